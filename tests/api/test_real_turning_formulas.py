"""Formulas of turning points and periods are real at all other parameters that satisfy what they assume, and the service's own numbers there are theirs."""

import pathlib
import random
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

FUNCTIONS = {name: getattr(mpmath, name) for name in ("sqrt", "acos", "log", "pi", "ellipk")} | {"abs": abs}

# V, its parameters, where x begins, which formula, and what makes it real
CASES = [
    ("k*(sqrt(x^2 + b^2) - l)^2/2", "m - 1; k - 1; b - 0.7; l - 1", "1", "x_min", "k*l > sqrt(2*k*h) + k*b"),
    ("k*(x^2 - a^2)^2/4", "m - 1; k - 1; a - 0.9", "1", "x_min", "2*k*a^2 > k"),
    ("k*(x^2 - a^2)^2 + b*(x^2 - a^2)", "m - 1; k - 1; a - 1; b - 0.7", "1", "x_min", "2*k*a^2 > k + b"),
    ("k*(x^2 - a^2)^2 + b*(x^2 - a^2)", "m - 1; k - 1; a - 1; b - 0.7", "1", "period", "2*k*a^2 > k + b"),
    ("k*abs(a - b)*x^2", "m - 1; k - 1; a - 1; b - 0.7", "1.1 0.4", "x_max", "a > b"),
    ("k*abs(x - a) + b*x^2", "m - 1; k - 1; a - 1; b - 0.7", "1.7", "period", "h > a^2*b"),
    ("-A*tanh(a*x) - B/cosh(a*x)^2", "m - 1; A - 1; B - 2; a - 0.7", "0.1", "period", "A + h < 0"),
]


def value(text, numbers):
    return eval(text.replace("^", "**"), {"__builtins__": {}}, FUNCTIONS | numbers)  # noqa: S307


def others(seed, names, count):
    draw = random.Random(seed)
    for _ in range(count):
        yield {name: round(draw.choice([0.2, 0.5, 1, 2, 3])*draw.choice([1, 1.1, 0.9]), 3) for name in names}


def is_said(assumed, numbers, answer):
    if assumed.startswith("ellipk"):
        return True
    if "(0)" in assumed:
        return not assumed.endswith(("_max", "_min")) or assumed.endswith(answer["initial_is"])
    return value(assumed, numbers)


class RealTurningFormulas(Service):
    def answer(self, potential, parameters, start, more=None):
        system = lagrangian("real", parameters, "x - " + start, f"m*x_dot^2/2 - ({potential})")
        return self.ask("turning_points", {"system": system, "parameters": more or {}})

    def test_they_assume_what_makes_them_real(self):
        for potential, parameters, start, name, needed in CASES:
            form = self.answer(potential, parameters, start)["exact"][name]
            self.assertIn(needed, form["assumes"], (potential, form))

    def test_they_are_the_numbers_at_other_parameters(self):
        checked = 0
        for potential, parameters, start, name, _ in CASES:
            form = self.answer(potential, parameters, start)["exact"][name]
            names = [words.split()[0] for words in parameters.split(";")]
            for numbers in others(potential, names, 8):
                answer = self.answer(potential, parameters, start, numbers)
                known = numbers | answer["constants"]
                if not all(is_said(assumed, known, answer) for assumed in form["assumes"]):
                    continue
                checked += 1
                self.assertAlmostEqual(value(form["text"], known), answer[name], places=7, msg=(potential, form, numbers))
        self.assertGreater(checked, 10)


if __name__ == "__main__":
    unittest.main()
