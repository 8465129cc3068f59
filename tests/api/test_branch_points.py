"""Roots and powers that pass near their branch points, or have no value for a while, along a motion x = v t.

Where a^n - c is zero, a(x) = c^(1/n) is a quadratic equation.
"""

import pathlib
import random
import sys
import unittest

from mpmath import acos, atan2, cos, mp, mpf, pi, sin, sqrt

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mp.dps = 40


class Case:
    """(g (x - p)^2 + d)^n - c, which falls to its least at x = p; d < 0: it has no value there."""

    def __init__(self, source, sign):
        pick = lambda least, most: f"{source.uniform(least, most):.3f}"  # noqa: E731
        g, self.speed, place, level = pick(0.5, 4), pick(0.5, 2), pick(0.5, 3), pick(0.05, 0.5)
        depth = f"{source.uniform(1, 9):.2f}e-{source.randrange(3, 15)}"
        power, inverse = source.choice((("sqrt({})", 2), ("({})^1.5", mpf(2) / 3), ("({})^0.25", 4)))
        square = f"{g}*(x - {place})^2 {'+' if sign > 0 else '-'} {depth}"
        self.text = f"{power.format(square)} - {level}"
        away = sqrt((mpf(level) ** inverse - sign * mpf(depth)) / mpf(g))
        v = mpf(self.speed)
        self.times = [(mpf(place) - away) / v, (mpf(place) + away) / v]
        self.bottom = mpf(place) / v
        self.lost = self.bottom - sqrt(mpf(depth) / mpf(g)) / v  # where it has no value from, with d < 0
        self.end = float(self.times[1] + mpf("0.05"))

    def request(self, **members):
        scene = lagrangian("free", "", f"x - 0 {self.speed}", "x_dot^2/2", **members)
        del scene["parameters"]
        return {"system": scene, "t_end": self.end, "samples": 2}


class BranchPoints(Service):
    def cases(self, sign, seed):
        source = random.Random(seed)
        cases = [Case(source, sign) for _ in range(40)]
        return [case for case in cases if case.times[0] > 0.01]

    def assert_near(self, found, known):
        self.assertIsNotNone(found["error"])
        self.assertLessEqual(abs(mpf(found["t"]) - known), found["error"])

    def test_both_crossings_are_found_beside_a_branch_point_and_a_gap(self):
        for sign, seed in ((1, 1), (-1, 2)):
            for case in self.cases(sign, seed):
                request = case.request(events=[{"name": "e", "expression": case.text}])
                answer = self.ask("simulate", {**request, "events": ["e"]})
                with self.subTest(case.text):
                    self.assertEqual(len(answer["events"]), 2)
                    for found, known in zip(answer["events"], case.times):
                        self.assert_near(found, known)

    def test_a_wall_that_rises_behind_a_gap_turns_the_motion_back(self):
        for sign, seed in ((1, 3), (-1, 4)):
            for case in self.cases(sign, seed):
                request = case.request(events=[{"name": "e", "expression": case.text, "direction": "rising"}],
                                       impacts=[{"event": "e", "restitution": 1}])
                t_end = float(case.times[1] + mpf("0.001"))
                answer = self.ask("simulate", {**request, "t_end": t_end, "events": ["e"]})
                with self.subTest(case.text):
                    self.assertLess(answer["trajectory"]["x_dot"][-1], 0)
                    self.assert_near(answer["events"][0], case.times[1])

    def test_no_motion_passes_where_forces_or_conditions_have_no_value(self):
        for case in self.cases(-1, 5):
            held = case.request(valid_while=[{"name": "held", "expression": f"2 + {case.text}", "reason": "touch",
                                              "message": "It has come too near."}])
            pushed = case.request(forces=[{"name": "f", "value": f"1e-9*sign(2 + {case.text})", "along": "x"}])
            with self.subTest(case.text):
                stop = self.ask("simulate", held)["stop"]
                self.assertEqual(stop["reason"], "touch")
                self.assert_near(stop, case.lost)
                problem = self.refused("simulate", pushed)
                self.assertEqual(problem["reason"], "nonfinite")
                self.assertLess(problem["t_reached"], case.bottom)

    def test_a_function_that_has_values_again_has_crossed_nothing_there(self):
        """The velocity of an oscillator, times a root that is 0 where it begins to have values."""
        for start, rate, square, level, place, side, power, end in (
            ("0.455", "2.88", "7.78", "0.075", "0.0254", 1, "sqrt({})", 2.11189724955),
            ("-0.0955", "1.69", "5.16", "-0.16", "0.469", -1, "({})^0.4", 6.6739130286),
            ("0.3", "1.2", "4", "0.2", "0.1", 1, "({})^1.5", 9.0),
        ):
            x, v, w = mpf(start), mpf(rate), sqrt(mpf(square))
            phase, most = atan2(x * w, v), sqrt(v**2 + (x * w) ** 2)
            turns = acos(mpf(level) / most)
            times = [(sign * turns - phase + 2 * pi * k) / w for sign in (1, -1) for k in range(9)]
            inside = lambda t: side * (x * cos(w * t) + v / w * sin(w * t) - mpf(place)) > 0  # noqa: E731, B023
            known = sorted(t for t in times if 0 < t < end and inside(t))
            root = power.format(f"x - {place}" if side > 0 else f"{place} - x")
            scene = lagrangian("oscillator", "", f"x - {start} {rate}", f"x_dot^2/2 - {square}*x^2/2",
                               events=[{"name": "e", "expression": f"(x_dot - ({level}))*{root}"}])
            del scene["parameters"]
            with self.subTest(root):
                answer = self.ask("simulate", {"system": scene, "t_end": end, "samples": 2, "events": ["e"]})
                self.assertEqual(len(answer["events"]), len(known))
                for found, t in zip(answer["events"], known):
                    self.assert_near(found, t)


if __name__ == "__main__":
    unittest.main()
