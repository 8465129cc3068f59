"""Plastic impacts: bodies that go on together meet once, whether nothing presses them or the motion ends there."""

import pathlib
import random
import sys
import unittest

from mpmath import mp, mpf

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

mp.dps = 30


class BodiesThatStayTogether(Service):
    def test_carts_that_stick_and_roll_on_meet_once(self):
        draw = random.Random(811)
        for _ in range(30):
            m, gap, v, u = draw.randint(5, 30)/10, draw.randint(3, 20)/10, draw.randint(10, 40)/10, draw.randint(-9, 9)/10
            scene = {"name": "carts", "units": "none", "lagrangian": f"x_dot^2/2 + {m}*y_dot^2/2",
                     "coordinates": [{"name": "x", "initial": "0", "initial_rate": str(v)},
                                     {"name": "y", "initial": str(gap), "initial_rate": str(u)}],
                     "events": [{"name": "w", "expression": "y - x", "direction": "falling"}],
                     "impacts": [{"event": "w", "restitution": "0"}]}
            with self.subTest(m=m, gap=gap, v=v, u=u):
                t_end = 3.71
                answer = self.ask("simulate", {"system": scene, "t_end": t_end, "samples": 2, "events": ["w"]})
                met = mpf(str(gap)) / (mpf(str(v)) - mpf(str(u)))
                together = (mpf(str(v)) + mpf(str(m)) * mpf(str(u))) / (1 + mpf(str(m)))
                happens = met < t_end
                self.assertEqual(len(answer["events"]), int(happens))
                self.assertNotIn("'w'", answer["accuracy"].get("reason", ""))
                place = mpf(str(v)) * met + together * (mpf(str(t_end)) - met) if happens else mpf(str(v)) * mpf(str(t_end))
                self.assertLessEqual(abs(answer["trajectory"]["x"][-1] - place), answer["accuracy"]["max_abs_error"]["x"] + 4e-16)
                if happens:
                    self.assertLessEqual(abs(answer["events"][0]["t"] - met), answer["events"][0]["error"])

    def test_a_ball_lands_once_on_a_floor_that_moves_on(self):
        for speed in ("0.5", "-0.3", "0", "1.25"):
            scene = {"name": "lift", "units": "none", "lagrangian": "y_dot^2/2 - 9.81*y", "coordinates": [{"name": "y", "initial": "1"}],
                     "events": [{"name": "p", "expression": f"y - ({speed})*t", "direction": "falling"}],
                     "impacts": [{"event": "p", "map": {"y_dot": speed}}]}
            with self.subTest(speed=speed):
                answer = self.ask("simulate", {"system": scene, "t_end": 2, "samples": 2, "events": ["p"]})
                g, u = mpf("9.81"), mpf(speed)
                met = (-u + mp.sqrt(u * u + 2 * g)) / g
                self.assertEqual(len(answer["events"]), 1)
                self.assertLessEqual(abs(answer["events"][0]["t"] - met), answer["events"][0]["error"])
                self.assertIn("stay in contact, pressed together", answer["stop"]["message"])


if __name__ == "__main__":
    unittest.main()
