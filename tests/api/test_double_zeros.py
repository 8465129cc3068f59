"""Small motions about a zero of the force that is double, or nearly: what of them is known, by 40 digits of mpmath."""

import pathlib
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mpmath.mp.dps = 40

# V of m*x_dot^2/2 - V, parameters, where the force and its slope vanish
DOUBLE = [
    ("a*exp(2*x)/2 - (b - c)*exp(x) + d*x", "m - 1; a - 2; b - 3; c - 1; d - 0.5", -mpmath.log(2)),
    ("exp(2*x)/2 - 0.2*exp(x) + 0.01*x", "m - 1; a - 2; b - 0.1", -mpmath.log(10)),
    ("k*x^2/2 + q*log(d - x)", "m - 1; k - 4; q - 1; d - 1", mpmath.mpf("0.5")),
    ("a*exp(2*x)/2 - 2*exp(x) + 0.5*x*b", "m - 1; a - 2; b - 1", -mpmath.log(2)),
    ("(x - a)^3/3", "m - 1; a - 2", mpmath.mpf(2)),
]
WELLS = [("", ""), (" - k2*y^2/2", "; k2 - 0.5"), (" - k2*(y - x)^2/2", "; k2 - 0.5"),
         (" - k2*y^2/2 + B*(x*y_dot - y*x_dot)", "; k2 - 0.5; B - 0.1")]


class DoubleZeros(Service):
    def modes(self, text, parameters, coordinates, **members):
        return self.ask("modes", {"system": lagrangian("double", parameters, coordinates, text, **members)})

    def check(self, answer, place, where):
        self.assertEqual(answer["equilibrium"]["stability"], "neutral", where)
        self.assertLess(abs(answer["equilibrium"]["state"]["x"] - place), 1e-6, where)
        self.assertIsNone(answer["equilibrium"]["error"]["x"], where)
        slow = [mode for mode in answer["modes"] if mode["omega"] < 0.1 and mode.get("rate", 0) < 0.05]
        self.assertEqual([mode["kind"] for mode in slow], ["neutral"], where)
        self.assertNotIn("period", slow[0], where)
        return slow[0]

    def test_a_double_zero_has_no_frequency_and_no_stability(self):
        for potential, parameters, place in DOUBLE:
            mode = self.check(self.modes(f"m*x_dot^2/2 - ({potential})", parameters, "x - 0.4"), place, potential)
            self.assertLess(mode["error"], 1e-3, potential)

    def test_nor_has_it_beside_another_coordinate(self):
        for potential, parameters, place in DOUBLE[1:2]:
            for more, names in WELLS[1:]:
                text = f"m*(x_dot^2 + y_dot^2)/2 - ({potential}){more}"
                self.check(self.modes(text, parameters + names, "x - 0.4; y - 0.1"), place, text)

    def test_with_damping_it_neither_decays_nor_grows_and_the_error_is_that_of_its_place(self):
        for potential, parameters, place in DOUBLE[:4]:
            answer = self.modes(f"m*x_dot^2/2 - ({potential})", parameters + "; C - 0.5", "x - 0.4", dissipation="C*x_dot^2/2")
            mode = self.check(answer, place, potential)
            self.assertGreater(mode["error"], 0, potential)

    def test_two_zeros_that_lie_close_together_have_their_frequencies(self):
        for size in ("1e-8", "1e-11"):
            rest = mpmath.mpf("0.01") - mpmath.mpf(size)
            potential = f"exp(2*x)/2 - 0.2*exp(x) + {mpmath.nstr(rest, 20)}*x"
            answer = self.modes(f"m*x_dot^2/2 - ({potential})", "m - 1", "x - 0.4")
            root = mpmath.mpf("0.1") + mpmath.sqrt(mpmath.mpf(size))
            omega = mpmath.sqrt(2*root*(root - mpmath.mpf("0.1")))
            self.assertEqual(answer["equilibrium"]["stability"], "stable", size)
            self.assertLessEqual(abs(answer["modes"][0]["omega"] - omega), answer["modes"][0]["error"] + 1e-15*omega, size)


if __name__ == "__main__":
    unittest.main()
