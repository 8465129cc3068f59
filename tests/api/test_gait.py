"""Periodic gaits through HTTP: the reference values, the contract's fields, and where there is none."""

import math
import pathlib
import random
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, reference_cases  # noqa: E402
from short_scene import G, lagrangian, particle, rigid, scene  # noqa: E402

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
        self.assertIs(found["complete"], False)
        self.assertIn("no proof excludes more", found["reason"])
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

    def test_where_nothing_is_lost_no_gait_is_told_from_those_beside_it(self):
        for potential, wall in (("k*x^2/2", "x + 0.5"), ("k*x^2/2", "x - 0.5"), ("k*x", "x"), ("k*x^2/2", "x + 0.2")):
            known = lagrangian("wall", "k 1 1", "x - 1 0", f"x_dot^2/2 - {potential}",
                               events=[{"name": "w", "expression": wall, "direction": "falling"}],
                               impacts=[{"event": "w", "restitution": 1}])
            with self.subTest(potential=potential, wall=wall):
                found = self.ask("gait", {"system": known})
                if not found["gaits"]:
                    self.assertIn("Where all motions repeat", found["reason"])
                for gait in found["gaits"]:
                    self.assertIsNone(gait["stable"])
                    self.assertIn("other gaits may lie beside", gait["reason"])
                    self.assertNotIn("exact", gait)

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
                    self.assertEqual((gait["exact"]["of"], gait["exact"]["text"]),
                                     ("theta_dot^2", "4*g*sin(alpha)*sin(gamma)*cos(2*alpha)^2/(l*sin(2*alpha)^2)"))
                    self.assertEqual(gait["exact"]["multiplier"]["text"], "cos(2*alpha)^2")
                    # Other wheels may not come over their spokes.
                    self.assertIn("theta_dot keeps its sign from impact to impact", gait["exact"]["assumes"])
                    rolled += 1
        self.assertGreater(rolled, 8)

    def test_a_walker_with_massless_feet_keeps_the_wheels_rate_by_its_angle(self):
        """Garcia, Chatterjee, Ruina and Coleman (1998), as a wheel's whose spokes stand at the angle of its stride."""
        found = self.ask("gait", {"system": "compass_walker", "parameters": {"m": 0}})
        self.assertEqual(len(found["gaits"]), 2)
        for gait in found["gaits"]:
            self.assertEqual(gait["exact"]["text"], "4*g*sin(theta)*sin(gamma)*cos(2*theta)^2/(l*sin(2*theta)^2)")
            self.assertIn("m = 0", gait["exact"]["assumes"])
            given, theta = found["request"]["parameters"], gait["state"]["theta"]
            square = 4*given["g"]/given["l"]*math.sin(theta)*math.sin(given["gamma"])/math.tan(2*theta)**2
            self.assertAlmostEqual(gait["state"]["theta_dot"]**2, square, 12)
        for gait in self.ask("gait", {"system": "compass_walker", "parameters": {"m": 0.1}})["gaits"]:
            self.assertNotIn("exact", gait)


class WhereStridesSettle(Service):
    """Gaits that no curve of recurring motions leads to, but the scene's own motion."""

    def only_gait(self, system, parameters):
        [gait] = self.ask("gait", {"system": system, "parameters": parameters})["gaits"]
        return gait

    def near(self, number, expected, error):
        self.assertLess(abs(number - expected), error + 4e-16*abs(expected))

    def test_a_ball_that_each_bounce_kicks(self):
        """v = e v + c, T = 2 v/g; all heights of the floor are alike, so that no motion recurs at other times."""
        ball = scene("kicked_ball", f"e 1 0.8; c m/s 1; m kg 1; {G}", "y m 1", gravity=["0", "-g"], bodies=[particle("m", "0", "y")],
                     events=[{"name": "floor", "expression": "y", "direction": "falling"}],
                     impact={"event": "floor", "map": {"y_dot": "c - e*y_dot"}})
        for e, c in ((0.929, 0.058), (0.169, 2.9), (-0.351, 3.784)):
            gait = self.only_gait(ball, {"e": e, "c": c})
            self.near(gait["state"]["y_dot"], c/(1 - e), gait["error"]["state"]["y_dot"])
            self.near(gait["step_time"], 2*c/(1 - e)/9.81, gait["error"]["step_time"])
            self.near(gait["multipliers"][0]["re"], e, gait["error"]["multipliers"][0])
            self.assertIs(gait["stable"], True)

    def test_just_beyond_the_fold_where_two_gaits_have_met(self):
        """y_dot -> c - e y_dot + q y_dot^2 repeats where q v^2 + (e - 1) v + c = 0, with 1 beside e + 2 q v."""
        with mpmath.workdps(40):
            fold = mpmath.mpf("1.797")**2/(4*mpmath.mpf("0.98"))
            places = [mpmath.nstr(fold + mpmath.mpf(beyond), 30) for beyond in ("1e-14", "1e-20")]
        for c in places:
            kicked = scene("kicked", f"m kg 1; g m/s^2 9.81; c m/s {c}; q s/m 0.98", "y m 0 1", gravity=["0", "-g"],
                           bodies=[particle("m", "0", "y")], events=[{"name": "floor", "expression": "y", "direction": "falling"}],
                           impact={"event": "floor", "map": {"y_dot": "c + 0.797*y_dot + q*y_dot^2"}})
            found = self.ask("gait", {"system": kicked})
            self.assertTrue(found["gaits"])
            for gait in found["gaits"]:
                self.assertIn("there may be none", gait["reason"])

    def test_what_rounding_makes_of_strides_that_hardly_settle_is_in_the_errors(self):
        """A kicked ball on a spring that is shaken by each bounce, nearly in resonance with them: x by its 2x2 map."""
        for e, c, k, r, s in (("0.586", "2.348", "28.14", "-0.3472", "0.6037"), ("0.2363", "1.606", "859.4834812957871", "0.9168", "0.541"),
                              ("0.1855", "1.64", "2132.10100484412899", "0.8008", "-0.413"), ("0.8379", "0.2367", "439.227546397268308", "0.7214", "-0.7682")):
            ball = scene("shaken", f"m kg 1; {G}; e 1 {e}; c m/s {c}; k N/m {k}; r 1 {r}; s m/s {s}", "x m 0 0.3; y m 0 1", gravity=["0", "-g"],
                         bodies=[particle("m", "x", "y")], forces=[{"name": "f", "value": "-k*x", "along": "x"}],
                         events=[{"name": "floor", "expression": "y", "direction": "falling"}],
                         impact={"event": "floor", "map": {"y_dot": "c - e*y_dot", "x_dot": "r*x_dot + s"}})
            with mpmath.workdps(40):
                e, c, k, r, s = map(mpmath.mpf, (e, c, k, r, s))
                speed, omega = c/(1 - e), mpmath.sqrt(k)
                turn = omega*2*speed/mpmath.mpf("9.81")
                stride = mpmath.matrix([[mpmath.cos(turn), mpmath.sin(turn)/omega], [-r*omega*mpmath.sin(turn), r*mpmath.cos(turn)]])
                x = mpmath.lu_solve(mpmath.eye(2) - stride, mpmath.matrix([0, s]))
                [gait] = self.ask("gait", {"system": ball})["gaits"]
                for name, true in (("x", x[0]), ("x_dot", x[1]), ("y_dot", speed)):
                    self.assertLessEqual(abs(gait["state"][name] - true), gait["error"]["state"][name], (k, name))

    def test_a_clock_ticks_where_it_hangs_down(self):
        """An impact that leaves the place on its surface: w = w r + J, r what a swing leaves of a linear one's rate."""
        clock = scene("clock", "m kg 1; I kg*m^2 1; k N*m 10; c kg*m^2/s 0.1; J rad/s 0.3", "a rad 0 0.5",
                      bodies=[rigid("m", "I", ["0", "0"], "a")], springs=[{"stiffness": "k", "angle": "a"}],
                      dampers=[{"coefficient": "c", "angle": "a"}], events=[{"name": "tick", "expression": "a", "direction": "rising"}],
                      impact={"event": "tick", "map": {"a_dot": "a_dot + J"}})
        for c, kick in ((0.1, 0.3), (0.7, 0.05), (2.1, 4.0)):
            gait = self.only_gait(clock, {"c": c, "J": kick})
            period = 2*math.pi/math.sqrt(10 - c*c/4)
            self.near(gait["step_time"], period, gait["error"]["step_time"])
            left = math.exp(-c/2*period)
            self.near(gait["state"]["a_dot"], kick/(1 - left), gait["error"]["state"]["a_dot"])
            self.near(gait["multipliers"][0]["re"], left, gait["error"]["multipliers"][0])

    def test_a_wheel_with_inertia_of_its_own_rolls(self):
        wheel = scene("wheel", f"m kg 1; l m 1; I kg*m^2 0.2; al rad 0.39; ga rad 0.08; {G}", "th rad 0 0.9",
                      gravity=["g*sin(ga)", "-g*cos(ga)"], bodies=[rigid("m", "I", ["l*sin(th)", "l*cos(th)"], "-th")],
                      events=[{"name": "strike", "expression": "al - th", "direction": "falling"}],
                      impact={"event": "strike", "map": {"th": "-al", "th_dot": "th_dot*(I + m*l^2*cos(2*al))/(I + m*l^2)"}})
        draw, rolled = random.Random(7), 0
        for _ in range(20):
            m, l, inertia, al, ga = (round(draw.uniform(*ends), 3) for ends in ((0.5, 2), (0.3, 2), (0.01, 1), (0.15, 0.7), (0.02, 0.3)))
            found = self.ask("gait", {"system": wheel, "parameters": {"m": m, "l": l, "I": inertia, "al": al, "ga": ga}})
            about_foot = inertia + m*l*l
            left = (inertia + m*l*l*math.cos(2*al))/about_foot
            steady = left**2/(1 - left**2)*4*m*9.81*l*math.sin(al)*math.sin(ga)/about_foot
            least = 2*m*9.81*l*(1 - math.cos(al - ga))/about_foot if ga < al else 0
            with self.subTest(m=m, l=l, I=inertia, al=al, ga=ga):
                self.assertEqual(len(found["gaits"]), int(steady > least), steady/least if least else None)
                for gait in found["gaits"]:
                    self.near(gait["state"]["th_dot"], math.sqrt(steady), gait["error"]["state"]["th_dot"])
                    self.near(gait["multipliers"][0]["re"], left**2, gait["error"]["multipliers"][0])
                    self.assertLess(abs(gait["pre_impact"]["th"] - al), gait["error"]["pre_impact"]["th"])
                    names = {"m": m, "l": l, "I": inertia, "al": al, "ga": ga, "g": 9.81, "sin": math.sin, "cos": math.cos}
                    self.near(eval(gait["exact"]["text"].replace("^", "**"), names), steady, 1e-12*steady)
                    rolled += 1
        self.assertGreater(rolled, 10)

    def test_a_walker_whose_foot_scuffs_as_it_strikes(self):
        """A. Goswami, B. Thuilot, B. Espiau, A study of the passive gait of a compass-like biped robot, Int. J. Robotics
        Research 17 (1998): 3 degrees, a = b, m_H = 2 m. The event is the height of the swing foot, `when` leaves the scuff out."""
        hip = ["-l*sin(A)", "l*cos(A)"]
        walker = scene("goswami", f"M kg 10; m kg 5; l m 1; a m 0.5; ga rad 0.05236; {G}", "A rad 0.27 -1.09; B rad -0.27 -0.377",
                       gravity=["g*sin(ga)", "-g*cos(ga)"],
                       points=[{"name": "stance", "components": ["0*l", "0*l"]},
                               {"name": "foot", "components": ["l*sin(B) - l*sin(A)", "l*cos(A) - l*cos(B)"]}],
                       bodies=[particle("M", *hip), particle("m", "-a*sin(A)", "a*cos(A)"),
                               particle("m", "(l - a)*sin(B) - l*sin(A)", "l*cos(A) - (l - a)*cos(B)")],
                       events=[{"name": "strike", "expression": "l*cos(A) - l*cos(B)", "direction": "falling", "when": "-A - 0.05"}],
                       impact={"event": "strike", "contact_made": "foot", "contact_left": "stance", "renamed": {"A": "B", "B": "A"}})
        gait = self.only_gait(walker, {})
        self.assertAlmostEqual(gait["step_time"], 0.734, 3)
        self.assertAlmostEqual(gait["step_length"], 0.535, 3)
        self.assertIs(gait["stable"], True)


if __name__ == "__main__":
    unittest.main()
