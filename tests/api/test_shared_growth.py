"""Lagrangians of damped motions, exp(b t) L: the time that all their equations share is not in what they say."""

import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402


def scene(lagrangian, coordinates="x", **parameters):
    return {"name": "scene", "units": "none", "lagrangian": lagrangian,
            "coordinates": [{"name": name, "initial": 1} for name in coordinates],
            "parameters": [{"name": name, "default": value} for name, value in parameters.items()]}


DAMPED = scene("exp(b*t)*(x_dot^2/2 - k*x^2/2)", b=0.3, k=2)


class SharedGrowth(Service):
    def test_it_is_a_damped_oscillation(self):
        mode, = self.ask("modes", {"system": DAMPED})["modes"]
        self.assertEqual((mode["kind"], mode["rate"]), ("decay", 0.15))
        self.assertEqual((mode["exact"]["text"], mode["exact"]["rate"]["text"]), ("k - 1/4*b^2", "1/2*b"))

    def test_no_potential_says_that_what_is_driven_is_stable(self):
        for b, stability in ((0.3, "stable"), (-0.3, "unstable")):
            found = self.ask("equilibria", {"system": DAMPED, "parameters": {"b": b}})
            self.assertEqual([e["stability"] for e in found["equilibria"]], [stability])

    def test_each_coordinate_may_have_its_own(self):
        apart = scene("exp(b*t)*(x_dot^2/2 - k*x^2/2) + exp(c*t)*(y_dot^2/2 - k*y^2)", "xy", b=0.3, c=0.5, k=2)
        modes = self.ask("modes", {"system": apart})["modes"]
        self.assertEqual([mode["exact"]["rate"]["text"] for mode in modes], ["1/2*b", "1/2*c"])

    def test_what_no_force_holds_drifts(self):
        free = scene("exp(b*t)*(x_dot^2/2 + y_dot^2/2 - x^2)", "xy", b=0.3)
        modes = self.ask("modes", {"system": free})["modes"]
        self.assertEqual([mode["kind"] for mode in modes], ["rigid", "decay", "decay"])
        self.assertEqual([mode["exact"]["text"] for mode in modes[1:]], ["b", "2 - 1/4*b^2"])

    def test_one_coordinate_is_not_called_several(self):
        drag = {"forces": [{"value": "-b*x_dot", "along": "x"}]}
        for system in (scene("exp(b*t)*(x_dot^2/2 - x^4/4)", b=0.3), scene("x_dot^2/2 - x^4/4", b=0.3) | drag):
            rest, = self.ask("equilibria", {"system": system})["equilibria"]
            self.assertEqual(rest["stability"], "neutral")
            self.assertIn("not looked at where a force depends on the velocity", rest["nonlinear"])

    def test_what_turns_with_the_time_is_refused_for_what_it_is(self):
        mathieu = scene("x_dot^2/2 - (a + b*cos(t))*x^2/2", a=1, b=0.2)
        for system in ("kapitza_pendulum", mathieu, scene("t^2*(x_dot^2 - x^2)"), scene("exp(t)*x_dot^2 - x^2")):
            problem = self.refused("modes", {"system": system})
            self.assertIn("is answered only where it does not", str(problem))
            self.assertNotIn("nothing stays at rest", str(problem))


if __name__ == "__main__":
    unittest.main()
