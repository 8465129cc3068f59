"""Turning points through HTTP: reference cases, what each motion is called, and requests that are not in order."""

import math
import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, reference_cases, textbook_scene  # noqa: E402
from short_scene import lagrangian  # noqa: E402

PLANE = textbook_scene("plane_pendulum")


class TurningPoints(Service):
    def within(self, answer, name, expected, relative=1e-13):
        """Within its stated error, and that error small."""
        self.assertLessEqual(abs(answer[name] - expected), answer["error"][name] + 2e-16*abs(expected), name)
        self.assertLessEqual(answer["error"][name], relative*abs(expected), name)

    def test_no_motion_passes_a_place_without_inertia(self):
        for text, start, where in (("m*x^2*x_dot^2/2 - k*x^2/2", "x - 0.5", "x = 0"), ("m*x^2*x_dot^2/2 - k*x^4/4", "x - 0.5", "x = 0"),
                                   ("m*cos(x)^2*x_dot^2/2 - k*sin(x)^2/2", "x - 0 5", "1.570796"), ("m*(x - 2)^2*x_dot^2/2 + k*x", "x - 0.5", "2")):
            with self.subTest(text):
                answer = self.ask("turning_points", {"system": lagrangian("wire", "m - 1; k - 3", start, text)})
                self.assertIsNone(answer["motion"])
                self.assertNotIn("period", {name for name, value in answer.items() if value is not None})
                self.assertIn("its inertia is zero to within rounding", str(answer))
                self.assertIn(where.replace("x = ", ""), str(answer))
        endless = self.ask("turning_points", {"system": lagrangian("wire", "m - 1; n - 3", "x - 0.5", "m/cos(x)*x_dot^2/2 - n*x")})
        self.assertIn("its inertia has no bound", endless["reason"]["x_min"])
        for inertia in ("m/x", "m/x^2", "m/x^4"):
            steep = self.ask("turning_points", {"system": lagrangian("wire", "m - 1; k - 3", "x - 0.5", inertia + "*x_dot^2/2 - k*x")})
            self.assertIn("x does not turn before 0, where its inertia has no bound", steep["reason"]["x_min"])
        free = self.ask("turning_points", {"system": lagrangian("wire", "m - 1; k - 3", "x - 0.5", "m/(1 + x^2)*x_dot^2/2 + k*x")})
        self.assertEqual(free["motion"], "unbounded")
        swings = self.ask("turning_points", {"system": lagrangian("wire", "m - 1; k - 3", "x - 1.5", "m*x^2*x_dot^2/2 - k*(x - 1)^2/2")})
        self.assertEqual(swings["motion"], "libration")

    def test_from_rest_half_a_last_digit_beside_a_kinked_top(self):
        """V = z^2 - |z|/2: from just above the top to the other side of the well, half a unit away."""
        for start, top in (("1000.50000000000003", "1000.5"), ("0.375", "0.37499999999999999"), ("-0.3756400000000000100459", "-0.37564"),
                           ("1000.30000000000003", "1000.3")):
            side = 1 if float(start) > 0 else -1
            scene = lagrangian("top", "", f"x - {start} 0", f"x_dot^2/2 - (x - ({top}))^2 + abs(x - ({top}))/2")
            found = self.ask("turning_points", {"system": scene})
            far, near = (found["x_max"], found["x_min"])[::side]
            self.assertEqual((found["motion"], found["initial_is"]), ("libration", "min" if side > 0 else "max"))
            self.assertLess(abs(far - (float(top) + side/2)), 1e-12)
            self.assertLess(abs(near - float(start)), 1e-12)

    def test_beside_a_known_end_the_other_is_a_root_of_a_quadratic_in_the_cosine(self):
        """A spherical pendulum (Landau, Lifshitz, Mechanics, section 14), and a bead on a hoop that turns freely: formulas against numbers elsewhere."""
        place = ["a*sin(th)*cos(phi)", "a*sin(th)*sin(phi)", "-a*cos(th)"]
        hoop = {"kind": "rigid_body", "mass": "m", "principal_moments": ["I", "I", "I"], "centre": ["0", "0", "0"],
                "orientation": {"sequence": "Z", "angles": ["phi"]}}
        bead = {"kind": "particle", "mass": "m", "position": place}
        functions = {name: getattr(math, name) for name in ("acos", "sqrt", "sin", "cos")}
        for bodies, rate, start in (([bead], "w", "c"), ([hoop, bead], "w", "c"), ([hoop, bead], "5", "0.5")):
            names = {"m": "1", "a": "0.3", "I": "0.05", "g": "9.81", "w": "5", "c": "0.5"}
            units = {"m": "kg", "a": "m", "I": "kg*m^2", "g": "m/s^2", "w": "rad/s", "c": "rad"}
            system = {"name": "hoop", "gravity": ["0", "0", "-g"], "bodies": bodies,
                      "parameters": [{"name": name, "unit": units[name], "default": value} for name, value in names.items()],
                      "coordinates": [{"name": "phi", "unit": "rad", "initial": "0", "initial_rate": rate},
                                      {"name": "th", "unit": "rad", "initial": start}]}
            for other in ({}, {"m": 0.7, "a": 0.8, "I": 0.3, "g": 3.7, "w": 6, "c": 0.9}):
                with self.subTest((len(bodies), rate, other)):
                    answer = self.ask("turning_points", {"system": system, "coordinate": "th", "parameters": other})
                    end = "th_min" if answer["initial_is"] == "max" else "th_max"
                    values = {name: float(value) for name, value in names.items()} | other | answer["constants"] | functions
                    self.assertAlmostEqual(eval(answer["exact"][end]["text"].replace("^", "**"), values), answer[end], 12)  # noqa: S307

    def test_reference_cases(self):
        count = 0
        for case in reference_cases("turning_points"):
            with self.subTest(case["id"]):
                answer = self.ask("turning_points", {name: case[name] for name in ("system", "parameters", "initial")})
                expected = case["expected"]
                self.assertEqual((answer["method"], answer["motion"]), ("energy", "libration"))
                for name in set(expected) & set(answer):
                    self.within(answer, name, expected[name])
                    count += 1
                energy = expected.get("energy", expected.get("jacobi"))
                self.assertAlmostEqual(answer["constants"].get("E", answer["constants"].get("h")), energy, delta=1e-13)
                if "beta" in expected:
                    self.assertAlmostEqual(answer["constants"]["p_psi"], expected["beta"], delta=1e-14)
        self.assertGreaterEqual(count, 7)

    def test_problem_8_is_the_sheets_equation(self):
        answer = self.ask("turning_points", {"system": "free_spin_pendulum"})
        self.assertEqual(answer["initial_is"], "min")
        self.assertEqual(answer["theta_min"], 0)
        self.within(answer, "theta_max", 0.962233337506167438619)
        self.assertAlmostEqual(answer["theta_max_deg"], 55.131909145890694733, delta=1e-12)
        self.assertEqual(answer["equation"]["text"], "p_psi^2/(2*m*l^2*(1/2 + sin(theta))^2) - m*l*g*cos(theta) = E")
        self.assertIn("\\theta", answer["equation"]["latex"])
        m, l, g = (answer["request"]["parameters"][name] for name in "mlg")
        self.assertAlmostEqual(answer["constants"]["E"], -m*g*l/2, delta=1e-15)
        self.assertEqual(answer["units"]["p_psi"], "kg*m^2/s")

    def test_problem_7b_goes_to_60_degrees_and_the_string_stays_taut(self):
        answer = self.ask("turning_points", {"system": "orbiting_pendulum"})
        self.within(answer, "phi_max", math.pi/3)
        self.assertAlmostEqual(answer["phi_max_deg"], 60, delta=1e-12)
        tension = answer["validity"]["tension"]
        p = answer["request"]["parameters"]
        self.assertTrue(tension["holds"])
        self.assertAlmostEqual(tension["min"], 5/6*p["m"]*p["l"]*p["omega0"]**2, delta=1e-12)
        self.assertAlmostEqual(tension["at"]["phi_dot"], -2/3*p["omega0"], delta=1e-4)

    def test_a_string_that_does_not_stay_taut(self):
        answer = self.ask("turning_points", {"system": "orbiting_pendulum", "initial": {"phi": 2.5, "phi_dot": 0}})
        self.assertEqual(answer["initial_is"], "max")
        self.assertFalse(answer["validity"]["tension"]["holds"])
        self.assertLess(answer["validity"]["tension"]["min"], 0)

    def test_kinds_of_motion(self):
        rate = 2*math.sqrt(9.81/0.8)
        for initial, motion in (({"theta": 1}, "libration"), ({"theta": 0, "theta_dot": 1.1*rate}, "rotation"),
                                ({"theta": 0, "theta_dot": rate}, "separatrix"), ({"theta": 0}, "equilibrium"),
                                ({"theta": 0, "theta_dot": rate*(1 - 1e-12)}, "libration"),
                                ({"theta": 0, "theta_dot": rate*(1 + 1e-12)}, "rotation")):
            with self.subTest(initial):
                answer = self.ask("turning_points", {"system": PLANE, "initial": initial})
                self.assertEqual(answer["motion"], motion)
                for name in ("theta_max", "theta_min", "period"):
                    if answer[name] is None:
                        self.assertIn(name, answer["reason"])

    def test_a_motion_that_is_followed(self):
        request = {"system": "cart_pendulum", "coordinate": "theta", "t_end": 5}
        answer = self.ask("turning_points", request)
        self.assertEqual((answer["method"], answer["status"]), ("trajectory", "complete"))
        rows = self.ask("simulate", {"system": "cart_pendulum", "t_end": 5, "samples": 20001, "rtol": 1e-12})["trajectory"]
        for name, sampled in (("theta_max", max(rows["theta"])), ("theta_min", min(rows["theta"]))):
            self.assertAlmostEqual(answer[name], sampled, delta=1e-6)
            self.assertLess(answer["error"][name], 1e-8)
        self.assertIsNone(answer["motion"])
        self.assertIn("more than one coordinate", answer["reason"]["motion"])

    def test_an_impact_turns_a_motion(self):
        wall = {"events": [{"name": "wall", "expression": "x + b", "direction": "falling"}],
                "impacts": [{"event": "wall", "restitution": "e"}]}
        spring = lagrangian("spring", "b - 0.3; e - 1", "x - 1", "x_dot^2/2 - x^2/2", **wall)
        for restitution in (1, 0.5):
            request = {"system": spring, "parameters": {"e": restitution}}
            if restitution < 1:
                self.refused_at("turning_points", request, "#/t_end")
            answer = self.ask("turning_points", request | {"t_end": 8})
            self.assertEqual(answer["method"], "trajectory" if restitution < 1 else "energy")
            self.within(answer, "x_min", -0.3, 1e-12)
            self.assertIn("'wall'", answer["reason"]["motion"] if restitution < 1 else answer["notes"][0])
            free = self.ask("turning_points", request | {"impacts": False})
            self.assertEqual((free["method"], round(free["x_min"], 12)), ("energy", -1))
        short = self.ask("turning_points", {"system": spring, "initial": {"x": 0.2}})  # it does not come to the wall
        self.assertEqual((short["method"], short["motion"]), ("energy", "libration"))
        self.refused_at("turning_points", {"system": "bouncing_ball"}, "#/t_end")
        self.within(self.ask("turning_points", {"system": "bouncing_ball", "t_end": 2}) | {}, "z_max", 1)

    def test_an_end_that_is_not_used_is_called_so(self):
        self.assertIn("'t_end' is not used", self.ask("turning_points", {"system": PLANE, "t_end": 1})["notes"][0])
        self.assertNotIn("notes", self.ask("turning_points", {"system": PLANE}))

    def test_a_spring_that_gets_stiffer_or_pushes_harder_from_a_place_on(self):
        """Beyond the kink the potential is another parabola."""
        for start, rate, potential, highest in (
            (0.1, 1.27, "x^2/2 + 2.3*(1 + sign(x - 0.662))/2*(x - 0.662)^2", 1.018675524276045686),
            (0.1, 1.27, "x^2/2 + 1.18*(1 + sign(x - 0.57))/2*(x - 0.57)", 0.908181026635382491),
            (0.797, 0.15, "2.99*x^2/2 - 1.77*x - 3.13*abs(x + 0.06) + 1.65*(x - 1.38)*sign(x - 1.38)",
             2.261047446760748326),
        ):
            with self.subTest(potential):
                system = lagrangian("kinked", "", f"x - {start} {rate}", f"x_dot^2/2 - ({potential})")
                del system["parameters"]
                answer = self.ask("turning_points", {"system": system, "coordinate": "x"})
                self.assertEqual(answer["motion"], "libration")
                self.within(answer, "x_max", highest)

    def test_what_is_not_seen_far_away_is_called_so(self):
        potential = "-x^2/2 + 0.665*(x - 0.886 + sqrt((x - 0.886)^2 + 1))^2"
        system = lagrangian("ramp", "", "x - 0.1 2.87", f"x_dot^2/2 - ({potential})")
        del system["parameters"]
        answer = self.ask("turning_points", {"system": system, "coordinate": "x"})
        self.assertIn("cannot be told in double precision", answer["reason"]["x_min"])
        self.assertNotIn("flat", answer["reason"]["x_min"])

    def test_what_a_request_lacks(self):
        self.refused_at("turning_points", {"system": "cart_pendulum"}, "#/coordinate")
        self.refused_at("turning_points", {"system": "cart_pendulum", "coordinate": "x"}, "#/t_end")
        self.refused_at("turning_points", {"system": "rolling_disk_platform"}, "#/t_end")
        self.refused_at("turning_points", {"system": "whirling_pendulum", "coordinate": "thet"}, "#/coordinate")
        self.refused_at("turning_points", {"system": "whirling_pendulum", "t_end": 0}, "#/t_end")
        self.refused_at("turning_points", {"system": "whirling_pendulum", "impacts": False}, "#/impacts")

    def test_a_query_gives_the_bytes_that_the_body_gives(self):
        posted = self.post("turning_points", {"system": "whirling_pendulum", "initial": {"theta": 0.4}, "digits": 12})
        got = self.get("turning_points", {"system": "whirling_pendulum", "theta": 0.4, "digits": 12})
        self.assertEqual((posted.status, got.status), (200, 200))
        self.assertEqual(got.data, posted.data)

    def test_formulas_of_extrema_say_at_which_of_them_the_motion_starts(self):
        for numbers, place in (({"m": 0.0825, "Omega": 3.62}, "theta_max"), ({"R": 0.715, "Omega": 8.05}, "theta_min")):
            exact = self.ask("turning_points", {"system": "bead_on_hoop", "parameters": numbers})["exact"]
            for extremum in ("theta_max", "theta_min"):
                self.assertIn(f"theta(0) = {place}", exact[extremum]["assumes"], numbers)
            self.assertNotIn(f"theta(0) = {place}", exact["equation"]["assumes"])


if __name__ == "__main__":
    unittest.main()
