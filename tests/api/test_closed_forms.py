"""Closed forms over HTTP, read by SymPy: against the practice sheet, hand-written matrices and the answers' own numbers."""

import json
import pathlib
import random
import sys
import unittest

import mpmath
import numpy
import sympy

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, strict_json  # noqa: E402
from running_qdot import qdot  # noqa: E402  (service.py names its directory)
from short_scene import DOWN_3D, G, lagrangian, particle, scene  # noqa: E402

SETS = 1000  # of random parameters that a formula is held against
ROUND_OFF = 1e-12  # relative: what double precision leaves of an eigenvalue


def symbols_of(*texts):
    names = {"m", "M", "l", "g", "k", "l0", "r", "R", "Omega", "omega0", "gamma", "theta", "phi", "psi", "a", "b", "c", "F", "E", "A", "B", "D"}
    return {name: sympy.Symbol(name, real=True) for name in names}


def read(form):
    """The formula as SymPy's; `lambda` is a Python word and no name here."""
    return sympy.sympify(form["text"].replace("^", "**"), locals=symbols_of())


def value(form, numbers):
    with mpmath.workdps(40):
        expression = read(form)
        exact = {symbol: mpmath.mpf(repr(numbers[symbol.name])) for symbol in expression.free_symbols}
        return mpmath.mpf(sympy.N(expression.subs(exact), 35))


def same(form, expected):
    names = symbols_of()
    positive = {symbol: sympy.Symbol(name, positive=True) for name, symbol in names.items()}
    return sympy.simplify((read(form) - sympy.sympify(expected, locals=names)).subs(positive)) == 0


ON_A_SHAFT = [["l*sin(theta)"], ["l*sin(theta)", "l*sin(phi)"]]
# Scene, parameter that moves, its range, and the critical values by hand: a bead between a spring and a current, a plate
# pulled in (Nathanson), a loaded double well, two pendulums on a shaft, a molecule torn apart, and polynomials.
CRITICAL = [
    (scene("current", "m kg 1; k N/m 5; a m 1; c J 0.5", "x m 0.1", bodies=[particle("m", "x", "0")],
           potential="k/2*x^2 + c*log((a - x)/a)"), "c", 0.1, 3, ["k*a**2/4"]),
    (scene("plate", "m kg 1; k N/m 5; a m 1; c N*m^2 0.2", "x m 0.1", bodies=[particle("m", "x", "0")],
           potential="k/2*x^2 - c/(a - x)"), "c", 0.1, 3, ["4*k*a**3/27"]),
    (scene("well", "m kg 1; a N/m 3; b N/m^3 2; F N 1", "x m 1", bodies=[particle("m", "x", "0")],
           potential="b*x^4/4 - a*x^2/2 - F*x"), "F", -5, 5, ["-2*a/3*sqrt(a/(3*b))", "2*a/3*sqrt(a/(3*b))"]),
    (scene("shaft", f"m kg 1; l m 1; Omega rad/s 1; {G}", "theta rad 0.1; phi rad 0.1", gravity=DOWN_3D,
           bodies=[particle("m", f"({' + '.join(out)})*cos(Omega*t)", f"({' + '.join(out)})*sin(Omega*t)",
                            f"-({' + '.join(out)})".replace("sin", "cos")) for out in ON_A_SHAFT]),
     "Omega", 1, 4, ["sqrt((2 - sqrt(2))*g/l)"] + 2*["sqrt(sqrt(2)*g/l)"]),  # hanging, then one of the two above
    (scene("atoms", "m kg 1; E J 1; l m 1; F N 1", "r m 1.1", bodies=[particle("m", "r", "0")],
           potential="4*E*((l/r)^12 - (l/r)^6) - F*r"), "F", 0.1, 30, ["504*E/(169*l)*(7/26)**(1/6)"]),
    (scene("morse", "m kg 1; D J 2; a 1/m 1.5; F N 1", "x m 0.2", bodies=[particle("m", "x", "0")],
           potential="D*(1 - exp(-a*x))^2 - F*x"), "F", 0.1, 3, ["D*a/2"]),
    (scene("centrifugal", "m kg 1; A J*m^2 2; B J*m 3; F N 1", "r m 1", bodies=[particle("m", "r", "0")],
           potential="A/r^2 - B/r - F*r"), "F", 0.01, 1, ["B**3/(27*A**2)"]),
    (lagrangian("sextic", "a - 1; b - 2", "x - 1", "x_dot^2/2 - a*x^2/2 - x^6/6 + b*x^4/4"), "a", 0.1, 5,
     ["b**2/4", "b**2/4"]),
]


def by_command(request):
    """Of the command line, which may work longer than a service shared by many."""
    return strict_json(qdot("bifurcations", stdin=json.dumps(request)).stdout)


class ClosedForms(Service):
    def modes(self, system, parameters=None, **more):
        return self.ask("modes", {"system": system, "parameters": parameters or {}} | more)

    def assert_same(self, form, expected):
        self.assertTrue(same(form, expected), (form["text"], expected))

    def test_the_modes_of_the_fourth_problem(self):
        slow, fast = self.modes("cart_pendulum")["modes"]
        self.assertEqual(slow["exact"]["text"], "g/(2*l)")
        self.assertEqual(slow["exact"]["latex"], "\\frac{g}{2 l}")
        self.assertEqual(fast["exact"]["text"], "2*g/l")
        self.assertEqual([slow["exact"]["lambda"]["text"], fast["exact"]["lambda"]["text"]], ["1/2", "2"])
        self.assertEqual({name: form["text"] for name, form in slow["exact"]["shape_scaled"].items()},
                         {"x": "1", "theta": "1"})
        self.assertEqual({name: form["text"] for name, form in fast["exact"]["shape_scaled"].items()},
                         {"x": "1", "theta": "-2"})
        self.assertEqual(fast["exact"]["shape"]["theta"]["text"], "-2/l")
        self.assertIn("k = 2*m*g/l", slow["exact"]["assumes"])
        self.assertIn("M = 2*m", slow["exact"]["assumes"])
        self.assertIn("l > 0", slow["exact"]["assumes"])

    def test_numbers_that_satisfy_the_problems_relation_give_the_same_formulas(self):
        for parameters in ({"M": 1, "m": 0.5, "k": 19.62, "l": 0.5, "g": 9.81}, {"k": "2*m*g/l", "m": "300 g"}):
            slow, fast = self.modes("cart_pendulum", parameters)["modes"]
            self.assertEqual([slow["exact"]["text"], fast["exact"]["text"]], ["g/(2*l)", "2*g/l"])
        slow, _ = self.modes("cart_pendulum", {"k": 19.63, "l": 0.5})["modes"]
        self.assertNotEqual(slow["exact"]["text"], "g/(2*l)")

    def test_the_modes_of_the_fifth_problem(self):
        slow, fast = self.modes("rod_pendulum")["modes"]
        for mode, sign in ((slow, "-"), (fast, "+")):
            self.assertEqual(mode["exact"]["text"], f"(17 {sign} sqrt(217))*g/(4*l)")
            self.assert_same(mode["exact"]["lambda"], f"(17 {sign} sqrt(217))/4")
            other = "+" if sign == "-" else "-"
            self.assert_same(mode["exact"]["shape"]["phi"], f"(1 {other} sqrt(217))/12")
            self.assert_same(mode["exact"]["omega"], f"sqrt((17 {sign} sqrt(217))*g/l)/2")

    def test_one_coordinate(self):
        for system, parameters, expected in (
            ("whirling_pendulum", {"Omega": 3}, "g/l - Omega**2"),
            ("whirling_pendulum", {"Omega": 6}, "Omega**2 - g**2/(l**2*Omega**2)"),
            ("orbiting_pendulum", {"r": 0.7}, "r*omega0**2/l"),
            ("spring_pendulum", {}, "k*g/(k*l0 + m*g)"),
            ("free_spin_pendulum", {}, None),
        ):
            initial = {"psi_dot": 0} if system == "free_spin_pendulum" else {}
            mode = next(m for m in self.modes(system, parameters, initial=initial)["modes"] if m["kind"] == "oscillation")
            self.assert_same(mode["exact"], expected or "g/l")
        upside_down = self.modes("whirling_pendulum", {"Omega": 3}, equilibrium={"theta": "pi"})["modes"][0]
        self.assertEqual(upside_down["exact"]["of"], "rate^2")
        self.assert_same(upside_down["exact"], "Omega**2 + g/l")

    def test_the_place_has_a_formula_too(self):
        found = self.modes("spring_pendulum")["equilibrium"]
        self.assert_same(found["exact"]["l"], "l0 + m*g/k")
        found = self.modes("whirling_pendulum", {"Omega": 6})["equilibrium"]
        self.assert_same(found["exact"]["theta"], "acos(g/(l*Omega**2))")

    def general_forms(self, system, parameters):
        forms = []
        for mode in self.modes(system, parameters)["modes"]:
            if "exact" in mode:
                forms.append(mode["exact"].get("general", mode["exact"]))
        return forms

    def assert_eigenvalues(self, forms, names, matrices, seed):
        """Every formula is an eigenvalue of hand-written matrices (physics of the sheet), all of them together."""
        draw = random.Random(seed)
        functions = [sympy.lambdify([sympy.Symbol(n, real=True) for n in names], read(form), "math") for form in forms]
        for _ in range(SETS):
            numbers = [draw.uniform(0.2, 5) for _ in names]
            mass, stiffness = (numpy.array(a, dtype=float) for a in matrices(*numbers))
            root = numpy.linalg.inv(numpy.linalg.cholesky(mass))
            expected = numpy.linalg.eigvalsh(root @ stiffness @ root.T)
            found = sorted(function(*numbers) for function in functions)
            self.assertEqual(len(found), len(expected))
            for a, b in zip(found, expected):
                self.assertLessEqual(abs(a - b), 1e3*ROUND_OFF*max(abs(expected)), (numbers, found, expected))

    def test_a_cart_at_a_thousand_sets_of_parameters(self):
        forms = self.general_forms("cart_pendulum", {"M": 1.37, "k": 21.7, "m": 0.631, "l": 0.413})
        self.assertEqual(len(forms), 2)
        self.assert_eigenvalues(forms, ["M", "m", "k", "l", "g"], lambda M, m, k, l, g: (
            [[M + m, m*l], [m*l, m*l*l]], [[k, 0], [0, m*g*l]]), 4)

    def test_a_rod_with_a_string_at_a_thousand_sets_of_parameters(self):
        self.assert_eigenvalues(self.general_forms("rod_pendulum", {}), ["m", "l", "g"], lambda m, l, g: (
            [[4/3*m*l*l, m*l*l], [m*l*l, m*l*l]], [[3/2*m*g*l, 0], [0, m*g*l]]), 5)

    def test_a_spring_pendulum_at_a_thousand_sets_of_parameters(self):
        forms = self.general_forms("spring_pendulum", {})
        self.assert_eigenvalues(forms, ["m", "k", "l0", "g"], lambda m, k, l0, g: (
            [[m, 0], [0, m*(l0 + m*g/k)**2]], [[k, 0], [0, m*g*(l0 + m*g/k)]]), 6)

    def test_formulas_agree_with_the_numbers_beside_them(self):
        draw = random.Random(11)
        shown = 0
        for _ in range(60):
            system = draw.choice(["cart_pendulum", "spring_pendulum", "rod_pendulum", "whirling_pendulum",
                                  "orbiting_pendulum", "rod_spring_pendulum", "compass_walker"])
            given = {name: round(draw.uniform(0.3, 4), draw.choice([0, 1, 3])) or 1
                     for name in self.ask_parameters(system) if draw.random() < 0.7}
            if "gamma" in given:
                given["gamma"] = 0.05
            found = self.modes(system, given)
            numbers = found["request"]["parameters"]
            for mode in found["modes"]:
                if "exact" not in mode:
                    continue
                shown += 1
                what = mode["exact"]["of"].removesuffix("^2")
                error = mode["error"] if what == "omega" else mode.get("rate_error", mode["error"])
                square = value(mode["exact"], numbers)
                self.assertLessEqual(abs(mpmath.sqrt(square) - mode[what]), error*1.01 + 1e-16*mode[what],
                                     (system, given, mode))
                self.assertLessEqual(abs(value(mode["exact"][what], numbers) - mode[what]), 1e-14*mode[what])
                for name, form in mode["exact"].get("shape", {}).items():
                    self.assertLessEqual(abs(value(form, numbers) - mode["shape"][name]),
                                         1e-12*max(1, abs(mode["shape"][name])))
        self.assertGreater(shown, 60)

    def ask_parameters(self, system):
        return self.modes(system)["request"]["parameters"]

    def test_the_spin_that_holds_the_tenth_problem(self):
        expected = "sqrt(3*g*(15*sin(theta) - cos(theta))/(l*(53*sin(2*theta) - 9*cos(2*theta))))"
        for angle in ("30deg", 0.5, "-60deg"):
            found = self.ask("equilibria", {"system": "rotating_l_bar", "solve_for": "Omega", "at": {"theta": angle}})
            self.assertIn("exact", found, found)
            numbers = found["request"]["parameters"] | found["request"]["at"]
            names = symbols_of()
            formula = read(found["exact"])**2 - sympy.sympify(expected, locals=names)**2
            self.assertEqual(sympy.simplify(sympy.expand_trig(formula)), 0)
            self.assertLessEqual(abs(value(found["exact"], numbers) - found["Omega"]), found["error"]*1.01 + 1e-15)
            self.assertTrue(found["all"][1]["exact"]["text"].startswith("-"))

    def test_the_steady_cone_of_the_eighth_problem(self):
        found = self.ask("equilibria", {"system": "free_spin_pendulum", "solve_for": "psi_dot", "at": {"theta": 0.7}})
        difference = read(found["exact"])**2 - sympy.sympify("g*sin(theta)/(l*(1/2 + sin(theta))*cos(theta))", locals=symbols_of())
        self.assertEqual(sympy.simplify(difference), 0)

    def test_the_critical_spin_of_the_sixth_problem(self):
        found = self.ask("bifurcations", {"system": "whirling_pendulum", "parameter": "Omega", "from": 0, "to": 10})
        self.assertEqual([c["exact"]["text"] for c in found["critical"]], ["sqrt(g/l)"])
        found = self.ask("bifurcations", {"system": "whirling_pendulum", "parameter": "l", "from": 0.1, "to": 1})
        self.assert_same(found["critical"][0]["exact"], "g/Omega**2")

    def test_the_critical_values_of_other_problems(self):
        for system, parameter, low, high, expected in CRITICAL:
            for factor in (1, 1.2, 0.9):  # of the others: the same formulas
                others = {p["name"]: factor*float(p["default"]) for p in system["parameters"] if p["name"] != parameter}
                found = by_command({"system": system, "parameter": parameter, "from": low, "to": high, "parameters": others})
                with self.subTest(scene=system["name"], factor=factor):
                    self.assertEqual(len(found["critical"]), len(expected))
                    for critical, by_hand in zip(found["critical"], expected):
                        self.assert_same(critical["exact"], by_hand)
                        off = abs(value(critical["exact"], found["request"]["parameters"]) - critical["value"])
                        self.assertLessEqual(off, critical["error"])

    def test_a_search_reaches_infinity_where_exponentials_overflow_and_forces_are_small(self):
        for name in ("morse", "centrifugal", "atoms"):
            system, parameter, low, high, _ = next(case for case in CRITICAL if case[0]["name"] == name)
            found = by_command({"system": system, "parameter": parameter, "from": low, "to": high})
            self.assertTrue(found["complete"], found.get("reason"))
        system, parameter, *_ = next(case for case in CRITICAL if case[0]["name"] == "centrifugal")
        found = by_command({"system": system, "parameter": parameter, "from": -1, "to": 1})
        self.assertEqual(found["reason"], "At F = 0 an equilibrium appears from or vanishes to r = -infinity. "
                                          "At F = 0 an equilibrium appears from or vanishes to r = infinity.")

    def test_places_that_exponentials_give(self):
        bond = scene("bond", "m kg 1; D J 2; a 1/m 1.5; F N 1", "x m 0.3", bodies=[particle("m", "x", "0")],
                     potential="D*exp(-a*x) + F*x")
        found = self.modes(bond)
        self.assertEqual(found["equilibrium"]["exact"]["x"]["text"], "log(D*a/F)/a")
        self.assert_same(found["modes"][0]["exact"], "a*F/m")

    def test_places_where_a_distance_is_one_of_its_coordinates(self):
        """Hill's points beside a planet, a mass that hangs beside the line of others, and two others on a turning line."""
        for text, parameters, expected in (
                ("(x_dot^2 + y_dot^2)/2 + n*(x*y_dot - y*x_dot) + 3*n^2*x^2/2 + mu/sqrt(x^2 + y^2)", "n - 1; mu - 1",
                 [("x", "-(mu/(3*n^2))^(1/3)"), ("x", "(mu/(3*n^2))^(1/3)")]),
                ("(x_dot^2 + y_dot^2)/2 + 3*n^2*x^2/2 + mu/abs(x) - y^2", "n - 1; mu - 1",
                 [("x", "-(mu/(3*n^2))^(1/3)"), ("x", "(mu/(3*n^2))^(1/3)")]),
                ("(x_dot^2 + y_dot^2)/2 - k*x^2/2 - k*y^2/2 - y^2 - q/sqrt(x^2 + y^2 + d^2)", "k - 1; q - 1; d - 0.1",
                 [("x", "-sqrt(q^(2/3)/k^(2/3) - d^2)"), ("x", "sqrt(q^(2/3)/k^(2/3) - d^2)")])):
            answer = self.ask("equilibria", {"system": lagrangian("place", parameters, "x - 0.6; y - 0.1", text)})
            found = [(q, form["text"]) for one in answer["equilibria"] for q, form in one.get("exact", {}).items() if q == "x"]
            self.assertEqual(found, expected, text)

    def test_unknowns_that_are_equal_or_opposite_are_written_so(self):
        for text, parameters, start, expected in (
                ("(x_dot^2 + y_dot^2)/2 - k*(x^2 + y^2)/2 + q*log(x) + q*log(y) - w*x*y", "k - 1; q - 1; w - 0.2", "x - 0.6; y - 0.1",
                 {"x": "sqrt(q/(k + w))", "y": "sqrt(q/(k + w))"}),
                ("m*(x_dot^2 + y_dot^2)/2 - m*w^2*(x^2 + y^2)/2 - q^2/abs(x - y)", "m - 1; q - 1; w - 0.7", "x - 0.6; y - -0.1",
                 {"x": "(q^2/(4*m*w^2))^(1/3)", "y": "-(q^2/(4*m*w^2))^(1/3)"})):
            answer = self.ask("equilibria", {"system": lagrangian("pair", parameters, start, text)})
            found = [{q: form["text"] for q, form in one["exact"].items() if q != "rate2"} for one in answer["equilibria"]]
            self.assertIn(expected, found)

    def test_places_in_a_lattice_are_told_by_its_phase(self):
        for text, parameters, start, place, square in (
                ("m*x_dot^2/2 - V*cos(q*x)", "m - 1; V - 2; q - 3", "x - 1", "pi/q", "V*q**2/m"),
                ("m*x_dot^2/2 - V*sin(2*pi*x/L)", "m - 1; V - 2; L - 3", "x - 2.1", "3*L/4", "4*pi**2*V/(m*L**2)"),
                ("m*x_dot^2/2 - V*sin(2*pi*x/L)", "m - 1; V - 2; L - 3", "x - 8.1", "11*L/4", "4*pi**2*V/(m*L**2)"),
                ("m*x_dot^2/2 - V*(1 - cos(q*x)) + F*x", "m - 1; V - 2; q - 3; F - 1", "x - 0.1", "asin(F/(V*q))/q", "q*sqrt(V**2*q**2 - F**2)/m")):
            found = self.modes(lagrangian("lattice", parameters, start, text))
            self.assert_same(found["equilibrium"]["exact"]["x"], place)
            self.assert_same(found["modes"][0]["exact"], square)

    def test_angles_of_critical_points_lie_within_a_turn(self):
        """The search is given up at the singularity above; what it has seen elsewhere is the same point, turns away."""
        between = [["0", "R"], ["R*sin(theta)", "-R*cos(theta)"]]
        hoop = scene("hoop", f"m kg 1; R m 1; k N/m 30; l0 m 0.4; {G}", "theta rad 0.1", gravity=["0", "-g"],
                     bodies=[particle("m", *between[1])],
                     springs=[{"stiffness": "k", "between": between, "rest_length": "l0"}])
        found = by_command({"system": hoop, "parameter": "k", "from": 1, "to": 90})
        self.assertEqual([(c["kind"], c["state"]["theta"]) for c in found["critical"]], [("pitchfork", 0)])
        self.assert_same(found["critical"][0]["exact"], "2*m*g/(2*R - l0)")

    def test_the_turning_points_of_the_seventh_problem(self):
        found = self.ask("turning_points", {"system": "orbiting_pendulum"})
        self.assertEqual(found["exact"]["phi_max"]["text"], "1/3*pi")
        self.assertEqual(found["exact"]["phi_max"]["cos"]["text"], "1/2")
        found = self.ask("turning_points", {"system": "orbiting_pendulum", "parameters": {"r": 0.8}})
        self.assert_same(found["exact"]["phi_max"]["cos"], "1 - l/(2*r)")

    def test_the_equation_of_the_eighth_problem(self):
        found = self.ask("turning_points", {"system": "free_spin_pendulum"})
        left = dict(found["exact"]["equation"], text=found["exact"]["equation"]["text"].removesuffix(" = 0"))
        self.assert_same(left, "1/8/(1/2 + sin(theta))**2 - cos(theta) + 1/2")
        self.assert_same(found["exact"]["E"], "-m*g*l/2")
        self.assert_same(found["exact"]["p_psi"], "m*l**2*sqrt(g/l)/2")

    def test_problems_show_them(self):
        for number, pointer, text in ((4, "/modes/0/exact", "g/(2*l)"), (5, "/modes/1/exact", "(17 + sqrt(217))*g/(4*l)")):
            part = strict_json(self.raw("GET", f"/v1/problems/{number}").data)["parts"][0]
            self.assertEqual(part["result"][pointer]["text"], text)


if __name__ == "__main__":
    unittest.main()
