"""Parameters as exponents: V = k x^n with n = 4 is V = k x^4, on both sides of 0."""

import json
import math
import pathlib
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

QUESTIONS = {"equilibria": {}, "modes": {}, "energy": {}, "turning_points": {}, "simulate": {"t_end": 3, "samples": 7}}


def well(power, n="2", **more):
    return lagrangian("well", f"k 1 1; n 1 {n}", "x - 0.5 0", f"x_dot^2/2 - {power}", **more)


class ParametersAsExponents(Service):
    def without(self, value, *names):
        if isinstance(value, dict):
            return {k: self.without(v, *names) for k, v in value.items() if k not in names}
        return [self.without(v, *names) for v in value] if isinstance(value, list) else value

    def test_the_answers_are_those_of_the_number(self):
        for power, n, plain in (("k*x^n", "2", "k*x^2"), ("k*x^n", "4", "k*x^4"), ("k*abs(x)^n", "2.3", "k*abs(x)^2.3"),
                                ("(x^2)^(n/2)*k", "3", "(x^2)^(3/2)*k"), ("k*x^(2*n)", "1", "k*x^2"), ("k*x^n/n", "6", "k*x^6/n"),
                                ("k*(x - 3)^n/2 + x", "2", "k*(x - 3)^2/2 + x"), ("k*sin(x)^n", "2", "k*sin(x)^2")):
            for question, more in QUESTIONS.items():
                with self.subTest(power=power, question=question):
                    symbolic = self.post(question, {"system": well(power, n), **more})
                    numeric = self.post(question, {"system": well(plain, n), **more})
                    self.assertEqual(symbolic.status, numeric.status)
                    self.assertNotEqual(json.loads(numeric.data).get(question), [])
                    # Closed forms may be written in another order.
                    hidden = ("request", "exact", "exact_rate2", "equation")
                    self.assertEqual(self.without(json.loads(symbolic.data), *hidden), self.without(json.loads(numeric.data), *hidden))

    def test_a_request_s_own_exponent_counts(self):
        for n, x in ((2, 0.5*math.cos(math.sqrt(2)*3)), (4, None)):
            answer = self.ask("simulate", {"system": well("k*x^n", "8"), "parameters": {"n": n}, "t_end": 3, "samples": 2})
            column, error = answer["trajectory"]["x"], answer["accuracy"]["max_abs_error"]["x"]
            if x is None:  # x'' = -4 x^3: the lemniscate's cosine
                with mpmath.workdps(30):
                    x = mpmath.ellipfun("cn", 3, m=mpmath.mpf("0.5"))/2
            self.assertLessEqual(abs(column[-1] - float(x)), error + 1e-16)

    def test_every_row_of_a_sweep_has_its_own(self):
        swept = self.ask("sweep", {"ask": {"equilibria": {"system": well("k*x^n")}}, "vary": {"n": {"values": [2, 4, 6]}},
                                   "collect": {"x": "/equilibria/0/state/x", "complete": "/complete"}})
        self.assertEqual(swept["columns"]["x"], [0, 0, 0])
        self.assertEqual(swept["columns"]["complete"], [True]*3)

    def test_an_exponent_that_moves_stays_a_symbol(self):
        # x - n x^(n - 1)/4 vanishes at (4/n)^(1/(n - 2)): 1 at n = 4.
        system = lagrangian("well", "n 1 4", "x - 0.9 0", "x_dot^2/2 - x^2/2 + x^n/4")
        found = self.ask("bifurcations", {"system": system, "parameter": "n", "from": 3, "to": 5})
        places = {n: x for b in found["branches"] for n, x in zip(b["n"], b["x"]) if x > 0.1}
        self.assertTrue(places)
        for n, x in places.items():
            self.assertAlmostEqual(x, (4/n)**(1/(n - 2)), 9)

    def test_formulas_say_which_exponent_they_are_for(self):
        mode = self.ask("modes", {"system": well("k*x^n")})["modes"][0]["exact"]
        self.assertEqual((mode["text"], mode["assumes"]), ("2*k", ["k > 0", "n = 2"]))

    def test_the_equations_keep_the_letter(self):
        self.assertIn("x^n", self.ask("equations", {"system": well("k*x^n")})["L"])

    def test_a_typed_event_with_an_exponent_is_met_where_its_base_is_negative(self):
        root = {2: math.acos(0.5), 3: math.acos(0.25 ** (1 / 3))}
        truth = {2: [root[2], math.pi - root[2], math.pi + root[2], 2 * math.pi - root[2]], 3: [root[3], 2 * math.pi - root[3]]}
        for n, times in truth.items():
            swing = lagrangian("swing", f"n - {n}; k - 1", "x - 1", "x_dot^2/2 - k*x^2/2")
            for request in ({"system": swing}, {"system": swing | {"parameters": [one | {"default": 5} if one["name"] == "n" else one
                                                                                  for one in swing["parameters"]]},
                                                "parameters": {"n": n}}):
                found = self.ask("simulate", request | {"t_end": 7, "samples": 3, "events": ["x^n = 1/4"]})["events"]
                self.assertEqual([round(one["t"], 9) for one in found], [round(t, 9) for t in times])


if __name__ == "__main__":
    unittest.main()
