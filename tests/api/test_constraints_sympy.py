"""SymPy derives the same accelerations and multipliers from the same Lagrangians and constraints."""

import math
import pathlib
import random
import sys
import unittest

import numpy
import sympy
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import constrained_scenes as scenes  # noqa: E402
from service import Service  # noqa: E402

T = dynamicsymbols._t


class SympyMotion:
    """q'' and lambda as functions of a state."""

    def __init__(self, scene, lagrangian, kind):
        self.names = [q["name"] for q in scene["coordinates"]]
        self.q = dynamicsymbols(self.names)
        self.q = self.q if isinstance(self.q, (list, tuple)) else [self.q]
        rates = [q.diff(T) for q in self.q]
        parameters = {p["name"]: sympy.Symbol(p["name"]) for p in scene["parameters"]}
        words = dict(zip(self.names, self.q)) | {f"{n}_dot": v for n, v in zip(self.names, rates)} | parameters | {"t": T}
        read = lambda text: sympy.sympify(text.replace("^", "**"), locals=words)  # noqa: E731
        constraints = [read(c["expression"]) for c in scene["constraints"]]
        method = LagrangesMethod(read(lagrangian), self.q, **{kind: constraints})
        method.form_lagranges_equations()
        plain = {}  # velocities before coordinates: derivatives of a replaced symbol would vanish
        for name, q in zip(self.names, self.q):
            plain[q.diff(T)] = sympy.Symbol(name + "_dot")
        for name, q in zip(self.names, self.q):
            plain[q] = sympy.Symbol(name)
        matrix = method.mass_matrix_full.subs(plain)
        forcing = method.forcing_full.subs(plain)
        self.values = sympy.lambdify([[*plain.values(), *parameters.values(), T]], (matrix, forcing), "numpy")

    def at(self, state, parameters, t):
        n = len(self.names)
        matrix, forcing = self.values([*(state[f"{k}_dot"] for k in self.names), *(state[k] for k in self.names), *parameters, t])
        solution = numpy.linalg.solve(numpy.array(matrix, float), numpy.array(forcing, float)).ravel()
        return [float(x) for x in solution[n:2 * n]], [float(x) for x in solution[2 * n:]]


def on_circle(draw):
    angle, rate = draw(), draw()
    return {"x": 0.7 * math.sin(angle), "y": -0.7 * math.cos(angle),
            "x_dot": 0.7 * rate * math.cos(angle), "y_dot": 0.7 * rate * math.sin(angle)}, 0


def along_edge(draw, angle="phi"):
    turned, speed = draw(), draw()
    return {"x": draw(), "y": draw(), angle: turned, "x_dot": speed * math.cos(turned), "y_dot": speed * math.sin(turned),
            f"{angle}_dot": draw()}, 0


def on_wire(draw):
    t, r, rate = abs(draw()), draw(), draw()
    c, s = math.cos(1.3 * t), math.sin(1.3 * t)
    return {"x": r * c, "y": r * s, "x_dot": rate * c - 1.3 * r * s, "y_dot": rate * s + 1.3 * r * c}, t


CASES = [
    (scenes.PENDULUM_BY_CONSTRAINT, "m*(x_dot^2 + y_dot^2)/2 - m*g*y", "hol_coneqs", on_circle),
    (scenes.KNIFE_EDGE, scenes.KNIFE_EDGE["lagrangian"], "nonhol_coneqs", along_edge),
    (scenes.SLEIGH, scenes.SLEIGH["lagrangian"], "nonhol_coneqs", lambda draw: along_edge(draw, "theta")),
    (scenes.ROTATING_WIRE, "m*(x_dot^2 + y_dot^2)/2", "hol_coneqs", on_wire),
]


class SameAsSympy(Service):
    def test_accelerations_and_multipliers(self):
        rng = random.Random(16)
        for scene, lagrangian, kind, place in CASES:
            known = SympyMotion(scene, lagrangian, kind)
            parameters = [float(p["default"]) for p in scene["parameters"]]
            signs = set()
            for _ in range(5):
                state, t = place(lambda: rng.uniform(-2, 2))
                found = self.ask("energy", {"system": scene, "initial": state, "t": t})
                accelerations, multipliers = known.at(state, parameters, t)
                for value, true in zip(found["accelerations"].values(), accelerations):
                    self.assertAlmostEqual(value, true, 11, scene["name"])
                for value, true in zip(found["multipliers"].values(), multipliers):
                    self.assertAlmostEqual(abs(value), abs(true), 11, scene["name"])
                    signs.add(math.copysign(1, value * true))
            self.assertEqual(len(signs), 1, "SymPy may count its multipliers the other way, but always")


if __name__ == "__main__":
    unittest.main()
