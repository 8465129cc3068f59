"""Equilibria of two and three coordinates that the forces couple. The second road: a potential that is a sum of
functions of one variable each, u = M x, has its equilibria where each of them is stationary; mpmath at 40 digits finds
them one by one, and turns them back by M^-1."""

import itertools
import json
import os
import pathlib
import random
import subprocess
import sys
import unittest

import mpmath as mp

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mp.mp.dps = 40
EXACT = mp.mpf(10) ** -30
NAMES = "xyz"


def coupled(potential, names):
    """Coordinates without dimension, of unit mass each."""
    kinetic = " + ".join(f"(T*{name}_dot)^2/2" for name in names)
    return {"name": "coupled",
            "parameters": [{"name": "J", "unit": "J", "default": "1"}, {"name": "T", "unit": "s", "default": "1"}],
            "coordinates": [{"name": name, "unit": "1"} for name in names],
            "lagrangian": f"J*({kinetic} - ({potential}))"}


def decimal(rng, low, high):
    return f"{rng.uniform(low, high):.2f}"


class Well:
    """f(u) = u^4/4 + b u^2/2 + c u"""

    def __init__(self, rng):
        self.b, self.c = decimal(rng, -2, 2), decimal(rng, 0.1, 1)

    def text(self, u):
        return f"{u}^4/4 + ({self.b})*{u}^2/2 + {self.c}*{u}"

    def places(self):
        roots = mp.polyroots([1, 0, mp.mpf(self.b), mp.mpf(self.c)], maxsteps=200, extraprec=200)
        return [(mp.re(u), 3 * mp.re(u) ** 2 + mp.mpf(self.b) > 0) for u in roots if abs(mp.im(u)) < EXACT]


class StaticsOfSeveral(Service):
    def slanting(self, rng, n):
        """A scene and its equilibria, (place, whether it is stable)."""
        slant = {2: 1.5, 3: 0.6}[n]
        while True:
            matrix = [[decimal(rng, 1, 2) if i == j else decimal(rng, -slant, slant) for j in range(n)]
                      for i in range(n)]
            if abs(mp.det(mp.matrix(matrix))) > 0.3:
                break
        wells = [Well(rng) for _ in range(n)]
        combined = ["(" + " + ".join(f"({c})*{name}" for c, name in zip(row, NAMES)) + ")" for row in matrix]
        potential = " + ".join(well.text(u) for well, u in zip(wells, combined))
        expected = [(mp.lu_solve(mp.matrix(matrix), mp.matrix([u for u, _ in places])), all(s for _, s in places))
                    for places in itertools.product(*(well.places() for well in wells))]
        return coupled(potential, NAMES[:n]), expected

    def assert_lists(self, found, expected):
        """All of them; only true ones where the answer says that some may be missing."""
        places = set()
        for entry in found["equilibria"]:
            hits = [k for k, (place, _) in enumerate(expected)
                    if all(abs(mp.mpf(repr(entry["state"][name])) - x) <= mp.mpf(entry["error"][name]) + EXACT
                           for name, x in zip(NAMES, place))]
            self.assertEqual(len(hits), 1, (entry, expected))
            self.assertEqual(entry["stability"], "stable" if expected[hits[0]][1] else "unstable")
            places.add(hits[0])
        self.assertEqual(len(places), len(found["equilibria"]))
        if found["complete"]:
            self.assertEqual(len(places), len(expected))
        else:
            self.assertTrue(found["reason"])

    def complete_of(self, rng, n, cases):
        """How many answers of so many are complete."""
        complete = 0
        for _ in range(cases):
            scene, expected = self.slanting(rng, n)
            with self.subTest(scene=scene["lagrangian"]):
                found = self.ask("equilibria", {"system": scene})
                self.assert_lists(found, expected)
                complete += found["complete"]
        return complete

    def test_wells_along_slanting_axes(self):
        rng = random.Random(1)
        self.assertEqual(self.complete_of(rng, 2, 40), 40)
        self.assertGreaterEqual(self.complete_of(rng, 3, 6), 4)

    def test_a_chain_of_masses_on_hardening_springs_rests_in_one_place(self):
        springs = [f"({a})^2/2 + ({a})^4/4" for a in ("x", "y-x", "z-y", "z")]
        found = self.ask("equilibria", {"system": coupled(" + ".join(springs), NAMES)})
        self.assertTrue(found["complete"])
        self.assert_lists(found, [(mp.matrix([0, 0, 0]), True)])

    def test_where_a_spring_has_no_length_is_named(self):
        spring = "10*(sqrt(x^2 + y^2) - 1)^2/2 + 0.3*y"
        found = self.ask("equilibria", {"system": coupled(spring, "xy")})
        self.assertTrue(found["complete"])
        self.assertIn("x = 0 and y = 0", found["reason"])
        self.assertEqual(len(found["equilibria"]), 2)

    def test_a_search_that_is_given_up_lists_what_it_has_found(self):
        ring = "(x^2 + y^2 - 1)^2/4"
        found = self.ask("equilibria", {"system": coupled(ring, "xy")})
        self.assertFalse(found["complete"])
        origin = [e for e in found["equilibria"] if abs(e["state"]["x"]) + abs(e["state"]["y"]) < 1e-9]
        self.assertEqual([e["stability"] for e in origin], ["unstable"])

    def test_eight_masses_on_quadratic_springs_rest_in_the_middle_whatever_may_be_spent(self):
        """Fermi, Pasta and Ulam: of some 500 places of rest, most with springs pulled beyond where they give way, one is seen."""
        names = [f"x{i}" for i in range(1, 9)]
        stretched = [f"({b} - {a})" for a, b in zip(["0", *names], [*names, "0"])]
        text = " + ".join(f"{x}_dot^2/2" for x in names) + "".join(f" - {d}^2/2 - al/3*{d}^3" for d in stretched)
        chain = lagrangian("fermi_pasta_ulam", "al - 0.25", "; ".join(f"{x} - 0.{x[1]}" for x in names), text)
        found = self.ask("equilibria", {"system": chain})
        line = subprocess.run([os.environ["QDOT_BINARY"], "equilibria"], input=json.dumps({"system": chain}), capture_output=True, text=True)
        for answer in (found, json.loads(line.stdout)):
            self.assertFalse(answer["complete"])
            self.assertIn({x: 0 for x in names}, [{x: e["state"][x] for x in names} for e in answer["equilibria"]])


class Families(Service):
    def test_what_may_be_shifted_is_a_family(self):
        ring = "x_dot^2/2 + y_dot^2/2 + z_dot^2/2 - {0}(x - y) - {0}(y - z) - {0}(z - x)"
        for potential in ("exp", "cosh"):
            found = self.ask("equilibria", {"system": lagrangian("ring", "", "x - 0.1; y - 0; z - 0.3",
                                                                 ring.format(potential))})
            self.assertEqual((found["equilibria"], found["complete"]), ([], False))
            self.assertIn("Adding the same to x, y and z changes no force", found["reason"])

    def test_what_turns_together_in_a_ratio_is_a_family(self):
        for slipped, told in (("a - 2*b", "da = 2 and db = 1"), ("a - n*b", "da = n and db = 1"),
                              ("r*a - n*b - 1", "da = n and db = r")):
            gears = lagrangian("gears", "k - 10; n - 3; r - 0.7", "a - 0.1; b - 0.2",
                               f"a_dot^2/2 + b_dot^2 - k*({slipped})^2/2")
            found = self.ask("equilibria", {"system": gears})
            self.assertEqual((found["equilibria"], found["complete"]), ([], False))
            self.assertIn(f"The small change {told} changes no force", found["reason"])

    def test_what_turns_about_a_place_is_a_family(self):
        for told, around in (("dx = -y and dy = x", "x^2 + y^2"), ("dx = 1 - y and dy = x", "x^2 + (y - 1)^2")):
            hat = lagrangian("hat", "a - 1.3", "x - 0.3; y - 0.2", f"(x_dot^2 + y_dot^2)/2 + a*({around})/2 - ({around})^2/4")
            found = self.ask("equilibria", {"system": hat})
            self.assertFalse(found["complete"])
            self.assertIn(f"The small change {told} leaves the potential as it is", found["reason"])
        well = lagrangian("well", "", "x - 0.3; y - 0.2", "(x_dot^2 + y_dot^2)/2 - (x^2 + y^2)/2 - (x^2 + y^2)^2/4")
        found = self.ask("equilibria", {"system": well})
        self.assertEqual((len(found["equilibria"]), found["complete"]), (1, True))

    def test_what_turns_together_under_balanced_torques_is_a_family(self):
        gears = lagrangian("gears", "k - 10; n - 3", "a - 0.1; b - 0.2", "a_dot^2/2 + b_dot^2 - k*(a - n*b)^2/2",
                           forces=[{"along": "a", "value": "2"}, {"along": "b", "value": "-2*n"}])
        self.assertIn("The small change da = n and db = 1 changes no force", self.ask("equilibria", {"system": gears})["reason"])
        found = self.ask("modes", {"system": gears})
        self.assertEqual([mode["kind"] for mode in found["modes"]], ["rigid", "oscillation"])
        place = found["equilibrium"]["state"]
        self.assertAlmostEqual(place["a"] - 3*place["b"], 0.2, delta=1e-14)

    def test_a_force_that_is_never_zero(self):
        drag = lagrangian("fall", "g - 9.81", "x - 0; y - 0", "x_dot^2/2 + y_dot^2/2 - g*y",
                          dissipation="x_dot^2/2 + y_dot^2/2")
        found = self.ask("equilibria", {"system": drag})
        self.assertEqual((found["equilibria"], found["complete"]), ([], True))
        self.assertIn("vanish nowhere", found["reason"])

    def test_a_shaft_with_damping_about_it_has_no_critical_rate_of_rest(self):
        shaft = lagrangian("shaft", "k - 10; c - 0.2; w - 4", "x - 0.1; y - 0",
                           "((x_dot - w*y)^2 + (y_dot + w*x)^2)/2 - k/2*(x^2 + y^2)",
                           forces=[{"value": "-c*(x_dot - w*y)", "along": "x"}, {"value": "-c*(y_dot + w*x)", "along": "y"}])
        found = self.ask("bifurcations", {"system": shaft, "parameter": "w", "from": 0.5, "to": 8})
        self.assertEqual((found["critical"], found["complete"]), ([], True), found["reason"])

    def test_a_rail_that_turns_lets_its_carriage_go_far(self):
        rail = lagrangian("rail", "k - 10; l - 1; c - 0.5; w - 1", "x - 0.2",
                          "x_dot^2/2 + w^2*x^2/2 - k/2*(sqrt(x^2 + l^2) - c)^2")
        found = self.ask("bifurcations", {"system": rail, "parameter": "w", "from": 0.1, "to": 5})
        self.assertEqual([critical["kind"] for critical in found["critical"]], ["pitchfork"])
        self.assertNotIn("given up", found["reason"])  # all that is missing comes from infinity
        self.assertIn("x = infinity", found["reason"])

    def test_what_is_nearly_a_circle_of_equilibria_is_a_few(self):
        """The Sun and the Earth, and a hat that is tilted a little."""
        mu = mp.mpf("3.003e-6")
        found = self.ask("equilibria", {"system": "restricted_three_body", "parameters": {"mu": "3.003e-6"}})

        def pull(x):
            return x - (1 - mu)*mp.sign(x + mu)/(x + mu)**2 - mu*mp.sign(x - 1 + mu)/(x - 1 + mu)**2

        on_axis = [(mp.findroot(pull, x), 0) for x in (-1, 0.99, 1.01)]
        self.lie_at(found, on_axis + [(mp.mpf("0.5") - mu, side*mp.sqrt(3)/2) for side in (-1, 1)])

        hat = lagrangian("hat", "e - 1e-6", "x - 1; y - 0", "(x_dot^2 + y_dot^2)/2 - (x^2 + y^2 - 1)^2 + e*x")
        found = self.ask("equilibria", {"system": hat})
        self.lie_at(found, [(x, 0) for x in mp.polyroots([-4, 0, 4, mp.mpf("1e-6")])])

    def test_beside_what_has_no_damping_linear_equations_are_stable(self):
        """As 'modes' says; a cubic force may drive it."""
        for cubic, stability in (("0", "stable"), ("0.1*x_dot*y_dot^2", "neutral")):
            masses = lagrangian("masses", "c - 1", "x - 0.1; y - 0.1", "(x_dot^2 + y_dot^2)/2 - (x^2 + 4*y^2)/2",
                                forces=[{"value": f"{cubic} - c*x_dot", "along": "x"}])
            self.assertEqual(self.ask("equilibria", {"system": masses})["equilibria"][0]["stability"], stability)
            self.assertEqual(self.ask("modes", {"system": masses})["equilibrium"]["stability"], stability)

    def lie_at(self, found, places):
        self.assertIs(found["complete"], True, found.get("reason"))
        self.assertEqual(len(found["equilibria"]), len(places))
        for one, place in zip(found["equilibria"], sorted(places)):
            for name, true in zip("xy", place):
                self.assertLessEqual(abs(one["state"][name] - true), one["error"][name] + EXACT)


if __name__ == "__main__":
    unittest.main()
