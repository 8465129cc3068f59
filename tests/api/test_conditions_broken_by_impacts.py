"""A ball is dropped from h and bounces with restitution e; the motion is valid while x' < c - 0.8 g t, which it obeys in each
flight where it does at its beginning. The impact after which it does not ends the motion then, which is as certain as the
impact is, but where x' after it is that limit itself."""

import pathlib
import random
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mpmath.mp.dps = 40
mpf = mpmath.mpf
OPTIONS = ({}, {"method": "erk"}, {"accuracy": "fast"}, {"accuracy": "accurate"}, {"max_error": 1e-9}, {"method": "bdf"})


class ConditionsBrokenByImpacts(Service):
    def bounce(self, height, gravity, restitution, condition, end, options):
        scene = lagrangian("ball", "", f"x - {height} 0", f"x_dot^2/2 - {gravity}*x",
                           events=[{"name": "floor", "expression": "x", "direction": "falling"}],
                           impacts=[{"event": "floor", "restitution": restitution}],
                           valid_while=[{"name": "slow", "expression": condition, "reason": "fast", "message": "too fast"}])
        del scene["parameters"]
        return self.ask("simulate", {"system": scene, "t_end": end, "samples": 7, **options})

    def test_it_stops_with_the_impact_and_that_is_certain(self):
        source = random.Random(3)
        for _ in range(20):
            height, gravity, restitution = (f"{source.uniform(*ends):.3f}" for ends in ((0.3, 3), (1, 10), (0.3, 0.95)))
            h, g, e = mpf(height), mpf(gravity), mpf(restitution)
            number, part = source.randrange(4), source.uniform(0.05, 0.5)
            first = mpmath.sqrt(2*h/g)
            speeds = [g*first*e**(i + 1) for i in range(number + 1)]
            end = first + sum(2*speed/g for speed in speeds[:-1])
            limit = f"{float(speeds[-1]*(1 - part) + mpf('0.8')*g*end):.6f} - 0.8*{gravity}*t"
            for options in OPTIONS:
                with self.subTest(h=height, g=gravity, e=restitution, c=limit, **options):
                    answer = self.bounce(height, gravity, restitution, f"{limit} - x_dot", 30, options)
                    stop = answer["stop"]
                    self.assertLessEqual(abs(mpf(stop["t"]) - end), mpf(stop["error"]))
                    for name, true in (("x", 0), ("x_dot", speeds[-1])):
                        self.assertLessEqual(abs(mpf(stop["state"][name]) - true), mpf(stop["state_error"][name]))
                    self.assertNotIn("may stop at another time", answer["accuracy"].get("reason", ""))

    def test_where_the_speed_after_it_is_the_limit_it_may_go_on(self):
        source = random.Random(4)
        for _ in range(6):
            height, gravity, restitution = (f"{source.uniform(*ends):.3f}" for ends in ((0.3, 3), (1, 10), (0.3, 0.95)))
            speed = mpmath.sqrt(2*mpf(height)*mpf(gravity))*mpf(restitution)
            speed += mpf("0.8")*mpmath.sqrt(2*mpf(height)*mpf(gravity))
            for off in ("1e-17", "-1e-17", "1e-18"):
                for options in OPTIONS:
                    with self.subTest(h=height, g=gravity, e=restitution, off=off, **options):
                        condition = f"{mpmath.nstr(speed + mpf(off), 30)} - 0.8*{gravity}*t - x_dot"
                        end = float(mpmath.sqrt(2*mpf(height)/mpf(gravity))*(1 + mpf(restitution)))
                        answer = self.bounce(height, gravity, restitution, condition, end, options)
                        self.assertIn("as near to 'slow' as its error", answer["accuracy"].get("reason", ""))
                        self.assertNotIn("error", answer.get("stop") or {})

    def test_where_it_is_more_by_a_little_the_motion_does_not_go_on_as_if_it_were_not(self):
        source = random.Random(5)
        for _ in range(20):
            height, gravity, restitution = (f"{source.uniform(*ends):.3f}" for ends in ((0.3, 3), (1, 10), (0.3, 0.95)))
            speed = mpmath.sqrt(2*mpf(height)*mpf(gravity))*mpf(restitution)
            for off in ("5e-14", "1e-14", "5e-15"):
                for options in OPTIONS:
                    with self.subTest(h=height, g=gravity, e=restitution, off=off, **options):
                        condition = f"{mpmath.nstr(speed - mpf(off), 30)} - x_dot"
                        answer = self.bounce(height, gravity, restitution, condition, float(speed/mpf(gravity)*(1 + 1/mpf(restitution))), options)
                        why = answer["accuracy"].get("reason", "")
                        self.assertTrue("stop" in answer or "as near to 'slow'" in why or "computation stopped" in why, answer)


if __name__ == "__main__":
    unittest.main()
