"""A body that is let go from rest where the function of an event or a condition is zero: along the motion that zero is a
double one, which rounding hides for a while. What happens later is found all the same."""

import math
import pathlib
import random
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

OPTIONS = ({}, {"accuracy": "fast"}, {"accuracy": "balanced"}, {"accuracy": "accurate"})

# functions of u = x - x0, which falls from 0, and how often they are zero for 0 > u > -d
SHAPES = (
    ("sin({u})", lambda d: math.floor(d / math.pi)),
    ("{u}", lambda d: 0),
    ("({u})*({u} + 1.3)", lambda d: int(d > 1.3)),
    ("1 - exp({u})", lambda d: 0),
    ("({u})^2*({u} + 2)", lambda d: int(d > 2)),
    ("sin({u}) + sin(2*({u}))", lambda d: sum(zero < d for zero in zeros_of_two_sines())),
)


def zeros_of_two_sines():
    """sin u + sin 2u = sin u (1 + 2 cos u)"""
    places = [k * math.pi for k in range(1, 9)]
    for turn in range(5):
        places += [2 * math.pi * turn + 2 * math.pi / 3, 2 * math.pi * turn + 4 * math.pi / 3]
    return places


class StartsOnRoots(Service):
    def scene(self, start, fall, **members):
        scene = lagrangian("let_go", "", f"x - {start} 0", f"x_dot^2/2 - {fall}*x", **members)
        del scene["parameters"]
        return scene

    def test_later_crossings_are_all_found(self):
        source = random.Random(7)
        for text, known in SHAPES:
            for options in OPTIONS:
                start, fall = f"{source.uniform(-1, 1):.3f}", f"{source.uniform(0.8, 2):.2f}"
                end = round(source.uniform(1.5, 4), 3)
                function = text.format(u=f"x - ({start})")
                with self.subTest(function, fall=fall, end=end, **options):
                    scene = self.scene(start, fall, events=[{"name": "e", "expression": function}])
                    request = {"system": scene, "t_end": end, "samples": 3, "events": ["e"], **options}
                    answer = self.ask("simulate", request)
                    self.assertEqual(len(answer["events"]), known(float(fall) * end**2 / 2))
                    self.assertTrue(answer["accuracy"]["bounded"])

    def test_a_condition_that_ends_later_stops_the_motion(self):
        source = random.Random(8)
        for options in OPTIONS:
            for _ in range(4):
                start, fall = f"{source.uniform(-1, 1):.3f}", f"{source.uniform(0.8, 2):.2f}"
                c = source.uniform(0.15, 0.4)
                u = f"(x - ({start}))"
                condition = {"name": "c", "expression": f"exp({u}) - 1 - {u} - {c:.3f}*{u}^2", "reason": "r", "message": "m"}
                place = self.end_of(float(f"{c:.3f}"))
                with self.subTest(start=start, fall=fall, c=c, **options):
                    request = {"system": self.scene(start, fall, valid_while=[condition]), "t_end": 6, "samples": 3, **options}
                    stop = self.ask("simulate", request)["stop"]
                    self.assertAlmostEqual(stop["t"], math.sqrt(2 * place / float(fall)), delta=stop["error"] + 1e-12)

    def end_of(self, c):
        """d > 0 where exp(-d) - 1 + d = c d^2"""
        low, high = 1e-2, 20.0
        for _ in range(100):
            middle = (low + high) / 2
            if math.exp(-middle) - 1 + middle > c * middle**2:
                low = middle
            else:
                high = middle
        return low


if __name__ == "__main__":
    unittest.main()
