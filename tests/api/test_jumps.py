"""Jumps in a Lagrangian: what a derivative that leaves them out would prove is not claimed, and where they are impulses the scene is refused."""

import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, strict_json  # noqa: E402
from short_scene import lagrangian  # noqa: E402

ONE, TWO = "x - 0.2 0.1", "x - 0.2 0.1; y - 0 1"

# L, coordinates, what is conserved: symmetries that leave the place of the jump where it is
CONSERVED = [
    ("m*x_dot^2/2 + A*x*sign(1 - t)", ONE, []),
    ("m*x_dot^2/2 + A*x^2*(2 + sign(t - 1))", ONE, []),
    ("m*x_dot^2/2 + A*x*(atan(t - 1) + atan(1/(t - 1)))", ONE, []),
    ("m*x_dot^2/2 + A*x*(atan(tan(t)) - t)", ONE, []),
    ("m*(x_dot^2 + y_dot^2)/2 - A*abs(y)*sign(t - 1)", TWO, ["p_x", "boost_x"]),
    ("m*(x_dot^2 + y_dot^2)/2 - A*(x - y)^2*sign(t - 1)", TWO, ["momentum_x_y", "boost_x_y"]),
    ("m*(x_dot^2 + y_dot^2)/2 - A*(x^2 + y^2)*sign(t - 1)", TWO, ["angular_momentum_x_y"]),
    ("m*(x_dot^2 + y_dot^2)/2 - A*(atan(y - 0.5) + atan(1/(y - 0.5)))", TWO, ["h", "p_x", "boost_x"]),
]

# No jump: the sign's factor vanishes where it changes.
CONTINUOUS = [
    ("m*(x_dot^2 + y_dot^2)/2 - A*(1 + sign(y - 0.5))*(y - 0.5)^2", ["h", "p_x", "boost_x"]),
    ("m*(x_dot^2 + y_dot^2)/2 - A*(1 + sign(y))*(1 - cos(y))", ["h", "p_x", "boost_x"]),
    ("m*(x_dot^2 + y_dot^2)/2 - A*(1 + sign(y - x))*(y - x)", ["h", "momentum_x_y", "boost_x_y"]),
    ("m*(x_dot^2 + y_dot^2)/2 - A*(1 + sign(x^2 + y^2 - 1))*(x^2 + y^2 - 1)", ["h", "angular_momentum_x_y"]),
    ("m*(x_dot^2 + y_dot^2)/2 - A*(1 + sign(m))*x", ["h", "p_y", "momentum_x", "boost_x", "boost_y"]),
]

# Steps of a potential, and of a mass: at the time, too, a momentum that stays makes the velocity jump.
IMPULSES = [
    ("m*(x_dot^2 + y_dot^2)/2 - A*sign(y - 0.5)", "y - 1/2", ["h", "p_x", "boost_x"]),
    ("m*(x_dot^2 + y_dot^2)/2 - A*x^2*sign(y - 0.5)", "y - 1/2", ["h"]),
    ("m*(2 + sign(y - 0.5))*x_dot^2/2 + m*y_dot^2/2", "y - 1/2", ["h", "p_x"]),
    ("m*(x_dot^2 + y_dot^2)/2 - A*(x^2 + y^2)*sign(x^2 + y^2 - 1)", "x^2 - 1 + y^2", ["h", "angular_momentum_x_y"]),
    ("m*(2 + sign(t - 1))*x_dot^2/2 + m*y_dot^2/2", "t - 1", ["p_x", "p_y", "boost_y"]),
]


class Jumps(Service):
    def scene(self, l, coordinates):
        return {"system": lagrangian("jumps", "m - 1; A - 2", coordinates, l)}

    def names(self, l, coordinates):
        return [quantity["name"] for quantity in self.ask("equations", self.scene(l, coordinates))["conserved"]]

    def test_a_symmetry_keeps_the_jumps_too(self):
        for l, coordinates, names in CONSERVED:
            self.assertEqual(sorted(self.names(l, coordinates)), sorted(names), l)

    def test_a_sign_whose_factor_vanishes_with_it_is_no_jump(self):
        for l, names in CONTINUOUS:
            self.assertEqual(sorted(self.names(l, TWO)), sorted(names), l)

    def test_no_motion_is_computed_where_a_step_gives_an_impulse(self):
        for l, u, names in IMPULSES:
            for method in ({"method": "taylor"}, {"method": "gauss", "h": 0.01}, {"method": "erk"}):
                answer = self.post("simulate", {**self.scene(l, TWO), "t_end": 3, "samples": 7, **method})
                self.assertEqual(answer.status, 422, l)
                self.assertIn(f"jumps with sign({u}) where {u} = 0", strict_json(answer.data)["detail"], l)
            self.assertEqual(sorted(self.names(l, TWO)), sorted(names), l)

    def test_energies_are_told_beside_a_step_and_refused_on_it(self):
        """By hand, with V = 2*A*|x| or A*sign(y - 0.5), m = 1 and A = 2."""
        stepped = "m*(x_dot^2 + y_dot^2)/2 - A*abs(x)*sign(y - 0.5)"
        for l, y, value, h, x_ddot in (("m*(x_dot^2 + y_dot^2)/2 - A*sign(y - 0.5)", 0, 2.505, -1.495, 0), (stepped, 0.6, 0.105, 0.905, -2),
                                       (stepped, 0.4, 0.905, 0.105, 2)):
            answer = self.ask("energy", {**self.scene(l, TWO), "initial": {"y": y}})
            for name, true in (("L", value), ("h", h)):
                self.assertLessEqual(abs(answer[name] - true), answer["error"][name] + 1e-16, l)
            self.assertEqual(answer["accelerations"], {"x_ddot": x_ddot, "y_ddot": 0})
        for initial in ({"y": 0.5}, {"x": 0, "y": 0.6}):
            answer = self.post("energy", {**self.scene(stepped, TWO), "initial": initial})
            self.assertEqual(answer.status, 422)
            self.assertIn("sign(y - 1/2)", strict_json(answer.data)["detail"])

    def test_a_force_that_jumps_in_time_moves_as_it_does(self):
        answer = self.ask("simulate", {**self.scene("m*x_dot^2/2 + A*x*sign(1 - t)", ONE), "times": [0, 1, 3]})
        x = [row[answer["columns"].index("x")] for row in answer["rows"]] if "rows" in answer else answer["trajectory"]["x"]
        for value, true in zip(x, [0.2, 1.3, 1.3 + 2.1*2 - 4]):
            self.assertAlmostEqual(value, true, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
