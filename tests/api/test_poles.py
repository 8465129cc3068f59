"""Turning points beside poles of the potential: over a pole h - V changes its sign, and nothing turns there."""

import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402


def scene(potential, start, rate="0"):
    return {"name": "pole", "units": "none", "parameters": [{"name": "k", "default": "2"}],
            "coordinates": [{"name": "x", "initial": start, "initial_rate": rate}],
            "lagrangian": f"x_dot^2/2 - ({potential})"}


# (V, x, x', which side has the pole, where): odd and even ones, of other functions, on either side of the start.
POLES = [("-k/x", "0.5", "0", "x_min", "0"), ("k/x", "-0.5", "0", "x_max", "0"), ("-k/x", "1", "1", "x_min", "0"),
         ("-k/tan(x)", "0.5", "0", "x_min", "0"), ("k*tan(x)", "0.5", "0", "x_min", "-1.570796327"),
         ("-k/x*exp(-x)", "0.5", "0", "x_min", "0"), ("-k/(x - 1)", "1.5", "0", "x_min", "1"),
         ("x^2 - k/(1 - x)", "0.2", "0.5", "x_max", "1"), ("-k/x^3 + x^2", "0.5", "0", "x_min", "0"),
         ("-k/x^2", "0.5", "0", "x_min", "0"), ("-k/abs(x)", "-0.5", "0", "x_max", "0"), ("k*log(x)", "0.5", "0", "x_min", "0"),
         ("-k/(x + 1)^2", "2", "0", "x_min", "-1")]


class Poles(Service):
    def test_a_pole_is_no_turning_point(self):
        for potential, start, rate, side, where in POLES:
            with self.subTest(potential=potential, start=start):
                found = self.ask("turning_points", {"system": scene(potential, start, rate)})
                self.assertIsNone(found[side])
                self.assertIsNone(found["motion"])
                self.assertIsNone(found["period"])
                for field in (side, "motion", "period"):
                    self.assertIn(f"At x = {where} the potential has a pole", found["reason"][field])
                    self.assertIn("grows without bound", found["reason"][field])

    def test_where_the_potential_ends_it_is_no_pole(self):
        for potential, side, where in (("k*sqrt(x)", "x_min", "0"), ("-k*asin(x)", "x_max", "1")):
            found = self.ask("turning_points", {"system": scene(potential, "0.5")})
            self.assertIsNone(found[side])
            self.assertIn(f"x does not turn before {where}, where the potential ends", found["reason"][side])

    def test_a_wall_is_a_turning_point(self):
        found = self.ask("turning_points", {"system": scene("k*sign(x) + x^2/2", "-0.5", "0.1")})
        self.assertEqual((found["motion"], found["x_max"]), ("libration", 0))


if __name__ == "__main__":
    unittest.main()
