"""Modes whose frequencies are one: all shapes that there are, and no others. The second road: a shape v obeys
K v = omega^2 M v, and where there are fewer shapes than frequencies the motion grows like t."""

import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402


def driven(line, **more):
    return lagrangian("driven", "k - 0.5", "x - 0.1; y - 0.1", line, **more)


PLAIN = "(x_dot^2 + y_dot^2)/2 - (x^2 + y^2)/2"
LACKING = [driven("x_dot*y_dot - x*y - k*x^2/2"), driven("x_dot*y_dot - 4*x*y - k*y^2"),
           driven(PLAIN, forces=[{"value": "-k*x", "along": "y"}])]


class ResonantPairs(Service):
    def test_what_drives_another_at_its_own_frequency_is_not_stable(self):
        for scene in LACKING:
            with self.subTest(scene["lagrangian"]):
                found = self.ask("modes", {"system": scene})
                self.assertEqual(found["equilibrium"]["stability"], "neutral")
                self.assertNotIn("neither grow nor decay", found["equilibrium"]["nonlinear"])
                run = self.ask("simulate", {"system": scene, "t_end": 200, "samples": 401})
                size = {q: max(map(abs, run["trajectory"][q])) for q in "xy"}
                self.assertGreater(max(size.values()), 20*min(size.values()))

    def test_each_shape_is_one(self):
        """Within what is stated; and no second one is made up."""
        for scene in LACKING:
            with self.subTest(scene["lagrangian"]):
                found = self.ask("modes", {"system": scene})
                mass, stiffness = found["mass_matrix"], found["stiffness_matrix"]
                for mode in found["modes"]:
                    v = [mode["shape"][q] for q in "xy"]
                    for i in range(2):
                        rest = sum((stiffness[i][j] - mode["omega"]**2*mass[i][j])*v[j] for j in range(2))
                        self.assertLess(abs(rest), 1e-7, (mode, stiffness))

    def test_two_signs_with_two_shapes_have_both(self):
        for line, omega in (("x_dot*y_dot - x*y - 0.3*x^3/3", 1), ("x_dot*y_dot - 4*x*y - x^4", 2), ("x_dot*y_dot - x*y - 0.3*x^2*y", 1),
                            ("x_dot*y_dot + y_dot^2/2 - x*y - y^2/2 - x^3", 1)):
            with self.subTest(line):
                found = self.ask("modes", {"system": driven(line), "equilibrium": {"x": 0, "y": 0}})
                self.assertEqual(found["equilibrium"]["stability"], "neutral")
                for mode in found["modes"]:
                    self.assertEqual(mode["kind"], "oscillation")
                    self.assertLessEqual(abs(mode["omega"] - omega), mode["error"])
                self.assertEqual([[mode["shape"][q] for q in "xy"] for mode in found["modes"]], [[1, 0], [0, 1]])

    def test_equal_oscillators_that_do_not_drive_each_other_stay(self):
        found = self.ask("modes", {"system": driven(PLAIN)})
        self.assertEqual(found["equilibrium"]["stability"], "stable")
        self.assertEqual([mode["multiplicity"] for mode in found["modes"]], [2, 2])


if __name__ == "__main__":
    unittest.main()
