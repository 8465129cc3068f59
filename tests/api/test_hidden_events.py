"""Events, walls and conditions whose functions doubles round by as much as they change there: what happens is answered
within its error, or the answer says that it is in doubt."""

import pathlib
import sys
import unittest
from fractions import Fraction

from mpmath import mp, mpf

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from test_multiple_roots import power, product  # noqa: E402

mp.dps = 50


def scene(lagrangian, x, rate, **members):
    coordinate = {"name": "x", "initial": x, "initial_rate": rate}
    return {"name": "p", "units": "none", "coordinates": [coordinate], "lagrangian": lagrangian, **members}


def condition(expression):
    return {"name": "c", "expression": expression, "reason": "touch", "message": "m"}


class HiddenEvents(Service):
    def simulate(self, system, t_end, **options):
        return self.ask("simulate", {"system": system, "t_end": t_end, "samples": 2, **options})

    def test_a_condition_that_is_the_difference_of_large_numbers_ends_the_motion(self):
        """Of a throw, x = h + v t - a t^2/2, where x^2 comes to c; squares, cubes and roots of what is beside 1e8."""
        height, speed, fall = mpf("0.8588"), mpf("1.56"), mpf("1.33")
        level = mpf("1.773")
        end = (speed - mp.sqrt(speed**2 - 2 * fall * (level - height))) / fall
        for text in (
            "-((x+1e8)^2-1e8^2-2*1e8*x-(3.143529))",
            "-((x+1e5)^3-1e15-3e10*x-3e5*x^2-(5.573476917))",
            "sqrt(1e8^2+3.143529)-sqrt(x^2+1e8^2)",
            "exp(1e-9*x) - exp(1.773e-9) - 2*(exp(1e-9*x) - exp(1.773e-9))",
        ):
            for options in ({}, {"accuracy": "fast"}, {"max_error": 1e-10}):
                with self.subTest(text, **options):
                    system = scene("x_dot^2/2 - 1.33*x", "0.8588", "1.56", valid_while=[condition(text)])
                    answer = self.simulate(system, 2.3, **options)
                    if answer["status"] == "complete":
                        self.assertIn("reason", answer["accuracy"])
                    elif answer["stop"].get("error") is None:
                        self.assertIn("reason", answer["accuracy"])
                    else:
                        self.assertLessEqual(abs(answer["stop"]["t"] - end), answer["stop"]["error"])

    def test_a_sharp_step_that_is_just_reached_is_in_doubt(self):
        """A throw from 0 that comes above the place by less than doubles tell, for a hundred millionth of a second."""
        for rate, fall, function in (("1.15", "0.78", "exp(2.84e6*(x-0.8477564102564102442555169))-1"),
                                     ("0.73", "0.52", "1/(1+exp(-1.33e9*(x-0.5124038461538461459764754)))-1/2"),
                                     ("2.36", "1.02", "exp(4.66e9*(x-2.73019607843137245112053))-1"),
                                     ("2.67", "1.72", "tanh(733*(x-2.072354651162790675823133))"),
                                     ("0.7", "9.56", "tanh(6.39e5*(x-0.02562761506276150561601523))")):
            with self.subTest(function):
                system = scene(f"x_dot^2/2 - {fall}*x", "0", rate, events=[{"name": "e", "expression": function}])
                answer = self.simulate(system, 3, events=["e"])
                if len(answer["events"]) != 2:
                    self.assertIn("'e' as its error", answer["accuracy"]["reason"])

    def test_a_step_at_which_the_event_is_passed_the_other_way_hides_nothing(self):
        for function in ("tanh(x)", "exp(x) - 1", "exp(x - 0.3) - 1", "exp(5*x) - 1", "atan(7*x)", "x*exp(x)"):
            for direction, count in (("rising", 1), ("falling", 1)):
                event = {"name": "e", "expression": function, "direction": direction}
                with self.subTest(function=function, direction=direction):
                    answer = self.simulate(scene("x_dot^2/2 - x^2/2", "1", "0", events=[event]), 7, events=["e"])
                    self.assertEqual(len(answer["events"]), count)
                    self.assertNotIn("reason", answer["accuracy"])

    def test_steps_of_time_just_behind_the_start_are_met(self):
        """Within the first rounding that times elsewhere have."""
        for function, known in (("tanh(1e16*t) - 0.5", [mp.atanh(0.5) * mpf("1e-16")]),
                                ("exp(-1e20*t) - 0.5", [mp.log(2) * mpf("1e-20")]),
                                ("t*exp(160*x) - 1", [mpf("2.591877726173834e-28"), mpf("0.7542699795806396")])):
            with self.subTest(function):
                system = scene("x_dot^2/2", "0.397", "-0.524", events=[{"name": "e", "expression": function}])
                answer = self.simulate(system, 1.3, events=["e"])
                self.assertEqual(len(answer["events"]), len(known))
                for event, t in zip(answer["events"], known):
                    self.assertLess(abs(event["t"] - t), 1e-14)

    def test_steps_far_steeper_than_doubles_tell_are_met_on_the_way(self):
        for function, count in (("tanh(1e22*sin(3*x))", 3), ("tanh(1e40*sin(3*x))", 3), ("tanh(1e24*(x - 0.7))", 1)):
            with self.subTest(function):
                system = scene("x_dot^2/2 + 0.37*x", "0.5", "1", events=[{"name": "e", "expression": function}])
                self.assertEqual(len(self.simulate(system, 2, events=["e"])["events"]), count)

    def test_a_wall_that_leaps_at_the_start_is_met_at_its_speed(self):
        wall = {"name": "w", "expression": "x - 0.3 - 0.2*tanh(1e16*t)", "direction": "falling"}
        system = scene("x_dot^2/2", "0.397", "-0.524", events=[wall], impacts=[{"event": "w", "restitution": 0.5}])
        answer = self.simulate(system, 1.3, events=["w"])
        speed = mpf("1.5") * mpf("2e15") * (1 - mpf("0.485") ** 2)
        self.assertLess(abs(answer["trajectory"]["x_dot"][-1] / speed - 1), 1e-6)

    def test_the_depth_of_a_graze_is_sought_where_it_is(self):
        rate = mp.sqrt(mpf("3.62"))
        root = "-1.78116366224010109444143167869"  # 1.5e-12 above the least x + 0.57 x_dot
        event = {"name": "e", "expression": f"((x+(0.57)*x_dot)-({root}))^5"}
        system = scene("x_dot^2/2 - 3.62*x^2/2", "-1.181", "0.478", events=[event])
        answer = self.simulate(system, 5.7, events=["e"])
        if "reason" not in answer["accuracy"]:
            least = mp.sqrt((mpf("-1.181") + mpf("0.57") * mpf("0.478")) ** 2
                            + (mpf("0.478") + mpf("0.57") * mpf("1.181") * rate**2) ** 2 / rate**2)
            self.assertGreater(least, -mpf(root))
            self.assertEqual(len(answer["events"]), 2)

    def test_errors_of_both_ways_hold_the_way_that_is_kicked(self):
        """A throw up to just beyond the place of a kick."""
        place = "0.865345205478992"
        event = {"name": "e", "expression": power(Fraction(place), 3)}
        kick = {"event": "e", "map": {"x_dot": "x_dot - 0.02"}}
        for options in ({}, {"accuracy": "accurate"}, {"accuracy": "fast"}, {"method": "erk", "rtol": 1e-10}):
            with self.subTest(**options):
                system = scene("x_dot^2/2 - 7.3*x", "0.7634", "1.22", events=[event], impacts=[kick])
                answer = self.simulate(system, 0.368, **options)
                speed = mp.sqrt(mpf("1.22") ** 2 - 2 * mpf("7.3") * (mpf(place) - mpf("0.7634")))
                left = mpf("0.368") - (mpf("1.22") - speed) / mpf("7.3")
                known = mpf(place) + (speed - mpf("0.02")) * left - mpf("7.3") * left**2 / 2
                errors = answer["accuracy"]["max_abs_error"]
                if errors is not None and errors["x"] is not None:
                    self.assertLessEqual(abs(answer["trajectory"]["x"][-1] - known), errors["x"])

    def test_a_wall_may_forestall_a_condition_that_ends_at_its_place(self):
        wall = {"name": "w", "expression": "-(" + product([Fraction("0.93"), Fraction("-1.3")]) + ")*(3+x)", "direction": "falling"}
        system = scene("x_dot^2/2", "-0.092", "1.47", events=[wall], impacts=[{"event": "w", "restitution": 0.9}],
                       valid_while=[condition("-(" + power(Fraction("0.93"), 3) + ")")])
        for options in ({}, {"accuracy": "fast"}, {"max_error": 1e-10}):
            with self.subTest(**options):
                answer = self.simulate(system, 1.5, **options)
                self.assertTrue(answer["status"] == "complete" or "reason" in answer["accuracy"])


if __name__ == "__main__":
    unittest.main()
