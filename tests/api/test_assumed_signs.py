"""What formulas assume is enough: at any other parameters that satisfy it they are true, by 40 digits of mpmath."""

import pathlib
import random
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mpmath.mp.dps = 40
FUNCTIONS = {name: getattr(mpmath, name) for name in
             ("sqrt", "acos", "asin", "atan", "sin", "cos", "tan", "exp", "log", "pi", "cosh", "sinh")}
TRIALS = 60

# V of m*x_dot^2/2 - V, parameters, a start
POTENTIALS = [
    ("a*cos(x - c) + b*sin(x - c)", "m - 1; a - 1.5; b - 1; c - 0.5", 0.7),
    ("a*cos(x) + b*cos(x - c)", "m - 1.5; a - 0.5; b - 2; c - 0.5", 0.7),
    ("a*sin(x) - b*sin(x + c)", "m - 1.5; a - 2; b - 1; c - 0.5", 0.7),
    ("(a - b)*sin(x) + c*cos(x)", "m - 1; a - 2; b - 0.5; c - 1", 0.7),
    ("a*cos(x) + b*cos(x - c) + d*sin(x - c)", "m - 1; a - 0.5; b - 2; c - 0.5; d - 1", 0.7),
    ("(a - b)*exp(x) + (c - b)*exp(-x)", "m - 1; a - 2; b - 0.5; c - 1", 0.1),
    ("(a - b)*x^2/2 - c*x^4/4", "m - 1; a - 2; b - 0.5; c - 1", 0.9),
    ("-a*cos(x) - b*sin(x)^2/2", "m - 1; a - 1; b - 2.5", 0.9),
    ("(a*x - b)^2*(x - c)^2", "m - 1; a - 1; b - 2; c - 0.5", 0.5),
]


def value(text, numbers):
    return eval(text.replace("^", "**"), {"__builtins__": {}}, FUNCTIONS | numbers)  # noqa: S307


def is_assumed(form, numbers):
    sides = [assumed.replace(" = ", " == ") for assumed in form["assumes"]]
    return all(value(side, numbers) for side in sides)


def derivative(potential, order, place, numbers):
    return mpmath.diff(lambda x: value(potential, numbers | {"x": x}), place, order)


class AssumedSigns(Service):
    def rests(self, potential, parameters, start):
        system = lagrangian("well", parameters, f"x - {start}", f"m*x_dot^2/2 - ({potential})")
        return self.ask("equilibria", {"system": system})["equilibria"]

    def sets_of(self, parameters, *forms):
        """Parameters, small and large, at which all that the forms assume holds."""
        names, draw, found = [words.split()[0] for words in parameters.split(";")], random.Random(parameters), 0
        for _ in range(40 * TRIALS):
            numbers = {name: mpmath.mpf(10)**draw.uniform(-1, 1) for name in names}
            if all(is_assumed(form, numbers) for form in forms):
                found += 1
                yield numbers
            if found == TRIALS:
                return

    def test_where_all_that_a_place_and_its_rate_assume_holds_both_are_true(self):
        for potential, parameters, start in POTENTIALS:
            rates = 0
            for rest in self.rests(potential, parameters, start):
                place, rate2 = rest.get("exact", {}).get("x"), rest.get("exact_rate2")
                if place is None or rate2 is None:
                    continue
                rates += 1
                for numbers in self.sets_of(parameters, place, rate2):
                    x, claimed = value(place["text"], numbers), value(rate2["text"], numbers)
                    if not isinstance(x, mpmath.mpf):
                        continue  # no real place there: the formula says it itself
                    size = max(abs(claimed), 1e-6)
                    curvature = derivative(potential, 2, x, numbers) / numbers["m"]
                    self.assertLess(abs(derivative(potential, 1, x, numbers)), 1e-12 * size, (potential, place, numbers))
                    self.assertLess(abs(curvature - claimed), 1e-12 * size, (potential, place, rate2, numbers))
            self.assertGreater(rates, 0, potential)

    def test_the_side_on_which_an_angle_lies_is_assumed_in_words_of_the_parameters(self):
        for potential, parameters, start in POTENTIALS[:2]:
            for rest in self.rests(potential, parameters, start):
                expected = {"a*cos(x - c) + b*sin(x - c)": "a*cos(c) > b*sin(c)"}.get(potential, "a + b*cos(c) > 0")
                self.assertIn(expected, rest["exact_rate2"]["assumes"])
                self.assertIn(expected, rest["exact"]["x"]["assumes"])

    def test_a_place_lies_in_the_domain_of_its_coordinate(self):
        for text, needed in (("m*(x_dot^2 + b^2*x^2)/2 - k*(x - a)^2/2", "k > m*b^2"), ("m*x_dot^2/2 - k*x^2/2 + a*x - b*x", "a > b")):
            system = lagrangian("inside", "m - 1; k - 30; a - 3; b - 2", "x - 0.4", text)
            (free,) = self.ask("equilibria", {"system": system})["equilibria"]
            self.assertNotIn(needed, free["exact"]["x"]["assumes"])
            system["coordinates"][0]["domain"] = "> 0"
            (rest,) = self.ask("equilibria", {"system": system})["equilibria"]
            self.assertEqual(rest["exact"]["x"]["assumes"], free["exact"]["x"]["assumes"] + [needed])

    def test_a_place_assumes_that_roots_and_logarithms_in_the_forces_have_values_there(self):
        bifilar = "m*a^2*x_dot^2/6 + m*g*sqrt(h^2 - 4*a^2*sin(x/2)^2)"
        system = lagrangian("bifilar", "m - 1; g - 9.81; a - 0.2; h - 1", "x - 0.1", bifilar)
        system["coordinates"][0]["unit"] = "rad"
        hanging, turned = self.ask("equilibria", {"system": system})["equilibria"]
        self.assertEqual((turned["exact"]["x"]["text"], turned["exact"]["x"]["assumes"]), ("pi", ["a > 0", "h > 0", "h > 2*a"]))
        self.assertEqual(hanging["exact_rate2"]["assumes"], ["g > 0", "h > 0"])
        for potential, needed in (("k*(x - a)^2*log(h - x)", "h > a"), ("k*(x - a)^2*sqrt(h - x)", "h > a")):
            places = [rest["exact"]["x"] for rest in self.rests(potential, "m - 1; k - 1; a - 0.2; h - 1", 0.1) if "exact" in rest]
            (at_a,) = [place for place in places if place["text"] == "a"]
            self.assertIn(needed, at_a["assumes"], potential)

    def test_the_sign_that_a_root_or_a_size_took_is_assumed_where_its_parameter_cancels(self):
        for parameters, potential, cancelled in (
                ("m - 1; k - 3; q - 2; d - 0.5", "k/2*(sqrt(x^2 + d^2) - d)^2 + q*x^2/2", "d > 0"),
                ("m - 1; k - 3; q - 2; d - -0.5", "k/2*(sqrt(x^2 + d^2) + d)^2 + q*x^2/2", "d < 0"),
                ("m - 1; k - 3; l - 0.5", "k*x^2*sqrt(l^2)/l", "l > 0"), ("m - 1; k - 3; l - 0.5", "k*x^2*abs(l)/l", "l > 0"),
                ("m - 1; k - 3; q - 2; l - 0.5", "k*x^2*sign(l) + q*x^2", "l > 0")):
            with self.subTest(potential, parameters=parameters):
                system = lagrangian("well", parameters, "x - 0.1", f"m*x_dot^2/2 - ({potential})")
                (mode,), (rest,) = self.ask("modes", {"system": system})["modes"], self.ask("equilibria", {"system": system})["equilibria"]
                for form in (mode["exact"], rest["exact_rate2"]):
                    self.assertIn(cancelled, form["assumes"])
        (_, other) = self.rests("k*(x^2*a - x^3*abs(a))", "m - 1; k - 3; a - 0.5", 0.1)
        self.assertEqual(other["exact"]["x"], other["exact"]["x"] | {"text": "2/3", "assumes": ["a > 0"]})
        system = lagrangian("well", "m - 1; k - 3; q - 2; d - 0.5", "x - 0.1", "m*x_dot^2/2 - k/2*(sqrt(x^2 + d^2) - d)^2 - q*x^2/2")
        system["parameters"][3]["domain"] = "> 0"
        self.assertEqual(self.ask("modes", {"system": system})["modes"][0]["exact"]["assumes"], ["m > 0", "q > 0"])

    def test_the_sign_that_a_root_of_a_constraint_took_is_assumed(self):
        for curve in ("y - x^2*sqrt((a - b)^2)", "sqrt((a - b)^2)*y - (a - b)^2*x^2"):
            with self.subTest(curve):
                bowl = lagrangian("bowl", "m - 1; g - 9.81; a - 0.5; b - 0.2", "x - 0; y - 0", "m/2*(x_dot^2 + y_dot^2) - m*g*y",
                                  constraints=[{"name": "w", "expression": curve}])
                (rest,) = self.ask("equilibria", {"system": bowl})["equilibria"]
                self.assertEqual(rest["exact_rate2"]["text"], "2*g*(a - b)")
                self.assertIn("a > b", rest["exact_rate2"]["assumes"])

    def test_a_period_assumes_that_the_motion_comes_to_no_place_without_inertia(self):
        text = "m*cos(x)^2*x_dot^2/2 - (k*sin(x)^2/2 - n*sin(x))"
        asked = lagrangian("wire", "m - 1; k - 3; n - 0.2; c - 0.5", "x - c", text)
        form = self.ask("turning_points", {"system": asked})["exact"]["period"]
        self.assertEqual(form["text"], "2*pi*sqrt(m/k)")
        numbers = {"m": 1.18, "k": 3.6, "n": 0.68, "c": -1.04}  # from c on the speed grows without bound towards pi/2
        other = self.ask("turning_points", {"system": asked, "parameters": numbers})
        self.assertIsNone(other["period"])
        start = mpmath.sin(numbers["c"])
        numbers["h"] = (numbers["k"]*start/2 - numbers["n"])*start
        self.assertFalse(is_assumed({"assumes": [text for text in form["assumes"] if "(0)" not in text]}, numbers))

    def test_an_end_assumes_that_no_place_without_inertia_lies_before_it(self):
        wire = lagrangian("wire", "m - 1; k - 3", "x - 2 5", "m/x^2*x_dot^2/2 - k*(x - 2)^2/2")
        wire["coordinates"] = [{"name": "x", "initial": "2", "initial_rate": "5"}]
        self.assertIn("16*k > 25*m", self.ask("turning_points", {"system": wire})["exact"]["x_min"]["assumes"])

    def test_a_mode_assumes_that_its_place_exists(self):
        two = "m*(x_dot^2 + y_dot^2)/2"
        for text, parameters, coordinates, squares in (
                (f"{two} - a*cos(x - y) + b*cos(x) + b*cos(y)", "a - 2; b - 1.5; m - 1.2", "x - 0.27; y - -0.78",
                 {"b^2/(2*a*m)": ["a > 0", "b > 0", "m > 0", "2*a > b"]}),
                (f"{two} - a*x^4/4 + (k - b)*x^2/2 - y^2*k/2", "a - 2; b - 1.5; k - 2; m - 1", "x - 0.27; y - 0",
                 {"2*(k - b)/m": ["b > 0", "k > 0", "m > 0", "a > 0", "k > b"], "k/m": ["k > 0", "m > 0", "a > 0", "k > b"]}),
                (f"{two} - a*(x^4 + y^4)/4 + k*(x^2 + y^2)/2 - b*x*y", "a - 2; b - 0.5; k - 2; m - 1", "x - 0.27; y - -0.2",
                 {"2*(b + k)/m": ["b > 0", "k > 0", "m > 0", "a > 0"]}),
                ("m*x_dot^2/2 - k*x^2/2 + f*abs(x)", "k - 2; f - 0.2; m - 1", "x - 0.27", {"k/m": ["k > 0", "m > 0", "f > 0"]}),
                ("m*x_dot^2/2 - k*(x - l)^2/2 - (a - b)*x^2/2 - f*abs(x)", "m - 0.51; a - 2.04; b - 1.6; f - 0.96; k - 1.88; l - 1.85", "x - 0.61",
                 {"(a - b + k)/m": ["m > 0", "a > 0", "b > 0", "k > 0", "k*l > f", "a + k > b"]})):
            with self.subTest(text):
                system = lagrangian("wells", parameters, coordinates, text)
                modes = {mode["exact"]["text"]: mode["exact"]["assumes"] for mode in self.ask("modes", {"system": system})["modes"]}
                self.assertEqual(modes, modes | squares)
                for rest in self.ask("equilibria", {"system": system})["equilibria"]:
                    square = rest.get("exact_rate2", {"text": ""})
                    self.assertEqual(square.get("assumes"), squares.get(square["text"]))

    def test_what_the_parameters_decide_is_not_assumed(self):
        system = lagrangian("carts", "m - 1; M - 2; k - 3; g - 9.81; l - 0.5", "x - 0; th - 0",
                            "M*x_dot^2/2 + m*(x_dot^2 + 2*l*x_dot*th_dot*cos(th) + l^2*th_dot^2)/2 + m*g*l*cos(th) - k*x^2/2")
        for mode in self.ask("modes", {"system": system})["modes"]:
            self.assertEqual(mode["exact"]["assumes"], ["m > 0", "M > 0", "k > 0", "g > 0", "l > 0"])

    def test_an_oscillation_that_friction_could_end_assumes_that_it_does_not(self):
        system = lagrangian("dashpot", "m - 1; k - 3; c - 0.4", "x - 0", "m*x_dot^2/2 - k*x^2/2", dissipation="c*x_dot^2/2")
        self.assertIn("4*m*k > c^2", self.ask("modes", {"system": system})["modes"][0]["exact"]["assumes"])


if __name__ == "__main__":
    unittest.main()
