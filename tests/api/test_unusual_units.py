"""Textbook scenes in units in which their numbers are very large or very small: the motion is the same."""

import pathlib
import sys
import unittest

from mpmath import mp, mpf

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mp.dps = 40
MASSES = (1e-100, 1.67e-27, 1e-14, 1, 1e16, 2e30, 1e100)
ROD = {"name": "rod", "expression": "x^2+y^2-l^2", "multiplier": "lam"}


def bob(mass, *constraints):
    return lagrangian("bob", f"m 1 {mass!r}; l 1 5; g 1 9.81", "x - 3 0; y - -4 0", "m*(x_dot^2 + y_dot^2)/2 - m*g*y",
                      constraints=list(constraints))


def swung(t):
    """x of that bob, by Jacobi's functions: sin(theta/2) = k cd(w t)."""
    k, rate = mp.sin(mp.atan(mpf(3) / 4) / 2), mp.sqrt(mpf("9.81") / 5)
    half = k * mp.ellipfun("cd", rate * t, k=k)
    return 5 * 2 * half * mp.sqrt(1 - half ** 2)


class UnusualUnits(Service):
    def test_a_mass_on_a_rod_swings_whatever_its_unit(self):
        for mass in MASSES:
            for options in ({}, {"accuracy": "accurate"}, {"precision": "extended"}):
                with self.subTest(mass=mass, **options):
                    answer = self.ask("simulate", {"system": bob(mass, ROD), "t_end": 1, "samples": 2, **options})
                    error = answer["accuracy"]["max_abs_error"]["x"]
                    self.assertLess(error, 1e-9)
                    # beside the rounding of the printed digits, where the error is below it
                    self.assertLessEqual(abs(answer["trajectory"]["x"][-1] - swung(1)), error + 1e-15)

    def test_constraints_that_touch_determine_nothing_whatever_the_unit_of_mass(self):
        for mass in MASSES:
            with self.subTest(mass=mass):
                touched = bob(mass, ROD, {"name": "tangent", "expression": "3*x-4*y-5*l", "multiplier": "mu"})
                response = self.post("simulate", {"system": touched, "t_end": 1, "samples": 2})
                self.assertEqual(response.status, 422)
                self.assertIn(b"depend on each other", response.data)


if __name__ == "__main__":
    unittest.main()
