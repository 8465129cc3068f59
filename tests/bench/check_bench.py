"""Processor time of grading, warm: each item of the ten keys with a right and a wrong answer, and submissions of 20 of them; and
cold: a `qdot check` of one item from start to end, in user mode, with its page faults.

    python3 tests/bench/check_bench.py            the binary of the release preset, or $QDOT_BINARY

Time is that of the server's threads as the kernel counts it (/proc/PID/task/*/schedstat), in user mode and for the answer's way
through the sockets, so that what else runs on the machine does not count. Prints a table and asserts nothing.
"""

import json
import pathlib
import random
import resource
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path += [str(HERE.parent / "server"), str(HERE.parent / "api")]

from running_qdot import RunningQdot, answer, qdot  # noqa: E402 (after the path)
from test_keys import ANSWERS, KEYS  # noqa: E402

REPEATS = 20
SUBMISSIONS = 200
SIZE = 20


def processor_milliseconds(server):
    tasks = pathlib.Path(f"/proc/{server.process.pid}/task").glob("*/schedstat")
    return sum(int(task.read_text().split()[0]) for task in tasks) / 1e6


def items():
    """(name, item) of every item of the keys, the originals of their ranges put in."""
    for number, answers in ANSWERS.items():
        key = json.loads((KEYS / f"problem_{number}.json").read_text())
        text = json.dumps(key["items"])
        for name, value in key.get("ranges", {}).items():
            whole = str(value["default"]) + (" " + value["unit"] if "unit" in value else "")
            text = text.replace(f'"${name}"', json.dumps(whole)).replace(f"${name}", str(value["default"]))
        for item in json.loads(text):
            for kind, submitted in zip(("right", "wrong"), answers[item["id"]]):
                yield f"{number} {item['id']} {kind}", {**item, "submitted": submitted}


def cost(server, connection, asked):
    """Processor milliseconds of one request with these items."""
    body = json.dumps({"items": [{**item, "id": str(number)} for number, item in enumerate(asked)]})
    before = processor_milliseconds(server)
    response = answer(connection, "POST", "/v1/check", body, {"Content-Type": "application/json"})
    if response.status != 200:
        raise SystemExit(response.data.decode())
    return processor_milliseconds(server) - before


def cold(item):
    """User milliseconds and page faults of a command that grades the item."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = qdot("check", stdin=json.dumps({"items": [{**item, "id": "0"}]}))
    if run.returncode != 0:
        raise SystemExit(run.stderr.decode())
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return 1000 * (after.ru_utime - before.ru_utime), after.ru_minflt - before.ru_minflt


def quantile(values, part):
    return sorted(values)[min(len(values) - 1, int(part * len(values)))]


def line(name, values):
    print(f"{name:<28} {quantile(values, 0.5):8.2f} {quantile(values, 0.99):8.2f} {max(values):8.2f}  ms: p50, p99, longest")


def main():
    named = dict(items())
    with RunningQdot("--threads", "1") as server:
        connection = server.connect()
        for item in named.values():
            cost(server, connection, [item])  # warm
        single = {name: [cost(server, connection, [item]) for _ in range(REPEATS)] for name, item in named.items()}
        line("one item", [value for values in single.values() for value in values])
        plain = {name: values for name, values in single.items() if not {"gait", "bifurcations"} & set(named[name]["expect"])}
        line("without gait, bifurcations", [value for values in plain.values() for value in values])
        chosen = random.Random(1)
        line(f"submission of {SIZE}", [cost(server, connection, chosen.sample(list(named.values()), SIZE))
                                       for _ in range(SUBMISSIONS)])
        connection.close()
    commands = [cold(item) for item in named.values()]
    line("cold command, bar 60 ms", [milliseconds for milliseconds, _ in commands])
    print(f"{'its page faults':<28} {quantile([faults for _, faults in commands], 0.5):8} {max(faults for _, faults in commands):17}")
    print("dearest:", ", ".join(f"{name} {quantile(values, 0.5):.1f}" for name, values in
                                sorted(single.items(), key=lambda entry: -quantile(entry[1], 0.5))[:6]))


if __name__ == "__main__":
    main()
