"""The stated errors of the states at events and at a stop, against damped oscillations and falls in closed form, to 40
digits. Rows are few, and late: what the last row may be off says nothing of a state long before it."""

import os
import pathlib
import random
import statistics
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, strict_json  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mpmath.mp.dps = 40
CASES = int(os.environ.get("QDOT_EVENT_CASES", "30"))
mpf = mpmath.mpf


class Oscillation:
    """x'' = -c x' - k x."""

    def __init__(self, c, k, x, v):
        self.rate, x, v = mpf(c) / 2, mpf(x), mpf(v)
        self.w = mpmath.sqrt(mpf(k) - self.rate**2)
        self.a, self.b = x, (v + self.rate * x) / self.w

    def state(self, t):
        s, c, shrunk = mpmath.sin(self.w * t), mpmath.cos(self.w * t), mpmath.exp(-self.rate * t)
        x = self.a * c + self.b * s
        return {"x": shrunk * x, "x_dot": shrunk * (self.w * (self.b * c - self.a * s) - self.rate * x)}

    def turns(self, end):
        """Times at which x' = 0, in (0, end)."""
        first = mpmath.atan2(self.w * self.b - self.rate * self.a, self.w * self.a + self.rate * self.b) / self.w
        half = mpmath.pi / self.w
        first -= half * mpmath.floor(first / half)
        times = []
        while first < end:
            times.append(first)
            first += half
        return times

    def times_of(self, level, end):
        """x = level, one at most between two turns."""
        ends = [mpf(0), *self.turns(end), mpf(end)]
        found = []
        for before, after in zip(ends, ends[1:]):
            low, high = (self.state(t)["x"] - level for t in (before, after))
            if low * high < 0:
                found.append(mpmath.findroot(lambda t: self.state(t)["x"] - level, (before, after), solver="anderson",
                                             tol=1e-60))
        return found


def oscillator(**members):
    return lagrangian("damped", "c 1 1; k 1 1; wall 1 9", "x - 0 0", "exp(c*t)*(x_dot^2/2 - k*x^2/2)", **members)


class EventStates(Service):
    def setUp(self):
        self.ratios = []
        self.random = random.Random(86)

    def tolerance(self):
        return self.random.choice([{"rtol": 10.0 ** self.random.uniform(-12, -4)}, {"accuracy": "fast"},
                                   {"max_error": 10.0 ** self.random.uniform(-12, -4)}, {}, {"method": "erk"}])

    def judge(self, found, true, request):
        self.assertEqual(set(found["state_error"]), set(true), request)
        for name, value in true.items():
            off, error = abs(mpf(found["state"][name]) - value), mpf(found["state_error"][name])
            self.assertLessEqual(off, error, (name, mpmath.nstr(value, 20), found, request))
            if off > 1e-15 * abs(value) and off > 1e-16:
                self.ratios.append(float(error / off))

    def ask(self, request):
        return strict_json(self.post("simulate", request).data)

    def drawn(self):
        draw = [round(self.random.uniform(*ends), 4) for ends in ((0, 3), (3, 60), (-1, 1), (1, 4))]
        return Oscillation(*map(str, draw)), {"parameters": dict(zip("ck", draw)), "initial": dict(zip(("x", "x_dot"), draw[2:]))}

    def test_of_damped_oscillations_between_two_rows(self):
        events = 0
        for _ in range(3 * CASES):
            motion, request = self.drawn()
            level = mpmath.nstr(motion.state(motion.turns(9)[0])["x"] * self.random.uniform(-0.5, 0.9), 6)
            request = {"system": oscillator(), **request, "t_end": 9, "samples": 2, "events": [f"x={level}"], **self.tolerance()}
            answer = self.ask(request)
            times = motion.times_of(mpf(level), 9)
            self.assertEqual(len(answer["events"]), len(times), answer)
            for event, t in zip(answer["events"], times):
                if event["error"] is not None:
                    events += 1
                    self.judge(event, motion.state(t), request)
        self.assertGreater(events, 3 * CASES)
        self.assertLess(statistics.median(self.ratios), 200)

    def test_where_a_wall_ends_the_motion(self):
        wall = [{"name": "room", "expression": "wall - x", "reason": "hit", "message": "It hit the wall."}]
        for _ in range(CASES):
            motion, request = self.drawn()
            level = mpmath.nstr(motion.state(motion.turns(9)[0])["x"] * self.random.uniform(0.5, 0.95), 6)
            times = motion.times_of(mpf(level), 9)
            if request["initial"]["x"] >= float(level) or not times:
                continue
            request = {"system": oscillator(valid_while=wall), **request, "t_end": 9, "samples": 2, **self.tolerance()}
            request["parameters"]["wall"] = float(level)
            stop = self.ask(request)["stop"]
            self.judge(stop, motion.state(times[0]), request)
        self.assertGreater(len(self.ratios), CASES / 4)

    def test_just_before_the_impacts_of_a_ball(self):
        """v_n = e^n v_0, at the height 0."""
        ball = lagrangian("ball", "g 1 9.81; e 1 0.8", "y - 1 0", "y_dot^2/2 - g*y", events=[
            {"name": "floor", "expression": "y", "direction": "falling"}], impacts=[{"event": "floor", "restitution": "e"}])
        for _ in range(CASES):
            g, e, y = (round(self.random.uniform(*ends), 4) for ends in ((1, 20), (0.3, 0.95), (0.2, 3)))
            first = mpmath.sqrt(2 * mpf(str(y)) / mpf(str(g)))
            fall = first * mpf(str(g))
            request = {"system": ball, "parameters": {"g": g, "e": e}, "initial": {"y": y}, "samples": 2,
                       "t_end": round(float(first * 3), 4), "events": ["floor"], **self.tolerance()}
            answer = self.ask(request)
            self.assertGreater(len(answer["events"]), 0, answer)
            for n, event in enumerate(answer["events"][:5]):
                if event["error"] is not None:
                    self.judge(event, {"y": mpf(0), "y_dot": -fall * mpf(str(e)) ** n}, request)
        self.assertGreater(len(self.ratios), CASES)


if __name__ == "__main__":
    unittest.main()
