"""Critical values that a course asks for: of angles measured from anywhere, of curves that stay unstable, of forces that
vanish everywhere, and of parameters under a sine."""

import math
import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import DOWN, DOWN_3D, G, lagrangian, particle, scene  # noqa: E402


def hoop(out, up):
    return scene("hoop", f"m kg 1; r m 0.7; W rad/s 2; {G}", "a rad", gravity=DOWN_3D,
                 bodies=[particle("m", f"{out}*cos(W*t)", f"{out}*sin(W*t)", up)])


class CriticalValues(Service):
    def critical(self, system, parameter, low, high):
        return self.ask("bifurcations", {"system": system, "parameter": parameter, "from": low, "to": high})

    def found(self, answer):
        return [(c["kind"], c.get("exact", {}).get("text")) for c in answer["critical"]]

    def test_a_hoop_is_the_same_wherever_its_angle_begins(self):
        rate = math.sqrt(9.81/0.7)
        for out, up, text in (("r*sin(a)", "-r*cos(a)", "sqrt(g/r)"), ("r*sin(a + pi/2)", "-r*cos(a + pi/2)", "sqrt(g/r)"),
                              ("r*cos(a)", "r*sin(a)", "sqrt(g/r)"), ("r*cos(a - pi/3)", "r*sin(a - pi/3)", None)):
            with self.subTest(out=out):
                answer = self.critical(hoop(out, up), "W", 1, 6)
                self.assertTrue(answer["complete"])
                self.assertEqual(self.found(answer), [("pitchfork", text)])
                self.assertAlmostEqual(answer["critical"][0]["value"], rate, 12)
        equation = self.ask("equations", {"system": hoop("r*sin(a + pi/2)", "-r*cos(a + pi/2)")})
        self.assertEqual(equation["V"], "m*r*g*sin(a)")

    def test_a_torsion_spring_holds_a_pendulum_up_wherever_its_angle_begins(self):
        for at_rest, out, up in (("pi", "l*sin(a)", "-l*cos(a)"), ("0", "l*sin(a)", "l*cos(a)"),
                                 ("pi/2", "l*cos(a)", "l*sin(a)"), ("-pi/2", "l*cos(a)", "-l*sin(a)")):
            with self.subTest(at_rest):
                system = scene("strut", f"m kg 1; l m 0.5; k N*m 12; {G}", "a rad", gravity=DOWN, bodies=[particle("m", out, up)],
                               springs=[{"stiffness": "k", "angle": "a", "rest_angle": at_rest}])
                answer = self.critical(system, "k", 3, 8)
                self.assertTrue(answer["complete"], answer.get("reason"))
                self.assertEqual(self.found(answer), [("pitchfork", "m*l*g")])

    def test_multiples_of_an_angle_show_their_factors(self):
        system = lagrangian("three_fold", "p - 0.2; q - 1", "a - 0", "a_dot^2/2 - p*cos(3*a) - q*cos(a)")
        answer = self.critical(system, "p", -2, 2)
        self.assertTrue(answer["complete"], answer.get("reason"))
        self.assertEqual(sorted(self.found(answer)), [("pitchfork", "-1/9*q")]*2 + [("saddle_node", "1/3*q")]*2)

    def test_without_units_what_repeats_is_an_angle(self):
        answer = self.ask("equilibria", {"system": lagrangian("pendulum", "w - 2", "x - 0.3", "x_dot^2/2 + w^2*cos(x)")})
        self.assertTrue(answer["complete"])
        self.assertEqual([e["state"]["x"] for e in answer["equilibria"]], [0, math.pi])
        self.assertIn("taken for an angle", answer["notes"][0])
        length = self.ask("equilibria", {"system": lagrangian("well", "w - 2", "x - 0.3", "x_dot^2/2 + w^2*cos(x) - x^2")})
        self.assertNotIn("notes", length)

    def test_a_second_pair_that_becomes_unstable(self):
        out = ("l*sin(a)", "l*sin(a) + l*sin(b)")
        system = scene("two_on_a_shaft", f"m kg 1; l m 0.5; W rad/s 3; {G}", "a rad; b rad", gravity=DOWN_3D,
                       bodies=[particle("m", f"({x})*cos(W*t)", f"({x})*sin(W*t)", f"-({x})".replace("sin", "cos")) for x in out])
        texts = [text for _, text in self.found(self.critical(system, "W", 0.5, 12))]
        self.assertEqual(texts, ["sqrt((2 - sqrt(2))*g/l)", *2 * ["sqrt(sqrt(2)*g/l)"], "sqrt((2 + sqrt(2))*g/l)"])
        wells = lagrangian("two_wells", "k - 0.5", "x - 0.5; y - -0.5",
                           "(x_dot^2 + y_dot^2)/2 + (x^2 + y^2)/2 - (x^4 + 2*y^4)/4 - k*(x - y)^2/2")
        self.assertIn(("pitchfork", "1/2"), self.found(self.critical(wells, "k", 0.4, 2)))

    def test_a_column_may_stand_at_a_critical_value(self):
        system = lagrangian("column", "k - 0.5", "x - 0.5; y - 0",
                            "(x_dot^2 + y_dot^2)/2 + (k - 1)*x^2/2 - x^4/4 - y^2/2 - x*y^3")
        self.assertEqual(self.found(self.critical(system, "k", 0, 2)), [("pitchfork", "1")])

    def test_where_a_force_vanishes_everywhere(self):
        answer = self.critical("bead_on_parabola", "Omega", 1, 8)
        self.assertEqual([form["text"] for form in answer["degenerate_exact"]], ["sqrt(g/p)"])
        saddle = lagrangian("rotating_saddle", "k - 2; W - 1", "x - 0.1; y - 0",
                            "((x_dot - W*y)^2 + (y_dot + W*x)^2)/2 - k*(x^2 - y^2)/2")
        answer = self.critical(saddle, "W", 0.5, 5)
        self.assertEqual([form["text"] for form in answer["degenerate_exact"]], ["sqrt(k)"])

    def test_where_what_other_forces_leave_of_one_vanishes(self):
        coupled = lagrangian("coupled", "w - 2; a - 1", "x - 1; y - 0", "(x_dot^2 + y_dot^2)/2 - w^2/2*(x^2 + y^2) + a*x*y")
        answer = self.critical(coupled, "a", 0, 10)
        self.assertEqual(answer["degenerate"], [4])
        self.assertEqual([form["text"] for form in answer["degenerate_exact"]], ["w^2"])
        column = lagrangian("column", "c - 1; P - 0.2", "a - 0; b - 0",
                            "a_dot^2 + b_dot^2/2 + a_dot*b_dot - c*a^2/2 - c*(b - a)^2/2 + P*(a^2 + b^2)/2")
        answer = self.critical(column, "P", 0, 4)
        self.assertEqual([form["text"] for form in answer["degenerate_exact"]], ["1/2*(3 - sqrt(5))*c", "1/2*(3 + sqrt(5))*c"])

    def test_where_an_equilibrium_goes_to_infinity(self):
        arm = ("l*cos(w*t) - x*sin(w*t)", "l*sin(w*t) + x*cos(w*t)")
        spring = scene("spring_on_an_arm", "m kg 1; k N/m 30; l m 0.5; w rad/s 2; r0 m 0.2", "x m 0.1",
                       bodies=[particle("m", *arm)], potential="k*(x - r0)^2/2")
        answer = self.critical(spring, "w", 0, 10)
        self.assertEqual([form["text"] for form in answer["at_ends_exact"]], 2 * ["sqrt(k/m)"])
        # A force that is no polynomial of x has no leading coefficient.
        soft = lagrangian("soft", "F - 0.01", "x - 0.1", "x_dot^2/2 + F*x + 1/(1 + exp(x))")
        self.assertNotIn("at_ends_exact", self.critical(soft, "F", -0.1, 0.1))

    def test_a_parameter_under_a_sine(self):
        cylinder = scene("eccentric_cylinder", f"m kg 1; R m 0.5; e m 0.2; al rad 0.1; {G}", "th rad", gravity=DOWN,
                         bodies=[{"kind": "rigid_body", "mass": "m", "inertia": "m*R^2/2", "angle": "-th",
                                  "centre": ["R*th*cos(al) - e*sin(th)", "-R*th*sin(al) - e*cos(th)"]}])
        answer = self.critical(cylinder, "al", 0, 1)
        self.assertEqual(self.found(answer), [("saddle_node", "asin(e/R)")])
        self.assertAlmostEqual(answer["critical"][0]["value"], math.asin(0.4), 14)

    def test_what_follows_the_parameter_is_said(self):
        answer = self.critical("cart_pendulum", "m", 0.1, 1)
        self.assertEqual(answer["notes"], ["While m moves, M = 2*m, k = 2*m*g/l follow it."])
        given = self.ask("bifurcations", {"system": "cart_pendulum", "parameter": "m", "from": 0.1, "to": 1,
                                          "parameters": {"M": 1, "k": 20}})
        self.assertNotIn("notes", given)

    def test_no_formula_has_numbers_that_no_book_would_print(self):
        bicycle = lagrangian("bicycle", "v - 1; g - 9.81", "a - 0; b - 0", "40.40862233*a_dot^2 + 1.15570714*a_dot*b_dot"
                             " + 0.14894194*b_dot^2 + g*(40.47412362*a^2 + 1.29973151*a*b + 0.33567513*b^2)"
                             " - v^2*(38.22978123*a^2 + 1.45698231*b*a + 0.38231789*b^2)")
        answer = self.critical(bicycle, "v", 0.1, 20)
        self.assertTrue(answer["complete"])
        self.assertEqual(answer["critical"], [])
        self.assertEqual([round(value, 9) for value in answer["degenerate"]], [2.934755217, 3.231515967])
        self.assertFalse(any("exact" in name for name in answer))

    def test_at_a_pole_of_the_potential_nothing_folds(self):
        for text, place, others in (("a*x^2/2 - p/(4 - x)", "p = 0 and x = 4", []),
                                    ("a*x^2/2 - p/(4 - x)^2", "p = 0 and x = 4", ["saddle_node"]),
                                    ("a*x^2/2 + p*log(x)", "p = 0 and x = 0", []), ("a*x^2/2 + p/x", "p = 0 and x = 0", [])):
            with self.subTest(text):
                system = lagrangian("pole", "a - 1; p - 1", "x - 0.1", f"x_dot^2/2 - ({text})")
                answer = self.critical(system, "p", -6, 20 if others else 6.1)
                self.assertEqual([kind for kind, _ in self.found(answer)], others)
                self.assertIn(f"At {place} the forces have no value", answer["reason"])


if __name__ == "__main__":
    unittest.main()
