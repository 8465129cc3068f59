"""Kinks, impacts and conditions that a motion nearly meets, or just meets, on both sides and from far to nearer than any
computation can tell. The truths are oscillations and parabolas; mpmath knows which side they are on."""

import pathlib
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, strict_json  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mpmath.mp.dps = 50
mpf = mpmath.mpf
GOALS = [{}, {"accuracy": "fast"}, {"accuracy": "accurate"}, {"max_error": 1e-9}, {"method": "taylor", "rtol": 1e-5}, {"method": "erk", "rtol": 1e-7},
         {"method": "bdf", "rtol": 1e-4}, {"method": "adams", "rtol": 1e-9}]
DISTANCES = [sign*mpf(size) for size in ("1e-6", "3.5e-9", "2.2e-14", "4.5e-15", "3e-16") for sign in (1, -1)]
NEAR = "comes as near to"
COUNT = "how often it happens is no more certain"


def oscillation(square, x, v, offset=0):
    """x(t), x'(t) of x'' = -square (x - offset)."""
    omega = mpmath.sqrt(square)

    def at(t):
        c, s = mpmath.cos(omega*t), mpmath.sin(omega*t)
        return offset + (x - offset)*c + v/omega*s, v*c - omega*(x - offset)*s

    return at


class NearMisses(Service):
    def motion(self, scene, **more):
        request = {"system": scene, **({} if "times" in more else {"samples": 5}), **more}
        return strict_json(self.post("simulate", request).data)

    def judge(self, answer, truth, where):
        """truth(t) by name."""
        columns, errors = answer["trajectory"], answer["accuracy"]["max_abs_error"]
        for i, t in enumerate(columns["t"]):
            for name, true in truth(mpf(t)).items():
                if errors[name] is not None:
                    self.assertLessEqual(abs(mpf(columns[name][i]) - true), mpf(errors[name]), (*where, name, t, answer["accuracy"]))
        return NEAR in answer["accuracy"].get("reason", "")

    def test_over_a_kink_beyond_which_the_force_carries_it_away(self):
        square, start, jump = mpf("1.451"), mpf("1.977"), mpf("10.45")
        told = {}
        for distance in DISTANCES:
            level = start*(1 - distance)
            scene = lagrangian("kinked", "", f"x - {start} 0", "x_dot^2/2",
                               forces=[{"name": "f", "value": f"-{square}*x + 5.225*(sign(x + {mpmath.nstr(level, 25)}) - 1)", "along": "x"}])
            inside = oscillation(square, start, 0)
            met = mpmath.acos(-level/start)/mpmath.sqrt(square) if distance > 0 else mpf(100)
            outside = oscillation(square, -level, inside(met)[1], -jump/square) if distance > 0 else None
            for goal in GOALS:
                answer = self.motion(scene, t_end=6, **goal)
                told[distance, str(goal)] = self.judge(
                    answer, lambda t: dict(zip(("x", "x_dot"), inside(t) if t <= met else outside(t - met))), (distance, goal))
        for goal in GOALS:
            self.assertFalse(told[DISTANCES[0], str(goal)], goal)
        self.assertFalse(told[DISTANCES[2], str({"accuracy": "accurate"})])
        self.assertTrue(told[DISTANCES[-1], str({"accuracy": "accurate"})])

    def test_after_thousands_that_do_no_harm(self):
        """A kink beside x = cos t waits a hundredth away and comes near once."""
        told = 0
        for period in (1010, 2600):
            near = (2*period + 1)*mpmath.pi
            for distance in (mpf("3e-11"), mpf("1e-14"), mpf("-1e-14"), mpf("-3e-11")):
                kink = f"x + {mpmath.nstr(mpf('1.03') + distance, 30)} - 0.03*exp(-(t - {mpmath.nstr(near, 30)})^2/4)"
                scene = lagrangian("kinked", "", "x - 1 0", "x_dot^2/2", forces=[{"name": "f", "value": f"-x - 5*(1 - sign({kink}))", "along": "x"}])
                met, beyond = mpf("1e9"), None
                if distance < 0:
                    guess = near - mpmath.sqrt(-distance/mpf("0.5075"))
                    met = mpmath.findroot(lambda t: mpmath.cos(t) + mpf("1.03") + distance - mpf("0.03")*mpmath.exp(-(t - near)**2/4), guess)
                    beyond = oscillation(1, mpmath.cos(met), -mpmath.sin(met), mpf(-10))
                for goal in (GOALS[0], GOALS[2], GOALS[3]):
                    answer = self.motion(scene, times=[float(near - 1), float(near + 3)], **goal)
                    told += self.judge(answer, lambda t: {"x": mpmath.cos(t) if t <= met else beyond(t - met)[0]}, (period, distance, goal))
        self.assertGreater(told, 6)

    def test_against_a_wall(self):
        square, start = mpf("1.913"), mpf("0.496")
        for distance in DISTANCES:
            level = start*(1 - distance)
            scene = lagrangian("bouncing", "", f"x - {start} 0", "x_dot^2/2", impacts=[{"event": "hit", "restitution": 1}],
                               forces=[{"name": "f", "value": f"-{square}*x", "along": "x"}],
                               events=[{"name": "hit", "expression": f"x + {mpmath.nstr(level, 25)}", "direction": "falling"}])
            inside = oscillation(square, start, 0)
            met = mpmath.acos(-level/start)/mpmath.sqrt(square) if distance > 0 else mpf(100)
            back = oscillation(square, -level, -inside(met)[1])
            for goal in [*GOALS, {"method": "gauss", "h": 0.01}]:
                answer = self.motion(scene, t_end=3.9, **goal)
                told = self.judge(answer, lambda t: dict(zip(("x", "x_dot"), inside(t) if t <= met else back(t - met))), (distance, goal))
                told = told or any(event["error"] is None for event in answer["events"]) or COUNT in answer["accuracy"].get("reason", "")
                self.assertTrue(told or bool(answer["events"]) == (distance > 0), (distance, goal, answer["events"], answer["accuracy"]))

    def test_over_a_wall_whose_top_is_near(self):
        """A ball that is at x = 3/4 and y = h after 1/2 s."""
        height, told = mpf("0.5")*1 - mpf("9.81")/8, 0
        for distance in DISTANCES:
            top = mpmath.nstr(height + distance, 25)
            scene = lagrangian("thrown", "", "x - 0 1.5; y - 0 1", "(x_dot^2 + y_dot^2)/2 - 9.81*y", impacts=[{"event": "hit", "restitution": "0.5"}],
                               events=[{"name": "hit", "expression": "x - 0.75", "direction": "rising", "when": f"{top} - y"}])

            def truth(t):
                x = mpf("1.5")*t if t <= 0.5 or distance < 0 else mpf("0.75") - mpf("0.75")*(t - mpf("0.5"))
                return {"x": x, "y": t - mpf("9.81")/2*t*t}

            for goal in GOALS:
                answer = self.motion(scene, t_end=1.2, **goal)
                told += self.judge(answer, truth, (distance, goal))
        self.assertGreater(told, 4)

    def test_of_what_an_event_needs_to_count(self):
        """Free flight x = 0.6 - t, y = t: at x = 0 `when` is the distance."""
        for distance in [mpf(0), *DISTANCES]:
            event = {"name": "e", "expression": "x", "when": f"y - ({mpmath.nstr(mpf('0.6') - distance, 25)})"}
            scene = lagrangian("gated", "", "x - 0.6 -1; y - 0 1", "x_dot^2/2 + y_dot^2/2", events=[event])
            for goal in GOALS[:5]:
                answer = self.motion(scene, t_end=3, events=["e"], **goal)
                is_told = NEAR in answer["accuracy"].get("reason", "")
                if not is_told:
                    self.assertEqual(len(answer["events"]), int(distance > 0), (distance, goal))
                if abs(distance) > mpf("1e-4") or (abs(distance) > mpf("1e-12") and goal == {}):
                    self.assertFalse(is_told, (distance, goal))

    def test_a_floor_that_jumps_far_below_is_none(self):
        """Down two stairs: at the edge of the first the distance jumps, and is far from zero on both sides and between."""
        for x, v in (("0.12", "0.81"), ("0.06", "0.77"), ("0.3", "0.6")):
            scene = lagrangian("stairs", "", f"x - {x} {v}; y - 1.04 0", "(x_dot^2 + y_dot^2)/2 - 9.81*y",
                               events=[{"name": "hit", "expression": "y - 0.1*(1 + sign(1 - x))", "direction": "falling"}],
                               impacts=[{"event": "hit", "map": {"y_dot": "-0.7*y_dot"}}])
            answer = self.motion(scene, t_end=1.6, events=["hit"])
            self.assertNotIn("reason", answer["accuracy"])
            first = mpmath.sqrt(2*mpf("0.84")/mpf("9.81"))
            self.assertLessEqual(abs(answer["events"][0]["t"] - first), answer["events"][0]["error"])
            self.judge(answer, lambda t, x=mpf(x), v=mpf(v): {"x": x + v*t}, (x,))
            self.assertGreater(len(answer["events"]), 1)

    def test_impacts_that_accumulate_may_be_one_more_or_less(self):
        """A ball in the trough of a parabola: both computations lose sight of the last flights, at different ones."""
        for x, v in (("-0.33", "-0.38"), ("0.49", "-0.24"), ("0.2", "0.3")):
            scene = lagrangian("trough", "", f"x - {x} {v}; y - 1.74 0", "(x_dot^2 + y_dot^2)/2 - 9.81*y",
                               events=[{"name": "hit", "expression": "y - x^2", "direction": "falling"}],
                               impacts=[{"event": "hit", "restitution": "0.5"}])
            answer = self.motion(scene, t_end=2, events=["hit"])
            self.assertEqual(answer["stop"]["reason"], "impacts_accumulate")
            self.assertNotIn("reason", answer["accuracy"])

    def test_an_event_that_is_switched_off_is_not_in_doubt(self):
        for when in ("k", "0*y", "k*y", "y - y"):
            scene = lagrangian("off", "k - 0", "x - 1 -1; y - 0 1", "x_dot^2/2 + y_dot^2/2",
                               events=[{"name": "e", "expression": "x", "when": when}])
            answer = self.motion(scene, t_end=3, events=["e"])
            self.assertEqual((answer["events"], answer["accuracy"].get("reason")), ([], None), when)

    def test_two_conditions_that_fail_within_an_instant(self):
        """x = t, y = 2 t: which is the first to fail is told, or in doubt, and the time is within its error."""
        told = 0
        for t_start in (0, -40, 700):
            for gap in ("1e-6", "3e-13", "7e-15", "1e-17", "-1e-17", "-7e-15", "-3e-13", "-1e-6"):
                for second in ("{} - y", "sign({} - y)"):
                    other = second.format(mpmath.nstr(2*(mpf("1.7") + mpf(gap)), 25))
                    scene = lagrangian("falling", "", "x - 0 1; y - 0 2", "x_dot^2/2 + y_dot^2/2",
                                       valid_while=[{"name": "p", "expression": "1.7 - x", "reason": "by_p", "message": "m"},
                                                    {"name": "q", "expression": other, "reason": "by_q", "message": "m"}])
                    answer = self.motion(scene, t_start=t_start, t_end=t_start + 3)
                    stop, reason = answer["stop"], answer["accuracy"].get("reason", "")
                    if stop.get("error") is not None:
                        self.assertLessEqual(abs(mpf(stop["t"]) - t_start - mpf("1.7") - min(mpf(gap), 0)), mpf(stop["error"]), answer)
                    if not reason:
                        self.assertEqual(stop["reason"], "by_p" if mpf(gap) > 0 else "by_q", (t_start, gap, second))
                    told += bool(reason)
                    if abs(mpf(gap)) > mpf("1e-9"):
                        self.assertFalse(reason, (t_start, gap))
        self.assertGreater(told, 10)

    def test_a_slanting_hit_of_a_corner_is_none(self):
        """A ball that falls from rest beside the middle of a circle. Its distance is a root, and would turn again within it."""
        g, radius, restitution = mpf("9.81"), mpf("0.2"), mpf("0.7")
        scene = lagrangian("corner", "", "x - 0 0; y - 2 0", "(x_dot^2 + y_dot^2)/2 - 9.81*y", impacts=[{"event": "hit", "restitution": "0.7"}],
                           events=[{"name": "hit", "expression": "sqrt(x^2 + y^2) - 0.2", "direction": "falling"}])
        for x in ("0.1", "-0.129", "0.137", "-0.05"):
            height = mpmath.sqrt(radius**2 - mpf(x)**2)
            met = mpmath.sqrt(2*(2 - height)/g)
            normal = -g*met*height/radius*(1 + restitution)
            after = mpf(x), -normal*mpf(x)/radius, height, -g*met - normal*height/radius

            def truth(t):
                s = t - met
                return {"x": after[0] + after[1]*max(s, 0), "y": after[2] + after[3]*s - g*s*s/2 if s > 0 else 2 - g*t*t/2}

            answer = self.motion(scene, t_end=0.8, initial={"x": x}, events=["hit"])
            self.judge(answer, truth, (x,))
            self.assertNotIn("reason", answer["accuracy"], x)
            self.assertEqual(len(answer["events"]), 1)
        # where the largest distance of the motion is large, too, and a parabola from the hit goes far through the circle
        scene["events"][0]["expression"] = "sqrt((x - 0.04)^2 + (y - 0.13)^2) - 0.24"
        answer = self.motion(scene, t_end=1.23, initial={"x": 0.59, "y": 1.19, "x_dot": -0.88}, events=["hit"])
        self.assertNotIn("reason", answer["accuracy"])

    def test_of_what_ends_it(self):
        """Either the stop is right to its error, or it is said that there is none."""
        square, start = mpf("0.688"), mpf("0.508")
        for distance in DISTANCES:
            level = start*(1 - distance)
            scene = lagrangian("ending", "", f"x - {start} 0", "x_dot^2/2", forces=[{"name": "f", "value": f"-{square}*x", "along": "x"}],
                               valid_while=[{"name": "room", "expression": f"x + {mpmath.nstr(level, 25)}", "reason": "touch", "message": "It touches."}])
            ends = mpmath.acos(-level/start)/mpmath.sqrt(square) if distance > 0 else None
            inside = oscillation(square, start, 0)
            for goal in GOALS:
                answer = self.motion(scene, t_end=6, **goal)
                where, reason = (distance, goal, answer["accuracy"]), answer["accuracy"].get("reason", "")
                if answer["accuracy"]["max_abs_error"] is not None:
                    self.judge(answer, lambda t: dict(zip(("x", "x_dot"), inside(t))), (distance, goal))
                error = answer["stop"].get("error") if answer["status"] == "stopped" else None
                if error is not None:
                    self.assertIsNotNone(ends, where)
                    self.assertLessEqual(abs(mpf(answer["stop"]["t"]) - ends), mpf(error), where)
                elif (answer["status"] == "stopped") != (ends is not None):
                    self.assertTrue(reason, where)

    def test_kinks_over_which_forces_are_continuous_do_no_harm(self):
        square, start = mpf("1.451"), mpf("1.977")
        inside = oscillation(square, start, 0)
        for distance in DISTANCES[4:]:  # what is nearer turns back by less than any of these errors
            scene = lagrangian("kinked", "", f"x - {start} 0", "x_dot^2/2",
                               forces=[{"name": "f", "value": f"-{square}*x + 3*(abs(x + {level}) - x - {level})", "along": "x"}
                                       for level in [mpmath.nstr(start*(1 - distance), 25)]])
            for goal in GOALS[:3]:
                answer = self.motion(scene, t_end=6, **goal)
                self.assertFalse(self.judge(answer, lambda t: {"x": inside(t)[0]}, (distance, goal)))
                self.assertLess(answer["accuracy"]["max_abs_error"]["x"], 1e-4)

    def test_from_a_balance_beside_a_kink_that_no_double_tells(self):
        """Of x'' = a*(x - 1) + b*|x - k|: on to the kink with one rate, and away from it with the other."""
        told = 0
        for a, b, side in ((30, 16, 1), (30, 16, -1), (24, -11, 1), (24, -11, -1)):
            for size in ("1e-17", "3e-19", "2e-22"):
                distance, push = side*mpf(size), b*mpf(size)
                before, after = mpmath.sqrt(a - b*side), mpmath.sqrt(a + b*side)
                leaves = (push > 0) == (side > 0)
                met = mpmath.acosh(1 + distance*before**2/push)/before if leaves else mpf(100)
                rate = push/before*mpmath.sinh(before*met) if leaves else 0

                def truth(t):
                    if t <= met:
                        return {"x": 1 + push/before**2*(mpmath.cosh(before*t) - 1)}
                    centre, s = -a*distance/after**2, t - met
                    return {"x": 1 + distance + centre - centre*mpmath.cosh(after*s) + rate/after*mpmath.sinh(after*s)}

                kink = mpmath.nstr(1 + distance, 30)
                scene = lagrangian("kinked", "", "x - 1 0", "x_dot^2/2", forces=[{"name": "f", "value": f"{a}*(x - 1) + {b}*abs(x - {kink})", "along": "x"}])
                for goal in ({}, {"accuracy": "fast"}, {"max_error": 1e-6}, {"max_error": 1e-3}, {"method": "taylor", "rtol": 1e-6}):
                    answer = self.motion(scene, t_end=4, **goal)
                    self.judge(answer, truth, (a, b, distance, goal))
                    told += answer["accuracy"]["horizon"] is None
        self.assertGreater(told, 30)

    def test_rows_just_before_a_kink_and_just_after_it(self):
        square, start, jump = mpf("1.586"), mpf("0.499"), mpf("11272")
        level = mpf("0.0441405")
        scene = lagrangian("kinked", "", f"x - {start} 0", "x_dot^2/2",
                           forces=[{"name": "f", "value": f"-{square}*x + 5636*(sign(x + {level}) - 1)", "along": "x"}])
        inside = oscillation(square, start, 0)
        met = mpmath.acos(-level/start)/mpmath.sqrt(square)
        outside = oscillation(square, -level, inside(met)[1], -jump/square)
        for away in ("1e-8", "4.6e-12", "1e-13", "1e-15", "-1e-15", "-1e-13", "-5e-12"):
            row = float(met - mpf(away))
            for goal in GOALS:
                for times in ([row], [row, 1.4]):
                    answer = self.motion(scene, times=times, **goal)
                    self.judge(answer, lambda t: dict(zip(("x", "x_dot"), inside(t) if t <= met else outside(t - met))), (away, goal))


if __name__ == "__main__":
    unittest.main()
