"""The stated errors of balls in a line that hit each other, a floor and a ceiling hundreds of times. Between impacts
each is on a parabola, and the next impact a root of a quadratic: the motion to 60 digits from the decimals of the
request."""

import os
import pathlib
import random
import statistics
import sys
import unittest

from mpmath import mp, mpf, sqrt

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, strict_json  # noqa: E402

mp.dps = 60
CASES = int(os.environ.get("QDOT_IMPACT_CASES", "60"))
MOST_IMPACTS = 500
# Once stated too small: the end of the motion is far, and impacts were as late as its rounding is.
KNOWN = {"balls": 2, "ceiling": False, "parameters": {"m0": 0.75917, "m1": 4.45, "a": 7.341, "e": 0.885},
         "initial": {"x0": 0.3267, "x1": 1.5077, "x0_dot": -0.154, "x1_dot": 0}, "t_end": 6.834, "samples": 30,
         "max_error": 1.73e-10}


def exact(number):
    return mpf(repr(number))


def scene(case):
    balls = range(case["balls"])
    contacts = [("floor", "x0")] + [(f"hit{i}", f"x{i} - x{i - 1}") for i in balls[1:]]
    if case["ceiling"]:
        contacts.append(("ceiling", f"b - x{balls[-1]}"))
    return {"name": "balls", "units": "none", "parameters": [{"name": name, "default": 1} for name in case["parameters"]],
            "coordinates": [{"name": f"x{i}"} for i in balls],
            "lagrangian": " + ".join(f"m{i}*x{i}_dot^2/2 - m{i}*a*x{i}" for i in balls),
            "events": [{"name": name, "expression": distance, "direction": "falling"} for name, distance in contacts],
            "impacts": [{"event": name, "restitution": "e"} for name, _ in contacts]}


class Balls:
    def __init__(self, case):
        count, given, start = case["balls"], case["parameters"], case["initial"]
        self.m = [exact(given[f"m{i}"]) for i in range(count)]
        self.a, self.e = exact(given["a"]), exact(given["e"])
        self.b = exact(given["b"]) if case["ceiling"] else None
        self.x = [exact(start[f"x{i}"]) for i in range(count)]
        self.v = [exact(start[f"x{i}_dot"]) for i in range(count)]
        self.t, self.impacts = mpf(0), 0

    def next_impact(self):
        """When, and of which balls: -1 stands for the floor, the number of balls for the ceiling."""
        x, v, last = self.x, self.v, len(self.x)
        found = [((v[0] + sqrt(v[0]**2 + 2 * self.a * x[0])) / self.a, -1)]
        if self.b is not None and v[-1]**2 > 2 * self.a * (self.b - x[-1]) > 0 and v[-1] > 0:
            found.append(((v[-1] - sqrt(v[-1]**2 - 2 * self.a * (self.b - x[-1]))) / self.a, last - 1))
        found += [((x[i + 1] - x[i]) / (v[i] - v[i + 1]), i) for i in range(last - 1) if v[i] > v[i + 1] and x[i + 1] > x[i]]
        return min(found)

    def later(self, s):
        return [x + v * s - self.a * s**2 / 2 for x, v in zip(self.x, self.v)] + [v - self.a * s for v in self.v]

    def state(self, t):
        """None after very many impacts."""
        while True:
            s, below = self.next_impact()
            if self.t + s > t:
                return self.later(t - self.t)
            if self.impacts == MOST_IMPACTS:
                return None
            self.pass_impact(s, below)

    def pass_impact(self, s, below):
        state, above = self.later(s), below + 1
        self.x, self.v = state[:len(self.x)], state[len(self.x):]
        self.t, self.impacts = self.t + s, self.impacts + 1
        if below == -1:
            self.x[0], self.v[0] = mpf(0), -self.e * self.v[0]
        elif above == len(self.x):
            self.x[below], self.v[below] = self.b, -self.e * self.v[below]
        else:
            self.x[above] = self.x[below]
            push = (1 + self.e) * (self.v[below] - self.v[above]) / (self.m[below] + self.m[above])
            self.v[below] -= self.m[above] * push
            self.v[above] += self.m[below] * push


def cases():
    yield KNOWN
    chance = random.Random(11)
    for _ in range(CASES):
        count = chance.choice([1, 2, 2, 3])
        case = {"balls": count, "ceiling": chance.random() < 0.3}
        numbers = [f"m{i}" for i in range(count)]
        case["parameters"] = {name: float(f"{10 ** chance.uniform(-1, 1):.{chance.choice([2, 5, 12])}g}") for name in numbers}
        case["parameters"] |= {"a": round(chance.uniform(2, 12), chance.choice([1, 3])), "e": round(chance.uniform(0.6, 0.99), 3)}
        if case["ceiling"]:
            case["parameters"]["b"] = round(chance.uniform(2.5, 4), 3)
        case["initial"] = {f"x{i}": round(0.7 * i + chance.uniform(0.1, 0.6), chance.choice([2, 4, 9])) for i in range(count)}
        case["initial"] |= {f"x{i}_dot": chance.choice([0, round(chance.uniform(-2, 2), 4)]) for i in range(count)}
        yield case | {"t_end": round(chance.uniform(1, 15), 3), "samples": chance.choice([2, 11, 40]),
                      "max_error": float(f"{10 ** chance.uniform(-13, -5):.3g}")}


class ManyImpacts(Service):
    def test_no_stated_error_is_below_the_true_one(self):
        ratios = []
        for case in cases():
            fields = {name: case[name] for name in ("parameters", "initial", "t_end", "samples", "max_error")}
            answer = strict_json(self.post("simulate", {"system": scene(case)} | fields).data)
            stated, rows = answer["accuracy"]["max_abs_error"], answer["trajectory"]
            motion = Balls(case)
            largest = dict.fromkeys(stated, mpf(0))
            for i, t in enumerate(rows["t"]):
                state = motion.state(exact(t))
                if state is None:
                    break
                if t in answer["accuracy"].get("at_impacts", []):
                    continue
                for name, true in zip(stated, state):
                    largest[name] = max(largest[name], abs(exact(rows[name][i]) - true))
            for name, error in largest.items():
                self.assertLessEqual(error, exact(stated[name]), (name, fields))
                # one that comes to rest is compared with nudged ones, which at round-off are much farther off
                if answer["status"] == "complete" and stated[name] > 1e-14 * max(map(abs, rows[name])) and error > 0:
                    ratios.append(float(exact(stated[name]) / error))
        self.assertGreater(len(ratios), CASES // 3)
        self.assertLess(statistics.median(ratios), 10)

    def test_the_times_of_impacts_are_within_their_errors(self):
        judged = 0
        for case in list(cases())[:CASES // 2]:
            fields = {name: case[name] for name in ("parameters", "initial", "t_end", "samples", "max_error")}
            answer = strict_json(self.post("simulate", {"system": scene(case)} | fields).data)
            motion = Balls(case)
            for event in answer["events"][:100]:
                s, below = motion.next_impact()
                motion.pass_impact(s, below)
                if event["error"] is None:
                    break  # from here on it may be another one
                self.assertLessEqual(abs(exact(event["t"]) - motion.t), exact(event["error"]), (event, fields))
                judged += 1
        self.assertGreater(judged, 3 * CASES)


class OneBall(Service):
    def test_bounces_where_it_did_a_thousand_times_before(self):
        """With nothing lost, and so low that the rounding of one bounce is a part of the next."""
        for rate, fall, end in (("0.1", "9.81", 20), ("0.02", "9", 2), ("2", "900", 2), ("2e-6", "9e-4", 2)):
            with self.subTest(rate=rate, fall=fall):
                ball = {"name": "ball", "units": "none", "coordinates": [{"name": "x", "initial": "0", "initial_rate": f"-{rate}"}],
                        "lagrangian": f"x_dot^2/2 - {fall}*x", "events": [{"name": "floor", "expression": "x", "direction": "falling"}],
                        "impacts": [{"event": "floor", "restitution": "1"}]}
                answer = self.ask("simulate", {"system": ball, "t_end": end, "samples": 4, "events": ["floor"]})
                self.assertGreater(len(answer["events"]), 400)
                for k, event in enumerate(answer["events"]):
                    self.assertLessEqual(abs(event["t"] - 2 * k * mpf(rate) / mpf(fall)), event["error"])


if __name__ == "__main__":
    unittest.main()
