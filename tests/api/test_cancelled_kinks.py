"""Kinks that are none: their factor is 0 at these numbers, or they cancel each other."""

import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402


class CancelledKinks(Service):
    def test_kinks_with_a_factor_that_cancels_at_these_numbers_leave_no_trace(self):
        """V = x^2/2 - |x| where a = b, and x^2/2 + sqrt(x^4) = 3/2 x^2."""
        scene = {"name": "cancelled", "units": "none", "coordinates": [{"name": "x", "initial": "0.3"}],
                 "parameters": [{"name": "a", "default": "2"}, {"name": "b", "default": "2"}],
                 "lagrangian": "x_dot^2/2 - (abs(a*x - b*x) + abs(b*x - a*x)*0.5 - abs(x) + x^2/2)"}
        for both in ("2", "0.1"):
            found = self.ask("equilibria", {"system": scene, "parameters": {"a": both, "b": both}})
            self.assertTrue(found["complete"])
            self.assertEqual([e["stability"] for e in found["equilibria"]], ["stable", "unstable", "stable"])
            for e, x in zip(found["equilibria"], (-1, 0, 1)):
                self.assertLessEqual(abs(e["state"]["x"] - x), e["error"]["x"])
                self.assertLess(e["error"]["x"], 1e-14)
        scene["lagrangian"] = "x_dot^2/2 - (sqrt(x^4) + x^2/2)"
        found = self.ask("equilibria", {"system": scene})
        self.assertEqual([(e["state"]["x"], e["stability"]) for e in found["equilibria"]], [(0, "stable")])


if __name__ == "__main__":
    unittest.main()
