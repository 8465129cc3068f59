"""Whether a place is an equilibrium, which one is downhill and how it swings depends on no unit: the same systems in
rods of 1e-12 to 1e12, masses of 1e-20 to 1e20, against closed forms."""

import math
import pathlib
import sys
import unittest

from mpmath import mp, mpf

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mp.dps = 30
LENGTHS = ["1", "5.31e-3", "1.3e-4", "1e-7", "1e-12", "1e6", "1e12"]
MASSES = ["1", "8.69", "1e4", "1e-9", "1e-20", "1e20"]
G = "9.81"


def constrained(name, mass, length, start, text, *constraints):
    return lagrangian(name, f"m _ {mass}; l _ {length}; g _ {G}", "; ".join(f"{q} _ {at}" for q, at in start.items()), text,
                      constraints=[{"name": f"c{i}", "expression": c} for i, c in enumerate(constraints)])


def plane(mass, length):
    return constrained("pendulum", mass, length, {"x": "0", "y": "-l"}, "m*(x_dot^2 + y_dot^2)/2 - m*g*y", "x^2 + y^2 - l^2")


def spherical(mass, length):
    return constrained("sphere", mass, length, {"x": "0", "y": "0", "z": "-l"}, "m*(x_dot^2 + y_dot^2 + z_dot^2)/2 - m*g*z",
                       "x^2 + y^2 + z^2 - l^2")


def two_bobs(mass, length):
    return constrained("bobs", mass, length, {"x": "0", "y": "-l", "u": "0", "v": "-2*l"},
                       "m*(x_dot^2 + y_dot^2 + u_dot^2 + v_dot^2)/2 - m*g*(y + v)",
                       "x^2 + y^2 - l^2", "(u - x)^2 + (v - y)^2 - l^2")


def tied(mass, length):
    """By springs of k = m g/l to l, and by a tie to each other."""
    return constrained("tied", mass, length, {"x": "1.5*l", "y": "1.5*l"},
                       "m*(x_dot^2 + y_dot^2)/2 - m*g/l*((x - l)^2 + (y - l)^2)/2", "x + y - 3*l")


def parabola(mass, length):
    return constrained("parabola", mass, length, {"x": "0", "y": "0"}, "m*(x_dot^2 + y_dot^2)/2 - m*g*y", "y - x^2/l")


def follower(mass, length):
    """Constraints in units of their own: an energy, and a number."""
    return constrained("follower", mass, length, {"x": "0", "y": "-l", "z": "0"},
                       "m*(x_dot^2 + y_dot^2 + z_dot^2)/2 - m*g*y", "m*g*(x^2 + y^2 - l^2)/l", "(z - 2*x)/l")


# omega^2 l/g
SYSTEMS = [(plane, [1]), (spherical, [1, 1]), (two_bobs, [2 - mp.sqrt(2), 2 + mp.sqrt(2)]), (tied, [1]), (parabola, [2]),
           (follower, [mpf(1)/5])]


class ModesInAnyUnit(Service):
    def assert_swings(self, system, length, squares, equilibrium=None):
        found = self.ask("modes", {"system": system, "equilibrium": equilibrium or {}})
        self.assertEqual(found["equilibrium"]["stability"], "stable", system)
        self.assertEqual(len(found["modes"]), len(squares), system)
        for mode, square in zip(found["modes"], squares):
            omega = mp.sqrt(square*mpf(G)/mpf(length))
            self.assertLessEqual(abs(mpf(mode["omega"]) - omega), mode["error"], system)
            self.assertLess(mode["error"], 1e-12*omega, system)
        return found

    def test_what_rests_is_an_equilibrium_whatever_it_is_measured_in(self):
        for length in LENGTHS:
            for mass in MASSES:
                for system, squares in SYSTEMS:
                    self.assert_swings(system(mass, length), length, squares)

    def test_a_guess_beside_it_leads_to_it(self):
        for length in LENGTHS:
            size = float(length)
            guess = {"x": 1e-6*size, "y": -size}
            for mass in MASSES:
                found = self.assert_swings(plane(mass, length), length, [1], guess)
                state, error = found["equilibrium"]["state"], found["equilibrium"]["error"]
                self.assertLessEqual(abs(state["x"]), error["x"])
                self.assertLess(error["x"], 1e-20*size)
                self.assertLessEqual(abs(mpf(state["y"]) + mpf(length)), error["y"])

    def test_on_a_hillside_without_end_nothing_rests_whatever_it_is_measured_in(self):
        for length in LENGTHS:
            for mass in MASSES:
                hillside = constrained("hillside", mass, length, {"x": "0", "y": "l"}, "m*(x_dot^2 + y_dot^2)/2 - m*g*y",
                                       "y - l*(2 + x/l + tanh(x/l))/2")
                problem = self.refused("modes", {"system": hillside})
                self.assertIn("no equilibrium near", problem["detail"])

    def test_a_start_of_zeros_has_no_size_and_the_next_place_downhill_is_found(self):
        """From the angles a above the lowest place, in coordinates that are 0 there."""
        for length in LENGTHS:
            for angle in (0.3, 0.8, 1.5, 1.7, 2.4, 3):
                sine, cosine = repr(math.sin(angle)), repr(math.cos(angle))
                circle = constrained("circle", "2", length, {"x": "0", "y": "0"}, "m*(x_dot^2 + y_dot^2)/2 - m*g*y",
                                     f"(x + {sine}*l)^2 + (y - {cosine}*l)^2 - l^2")
                state = self.ask("modes", {"system": circle})["equilibrium"]["state"]
                self.assertAlmostEqual(state["x"]/float(length), -math.sin(angle), delta=1e-9, msg=circle)
                self.assertLess(state["y"], 0, circle)
                waves = lagrangian("waves", f"l _ {length}", "x _ 0; y _ 0",
                                   f"(x_dot^2 + y_dot^2)/2 + l*cos(x/l + {angle}) - (y - x/10 - l/3)^2/(2*l)")
                found = self.ask("modes", {"system": waves})["equilibrium"]
                self.assertAlmostEqual(found["state"]["x"]/float(length), -angle, delta=1e-9, msg=waves)
                self.assertEqual(found["stability"], "stable", waves)


if __name__ == "__main__":
    unittest.main()
