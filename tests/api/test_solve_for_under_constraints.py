"""The parameter, or the spin, that holds a position on the surface of constraints: closed forms and virtual work, with
formulas, stability, and reasons where there is none."""

import copy
import math
import pathlib
import random
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import constrained_scenes as scenes  # noqa: E402
from service import Service  # noqa: E402
from short_scene import DOWN, DOWN_3D, G, particle, rod, scene  # noqa: E402

ROUNDING = 4e-16  # of the closed form in doubles, a few times


def pushed(system, point, parameter="F"):
    """With a horizontal force at a point."""
    found = copy.deepcopy(system)
    found["parameters"].append({"name": parameter, "unit": "N", "default": 1})
    return {**found, "forces": [{"vector": [parameter, "0"], "point": point}]}


PENDULUM = pushed(scenes.PENDULUM_BY_CONSTRAINT, ["x", "y"])
TWO_BOBS = pushed(scenes.DOUBLE_PENDULUM, ["x2", "y2"])
CONE = scene("cone", f"m kg 1; l m 0.5; {G}", "r m 0.3; psi rad 0 1; z m -0.4", gravity=DOWN_3D,
             bodies=[particle("m", "r*cos(psi)", "r*sin(psi)", "z")], constraints=[{"name": "rod", "expression": "r^2 + z^2 - l^2"}])
HOOP = scene("hoop", f"m kg 1; R m 0.5; Omega rad/s 6; {G}", "x m; y m; z m -R", gravity=DOWN_3D,
             bodies=[particle("m", "x*cos(Omega*t) - y*sin(Omega*t)", "x*sin(Omega*t) + y*cos(Omega*t)", "z")],
             constraints=[{"name": "plane", "expression": "y"}, {"name": "hoop", "expression": "x^2 + z^2 - R^2"}])
LADDER = scene("ladder", f"m kg 1; l m 2; H N 1; {G}", "x m 1.2; y m 1.6", gravity=DOWN, bodies=[rod("m", ["x", "0"], ["0", "y"])],
               forces=[{"vector": ["-H", "0"], "point": ["x", "0"]}], constraints=[{"name": "length", "expression": "x^2 + y^2 - l^2"}])
CRANK = scene("crank", f"m kg 1; M kg 2; r m 0.2; L m 0.5; F N 3; tau N*m 1; {G}", "th rad 0.5; x m 0.6", gravity=DOWN,
              bodies=[particle("M", "x", "0"), particle("m", "r*cos(th)", "r*sin(th)")],
              forces=[{"vector": ["-F", "0"], "point": ["x", "0"]}, {"value": "tau", "along": "th"}],
              constraints=[{"name": "rod", "expression": "(x - r*cos(th))^2 + (r*sin(th))^2 - L^2"}])
ROLLING = copy.deepcopy(scenes.ROLLING_DISK)
ROLLING["parameters"].append({"name": "k", "unit": "N/m", "default": 10})
ROLLING["springs"] = [{"stiffness": "k", "length": "x"}]


class SolveFor(Service):
    def solved(self, system, unknown, at, **more):
        return self.ask("equilibria", {"system": system, "solve_for": unknown, "at": at, **more})

    def check(self, system, unknown, at, expected, exact=None, stability=None):
        answer = self.solved(system, unknown, at)
        self.assertIsNotNone(answer[unknown], answer.get("reason"))
        self.assertLessEqual(abs(answer[unknown] - expected), answer["error"] + 4 * ROUNDING * abs(expected), answer)
        self.assertLess(answer["error"], 1e-12 * abs(expected))
        if exact:
            self.assertEqual(answer["exact"]["text"], exact)
        if stability:
            self.assertEqual(answer["stability"], stability)
        return answer

    def test_a_force_holds_a_pendulum_aside(self):
        draw = random.Random(1)
        for _ in range(20):
            x = round(draw.uniform(-0.65, 0.65), 3)
            answer = self.check(PENDULUM, "F", {"x": x}, 0.3 * 9.81 * x / math.sqrt(0.49 - x**2), "-m*g*x/y", "stable")
            self.assertAlmostEqual(answer["request"]["at"]["y"], -math.sqrt(0.49 - x**2), 14)
        self.check(PENDULUM, "F", {"x": 0.42, "y": -0.56}, 0.3 * 9.81 * 0.75)

    def test_a_force_holds_two_bobs(self):
        """tan(b) = F/(m g) and tan(a) = F/(2 m g); at other angles no F does."""
        for force in (1.0, 7.5, 30.0):
            a, b = math.atan(force / (2 * 9.81)), math.atan(force / 9.81)
            at = {"x1": math.sin(a), "x2": math.sin(a) + math.sin(b)}
            self.check(TWO_BOBS, "F", at, force, stability="stable")
            reason = self.solved(TWO_BOBS, "F", {**at, "x2": at["x2"] + 0.01})["reason"]
            self.assertIn("not in balance", reason)

    def test_spins_that_hold_a_cone_and_a_bead(self):
        for r in (0.1, 0.3, 0.45):
            spin = math.sqrt(9.81 / math.sqrt(0.25 - r**2))
            self.check(CONE, "psi_dot", {"r": r}, spin, "sqrt(-g/z)", "stable")
            answer = self.check(HOOP, "Omega", {"x": r}, spin, "sqrt(-g/z)", "stable")
            self.assertEqual(answer["all"][1]["Omega"], -answer["Omega"])

    def test_virtual_work_of_a_crank_and_a_ladder(self):
        self.check(LADDER, "H", {"x": 1.2}, 9.81 / 2 * 0.75, "m*g*x/(2*y)", "unstable")
        for th in (0.3, 0.7, 1.4, -0.9):
            root = math.sqrt(0.25 - (0.2 * math.sin(th))**2)
            slope = -0.2 * math.sin(th) - 0.04 * math.sin(th) * math.cos(th) / root  # dx/dth
            self.check(CRANK, "tau", {"th": th}, 3 * slope + 9.81 * 0.2 * math.cos(th))

    def test_a_length_that_a_constraint_fixes(self):
        self.check(scenes.PENDULUM_BY_CONSTRAINT, "l", {"x": 0, "y": -0.8}, 0.8)
        self.assertIn("not in balance", self.solved(scenes.PENDULUM_BY_CONSTRAINT, "l", {"x": 0.6, "y": -0.8})["reason"])

    def test_what_rolls_is_held_by_a_spring(self):
        """A constraint in the velocities allows every place, and forces that balance along it."""
        answer = self.check(ROLLING, "k", {"x": 0.2}, 2 * 9.81 * math.sin(0.4) / 0.2, "m*g*sin(alpha)/x")
        self.assertNotIn("no equilibrium", answer.get("undecided", "") + answer.get("nonlinear", ""))

    def test_a_place_off_the_surface_is_refused(self):
        problem = self.refused("equilibria", {"system": PENDULUM, "solve_for": "F", "at": {"x": 0.42, "y": -0.5}})
        self.assertEqual([(e["pointer"], e["code"]) for e in problem["errors"]], [("#/at", "inconsistent_state")])
        self.assertIn("Near it does x = 0.4502", problem["errors"][0]["detail"])
        self.refused_at("equilibria", {"system": PENDULUM, "solve_for": "F", "at": {}}, "#/at/x", "#/at/y")
        self.refused("equilibria", {"system": PENDULUM, "solve_for": "F", "at": {"x": 0.9}})

    def test_where_constraints_depend_on_each_other_nothing_is_told(self):
        system = scene("rods", f"m kg 1; F N 1; {G}", "x m; y m", gravity=DOWN, bodies=[particle("m", "x", "y")],
                       forces=[{"vector": ["F", "0"], "point": ["x", "y"]}], constraints=[{"name": "axes", "expression": "x*y"}])
        self.assertIn("has no slope", self.raw_reason(system))

    def raw_reason(self, system):
        response = self.post("equilibria", {"system": system, "solve_for": "F", "at": {"x": 0, "y": 0}})
        return response.data.decode()


if __name__ == "__main__":
    sys.exit(unittest.main())
