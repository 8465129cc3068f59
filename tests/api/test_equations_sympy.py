"""The printed equations, read back by SymPy, say what SymPy derives from the printed Lagrangian, what a hand
derivation says and what the service itself computes."""

import functools
import math
import pathlib
import random
import sys
import unittest
import xml.etree.ElementTree

import mpmath
import sympy
from sympy.parsing.sympy_parser import parse_expr

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from hand_derivations import ACCELERATIONS as HAND  # noqa: E402
from service import TEXTBOOK, Service, strict_json, textbook_scene  # noqa: E402

DIGITS = 30
EXACT = mpmath.mpf("1e-22")  # two forms of one formula, evaluated with 30 digits, of which cancellation takes 8
DOUBLE = 1e-12  # a formula evaluated in double precision: some thousand roundings
STATES = 3
CATALOGUE = list(HAND)
WITH_ROUTHIAN = {"free_spin_pendulum", "kepler", "magnetic_particle", "spherical_pendulum"}
FUNCTIONS = {name: getattr(sympy, name) for name in ("Rational", "Integer", "Float", "Symbol", "Eq", "sin", "cos",
                                                     "tan", "sqrt", "exp", "log", "pi", "asin", "acos", "atan")}


class Sheet:
    """The answer of /v1/equations for one system, with the symbols of its scene."""

    def __init__(self, system, scene, printed):
        self.system = system
        self.scene = scene
        self.printed = printed

    @functools.cached_property
    def coordinates(self):
        return [coordinate["name"] for coordinate in self.scene["coordinates"]]

    @functools.cached_property
    def symbols(self):
        names = ["t"]
        names += [entry["name"] for key in ("parameters", "inputs") for entry in self.scene.get(key, [])]
        for q in self.coordinates:
            names += [q, q + "_dot", q + "_ddot", "p_" + q]
        names += list((self.printed["dimensionless"] or {"groups": {}})["groups"])
        return {name: sympy.Symbol(name) for name in names}

    def of(self, *suffixes):
        return [self.symbols[q + suffix] for suffix in suffixes for q in self.coordinates]

    @functools.lru_cache(maxsize=None)
    def read(self, text):
        expression = parse_expr(text, local_dict=self.symbols, global_dict=dict(FUNCTIONS))
        assert expression.free_symbols <= set(self.symbols.values()), (text, expression.free_symbols)
        return expression

    def states(self):
        """Seeded values of every symbol but the accelerations, momenta and groups that others give."""
        generator = random.Random(20250 + len(self.coordinates) + len(self.symbols))
        for _ in range(STATES):
            yield {name: generator.choice((-1, 1)) * generator.uniform(0.3, 2) if name.endswith(("dot", "_t")) else
                   generator.uniform(0.2, 1.3) for name in self.symbols}


@functools.lru_cache(maxsize=None)
def evaluator(expression):
    names = sorted(symbol.name for symbol in expression.free_symbols)
    with mpmath.workdps(DIGITS):
        return names, sympy.lambdify([sympy.Symbol(name) for name in names], expression, "mpmath")


def value(expression, state):
    """At a state, with DIGITS digits."""
    names, function = evaluator(expression)
    with mpmath.workdps(DIGITS):
        return mpmath.mpf(function(*(mpmath.mpf(state[name]) for name in names)))


class Names:
    """A state whose values are read as attributes, with DIGITS digits."""

    def __init__(self, state):
        for name, number in state.items():
            setattr(self, name, mpmath.mpf(number))


def expressions_of(sheet):
    """Every expression of an answer, with the way to it."""
    for name in ("T", "V", "L", "jacobi_integral", "hamiltonian"):
        if sheet[name] is not None:
            yield name, sheet[name]
    for name in ("generalized_forces", "accelerations", "momenta"):
        yield from ((f"{name}/{key}", text) for key, text in (sheet[name] or {}).items())
    for equation in sheet["equations_of_motion"]:
        for key in ("left", "right", "divided_by"):
            yield f"equations_of_motion/{equation['coordinate']}/{key}", equation[key]
    for i, row in enumerate(sheet["mass_matrix"]):
        yield from ((f"mass_matrix/{i}/{j}", text) for j, text in enumerate(row))
    for name in ("conserved", "validity"):
        yield from ((f"{name}/{entry['name']}", entry["value"]) for entry in sheet[name])
    if sheet["routhian"]:
        yield "routhian/R", sheet["routhian"]["R"]
        yield from ((f"routhian/{key}", text) for key, text in sheet["routhian"]["rates"].items())
    if sheet["dimensionless"]:
        for name in ("energy_unit", "time_unit", "L"):
            yield f"dimensionless/{name}", sheet["dimensionless"][name]
        yield from ((f"dimensionless/{key}", text) for key, text in sheet["dimensionless"]["groups"].items())


def of_each_system(test):
    """The test for every system of the catalogue and every textbook scene, with its sheet."""

    @functools.wraps(test)
    def run(self):
        for name in CATALOGUE + TEXTBOOK:
            with self.subTest(name):
                test(self, name, self.sheet(name))

    return run


class PrintedEquations(Service):
    sheets = {}

    def sheet(self, name):
        if name not in self.sheets:
            self.sheets[name] = self.read_sheet(name)
        return self.sheets[name]

    def read_sheet(self, name):
        system, scene = name, None
        if name in CATALOGUE:
            scene = strict_json(self.raw("GET", f"/v1/systems/{name}").data)["scene"]
        else:
            system = scene = textbook_scene(name)
        return Sheet(system, scene, self.ask("equations", {"system": system, "form": "sympy"}))

    def assert_equal(self, actual, expected, scale=0, tolerance=EXACT, what=None):
        """To `tolerance` of the larger of `expected` and `scale`, the size of what was added up."""
        with mpmath.workdps(DIGITS):
            actual, expected, scale = (mpmath.mpf(number) for number in (actual, expected, scale))
            self.assertLessEqual(abs(actual - expected), tolerance*max(abs(expected), abs(scale)), what)

    def derived(self, sheet):
        """d/dt of dL/dq_dot minus dL/dq, and the parts that size it: SymPy's, from the printed L."""
        L, t = sheet.read(sheet.printed["L"]), sheet.symbols["t"]
        q, v, a = sheet.of(""), sheet.of("_dot"), sheet.of("_ddot")
        for qi, vi in zip(q, v):
            p = L.diff(vi)
            yield ([p.diff(qj)*vj for qj, vj in zip(q, v)] + [p.diff(vj)*aj for vj, aj in zip(v, a)]
                   + [p.diff(t), -L.diff(qi)])

    @of_each_system
    def test_printed_equations_are_euler_lagrange_of_the_printed_lagrangian(self, _, sheet):
        for parts, equation in zip(self.derived(sheet), sheet.printed["equations_of_motion"]):
            left, right, divisor = (sheet.read(equation[key]) for key in ("left", "right", "divided_by"))
            force = sheet.read(sheet.printed["generalized_forces"][equation["coordinate"]])
            self.assertEqual(sheet.read(equation["equation"]), sympy.Eq(left, right))
            for state in sheet.states():
                values = [value(part, state) for part in parts]
                with mpmath.workdps(DIGITS):
                    self.assert_equal(value(left*divisor, state), sum(values), sum(map(abs, values)))
                self.assert_equal(value(right*divisor, state), value(force, state))

    @of_each_system
    def test_solved_accelerations_satisfy_euler_lagrange(self, _, sheet):
        solved = {name: sheet.read(text) for name, text in sheet.printed["accelerations"].items()}
        forces = [sheet.read(sheet.printed["generalized_forces"][q]) for q in sheet.coordinates]
        for state in sheet.states():
            state |= {name: value(expression, state) for name, expression in solved.items()}
            for parts, force in zip(self.derived(sheet), forces):
                values = [value(part, state) for part in parts]
                with mpmath.workdps(DIGITS):
                    self.assert_equal(sum(values), value(force, state), sum(map(abs, values)))

    @of_each_system
    def test_accelerations_are_those_of_the_hand_derivation(self, name, sheet):
        if name in HAND:
            for state in sheet.states():
                with mpmath.workdps(DIGITS):
                    expected = HAND[name](Names(state))
                self.assertEqual(set(expected), set(sheet.coordinates))
                for q, number in expected.items():
                    text = sheet.printed["accelerations"][q + "_ddot"]
                    self.assert_equal(value(sheet.read(text), state), number, 1, what=q)

    @of_each_system
    def test_momenta_mass_matrix_jacobi_integral_and_lagrangian_fit_together(self, _, sheet):
        printed = sheet.printed
        L, v = sheet.read(printed["L"]), sheet.of("_dot")
        pairs = [(printed["momenta"]["p_" + q], L.diff(vi)) for q, vi in zip(sheet.coordinates, v)]
        pairs += [(printed["mass_matrix"][i][j], L.diff(vi, vj)) for i, vi in enumerate(v) for j, vj in enumerate(v)]
        pairs += [(printed["jacobi_integral"], sum(vi*L.diff(vi) for vi in v) - L)]
        if printed["T"] is None:
            self.assertIn("T", printed["reasons"])
            self.assertIn("V", printed["reasons"])
        else:
            pairs += [(printed["L"], sheet.read(printed["T"]) - sheet.read(printed["V"]))]
        for text, expected in pairs:
            for state in sheet.states():
                self.assert_equal(value(sheet.read(text), state), value(expected, state), 1, what=text)

    @of_each_system
    def test_hamiltonian_at_the_momenta_is_the_jacobi_integral(self, _, sheet):
        hamiltonian, jacobi = (sheet.read(sheet.printed[key]) for key in ("hamiltonian", "jacobi_integral"))
        self.assertFalse(hamiltonian.free_symbols & set(sheet.of("_dot")))
        for state in sheet.states():
            expected = value(jacobi, state)
            state |= {p: value(sheet.read(text), state) for p, text in sheet.printed["momenta"].items()}
            self.assert_equal(value(hamiltonian, state), expected, 1)

    @of_each_system
    def test_ignorable_coordinates_are_absent_from_the_lagrangian_and_feel_no_force(self, _, sheet):
        L = sheet.read(sheet.printed["L"])
        expected = [q for q in sheet.coordinates if sheet.symbols[q] not in L.free_symbols
                    and sheet.printed["generalized_forces"][q] == "0"]
        self.assertEqual(sheet.printed["ignorable_coordinates"], expected)

    @of_each_system
    def test_routhian_is_the_lagrangian_less_the_ignored_momenta_times_their_rates(self, name, sheet):
        routhian = sheet.printed["routhian"]
        self.assertEqual(routhian is not None, name in WITH_ROUTHIAN)
        if routhian is None:
            self.assertIn("routhian", sheet.printed["reasons"])
            return
        self.assertEqual(routhian["ignored"], sheet.printed["ignorable_coordinates"])
        R, L = sheet.read(routhian["R"]), sheet.read(sheet.printed["L"])
        for state in sheet.states():
            given = dict(state)
            given |= {p: value(sheet.read(text), state) for p, text in sheet.printed["momenta"].items()}
            for rate, text in routhian["rates"].items():
                self.assert_equal(value(sheet.read(text), given), state[rate])
            with mpmath.workdps(DIGITS):
                expected = value(L, state) - sum(given["p_" + q]*state[q + "_dot"] for q in routhian["ignored"])
            self.assert_equal(value(R, given), expected, 1)
            self.assertFalse(R.free_symbols & {sheet.symbols[q + "_dot"] for q in routhian["ignored"]})

    @of_each_system
    def test_what_is_called_conserved_does_not_change_along_the_motion(self, _, sheet):
        q, v, t = sheet.of(""), sheet.of("_dot"), sheet.symbols["t"]
        a = [sheet.read(sheet.printed["accelerations"][name + "_ddot"]) for name in sheet.coordinates]
        for quantity in sheet.printed["conserved"]:
            C = sheet.read(quantity["value"])
            parts = [C.diff(x)*rate for x, rate in zip(q + v, v + a)] + [C.diff(t)]
            for state in sheet.states():
                values = [value(part, state) for part in parts]
                with mpmath.workdps(DIGITS):
                    self.assert_equal(sum(values), 0, sum(map(abs, values)), what=quantity["name"])
        if not any(quantity["name"] in ("energy", "h") for quantity in sheet.printed["conserved"]):
            self.assertIn("energy_not_conserved", sheet.printed["reasons"])

    @of_each_system
    def test_dimensionless_lagrangian_times_the_unit_of_energy_is_the_lagrangian(self, name, sheet):
        form = sheet.printed["dimensionless"]
        if form is None:
            self.assertIn("dimensionless", sheet.printed["reasons"])
            self.assertNotIn(name, CATALOGUE)
            return
        hat, L = sheet.read(form["L"]), sheet.read(sheet.printed["L"])
        self.assertFalse(hat.free_symbols & {sheet.symbols[unit] for unit in form["set_to_one"]})
        for state in sheet.states():
            energy, time = (value(sheet.read(form[key]), state) for key in ("energy_unit", "time_unit"))
            with mpmath.workdps(DIGITS):
                length = time*mpmath.sqrt(energy/mpmath.mpf(state[form["set_to_one"][0]]))  # a mass is first
                units = {c["name"]: length if c["unit"] == "m" else 1 for c in sheet.scene["coordinates"]}
                scaled = {"t": state["t"]/time}
                for q in sheet.coordinates:
                    scaled |= {q: state[q]/units[q], q + "_dot": state[q + "_dot"]*time/units[q]}
            for group, text in form["groups"].items():
                scaled[group] = value(sheet.read(text), state)
            self.assertLessEqual({symbol.name for symbol in hat.free_symbols}, scaled.keys())
            with mpmath.workdps(DIGITS):
                self.assert_equal(energy*value(hat, scaled), value(L, state), 1)

    @of_each_system
    def test_the_service_computes_the_numbers_of_its_printed_formulas(self, _, sheet):
        printed = sheet.printed
        for state in sheet.states():
            def these(key):
                return {entry["name"]: state[entry["name"]] for entry in sheet.scene.get(key, [])}
            computed = self.ask("energy", {"system": sheet.system, "parameters": these("parameters"),
                                           "inputs": these("inputs"), "t": state["t"],
                                           "initial": {s.name: state[s.name] for s in sheet.of("", "_dot")}})
            pairs = [("L", "L"), ("h", "jacobi_integral"), ("H", "jacobi_integral")]
            pairs += [(name, name) for name in ("T", "V") if printed[name] is not None]
            scale = max(abs(computed[key]) for key, _ in pairs)
            for key, name in pairs:
                self.assert_equal(computed[key], value(sheet.read(printed[name]), state), scale, DOUBLE, key)
            for p, text in printed["momenta"].items():
                self.assert_equal(computed[p], value(sheet.read(text), state), scale, DOUBLE, p)
            scale = max(map(abs, computed["accelerations"].values()))
            self.assertEqual(computed["accelerations"].keys(), printed["accelerations"].keys())
            for name, text in printed["accelerations"].items():
                state[name] = value(sheet.read(text), state)
                self.assert_equal(computed["accelerations"][name], state[name], scale, DOUBLE, name)
            for entry in printed["validity"]:
                expected = value(sheet.read(entry["value"]), state)
                self.assert_equal(computed["validity"][entry["name"]], expected, scale, DOUBLE, entry["name"])
            self.assertEqual([entry["name"] for entry in computed["conserved"]],
                             [entry["name"] for entry in printed["conserved"]])
            for numeric, entry in zip(computed["conserved"], printed["conserved"]):
                expected = value(sheet.read(entry["value"]), state)
                self.assert_equal(numeric["value"], expected, 10*max(1, abs(computed["L"])), DOUBLE, entry["name"])

    @of_each_system
    def test_parts_of_the_kinetic_energy_are_of_degree_two_one_and_none_in_the_velocities(self, _, sheet):
        if sheet.printed["T"] is None:
            return
        T = sheet.read(sheet.printed["T"])
        state = next(iter(sheet.states()))
        velocities = {s.name: state[s.name] for s in sheet.of("_dot")}
        rest, back = (state | {n: f*x for n, x in velocities.items()} for f in (0, -1))
        computed = self.ask("energy", {
            "system": sheet.system, "t": state["t"], "initial": {s.name: state[s.name] for s in sheet.of("", "_dot")},
            "parameters": {entry["name"]: state[entry["name"]] for entry in sheet.scene["parameters"]}})
        t, t_rest, t_back = (value(T, s) for s in (state, rest, back))
        self.assert_equal(computed["T0"], t_rest, t, DOUBLE)
        self.assert_equal(computed["T1"], (t - t_back)/2, t, DOUBLE)
        self.assert_equal(computed["T2"], (t + t_back)/2 - t_rest, t, DOUBLE)

    @of_each_system
    def test_text_form_reads_as_the_same_formulas(self, _, sheet):
        text = self.ask("equations", {"system": sheet.system, "form": "text"})
        state = next(iter(sheet.states()))
        for (where, plain), (same, other) in zip(expressions_of(text), expressions_of(sheet.printed), strict=True):
            self.assertEqual(where, same)
            read = parse_expr(plain.replace("^", "**"), local_dict=sheet.symbols, global_dict=dict(FUNCTIONS))
            self.assert_equal(value(read, state), value(sheet.read(other), state), 1, what=where)

    @of_each_system
    def test_every_other_form_writes_the_same_sheet_and_mathml_is_xml(self, _, sheet):
        places = [where for where, _ in expressions_of(sheet.printed)]
        for form in ("latex", "mathml", "maxima", "c"):
            printed = self.ask("equations", {"system": sheet.system, "form": form})
            found = list(expressions_of(printed))
            self.assertEqual([where for where, _ in found], places)
            found += [(e["coordinate"], e["equation"]) for e in printed["equations_of_motion"]]
            for where, text in found:
                self.assertTrue(text.strip(), where)
                if form == "mathml":
                    root = xml.etree.ElementTree.fromstring(text)
                    self.assertEqual(root.tag, "{http://www.w3.org/1998/Math/MathML}math", where)
                if form == "latex":
                    self.assertEqual(text.count("{"), text.count("}"), where)
                    self.assertEqual(text.count(r"\left"), text.count(r"\right"), where)

    def test_a_wrong_sign_would_be_seen(self):
        sheet = self.sheet("cart_pendulum")
        text = sheet.printed["accelerations"]["x_ddot"].replace("- k*x", "+ k*x")
        self.assertNotEqual(text, sheet.printed["accelerations"]["x_ddot"])
        state = next(iter(sheet.states()))
        with self.assertRaises(AssertionError):
            self.assert_equal(value(sheet.read(text), state), HAND["cart_pendulum"](Names(state))["x"], 1)
        self.assertTrue(math.isfinite(value(sheet.read(text), state)))


if __name__ == "__main__":
    unittest.main()
