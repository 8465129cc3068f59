"""Impacts that are derived: with restitution, and of a contact that is made while another is left."""

import json
import math
import pathlib
import random
import sys
import unittest

import mpmath
import numpy

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from constrained_scenes import coordinates, parameters  # noqa: E402
from service import ROOT, Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

BALL = {
    "name": "bouncing_ball",
    "parameters": parameters(m=("kg", "0.3"), e=("1", "0.8"), g=("m/s^2", "9.81")),
    "coordinates": coordinates(x=("m", "0", "1"), y=("m", "2", "0")),
    "bodies": [{"kind": "particle", "mass": "m", "position": ["x", "y"]}],
    "gravity": [0, "-g"],
    "events": [{"name": "bounce", "expression": "y", "direction": "falling"}],
    "impact": {"event": "bounce", "restitution": "e"},
}


class Restitution(Service):
    def test_a_ball_bounces_and_comes_to_rest_in_time_and_place(self):
        answer = self.ask("simulate", {"system": BALL, "t_end": 10, "samples": 11, "events": ["bounce"]})
        fall = math.sqrt(2 * 2 / 9.81)
        for n, event in enumerate(answer["events"][:10]):
            known = fall * (1 + 2 * sum(0.8**k for k in range(1, n + 1)))
            self.assertAlmostEqual(event["t"], known, 10)
        end = fall * (1 + 2 * 0.8 / (1 - 0.8))
        self.assertEqual((answer["status"], answer["stop"]["reason"]), ("stopped", "impacts_accumulate"))
        self.assertAlmostEqual(answer["stop"]["t"], end, 6)
        self.assertAlmostEqual(answer["strides"][-1]["state"]["x"], end, 5)
        self.assertAlmostEqual(answer["strides"][-1]["state"]["y"], 0, 6)

    def test_a_ball_that_does_not_bounce_stays_in_contact(self):
        answer = self.ask("simulate", {"system": BALL, "parameters": {"e": 0}, "t_end": 10, "samples": 11})
        stop = answer["stop"]
        self.assertIn("stay in contact", stop["message"])
        self.assertLessEqual(abs(stop["t"] - math.sqrt(4 / 9.81)), stop["error"])
        self.assertLess(stop["error"], 1e-12)
        lying = self.ask("simulate", {"system": BALL, "initial": {"y": 0}, "t_end": 1, "samples": 11})
        self.assertIn("stay in contact", lying["stop"]["message"])
        bouncing = self.ask("simulate", {"system": BALL, "parameters": {"e": 0.01}, "t_end": 10, "samples": 11})
        self.assertIn("faster and faster", bouncing["stop"]["message"])

    def test_a_restitution_is_between_0_and_1(self):
        for e in (-0.1, 1.01, -1e-300):
            problem = self.refused_at("simulate", {"system": BALL, "parameters": {"e": e}, "t_end": 1}, "#/parameters")
            self.assertIn("'bounce' is not between 0 and 1", problem["errors"][0]["detail"])
        self.ask("simulate", {"system": BALL, "parameters": {"e": 1}, "t_end": 1})

    def test_what_is_kept_is_kept_between_impacts(self):
        free = BALL | {"gravity": [0, 0]}
        for scene in (BALL, free):
            kept = self.ask("equations", {"system": scene})["conserved"]
            self.assertTrue(kept)
            for one in kept:
                self.assertIn("constant between impacts", one["why"])
        kept = self.ask("equations", {"system": {name: free[name] for name in free if name != "impact"}})["conserved"]
        self.assertTrue(kept)
        for one in kept:
            self.assertNotIn("impact", one["why"])

    def test_what_is_met_just_after_the_start_is_met(self):
        """From a height that is far less than what rounds the motion later on."""
        for distance in ("0.00000000000000013", "1.3e-17", "2e-19"):
            floor = lagrangian("floor", "", f"x - {distance} -1", "x_dot^2/2", events=[{"name": "hit", "expression": "x", "direction": "falling"}],
                               impacts=[{"event": "hit", "restitution": 0.5}])
            answer = self.ask("simulate", {"system": floor, "t_end": 0.3, "samples": 2})
            self.assertEqual([e["name"] for e in answer["events"]], ["hit"], distance)
            self.assertAlmostEqual(answer["trajectory"]["x"][-1], 0.15, 14)
            ending = lagrangian("ending", "", "x - 0 1", "x_dot^2/2", valid_while=[{"name": "room", "expression": f"{distance} - x", "reason": "touch", "message": "It touches."}])
            self.assertAlmostEqual(self.ask("simulate", {"system": ending, "t_end": 0.3, "samples": 2})["stop"]["t"] / float(distance), 1, 9)
            passed = self.ask("simulate", {"system": lagrangian("passing", "", "x - 0 1", "x_dot^2/2"), "t_end": 0.3, "samples": 2, "events": [f"x = {distance}"]})
            self.assertEqual(len(passed["events"]), 1, distance)

    def test_a_kick_after_which_it_goes_on_through_the_surface_is_one(self):
        for event, kick, x in (("x - 0.5", "x_dot/2", 1.3), ("t - 0.4", "x_dot + 1", 3.7), ("(x - 0.5)*(1 + x^2)", "3*x_dot", 5.3)):
            scene = lagrangian("kicked", "", "x - 0.1 1", "x_dot^2/2", events=[{"name": "kick", "expression": event, "direction": "rising"}],
                               impact={"event": "kick", "map": {"x_dot": kick}})
            answer = self.ask("simulate", {"system": scene, "t_end": 2, "samples": 3})
            self.assertEqual((answer["status"], [e["name"] for e in answer["events"]]), ("complete", ["kick"]))
            self.assertAlmostEqual(answer["trajectory"]["x"][-1], x, 12)

    def test_a_ball_that_is_let_go_as_high_as_rounding_has_an_error_or_a_reason(self):
        """It rests after three times its fall, or twice its first flight's third."""
        mpmath.mp.dps = 40
        for floor in ("0.3", "0"):
            for power in range(8, 20):
                for height, speed in ((mpmath.mpf(f"1e-{power}"), 0), (0, f"1e-{power}")):
                    ball = lagrangian("ball", "", "y - 0 0", "y_dot^2/2 - 9.81*y", events=[{"name": "hit", "expression": f"y - {floor}", "direction": "falling"}],
                                      impacts=[{"event": "hit", "restitution": 0.5}])
                    ball["coordinates"][0] = {"name": "y", "initial": str(mpmath.mpf(floor) + height), "initial_rate": speed}
                    start = float(f"1e-{power}")
                    true = 4*start/9.81 if speed else 3*math.sqrt(2*start/9.81)
                    answer = self.ask("simulate", {"system": ball, "t_end": 0.2, "samples": 2})
                    error = answer["stop"].get("error")
                    if error is None:
                        self.assertTrue(answer["accuracy"]["reason"], (floor, power))
                    else:
                        self.assertLessEqual(abs(answer["stop"]["t"] - true), error, (floor, power, height, speed))

    def test_an_event_without_a_direction_is_met_once_from_either_side(self):
        for speed in (1, -1):
            wall = lagrangian("wall", "", f"x - 0 {speed}", "x_dot^2/2", events=[{"name": "hit", "expression": f"x - {0.5*speed}"}],
                              impacts=[{"event": "hit", "restitution": 0.5}])
            answer = self.ask("simulate", {"system": wall, "t_end": 1, "samples": 2})
            self.assertEqual((answer["status"], len(answer["events"])), ("complete", 1))
            self.assertAlmostEqual(answer["trajectory"]["x"][-1], 0.25*speed, 12)

    def after(self, scene, state):
        """Velocities just after an impact at which the state is."""
        answer = self.ask("simulate", {"system": scene, "initial": state, "t_end": 1e-9, "times": [1e-9], "events": [
            scene["impact"]["event"]]})
        self.assertEqual(len(answer["events"]), 1, answer["events"])
        return {name: values[-1] for name, values in answer["trajectory"].items()}

    def test_against_a_line_and_a_circle(self):
        slope = BALL | {"events": [{"name": "bounce", "expression": "y*cos(0.3) - x*sin(0.3)", "direction": "falling"}]}
        round_wall = BALL | {"events": [{"name": "bounce", "expression": "R - sqrt(x^2 + y^2)", "direction": "falling"}],
                             "parameters": BALL["parameters"] + parameters(R=("m", "2"))}
        for scene, place, normal in ((slope, (1, math.tan(0.3)), (-math.sin(0.3), math.cos(0.3))),
                                     (round_wall, (1.2, 1.6), (-0.6, -0.8))):
            place, normal, v = numpy.array(place), numpy.array(normal), numpy.array([0.5, 0.2]) - numpy.array(normal)
            start = place + 1e-10 * normal - 0 * v
            found = self.after(scene, {"x": start[0], "y": start[1], "x_dot": v[0], "y_dot": v[1]})
            known = v - 1.8 * (v @ normal) * normal
            self.assertLess(abs(found["x_dot"] - known[0]) + abs(found["y_dot"] - known[1]), 1e-7)

    def test_two_particles_exchange_their_momentum(self):
        scene = {"name": "collision", "parameters": parameters(m1=("kg", "1"), m2=("kg", "3"), e=("1", "1")),
                 "coordinates": coordinates(x1=("m", "0", "2"), x2=("m", "1", "0")),
                 "bodies": [{"kind": "particle", "mass": f"m{i}", "position": [f"x{i}", 0]} for i in (1, 2)],
                 "events": [{"name": "meet", "expression": "x2 - x1", "direction": "falling"}],
                 "impact": {"event": "meet", "restitution": "e"}}
        for e in (1, 0.5):
            found = self.ask("simulate", {"system": scene, "parameters": {"e": e}, "t_end": 1, "samples": 2})["trajectory"]
            self.assertAlmostEqual(found["x1_dot"][-1], 2 * (1 - 3 * e) / 4, 12)
            self.assertAlmostEqual(found["x2_dot"][-1], 2 * (1 + e) / 4, 12)

    def test_a_rod_that_falls_on_its_end_turns(self):
        # of four coordinates, so by elimination: a rod and a wheel beside it that nothing touches
        scene = {"name": "rod", "parameters": parameters(m=("kg", "2"), l=("m", "0.6"), e=("1", "0.5"), g=("m/s^2", "0")),
                 "coordinates": coordinates(x=("m", "0", "0"), y=("m", "1", "-1"), a=("rad", "0.4", "0"), b=("rad", "0", "1")),
                 "bodies": [{"kind": "rod", "mass": "m", "start": ["x - l/2*cos(a)", "y - l/2*sin(a)"],
                             "end": ["x + l/2*cos(a)", "y + l/2*sin(a)"]},
                            {"kind": "disk", "mass": "m", "radius": "l", "centre": [0, 0], "angle": "b"}],
                 "events": [{"name": "touch", "expression": "y - l/2*sin(a)", "direction": "falling"}],
                 "impact": {"event": "touch", "restitution": "e"}}
        found = self.ask("simulate", {"system": scene, "t_end": 1, "samples": 2})["trajectory"]
        arm, inertia = -0.3 * math.cos(0.4), 2 * 0.36 / 12
        impulse = 1.5 / (1 / 2 + arm * arm / inertia)
        self.assertAlmostEqual(found["y_dot"][-1], -1 + impulse / 2, 10)
        self.assertAlmostEqual(found["a_dot"][-1], impulse * arm / inertia, 10)
        self.assertAlmostEqual(found["b_dot"][-1], 1, 12)

    def test_mistakes_are_told_at_their_places(self):
        def impact(**fields):
            return BALL | {"impact": {"event": "bounce", **fields}}

        points = {"points": [{"name": "P", "components": ["x", "y"]}, {"name": "O", "components": [0, 0]}]}
        for scene, *pointers in (
            (impact(), "/impact"),
            (impact(restitution="m"), "/impact/restitution"),
            (impact(restitution=1.2), "/impact/restitution"),
            (impact(restitution="-1/2"), "/impact/restitution"),
            (impact(restitution="y"), "/impact/restitution"),
            (impact(restitution="e", map={"y_dot": "-y_dot"}), "/impact/restitution"),
            (BALL | {"events": [{"name": "bounce", "expression": "y_dot"}]}, "/impact/restitution"),
            (impact(contact_made="P") | points, "/impact"),
            (impact(contact_made="Q", contact_left="O") | points, "/impact/contact_made"),
            (impact(contact_made="O", contact_left="P") | points, "/impact/contact_left"),
            (impact(contact_made="P", contact_left="O", renamed={"z": "x"}) | points, "/impact/renamed/z"),
            (impact(contact_made="P", contact_left="O", renamed={"x": "x_dot"}) | points, "/impact/renamed/x"),
            (impact(contact_made="P", contact_left="O", renamed={"x": "y"}) | points, "/impact"),
        ):
            self.refused_at("energy", {"system": scene}, *("#/system" + p for p in pointers))


class Walker(Service):
    """The map that used to be written, from angular momentum about the new foot and of the new swing leg about the hip."""

    def test_the_derived_impact_is_the_one_on_paper(self):
        rng = random.Random(9)
        scene = json.loads((ROOT / "api/scenes/systems/compass_walker.json").read_text(encoding="utf-8"))
        for mu in (0, 0.01, 0.5):
            for _ in range(3):
                theta, rate, swing = -rng.uniform(0.1, 0.4), -rng.uniform(0.5, 2), rng.uniform(-0.2, 0.2)
                start = {"theta": theta, "theta_dot": rate, "phi": 2 * theta - 1e-12, "phi_dot": swing}
                answer = self.ask("simulate", {"system": scene, "parameters": {"m": mu}, "initial": start, "times": [1e-11],
                                               "t_end": 1e-11, "on_invalid": "continue"})
                found = {name: values[-1] for name, values in answer["trajectory"].items()}
                new = math.cos(2 * theta) * rate / (1 + mu * math.sin(2 * theta) ** 2)
                for name, known in (("theta", -theta), ("phi", -2 * theta), ("theta_dot", new),
                                    ("phi_dot", (1 - math.cos(2 * theta)) * new)):
                    self.assertLess(abs(found[name] - known), 1e-9, (name, mu, start))


if __name__ == "__main__":
    unittest.main()
