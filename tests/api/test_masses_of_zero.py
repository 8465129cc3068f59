"""What small and negative masses, and poles of positions, are told of."""

import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import DOWN, G, particle, scene  # noqa: E402

PENDULUM = scene("pendulum", f"m kg 1; l m 0.5; {G}", "th rad 0.1", gravity=DOWN, bodies=[particle("m", "l*sin(th)", "-l*cos(th)")])
POLE = PENDULUM | {"bodies": [particle("m", "l*tan(th)", "0")]}


class MassesOfZero(Service):
    def test_the_limit_of_a_vanishing_mass_is_called_one(self):
        answer = self.ask("modes", {"system": PENDULUM, "parameters": {"m": 0}})
        self.assertIn("the equation of th vanishes", answer["notes"][0])
        self.assertNotIn("notes", self.ask("modes", {"system": PENDULUM}))

    def test_a_negative_mass_swings_as_a_positive_one(self):
        found = [self.ask("equilibria", {"system": PENDULUM, "parameters": {"m": m}})["equilibria"] for m in (1, -1)]
        for heavy, light in zip(*found):
            self.assertEqual(heavy["stability"], light["stability"])

    def test_one_eigenvalue_does_not_coincide_with_others(self):
        refused = self.refused("modes", {"system": PENDULUM, "parameters": {"m": 1e-300}})
        self.assertNotIn("coincide", refused["detail"])

    def test_a_state_at_a_pole_has_no_energy(self):
        self.refused("energy", {"system": POLE, "initial": {"th": "pi/2", "th_dot": 1}})
        near = self.ask("energy", {"system": POLE, "initial": {"th": "pi/2 - 1e-3", "th_dot": 1}})
        self.assertLess(near["error"]["T"], 1e-9 * near["T"])

    def test_nothing_rests_at_a_pole(self):
        for th in ("pi/2", "-90deg"):
            at = {"system": POLE, "initial": {"th": th}}
            for endpoint, more in (("simulate", {"t_end": 1}), ("turning_points", {})):
                problem = self.refused(endpoint, at | more)
                self.assertIn("there is no finite value of", problem["errors"][0]["detail"])
        near = {"system": POLE, "initial": {"th": "pi/2 - 1e-3"}}
        self.assertEqual(self.ask("simulate", near | {"t_end": 1e-9})["status"], "complete")

    def test_a_sleeping_top_by_angles_that_fail_there(self):
        refused = self.refused("modes", {"system": "symmetric_top", "initial": {"theta": 0, "phi_dot": 0}})
        self.assertIn("At theta = 0 the forces have no value", refused["detail"])


if __name__ == "__main__":
    unittest.main()
