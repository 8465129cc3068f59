"""Events whose functions have no value, or a pole, somewhere along an oscillation x(t) = A cos(omega t - phi). Beside such a
place nothing is in doubt; where x turns as near to an event as the motion's error, it is, in the step in which the function
gets its first values, too."""

import math
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
OPTIONS = ({}, {"method": "erk"}, {"accuracy": "fast"}, {"max_error": 1e-9}, {"method": "bdf"})
NEAR = "comes as near to"
ROOTS = {"sqrt(x - ({a}))": lambda x, a: mpmath.sqrt(x - a), "(x - ({a}))^1.5": lambda x, a: (x - a)**mpf("1.5"),
         "log(x - ({a}))": lambda x, a: mpmath.log(x - a)}


class DomainsOfEvents(Service):
    def reason(self, square, x, v, end, function, **options):
        scene = lagrangian("oscillator", "", f"x - {x} {v}", f"x_dot^2/2 - {square}*x^2/2", events=[{"name": "e", "expression": function}])
        del scene["parameters"]
        answer = self.ask("simulate", {"system": scene, "t_end": end, "samples": 3, "events": ["e"], **options})
        return answer["accuracy"].get("reason", ""), answer["events"]

    def motions(self, seed, cases):
        source = random.Random(seed)
        for _ in range(cases):
            square, x, v = (f"{source.uniform(*ends):.3f}" for ends in ((1, 6), (-1.5, 1.5), (-2, 2)))
            yield source, square, x, v, mpmath.sqrt(mpf(x)**2 + mpf(v)**2/mpf(square))

    def test_where_a_function_has_no_value_or_a_pole_its_events_are_not_in_doubt(self):
        shapes = ("sqrt(x - ({a})) - {c}", "sqrt({a} - x) - {c}", "log(x - ({a})) + {c}", "(x - ({a}))^1.5 - {c}",
                  "tan({w}*x) - ({d})", "1/(x - ({a})) - ({d})", "asin(x - ({a})) - {c}", "1/(x - ({a}))^2 - ({d})", "tan({w}*x)^2 - {c}",
                  "abs(x - ({a}))^(-0.5) - {c}")
        for source, square, x, v, amplitude in self.motions(1, 15):
            for shape in shapes:
                a = f"{source.uniform(-0.9, 0.9) * float(amplitude):.3f}"
                c, w, d = f"{10 ** source.uniform(-3, -0.3):.4f}", f"{source.uniform(2, 15):.3f}", f"{source.uniform(-2, 2):.3f}"
                function, end, options = shape.format(a=a, c=c, w=w, d=d), round(source.uniform(1, 6), 2), source.choice(OPTIONS)
                with self.subTest(function, square=square, x=x, v=v, end=end, **options):
                    self.assertNotIn(NEAR, self.reason(square, x, v, end, function, **options)[0])

    def test_where_the_motion_turns_at_an_event_it_is_in_doubt(self):
        for source, square, x, v, amplitude in self.motions(2, 15):
            a = f"{source.uniform(-0.9, 0.8) * float(amplitude):.3f}"
            turn = (mpmath.atan2(mpf(v)/mpmath.sqrt(mpf(square)), mpf(x)) % (2*mpmath.pi))/mpmath.sqrt(mpf(square))
            for shape, value in ROOTS.items():
                off = mpf(source.choice(("1e-17", "-1e-17", "1e-18", "-1e-18")))
                function = shape.format(a=a) + f" - ({mpmath.nstr(value(amplitude + off, mpf(a)), 30)})"
                for options in OPTIONS:
                    with self.subTest(function, square=square, x=x, v=v, **options):
                        reason, events = self.reason(square, x, v, math.ceil(turn + mpf("0.1")), function, **options)
                        no_error = [event for event in events if event["error"] is None]
                        self.assertTrue(NEAR in reason or "how often it happens" in reason or len(no_error) == 2, (reason, events))

    def test_a_flat_function_does_not_hide_what_cancels_in_its_argument(self):
        # u = 2e-17 where 1 + (x - a)^2 = (1 + 2e-17)^2: for some nanoseconds, which doubles do not show.
        for shape in ("sign({u})", "tanh(1e18*({u}))", "atan(1e18*({u}))", "sign({u})*(2 + x)"):
            function = shape.format(u="sqrt(1 + (x - 0.434)^2) - 1 - 2e-17")
            with self.subTest(function):
                reason, events = self.reason("1e-9", "-0.554", "1.316", 1.3, function)
                self.assertTrue(len(events) == 2 or NEAR in reason, (reason, events))

    def test_jumps_are_told_apart_however_near_they_are(self):
        for apart in ("1e-3", "1e-6", "1e-9", "1e-12"):
            places = [mpf("0.434") + i*mpf(apart) for i in range(3)]
            levels = [f"(x - {mpmath.nstr(place, 20)})" for place in places]
            for function in (f"sign({'*'.join(levels)})", "*".join(f"sign{level}" for level in levels), f"sign{levels[1]}*(x + 3)"):
                with self.subTest(function):
                    reason, events = self.reason("1e-18", "-0.554", "1.316", 1.3, function)
                    met = places if levels[0] in function else places[1:2]
                    self.assertEqual((len(events), reason), (len(met), ""))
                    for event, place in zip(events, met):
                        self.assertLessEqual(abs(mpf(event["t"]) - (place + mpf("0.554"))/mpf("1.316")), mpf(event["error"]) + mpf("1e-18"))
                        self.assertLess(event["error"], 1e-13)

    def test_a_function_whose_sign_is_never_seen_is_in_doubt(self):
        reason, events = self.reason("1e-18", "-0.554", "1.316", 1.3, "exp(x + 1e-33*(x - 0.7)) - exp(x)")
        self.assertIn("rounding hides the sign", reason)
        reason, events = self.reason("1", "0", "0", 5, "x")  # exactly zero, and always
        self.assertEqual((reason, events), ("", []))
        reason, events = self.reason("1e-18", "-0.554", "1.316", 1.3, "exp(-1e6*(x - 0.434)^2) - 1e-300")
        self.assertEqual((reason, len(events)), ("", 2))

    def test_a_jump_where_a_step_ends_or_is_halved_is_met(self):
        for function, places in (("sign(x - 1)", [1]), ("sign(x - 1) + 0.3", [1]), ("sign((x - 0.75)*(1 - x))", [0.75, 1]),
                                 ("sign(x - 1.5) - sign(x - 1.75) - 1", [1.5, 1.75])):
            with self.subTest(function):
                _, events = self.reason("1e-18", "0", "1", 2, function)
                self.assertEqual([round(event["t"], 12) for event in events], places)
        _, events = self.reason("1", "0", "4", 4, "sign(x_dot)")
        self.assertEqual(len(events), 1)

    def test_a_jump_as_near_to_the_end_as_rounding_is_in_doubt(self):
        reason, events = self.reason("1e-18", "0", "1", -997.6, "sign(x - 2.399999999995)", t_start=-1000)
        self.assertTrue(len(events) == 1 or reason, (reason, events))

    def test_a_jump_beside_where_its_argument_has_no_value(self):
        for function in ("sign(sqrt(x - 0.434) - 0.1)", "sign(sqrt(x - 0.434) - 0.1)*x"):
            reason, events = self.reason("1e-18", "-0.554", "1.316", 1.3, function)
            self.assertEqual((reason, [round(event["t"], 9) for event in events]), ("", [round(0.998/1.316, 9)]))


if __name__ == "__main__":
    unittest.main()
