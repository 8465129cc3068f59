"""Small oscillations over HTTP: the reference cases, the practice sheet's numbers, and laws on random parameters."""

import cmath
import json
import math
import pathlib
import random
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, reference_cases, textbook_scene  # noqa: E402
from short_scene import G, lagrangian, particle, scene  # noqa: E402

PROMISED = 1e-12  # relative
ROUND_OFF = 1e-15  # what a stated error may be of its value


class Modes(Service):
    def modes(self, system, parameters=None, **more):
        found = self.ask("modes", {"system": system, "parameters": parameters or {}} | more)
        omegas = [mode["omega"] for mode in found["modes"]]
        self.assertEqual(omegas, sorted(omegas))
        return found

    def assert_near(self, actual, expected, relative=PROMISED):
        self.assertLessEqual(abs(actual - expected), relative*abs(expected), (actual, expected))

    def assert_shape(self, shape, expected, relative=PROMISED):
        self.assertEqual(list(shape), list(expected))
        for name, number in expected.items():
            self.assert_near(shape[name], number, relative)

    def test_reference_cases(self):
        count = 0
        for case in reference_cases("modes"):
            with self.subTest(case["id"]):
                count += 1
                found, expected = self.modes(case["system"], case["parameters"]), case["expected"]
                self.assertEqual(found["equilibrium"]["stability"], "stable")
                self.assertEqual(found["coordinates"], list(expected["mode_shapes"][0]))
                for name, number in expected["equilibrium"].items():
                    self.assert_near(found["equilibrium"]["state"][name], number)
                    self.assertLessEqual(found["equilibrium"]["error"][name], ROUND_OFF)
                self.assertEqual(len(found["modes"]), len(expected["omega"]))
                for i, mode in enumerate(found["modes"]):
                    self.assertEqual(mode["kind"], "oscillation")
                    self.assert_near(mode["omega"], expected["omega"][i])
                    self.assert_near(mode["f"], expected["frequency_hz"][i])
                    self.assert_near(mode["period"], 1/expected["frequency_hz"][i])
                    self.assertLessEqual(mode["error"], ROUND_OFF*mode["omega"])
                    self.assertLessEqual(abs(mode["omega"] - expected["omega"][i]), mode["error"] + 1e-15*mode["omega"])
                    self.assert_shape(mode["shape"], expected["mode_shapes"][i])
        self.assertEqual(count, 5)

    def test_the_sheets_fourth_problem(self):
        found = self.modes("cart_pendulum")
        slow, fast = found["modes"]
        self.assert_near(slow["lambda"], 0.5)
        self.assert_near(fast["lambda"], 2)
        self.assert_shape(slow["shape_scaled"], {"x": 1, "theta": 1})
        self.assert_shape(fast["shape_scaled"], {"x": 1, "theta": -2})
        m, length, g = 0.5, 0.4, 9.81
        for row, expected in zip(found["mass_matrix"] + found["stiffness_matrix"],
                                 [[3*m, m*length], [m*length, m*length**2], [2*m*g/length, 0], [0, m*g*length]]):
            for actual, number in zip(row, expected):
                self.assert_near(actual, number)
        self.assertEqual(found["gyroscopic_matrix"], [[0, 0], [0, 0]])
        self.assertNotIn("damping_matrix", found)
        self.assertEqual(found["units"]["mass_matrix"], [["kg", "kg*m"], ["kg*m", "kg*m^2"]])
        self.assertEqual(found["units"]["stiffness_matrix"][0][0], "kg/s^2")

    def test_the_sheets_fifth_problem(self):
        slow, fast = self.modes("rod_pendulum")["modes"]
        self.assert_near(slow["lambda"], (17 - math.sqrt(217))/4)
        self.assert_near(fast["lambda"], (17 + math.sqrt(217))/4)
        self.assert_near(slow["shape"]["phi"], 1.3109099885546863)
        self.assert_near(fast["shape"]["phi"], -1.1442433218880196)

    def test_a_query_gives_the_bytes_that_the_body_gives(self):
        posted = self.post("modes", {"system": "cart_pendulum", "parameters": {"k": 19.62}, "digits": 6,
                                     "equilibrium": {"theta": "180deg"}})
        got = self.get("modes", {"system": "cart_pendulum", "k": 19.62, "digits": 6, "equilibrium.theta": "180deg"})
        self.assertEqual((posted.status, got.status), (200, 200), got.data[:300])
        self.assertEqual(got.data, posted.data)
        found = json.loads(got.data)
        self.assertEqual(found["equilibrium"]["stability"], "unstable")
        self.assertEqual([mode["kind"] for mode in found["modes"]], ["growth", "oscillation"])
        self.assertGreater(found["modes"][1]["error"], 1e-7*found["modes"][1]["omega"]/10)  # of six digits

    def simulated_period(self, request, found, mode, amplitude):
        """From the equilibrium along Re(shape e^(i omega t)): the first coordinate that moves turns twice a period."""
        state, omega = dict(found["equilibrium"]["state"]), mode["omega"]
        components = {q: (c["re"], c["im"]) if isinstance(c, dict) else (c, 0) for q, c in mode["shape"].items()}
        size = amplitude/max(math.hypot(*c) for c in components.values())
        for q, (re, im) in components.items():
            state[q] += size*re
            state[q + "_dot"] -= size*omega*im
        leader = next(q for q, c in components.items() if c != (0, 0))
        motion = self.ask("simulate", request | {"initial": state, "t_end": 3.3*mode["period"], "samples": 2, "rtol": 1e-13,
                                                 "atol": 1e-16, "method": "erk", "events": [f"{leader}_dot=0"],
                                                 "on_invalid": "continue"})
        return [event["t"] for event in motion["events"] if event["t"] > mode["period"]/4][5]/3

    def check_simulated(self, system, parameters, initial, tolerance, amplitude=1e-6):
        request = {"system": system, "parameters": parameters}
        found = self.ask("modes", request | {"initial": initial})
        oscillations = [mode for mode in found["modes"] if mode["kind"] == "oscillation"]
        self.assertTrue(oscillations)
        for mode in oscillations:
            with self.subTest(system, parameters=parameters, mode=mode):
                self.assert_near(self.simulated_period(request, found, mode, amplitude), mode["period"], tolerance)

    def test_small_simulated_oscillations_have_the_frequencies(self):
        """To the amplitude, by which quadratic terms mix modes; in symmetric systems to its square and round-off."""
        draw = random.Random(11).uniform
        for _ in range(5):
            g, length, mass = draw(2, 20), draw(0.2, 2), draw(0.2, 4)
            common = {"m": mass, "l": length, "g": g}
            rate = math.sqrt(g/length)
            self.check_simulated("cart_pendulum", common | {"M": draw(0.2, 4), "k": draw(1, 80)}, {}, 1e-8)
            self.check_simulated("rod_pendulum", common, {}, 1e-8)
            spring = {"k": draw(5, 200), "l0": draw(0.3, 2)}
            self.check_simulated("rod_spring_pendulum", common | spring, {}, 1e-4)
            self.check_simulated("spring_pendulum", {"m": mass, "g": g} | spring, {}, 1e-4)
            self.check_simulated("whirling_pendulum", common | {"Omega": draw(1.1, 3)*rate}, {}, 1e-4)
            self.check_simulated("rotating_l_bar", common | {"Omega": draw(0, 3)*rate}, {}, 1e-4)
            self.check_simulated("orbiting_pendulum", {"m": mass, "l": length, "r": draw(0.2, 2), "omega0": draw(1, 5)}, {}, 1e-8)
            self.check_simulated("free_spin_pendulum", common, {"psi_dot": draw(0.5, 4)*rate}, 1e-4)

    def test_whirling_and_spinning(self):
        found = self.modes("whirling_pendulum", {"Omega": 0.0}, equilibrium={"theta": math.pi})
        self.assertEqual(found["modes"][0]["kind"], "growth")
        self.assertEqual(found["modes"][0]["omega"], 0)
        cone = self.modes("free_spin_pendulum", initial={"theta": 0.6, "psi_dot": 3})
        self.assertEqual([mode["kind"] for mode in cone["modes"]], ["rigid", "oscillation"])
        self.assertEqual(cone["modes"][1]["shape"]["theta"], {"re": 1, "im": 0})
        self.assertEqual(cone["modes"][1]["shape"]["psi"]["re"], 0)
        self.assertNotEqual(cone["gyroscopic_matrix"][0][1], 0)

    def test_scenes_with_damping_and_gyroscopic_terms(self):
        scene = textbook_scene("damped_oscillator")
        decay, = self.modes(scene, {"m": 0.5, "b": 0.3, "k": 8})["modes"]
        self.assertEqual(decay["kind"], "decay")
        self.assert_near(decay["rate"], 0.3)
        self.assert_near(decay["omega"], math.sqrt(16 - 0.09))
        g, length, turning = 9.81, 67, 7.292115e-5*math.sin(0.8527)
        slow, fast = self.modes(textbook_scene("foucault"))["modes"]
        self.assert_near(fast["omega"], math.sqrt(g/length + turning**2) + turning)
        self.assert_near(slow["omega"], math.sqrt(g/length + turning**2) - turning)
        self.assert_near(fast["shape"]["y"]["im"]*slow["shape"]["y"]["im"], -1)

    def test_a_cart_that_a_state_force_balances_drifts_and_swings(self):
        """M l s^2 + D s + K - (M + m) g = 0; the cart's two eigenvalues 0 have one eigenvector between them."""
        cart = scene("balanced", f"M kg 1; m kg 0.2; l m 0.5; K N 20; D N*s 2; {G}", "x m; th rad", gravity=["0", "-g"],
                     points=[{"name": "cart", "components": ["x", "0"]}],
                     bodies=[particle("M", "x", "0"), particle("m", "x + l*sin(th)", "l*cos(th)")],
                     forces=[{"vector": ["K*th + D*th_dot", "0"], "point": "cart"}])
        draw = random.Random(4)
        for _ in range(40):
            M, m, l, K, D = (round(draw.uniform(*ends), 2) for ends in ((0.3, 3), (0.1, 1), (0.2, 2), (-20, 60), (0.1, 6)))
            with self.subTest(M=M, m=m, l=l, K=K, D=D):
                rigid, *found = self.ask("modes", {"system": cart, "parameters": {"M": M, "m": m, "l": l, "K": K, "D": D}})["modes"]
                self.assertEqual((rigid["kind"], rigid["shape"]), ("rigid", {"x": 1, "th": 0}))
                half, square = D/(2*M*l), (K - (M + m)*9.81)/(M*l)
                root = cmath.sqrt(half**2 - square)
                expected = {-half + root, -half - root} if not root.imag else {-half + root}
                self.assertEqual(len(found), len(expected))
                for s in expected:
                    sign = {"growth": 1, "decay": -1}
                    nearest = min(found, key=lambda mode: abs(sign[mode["kind"]]*mode["rate"] - s.real))
                    self.assertAlmostEqual(sign[nearest["kind"]]*nearest["rate"], s.real, 12)
                    self.assertAlmostEqual(nearest["omega"], abs(s.imag), 12)

    def test_every_system_is_answered_or_refused_with_a_sentence(self):
        for system in json.loads(self.raw("GET", "/v1/systems").data)["systems"]:
            with self.subTest(system["name"]):
                request = {"system": system["name"]}
                if system["name"] == "rolling_disk_platform":
                    problem = self.refused("modes", request)
                    self.assertEqual(problem["type"], "/errors/not-applicable")
                    self.assertIn("time", problem["detail"])
                    request["parameters"] = {"g": 0}
                self.assertTrue(self.ask("modes", request)["modes"])

    def test_mistakes(self):
        self.refused_at("modes", {"system": "cart_pendulum", "equilibrium": {"theta_dot": 1, "x": "3 rad"}},
                        "#/equilibrium/theta_dot", "#/equilibrium/x")
        problem = self.refused("modes", {"system": "forced_spring_pendulum", "inputs": {"F": "cos(t)"}})
        self.assertEqual(problem["type"], "/errors/not-applicable")
        problem = self.refused("modes", {"system": "spring_pendulum", "parameters": {"k": 0}})
        self.assertIn("no equilibrium near", problem["detail"])

    def test_powers_of_the_distance_from_a_far_place(self):
        """V = u^2/2 + u^p/p - 2 u, u = x - place: at rest where u + u^(p - 1) = 2, u = 1."""
        for place in ("2", "6.3", "1000", "9009.5", "100000", "1000000000", "300000000000"):
            for p in (4, 6, 12, 20):
                u = f"(x - {place})"
                line = {"name": "far", "units": "none", "coordinates": [{"name": "x", "initial": place}],
                        "lagrangian": f"x_dot^2/2 - ({u}^2/2 + {u}^{p}/{p} - 2*{u})"}
                with self.subTest(place=place, p=p):
                    found = self.modes(line)
                    at = found["equilibrium"]
                    self.assertLessEqual(abs(at["state"]["x"] - float(place) - 1), at["error"]["x"])
                    self.assert_near(found["modes"][0]["omega"], math.sqrt(p), 1e-13)
                    self.assertLessEqual(abs(found["modes"][0]["omega"] - math.sqrt(p)), found["modes"][0]["error"] + 2**-52 * math.sqrt(p))

    def test_a_place_that_rounding_hides_has_no_error(self):
        """u^2/2 + u^4/4, u = x - 3e11, multiplied out: beside 1e46 nothing of it is seen."""
        line = {"name": "far", "units": "none", "coordinates": [{"name": "x", "initial": "300000000000.3"}],
                "lagrangian": "x_dot^2/2 - 1/4*(8.10000000000000000000018e+45 + x*(x*(5.40000000000000000000002e+23"
                              " + x*(x - 1200000000000)) - 1.080000000000000000000012e+35))"}
        found = self.modes(line)
        self.assertIsNone(found["equilibrium"]["error"]["x"])
        self.assertTrue(found["equilibrium"]["reason"])
        self.assertEqual(found["modes"][0]["kind"], "neutral")
        self.assertGreater(found["modes"][0]["error"], 1)

    def test_a_kinetic_energy_of_two_signs_proves_nothing_stable(self):
        """Cherry's oscillators of opposite signs, whose frequencies are as 1 to 2, leave every neighbourhood of rest.
        Source: Whittaker, Analytical Dynamics, 182."""
        two = lagrangian("cherry", "e - 0.3", "x - 0.05; y - 0.05", "(x_dot^2 - x^2)/2 - (y_dot^2 - 4*y^2)/2 - e*x^2*y")
        for scene_of_two in (two, two | {"lagrangian": two["lagrangian"] + " + x*y_dot/4 - y*x_dot/4"}):
            found = self.modes(scene_of_two)
            self.assertEqual([mode["kind"] for mode in found["modes"]], ["oscillation"]*2)
            self.assertEqual(found["equilibrium"]["stability"], "neutral")
            self.assertIn("two signs", found["equilibrium"]["nonlinear"])
            listed = self.ask("equilibria", {"system": scene_of_two})["equilibria"]
            at_rest = [place for place in listed if place["state"]["x"] == place["state"]["y"] == 0]
            self.assertEqual([place["stability"] for place in at_rest], ["neutral"])
            self.assertEqual(at_rest[0]["nonlinear"], found["equilibrium"]["nonlinear"])
        run = self.ask("simulate", {"system": two, "t_end": 240, "samples": 2})
        self.assertGreater(abs(run["trajectory"]["x"][-1]), 20*0.05)

    def test_linear_equations_of_two_signs_are_decided_by_their_frequencies_alone(self):
        line = "x_dot^2/2 - y_dot^2/2 - x^2/2 + w^2*y^2/2 - e*x*y"
        found = self.modes(lagrangian("opposite", "w - 2; e - 0.3", "x -; y -", line))
        self.assertEqual(found["equilibrium"]["stability"], "stable")
        self.assertEqual(self.modes(lagrangian("opposite", "w - 1; e - 0.3", "x -; y -", line))["equilibrium"]["stability"], "unstable")
        found = self.modes(lagrangian("opposite", "w - 1", "x -; y -", "x_dot^2/2 - y_dot^2/2 - x^2/2 + w^2*y^2/2"))
        self.assertEqual(found["equilibrium"]["stability"], "neutral")

    def test_a_kinetic_energy_of_one_sign_does_not_mind_which(self):
        turned = self.modes(lagrangian("turned", "", "x -; y -", "-(x_dot^2 + y_dot^2 - x^2 - 4*y^2 + x^2*y)/2"))
        self.assertEqual(turned["equilibrium"]["stability"], "stable")


if __name__ == "__main__":
    unittest.main()
