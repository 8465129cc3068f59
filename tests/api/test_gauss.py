"""Method gauss through HTTP: its step, its error, what it refuses."""

import math
import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

# Without gravity and with a spring of no natural length the spring pendulum is an isotropic oscillator.
W = 4.0
OSCILLATOR = {"system": "spring_pendulum", "parameters": {"m": 0.5, "k": 8, "l0": 0, "g": 0},
              "initial": {"l": 1.25, "theta": 0, "theta_dot": 2}, "t_end": 30, "samples": 61,
              "method": "gauss"}
PENDULUM = {"system": "spring_pendulum", "t_end": 10, "method": "gauss"}


def true_error(answer):
    rows = answer["trajectory"]
    return max(abs(l - math.hypot(1.25*math.cos(W*t), 2*1.25/W*math.sin(W*t)))
               for t, l in zip(rows["t"], rows["l"]))


class Gauss(Service):
    def test_the_error_of_a_step_is_measured_and_falls_as_its_sixth_power(self):
        errors = []
        for h in (0.1, 0.05, 0.025):
            answer = self.ask("simulate", OSCILLATOR | {"h": h})
            accuracy = answer["accuracy"]
            self.assertEqual((accuracy["method"], accuracy["h"], accuracy["symplectic"]), ("gauss", h, True))
            self.assertNotIn("rtol", accuracy)
            self.assertEqual(answer["diagnostics"]["steps"], round(30/h))
            errors.append(true_error(answer))
            self.assertLessEqual(errors[-1], accuracy["max_abs_error"]["l"])
            self.assertLessEqual(accuracy["max_abs_error"]["l"], 10*errors[-1])
        for coarse, fine in zip(errors, errors[1:]):
            self.assertAlmostEqual(math.log2(coarse/fine), 6, delta=0.3)

    def test_the_step_may_carry_a_unit_and_come_by_query(self):
        self.assertEqual(self.ask("simulate", PENDULUM | {"h": "10 ms"})["request"]["h"], 0.01)

    def test_the_energy_does_not_drift(self):
        # 1200 oscillations of the spring: 25 times as long, and no larger an error.
        drift = [self.ask("simulate", PENDULUM | {"h": 0.05, "t_end": t, "samples": 681, "verify": False})
                 ["diagnostics"]["conserved"][0]["max_rel_drift"] for t in (34, 850)]
        self.assertGreater(drift[0], 1e-10)
        self.assertLess(drift[1], 2*drift[0])

    def test_rows_do_not_change_the_motion(self):
        few, many = (self.ask("simulate", PENDULUM | {"h": 0.03, "samples": n})["trajectory"] for n in (2, 1001))
        for column, values in few.items():
            self.assertEqual([values[0], values[-1]], [many[column][0], many[column][-1]], column)

    def test_events_and_strides_are_those_of_taylor(self):
        events = [[event["t"] for event in self.ask("simulate", PENDULUM | how | {"events": ["theta=0+"]})["events"]]
                  for how in ({"h": 0.005}, {"method": "taylor"})]
        self.assertGreater(len(events[0]), 3)
        self.assertEqual(len(events[0]), len(events[1]))
        for a, b in zip(*events):
            self.assertAlmostEqual(a, b, 8)
        strides = [[s["t"] for s in self.ask("simulate", {"system": "compass_walker", "steps": 4} | how)["strides"]]
                   for how in ({"method": "gauss", "h": 0.005}, {"method": "taylor"})]
        self.assertEqual(len(strides[0]), 4)
        for a, b in zip(*strides):
            self.assertAlmostEqual(a, b, 8)

    def test_events_that_its_last_digits_invent_are_told_to_be_in_doubt(self):
        """Before a pulse both stand still, apart from a difference of 1e-200 and what is left of its equations."""
        for where in (2.274, 4.96):
            scene = lagrangian("pushed", "", "x - 0 0; y - 0 0", "(x_dot^2 + y_dot^2)/2", forces=[
                {"name": "push", "value": f"exp(-((t - {where})/0.05)^2)", "along": "x"},
                {"name": "pull", "value": "-1.2*sin(y - x)", "along": "y"}])
            how = {"system": scene, "t_end": where + 1, "samples": 3, "events": ["x_dot=y_dot"]}
            self.assertEqual(self.ask("simulate", how)["events"], [])
            answer = self.ask("simulate", how | {"method": "gauss", "h": 0.02})
            self.assertGreater(len(answer["events"]), 3)
            self.assertIn("how often it happens is no more certain", answer["accuracy"]["reason"])

    def test_massless_feet_are_said_not_to_be_symplectic(self):
        answer = self.ask("simulate", {"system": "compass_walker", "t_end": 1, "method": "gauss", "h": 0.01})
        self.assertIs(answer["accuracy"]["symplectic"], False)

    def test_a_request_must_fit_the_method(self):
        def errors(**fields):
            problem = self.refused("simulate", {"system": "spring_pendulum", "t_end": 1} | fields)
            return [(e["pointer"], e["code"]) for e in problem["errors"]]

        self.assertEqual(errors(method="gauss"), [("#/h", "missing")])
        self.assertEqual(errors(method="gauss", h=-0.1), [("#/h", "out_of_range")])
        self.assertEqual(errors(method="gauss", h=1e-7), [("#/h", "too_many")])
        self.assertEqual(errors(method="erk", h=0.1), [("#/h", "not_applicable")])
        self.assertEqual(errors(h=0.1), [("#/h", "not_applicable")])
        for other in ({"rtol": 1e-9}, {"max_error": 1e-6}, {"accuracy": "fast"}, {"max_evaluations": 1000}):
            self.assertEqual(errors(method="gauss", h=0.1, **other), [("#/h", "exclusive")])

    def test_a_step_without_a_solution_has_a_name(self):
        # A stiff spring three times as long as at rest: hundreds of its periods through l = 0 in one step.
        problem = self.refused("simulate", PENDULUM | {"parameters": {"k": 1e6}, "initial": {"l": 3}, "h": 5})
        self.assertEqual(problem["reason"], "no-convergence")
        self.assertEqual(problem["t_reached"], 0)
        self.assertIn("shorter h", problem["detail"])


if __name__ == "__main__":
    unittest.main()
