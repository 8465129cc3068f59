"""Turning points where impacts may lie on the way: the energy integral knows only of walls that take nothing."""

import math
import pathlib
import sys
import unittest
from fractions import Fraction

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402


def oscillator(wall="x+b", b="0.3", restitution="1", **event):
    """x'' = -x from x = 1 at rest, with a wall where `wall` falls through 0."""
    return {"name": "walled", "units": "none", "lagrangian": "x_dot^2/2-x^2/2",
            "parameters": [{"name": "b", "default": b}], "coordinates": [{"name": "x", "initial": "1"}],
            "events": [{"name": "w", "expression": wall, "direction": "falling", **event}],
            "impact": {"event": "w", "restitution": restitution}}


def brake(b):
    """The same, stopped where it moves to the right faster than b."""
    return {**oscillator(wall="b-x_dot", b=b), "impact": {"event": "w", "map": {"x_dot": "0"}}}


PLANET = {"name": "planet", "units": "none", "lagrangian": "m*(r_dot^2+r^2*ph_dot^2)/2+k/r",
          "parameters": [{"name": "m", "default": "1"}, {"name": "k", "default": "4"}],
          "coordinates": [{"name": "r", "initial": "1"}, {"name": "ph", "initial": "0", "initial_rate": "2"}]}


class TurningAtWalls(Service):
    def test_a_bouncing_ball_is_followed(self):
        problem = self.refused("turning_points", {"system": "bouncing_ball"})
        self.assertEqual([error["pointer"] for error in problem["errors"]], ["#/t_end"])
        self.assertIn("impact", problem["errors"][0]["detail"])
        answer = self.ask("turning_points", {"system": "bouncing_ball", "t_end": 1})
        self.assertEqual(answer["method"], "trajectory")
        self.assertLessEqual(abs(answer["z_min"]), answer["error"]["z_min"])

    def test_the_motion_turns_at_a_wall(self):
        for restitution in ("1", "0.5"):
            answer = self.ask("turning_points", {"system": oscillator(restitution=restitution), "t_end": 3})
            self.assertEqual(answer["method"], "energy" if restitution == "1" else "trajectory")
            self.assertLessEqual(abs(answer["x_min"] + 0.3), answer["error"]["x_min"])
            self.assertEqual(answer["x_max"], 1)

    def test_the_error_at_a_wall_holds_what_rounding_does(self):
        for b in ("0", "0.5", "0.001", "0.000000001", "-0.2"):
            for restitution, t_end in (("1", 7), ("0.5", 3), ("0.5", 7)):
                answer = self.ask("turning_points", {"system": oscillator(b=b, restitution=restitution), "t_end": t_end})
                distance = abs(Fraction(answer["x_min"]) + Fraction(b))
                self.assertLessEqual(distance, Fraction(answer["error"]["x_min"]), (b, restitution, t_end))
                self.assertLess(answer["error"]["x_min"], 1e-13)

    def test_so_does_the_error_of_what_follows_the_wall(self):
        """The largest value of a motion that keeps its energy is that without the wall."""
        for potential, b, x, v, t_end in (("1-cos(x)", "0.7", "0.93", "-0.096", 9.4),
                                          ("x^2/2+x^3/10", "0.333", "0.38", "0.075", 16.21)):
            scene = {**oscillator(b=b, when="1"), "lagrangian": f"x_dot^2/2-({potential})",
                     "coordinates": [{"name": "x", "initial": x, "initial_rate": v}]}
            answer = self.ask("turning_points", {"system": scene, "t_end": t_end})
            free = self.ask("turning_points", {"system": scene, "impacts": False})
            self.assertEqual((answer["method"], free["method"]), ("trajectory", "energy"))
            self.assertLessEqual(abs(Fraction(answer["x_max"]) - Fraction(free["x_max"])),
                                 Fraction(answer["error"]["x_max"]) + Fraction(free["error"]["x_max"]))

    def period(self, scene, **initial):
        answer = self.ask("turning_points", {"system": scene, "initial": initial})
        self.assertEqual((answer["method"], answer["motion"]), ("energy", "libration"))
        self.assertLess(answer["error"]["period"], 1e-12)
        return answer["period"], answer["exact"]["period"]["text"], answer

    def test_between_walls_that_take_nothing_the_period_has_its_formula(self):
        ball = {"name": "ball", "parameters": [{"name": "m", "unit": "kg", "default": 2}, {"name": "h", "unit": "m", "default": 1.5},
                                               {"name": "g", "unit": "m/s^2", "default": 9.81}],
                "coordinates": [{"name": "z", "unit": "m", "initial": "h"}],
                "bodies": [{"kind": "particle", "mass": "m", "position": ["0", "z"]}], "gravity": ["0", "-g"],
                "events": [{"name": "floor", "expression": "z", "direction": "falling"}],
                "impact": {"event": "floor", "map": {"z_dot": "-z_dot"}}}
        period, text, answer = self.period(ball)
        self.assertAlmostEqual(period, 2*math.sqrt(2*1.5/9.81), 14)
        self.assertEqual(text, "2*sqrt(2*h/g)")
        self.assertEqual((answer["z_min"], answer["z_max"]), (0, 1.5))
        self.assertIn("'floor'", answer["notes"][0])
        # Thrown from the floor.
        self.assertAlmostEqual(self.period(ball, z=0, z_dot=3)[0], 2*3/9.81, 14)
        box = {"name": "box", "parameters": [{"name": "m", "unit": "kg", "default": 2}, {"name": "L", "unit": "m", "default": 1.5},
                                             {"name": "v", "unit": "m/s", "default": 3}],
               "coordinates": [{"name": "x", "unit": "m", "initial": "L/3", "initial_rate": "v"}],
               "bodies": [{"kind": "particle", "mass": "m", "position": ["x", "0"]}],
               "events": [{"name": "left", "expression": "x", "direction": "falling"},
                          {"name": "right", "expression": "L - x", "direction": "falling"}],
               "impacts": [{"event": "left", "restitution": "1"}, {"event": "right", "restitution": "1"}]}
        period, text, answer = self.period(box)
        self.assertAlmostEqual(period, 2*1.5/3, 14)
        self.assertEqual(text, "2*L/v")
        self.assertEqual((answer["x_min"], answer["x_max"], answer["exact"]["x_max"]["text"]), (0, 1.5, "L"))
        # On a spring with a wall in the middle, and beside it: x'' = -x from 1.
        self.assertAlmostEqual(self.period(oscillator(b="0"))[0], math.pi, 14)
        for b in ("0.3", "-0.4", "0.9"):
            period, text, _ = self.period(oscillator(b=b))
            self.assertAlmostEqual(period, 2*math.acos(-float(b)), 14)
            self.assertEqual(text.replace(" ", ""), "2*acos(-b)")

    def test_the_error_of_a_period_holds_the_rounding_of_both_walls(self):
        scene = {**oscillator(wall="x-b", b="-0.486"), "lagrangian": "x_dot^2/2-899/2000*x^2",
                 "events": [{"name": "w", "expression": "x-b", "direction": "falling"},
                            {"name": "u", "expression": "29/125-x", "direction": "falling"}],
                 "impacts": [{"event": "w", "restitution": "1"}, {"event": "u", "restitution": "1"}]}
        del scene["impact"]
        answer = self.ask("turning_points", {"system": scene, "initial": {"x": -0.187, "x_dot": -0.441}})
        true = Fraction("3.805842607372207479858217302864385561")  # 2 (acos(b/A) - acos(c/A))/omega, by mpmath
        self.assertLessEqual(abs(Fraction(answer["period"]) - true), Fraction(answer["error"]["period"]))

    def test_the_period_at_a_wall_is_that_of_the_motion(self):
        """Of potentials without a formula: the second fall meets the wall one period after the first."""
        for potential, b, x, v in (("1-cos(x)", "0.7", "0.93", "-0.096"), ("x^2/2+x^3/10", "0.333", "0.38", "0.075")):
            scene = {**oscillator(b=b), "lagrangian": f"x_dot^2/2-({potential})",
                     "coordinates": [{"name": "x", "initial": x, "initial_rate": v}]}
            answer = self.ask("turning_points", {"system": scene})
            self.assertEqual(answer["method"], "energy")
            motion = self.ask("simulate", {"system": scene, "t_end": 20, "samples": 2, "accuracy": "accurate"})
            times = [event["t"] for event in motion["events"] if event["name"] == "w"]
            self.assertAlmostEqual(times[1] - times[0], answer["period"], 9)

    def test_without_impacts_the_energy_answers(self):
        answer = self.ask("turning_points", {"system": oscillator(), "impacts": False})
        self.assertEqual((answer["method"], answer["x_min"]), ("energy", -1))

    def test_a_wall_out_of_reach_changes_nothing(self):
        for scene in (oscillator(b="1.01"), oscillator(wall="x^2+b"), brake("1.01")):
            answer = self.ask("turning_points", {"system": scene})
            self.assertEqual((answer["method"], answer["motion"], answer["x_min"]), ("energy", "libration", -1))
            self.assertAlmostEqual(answer["period"], 2 * math.pi)

    def test_a_wall_that_is_touched_or_moves_is_not_excluded(self):
        for scene in (oscillator(b="1"), oscillator(wall="x+b-t", b="9"), brake("0.9")):
            self.refused_at("turning_points", {"system": scene}, "#/t_end")

    def test_walls_of_ignorable_coordinates_are_not_excluded(self):
        scene = {**PLANET, "events": [{"name": "w", "expression": "3-ph", "direction": "falling"}],
                 "impact": {"event": "w", "restitution": "1"}}
        self.refused_at("turning_points", {"system": scene, "coordinate": "r", "initial": {"r": 1.1}}, "#/t_end")

    def test_an_equilibrium_behind_a_wall_is_marked(self):
        scene = {**oscillator(wall="x", b="0"), "lagrangian": "x_dot^2/2-(x+1)^2/2"}
        answer = self.ask("equilibria", {"system": scene})
        self.assertIn("behind", answer["equilibria"][0]["note"])
        self.assertTrue(any("pressed" in note for note in answer["notes"]))
        before = self.ask("equilibria", {"system": oscillator()})
        self.assertNotIn("note", before["equilibria"][0])

    def test_a_circle_does_not_rest(self):
        answer = self.ask("turning_points", {"system": PLANET, "coordinate": "r"})
        self.assertEqual(answer["motion"], "equilibrium")
        self.assertNotIn("rest", answer["reason"]["period"])


if __name__ == "__main__":
    unittest.main()
