"""Timings of the whole program, from outside: start, answers, memory, one command. Prints a table and asserts nothing.

    python3 tests/bench/process_bench.py            the binary of the release preset, or $QDOT_BINARY
"""

import pathlib
import statistics
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "server"))

from running_qdot import RunningQdot, answer, qdot  # noqa: E402 (after the path)

SIMULATE = "/v1/simulate?system=spring_pendulum&t_end=10"
STARTS = 20
SIMULATIONS = 1000
COMMANDS = 20


def milliseconds(function):
    start = time.perf_counter()
    function()
    return 1000 * (time.perf_counter() - start)


def expect_ok(response):
    if response.status != 200:
        raise SystemExit(f"{response.status}: {response.data.decode()}")


def start_to_first_answer():
    start = time.perf_counter()
    with RunningQdot() as server:
        expect_ok(server.request("GET", "/healthz"))
        return 1000 * (time.perf_counter() - start)


def resident_megabytes(server):
    """VmRSS in 10^6 bytes."""
    status = pathlib.Path(f"/proc/{server.process.pid}/status").read_text()
    return next(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmRSS")) * 1024 / 1e6


def keep_alive(server):
    """Milliseconds of each of many simulations on one connection."""
    connection = server.connect()
    try:
        return [milliseconds(lambda: expect_ok(answer(connection, "GET", SIMULATE))) for _ in range(SIMULATIONS)]
    finally:
        connection.close()


def command():
    run = qdot("simulate", "system=spring_pendulum", "t_end=10")
    if run.returncode != 0:
        raise SystemExit(run.stderr.decode())


def main():
    rows = [("start to first answer, median", statistics.median(start_to_first_answer() for _ in range(STARTS)),
             "ms", "< 100")]
    with RunningQdot() as server:
        rows.append(("resident memory, fresh", resident_megabytes(server), "MB", ""))
        times = keep_alive(server)
        rows.append((f"resident memory, {SIMULATIONS} simulations later", resident_megabytes(server), "MB", "< 50"))
    rows += [("simulate, keep-alive, one connection", 1000 * len(times) / sum(times), "1/s", ""),
             ("simulate, median", statistics.median(times), "ms", ""),
             ("simulate, 99 of 100 below", statistics.quantiles(times, n=100)[-1], "ms", ""),
             ("simulate as a command, median", statistics.median(milliseconds(command) for _ in range(COMMANDS)),
              "ms", "")]
    for name, value, unit, target in rows:
        print(f"{name:45}{value:10.2f} {unit:4}{target:>6}".rstrip())


if __name__ == "__main__":
    main()
