"""A ball on a plate that is shaken: at each impact what is off in the instant becomes an error of the plate's speed, and
chaos grows it. Against parabolas and bisection to 60 digits."""

import math
import os
import pathlib
import random
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, strict_json  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mpmath.mp.dps = 60
CASES = int(os.environ.get("QDOT_PLATE_CASES", "30"))
LOOK = 1e-3  # seconds between two looks for the next impact
mpf = mpmath.mpf
PLATE = [{"name": "plate", "expression": "y - a*sin(w*t)", "direction": "falling"}]


class Ball:
    """Falls with g = 9.81 on the plate a*sin(w*t), and comes back with the part e of the speed between them."""

    def __init__(self, y, a, w, e):
        self.t, self.y, self.v, self.g = mpf(0), mpf(y), mpf(0), mpf("9.81")
        self.a, self.w, self.e = mpf(a), mpf(w), mpf(e)

    def height(self, t):
        return self.y + self.v * (t - self.t) - self.g * (t - self.t)**2 / 2

    def next_impact(self, end):
        """None before the end; a look at doubles tells where it is."""
        t0, y, v, a, w = map(float, (self.t, self.y, self.v, self.a, self.w))
        for n in range(1, math.ceil((float(end) - t0) / LOOK) + 1):
            dt = min(n * LOOK, float(end) - t0)
            if y + v * dt - 4.905 * dt * dt < a * math.sin(w * (t0 + dt)):
                gap = lambda t: self.height(t) - self.a * mpmath.sin(self.w * t)  # noqa: E731
                return mpmath.findroot(gap, (mpf(t0 + (n - 1) * LOOK), mpf(t0 + dt)), solver="anderson", tol=1e-110)
        return None

    def motion(self, end):
        """Times of impacts, the least speed between ball and plate, the state at the end."""
        times, slowest = [], mpmath.inf
        while slowest > 0.5 and (t := self.next_impact(end)) is not None:
            own = self.v - self.g * (t - self.t)
            plate = self.a * self.w * mpmath.cos(self.w * t)
            slowest = min(slowest, plate - own)
            self.t, self.y, self.v = t, self.height(t), plate + self.e * (plate - own)
            times.append(t)
        return times, slowest, (self.height(end), self.v - self.g * (end - self.t))


class ShakenPlate(Service):
    def test_rows_and_instants_are_within_their_errors(self):
        draw = random.Random(20)
        scene = lagrangian("ball", "a 1 0.1; w 1 9; e 1 0.9", "y - 1 0", "y_dot^2/2 - 9.81*y", events=PLATE,
                           impacts=[{"event": "plate", "restitution": "e"}])
        judged = impacts = 0
        for _ in range(CASES):
            numbers = {"a": round(draw.uniform(0.05, 0.25), 3), "w": round(draw.uniform(5, 18), 2),
                       "e": draw.choice([0.8, 0.9, 1])}
            y, end = round(draw.uniform(0.6, 2), 3), draw.choice([4, 8, 12])
            times, slowest, (y_end, v_end) = Ball(str(y), *map(str, numbers.values())).motion(mpf(end))
            if slowest < 0.5:
                continue  # it may have bounced between two looks
            request = {"system": scene, "parameters": numbers, "initial": {"y": y}, "t_end": end, "samples": 3,
                       "events": ["plate"], **draw.choice([{}, {"accuracy": "fast"}, {"method": "erk"}, {"rtol": 1e-7}])}
            answer = strict_json(self.post("simulate", request).data)
            errors = answer["accuracy"]["max_abs_error"]
            if errors is None or len(answer["events"]) != len(times):
                self.assertIn("reason", answer["accuracy"], answer)
                continue
            judged += 1
            for name, true in (("y", y_end), ("y_dot", v_end)):
                off = abs(mpf(answer["trajectory"][name][-1]) - true)
                self.assertLessEqual(off, mpf(errors[name]), (name, request))
            for event, t in zip(answer["events"], times):
                if event["error"] is not None:
                    impacts += 1
                    self.assertLessEqual(abs(mpf(event["t"]) - t), mpf(event["error"]), (event, request))
        self.assertGreater(judged, CASES / 3)
        self.assertGreater(impacts, 2 * CASES)


if __name__ == "__main__":
    unittest.main()
