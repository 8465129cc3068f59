"""Formulas of turning points that take a side of a kink at the start say which, and so do places of rest: at other parameters that satisfy what they
assume, the service's own numbers are theirs."""

import pathlib
import random
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

FUNCTIONS = {name: getattr(mpmath, name) for name in ("sqrt", "sin", "cos", "exp", "pi")} | {"abs": abs, "sign": mpmath.sign}
PARAMETERS = "m - 1; k - 1; a - 1; b - 0.7"
DEFAULTS = {"m": 1, "k": 1, "a": 1, "b": 0.7}

# V, where x begins, h, and on which side that is
CASES = [
    ("k*abs(x - a) + b*x", "1.7", "1.7*b + k*(1.7 - a)", "a < 1.7"),
    ("k*abs(x - a) + b*x", "0.3", "0.3*b + k*(a - 0.3)", "a > 0.3"),
    ("k*abs(x - a) + b*x", "1.7 0.5", "1/8*(m + 68/5*b) + k*(1.7 - a)", "a < 1.7"),
    ("k*sqrt((x - a)^2) + b*x^2", "1.7", "2.89*b + k*(1.7 - a)", "a < 1.7"),
    ("k*sign(x - a)*(x - a)^2 + b*x^2", "1.7", "2.89*b + k*(a - 1.7)^2", "a < 1.7"),
    ("k*abs(x^2 - a^2) + b*x^2", "1.7", "2.89*b + k*(2.89 - a^2)", "a < 1.7"),
    ("k*abs(sin(x) - a) + b*x", "0.3", None, "a > sin(0.3)"),
    ("k*abs(a - b)*x^2", "1.7", "2.89*k*(a - b)", "a > b"),
    ("k*sqrt((a - b)^2)*x^2", "1.7", "2.89*k*(a - b)", "a > b"),
    ("k*(a + b - abs(a - b))*x^2", "1.7", "5.78*k*b", "a > b"),
]


def value(text, numbers):
    return eval(text.replace("^", "**").replace("(0)", ""), {"__builtins__": {}}, FUNCTIONS | numbers)  # noqa: S307


def others(seed, count):
    draw = random.Random(seed)
    for _ in range(count):
        yield {name: round(draw.choice([0.2, 0.5, 1, 2, 3])*draw.choice([1, 1.1, 0.9]), 3) for name in DEFAULTS}


def holds(form, numbers):
    return all(value(assumed.replace(" = ", " == "), numbers) for assumed in form["assumes"] if "(0)" not in assumed)


class SidesOfStarts(Service):
    def answer(self, potential, start, more=None):
        system = lagrangian("kinked", PARAMETERS, "x - " + start, f"m*x_dot^2/2 - ({potential})")
        return self.ask("turning_points", {"system": system, "parameters": more or {}})

    def test_the_energy_says_on_which_side_the_motion_begins(self):
        for potential, start, h, side in CASES:
            form = self.answer(potential, start)["exact"]["h"]
            self.assertIn(side, form["assumes"], (potential, form))
            if h is not None:
                self.assertEqual(form["text"], h)

    def test_the_equation_says_so_where_it_takes_one(self):
        for potential, start, _, side in CASES[:7]:
            form = self.answer(potential, start)["exact"]["equation"]
            self.assertIn(side, form["assumes"], (potential, form))
        form = self.answer("k*abs(a - b)*x^2", "1.7")["exact"]["equation"]  # is 0 there whatever the sign
        self.assertNotIn("a > b", form["assumes"])

    def test_the_energy_is_that_at_other_parameters(self):
        checked = 0
        for potential, start, _, _ in CASES:
            form = self.answer(potential, start)["exact"]["h"]
            for numbers in others(potential + start, 6):
                if holds(form, numbers):
                    checked += 1
                    found = self.answer(potential, start, numbers)["constants"]["h"]
                    self.assertAlmostEqual(float(value(form["text"], numbers)), found, msg=(potential, form, numbers))
        self.assertGreater(checked, 15)

    def test_a_place_of_rest_lies_on_a_side_of_the_kink(self):
        """The force of k*|x|^(3/2) balances b only beyond a."""
        system = lagrangian("beyond", "m - 1.13; k - 0.55; a - 0.565; b - 2.7", "x - 0.3", "m*x_dot^2/2 - k*abs(x)^(3/2) + b*abs(x - a)")
        places = self.ask("equilibria", {"system": system})["equilibria"]
        forms = [place["exact"]["x"] for place in places if place["state"]["x"] > 1]
        self.assertEqual([(form["text"], form["assumes"]) for form in forms], [("4*b^2/(9*k^2)", ["k > 0", "b > 0", "4*b^2 > 9*k^2*a"])])


if __name__ == "__main__":
    unittest.main()
