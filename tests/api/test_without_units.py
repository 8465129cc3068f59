"""Scenes without units: Lagrangians as textbooks print them, where everything is a number, t included."""

import math
import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402


def scene(lagrangian, *coordinates, **more):
    return {"name": "printed", "units": "none", "lagrangian": lagrangian,
            "coordinates": [{"name": name} for name in coordinates]} | more


HENON_HEILES = scene("(x_dot^2 + y_dot^2)/2 - (x^2 + y^2)/2 - x^2*y + y^3/3", "x", "y")
PENDULUM = {**scene("theta_dot^2/2 + cos(theta)"), "coordinates": [{"name": "theta", "unit": "rad"}]}


def units_in(value):
    """Every unit that an answer speaks of."""
    if isinstance(value, dict):
        for name, part in value.items():
            if name == "unit":
                yield part
            elif name == "units":
                yield from leaves(part)
            elif name != "request":
                yield from units_in(part)
    elif isinstance(value, list):
        for part in value:
            yield from units_in(part)


def leaves(value):
    return [leaf for part in value.values() for leaf in leaves(part)] if isinstance(value, dict) else (
        [leaf for part in value for leaf in leaves(part)] if isinstance(value, list) else [value])


class WithoutUnits(Service):
    def test_henon_and_heiles(self):
        start = {"x": 0.1, "y": -0.1, "x_dot": 0.2, "y_dot": 0}
        motion = self.ask("simulate", {"system": HENON_HEILES, "initial": start, "t_end": 50, "include": ["energy"]})
        self.assertLess(motion["diagnostics"]["conserved"][0]["max_abs_drift"], 1e-8)
        modes = self.ask("modes", {"system": HENON_HEILES})
        self.assertEqual([mode["omega"] for mode in modes["modes"]], [1, 1])
        saddle = self.ask("energy", {"system": HENON_HEILES, "initial": {"x": 0, "y": 1, "x_dot": 0, "y_dot": 0}})
        self.assertAlmostEqual(saddle["h"], 1 / 6, 15)
        found = self.ask("equilibria", {"system": HENON_HEILES})
        self.assertTrue(found["complete"])
        places = sorted((e["state"]["x"], e["state"]["y"]) for e in found["equilibria"])
        for place, true in zip(places, [(-math.sqrt(0.75), -0.5), (0, 0), (0, 1), (math.sqrt(0.75), -0.5)], strict=True):
            self.assertAlmostEqual(math.dist(place, true), 0, 14)

    def test_time_is_a_number_too(self):
        answer = self.ask("simulate", {"system": scene("x_dot^2/2 - x^2/2 + x*cos(t)", "x"), "t_end": 20, "samples": 21,
                                       "initial": {"x": 0, "x_dot": 0}})
        for t, x in zip(answer["trajectory"]["t"], answer["trajectory"]["x"]):
            self.assertLessEqual(abs(x - t * math.sin(t) / 2), answer["accuracy"]["max_abs_error"]["x"] + 1e-14)

    def test_an_angle_keeps_its_turn(self):
        states = self.ask("equilibria", {"system": PENDULUM})["equilibria"]
        self.assertEqual(len(states), 2)
        answer = self.ask("turning_points", {"system": PENDULUM, "initial": {"theta": "90deg", "theta_dot": 0}})
        self.assertAlmostEqual(answer["period"], 7.416298709205487, 13)  # 4 K(1/2)
        self.assertEqual(answer["units"]["theta_max_deg"], "deg")

    def test_no_answer_speaks_of_units(self):
        questions = {"simulate": {"t_end": 1, "include": ["energy", "momenta", "accelerations"]}, "energy": {}, "modes": {},
                     "equilibria": {}, "turning_points": {"t_end": 1, "coordinate": "x"},
                     "accuracy": {"t_end": 1}}
        for endpoint, more in questions.items():
            with self.subTest(endpoint=endpoint):
                self.assertEqual(set(units_in(self.ask(endpoint, {"system": HENON_HEILES} | more))), {"1"})
        extended = self.ask("simulate", {"system": HENON_HEILES, "t_end": 1, "samples": 2, "precision": "extended"})
        self.assertEqual(set(units_in(extended)), {"1"})
        self.assertIn("rad", set(units_in(self.ask("modes", {"system": PENDULUM}))))

    def test_a_unit_in_such_a_scene_is_refused(self):
        for unit in ("kg", "m/s", "deg"):
            wrong = {**HENON_HEILES, "coordinates": [{"name": "x", "unit": unit}, {"name": "y"}]}
            problem = self.refused_at("simulate", {"system": wrong, "t_end": 1}, "#/system/coordinates/0/unit")
            self.assertIn("no units", problem["errors"][0]["detail"])
        self.refused_at("simulate", {"system": HENON_HEILES, "t_end": 1, "initial": {"x": "3 m"}}, "#/initial/x")

    def test_a_scene_with_units_needs_them(self):
        with_units = {**scene("x_dot^2", "x"), "units": "SI"}
        problem = self.refused("simulate", {"system": with_units, "t_end": 1})
        self.assertIn(("#/system/coordinates/0", "missing"),
                      [(error["pointer"], error["code"]) for error in problem["errors"]])

    def test_constraints_too(self):
        circle = scene("(x_dot^2 + y_dot^2)/2 - y", "x", "y", constraints=[{"name": "circle", "expression": "x^2 + y^2 - 1"}])
        circle["coordinates"][1]["initial"] = -1
        answer = self.ask("energy", {"system": circle, "initial": {"x_dot": 2}})
        self.assertAlmostEqual(answer["multipliers"]["lambda_circle"], -5 / 2, 15)


if __name__ == "__main__":
    unittest.main()
