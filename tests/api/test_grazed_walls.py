"""Oscillations whose turn lies at a wall, beside it, or at a place where the force jumps: whether it is met cannot be told,
and both ways on stay near each other. The errors hold both, and are no larger than that."""

import pathlib
import random
import sys
import unittest

from mpmath import mp, mpf

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mp.dps = 50
DISTANCES = ("0", "1e-14", "1e-13", "1e-12", "1e-11")
GOALS = ({}, {}, {"accuracy": "accurate"}, {"max_error": 1e-9})
NOTHING_LOST = 1e-2  # lost are errors as large as the motion


class Oscillation:
    """About `centre`, with x'' = -square (x - centre)."""

    def __init__(self, square, centre, x, v):
        self.centre, self.rate, self.x, self.v = centre, mp.sqrt(square), x - centre, v / mp.sqrt(square)

    def at(self, t):
        c, s = mp.cos(self.rate * t), mp.sin(self.rate * t)
        return self.centre + self.x * c + self.v * s, self.rate * (self.v * c - self.x * s)

    def next_at(self, level, is_rising):
        """When it is there next with that direction; None where it does not come so far."""
        amplitude = mp.hypot(self.x, self.v)
        if not abs(level - self.centre) < amplitude:
            return None
        side = mp.acos((level - self.centre) / amplitude) * (-1 if is_rising else 1)
        turns = (mp.atan2(self.v, self.x) + side) / (2 * mp.pi)
        t = (turns - mp.floor(turns)) * 2 * mp.pi / self.rate
        return t if t > mpf(10)**-25 else t + 2 * mp.pi / self.rate


class Graze:
    def __init__(self, draw):
        self.is_exact = draw.random() < 0.4
        self.square = mpf(draw.randint(5, 30)) / 10
        self.start = mpf(draw.randint(300, 1500)) / 1000, mpf(0 if self.is_exact else draw.randint(-1500, 1500)) / 1000
        distance = mpf(draw.choice(DISTANCES)) * (1 if self.is_exact else draw.choice((1, -1)))
        amplitude = mp.hypot(self.start[0], self.start[1] / mp.sqrt(self.square))
        self.level = mpf(self.text(amplitude + distance))
        self.end = draw.choice((7, 10))
        self.goal = draw.choice(GOALS)

    @staticmethod
    def text(x):
        return mp.nstr(x, 30, min_fixed=-99, max_fixed=99)

    def request(self, force, **members):
        x, v = (self.text(y) for y in self.start)
        scene = lagrangian("graze", "", f"x - {x} {v}", "x_dot^2/2", forces=[{"name": "f", "value": force, "along": "x"}], **members)
        del scene["parameters"]
        return {"system": scene, "t_end": self.end, "samples": 6, **self.goal}

    def follow(self, times, inside, beyond):
        """`beyond`: the motion after the place has been met going out, or coming back, from its speed there."""
        begin, motion, is_out, states = mpf(0), Oscillation(self.square, 0, *self.start), True, []
        met = motion.next_at(self.level, True)
        for t in times:
            while met is not None and begin + met < t:
                begin, motion = begin + met, (beyond if is_out else inside)(motion.at(met)[1])
                is_out = not is_out or beyond == inside
                met = motion.next_at(self.level, is_out)
            states.append(motion.at(t - begin))
        return states


class GrazedWalls(Service):
    def judge(self, graze, request, inside, beyond):
        answer = self.ask("simulate", request)
        self.assertEqual(answer["status"], "complete")
        rows, errors = answer["trajectory"], answer["accuracy"]["max_abs_error"]
        known = graze.follow([mpf(t) for t in rows["t"]], inside, beyond)
        for i, state in enumerate(known):
            for name, true in zip(("x", "x_dot"), state):
                self.assertLessEqual(abs(rows[name][i] - true), errors[name])
        return max(errors.values()) < NOTHING_LOST

    def each(self, cases, seed, seen):
        draw, told = random.Random(seed), 0
        for _ in range(cases):
            graze = Graze(draw)
            with self.subTest(start=graze.start, level=graze.level, square=graze.square, **graze.goal):
                told += seen(graze, draw)
        return told

    def test_at_walls(self):
        def seen(graze, draw):
            restitution = draw.choice(("0", "0", "0.5", "1"))
            request = graze.request(f"-{graze.text(graze.square)}*x", impacts=[{"event": "w", "restitution": restitution}],
                                    events=[{"name": "w", "expression": f"{graze.text(graze.level)} - x", "direction": "falling"}])

            def turned(speed):
                return Oscillation(graze.square, 0, graze.level, -mpf(restitution) * speed)

            return self.judge(graze, request, turned, turned)

        self.assertGreater(self.each(80, 4401, seen), 72)

    def test_where_the_force_jumps(self):
        def seen(graze, draw):
            jump = mpf(draw.randint(5, 60)) / 10
            force = f"-{graze.text(graze.square)}*x - {graze.text(jump)}*(1 + sign(x - {graze.text(graze.level)}))/2"
            return self.judge(graze, graze.request(force), lambda speed: Oscillation(graze.square, 0, graze.level, speed),
                              lambda speed: Oscillation(graze.square, -jump / graze.square, graze.level, speed))

        self.assertGreater(self.each(80, 4402, seen), 75)


if __name__ == "__main__":
    unittest.main()
