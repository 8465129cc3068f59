"""Curves of equilibria that move with the parameter and cross: found and named as those that stay in their places."""

import math
import pathlib
import random
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402


def scene(force, unit=None):
    return {"name": "oblique", "units": "none", "parameters": [{"name": "r", "default": 1}],
            "coordinates": [{"name": "x", "initial": "0.1", **({"unit": unit} if unit else {})}],
            "lagrangian": "x_dot^2/2", "forces": [{"name": "f", "along": "x", "value": force}]}


class ObliqueCrossings(Service):
    def assert_found(self, force, start, end, expected, unit=None):
        """expected: (value, x, kind), ascending."""
        system = scene(force, unit)
        found = self.ask("bifurcations", {"system": system, "parameter": "r", "from": start, "to": end})
        self.assertTrue(found["complete"], (force, found.get("reason")))
        self.assertEqual([one["kind"] for one in found["critical"]], [kind for _, _, kind in expected], force)
        for one, (value, x, _) in zip(found["critical"], expected):
            self.assertLessEqual(abs(one["value"] - value), one["error"] + 4e-16 * abs(value), force)
            self.assertLess(one["error"], 1e-12, force)
            self.assertLessEqual(abs(one["state"]["x"] - x), one["state_error"]["x"] + 1e-15 * (1 + abs(x)), force)
        return found

    def test_two_lines(self):
        found = self.assert_found("-(x - 1 - r)*(x + 1 - 2*r)", -1, 4, [(2, 3, "transcritical")])
        self.assertEqual(len(found["branches"]), 2)
        for branch in found["branches"]:
            self.assertEqual(set(branch["stability"]), {"stable", "neutral", "unstable"} & set(branch["stability"]))
            slope = round((branch["x"][-1] - branch["x"][0]) / (branch["r"][-1] - branch["r"][0]))
            for r, x in zip(branch["r"], branch["x"]):
                self.assertAlmostEqual(x, 1 + r if slope == 1 else 2 * r - 1, 9)

    def test_several_lines_of_decimals(self):
        chance = random.Random(1)
        for count in (2, 3, 4) * 3:
            lines = [(round(chance.uniform(-2, 2), 2), round(chance.uniform(-1.5, 1.5), 2)) for _ in range(count)]
            crossings = [((c - a) / (b - d), a + b * (c - a) / (b - d), "transcritical")
                         for k, (a, b) in enumerate(lines) for c, d in lines[:k] if b != d]
            force = "*".join(f"(x - ({a}) - ({b})*r)" for a, b in lines)
            self.assert_found(f"-{force}", -3.21, 3.17, sorted(c for c in crossings if -3.21 < c[0] < 3.17))

    def test_a_line_and_a_parabola(self):
        """x = r/2 meets x^2 = r + 1 at r = 2 +- 2 sqrt 2."""
        ends = [(2 + sign * 2 * math.sqrt(2), 1 + sign * math.sqrt(2), "transcritical") for sign in (-1, 1)]
        self.assert_found("-(x - r/2)*(x^2 - r - 1)", -3, 6, [(-1, 0, "saddle_node"), *ends])

    def test_two_curves_over_the_coordinate(self):
        """r = x^2 and r = x/2 + 1/5."""
        meet = [(x * x, x, "transcritical") for x in (0.25 - math.sqrt(0.2625), 0.25 + math.sqrt(0.2625))]
        self.assert_found("(r - x^2)*(r - x/2 - 1/5)", -1, 3, [(0, 0, "saddle_node"), *meet])

    def test_a_pitchfork_on_a_curve_that_moves(self):
        self.assert_found("-(x - 0.3 - 0.7*r)*((x - 0.3 - 0.7*r)^2 - 1.3*(r - 0.4))", -1, 2, [(0.4, 0.58, "pitchfork")])

    def test_a_pitchfork_on_an_angle_that_moves(self):
        expected = [(-0.6, 0.2 - 0.3 + math.pi, "pitchfork"), (1.4, 0.2 + 0.7, "pitchfork")]
        self.assert_found("-sin(x - 0.2 - 0.5*r)*(cos(x - 0.2 - 0.5*r) - (r - 0.4))", -2, 3, expected, "rad")

    def test_one_that_has_gone_round_more_than_once(self):
        """The same of its potential; the curve is at 9.51 for r = -4.225, a turn and more on."""
        expected = [(-4.225, 0.88 + 1.3 * 4.225 + math.pi - 4 * math.pi, "pitchfork"),
                    (2.025, 0.88 - 1.3 * 2.025, "pitchfork")]
        self.assert_found("(8*r/25 + 44/125)*sin(13*r/10 + x - 22/25) - sin(13*r/5 + 2*x - 44/25)/2", -5.52, 3.12,
                          expected, "rad")

    def test_a_pitchfork_that_is_hardly_unsymmetric(self):
        """u (u^4 + e u^3 - b u^2 - r), b = 0.718: numbers of very different sizes are in what folds."""
        aside = math.sqrt(0.359)
        self.assert_found("-u*(u^4 + u^3/1e15 - 0.718*u^2 - r)".replace("u", "(x - 0.6615)"), -0.322, 0.644,
                          [(-0.359 ** 2, 0.6615 - aside, "saddle_node"), (-0.359 ** 2, 0.6615 + aside, "saddle_node"),
                           (0, 0.6615, "pitchfork")])

    def test_a_pitchfork_that_is_not_symmetric(self):
        """The fold of r = x^2 + x^3/5 at x = 0 lies on x = 0, that at x = -10/3 does not."""
        self.assert_found("-x*(x^2 + x^3/5 - r)", -1, 5,
                          [(0, 0, "pitchfork"), (100 / 27, -10 / 3, "saddle_node")])

    def test_a_term_that_matters_far_out_alone(self):
        """The middle of the roots of e x^3 + x^2 + x - r is at -1/(3 e): no place to count from."""
        for e in (1e-6, 1e-9):
            x = -1 / (1 + math.sqrt(1 - 3 * e))
            self.assert_found(f"-({e}*x^3 + x^2 + x - r)", -1, 1, [(e * x ** 3 + x * x + x, x, "saddle_node")])

    def test_a_shifted_and_scaled_one(self):
        """u^5 - b u^3 - r u, u = 40 (x + 1.8), b = 2.91: a pitchfork and two folds at r = -b^2/4."""
        u, b = "(40*(x + 1.8))", 2.91
        aside = math.sqrt(b / 2) / 40
        self.assert_found(f"-({u}^5 - {b}*{u}^3 - r*{u})", -3.43, 1.51,
                          [(-b * b / 4, -1.8 - aside, "saddle_node"), (-b * b / 4, -1.8 + aside, "saddle_node"),
                           (0, -1.8, "pitchfork")])

    def test_a_spring_without_stiffness_on_a_support_that_moves(self):
        self.assert_found("-(x - r)^3", -2, 2, [])
        self.assert_found("-sin(x - r)^3", -1, 1, [], "rad")

    def test_a_curve_goes_to_infinity_and_another_comes_from_there(self):
        """x = c/r beside x^2 = r, beside x = r, and alone: no branch goes over from one of its arms to the other."""
        crossing = 0.3 ** (2 / 3)
        for force, expected in (("-(r*x - 0.3)*(x^2 - r)", [(0, 0, "saddle_node"), (crossing, crossing ** 0.5, "transcritical")]),
                                ("-(r*x - 1)*(x - r)", [(-1, -1, "transcritical"), (1, 1, "transcritical")]),
                                ("-(r*x - 1)", [])):
            found = self.assert_found(force, -2.03, 2.11, expected)
            self.assertIn("infinity", found["reason"])
            for branch in found["branches"]:
                far = [x for x in branch["x"] if abs(x) > 3]
                self.assertEqual(len({x > 0 for x in far}), 1 if far else 0, force)
                self.assertFalse(far and min(branch["r"]) < 0 < max(branch["r"]), force)

    def test_what_rounding_does_not_tell_apart_is_said(self):
        system = scene("-(x - r)*(x - (1 + 1e-6)*r - 0.4e-6)")
        found = self.ask("bifurcations", {"system": system, "parameter": "r", "from": -3.21, "to": 3.17})
        self.assertEqual([(one["kind"], round(one["value"], 6)) for one in found["critical"]], [("transcritical", -0.4)])
        if len(found["branches"]) != 2:
            self.assertFalse(found["complete"])
            self.assertIn("begins or ends", found["reason"])


if __name__ == "__main__":
    unittest.main()
