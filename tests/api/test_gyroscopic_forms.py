"""Modes that gyroscopic terms couple, as formulas: a sleeping top and its threshold, a charge in a magnetic field."""

import math
import pathlib
import random
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from constrained_scenes import coordinates, parameters  # noqa: E402
from service import Service  # noqa: E402

TOP = {
    "name": "sleeping_top",
    "parameters": parameters(m=("kg", "0.4"), h=("m", "0.04"), A=("kg*m^2", "0.002"), C=("kg*m^2", "0.001"),
                             w=("rad/s", "60"), g=("m/s^2", "9.81")),
    "coordinates": coordinates(a=("rad", "0", "0"), b=("rad", "0", "0")),
    "bodies": [{"kind": "rigid_body", "mass": "m", "principal_moments": ["A", "A", "C"],
                "centre": ["h*sin(b)", "-h*sin(a)*cos(b)", "h*cos(a)*cos(b)"],
                "orientation": {"sequence": "XYZ", "angles": ["a", "b", "w*t"]}}],
    "gravity": [0, 0, "-g"],
}


def value(text, values):
    return eval(text.replace("^", "**"), {"sqrt": math.sqrt, "pi": math.pi}, values)  # noqa: S307


class Gyroscopic(Service):
    def test_a_sleeping_top(self):
        rng = random.Random(4)
        for _ in range(20):
            values = {"m": rng.uniform(0.1, 1), "h": rng.uniform(0.02, 0.1), "A": rng.uniform(1e-3, 4e-3), "g": 9.81}
            values["C"] = rng.uniform(0.5e-3, 1.9 * values["A"])
            inertia = values["A"] + values["m"] * values["h"]**2
            threshold = math.sqrt(4 * inertia * values["m"] * 9.81 * values["h"]) / values["C"]
            for times in (1.05, 3):
                values["w"] = times * threshold
                answer = self.ask("modes", {"system": TOP, "parameters": values, "equilibrium": {"a": 0, "b": 0}})
                self.assertEqual([mode["kind"] for mode in answer["modes"]], ["oscillation"] * 2)
                for mode in answer["modes"]:
                    found = value(mode["exact"]["text"], values)
                    self.assertLess(abs(found - mode["omega"]**2), 1e-9 * mode["omega"]**2)
                    self.assertIn("sqrt(C^2*w^2 - 4*m*h*g*(A + m*h^2))", mode["exact"]["text"])
            values["w"] = 0.9 * threshold
            answer = self.ask("modes", {"system": TOP, "parameters": values, "equilibrium": {"a": 0, "b": 0}})
            self.assertEqual(answer["equilibrium"]["stability"], "unstable")
            self.assertFalse(any("exact" in mode for mode in answer["modes"]))

    def test_where_the_top_falls_asleep(self):
        threshold = math.sqrt(4 * (0.002 + 0.4 * 0.04**2) * 0.4 * 9.81 * 0.04) / 0.001
        asked = {"system": TOP, "parameter": "w", "from": 1}
        answer = self.ask("bifurcations", {**asked, "to": 0.9 * threshold})
        self.assertEqual((answer["critical"], answer["complete"]), ([], True))
        answer = self.ask("bifurcations", {**asked, "to": 3 * threshold})
        critical, other = answer["critical"]  # a = b = pi is the same place as a = b = 0
        self.assertEqual((critical["kind"], other["kind"], answer["complete"]), ("flutter", "flutter", True))
        self.assertEqual(len(answer["branches"]), 8)
        self.assertLessEqual(abs(critical["value"] - threshold), critical["error"] + 1e-15 * threshold)
        self.assertAlmostEqual(critical["omega"], 0.001 * threshold / (2 * (0.002 + 0.4 * 0.04**2)), 12)
        values = {"m": 0.4, "h": 0.04, "A": 0.002, "C": 0.001, "g": 9.81}
        self.assertAlmostEqual(value(critical["exact"]["text"], values), threshold, 12)

    def test_a_charge_on_springs_in_a_magnetic_field(self):
        scene = {"name": "charge", "parameters": parameters(m=("kg", "1"), k=("N/m", "4"), B=("kg/s", "0.8")),
                 "coordinates": coordinates(x=("m", "0", "0"), y=("m", "0", "0")),
                 "lagrangian": "m/2*(x_dot^2 + y_dot^2) - k/2*(x^2 + y^2) + B/2*(x*y_dot - y*x_dot)"}
        for mode, sign in zip(self.ask("modes", {"system": scene})["modes"], (-1, 1)):
            known = (math.sqrt(0.8**2 + 4 * 4) + sign * 0.8) / 2
            self.assertAlmostEqual(mode["omega"], known, 13)
            self.assertAlmostEqual(value(mode["exact"]["text"], {"m": 1, "k": 4, "B": 0.8}), known**2, 12)

    def test_damping_beside_it_has_no_formula(self):
        scene = TOP | {"dissipation": "c*(a_dot^2 + b_dot^2)/2", "parameters": TOP["parameters"] + parameters(
            c=("N*m*s", "1e-4"))}
        answer = self.ask("modes", {"system": scene, "equilibrium": {"a": 0, "b": 0}})
        self.assertFalse(any("exact" in mode for mode in answer["modes"]))


class QuarterTurns(Service):
    def test_a_wheel_on_its_rim_has_no_cosine_of_a_quarter(self):
        scene = {"name": "wheel", "parameters": parameters(m=("kg", "1"), r=("m", "0.5")),
                 "coordinates": coordinates(psi=("rad", "0", "1"), phi=("rad", "0", "2")),
                 "bodies": [{"kind": "ring", "mass": "m", "radius": "r", "centre": [0, 0, "r"],
                             "orientation": {"sequence": "ZXZ", "angles": ["psi", "pi/2", "-phi"]}}]}
        answer = self.ask("equations", {"system": scene})
        self.assertNotIn("cos", answer["T"])
        self.assertEqual(self.ask("energy", {"system": scene})["T"], 0.25 * (1 / 4 + 4 / 2))


if __name__ == "__main__":
    unittest.main()
