"""Forces that are small differences of large numbers: what rounding leaves of them all computations of a motion have in
common. The truths are closed forms: an oscillator after a Gaussian pulse whose square is written out, and forces that are
-x up to terms of (a x)^2 where nothing is rounded."""

import pathlib
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, strict_json  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mpmath.mp.dps = 30
mpf = mpmath.mpf
GOALS = [{}, {"accuracy": "fast"}, {"accuracy": "accurate"}, {"max_error": 1e-7}, {"max_error": 1e-12},
         {"method": "taylor", "rtol": 1e-11}, {"method": "taylor", "rtol": 1e-7}, {"method": "erk", "rtol": 1e-8},
         {"method": "erk", "rtol": 1e-5}, {"method": "taylor", "rtol": 1e-13}]
VANISHING = ["-(cosh(x*a) - 1)*2*b*b/x", "-(1 - cos(x*a))*2*b*b/x", "-(sqrt(1 + (x*a)^2) - 1)*2*b*b/x"]


def forced(force, parameters=""):
    return lagrangian("forced", parameters, "x - 0 0", "x_dot^2/2", forces=[{"name": "push", "value": force, "along": "x"}])


class RoundingInForces(Service):
    def ask(self, force, parameters, x, t_end, goal):
        request = {"system": forced(force, parameters), "initial": {"x": x, "x_dot": 0}, "t_end": t_end, "samples": 2, **goal}
        return strict_json(self.post("simulate", request).data)

    def judge(self, answer, truth, allowed=0):
        stated = answer["accuracy"]["max_abs_error"]
        for name, true in zip(("x", "x_dot"), truth):
            error = abs(mpf(answer["trajectory"][name][-1]) - true)
            self.assertLessEqual(error, mpf(stated[name]) + allowed, (answer["request"], name, float(true)))
        return stated

    def test_a_pulse_whose_square_is_written_out(self):
        for c, w in (("3.579", "0.000029"), ("4.0625", "0.0000012"), ("2.37", "0.003")):
            centre, width = mpf(c), mpf(w)
            square = f"(t^2 - {mpmath.nstr(2 * centre, 20)}*t + {mpmath.nstr(centre**2, 20)})"
            force = f"exp(-{square}/{mpmath.nstr(width**2, 20, min_fixed=-20)}) - 0.86*x"
            rate, left = mpmath.sqrt(mpf("0.86")), mpf("8.65") - centre
            impulse = width * mpmath.sqrt(mpmath.pi) * mpmath.exp(-(rate * width / 2) ** 2)
            truth = impulse * mpmath.sin(rate * left) / rate, impulse * mpmath.cos(rate * left)
            for goal in GOALS:
                with self.subTest(c=c, goal=goal):
                    self.judge(self.ask(force, "", 0, 8.65, goal), truth)

    def test_of_a_motion_whose_damping_rules_its_steps(self):
        """x'' = -c x' - x^2 from rest creeps as 1/x = 1 + (t - 1/c)/c up to terms of 1/c^3."""
        for c in (20000, 100000, 1000000):
            true = 1/(1 + (1 - mpf(1)/c)/c)
            for goal in ({}, {"accuracy": "accurate"}, {"method": "bdf", "rtol": 1e-8}):
                for kink in ("", "*(1 + sign(x + 5))/2"):
                    answer = self.ask(f"-{c}*x_dot - (cosh(x*1e-7) - 1)*2e14{kink}", "", 1, 1, goal)
                    self.judge(answer, (true, -true**2/c), 10/mpf(c)**3)
                    self.assertLess(answer["accuracy"]["max_abs_error"]["x"], 1e-5)

    def test_a_pulse_or_a_wall_so_narrow_that_rounding_hides_it_is_not_passed_in_silence(self):
        for centre, width in (("4.3445", "0.00000000000248"), ("9.4341", "0.000000000556"), ("0.88603", "0.0000000000198"), ("2.5", "0.0001")):
            height = mpmath.nstr(1/mpf(width), 20)
            pulse = forced(f"{height}*exp(-((t - {centre})/{width})^2)")
            wall = lagrangian("wall", "", "x - 0 1", f"x_dot^2/2 - 2*exp(-((x - {centre})/{width})^2)")
            for goal in GOALS[:5]:
                for system, v in ((pulse, mpmath.sqrt(mpmath.pi)), (wall, mpf(-1))):
                    request = {"system": system, "t_end": 1.5*float(centre), "samples": 2, **goal}
                    response = self.post("simulate", request)
                    if response.status != 200:
                        continue
                    answer = strict_json(response.data)
                    stated = answer["accuracy"]["max_abs_error"]["x_dot"]
                    self.assertLessEqual(abs(mpf(answer["trajectory"]["x_dot"][-1]) - v), mpf(stated), (centre, width, goal, float(v)))
                    self.assertTrue(stated < 1e10 or answer["accuracy"].get("reason"), (centre, width, goal, stated))

    def test_of_equal_ones_beside_a_kink_that_they_make(self):
        """x = x_0 cos(w t) down to -a, where K - K ends: rows there, and where it is carried to from there."""
        for square, x0, a, k in (("3.178", "1.119", "0.0186717", "-8117000"), ("2.984", "1.532", "-0.224135", "-62570"), ("3.651", "0.474", "0.0208098", "-79.5"),
                                 ("0.919", "1.963", "0.686645", "39970"), ("2.949", "0.352", "0.0142777", "-84810"), ("0.743", "1.498", "0.884474", "-5610"),
                                 ("1.676", "1.983", "0.0448979", "97170"), ("3.748", "1.204", "1.03546", "1416000"), ("1.084", "0.985", "0.0437785", "15740"),
                                 ("2.461", "2.427", "0.0786817", "-4622000"), ("1.954", "2.419", "0.0645959", "45330")):
            rate = mpmath.sqrt(mpf(square))
            met = mpmath.acos(-mpf(a)/mpf(x0))/rate
            speed, centre = -rate*mpf(x0)*mpmath.sin(rate*met), 2*mpf(k)/mpf(square)
            force = f"-{square}*x - {k}*(sign(x + {a}) - 1)".replace("- -", "+ ")

            def truth(t):
                if t <= met:
                    return mpf(x0)*mpmath.cos(rate*t), -rate*mpf(x0)*mpmath.sin(rate*t)
                c, s, x = mpmath.cos(rate*(t - met)), mpmath.sin(rate*(t - met)), -mpf(a) - centre
                return centre + x*c + speed/rate*s, speed*c - rate*x*s

            later = met + min(mpf("0.05"), abs(speed/(2*mpf(k))))  # it is still there, where it is carried back
            for goal in GOALS:
                for times in ([float(met)], [float(met), float(later)], [float(met)*(1 - 1e-15), float(later)]):
                    request = {"system": forced(force), "initial": {"x": float(x0), "x_dot": 0}, "times": times, **goal}
                    answer = strict_json(self.post("simulate", request).data)
                    for i, t in enumerate(answer["trajectory"]["t"]):
                        for name, true in zip(("x", "x_dot"), truth(mpf(t))):
                            stated = answer["accuracy"]["max_abs_error"][name]
                            self.assertLessEqual(abs(mpf(answer["trajectory"][name][i]) - true), mpf(stated), (force, goal, times, t, name))

    def test_the_error_of_such_a_pulse_is_measured_not_only_bounded(self):
        force = "exp(-(t^2 - 7.158*t + 12.809241)/0.000000000841) - 0.86*x"
        answer = self.ask(force, "", 0, 8.65, {"method": "taylor", "rtol": 1e-11})
        self.assertLess(answer["accuracy"]["max_abs_error"]["x"], 1e-9)

    def test_a_force_that_vanishes_by_rounding(self):
        for force in VANISHING:
            for digits in (5, 7, 9, 20):
                a, b = f"1e-{digits}", f"1e{digits}"
                for goal in GOALS:
                    with self.subTest(force=force, a=a, goal=goal):
                        answer = self.ask(force, f"a - {a}; b - {b}", 1, 1.5, goal)
                        if answer["accuracy"]["max_abs_error"] is None:
                            self.assertTrue(answer["accuracy"]["reason"])
                            continue
                        truth = mpmath.cos(mpf("1.5")), -mpmath.sin(mpf("1.5"))
                        self.judge(answer, truth, allowed=mpf(a) ** 2)

    def test_extended_precision_takes_no_shorter_steps_than_rounding_allows(self):
        """Of 32 digits cosh(x a) - 1 has lost up to 26: no step, however short, obeys such a force to the last digit."""
        for force in VANISHING[:1] + VANISHING[2:]:
            for digits in (10, 12, 13):
                with self.subTest(force=force, digits=digits):
                    answer = self.ask(force, f"a - 1e-{digits}; b - 1e{digits}", 1, 0.05, {"precision": "extended"})
                    self.assertLess(answer["diagnostics"]["steps"], 1000)
                    self.judge(answer, (mpmath.cos(mpf("0.05")), -mpmath.sin(mpf("0.05"))), mpf(10)**(-2 * digits))

    def test_a_stop_before_the_next_row_counts_what_was_rounded_up_to_it(self):
        """An oscillation from rest: x = cos t, down to a wall; the force is -x, as far as it is not rounded."""
        for b in ("3.1e4", "7.7e5", "2.9e6", "1.3e7"):
            for force in (f"-((x + {b})^2 - {b}^2 - x^2)/(2*{b})", f"-((x + {b})^3 - {b}^3 - 3*{b}*x^2 - x^3)/(3*{b}^2)"):
                for wall in ("0.999", "0.99", "0.9"):
                    scene = forced(force)
                    scene["valid_while"] = [{"name": "room", "expression": f"x - {wall}", "reason": "hit", "message": "hit"}]
                    request = {"system": scene, "initial": {"x": 1, "x_dot": 0}, "t_end": 40, "samples": 2}
                    stop = strict_json(self.post("simulate", request).data)["stop"]
                    if stop.get("error") is not None:
                        self.assertLessEqual(abs(mpf(stop["t"]) - mpmath.acos(mpf(wall))), mpf(stop["error"]), request)

    def test_growth_from_where_doubles_leave_nothing_of_the_force(self):
        """x'' = c*x up to terms of x^2, and a push p: x = (x0 + p/c)*cosh(sqrt(c)*t) - p/c up to 1e-5 or so."""
        told = 0
        for force, c in (("20*(exp(x) - 1)", 20), ("20*log(1 + x)", 20), ("20*(sqrt(1 + 2*x) - 1)", 20), ("20*(1 - exp(-x))", 20),
                         ("18*x + 3*(abs(x - 0.5) - 0.5)", 15)):
            for size, reach in (("1e-15", "2e-6"), ("1e-20", "1e-5"), ("1e-25", "3e-6"), ("1e-29", "1e-6")):
                for push in (0, 1):
                    start = mpf(size)/(c if push else 1)
                    t_end = float(mpmath.nstr(mpmath.acosh(mpf(reach)/start)/mpmath.sqrt(c), 3))
                    true = start*mpmath.cosh(mpmath.sqrt(c)*mpf(t_end)) - (start if push else 0)
                    for goal in ({}, {"max_error": 1e-6}, {"accuracy": "fast"}, {"max_error": 1e-9}):
                        answer = self.ask(force + f" + {size}"*push, "", "0" if push else size, t_end, goal)
                        self.judge(answer, [true], allowed=true*true)
                        told += answer["accuracy"].get("meets_request", True) is False
        self.assertGreater(told, 40)

    def test_a_start_below_the_digits_beside_a_force(self):
        """x'' = c*log(1 + x) + p from an x that 1 + x does not hold: two steps of a motion by p alone, and no sample of
        rounding begins so large that doubles show how it grows."""
        c = mpf(18)
        for start, push in (("5e-17", "3e-19"), ("5e-17", "3e-20"), ("2e-18", "3e-19"), ("1e-19", "3e-19")):
            for t_end in ("5", "6", "7.31"):
                true = (mpf(start) + mpf(push)/c)*mpmath.cosh(mpmath.sqrt(c)*mpf(t_end)) - mpf(push)/c
                for options in ({}, {"rtol": 1e-5}, {"accuracy": "balanced"}):
                    answer = self.ask(f"18*log(1 + x) + {push}", "", start, float(t_end), options)
                    self.judge(answer, [true], allowed=true*true)

    def test_pushes_that_twice_the_digits_do_not_hold(self):
        """The same from rest, the push smaller than the last digit of 1 there."""
        for force, c in (("27.034*((1 + x)*sqrt(1 + x) - 1)/1.5", 27.034), ("23.43*(1 - 1/(1 + x))", 23.43),
                         ("12.888*((1 + x)/(1 - x) - 1)/2", 12.888)):
            for size, t_end in (("4.9e-32", 11.9), ("1.8e-39", 15.1), ("1.2e-57", 16.5)):
                push, rate = mpf(size), mpmath.sqrt(mpf(str(c)))
                true = push/mpf(str(c))*(mpmath.cosh(rate*mpf(str(t_end))) - 1)
                for options in ({}, {"rtol": 1e-5}, {"accuracy": "fast"}):
                    self.judge(self.ask(f"{force} + {size}", "", "0", t_end, options), [true], allowed=true*true)

    def test_a_wanted_error_is_not_met_where_rounding_leaves_nothing_of_the_force(self):
        answer = self.ask(VANISHING[0], "a - 1e-20; b - 1e20", 1, 3, {"max_error": 1e-6})
        self.assertFalse(answer["accuracy"]["meets_request"])
        self.assertTrue(answer["accuracy"]["reason"])


class FastCharges(Service):
    """-sqrt(1 - v^2) in the plane, whose accelerations are solved for with a determinant that is known where a step
    begins: of a charge in a magnetic field, which turns at the rate B sqrt(1 - v^2), and of one that flies straight on."""

    def test_turns_at_a_known_rate(self):
        for B in ("1", "0", "2.7"):
            charge = lagrangian("fast_charge", f"B - {B}", "x - 0 0.5; y - 0 0.3",
                                "-sqrt(1 - x_dot^2 - y_dot^2) + B/2*(x*y_dot - y*x_dot)")
            rate = mpf(B)*mpmath.sqrt(1 - mpf("0.5")**2 - mpf("0.3")**2)
            start = mpmath.mpc("0.5", "0.3")
            for goal in ({}, {"accuracy": "accurate"}, {"max_error": 1e-10}, {"method": "adams"}):
                with self.subTest(B=B, goal=goal):
                    answer = self.ask("simulate", {"system": charge, "t_end": 3, "samples": 4, **goal})
                    v = start*mpmath.expj(-3*rate)
                    z = 3*start if rate == 0 else (start - v)/(mpmath.mpc(0, 1)*rate)
                    for name, truth in zip(("x", "y", "x_dot", "y_dot"), (z.real, z.imag, v.real, v.imag)):
                        stated = answer["accuracy"]["max_abs_error"][name]
                        self.assertLessEqual(abs(mpf(answer["trajectory"][name][-1]) - truth), stated)
                        self.assertLess(stated, 1e-6)


if __name__ == "__main__":
    unittest.main()
