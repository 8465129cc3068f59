"""The measured points, and the least time in which a method reaches an error."""

import csv
import math

OWN = ("taylor", "erk", "adams", "bdf", "gauss")


def read(folder):
    """{motion: {(method, equations): [(error, us, setting), ...]}}, in the order of the file."""
    motions = {}
    with open(folder / "points.csv", encoding="ascii") as lines:
        for row in csv.DictReader(lines):
            if float(row["error"]) > 0:
                motions.setdefault(row["motion"], {}).setdefault((row["method"], row["equations"]), []).append(
                    (float(row["error"]), float(row["cpu_us"]), float(row["tolerance"])))
    return motions


def front(points):
    """Those that no other beats in both, from the largest error to the smallest."""
    chosen = []
    for error, us, _ in sorted(points, key=lambda p: (p[1], p[0])):
        if not chosen or error < chosen[-1][0]:
            chosen.append((error, us))
    return chosen


def time_for(points, error):
    """Least CPU time in us that reaches the error, by log-log interpolation along the front; none if not reached."""
    before = None
    for reached, us in front(points):
        if reached <= error:
            if before is None:
                return us
            share = math.log(before[0]/error)/math.log(before[0]/reached)
            return before[1]*(us/before[1])**share
        before = (reached, us)
    return None


def best(series, error, wanted):
    """(us, method, equations) of the fastest among those that `wanted` says yes to; none if none reaches it."""
    times = [(time_for(points, error), *key) for key, points in series.items() if wanted(*key)]
    times = [entry for entry in times if entry[0] is not None]
    return min(times) if times else None
