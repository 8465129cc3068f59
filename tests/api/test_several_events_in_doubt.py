"""Oscillations smaller than their errors, asked for several events: the reason names each event whose count is in doubt, in
whatever order they are asked for and whichever of them was found first."""

import itertools
import pathlib
import random
import sys
import unittest
from decimal import Decimal
from fractions import Fraction

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402


class SeveralEventsInDoubt(Service):
    def test_each_event_is_named(self):
        source = random.Random(1)
        events = [{"name": "middle", "expression": "x"}, {"name": "turn", "expression": "x_dot"}]
        for _ in range(12):
            stiffness, damping, size = source.uniform(2, 6), source.uniform(0, 0.4), source.uniform(1, 3)
            start, tolerances = source.choice(((f"0 {size:.3f}e-15", {}), (f"{size:.3f}e-7 0", {"rtol": 1e-12, "atol": 1e-6})))
            scene = lagrangian("tiny", "", f"x - {start}", "x_dot^2/2", events=events,
                               forces=[{"name": "f", "value": f"-{stiffness:.3f}*x - {damping:.3f}*x_dot", "along": "x"}])
            del scene["parameters"]
            alone = {name for name in ("middle", "turn") if self.reason(scene, [name], tolerances)}
            for names in itertools.permutations(("middle", "turn")):
                with self.subTest(k=stiffness, d=damping, start=start, names=names):
                    reason = self.reason(scene, names, tolerances)
                    self.assertEqual({name for name in names if name in reason}, alone)

    def test_three_crossings_within_the_error_of_one_are_told(self):
        """An odd number of them changes the sign as one does."""
        for function, begin in (("(x - 1.7)*(x - 1.700000001)*(x - 1.699999999)", 1000000), ("(x - 1.7)^3", 0), ("(x - 1.7)^5", 10),
                                ("(x - 1.7)*((x - 1.7)^2 - 1e-34)", 0), ("(x - 1.7)^5 - 1e-28*(x - 1.7)^3", 0),
                                ("sign((x - 1.7)*(x - 1.70000005)*(x - 1.7000001))", 0)):
            with self.subTest(function):
                answer = self.met(function, begin, begin + 4)
                if len(answer["events"]) < 3 and answer["events"][0]["error"] is not None:
                    self.assertIn("several times", answer["accuracy"]["reason"])
        for function in ("x - 1.7", "(x - 1.7)*(x - 1.8)*(x - 1.6)", "sin(9*x)", "(x - 1.7)^3 + 0.001*(x - 1.7)", "exp(5*x) - 9", "tanh(99*(x - 1.7))"):
            with self.subTest(function):
                self.assertNotIn("reason", self.met(function, 0, 4)["accuracy"])

    def test_steep_ones_are_not_in_doubt_however_they_are_written(self):
        """With a coordinate twice in it."""
        for function in ("2*x - 3*(x - 0.5)", "x - 2.117*(x + 0.472) + 3", "sin(x) - 2*(x - 0.6)", "tanh(1.113*(x - 1)) - x + 1.3"):
            with self.subTest(function):
                answer = self.met(function, 0, 4)
                self.assertGreater(len(answer["events"]), 0)
                self.assertNotIn("reason", answer["accuracy"])
                self.assertLess(max(event["error"] for event in answer["events"]), 1e-13)

    def test_ordinary_events_of_the_time_are_not_in_doubt(self):
        for function in ("sin(t) - 0.3", "cos(2*t) + x/9", "exp(-t) - 0.4", "x - cos(3*t)", "t - 1 + x/9", "sin(50*t) + x - 0.2"):
            with self.subTest(function):
                answer = self.met(function, 0, 3)
                self.assertNotIn("reason", answer["accuracy"])
                self.assertLess(max(event["error"] for event in answer["events"]), 1e-13)

    def test_jumps_that_turn_back_are_not_in_doubt(self):
        """An oscillation: each passes zero at both zeros of x and of x_dot, or at those of x alone."""
        for function, in_a_turn in (("sign(x_dot)*x", 4), ("sign(x)*x_dot", 4), ("sign(x)*(x_dot + 3)", 2)):
            with self.subTest(function):
                scene = lagrangian("free", "", "x - 0.1 1", "x_dot^2/2 - x^2/2", events=[{"name": "e", "expression": function}])
                del scene["parameters"]
                answer = self.ask("simulate", {"system": scene, "t_end": 12.5, "samples": 2, "events": ["e"]})
                self.assertEqual(len(answer["events"]), 2*in_a_turn)
                self.assertNotIn("reason", answer["accuracy"])

    def test_jumps_that_do_not_reach_zero_are_not_in_doubt(self):
        """Functions of x = 0.5 + t that are far from zero on both sides of a jump at 1.5."""
        for function in ("3 + sign(sin(9*x))", "sign(x - 1.5) - 3", "sign(x - 1.5) + 1.0001", "abs(x - 1.5) + sign(x - 1.5) + 4",
                         "atan(1e20*(x - 1.5)) - 3", "sign(t - 1) - 0.7*(x + 2)"):
            with self.subTest(function):
                answer = self.met(function, 0, 2)
                self.assertEqual(answer["events"], [])
                self.assertNotIn("reason", answer["accuracy"])

    def test_a_turn_beside_a_jump_is_told(self):
        """x = (t - 1)^2, twice below what stands in the jump, or never, and rounding does not tell which."""
        for past in ("1e-15", "1e-16", "1e-17", "1e-20", "1e-32", "-1e-17", "-1e-20"):
            for function in ("sign(x - PAST)", "2*sign(x - PAST) - 1", "sign(x - PAST)*(x + 2)", "sign(x - PAST) + 0.3*t", "tanh(1e20*(x - PAST))",
                             "exp(-1e20*(x - PAST)) - 0.5"):
                with self.subTest(function, past=past):
                    answer = self.turning(function.replace("PAST", f"({past})"))
                    self.assertTrue(answer["events"] or "'e'" in answer["accuracy"]["reason"])
                    self.assertFalse([event for event in answer["events"] if event["error"] is not None])
        for function in ("sign(x + 1e-12)", "sign(x - 1e-17) + 3", "sign(x + 1e-14)*(x + 2)", "tanh(1e20*(x + 1e-12))"):
            with self.subTest(function):
                answer = self.turning(function)
                self.assertEqual(answer["events"], [])
                self.assertNotIn("reason", answer["accuracy"])

    def turning(self, function):
        scene = lagrangian("turn", "", "x - 1 -2", "x_dot^2/2", events=[{"name": "e", "expression": function}],
                           forces=[{"name": "f", "value": "2", "along": "x"}])
        del scene["parameters"]
        return self.ask("simulate", {"system": scene, "t_end": 2.3, "samples": 2, "events": ["e"]})

    def test_what_lies_just_behind_t_start_is_met(self):
        """By so many times the last digit of t, which is what a time is off by."""
        for begin in (1e7, 1e8, 1000, -1000, 0.25):
            for part in (2, 27, 60, 300):
                after = part * abs(begin) * 2**-52
                with self.subTest(begin=begin, part=part):
                    for function in (f"x - 0.5 - {after!r}", f"sign(x - 0.5 - {after!r})"):
                        met, = self.met(function, begin, begin + 1.3)["events"]
                        self.assertLessEqual(abs(Fraction(met["t"]) - Fraction(begin) - Fraction(after)), Fraction(met["error"]))

    def test_what_happens_for_a_moment_beside_an_impact(self):
        """Of y = t, with a wall that turns x at 0.5: a condition that is broken and an event that is met twice, so long."""
        for begin, length in (("1.9999999", "5e-8"), ("1.99999999", "1e-12"), ("1", "1e-11"), ("0.50000001", "5e-8"), ("0.50000001", "1e-12"),
                              ("0.50000000001", "1e-12"), ("0.3", "5e-8")):
            end = Decimal(begin) + Decimal(length)
            function = f"sign((y - {begin})*(y - {end}))"
            scene = lagrangian("wall", "", "x - 0.5 -1; y - 0 1", "x_dot^2/2 + y_dot^2/2", impacts=[{"event": "wall", "restitution": "1"}],
                               events=[{"name": "wall", "expression": "x", "direction": "falling"}, {"name": "e", "expression": function}])
            del scene["parameters"]
            with self.subTest(begin=begin, length=length):
                met = self.ask("simulate", {"system": scene, "t_end": 2, "samples": 2, "events": ["e"]})["events"]
                met = [event for event in met if event["name"] == "e"]
                self.assertEqual(len(met), 2)
                for event, true in zip(met, (Fraction(begin), Fraction(end))):
                    self.assertLessEqual(abs(Fraction(event["t"]) - true), Fraction(event["error"]))
                scene["valid_while"] = [{"name": "v", "expression": function, "reason": "broken", "message": "broken"}]
                stop = self.ask("simulate", {"system": scene, "t_end": 2, "samples": 2})["stop"]
                self.assertLessEqual(abs(Fraction(stop["t"]) - Fraction(begin)), Fraction(stop["error"]))

    def test_conditions_that_break_just_behind_a_kink_or_an_impact_stop(self):
        """Of y = t, by a jump or a step so long after x has passed its kink at 0.5, or has come to rest there."""
        starts = {"abs(t - 0.5)": "1 -1.3", "sign(t - 0.5)": "1 -1.3", "-0.5*sign(x_dot)": "1 0.25", "0.5 - sign(x_dot)": "1 -0.75"}
        for (force, start), function, after in itertools.product(
                starts.items(), ("sign(END - y)", "sign(END - y) + 0.5", "tanh(1e22*(END - y))"), ("1e-13", "1e-11", "1e-9", "1e-8")):
            end = Decimal("0.5") + Decimal(after)
            scene = lagrangian("kink", "", f"x - {start}; y - 0 1", "x_dot^2/2 + y_dot^2/2", forces=[{"name": "f", "value": force, "along": "x"}],
                               valid_while=[{"name": "v", "expression": function.replace("END", str(end)), "reason": "broken", "message": "broken"}])
            del scene["parameters"]
            with self.subTest(force=force, function=function, after=after):
                stop = self.ask("simulate", {"system": scene, "t_end": 2, "samples": 2})["stop"]
                self.assertLessEqual(abs(Fraction(stop["t"]) - Fraction(end)), Fraction(stop.get("error") or 1e-14))

    def test_beside_the_top_of_a_hill(self):
        """Whether, and when, a motion goes over it its errors leave open; times are those of 70 digits."""
        for text, start, t_end, goal, true in (
                ("2.864*x_dot^2/2 + 6.013*x^2/2 - 0.504*x^4/4", "0.222 -0.321338748805958306497404", 20.91, {"rtol": 1e-13}, 19.2374),
                ("x_dot^2/2 + 6.707*log(1 + x^2)/2", "0.836 -1.885355844466774", 7.55, {}, None),
                ("2.277*x_dot^2/2 + 4.414*x^2/2 + 1.192*x*abs(x)/2", "0.339 -0.53191805217462681", 18.19, {}, None),
                ("2.561*x_dot^2/2 + 2.763*x^2/2 + 0.784*x*abs(x)/2", "-1.365 1.19991576481001111507", 29.73, {"rtol": 1e-13}, 28.07771875)):
            with self.subTest(text):
                scene = lagrangian("hill", "", f"x - {start}", text, events=[{"name": "top", "expression": "x"}])
                del scene["parameters"]
                answer = self.ask("simulate", {"system": scene, "t_end": t_end, "samples": 2, "events": ["top"], **goal})
                met = answer["events"]
                is_right = bool(met) and true is not None and met[0]["error"] is not None and abs(met[0]["t"] - true) <= met[0]["error"]
                self.assertTrue(is_right or "top" in answer["accuracy"].get("reason", ""), answer["accuracy"])

    def test_one_whose_time_is_known_beyond_the_end_is_in_doubt(self):
        """Free flight over x = 1 at t_end, to all digits that there are."""
        for past in (0, 1e-17):
            scene = lagrangian("flight", "", "x - 0.1 0.3", "x_dot^2/2", events=[{"name": "line", "expression": f"x - 1 - {past}"}])
            del scene["parameters"]
            answer = self.ask("simulate", {"system": scene, "t_end": 3, "samples": 2, "events": ["line"]})
            self.assertIn("line", answer["accuracy"]["reason"])

    def met(self, function, begin, end):
        """By x = 0.5 + t - begin."""
        scene = lagrangian("free", "", "x - 0.5 1", "x_dot^2/2", events=[{"name": "e", "expression": function}])
        del scene["parameters"]
        return self.ask("simulate", {"system": scene, "t_start": begin, "t_end": end, "samples": 2, "events": ["e"]})

    def reason(self, scene, names, tolerances):
        request = {"system": scene, "t_end": 8, "samples": 3, "events": list(names), **tolerances}
        return self.ask("simulate", request)["accuracy"].get("reason", "")


if __name__ == "__main__":
    unittest.main()
