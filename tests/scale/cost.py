"""What answers cost: CPU time of one core, by qdot batch and by a server over kept connections.

    python3 tests/scale/cost.py

QDOT_BINARY names the program. Of each way the least of three runs is printed, as a table of Markdown. CPU time and not
the clock's is what a fleet pays for, and other work on the machine hardly disturbs it.
"""

import http.client
import json
import os
import pathlib
import resource
import subprocess
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "server"))

from running_qdot import ENVIRONMENT, QDOT, RunningQdot  # noqa: E402

RUNS, HOURS = 3, 3600
DOLLARS_PER_CORE_HOUR = 0.04
MOTION = {"system": "spring_pendulum", "t_end": 10}
# Of each kind: what it is called, the endpoint, its request, the parameter in which the answers differ, how many.
KINDS = [("energy at a state", "energy", {"system": "spring_pendulum"}, "k", 4000),
         ("natural frequencies", "modes", {"system": "cart_pendulum"}, "k", 2000),
         ("turning points", "turning_points", {"system": "free_spin_pendulum"}, "l", 2000),
         ("10 s of motion, 2 rows, error below 1e-6", "simulate", {**MOTION, "samples": 2, "max_error": 1e-6}, "k", 1000),
         ("10 s of motion, 101 rows, balanced", "simulate", {**MOTION, "samples": 101}, "k", 1000),
         ("10 s of motion, 1001 rows, as CSV", "simulate", {**MOTION, "samples": 1001, "format": "csv"}, "k", 300)]


def requests_of(kind):
    _, _, request, parameter, count = kind
    return [{**request, "parameters": {parameter: 1 + number / count}} for number in range(count)]


def seconds_of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def seconds_of_process(number):
    fields = pathlib.Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def cost_in_batch(kind):
    lines = "".join(json.dumps({"id": number, kind[1]: request}) + "\n" for number, request in enumerate(requests_of(kind)))
    before = seconds_of_children()
    done = subprocess.run([QDOT, "batch", "--jobs", "1"], input=lines.encode(), stdout=subprocess.PIPE, check=True, env=ENVIRONMENT)
    used = seconds_of_children() - before
    assert done.stdout.count(b'"status":200') == kind[4]
    return used / kind[4]


def cost_over_http(kind, server):
    bodies = [json.dumps(request) for request in requests_of(kind)]
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=60)
    before = seconds_of_process(server.process.pid)
    for body in bodies:
        connection.request("POST", f"/v1/{kind[1]}", body, {"Content-Type": "application/json"})
        response = connection.getresponse()
        response.read()
        assert response.status == 200
    connection.close()
    return (seconds_of_process(server.process.pid) - before) / kind[4]


def main():
    print("| answer | ms, qdot batch | ms, HTTP | core-hours a million | $ a million |\n|---|---|---|---|---|")
    with RunningQdot() as server:
        for kind in KINDS:
            batch = min(cost_in_batch(kind) for _ in range(RUNS))
            over_http = min(cost_over_http(kind, server) for _ in range(RUNS))
            hours = over_http * 1e6 / HOURS
            print(f"| {kind[0]} | {batch * 1000:.2f} | {over_http * 1000:.2f} | {hours:.2g} "
                  f"| {hours * DOLLARS_PER_CORE_HOUR:.2g} |", flush=True)


if __name__ == "__main__":
    main()
