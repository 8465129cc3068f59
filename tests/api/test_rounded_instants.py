"""Instants of events, impacts and kinks whose functions are small differences of large numbers: what those are rounded by
all computations have in common. The truths are polynomials of the time and an oscillation."""

import pathlib
import random
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, strict_json  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mpmath.mp.dps = 40
mpf = mpmath.mpf
GOALS = [{}, {"accuracy": "accurate"}, {"method": "taylor", "rtol": 1e-7}, {"method": "erk", "rtol": 1e-9}]
LARGE = ["1e5", "1e6", "3e6", "1e7", "2e7", "4.85e5"]


def square(u, large, level):
    """u^2 - level, rounded as large^2 is."""
    return f"(({u}) + {large})^2 - {large}^2 - 2*{large}*({u}) - {level}"


class RoundedInstants(Service):
    def motion(self, scene, initial, **more):
        request = {"system": scene, "initial": initial, "t_end": 1, "samples": 2, **more}
        return strict_json(self.post("simulate", request).data)

    def judge(self, value, error, truth, where):
        if error is not None:
            self.assertLessEqual(abs(mpf(value) - truth), mpf(error), where)

    def rows(self, answer, truth):
        """truth(t) = (q, q') in the order of the columns. Returns whether an error is stated."""
        columns = answer["trajectory"]
        names = [name for name in columns if name != "t"]
        for i, t in enumerate(columns["t"]):
            for name, true in zip(names, truth(mpf(t))):
                self.judge(columns[name][i], answer["accuracy"]["max_abs_error"][name], true, (answer["request"], name, t))
        return None not in answer["accuracy"]["max_abs_error"].values()

    def test_an_event_is_as_uncertain_as_its_function_is_rounded(self):
        oscillation = lagrangian("oscillation", "", "x - 1 0", "x_dot^2/2 - x^2/2")
        told = 0
        for large in LARGE:
            for u, true in (("x", mpmath.acos(mpf("0.8"))), ("x_dot", mpmath.asin(mpf("0.8")))):
                for goal in GOALS:
                    answer = self.motion(oscillation, {"x": 1, "x_dot": 0}, events=[square(u, large, "0.64") + "=0"], **goal)
                    for event in answer["events"]:
                        told += event["error"] is not None
                        self.judge(event["t"], event["error"], true, (u, large, goal, event))
        self.assertGreater(told, 24)

    def test_an_event_that_is_all_rounding_is_told_to_be(self):
        oscillation = lagrangian("oscillation", "", "x - 1 0", "x_dot^2/2 - x^2/2")
        for large, is_told in (("1e4", False), ("4.56e9", True), ("2.07e8", True)):
            for goal in [*GOALS, {"max_error": 1e-13}, {"method": "gauss", "h": 0.01}]:
                answer = self.motion(oscillation, {"x": 1, "x_dot": 0}, events=[square("x", large, "0.25") + "=0"], **goal)
                self.assertIs("rounded by as much as it changes" in answer["accuracy"].get("reason", ""), is_told, (large, goal))
        answer = self.motion(oscillation, {"x": 0.3, "x_dot": 0}, t_end=2*3.141592653589793, events=["x=0.3"])
        self.assertNotIn("rounded by", answer["accuracy"].get("reason", ""))

    def test_a_bounce_is_as_uncertain_as_its_distance_is_rounded(self):
        """At y = 1/4 from y = 1 - t; then y = t - 1/2."""
        told = 0
        for distance in [square("y", large, "0.0625") for large in LARGE] + ["exp(1e-9*y) - exp(2.5e-10)", "(1e9 + y) - 1000000000.25"]:
            ball = lagrangian("ball", "", "y - 1 -1", "y_dot^2/2", impacts=[{"event": "hit", "restitution": 1}],
                              events=[{"name": "hit", "expression": distance, "direction": "falling"}])
            for goal in GOALS:
                answer = self.motion(ball, {"y": 1, "y_dot": -1}, **goal)
                self.assertEqual(answer["status"], "complete")
                told += self.rows(answer, lambda t: (1 - t, -1) if t < mpf("0.75") else (t - mpf("0.5"), 1))
        self.assertGreater(told, 16)

    def test_a_kink_is_passed_where_its_argument_vanishes_and_not_where_it_is_rounded_to_zero(self):
        """x'' = 1 up to x = 1/2, then -1."""
        passed = mpmath.sqrt(2) - 1
        told = 0

        def truth(t):
            if t < passed:
                return t + t*t/2, 1 + t
            s = t - passed
            return mpf("0.5") + mpmath.sqrt(2)*s - s*s/2, mpmath.sqrt(2) - s

        for large in LARGE:
            kinked = lagrangian("kinked", "", "x - 0 1", "x_dot^2/2",
                                forces=[{"name": "f", "value": f"-sign({square('x', large, '0.25')})", "along": "x"}])
            for goal in GOALS:
                for times in ([1], [0.39, 0.4, 0.41, 0.412, 0.414, 0.4143, 0.415, 0.416, 0.42, 0.43, 0.44]):
                    answer = strict_json(self.post("simulate", {"system": kinked, "initial": {"x": 0, "x_dot": 1}, "times": times, **goal}).data)
                    if "trajectory" in answer:  # else which way it goes on could not be told
                        told += self.rows(answer, truth)
        self.assertGreater(told, 24)

    def test_after_a_rounded_kink_the_motion_is_as_good_as_any(self):
        kinked = lagrangian("kinked", "", "x - 0 1", "x_dot^2/2",
                            forces=[{"name": "f", "value": f"-sign({square('x', '1e7', '0.25')}) - x_dot", "along": "x"}])
        plain = lagrangian("kinked", "", "x - 0 1", "x_dot^2/2", forces=[{"name": "f", "value": "-sign(x - 0.5) - x_dot", "along": "x"}])
        rounded, exact = (self.motion(scene, {"x": 0, "x_dot": 1}, max_error=1e-12)["trajectory"] for scene in (kinked, plain))
        for name in ("x", "x_dot"):
            self.assertLess(abs(rounded[name][-1] - exact[name][-1]), 1e-11)

    def test_a_kink_at_a_multiple_root_is_passed_within_what_rounding_leaves_open(self):
        source, close = random.Random(7), 0
        for _ in range(60):
            m, start, speed, fall = (source.choice((3, 5)), *(f"{source.uniform(0.3, 2):.3f}" for _ in range(3)))
            place, force, end = f"{source.uniform(0.05, 1.5):.4f}", f"{source.uniform(0.1, 0.5):.2f}", mpf(start) / mpf(speed) + mpf(fall)
            c = mpf(start) - mpf(place)  # passed at a time that is the quotient of two decimals
            power = " + ".join(f"({mpmath.nstr(mpmath.binomial(m, k) * (-c) ** (m - k), 30)})*x^{k}" for k in range(m + 1))
            scene = lagrangian("passing", "", f"x - {start} -{speed}", "x_dot^2/2",
                               forces=[{"name": "f", "value": f"-{force}*(1 - sign({power}))", "along": "x"}])
            later = mpf(float(end)) - mpf(place) / mpf(speed)
            truth = (mpf(start) - mpf(speed) * mpf(float(end)) - mpf(force) * later**2, -mpf(speed) - 2 * mpf(force) * later)
            answer = self.motion(scene, {}, t_end=float(end))
            for name, true in zip(("x", "x_dot"), truth):
                error = answer["accuracy"]["max_abs_error"][name]
                self.judge(answer["trajectory"][name][-1], error, true, (power, start, speed))
                close += error < 0.1
        self.assertGreater(close, 90)

    def test_an_argument_that_vanishes_altogether_has_no_instant(self):
        """abs(abs(x + 1) - x - 1) is 0 on one side, and -2 (x + 1) on the other."""
        for text, same in (("abs(abs(x + 1) - x - 1)", "abs(x + 1) - x - 1"), ("abs(x + 1 - abs(x + 1))", "abs(x + 1) - x - 1")):
            scenes = [lagrangian("s", "", "x - 1.5 0", "x_dot^2/2", forces=[{"name": "f", "value": f"-x + 3*({t})", "along": "x"}])
                      for t in (text, same)]
            for goal in GOALS:
                one, other = (strict_json(self.post("simulate", {"system": scene, "t_end": 9, "samples": 7, **goal}).data) for scene in scenes)
                for name, error in one["accuracy"]["max_abs_error"].items():
                    self.assertLess(error, 1e-4, (text, goal))
                    for a, b in zip(one["trajectory"][name], other["trajectory"][name]):
                        self.assertLessEqual(abs(a - b), error + other["accuracy"]["max_abs_error"][name], (text, goal))


if __name__ == "__main__":
    unittest.main()
