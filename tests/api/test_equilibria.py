"""Equilibria, the number that makes a position one, and critical values over HTTP: reference cases, theory, refusals."""

import math
import pathlib
import random
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, numbers_in, reference_cases  # noqa: E402
from short_scene import DOWN_3D, G, lagrangian, particle, scene  # noqa: E402
from textbook_fields import BELT  # noqa: E402
from textbook_machines import CUBE_ON_CYLINDER, WRAPPING  # noqa: E402

PROMISED = 1e-12  # relative


class Answers(Service):
    def assert_near(self, actual, expected, relative=PROMISED):
        self.assertLessEqual(abs(actual - expected), relative*max(abs(expected), 1e-3), (actual, expected))

    def stability(self, stable):
        return "stable" if stable else "unstable"


class Equilibria(Answers):
    def test_many_places_have_formulas_once_for_a_family(self):
        beads = lagrangian("two_beads", "m - 1; g - 9.81; R - 0.5; w - 6", "a - 0.1; b - 0.1",
                           "m*R^2/2*(a_dot^2 + b_dot^2) + m*g*R*(cos(a) + cos(b)) + m*R^2*w^2/2*(sin(a)^2 + sin(b)^2)")
        found = self.ask("equilibria", {"system": beads})
        forms = [{name: form["text"] for name, form in place.get("exact", {}).items()} for place in found["equilibria"]]
        tilted = "acos(g/(R*w^2))"
        self.assertEqual(len(forms), 16)
        self.assertIn({"a": tilted, "b": tilted}, forms)
        self.assertEqual(sum(map(bool, forms)), 5)  # of six families; one is at 0
        self.assertIn("have their formulas once", str(found["notes"]))

    def test_wells_along_curves_are_all_found(self):
        """V = U(x + h(y)) + 0.15 y^2: at rest y = 0, and x + h(0) where U has its slope 0."""
        for well, places in (("((W)^4/4 - (W)^2/2)", (-1, 0, 1)), ("-exp(-(W)^2)", (0,)), ("1.7*cosh((W)/2)", (0,)),
                             ("0.5*(W)^2*exp(-(W)/3)", (0, 6))):
            for curve, offset in (("y^2", 0), ("y^3", 0), ("2*sin(y)", 0), ("0.7*y", 0), ("y/(1 + y^2)", 0), ("exp(-y^2)", 1)):
                potential = well.replace("W", f"x + {curve}")
                found = self.ask("equilibria", {"system": lagrangian("wells", "", "x - 0.3; y - 0.2",
                                                                     f"(x_dot^2 + y_dot^2)/2 - ({potential}) - 0.15*y^2")})
                self.assertIs(found["complete"], True, potential)
                self.assertEqual([(round(e["state"]["x"], 9), round(e["state"]["y"], 9)) for e in found["equilibria"]],
                                 [(x - offset, 0) for x in places])

    def test_rates_that_no_place_of_rest_has_are_noted(self):
        bowl = lagrangian("bowl", "m - 1; l - 1; g - 9.81", "th - 0.3; p - 0",
                          "m*l^2*(th_dot^2 + sin(th)^2*p_dot^2)/2 + m*g*l*cos(th)")
        whirl = {"system": "whirling_pendulum", "parameter": "Omega", "from": 0, "to": 10}
        for endpoint, request, rate in (("equilibria", {"system": bowl, "initial": {"p_dot": 4, "th_dot": 1}}, "th_dot = 1"),
                                        ("bifurcations", {**whirl, "initial": {"theta_dot": 3}}, "theta_dot = 3")):
            left_out = [note for note in self.ask(endpoint, request)["notes"] if "its rate is left out" in note]
            self.assertEqual(len(left_out), 1, left_out)
            self.assertIn(f"The start has {rate},", left_out[0])
        self.assertNotIn("notes", self.ask("bifurcations", whirl))
        self.assertNotIn("left out", str(self.ask("equilibria", {"system": bowl, "initial": {"p_dot": 4}})["notes"]))

    def test_rates_of_a_scene_that_the_request_brings_are_noted_too(self):
        bowl = lagrangian("bowl", "m - 1; l - 1; g - 9.81", "th - 0.3 1; p - 0 4", "m*l^2*(th_dot^2 + sin(th)^2*p_dot^2)/2 + m*g*l*cos(th)")
        for endpoint, more in (("equilibria", {}), ("bifurcations", {"parameter": "g", "from": 5, "to": 10}), ("modes", {})):
            left_out = [note for note in self.ask(endpoint, {"system": bowl, **more})["notes"] if "its rate is left out" in note]
            self.assertEqual(len(left_out), 1, (endpoint, left_out))
            self.assertIn("The start has th_dot = 1,", left_out[0])
        self.assertNotIn("left out", str(self.ask("modes", {"system": "orbiting_pendulum"}).get("notes")))

    def test_a_rate_is_not_left_out_for_what_depends_on_nothing(self):
        free = lagrangian("free", "m - 1", "x - 0.1", "m*x_dot^2/2")
        held = lagrangian("held", "m - 1; k - 2; c - 0.3", "x - 0.1; y - 0", "m*(x_dot^2 + y_dot^2)/2 - k*x^2/2", dissipation="c*y_dot^2/2")
        for system, rate, why in ((free, "x_dot", "nothing depends on where it is, and"), (held, "y_dot", "nothing depends on where it is, and"),
                                  (held, "x_dot", "something depends on it, so that")):
            notes = self.ask("modes", {"system": system, "initial": {rate: 1}})["notes"]
            self.assertIn(f"where {rate[0]} rests: {why} its rate is left out.", notes[0])

    def test_forces_that_vanish_where_the_mass_matrix_has_no_inverse_prove_no_rest(self):
        system = lagrangian("spring", "m - 1; g - 9.81; k - 3; l - 0.5", "r - 1; th - 0.1",
                            "m/2*(r_dot^2 + r^2*th_dot^2) + m*g*r*cos(th) - k*(r - l)^2/2")
        across = {"r": 0, "th": math.acos(-3*0.5/9.81)}  # there m*g pulls the mass sideways out of the axis
        self.refused("energy", {"system": system, "initial": across})
        found = self.ask("equilibria", {"system": system})
        self.assertEqual([round(one["state"]["r"], 9) for one in found["equilibria"]], [-2.77, 3.77])
        self.assertFalse(found["complete"])
        self.assertIn("Near r = 0 and th = 1.72", found["reason"])
        self.assertIn("the mass matrix has no inverse", found["reason"])

    def test_nor_do_they_on_the_surface_of_a_constraint(self):
        system = lagrangian("spring", "m - 1; g - 9.81; k - 3; l - 0.5", "r - 1; th - 0.1; z - 2",
                            "m/2*(r_dot^2 + r^2*th_dot^2 + z_dot^2) + m*g*r*cos(th) - k*(r - l)^2/2",
                            constraints=[{"name": "w", "expression": "z - 2*r"}])
        found = self.ask("equilibria", {"system": system})
        self.assertEqual([round(one["state"]["r"], 9) for one in found["equilibria"]], [-2.77, 3.77])
        self.assertFalse(found["complete"])
        self.assertIn("the mass matrix has no inverse", found["reason"])

    def test_reference_cases(self):
        count = 0
        for case in reference_cases("equilibria"):
            with self.subTest(case["id"]):
                found = self.ask("equilibria", {"system": case["system"], "parameters": case["parameters"]})
                self.assertIs(found["complete"], True)
                expected = sorted(case["expected"]["equilibria"], key=lambda entry: entry["theta"])
                self.assertEqual(len(found["equilibria"]), len(expected))
                for actual, entry in zip(found["equilibria"], expected):
                    count += 1
                    self.assert_near(actual["state"]["theta"], entry["theta"])
                    self.assertLess(actual["error"]["theta"], 1e-14)
                    self.assertEqual(actual["stability"], self.stability(entry["stable"]))
                    self.assert_near(actual["rate2"], entry["rate2"])
        self.assertEqual(count, 8)

    def test_angles_lie_in_one_turn_and_ascend(self):
        for system in ("spring_pendulum", "cart_pendulum", "rod_pendulum", "compass_walker", "orbiting_pendulum"):
            with self.subTest(system):
                found = self.ask("equilibria", {"system": system})
                self.assertTrue(found["equilibria"])
                for entry in found["equilibria"]:
                    for name in entry["state"]:
                        if found["units"][name] == "rad":
                            self.assertTrue(-math.pi < entry["state"][name] <= math.pi)
                first = [list(entry["state"].values()) for entry in found["equilibria"]]
                self.assertEqual(first, sorted(first))
                self.assertTrue(all(math.isfinite(number) for number in numbers_in(found)))

    def test_where_they_do_not_end_those_in_the_middle_are_all_there(self):
        found = self.ask("equilibria", {"system": CUBE_ON_CYLINDER})
        self.assertIs(found["complete"], False)
        self.assertIn("theta from -12.57 to 12.57", found["reason"])
        places = [entry["state"]["theta"] for entry in found["equilibria"]]
        self.assertEqual(len(places), 9)  # r theta cos(theta) = b sin(theta)
        for theta in places:
            self.assertAlmostEqual(2*theta*math.cos(theta), math.sin(theta), 12)

    def test_a_place_where_the_mass_matrix_has_no_inverse_is_told(self):
        found = self.ask("equilibria", {"system": WRAPPING})["equilibria"]
        told = [entry["state"]["phi"] for entry in found if "no inverse" in entry.get("nonlinear", "")]
        self.assertEqual(told, [-5])  # the whole string is wound up: l + R phi = 0

    def test_without_a_potential_imaginary_eigenvalues_do_not_decide(self):
        entry, = self.ask("equilibria", {"system": BELT})["equilibria"]
        self.assertEqual((entry["stability"], entry["rate2"]), ("neutral", 20))
        self.assertIn("without a potential", entry["nonlinear"])

    def test_a_string_is_taut_or_not(self):
        found = self.ask("equilibria", {"system": "rod_pendulum"})
        valid = {(entry["state"]["theta"], entry["state"]["phi"]): entry["valid"] for entry in found["equilibria"]}
        self.assertEqual(valid, {(0, 0): True, (0, math.pi): False, (math.pi, 0): True, (math.pi, math.pi): False})

    def test_at_the_critical_spin_linearization_does_not_decide(self):
        found = self.ask("equilibria", {"system": "whirling_pendulum", "parameters": {"g": 9, "l": 1, "Omega": 3}})
        bottom = found["equilibria"][0]
        self.assertEqual((bottom["state"]["theta"], bottom["stability"]), (0, "neutral"))
        self.assertIn("nonlinearly stable", bottom["nonlinear"])

    def test_next_to_a_pitchfork_each_of_three_has_its_stability(self):
        """V = (x - c)^4/4 - e (x - c)^2/2: at c unstable, at c +- sqrt(e) stable, whatever rounding makes of V'' there."""
        rng = random.Random(5)
        for _ in range(30):
            c, e = round(rng.uniform(-3, 3), 2), rng.randint(10, 99)*10.0**-rng.randint(12, 26)
            text = f"x_dot^2/2 - (x - ({c}))^4/4 + {e!r}*(x - ({c}))^2/2"
            found = self.ask("equilibria", {"system": lagrangian("landau", "", "x 1", text)})
            with self.subTest(c=c, e=e):
                self.assertIs(found["complete"], True)
                self.assertEqual([s["stability"] for s in found["equilibria"]], ["stable", "unstable", "stable"])
                for state, sign in zip(found["equilibria"], (-1, 0, 1)):
                    self.assertLess(abs(state["state"]["x"] - (c + sign*math.sqrt(e))), 1e-15)

    def test_what_follows_from_a_zero_is_not_said_of_what_rounding_hides(self):
        """0 is unstable here, between two stable ones 1e-14 apart."""
        system = lagrangian("landau", "", "x 1", "x_dot^2/2 - x^4/4 + 1e-28*x^2/2")
        state, = self.ask("equilibria", {"system": system})["equilibria"]
        self.assertIn("nonlinearly stable, where both are zero", state["nonlinear"])
        system = lagrangian("fold", "", "x 1", "x_dot^2/2 - (x - 0.1)^3/3 + 1e-33*(x - 0.1)")
        state, = self.ask("equilibria", {"system": system})["equilibria"]
        self.assertIn("where the second is zero, unstable", state["nonlinear"])

    def test_a_multiple_zero_is_listed_once(self):
        system = lagrangian("quartic", "m - 1", "x - 0.1; y - 0.1; z - 0.1",
                            "m*(x_dot^2 + y_dot^2 + z_dot^2)/2 - 10*x^4 - 300*x^2*z - 80*y^4 + 2*y^2/25 - 3000*z^4 + 3*z^2")
        answer = self.ask("equilibria", {"system": system})
        self.assertTrue(answer["complete"])
        self.assertEqual(len(answer["equilibria"]), 15)
        self.assertEqual(sum("note" in one for one in answer["equilibria"]), 3)

    def test_momenta_of_a_steady_motion_are_told(self):
        found = self.ask("equilibria", {"system": "free_spin_pendulum"})
        self.assertEqual(list(found["momenta"]), ["p_psi"])
        self.assertEqual(found["units"]["p_psi"], "kg*m^2/s")
        self.assertTrue(found["equilibria"])
        for place in (found["request"]["initial"], *(entry["state"] for entry in found["equilibria"])):
            momentum = 0.2 * 0.5**2 * (0.5 + math.sin(place["theta"]))**2 * place["psi_dot"]
            self.assertAlmostEqual(found["momenta"]["p_psi"], momentum, 14)

    def test_a_momentum_that_cancels_is_none(self):
        """What rounding might leave of it would be a centrifugal force next to r = 0."""
        system = lagrangian("charge_in_a_field", "m - 1; B - -0.5", "r - 0.75; phi - 0 0.25",
                            "m*(r_dot^2 + r^2*phi_dot^2)/2 + B*r^2*phi_dot/2 - 2*r")
        system["coordinates"][0]["domain"] = "> 0"
        found = self.ask("equilibria", {"system": system})
        self.assertEqual(found["momenta"], {"p_phi": 0})
        self.assertEqual(found["equilibria"], [])
        self.assertTrue(found["complete"])

    def test_an_equation_that_is_a_limit_belongs_to_no_energy(self):
        """A massless bob below a bob: a'' = -a, b'' = a - b, whose b grows with the time."""
        system = lagrangian("massless_bob", "m - 0", "a - 0; b - 0",
                            "(1 + m)*a_dot^2/2 + m*b_dot^2/2 + m*a_dot*b_dot - (1 + m)*a^2/2 - m*b^2/2")
        for mass, stability in ((0, "neutral"), (0.5, "stable")):
            asked = {"system": system, "parameters": {"m": mass}}
            self.assertEqual([one["stability"] for one in self.ask("equilibria", asked)["equilibria"]], [stability])
            self.assertEqual(self.ask("modes", asked)["equilibrium"]["stability"], stability)

    def test_time_in_the_equations_is_not_applicable(self):
        problem = self.refused("equilibria", {"system": "rolling_disk_platform"})
        self.assertEqual(problem["type"], "/errors/not-applicable")
        found = self.ask("equilibria", {"system": "rolling_disk_platform", "parameters": {"g": 0}})
        self.assertEqual([entry["stability"] for entry in found["equilibria"]], ["unstable"])


class SolveFor(Answers):
    def solve(self, system, unknown, at, parameters):
        return self.ask("equilibria", {"system": system, "solve_for": unknown, "at": at, "parameters": parameters})

    def test_reference_cases(self):
        count = 0
        for case in reference_cases("steady_spin"):
            expected = case["expected"]
            if "orientations" not in expected:
                continue
            for entry in expected["orientations"]:
                with self.subTest(case["id"], theta=entry["theta0"]):
                    count += 1
                    found = self.solve(case["system"], "Omega", {"theta": entry["theta0"]}, case["parameters"])
                    self.assertEqual(len(found["ranges"]), 3)
                    if not entry["exists"]:
                        self.assertIsNone(found["Omega"])
                        self.assertIn("No real Omega", found["reason"])
                        continue
                    self.assert_near(found["Omega"], entry["Omega"])
                    self.assertLessEqual(abs(found["Omega"] - entry["Omega"]), found["error"] + 2e-15*entry["Omega"])
                    self.assert_near(found["rate2"], entry["rate2"])
                    self.assertEqual(found["stability"], self.stability(entry["stable"]))
        self.assertEqual(count, 8)

    def test_the_steady_cone(self):
        for case in reference_cases("steady_spin"):
            expected = case["expected"]
            if "psi_dot" in expected:
                found = self.solve(case["system"], "psi_dot", {"theta": expected["theta0"]}, case["parameters"])
                self.assert_near(found["psi_dot"], expected["psi_dot"])
                self.assert_near(math.sqrt(found["rate2"]), expected["nutation_omega"])
                self.assertEqual(found["stability"], "stable")
                return
        self.fail("no such case")

    def test_omega_gives_the_equilibrium_back(self):
        numbers = random.Random(1)
        for _ in range(20):
            parameters = {"l": numbers.uniform(0.2, 2), "g": numbers.uniform(1, 20)}
            theta = numbers.uniform(0.1, 1.6)
            omega = self.solve("rotating_l_bar", "Omega", {"theta": theta}, parameters)["Omega"]
            found = self.ask("equilibria", {"system": "rotating_l_bar", "parameters": parameters | {"Omega": omega}})
            self.assertLess(min(abs(entry["state"]["theta"] - theta) for entry in found["equilibria"]), 1e-12)

    def test_a_query_says_the_position_as_initial_values(self):
        body = self.solve("rotating_l_bar", "Omega", {"theta": 0.3}, {})
        query = self.get("equilibria", {"system": "rotating_l_bar", "solve_for": "Omega", "theta": "0.3"})
        self.assertEqual(query.status, 200)
        self.assertIn(f'"Omega":{body["Omega"]},'.encode(), query.data)

    def test_mistakes(self):
        request = {"system": "spring_pendulum", "solve_for": "k"}
        self.refused_at("equilibria", request | {"at": {"theta": 0}}, "#/at/l")
        self.refused_at("equilibria", request, "#/at/l", "#/at/theta")
        self.refused_at("equilibria", request | {"solve_for": "kk", "at": {"l": 1, "theta": 0}}, "#/solve_for")
        self.refused_at("equilibria", request | {"solve_for": "l_dot", "at": {"l": 1, "theta": 0}}, "#/solve_for")
        self.refused_at("equilibria", request | {"at": {"l": 1, "thetaa": 0}}, "#/at/thetaa")
        self.refused_at("equilibria", {"system": "spring_pendulum", "at": {"l": 1}}, "#/at")


class Bifurcations(Answers):
    def critical(self, system, parameter, start, end, **parameters):
        return self.ask("bifurcations", {"system": system, "parameter": parameter, "from": start, "to": end,
                                         "parameters": parameters})

    def test_the_pitchfork(self):
        for case in reference_cases("equilibria"):
            if "Omega_c" in case["expected"]:
                with self.subTest(case["id"]):
                    given = {name: number for name, number in case["parameters"].items() if name != "Omega"}
                    found = self.critical(case["system"], "Omega", 0, 10, **given)
                    self.assertEqual([c["kind"] for c in found["critical"]], ["pitchfork"])
                    self.assert_near(found["critical"][0]["value"], case["expected"]["Omega_c"])
                    self.assertEqual(found["critical"][0]["state"]["theta"], 0)

    def test_the_saddle_node(self):
        found = self.critical("rotating_l_bar", "Omega", 0, "2 rev/s", l=0.5, g=9.81)
        self.assertEqual([c["kind"] for c in found["critical"]], ["saddle_node"])
        self.assert_near(found["critical"][0]["value"], math.sqrt(0.46257442562035035824*9.81/0.5))
        self.assert_near(found["critical"][0]["state"]["theta"], 0.33829126264813825728)
        self.assertEqual(found["request"]["to"], 4*math.pi)
        for branch in found["branches"]:
            self.assertEqual(len({len(branch[name]) for name in ("Omega", "theta", "stability")}), 1)
            self.assertEqual(branch["Omega"], sorted(branch["Omega"]))

    def test_where_determinants_are_long_the_branches_are_left(self):
        scene = lagrangian("restricted_three_bodies", "mu - 0.01", "x - 0.49; y - 0.86",
                           "(x_dot^2 + y_dot^2)/2 + x*y_dot - y*x_dot + (x^2 + y^2)/2"
                           " + (1 - mu)/sqrt((x + mu)^2 + y^2) + mu/sqrt((x - 1 + mu)^2 + y^2)")
        found = self.ask("bifurcations", {"system": scene, "parameter": "mu", "from": 0.01, "to": 0.06})
        self.assertIs(found["complete"], False)
        self.assertEqual(len(found["branches"]), 5)

    def test_where_linear_forces_vanish_all_of_a_line_rests_and_nothing_else_happens(self):
        """A stiffness goes through 0, not the growth of an oscillation."""
        coupled = lagrangian("coupled", "w - 1; al - 0.3", "x - 1; y - 0",
                             "(x_dot^2 + y_dot^2)/2 - w^2*(x^2 + y^2)/2 + al*x*y")
        found = self.ask("bifurcations", {"system": coupled, "parameter": "al", "from": -2, "to": 2})
        self.assertEqual((found["degenerate"], found["critical"], found["complete"]), ([-1, 1], [], True))
        self.assertNotIn("oscillations", found["reason"])

    def test_branches_end_and_begin_where_linear_forces_vanish(self):
        column = lagrangian("column", "c - 1; P - 0.2", "a - 0; b - 0",
                            "a_dot^2 + b_dot^2/2 + a_dot*b_dot - c*a^2/2 - c*(b - a)^2/2 + P*(a^2 + b^2)/2")
        found = self.ask("bifurcations", {"system": column, "parameter": "P", "from": 0, "to": 4})
        self.assertIs(found["complete"], True, found.get("reason"))
        for value, book in zip(found["degenerate"], ((3 - math.sqrt(5))/2, (3 + math.sqrt(5))/2)):
            self.assert_near(value, book)

    def test_what_comes_from_infinity_keeps_its_stability_and_its_parameter(self):
        bond = lagrangian("bond", "A - 1; B - 1; F - 0.01", "r - 2 0", "r_dot^2/2 - A/r^2 + B/r + F*r")
        found = self.ask("bifurcations", {"system": bond, "parameter": "F", "from": -0.1, "to": 0.1})
        self.assertIn("At F = 0 an equilibrium appears from or vanishes to r = infinity.", found["reason"])
        self.assertIs(found["complete"], True, found["reason"])  # what is known is not missing
        self.assertEqual(found["reason"], " ".join(found["at_ends"]))
        self.assertEqual([set(branch["stability"]) - {"neutral"} for branch in found["branches"]],
                         [{"stable"}, {"stable"}, {"unstable"}])

    def test_a_search_that_costs_too_much_tells_what_it_has_found(self):
        """Two balls on links hold a sleeve, each link by its length: constraints that fail where the sleeve is up."""
        governor = scene(
            "governor", f"m kg 1; M kg 2; l m 0.5; w rad/s 6; {G}", "x m; z m -l; y m -2*l", gravity=DOWN_3D,
            bodies=[particle("m", "x*cos(w*t)", "x*sin(w*t)", "z"), particle("m", "-x*cos(w*t)", "-x*sin(w*t)", "z"),
                    particle("M", "0", "0", "y")],
            constraints=[{"name": "upper", "expression": "x^2 + z^2 - l^2"},
                         {"name": "lower", "expression": "x^2 + (z - y)^2 - l^2"}])
        found = self.ask("equilibria", {"system": governor})
        self.assertIs(found["complete"], False)
        self.assertIn("the constraints depend on each other", found["reason"])
        hanging = [place for place in found["equilibria"] if place["state"]["y"] < -0.9]
        self.assertEqual([place["stability"] for place in hanging], ["stable"])
        critical = self.ask("bifurcations", {"system": governor, "parameter": "w", "from": 1, "to": 15})
        self.assertIs(critical["complete"], False)
        self.assertIn("sqrt(g*(1 + M/m)/l)", [entry.get("exact", {}).get("text") for entry in critical["critical"]])

    def test_places_behind_walls_say_so(self):
        """A mass that is drawn to x = f = 3/2, and a wall on the right of it or on the left."""
        for expression, direction, hidden in (("0.7 - x", "falling", True), ("x - 0.7", "rising", True),
                                              ("x - 0.7", "falling", False), ("0.7 - x", "rising", False)):
            drawn = lagrangian("drawn", "f - 1.5", f"x - {0.1 if hidden else 2}", "x_dot^2/2 - x^2/2 + f*x",
                               events=[{"name": "wall", "expression": expression, "direction": direction}],
                               impacts=[{"event": "wall", "restitution": "0.8"}])
            found = self.ask("equilibria", {"system": drawn})
            self.assertIn("pressed against", " ".join(found["notes"]))
            self.assertEqual("lies behind what the impact 'wall' hits" in found["equilibria"][0].get("note", ""), hidden)

    def test_the_period_doubling_of_the_walker(self):
        found = self.critical("compass_walker", "gamma", 0.01, 0.016, m=0)
        self.assertEqual([c["kind"] for c in found["critical"]], ["period_doubling"])
        self.assertLess(abs(found["critical"][0]["value"] - 0.0150884379411194636), 1e-12)

    def test_mistakes(self):
        request = {"system": "whirling_pendulum", "parameter": "Omega", "from": 0, "to": 10}
        self.refused_at("bifurcations", request | {"parameter": "omega"}, "#/parameter")
        self.refused_at("bifurcations", request | {"to": 0}, "#/to")
        self.refused_at("bifurcations", request | {"to": "3 kg"}, "#/to")
        self.refused_at("bifurcations", request | {"parameter": "l", "from": -1}, "#/from")
        del request["from"]
        self.refused_at("bifurcations", request, "#/from")


if __name__ == "__main__":
    unittest.main()
