"""What rests, turns steadily and swings on the surfaces of constraints is what it is in coordinates of its own: critical
values with their kinds and formulas, steady motions, small motions with gyroscopic forces and damping."""

import pathlib
import random
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import DOWN, DOWN_3D, G, lagrangian, particle, scene  # noqa: E402

ROUNDING = 4e-16


def turned(radius, rate):
    """A place at a distance from a vertical axis that turns."""
    return f"({radius})*cos({rate}*t)", f"({radius})*sin({rate}*t)"


def on_axes_that_turn(x, y, rate):
    return f"({x})*cos({rate}*t) - ({y})*sin({rate}*t)", f"({x})*sin({rate}*t) + ({y})*cos({rate}*t)"


def pair(name, parameters, constrained, own):
    """The same system with constraints and in coordinates of its own."""
    return [scene(name, parameters, coordinates, **members) for coordinates, members in (constrained, own)]


HOOP = pair(
    "hoop", f"m kg 1; R m 0.5; Omega rad/s 6; {G}",
    ("x m; y m; z m -R", {
        "gravity": DOWN_3D, "bodies": [particle("m", *on_axes_that_turn("x", "y", "Omega"), "z")],
        "constraints": [{"name": "plane", "expression": "y"}, {"name": "hoop", "expression": "x^2 + z^2 - R^2"}]}),
    ("theta rad 0", {
        "gravity": DOWN_3D, "bodies": [particle("m", *turned("R*sin(theta)", "Omega"), "-R*cos(theta)")]}))

PUSHED_HOOP = pair(
    "pushed_hoop", f"m kg 1; R m 0.5; Omega rad/s 7; F N 1; {G}",
    ("x m; z m -R; y m", {
        "gravity": DOWN_3D, "bodies": [particle("m", *on_axes_that_turn("x", "y", "Omega"), "z")],
        "forces": [{"value": "F", "along": "x"}],
        "constraints": [{"name": "plane", "expression": "y"}, {"name": "hoop", "expression": "x^2 + z^2 - R^2"}]}),
    ("theta rad 0", {
        "gravity": DOWN_3D, "potential": "-F*R*sin(theta)",
        "bodies": [particle("m", *turned("R*sin(theta)", "Omega"), "-R*cos(theta)")]}))

TWISTED = pair(
    "twisted_pendulum", f"m kg 1; l m 0.7; tau N*m 2; {G}",
    ("x m; y m -l; theta rad", {
        "gravity": DOWN, "bodies": [particle("m", "x", "y")], "forces": [{"value": "tau", "along": "theta"}],
        "constraints": [{"name": "a", "expression": "x - l*sin(theta)"}, {"name": "b", "expression": "y + l*cos(theta)"}]}),
    ("theta rad", {
        "gravity": DOWN, "bodies": [particle("m", "l*sin(theta)", "-l*cos(theta)")],
        "forces": [{"value": "tau", "along": "theta"}]}))

LINKS = [particle("m", "l*sin(a)", "l*cos(a)"), particle("m", "l*sin(a) + l*sin(b)", "l*cos(a) + l*cos(b)")]
COLUMN = pair(
    "column", "m kg 1; P N 0.2; c N*m 1; l m 1",
    ("a rad; b rad; y m 2*l", {
        "bodies": LINKS, "potential": "c*a^2/2 + c*(b - a)^2/2 + P*y",
        "constraints": [{"name": "top", "expression": "y - l*cos(a) - l*cos(b)"}]}),
    ("a rad; b rad", {"bodies": LINKS, "potential": "c*a^2/2 + c*(b - a)^2/2 + P*l*(cos(a) + cos(b))"}))

TABLE = pair(
    "mass_through_a_hole", f"m kg 1; M kg 2; L m 2; {G}",
    ("r m 1; theta rad 0 4; z m -1", {
        "gravity": DOWN_3D, "bodies": [particle("m", "r*cos(theta)", "r*sin(theta)", "0"), particle("M", "0", "0", "z")],
        "constraints": [{"name": "string", "expression": "r - z - L"}]}),
    ("r m 1; theta rad 0 4", {
        "gravity": DOWN_3D,
        "bodies": [particle("m", "r*cos(theta)", "r*sin(theta)", "0"), particle("M", "0", "0", "r - L")]}))

CONE = pair(
    "conical_pendulum", f"m kg 1; l m 0.7; {G}",
    ("r m l*sin(1); phi rad 0 5; z m -l*cos(1)", {
        "gravity": DOWN_3D, "bodies": [particle("m", "r*cos(phi)", "r*sin(phi)", "z")],
        "constraints": [{"name": "string", "expression": "r^2 + z^2 - l^2"}]}),
    ("theta rad 1; phi rad 0 5", {
        "gravity": DOWN_3D, "bodies": [particle("m", "l*sin(theta)*cos(phi)", "l*sin(theta)*sin(phi)", "-l*cos(theta)")]}))

BOWL = pair(
    "bowl_that_turns", f"m kg 1; a m 1; b m 1.5; c m 0.8; w rad/s 2; {G}",
    ("x m; y m; z m -c", {
        "gravity": DOWN_3D, "bodies": [particle("m", *on_axes_that_turn("x", "y", "w"), "z")],
        "constraints": [{"name": "bowl", "expression": "x^2/a^2 + y^2/b^2 + z^2/c^2 - 1"}]}),
    ("x m; y m", {
        "gravity": DOWN_3D,
        "bodies": [particle("m", *on_axes_that_turn("x", "y", "w"), "-c*sqrt(1 - x^2/a^2 - y^2/b^2)")]}))

OIL = pair(
    "pendulum_in_oil", f"m kg 1; l m 0.7; c kg/s 0.5; {G}",
    ("x m; y m -l", {
        "gravity": DOWN, "bodies": [particle("m", "x", "y")], "dampers": [{"coefficient": "c", "point": ["x", "y"]}],
        "constraints": [{"name": "string", "expression": "x^2 + y^2 - l^2"}]}),
    ("theta rad", {
        "gravity": DOWN, "bodies": [particle("m", "l*sin(theta)", "-l*cos(theta)")],
        "dampers": [{"coefficient": "c", "point": ["l*sin(theta)", "-l*cos(theta)"]}]}))


class SteadyUnderConstraints(Service):
    def assert_near(self, a, b, errors):
        self.assertLessEqual(abs(a - b), errors + ROUNDING*abs(b))

    def critical(self, systems, parameter, first, last, by_angle_alone=None):
        """Those of both scenes, which are the same; a formula may be there only by the scene's own coordinate."""
        with_constraints, own = [
            self.ask("bifurcations", {"system": system, "parameter": parameter, "from": first, "to": last})
            for system in systems]
        self.assertEqual([answer["complete"] for answer in (with_constraints, own)], [True, True], with_constraints)
        self.assertEqual(len(with_constraints["branches"]), len(own["branches"]))
        self.assertEqual(len(with_constraints["critical"]), len(own["critical"]))
        for a, b in zip(with_constraints["critical"], own["critical"]):
            self.assertEqual(a["kind"], b["kind"])
            self.assert_near(a["value"], b["value"], a["error"] + b["error"])
            self.assertLess(a["error"], 1e-13*(1 + abs(a["value"])))
            self.assertEqual(a.get("exact", {}).get("text", by_angle_alone), b.get("exact", {}).get("text"))
        stability = [sorted(set(sum((branch["stability"] for branch in answer["branches"]), [])))
                     for answer in (with_constraints, own)]
        self.assertEqual(*stability)
        return with_constraints

    def test_a_bead_leaves_the_foot_of_a_hoop_at_one_rate(self):
        fork, = self.critical(HOOP, "Omega", 1, 10)["critical"]
        self.assertEqual((fork["kind"], fork["exact"]["text"]), ("pitchfork", "sqrt(g/R)"))
        self.assertEqual(fork["state"]["x"], 0)

    def test_two_places_on_a_hoop_appear_together_where_a_force_pushes(self):
        formula = "(F^(2/3) + m^(2/3)*g^(2/3))^(3/4)/sqrt(m*R)"
        fold, = self.critical(PUSHED_HOOP, "Omega", 1, 12, formula)["critical"]
        self.assertEqual(fold["kind"], "saddle_node")

    def test_a_torque_lifts_a_pendulum_to_the_side_and_no_further(self):
        fold, = self.critical(TWISTED, "tau", 1, 10)["critical"]
        self.assertEqual((fold["kind"], fold["exact"]["text"]), ("saddle_node", "m*l*g"))
        self.assert_near(fold["state"]["x"], 0.7, fold["state_error"]["x"])

    def test_a_column_of_two_links_buckles(self):
        fork, = self.critical(COLUMN, "P", 0.1, 1.5)["critical"]
        self.assertEqual((fork["kind"], fork["exact"]["text"]), ("pitchfork", "(3 - sqrt(5))*c/(2*l)"))

    def test_random_potentials_on_a_circle_have_the_critical_values_of_its_angle(self):
        draw = random.Random(5)
        found = 0
        for _ in range(12):
            a, b, c, d = (round(draw.uniform(-1.5, 1.5), 2) for _ in range(4))
            terms = [f"({a})*X", f"({b})*Y", f"({c})*X^2", f"({d})*X*Y", "p*" + draw.choice(("X", "Y", "X^2", "X*Y", "X^2*Y"))]
            potential = " + ".join(terms)
            on_circle = lagrangian("on_circle", "p - 0.3", "x - 1; y -",
                                   "(x_dot^2 + y_dot^2)/2 - (" + potential.replace("X", "x").replace("Y", "y") + ")",
                                   constraints=[{"name": "circle", "expression": "x^2 + y^2 - 1"}])
            by_angle = lagrangian("by_angle", "p - 0.3", "a -",
                                  "a_dot^2/2 - (" + potential.replace("X", "cos(a)").replace("Y", "sin(a)") + ")")
            by_angle["coordinates"][0]["unit"] = "rad"
            found += len(self.critical((on_circle, by_angle), "p", -3, 3)["critical"])
        self.assertGreater(found, 12)

    def test_branches_lie_on_the_surface(self):
        answer = self.critical(HOOP, "Omega", 1, 10)
        self.assertTrue(answer["branches"])
        for branch in answer["branches"]:
            for x, y, z in zip(branch["x"], branch["y"], branch["z"]):
                self.assertLess(abs(x*x + z*z - 0.25) + abs(y), 1e-14)

    def modes(self, systems):
        return [self.ask("modes", {"system": system}) for system in systems]

    def assert_same_modes(self, systems):
        with_constraints, own = self.modes(systems)
        self.assertEqual(with_constraints["equilibrium"]["stability"], own["equilibrium"]["stability"])
        self.assertEqual([mode["kind"] for mode in with_constraints["modes"]], [mode["kind"] for mode in own["modes"]])
        for a, b in zip(with_constraints["modes"], own["modes"]):
            for name, error in (("omega", "error"), ("rate", "rate_error")):
                if name in b:
                    errors = [mode.get(error) or mode.get("error") or 0 for mode in (a, b)]
                    self.assert_near(a[name], b[name], sum(errors) + 1e-14)
        return with_constraints["modes"]

    def test_a_steady_turn_has_the_modes_of_its_radius(self):
        rigid, swing = self.assert_same_modes(TABLE)
        self.assertEqual(rigid["shape"], {"r": 0, "theta": 1, "z": 0})
        self.assertEqual([(swing["shape"][name]["re"], swing["shape"][name]["im"]) for name in ("r", "z")], [(1, 0), (1, 0)])
        self.assertGreater(swing["shape"]["theta"]["im"], 1)  # slower where it is farther out

    def test_a_conical_pendulum_has_its_modes(self):
        self.assertEqual(len(self.assert_same_modes(CONE)), 2)

    def test_gyroscopic_forces_on_a_surface(self):
        growth, swing = self.assert_same_modes(BOWL)
        self.assertEqual((growth["kind"], swing["kind"]), ("growth", "oscillation"))

    def test_damping_on_a_surface(self):
        decay, = self.assert_same_modes(OIL)
        self.assertAlmostEqual(decay["rate"], 0.25, 15)

    def test_a_bead_on_a_hoop_has_the_formula_of_its_angle(self):
        for system in HOOP:
            at_foot, = self.ask("modes", {"system": system, "parameters": {"Omega": 2}})["modes"]
            self.assertEqual(at_foot["exact"]["text"], "g/R - Omega^2")

    def test_steady_turns_are_found_with_their_momenta(self):
        for systems in (TABLE, CONE):
            with_constraints, own = [self.ask("equilibria", {"system": system}) for system in systems]
            self.assertEqual(with_constraints["complete"], True)
            self.assertEqual(len(with_constraints["equilibria"]), len(own["equilibria"]))
            self.assertTrue(own["equilibria"])
            for a, b in zip(with_constraints["equilibria"], own["equilibria"]):
                self.assertEqual(a["stability"], b["stability"])
                self.assert_near(a["rate2"], b["rate2"], 1e-11)
            for name, momentum in own["momenta"].items():
                self.assert_near(with_constraints["momenta"][name], momentum, 1e-15)

    def test_the_string_pulls_with_the_weight_that_hangs_on_it(self):
        turn, = self.ask("equilibria", {"system": TABLE[0]})["equilibria"]
        self.assert_near(turn["multipliers"]["lambda_string"], -2*9.81, turn["error"]["lambda_string"])
        rate = turn["state"]["theta_dot"]
        self.assertAlmostEqual(turn["state"]["r"]*rate*rate, 2*9.81, 12)


if __name__ == "__main__":
    unittest.main()
