"""The error that an answer states is the one it has: against closed forms, through HTTP."""

import math
import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

# Without gravity and with a spring of no natural length the spring pendulum is an isotropic oscillator.
W = 4.0
OSCILLATOR = {"system": "spring_pendulum", "parameters": {"m": 0.5, "k": 8, "l0": 0, "g": 0},
              "initial": {"l": 1.25, "theta": 0, "theta_dot": 2}, "t_end": 30, "samples": 61}
PROMISED = {"fast": 1e-3, "balanced": 1e-6, "accurate": 1e-9}


def length(t):
    return math.hypot(1.25*math.cos(W*t), 2*1.25/W*math.sin(W*t))


def true_error(answer):
    rows = answer["trajectory"]
    return max(abs(value - length(t)) for t, value in zip(rows["t"], rows["l"]))


class Accuracy(Service):
    def answer(self, **fields):
        return self.ask("simulate", OSCILLATOR | fields)

    def test_the_stated_error_is_true_for_every_method(self):
        for method in ("taylor", "erk", "adams", "bdf", "auto"):
            for rtol in (1e-4, 1e-8):
                with self.subTest(method=method, rtol=rtol):
                    answer = self.answer(method=method, rtol=rtol, atol=rtol)
                    stated = answer["accuracy"]["max_abs_error"]["l"]
                    self.assertLessEqual(true_error(answer), stated)
                    self.assertLessEqual(stated, 100*true_error(answer))

    def test_a_wanted_error_is_met(self):
        for wanted in (1e-2, 1e-5, 1e-8, 1e-11):
            with self.subTest(wanted=wanted):
                answer = self.answer(max_error=wanted)
                self.assertIs(answer["accuracy"]["meets_request"], True)
                self.assertLessEqual(true_error(answer), wanted)
                self.assertLessEqual(max(answer["accuracy"]["max_abs_error"].values()), wanted)

    def test_presets_keep_their_promise(self):
        work = []
        for preset, promised in PROMISED.items():
            answer = self.answer(accuracy=preset)
            self.assertIs(answer["accuracy"]["meets_request"], True)
            for column, error in answer["accuracy"]["max_abs_error"].items():
                scale = max(map(abs, answer["trajectory"][column]))
                self.assertLessEqual(error, promised*scale, column)
            work.append(answer["diagnostics"]["total_evaluations"])
        self.assertEqual(work, sorted(work))

    def test_what_is_out_of_reach_is_said(self):
        accuracy = self.answer(max_error=1e-14, t_end=300)["accuracy"]
        self.assertIs(accuracy["meets_request"], False)
        self.assertTrue(accuracy["reason"])
        self.assertLess(max(accuracy["max_abs_error"].values()), 1e-10)

    def test_work_is_bounded_and_buys_accuracy(self):
        errors = []
        for allowed in (20_000, 100_000):
            answer = self.answer(max_evaluations=allowed)
            self.assertLessEqual(answer["diagnostics"]["total_evaluations"], allowed)
            self.assertLessEqual(true_error(answer), answer["accuracy"]["max_abs_error"]["l"])
            errors.append(answer["accuracy"]["max_abs_error"]["l"])
        self.assertLess(errors[1], errors[0])

    def test_rounding_to_digits_is_an_error_too(self):
        answer = self.answer(digits=4)
        self.assertLessEqual(true_error(answer), answer["accuracy"]["max_abs_error"]["l"])
        self.assertIs(self.answer(digits=4, max_error=1e-6)["accuracy"]["meets_request"], False)

    def test_a_chaotic_motion_has_a_horizon(self):
        chaotic = {"system": "rod_pendulum", "initial": {"theta": 2, "phi": 2.1}, "t_end": 40, "samples": 401,
                   "on_invalid": "continue"}
        accuracy = self.ask("simulate", chaotic)["accuracy"]
        self.assertTrue(0 < accuracy["horizon"] < 40)
        self.assertIs(self.ask("simulate", chaotic | {"accuracy": "accurate"})["accuracy"]["meets_request"], False)

    def test_without_measurement_there_is_no_error(self):
        accuracy = self.answer(verify=False)["accuracy"]
        self.assertIsNone(accuracy["max_abs_error"])
        self.assertTrue(accuracy["reason"])

    def test_a_force_with_a_kink_is_integrated_on_its_smooth_sides(self):
        kink = {"system": "forced_spring_pendulum", "inputs": {"F": "0.5*abs(cos(3*t))"}, "t_end": 5}
        accuracy = self.ask("simulate", kink)["accuracy"]
        self.assertEqual(accuracy["method"], "taylor")
        self.assertIs(accuracy["bounded"], True)
        self.assertLess(max(accuracy["max_abs_error"].values()), 1e-6)


class Strides(Service):
    def test_a_number_of_strides_ends_the_motion(self):
        answer = self.ask("simulate", {"system": "compass_walker", "steps": 5, "samples": 11})
        self.assertEqual(answer["status"], "complete")
        self.assertEqual(len(answer["strides"]), 5)
        self.assertEqual(len(answer["trajectory"]["t"]), 11)
        self.assertEqual(answer["trajectory"]["t"][-1], answer["t_reached"])
        self.assertEqual(answer["strides"][-1]["t"], answer["t_reached"])
        for stride in answer["strides"]:  # the default start is the stable gait
            self.assertAlmostEqual(stride["step_time"], 3.88246375285137414/math.sqrt(9.81), 8)
            self.assertAlmostEqual(stride["state"]["theta"], -stride["pre_impact"]["theta"], 15)

    def test_t_end_ends_it_earlier(self):
        answer = self.ask("simulate", {"system": "compass_walker", "steps": 50, "t_end": 3})
        self.assertEqual(answer["t_reached"], 3)
        self.assertEqual(len(answer["strides"]), 2)

    def test_a_fall_stops_it(self):
        answer = self.ask("simulate", {"system": "compass_walker", "steps": 5, "initial": {"theta": 0.3}})
        self.assertEqual(answer["stop"]["reason"], "fall")
        self.assertEqual(answer["strides"], [])

    def test_who_stands_still_does_not_walk_for_ever(self):
        standing = {"system": "compass_walker", "parameters": {"gamma": 0}, "steps": 3,
                    "initial": {"theta": 0, "theta_dot": 0, "phi": 0, "phi_dot": 0}}
        self.refused("simulate", standing)


if __name__ == "__main__":
    unittest.main()
