"""Work that would never end: it ends in time, and at once when nobody waits for it."""

import json
import time
import unittest

import hostile_inputs
import wire
from running_qdot import SANITIZED, RunningQdot

ENDLESS = list(hostile_inputs.endless())
# A sanitizer sees in these seconds what the code does; which bound ends it, only the release can tell.
DEADLINE = ("--deadline", "2") if SANITIZED else ()


def sweep(rows, t_end):
    return hostile_inputs.ask("/v1/sweep", ask={"simulate": {"system": "spring_pendulum", "t_end": t_end, "samples": 2}},
                              vary={"k": {"from": 30, "to": 50, "count": rows}}, collect={"l": "/trajectory/l/1"})


class Work(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = RunningQdot("--threads", "1", *DEADLINE)

    @classmethod
    def tearDownClass(cls):
        cls.server.__exit__()

    def running(self):
        metrics = wire.exchange(self.server.port, hostile_inputs.get(b"/metrics")).body.decode()
        return sum(float(line.split()[1]) for line in metrics.splitlines() if line.startswith("qdot_in_flight{"))

    def wait_until_running(self, number):
        """The seconds until so many requests are computed."""
        started = time.monotonic()
        while self.running() != number:
            self.assertLess(time.monotonic() - started, 10)
            time.sleep(0.002)
        return time.monotonic() - started

    def seconds_to_be_free(self, data, after):
        """Sends it, leaves after so many seconds: how long its thread is still busy; none if it was done already."""
        with wire.connect(self.server.port) as sock:
            sock.sendall(data)
            self.wait_until_running(1)
            time.sleep(after)
            if self.running() == 0:
                return None
        return self.wait_until_running(0)

    def test_it_ends_in_time(self):
        for name, data, statuses in ENDLESS:
            with self.subTest(name):
                reply = wire.exchange(self.server.port, data)
                self.assertIn(reply.status, statuses)
                answer = json.loads(reply.body)
                if reply.status == 200:  # an answer, or what was found and that it is not all
                    self.assertTrue("equations_of_motion" in answer or (not answer["complete"] and answer["reason"]))
                else:
                    self.assertIn(answer["type"],
                                  ("/errors/limit-exceeded", "/errors/deadline", "/errors/integration-failed"))
                self.assertLess(reply.seconds, 20 if SANITIZED else 10)
                print(f"{name}: {reply.status} after {reply.seconds:.2f} s")

    def test_it_ends_when_its_client_leaves(self):
        for name, data, _ in ENDLESS:
            with self.subTest(name):
                took = [self.seconds_to_be_free(data, after) for after in (0, 0.2, 1)]
                took = [seconds for seconds in took if seconds is not None]
                self.assertLess(max(took), 5)
                print(f"{name}: free {max(took):.3f} s after its client left")

    def test_a_small_sweep_does_not_wait_for_a_long_one(self):
        with wire.connect(self.server.port) as sock:
            sock.sendall(sweep(rows=10000, t_end=2000))  # far more than the deadline allows
            self.wait_until_running(1)
            small = sweep(rows=5 if SANITIZED else 50, t_end=10)
            self.assertEqual(wire.exchange(self.server.port, small).status, 200)
            self.assertGreater(self.running(), 0)
        self.wait_until_running(0)

    def test_who_asks_one_after_another_is_never_refused(self):
        for _ in range(4):  # each of more than a second, the longest that one may wait for another
            reply = wire.exchange(self.server.port, hostile_inputs.simulate(t_end=1e6, rtol=1e-13, method="adams"))
            # At its limit of steps; on a slow machine at the deadline.
            self.assertIn(json.loads(reply.body)["type"], ("/errors/integration-failed", "/errors/deadline"))


if __name__ == "__main__":
    unittest.main()
