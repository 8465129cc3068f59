"""Equilibria where a force has no value at a place, though its slope has one there: it may jump."""

import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

# Forces along x with c = 3 and d = 1, and the places at which they vanish beside 0.
QUOTIENTS = [
    ("c*x/(c*x + d*x) - x", [0.75]),
    ("c*x/(c*x + d*x) - x + 2", [2.75]),
    ("c*x/(c*x + d*x) + x", [-0.75]),
    ("x^2/(x^2 + c*x^2) - x", [0.25]),
    ("sin(x)^2/(sin(x)^2 + c*sin(x)^2) - x", [0.25]),
    ("x*abs(x)/(x^2 + c*x^2) - x", [-0.25, 0.25]),
    ("(d + c)*x/(abs(x) + abs(c*x)) - x", [-1, 1]),
]
# Potentials that are 2|x - place| but for how they are written.
KINKS = ["2*sqrt((x - 1)^2)", "sqrt(4*x^2 - 8*x + 4)", "sqrt((d + c)*(x - 1)^2)", "sqrt(c*(x - 1)^2 + d*(x - 1)^2)",
         "2*abs(abs(x - 1))", "sqrt(abs(2*x - 2)^2)", "abs(c*x - c) - (x - 1)*sign(c*x - c)"]


class QuotientsThatCancel(Service):
    def places(self, scene):
        answer = self.ask("equilibria", {"system": scene | {"name": "one", "units": "none", "coordinates": [{"name": "x", "initial": "0.3"}],
                                                            "parameters": [{"name": "c", "default": "3"}, {"name": "d", "default": "1"}]}})
        return answer, [(entry["state"]["x"], entry["error"]["x"], entry["stability"]) for entry in answer["equilibria"]]

    def test_no_place_is_lost_across_a_jump(self):
        for force, held in QUOTIENTS:
            answer, places = self.places({"lagrangian": "x_dot^2/2", "forces": [{"name": "f", "value": force, "along": "x"}]})
            self.assertEqual(len(places), len(held), force)
            for (x, error, _), value in zip(places, held):
                self.assertLessEqual(abs(x - value), error, force)
                self.assertLess(error, 1e-14, force)
            self.assertFalse(answer["complete"])
            self.assertIn("Near x = 0 is a singularity", answer["reason"])

    def test_a_kink_is_one_however_it_is_written(self):
        for kink in KINKS:
            answer, places = self.places({"lagrangian": f"x_dot^2/2 + {kink} - x^2/4"})
            self.assertTrue(answer["complete"], kink)
            for (x, error, stability), (value, kind) in zip(places, [(-4, "stable"), (1, "unstable"), (4, "stable")], strict=True):
                self.assertLessEqual(abs(x - value), error, kink)
                self.assertEqual(stability, kind, kink)

    def test_turning_points_lie_beyond_a_square_that_is_written_out(self):
        for square in ("x^2 - 2*x + 1", "(x - 1)^2", "4*x^2 - 8*x + 4 - 3*(x - 1)^2"):
            scene = {"name": "one", "units": "none", "coordinates": [{"name": "x", "initial": "2.42"}],
                     "lagrangian": f"x_dot^2/2 - (sqrt({square}) + x^2/2)"}
            answer = self.ask("turning_points", {"system": scene})
            self.assertEqual(answer["motion"], "libration")
            truth = 1 - (2*(2.42 - 1 + 2.42**2/2) - 1)**0.5  # of (1 - x) + x^2/2 = E
            self.assertLessEqual(abs(answer["x_min"] - truth), answer["error"]["x_min"] + 4e-16)

    def test_a_wire_with_a_corner_is_refused_however_it_is_written(self):
        for corner in ("abs(x - 0.3)", "sqrt((x - 0.3)^2)", "sqrt(x^2 - 0.6*x + 0.09)", "2*sqrt(0.25*(x - 0.3)^2)"):
            scene = {"name": "wire", "units": "none", "lagrangian": "x_dot^2/2 + y_dot^2/2 - 2*y",
                     "coordinates": [{"name": "x", "initial": "0.8", "initial_rate": "-1"}, {"name": "y", "initial": "0.5", "initial_rate": "-1"}],
                     "constraints": [{"name": "c", "expression": f"y - {corner}"}]}
            self.refused_at("simulate", {"system": scene, "t_end": 1}, "#/system/constraints/0/expression")


if __name__ == "__main__":
    unittest.main()
