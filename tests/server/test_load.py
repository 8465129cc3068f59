"""Overload, in short: what no noise of a busy machine can break. load.py measures."""

import unittest

import hostile_inputs
import load
import wire
from running_qdot import RunningQdot


class Overload(unittest.TestCase):
    def test_more_than_it_can_do_is_answered_or_refused_at_once(self):
        with RunningQdot("--threads", "1") as server:
            found = list(load.overload(server.port, [5], 2))
            saturation, overloaded = found
            self.assertGreater(saturation["per_second"], 0)
            self.assertEqual(overloaded["others"], 0)
            self.assertGreater(overloaded["goodput"], 0.1)
            self.assertIsNotNone(overloaded["shed_p99_ms"], "nothing was refused")
            self.assertLess(overloaded["shed_p99_ms"], 2000)
            self.assertEqual(wire.exchange(server.port, hostile_inputs.get(b"/healthz")).status, 200)
            metrics = wire.exchange(server.port, hostile_inputs.get(b"/metrics")).body.decode()
            shed = [line for line in metrics.splitlines() if line.startswith("qdot_shed_total ")]
            self.assertGreater(float(shed[0].split()[1]), 0)

    def test_light_requests_do_not_wait_for_heavy_ones(self):
        with RunningQdot("--threads", "1") as server:
            fairness = next(load.fairness(server.port, 1))
            self.assertEqual(fairness["light_refused"], 0)
            self.assertGreater(fairness["heavy_done"], 0)
            # In one queue they would wait for heavy ones of a quarter of a second each.
            self.assertLess(fairness["beside_heavy_p99_ms"], 500)

    def test_a_burst_is_answered(self):
        with RunningQdot() as server:
            burst = next(load.burst(server.port, 300))
            print(burst)
            self.assertEqual((burst["answered"], burst["unanswered"], burst["light_refused"]), (300, 0, 0))
            self.assertLess(burst["light_p99_ms"], 500)

    def test_what_is_offered_without_end_is_shed_at_once(self):
        with RunningQdot("--threads", "1", "--deadline", "2") as server:  # a burst may wait for 1.2 seconds
            heavy = load.hostile_inputs.simulate(t_end=500, samples=2, digits=6)
            done = [took for status, took in load.closed_loop(server.port, heavy, 4, 2) if status == 200]
            answers, unanswered = load.open_loop(server.port, heavy, 5 * len(done) / 2, 5)
            refused = [took for status, took in answers if status == 503]
            self.assertEqual(unanswered, 0)
            self.assertGreater(len(refused), len(answers) / 3)
            self.assertLess(sorted(refused)[len(refused) // 2], 0.5)


if __name__ == "__main__":
    unittest.main()
