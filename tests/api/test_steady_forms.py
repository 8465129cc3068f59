"""Frequencies of small motions about steady ones, whose momentum is given: as formulas by the momentum or by the place.

Books' results (Goldstein, Classical Mechanics, 3rd ed., 3.6; Landau and Lifshitz, Mechanics, section 14; Taylor,
Classical Mechanics, chapter 8), each held against the number beside it at random parameters and momenta.
"""

import pathlib
import random
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import DOWN_3D, G, particle, scene  # noqa: E402

mpmath.mp.dps = 30
FUNCTIONS = {name: getattr(mpmath, name) for name in ("sqrt", "sin", "cos", "tan", "pi")}


def in_the_plane(name, parameters, potential):
    return scene(name, f"m kg 1.2; {parameters}", "r m 0.9; phi rad 0 1.3", potential=potential,
                 bodies=[particle("m", "r*cos(phi)", "r*sin(phi)")])


def on_surface(name, parameters, coordinate, radius, height):
    return scene(name, f"m kg 1.2; {parameters}; {G}", f"{coordinate}; phi rad 0 3", gravity=DOWN_3D,
                 bodies=[particle("m", f"({radius})*cos(phi)", f"({radius})*sin(phi)", height)])


HOLE = scene("mass_through_a_hole", f"m kg 1; M kg 2; {G}", "r m 1; phi rad 0 3", gravity=DOWN_3D,
             bodies=[particle("m", "r*cos(phi)", "r*sin(phi)", "0"), particle("M", "0", "0", "r")])
# The scene, its coordinate, and omega^2 by it, with the momentum that belongs to it.
STEADY = [
    (in_the_plane("kepler", "k N*m^2 2", "-k/r"), "r", "k/(m*r**3)"),
    (in_the_plane("isotropic", "k N/m 3", "k*r^2/2"), "r", "4*k/m"),
    (in_the_plane("cubic", "k N/m^2 3", "k*r^3/3"), "r", "5*k*r/m"),
    (in_the_plane("dust", "k N*m^2 2; C N/m 0.3", "-k/r + C*r^2/2"), "r", "k/(m*r**3) + 4*C/m"),
    (in_the_plane("yukawa", "k N*m^2 2; a m 3", "-k/r*exp(-r/a)"), "r",
     "k*exp(-r/a)*(1 + r/a - r**2/a**2)/(m*r**3)"),
    (on_surface("spherical", "l m 0.7", "theta rad 0.8", "l*sin(theta)", "-l*cos(theta)"), "theta",
     "g*(1 + 3*cos(theta)**2)/(l*cos(theta))"),
    (on_surface("cone", "alpha rad 0.5", "r m 0.5", "r", "r/tan(alpha)"), "r", "3*g*sin(alpha)*cos(alpha)/r"),
    (on_surface("paraboloid", "a 1/m 1.1", "r m 0.5", "r", "a*r^2/2"), "r", "4*a*g/(1 + a**2*r**2)"),
    (HOLE, "r", "3*M*g/((m + M)*r)"),
]


def value(text, numbers):
    names = {name: mpmath.mpf(number) for name, number in numbers.items()}
    return eval(text.replace("^", "**"), FUNCTIONS | {"exp": mpmath.exp}, names)  # noqa: S307


class SteadyForms(Service):
    def test_by_the_place_or_the_momentum(self):
        draw = random.Random(5)
        for system, coordinate, book in STEADY:
            for _ in range(4):
                with self.subTest(system["name"]):
                    parameters = {p["name"]: f"{float(p['default'])*draw.uniform(0.8, 1.2):.3f}" for p in system["parameters"]}
                    parameters = {name: float(text) for name, text in parameters.items()}
                    rate = round(draw.uniform(1.1, 1.4) if coordinate == "r" else draw.uniform(1.5, 4), 3)
                    found = self.ask("modes", {"system": system, "parameters": parameters, "initial": {"phi_dot": rate}})
                    mode = next(mode for mode in found["modes"] if mode["kind"] == "oscillation")
                    start = found["request"]["initial"]
                    numbers = parameters | {coordinate: found["equilibrium"]["state"][coordinate]}
                    momentum = self.ask("energy", {"system": system, "parameters": parameters, "initial": start})["p_phi"]
                    place_error = found["equilibrium"]["error"][coordinate]
                    for text in (book, mode["exact"]["text"]):
                        omega = mpmath.sqrt(value(text, numbers | {"p_phi": momentum}))
                        self.assertLess(abs(omega - mode["omega"]), mode["error"] + 1e-13*mode["omega"] + 9*place_error, text)
                    self.assertLessEqual(len(mode["exact"]["text"]), len(book) + 6)

    def test_where_a_planet_circles_is_known_by_its_momentum(self):
        system = in_the_plane("kepler", "k N*m^2 2", "-k/r")
        found = self.ask("modes", {"system": system})
        place = found["equilibrium"]["exact"]["r"]
        self.assertEqual(place["text"], "p_phi^2/(m*k)")
        self.assertIn("p_phi > 0", self.ask("modes", {"system": system})["modes"][1]["exact"]["assumes"] + place["assumes"])

    def test_what_holds_at_a_place_assumes_that_there_is_one(self):
        """A charge on a sphere about a monopole of size b rests at acos(p/b); one of p < -b does not, nor does its b^2/m^2."""
        sphere = {"name": "monopole", "units": "none",
                  "parameters": [{"name": "m", "default": 1}, {"name": "b", "default": 1}],
                  "coordinates": [{"name": "th", "initial": 1, "unit": "rad"}, {"name": "ph", "initial_rate": 0.4}],
                  "lagrangian": "m/2*(th_dot^2 + sin(th)^2*ph_dot^2) + b*cos(th)*ph_dot"}
        for sign, conditions in ((1, ["p_ph > 0", "b > p_ph"]), (-1, ["p_ph < 0", "p_ph + b > 0"])):
            rate = sign*0.4 - (0 if sign > 0 else 2*mpmath.cos(1)/mpmath.sin(1)**2)
            start = {"system": sphere, "initial": {"ph_dot": float(rate)}}
            forms = [place["exact_rate2"] for place in self.ask("equilibria", start)["equilibria"]]
            forms += [mode["exact"] for mode in self.ask("modes", start)["modes"] if "exact" in mode]
            self.assertEqual([form["text"] for form in forms], ["b^2/m^2"]*3)
            for form in forms:
                self.assertLessEqual(set(conditions), set(form["assumes"]))

    def test_a_formula_by_the_place_assumes_that_some_momentum_holds_it_there(self):
        """p^2 = (m*k + B^2/4) r^4 in a field B on a spring that pushes, k < 0: nothing circles where that is negative."""
        ring = {"name": "ring", "units": "none",
                "parameters": [{"name": "m", "default": 1}, {"name": "k", "default": -0.2}, {"name": "B", "default": 2}],
                "coordinates": [{"name": "r", "initial": 1}, {"name": "f", "initial_rate": -1.5}],
                "lagrangian": "m/2*(r_dot^2 + r^2*f_dot^2) + B*r^2/2*f_dot - k*r^2/2"}
        places = self.ask("equilibria", {"system": ring})["equilibria"]
        forms = [place["exact_rate2"] for place in places if "exact_rate2" in place]
        self.assertTrue(forms)
        for form in forms:
            self.assertIn("B^2 + 4*m*k > 0", form["assumes"])

    def test_a_sleeping_top_by_its_spin(self):
        top = scene("top", f"m kg 0.4; h m 0.04; A kg*m^2 0.002; C kg*m^2 0.001; {G}", "a rad; b rad; psi rad 0 90",
                    gravity=DOWN_3D,
                    bodies=[{"kind": "rigid_body", "mass": "m", "principal_moments": ["A", "A", "C"],
                             "centre": ["h*sin(b)", "-h*sin(a)*cos(b)", "h*cos(a)*cos(b)"],
                             "orientation": {"sequence": "XYZ", "angles": ["a", "b", "psi"]}}])
        found = self.ask("modes", {"system": top, "equilibrium": {"a": 0, "b": 0, "psi": 0}})
        numbers = {"m": 0.4, "h": 0.04, "A": 0.002, "C": 0.001, "g": 9.81, "p_psi": 0.09}
        swings = [mode for mode in found["modes"] if mode["kind"] == "oscillation"]
        self.assertEqual(len(swings), 2)
        for mode in swings:
            self.assertIn("sqrt(p_psi^2 - 4*m*h*g*(A + m*h^2))", mode["exact"]["text"])
            self.assertLess(abs(value(mode["exact"]["text"], numbers) - mpmath.mpf(mode["omega"])**2), 1e-11*mode["omega"]**2)


if __name__ == "__main__":
    unittest.main()
