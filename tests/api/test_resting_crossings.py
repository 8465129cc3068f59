"""Curves of equilibria that leave a position of rest where all critical points were not found: det K there tells."""

import pathlib
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402


def scene(lagrangian, coordinates, **parameters):
    return {"name": "scene", "units": "none", "lagrangian": lagrangian, "coordinates": coordinates,
            "parameters": [{"name": name, "default": value} for name, value in parameters.items()]}


ANGLES = [{"name": "a", "unit": "rad"}, {"name": "b", "unit": "rad"}]
# Two equal pendulums, one below the other, in a plane that turns with W.
TURNED = scene("a_dot^2 + b_dot^2/2 + a_dot*b_dot*cos(a - b) + g*(2*cos(a) + cos(b))"
               " + W^2/2*(sin(a)^2 + (sin(a) + sin(b))^2)", ANGLES, g=1, W=1)
# Three links between pins, springs at their joints, pushed by F.
STRUT = scene("(a_dot^2 + b_dot^2)/2 - c/2*((b - a)^2 + (asin(sin(a) + sin(b)) + b)^2)"
              " - F*l*(cos(a) + cos(b) + sqrt(1 - (sin(a) + sin(b))^2))",
              [angle | {"domain": "> -0.5, < 0.5"} for angle in ANGLES], l=0.5, c=2, F=1)
PLANE = [{"name": "x"}, {"name": "y"}]


class RestingCrossings(Service):
    def critical(self, system, parameter, start, end):
        found = self.ask("bifurcations", {"system": system, "parameter": parameter, "from": start, "to": end})
        return found, [c for c in found["critical"] if c["kind"] == "pitchfork"]

    def assert_pitchforks(self, system, parameter, span, expected):
        """(formula, value) in ascending order; each within its error."""
        _, pitchforks = self.critical(system, parameter, *span)
        self.assertEqual([c.get("exact", {}).get("text") for c in pitchforks], [text for text, _ in expected])
        for c, (_, true) in zip(pitchforks, expected):
            self.assertLessEqual(abs(c["value"] - true), c["error"])
            self.assertNotIn("reason", c)
        return pitchforks

    def test_a_turned_double_pendulum_leaves_its_positions_at_four_speeds(self):
        root = mpmath.sqrt(2)
        pitchforks = self.assert_pitchforks(TURNED, "W", (0.2, 3), [
            ("sqrt((2 - sqrt(2))*g)", mpmath.sqrt(2 - root)), ("sqrt(sqrt(2)*g)", mpmath.sqrt(root)),
            ("sqrt(sqrt(2)*g)", mpmath.sqrt(root)), ("sqrt((2 + sqrt(2))*g)", mpmath.sqrt(2 + root))])
        places = [(round(c["state"]["a"], 12), round(c["state"]["b"], 12)) for c in pitchforks]
        pi = round(float(mpmath.pi), 12)
        self.assertEqual(places, [(0, 0), (0, pi), (pi, 0), (0, 0)])

    def test_a_strut_of_three_links_has_two_loads(self):
        self.assert_pitchforks(STRUT, "F", (0.5, 20), [("c/l", 4), ("3*c/l", 12)])

    def test_a_second_pair_that_leaves_an_unstable_position_is_seen(self):
        wells = scene("(x_dot^2 + y_dot^2)/2 + (x^2 + y^2)/2 - (x^4 + 2*y^4)/4 - k*(x - y)^2/2", PLANE, k=1)
        self.assert_pitchforks(wells, "k", (0.4, 0.7), [("1/2", 0.5)])

    def test_one_at_a_place_that_moves_is_seen_by_the_change_of_stability(self):
        wells = scene("(x_dot^2 + y_dot^2)/2 + (x^2 + y^2)/2 - (x^4 + y^4)/4 - k*(x - y)^2/2", PLANE, k=1)
        found = self.ask("bifurcations", {"system": wells, "parameter": "k", "from": 0.2, "to": 0.4})
        self.assertFalse(found["complete"])
        self.assertLessEqual(min(abs(c["value"] - mpmath.mpf(1)/3) - c["error"] for c in found["critical"]), 0)

    def test_a_pitchfork_may_follow_from_what_drives_nothing(self):
        # y = 0 near the place for y (1 + 2 x) = 0, and k x = x^3 there.
        for coupling in ("x*y^2", "x*y^3"):
            system = scene(f"(x_dot^2 + y_dot^2)/2 + (k - 1)*x^2/2 - x^4/4 - y^2/2 - {coupling}", PLANE, k=0.5)
            _, pitchforks = self.critical(system, "k", 0.9, 1.1)
            self.assertEqual([c["value"] for c in pitchforks], [1], coupling)

    def test_without_a_symmetry_the_crossing_is_transcritical(self):
        # k x - x^2 = 0 where y is 0.
        system = scene("(x_dot^2 + y_dot^2)/2 + k*x^2/2 - x^3/3 - y^2/2 - x^2*y^3*cos(x - y)", PLANE, k=0.5)
        found, _ = self.critical(system, "k", -1, 1.5)
        here = [c["kind"] for c in found["critical"] if abs(c["value"]) < 1e-9 and abs(c["state"]["x"]) < 1e-9]
        self.assertEqual(here, ["transcritical"])


if __name__ == "__main__":
    unittest.main()
