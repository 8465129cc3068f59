"""Kinds of critical values of searches that are given up: a fold of one factor of the forces is a saddle-node only where
the other factors do not vanish. And forces that are more than the unknowns that they depend on."""

import math
import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402


def scene(parameters, names, lagrangian, forces=()):
    return {"name": "s", "units": "none", "parameters": [{"name": name, "default": value} for name, value in parameters],
            "coordinates": [{"name": name, "initial": "0.1"} for name in names], "lagrangian": lagrangian,
            "forces": [{"value": value, "along": along} for value, along in forces]}


# Kapitza's averaged pendulum, its angle a number on a line: V is even about each multiple of pi, dF/dv = 0 there.
KAPITZA = scene([("g", "9.81"), ("l", "1"), ("v", "6")], ["th"], "th_dot^2/2 + g/l*cos(th) - v^2*sin(th)^2/(4*l^2)")
PAIR = scene([("g", "9.81"), ("l", "1"), ("v", "6")], ["th", "b"],
             "(th_dot^2 + b_dot^2)/2 + g/l*cos(th) - v^2*sin(th)^2/(4*l^2) - b^2/2 - b^4")
FOLD = scene([("p", "1")], ["x"], "x_dot^2/2 - x^3/3 + p*x")
TOO_MANY = [scene([("p", "1")], ["x", "th"], "(x_dot^2 + th_dot^2)/2", [("p*sin(th)", "x"), ("p*cos(th)", "th")]),
            scene([("p", "1")], ["x", "y"], "(x_dot^2 + y_dot^2)/2", [("p", "x"), ("1", "y")])]


class KnownKinds(Service):
    def critical(self, asked, parameter, start, end):
        return self.ask("bifurcations", {"system": asked, "parameter": parameter, "from": start, "to": end})

    def test_a_pitchfork_on_a_line_is_no_saddle_node(self):
        for asked in (KAPITZA, PAIR):
            found = self.critical(asked, "v", 0.1, 10)["critical"]
            self.assertEqual([one["kind"] for one in found], ["pitchfork"])
            self.assertAlmostEqual(found[0]["value"], math.sqrt(2 * 9.81), 12)

    def test_a_fold_alone_is_a_saddle_node(self):
        found = self.critical(FOLD, "p", -1, 1)
        self.assertEqual([one["kind"] for one in found["critical"]], ["saddle_node"])

    def test_more_forces_than_unknowns(self):
        for asked in TOO_MANY:
            found = self.critical(asked, "p", 0.1, 3)
            self.assertEqual(found["critical"], [])
            self.assertIn("More forces have to vanish than there are coordinates", found["reason"])
        self.assertEqual(self.critical("quadrotor", "m", 0.2, 4)["critical"], [])

    def test_a_mirror_where_the_angle_is_no_zero(self):
        """A bead on a hoop that turns, its angle from the horizontal, from the vertical, and from another direction."""
        for sine, cosine, start in (("cos(a)", "-sin(a)", "-1.5"), ("sin(a)", "cos(a)", "0.1"), ("sin(a - c)", "cos(a - c)", "0.8"),
                                    ("sin(a + pi/3)", "cos(a + pi/3)", "2")):
            hoop = scene([("g", "9.81"), ("R", "1"), ("W", "2"), ("c", "0.7")], ["a"],
                         f"R^2*a_dot^2/2 + R^2*W^2*({sine})^2/2 + g*R*({cosine})")
            hoop["coordinates"][0] |= {"unit": "rad", "initial": start}
            found = self.ask("bifurcations", {"system": hoop, "parameter": "W", "from": 0.5, "to": 6})["critical"]
            self.assertEqual([one["kind"] for one in found], ["pitchfork"], sine)
            self.assertAlmostEqual(found[0]["value"], 9.81 ** 0.5, 12)


if __name__ == "__main__":
    unittest.main()
