"""Conditions of validity that cease to have a value where they fail, or before: they hold no longer."""

import pathlib
import sys
import unittest

from mpmath import mp, mpf

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

mp.dps = 30
# Of x = t, and where it ends.
CONDITIONS = [("sqrt(1 - x)", 1), ("sqrt(1 - x) - 0.001", 0.999999), ("(1 - x)^0.5 + 1", 1), ("sqrt(1 - x) - 1e-10", 1),
              ("log(1 - x) + 30", 1 - 9.357622968840175e-14), ("log(1 - x) + 1", 0.6321205588285577),
              ("sqrt(2 - x) + sqrt(3 - 2*x)", 1.5), ("sqrt((x - 1)^2) - 0.25", 0.75), ("x + sqrt(x^2 + 1)", None),
              ("acos(x) + 1", 1), ("2 - asin(x)", 1), ("acos(1 - 0.8*x) - 3.2", 0), ("4 - acos(0.6 - x)", 1.6), ("asin(2*x) - asin(x - 0.7) + 1", 0.5),
              ("acos(x) - 0.1", 0.9950041652780258), ("2 - asin(sin(x))", None)]


class ConditionsWithoutValue(Service):
    def test_they_end_the_motion_where_they_have_none(self):
        for expression, end in CONDITIONS:
            scene = {"name": "moving", "units": "none", "coordinates": [{"name": "x", "initial": "0", "initial_rate": "1"}],
                     "lagrangian": "x_dot^2/2",
                     "valid_while": [{"name": "v", "expression": expression, "reason": "over", "message": "It is over."}]}
            with self.subTest(expression=expression):
                answer = self.ask("simulate", {"system": scene, "t_end": 2, "samples": 2})
                if end is None:
                    self.assertEqual(answer["status"], "complete")
                    continue
                self.assertEqual(answer["stop"]["reason"], "over")
                self.assertLessEqual(abs(answer["stop"]["t"] - end), answer["stop"]["error"])
                self.assertLess(answer["stop"]["error"], 3e-14)

    def test_they_end_it_at_the_top_of_an_oscillation_that_passes_their_end_by_little(self):
        for form in ("acos({0})+1", "2 - asin({0})", "sqrt(1 - ({0})) + 1", "acos(({0})^2)+1", "1/(acos({0}) + 0.1) + acos({0}/2)"):
            for beyond in ("0.00003", "0.0000001", "0.00000006", "0.00000001", "0.000000002"):
                u = f"x + 0.1 + {beyond}"
                scene = {"name": "oscillator", "units": "none", "lagrangian": "x_dot^2/2 - x^2/2",
                         "coordinates": [{"name": "x", "initial": "0.54", "initial_rate": "0.72"}],
                         "valid_while": [{"name": "v", "expression": form.format(u), "reason": "over", "message": "It is over."}]}
                with self.subTest(form=form, beyond=beyond):
                    answer = self.ask("simulate", {"system": scene, "t_end": 3, "samples": 4})
                    end = mp.atan2(mpf("0.72"), mpf("0.54")) - mp.acos((mpf("0.9") - mpf(beyond)) / mpf("0.9"))
                    self.assertEqual(answer["stop"]["reason"], "over")
                    self.assertLessEqual(abs(answer["stop"]["t"] - end), answer["stop"]["error"])
                    self.assertLess(answer["stop"]["error"], 1e-7)

    def test_a_root_that_only_touches_its_end_breaks_nothing(self):
        for expression in ("sqrt(1 - cos(x - 1)) + 0.1", "sqrt(1 - sin(x)) + 0.5", "sqrt(x^2 - x + 0.25) + 1"):
            scene = {"name": "moving", "units": "none", "coordinates": [{"name": "x", "initial": "0", "initial_rate": "1"}],
                     "lagrangian": "x_dot^2/2",
                     "valid_while": [{"name": "v", "expression": expression, "reason": "over", "message": "It is over."}]}
            answer = self.ask("simulate", {"system": scene, "t_end": 3, "samples": 2})
            self.assertEqual(answer["status"], "complete", expression)
            self.assertLess(answer["accuracy"]["max_abs_error"]["x"], 1e-12)


if __name__ == "__main__":
    unittest.main()
