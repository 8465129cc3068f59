"""The formulas of one coordinate that swings with friction: omega^2 = K/M - rate^2, rate = D/(2 M), at random parameters
against mpmath; none where it creeps."""

import pathlib
import random
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import DOWN, G, particle, scene  # noqa: E402

mpmath.mp.dps = 30
SPRING = scene("damped_spring", "m kg 1; k N/m 4; c kg/s 0.6", "x m 0.1", bodies=[particle("m", "x", "0")],
               springs=[{"stiffness": "k", "length": "x"}], dampers=[{"coefficient": "c", "length": "x"}])
PENDULUM = scene("damped_pendulum", f"m kg 1; l m 0.5; c kg*m^2/s 0.1; {G}", "th rad 0.1", gravity=DOWN,
                 bodies=[particle("m", "l*sin(th)", "-l*cos(th)")], dissipation="c*th_dot^2/2")
HANGING = scene("hanging", f"m kg 1; k N/m 9; b kg/s 0.2; {G}", "y m 0.1", gravity=DOWN, bodies=[particle("m", "0", "-y")],
                springs=[{"stiffness": "k", "length": "y"}], dissipation="b*y_dot^2/2")
NEGATIVE = scene("driven_by_friction", "m kg 1; k N/m 4; c kg/s 0.6", "x m 0.1", bodies=[particle("m", "x", "0")],
                 potential="k*x^2/2", forces=[{"value": "c*x_dot", "along": "x"}])
FORMS = [(SPRING, "k/m - c^2/(4*m^2)", "c/(2*m)"), (PENDULUM, "g/l - c^2/(4*m^2*l^4)", "c/(2*m*l^2)"),
         (HANGING, "k/m - b^2/(4*m^2)", "b/(2*m)"), (NEGATIVE, "k/m - c^2/(4*m^2)", "c/(2*m)")]


class DampedForms(Service):
    def test_what_courses_print(self):
        for asked, square, rate in FORMS:
            mode, = self.ask("modes", {"system": asked})["modes"]
            exact = mode["exact"]
            self.assertEqual((exact["of"], exact["text"], exact["rate"]["text"]), ("omega^2", square, rate))
            self.assertEqual(exact["omega"]["text"], f"sqrt({square})")
        place = self.ask("modes", {"system": HANGING})["equilibrium"]["exact"]["y"]["text"]
        self.assertEqual(place, "m*g/k")

    def test_their_numbers(self):
        draw = random.Random(16)
        for asked, square, rate in FORMS:
            for _ in range(25):
                values = {one["name"]: round(draw.uniform(0.1, 9), 4) for one in asked["parameters"]}
                mode = self.ask("modes", {"system": asked, "parameters": values})["modes"][0]
                known = {name: mpmath.mpf(repr(value)) for name, value in values.items()}
                omega2, size = (eval(text.replace("^", "**"), known) for text in (square, rate))
                self.assertEqual("exact" in mode, omega2 > 0)
                if omega2 > 0:
                    self.assertLessEqual(abs(mode["rate"] - size), mode["rate_error"])
                    self.assertLessEqual(abs(mode["omega"] - mpmath.sqrt(omega2)), mode["error"])

    def test_what_creeps_has_none(self):
        for mode in self.ask("modes", {"system": SPRING, "parameters": {"c": 5}})["modes"]:
            self.assertNotIn("exact", mode)


if __name__ == "__main__":
    unittest.main()
