"""An overload client: offers more than the server can do, and measures what comes of it.

    python3 tests/server/load.py [--seconds 60] [--rounds 2,5,10]

Open loop: requests leave at their appointed times, whether or not answers come. The server gets one core and the
clients the others. QDOT_BINARY names the program. Prints one JSON line a measurement and exits 1 where a promise of
the README is broken.
"""

import argparse
import json
import multiprocessing
import os
import select
import socket
import sys
import time

import hostile_inputs
from running_qdot import RunningQdot

LIGHT = hostile_inputs.simulate(t_end=90, samples=2, digits=6)  # a few milliseconds
SMALL = hostile_inputs.get(b"/v1/modes?system=cart_pendulum")
HEAVY = hostile_inputs.simulate(t_end=2000, samples=2, digits=6)  # a hundred times as much
MOTION = hostile_inputs.simulate(t_end=100, samples=2, digits=6)  # about ten milliseconds, and in the heavy lane
HEALTH = hostile_inputs.get(b"/healthz")
MOST_CONNECTIONS = 900


class Client:
    """Requests on kept connections, each its own; answers in the order of their coming."""

    def __init__(self, port):
        self.port = port
        self.poll = select.epoll()
        self.free, self.busy = [], {}
        self.answers = []  # (status, seconds from its appointed time to its answer)
        self.unsent = 0

    def send(self, data, due):
        if self.free:
            sock = self.free.pop()
        elif len(self.busy) < MOST_CONNECTIONS:
            sock = socket.create_connection(("127.0.0.1", self.port))
            sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self.poll.register(sock, select.EPOLLIN)
        else:
            self.unsent += 1
            return
        self.busy[sock.fileno()] = [sock, due, b""]
        sock.sendall(data)

    def receive(self, timeout):
        for number, _ in self.poll.poll(timeout):
            entry = self.busy.get(number)
            if entry is None:
                continue
            sock, due, data = entry
            part = sock.recv(65536)
            entry[2] = data = data + part
            if part and not data.endswith(b"}\n"):
                continue
            del self.busy[number]
            self.answers.append((int(data[9:12]) if data else 0, time.monotonic() - due))
            if part and b"Connection: close" not in data:
                self.free.append(sock)
            else:
                self.poll.unregister(sock)
                sock.close()

    def close(self):
        for sock in [entry[0] for entry in self.busy.values()] + self.free:
            sock.close()
        self.poll.close()


def closed_loop(port, data, connections, seconds):
    """Each connection asks again as soon as it has its answer."""
    client = Client(port)
    start = time.monotonic()
    while (now := time.monotonic()) < start + seconds:
        while len(client.busy) < connections:
            client.send(data, now)
        client.receive(0.1)
    client.close()
    return client.answers


def open_loop(port, data, rate, seconds):
    """`rate` a second, then two seconds for what is still on its way."""
    client = Client(port)
    start = time.monotonic()
    sent = 0
    while (now := time.monotonic()) < start + seconds + 2:
        while sent < rate * seconds and now >= start + sent / rate:
            client.send(data, start + sent / rate)
            sent += 1
        next_one = start + sent / rate if sent < rate * seconds else start + seconds + 2
        client.receive(max(0, min(0.05, next_one - time.monotonic())))
        if sent >= rate * seconds and not client.busy:
            break
    unanswered = len(client.busy)
    client.close()
    return client.answers, unanswered + client.unsent


def paced(port, data, gap, seconds):
    """One connection that asks, waits for the answer and then `gap` seconds."""
    client = Client(port)
    end = time.monotonic() + seconds
    while (now := time.monotonic()) < end:
        client.send(data, now)
        while client.busy:
            client.receive(1)
        time.sleep(gap)
    client.close()
    return client.answers


def percentile(seconds, part):
    ordered = sorted(seconds)
    return ordered[min(len(ordered) - 1, int(part * len(ordered)))] if ordered else None


def milliseconds(answers, status, part=0.99):
    value = percentile([seconds for code, seconds in answers if code == status], part)
    return None if value is None else round(value * 1000, 1)


def in_process(function, *arguments):
    """Runs a client beside this one; its answers come from .get()."""
    pool = multiprocessing.Pool(1)
    result = pool.apply_async(function, arguments)
    pool.close()
    return result


def overload(port, times, seconds):
    """Saturation, then so many times as much."""
    saturated = closed_loop(port, LIGHT, 16, seconds)
    saturation = sum(status == 200 for status, _ in saturated) / seconds
    yield {"what": "saturation", "per_second": round(saturation, 1), "p99_ms": milliseconds(saturated, 200)}
    for factor in times:
        health = in_process(paced, port, HEALTH, 0.01, seconds)
        answers, unanswered = open_loop(port, LIGHT, factor * saturation, seconds)
        good = sum(status == 200 and took < 2 for status, took in answers) / seconds
        yield {"what": f"{factor}x", "offered": round(factor * saturation), "goodput": round(good / saturation, 3),
               "p99_ms": milliseconds(answers, 200), "shed_p99_ms": milliseconds(answers, 503),
               "health_p99_ms": milliseconds(health.get(), 200), "unanswered": unanswered,
               "others": sum(status not in (200, 503) for status, _ in answers)}


def fairness(port, seconds):
    """Light requests alone, then beside as many heavy ones as the server takes."""
    alone = paced(port, SMALL, 0.005, seconds)
    heavy = in_process(closed_loop, port, HEAVY, 8, seconds + 1)
    time.sleep(0.5)
    beside = paced(port, SMALL, 0.005, seconds)
    done = heavy.get()
    yield {"what": "fairness", "alone_p99_ms": milliseconds(alone, 200), "beside_heavy_p99_ms": milliseconds(beside, 200),
           "light_refused": sum(status != 200 for status, _ in beside),
           "heavy_done": sum(status == 200 for status, _ in done)}


def burst(port, count):
    """So many motions at one moment, beside light requests."""
    light = in_process(paced, port, SMALL, 0.005, 3)
    time.sleep(0.5)
    client = Client(port)
    started = time.monotonic()
    for _ in range(count):
        client.send(MOTION, started)
    while client.busy and time.monotonic() < started + 60:
        client.receive(0.1)
    beside = light.get()
    unanswered = len(client.busy) + client.unsent
    client.close()
    yield {"what": "burst", "of": count, "answered": sum(status == 200 for status, _ in client.answers),
           "seconds": round(max((took for _, took in client.answers), default=0), 2),
           "unanswered": unanswered, "light_p99_ms": milliseconds(beside, 200),
           "light_refused": sum(status != 200 for status, _ in beside)}


def broken_promises(found):
    if found["what"] == "burst":
        yield found["answered"] < found["of"], "not all of a burst was answered"
        yield found["light_p99_ms"] > 10, "a light request took more than 10 ms beside a burst"
    if found["what"].endswith("x"):
        yield found["goodput"] < 0.9, "goodput below 90 % of saturation"
        yield found["p99_ms"] > 250, "an admitted light request took more than 250 ms"
        yield (found["shed_p99_ms"] or 0) > 100, "a refusal took more than 100 ms"
        yield found["health_p99_ms"] > 100, "a probe took more than 100 ms"
        yield found["unanswered"] or found["others"], "requests without an answer"
    if found["what"] == "fairness":
        yield found["beside_heavy_p99_ms"] > 3 * found["alone_p99_ms"], "light requests wait for heavy ones"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--rounds", default="2,5,10")
    options = parser.parse_args()
    cores = sorted(os.sched_getaffinity(0))
    os.sched_setaffinity(0, cores[:1])  # the server inherits it
    broken = False
    with RunningQdot() as server:
        os.sched_setaffinity(0, cores[1:] or cores)
        rounds = [float(factor) if "." in factor else int(factor) for factor in options.rounds.split(",")]
        for part in (burst(server.port, 300), overload(server.port, rounds, options.seconds), fairness(server.port, options.seconds)):
            for found in part:
                found["broken"] = [text for failed, text in broken_promises(found) if failed]
                broken = broken or bool(found["broken"])
                print(json.dumps(found), flush=True)
    sys.exit(broken)


if __name__ == "__main__":
    main()
