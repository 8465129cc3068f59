"""Equilibria, modes and critical values where something is on the verge: kinks, forces that fall off, places a few
units in the last place from critical, eigenvalues that coincide. The second road is mpmath at 40 digits, from the
decimals as they are typed."""

import math
import pathlib
import random
import sys
import unittest

import mpmath as mp

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

mp.mp.dps = 40
EXACT = mp.mpf(10) ** -30  # what the second road itself may be off


def number(value):
    return mp.mpf(repr(value))


def text(value):
    return repr(value) if value >= 0 else f"({value!r})"


def particle(potential, parameters=(), unit="1", **coordinate):
    """One coordinate x of unit mass in a potential, all without dimension."""
    return {"name": "particle",
            "parameters": [{"name": "J", "unit": "J", "default": "1"}, {"name": "T", "unit": "s", "default": "1"}]
            + [{"name": name, "unit": "1", "default": repr(value)} for name, value in parameters],
            "coordinates": [{"name": "x", "unit": unit} | coordinate],
            "lagrangian": f"J*((T*x_dot)^2/2 - ({potential}))"}


def chain(stiffness, damping):
    """Unit masses on a line, x'' = -C x' - K x."""
    n = len(stiffness)

    def force(i):
        terms = [f"-{text(stiffness[i][j])}*k*x{j}" for j in range(n) if stiffness[i][j]]
        terms += [f"-{text(damping[i][j])}*c*x{j}_dot" for j in range(n) if damping[i][j]]
        return " + ".join(terms) or "0*k*x0"

    return {"name": "chain",
            "parameters": [{"name": "m", "unit": "kg", "default": "1"}, {"name": "k", "unit": "N/m", "default": "1"},
                           {"name": "c", "unit": "N*s/m", "default": "1"}],
            "coordinates": [{"name": f"x{i}", "unit": "m"} for i in range(n)],
            "points": [{"name": f"p{i}", "components": [f"x{i}", "0"]} for i in range(n)],
            "bodies": [{"kind": "particle", "name": f"b{i}", "mass": "m", "position": f"p{i}"} for i in range(n)],
            "forces": [{"name": f"f{i}", "vector": [force(i), "0"], "point": f"p{i}"} for i in range(n)]}


class Statics(Service):
    def equilibria(self, scene):
        return self.ask("equilibria", {"system": scene})

    def assert_lists(self, found, expected):
        """All of `expected`, (place, stability), and nothing else; clusters may stand for several."""
        left = list(expected)
        for entry in found["equilibria"]:
            error = number(entry["error"]["x"]) + EXACT
            hits = [e for e in left if abs(e[0] - number(entry["state"]["x"])) <= error]
            if "note" not in entry:
                self.assertEqual(len(hits), 1, (entry, expected))
                self.assertIn(entry["stability"], (hits[0][1], "neutral"))
                if entry["stability"] == "neutral":
                    self.assertTrue(entry["nonlinear"])
            left = [e for e in left if e not in hits]
        if found["complete"]:
            self.assertEqual(left, [], found)
        else:
            self.assertTrue(found["reason"])


class FarOut(Statics):
    def test_forces_that_fall_off_have_no_equilibrium_at_infinity(self):
        numbers = random.Random(1)
        for _ in range(12):
            a, b = (round(numbers.uniform(0.2, 3), 4) for _ in range(2))
            s = round(numbers.uniform(-3, 3), 4)
            a_text, b_text, s_text = text(a), text(b), text(s)
            place = number(s)
            for potential, expected in ((f"{a_text}*exp({s_text}*x)", []),
                                        (f"{a_text}*(1 - exp(-{b_text}*(x - {s_text})))^2", [(place, "stable")]),
                                        (f"-{a_text}*exp(-((x - {s_text})/{b_text})^2)", [(place, "stable")]),
                                        (f"{a_text}*tanh({b_text}*x)", [])):
                with self.subTest(potential):
                    found = self.equilibria(particle(potential))
                    self.assertIs(found["complete"], True)
                    self.assert_lists(found, expected)

    def test_a_region_that_is_not_decided_is_named(self):
        found = self.equilibria(particle("sqrt(1 + x^2) - x"))
        self.assertEqual(found["equilibria"], [])
        self.assertIs(found["complete"], False)
        self.assertTrue(found["reason"])

    def test_of_infinitely_many_the_nearest_are_listed(self):
        found = self.equilibria(particle("-cos(x)"))
        self.assertIs(found["complete"], False)
        self.assertEqual(min(abs(entry["state"]["x"]) for entry in found["equilibria"]), 0)


class NearlyCritical(Statics):
    def test_none_is_missing_a_few_units_past_a_pitchfork_a_fold_or_a_crossing(self):
        numbers = random.Random(2)
        for _ in range(40):
            a, c = (round(numbers.uniform(0.3, 3), 3) for _ in range(2))
            b = c
            for _ in range(numbers.choice([0, 1, 3, 5, 40])):
                b = math.nextafter(b, math.inf)
            past = mp.mpf(b) - mp.mpf(c)  # the numbers that the service works with
            branch = mp.sqrt(past / mp.mpf(a))
            for potential, places in (("a*x^4/4 - (b - c)*x^2/2", {0, branch, -branch}),
                                      ("a*x^3/3 - (b - c)*x", {branch, -branch}),
                                      ("a*x^3/3 - (b - c)*x^2/2", {0, past / mp.mpf(a)})):
                with self.subTest(potential, a=a, b=b, c=c):
                    found = self.equilibria(particle(potential, (("a", a), ("b", b), ("c", c))))
                    for place in places:
                        inside = [e for e in found["equilibria"]
                                  if abs(e["state"]["x"] - place) <= e["error"]["x"] + 1e-30]
                        self.assertTrue(inside or not found["complete"], (place, found["equilibria"]))


class Kinks(Statics):
    def test_corners_are_equilibria_with_the_stability_of_their_sides(self):
        numbers = random.Random(3)
        for _ in range(40):
            a, c, d = (round(numbers.uniform(0.2, 3), 3) for _ in range(3))
            s = round(numbers.uniform(-3, 3), 3)
            mp_a, mp_c, mp_d, kink = map(number, (a, c, d, s))
            smooth = f"{text(a)}*x^2/2 - {text(c)}*x"
            right, left = (mp_c - mp_d) / mp_a, (mp_c + mp_d) / mp_a
            expected = [(right if right > kink else left if left < kink else kink, "stable")]
            with self.subTest(a=a, c=c, d=d, s=s):
                self.assert_lists(self.equilibria(particle(f"{smooth} + {text(d)}*abs(x - {text(s)})")), expected)
                expected = [(x, "stable") for x in (right,) if x < kink] + [(x, "stable") for x in (left,) if x > kink]
                if right < kink < left:
                    expected.append((kink, "unstable"))
                self.assert_lists(self.equilibria(particle(f"{smooth} - {text(d)}*abs(x - {text(s)})")), expected)

    def test_a_corner_hides_no_smooth_equilibrium(self):
        found = self.equilibria(particle("0.7*(atan(x) + 1.8*x - 2.4*abs(x + 1.71))"))
        smooth = mp.sqrt(1 / mp.mpf("0.6") - 1)
        self.assertIs(found["complete"], True)
        self.assert_lists(found, [(number(-1.71), "unstable"), (-smooth, "stable"), (smooth, "unstable")])

    def test_roots_of_squares_beside_parameters_are_corners(self):
        well, valley = [(mp.mpf(-1), "stable"), (mp.mpf(0), "unstable"), (mp.mpf(1), "stable")], [(mp.mpf(0), "stable")]
        for root in ("sqrt(c^2*x^2)", "sqrt(c*x^2)", "sqrt((c*x)^2)"):
            for potential, places in ((f"x^2/2 - {root}", well), (f"x^2/2 + {root} - abs(x)/2", valley)):
                self.assert_lists(self.equilibria(particle(potential, [("c", 1)])), places)

    def test_of_the_sine_in_one_turn(self):
        found = self.equilibria(particle("3*abs(sin(x))", unit="rad"))
        self.assertIs(found["complete"], True)
        self.assert_lists(found, [(mp.mpf(0), "stable"), (mp.pi, "stable"),
                                  (mp.pi / 2, "unstable"), (-mp.pi / 2, "unstable")])

    def test_in_the_plane_along_a_wedge(self):
        scene = particle("abs(x) + x^2 + (y - x)^2 - 3*y")
        scene["coordinates"].append({"name": "y", "unit": "1"})
        scene["lagrangian"] = scene["lagrangian"].replace("(T*x_dot)^2/2", "(T*x_dot)^2/2 + (T*y_dot)^2/2")
        found = self.equilibria(scene)  # y = x + 3/2, and sign(x) + 2 x = 3
        self.assertEqual([entry["stability"] for entry in found["equilibria"]], ["stable"])
        self.assertAlmostEqual(found["equilibria"][0]["state"]["x"], 1)
        scene["lagrangian"] = scene["lagrangian"].replace("- 3*y", "- y/2")
        entry, = self.equilibria(scene)["equilibria"]  # y = x + 1/4, and at x = 0 the sides reach from -1 to 1
        self.assertEqual((entry["state"]["x"], entry["stability"]), (0, "stable"))
        self.assertAlmostEqual(entry["state"]["y"], 0.25)
        scene["lagrangian"] = scene["lagrangian"].replace("(abs(x)", "(-abs(x)")
        at_ridge, = [e for e in self.equilibria(scene)["equilibria"] if e["state"]["x"] == 0]
        self.assertEqual(at_ridge["stability"], "unstable")

    def test_at_a_corner_of_one_coordinate_the_others_keep_their_errors(self):
        """3 y = 1 beside |x|: what rounds y is no part of the kink."""
        draw = random.Random(5)
        for _ in range(40):
            stiffness, load, corner = (draw.choice((3, 0.7, 0.3, 7, 1.1)), draw.choice((1, 1234, 7, 0.1)), draw.choice((0, 0, 0.1)))
            scene = {"name": "corner", "units": "none", "coordinates": [{"name": "x"}, {"name": "y"}],
                     "lagrangian": f"(x_dot^2 + y_dot^2)/2 - abs(x - {corner}) - {stiffness}*y^2/2 + {load}*y"}
            found = self.equilibria(scene)["equilibria"]
            self.assertEqual(len(found), 1, scene)
            self.assertEqual(found[0]["state"]["x"], corner)
            if corner == 0:
                self.assertEqual(found[0]["error"]["x"], 0)
            off = abs(number(found[0]["state"]["y"]) - number(load)/number(stiffness))
            self.assertLessEqual(off, number(found[0]["error"]["y"]) + EXACT, scene)
            self.assertLessEqual(found[0]["error"]["y"], 1e-14*load/stiffness, scene)

    def test_modes_have_no_frequency_there(self):
        for equilibrium in ({}, {"x": 0}):
            problem = self.refused("modes", {"system": particle("abs(x) + x^2/2"), "equilibrium": equilibrium})
            self.assertEqual(problem["type"], "/errors/not-applicable")
            self.assertIn("kink", problem["detail"])

    def test_dry_friction_is_refused_with_its_reason(self):
        scene = chain([[2.0]], [[0.5]])
        scene["forces"][0]["vector"][0] = "-2*k*x0 - F*sign(x0_dot)"
        scene["parameters"].append({"name": "F", "unit": "N", "default": "0.3"})
        for endpoint in ("equilibria", "modes"):
            problem = self.refused(endpoint, {"system": scene})
            self.assertEqual(problem["type"], "/errors/not-applicable")
            self.assertIn("Dry friction", problem["detail"])
        self.assertEqual(self.ask("equilibria", {"system": scene, "parameters": {"F": 0}})["complete"], True)

    def test_dry_friction_against_what_nothing_else_turns_is_refused_as_well(self):
        scene = chain([[0.0]], [[0.0]])
        scene["coordinates"].append({"name": "y", "unit": "m"})
        scene["points"].append({"name": "q", "components": ["y", "0"]})
        scene["bodies"].append({"kind": "particle", "mass": "m", "position": "q"})
        scene["parameters"].append({"name": "F", "unit": "N", "default": "0.3"})
        scene["forces"] = [{"value": "-F*sign(x0_dot - y_dot)", "along": "x0"}]  # y itself stands nowhere
        for endpoint in ("equilibria", "modes"):
            self.assertIn("Dry friction", self.refused(endpoint, {"system": scene})["detail"])
            sliding = self.post(endpoint, {"system": scene, "initial": {"y_dot": 1}})
            self.assertNotIn(b"Dry friction", sliding.data)


class Spectra(Service):
    def assert_stability(self, stability, most):
        self.assertFalse(stability == "stable" and most > EXACT or stability == "unstable" and most < -EXACT,
                         (stability, most))

    def test_one_way_chains_of_equal_links_have_their_rates(self):
        numbers = random.Random(4)
        for _ in range(30):
            n = numbers.randint(2, 4)
            k = round(numbers.uniform(0.5, 9), 3)
            c = numbers.choice([round(numbers.uniform(-0.4, 1.2), 3), 1e-7, -1e-7, -0.003])
            stiffness = [[k if i == j else 1.5 if i == j + 1 else 0.0 for j in range(n)] for i in range(n)]
            damping = [[c if i == j else 0.0 for j in range(n)] for i in range(n)]
            root = (-number(c) + mp.sqrt(mp.mpc(number(c) ** 2 - 4 * number(k)))) / 2
            with self.subTest(n=n, k=k, c=c):
                entry, = self.ask("equilibria", {"system": chain(stiffness, damping)})["equilibria"]
                self.assertEqual(entry["stability"], "stable" if c > 0 else "unstable")
                for s in entry["eigenvalues"]:
                    off = min(abs(mp.mpc(s["re"], s["im"]) - r) for r in (root, mp.conj(root)))
                    self.assertLessEqual(off, s["error"] + EXACT)
                    self.assertLess(s["error"], 1e-14)
                modes = self.ask("modes", {"system": chain(stiffness, damping)})
                self.assertEqual(modes["equilibrium"]["stability"], entry["stability"])
                for mode in modes["modes"]:
                    self.assertEqual(mode["kind"], "decay" if c > 0 else "growth")
                    self.assertLessEqual(abs(mode["rate"] - abs(root.real)), mode["rate_error"] + EXACT)

    def test_weak_feedback_splits_them_by_its_root(self):
        numbers = random.Random(5)
        for _ in range(20):
            n = numbers.randint(2, 4)
            k, c = round(numbers.uniform(0.5, 9), 3), round(numbers.uniform(-0.01, 0.02), 5)
            stiffness = [[k if i == j else 1.5 if i == j + 1 else 0.0 for j in range(n)] for i in range(n)]
            feedback = numbers.choice([1e-12, -1e-9, 1e-6])
            stiffness[0][n - 1] += feedback
            damping = [[c if i == j else 0.0 for j in range(n)] for i in range(n)]
            # det of w on the diagonal, 3/2 below it and the feedback in the corner: w^n = (-1)^n feedback (3/2)^(n-1).
            turn = mp.root(abs(number(feedback)) * mp.mpf(1.5) ** (n - 1), n)
            sign = (-1) ** n * (1 if feedback > 0 else -1)
            angles = [(2 * j + (0 if sign > 0 else 1)) * mp.pi / n for j in range(n)]
            exact = []
            for angle in angles:
                root = mp.sqrt(number(c) ** 2 - 4 * (number(k) - turn * mp.expj(angle)))
                exact += [(-number(c) + root) / 2, (-number(c) - root) / 2]
            with self.subTest(n=n, k=k, c=c, feedback=feedback):
                entry, = self.ask("equilibria", {"system": chain(stiffness, damping)})["equilibria"]
                self.assert_stability(entry["stability"], max(r.real for r in exact))
                for s in entry["eigenvalues"]:
                    off = min(abs(mp.mpc(s["re"], s["im"]) - r) for r in exact)
                    self.assertLessEqual(off, s["error"] + EXACT)

    def test_what_no_energy_decides_is_neither_stable_nor_unstable(self):
        for forces in (["-k*x0 + c*x0_dot*(T*x0_dot/a)^2"],  # pumps, and with the other sign brakes: to third order
                       ["-k*x0 - c*x0_dot*(T*x0_dot/a)^2"],
                       ["-k*x0 + c*x0_dot*(x0/a)^2"],
                       ["-k*x0", "-k*x1 + k*x0"],  # driven in its resonance
                       ["-k*x0 + k*x0*(x0/a)*x1/a", "-2*k*x1"]):
            scene = chain([[0.0]*len(forces)]*len(forces), [[0.0]*len(forces)]*len(forces))
            scene["parameters"] += [{"name": "T", "unit": "s", "default": "1"},
                                    {"name": "a", "unit": "m", "default": "1"}]
            for entry, force in zip(scene["forces"], forces):
                entry["vector"][0] = force
            with self.subTest(forces):
                modes = self.ask("modes", {"system": scene})["equilibrium"]
                self.assertEqual(modes["stability"], "neutral")
                self.assertTrue(modes["nonlinear"])
                entry, = self.ask("equilibria", {"system": scene})["equilibria"]
                self.assertEqual(entry["stability"], "neutral")
        scene = chain([[2.0, -1.0], [-1.0, 2.0]], [[0.0, 0.0], [0.0, 0.0]])  # springs, written as forces
        self.assertEqual(self.ask("modes", {"system": scene})["equilibrium"]["stability"], "stable")

    def test_at_the_verge_of_gyroscopic_stabilization_nothing_is_decided(self):
        stiffness, damping = [[-1.0, 0.0], [0.0, -1.0]], [[0.0, -2.0], [2.0, 0.0]]
        entry, = self.ask("equilibria", {"system": chain(stiffness, damping)})["equilibria"]
        self.assertEqual(entry["stability"], "neutral")
        self.assertTrue(entry["nonlinear"])
        for s in entry["eigenvalues"]:
            self.assertLessEqual(abs(abs(s["im"]) - 1), s["error"])
        modes = self.ask("modes", {"system": chain(stiffness, damping)})
        self.assertEqual(modes["equilibrium"]["stability"], "neutral")
        self.assertIn("is not decided", modes["equilibrium"]["nonlinear"])


def printed(potential):
    return {"name": "printed", "units": "none", "parameters": [{"name": "p", "default": "0.5"}],
            "coordinates": [{"name": "x"}, {"name": "y"}], "lagrangian": f"(x_dot^2 + y_dot^2)/2 - ({potential})"}


def evaluated(form, place):
    """Of a sum of decimals times coordinates, "0.5*x + 0.25*y"."""
    total = mp.mpf(0)
    for term in form.replace("- ", "+ -").split(" + "):
        factor, _, name = term.rpartition("*")
        total += mp.mpf(factor or "1") * place[name]
    return total


class NormalForms(Service):
    def critical(self, potential):
        request = {"system": particle(potential, (("p", 0.5),)), "parameter": "p", "from": -1, "to": 1}
        return self.ask("bifurcations", request)

    def test_kinds_are_those_of_the_normal_forms(self):
        numbers = random.Random(6)
        for _ in range(8):
            a, b = (round(numbers.uniform(0.3, 3), 3) for _ in range(2))
            p = round(numbers.uniform(-0.8, 0.8), 3)
            moved = f"{text(b)}*(p - {text(p)})"
            for potential, kind in ((f"{text(a)}*x^4/4 - {moved}*x^2/2", "pitchfork"),
                                    (f"-{text(a)}*x^4/4 - {moved}*x^2/2", "pitchfork"),
                                    (f"{text(a)}*x^3/3 - {moved}*x", "saddle_node"),
                                    (f"{text(a)}*x^3/3 - {moved}*x^2/2", "transcritical"),
                                    (f"{text(a)}*x^5/5 - {moved}*x^2/2", "unresolved"),
                                    (f"{text(a)}*x^4/4 - {moved}*x", "unresolved")):
                with self.subTest(potential):
                    found = self.critical(potential)
                    self.assertIs(found["complete"], True)
                    one, = found["critical"]
                    self.assertEqual(one["kind"], kind)
                    self.assertEqual("reason" in one, kind == "unresolved")
                    self.assertLessEqual(abs(one["value"] - number(p)), one["error"] + EXACT)
                    self.assertLessEqual(abs(one["state"]["x"]), one["state_error"]["x"] + EXACT)

    def test_kinds_stay_where_axes_are_moved_and_slanted(self):
        numbers = random.Random(16)
        forms = {"{a}*({u})^4/4 - {q}*({u})^2/2": "pitchfork", "{a}*({u})^3/3 - {q}*({u})": "saddle_node",
                 "{a}*({u})^3/3 - {q}*({u})^2/2": "transcritical", "{a}*({u})^4/4 - {q}*({u})": "unresolved",
                 "{a}*({u})^6/6 - {q}*({u})^2/2": "unresolved"}
        for form, kind in forms.items():
            for slanted in (False, True):
                a, c, d, p = (round(numbers.uniform(0.3, 0.9), 3) for _ in range(4))
                u, w = (f"0.{numbers.randint(3, 9)}*x + {a}*y", f"{c}*y - {d}*x") if slanted else ("x", "y")
                potential = form.format(a=a, u=f"{u} - {c}", q=f"{d}*(p - {p})") + f" + ({w} - {p})^2"
                with self.subTest(potential):
                    found = self.ask("bifurcations", {"system": printed(potential), "parameter": "p", "from": -1, "to": 1})
                    self.assertIs(found["complete"], True, found.get("reason"))
                    self.assert_critical(found["critical"], u, w, (c, p, p), kind, slanted)

    def assert_critical(self, found, u, w, at, kind, slanted):
        """One, at u = c, w = p and the parameter p; on no axis a fork is only known to be several events."""
        one, = found
        self.assertIn(one["kind"], {kind, "unresolved"} if slanted and kind == "pitchfork" else {kind})
        self.assertLess(one["error"], 1e-12)
        self.assertLessEqual(abs(one["value"] - number(at[2])), one["error"] + EXACT)
        exact = {name: number(one["state"][name]) for name in "xy"}
        slack = 4 * max(one["state_error"].values()) + EXACT
        for form, value in ((u, at[0]), (w, at[1])):
            self.assertLessEqual(abs(evaluated(form, exact) - number(value)), slack, form)

    def test_a_mirror_makes_no_pitchfork_of_what_crosses_along_it(self):
        for tilt in (1e-3, 1e-9, 1e-16):
            scene = chain([[0.0, 0.0], [0.0, 1.0]], [[0.0, 0.0], [0.0, 0.0]])
            scene["parameters"] += [{"name": "p", "unit": "1", "default": "0.5"},
                                    {"name": "a", "unit": "m", "default": "1"}]
            u = "(x0/a - 0.7)"  # a line u = 0 and a parabola that leans; x1 = 0 is a mirror of its own
            scene["forces"][0]["vector"][0] = f"k*a*{u}*(p - 0.3 - {u}^2 + {tilt!r}*{u})"
            found = self.ask("bifurcations", {"system": scene, "parameter": "p", "from": -1, "to": 1})
            self.assertTrue(found["critical"] if tilt == 1e-3 else found["complete"] is False)
            for one in found["critical"]:
                self.assertIn(one["kind"], ("transcritical", "saddle_node", "unresolved"), (tilt, one))

    def test_what_comes_from_infinity_is_told(self):
        found = self.critical("(p - 0.25)*x^2/2 - 2*x")
        self.assertIs(found["complete"], True)
        self.assertIn("At p = 0.25 an equilibrium appears from or vanishes to x = infinity", found["reason"])

    def test_what_comes_from_the_end_of_a_domain_is_told(self):
        scene = particle("x^2/2 - (p - 0.25)*x", (("p", 0.5),), domain=">= 0", initial="1")
        found = self.ask("bifurcations", {"system": scene, "parameter": "p", "from": -1, "to": 1})
        self.assertIn("At p = 0.25 an equilibrium appears from or vanishes to x = 0", found["reason"])

    def test_kinks_are_not_searched_and_that_is_said(self):
        found = self.critical("x^2/2 + p*abs(x)")
        self.assertIs(found["complete"], False)
        self.assertIn("kinks", found["reason"])


if __name__ == "__main__":
    unittest.main()
