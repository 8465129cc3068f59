"""Periodic gaits through HTTP: the reference values, the contract's fields, and where there is none."""

import math
import pathlib
import random
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, reference_cases  # noqa: E402
from short_scene import G, particle, scene  # noqa: E402

STATE = 1e-12  # contract of this version; the reference asks 1e-9
PRE_IMPACT = 1e-10  # the swing foot's rate just before the strike
MULTIPLIER = 1e-10


def with_numbers(case):
    return {"system": case["system"], "parameters": case["parameters"]}


class GaitAnswers(Service):
    def test_reference(self):
        count = 0
        for case in reference_cases("gait"):
            expected = case["expected"]
            with self.subTest(case["id"]):
                found = self.ask("gait", with_numbers(case) | {"gait": expected["gait"]})
                self.assertEqual(len(found["gaits"]), 1)
                gait = found["gaits"][0]
                self.assertEqual(gait["kind"], expected["gait"])
                for name in ("theta", "phi", "theta_dot", "phi_dot"):
                    self.assertAlmostEqual(gait["state"][name], expected[name], delta=STATE)
                    self.assertAlmostEqual(gait["pre_impact"][name], expected["pre_impact"][name], delta=PRE_IMPACT)
                    self.assertLess(abs(gait["state"][name] - expected[name]), gait["error"]["state"][name] + 1e-16)
                self.assertAlmostEqual(gait["step_time"], expected["step_time"], delta=STATE)
                self.assertAlmostEqual(gait["step_length"], 2*math.sin(expected["theta"]), delta=10*STATE)
                for multiplier, number in zip(gait["multipliers"], expected["multipliers"], strict=True):
                    self.assertAlmostEqual(multiplier["re"], number["re"], delta=MULTIPLIER)
                    self.assertAlmostEqual(multiplier["im"], number["im"], delta=MULTIPLIER)
                self.assertIs(gait["stable"], expected["stable"])
                self.assertLess(gait["residual"], 1e-13)
                count += 1
        self.assertEqual(count, 2)

    def test_both_gaits_and_all_fields(self):
        found = self.ask("gait", {"system": "compass_walker", "parameters": {"g": 1, "m": "0.01 kg"}})
        self.assertEqual([gait["kind"] for gait in found["gaits"]], ["short", "long"])
        self.assertNotIn("reason", found)
        self.assertEqual(found["request"]["parameters"], {"M": 1.0, "m": 0.01, "l": 1.0, "gamma": 0.009, "g": 1.0})
        self.assertNotIn("initial", found["request"])
        for gait in found["gaits"]:
            for name in ("state", "pre_impact"):
                self.assertEqual(set(gait[name]), set(gait["error"][name]))
                self.assertLessEqual(set(gait[name]), set(found["units"]))
            self.assertEqual(len(gait["error"]["multipliers"]), 2)
        self.assertEqual(found["units"]["step_time"], "s")
        self.assertAlmostEqual(found["gaits"][1]["state"]["theta"], 0.198825, delta=1e-6)

    def test_a_gait_that_is_simulated_repeats(self):
        gait = self.ask("gait", {"system": "compass_walker", "parameters": {"l": 0.8, "m": 0.1}, "gait": "short"})
        [gait] = gait["gaits"]
        found = self.ask("simulate", {"system": "compass_walker", "parameters": {"l": 0.8, "m": 0.1},
                                      "initial": gait["state"], "t_end": 2.5*gait["step_time"], "rtol": 1e-12,
                                      "atol": 1e-14, "samples": 2})
        strikes = [event for event in found["events"] if event["name"] == "heel_strike"]
        self.assertEqual(len(strikes), 2)
        for i, strike in enumerate(strikes):
            self.assertAlmostEqual(strike["t"], (i + 1)*gait["step_time"], delta=1e-8)
            self.assertAlmostEqual(strike["state"]["theta"], gait["pre_impact"]["theta"], delta=1e-8)

    def test_digits_are_in_the_error(self):
        found = self.ask("gait", {"system": "compass_walker", "parameters": {"g": 1}, "gait": "long", "digits": 4})
        [gait] = found["gaits"]
        self.assertEqual(gait["state"]["theta"], 0.2003)
        self.assertGreater(gait["error"]["state"]["theta"], 1e-5)
        self.assertAlmostEqual(gait["error"]["state"]["theta"], 0.2003109005 - 0.2003, delta=1e-8)

    def test_no_gait_has_a_reason(self):
        for parameters in ({"gamma": 0}, {"gamma": -0.02}, {"g": 0}):
            for kind in ({}, {"gait": "long"}):
                with self.subTest(parameters, kind=kind):
                    found = self.ask("gait", {"system": "compass_walker", "parameters": parameters} | kind)
                    self.assertEqual(found["gaits"], [])
                    self.assertTrue(found["reason"].endswith("."))

    def test_no_impact_no_gait(self):
        for system in ("cart_pendulum", "forced_spring_pendulum"):
            problem = self.refused("gait", {"system": system})
            self.assertEqual(problem["type"], "/errors/not-applicable")
            self.assertIn("impact", problem["detail"])

    def test_mistakes(self):
        self.refused_at("gait", {"system": "compass_walker", "gait": "middle", "initial": {"theta": 1},
                                 "parameters": {"l": -1}}, "#/gait", "#/initial", "#/parameters/l")

    def test_a_query_gives_the_same_bytes(self):
        posted = self.post("gait", {"system": "compass_walker", "parameters": {"gamma": 0.02}, "gait": "short"})
        got = self.get("gait", {"system": "compass_walker", "gamma": 0.02, "gait": "short"})
        self.assertEqual((posted.status, got.status), (200, 200))
        self.assertEqual(got.data, posted.data)


class RimlessWheel(Service):
    """Spokes roll down a slope (McGeer, Passive Dynamic Walking, 1990): w^2 = 4 g/l sin(alpha) sin(gamma)
    cot(2 alpha)^2 just after an impact, where that takes the wheel over its next spoke."""

    scene = scene("rimless_wheel", f"m kg 1; l m 1; alpha rad 0.39; gamma rad 0.08; {G}", "theta rad 0 0.9",
                  gravity=["g*sin(gamma)", "-g*cos(gamma)"], bodies=[particle("m", "l*sin(theta)", "l*cos(theta)")],
                  events=[{"name": "strike", "expression": "alpha - theta", "direction": "falling"}],
                  impact={"event": "strike", "map": {"theta": "-alpha", "theta_dot": "theta_dot*cos(2*alpha)"}})

    def rates(self, alpha, gamma, l):
        """Squares of the rate with which it rolls, and of the least that takes it over."""
        steady = 4*9.81/l*math.sin(alpha)*math.sin(gamma)/math.tan(2*alpha)**2
        return steady, 2*9.81/l*(1 - math.cos(gamma - alpha)) if gamma < alpha else 0

    def test_rolls_with_the_known_rate(self):
        draw = random.Random(3)
        rolled = 0
        for _ in range(20):
            alpha, gamma, l = (round(draw.uniform(*ends), 3) for ends in ((0.2, 0.6), (0.01, 0.3), (0.3, 2)))
            found = self.ask("gait", {"system": self.scene, "parameters": {"alpha": alpha, "gamma": gamma, "l": l}})
            steady, least = self.rates(alpha, gamma, l)
            if abs(steady - least) < 0.1*least:
                continue  # it stands on a spoke for long
            with self.subTest(alpha=alpha, gamma=gamma, l=l):
                self.assertEqual(len(found["gaits"]), int(steady > least))
                for gait in found["gaits"]:
                    rate, error = gait["state"]["theta_dot"], gait["error"]["state"]["theta_dot"]
                    self.assertLess(abs(rate - math.sqrt(steady)), error + 1e-15*rate)
                    self.assertAlmostEqual(gait["multipliers"][0]["re"], math.cos(2*alpha)**2, 11)
                    rolled += 1
        self.assertGreater(rolled, 8)


if __name__ == "__main__":
    unittest.main()
