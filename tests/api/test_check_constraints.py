"""/v1/check of equations of motion under constraints: SymPy writes right ones, with multipliers and without, and
wrong ones with one term changed."""

import os
import pathlib
import random
import sys
import unittest

import sympy as sp

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.extend([str(ROOT / "tests" / "support"), str(ROOT / "tests" / "server")])

import constrained_scenes as scenes  # noqa: E402
from scene_by_sympy import T, BySympy, names_of  # noqa: E402
from service import Service  # noqa: E402

SEED = int(os.environ.get("QDOT_SEED", "1"))
OF_EACH = 20
BEAD_ON_PARABOLA = {
    "name": "bead_on_parabola", "parameters": scenes.parameters(m=("kg", "1"), c=("1/m", "2"), g=("m/s^2", "9.81")),
    "coordinates": scenes.coordinates(x=("m", "0", "1"), y=("m", "0", "0")),
    "lagrangian": "m*(x_dot^2 + y_dot^2)/2 - m*g*y", "constraints": [{"name": "wire", "expression": "y - c*x^2"}]}
BEAD_IN_SPACE = {
    "name": "bead_on_cone", "parameters": scenes.parameters(m=("kg", "1"), k=("1", "1"), g=("m/s^2", "9.81")),
    "coordinates": scenes.coordinates(x=("m", "1", "0"), y=("m", "0", "1"), z=("m", "1", "0")),
    "lagrangian": "m*(x_dot^2 + y_dot^2 + z_dot^2)/2 - m*g*z",
    "constraints": [{"name": "cone", "expression": "z^2 - k*(x^2 + y^2)"}]}
SCENES = [scenes.PENDULUM_BY_CONSTRAINT, scenes.KNIFE_EDGE, scenes.SLEIGH, scenes.ROTATING_WIRE, scenes.ATWOOD,
          scenes.DOUBLE_PENDULUM, scenes.ROLLING_DISK, BEAD_ON_PARABOLA, BEAD_IN_SPACE]


class Motion:
    """Lagrange's equations with multipliers, and the constraints, in symbols that a submission can name."""

    def __init__(self, scene):
        by_sympy = BySympy(scene)
        self.q, lagrangian = by_sympy.q, by_sympy.lagrangian
        self.names = names_of(scene)
        self.multipliers = [sp.Symbol(c.get("multiplier", f"lambda_{c['name']}")) for c in scene["constraints"]]
        constraints = [by_sympy.read(c["expression"]) for c in scene["constraints"]]
        slopes = [[c.diff(v) if any(c.has(r) for r in by_sympy.rates) else c.diff(q)
                   for q, v in zip(self.q, by_sympy.rates)] for c in constraints]
        lagrange = [lagrangian.diff(v).diff(T) - lagrangian.diff(q) for q, v in zip(self.q, by_sympy.rates)]
        self.equations = [self.plain(left - sum(m * row[i] for m, row in zip(self.multipliers, slopes)))
                          for i, left in enumerate(lagrange)]
        self.constraints = [self.plain(c) for c in constraints]

    def plain(self, e):
        named = [(q.diff(T, 2), sp.Symbol(n + "_ddot")) for q, n in zip(self.q, self.names)]
        named += [(q.diff(T), sp.Symbol(n + "_dot")) for q, n in zip(self.q, self.names)]
        named += [(q, sp.Symbol(n)) for q, n in zip(self.q, self.names)] + [(T, sp.Symbol("t"))]
        return sp.expand(sp.expand(e.doit()).subs(named))

    def eliminated(self):
        """One equation for every direction that the constraints allow."""
        rows = sp.Matrix([[sp.diff(e, m) for m in self.multipliers] for e in self.equations])
        return [sp.expand(sp.numer(sp.together(sum(w * e for w, e in zip(way, self.equations)))))
                for way in rows.T.nullspace()]


def text(equations):
    return [str(e).replace("**", "^") + " = 0" for e in equations]


def rewritten(motion, rng):
    """Right: scaled, combined, with the multipliers of the other sign or without, the constraints beside or not."""
    kind = rng.randrange(4)
    if kind == 0:
        equations = motion.eliminated()
    else:
        equations = list(motion.equations)
        if rng.random() < 0.5 and all(str(m).startswith("lambda") for m in motion.multipliers):
            equations = [e.subs([(m, -m) for m in motion.multipliers]) for e in equations]
        if kind == 2 and len(equations) > 1:
            i, j = rng.sample(range(len(equations)), 2)
            equations[i] = equations[i] + rng.choice([2, -3]) * equations[j] * sp.Symbol(motion.names[0])
    equations = [sp.expand(rng.choice([1, -2, sp.Rational(1, 3)]) * e) for e in equations]
    if rng.random() < 0.5:
        equations += motion.constraints
    rng.shuffle(equations)
    return text(equations)


def changed(motion, rng):
    """Wrong: one term of one equation, which has others, has another factor."""
    equations = list(motion.equations) if rng.random() < 0.6 else motion.eliminated()
    i = rng.choice([i for i, e in enumerate(equations) if isinstance(e, sp.Add)])
    term = rng.choice(sp.Add.make_args(sp.expand(equations[i])))
    equations[i] = equations[i] + rng.choice([sp.Rational(1, 2), 1, -3, -sp.Rational(1, 2)]) * term
    return text(equations)


class CheckUnderConstraints(Service):
    def graded(self, scene, submissions, of=None):
        expect = {"equation": {"system": scene}} | ({"of": of} if of else {})
        items = [{"id": str(i), "expect": expect, "submitted": s} for i, s in enumerate(submissions)]
        return self.ask("check", {"items": items, "seed": SEED})["items"]

    def test_no_verdict_is_false(self):
        for scene in SCENES:
            rng, motion = random.Random(f"{SEED} {scene['name']}"), Motion(scene)
            for make, wanted in ((rewritten, True), (changed, False)):
                submissions = [make(motion, rng) for _ in range(OF_EACH)]
                for submitted, item in zip(submissions, self.graded(scene, submissions)):
                    with self.subTest(scene=scene["name"], submitted=submitted):
                        self.assertIs(item["correct"], wanted, item)

    def test_what_the_constraints_say_alone_is_told_as_that(self):
        for submitted in ("x^2 + y^2 = l^2", "x x' + y y' = 0", "x x'' + y y'' + x'^2 + y'^2 = 0"):
            item = self.graded(scenes.PENDULUM_BY_CONSTRAINT, [submitted], "x")[0]
            self.assertIs(item["correct"], False)
            self.assertIn("follows from the constraints alone", item["feedback"][0])

    def test_what_says_nothing_is_told_as_that(self):
        item = self.graded(scenes.PENDULUM_BY_CONSTRAINT, ["0 = 0"], "x")[0]
        self.assertIs(item["correct"], False)
        self.assertIn("says nothing", item["feedback"][0])

    def test_the_sign_of_a_multiplier_is_the_same_everywhere(self):
        pairs = {"+-": False, "-+": False, "++": True, "--": True}
        for (a, b), wanted in pairs.items():
            lines = [f"m x'' = {a} 2 lambda x", f"m y'' = {b} 2 lambda y - m g"]
            self.assertIs(self.graded(scenes.PENDULUM_BY_CONSTRAINT, [lines])[0]["correct"], wanted)

    def test_a_set_that_leaves_something_free_is_wrong(self):
        item = self.graded(scenes.PENDULUM_BY_CONSTRAINT, ["m x'' = 2 lambda x"])[0]
        self.assertIs(item["correct"], False)
        self.assertIn("leave accelerations or multipliers free", item["feedback"][0])


if __name__ == "__main__":
    unittest.main()
