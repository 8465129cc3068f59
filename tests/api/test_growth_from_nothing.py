"""x'' = k x + push(t), from 1e-90 to 1e-18 or from rest: what lies far below every tolerance grows with the motion, and
the error stated with it. Against cosh and sinh, and the integral over the pulse."""

import json
import pathlib
import random
import sys
import unittest

from mpmath import mp, mpf

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mp.dps = 60
OPTIONS = ({}, {}, {"max_error": 1e-3}, {"max_error": 1e-6}, {"rtol": 1e-6}, {"rtol": 1e-4}, {"accuracy": "fast"},
           {"accuracy": "balanced"}, {"precision": "extended"})


class GrowthFromNothing(Service):
    def check(self, scene, end, options, x, v):
        del scene["parameters"]
        request = {"system": scene, "t_end": float(end), "samples": 2, **options}
        with self.subTest(request=request):
            response = self.post("simulate", request)
            self.assertEqual(response.status, 200, response.data[:500])
            answer = json.loads(response.data, parse_float=mpf)
            errors = answer["accuracy"]["max_abs_error"]
            if errors is None:
                self.assertTrue(answer["accuracy"]["reason"])
                return 0
            for name, known in (("x", x), ("x_dot", v)):
                off = abs(answer["trajectory"][name][-1] - known)
                self.assertLessEqual(off, errors[name] * (1 + mpf(10) ** -10))
            return 1

    def test_a_start_far_below_the_tolerance(self):
        draw, measured = random.Random(20261129), 0
        for _ in range(120):
            k = mpf(draw.randint(100, 2000)) / 100
            rate = mp.sqrt(k)
            x = mpf(draw.randint(1, 999)) * mpf(10) ** draw.randint(-32, -18)
            v = draw.choice((mpf(0), 3 * x, -2 * x, mpf(mp.nstr(-rate * x, draw.choice((5, 17, 25))))))
            end = mpf(mp.nstr(draw.uniform(5, 70) / rate, 4))
            start = f"x - {mp.nstr(x, 30)} {mp.nstr(v, 30)}"
            force = f"{mp.nstr(k, 6)}*x"
            scene = (lagrangian("top", "", start, f"x_dot^2/2 + {force}*x/2") if draw.random() < 0.5 else
                     lagrangian("top", "", start, "x_dot^2/2", forces=[{"name": "f", "value": force, "along": "x"}]))
            grown, rising = mp.cosh(rate * end), mp.sinh(rate * end)
            measured += self.check(scene, end, draw.choice(OPTIONS), x * grown + v / rate * rising, x * rate * rising + v * grown)
        self.assertGreater(measured, 100)

    def test_a_start_on_the_direction_that_decays(self):
        """To some digits: what is left of the other direction grows to more than the start was, and so do all errors."""
        draw, measured = random.Random(20261201), 0
        for _ in range(300):
            k = mpf(draw.randint(100, 1200)) / 100
            rate = mp.sqrt(k)
            x = mpf(draw.randint(100, 999)) / 100 * mpf(10) ** draw.randint(-18, 2)
            v = mpf(mp.nstr(-rate * x, draw.choice((16, 17, 20, 22, 25, 28))))
            end = mpf(mp.nstr(draw.uniform(5, 75) / rate, 4))
            scene = lagrangian("top", "", f"x - {mp.nstr(x, 30)} {mp.nstr(v, 30)}", f"x_dot^2/2 + {mp.nstr(k, 6)}*x^2/2")
            grown, rising = mp.cosh(rate * end), mp.sinh(rate * end)
            options = draw.choice(({}, {"max_error": 1e-9}, {"precision": "extended"}))
            measured += self.check(scene, end, options, x * grown + v / rate * rising, x * rate * rising + v * grown) or 0
        self.assertGreater(measured, 250)

    def test_what_comes_back_by_rounding_alone(self):
        """x'' = k x - c x' from so near to the direction that decays that both computations are lost to the same side."""
        lost = (("0.606", "-2.01715548427275", "11.203", "-0.037", 11.29, {"max_error": 1e-9}),
                ("0.308", "-0.7585864973619602425", "7.933", "-0.758", 13.37, {"max_error": 1e-9}),
                ("0.375", "-0.7803244517506804361539", "4.33", "0", 33.47, {"accuracy": "fast"}))
        for x, v, k, c, end, options in lost:
            force = {"name": "f", "value": f"{k}*x - ({c})*x_dot", "along": "x"}
            scene = lagrangian("top", "", f"x - {x} {v}", "x_dot^2/2", forces=[force])
            half = mp.sqrt(mpf(k) + mpf(c) ** 2 / 4)
            rises, falls = half - mpf(c) / 2, -half - mpf(c) / 2
            rising, falling = ((mpf(v) - falls * mpf(x)) / (2 * half) * mp.exp(rises * mpf(end)),
                               (rises * mpf(x) - mpf(v)) / (2 * half) * mp.exp(falls * mpf(end)))
            self.check(scene, end, {**options, "samples": 4}, rising + falling, rises * rising + falls * falling)

    def test_a_push_far_above_the_start(self):
        draw, measured = random.Random(20261202), 0
        for _ in range(120):
            k = mpf(draw.randint(100, 6000)) / 100
            rate = mp.sqrt(k)
            start = draw.randint(1, 9) * mpf(10) ** draw.randint(-90, -30)
            push = draw.randint(1, 9) * mpf(10) ** draw.randint(-30, -14)
            end = mpf(mp.nstr(draw.uniform(25, 65) / rate, 4))
            force = {"name": "f", "value": f"{mp.nstr(k, 6)}*x + {mp.nstr(push, 30)}", "along": "x"}
            scene = lagrangian("top", "", f"x - {mp.nstr(start, 30)} 0", "x_dot^2/2", forces=[force])
            options = draw.choice(({}, {}, {"rtol": 1e-2}, {"rtol": 1e-4}))
            grown, rising = mp.cosh(rate * end), mp.sinh(rate * end)
            off = start + push / k
            measured += self.check(scene, end, options, off * grown - push / k, off * rate * rising) or 0
        self.assertEqual(measured, 120)

    def test_a_push_beside_a_balance(self):
        """Of forces that doubles cannot tell from one: no term of a series in doubles shows any of what grows."""
        draw, measured = random.Random(20261203), 0
        for _ in range(120):
            k, place = mpf(draw.randint(500, 60000)) / 1000, mpf(draw.randint(100, 1999)) / 1000
            push = draw.choice((-1, 1)) * draw.randint(1, 9) * mpf(10) ** draw.randint(-28, -18)
            rate, typed = mp.sqrt(k), mpf(0)
            end = mpf(mp.nstr(draw.uniform(5, 40) / rate, 4))
            if draw.random() < 0.5:
                typed, push = push / 10, push / 10 * k  # of the place itself
                force = f"{mp.nstr(k, 6)}*x - {mp.nstr(k * place, 12)}"
            else:
                force = f"{mp.nstr(k, 6)}*x - {mp.nstr(k * place, 12)} + ({mp.nstr(push, 3)})"
            forces = [{"name": "f", "value": force, "along": "x"}]
            scene = lagrangian("top", "", f"x - {mp.nstr(place + typed, 40)} 0", "x_dot^2/2", forces=forces)
            grown, rising = mp.cosh(rate * end), mp.sinh(rate * end)
            x = place + typed + push / k * (grown - 1)
            options = draw.choice(({"max_error": 1e-6}, {"max_error": 1e-12}, {"accuracy": "fast"}, {"accuracy": "accurate"}, {}))
            measured += self.check(scene, end, options, x, push / rate * rising)
        self.assertGreater(measured, 110)

    def test_a_push_far_below_the_tolerance(self):
        draw, measured = random.Random(20261130), 0
        for _ in range(60):
            k, size = mpf(draw.choice(("4", "9.81", "25", "100"))), mpf(10) ** draw.randint(-30, -8)
            width, place = mpf(draw.choice(("0.3", "0.1", "0.01", "0.001"))), mpf(draw.randint(2, 6))
            rate = mp.sqrt(k)
            end = place + mpf(mp.nstr(draw.uniform(3, 60) / rate, 4))
            pulse = f"{mp.nstr(size, 3)}*exp(-((t-{place})/{mp.nstr(width, 5)})^2)"
            scene = lagrangian("top", "", "x - 0 0", f"x_dot^2/2 + {mp.nstr(k, 6)}*x^2/2 + x*{pulse}")
            parts = [0] + [place + j * width for j in range(-10, 11, 4) if 0 < place + j * width < end] + [end]

            def over_pulse(response):
                return mp.quad(lambda t: size * mp.exp(-(((t - place) / width) ** 2)) * response(rate * (end - t)), parts)

            measured += self.check(scene, end, draw.choice(OPTIONS), over_pulse(mp.sinh) / rate, over_pulse(mp.cosh))
        self.assertGreater(measured, 40)


if __name__ == "__main__":
    unittest.main()
