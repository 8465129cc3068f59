"""Equilibria on the surfaces of constraints: closed forms, and random potentials on random ellipsoids and curves against
Newton's iteration from many starts, with the multipliers as unknowns, at 40 digits."""

import itertools
import math
import pathlib
import random
import sys
import unittest

import mpmath as mp
import numpy

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import constrained_scenes as scenes  # noqa: E402
from service import Service  # noqa: E402

mp.mp.dps = 40
EXACT = mp.mpf(10) ** -30  # what the second road itself may be off


def number(value):
    return mp.mpf(repr(value))


def text(terms):
    """{(2, 1): 0.5} as "(0.5)*x^2*y^1"."""
    return " + ".join(f"({c!r})*" + "*".join(f"{x}^{e}" for x, e in zip("xyz", powers)) for powers, c in terms.items())


def value(terms, place):
    return mp.fsum(number(c) * mp.fprod(x**e for x, e in zip(place, powers)) for powers, c in terms.items())


def slope(terms, i):
    slopes = {}
    for powers, c in terms.items():
        if powers[i]:
            lower = powers[:i] + (powers[i] - 1,) + powers[i + 1:]
            slopes[lower] = slopes.get(lower, mp.mpf(0)) + powers[i] * (c if isinstance(c, mp.mpf) else number(c))
    return slopes


def total(terms, place):
    """In the arithmetic of its numbers."""
    return sum(c * math.prod(x**e for x, e in zip(place, powers)) for powers, c in terms.items())


def rounded(derivatives):
    """The same polynomials in doubles."""
    if isinstance(derivatives, dict):
        return {powers: float(c) for powers, c in derivatives.items()}
    return [rounded(part) for part in derivatives]


def lu_solve(jacobian, residual):
    return mp.lu_solve(mp.matrix(jacobian), mp.matrix(residual))


class Problem:
    """A potential and constraints, polynomials in n coordinates."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.n = self.random.choice((2, 3))
        m = 1 if self.n == 2 else self.random.choice((1, 2))
        self.potential = self.some(2, 1.5)
        ellipsoid = {self.power(i, 2): self.near(0.3, 2) for i in range(self.n)} | {self.power(0, 0): self.near(-3, -0.5)}
        plane = {self.power(i, 1): self.near(-1.5, 1.5) for i in range(self.n)} | {self.power(0, 0): self.near(-0.2, 0.2)}
        self.constraints = [ellipsoid, plane][:m]

    def near(self, low, high):
        return round(self.random.uniform(low, high), 2) or 0.5

    def power(self, i, e):
        return tuple(e if j == i else 0 for j in range(self.n))

    def some(self, degree, size):
        powers = itertools.product(range(degree + 1), repeat=self.n)
        return {p: self.near(-size, size) for p in powers if 0 < sum(p) <= degree}

    def scene(self):
        names = "xyz"[:self.n]
        kinetic = " + ".join(f"{x}_dot^2" for x in names)
        return {"name": "on_a_surface", "units": "none", "coordinates": [{"name": x, "initial": "1"} for x in names],
                "lagrangian": f"({kinetic})/2 - ({text(self.potential)})",
                "constraints": [{"name": f"c{j}", "expression": text(c)} for j, c in enumerate(self.constraints)]}

    def derivatives(self):
        exact = [{p: number(c) for p, c in terms.items()} for terms in (self.potential, *self.constraints)]
        first = [[slope(terms, i) for i in range(self.n)] for terms in exact]
        second = [[[slope(row[i], k) for k in range(self.n)] for i in range(self.n)] for row in first]
        return exact, first, second

    def residual_and_jacobian(self, z, derivatives):
        exact, first, second = derivatives
        m = len(self.constraints)
        q, lambdas = z[:self.n], z[self.n:]
        slopes = [[total(e, q) for e in row] for row in first]
        force = [slopes[0][i] - sum(lambdas[j] * slopes[1 + j][i] for j in range(m)) for i in range(self.n)]
        jacobian = [[0] * (self.n + m) for _ in range(self.n + m)]
        for i in range(self.n):
            for k in range(self.n):
                curvature = [total(second[s][i][k], q) for s in range(1 + m)]
                jacobian[i][k] = curvature[0] - sum(lambdas[j] * curvature[1 + j] for j in range(m))
            for j in range(m):
                jacobian[i][self.n + j], jacobian[self.n + j][i] = -slopes[1 + j][i], slopes[1 + j][i]
        return force + [total(exact[1 + j], q) for j in range(m)], jacobian

    def newton(self, z, derivatives, solve, within):
        """Where the iteration comes to rest; None where it does not in forty steps."""
        for _ in range(40):
            residual, jacobian = self.residual_and_jacobian(z, derivatives)
            try:
                step = solve(jacobian, residual)
            except (ZeroDivisionError, numpy.linalg.LinAlgError):
                return None
            z = [a - b for a, b in zip(z, step)]
            if max(map(abs, step)) < within * (1 + max(map(abs, z))):
                return z
        return None

    def equilibria(self):
        """All (q, lambda) that Newton's iteration finds from a hundred places: in doubles first, which tell where it leads."""
        found = []
        exact = self.derivatives()
        doubles = rounded(exact)
        for _ in range(100):
            z = [self.random.uniform(-3, 3) for _ in range(self.n + len(self.constraints))]
            near = self.newton(z, doubles, numpy.linalg.solve, 1e-8)
            z = near and self.newton([mp.mpf(float(x)) for x in near], exact, lu_solve, mp.mpf(10) ** -35)
            if z and all(mp.norm(mp.matrix(z) - mp.matrix(o)) > mp.mpf(10) ** -20 for o in found):
                found.append(z)
        return found


class Equilibria(Service):
    def places(self, scene):
        answer = self.ask("equilibria", {"system": scene})
        self.assertTrue(answer["complete"], answer.get("reason"))
        return answer["equilibria"]

    def test_a_pendulum_hangs_or_stands(self):
        down, up = self.places(scenes.PENDULUM_BY_CONSTRAINT)
        for place, sign, stability in ((down, -1, "stable"), (up, 1, "unstable")):
            self.assertEqual(place["stability"], stability)
            self.assertLessEqual(abs(place["state"]["y"] - sign * 0.7), place["error"]["y"])
            tension = sign * 0.3 * 9.81 / (2 * 0.7)  # lambda dphi/dy = dV/dy
            self.assertLessEqual(abs(place["multipliers"]["lambda_string"] - tension),
                                 place["error"]["lambda_string"] + 1e-15 * abs(tension))
            self.assertLess(place["error"]["lambda_string"], 1e-13)
        self.assertTrue(down["valid"])
        self.assertFalse(up["valid"])  # the string would have to push
        omega = math.sqrt(9.81 / 0.7)
        self.assertEqual([round(e["im"], 9) for e in down["eigenvalues"]], [-round(omega, 9), round(omega, 9)])

    def test_what_pushes_with_nothing_pushes_as_much_at_pi_as_at_0(self):
        """A ladder that stands upright, on its head or not, does not touch the wall: W = 0 is no more below 0 than above."""
        for length, push in itertools.product((0.7, 2, 3.1), ("W", "-W")):
            ladder = {"name": "ladder", "units": "none",
                      "parameters": [{"name": "l", "default": length}, {"name": "g", "default": 9.81}],
                      "coordinates": [{"name": "x", "initial": "l/2*sin(0.2)"}, {"name": "y", "initial": "l/2*cos(0.2)"},
                                      {"name": "th", "initial": 0.2, "unit": "rad"}],
                      "lagrangian": "(x_dot^2 + y_dot^2)/2 + l^2*th_dot^2/24 - g*y",
                      "constraints": [{"name": "wall", "expression": "x - l/2*sin(th)", "multiplier": "W"},
                                      {"name": "floor", "expression": "y - l/2*cos(th)", "multiplier": "F"}],
                      "valid_while": [{"name": "push", "expression": push, "reason": "off", "message": "It is off."},
                                      {"name": "held", "expression": "F - 2*g", "reason": "off", "message": "It is off."},
                                      {"name": "F", "expression": "F", "reason": "off", "message": "It is off."}]}
            for place in self.places(ladder):
                self.assertEqual((place["validity"]["push"], place["valid"]), (0, False))
                self.assertLess(place["error"]["push"], 1e-13)
                self.assertLessEqual(abs(place["validity"]["held"] + 9.81), place["error"]["held"] + 1e-15)
                self.assertLess(place["error"]["validity/F"], 1e-13)  # beside that of the multiplier F
            del ladder["valid_while"][1]
            self.assertEqual([place["valid"] for place in self.places(ladder)], [True, True])

    def test_four_of_a_double_pendulum(self):
        found = self.places(scenes.DOUBLE_PENDULUM)
        self.assertEqual([p["stability"] for p in found], ["stable", "unstable", "unstable", "unstable"])
        self.assertEqual([(round(p["state"]["y1"]), round(p["state"]["y2"])) for p in found],
                         [(-1, -2), (-1, 0), (1, 0), (1, 2)])

    def test_none_where_weights_differ(self):
        answer = self.ask("equilibria", {"system": scenes.ATWOOD})
        self.assertEqual((answer["equilibria"], answer["complete"]), ([], True))

    def test_on_random_surfaces(self):
        seen = 0
        for seed in range(20):
            problem = Problem(seed)
            answer = self.ask("equilibria", {"system": problem.scene()})
            true = problem.equilibria()
            seen += len(true)
            for place in answer["equilibria"]:
                names = list("xyz"[:problem.n]) + list(place["multipliers"])
                got = [place["state"].get(name, place["multipliers"].get(name)) for name in names]
                hits = [z for z in true if all(abs(number(g) - x) <= number(place["error"][name]) + EXACT
                                               for g, x, name in zip(got, z, names))]
                self.assertEqual(len(hits), 1, (seed, place))
            if answer["complete"]:
                self.assertEqual(len(answer["equilibria"]), len(true), seed)
        self.assertGreater(seen, 60)

    def test_no_mass_lets_a_rolling_disk_lie_askew(self):
        """Its forces on the surface are not one for each equation of motion."""
        for name, place in (("euler_disk", {"x": 0, "y": 0, "phi": 0, "theta": 0.5, "psi": 0}), ("rattleback", None)):
            with self.subTest(name):
                self.assertEqual(self.post("equilibria", {"system": name, "solve_for": "m"}).status, 422)
            if place is not None:
                answer = self.ask("equilibria", {"system": name, "solve_for": "m", "at": place})
                self.assertIsNone(answer["m"])
                self.assertIn("0", answer["reason"])

    def test_where_constraints_meet_without_crossing_nothing_is_claimed(self):
        """Two spheres that touch: the gradients are parallel where they do."""
        scene = {"name": "touching", "units": "none", "coordinates": [{"name": x, "initial": "0"} for x in "xyz"],
                 "lagrangian": "(x_dot^2 + y_dot^2 + z_dot^2)/2 - z",
                 "constraints": [{"name": "a", "expression": "x^2 + y^2 + z^2 - 1"},
                                 {"name": "b", "expression": "(x - 2)^2 + y^2 + z^2 - 1"}]}
        scene["coordinates"][0]["initial"] = "1"
        problem = self.post("equilibria", {"system": scene})
        if problem.status == 200:
            self.assertIn(b"depend on each other", problem.data)
            self.assertIn(b'"complete": false', problem.data.replace(b'"complete":false', b'"complete": false'))


if __name__ == "__main__":
    unittest.main()
