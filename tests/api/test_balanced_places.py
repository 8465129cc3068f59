"""Places of rest where an exponential, a logarithm, a tangent or a power of a length stands beside the coordinate: their
formulas and those of the rates, as a book prints them, against 40 digits of mpmath."""

import math
import pathlib
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mpmath.mp.dps = 40
VALUES = {"m": mpmath.mpf("1.3"), "a": mpmath.mpf(2), "b": mpmath.mpf("1.5")}

# -V, a place nearby, its formula, omega^2 as it is written, and by mpmath.
PLACES = [
    ("a*x*exp(-b*x)", 0.4, "1/b", "a*b*exp(-1)/m", "a*b*exp(-1)/m"),
    ("a*x^2*exp(-b*x)", 0.9, "2/b", "2*a*exp(-2)/m", "2*a*exp(-2)/m"),
    ("a*x*exp(-b*x^2)", 0.4, "1/sqrt(2*b)", "2*a*exp(-1/2)*sqrt(2*b)/m", "2*sqrt(2*b)*a*exp(mpf(-1)/2)/m"),
    ("a*x^2*exp(-b*x^2)", 0.7, "1/sqrt(b)", "4*a*exp(-1)/m", "4*a*exp(-1)/m"),
    ("a*x*(1-x)*exp(-b*x)", 0.4, "(2 + b - sqrt(4 + b^2))/(2*b)", None, "a*sqrt(4+b**2)*exp(sqrt(4+b**2)/2-1-b/2)/m"),
    ("a*sin(x)*exp(-b*x)", 0.4, "atan(1/b)", "a*sqrt(1 + b^2)*exp(-b*atan(1/b))/m", "a*sqrt(1+b**2)*exp(-b*atan(1/b))/m"),
    ("-a*x*log(x/b)", 0.5, "b*exp(-1)", "a*exp(1)/(m*b)", "a*exp(1)/(m*b)"),
    ("-a*x^2*log(x/b)", 0.9, "b*exp(-1/2)", "2*a/m", "2*a/m"),
    ("a*log(x)/x", 2.5, "exp(1)", "a*exp(-3)/m", "a*exp(-3)/m"),
    ("-a*tan(x)-b/tan(x)", 0.7, "atan(sqrt(b/a))", "2*(a + b)^2/(m*sqrt(a*b))", "2*(a+b)**2/(m*sqrt(a*b))"),
    ("-a*tan(x)-b/tan(x)", -2.4, "atan(sqrt(b/a)) - pi", "2*(a + b)^2/(m*sqrt(a*b))", "2*(a+b)**2/(m*sqrt(a*b))"),
    ("-tan(x)+b*x", 0.5, "acos(1/sqrt(b))", "2*b*sqrt(b - 1)/m", "2*b*sqrt(b-1)/m"),
    ("-a/cos(x)-b/sin(x)", 0.7, "atan((b/a)^(1/3))", "3*(a^(2/3) + b^(2/3))^(3/2)/m",
     "3*(cbrt(a)**2+cbrt(b)**2)**1.5/m"),
    ("-a*cos(x)^4/4+b*cos(x)", -0.5, "-acos((b/a)^(1/3))", None, "3*cbrt(b**2/a)*(cbrt(a)**2-cbrt(b)**2)/m"),
    ("-a/x^2-b/(1-x)^2", 0.7, "a^(1/3)/(a^(1/3) + b^(1/3))", "6*(a^(1/3) + b^(1/3))^5/(m*(a*b)^(1/3))",
     "6*(cbrt(a)+cbrt(b))**5/(m*cbrt(a*b))"),
    ("-a/x-b/(1-x)", 0.7, "sqrt(a)/(sqrt(a) + sqrt(b))", "2*(sqrt(a) + sqrt(b))^4/(m*sqrt(a*b))",
     "2*(sqrt(a)+sqrt(b))**4/(m*sqrt(a*b))"),
    ("-(a+b)*x^2-a/x^2", 0.8, "(a/(a + b))^(1/4)", "8*(a + b)/m", "8*(a+b)/m"),
    ("-a*x^2-(a+b)/x^2", 1.2, "((a + b)/a)^(1/4)", "8*a/m", "8*a/m"),
    ("-(a+b)*x^2/2-a/x", 0.8, "(a/(a + b))^(1/3)", "3*(a + b)/m", "3*(a+b)/m"),
    ("-a*x-b/(x-1)", 1.7, "1 + sqrt(b/a)", "2*a*sqrt(a/b)/m", "2*a*sqrt(a/b)/m"),
    ("-a*cosh(x)+b*sinh(x)", 0.9, None, "sqrt((a - b)*(a + b))/m", "sqrt(a**2-b**2)/m"),
    ("-a*exp(x)-b*exp(-x)", 0.1, "1/2*log(b/a)", "2*sqrt(a*b)/m", "2*sqrt(a*b)/m"),
    ("a*x/sqrt(1+b*x^4)", 0.7, None, "sqrt(2)*a*b^(1/4)/m", "sqrt(2)*a*sqrt(sqrt(b))/m"),
]


def value(text):
    functions = {name: getattr(mpmath, name) for name in ("sqrt", "cbrt", "exp", "atan", "mpf")}
    return eval(text, functions | VALUES)  # noqa: S307: the lines above


class BalancedPlaces(Service):
    def test_places_and_rates_have_their_formulas(self):
        for force, near, place, square, by_hand in PLACES:
            with self.subTest(force=force):
                scene = lagrangian("line", "m - 1.3; a - 2; b - 1.5", f"x - {near}", f"m*x_dot^2/2 + ({force})")
                found = self.ask("modes", {"system": scene, "equilibrium": {"x": near}})
                if place:
                    self.assertEqual(found["equilibrium"]["exact"]["x"]["text"], place)
                mode = found["modes"][0]
                if square:
                    self.assertEqual(mode["exact"]["text"], square)
                self.assertIn("omega", mode["exact"])
                self.assertAlmostEqual(mode["omega"] ** 2, float(value(by_hand)), delta=1e-13 * mode["omega"] ** 2)

    def test_bounce_and_pitch_of_a_car(self):
        """Thomson and Dahleh, Theory of Vibration with Applications, 5.3: two coordinates coupled by their springs."""
        car = lagrangian("car", "m - 1000; J - 1500; k1 - 20000; k2 - 22000; a - 1.2; b - 1.5", "y - 0; th - 0",
                         "m*y_dot^2/2 + J*th_dot^2/2 - k1*(y - a*th)^2/2 - k2*(y + b*th)^2/2")
        modes = self.ask("modes", {"system": car})["modes"]
        own = "k1*(J + m*a^2)", "k2*(J + m*b^2)"
        root = "sqrt((k1*(J - m*a^2) + k2*(J - m*b^2))^2 + 4*m*J*(k2*b - k1*a)^2)"
        self.assertEqual([mode["exact"]["text"] for mode in modes],
                         [f"({own[0]} - {root} + {own[1]})/(2*m*J)", f"({root} + {own[0]} + {own[1]})/(2*m*J)"])
        K = mpmath.matrix([[42000, 22000*mpmath.mpf("1.5") - 24000], [9000, 20000*mpmath.mpf("1.44") + 22000*mpmath.mpf("2.25")]])
        half = (K[0, 0]/1000 + K[1, 1]/1500)/2
        apart = mpmath.sqrt((K[0, 0]/1000 - K[1, 1]/1500)**2/4 + K[0, 1]**2/1500000)
        for mode, square in zip(modes, (half - apart, half + apart)):
            self.assertLessEqual(abs(mode["omega"] - mpmath.sqrt(square)), mode["error"] + 1e-15)

    def test_charges_at_both_ends_of_a_wire(self):
        wire = lagrangian("charges", "m - 1; k1 - 1; k2 - 2; d - 1", "x - 0.4", "m*x_dot^2/2 - k1/x - k2/(d - x)")
        found = self.ask("modes", {"system": wire, "equilibrium": {"x": 0.4}})
        self.assertEqual(found["equilibrium"]["exact"]["x"]["text"], "sqrt(k1)*d/(sqrt(k1) + sqrt(k2))")
        self.assertEqual(found["modes"][0]["exact"]["text"], "2*(sqrt(k1) + sqrt(k2))^4/(m*d^3*sqrt(k1*k2))")

    def test_all_equilibria_have_their_formulas(self):
        found = self.ask("equilibria", {"system": "bead_on_hoop"})["equilibria"]
        self.assertEqual([entry.get("exact", {}).get("theta", {}).get("text") for entry in found],
                         ["-acos(g/(R*Omega^2))", None, "acos(g/(R*Omega^2))", "pi"])
        side, bottom, top = "Omega^2 - g^2/(R^2*Omega^2)", "g/R - Omega^2", "-Omega^2 - g/R"
        self.assertEqual([entry["exact_rate2"]["text"] for entry in found], [side, bottom, side, top])
        self.assertEqual(found[0]["exact"]["theta"]["assumes"], ["R > 0", "Omega > 0", "g > 0", "R*Omega^2 > g"])
        for name in ("henon_heiles", "governor", "orbiting_pendulum", "spring_pendulum"):
            for entry in self.ask("equilibria", {"system": name})["equilibria"]:
                at = self.ask("modes", {"system": name, "equilibrium": {
                    q: x for q, x in entry["state"].items() if not q.endswith("_dot")}})
                self.assertEqual(entry.get("exact", {}), at["equilibrium"].get("exact", {}), name)

    def test_a_place_is_the_parameter_at_which_it_rests(self):
        """Another one has the same number."""
        pendulum = lagrangian("pendulum", "A - 1; k - 2; c - 1", "x - 0", "x_dot^2/2 - A*cos(x - c) - k*(x - c)^2/2")
        found = self.ask("modes", {"system": pendulum, "equilibrium": {"x": 1}})
        self.assertEqual(found["equilibrium"]["exact"]["x"]["text"], "c")
        fork, = self.ask("bifurcations", {"system": pendulum, "parameter": "k", "from": 0.5, "to": 1.5})["critical"]
        self.assertEqual(fork["exact"]["text"], "A")

    def test_koiters_strut(self):
        strut = {"name": "strut", "units": "none", "coordinates": [{"name": "a", "unit": "rad", "initial": "0.1"}],
                 "parameters": [{"name": n, "default": d} for n, d in (("c", "1"), ("l", "1"), ("P", "0.5"), ("e", "0.1"))],
                 "lagrangian": "l^2*a_dot^2/2 - c*sin(a)^2/2 - P*l*cos(a) - P*e*sin(a)"}
        fold, = self.ask("bifurcations", {"system": strut, "parameter": "P", "from": 0.1, "to": 2})["critical"]
        self.assertEqual(fold["exact"]["text"], "c/(l^(2/3) + e^(2/3))^(3/2)")

    def test_the_truss_of_von_mises_by_its_angle(self):
        truss = {"name": "truss", "units": "none", "coordinates": [{"name": "a", "unit": "rad", "initial": "0.4"}],
                 "parameters": [{"name": n, "default": d} for n, d in (("k", "2"), ("l", "1"), ("b", "0.5"), ("P", "0.1"))],
                 "lagrangian": "l^2*a_dot^2/2 - k*(2*l*(cos(b) - cos(a)))^2/2 - P*l*sin(a)"}
        fold, = self.ask("bifurcations", {"system": truss, "parameter": "P", "from": 0.01, "to": 1})["critical"]
        self.assertEqual(fold["exact"]["text"], "4*k*l*(1 - cos(b)^(2/3))^(3/2)")
        self.assertAlmostEqual(fold["value"], 8 * (1 - math.cos(0.5) ** (2 / 3)) ** 1.5, delta=1e-14)

    def test_a_critical_value_of_zero_is_exact(self):
        for force, kind in (("p*x^2/2 - b*x^3/3", "transcritical"), ("p*x^2/2 - x^4/4", "pitchfork"),
                            ("-x^4/4 + a*x^3/3 - p*x", "saddle_node")):
            line = lagrangian("line", "m - 1; a - 1; b - 1; p - 0.5", "x - 0.1", f"m*x_dot^2/2 + ({force})")
            first = self.ask("bifurcations", {"system": line, "parameter": "p", "from": -1, "to": 1})["critical"][0]
            self.assertEqual((first["value"], first["kind"], first["exact"]["text"], first["exact"]["assumes"]), (0, kind, "0", []))

    def test_rates_that_are_left_out_are_named(self):
        spinning = {"name": "spinning", "units": "none", "coordinates": [{"name": q} for q in "abc"],
                    "parameters": [{"name": p, "default": v} for p, v in (("m", "1"), ("A", "2"), ("B", "3"), ("C", "4"))],
                    "bodies": [{"kind": "rigid_body", "mass": "m", "principal_moments": ["A", "B", "C"],
                                "centre": ["0", "0", "0"], "orientation": {"sequence": "XYZ", "angles": ["a", "b", "c"]}}]}
        for body in ({"system": spinning, "initial": {"c_dot": 10}},
                     {"system": "plane_pendulum", "initial": {"theta_dot": 3}}):
            name = next(iter(body["initial"]))
            self.assertIn(f"{name} = {body['initial'][name]}", self.ask("modes", body)["notes"][0])
        for body in ({"system": "plane_pendulum"}, {"system": "free_spin_pendulum", "initial": {"psi_dot": 3}}):
            self.assertNotIn("notes", self.ask("modes", body))

    def test_of_two_values_that_are_hardly_apart_another_force_tells_which(self):
        """f vanishes at two values of k, or at one twice, and g at one of them alone."""
        for value, other in (("-0.77753", "-0.77752999"), ("1.25", "1.250000000001"), ("2.3", "2.3"), ("1234567.5", "1234567.501")):
            scene = {"name": "two", "units": "none", "parameters": [{"name": "k", "default": "1"}],
                     "coordinates": [{"name": "x", "initial": "0.3"}, {"name": "y", "initial": "0.1"}],
                     "lagrangian": "(x_dot^2 + y_dot^2)/2",
                     "forces": [{"name": "f", "value": f"2.173*(k - ({value}))*(k - ({other}))", "along": "x"},
                                {"name": "g", "value": f"-2*(y - 0.5) + 0.5*(k - ({value}))", "along": "y"}]}
            answer = self.ask("equilibria", {"system": scene, "solve_for": "k", "at": {"x": 1, "y": 0.5}})
            self.assertLessEqual(abs(answer["k"] - float(value)), answer["error"])
            self.assertLess(answer["error"], 1e-14*max(1, abs(float(value))))
            self.assertEqual(len(answer["all"]), 1)
            del scene["forces"][1], scene["coordinates"][1]
            scene["lagrangian"] = "x_dot^2/2"
            alone = self.ask("equilibria", {"system": scene, "solve_for": "k", "at": {"x": 1}})
            for held in (value, other):
                self.assertTrue(any(abs(one["k"] - float(held)) <= one["error"] for one in alone["all"]))
            self.assertEqual(len(alone["all"]) == 1, "several values, one or none" in str(alone.get("notes")))

    def test_a_square_that_does_not_vanish_there_refuses(self):
        for value, other in (("2.53", "2.5300001"), ("2.53", "2.53001"), ("-0.7", "-0.7000001"), ("1.25", "1.25")):
            scene = {"name": "two", "units": "none", "parameters": [{"name": "k", "default": "1"}],
                     "coordinates": [{"name": "x", "initial": "0.3"}, {"name": "y", "initial": "0.1"}],
                     "lagrangian": "(x_dot^2 + y_dot^2)/2",
                     "forces": [{"name": "f", "value": f"k - ({value})", "along": "x"},
                                {"name": "g", "value": f"(k - ({other}))^2", "along": "y"}]}
            answer = self.ask("equilibria", {"system": scene, "solve_for": "k", "at": {"x": 1, "y": 1}})
            self.assertEqual(len(answer["all"]), value == other, (value, other))

    def test_where_another_force_has_no_value_nothing_is_held(self):
        for f, g, held in (("sqrt(k) - 3", "k + 4", []), ("log(k)", "(k - 1)*(k + 4)", [1]), ("sqrt(k - 2*x) - 1", "k^2 - 9", [3]),
                           ("asin(k) - asin(0.5)", "(k - 0.5)*(k - 3)", [0.5]), ("sqrt(k)", "k*(k - 2)", [0])):
            for one, other in ((f, g), (g, f)):
                scene = {"name": "two", "units": "none", "parameters": [{"name": "k", "default": "1"}],
                         "coordinates": [{"name": "x", "initial": "0.3"}, {"name": "y", "initial": "0.1"}],
                         "lagrangian": "(x_dot^2 + y_dot^2)/2",
                         "forces": [{"name": "f", "value": one, "along": "x"}, {"name": "g", "value": other, "along": "y"}]}
                answer = self.ask("equilibria", {"system": scene, "solve_for": "k", "at": {"x": 1, "y": 1}})
                self.assertEqual([round(found["k"], 9) for found in answer["all"]], held, (one, other))

    def test_what_may_rest_anywhere_has_no_formula(self):
        """Its number may be that of a parameter."""
        ring = "m*(a_dot^2 + b_dot^2 + c_dot^2)/2 - k*((a - b)^2 + (b - c)^2 + (c - a)^2)/2"
        for scene in (lagrangian("free", "m - 1; k - 2", "y - 1", "m*y_dot^2/2"),
                      lagrangian("three", "m - 2; M - 3; R - 0.5", "x - 2; y - 3; z - 0.5", "m*(x_dot^2 + y_dot^2 + z_dot^2)/2"),
                      lagrangian("ring", "m - 2; k - 3", "a - 2; b - 2; c - 2", ring),
                      lagrangian("ring", "m - 2; k - 3", "a - 3; b - 3; c - 3", ring),
                      lagrangian("two", "m - 1; M - 2", "a - 2; b - 2", "m*a_dot^2/2 + M*b_dot^2/2 - (a - b)^2")):
            self.assertNotIn("exact", self.ask("modes", {"system": scene})["equilibrium"], scene["lagrangian"])
        held = lagrangian("held", "m - 1; k - 3; d - 2", "a - 2; b - 2", "m*(a_dot^2 + b_dot^2)/2 - k*(a - d)^2/2 - (a - b)^4 - (a - b)^2")
        exact = self.ask("modes", {"system": held})["equilibrium"]["exact"]
        self.assertEqual([exact[name]["text"] for name in "ab"], ["d", "d"])


if __name__ == "__main__":
    unittest.main()
