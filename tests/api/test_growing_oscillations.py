"""Values of a parameter at which oscillations begin to grow: follower forces, gyroscopic stabilization, internal damping of
shafts, negative damping. Closed forms, and the eigenvalues of random systems by numpy."""

import math
import pathlib
import random
import sys
import unittest

import numpy

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian, particle, scene  # noqa: E402

END = ["l*cos(a) + l*cos(b)", "l*sin(a) + l*sin(b)"]
# Ziegler's double pendulum: a load that follows the last link. Ziegler, Principles of Structural Stability, 2nd ed., 4.
ZIEGLER = scene("ziegler", "m kg 1; l m 1; c N*m 1; P N 1; d N*m*s 0", "a rad 0; b rad 0",
                bodies=[particle("2*m", "l*cos(a)", "l*sin(a)"), particle("m", *END)],
                springs=[{"stiffness": "c", "angle": "a"}, {"stiffness": "c", "angle": "b - a"}],
                dampers=[{"coefficient": "d", "angle": "a"}, {"coefficient": "d", "angle": "b - a"}],
                forces=[{"vector": ["-P*cos(b)", "-P*sin(b)"], "point": END}])


class Growth(Service):
    def found(self, system, parameter, low, high, **more):
        answer = self.ask("bifurcations", {"system": system, "parameter": parameter, "from": low, "to": high, **more})
        self.assertTrue(answer["complete"], answer.get("reason"))
        return [c for c in answer["critical"] if c["kind"] in ("hopf", "flutter")], answer

    def check(self, system, parameter, low, high, kind, value, omega, exact=None, **more):
        (critical,), answer = self.found(system, parameter, low, high, **more)
        self.assertEqual(critical["kind"], kind)
        self.assertLessEqual(abs(critical["value"] - value), critical["error"] + 1e-15 * abs(value))
        self.assertLess(critical["error"], 1e-13 * max(1, abs(value)))
        self.assertLessEqual(abs(critical["omega"] - omega), critical["omega_error"] + 1e-15 * omega)
        if exact:
            self.assertEqual(critical["exact"]["text"], exact)
        return answer

    def test_zieglers_pendulum_flutters(self):
        square = 1 / math.sqrt(2)  # det K / det M = c^2/(2 m^2 l^4), the product of two equal omega^2
        answer = self.check(ZIEGLER, "P", 0, 5, "flutter", 3.5 - math.sqrt(2), math.sqrt(square), "(7 - 2*sqrt(2))*c/(2*l)")
        self.assertEqual(sorted(set(answer["branches"][0]["stability"])), ["neutral", "unstable"])

    def test_damping_makes_it_flutter_earlier(self):
        """Ziegler's paradox: 41/28 c/l with vanishing damping."""
        answer = self.check(ZIEGLER, "P", 0, 5, "hopf", 41 / 28 + 0.005, math.sqrt(2 / 7), "41*c/(28*l) + d^2/(2*m*l^3)",
                            parameters={"d": 0.1})
        (branch,) = answer["branches"]
        for load, stability in zip(branch["P"], branch["stability"]):
            self.assertEqual(stability, "stable" if load < 41 / 28 + 0.005 else "unstable")

    def test_gyroscopic_forces_hold_a_hilltop(self):
        hill = lagrangian("hill", "a - 1; G - 1", "x - 0; y - 0",
                          "(x_dot^2 + y_dot^2)/2 + G/2*(x*y_dot - y*x_dot) + a/2*(x^2 + y^2)")
        self.check(hill, "G", 0.5, 5, "flutter", 2, 1)
        self.check(hill, "G", 0.5, 5, "flutter", 3, 1.5, parameters={"a": 2.25})

    def test_a_shaft_with_internal_damping_whirls(self):
        force = {"x": "-(ce + ci)*x_dot - ci*W*y", "y": "-(ce + ci)*y_dot + ci*W*x"}
        shaft = lagrangian("shaft", "m - 2; k - 8; ce - 0.1; ci - 0.2; W - 1", "x - 0; y - 0",
                           "m*(x_dot^2 + y_dot^2)/2 - k*(x^2 + y^2)/2",
                           forces=[{"value": value, "along": q} for q, value in force.items()])
        self.check(shaft, "W", 0, 10, "hopf", 3, 2, "(ce + ci)*sqrt(k/m)/ci")

    def test_damping_that_changes_its_sign(self):
        van_der_pol = lagrangian("vdp", "mu - 1", "x - 0.1", "(x_dot^2 - x^2)/2", forces=[{"value": "mu*(1 - x^2)*x_dot", "along": "x"}])
        self.check(van_der_pol, "mu", -1, 1, "hopf", 0, 1)
        along_a_curve = lagrangian("curve", "p - 1", "x - 0.1", "x_dot^2/2 - x^3/3 + p*x",
                                   forces=[{"value": "-(x - 1/2)*x_dot", "along": "x"}])
        answer = self.check(along_a_curve, "p", -1, 1, "hopf", 0.25, 1)
        self.assertEqual([c["kind"] for c in answer["critical"]], ["saddle_node", "hopf"])

    def test_damping_that_changes_its_sign_assumes_that_its_place_exists_and_something_oscillates(self):
        for potential, parameters, needed in (
                ("k*x^2/2", "k - 2; m - 1; c - 1", ["k > 0", "m > 0"]),
                ("k*(x^2 + y^2)/2 + q*(x - y)^2/2", "k - 2; q - 1; m - 1; c - 1; d - 1", ["k > 0", "m > 0"]),
                ("a*exp(x) - f*x", "a - 1; f - 2; m - 1; c - 1", ["a > 0", "f > 0", "m > 0"]),
                ("a*cos(x) + b*x", "a - 1; b - 0.5; m - 1; c - 1", ["b > 0", "m > 0", "a > b"])):
            with self.subTest(potential):
                forces = [{"name": "f_x", "value": "-c*x_dot", "along": "x"}]
                places, inertia = "x - 0.6", "m*x_dot^2/2"
                if "y" in potential:
                    places, inertia = "x - 0.6; y - 0.1", "m*(x_dot^2 + y_dot^2)/2"
                    forces = [{"name": f"f_{u}", "value": f"-c*{u}_dot - d*({u}_dot - {v}_dot)", "along": u} for u, v in ("xy", "yx")]
                ((critical,), _) = self.found(lagrangian("s", parameters, places, f"{inertia} - ({potential})", forces=forces), "c", -1, 2)
                self.assertEqual(critical["exact"]["text"], "0")
                self.assertEqual(critical["exact"]["assumes"], needed)

    def test_equal_oscillators_that_begin_together_are_told(self):
        both = lagrangian("both", "mu - 1", "x - 0.1; y - 0", "(x_dot^2 + y_dot^2 - 4*x^2 - 4*y^2)/2",
                          forces=[{"value": f"(mu - 0.25)*{q}_dot", "along": q} for q in "xy"])
        answer = self.ask("bifurcations", {"system": both, "parameter": "mu", "from": -1, "to": 1})
        (critical,) = answer["critical"]
        self.assertLessEqual(abs(critical["value"] - 0.25), critical["error"])
        self.assertEqual((critical["kind"], critical["omega"]), ("unresolved", 2))
        self.assertIn("cross the imaginary axis at once", critical["reason"])

    def test_none_where_only_energy_is_kept_or_lost(self):
        for more in ([], [{"value": "-0.1*x_dot", "along": "x"}]):
            saddle = lagrangian("saddle", "p - 1", "x - 0; y - 0", "(x_dot^2 + y_dot^2)/2 + p*x^2/2 - x*y - y^2 - x^4", forces=more)
            self.assertEqual(self.found(saddle, "p", -1, 1)[0], [])

    def test_real_eigenvalues_of_opposite_signs_are_no_oscillations(self):
        """s^2 + (p - 0.5) s - 1 has +-1 at p = 0.5."""
        neutral = lagrangian("neutral", "p - 1", "x - 0", "x_dot^2/2 + x^2/2", forces=[{"value": "-(p - 0.5)*x_dot", "along": "x"}])
        self.assertEqual(self.found(neutral, "p", 0, 1)[0], [])

    def test_random_systems_of_two_and_three(self):
        draw = random.Random(3)
        crossings = 0
        for _ in range(30):
            n = draw.choice([2, 2, 3])
            names = "xyz"[:n]
            k = [[round(draw.uniform(2, 4), 2) if i == j else round(draw.uniform(-1, 1), 2) for j in range(n)] for i in range(n)]
            d = [[round(draw.uniform(-0.3, 0.5), 2) for _ in range(n)] for _ in range(n)]
            force = {q: " ".join(f"- ({k[i][j]})*{r} - ({d[i][j]}{' + p' if i == j else ''})*{r}_dot" for j, r in enumerate(names))
                     for i, q in enumerate(names)}
            system = lagrangian("random", "p - 1", "; ".join(f"{q} - 0" for q in names),
                                "(" + " + ".join(f"{q}_dot^2" for q in names) + ")/2",
                                forces=[{"value": value, "along": q} for q, value in force.items()])
            found, _ = self.found(system, "p", -1, 1)
            expected = []
            for low, high in zip(numpy.linspace(-1, 1, 2001)[:-1], numpy.linspace(-1, 1, 2001)[1:]):
                growing = []
                for p in (low, high):
                    a = numpy.block([[numpy.zeros((n, n)), numpy.eye(n)], [-numpy.array(k), -numpy.array(d) - p * numpy.eye(n)]])
                    growing.append(sum(numpy.linalg.eigvals(a).real > 0))
                if abs(growing[1] - growing[0]) == 2:
                    expected.append((low, high))
            self.assertEqual(len(found), len(expected), (system, expected))
            for critical, (low, high) in zip(found, expected):
                self.assertTrue(low - 1e-9 <= critical["value"] <= high + 1e-9)
            crossings += len(found)
        self.assertGreater(crossings, 30)

    def test_a_body_whose_condition_of_growth_is_too_long_says_so_soon(self):
        body = {"kind": "rigid_body", "mass": "m", "principal_moments": ["A", "A", "C"], "centre": ["0", "0", "0"],
                "orientation": {"sequence": "ZXY", "angles": ["a", "b", "c"]}}
        racket = scene("racket", "m kg 0.5; A kg*m^2 0.003; C kg*m^2 0.004", "a rad 0 10; b rad; c rad", bodies=[body])
        answer = self.ask("bifurcations", {"system": racket, "parameter": "C", "from": 0.0028, "to": 0.0033})
        self.assertFalse(answer["complete"])
        self.assertIn("the search for them was given up", answer["reason"])


if __name__ == "__main__":
    sys.exit(unittest.main())
