"""/v1/check gives no false verdict: right formulas and equations rewritten by SymPy, and wrong ones with one slip
or two.

The seed and the number of variants can be set, QDOT_SEED and QDOT_VARIANTS: by default a few hundred, and
`QDOT_VARIANTS=2500` is the whole, a thousand of each kind and more.
"""

import json
import os
import pathlib
import random
import re
import sys
import unittest

import sympy as sp
from sympy.simplify.fu import TR5, TR6, TR7, TR8, TR9, TR22

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.extend([str(ROOT / "tests" / "support"), str(ROOT / "tests" / "server")])

from service import TEXTBOOK, Service, textbook_scene  # noqa: E402

VARIANTS = int(os.environ.get("QDOT_VARIANTS", "240"))
SEED = int(os.environ.get("QDOT_SEED", "1"))
LONGEST = 1500  # characters of a formula that SymPy rewrites in good time
GREEK = ("theta", "phi", "psi", "gamma", "omega", "Omega", "alpha", "beta", "mu", "rho", "lambda")


def latex_name(name):
    dots, base = 0, name
    for ending, count in (("_ddot", 2), ("_dot", 1)):
        if base.endswith(ending):
            base, dots = base.removesuffix(ending), count
            break
    letters, digits = re.fullmatch(r"(.*?)_?(\d*)", base).groups()
    text = "\\" + letters if letters in GREEK else letters
    text += f"_{{{digits}}}" if digits else ""
    return [text, rf"\dot{{{text}}}", rf"\ddot{{{text}}}"][dots]


class Formula:
    """A formula, or the residual of an equation, with its system."""

    def __init__(self, label, system, names, value, **expect):
        self.label, self.system, self.names, self.value, self.expect = label, system, names, value, expect

    def item(self, value, style):
        text = self.written(value, style)
        kind = "equation" if "coordinate" in self.expect else "expression"
        expect = {kind: {"system": self.system}, "of": self.expect.get("coordinate") or self.expect["of"]}
        return {"expect": expect, "submitted": text}

    def written(self, value, style):
        if "coordinate" not in self.expect:
            return self.one(value, style)
        terms = sp.Add.make_args(sp.sympify(value))
        left = [t for t in terms if any(str(s).endswith("_ddot") for s in t.free_symbols)]
        right = [t for t in terms if t not in left]
        return f"{self.one(sp.Add(*left), style)} = {self.one(-sp.Add(*right), style)}"

    def one(self, value, style):
        if style == "latex":
            return sp.latex(value, symbol_names={s: latex_name(str(s)) for s in value.free_symbols})
        text = str(value)
        if style == "primes":
            text = re.sub(r"(\w+?)_ddot\b", r"\1''", text)
            text = re.sub(r"(\w+?)_dot\b", r"\1'", text)
        if style == "blanks":
            text = text.replace("**", "^").replace("*", " ")
        return text


class Variants(Service):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.random = random.Random(SEED)
        cls.formulas = list(cls.all_formulas(cls))

    def all_formulas(self):
        listed = json.loads(self.raw(self, "GET", "/v1/systems").data)["systems"]
        for system in [entry["name"] for entry in listed] + [textbook_scene(name) for name in TEXTBOOK]:
            body = json.dumps({"system": system, "form": "sympy"})
            response = self.raw(self, "POST", "/v1/equations", body, {"Content-Type": "application/json"})
            if response.status == 200:
                yield from self.formulas_of(system, json.loads(response.data))

    @staticmethod
    def formulas_of(system, answer):
        label = answer["system"]
        texts = [(answer["T"], {"of": "T"}), (answer["L"], {"of": "L"})]
        texts += [(f"({one['left']}) - ({one['right']})", {"coordinate": one["coordinate"]}) for one in answer["equations_of_motion"]]
        for text, expect in texts:
            if text is None or len(text) > LONGEST or "Abs" in text or "sign" in text or "lambda" in text:
                continue
            names = set(re.findall(r"[A-Za-z_]\w*", text)) - {"sin", "cos", "tan", "sqrt", "exp", "log", "pi", "Rational", "Eq"}
            value = sp.sympify(text, locals={name: sp.Symbol(name, real=True) for name in names})
            yield Formula(label, system, names, value, **expect)

    # --- right ones ------------------------------------------------------------------------------------------------

    def rewritten(self, value):
        ways = [sp.expand, sp.factor, sp.expand_trig, sp.together, lambda e: sp.expand(sp.expand_trig(e)), TR8, TR5, TR6,
                TR7, lambda e: sp.collect(sp.expand(e), self.random.choice(sorted(e.free_symbols, key=str))), lambda e: TR9(sp.expand(e)),
                sp.trigsimp if len(str(value)) < 200 else sp.expand, TR22 if len(str(value)) < 200 else sp.expand, lambda e: e]
        for way in self.random.sample(ways, 2):
            value = way(value)
        return value

    def scaled(self, formula, value):
        """An equation may be multiplied by what does not vanish."""
        if "coordinate" not in formula.expect:
            return value
        masses = [sp.Symbol(n, real=True) for n in sorted(formula.names & {"m", "M", "l", "k"})]
        return value * self.random.choice([1, 1, -1, 2, sp.Rational(3, 7), *masses, *(1 / x for x in masses)])

    def test_right_ones_are_right(self):
        cases = []
        while len(cases) < VARIANTS // 2:
            formula = self.random.choice(self.formulas)
            value = self.scaled(formula, self.rewritten(formula.value))
            item = formula.item(value, self.random.choice(["text", "latex", "primes", "blanks"]))
            if len(item["submitted"]) < 3800:
                cases.append((formula, item))
        undecided = 0
        for (formula, item), graded in zip(cases, self.graded([item for _, item in cases])):
            with self.subTest(system=formula.label, submitted=item["submitted"]):
                self.assertIsNot(graded["correct"], False, graded["counterexample"])
                undecided += graded["correct"] is None
                if graded["correct"] is None:
                    print("not decided:", formula.label, item["submitted"][:200], graded["format_errors"], graded["feedback"])
        self.assertLessEqual(undecided, len(cases) // 100)

    # --- wrong ones ------------------------------------------------------------------------------------------------

    def slipped(self, formula):
        """(slip, value): one term of the formula changed."""
        terms = list(sp.Add.make_args(sp.expand(formula.value)))
        if len(terms) < 2:
            return None
        slip = self.random.choice(["sign", "factor", "dropped_term", "exponent", "sine_and_cosine", "argument"])
        k = self.random.randrange(len(terms))
        changed = self.changed_term(slip, terms[k])
        if changed is None:
            return None
        return slip, sp.Add(*terms[:k], changed, *terms[k + 1:])

    def changed_term(self, slip, term):
        if slip == "sign":
            return -term
        if slip == "factor":
            return term * self.random.choice([2, sp.Rational(1, 2), 3, sp.Rational(2, 3), sp.Rational(4, 3), sp.Rational(35, 53)])
        if slip == "dropped_term":
            return sp.Integer(0)
        if slip == "exponent":
            symbols = sorted(term.free_symbols, key=str)
            return term * self.random.choice(symbols) ** self.random.choice([1, -1]) if symbols else None
        waves = sorted(term.atoms(sp.sin, sp.cos), key=str)
        if not waves:
            return None
        wave = self.random.choice(waves)
        if slip == "sine_and_cosine":
            return term.subs(wave, (sp.cos if isinstance(wave, sp.sin) else sp.sin)(wave.args[0]))
        return term.subs(wave, wave.func(2 * wave.args[0]))

    def is_wrong(self, formula, value):
        """Whether it is another formula: at a place, and not by a constant of the potential energy."""
        place = {s: sp.Rational(self.random.randint(101, 999), 377) for s in (formula.value - value).free_symbols}
        difference = sp.expand(formula.value - value)
        if not any(str(s).removesuffix("_dot").removesuffix("_ddot") not in ("m", "g") for s in difference.free_symbols):
            return False
        moving = [s for s in difference.free_symbols if self.moves(formula, str(s))]
        if not moving or abs(difference.subs(place).evalf(30)) < 1e-12:
            return False
        if "coordinate" not in formula.expect:
            return True
        # Of equations, only those that no factor makes the right one.
        accelerations = [s for s in formula.value.free_symbols if str(s).endswith("_ddot")]
        if not any(value.diff(a) != 0 for a in accelerations):
            return True
        other = {s: v + sp.Rational(1, 7) for s, v in place.items()}
        ratios = [(value / formula.value).subs({**{s: 1 for s in formula.value.free_symbols | value.free_symbols}, **p}).evalf(30) for p in (place, other)]
        return abs(ratios[0] - ratios[1]) > 1e-9

    @staticmethod
    def moves(formula, name):
        return name == "t" or name.endswith("_dot") or name.endswith("_ddot") or f"{name}_dot" in formula.names or f"{name}_ddot" in formula.names

    def test_wrong_ones_are_wrong_and_their_slip_is_told(self):
        cases = []
        while len(cases) < VARIANTS // 2:
            formula = self.random.choice(self.formulas)
            found = self.slipped(formula)
            if found is None or not self.is_wrong(formula, found[1]):
                continue
            item = formula.item(self.scaled(formula, found[1]), self.random.choice(["text", "latex", "primes", "blanks"]))
            if len(item["submitted"]) < 3800:
                cases.append((formula, found[0], item))
        told = undecided = 0
        for (formula, slip, item), graded in zip(cases, self.graded([item for *_, item in cases])):
            with self.subTest(system=formula.label, expect=formula.expect, slip=slip, submitted=item["submitted"]):
                self.assertIsNot(graded["correct"], True)
                undecided += graded["correct"] is None
                if graded["correct"] is None:
                    print("not decided:", formula.label, item["submitted"][:200], graded["format_errors"], graded["feedback"])
                if graded["diagnosis"] is None:
                    print("not told:", slip, formula.label, formula.expect, item["submitted"][:300])
                else:
                    told += 1
                    self.assertEqual(graded["diagnosis"]["slip"], slip, graded["diagnosis"])
        self.assertLessEqual(undecided, len(cases) // 100)
        self.assertGreaterEqual(told, 0.9 * len(cases))

    # --- two slips -------------------------------------------------------------------------------------------------

    def one_slip_each(self, formula, slip):
        """The formula with one slip of that kind, in every way."""
        right = sp.expand(formula.value)
        terms = sp.Add.make_args(right)
        if slip == "whole_sign":
            return [-right]
        if slip == "gravity":
            return [right.subs(sp.Symbol("g", real=True), -sp.Symbol("g", real=True))]
        if slip in ("small_angles", "sine_and_cosine"):
            small = slip == "small_angles"
            other = {w: (w.args[0] if isinstance(w, sp.sin) else 1) if small else (sp.cos if isinstance(w, sp.sin) else sp.sin)(w.args[0])
                     for w in right.atoms(sp.sin, sp.cos)}
            whole = [right.subs(other, simultaneous=True)]
        else:
            whole = [right - group + changed for group in self.terms_of_one_symbol(right) for changed in self.ways(slip, group, several=True)]
        if slip == "exponent" and "coordinate" in formula.expect:  # of what the equation was divided by, too
            whole = [right - term + term * s ** n for term in terms for s in sorted(right.free_symbols, key=str) for n in (-1, 1)]
        return whole + [right - term + changed for term in terms for changed in self.ways(slip, term)]

    @staticmethod
    def terms_of_one_symbol(right):
        terms = sp.Add.make_args(right)
        groups = [[term for term in terms if symbol in term.free_symbols] for symbol in sorted(right.free_symbols, key=str)]
        return [sp.Add(*group) for group in groups if 1 < len(group) < len(terms)]

    @staticmethod
    def ways(slip, term, several=False):
        if several and slip not in ("sign", "dropped_term"):
            return []
        waves = sorted(term.atoms(sp.sin, sp.cos), key=str)
        if slip in ("sign", "dropped_term"):
            return [-term if slip == "sign" else sp.Integer(0)]
        if slip == "exponent":
            return [term * s ** n for s in [*sorted(term.free_symbols, key=str), *waves] for n in (-2, -1, 1, 2)]
        if slip == "sine_and_cosine":
            return [term.subs(w, (sp.cos if isinstance(w, sp.sin) else sp.sin)(w.args[0])) for w in waves]
        return []

    def explains(self, formula, slip, submitted):
        """Whether the submission is the formula with one slip of that kind; None where that is not looked at."""
        if slip in ("argument", "moment_of_inertia", "whole_factor"):
            return None
        if slip == "factor":  # S - E is a multiple of one term, or r - c E is
            return self.is_multiple_of_a_term(formula, submitted)
        return any(self.agree(formula, changed, submitted) for changed in self.one_slip_each(formula, slip))

    def agree(self, formula, one, other):
        if "coordinate" not in formula.expect:
            return all(abs((one - other).subs(place).evalf(40)) < 1e-20 for place in self.places(one, other))
        in_either = sorted(one.free_symbols | other.free_symbols, key=str)
        varying = ([s for s in in_either if str(s).endswith("_ddot")]
                   or [s for s in in_either if str(s).endswith("_dot")]
                   or [s for s in in_either if self.moves(formula, str(s))])
        wronskian = [one * other.diff(a) - other * one.diff(a) for a in varying]
        return bool(varying) and all(abs(w.subs(place).evalf(40)) < 1e-20 for w in wronskian for place in self.places(one, other))

    def places(self, *values):
        symbols = set().union(*(value.free_symbols for value in values))
        return [{s: sp.Rational(self.random.randint(101, 999), 377) for s in sorted(symbols, key=str)} for _ in range(2)]

    def is_multiple_of_a_term(self, formula, submitted):
        right = sp.expand(formula.value)
        for term in [*sp.Add.make_args(right), *self.terms_of_one_symbol(right)]:
            mu = sp.Symbol("mu")
            if "coordinate" not in formula.expect:
                found = [((submitted - right) / term).subs(place).evalf(40) for place in self.places(submitted, right)]
            else:
                a = next((s for s in sorted(submitted.free_symbols, key=str) if str(s).endswith("_ddot")), None)
                if a is None:
                    return False
                changed = right + mu * term
                rest = submitted * changed.diff(a) - changed * submitted.diff(a)
                found = []
                for place in self.places(submitted, right):
                    line = sp.Poly(rest.subs(place).evalf(40), mu)
                    found.append(-line.coeff_monomial(1) / line.coeff_monomial(mu) if line.coeff_monomial(mu) != 0 else sp.nan)
            if all(mu.is_finite for mu in found) and abs(found[0] - found[1]) < 1e-20:
                return True
        return False

    def test_of_two_slips_none_is_told_that_does_not_explain_the_answer(self):
        cases = []
        while len(cases) < VARIANTS // 2:
            formula = self.random.choice(self.formulas)
            terms = list(sp.Add.make_args(sp.expand(formula.value)))
            if not 2 <= len(terms) <= 12:
                continue
            for k in self.random.sample(range(len(terms)), 2):
                slip = self.random.choice(["sign", "factor", "dropped_term", "exponent", "sine_and_cosine", "argument"])
                terms[k] = self.changed_term(slip, terms[k])
            if None in terms or not self.is_wrong(formula, sp.Add(*terms)):
                continue
            cases.append((formula, sp.Add(*terms), formula.item(sp.Add(*terms), "text")))
        told = refuted = 0
        for (formula, value, item), graded in zip(cases, self.graded([item for *_, item in cases])):
            with self.subTest(system=formula.label, expect=formula.expect, submitted=item["submitted"]):
                self.assertIsNot(graded["correct"], True)
                if graded["diagnosis"] is not None:
                    told += 1
                    self.assertIsNot(self.explains(formula, graded["diagnosis"]["slip"], value), False, graded["diagnosis"])
                elif refuted < 5:  # explains() can say no
                    self.assertIs(self.explains(formula, "sign", value) or self.explains(formula, "factor", value), False)
                    refuted += 1
        self.assertEqual(refuted, 5)
        self.assertLess(told, 0.4 * len(cases))

    def graded(self, items):
        """The results of any number of items."""
        results = []
        for first in range(0, len(items), 50):
            part = [{"id": str(i), **item} for i, item in enumerate(items[first:first + 50])]
            results += self.ask("check", {"items": part})["items"]
        return results


if __name__ == "__main__":
    unittest.main()
