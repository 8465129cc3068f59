"""What formulas of critical values and of solutions assume is enough: put back at any other parameters that satisfy it, by 40 digits of mpmath, the
forces vanish, and at a critical value their slope, too."""

import pathlib
import random
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mpmath.mp.dps = 40
FUNCTIONS = {name: getattr(mpmath, name) for name in ("sqrt", "sin", "cos", "exp", "log", "pi")}
SETS = 30

# V of m*x_dot^2/2 - V, parameters, start, the parameter and its range, where the fold or fork is, what is needed
CRITICAL = [
    ("a*exp(2*x)/2 - (b - c)*exp(x) + d*x", "m - 1; a - 2; b - 3; c - 1; d - 0.2", 0.4, ("d", 0, 2), "log((b - c)/(2*a))", "b > c"),
    ("p*x + a*x^2/2 - 2*(b - c)*x^1.5/3", "m - 1; a - 2; b - 3; c - 1; p - 0.1", 0.4, ("p", 0, 2), "((b - c)/(2*a))^2", "b > c"),
    ("k*(sqrt(x^2 + h^2) - l + d)^2/2", "m - 1; k - 20; l - 1; d - 0.2; h - 0.4", 0.1, ("h", 0.1, 2), "0", "l > d"),
    ("k*(x - c)^2/2 + I*log(d - x)", "m - 1; k - 10; d - 1; I - 0.5; c - 0.3", 0.1, ("I", 0.1, 6), "(c + d)/2", "d > c"),
    ("k*x^2/2 + I*log(d - x)", "m - 1; k - 10; d - 1; I - 0.5", 0.1, ("I", 0.1, 6), "d/2", None),
]

# V, parameters, the position, what is solved for, what is needed
SOLVED = [
    ("k*(sqrt(x^2 + h^2) - l + d)^2/2", "m - 1; k - 20; l - 1; d - 0.2; h - 0.4", 0.3, "h", "l > d", "l^2 + d^2 > x^2 + 2*l*d"),
    ("sqrt(a)*x^2/2 - (b - c)*x", "m - 1; a - 2; b - 1; c - 0.4", 0.3, "a", "b > c"),
    ("k*(sqrt(x^2 + a^2) - l)^2/2 - F*x", "m - 1; k - 20; a - 1; F - 3; l - 0.4", 0.3, "a", "k*x > F",
     "2*k*F*x + k^2*l^2 > k^2*x^2 + F^2"),
    ("a*x^2/2 - (b - c)*x", "m - 1; a - 2; b - 1; c - 0.4", 0.3, "a", None),
]


def value(text, numbers):
    return eval(text.replace("^", "**"), {"__builtins__": {}}, FUNCTIONS | numbers)  # noqa: S307


def slope(potential, order, numbers):
    return mpmath.diff(lambda x: value(potential, numbers | {"x": x}), numbers["x"], order)


def sets(parameters, unknown, form, more=()):
    """Parameters, small and large, at which all that is assumed holds."""
    names = [words.split()[0] for words in parameters.split(";") if words.split()[0] != unknown] + list(more)
    draw = random.Random(parameters)
    for _ in range(40*SETS):
        numbers = {name: mpmath.mpf(10)**draw.uniform(-1, 1)*(draw.choice([-1, 1]) if name in more else 1) for name in names}
        if all(value(assumed, numbers) for assumed in form["assumes"]):
            yield numbers


class SignsOfSolutions(Service):
    def check(self, form, needed, where):
        signs = [assumed for assumed in form["assumes"] if not assumed.endswith(" > 0")]
        self.assertEqual(signs, [one for one in needed if one], where)

    def test_a_critical_value_is_one_wherever_its_signs_hold(self):
        for potential, parameters, start, (name, lower, upper), place, needed in CRITICAL:
            system = lagrangian("fold", parameters, f"x - {start}", f"m*x_dot^2/2 - ({potential})")
            found = self.ask("bifurcations", {"system": system, "parameter": name, "from": lower, "to": upper})
            form = next(one["exact"] for one in found["critical"] if one.get("exact"))
            self.check(form, [needed], potential)
            for _, numbers in zip(range(SETS), sets(parameters, name, form)):
                numbers |= {"x": mpmath.mpf(value(place, numbers)), name: value(form["text"], numbers)}
                for order in (1, 2):
                    self.assertLess(abs(slope(potential, order, numbers)), 1e-12*sum(map(abs, numbers.values()))**4, (potential, numbers))

    def test_a_solution_is_one_wherever_its_signs_hold(self):
        for potential, parameters, place, name, *needed in SOLVED:
            system = lagrangian("solved", parameters, f"x - {place}", f"m*x_dot^2/2 - ({potential})")
            found = self.ask("equilibria", {"system": system, "solve_for": name, "at": {"x": place}})
            form = found["all"][0]["exact"]
            self.check(form, needed, potential)
            for _, numbers in zip(range(SETS), sets(parameters, name, form, ["x"])):
                solution = value(form["text"], numbers)
                self.assertIsInstance(solution, mpmath.mpf, (potential, form, numbers))
                self.assertLess(abs(slope(potential, 1, numbers | {name: solution})), 1e-12, (potential, form, numbers))

    def test_the_square_of_the_rate_there_has_no_square_under_a_root(self):
        for potential, parameters, place, name, *_ in SOLVED:
            system = lagrangian("solved", parameters, f"x - {place}", f"m*x_dot^2/2 - ({potential})")
            form, rate2 = (self.ask("equilibria", {"system": system, "solve_for": name, "at": {"x": place}})["all"][0][key] for key in ("exact", "exact_rate2"))
            self.assertNotIn("sqrt", rate2["text"])
            for _, numbers in zip(range(SETS), sets(parameters, name, rate2, ["x"])):
                square = slope(potential, 2, numbers | {name: value(form["text"], numbers)})/numbers["m"]
                self.assertLess(abs(value(rate2["text"], numbers) - square), 1e-12*(1 + abs(square)), (potential, rate2, numbers))


if __name__ == "__main__":
    unittest.main()
