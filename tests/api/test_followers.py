"""What follows a parameter that moves: others that are expressions of it, and the momenta of a start that speaks of it.
Critical values against those by hand, and against `equilibria` at single values."""

import math
import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import DOWN, DOWN_3D, G, lagrangian, particle, scene  # noqa: E402

HOOP = lagrangian("hoop", "n - 0.7; I - 1", "th -; ph - 0 n", "th_dot^2/2 + (I + sin(th)^2)*ph_dot^2/2 + cos(th)")
HOOP["coordinates"] = [one | {"unit": "rad"} for one in HOOP["coordinates"]]
TOP = scene("top", f"m kg 1; A kg*m^2 0.3; C kg*m^2 0.5; l m 0.4; n rad/s 5; {G}", "a rad 0; b rad 0; ps rad 0 n", gravity=DOWN_3D,
            bodies=[{"kind": "rigid_body", "mass": "m", "principal_moments": ["A", "A", "C"],
                     "centre": ["l*sin(b)", "-l*cos(b)*sin(a)", "l*cos(b)*cos(a)"],
                     "orientation": {"sequence": "XYZ", "angles": ["a", "b", "ps"]}}])
POST = scene("post", f"m kg 1; l m 0.5; k N/m 30; c N*m k*l^2/2; {G}", "th rad 0.1", gravity=DOWN,
             bodies=[particle("m", "l*sin(th)", "l*cos(th)")], springs=[{"stiffness": "c", "angle": "th"}])


class Followers(Service):
    def critical(self, asked, parameter, first, last, **more):
        answer = self.ask("bifurcations", {"system": asked, "parameter": parameter, "from": first, "to": last, **more})
        return answer, [(one["kind"], one["value"], one.get("exact", {}).get("text")) for one in answer["critical"]]

    def near(self, found, kind, value, text):
        self.assertEqual((found[0], found[2]), (kind, text))
        self.assertAlmostEqual(found[1], value, 12)

    def test_momenta_follow_the_start(self):
        _, found = self.critical(HOOP, "n", 0.1, 5)
        self.assertEqual(len(found), 1)
        self.near(found[0], "pitchfork", 1, "1")
        _, found = self.critical(HOOP, "n", 0.1, 5, initial={"ph_dot": "2*n"})
        self.near(found[0], "pitchfork", 0.5, "1/2")
        answer, found = self.critical(HOOP, "I", 0.1, 5)  # p/I stays 0.7
        self.assertEqual((found, answer["complete"]), ([], True))
        self.near(self.critical(HOOP, "I", 0.1, 5, initial={"th": 0.5})[1][0], "pitchfork", 0.7 * math.sin(0.5) ** 2 / 0.3,
                  "n*sin(1/2)^2/(1 - n)")

    def test_branches_have_the_stability_of_single_values(self):
        answer, _ = self.critical(HOOP, "n", 0.1, 5)
        upright = next(one for one in answer["branches"] if all(abs(th) < 1e-9 for th in one["th"]))
        for n, stability in list(zip(upright["n"], upright["stability"]))[::7]:
            if abs(n - 1) < 1e-6:
                continue
            single = self.ask("equilibria", {"system": HOOP, "parameters": {"n": n}})["equilibria"]
            self.assertIn(stability, [one["stability"] for one in single if one["state"]["th"] == 0], n)

    def test_a_sleeping_top(self):
        root = 2 * math.sqrt((0.3 + 0.16) * 0.4 * 9.81)
        for parameter, first, last, value, text in (("n", 1, 20, root / 0.5, "2*sqrt(m*l*g*(A + m*l^2))/C"),
                                                    ("C", 0.1, 2, root / 5, "2*sqrt(m*l*g*(A + m*l^2))/n"),
                                                    ("A", 0.01, 2, 6.25 / (4 * 0.4 * 9.81) - 0.16, "C^2*n^2/(4*m*l*g) - m*l^2"),
                                                    ("g", 1, 20, 6.25 / (4 * 0.4 * 0.46), "C^2*n^2/(4*m*l*(A + m*l^2))")):
            for one in self.critical(TOP, parameter, first, last)[1]:
                self.near(one, "flutter", value, text)

    def test_parameters_that_are_expressions_follow(self):
        self.near(self.critical(POST, "k", 20, 100)[1][0], "pitchfork", 39.24, "2*m*g/l")
        self.near(self.critical(POST, "l", 0.3, 2)[1][0], "pitchfork", 0.654, "2*m*g/k")
        free = POST | {"parameters": [one | {"default": 7} if one["name"] == "c" else one for one in POST["parameters"]]}
        self.near(self.critical(free, "k", 20, 100, parameters={"c": "k*l^2/2"})[1][0], "pitchfork", 39.24, "2*m*g/l")
        answer = self.ask("equilibria", {"system": POST, "solve_for": "k", "at": {"th": 0.3}})
        self.assertAlmostEqual(answer["k"], 2 * 9.81 * math.sin(0.3) / (0.5 * 0.3), 12)
        self.assertEqual(answer["exact"]["text"], "2*m*g*sin(th)/(l*th)")

    def test_a_rate_that_is_held_is_named(self):
        answer = self.ask("equilibria", {"system": HOOP, "solve_for": "n", "at": {"th": 0.5}})
        self.assertIn("ph_dot stays 0.7 here, though the start gives it by n", answer["reason"])
        self.assertAlmostEqual(self.ask("equilibria", {"system": HOOP, "solve_for": "ph_dot", "at": {"th": 0.5}})["ph_dot"],
                               math.cos(0.5) ** -0.5, 12)


if __name__ == "__main__":
    unittest.main()
