"""Places of rest that one equation gives: a square root that goes when it is squared, a power that is not whole, a quadratic
in a cosine; parameters under a sine or a root; chains of equal masses."""

import math
import pathlib
import random
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import DOWN, DOWN_3D, G, lagrangian, particle, scene  # noqa: E402

mpmath.mp.dps = 30
FUNCTIONS = {name: getattr(mpmath, name) for name in
             ("sqrt", "acos", "asin", "atan", "sin", "cos", "tan", "exp", "log", "pi")}
LOAD = "m - 1; T - 20; a - 0.5; g - 9.81"
AB = "a - 1; b - 2.5"
# name, parameters, start, Lagrangian, the place, omega^2
PLACES = [
    ("weight_on_a_string", LOAD, "y - 0.1", "m*y_dot^2/2 + m*g*y - 2*T*sqrt(a^2 + y^2)", "m*a*g/sqrt(4*T^2 - m^2*g^2)",
     "(4*T^2 - m^2*g^2)^(3/2)/(4*m*T^2*a)"),
    ("root_of_one", AB, "x - 0.1", "x_dot^2/2 + a*x - b*sqrt(1 + x^2)", "a/sqrt(b^2 - a^2)", "(b^2 - a^2)^(3/2)/b^2"),
    ("power_of_three_halves", AB, "x - 0.1", "x_dot^2/2 - 2/3*a*x^(3/2) + b*x", "b^2/a^2", "a^2/(2*b)"),
    ("root_and_logarithm", AB, "x - 20", "x_dot^2/2 - a*sqrt(x) + b*log(x)", "4*b^2/a^2", "a^4/(32*b^3)"),
    ("ball_on_a_gas", "m - 0.02; C - 0.3; g - 9.81", "x - 1", "m*x_dot^2/2 - m*g*x - 5/2*C*x^(-2/5)", "(C/(m*g))^(5/7)",
     "7/5*g*(m*g/C)^(5/7)"),
    ("two_cosines", "a - 3; b - 2", "x - 0.5", "x_dot^2/2 + a*cos(x) - b*cos(2*x)", "acos(a/(4*b))", "4*b - a^2/(4*b)"),
    ("sixth_power", "a - 1; b - 2; c - 0.7", "x - 0.6", "x_dot^2/2 + a*x^2/2 - b*x^4/4 - c*x^6/6",
     "sqrt((sqrt(b^2 + 4*a*c) - b)/(2*c))", "4*a + b*(b - sqrt(b^2 + 4*a*c))/c"),
    ("weight_on_a_charge", "m - 0.7; g - 9.81; q - 2", "x - 0.6", "m*x_dot^2/2 - m*g*x - q/x", "sqrt(q/(m*g))",
     "2*g*sqrt(m*g/q)"),
    ("weight_on_a_dipole", "m - 0.7; g - 9.81; q - 2", "x - 0.6", "m*x_dot^2/2 - m*g*x - q/x^2", "(2*q/(m*g))^(1/3)",
     "3/2*g*(4*m*g/q)^(1/3)"),
]


# name, parameters, start, Lagrangian, solved for, the value
HELD = [
    ("cube_of_the_unknown", "a - 1; b - 2", "x - 1", "x_dot^2/2 - (a^3*x^2 - 2*b*x^3)", "a", "(3*b*x)^(1/3)"),
    ("logarithm_of_the_unknown", "a - 2; b - 3", "x - 1", "x_dot^2/2 - (log(a)*x^2 - b*x)", "a", "exp(b/(2*x))"),
]


def carts(n, left=True, right=True):
    """A chain of n equal masses with equal springs between them, and to walls."""
    gaps = [f"(q{i + 1} - q{i})^2" for i in range(n - 1)] + ["q0^2"]*left + [f"q{n - 1}^2"]*right
    return lagrangian("carts", "m - 1.3; k - 3", "; ".join(f"q{i} - 0" for i in range(n)),
                      " + ".join(f"m*q{i}_dot^2/2" for i in range(n)) + f" - k/2*({' + '.join(gaps)})")


def value(text, **numbers):
    names = {name: mpmath.mpf(x) if isinstance(x, str) else x for name, x in numbers.items()}
    return eval(text.replace("^", "**"), {"__builtins__": {}}, FUNCTIONS | names)  # noqa: S307


def numbers_of(parameters):
    return {words.split()[0]: words.split()[-1] for words in parameters.split(";")}


class Places(Service):
    def check(self, form, number, expected, numbers):
        """As short as a book's, and right."""
        self.assertLessEqual(len(form["text"]), len(expected) + 4, form["text"])
        for text in (form["text"], expected):
            self.assertAlmostEqual(float(value(text, **numbers))/number, 1, 12, text)

    def test_one_equation_gives_the_place(self):
        for name, parameters, start, text, place, square in PLACES:
            with self.subTest(name):
                x = start.split()[0]
                answer = self.ask("modes", {"system": lagrangian(name, parameters, start, text)})
                numbers = numbers_of(parameters)
                self.check(answer["equilibrium"]["exact"][x], answer["equilibrium"]["state"][x], place, numbers)
                self.check(answer["modes"][0]["exact"], answer["modes"][0]["omega"]**2, square, numbers)

    def test_other_values_keep_the_formula_right(self):
        source = random.Random(16)
        for name, parameters, start, text, place, _ in PLACES:
            drawn = {key: str(round(float(x)*source.uniform(0.9, 1.1), 5)) for key, x in numbers_of(parameters).items()}
            system = lagrangian(name, "; ".join(f"{key} - {x}" for key, x in drawn.items()), start, text)
            answer = self.ask("modes", {"system": system})
            with self.subTest(name, **drawn):
                x = start.split()[0]
                self.check(answer["equilibrium"]["exact"][x], answer["equilibrium"]["state"][x], place, drawn)

    def test_a_parameter_under_a_sine_or_a_root_is_solved_for(self):
        for name, parameters, start, text, unknown, expected in HELD:
            with self.subTest(name):
                system = lagrangian(name, parameters, start, text)
                answer = self.ask("equilibria", {"system": system, "solve_for": unknown, "at": {"x": 1.2}})
                self.check(answer["exact"], answer[unknown], expected, numbers_of(parameters) | {"x": "1.2"})
        incline = scene("weight_over_a_pulley", f"m kg 3; M kg 2; al rad 0.4; {G}", "x m", gravity=DOWN,
                        bodies=[particle("m", "x*cos(al)", "-x*sin(al)"), particle("M", "0", "x")])
        answer = self.ask("equilibria", {"system": incline, "solve_for": "al", "at": {}})
        self.assertEqual(answer["exact"]["text"], "asin(M/m)")
        self.assertAlmostEqual(answer["al"], math.asin(2/3), 14)
        bank = scene("banked_curve", f"m kg 1; r m 2; W rad/s 1.5; al rad 0.3; {G}", "s m 0", gravity=DOWN_3D,
                     bodies=[particle("m", "(r + s*cos(al))*cos(W*t)", "(r + s*cos(al))*sin(W*t)", "s*sin(al)")])
        answer = self.ask("equilibria", {"system": bank, "solve_for": "al", "at": {"s": 0}})
        self.assertEqual(answer["exact"]["text"], "atan(r*W^2/g)")

    def test_a_mass_of_zero_holds_nothing(self):
        pendulum = scene("pendulum", f"m kg 1; l m 0.4; {G}", "th rad 0.5", gravity=DOWN,
                         bodies=[particle("m", "l*sin(th)", "-l*cos(th)")])
        for unknown in ("m", "l"):
            answer = self.ask("equilibria", {"system": pendulum, "solve_for": unknown, "at": {"th": 0.5}})
            self.assertIsNone(answer[unknown])
            self.assertEqual(answer["reason"], f"th is not in balance at th = 0.5, whatever {unknown} is.")
        answer = self.ask("equilibria", {"system": pendulum, "solve_for": "g", "at": {"th": 0.5}})
        self.assertEqual(answer["g"], 0)

    def test_rates_of_chains_are_sines(self):
        for n, left, right in [(3, True, False), (6, True, True), (7, True, True), (8, True, True), (7, False, False)]:
            with self.subTest(n=n, left=left, right=right):
                modes = self.ask("modes", {"system": carts(n, left, right)})["modes"]
                for j, mode in enumerate(modes, start=1 if left else 0):
                    if mode["kind"] == "rigid":
                        continue
                    angle = j/(n + 1) if left and right else (2*j - 1)/(2*n + 1) if left else j/n
                    true = 2*math.sqrt(3/1.3)*math.sin(angle*math.pi/2)
                    self.assertAlmostEqual(mode["omega"], true, 12)
                    self.assertAlmostEqual(float(value(mode["exact"]["text"], m="1.3", k="3")), true**2, 11)
        text = self.ask("modes", {"system": carts(6)})["modes"][0]["exact"]["omega"]["text"]
        self.assertEqual(text, "2*sin(1/14*pi)*sqrt(k/m)")

    def test_critical_damping_is_called_so(self):
        for b in ("6", "2*sqrt(k*m)"):
            system = scene("damped_oscillator", f"m kg 1; k N/m 9; b kg/s {b.replace(' ', '')}", "x m 0.1",
                           bodies=[particle("m", "x", "0")], potential="k*x^2/2", dissipation="b*x_dot^2/2")
            modes = self.ask("modes", {"system": system})["modes"]
            self.assertTrue(modes)
            for mode in modes:
                self.assertEqual((mode["kind"], mode["exact"]["text"]), ("decay", "b/(2*m)"))
                self.assertIn("k/m = b^2/(4*m^2)", mode["exact"]["assumes"])

    def test_bodies_that_two_others_draw_rest_at_the_corners_of_a_triangle(self):
        answer = self.ask("modes", {"system": "restricted_three_body", "parameters": {"mu": "0.02"}})
        self.assertEqual(answer["equilibrium"]["exact"]["x"]["text"], "1/2 - mu")
        self.assertEqual(answer["equilibrium"]["exact"]["y"]["text"], "1/2*sqrt(3)")
        self.assertEqual(len(answer["modes"]), 2)
        for mode in answer["modes"]:
            self.assertAlmostEqual(float(value(mode["exact"]["text"], mu="0.02")), mode["omega"]**2, 12)

    def test_a_force_that_vanishes_where_it_is_asked_leaves_the_value_to_the_others(self):
        """k (x - 1) at x = 1 whatever k is, and k sin(x) at pi."""
        spring = lagrangian("spring", "k - 10; g - 3", "x - 0.3; y - 0.3", "(x_dot^2 + y_dot^2)/2 - (k*(x - 1)^2/2 + k*y^2/2 + g*y)")
        waves = lagrangian("waves", "k - 1; g - 3", "x - 0.3; y - 0.3", "(x_dot^2 + y_dot^2)/2 - (-k*cos(x) + k*y^2/2 + g*y)")
        for scene, unknown, at, value, text, held in ((spring, "k", {"x": 1, "y": -1.5}, 2, "-g/y", "x = 1"), (spring, "g", {"x": 1, "y": -1.5}, 15, "-k*y", "x = 1"),
                                                      (waves, "k", {"x": "pi", "y": -0.5}, 6, "-g/y", "x = 3.14159265358979")):
            with self.subTest(unknown=unknown, at=at):
                found = self.ask("equilibria", {"system": scene, "solve_for": unknown, "at": at})
                self.assertLessEqual(abs(found[unknown] - value), found["error"] + 1e-15*value)
                self.assertEqual(found["exact"]["text"], text)
                self.assertIn(held, found["exact"]["assumes"])
        for scene, unknown, at in ((lagrangian("well", "a - 1", "x - 0.3", "x_dot^2/2 - a*(x^2 - 1)^2/4"), "a", {"x": 1}),
                                   (lagrangian("line", "k - 1", "x - 0.3", "x_dot^2/2 - k*(x - 0.7)^2/2"), "k", {"x": 0.7}),
                                   ("whirling_pendulum", "Omega", {"theta": "pi"})):
            with self.subTest(unknown=unknown, at=at):
                body = {"system": scene, "solve_for": unknown, "at": at}
                if scene == "whirling_pendulum":
                    body["parameters"] = {"R": 0}
                found = self.ask("equilibria", body)
                self.assertIsNone(found[unknown])
                self.assertIn("Every value does", found["reason"])
        series = lagrangian("series", "k - 1; K - 2; g - 3", "x - 0.3; y - 0.3", "(x_dot^2 + y_dot^2)/2 - (k*(y - x - 1)^2/2 + K*x^2/2 - g*y)")
        found = self.ask("equilibria", {"system": series, "solve_for": "k", "at": {"x": 1.5, "y": 2.5}})
        self.assertIn("x is not in balance", found["reason"])

    def test_a_force_that_vanishes_there_holds_the_coordinate_that_makes_it(self):
        for potential, unknown, text in (("exp(k)*(x - 1)^2/2 + k*y^2/2 + g*y", "k", "-g/y"), ("cos(k)*(x - 1)^2/2 + k*y^2/2 + g*y", "k", "-g/y"),
                                         ("exp(k)*(x - 1)^2/2 + exp(k)*y^2/2 + g*y", "k", "log(-g/y)"),
                                         ("k*(sqrt((x - 1)^2 + y^2) - l)^2/2 + g*y", "g", None)):
            scene = lagrangian("spring", "k - 10; l - 1; g - 3", "x - 0.3; y - 0.3", f"(x_dot^2 + y_dot^2)/2 - ({potential})")
            with self.subTest(potential):
                found = self.ask("equilibria", {"system": scene, "solve_for": unknown, "at": {"x": 1, "y": -1.5}})
                value = {"-g/y": 2, "log(-g/y)": math.log(2), None: 5}[text]
                self.assertLessEqual(abs(found[unknown] - value), found["error"] + 1e-15)
                self.assertEqual(found["exact"]["text"] if text else None, text)
                self.assertIn("x = 1", found["exact"]["assumes"])
                self.assertNotIn("y = -1.5", found["exact"]["assumes"])

    def test_a_value_of_zero_holds_where_it_is_asked(self):
        tilted = lagrangian("tilted", "k - 10; g - 3", "x - 0.3; y - 0.3", "(x_dot^2 + y_dot^2)/2 - (k*(x - 1)^2/2 + k*y^2/2 + g*(y - 1)^2)")
        found = self.ask("equilibria", {"system": tilted, "solve_for": "k", "at": {"x": 1, "y": 1}})
        self.assertEqual((found["k"], found["exact"]["text"], found["exact"]["assumes"]), (0, "0", ["x = 1", "y = 1"]))

    def test_a_small_power_is_no_force_that_vanishes(self):
        """k (x - 1)^5 at x = 1.001, which is 1e-15 of itself and holds for no k but 0."""
        for force, at in (("-k*(x - 1)^5", "1.001"), ("-k*(x - 1)^3", "1.00001"), ("-k*x^5", "1e-20"), ("-k*(x - 100000)", "100000.00000000001")):
            line = lagrangian("line", "k - 10; g - 3", "x - 0.3; y - 0.3", "(x_dot^2 + y_dot^2)/2",
                              forces=[{"name": "f", "value": force, "along": "x"}, {"name": "h", "value": "-k*y - g", "along": "y"}])
            with self.subTest(force=force, at=at):
                found = self.ask("equilibria", {"system": line, "solve_for": "k", "at": {"x": at, "y": -1.5}})
                if "100000" in force:  # as near as the next double
                    self.assertIn("x = 100000", found["exact"]["assumes"])
                    continue
                self.assertIsNone(found["k"])
                self.assertIn("No single value", found["reason"])
        turned = lagrangian("line", "k - 10; g - 3", "y - 0.3; x - 0.3", "(x_dot^2 + y_dot^2)/2",
                            forces=[{"name": "f", "value": "-k*(x - 1)^5", "along": "x"}, {"name": "h", "value": "-k*y - g", "along": "y"}])
        self.assertIsNone(self.ask("equilibria", {"system": turned, "solve_for": "k", "at": {"x": "1.001", "y": -1.5}})["k"])
        well = lagrangian("well", "k - 10", "x - 0.3", "x_dot^2/2 - k*(x - 1)^6/6")
        found = self.ask("equilibria", {"system": well, "solve_for": "k", "at": {"x": "1.001"}})
        self.assertEqual((found["k"], found["exact"]["assumes"]), (0, []))


if __name__ == "__main__":
    unittest.main()
