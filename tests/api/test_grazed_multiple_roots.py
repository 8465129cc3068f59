"""How often x = A cos(w t - phi) crosses a triple or fifth-fold root just below A, where doubles do not tell what
(x - c)^m does: each crossing is answered, or its absence is said to be in doubt. And maps of impacts at such roots,
where the motion starts."""

import math
import pathlib
import random
import sys
import unittest
from fractions import Fraction

from mpmath import mp, mpf

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from test_multiple_roots import Flight, power  # noqa: E402

mp.dps = 40
CASES = 150


class Graze:
    """An oscillator whose amplitude is `above` the root."""

    def __init__(self, draw):
        self.stiffness = mpf(draw.randint(50, 600)) / 100
        self.x, self.v = (mpf(draw.randint(-1500, 1500)) / 1000 for _ in range(2))
        self.exponent = draw.choice((1, 3, 3, 5))
        self.end = draw.choice((3, 6, 20))
        self.rate = mp.sqrt(self.stiffness)
        self.amplitude = mp.sqrt(self.x**2 + self.v**2 / self.stiffness)
        above = draw.choice((1, 1, -1)) * mpf(10) ** draw.uniform(-14, -3)
        self.root = mp.nstr(self.amplitude - above, draw.choice((15, 17, 25)), min_fixed=-99, max_fixed=99)
        self.is_expanded = draw.random() < 0.25

    def function(self):
        if self.is_expanded:
            return power(Fraction(self.root), self.exponent)
        return f"(x - ({self.root}))^{self.exponent}"

    def request(self, options):
        coordinate = {"name": "x", "initial": mp.nstr(self.x, 9), "initial_rate": mp.nstr(self.v, 9)}
        scene = {
            "name": "graze",
            "units": "none",
            "coordinates": [coordinate],
            "lagrangian": f"x_dot^2/2 - {mp.nstr(self.stiffness, 9)}*x^2/2",
            "events": [{"name": "top", "expression": self.function()}],
        }
        return {"system": scene, "events": ["top"], "t_end": self.end, "samples": 2, **options}

    def crossings(self):
        if mpf(self.root) >= self.amplitude:
            return []
        half = mp.acos(mpf(self.root) / self.amplitude) / self.rate
        top = mp.atan2(self.v / self.rate, self.x) / self.rate
        period = 2 * mp.pi / self.rate
        times = (top + k * period + side * half for k in range(-1, self.end + 2) for side in (-1, 1))
        return [t for t in times if 0 <= t <= self.end]


class GrazedMultipleRoots(Service):
    def test_each_crossing_is_answered_or_its_absence_told(self):
        draw, certain = random.Random(20261126), 0
        for _ in range(CASES):
            graze = Graze(draw)
            options = draw.choice(({}, {}, {"max_error": 1e-10}, {"accuracy": "fast"}))
            with self.subTest(root=graze.root, exponent=graze.exponent, expanded=graze.is_expanded, **options):
                answer = self.ask("simulate", graze.request(options))
                if answer["accuracy"].get("reason"):
                    continue
                certain += 1
                known = graze.crossings()
                self.assertEqual(len(answer["events"]), len(known))
                for event, t in zip(answer["events"], known):
                    self.assertLessEqual(abs(event["t"] - t), event["error"] or math.inf)
        self.assertGreater(certain, CASES / 3)

    def test_a_map_at_a_multiple_root_is_applied_once(self):
        for start, speed, place, exponent, end in (
            ("0.899", "0.343", "0.899", 7, "0.1304"),
            ("0.704", "0.588", "0.704", 7, "0.4207"),
            ("0.795", "0.431", "0.794999999997", 7, "0.759"),
            ("0.61", "0.9", "0.61", 5, "0.3"),
            ("0.5", "1.2", "0.49999999999", 3, "0.4"),
        ):
            for options in ({}, {"max_error": 1e-10}, {"accuracy": "accurate"}):
                with self.subTest(place=place, exponent=exponent, **options):
                    flight = Flight(start, speed, place, exponent, end)
                    event = {"name": "e", "expression": flight.function, "direction": "falling"}
                    kick = {"event": "e", "map": {"x_dot": "0.5*x_dot"}}
                    answer = self.ask("simulate", flight.request(options, events=[event], impacts=[kick]))
                    self.assertEqual(answer["status"], "complete")
                    x, v = flight.after(Fraction(1, 2))
                    errors = answer["accuracy"]["max_abs_error"]
                    self.assertLessEqual(abs(Fraction(answer["trajectory"]["x"][-1]) - x), errors["x"])
                    self.assertLessEqual(abs(Fraction(answer["trajectory"]["x_dot"][-1]) - v), errors["x_dot"])


if __name__ == "__main__":
    unittest.main()
