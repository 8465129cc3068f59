"""Equilibria in wells of tanh, which has rounded to 1 far away: all of them are found, and no others. The second road
is the same well by cosh, or by hand."""

import math
import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

# the potential, and the places where it is stationary
WELLS = {
    "tanh(x)^2": [0], "2*tanh(3*x)^2": [0], "A*tanh(x)^2": [0], "sinh(x)^2/cosh(x)^2": [0],
    "tanh(x)^2 - tanh(x)": [math.atanh(1/2)],
    "0.7*tanh(x)^4 - tanh(x)^2": [-math.atanh(math.sqrt(1/1.4)), 0, math.atanh(math.sqrt(1/1.4))],
    "tanh(x)^2 + tanh(x - 2)^2": [None, 1, None],
    "tanh(x)^4": [0], "tanh(x - 1)^4": [1], "tanh(x)^3": [0], "tanh(x)": [],
}


class HyperbolicWells(Service):
    def places(self, potential):
        well = lagrangian("well", "A - 1.3", "x - 0.3", f"x_dot^2/2 - ({potential})")
        found = self.ask("equilibria", {"system": well})
        self.assertTrue(found["complete"], (potential, found.get("reason")))
        return [place["state"]["x"] for place in found["equilibria"]]

    def test_all_places_are_found(self):
        for potential, expected in WELLS.items():
            with self.subTest(potential):
                places = self.places(potential)
                self.assertEqual(len(places), len(expected), places)
                for x, true in zip(places, expected):
                    if true is not None:
                        self.assertAlmostEqual(x, true, delta=1e-14)

    def test_two_wells_by_tanh_are_those_by_cosh(self):
        by_cosh = self.places("-1/cosh(x)^2 - 1/cosh(x - 2)^2")
        for x, other in zip(self.places("tanh(x)^2 + tanh(x - 2)^2"), by_cosh, strict=True):
            self.assertAlmostEqual(x, other, delta=1e-14)


if __name__ == "__main__":
    unittest.main()
