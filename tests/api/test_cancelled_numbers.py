"""Defaults that are expressions of parameters and cancel up to their last digits: to the decimals as typed where they
are rational, and elsewhere with an error that holds what is not known."""

import json
import pathlib
import sys
import unittest

from mpmath import mp, mpf

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mp.dps = 80
SQUARE = ("p 1 5650.4", "(p-0.65728236248253724127721)^2-31919592.7754981613737693",
          lambda: (mpf("5650.4") - mpf("0.65728236248253724127721")) ** 2 - mpf("31919592.7754981613737693"))
CASES = (
    ("p 1 0.1; r 1 0.3", "p*r-0.03+1e-30", lambda: mpf("1e-30")),
    ("p 1 0.1", "p^3-0.001+1e-33", lambda: mpf("1e-33")),
    ("p 1 1.23456789000000000000000001", "p^2-1.23456789^2", lambda: mpf("1.23456789000000000000000001") ** 2 - mpf("1.23456789") ** 2),
    ("p 1 0.3; q 1 p/3", "q-0.1+1e-25", lambda: mpf("1e-25")),
    ("p 1 2", "sqrt(p)-1.41421356237309504880168872420969", lambda: mp.sqrt(2) - mpf("1.41421356237309504880168872420969")),
    ("p 1 1", "exp(p)-2.718281828459045235360287471352", lambda: mp.e - mpf("2.718281828459045235360287471352")),
    SQUARE,
)
STIFFNESSES = (
    ("2", "sqrt(q)-1.41421356237309504880168872420969", mp.sqrt(2) - mpf("1.41421356237309504880168872420969")),
    ("100", "cosh(q)^2-sinh(q)^2+4", 5),
    ("20", "cosh(q)^2-sinh(q)^2+4", 5),
    ("2", "log(q)-0.69314718055994530941723212145817", mp.log(2) - mpf("0.69314718055994530941723212145817")),
)


class CancelledNumbers(Service):
    def numbers(self, request):
        """The answer, with all digits of its numbers."""
        response = self.post("simulate", request)
        self.assertEqual(response.status, 200, response.data[:500])
        return json.loads(response.data, parse_float=mpf)

    def test_a_start_is_within_its_error(self):
        for parameters, start, known in CASES:
            for options in ({}, {"accuracy": "fast"}, {"precision": "extended"}, {"parameters": {"p": parameters.split(";")[0].split()[2]}}):
                scene = lagrangian("swing", parameters, f"x - {start} 0", "x_dot^2/2 - 1.7*x^2/2")
                with self.subTest(start=start, **options):
                    answer = self.numbers({"system": scene, "t_end": 2, "samples": 2, **options})
                    error = answer["accuracy"]["max_abs_error"]["x"]
                    rate = mp.sqrt(mpf("1.7"))
                    for x, t in zip(answer["trajectory"]["x"], (0, 2)):
                        self.assertLessEqual(abs(x - known() * mp.cos(rate * t)), error)

    def test_a_parameter_is_what_its_expression_says(self):
        parameters, text, known = SQUARE
        for options in ({}, {"precision": "extended"}, {"parameters": {"p": "5650.4"}}):
            scene = lagrangian("fall", f"{parameters}; w 1 {text}", "x - 0 0", "x_dot^2/2 + w*x")
            with self.subTest(**options):
                answer = self.numbers({"system": scene, "t_end": 1, "samples": 2, **options})
                off = abs(answer["trajectory"]["x_dot"][-1] - known())
                self.assertLessEqual(off, answer["accuracy"]["max_abs_error"]["x_dot"])

    def test_a_stiffness_is_not_taken_for_zero(self):
        """Its frequency is within the error stated, its place is found or said to be in doubt, and nothing rests."""
        for q, text, stiffness in STIFFNESSES:
            for parameters, potential in ((f"q 1 {q}", f"({text})*x^2/2"), (f"q 1 {q}; w 1 {text}", "w*x^2/2")):
                scene = lagrangian("spring", parameters, "x - 0.1 0", f"x_dot^2/2 - {potential}")
                with self.subTest(q=q, text=text, potential=potential):
                    [mode] = self.ask("modes", {"system": scene})["modes"]
                    self.assertNotEqual(mode["kind"], "rigid")
                    self.assertLessEqual(abs(mode["omega"] - mp.sqrt(stiffness)), mode["error"])
                    found = self.ask("equilibria", {"system": scene})
                    if found["complete"]:
                        [place] = found["equilibria"]
                        self.assertEqual(place["state"]["x"], 0)
                        self.assertLessEqual(abs(place["rate2"] - stiffness), place["rate2_error"])
                    self.assertIn(self.ask("turning_points", {"system": scene})["motion"], (None, "libration"))

    def test_masses_that_are_all_rounding_make_no_motion_known(self):
        """(q - 1.1)^2 multiplied out is a difference of numbers 1e18 times as large."""
        known = 0
        for size, q in (("1e1", "1.111211"), ("1e2", "1.1011211"), ("1e7", "1.100000011211"), ("1e9", "1.10000000011211")):
            scene = lagrangian("ties", f"q 1 {q}", "x - 0.331 0.346; y - 0.678 -0.0877",
                               "a*y_dot^2 + a*(x_dot-y_dot)^2/2 + x_dot^2 - (x-y)^2".replace("a", f"((q-1.1)*{size})^2"))
            a = ((mpf(q) - mpf("1.1")) * mpf(size)) ** 2
            rates = mp.matrix([[a + 2, -a], [-a, 3 * a]]) ** -1 * mp.matrix([[-2, 2], [2, -2]])
            flow = mp.zeros(4)
            flow[0, 2] = flow[1, 3] = 1
            flow[2:4, 0:2] = rates
            end = mp.expm(flow) * mp.matrix([mpf("0.331"), mpf("0.678"), mpf("0.346"), mpf("-0.0877")])
            answer = self.numbers({"system": scene, "t_end": 1, "samples": 2})
            errors = answer["accuracy"]["max_abs_error"]
            known += errors is not None and errors["x"] < 1e-3
            for name, true in zip(("x", "y", "x_dot", "y_dot"), end):
                with self.subTest(size=size, name=name):
                    self.assertTrue(errors is None or abs(answer["trajectory"][name][-1] - true) <= errors[name])
        self.assertGreaterEqual(known, 2)

    def test_carts_on_one_spring_have_a_rigid_mode_exactly(self):
        scenes = (lagrangian("carts", "m 1 0.3; M 1 1.7; k 1 2.3", "x - 0 0; y - 0 0", "m*x_dot^2/2 + M*y_dot^2/2 - k*(x - y)^2/2"),
                  lagrangian("wheels", "r 1 0.3; R 1 0.7; k 1 2.3", "a 1 0 0; b 1 0 0", "a_dot^2/2 + b_dot^2/2 - k*(r*a + R*b)^2/2"),
                  lagrangian("three", "k 1 0.1", "x - 0 0; y - 0 0; z - 0 0",
                             "(x_dot^2 + y_dot^2 + z_dot^2)/2 - k*(x - y)^2/2 - k*(y - z)^2"))
        for scene in scenes:
            with self.subTest(scene=scene["name"]):
                kinds = [(mode["kind"], mode["error"]) for mode in self.ask("modes", {"system": scene})["modes"]]
                self.assertEqual(kinds[0], ("rigid", 0))
                self.assertNotIn("rigid", [kind for kind, _ in kinds[1:]])


if __name__ == "__main__":
    unittest.main()
