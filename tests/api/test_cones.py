"""Equilibria where a distance in the potential is 0: springs, tensions and strings that end at a point. A tension holds
there what pulls less than it does; what pushes away, or is too weak, does not. Truth: the forces about the point by hand,
and the other equilibria of V = c |x - p| + b |x|^2/2 + w.x on the line through p."""

import math
import pathlib
import random
import re
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

CASES = 40
SPRING = "k*(sqrt((x - 1)^2 + y^2) - l)^2/2 + g*y"


def scene(potential, parameters, start="x 0.3; y 0.3"):
    kinetic = "+".join(f"{words.split()[0]}_dot^2" for words in start.split(";"))
    parameters, start = (re.sub(r"(\w) ", r"\1 1 ", words) for words in (parameters, start))  # without dimension
    return lagrangian("cone", parameters, start, f"({kinetic})/2 - ({potential})")


class Cones(Service):
    def equilibria(self, potential, parameters, start="x 0.3; y 0.3"):
        return self.ask("equilibria", {"system": scene(potential, parameters, start)})

    def assert_lists(self, answer, expected):
        """All of `expected`, (place, stability), and nothing else, proven to be all."""
        self.assertTrue(answer["complete"], answer)
        found = [(tuple(v for name, v in e["state"].items() if not name.endswith("_dot")), e["stability"])
                 for e in answer["equilibria"]]
        self.assertEqual(len(found), len(expected), (found, expected))
        for (place, stability), (wanted, kind) in zip(found, sorted(expected)):
            self.assertEqual(stability, kind, (found, expected))
            for a, b in zip(place, wanted):
                self.assertAlmostEqual(a, b, delta=1e-12, msg=(found, expected))

    def test_nothing_rests_where_a_compressed_spring_is_fixed(self):
        answer = self.equilibria(SPRING, "k 10; l 1; g 3")
        self.assert_lists(answer, [((1, -1.3), "stable"), ((1, 0.7), "unstable")])
        self.assertIn("Near x = 1 and y = 0 a distance is 0", answer["reason"])
        self.assert_lists(self.equilibria(SPRING, "k 10; l 1; g 12"), [((1, -2.2), "stable")])

    def test_nor_in_space(self):
        answer = self.equilibria("k*(sqrt((x - 1)^2 + y^2 + (z - 1)^2) - l)^2/2 + g*z", "k 10; l 1; g 3",
                                 "x 0.3; y 0.3; z 0.2")
        self.assert_lists(answer, [((1, 0, -0.3), "stable"), ((1, 0, 1.7), "unstable")])

    def test_nothing_rests_about_a_pole(self):
        between = 3 - 2*math.sqrt(2)  # q1/(1 - x)^2 = q2/(1 + x)^2
        charges = "q1/sqrt((x - 1)^2 + y^2) + q2/sqrt((x + 1)^2 + y^2)"
        self.assert_lists(self.equilibria(charges, "q1 1; q2 2"), [((between, 0), "unstable")])
        self.assert_lists(self.equilibria("q/(x^2 + y^2) - f*x", "q 2; f 4"), [((-1, 0), "unstable")])
        self.assert_lists(self.equilibria("-q*log(x^2 + y^2) + x^2/2 + y^2", "q 1", "x 0.3; y 0.2"),
                          [((-math.sqrt(2), 0), "stable"), ((math.sqrt(2), 0), "stable"), ((0, -1), "unstable"), ((0, 1), "unstable")])
        space = "q1/sqrt((x - 1)^2 + y^2 + z^2) + q2/sqrt((x + 1)^2 + y^2 + z^2)"
        self.assert_lists(self.equilibria(space, "q1 1; q2 2", "x 0.3; y 0.3; z 0.2"), [((between, 0, 0), "unstable")])

    def test_three_bodies_have_five_equilibria_and_no_other(self):
        text = ("(x_dot^2 + y_dot^2)/2 + x*y_dot - y*x_dot + (x^2 + y^2)/2"
                " + (1 - mu)/sqrt((x + mu)^2 + y^2) + mu/sqrt((x - 1 + mu)^2 + y^2)")
        for mu in ("0.1", "0.01215", "0.3", "0.5"):
            system = lagrangian("three_bodies", f"mu - {mu}", "x - 0.3; y - 0.2", text)
            answer = self.ask("equilibria", {"system": system})
            self.assertTrue(answer["complete"], answer.get("reason"))
            self.assertEqual(len(answer["equilibria"]), 5, mu)

    def test_a_pole_whose_forces_may_vanish_about_it_is_said_to_be_one(self):
        answer = self.equilibria("q*x/(x^2 + y^2) + x^2 + y^2", "q 1", "x 0.3; y 0.2")
        self.assertFalse(answer["complete"])
        self.assertIn("is a singularity", answer["reason"])

    def test_a_tension_holds_what_pulls_less(self):
        draw = random.Random(20261127)
        for _ in range(CASES):
            p = [round(draw.choice([0, 1, -1, 0.5, draw.uniform(-2, 2)]), 2) for _ in "xy"]
            w = [round(draw.uniform(-3, 3), 2) for _ in "xy"]
            c, b = round(draw.uniform(-4, 4), 2), round(draw.uniform(0.5, 2), 2)
            away = [b * p[0] + w[0], b * p[1] + w[1]]
            size = math.hypot(*away)
            if abs(size - abs(c)) < 0.01 or size < 0.01 or c == 0:
                continue
            # (c + b r) n = -away at x = p + r n, so that n is -away/size or away/size.
            expected = [((p[0] + s * away[0] / size, p[1] + s * away[1] / size), "stable" if s < 0 else "unstable")
                        for s, there in ((-(size - c) / b, c < size), (-(size + c) / b, size + c < 0)) if there]
            if c > size:
                expected = [(tuple(p), "stable")]
            with self.subTest(p=p, w=w, c=c, b=b):
                answer = self.equilibria(f"c*sqrt((x - ({p[0]}))^2 + (y - ({p[1]}))^2) + b*(x^2 + y^2)/2"
                                         f" + {w[0]}*x + ({w[1]})*y", f"c {c}; b {b}")
                self.assert_lists(answer, expected)

    def test_three_weights_on_strings_meet_in_the_point_of_fermat_or_in_a_hole(self):
        holes = "k*sqrt((x - 1)^2 + (y - 2)^2) + k*sqrt((x + 1)^2 + y^2) + {}*k*sqrt(x^2 + (y + 1)^2)"
        answer = self.equilibria(holes.format(1), "k 1")
        self.assertTrue(answer["complete"], answer)
        self.assertEqual([e["stability"] for e in answer["equilibria"]], ["stable"])
        x, y = (answer["equilibria"][0]["state"][name] for name in "xy")
        pulls = [(a - x, b - y) for a, b in ((1, 2), (-1, 0), (0, -1))]
        for along in (0, 1):
            self.assertAlmostEqual(sum(pull[along] / math.hypot(*pull) for pull in pulls), 0, delta=1e-13)
        self.assert_lists(self.equilibria(holes.format(3), "k 1"), [((0, -1), "stable")])

    def test_what_is_not_decided_is_no_equilibrium(self):
        """Just as strong; a distance that does not depend on all coordinates; an oblique one."""
        for potential, parameters, start in (
                ("k*sqrt((x - 1)^2 + y^2) + g*y", "k 3; g 3", "x 0.3; y 0.3"),
                ("k*sqrt((x - 1)^2 + y^2) + g*y + z^2/2 + x*z", "k 10; g 3", "x 0.3; y 0.3; z 0.2"),
                ("k*sqrt((x - 1)^2 + (x - 1)*y + 4*y^2) + g*y", "k 10; g 3", "x 0.3; y 0.3")):
            with self.subTest(potential=potential):
                answer = self.equilibria(potential, parameters, start)
                self.assertFalse(answer["complete"])
                self.assertIn("Near x = 1 and y = 0 ", answer["reason"])
                for e in answer["equilibria"]:
                    self.assertLess(e["residual"], 1e-12, e)

    def test_no_value_is_solved_for_where_forces_have_none(self):
        for pivot in (0, 1):
            system = scene(SPRING.replace("x - 1", f"x - {pivot}"), "k 10; l 1; g 3")
            answer = self.ask("equilibria", {"system": system, "solve_for": "g", "at": {"x": pivot, "y": 0}})
            self.assertIsNone(answer["g"])
            self.assertIn("no single finite value", answer["reason"])
            below = self.ask("equilibria", {"system": system, "solve_for": "g", "at": {"x": pivot, "y": -1.3}})
            self.assertAlmostEqual(below["g"], 3, delta=below["error"] + 1e-300)


if __name__ == "__main__":
    unittest.main()
