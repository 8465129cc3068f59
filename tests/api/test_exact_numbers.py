"""A number in a request is the decimal that was typed. Answers are held, without any slack, against rational
arithmetic and 60 digits of mpmath: the same number as a JSON number, a text with a unit, in a query, in a scene's
expression and as a scene's default."""

import fractions
import json
import pathlib
import random
import re
import sys
import unittest
import urllib.parse

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

CASES = 500
mpmath.mp.dps = 60


def typed(rng, low, high, most_digits=24):
    """A decimal between two numbers, of 1 to so many digits behind the point, as text."""
    digits = rng.randint(1, most_digits)
    scaled = rng.randint(int(low * 10**digits) + 1, int(high * 10**digits))
    text = f"{abs(scaled):0{digits + 1}d}"
    return ("-" if scaled < 0 else "") + text[:-digits] + "." + text[-digits:]


def as_number(text):
    """A text that raw() turns into a JSON number of just these digits."""
    return f"@{text}@"


def raw(body):
    return re.sub(r'"@([^@]*)@"', r"\1", json.dumps(body))


def exactly(text):
    value = fractions.Fraction(text)
    return mpmath.mpf(value.numerator) / value.denominator


def line(potential, parameters=()):
    """A particle on a line: m x'' = -dV/dx."""
    return {"name": "line", "title": "A particle on a line",
            "parameters": [{"name": "m", "unit": "kg", "default": "1", "domain": "> 0"}, *parameters],
            "coordinates": [{"name": "x", "unit": "m"}],
            "points": [{"name": "p", "components": ["x", "0"]}],
            "bodies": [{"kind": "particle", "name": "p", "mass": "m", "position": "p"}], "potential": potential}


def plain(potential, parameters=()):
    """The same in numbers without units, J apart."""
    return {"name": "plain", "title": "A point on a line",
            "parameters": [parameter("I", "kg*m^2"), parameter("J", "J"), *parameters],
            "coordinates": [{"name": "x", "unit": "1"}], "lagrangian": f"I*x_dot^2/2 - J*({potential})"}


def parameter(name, unit="1", default="1"):
    return {"name": name, "unit": unit, "default": default}


BEADS = lagrangian("two_beads", "m - 1; k - 2", "a - 0.1; b - 0.3", "m/2*(a_dot^2 + b_dot^2) - k/2*(b - a)^2")
TURNTABLE = lagrangian("pendulum_on_a_turntable", "m - 1; l - 1; g - 9.81", "a - 0.1; b - 0.3",
                       "m*l^2/2*(a_dot^2 + sin(b)^2*a_dot^2 + b_dot^2) + m*g*l*cos(b)")


class ExactNumbers(Service):
    def answer_of(self, endpoint, body):
        response = self.raw("POST", "/v1/" + endpoint, raw(body))
        self.assertEqual(response.status, 200, response.data[:500])
        return json.loads(response.data)

    def holds(self, value, error, exact, what):
        self.assertIsNotNone(value, what)
        self.assertLessEqual(abs(mpmath.mpf(value) - exact), mpmath.mpf(error), what)

    def said(self, rng, name, text):
        """The same decimal in one of the ways in which a parameter can be given."""
        way = rng.choice(("number", "text", "default"))
        if way == "default":
            return parameter(name, default=rng.choice((text, as_number(text)))), {}
        return parameter(name), {name: as_number(text) if way == "number" else text}

    def test_a_literal_and_a_parameter_of_the_same_digits_agree(self):
        for small, apart in (("1e-12", "1e-6"), ("1e-8", "1e-4")):
            literal = {"system": plain(f"(x - 100.1)^3/3 - {small}*x")}
            given = {"system": plain("(x - a)^3/3 - e*x", [parameter("a"), parameter("e")]),
                     "parameters": {"a": as_number("100.1"), "e": as_number(small)}}
            by_default = {"system": plain("(x - a)^3/3 - e*x", [parameter("a", default="100.1"),
                                                                parameter("e", default=as_number(small))])}
            for body in (literal, given, by_default):
                found = self.answer_of("equilibria", body)["equilibria"]
                for sign in (-1, 1):
                    exact = exactly("100.1") + sign * mpmath.mpf(apart)
                    self.assertTrue(any(abs(state["state"]["x"] - exact) <= state["error"]["x"] for state in found),
                                    (body, found))
                if small == "1e-8":
                    self.assertEqual([state["stability"] for state in found], ["unstable", "stable"])

    def test_equilibria_are_where_the_typed_decimals_put_them(self):
        rng = random.Random(1)
        for _ in range(CASES):
            places = sorted((typed(rng, 0.1, 2), typed(rng, 2.1, 4)), key=fractions.Fraction)
            names = ("a", "b")
            if rng.random() < 0.5:
                parameters, values = zip(*(self.said(rng, name, place) for name, place in zip(names, places)))
                body = {"system": plain("x^3/3 - (a + b)*x^2/2 + a*b*x", parameters),
                        "parameters": {k: v for given in values for k, v in given.items()}}
            else:
                body = {"system": plain("x^3/3 - ({0} + {1})*x^2/2 + {0}*{1}*x".format(*places))}
            answer = self.answer_of("equilibria", body)
            self.assertEqual(len(answer["equilibria"]), 2, raw(body))
            for state, place in zip(answer["equilibria"], places):
                self.holds(state["state"]["x"], state["error"]["x"], exactly(place), raw(body))
                self.assertLess(state["error"]["x"], 1e-13, raw(body))

    def test_literals_that_cancel_are_worked_out_on_paper(self):
        rng = random.Random(6)

        def arithmetic(depth):
            """A text of decimals, and its value."""
            if depth == 0:
                text = typed(rng, 0.001, 1000, 17)
                return text, fractions.Fraction(text)
            (a, x), (b, y) = arithmetic(depth - 1), arithmetic(rng.randint(0, depth - 1))
            way = rng.choice("+-*/^")
            if way == "/" and y != 0:
                return f"({a})/({b})", x / y
            if way == "^":
                power = rng.choice((2, 3))
                return f"({a})^{power}", x**power
            return (f"({a}) + ({b})", x + y) if way == "+" else \
                   (f"({a}) - ({b})", x - y) if way == "-" else (f"({a})*({b})", x * y)

        for _ in range(CASES):
            text, value = arithmetic(rng.randint(1, 4))
            # Two numbers that agree in many digits, and what is left of them.
            near = typed(rng, -1, 1, 12)
            text, value = f"({text} + {near}e-9) - ({text})", fractions.Fraction(near) / 10**9
            answer = self.answer_of("equilibria", {"system": plain(f"(x - 1000*({text}))^2/2")})
            exact = 1000 * mpmath.mpf(value.numerator) / value.denominator
            state = answer["equilibria"][0]
            self.holds(state["state"]["x"], state["error"]["x"], exact, text)
            self.assertLessEqual(state["error"]["x"], 1e-14 * abs(exact), text)

    def test_frequencies_are_those_of_the_typed_decimals(self):
        rng = random.Random(2)
        for _ in range(CASES):
            m, k = typed(rng, 0.1, 3), typed(rng, 0.1, 90)
            if rng.random() < 0.3:
                units = {"m": rng.choice(("", "kg", " g")), "k": rng.choice(("", " N/m", "N/cm"))}
                sizes = {"": 1, "kg": 1, " g": fractions.Fraction(1, 1000), " N/m": 1, "N/cm": 100}
                query = urllib.parse.urlencode({"system": "spring_pendulum", "m": m + units["m"], "k": k + units["k"],
                                                "l0": "0.3", "g": "0"})
                response = self.raw("GET", "/v1/modes?" + query)
                self.assertEqual(response.status, 200, response.data[:300])
                found = json.loads(response.data)["modes"][-1]
                ratio = fractions.Fraction(k) * sizes[units["k"]] / (fractions.Fraction(m) * sizes[units["m"]])
                what = query
            else:
                body = {"system": line("k*x^2/2", [parameter("k", "N/m")]),
                        "parameters": {"m": as_number(m), "k": rng.choice((as_number(k), k, k + " N/m"))}}
                found = self.answer_of("modes", body)["modes"][0]
                ratio = fractions.Fraction(k) / fractions.Fraction(m)
                what = raw(body)
            omega = mpmath.sqrt(mpmath.mpf(ratio.numerator) / ratio.denominator)
            self.holds(found["omega"], found["error"], omega, what)
            self.assertLess(found["error"], 1e-14 * omega, what)

    def test_turning_points_start_from_the_typed_decimals(self):
        rng = random.Random(3)
        for _ in range(CASES):
            m, k, x, v = typed(rng, 0.1, 3), typed(rng, 1, 9), typed(rng, -1, 1), typed(rng, -2, 2)
            body = {"system": line("k*x^2/2", [parameter("k", "N/m")]),
                    "parameters": {"m": as_number(m), "k": as_number(k)},
                    "initial": {"x": rng.choice((as_number(x), x, x + " m")),
                                "x_dot": rng.choice((as_number(v), v, "0"))}}
            moving = body["initial"]["x_dot"] != "0"
            answer = self.answer_of("turning_points", body)
            reach = mpmath.sqrt(exactly(x)**2 + (exactly(m) * exactly(v)**2 / exactly(k) if moving else 0))
            for name, exact in (("x_max", reach), ("x_min", -reach)):
                self.holds(answer[name], answer["error"][name], exact, raw(body))
                self.assertLess(answer["error"][name], 1e-12, raw(body))

    def test_extrema_along_a_motion_are_those_of_the_typed_decimals(self):
        rng = random.Random(5)
        system = {"name": "pushed", "units": "none", "parameters": [{"name": "a", "default": 1}, {"name": "b", "default": 1}],
                  "coordinates": [{"name": "x"}], "lagrangian": "x_dot^2/2",
                  "forces": [{"name": "push", "value": "a - b", "along": "x"}]}
        for _ in range(40):
            a, b, v = typed(rng, 900.5, 901), typed(rng, 900, 900.5), typed(rng, 0, 3)
            body = {"system": system, "parameters": {"a": as_number(a), "b": as_number(b)},
                    "initial": {"x": 0, "x_dot": as_number(v)}, "coordinate": "x", "t_end": 18.5}
            answer = self.answer_of("turning_points", body)
            self.assertEqual(answer["method"], "trajectory")
            exact = exactly(v)*mpmath.mpf("18.5") + (exactly(a) - exactly(b))*mpmath.mpf("18.5")**2/2
            self.holds(answer["x_max"], answer["error"]["x_max"], exact, raw(body))

    def test_solved_parameters_hold_the_typed_position(self):
        rng = random.Random(4)
        for _ in range(CASES):
            m, k, x = typed(rng, 0.1, 3), typed(rng, 1, 9), typed(rng, 0.1, 2)
            body = {"system": line("k*x^2/2 - m*G*x", [parameter("k", "N/m"), parameter("G", "m/s^2")]),
                    "parameters": {"m": as_number(m), "k": as_number(k)}, "solve_for": "G",
                    "at": {"x": rng.choice((as_number(x), x))}}
            answer = self.answer_of("equilibria", body)
            exact = exactly(k) * exactly(x) / exactly(m)
            self.holds(answer["G"], answer["error"], exact, raw(body))
            self.assertLess(answer["error"], 1e-13 * max(1, exact), raw(body))

    def test_angles_in_degrees_are_multiples_of_pi(self):
        rng = random.Random(5)
        for _ in range(50):
            degrees = typed(rng, 1, 100, 12)
            answer = self.answer_of("turning_points", {"system": "free_spin_pendulum",
                                                       "initial": {"theta": degrees + "deg", "psi_dot": 0}})
            exact = exactly(degrees) * mpmath.pi / 180
            self.holds(answer["theta_max"], answer["error"]["theta_max"], exact, degrees)

    def test_what_nothing_decides_is_where_it_was_typed(self):
        place = {"a": "pi/2", "b": "pi/2"}
        for name, found in (("a", self.ask("modes", {"system": BEADS, "equilibrium": place})["equilibrium"]),
                            ("a", self.ask("modes", {"system": TURNTABLE, "initial": {"a": "pi/2"}})["equilibrium"]),
                            ("b", self.ask("modes", {"system": BEADS, "equilibrium": place})["equilibrium"])):
            self.holds(found["state"][name], found["error"][name], mpmath.pi / 2, name)
            self.assertLess(found["error"][name], 2e-16)
        turning = {"system": TURNTABLE, "initial": {"a": "1/7", "a_dot": "1/3"}}
        body = turning | {"parameter": "g", "from": 0, "to": 5}
        for found in (self.ask("equilibria", turning)["equilibria"] + self.ask("bifurcations", body)["critical"]):
            error = found["state_error" if "value" in found else "error"]
            self.holds(found["state"]["a"], error["a"], mpmath.mpf(1) / 7, found)

    def test_what_no_double_is_near_is_refused(self):
        for number in ("1e-400", "-1e-330", "1e400"):
            response = self.raw("POST", "/v1/energy", '{"system": "spring_pendulum", "parameters": {"m": %s}}' % number)
            self.assertEqual(response.status, 400, number)
            self.assertIn(b"beyond double precision", response.data)
        response = self.raw("POST", "/v1/energy",
                            '{"system": "spring_pendulum", "parameters": {"m": 0.%s1}}' % ("3" * 1200))
        self.assertEqual(response.status, 422, response.data)
        self.assertIn(b"1000 digits", response.data)


if __name__ == "__main__":
    unittest.main()
