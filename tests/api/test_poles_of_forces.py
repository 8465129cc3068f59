"""Values that are solved for, where forces divide by what may vanish: their numerators vanish at more places."""

import math
import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

# Forces along x, and the values of c that hold x = 1.5.
HELD = [
    ("sin(c)/c - 0.75", [1.2756981092811262, -1.2756981092811262]),
    ("sin(c - 2)/(c - 2) - 0.75", [0.7243018907188738, 3.2756981092811262]),
    ("(1 - cos(c))/c - 0.375", [0.790284139891112, 4.131049754090618]),
    ("(exp(c) - 1)/c - 1.5", [0.7626885608503389]),
    ("c/(c + c^2) - 0.75", [1/3]),
    ("c*(c - 3)/(c + c^2)", [3]),
    ("c*x/sqrt(c*x^2) - 1", [1]),
    ("c*x/sqrt(3*c*x^2) - 1", [3]),
    ("sqrt(c*x^2) - c", [2.25, 0]),
    ("sqrt(c + 2.5)*x", [-2.5]),
    ("(c - 2)*sqrt(c + 2.5)", [2, -2.5]),
    ("(c - 2)*(1 - c)^0.5", [1]),
    ("sqrt(c + 2.5) - 1e-9", [-2.5]),
    ("sqrt(c + 2.5) + 1e-19", []),
    ("sqrt(c + 1) + sqrt(2 - c) - 2", [-0.9142135623730951, 1.9142135623730951]),
    ("c*sqrt(c + 2) - 1", [0.6180339887498949]),
    ("sqrt(c - 1) + sqrt(1 - c)", [1]),
    ("sqrt(c - 1)*sqrt(1 - c)", [1]),
]


class PolesOfForces(Service):
    def solved(self, force):
        scene = {"name": "pushed", "units": "none", "parameters": [{"name": "c", "default": "1"}],
                 "coordinates": [{"name": "x", "initial": "0.3"}], "lagrangian": "x_dot^2/2",
                 "forces": [{"name": "f", "value": force, "along": "x"}]}
        return self.ask("equilibria", {"system": scene, "solve_for": "c", "at": {"x": 1.5}})

    def test_no_zero_of_a_numerator_is_one_where_it_is_divided_by_zero(self):
        for force, held in HELD:
            answer = self.solved(force)
            self.assertEqual(len(answer["all"]), len(held), (force, answer["all"]))
            for value in held:
                near = min(answer["all"], key=lambda one: abs(one["c"] - value))
                self.assertLessEqual(abs(near["c"] - value), near["error"] + 2e-15*abs(value), force)

    def test_where_alone_it_would_balance_it_has_no_value(self):
        answer = self.solved("sin(c)/c - 3")
        self.assertEqual(answer["reason"], "No real c holds the system: at c = 0, where the forces would balance, "
                                           "what they divide by is zero, too.")

    def test_a_pole_that_is_not_told_from_a_zero_refuses(self):
        self.assertIn("vanish too often", self.solved("(1 - cos(c))/c^2 - 0.3")["reason"])

    def test_ends_of_a_domain_that_are_not_told_refuse(self):
        for force in ("sqrt(4 - c^2) - 1", "asin(c) - 0.5"):
            self.assertIn("and vanish where that ends", self.solved(force)["reason"])

    def test_no_turn_is_all_where_forces_do_not_come_back(self):
        self.assertIn("vanish too often", self.solved("sin(c)/c")["reason"])
        self.assertEqual(len(self.solved("sin(c) - 0.3")["all"]), 2)

    def test_several_values_within_rounding_are_said(self):
        for force, count in (("exp(c) - 1 - c", 1), ("exp(c) - 1 - c + 1e-17", 1), ("(cosh(c) - 1)*(c - 2)", 2)):
            answer = self.solved(force)
            self.assertEqual(len(answer["all"]), count)
            self.assertEqual(answer["notes"], ["Within the error of c = 0 there may be several values, one or none: "
                                               "rounding does not tell them apart."])
        self.assertNotIn("notes", self.solved("exp(c) - 2"))
        self.assertTrue(math.isclose(self.solved("exp(c) - 2")["c"], math.log(2)))


if __name__ == "__main__":
    unittest.main()
