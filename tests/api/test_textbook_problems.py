"""Problems of textbooks that no scene of the service holds, each with the book's answer: as a formula that is equal
at random places, and as a number within its stated error."""

import pathlib
import random
import re
import sys
import unittest

import sympy

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from textbook_constraints import PROBLEMS as CONSTRAINTS  # noqa: E402
from textbook_fields import PROBLEMS as FIELDS  # noqa: E402
from textbook_machines import PROBLEMS as MACHINES  # noqa: E402
from textbook_oscillations import PROBLEMS as OSCILLATIONS  # noqa: E402
from textbook_places import PROBLEMS as PLACES  # noqa: E402
from textbook_rotations import PROBLEMS as ROTATIONS  # noqa: E402

PROBLEMS = MACHINES + OSCILLATIONS + ROTATIONS + CONSTRAINTS + FIELDS + PLACES
DIGITS = 30
EQUAL = sympy.Float("1e-22", DIGITS)  # what 30 digits leave of formulas of some dozen operations
ROUNDING = 4e-16  # of a number that is written in double precision
FUNCTIONS = {name: getattr(sympy, name) for name in ("sin", "cos", "tan", "sqrt", "exp", "log", "cosh", "sinh", "acos",
                                                     "atan", "asin", "pi", "sign")} | {"abs": sympy.Abs}


def formula(text):
    if isinstance(text, sympy.Expr):
        return text
    names = set(re.findall(r"[A-Za-z]\w*", text)) - set(FUNCTIONS)
    return sympy.sympify(text.replace("^", "**"), FUNCTIONS | {name: sympy.Symbol(name) for name in names}, rational=True)


def value(expression, places):
    return sympy.N(expression.subs(places), DIGITS)


class TextbookProblems(Service):
    def assert_same(self, found, book):
        """Two formulas, at random places."""
        found, book = formula(found), formula(book)
        draw = random.Random(3)
        for _ in range(4):
            places = {symbol: sympy.Rational(draw.randint(200, 1300), 1000)
                      for symbol in sorted(found.free_symbols | book.free_symbols, key=str)}
            expected = value(book, places)
            self.assertLess(abs(value(found, places) - expected), EQUAL*(1 + abs(expected)), (found, book))

    def number(self, scene, text):
        """What a formula is worth with the scene's own parameters."""
        places = {}
        for _ in scene["parameters"]:  # defaults may speak of each other
            for symbol in scene["parameters"]:
                places[sympy.Symbol(symbol["name"])] = formula(symbol["default"]).subs(places)
        return value(formula(text), places)

    def assert_number(self, scene, found, error, text):
        expected = self.number(scene, text)
        self.assertLessEqual(abs(found - expected), error + ROUNDING*abs(expected), (found, error, text))

    def accelerations(self, scene, expected):
        self.check_formulas(self.ask("equations", {"system": scene})["accelerations"], expected)

    def conserved(self, scene, expected):
        found = self.ask("equations", {"system": scene})["conserved"]
        self.check_formulas({quantity["name"]: quantity["value"] for quantity in found}, expected)

    def check_formulas(self, found, expected):
        for name, book in expected.items():
            self.assertIn(name, found)
            self.assert_same(found[name], book)

    def modes(self, scene, squares, fields=()):
        """omega^2 in the order of the answer, -rate^2 where it grows."""
        found = self.ask("modes", {"system": scene} | dict(fields))["modes"]
        self.assertEqual(len(found), len(squares))
        for mode, square in zip(found, squares):
            if mode["kind"] == "rigid":
                self.assertEqual(square, "0")
                continue
            grows = mode["kind"] == "growth"
            name = "rate" if grows else "omega"
            book = formula(f"-({square})" if grows else square)
            self.assert_number(scene, mode[name], mode["error"], sympy.sqrt(book))
            self.assertEqual(mode["exact"]["of"], f"{name}^2")
            related = [relation.split(" = ") for relation in mode["exact"]["assumes"] if " = " in relation]
            self.assert_same(mode["exact"]["text"], book.subs({name: formula(text) for name, text in related}))

    def holds(self, scene, unknown, at, book, rate2):
        """What holds a position, and how fast it oscillates about it."""
        found = self.ask("equilibria", {"system": scene, "solve_for": unknown, "at": at})
        self.assert_same(found["exact"]["text"], book)
        if rate2:
            self.assert_same(found["exact_rate2"]["text"], rate2)

    def equilibrium(self, scene, expected):
        """The only one."""
        found, = self.ask("equilibria", {"system": scene})["equilibria"]
        for name, book in expected.items():
            self.assert_number(scene, found["state"][name], found["error"][name], book)

    def critical(self, scene, parameter, first, last, books):
        found = self.ask("bifurcations", {"system": scene, "parameter": parameter, "from": first, "to": last})["critical"]
        self.assertEqual(len(found), len(books))
        for entry, book in zip(found, books):
            self.assert_number(scene, entry["value"], entry["error"], book)
            self.assert_same(entry["exact"]["text"], book)

    def turning(self, scene, expected, fields=()):
        found = self.ask("turning_points", {"system": scene} | dict(fields))
        for name, book in expected.items():
            self.assert_number(scene, found[name], found["error"][name], book)

    def amplitude(self, scene, expected, fields=()):
        """Turning points, as formulas too."""
        found = self.ask("turning_points", {"system": scene} | dict(fields))
        for name, book in expected.items():
            self.assert_number(scene, found[name], found["error"][name], book)
            self.assert_same(found["exact"][name]["text"], book)

    def motion(self, scene, t, expected, fields=()):
        found = self.ask("simulate", {"system": scene, "t_end": t, "samples": 2} | dict(fields))
        for name, book in expected.items():
            self.assert_number(scene, found["trajectory"][name][-1], found["accuracy"]["max_abs_error"][name], book)

    def ends(self, scene, reason, coordinate, book):
        """Where a motion ends. The error of the place is that of the rows, and of the time as fast as it moves there."""
        found = self.ask("simulate", {"system": scene, "t_end": 30, "samples": 3001})
        stop = found["stop"]
        self.assertEqual(stop["reason"], reason)
        error = found["accuracy"]["max_abs_error"][coordinate] + stop["error"]*abs(stop["state"][f"{coordinate}_dot"])
        self.assert_number(scene, stop["state"][coordinate], error, book)

    def test_have_their_books_answers(self):
        for title, scene, questions in PROBLEMS:
            for question, *expected in questions:
                with self.subTest(title, question=question):
                    getattr(self, question)(scene, *expected)

    def test_another_answer_would_be_seen(self):
        _, scene, _ = PROBLEMS[0]
        with self.assertRaises(AssertionError):
            self.accelerations(scene, {"x_ddot": "g*(m1*(m2 + m3) - 4*m2*m3)/(m1*(m2 + m3) + 3*m2*m3)"})


if __name__ == "__main__":
    unittest.main()
