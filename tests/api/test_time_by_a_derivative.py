"""Why the energy changes, or does not, where the time is in the Lagrangian by the total derivative of a function."""

import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

BARE = ("x_dot^2/2 - x^2/2 + sin(t)", "x_dot^2/2 - x^2/2 + x + t*x_dot", "x_dot^2/2 - x^2/2 + cos(t)*x*x_dot - sin(t)*x^2/2",
        "x_dot^2/2 - x^2/2 + atan(x) + t*x_dot/(1 + x^2)")
MOVED = ("x_dot^2/2 - x^2/2 + x*sin(t)", "exp(t)*(x_dot^2 - x^2)/2", "x_dot^2/2 - x^2/2 + t*x")


def scene(lagrangian):
    return {"name": "s", "units": "none", "coordinates": [{"name": "x", "initial": "1"}], "lagrangian": lagrangian}


class TimeByADerivative(Service):
    def why(self, asked):
        return self.ask("equations", {"system": asked})["reasons"]["energy_not_conserved"]

    def test_nothing_does_work_by_a_total_derivative(self):
        for lagrangian in BARE:
            self.assertIn("The time is in it by a total derivative only", self.why(scene(lagrangian)), lagrangian)

    def test_what_moves_the_system_does(self):
        for lagrangian in MOVED:
            self.assertIn("contains the time explicitly", self.why(scene(lagrangian)), lagrangian)

    def test_of_a_potential_that_only_rises(self):
        asked = {"name": "s", "units": "none", "coordinates": [{"name": "x", "initial": "1"}],
                 "bodies": [{"kind": "particle", "mass": "1", "position": ["x", "0"]}], "potential": "x^2/2 + sin(t)"}
        self.assertIn("T + V contains the time, but no equation of motion does", self.why(asked))


if __name__ == "__main__":
    unittest.main()
