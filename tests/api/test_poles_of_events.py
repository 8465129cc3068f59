"""An event whose function has a pole on the way x = v t: there it changes its sign and crosses nothing. Where it jumps,
or is as steep as it may be without a pole, it crosses zero once."""

import math
import pathlib
import random
import sys
import unittest
from fractions import Fraction

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

OPTIONS = ({}, {"method": "erk"}, {"accuracy": "fast"}, {"method": "adams"}, {"max_error": 1e-10})


class PolesOfEvents(Service):
    def count(self, function, speed, end, options):
        scene = lagrangian("free", "", f"x - 0 {speed}", "x_dot^2/2", events=[{"name": "e", "expression": function}])
        del scene["parameters"]
        request = {"system": scene, "t_end": end, "samples": 2, "events": ["e"], **options}
        return len(self.ask("simulate", request)["events"])

    def each(self, shapes, seed, known, cases=20):
        """The shapes with a place c on the way, a sign and size s, and angles a x - b."""
        source = random.Random(seed)
        for shape in shapes:
            for _ in range(cases):
                speed, end = f"{source.uniform(0.5, 2):.3f}", round(source.uniform(0.5, 3), 3)
                way = float(speed) * end
                c = f"{source.uniform(0.05, 0.95) * way:.4f}"
                s = source.choice(("", "-")) + f"{10 ** source.uniform(-3, 3):.3g}"
                a, b, w = f"{source.uniform(3, 20):.3f}", f"{source.uniform(0, 3):.3f}", f"{10 ** source.uniform(-30, -2):.3g}"
                options = source.choice(OPTIONS)
                function = shape.format(c=c, s=s, a=a, b=b, w=w)
                with self.subTest(function, speed=speed, end=end, **options):
                    self.assertEqual(self.count(function, speed, end, options), known(-float(b), float(a) * way - float(b)))

    def test_poles_are_none(self):
        shapes = ("{s}/(x - {c})", "{s}/(x - {c})^3", "{s}/tanh(x - {c})", "{s}/sin({a}*x - {b})")
        self.each(shapes, 1, lambda begin, end: 0)

    def test_zeros_between_poles_are_all_found(self):
        self.each(("{s}*cos({a}*x - {b})/sin({a}*x - {b})",), 2,
                  lambda begin, end: math.floor(end / math.pi - 0.5) - math.floor(begin / math.pi - 0.5))

    def test_zeros_of_a_tangent_are_all_found_on_the_way_up_and_down(self):
        source = random.Random(4)
        cases = [("0.787", "2.23", "11.4", "0.933", 4), ("0.528", "2.62", "15.7", "-0.98", 3)]
        for _ in range(20):
            draw = [f"{source.uniform(*ends):.3f}" for ends in ((0.3, 2), (0.5, 3), (2, 20), (-2, 2))]
            cases.append((*draw, round(source.uniform(1, 5), 2)))
        for speed, fall, w, c, end in cases:
            v, g = float(speed), float(fall)
            turns = [(float(w) * (0.1 + v * t - g * t * t / 2) - math.atan(float(c))) / math.pi
                     for t in (0, min(end, v / g), end)]
            known = sum(abs(math.floor(after) - math.floor(before)) for before, after in zip(turns, turns[1:]))
            scene = lagrangian("thrown", "", f"x - 0.1 {speed}", f"x_dot^2/2 - {fall}*x",
                               events=[{"name": "e", "expression": f"tan({w}*x) - ({c})"}])
            del scene["parameters"]
            request = {"system": scene, "t_end": end, "samples": 2, "events": ["e"]}
            with self.subTest(speed=speed, fall=fall, w=w, c=c, end=end):
                self.assertEqual(len(self.ask("simulate", request)["events"]), known)

    def test_jumps_and_steep_crossings_are_events(self):
        shapes = ("{s}*sign(x - {c})", "{s}*abs(x - {c})/(x - {c})", "{s}*atan(1/(x - {c}))",
                  "{s}*(x - {c})/((x - {c})^2 + {w})", "{s}*(x - {c})*(1 + 0.001/((x - {c})^2 + {w}))",
                  "{s}*(x - {c})/((x - {c})^2 + 1e-34)")
        self.each(shapes, 3, lambda begin, end: 1)

    def test_a_condition_is_broken_behind_a_pole(self):
        source = random.Random(5)
        for shape in ("{s}/({c} - x)", "{s}/({c} - x)^3", "{s}/sin(0.9*({c} - x)) + 0.01", "{s}*tan(pi/2 - 0.9*({c} - x))"):
            for _ in range(12):
                speed, place, options = Fraction(source.randint(50, 200), 100), source.randint(1000, 9999), source.choice(OPTIONS)
                c = Fraction(place, 10000)
                function = shape.format(c=float(c), s=f"{10 ** source.uniform(-3, 3):.3g}")
                scene = lagrangian("free", "", f"x - 0 {float(speed)}", "x_dot^2/2",
                                   valid_while=[{"name": "c", "expression": function, "reason": "r", "message": "m"}])
                del scene["parameters"]
                with self.subTest(function, speed=speed, **options):
                    answer = self.ask("simulate", {"system": scene, "t_end": 2.5, "samples": 2, **options})
                    self.assertEqual(answer["status"], "stopped")
                    if options.get("method") == "adams" and answer["accuracy"].get("reason"):
                        continue
                    self.assertLessEqual(abs(Fraction(answer["stop"]["t"]) - c / speed), answer["stop"]["error"])

    def test_extended_precision_says_what_doubles_could_not_bound(self):
        scene = lagrangian("swing", "", "x - 0 0.9", "x_dot^2/2 - x^2/8",
                           valid_while=[{"name": "c", "expression": "1/((x - 1)*(x - 1.000006))", "reason": "r", "message": "m"}])
        del scene["parameters"]
        for options in ({}, {"precision": "extended"}, {"precision": "extended", "max_error": 1e-20}):
            with self.subTest(**options):
                answer = self.ask("simulate", {"system": scene, "t_end": 2.5, "samples": 2, **options})
                if answer["status"] == "stopped":
                    self.assertAlmostEqual(answer["stop"]["t"], 2 * math.asin(1 / 1.8), delta=1e-5)
                else:
                    self.assertFalse(answer["accuracy"]["bounded"])
                    self.assertIn("bound", answer["accuracy"]["reason"])
                    self.assertFalse(answer["accuracy"].get("meets_request", False))


if __name__ == "__main__":
    unittest.main()
