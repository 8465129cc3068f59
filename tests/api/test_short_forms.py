"""Formulas as a book prints them: a rate whose square has a nested root, an angle by its tangent, a place that is free."""

import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import DOWN, DOWN_3D, G, lagrangian, particle, scene  # noqa: E402

ZEEMAN = scene("spring_in_a_magnetic_field", "m kg 1; k N/m 4; q C 1; B T 3", "x m 0.1; y m; z m",
               lagrangian="m/2*(x_dot^2 + y_dot^2 + z_dot^2) - k/2*(x^2 + y^2 + z^2) + q*B/2*(x*y_dot - y*x_dot)")
TOP = scene("sleeping_top", f"m kg 0.4; h m 0.04; A kg*m^2 0.002; C kg*m^2 0.001; w rad/s 90; {G}", "a rad; b rad",
            gravity=DOWN_3D,
            bodies=[{"kind": "rigid_body", "mass": "m", "principal_moments": ["A", "A", "C"],
                     "centre": ["h*sin(b)", "-h*sin(a)*cos(b)", "h*cos(a)*cos(b)"],
                     "orientation": {"sequence": "XYZ", "angles": ["a", "b", "w*t"]}}])
SLOPE = scene("pendulum_on_a_slope", f"m kg 1; l m 1; gamma rad 0.08; {G}", "theta rad 3",
              gravity=["g*sin(gamma)", "-g*cos(gamma)"], bodies=[particle("m", "l*sin(theta)", "l*cos(theta)")])
BEADS = lagrangian("two_beads_on_a_hoop", "m - 1; k - 2; R - 1", "a - 0.1; b - 0.3",
                   "m*R^2/2*(a_dot^2 + b_dot^2) - k*R^2/2*(b - a)^2")
# Kane and Levinson's chaotic pendulum: its plate may stand at any angle.
PLATE = scene("plate_on_a_rod", f"m kg 0.1; l m 0.2; h m 0.1; w m 0.2; {G}", "theta rad 1.5; phi rad 0.01", gravity=DOWN_3D,
              bodies=[{"kind": "rigid_body", "mass": "m",
                       "principal_moments": ["m*h^2/12", "m*(w^2 + h^2)/12", "m*w^2/12"],
                       "centre": ["-l*sin(theta)", "0", "-l*cos(theta)"],
                       "orientation": {"sequence": "YZ", "angles": ["theta", "phi"]}}])
WELL = lagrangian("well_under_a_load", "V - 1; a - 1; F - 0.1", "x - 0.1", "x_dot^2/2 + V/cosh(a*x)^2 + F*x")
BLOCK = scene("block_on_a_wedge", f"M kg 3; m kg 1; al rad 0.5; k N/m 20; {G}", "X m; s m", gravity=DOWN,
              bodies=[particle("M", "X", "0"), particle("m", "X + s*cos(al)", "-s*sin(al)")],
              springs=[{"stiffness": "k", "length": "s"}])


class ShortForms(Service):
    def oscillations(self, scene, **fields):
        found = self.ask("modes", {"system": scene} | fields)
        return [mode["exact"] for mode in found["modes"] if mode["kind"] == "oscillation"]

    def test_rates_that_are_sums_of_roots(self):
        slow, _, fast = (mode["omega"]["text"] for mode in self.oscillations(ZEEMAN))
        self.assertEqual(slow, "(sqrt(4*m*k + q^2*B^2) - q*B)/(2*m)")
        self.assertEqual(fast, "(sqrt(4*m*k + q^2*B^2) + q*B)/(2*m)")
        slow, fast = (mode["omega"]["text"] for mode in self.oscillations(TOP, equilibrium={"a": 0, "b": 0}))
        self.assertEqual(slow, "(C*w - sqrt(C^2*w^2 - 4*m*h*g*(A + m*h^2)))/(2*(A + m*h^2))")
        self.assertEqual(fast, "(sqrt(C^2*w^2 - 4*m*h*g*(A + m*h^2)) + C*w)/(2*(A + m*h^2))")

    def test_an_angle_by_its_tangent(self):
        found = self.ask("modes", {"system": SLOPE})
        self.assertEqual(found["equilibrium"]["exact"]["theta"]["text"], "pi - gamma")
        self.assertEqual(found["modes"][0]["exact"]["text"], "g/l")
        found = self.ask("modes", {"system": SLOPE, "equilibrium": {"theta": 0}})
        self.assertEqual(found["equilibrium"]["exact"]["theta"]["text"], "-gamma")

    def test_where_a_coordinate_is_free(self):
        self.assertEqual([mode["text"] for mode in self.oscillations(BEADS)], ["2*k/m"])
        plate, = self.oscillations(PLATE)
        self.assertEqual(plate["text"], "12*l*g/(12*l^2 + h^2 + w^2*cos(phi)^2)")

    def test_a_load_on_a_well(self):
        found = self.ask("bifurcations", {"system": WELL, "parameter": "F", "from": 0.1, "to": 2})
        self.assertEqual([critical["exact"]["text"] for critical in found["critical"]], ["4/9*sqrt(3)*V*a"])

    def test_a_wedge_has_the_sine_of_its_angle(self):
        mode, = self.oscillations(BLOCK)
        for form in (mode, mode["omega"], mode["period"]):
            self.assertIn("sin(al)^2", form["text"])
        period = self.ask("turning_points", {"system": BLOCK})["exact"]["period"]
        self.assertEqual(period["text"], "2*pi*sqrt(m*(M + m*sin(al)^2)/(k*(M + m)))")


if __name__ == "__main__":
    unittest.main()
