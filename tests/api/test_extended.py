"""precision=extended: every digit against mpmath's arithmetic with 45 digits, from the decimals as they are typed.

The second road shares nothing with the program: the equations of the practice sheet, written by hand, and a series
method of a fixed order and step in another arithmetic.
"""

import json
import math
import os
import pathlib
import random
import sys
import unittest
from decimal import Decimal, getcontext
from fractions import Fraction

import mpmath
from mpmath import mpf

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mpmath.mp.dps = 45
getcontext().prec = 60
ORDER = 44
REQUESTS = int(os.environ.get("QDOT_EXTENDED_REQUESTS", "12"))


def convolved(a, b, k):
    return mpmath.fsum(a[j]*b[k - j] for j in range(k + 1))


class Angle:
    """Coefficients of the sine and cosine of a series."""

    def __init__(self):
        self.sine, self.cosine = [], []

    def extend(self, u, k):
        if k == 0:
            self.sine.append(mpmath.sin(u[0]))
            self.cosine.append(mpmath.cos(u[0]))
            return
        rate = [j*u[j] for j in range(k + 1)]
        sine = mpmath.fsum(rate[j]*self.cosine[k - j] for j in range(1, k + 1))/k
        cosine = -mpmath.fsum(rate[j]*self.sine[k - j] for j in range(1, k + 1))/k
        self.sine.append(sine)
        self.cosine.append(cosine)


class SpringPendulum:
    """Problem 1: l'' = l theta'^2 + g cos theta - k (l - l0)/m, theta'' = -(g sin theta + 2 l' theta')/l."""

    name, parameters, state = "spring_pendulum", ("m", "k", "l0", "g"), ("l", "theta")

    def __init__(self, p):
        self.p, self.angle, self.square, self.turn = p, Angle(), [], []

    def accelerations(self, q, v, k):
        m, stiffness, l0, g = (self.p[name] for name in self.parameters)
        self.angle.extend(q[1], k)
        self.square.append(convolved(v[1], v[1], k))
        stretch = convolved(q[0], self.square, k) + g*self.angle.cosine[k]
        stretch -= stiffness/m*(q[0][k] - (l0 if k == 0 else 0))
        turn = -(g*self.angle.sine[k] + 2*convolved(v[0], v[1], k))
        turn -= mpmath.fsum(q[0][j]*self.turn[k - j] for j in range(1, k + 1))
        self.turn.append(turn/q[0][0])
        return [stretch, self.turn[k]]


class WhirlingPendulum:
    """Problem 6: theta'' = sin theta (Omega^2 cos theta - g/l)."""

    name, parameters, state = "whirling_pendulum", ("m", "l", "R", "Omega", "g"), ("theta",)

    def __init__(self, p):
        self.p, self.angle = p, Angle()

    def accelerations(self, q, _, k):
        l, spin, g = (self.p[name] for name in ("l", "Omega", "g"))
        self.angle.extend(q[0], k)
        return [spin**2*convolved(self.angle.sine, self.angle.cosine, k) - g/l*self.angle.sine[k]]


def motion(system, p, q, v, t_end, pieces):
    h = t_end/pieces
    for _ in range(pieces):
        equations = system(p)
        qs, vs = [[x] for x in q], [[x] for x in v]
        for k in range(ORDER):
            a = equations.accelerations(qs, vs, k)
            for i, acceleration in enumerate(a):
                qs[i].append(vs[i][k]/(k + 1))
                vs[i].append(acceleration/(k + 1))
        q = [mpmath.polyval(c[::-1], h) for c in qs]
        v = [mpmath.polyval(c[::-1], h) for c in vs]
    return q + v


def decimal(rng, low, high):
    """A decimal with up to 24 digits: some that doubles keep, and some that they do not."""
    return f"{rng.uniform(low, high):.{rng.choice([1, 2, 3, 8])}f}" + rng.choice(["", "", "123456789"])


def drawn(rng, system):
    if system is SpringPendulum:
        p = {"m": decimal(rng, .3, 2), "k": decimal(rng, 20, 60), "l0": decimal(rng, .3, .5), "g": decimal(rng, 5, 10)}
        start = {"l": decimal(rng, .5, .7), "theta": decimal(rng, -.4, .4), "l_dot": decimal(rng, -.2, .2),
                 "theta_dot": decimal(rng, -.4, .4)}
    else:
        p = {"m": decimal(rng, .3, 2), "l": decimal(rng, .4, 1), "R": decimal(rng, .1, .5), "Omega": decimal(rng, 1, 3),
             "g": decimal(rng, 5, 10)}
        start = {"theta": decimal(rng, .1, .6), "theta_dot": decimal(rng, -.5, .5)}
    return p, start


def in_digits(x):
    """Of a fraction of a power of ten."""
    return format(Decimal(x.numerator)/Decimal(x.denominator), "f")


def numbers(table):
    return "{" + ", ".join(f'"{name}": {value}' for name, value in table.items()) + "}"


class Extended(Service):
    def body(self, system, p, start, t_end, more=""):
        return (f'{{"system": "{system.name}", "parameters": {numbers(p)}, "initial": {numbers(start)}, '
                f'"t_end": {t_end}, "samples": 2, "precision": "extended", "on_invalid": "continue"{more}}}')

    def extended(self, body):
        response = self.post("simulate", body)
        self.assertEqual(response.status, 200, response.data[:500])
        return json.loads(response.data, parse_float=str)

    def rows(self, fields):
        response = self.post("simulate", fields)
        self.assertEqual(response.status, 200, response.data[:500])
        return response.data.decode().splitlines()

    def test_every_digit_is_right_within_the_error_that_is_stated(self):
        rng = random.Random(20240611)
        for i in range(REQUESTS):
            system = (SpringPendulum, WhirlingPendulum)[i % 2]
            p, start = drawn(rng, system)
            t_end = decimal(rng, .5, 2.5)
            with self.subTest(system=system.name, p=p, start=start, t_end=t_end):
                answer = self.extended(self.body(system, p, start, t_end, ', "max_error": 1e-24'))
                exact = {name: mpf(value) for name, value in (p | start).items()}
                names = list(system.state) + [q + "_dot" for q in system.state]
                pieces = int(mpf(t_end)*60) + 1
                t = mpf(answer["trajectory"]["t"][-1])
                end = motion(system, exact, [exact[q] for q in system.state],
                             [exact[q + "_dot"] for q in system.state], t, pieces)
                self.assertTrue(answer["accuracy"]["meets_request"])
                for name, value in zip(names, end):
                    stated = mpf(answer["accuracy"]["max_abs_error"][name])
                    found = mpf(answer["trajectory"][name][-1])
                    self.assertLessEqual(abs(found - value), stated)
                    self.assertLessEqual(stated, mpf("1e-24"))

    def test_instants_are_those_that_were_typed(self):
        rng = random.Random(20241125)
        system = json.dumps({"name": "thrown", "units": "none", "coordinates": [{"name": "x"}],
                             "lagrangian": "x_dot^2/2", "forces": [{"name": "push", "value": "3", "along": "x"}]})
        for i in range(24):
            start = Fraction(rng.choice([0, -500, 2000])) + Fraction(rng.randint(1, 9), 10**rng.randint(13, 20))
            end = start + Fraction(rng.randint(10**13, 10**14), 10**14) + Fraction(rng.randint(1, 9), 10**rng.randint(13, 22))
            rows, precision = rng.choice([2, 4, 8]), '"precision": "extended", ' if i % 2 == 0 else ""
            body = (f'{{"system": {system}, "initial": {{"x": 0, "x_dot": 1000}}, {precision}"t_start": {in_digits(start)}, '
                    f'"t_end": {in_digits(end)}, "samples": {rows}}}')
            with self.subTest(body=body):
                answer = self.extended(body)
                for row, found in enumerate(answer["trajectory"]["x"]):
                    t = (end - start)*row/(rows - 1)
                    off = abs(Fraction(found) - 1000*t - 3*t*t/2)
                    self.assertLessEqual(off, Fraction(answer["accuracy"]["max_abs_error"]["x"]))

    def test_a_row_where_a_column_is_zero_is_as_good_as_any(self):
        system = {"name": "thrown", "units": "none", "coordinates": [{"name": "x"}], "lagrangian": "x_dot^2/2",
                  "forces": [{"name": "push", "value": "3", "along": "x"}]}
        for more in ({}, {"precision": "extended"}):
            accuracy = self.ask("simulate", {"system": system, "initial": {"x": -6, "x_dot": 0}, "times": [2]} | more)["accuracy"]
            self.assertIsNone(accuracy["horizon"])
            for name in ("x", "x_dot"):
                self.assertLess(accuracy["max_abs_error"][name], 1e-26 if more else 1e-14)

    def test_a_chaotic_motion_says_how_far_it_is_good(self):
        rods = {"system": "rod_pendulum", "initial": {"theta": 2.5, "phi": 2.9}, "t_end": 40, "samples": 81,
                "on_invalid": "continue"}
        doubles = self.ask("simulate", rods | {"max_error": 1e-14})["accuracy"]["horizon"]
        extended = self.ask("simulate", rods | {"precision": "extended"})["accuracy"]
        self.assertGreaterEqual(extended["horizon"], 1.8*doubles)
        self.assertLess(extended["horizon"], 40)
        wanted = self.ask("simulate", rods | {"precision": "extended", "max_error": 1e-20})["accuracy"]
        self.assertFalse(wanted["meets_request"])

    def test_what_grows_brings_the_rounding_of_all_computations_with_it(self):
        """x'' = k x: to a loose max_error two computations may agree by chance in what rounding has become."""
        draw, checked = random.Random(35), 0
        for _ in range(60):
            k, x, v = (Decimal(draw.randint(1, 10**n)).scaleb(-m) for n, m in ((12, 11), (8, 8), (8, 8)))
            end, wanted = draw.randint(20, 120) / 10, 10.0 ** draw.randint(-24, -16)
            near = draw.random() < 0.5
            if near:  # by a hair on what falls towards 0
                v = -Decimal(mpmath.nstr(mpf(str(x)) * mpmath.sqrt(mpf(str(k))), draw.choice((9, 16, 25))))
            request = {"system": lagrangian("hill", "", f"x {x} {v}", f"x_dot^2/2 + {k}*x^2/2"), "t_end": end,
                       "samples": 3, "precision": "extended", "max_error": wanted}
            del request["system"]["parameters"]
            request["system"]["coordinates"][0].update(initial=str(x), initial_rate=str(v))
            with self.subTest(k=k, x=x, v=v, end=end, max_error=wanted):
                answer = self.extended(json.dumps(request))
                rate, t = mpmath.sqrt(mpf(str(k))), mpf(str(end))
                known = mpf(str(x)) * mpmath.cosh(rate * t) + mpf(str(v)) / rate * mpmath.sinh(rate * t)
                off = abs(mpf(answer["trajectory"]["x"][-1]) - known)
                self.assertLessEqual(off, mpf(answer["accuracy"]["max_abs_error"]["x"]))
                checked += 1
        self.assertEqual(checked, 60)

    def test_a_pulse_between_two_places_is_not_missed(self):
        base = {"system": "forced_spring_pendulum", "initial": {"theta": 0, "theta_dot": 0}, "t_end": 8, "samples": 2}
        for force in ("0.8*exp(-((t-5)/0.3)^2)", "0.8*exp(-((t-5)/0.001)^2)", "0.8*exp(-((t-5)/1e-7)^2)",
                      "1e-9*exp(-((t-5)/0.001)^2)", "0.8*(tanh((t-5)/0.01)-tanh((t-6)/0.01))",
                      "0.8*(1-tanh((t-5)/0.001)^2)", "0.8/cosh((t-5)/0.001)^2", "0.8*exp(-cosh((t-5)/0.001))",
                      "0.8/(2+sinh((t-5)/0.001)^2)"):
            with self.subTest(force=force):
                request = base | {"inputs": {"F": force}}
                doubles = self.ask("simulate", request | {"max_error": 1e-12})
                answer = self.ask("simulate", request | {"precision": "extended"})
                for name in ("theta", "theta_dot"):
                    stated = answer["accuracy"]["max_abs_error"][name]
                    difference = abs(answer["trajectory"][name][1] - doubles["trajectory"][name][1])
                    self.assertLessEqual(difference, doubles["accuracy"]["max_abs_error"][name] + stated)
                    self.assertLess(stated, 1e-25)
                self.assertTrue(answer["accuracy"]["bounded"])
                self.assertNotIn("reason", answer["accuracy"])

    def test_a_pulse_that_is_less_than_all_doubles_at_first_comes_to_an_answer(self):
        system = {"name": "pushed", "units": "none", "coordinates": [{"name": "x"}], "lagrangian": "x_dot^2/2",
                  "forces": [{"name": "f", "value": "exp(-(t - 90)^2)", "along": "x"}]}
        for t_end, truth in ((40, 0), (60, 0), (100, 17.724538509055161)):
            answer = self.ask("simulate", {"system": system, "t_end": t_end, "samples": 2, "precision": "extended", "max_error": 1e-18})
            self.assertLess(abs(answer["trajectory"]["x"][-1] - truth), 1e-14)
            self.assertLess(answer["accuracy"]["max_abs_error"]["x"], 1e-18)
        system["lagrangian"] += " - 400*x^2/2"
        system["forces"][0]["value"] = "exp(-((t - 0.4)/0.004)^2)"
        answer = self.ask("simulate", {"system": system, "t_end": 1, "samples": 2})
        impulse = 0.004*math.sqrt(math.pi)*math.exp(-(20*0.004)**2/4)
        self.assertLessEqual(abs(answer["trajectory"]["x"][-1] - impulse*math.sin(20*0.6)/20), answer["accuracy"]["max_abs_error"]["x"] + 1e-18)

    def test_rounding_inside_a_force_is_in_the_error(self):
        """x'' = exp(-t^2) with the square written out: all computations in double-doubles have its rounding in common."""
        rng = random.Random(20241126)
        for _ in range(20):
            b = f"{rng.uniform(1, 9):.3f}e{rng.randint(1, 2)}"
            t_end = decimal(rng, 1, 3)
            system = json.dumps({"name": "pushed", "units": "none", "coordinates": [{"name": "x"}], "lagrangian": "x_dot^2/2",
                                 "forces": [{"name": "f", "value": f"exp(-({b} + t)^2 + {b}^2 + 2*{b}*t)", "along": "x"}]})
            body = f'{{"system": {system}, "initial": {{"x": 0, "x_dot": 0}}, "t_end": {t_end}, "samples": 2, "precision": "extended"}}'
            with self.subTest(body=body):
                answer = self.extended(body)
                t = mpf(answer["trajectory"]["t"][-1])
                speed = mpmath.sqrt(mpmath.pi)/2*mpmath.erf(t)
                for name, truth in (("x", t*speed + (mpmath.exp(-t*t) - 1)/2), ("x_dot", speed)):
                    stated = mpf(answer["accuracy"]["max_abs_error"][name])
                    self.assertLessEqual(abs(mpf(answer["trajectory"][name][-1]) - truth), stated)
                    self.assertLess(stated, mpf("1e-27")*mpf(b)**2)

    def test_fast_motions_have_the_digits_that_they_have_in_units_of_their_own(self):
        pendulum = ("x_dot^2/2 + w2*cos(x) + f*x*sin(o*t)", {"w2": ("9.3", 2), "f": ("2.1", 2), "o": ("1.7", 1)},
                    {"x": ("1", 0), "x_dot": ("0.3", 1)}, "6.3", 0)
        scattering = ("m*(x_dot^2 + y_dot^2)/2 - k/sqrt(x^2 + y^2)", {"m": ("6.64", 0), "k": ("3.64", 2)},
                      {"x": ("-7.21", 0), "y": ("0.18", 0), "x_dot": ("1.3", 1)}, "35.1", -13)

        def answer(motion, by_seconds, metre):
            text, parameters, start, t_end, _ = motion
            of_k = 3*metre
            scene = {"name": "s", "units": "none", "lagrangian": text,
                     "coordinates": [{"name": name} for name in start if "_" not in name],
                     "parameters": [{"name": name, "default": f"{number}e{by_seconds*power + of_k*(name == 'k')}"}
                                    for name, (number, power) in parameters.items()]}
            initial = ", ".join(f'"{name}": {number}e{by_seconds*power + metre}'
                                for name, (number, power) in start.items())
            body = (f'{{"system": {json.dumps(scene)}, "initial": {{{initial}}}, "t_end": {t_end}e{-by_seconds}, '
                    '"samples": 3, "precision": "extended"}')
            return self.extended(body)

        for motion in (pendulum, scattering):
            slow, metre = answer(motion, 0, 0), motion[-1]
            for by_seconds in (9, 12, 15, 20):
                fast = answer(motion, by_seconds, metre)
                self.assertLess(fast["diagnostics"]["steps"], 1.5*slow["diagnostics"]["steps"])
                self.assertNotIn("reason", fast["accuracy"])
                for name in motion[2]:
                    unit = mpf(10)**(metre + (by_seconds if "_" in name else 0))
                    stated = [mpf(one["accuracy"]["max_abs_error"][name]) for one in (slow, fast)]
                    self.assertLess(stated[1], 3*stated[0]*unit)
                    for one, other in zip(slow["trajectory"][name], fast["trajectory"][name]):
                        self.assertLessEqual(abs(mpf(other) - unit*mpf(one)), stated[1] + unit*stated[0], name)

    def test_a_get_asks_the_same(self):
        fields = {"system": "spring_pendulum", "t_end": 1, "samples": 3, "precision": "extended", "digits": 28}
        by_get = json.loads(self.get("simulate", fields).data, parse_float=str)
        self.assertEqual(self.extended(json.dumps(fields))["trajectory"], by_get["trajectory"])

    def test_rows_have_the_same_digits_in_every_form(self):
        fields = {"system": "spring_pendulum", "t_end": 1, "samples": 2, "precision": "extended"}
        columns = self.extended(json.dumps(fields))["trajectory"]
        csv = self.rows(fields | {"format": "csv"})
        self.assertEqual(csv[2], ",".join(columns[name][1] for name in columns))
        last = json.loads(self.rows(fields | {"format": "ndjson"})[1], parse_float=str)
        self.assertEqual(last, {name: columns[name][1] for name in columns})

    def test_what_it_cannot_do_it_refuses_by_name(self):
        base = {"system": "spring_pendulum", "t_end": 1, "precision": "extended"}
        for more, field in (({"events": ["theta=0"]}, "events"), ({"method": "erk"}, "method"),
                            ({"accuracy": "fast"}, "accuracy"), ({"rtol": 1e-9}, "rtol"), ({"verify": False}, "verify"),
                            ({"max_error": 1e-25}, "max_error"), ({"digits": 32}, "digits"),
                            ({"system": "compass_walker"}, "impacts")):
            with self.subTest(field=field):
                self.refused_at("simulate", base | more, "#/" + field)
        for field, value in (("digits", 18), ("max_error", 1e-15)):
            self.refused_at("simulate", {"system": "spring_pendulum", "t_end": 1, field: value}, "#/" + field)

    def test_kinks_are_refused(self):
        body = {"system": "forced_spring_pendulum", "inputs": {"F": "abs(sin(t))"}, "t_end": 1, "precision": "extended"}
        self.assertIn("kinks", self.refused("simulate", body)["detail"])


class InstantsFarFromZero(Service):
    """An instant such as 98765.4321 is rounded to 32 digits, and a fast motion shows it."""

    def test_the_rounding_of_instants_is_in_the_error(self):
        draw = random.Random(5)
        for _ in range(20):
            k, x, v, start = (f"{draw.uniform(*ends):.6g}" for ends in ((5, 60), (-2, 2), (-2, 2), (1e4, 1e5)))
            times = [start] + [f"{float(start) + s + draw.uniform(0, 0.5):.9f}" for s in (0.1, 1, 2)]
            scene = {"name": "s", "units": "none", "lagrangian": f"x_dot^2/2 - {k}*x^2/2",
                     "coordinates": [{"name": "x", "initial": x, "initial_rate": v}]}
            body = (f'{{"system": {json.dumps(scene)}, "t_start": {start}, "times": [{", ".join(times)}], '
                    '"precision": "extended"}')
            answer = json.loads(self.server.request("POST", "/v1/simulate", body).data, parse_float=mpf)
            omega = mpmath.sqrt(mpf(k))
            for i, t in enumerate(times):
                angle = omega*(mpf(t) - mpf(start))
                truth = {"x": mpf(x)*mpmath.cos(angle) + mpf(v)/omega*mpmath.sin(angle),
                         "x_dot": mpf(v)*mpmath.cos(angle) - mpf(x)*omega*mpmath.sin(angle)}
                for name, value in truth.items():
                    off = abs(answer["trajectory"][name][i] - value)
                    self.assertLessEqual(off, answer["accuracy"]["max_abs_error"][name], f"{name} at {t}")


if __name__ == "__main__":
    unittest.main()
