"""Curves of equilibria that run into a place where the forces have no value: which values of the parameter those are is solved by hand, and the number of
equilibria on both sides of each, which `equilibria` proves, differs there or at a critical value only."""

import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

# V, parameters, start, the parameter and its range, where curves run into (p, x), critical values and kinds
INTO = [
    ("k*x^2/2 + B*log(d - x)", "m - 1; k - 10; B - 0.5; d - 1", 0.05, ("B", -1, 4), (0, 1), [(2.5, "saddle_node")]),
    ("k*x^2/2 - q/(d - x)", "m - 1; k - 10; q - 0.5; d - 1", 0.05, ("q", -1, 4), (0, 1), [(40/27, "saddle_node")]),
    ("J/(2*x^2) - k/x", "m - 1; J - 1; k - 2", 0.6, ("J", -1, 2), (0, 0), []),
    ("(x - c)^2/2 - 0.1*log(x)", "m - 1; c - 1", 0.6, ("c", -2, 2), None, []),
    ("k*(x - c)^2/2 + q*log(x + 3)", "m - 1; k - 1; c - 0.5; q - 0.2", 0.3, ("q", -1, 1), (0, -3), []),
    ("k*x^2/2 - p*log(1 - x^2)", "m - 1; p - 1; k - 0.6", 0.1, ("p", -1, 2), (0, 1), [(-0.3, "pitchfork")]),
]
H = "m*R^2*(x_dot^2 + W^2*sin(x)^2)/2 + m*g*R*cos(x)"
# L, parameters, start, the parameter, its range and the pitchfork at an end of it
AT_ENDS = [
    (H, "m - 1; R - 0.5; g - 2; W - 6", 0.8, ("W", 0, 2), 2),
    (H, "m - 1; R - 0.5; g - 2; W - 6", 0.8, ("W", 2, 9), 2),
    ("m*x_dot^2/2 - p*cos(x) + sin(x)^2 - 2*cos(x)", "m - 1; p - 0.5", 0.1, ("p", -4, -0.5), -4),
    ("m*x_dot^2/2 - p*x^2/2 - x^4/4", "m - 1; p - 0.5", 0.1, ("p", -1, 0), 0),
    ("m*x_dot^2/2 - p*x^2/2 - x^4/4", "m - 1; p - 0.5", 0.1, ("p", 0, 1), 0),
]


class CurvesIntoPoles(Service):
    def found(self, text, parameters, start, moving):
        name, lower, upper = moving
        return self.ask("bifurcations", {"system": lagrangian("curves", parameters, f"x - {start}", text), "parameter": name, "from": lower, "to": upper})

    def test_where_a_curve_runs_into_a_pole_is_told(self):
        for potential, parameters, start, moving, pole, critical in INTO:
            answer = self.found(f"m*x_dot^2/2 - ({potential})", parameters, start, moving)
            with self.subTest(potential):
                self.assertEqual([kind for _, kind in critical], [one["kind"] for one in answer["critical"]])
                for (value, _), one in zip(critical, answer["critical"]):
                    self.assertAlmostEqual(one["value"], value, 12)
                self.assertTrue(answer["complete"])
                told = f"At {moving[0]} = {pole[0]} and x = {pole[1]} the forces have no value" if pole else "the forces have no value"
                (self.assertIn if pole else self.assertNotIn)(told, answer.get("reason") or "")
                self.assertNotIn("oscillations", answer.get("reason") or "")
                for branch in answer["branches"] if pole else []:
                    sides = {x > pole[1] for p, x in zip(branch[moving[0]], branch["x"]) if x != pole[1]}
                    self.assertLessEqual(len(sides), 1, branch)

    def test_of_many_poles_the_nearest_are_told(self):
        answer = self.found("m*x_dot^2/2 + p*log(cos(x)) - k*x^2/2", "m - 1; p - 1; k - 0.3", 0.1, ("p", -1, 2))
        self.assertEqual(answer["reason"].count("the forces have no value, to within rounding"), 3)
        self.assertIn("more such places", answer["reason"])

    def test_infinity_is_no_end_where_the_scene_has_no_value(self):
        answer = self.found("m*x_dot^2/2 - a*log(x) + b*x", "m - 1; a - 1; b - 2", 0.3, ("b", -1, 3))
        self.assertEqual(answer["at_ends"], ["At b = 0 an equilibrium appears from or vanishes to x = infinity."])

    def test_a_pitchfork_at_an_end_of_the_range_is_one(self):
        for text, parameters, start, moving, value in AT_ENDS:
            answer = self.found(text, parameters, start, moving)
            with self.subTest(text, moving=moving):
                (one,) = [one for one in answer["critical"] if abs(one["value"] - value) < 1e-6]
                self.assertEqual(one["kind"], "pitchfork")
                self.assertLessEqual(abs(one["value"] - value), one["error"])


if __name__ == "__main__":
    unittest.main()
