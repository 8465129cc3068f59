"""/v1/check: numbers, sets, shapes, facts, formulas and equations are graded as a careful teacher would.

Each table has submissions that are right and such that are wrong; `None` stands for one that cannot be read, which has
no verdict.
"""

import json
import math
import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.extend([str(ROOT / "tests" / "support"), str(ROOT / "tests" / "server")])

from service import Service  # noqa: E402

TURNING_POINT = {"turning_points": {"system": "free_spin_pendulum"}, "at": "/theta_max"}
ANGLES = {"equilibria": {"system": "whirling_pendulum", "parameters": {"Omega": 5}}, "at": "/equilibria/*/state/theta"}
SHAPE = {"modes": {"system": "cart_pendulum"}, "at": "/modes/1/shape"}


class Check(Service):
    def check(self, items, **more):
        body = {"items": [{"id": str(i), **item} for i, item in enumerate(items)], **more}
        return self.ask_json("check", body)

    def get_json(self, target):
        response = self.raw("GET", target)
        self.assertEqual(response.status, 200, response.data[:300])
        return json.loads(response.data)

    def ask_json(self, question, body):
        answer = self.post(question, body)
        return answer.status, json.loads(answer.data)

    def verdicts(self, expect, submissions, **more):
        status, answer = self.check([{"expect": expect, "submitted": s, **more} for s in submissions])
        self.assertEqual(status, 200, answer)
        return answer["items"]

    def assert_verdicts(self, expect, cases, **more):
        for (submitted, expected), item in zip(cases, self.verdicts(expect, [s for s, _ in cases], **more)):
            with self.subTest(submitted=submitted):
                self.assertIs(item["correct"], expected, item)
                self.assertEqual(item["score"], 1 if expected else 0)

    def error(self, item):
        status, answer = self.check([item])
        self.assertEqual(status, 422, answer)
        return answer["errors"][0]


class Numbers(Check):
    def test_with_and_without_units(self):
        self.assert_verdicts(TURNING_POINT, [
            (0.9622, True), ("0.9622", True), ("55.13deg", True), ("55.13°", True), ("0.9622 rad", True), ("0.3063*pi", True),
            (0.95, False), ("55.13", False), ("-0.9622", False), ("0.9622 kg", False), ("none", False), (None, False),
            ("about 1", None), ([0.96], None), (True, None), ("0.9622 foo", None), ("", None)], rule={"rtol": 1e-3})
        self.assert_verdicts({**TURNING_POINT, "at": "/theta_max_deg"},
                             [(55.13, True), ("55.13", True), ("0.9622 rad", True), (0.9622, False)], rule={"rtol": 1e-3})

    def test_numbers_at_the_end_of_their_range(self):
        degrees = {**TURNING_POINT, "at": "/theta_max_deg"}
        self.assert_verdicts(degrees, [("1e308 rad", None), ("1e308", False), ("-1e308", False), (1e308, False), ("5e-324", False)])
        self.assertEqual(self.error({"expect": TURNING_POINT, "submitted": 1, "points": 1e300})["pointer"], "#/items/0/points")

    def test_a_unit_may_be_required(self):
        self.assert_verdicts(TURNING_POINT, [("0.9622 rad", True), ("55.13 deg", True), (0.9622, None), ("0.9622", None)],
                             rule={"unit": "required", "rtol": 1e-3})

    def test_frequencies_in_turns(self):
        expect = {"modes": {"system": "cart_pendulum"}, "at": "/modes/0/omega"}
        self.assert_verdicts(expect, [("3.50179 rad/s", True), ("0.55733 Hz", True), (0.55733, False)], rule={"rtol": 1e-4})

    def test_rules_have_their_own_options(self):
        for rule, right, wrong in (({"kind": "sigfig", "digits": 3}, 0.962, 0.963), ({"kind": "decdig", "digits": 1}, 1.0, 1.1),
                                   ({"kind": "stack_relative", "testoptions": 0.01}, 0.97, 0.98), ({"kind": "webwork"}, 0.963, 0.964),
                                   ({"kind": "stack_absolute", "testoptions": 0.01}, 0.97, 0.9723), ({}, 0.97, 0.98),
                                   ({"kind": "webwork", "tolerance": 0.1, "tolType": "absolute"}, 1.06, 1.07)):
            with self.subTest(rule=rule):
                self.assert_verdicts(TURNING_POINT, [(right, True), (wrong, False)], rule=rule)

    def test_as_they_are_typed(self):
        self.assert_verdicts(TURNING_POINT, [
            ("0,9622", True), ("55,13°", True), ("55{,}13^\\circ", True), ("θ_max = 0.9622", True), (r"\theta_{\max} = 0.9622 \text{ rad}", True),
            ("≈ 0.9622", True), ("9.622 x 10^-1", True), ("9.622·10⁻¹ rad", True), (r"9.622\cdot 10^{-1}\,\mathrm{rad}", True), ("0.9622 rad.", True),
            ("962.2 mrad", True), ("0.3063π", True), ("0.3063 pi rad", True), ("arccos(0.5717)", True), ("√0.9259", True), ("61.26 gon", True),
            ("0.9622 [rad]", True), (r"\frac{9622}{10000}", True), ("0,9", False), ("θ_max = 55.13", False), ("0.9622 1", None), ("1,234", None),
            ("0·962", None), ("2 = 0.9622", None), ("0.9 = 0.9622", None), ("\\frac" * 20000, None)], rule={"rtol": 1e-3})

    def test_units_of_other_systems(self):
        length = {"equilibria": {"system": "spring_pendulum"}, "at": "/equilibria/0/state/l"}  # 0.247375 m
        self.assert_verdicts(length, [("9.7392 in", True), ("0.81160 ft", True), ("2.47375 dm", True), ("9.7392 ft", False), ("0.247375 lb", False)],
                             rule={"rtol": 1e-4})
        energy = {"energy": {"system": "spring_pendulum", "initial": {"l": 0.6, "theta": 0}}, "at": "/V"}
        expected = self.get_json("/v1/energy?system=spring_pendulum&l=0.6&theta=0")["V"]
        self.assert_verdicts(energy, [(f"{expected!r} N m", True), (f"{expected!r} Nm", True), (f"{expected!r} kg m^2 s^-2", True),
                                      (f"{1e7 * expected!r} erg", True), (f"{expected / 4.184!r} cal", True), (f"{expected!r} N", False)], rule={"rtol": 1e-6})
        rate = {"modes": {"system": "cart_pendulum"}, "at": "/modes/0/omega"}
        self.assert_verdicts(rate, [("3.50179 rad s^-1", True), ("3.50179 /s", True), ("3.50179 s^{-1}", True), ("3.50179 radians per second", True),
                                    ("sqrt(12.2625) rad/s", True)], rule={"rtol": 1e-4})

    def test_lists_as_they_are_typed(self):
        four = {"any_order": True, "modulo": "2pi", "rtol": 1e-4}
        self.assert_verdicts(ANGLES, [
            ("0, ±38.298°, 180°", True), ("0; 0,66842; -0,66842; 3,14159", True), (r"\{0, \pi, \pm 0.66842\}", True), ("0\nπ\n0.66842\n-0.66842", True),
            ("θ = 0, θ = π, θ = 0.66842 and θ = -0.66842", True), ("0, 3,14159, 0,66842, -0,66842", True), ("0, ±38.298°", False),
            ("0; 0,66842; -0,66842", False), ("0, 180, 38.298, -38.298 deg", None), ("0, pi, 0.66842, -0.66842, 1", False)], rule=four)
        self.assert_verdicts(SHAPE, [("1 : -5", True), ("[1 -5]", True), ("(1, -5)^T", True), (r"\begin{pmatrix} 1 \\ -5 \end{pmatrix}", True),
                                     ("theta = -5, x = 1", True), ("theta = 1, x = -5", False), ("(1 m, -5 rad)", None), ("[1 5]", False)],
                             rule={"any_scale": True})
        energies = {"energy": {"system": "spring_pendulum", "initial": {"l_dot": 1}}, "at": ["/T", "/V"]}
        found = self.get_json("/v1/energy?system=spring_pendulum&l_dot=1")
        self.assert_verdicts(energies, [(f"V = {found['V']} J, T = {found['T']} J", True), (f"T = {found['V']} J, V = {found['T']} J", False)])

    def test_many_mistakes_are_not_all_listed(self):
        item, = self.verdicts(ANGLES, ["x," * 9000])
        self.assertLessEqual(len(item["format_errors"]), 5)

    def test_a_rate_in_degrees_is_told(self):
        item, = self.verdicts({"modes": {"system": "cart_pendulum"}, "at": "/modes/0/omega"}, ["200.637"])
        self.assertEqual((item["correct"], item["diagnosis"]["slip"]), (False, "degrees"))

    def test_sets_and_angles_modulo_a_turn(self):
        right = "0, 180deg, 38.298deg, -38.298deg"
        cases = [(right, True), ([0, math.pi, 0.668423, -0.668423], True), ("(180deg, 38.298deg, -38.298deg, 360deg)", True),
                 ("0, 180deg, 38.298deg", False), ("", None), (" \n", None), ([], False), ("0, 0, 38.298deg, -38.298deg", False), ("0, 180deg, 38.298deg, -38.5deg", False)]
        self.assert_verdicts(ANGLES, cases, rule={"any_order": True, "modulo": "2pi", "rtol": 1e-4})
        turned = "360deg, 180deg, 38.298deg, -38.298deg"
        self.assert_verdicts(ANGLES, [(right, True), (turned, False)], rule={"any_order": True, "rtol": 1e-4})

    def test_mode_shapes_at_any_scale(self):
        self.assert_verdicts(SHAPE, [([1, -5], True), ("(-0.2, 1)", True), ({"theta": -10, "x": 2}, True), ([1, 5], False),
                                     ([0, 0], False), ([1, -5, 0], None), ({"x": 1}, None)], rule={"any_scale": True})
        self.assert_verdicts(SHAPE, [([1, -5], True), ([2, -10], False)])

    def test_what_does_not_exist(self):
        expect = {"turning_points": {"system": "rolling_disk_platform", "parameters": {"g": 0}}, "at": "/theta_max"}
        status, answer = self.check([{"expect": expect, "submitted": "none"}])
        if status == 200:
            self.assertIs(answer["items"][0]["correct"], True)

    def test_facts(self):
        stability = {**ANGLES, "at": "/equilibria/0/stability"}
        self.assert_verdicts(stability, [
            ("stable", True), ("Stable ", True), ("It is stable.", True), ("a stable equilibrium", True), ("unstable", False), ("instable", False),
            ("neutral", False), ("not stable", None), ("asymptotically stable", None), ("stable or unstable", None), ("", None), (3, None)])
        self.assert_verdicts({**stability, "is": "stable"}, [("yes", True), (True, True), ("no", False), ("perhaps", None)])
        self.assert_verdicts({"energy": {"system": "orbiting_pendulum"}, "at": "/validity/tension", "is": ">= 0"},
                             [("yes", True), ("no", False)])
        self.assert_verdicts({"equations": {"system": "whirling_pendulum"}, "at": "/conserved/*/name", "is": "energy"},
                             [("no", True), ("yes", False)])

    def test_a_wrong_key_is_refused_with_its_place(self):
        item = {"expect": {**TURNING_POINT, "at": "/theta_maxi"}, "submitted": 1}
        self.assertEqual(self.error(item)["pointer"], "#/items/0/expect/at")
        item["expect"] = {"turning_points": {"system": "free_spin_pendulum", "parameters": {"kk": 1}}, "at": "/theta_max"}
        self.assertEqual(self.error(item)["pointer"], "#/items/0/expect/turning_points/parameters/kk")
        item["expect"] = {"turning_point": {}}
        self.assertEqual(self.error(item)["pointer"], "#/items/0/expect")
        item["expect"] = {**TURNING_POINT, "off": "theta"}
        self.assertEqual(self.error(item)["pointer"], "#/items/0/expect/off")
        self.assertEqual(self.error({"expect": TURNING_POINT, "submitted": 1, "rule": {"digits": 3}})["pointer"], "#/items/0/rule/digits")
        self.assertEqual(self.error({"submitted": 1})["code"], "missing")

    def test_an_item_without_a_name_has_its_number(self):
        status, answer = self.ask_json("check", {"items": [{"expect": TURNING_POINT, "submitted": "55.13deg"}, {"expect": TURNING_POINT, "id": "b"}]})
        self.assertEqual((status, [item["id"] for item in answer["items"]]), (200, ["1", "b"]))
        status, answer = self.ask_json("check", {"items": [{"expect": TURNING_POINT}, {"expect": TURNING_POINT, "id": "1"}]})
        self.assertEqual((status, answer["errors"][0]["code"]), (422, "duplicate_name"))

    def test_a_key_alone_has_no_verdict(self):
        status, answer = self.check([{"expect": TURNING_POINT}])
        self.assertEqual((status, answer["gradable"], answer["items"][0]["correct"]), (200, False, None))


class Formulas(Check):
    def test_kinetic_energy(self):
        self.assert_verdicts({"expression": {"system": "spring_pendulum"}, "of": "T"}, [
            ("m/2 (l'^2 + l^2 theta'^2)", True), ("T = 1/2 m l'^2 + 1/2 m l^2 theta'^2", True),
            (r"T=\frac{m}{2}\left(\dot l^2+l^2\dot\theta^2\right)", True), ("½ m (l̇² + l²θ̇²)", True),
            ("m/2 (l'^2 + l^2 theta'^2) - 1e-30 m", False), ("m/2 (l'^2 + l theta'^2)", False), ("m (l'^2 + l^2 theta'^2)", False),
            ("m/2 (l'^2 + L^2 theta'^2)", None), ("m/2 (", None), ("a = b", None), (7, False), ([1], None)])

    def test_letters_and_numbers_of_what_is_given(self):
        expect = {"equation": {"system": "cart_pendulum", "parameters": {"M": "2*m", "g": 9.81, "l": "50 cm"}}, "of": "theta"}
        self.assert_verdicts(expect, [
            ("l theta'' + x'' cos(theta) + g sin(theta) = 0", True), ("0.5 theta'' + x'' cos(theta) + 9.81 sin(theta) = 0", True),
            ("1/2 theta'' + x'' cos(theta) + 9.8 sin(theta) = 0", False)])
        expect["of"] = "x"
        self.assert_verdicts(expect, [("3 m x'' + m l (theta'' cos(theta) - theta'^2 sin(theta)) + k x = 0", True),
                                      ("(M+m) x'' + m l (theta'' cos(theta) - theta'^2 sin(theta)) + k x = 0", True),
                                      ("2 m x'' + m l (theta'' cos(theta) - theta'^2 sin(theta)) + k x = 0", False)])

    def test_a_momentum_stands_for_what_it_is(self):
        spring = {"expression": {"system": "spring_pendulum"}, "of": "T"}
        self.assert_verdicts(spring, [("p_l^2/(2 m) + p_theta^2/(2 m l^2)", True), ("p_l l'/2 + p_theta theta'/2", True),
                                      ("p_l^2/m + p_theta^2/(2 m l^2)", False)])
        spin = {"equation": {"system": "free_spin_pendulum"}, "of": "theta"}
        text = "theta'' = {}p_psi^2 cos(theta)/(m^2 l^4 (1/2 + sin(theta))^3) - g/l sin(theta)"
        self.assert_verdicts(spin, [(text.format(""), True), (text.format("-"), False)])

    def test_nothing_is_given_by_itself(self):
        for of, circular, right in (("theta_ddot", "theta''", "-(g sin(theta) + 2 l' theta')/l"), ("p_l", "p_l", "m l'"),
                                    ("theta_ddot", "2 theta'' + (g sin(theta) + 2 l' theta')/l", "-g/l sin(theta) - 2 l' theta'/l")):
            self.assert_verdicts({"expression": {"system": "spring_pendulum"}, "of": of}, [(circular, None), (right, True)])

    def test_a_moment_of_inertia_about_another_point_is_named(self):
        rod = "l*({}*theta'' + phi''*cos(theta - phi) + phi'^2*sin(theta - phi)) + 3/2*g*sin(theta) = 0"
        energy = "m*l^2*({}*theta'^2 + 1/2*phi'^2 + theta'*phi'*cos(theta - phi))"
        disk = "{}*q'' - Omega^2*q + g*sin(Omega*t) = 0"
        cases = [({"equation": {"system": "rod_pendulum"}, "of": "theta"}, rod, ("(1 + 1/12)", "(1 + 1/3 + 1/4)"), "(1 + 1/6)"),
                 ({"expression": {"system": "rod_pendulum"}, "of": "T"}, energy, ("(1/2 + 1/24)", "(2/3 + 1/8)"), "(1/2 + 1/12)"),
                 ({"equation": {"system": "rolling_disk_platform"}, "of": "q"}, disk, ("5/2",), "2")]
        for expect, text, other_points, factor in cases:
            slips = [item["diagnosis"]["slip"] for item in self.verdicts(expect, [text.format(p) for p in (*other_points, factor)])]
            self.assertEqual(slips, ["moment_of_inertia"] * len(other_points) + ["factor"])

    def test_four_coordinates(self):
        ends = [", ".join(["l*({})".format(" + ".join(f"{f}({q})" for q in "abcd"[:n])) for f in ("sin", "-cos")]) for n in range(1, 5)]
        scene = {"name": "chain", "gravity": ["0", "-g"],
                 "parameters": [{"name": n, "unit": u, "default": 1, "meaning": n} for n, u in (("m", "kg"), ("l", "m"), ("g", "m/s^2"))],
                 "coordinates": [{"name": q, "unit": "rad", "initial": 0.1, "initial_rate": 0, "meaning": q} for q in "abcd"],
                 "bodies": [{"kind": "particle", "name": f"bob{i}", "mass": "m", "position": end.split(", ")} for i, end in enumerate(ends)]}
        status, answer = self.ask_json("equations", {"system": scene})
        self.assertEqual(status, 200, answer)
        texts = [entry["equation"] for entry in answer["equations_of_motion"]]
        sides = [f"({entry['left']})" for entry in answer["equations_of_motion"]]
        self.assert_verdicts({"equation": {"system": scene}, "of": "b"}, [
            (texts[1], True), (f"m*cos(a)*{sides[1]} + 3*{sides[2]} = 0", True), (f"{sides[1]}^2 = 0", True), (texts[0], False),
            (f"{sides[1]} + l*a'*b'/10^6 = 0", False), (f"{sides[1]}*b'' = 0", False)])
        self.assert_verdicts({"equation": {"system": scene}}, [
            (texts, True), ([*texts[:3], f"{sides[3]} + {sides[0]} = 0"], True), ([*texts[:3], f"{sides[1]} + 2*{sides[0]} = 0"], False),
            ([*texts[:3], "0 = 0"], False)])
        self.assert_verdicts({"expression": {"system": scene}, "of": "a_ddot"}, [("a''", None), ("-g/l*sin(a)", False)])

    def test_other_names_of_energies_and_chains_of_equals_signs(self):
        kinetic = "m/2 (l'^2 + l^2 theta'^2)"
        self.assert_verdicts({"expression": {"system": "spring_pendulum"}, "of": "T"},
                             [(f"{name} = {kinetic}", True) for name in ("T", "K", "KE", "E_k", r"E_{kin}")] + [(f"V = {kinetic}", None)])
        lagrangian = kinetic + " + m g l cos theta - k/2 (l - l0)^2"
        for head in ("L =", "L = T - V =", r"\mathcal{L} ="):
            self.assert_verdicts({"expression": {"system": "spring_pendulum"}, "of": "L"}, [(f"{head} {lagrangian}", True)])
            self.assert_verdicts({"equation": {"system": "spring_pendulum"}}, [(f"{head} {lagrangian}", True), (f"{head} {kinetic}", False)])
        self.assert_verdicts({"expression": {"system": "cart_pendulum"}, "of": "V"}, [("K = k x^2/2 - m g l cos theta", None)])

    def test_another_zero_of_the_potential_is_an_energy(self):
        potential = "k x^2/2 - m g l cos theta"
        self.assert_verdicts({"expression": {"system": "cart_pendulum"}, "of": "V"},
                             [(potential + more, verdict) for more, verdict in (("", True), (" + m g l", True), (" + 7", None), (" + l", None), (" + k", None))])
        given = {"expression": {"system": "cart_pendulum", "parameters": {"m": 2, "g": 10, "l": 1}}, "of": "V"}
        self.assert_verdicts(given, [("k x^2/2 - 20 cos theta + 20", True), ("k x^2/2 + 20 (1 - cos theta)", True)])

    def test_rates_of_momenta(self):
        self.assert_verdicts({"equation": {"system": "spring_pendulum"}, "of": "theta"}, [
            ("p_theta' = -m g l sin theta", True), (r"\dot p_\theta = -mgl\sin\theta", True), ("d/dt p_theta = -m g l sin theta", True),
            ("p_theta' = m g l sin theta", False), ("p_theta'' = 0", None)])
        self.assert_verdicts({"equation": {"system": "free_spin_pendulum"}, "of": "psi"}, [("p_psi' = 0", True)])

    def test_labels_of_equations_are_no_factors(self):
        first, second = "m l'' = m l theta'^2 + m g cos theta - k(l-l0)", "l theta'' + 2 l' theta' + g sin theta = 0"
        self.assert_verdicts({"equation": {"system": "spring_pendulum"}}, [
            (f"(1) {first}\n(2) {second}", True), ([f"(1) {first}", f"(2) {second}"], True), (f"1. {first}\n2. {second}", True),
            (f"{first}  (1)\n{second}  (2)", True), (f"l: {first}\nθ: {second}", True), (f"(1) {first}\n(2) {second} + 1", False)])

    def test_states_of_first_order_have_names_of_their_own(self):
        state = "x1 = l, x2 = l', x3 = theta, x4 = theta', x1' = x2, x3' = x4"
        rates = "x2' = x1 x4^2 + g cos x3 - k/m (x1 - l0), x4' = -(2 x2 x4 + g sin x3)/x1"
        self.assert_verdicts({"equation": {"system": "spring_pendulum"}}, [
            (f"{state}, {rates}", True), (f"{state}, {rates} + 1", False), (f"l' = v, theta' = w, v' = l w^2 + g cos theta - k/m (l - l0), w' = -(2 v w + g sin theta)/l", True)])

    def test_systems_of_first_order_and_lagrangians(self):
        self.assert_verdicts({"equation": {"system": "whirling_pendulum"}}, [
            ("theta' = w; w' = sin(theta) (Omega^2 cos(theta) - g/l)", True), ("v = theta'\nv' = sin(theta) (Omega^2 cos(theta) - g/l)", True),
            (["dtheta/dt = w", "dw/dt = sin(theta) (Omega^2 cos(theta) - g/l)"], True), ("theta' = w; w' = -g/l sin(theta)", False),
            (r"\dot\theta = u \\ \dot u = \sin\theta\left(\Omega^2\cos\theta-\frac gl\right)", True), ("theta' = w; theta' = w", False),
            ("L = m l^2 theta'^2/2 + m Omega^2 l^2 sin(theta)^2/2 + m g l cos(theta)", True),
            ("L = m l^2 theta'^2/2 + m Omega^2 l^2 sin(theta)^2/2 - m g l cos(theta)", False), ("L = 0", False), ("L = theta'", False)])
        self.assert_verdicts({"equation": {"system": "cart_pendulum"}}, [
            ("L = (M+m)/2 x'^2 + m l x' theta' cos(theta) + m l^2 theta'^2/2 - k x^2/2 + m g l cos(theta) + 7 x'", True),
            ("L = (M+m)/2 x'^2 + m l x' theta' cos(theta) + m l^2 theta'^2/2 - k x^2/2 + m g l cos(theta) + 7 x' theta", False)])

    def test_a_slip_that_takes_the_acceleration_away_is_told(self):
        for system, of, submitted, slip in (
                ("spring_pendulum", "theta", "2 l' theta' + g sin(theta) = 0", "dropped_term"),
                ("spring_pendulum", "theta", "m*(2 l' theta' + g sin(theta))/7 = 0", "dropped_term"),
                ("spring_pendulum", "l", "m l theta'^2 + m g cos(theta) - k (l - l0) = 0", "dropped_term"),
                ("cart_pendulum", "theta", "g sin(theta) + l = -x'' cos(theta)", "exponent"),
                ("spring_pendulum", "theta", "l + 2 l' theta' + g sin(theta) = 0", "exponent"),
                ("spring_pendulum", "theta", "2 l' theta' - g sin(theta) = 0", None), ("spring_pendulum", "theta", "theta' = 0", None)):
            item, = self.verdicts({"equation": {"system": system}, "of": of}, [submitted])
            with self.subTest(submitted=submitted):
                self.assertIs(item["correct"], False)
                self.assertEqual(item["diagnosis"] and item["diagnosis"]["slip"], slip)
        item, = self.verdicts({"equation": {"system": "spring_pendulum"}}, ["k l - k l0 - m g cos(theta) = m l theta'^2; l theta'' + 2 l' theta' + g sin(theta) = 0"])
        self.assertEqual((item["feedback"], item["diagnosis"]["slip"]), (["Equation 1: The motion does not obey it."], "dropped_term"))

    def test_a_forgotten_lever_is_told(self):
        for submitted in ("m l^2 theta'' + 2 m l l' theta' + m g l sin theta = F cos theta", "l theta'' + 2 l' theta' + g sin theta = F cos theta",
                          "l theta'' + 2 l' theta' + g sin theta = F/m^2 cos theta"):
            item, = self.verdicts({"equation": {"system": "forced_spring_pendulum"}, "of": "theta"}, [submitted])
            self.assertEqual((item["correct"], item["diagnosis"]["slip"]), (False, "exponent"))

    def test_a_slip_in_all_terms_of_one_symbol_is_told(self):
        for system, of, submitted, slip, text in (
                ("spring_pendulum", "l", "m l'' = m l theta'^2 + m g cos theta + k (l - l0)", "sign", "The terms with k have the wrong sign."),
                ("spring_pendulum", "l", "m l'' = m l theta'^2 + m g cos theta", "dropped_term", "Several terms are missing."),
                ("free_spin_pendulum", "theta", "theta'' = -psi'^2 (1/2 + sin theta) cos theta - g/l sin theta", "sign", "The terms with psi_dot have the wrong sign."),
                ("free_spin_pendulum", "theta", "theta'' = 2 psi'^2 (1/2 + sin theta) cos theta - g/l sin theta", "factor", "The number in front of the terms with psi_dot is wrong."),
                ("free_spin_pendulum", "theta", "theta'' = 3 psi'^2 (1/2 + sin theta) cos theta + g/l sin theta", None, None)):
            item, = self.verdicts({"equation": {"system": system}, "of": of}, [submitted])
            with self.subTest(submitted=submitted):
                self.assertIs(item["correct"], False)
                self.assertEqual(item["diagnosis"], slip and {"slip": slip, "text": text})

    def test_a_line_that_is_missing_or_says_nothing_is_told(self):
        first, second = "(M + m) x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) + k x = 0", "l theta'' + x'' cos(theta) + g sin(theta) = 0"
        one, idle, twice = self.verdicts({"equation": {"system": "cart_pendulum"}}, [first, [first, "0 = 0"], [second, second]])
        self.assertEqual(one["format_errors"], ["2 equations are asked for, one a line, and 1 is here"])
        self.assertEqual(idle["feedback"], ["Equation 2: It holds whatever the motion is, so it says nothing about it."])
        self.assertEqual(twice["feedback"], ["One of the equations follows from the others."])

    def test_ones_own_formula(self):
        self.assert_verdicts({"expression": {"system": "whirling_pendulum"}, "is": "sqrt(g/l)"},
                             [("sqrt(g/l)", True), ("(g/l)^(1/2)", True), (r"\sqrt{\frac{g}{l}}", True), ("sqrt(g l)/l", True),
                              ("sqrt(l/g)", False), ("g/l", False)])

    def test_what_was_understood_is_shown(self):
        item, = self.verdicts({"equation": {"system": "rotating_l_bar"}, "of": "theta"}, ["theta'' = w^2 cos theta"], names={"w": "Omega"})
        self.assertEqual(item["understood"], {"text": "theta_ddot = Omega^2*cos(theta)", "latex": r"\ddot\theta = \Omega^2 \cos\theta"})

    def test_a_counterexample_can_be_checked_by_hand(self):
        item, = self.verdicts({"equation": {"system": "whirling_pendulum"}, "of": "theta"}, ["theta'' = Omega^2 cos(theta) sin(theta) + g/l sin(theta)"])
        self.assertEqual(item["decided_by"], "counterexample")
        state, value = item["counterexample"]["state"], item["counterexample"]["theta_ddot"]
        sine, cosine = math.sin(state["theta"]), math.cos(state["theta"])
        self.assertAlmostEqual(value, state["Omega"] ** 2 * cosine * sine + state["g"] / state["l"] * sine, delta=1e-9 * abs(value))
        right = state["Omega"] ** 2 * cosine * sine - state["g"] / state["l"] * sine
        self.assertGreater(abs(value - right), 1e-6)

    def test_rounded_numbers_where_the_key_allows_them(self):
        energy = {"expression": {"system": "rod_pendulum"}, "of": "T"}
        rounded = "m l^2 (0.667 theta'^2 + 0.5 phi'^2 + theta' phi' cos(theta - phi))"
        self.assert_verdicts(energy, [(rounded, False)])
        self.assert_verdicts(energy, [
            (rounded, True), ("m l^2 (2/3 theta'^2 + phi'^2/2 + theta' phi' cos(theta - phi))", True),
            ("m l^2 (0.65 theta'^2 + 0.5 phi'^2 + theta' phi' cos(theta - phi))", False), ("m l^2 (0.667 theta'^2 + 0.5 phi'^2)", False),
            ("m l^2 (0.667 theta'^2 + 0.5 phi'^2 + theta' phi')", False), ("0", False)], rule={"rtol": 0.01})
        self.assertEqual(self.verdicts(energy, [rounded], rule={"rtol": 0.01})[0]["decided_by"], "rule")
        equation = {"equation": {"system": "rotating_l_bar"}, "of": "theta"}
        right = "{} theta'' - {} Omega^2 sin theta cos theta - 1.5 Omega^2 (sin^2 theta - cos^2 theta) = -g/(2l)*(15 sin theta - cos theta)"
        self.assert_verdicts(equation, [(right.format(18.3333, 17.6667), False)])
        padding = "1000000*(sin(theta)^2 + cos(theta)^2 - 1) + "
        self.assert_verdicts(equation, [
            (right.format(18.3333, 17.6667), True), (right.format("55/3", "53/3"), True), (right.format(18.3333, 11.6667), False),
            (right.format(19, 17.6667), False), (padding + "theta'' = 0", False), (padding + "0.001 theta'' = 0", False),
            ("theta'' = 0.0545 (17.667 Omega^2 sin theta cos theta + 1.5 Omega^2 (sin^2 theta - cos^2 theta) - g/(2l)*(15 sin theta - cos theta))", True),
            ("theta'' - theta'' = 0", False), ("0 = 0", False), ("theta'' = 0.0545 (17.667 Omega^2 sin theta cos theta)", False)],
            rule={"rtol": 0.01})
        both = {"equation": {"system": "cart_pendulum", "parameters": {"M": "2*m"}}}
        lines = "{} m x'' + m l theta'' cos theta - m l theta'^2 sin theta + k x = 0\nl theta'' + x'' cos theta + g sin theta = 0"
        self.assert_verdicts(both, [(lines.format("2.99"), True), (lines.format("2.9"), False)], rule={"rtol": 0.005})

    def test_other_rules_are_for_numbers(self):
        for rule in ({"any_order": True}, {"kind": "sigfig"}, {"atol": 0.1}, {}, {"rtol": 0.1, "unit": "required"}):
            error = self.error({"expect": {"equation": {"system": "rotating_l_bar"}, "of": "theta"}, "rule": rule, "submitted": "x = 0"})
            self.assertEqual((error["pointer"], error["code"]), ("#/items/0/rule", "unused"))

    def test_wrong_keys(self):
        self.assertEqual(self.error({"expect": {"expression": {"system": "cart_pendulum"}, "of": "K"}, "submitted": ""})["pointer"], "#/items/0/expect/of")
        self.assertEqual(self.error({"expect": {"equation": {"system": "cart_pendulum"}, "of": "phi"}, "submitted": ""})["allowed"], ["x", "theta"])
        self.assertEqual(self.error({"expect": {"equation": {"system": "cart"}}, "submitted": ""})["pointer"], "#/items/0/expect/equation/system")
        self.assertEqual(self.error({"expect": {"equation": {"system": "cart_pendulum", "parameters": {"k": "2*k"}}}, "submitted": ""})["code"], "circular")
        self.assertEqual(self.error({"expect": {"equation": {"system": "cart_pendulum"}}, "submitted": "", "names": {"w": "W"}})["pointer"], "#/items/0/names/w")

    def test_every_equation_that_is_printed_is_right(self):
        for system in [s["name"] for s in self.get_json("/v1/systems")["systems"]]:
            for form in ("text", "latex", "sympy", "maxima"):
                printed = self.get_json(f"/v1/equations?system={system}&form={form}")
                for one in printed["equations_of_motion"]:
                    expect = {"equation": {"system": system}, "of": one["coordinate"]}
                    self.assert_verdicts(expect, [(one["equation"], True), (f"{one['left']} = {one['right']} + 1", False)]
                                         if form != "sympy" else [(one["equation"], True)])
                equations = [one["equation"] for one in printed["equations_of_motion"]]
                self.assert_verdicts({"equation": {"system": system}}, [(equations, True), ("\n".join(equations), True)])

    def test_every_formula_that_is_printed_is_right(self):
        for system in [s["name"] for s in self.get_json("/v1/systems")["systems"]]:
            for form in ("text", "latex", "maxima"):
                printed = self.get_json(f"/v1/equations?system={system}&form={form}")
                for name, formula in [(n, printed[n]) for n in "TVL"] + [("h", printed["jacobi_integral"]), ("H", printed["hamiltonian"])] + list(printed["momenta"].items()):
                    if formula is None:
                        continue
                    with self.subTest(system=system, form=form, name=name):
                        self.assert_verdicts({"expression": {"system": system}, "of": name}, [(formula, True), (f"{formula} + {printed['T']}", False)])


if __name__ == "__main__":
    unittest.main()
