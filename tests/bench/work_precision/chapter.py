"""tests/bench/README.md, from the measured points: python3 chapter.py FOLDER. Every figure in it is of that run."""

import csv
import pathlib
import statistics
import sys

import points
from summary import number, table

PROMISES = {"fast": "1e-3", "balanced": "1e-6", "accurate": "1e-9"}
ERRORS = (1e-3, 1e-6, 1e-9)
PROGRAMS = """## The other benchmarks

`cmake --preset release -DQDOT_BENCH=ON` adds them to the build; none has a limit that a slow machine could miss, and
each prints a ratio to a reference in the same run.

| program | what it measures |
|---|---|
| `bench` | models, tapes, equilibria, modes, turning points, JSON and whole requests (Google Benchmark) |
| `server_bench` | small answers on kept connections, beside bare cpp-httplib |
| `tests/bench/answers_against_scipy.py` | answers without a motion, beside SciPy given the formulas |
| `tests/bench/process_bench.py` | start to first answer, memory |
| `tests/server/load.py` | light and heavy requests far above what the machine can do |"""


def is_compiled(method, _):
    return method.startswith(("boost", "gsl"))


def is_ours(method, _):
    return method in points.OWN


def conditions(folder):
    lines = (folder / "conditions.txt").read_text().splitlines()
    print("What each preset costs and gives, and what other programs take for the same. `tests/bench/measure` made these "
          f"figures in one run ({lines[0]}; {lines[1]}, {lines[2]}; {lines[3]}; {lines[-1]}) and makes them again; all "
          "points, conditions and a plot for each motion are in `measured`. CPU time, 1001 rows of "
          "coordinates and velocities, 13 motions of the eleven systems, 0.35 to 100 s long.\n")


def presets(folder):
    with open(folder / "presets.csv", encoding="ascii") as lines:
        rows = list(csv.DictReader(lines))
    with open(folder / "ladder.csv", encoding="ascii") as lines:
        ratios = [float(r["second_us"])/float(r["first_us"]) for r in csv.DictReader(lines)]
    out = []
    for name, promise in PROMISES.items():
        group = [r for r in rows if r["preset"] == name]
        times = [float(r["cpu_us"])/1000 for r in group]
        kept = sum(r["meets_request"] == "1" for r in group)
        out.append([f"`{name}`", promise, f"{statistics.median(float(r['error']) for r in group):.0e}",
                    f"{max(float(r['error']) for r in group):.0e}", f"{kept} of {len(group)}",
                    f"{number(statistics.median(times))} ({number(min(times))} to {number(max(times))})"])
    table(["preset", "promise", "true error, median", "largest", "kept", "CPU ms, median (range)"], out)
    print("Errors are over each column's largest magnitude. A promise that was not kept was said so in the answer. The "
          f"second computation, which measures the error, costs {statistics.median(ratios):.2f} times the first "
          f"(at most {max(ratios):.2f}).\n")


def systems(motions):
    print("CPU time in us to an error of 1e-6 (SI, the largest of all rows and columns); Boost.odeint and GSL have "
          "equations written by hand in C++ for the first six, the compiled tape for the others.\n")
    rows = []
    for motion, series in motions.items():
        def time(method, kind):
            found = points.time_for(series.get((method, kind), []), 1e-6)
            return number(found)
        peer = points.best(series, 1e-6, is_compiled)
        rows.append([f"[{motion.replace('_', ' ')}](measured/{motion}.svg)"]
                    + [time(method, "tape") for method in points.OWN]
                    + [f"{number(peer[0])} ({peer[1].replace('_', ' ')})" if peer else "-",
                       time("scipy_dop853", "python"), time("scipy_odeint", "python")])
    table(["motion", *points.OWN, "best of Boost and GSL", "SciPy DOP853", "SciPy odeint"], rows)


def winners(motions):
    """Which method wins where."""
    others, cells, ours_elsewhere = [], 0, []
    for motion, series in motions.items():
        for error in ERRORS:
            first = points.best(series, error, lambda m, e: m != "taylor_by_hand")
            if first is None:
                continue
            cells += 1
            taylor = points.time_for(series[("taylor", "tape")], error)
            if not is_ours(*first[1:]):
                others.append(f"{motion.replace('_', ' ')} at {error:.0e} ({first[1].replace('_', ' ')}, "
                              f"{first[0]/taylor:.2f})")
            own = points.best(series, error, is_ours)
            if own and own[1] != "taylor":
                ours_elsewhere.append(f"{motion.replace('_', ' ')} at {error:.0e} ({own[1]})")
    print(f"Of {cells} pairs of motion and error (1e-3, 1e-6, 1e-9), `taylor` is the fastest of all in "
          f"{cells - len(others)}." + (f" Faster than it, with their share of its time: {'; '.join(others)}." if others else ""))
    print("Of our own methods it is the fastest " +
          (f"except for {'; '.join(ours_elsewhere)}." if ours_elsewhere else "everywhere.") + " `gauss`, whose step is "
          "fixed, is for the energy of long motions, `bdf` for strong damping, `adams` and `erk` are second roads.")


def factors(motions):
    """Ratios to SciPy and to Taylor methods by hand."""
    scipy, by_hand = [], []
    for motion, series in motions.items():
        for error in ERRORS:
            taylor = points.time_for(series[("taylor", "tape")], error)
            dop853 = points.time_for(series.get(("scipy_dop853", "python"), []), error)
            hand = points.time_for(series.get(("taylor_by_hand", "hand"), []), error)
            if taylor and dop853:
                scipy.append(dop853/taylor)
            if taylor and hand:
                by_hand.append((taylor/hand, f"{motion.replace('_', ' ')} at {error:.0e}"))
    print(f"SciPy's DOP853 takes {min(scipy):.0f} to {max(scipy):.0f} times as long (median {statistics.median(scipy):.0f})."
          f" Beside scalar Taylor methods written by hand for a system, `taylor` on the tape takes "
          f"{min(by_hand)[0]:.2f} ({min(by_hand)[1]}) to {max(by_hand)[0]:.2f} ({max(by_hand)[1]}) times as long.\n")


def main():
    folder = pathlib.Path(sys.argv[1])
    motions = points.read(folder)
    print("# What accuracy costs\n")
    conditions(folder)
    presets(folder)
    systems(motions)
    winners(motions)
    factors(motions)
    print(PROGRAMS)


if __name__ == "__main__":
    main()
