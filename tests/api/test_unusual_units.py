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


def stiffening(length, rate, **options):
    """A spring that stiffens, x'' = -w^2 (x + x^3/l^2), over some swings."""
    scene = lagrangian("spring", f"l 1 {length!r}; w 1 {rate!r}", f"x - {0.8 * length!r} 0", "x_dot^2/2 - w^2*x^2/2 - w^2*x^4/(4*l^2)")
    return {"system": scene, "t_end": 10 / rate, "samples": 3, **options}


def stiffened(request, t):
    """Its x, by Jacobi's functions: A cn(W t), W^2 = w^2 (1 + (A/l)^2)."""
    (length, rate), start = (p["default"] for p in request["system"]["parameters"]), request["system"]["coordinates"][0]["initial"]
    part = (mpf(start) / mpf(length)) ** 2
    return mpf(start) * mp.ellipfun("cn", mpf(rate) * mp.sqrt(1 + part) * mpf(t), m=part / (2 * (1 + part)))


def orbit(mass, strength, r, speed):
    """About a charge that pulls with k/r^2, from where it is farthest."""
    scene = lagrangian("orbit", f"m 1 {mass!r}; k 1 {strength!r}", f"x - {r!r} 0; y - 0 {speed!r}",
                       "m*(x_dot^2 + y_dot^2)/2 + k/sqrt(x^2 + y^2)")
    return {"system": scene}


def orbited(mass, strength, r, speed, t):
    """Its x and y, by Kepler's equation."""
    mu, r, speed = mpf(strength) / mpf(mass), mpf(r), mpf(speed)
    e = 1 - r * speed ** 2 / mu
    a = r / (1 + e)
    phase = mp.pi + mp.sqrt(mu / a ** 3) * mpf(t)
    angle = mp.findroot(lambda x: x - e * mp.sin(x) - phase, phase)
    return a * (e - mp.cos(angle)), -a * mp.sqrt(1 - e ** 2) * mp.sin(angle)


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

    def test_accuracy_is_met_whatever_the_unit_of_length(self):
        """At the rate of molecules velocities are large where places are small."""
        for length, rate in [(length, 1.3) for length in (1.0, 1e-5, 1e-9, 1e-12, 1e-15, 1e-40)] + [(1e-10, 1e13)]:
            for accuracy in ("fast", "balanced", "accurate"):
                with self.subTest(length=length, rate=rate, accuracy=accuracy):
                    request = stiffening(length, rate, accuracy=accuracy)
                    answer = self.ask("simulate", request)
                    self.assertTrue(answer["accuracy"]["meets_request"], answer["accuracy"])
                    error = answer["accuracy"]["max_abs_error"]["x"]
                    for x, t in zip(answer["trajectory"]["x"], answer["trajectory"]["t"]):
                        self.assertLessEqual(abs(mpf(x) - stiffened(request, t)), error)

    def test_a_column_much_smaller_than_another_is_resolved(self):
        """An angle, and beside it a displacement of a picometre that is faster."""
        scene = lagrangian("both", "l 1 1e-12; w 1 13", "a 1 0.5 0; x - 0.8e-12 0",
                           "a_dot^2/2 + cos(a) + x_dot^2/2 - w^2*x^2/2 - w^2*x^4/(4*l^2)")
        answer = self.ask("simulate", {"system": scene, "t_end": 10, "samples": 3, "accuracy": "accurate"})
        self.assertTrue(answer["accuracy"]["meets_request"], answer["accuracy"])
        true = stiffened(stiffening(1e-12, 13), 10)
        self.assertLessEqual(abs(answer["trajectory"]["x"][-1] - true), answer["accuracy"]["max_abs_error"]["x"])

    def test_an_electron_orbits_in_seconds(self):
        """And a motion as fast as in a nucleus. Coefficients of order 20 are beyond doubles there."""
        for start, period in (((9.11e-31, 2.307e-28, 5.29e-11, 1.5e6), 1e-16), ((1.67e-27, 2.307e-28, 1e-15, 1e7), 1e-22)):
            for options in ({}, {"accuracy": "fast"}, {"accuracy": "accurate"}, {"method": "adams"}, {"rtol": 1e-14}):
                for t in (2.5 * period, 10 * period):
                    with self.subTest(start=start, t=t, **options):
                        answer = self.ask("simulate", {**orbit(*start), "t_end": t, "samples": 2, **options})
                        self.assertEqual(answer["status"], "complete")
                        errors = answer["accuracy"]["max_abs_error"]
                        self.assertLess(errors["x"], 1e-3 * start[2])
                        for name, true in zip("xy", orbited(*start, t)):
                            self.assertLessEqual(abs(mpf(answer["trajectory"][name][-1]) - true), errors[name])

    def test_constraints_that_touch_determine_nothing_whatever_the_unit_of_mass(self):
        for mass in MASSES:
            with self.subTest(mass=mass):
                touched = bob(mass, ROD, {"name": "tangent", "expression": "3*x-4*y-5*l", "multiplier": "mu"})
                response = self.post("simulate", {"system": touched, "t_end": 1, "samples": 2})
                self.assertEqual(response.status, 422)
                self.assertIn(b"depend on each other", response.data)


if __name__ == "__main__":
    unittest.main()
