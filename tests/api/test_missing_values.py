"""Places where a Lagrangian or a position has no value, though the equations have: the slope of log(x) is 1/x on both
sides of 0. Nothing rests there, and no motion begins there."""

import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402


def scene(lagrangian, start="1"):
    return {"name": "partial", "units": "none",
            "parameters": [{"name": "k", "default": "1"}, {"name": "a", "default": "0"}],
            "coordinates": [{"name": "x", "initial": start}], "lagrangian": lagrangian}


TRAP = "x_dot^2/2 - k*x^2/2 + log(x)"
ROOT = {"name": "root", "parameters": [{"name": "m", "unit": "kg", "default": "1"}, {"name": "d", "unit": "m", "default": "1"},
                                       {"name": "k", "unit": "N/m", "default": "1"}],
        "coordinates": [{"name": "x", "unit": "m", "initial": "-1"}],
        "bodies": [{"kind": "particle", "name": "bead", "mass": "m", "position": ["x", "sqrt(d*x)"]}],
        "potential": "k*(x + d)^2/2"}


class MissingValues(Service):
    def places(self, asked):
        found = self.ask("equilibria", {"system": asked})
        self.assertTrue(found["complete"], found.get("reason"))
        return [one["state"]["x"] for one in found["equilibria"]]

    def test_nothing_rests_where_the_potential_has_no_value(self):
        self.assertEqual(self.places(scene(TRAP)), [1])
        self.assertEqual(self.places(scene("x_dot^2/2 - x^2/2 + log(-x)")), [-1])
        self.assertEqual(len(self.places(scene("x_dot^2/2 - (x - 1/2)^2/2 + log(x^2)/2"))), 2)
        self.assertEqual(self.places(ROOT), [])

    def test_modes_say_that_it_is_no_place_to_rest(self):
        self.assertEqual(self.ask("modes", {"system": scene(TRAP)})["equilibrium"]["state"]["x"], 1)
        problem = self.refused("modes", {"system": scene(TRAP), "equilibrium": {"x": -1}})
        self.assertIn("The forces vanish at x = -1, but there is no finite value of L there", str(problem))

    def test_no_critical_value_there(self):
        found = self.ask("bifurcations", {"system": scene("x_dot^2/2 - x^2/2 - log(x) - k*x"), "parameter": "k",
                                          "from": -3, "to": 3})
        self.assertEqual([round(one["value"], 9) for one in found["critical"]], [-2])

    def test_no_motion_begins_there(self):
        for asked, missing, pointer in ((scene("x_dot^2/2 - log(x)", "-1"), "L", "#/initial"), (scene("x_dot^2/(2*a)"), "L", "#/parameters"),
                                        (ROOT, "the position of bead", "#/initial")):
            for endpoint, more in (("simulate", {"t_end": 1, "samples": 2}), ("turning_points", {})):
                problem = self.refused(endpoint, {"system": asked} | more)
                self.assertEqual(problem["errors"][0]["pointer"], pointer)
                self.assertIn(f"no finite value of {missing}", problem["errors"][0]["detail"])


if __name__ == "__main__":
    unittest.main()
