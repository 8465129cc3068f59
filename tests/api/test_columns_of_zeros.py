"""A column that is 0 all along has no size that an error could be compared with: what is kept for underflow is not what
keeps a promise from being met."""

import pathlib
import sys
import unittest

from mpmath import mp, mpf

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import DOWN, lagrangian, particle, rod, scene  # noqa: E402


def parameter(name, unit, default):
    return {"name": name, "unit": unit, "default": default}


mp.dps = 40

# A block that is pulled on another one, both sliding: h is held at 0.
STACK = {"name": "stack", "gravity": ["0", "-g"],
         "parameters": [parameter("m", "kg", "1"), parameter("M", "kg", "2"), parameter("mu", "1", "0.3"),
                        parameter("F", "N", "12"), parameter("g", "m/s^2", "9.81")],
         "coordinates": [{"name": name, "unit": "m"} for name in ("X", "x", "h")],
         "bodies": [{"kind": "particle", "mass": "M", "position": ["X", "0"]},
                    {"kind": "particle", "mass": "m", "position": ["x", "h"]}],
         "constraints": [{"name": "on", "expression": "h", "multiplier": "N"}],
         "forces": [{"value": "-mu*N*sign(x_dot-X_dot)", "along": "x-X"}, {"value": "F", "along": "X"}]}

OFF_A_BALL = scene("off", "m kg 1; R m 2; g m/s^2 9.81", "x m 0 1; y m R", bodies=[particle("m", "x", "y")], gravity=DOWN,
                   constraints=[{"name": "ball", "expression": "sqrt(x^2 + y^2) - R", "multiplier": "N"}],
                   valid_while=[{"name": "push", "unit": "N", "expression": "N", "reason": "lift_off", "message": "leaves"}])
DUMBBELL = scene("dumbbell", "m kg 1; l m 1; g m/s^2 9.81", "x1 m 0; y1 m l*cos(0.1); x2 m l*sin(0.1); y2 m 0", gravity=DOWN,
                 bodies=[particle("m", "x1", "y1"), particle("m", "x2", "y2")],
                 constraints=[{"name": "wall", "expression": "x1"}, {"name": "floor", "expression": "y2"},
                              {"name": "rod", "expression": "(x1 - x2)^2 + (y1 - y2)^2 - l^2"}])
CRADLE = lagrangian("cradle", "l - 1; g - 9.81; e - 1", "a - -0.8; b - 0; c - 0.002",
                    "(a_dot^2 + b_dot^2 + c_dot^2)/2 + g*(cos(a) + cos(b) + cos(c))",
                    events=[{"name": "left", "expression": "b - a", "direction": "falling"},
                            {"name": "right", "expression": "c - b", "direction": "falling"}],
                    impacts=[{"event": "left", "restitution": "e"}, {"event": "right", "restitution": "e"}])

# Friction at the floor holds it against a smooth wall.
LADDER = scene("held_ladder", "m kg 3; l m 2; mu 1 0.5; g m/s^2 9.81", "x m l/2*sin(0.6); y m l/2*cos(0.6); th rad 0.6",
               gravity=DOWN, bodies=[rod("m", ["x + l/2*sin(th)", "y - l/2*cos(th)"], ["x - l/2*sin(th)", "y + l/2*cos(th)"])],
               constraints=[{"name": "floor", "expression": "y - l/2*cos(th)", "multiplier": "N"},
                            {"name": "wall", "expression": "x - l/2*sin(th)"}],
               forces=[{"value": "-mu*N*sign(x_dot + l/2*th_dot*cos(th))", "along": "x + l/2*sin(th)"}])


class ColumnsOfZeros(Service):
    def test_the_promise_is_met_beside_a_column_of_zeros(self):
        for accuracy in ("fast", "balanced", "accurate"):
            found = self.ask("simulate", {"system": STACK, "t_end": 1, "samples": 3, "accuracy": accuracy})["accuracy"]
            error = found["max_abs_error"]
            self.assertLess(error["h"], 1e-200)
            self.assertLess(error["X"], 1e-12)
            self.assertTrue(found["meets_request"], found.get("reason"))

    def test_the_promise_is_met_beside_rounding_of_zero(self):
        for scene, end in ((OFF_A_BALL, 5), (OFF_A_BALL, 0.8), (DUMBBELL, 0.5), (CRADLE, 2.9)):
            for accuracy in ("fast", "balanced", "accurate"):
                found = self.ask("simulate", {"system": scene, "t_end": end, "samples": 2, "accuracy": accuracy})["accuracy"]
                self.assertTrue(found["meets_request"], (scene["name"], found.get("reason"), found["max_abs_error"]))

    def test_the_promise_is_met_where_all_rests(self):
        for end in (0.1, 1, 50):
            for accuracy in ("fast", "balanced", "accurate"):
                found = self.ask("simulate", {"system": LADDER, "t_end": end, "samples": 5, "accuracy": accuracy})["accuracy"]
                self.assertTrue(found["meets_request"], (end, found.get("reason"), found["max_abs_error"]))
                self.assertIsNone(found["horizon"])

    def test_a_column_that_is_not_zero_keeps_its_promise(self):
        two = lagrangian("two", "k - 4; e - 1e-9", "x - 1; y - 0", "(x_dot^2 + y_dot^2)/2 - k*x^2/2 - y^2/2 + e*x*y")
        answer = self.ask("simulate", {"system": two, "t_end": 20, "samples": 40, "accuracy": "fast"})
        size = max(abs(y) for y in answer["trajectory"]["y"])
        self.assertLessEqual(answer["accuracy"]["max_abs_error"]["y"], 1e-3 * size)

    def test_what_has_hardly_begun_is_within_its_error(self):
        """A fast body passes a bump beside its way: y is far below every tolerance when the run ends."""
        for width, side, end in (("0.1", "0.1", 3), ("0.1", "0.1", 4), ("0.1", "0.1", 4.2), ("0.3", "-0.2", 3.5),
                                 ("0.05", "0.02", 4.6), ("0.2", "0.4", 4), ("1e-2", "3e-3", 4.9)):
            bump = lagrangian(
                "bump", "", "x - 0 1; y - 0 0",
                f"x_dot^2/2 + y_dot^2/2 - exp(-((x - 5)^2 + (y - ({side}))^2)/({width})^2)")
            del bump["parameters"]
            w, b = mpf(width), mpf(side)
            known = -mp.quad(lambda t: 2*b/w**2*mp.exp(-((t - 5)**2 + b**2)/w**2), [0, end - 1, mpf(end) - w / 5, end])
            for options in ({"rtol": 1e-12}, {"accuracy": "fast"}, {"precision": "extended"}):
                with self.subTest(width=width, side=side, end=end, **options):
                    answer = self.ask("simulate", {"system": bump, "t_end": end, "samples": 2, **options})
                    off = abs(mpf(str(answer["trajectory"]["y_dot"][-1])) - known)
                    self.assertLessEqual(off, answer["accuracy"]["max_abs_error"]["y_dot"] * (1 + 1e-9) + abs(known) * 1e-9)


if __name__ == "__main__":
    unittest.main()
