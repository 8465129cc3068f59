"""Curves of equilibria that pass near each other and do not meet: each goes on as itself, and the reason says what is."""

import math
import pathlib
import random
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402


def scene(potential, unit=None, more=()):
    coordinates = [{"name": "x", "initial": "0.1", **({"unit": unit} if unit else {})}, *more]
    kinetic = "(x_dot^2 + y_dot^2)/2" if more else "x_dot^2/2"
    return {"name": "near", "units": "none", "parameters": [{"name": "r", "default": 1}], "coordinates": coordinates,
            "lagrangian": f"{kinetic} - ({potential})"}


def cubic_roots(r, h):
    """Of z^3 - r z - h, ascending, by bisection between the extrema."""
    far = 2 * (abs(r) ** 0.5 + abs(h) ** (1 / 3) + 1)
    turn = math.sqrt(r / 3) if r > 0 else 0
    marks = [-far, -turn, turn, far] if r > 0 else [-far, far]
    roots = []
    for low, high in zip(marks, marks[1:]):
        f = [z ** 3 - r * z - h for z in (low, high)]
        if f[0] * f[1] > 0:
            continue
        for _ in range(200):
            middle = (low + high) / 2
            if (middle ** 3 - r * middle - h) * f[0] > 0:
                low = middle
            else:
                high = middle
        roots.append((low + high) / 2)
    return roots


class CurvesNearEachOther(Service):
    def found(self, system, start, end):
        return self.ask("bifurcations", {"system": system, "parameter": "r", "from": start, "to": end})

    def assert_two_curves(self, found):
        """Nothing meets, nothing changes its stability."""
        self.assertTrue(found["complete"])
        self.assertEqual(found["critical"], [])
        self.assertEqual(found["reason"], "No equilibrium appears, vanishes or meets another in this range.")
        self.assertEqual(sorted(tuple(set(b["stability"])) for b in found["branches"]), [("stable",), ("unstable",)])

    def test_an_imperfect_transcritical(self):
        for e in ("1e-2", "1e-3", "1e-6", "1e-9", "1e-12"):
            found = self.found(scene(f"-r*x^2/2 + x^3/3 - {e}*x"), -3, 3)
            self.assert_two_curves(found)
            for branch in found["branches"]:
                sign = 1 if branch["stability"][0] == "stable" else -1
                for r, x in zip(branch["r"], branch["x"]):
                    self.assertGreater(sign * x, 0)
                    far = (abs(r) + math.sqrt(r * r + 4 * float(e))) / 2
                    self.assertAlmostEqual(abs(x), far if sign * r > 0 else float(e) / far, 12)

    def test_one_that_is_shifted_and_scaled(self):
        chance = random.Random(3)
        for _ in range(12):
            place, size, at = (round(chance.uniform(*span), 2) for span in ((-5, 5), (0.2, 20), (-0.9, 0.9)))
            z, e = f"((x - ({place}))/{size})", f"{10 ** chance.uniform(-9, -2):.3e}"
            self.assert_two_curves(self.found(scene(f"-(r - ({at}))*{z}^2/2 + {z}^3/3 - {e}*{z}"), -1.3, 1.7))

    def test_one_among_others_on_a_circle(self):
        """dV/du = (r - cos u) sin u - e cos u."""
        for e in ("1e-3", "1e-8"):
            found = self.found(scene(f"-r*cos(x) + cos(x)^2/2 - {e}*sin(x)", "rad"), -3, 3)
            self.assertTrue(found["complete"])
            self.assertEqual([one["kind"] for one in found["critical"]], ["saddle_node"] * 2)
            self.assertEqual(sorted(tuple(set(b["stability"]) - {"neutral"}) for b in found["branches"]),
                             [("stable",), ("stable",), ("unstable",), ("unstable",)])

    def test_a_curve_passes_where_the_circle_is_cut(self):
        """sin(u) = e, u the angle from 2*r: both go round, past 0 and half a turn."""
        for e in ("0", "0.3", "0.999"):
            self.assert_two_curves(self.found(scene(f"-cos(x - 2*r) - {e}*(x - 2*r)", "rad"), -3, 3.5))

    def test_an_imperfect_pitchfork(self):
        """The curve that has no end passes near the fold of the two others."""
        for h in (1e-2, -1e-4, 1e-6, -1e-9):
            found = self.found(scene(f"-r*x^2/2 + x^4/4 - ({h})*x"), -2, 2.5)
            self.assertTrue(found["complete"])
            fold, = found["critical"]
            self.assertEqual(fold["kind"], "saddle_node")
            self.assertLessEqual(abs(fold["value"] - 3 * (abs(h) / 2) ** (2 / 3)), 1e-15 + fold["error"])
            branches = found["branches"]
            self.assertEqual(sorted(tuple(set(b["stability"]) - {"neutral"}) for b in branches),
                             [("stable",), ("stable",), ("unstable",)])
            whole, = [b for b in branches if b["r"][0] == -2]
            self.assertEqual(whole["r"][-1], 2.5)
            for r, x in zip(whole["r"], whole["x"]):
                self.assertAlmostEqual(x, cubic_roots(r, h)[-1 if h > 0 else 0], 9)
            for branch in branches:
                if branch is not whole:
                    self.assertEqual(branch["r"][0], fold["value"])
                    self.assertEqual(branch["x"][0], fold["state"]["x"])

    def test_a_fold_far_from_zero_begins_both_its_curves(self):
        found = self.found(scene("(x - 4000)^3/3e6 - r*(x - 4000)"), -1, 2)
        self.assertEqual([(b["r"][0], b["x"][0]) for b in found["branches"]],
                         [(found["critical"][0]["value"], found["critical"][0]["state"]["x"])] * 2)

    def test_two_folds_at_one_value_that_rounding_parts(self):
        for b, place in (("1.55", "0"), ("1.17", "1.43")):
            found = self.found(scene(f"(x - {place})^6/6 - {b}*(x - {place})^4/4 - r*(x - {place})^2/2"), -15.3, 16.1)
            self.assertTrue(found["complete"])
            self.assertEqual([one["kind"] for one in found["critical"]], ["saddle_node", "saddle_node", "pitchfork"])
            whole, *others = sorted((min(b["r"]), max(b["r"])) for b in found["branches"])
            self.assertEqual(whole, (-15.3, 16.1))
            self.assertEqual(len(others), 4)
            for branch in found["branches"]:
                self.assertLess(max(abs(x - y) for x, y in zip(branch["x"], branch["x"][1:])), 1)

    def test_pitchforks_at_values_so_near_that_rounding_hides_what_is_stable_between(self):
        found = self.found(scene("-1e-9*cos(x + 2.18) - 0.893*cos(4*(x + 2.18)) - r*cos(2*(x + 2.18))", "rad"), -13, 12)
        self.assertTrue(found["complete"])
        values = {one["value"] for one in found["critical"]} | {-13, 12}
        self.assertEqual(len(found["critical"]), 4)
        for branch in found["branches"]:
            self.assertLessEqual({branch["r"][0], branch["r"][-1]}, values)

    def test_pitchforks_about_an_axis_that_is_turned_are_each_told_once(self):
        found = self.found(scene("-r*cos(2*(x - 0.44)) - 1.65*cos(4*(x - 0.44))", "rad"), -15.3, 16.1)
        self.assertTrue(found["complete"])
        self.assertEqual([(round(one["value"], 9), one["kind"]) for one in found["critical"]],
                         [(-6.6, "pitchfork")] * 2 + [(6.6, "pitchfork")] * 2)
        self.assertEqual(len(found["branches"]), 8)

    def test_of_two_coordinates_what_is_stable_goes_on_as_stable(self):
        found = self.found(scene("-r*x^2/2 + x^3/3 - 1e-4*x + (y - x/2)^2/2 + y^4/40", more=[{"name": "y"}]), -1, 1.3)
        self.assertNotIn("oscillations", found["reason"])
        near = [b for b in found["branches"] if b["r"][0] == -1 and b["r"][-1] == 1.3]
        self.assertTrue(near)
        for branch in near:
            self.assertEqual(len(set(branch["stability"]) - {"neutral"}), 1)


if __name__ == "__main__":
    unittest.main()
