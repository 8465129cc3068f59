"""Dry friction and other kinks: each motion is held against its smooth pieces in closed form, at 40 digits.

A mass slides to rest and stays, oscillates until its spring no longer moves it, sticks to a belt, starts when a force
has grown, and passes the kinks of potentials and drives.
"""

import pathlib
import random
import sys
import unittest

from mpmath import asin, cos, floor, mp, mpf, nstr, pi, sin, sqrt

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

mp.dps = 40
ROUND_OFF = 1e-15
ACCURACIES = ({}, {"accuracy": "fast"}, {"accuracy": "accurate"}, {"max_error": 1e-9}, {"method": "adams"}, {"method": "bdf"},
              {"method": "erk"})


def mass(*forces):
    """Masses of 1 kg on a line; F, L, T are units."""
    points = [f"P{i}" for i in range(len(forces))]
    return {"name": "masses",
            "parameters": [{"name": name, "unit": unit, "default": "1"}
                           for name, unit in (("m", "kg"), ("F", "N"), ("L", "m"), ("T", "s"))],
            "coordinates": [{"name": f"x{i}", "unit": "m", "initial": "0", "initial_rate": "0"} for i in range(len(forces))],
            "points": [{"name": p, "components": [f"x{i}", "0"]} for i, p in enumerate(points)],
            "bodies": [{"kind": "particle", "name": f"body{i}", "mass": "m", "position": p} for i, p in enumerate(points)],
            "forces": [{"name": f"force{i}", "vector": [f"F*({forces[i]})", "0"], "point": p} for i, p in enumerate(points)]}


class DryFriction(Service):
    def check(self, request, truth):
        """Every row is within the stated error of truth(t) = (x, v), and the error is stated small."""
        answer = self.ask("simulate", {"samples": 9, **request})
        accuracy, rows = answer["accuracy"], answer["trajectory"]
        self.assertIsNotNone(accuracy["max_abs_error"], accuracy)
        if accuracy["method"] == "taylor":
            self.assertIs(accuracy["bounded"], True)
        for i, t in enumerate(rows["t"]):
            for name, value in zip(("x0", "x0_dot"), truth(mpf(t))):
                error = accuracy["max_abs_error"][name]
                self.assertLessEqual(abs(mpf(rows[name][i]) - value), error + ROUND_OFF, f"{name} at {t}")
                self.assertLess(error, 1e-2)
        return answer

    def test_a_mass_slides_to_rest_and_stays(self):
        draw = random.Random(1)
        for _ in range(30):
            mu, v = (f"{draw.uniform(0.1, 3):.3g}" for _ in range(2))
            accuracy = draw.choice(ACCURACIES)
            with self.subTest(mu=mu, v=v, **accuracy):
                rest = mpf(v)/mpf(mu)

                def truth(t):
                    s = min(t, rest)
                    return mpf(v)*s - mpf(mu)*s*s/2, mpf(v) - mpf(mu)*s

                answer = self.check({"system": mass(f"-{mu}*sign(x0_dot)"), "initial": {"x0_dot": float(v)}, "t_end": 31,
                                     "include": ["accelerations"], **accuracy}, truth)
                self.assertEqual(answer["trajectory"]["x0_dot"][-1], 0)
                self.assertEqual(answer["trajectory"]["x0_ddot"][-1], 0)
                [stick] = answer["sticking"]
                self.assertEqual(stick["where"], "x0_dot = 0")
                self.assertAlmostEqual(stick["from"], float(rest), delta=1e-2)
                self.assertEqual(stick["to"], 31)

    def test_fast_masses_slide_to_rest_too(self):
        """At 1e9 m/s the last digit of the time is 1e-7 m/s."""
        for v, mu in (("9.503e9", "7.676737642498904e9"), ("3.1e12", "1.23456789e12"), ("7.7e14", "3.3333333e13")):
            rest = mpf(v)/mpf(mu)

            def truth(t):
                s = min(t, rest)
                return mpf(v)*s - mpf(mu)*s*s/2, mpf(v) - mpf(mu)*s

            answer = self.ask("simulate", {"system": mass(f"-{mu}*sign(x0_dot)"), "initial": {"x0_dot": float(v)}, "t_end": 30,
                                           "samples": 3})
            accuracy = answer["accuracy"]["max_abs_error"]
            for name, value in zip(("x0", "x0_dot"), truth(mpf(30))):
                self.assertLessEqual(abs(mpf(answer["trajectory"][name][-1]) - value), accuracy[name])
            self.assertLess(accuracy["x0"], 1e-13*float(v)*30)

    def test_an_oscillation_ends_where_friction_holds_the_spring(self):
        draw = random.Random(2)
        for _ in range(30):
            k, mu, x = f"{draw.uniform(1, 30):.3g}", f"{draw.uniform(0.1, 2):.3g}", f"{draw.uniform(0.5, 3):.3g}"
            accuracy = draw.choice(ACCURACIES)
            with self.subTest(k=k, mu=mu, x=x, **accuracy):
                omega, shift = sqrt(mpf(k)), mpf(mu)/mpf(k)

                def truth(t):
                    start, side = mpf(x), 1  # half oscillations about +-shift, each 2 shift shorter
                    while abs(start) > shift:
                        if t < pi/omega:
                            amplitude = start - side*shift
                            return side*shift + amplitude*cos(omega*t), -amplitude*omega*sin(omega*t)
                        start, side, t = 2*side*shift - start, -side, t - pi/omega
                    return start, mpf(0)

                self.check({"system": mass(f"-{k}*x0/L - {mu}*sign(x0_dot)"), "initial": {"x0": float(x)}, "t_end": 12,
                            **accuracy}, truth)

    def test_a_belt_carries_a_mass_until_the_spring_is_stronger(self):
        """With its friction as one, and as two, of which one may drive, whose signs are of multiples of one speed."""
        draw = random.Random(3)
        for i in range(60):
            k, mu, v = f"{draw.uniform(1, 30):.3g}", f"{draw.uniform(0.2, 2):.3g}", f"{draw.uniform(0.1, 1):.3g}"
            multiple = ("3", "0.5", "1.7", "10")[i // 3 % 4]
            other = f"sign({multiple}*x0_dot - {nstr(mpf(multiple)*mpf(v), 10)}*L/T)"
            friction = (f"-{mu}*sign(x0_dot - {v}*L/T)", f"-{mu}/4*{other} - 3*{mu}/4*sign(x0_dot - {v}*L/T)",
                        f"+ {mu}/4*{other} - 5*{mu}/4*sign(m*x0_dot - m*{v}*L/T)")[i % 3]
            accuracy = draw.choice(ACCURACIES)
            with self.subTest(k=k, friction=friction, **accuracy):
                omega, stretch, speed = sqrt(mpf(k)), mpf(mu)/mpf(k), mpf(v)

                def truth(t):  # once it slips, undamped about the stretch: it just reaches the belt's speed once a period
                    s = t - stretch/speed
                    if s < 0:
                        return speed*t, speed
                    return stretch + speed/omega*sin(omega*s), speed*cos(omega*s)

                slips = min(stretch/speed + 2*pi/omega*mpf("6.5" if i % 5 == 0 else "0.95"), mpf(20))
                answer = self.check({"system": mass(f"-{k}*x0/L {friction}"),
                                     "initial": {"x0_dot": float(v)}, "t_end": float(slips), **accuracy}, truth)
                self.assertEqual(answer["sticking"][0]["from"], 0)
                self.assertLess(answer["accuracy"]["max_abs_error"]["x0"], 1e-3)

    def test_a_mass_starts_when_the_force_is_large_enough(self):
        draw = random.Random(4)
        for _ in range(30):
            a, w, share = f"{draw.uniform(1, 5):.3g}", f"{draw.uniform(0.3, 3):.3g}", f"{draw.uniform(0.1, 0.9):.3g}"
            accuracy = draw.choice(ACCURACIES)
            with self.subTest(a=a, w=w, share=share, **accuracy):
                begin, mu = asin(mpf(share))/mpf(w), mpf(share)*mpf(a)

                def truth(t):
                    if t < begin:
                        return mpf(0), mpf(0)
                    s, amplitude = t - begin, mpf(a)/mpf(w)
                    top = cos(mpf(w)*begin)
                    return (amplitude*top*s - amplitude/mpf(w)*(sin(mpf(w)*t) - sin(mpf(w)*begin)) - mu*s*s/2,
                            amplitude*(top - cos(mpf(w)*t)) - mu*s)

                self.check({"system": mass(f"{a}*sin({w}*t/T) - {share}*{a}*sign(x0_dot)"), "t_end": float(pi/2/mpf(w)),
                            **accuracy}, truth)

    def test_kinks_of_potentials_are_passed(self):
        draw = random.Random(5)
        for _ in range(20):
            a, x, t_end = f"{draw.uniform(0.3, 5):.3g}", f"{draw.uniform(0.3, 3):.3g}", draw.choice((5, 50))
            accuracy = draw.choice(ACCURACIES[:4])
            with self.subTest(a=a, x=x, t_end=t_end, **accuracy):
                quarter = sqrt(2*mpf(x)/mpf(a))

                def truth(t):  # parabolas
                    turn = floor(t/(2*quarter) + mpf(1)/2)
                    s, side = t - turn*2*quarter, 1 if int(turn) % 2 == 0 else -1
                    return side*(mpf(x) - mpf(a)*s*s/2), -side*mpf(a)*s

                self.check({"system": {**mass("0"), "potential": f"{a}*F*abs(x0)"}, "initial": {"x0": float(x)}, "t_end": t_end,
                            **accuracy}, truth)

    def test_springs_that_are_stiffer_on_one_side_are_followed(self):
        draw = random.Random(6)
        for _ in range(20):
            soft, more, v = (f"{draw.uniform(1, 9):.3g}" for _ in range(3))
            with self.subTest(soft=soft, more=more, v=v):
                slow, fast = sqrt(mpf(soft)), sqrt(mpf(soft) + mpf(more))

                def truth(t):
                    t = t - floor(t/(pi/slow + pi/fast))*(pi/slow + pi/fast)
                    omega, side = (fast, 1) if t < pi/fast else (slow, -1)
                    s = t if side == 1 else t - pi/fast
                    return side*mpf(v)/omega*sin(omega*s), side*mpf(v)*cos(omega*s)

                self.check({"system": mass(f"-{soft}*x0/L - {more}*(x0 + abs(x0))/L/2"), "initial": {"x0_dot": float(v)},
                            "t_end": 10}, truth)

    def test_rectified_drives_are_followed(self):
        draw = random.Random(7)
        for _ in range(20):
            a, w = f"{draw.uniform(0.5, 5):.3g}", f"{draw.uniform(0.3, 9):.3g}"
            with self.subTest(a=a, w=w):
                scale = mpf(a)/mpf(w)

                def truth(t):  # v gains 2 a/w in each half turn
                    half = floor(mpf(w)*t/pi)
                    u = mpf(w)*t - half*pi
                    return scale/mpf(w)*(pi*half*half + 2*half*u + u - sin(u)), scale*(2*half + 1 - cos(u))

                self.check({"system": mass(f"{a}*abs(sin({w}*t/T))"), "t_end": 12}, truth)

    def test_a_force_that_acts_for_microseconds_keeps_its_digits(self):
        """1 - ((t - c)/w)^2 multiplied out would be a sum of terms (c/w)^2, and its zeros would be off as much."""
        draw = random.Random(8)
        for _ in range(24):
            c, w = f"{draw.uniform(2, 9):.3f}", f"{draw.uniform(1, 9):.1f}e-5"
            accuracy = draw.choice(({}, {"rtol": 1e-4}, {"rtol": 1e-6}, {"accuracy": "balanced"}, {"accuracy": "accurate"}))
            with self.subTest(c=c, w=w, **accuracy):
                def truth(t):
                    return (4*mpf(w)*(t - mpf(c)), 4*mpf(w)) if t > mpf(c) else (mpf(0), mpf(0))

                answer = self.check({"system": mass(f"1 + sign(1 - ((t/T - {c})/{w})^2)"), "t_end": 11, "samples": 2,
                                     **accuracy}, truth)
                self.assertLess(answer["accuracy"]["max_abs_error"]["x0_dot"], 2e-6*4*float(w))

    def test_a_drive_that_is_hardly_stronger_moves_it_hardly(self):
        """By 9.6e-17 of the force, for 18 ns: x = 9/4 A s^2 where the drive is A (1 - (t/s)^2) beyond friction; then back."""
        friction = mpf("0.7619999999999999040926")
        beyond = mpf("0.762") - friction
        moved = mpf(9)/4*beyond*2*beyond/(mpf("0.762")*mpf("2.652")**2)
        for accuracy in ACCURACIES[:4]:
            answer = self.ask("simulate", {"system": mass("-1.539*x0/L + 0.762*sin(2.652*t/T) - 0.7619999999999999040926*sign(x0_dot)"), "t_end": 2.053, "samples": 3, **accuracy})
            error = answer["accuracy"]["max_abs_error"]["x0"]
            self.assertIsNotNone(error, answer["accuracy"])
            self.assertLess(error, 1e-30)
            self.assertLessEqual(abs(answer["trajectory"]["x0"][1] - moved), error)
            self.assertIn("comes as near to", answer["accuracy"]["reason"])

    def test_two_masses_stick_each_by_itself(self):
        scene = mass("0.5*x1/L - 0.5*x0/L - 2*sign(x0_dot)", "0.5*x0/L - 0.5*x1/L - 1*sign(x1_dot)")
        answer = self.ask("simulate", {"system": scene, "initial": {"x0_dot": 1, "x1_dot": 0.4}, "t_end": 30, "samples": 4})
        self.assertEqual({stick["where"] for stick in answer["sticking"]}, {"x0_dot = 0", "x1_dot = 0"})
        self.assertEqual([answer["trajectory"][name][-1] for name in ("x0_dot", "x1_dot")], [0, 0])

    def test_what_rests_has_no_acceleration(self):
        for push, acceleration in (("2.9", 0), ("3.5", 0.5), ("-2.9", 0), ("-3.5", -0.5)):
            with self.subTest(push=push):
                answer = self.ask("energy", {"system": mass(f"{push} - 3*sign(x0_dot)")})
                self.assertAlmostEqual(answer["accelerations"]["x0_ddot"], acceleration, delta=1e-14)

    def test_where_nothing_tells_which_way_is_refused(self):
        problem = self.refused("simulate", {"system": mass("sign(x0_dot)"), "t_end": 3})
        self.assertEqual(problem["reason"], "undetermined")
        self.assertIn("t_reached", problem)


if __name__ == "__main__":
    unittest.main()
