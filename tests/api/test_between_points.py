"""What happens between the places that a computation looks at: pulses, walls, crossings, kinks and impacts.

Every truth is a closed form: the speed that a pulse gives a free mass, on which side of a wall a particle ends, how often
a sine crosses a level, when a ball has bounced out.
"""

import json
import math
import pathlib
import random
import sys
import unittest

from mpmath import atan, erf, exp, log, mp, mpf, pi, sin, sqrt, tanh

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

mp.dps = 40


def particle(potential=None, force=False, parameters=()):
    scene = {"name": "particle_on_a_line",
             "parameters": [{"name": "m", "unit": "kg", "default": "1"}, *parameters],
             "coordinates": [{"name": "x", "unit": "m", "initial": "0", "initial_rate": "0"}],
             "points": [{"name": "P", "components": ["x", "0"]}],
             "bodies": [{"kind": "particle", "name": "body", "mass": "m", "position": "P"}]}
    if potential:
        scene["potential"] = potential
    if force:
        scene["inputs"] = [{"name": "F", "unit": "N", "default": "0"}]
        scene["forces"] = [{"name": "push", "vector": ["F", "0"], "point": "P"}]
    return scene


def parameter(name, unit, default):
    return {"name": name, "unit": unit, "default": default}


def gauss(a, c, w, t):
    return a*w*sqrt(pi)/2*(erf((t - c)/w) + erf(c/w))


def lorentz(a, c, w, t):
    return a*w*(atan((t - c)/w) + atan(c/w))


def box(a, c, w, t):
    def integral(z):  # of tanh
        return abs(z) + log(1 + exp(-2*abs(z)))

    def total(s):
        return w*(integral((s - c + 1)/w) - integral((s - c - 1)/w))/2
    return a*(total(t) - total(mpf(0)))


def bell(a, c, w, t):  # of 1/cosh^2
    return a*w*(tanh((t - c)/w) + tanh(c/w))


def hill(a, c, w, t):  # of the logistic function's slope
    return a*w*(1/(1 + exp((c - t)/w)) - 1/(1 + exp(c/w)))


PULSES = {"{a}*exp(-((t-{c})/{w})^2)": gauss, "{a}/(1+((t-{c})/{w})^2)": lorentz,
          "{a}*(tanh((t-{c}+1)/{w})-tanh((t-{c}-1)/{w}))/2": box, "{a}/cosh((t-{c})/{w})^2": bell,
          "{a}*exp((t-{c})/{w})/(1+exp((t-{c})/{w}))^2": hill}
ACCURACIES = ({}, {"accuracy": "fast"}, {"accuracy": "balanced"}, {"accuracy": "accurate"}, {"max_error": 1e-8})


class BetweenPoints(Service):
    def test_no_pulse_is_stepped_over(self):
        draw = random.Random(11)
        for _ in range(80):
            text, speed = draw.choice(list(PULSES.items()))
            a, c, w = (f"{value:.3g}" for value in (10**draw.uniform(-1, 2), draw.uniform(1.5, 8.5),
                                                    10**draw.uniform(-6, -0.3)))
            request = {"system": particle(force=True), "inputs": {"F": text.format(a=a, c=c, w=w)}, "t_end": 10,
                       "samples": 11, **draw.choice(ACCURACIES)}
            with self.subTest(request["inputs"]["F"], **{k: request[k] for k in ("accuracy",) if k in request}):
                answer = self.ask("simulate", request)
                error = abs(mpf(answer["trajectory"]["x_dot"][-1]) - speed(mpf(a), mpf(c), mpf(w), mpf(10)))
                self.assertLessEqual(error, answer["accuracy"]["max_abs_error"]["x_dot"])
                self.assertIs(answer["accuracy"]["bounded"], True)

    def test_a_pulse_of_a_billionth_of_the_time_is_seen(self):
        """Its exponent is rounded by more than an exponential lets pass: -1e20 at the start, 0 in the pulse."""
        draw, seen = random.Random(13), 0
        for i in range(48):
            c, w = f"{draw.uniform(0.5, 9):.5g}", f"{10**draw.uniform(-13, -8):.3g}"
            a = f"{1/float(w):.8g}"
            text, speed = (("{a}*exp(-((t-{c})/{w})^2)", gauss), ("{a}/cosh((t-{c})/{w})^2", bell))[i % 2]
            with self.subTest(c=c, w=w, text=text):
                response = self.post("simulate", {"system": particle(force=True), "inputs": {"F": text.format(a=a, c=c, w=w)},
                                                  "t_end": 10, "samples": 2, **draw.choice(ACCURACIES)})
                if response.status != 200:  # cosh^2 is too large for a double
                    self.assertIn("cosh", text)
                    self.assertIn(json.loads(response.data)["reason"], ("nonfinite", "step-limit"))
                    continue
                answer = json.loads(response.data)
                accuracy, true = answer["accuracy"], speed(mpf(a), mpf(c), mpf(w), mpf(10))
                if not accuracy.get("bounded"):
                    self.assertTrue(accuracy["reason"])
                    continue
                seen += 1
                self.assertLessEqual(abs(mpf(answer["trajectory"]["x_dot"][-1]) - true), accuracy["max_abs_error"]["x_dot"])
        self.assertGreater(seen, 20)

    def test_a_thin_wall_turns_back_what_cannot_pass_it(self):
        draw = random.Random(14)
        wall = particle("V0*exp(-((x-c)/w)^2)", parameters=[parameter("V0", "J", "2"), parameter("w", "m", "0.3"),
                                                            parameter("c", "m", "5")])
        for _ in range(16):
            c, w = draw.uniform(0.5, 9), 10**draw.uniform(-12, -8)
            with self.subTest(c=c, w=w):
                answer = self.ask("simulate", {"system": wall, "parameters": {"c": c, "w": w}, "initial": {"x": 0, "x_dot": 1},
                                               "t_end": 1.5*c, "samples": 2})
                if answer["accuracy"]["bounded"]:
                    self.assertLessEqual(abs(answer["trajectory"]["x_dot"][-1] + 1), answer["accuracy"]["max_abs_error"]["x_dot"])

    def test_what_a_pulse_takes_back_leaves_its_rounding(self):
        """The speed after it is 0, and was a million times the rounding that is left."""
        draw = random.Random(17)
        for _ in range(240):
            a, c, w = (f"{value:.4g}" for value in (draw.uniform(5, 30), draw.uniform(3, 9), 10**draw.uniform(-4, -1.5)))
            u = f"((t-{c})/{w})"
            accuracy = draw.choice([{"accuracy": "accurate"}, {"max_evaluations": 20000}, {"rtol": 1e-14, "atol": 1e-17}])
            answer = self.ask("simulate", {"system": particle(force=True), "inputs": {"F": f"{a}*{u}*exp(-{u}^2/2)"},
                                           "times": [1, 12], "t_end": 12, **accuracy})
            errors = answer["accuracy"]["max_abs_error"]
            with self.subTest(a=a, c=c, w=w, **accuracy):
                self.assertLessEqual(abs(answer["trajectory"]["x_dot"][1]), errors["x_dot"])
                self.assertLess(errors["x_dot"], 1e-11)
                shift = -mpf(a)*mpf(w)**2*sqrt(2*pi)
                self.assertLessEqual(abs(mpf(repr(answer["trajectory"]["x"][1])) - shift), errors["x"])

    def test_no_wall_is_tunnelled_through(self):
        draw = random.Random(12)
        wall = particle("V0*exp(-((x-c)/w)^2)", parameters=[parameter("V0", "J", "10"), parameter("w", "m", "0.3"),
                                                            parameter("c", "m", "5")])
        for _ in range(30):
            height, width = draw.uniform(0.5, 20), 10**draw.uniform(-3, 0)
            share = draw.choice((0.05, 0.3, 0.7, 0.95, 1.05, 1.5))
            speed = math.sqrt(2*height*share)
            with self.subTest(height=height, width=width, share=share):
                answer = self.ask("simulate", {"system": wall, "parameters": {"V0": height, "w": width},
                                               "initial": {"x": 0, "x_dot": speed}, "t_end": 12/speed, "samples": 3})
                self.assertEqual(answer["trajectory"]["x"][-1] > 5, share > 1)

    def test_a_layer_far_from_the_origin_keeps_its_digits(self):
        """Multiplied out, 1 + ((x - c)/w)^8 is a sum of terms (c/w)^8, and its 1 is lost."""
        layer = particle(parameters=[parameter("b", "kg/s", "1"), parameter("c", "m", "2"), parameter("w", "m", "1")])
        layer["dissipation"] = "b*x_dot^2/(1+((x-c)/w)^8)"
        for b, c, w in (("2.085", "1.153", "0.0003814"), ("0.9838", "3.666", "0.004614"), ("20", "2.5", "0.01")):
            lost = 2*mpf(b)*mpf(w)*2*(pi/8)/sin(pi/8)
            for accuracy in ({"rtol": 1e-5, "atol": 1e-8}, *ACCURACIES):
                with self.subTest(c=c, w=w, **accuracy):
                    answer = self.ask("simulate", {"system": layer, "initial": {"x_dot": 5}, "t_end": 3, "samples": 3,
                                                   "parameters": {"b": float(b), "c": float(c), "w": float(w)},
                                                   **accuracy})
                    error = abs(mpf(answer["trajectory"]["x_dot"][-1]) - 5 + lost)
                    self.assertLessEqual(error, answer["accuracy"]["max_abs_error"]["x_dot"] + 1e-16)
                    self.assertIsNot(answer["accuracy"].get("meets_request"), False)

    def test_every_crossing_is_an_event(self):
        oscillator = particle("k*x^2/2", parameters=[parameter("k", "N/m", "1"), parameter("L", "m", "1")])
        for rate in (1, 10, 63, 500):
            answer = self.ask("simulate", {"system": oscillator, "parameters": {"k": rate**2}, "initial": {"x": 1},
                                           "t_end": math.pi, "samples": 2, "events": ["x=0"]})
            times = [event["t"] for event in answer["events"]]
            self.assertEqual(len(times), rate)
            for i, t in enumerate(times):
                self.assertAlmostEqual(t, (i + 0.5)*math.pi/rate, 9)
        answer = self.ask("simulate", {"system": oscillator, "initial": {"x": 1}, "t_end": 20, "samples": 2,
                                       "events": ["tan(2*x/L)=0", "L/x=0", "abs(x)/L=1/2", "x^2=0", "x^2/L^2=1e-12"]})
        names = [event["name"] for event in answer["events"]]
        counts = {name: names.count(name) for name in set(names)}  # poles and touches are no crossings
        self.assertEqual(counts, {"tan(2*x/L)=0": 6, "abs(x)/L=1/2": 13, "x^2/L^2=1e-12": 12})

    def test_crossings_of_the_first_step_are_events_too(self):
        """Over a long first step g is known less well than where it starts, and g is not zero there for that."""
        oscillator = particle("k*x^2/2", parameters=[parameter("k", "N/m", "1"), parameter("L", "m", "1")])
        for amplitude, rate, event, levels in ((2.5, 0.6, "(x/L+0.65)*(x/L-1.07)*(x/L+0.640)=0", (-0.65, 1.07, -0.64)),
                                               (0.22, 1.66, "sin(2.08*x/L)=0", (0,)),
                                               (1, 13, "(x/L+0.45)*(x/L-0.57)*(x/L+0.4499)=0", (-0.45, 0.57, -0.4499))):
            for start in (0.1, 0.5, 0.7, 1.3, 2.9):  # phase
                for goal in ACCURACIES:
                    answer = self.ask("simulate", {
                        "system": oscillator, "parameters": {"k": rate**2}, "t_end": 20/rate, "samples": 2,
                        "initial": {"x": amplitude*math.cos(start), "x_dot": -amplitude*rate*math.sin(start)},
                        "events": [event], **goal})
                    phases = [s + turn for level in levels for turn in (0, 2*math.pi, 4*math.pi, 6*math.pi)
                              for s in (math.acos(level/amplitude), 2*math.pi - math.acos(level/amplitude))]
                    times = sorted((phase - start)/rate for phase in phases if 0 < phase - start < 20)
                    found = [found["t"] for found in answer["events"]]
                    with self.subTest(event=event, start=start, **goal):
                        self.assertEqual(len(found), len(times))
                        for one, other in zip(found, times):
                            self.assertAlmostEqual(one, other, 3)

    def test_a_condition_that_fails_for_a_moment_stops_the_motion(self):
        scene = particle("k*x^2/2", parameters=[parameter("k", "N/m", "1"), parameter("L", "m", "1")])
        scene["valid_while"] = [{"name": "room", "unit": "m", "expression": "0.999*L - x", "reason": "hit",
                                 "message": "The particle hit the wall."}]
        answer = self.ask("simulate", {"system": scene, "initial": {"x_dot": 1}, "t_end": 20, "samples": 3})
        self.assertEqual(answer["status"], "stopped")
        self.assertAlmostEqual(answer["stop"]["t"], math.asin(0.999), 9)

    def test_a_ball_bounces_out_and_never_falls_through_the_floor(self):
        ball = particle("m*g*x", parameters=[parameter("g", "m/s^2", "9.81"), parameter("e", "1", "0.8")])
        ball["events"] = [{"name": "floor", "expression": "x", "direction": "falling"}]
        ball["impact"] = {"event": "floor", "map": {"x_dot": "-e*x_dot"}}
        for e in (0.3, 0.5, 0.8, 0.95):
            with self.subTest(e=e):
                answer = self.ask("simulate", {"system": ball, "parameters": {"e": e}, "initial": {"x": 1}, "t_end": 30,
                                               "samples": 301, "events": ["floor"]})
                self.assertEqual(answer["stop"]["reason"], "impacts_accumulate")
                end = math.sqrt(2/9.81)*(1 + 2*e/(1 - e))
                self.assertAlmostEqual(answer["stop"]["t"], end, 9)
                self.assertGreaterEqual(min(answer["trajectory"]["x"]), -1e-12)
        resting = self.ask("simulate", {"system": ball, "initial": {"x": 0}, "t_end": 1, "samples": 11})
        self.assertEqual((resting["stop"]["reason"], resting["stop"]["t"]), ("impacts_accumulate", 0))

    def test_kinks_of_a_force_are_passed_on_both_smooth_sides(self):
        corner = particle("k*abs(x)", parameters=[parameter("k", "N", "1")])  # parabolas between the zeros
        answer = self.ask("simulate", {"system": corner, "initial": {"x": 0.5}, "t_end": 9, "samples": 10,
                                       "max_error": 1e-9})
        self.assertIs(answer["accuracy"]["meets_request"], True)
        for t, x in zip(answer["trajectory"]["t"], answer["trajectory"]["x"]):
            s = t % 4  # x = 1/2 - t^2/2 for a quarter of the period 4
            exact = 0.5 - s*s/2 if s <= 1 else (s - 2)**2/2 - 0.5 if s <= 3 else 0.5 - (4 - s)**2/2
            self.assertLessEqual(abs(x - exact), answer["accuracy"]["max_abs_error"]["x"] + 1e-15)


if __name__ == "__main__":
    unittest.main()
