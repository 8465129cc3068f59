"""Formulas as a book prints them: a rate whose square has a nested root, an angle by its tangent, a place that is free."""

import pathlib
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import DOWN, DOWN_3D, G, lagrangian, particle, scene  # noqa: E402

mpmath.mp.dps = 30
FUNCTIONS = {name: getattr(mpmath, name) for name in ("sqrt", "acos", "mpf")}

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


def beside(name, parameters, potential):
    return scene(name, f"m kg 1; {parameters}", "x m 0.8", bodies=[particle("m", "x", "0")], potential=potential)


# A spring draws a bead to a place beside its wire; a charge on the axis of a ring that repels it; a bead on a hoop with a
# spring to its top (Goldstein; Irodov): the bracket's power is known there, and what it says of the place.
WIRE = beside("bead_beside_its_wire", "k N/m 10; l m 0.5; r m 1", "k/2*(sqrt(x^2 + l^2) - r)^2")
RING = beside("charge_on_the_axis_of_a_ring", "q N*m^2 2; c N/m 0.3; R m 0.5", "q/sqrt(x^2 + R^2) + c*x^2/2")
HOOP = scene("bead_on_a_hoop_with_a_spring", f"m kg 1; k N/m 40; R m 0.5; l m 0.3; {G}", "th rad 0.5", gravity=DOWN,
             bodies=[particle("m", "R*sin(th)", "-R*cos(th)")],
             springs=[{"stiffness": "k", "between": [["R*sin(th)", "-R*cos(th)"], ["0", "R"]], "rest_length": "l"}])
TRUSS = scene("truss", "k N/m 10; b m 1; h m 0.5; P N 0.1; m kg 1", "y m 0.5", bodies=[particle("m", "0", "y")],
              potential="P*y + k*(sqrt(b^2 + y^2) - sqrt(b^2 + h^2))^2")
PLACES = [(WIRE, "x", "sqrt(r**2 - l**2)", "k/m*(1 - l**2/r**2)"),
          (RING, "x", "sqrt((q/c)**(2/3) - R**2)", "3*c/m*(1 - R**2*(c/q)**(2/3))"),
          (HOOP, "th", "acos((k*l/(k*R - m*g))**2/2 - 1)", None)]

# Three masses in an equilateral triangle (Goldstein, chapter 6): roots of 3 multiply to numbers.
CORNERS = [["x1", "y1"], ["a + x2", "y2"], ["a/2 + x3", "sqrt(3)/2*a + y3"]]
TRIANGLE = scene("triangle", "m kg 1; k N/m 1; a m 1", "x1 m; y1 m; x2 m; y2 m; x3 m; y3 m",
                 bodies=[particle("m", *corner) for corner in CORNERS],
                 springs=[{"stiffness": "k", "between": [CORNERS[i], CORNERS[j]], "rest_length": "a"}
                          for i, j in ((0, 1), (0, 2), (1, 2))])
OBLIQUE = lagrangian("oblique_springs", "m - 1; k - 1", "x - 0; y - 0", "m*(x_dot^2 + y_dot^2)/2"
                     " - k*(x^2 + (x/2 + sqrt(3)/2*y)^2 + (x/2 - sqrt(3)/2*y + y/7)^2)/2")

CORNER = lagrangian("corner_of_two_hyperbolas", "m - 1; k - 3; c - 2", "x - 1; y - 1", "m*(x_dot^2 + y_dot^2)/2 - k/(x*y) - c*(x + y)")
CONE = lagrangian("cone", "m - 1; g - 9.81; al - 0.5", "r - 1; f - 0 2", "m*(r_dot^2 + r^2*sin(al)^2*f_dot^2)/2 - m*g*r*cos(al)")


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

    def test_roots_of_numbers_multiply_to_numbers(self):
        at_rest = {name["name"]: 0 for name in TRIANGLE["coordinates"]}
        fastest = self.ask("modes", {"system": TRIANGLE, "equilibrium": at_rest})["modes"][-1]
        self.assertEqual(fastest["exact"]["text"], "3*k/m")
        for mode in self.oscillations(OBLIQUE, equilibrium={"x": 0, "y": 0}):
            self.assertIn("sqrt(197 - 14*sqrt(3))", mode["text"])

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

    def test_a_place_that_a_lengths_power_solves(self):
        for system, name, place, square in PLACES:
            with self.subTest(system["name"]):
                found = self.ask("modes", {"system": system})
                numbers = {p["name"]: mpmath.mpf(p["default"]) for p in system["parameters"]}
                state = found["equilibrium"]
                for text in (place, state["exact"][name]["text"].replace("^", "**").replace("(2/3)", "(mpf(2)/3)")):
                    value = eval(text.replace("(2/3)", "(mpf(2)/3)"), FUNCTIONS | numbers)  # noqa: S307
                    self.assertLess(abs(value - state["state"][name]), state["error"][name] + 1e-15)
                if square is None:
                    continue
                mode, = found["modes"]
                value = eval(square.replace("(2/3)", "(mpf(2)/3)"), FUNCTIONS | numbers)  # noqa: S307
                self.assertLess(abs(mpmath.sqrt(value) - mode["omega"]), mode["error"] + 1e-15)
                self.assertIn("exact", mode)

    def test_roots_give_up_powers_that_are_squares(self):
        self.assertEqual([mode["text"] for mode in self.oscillations(CORNER)], ["c*(c/k)^(1/3)/m", "3*c*(c/k)^(1/3)/m"])

    def test_roots_give_up_sines_whose_squares_cosines_hide(self):
        lower = self.ask("turning_points", {"system": CONE})["exact"]["r_min"]
        self.assertEqual(lower["text"], "(sqrt(sin(al)^2 + 2*g*cos(al)) + sin(al))*sin(al)/(g*cos(al))")
        self.assertIn("sin(al) > 0", lower["assumes"])

    def test_a_truss_snaps_through(self):
        found = self.ask("bifurcations", {"system": TRUSS, "parameter": "P", "from": 0.1, "to": 2})
        critical, = found["critical"]
        known = 20*(mpmath.cbrt(mpmath.mpf("1.25")) - 1)**mpmath.mpf("1.5")
        self.assertLess(abs(critical["value"] - known), critical["error"])
        self.assertIn("(b^2 + h^2)^(1/3)", critical["exact"]["text"])

    def test_a_wedge_has_the_sine_of_its_angle(self):
        mode, = self.oscillations(BLOCK)
        for form in (mode, mode["omega"], mode["period"]):
            self.assertIn("sin(al)^2", form["text"])
        period = self.ask("turning_points", {"system": BLOCK})["exact"]["period"]
        self.assertEqual(period["text"], "2*pi*sqrt(m*(M + m*sin(al)^2)/(k*(M + m)))")


if __name__ == "__main__":
    unittest.main()
