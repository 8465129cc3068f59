"""A ball that comes to rest on a slope or a floor, where the motion ends within 1e-7 s of the instant at which its
impacts accumulate: some are lower than its distance is rounded, and errors of velocities hold what they change."""

import pathlib
import random
import sys
import unittest

from mpmath import mp, mpf

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

mp.dps = 40
CASES = 90


class Ball:
    """Thrown along x above the line a x + b (y - c) = 0, with the restitution e."""

    def __init__(self, draw):
        self.g = draw.choice((1.38, 7.97, 9.81, 10, 3.96))
        self.e = draw.choice((0.01, 0.05, 0.1, 0.2, 0.3, 0.5))
        lines = ((3, 4, 0), (5, 12, 0), (-8, 15, 0), (0, 1, 0.1), (0, 1, -0.37), (0, 1, 10.7))
        self.a, self.b, self.c = draw.choice(lines)
        self.u = draw.randint(-100, 100) / 100
        self.y = round(self.c + draw.randint(50, 2000) / 1000, 3)
        self.is_curved = self.a == 0 and draw.random() < 0.3
        norm = mp.hypot(self.a, self.b)
        self.normal, self.tangent = mpf(self.a) / norm, mpf(self.b) / norm  # components along x
        self.g_normal, self.g_along = mpf(str(self.g)) * self.tangent, mpf(str(self.g)) * self.normal
        u = mpf(str(self.u))
        height = self.tangent * (mpf(str(self.y)) - mpf(str(self.c)))
        self.speed = mp.sqrt((self.normal * u) ** 2 + 2 * self.g_normal * height)
        self.first = (self.normal * u + self.speed) / self.g_normal
        e = mpf(str(self.e))
        self.rest = self.first + 2 * e * self.speed / self.g_normal / (1 - e)
        self.end = float(self.rest + draw.choice((1, -1)) * mpf(10) ** draw.uniform(-11, -7))

    def request(self, options):
        distance = f"({self.a})*x + ({self.b})*y" if self.a else f"y - ({self.c})"
        if self.is_curved:
            distance = f"({distance})*(2 + x^2)"
        scene = {
            "name": "ball",
            "units": "none",
            "coordinates": [
                {"name": "x", "initial": "0", "initial_rate": str(self.u)},
                {"name": "y", "initial": str(self.y), "initial_rate": "0"},
            ],
            "lagrangian": f"x_dot^2/2 + y_dot^2/2 - ({self.g})*y",
            "events": [{"name": "ground", "expression": distance, "direction": "falling"}],
            "impacts": [{"event": "ground", "restitution": self.e}],
        }
        return {"system": scene, "t_end": self.end, "samples": 3, **options}

    def impacts(self):
        """Those before the end, and the speed of flight after the last, away from the line."""
        e, t, speed, all_of_them = mpf(str(self.e)), self.first, mpf(str(self.e)) * self.speed, []
        while t <= mpf(self.end) and len(all_of_them) < 200:
            all_of_them.append(t)
            t, speed = t + 2 * speed / self.g_normal, e * speed
        return all_of_them, speed / e

    def velocity_at_end(self):
        end, speed = mpf(self.end), mpf(0)
        if end < self.rest:
            before, left = self.impacts()
            speed = left - self.g_normal * (end - before[-1])
        along = self.tangent * mpf(str(self.u)) + self.g_along * end
        return self.normal * speed + self.tangent * along, self.tangent * speed - self.normal * along


class HiddenImpacts(Service):
    def test_velocities_are_within_their_errors_beside_the_instant_of_rest(self):
        draw, complete = random.Random(20261127), 0
        for _ in range(CASES):
            ball = Ball(draw)
            options = draw.choice(({}, {}, {"max_error": 1e-10}, {"accuracy": "fast"}, {"method": "gauss", "h": 0.001}))
            with self.subTest(request=ball.request(options)):
                answer = self.ask("simulate", ball.request(options))
                errors = answer["accuracy"]["max_abs_error"]
                if errors is None:
                    self.assertTrue(answer["accuracy"]["reason"])
                    continue
                if answer["status"] != "complete":
                    self.assertEqual(answer["status"], "stopped")
                    if "error" in answer["stop"]:
                        self.assertLessEqual(abs(answer["stop"]["t"] - ball.rest), answer["stop"]["error"])
                    continue
                complete += 1
                for name, known in zip(("x_dot", "y_dot"), ball.velocity_at_end()):
                    self.assertLessEqual(abs(answer["trajectory"][name][-1] - known), errors[name])
        self.assertGreater(complete, CASES / 3)

    def test_impacts_are_at_their_times(self):
        draw, found = random.Random(20261128), 0
        for _ in range(CASES // 3):
            ball = Ball(draw)
            with self.subTest(request=ball.request({})):
                answer = self.ask("simulate", ball.request({"events": ["ground"]}))
                for event, known in zip(answer["events"], ball.impacts()[0]):
                    if event["error"] is not None:
                        found += 1
                        self.assertLessEqual(abs(event["t"] - known), event["error"])
        self.assertGreater(found, CASES / 3)

    def test_impacts_that_are_missing_are_in_doubt(self):
        """So is an answer that is complete although the ball has come to rest, or the other way round."""
        draw, in_doubt = random.Random(20261129), 0
        for _ in range(CASES):
            ball = Ball(draw)
            with self.subTest(request=ball.request({})):
                answer = self.ask("simulate", ball.request({"events": ["ground"]}))
                stops, rests = answer["status"] == "stopped", mpf(ball.end) >= ball.rest
                if stops == rests and (stops or len(answer["events"]) == len(ball.impacts()[0])):
                    continue
                in_doubt += 1
                if stops and "error" in answer["stop"]:
                    self.assertLessEqual(abs(answer["stop"]["t"] - ball.rest), answer["stop"]["error"])
                else:
                    self.assertTrue(answer["accuracy"].get("reason"))
        self.assertGreater(in_doubt, CASES / 10)

    def test_a_ball_in_flight_is_not_in_doubt(self):
        scene = Ball(random.Random(1)).request({})["system"]
        scene.update(lagrangian="x_dot^2/2 + y_dot^2/2 - 9.81*y")
        scene["coordinates"][1]["initial"] = "1.3"
        scene["events"][0]["expression"] = "y - 0.1"
        for end in (0.3, 0.6, 0.7, 1):
            answer = self.ask("simulate", {"system": scene, "t_end": end, "samples": 3, "events": ["ground"]})
            self.assertNotIn("reason", answer["accuracy"])


if __name__ == "__main__":
    unittest.main()
