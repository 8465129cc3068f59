"""Motions under constraints: against the same system in coordinates that need none, and against closed forms."""

import copy
import json
import math
import pathlib
import random
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import constrained_scenes as scenes  # noqa: E402
from service import Service  # noqa: E402

ROUND_OFF = 1e-13  # of closed forms in doubles, relative to 1


class Motions(Service):
    def motion(self, scene, t_end, samples=41, **more):
        grid = {} if "times" in more else {"samples": samples}
        include = ["multipliers"] if "constraints" in scene else []
        answer = self.ask("simulate", {"system": scene, "t_end": t_end, **grid, "include": include} | more)
        self.assertEqual(answer["status"], "complete")
        self.assertTrue(answer["accuracy"]["bounded"] or answer["accuracy"]["method"] != "taylor", answer["accuracy"])
        return answer

    def assert_true(self, answer, name, values, below=1e-5):
        """Every row of a coordinate or velocity is within its stated error of the truth."""
        error = answer["accuracy"]["max_abs_error"][name]
        self.assertLess(error, below)
        for t, found, true in zip(answer["trajectory"]["t"], answer["trajectory"][name], values):
            self.assertLessEqual(abs(found - true), 1.0001 * error + ROUND_OFF * max(1, abs(true)), (name, t))

    def assert_near(self, answer, name, values, within):
        for t, found, true in zip(answer["trajectory"]["t"], answer["trajectory"][name], values):
            self.assertLessEqual(abs(found - true), within * max(1, abs(true)), (name, t))

    def test_accelerations_have_what_a_constraint_holds_put_in_where_that_is_shorter(self):
        """A ball that rolls off a sphere: the book has its distance R + a in them."""
        system = {"name": "ball", "gravity": ["0", "-g"],
                  "parameters": [{"name": n, "unit": u, "default": "1"} for n, u in (("m", "kg"), ("R", "m"), ("a", "m"), ("g", "m/s^2"))],
                  "coordinates": [{"name": "th", "unit": "rad", "initial": "0.1"}, {"name": "phi", "unit": "rad"}, {"name": "r", "unit": "m", "initial": "R + a"}],
                  "bodies": [{"kind": "sphere", "mass": "m", "radius": "a", "centre": ["r*sin(th)", "r*cos(th)"], "angle": "-phi"}],
                  "constraints": [{"name": "contact", "expression": "r - a - R", "multiplier": "N"},
                                  {"name": "rolling", "expression": "a*phi_dot - (a + R)*th_dot", "multiplier": "F"}]}
        answer = self.ask("equations", {"system": system})["accelerations"]
        self.assertEqual(answer["th_ddot"], "5*g*sin(th)/(7*(R + a))")
        self.assertEqual(answer["F"], "2/7*m*g*sin(th)")

    def test_twelve_coordinates_and_eight_constraints(self):
        # q0 = 2 q1 = ... = 2^8 q8: these fall as one, m x'' = -F with m = sum 4^-i, F = sum 2^-i.
        n, m = 12, 8
        scene = {"name": "chained", "units": "none", "coordinates": [{"name": f"q{i}"} for i in range(n)],
                 "lagrangian": " + ".join(f"q{i}_dot^2/2 - q{i}" for i in range(n)),
                 "constraints": [{"name": f"c{i}", "expression": f"q{i} - 2*q{i + 1}"} for i in range(m)]}
        a = sum(0.5**i for i in range(m + 1))/sum(0.25**i for i in range(m + 1))
        for precision in ({}, {"precision": "extended"}):
            answer = self.motion(scene, 2, samples=5, **precision)
            self.assert_true(answer, "q0", [-a*t*t/2 for t in answer["trajectory"]["t"]])
        energy = self.ask("energy", {"system": scene})
        self.assertAlmostEqual(energy["accelerations"]["q0_ddot"], -a, 12)

    def test_a_start_at_the_origin_is_as_good_as_any(self):
        bead = {"name": "bead", "units": "none", "coordinates": [{"name": "x"}, {"name": "y"}],
                "lagrangian": "(x_dot^2 + y_dot^2)/2 - y"}
        for wire, start in [("y - cosh(x) + 1", 1), ("sqrt(x^2 + (y - 1)^2) - 1", 1), ("y - 1 + cos(x)", 0.5),
                            ("y - exp(x) + 1", 1), ("y - (1 - cos(2*t))", 1), ("y - sqrt(1 + x^2) + 1", 1)]:
            for x in (0, 1e-9):
                with self.subTest(wire=wire, x=x):
                    scene = bead | {"constraints": [{"name": "wire", "expression": wire, "multiplier": "N"}]}
                    rate = start if x == 0 else 0
                    rises = "exp" in wire
                    state = {"x": x, "x_dot": rate, "y": f"exp({x:.9f}) - 1" if rises else 0, "y_dot": rate if rises else 0}
                    answer = self.ask("simulate", {"system": scene, "initial": state, "t_end": 1, "samples": 5,
                                                   "accuracy": "accurate"})
                    error = max(answer["accuracy"]["max_abs_error"].values())
                    for t, a, b in zip(*(answer["trajectory"][name] for name in ("t", "x", "y"))):
                        where = {"x": a, "y": b, "t": t} | {name: getattr(math, name)
                                                            for name in ("cosh", "sqrt", "cos", "exp")}
                        left = eval(wire.replace("^", "**"), where)  # noqa: S307
                        self.assertLessEqual(abs(left), 10*error + 1e-14)
        flat = bead | {"constraints": [{"name": "wire", "expression": "(y - x - 0.1)^2", "multiplier": "N"}]}
        problem = self.refused("simulate", {"system": flat, "initial": {"y": 0.1}, "t_end": 1})
        self.assertIn("undetermined", problem["errors"][0]["detail"])

    def test_a_pendulum_in_x_and_y_is_that_in_its_angle(self):
        start = {"initial": {"x": "0.7*sin(2)", "y": "-0.7*cos(2)", "x_dot": "0.7*6*cos(2)", "y_dot": "0.7*6*sin(2)"}}
        found = self.motion(scenes.PENDULUM_BY_CONSTRAINT, 10, max_error=1e-9, include=["multipliers", "validity"], **start)
        true = self.motion(scenes.PENDULUM_BY_ANGLE, 10, max_error=1e-11, include=["validity"],
                           initial={"theta": 2, "theta_dot": 6})
        angles, rates = true["trajectory"]["theta"], true["trajectory"]["theta_dot"]
        self.assert_true(found, "x", [0.7 * math.sin(a) for a in angles])
        self.assert_true(found, "y_dot", [0.7 * w * math.sin(a) for a, w in zip(angles, rates)])
        self.assert_near(found, "tension", true["trajectory"]["tension"], 1e-7)
        self.assertEqual(found["units"]["lambda_string"], "kg/s^2")

    def test_two_constraints_make_a_double_pendulum(self):
        found = self.motion(scenes.DOUBLE_PENDULUM, 5, max_error=1e-8)
        true = self.motion(scenes.DOUBLE_PENDULUM_BY_ANGLES, 5, max_error=1e-10)["trajectory"]
        self.assert_true(found, "x2", [math.sin(a) + math.sin(b) for a, b in zip(true["a"], true["b"])])

    def test_a_disk_rolls_down_with_two_thirds_of_the_slope(self):
        found = self.motion(scenes.ROLLING_DISK, 2)
        slope = 9.81 * math.sin(0.4)
        self.assert_true(found, "x", [slope * t * t / 3 for t in found["trajectory"]["t"]])
        self.assert_near(found, "friction", [-2 * slope / 3] * 41, ROUND_OFF)
        self.assertEqual(found["units"]["friction"], "kg*m/s^2")

    def test_a_knife_edge_on_a_slope_comes_back(self):
        found = self.motion(scenes.KNIFE_EDGE, 6)
        unit = 9.81 * math.sin(0.3) / (2 * 2 ** 2)
        times = found["trajectory"]["t"]
        self.assert_true(found, "x", [unit * math.sin(2 * t) ** 2 for t in times])
        self.assert_true(found, "y", [unit * (2 * t - math.sin(4 * t) / 2) for t in times])

    def test_the_sleigh_turns_straight(self):
        found = self.motion(scenes.SLEIGH, 8)
        m, inertia, a, w = 1.2, 0.3 + 1.2 * 0.4 ** 2, 0.4, 1.5
        fastest = w * math.sqrt(inertia / m)
        rate = a * m * fastest / inertia
        times, theta = found["trajectory"]["t"], found["trajectory"]["theta"]
        self.assert_true(found, "theta_dot", [w / math.cosh(rate * t) for t in times])
        self.assert_true(found, "x_dot", [fastest * math.tanh(rate * t) * math.cos(angle) for t, angle in zip(times, theta)])
        self.assertIn("h", [kept["name"] for kept in found["diagnostics"]["conserved"]])

    def test_a_wire_that_turns_drives_its_bead_out(self):
        found = self.motion(scenes.ROTATING_WIRE, 3)
        times = found["trajectory"]["t"]
        self.assert_true(found, "x", [0.2 * math.cosh(1.3 * t) * math.cos(1.3 * t) for t in times])
        self.assert_near(found, "N", [-2 * 0.5 * 1.3 ** 2 * 0.2 * math.sinh(1.3 * t) for t in times], 1e-7)
        self.assertEqual(found["diagnostics"]["conserved"], [], "what turns the wire does work")

    def test_two_weights_on_a_rope(self):
        found = self.motion(scenes.ATWOOD, 1)
        self.assert_true(found, "y1", [1 + 9.81 * t * t / 10 for t in found["trajectory"]["t"]])
        self.assert_near(found, "lambda_rope", [-2 * 3 * 2 / 5 * 9.81] * 41, ROUND_OFF)
        self.assertEqual(found["diagnostics"]["conserved"][0]["name"], "energy")

    def test_dry_friction_holds_a_block_on_its_plane(self):
        found = self.motion(scenes.BLOCK_WITH_FRICTION, 2)
        slope = 9.81 * math.sin(0.3) - 8 / 2
        stop = -1 / slope
        self.assertAlmostEqual(found["sticking"][0]["from"], stop, 9)
        way = [t + slope * t * t / 2 if t < stop else stop / 2 for t in found["trajectory"]["t"]]
        self.assert_true(found, "x", [s * math.cos(0.3) for s in way])
        self.assert_near(found, "N", [2 * 9.81 * math.cos(0.3)] * 41, 1e-9)

    def test_every_method_states_its_error_and_how_far_it_drifts(self):
        true = self.motion(scenes.PENDULUM_BY_ANGLE, 5, max_error=1e-11)["trajectory"]["theta"]
        for method, more in (("taylor", {}), ("adams", {}), ("bdf", {"rtol": 1e-7}), ("erk", {}), ("gauss", {"h": 0.005})):
            with self.subTest(method=method):
                found = self.motion(scenes.PENDULUM_BY_CONSTRAINT, 5, method=method, on_invalid="continue", **more)
                self.assert_true(found, "x", [0.7 * math.sin(a) for a in true], below=1e-4)
                drift = found["diagnostics"]["constraints"][0]
                x, y = found["trajectory"]["x"], found["trajectory"]["y"]
                in_rows = max(abs(a * a + b * b - 0.49) for a, b in zip(x, y))
                self.assertLessEqual(in_rows, drift["max_abs_value"] + 1e-15)
                self.assertLessEqual(drift["max_abs_value"], 10 * in_rows + 1e-15)

    def test_a_long_motion_stays_on_its_constraint_to_round_off(self):
        found = self.motion(scenes.PENDULUM_BY_CONSTRAINT, 500, on_invalid="continue", accuracy="fast")
        drift = found["diagnostics"]["constraints"][0]
        self.assertLess(drift["max_abs_value"], 1e-6 * 0.49)  # rows between steps have the polynomials' error
        state = {name: values[-1] for name, values in found["trajectory"].items()}
        x, y = state["x"], state["y"]  # the last row ends a step
        self.assertLess(abs(x * x + y * y - 0.49), 2e-16)
        self.assertLess(abs(x * state["x_dot"] + y * state["y_dot"]), 1e-15)

    def test_a_string_goes_slack_where_the_angle_says(self):
        start = {"x": 0, "y": "-0.7", "x_dot": "sqrt(3.5*9.81*0.7)", "y_dot": 0}
        request = {"t_end": 2, "samples": 5}
        found = self.ask("simulate", {"system": scenes.PENDULUM_BY_CONSTRAINT, "initial": start} | request)
        true = self.ask("simulate", {"system": scenes.PENDULUM_BY_ANGLE, **request,
                                     "initial": {"theta": 0, "theta_dot": "sqrt(3.5*9.81/0.7)"}})
        self.assertEqual((found["status"], found["stop"]["reason"]), ("stopped", "string_slack"))
        self.assertLessEqual(abs(found["stop"]["t"] - true["stop"]["t"]), found["stop"]["error"] + true["stop"]["error"])
        event = self.ask("simulate", {"system": scenes.PENDULUM_BY_CONSTRAINT, "initial": start, "on_invalid": "continue",
                                      "events": ["lambda_string=0+"]} | request)["events"][0]
        self.assertAlmostEqual(event["t"], true["stop"]["t"], 9)

    def test_twice_the_digits_agree(self):
        found = self.ask("simulate", {"system": scenes.PENDULUM_BY_CONSTRAINT, "t_end": 3, "samples": 3,
                                      "precision": "extended", "digits": 25, "on_invalid": "continue"})
        x, y = (float(found["trajectory"][name][-1]) for name in "xy")
        self.assertAlmostEqual(x * x + y * y, 0.49, 14)
        self.assertLess(max(map(float, found["accuracy"]["max_abs_error"].values())), 1e-24)

    def test_energy_has_the_multipliers_of_a_state(self):
        found = self.ask("energy", {"system": scenes.PENDULUM_BY_CONSTRAINT, "initial": {"x": 0, "y": "-l", "x_dot": 2}})
        self.assertAlmostEqual(-2 * 0.7 * found["multipliers"]["lambda_string"], 0.3 * (9.81 + 4 / 0.7), 13)
        self.assertAlmostEqual(found["accelerations"]["y_ddot"], 4 / 0.7, 13)

    def test_other_questions_follow_the_same_motion(self):
        single = self.ask("simulate", {"system": scenes.ATWOOD, "t_end": 1, "samples": 2})["trajectory"]["y1"][-1]
        rows = self.ask("sweep", {"ask": {"simulate": {"system": scenes.ATWOOD, "t_end": 1, "samples": 2}},
                                  "vary": {"m1": {"values": [3]}}, "collect": {"y": "/trajectory/y1/1"}})
        self.assertEqual(rows["columns"]["y"], [single])
        self.ask("accuracy", {"system": scenes.PENDULUM_BY_CONSTRAINT, "t_end": 1})
        found = self.ask("turning_points", {"system": scenes.PENDULUM_BY_CONSTRAINT, "coordinate": "x", "t_end": 3})
        self.assertLessEqual(abs(found["x_min"] + 0.7 * math.sin(1)), found["error"]["x_min"] + 1e-16)
        problem = self.refused("turning_points", {"system": scenes.PENDULUM_BY_CONSTRAINT, "coordinate": "x"})
        self.assertIn("has constraints", problem["errors"][0]["detail"])


class SmallMotions(Service):
    def test_a_pendulum_swings_with_the_root_of_g_over_l(self):
        rng = random.Random(7)
        for _ in range(20):
            l, g, m = (float(f"{10 ** rng.uniform(-2, 2):.4g}") for _ in range(3))
            found = self.ask("modes", {"system": scenes.PENDULUM_BY_CONSTRAINT, "parameters": {"m": m, "l": l, "g": g}})
            mode, = found["modes"]
            with mpmath.workdps(40):
                true = mpmath.sqrt(mpmath.mpf(str(g)) / mpmath.mpf(str(l)))
                self.assertLessEqual(abs(mode["omega"] - true), mode["error"])
            self.assertLess(mode["error"], 1e-15 * true)
            self.assertEqual((mode["kind"], mode["shape"]), ("oscillation", {"x": 1, "y": 0}))
            self.assertEqual(found["equilibrium"]["stability"], "stable")

    def test_upright_it_falls(self):
        found = self.ask("modes", {"system": scenes.PENDULUM_BY_CONSTRAINT, "equilibrium": {"x": 0, "y": 0.7}})
        self.assertEqual((found["equilibrium"]["stability"], found["modes"][0]["kind"]), ("unstable", "growth"))
        self.assertAlmostEqual(found["modes"][0]["rate"], math.sqrt(9.81 / 0.7), 14)

    def test_two_pendulums_have_the_modes_of_their_angles(self):
        found = self.ask("modes", {"system": scenes.DOUBLE_PENDULUM})
        true = self.ask("modes", {"system": scenes.DOUBLE_PENDULUM_BY_ANGLES})
        self.assertEqual(len(true["modes"]), 2)
        for mode, other in zip(found["modes"], true["modes"], strict=True):
            self.assertLessEqual(abs(mode["omega"] - other["omega"]), mode["error"] + other["error"])
            self.assertAlmostEqual(mode["shape"]["x2"], 1 + other["shape"]["b"], 14)
            self.assertEqual((mode["shape"]["y1"], mode["shape"]["y2"]), (0, 0))

    def test_what_has_no_small_motions_says_why(self):
        for scene, why in ((scenes.ROLLING_DISK, "x_ddot is not 0"), (scenes.ROTATING_WIRE, "moves"),
                           (scenes.ATWOOD, "no equilibrium"), (scenes.BLOCK_WITH_FRICTION, "sign()")):
            self.assertIn(why, self.refused("modes", {"system": scene})["detail"])


class InitialStates(Service):
    def problem(self, scene, initial):
        problem = self.refused("simulate", {"system": scene, "initial": initial, "t_end": 1})
        self.assertEqual(problem["errors"][0]["code"], "inconsistent_state", problem)
        return problem

    def test_off_the_surface_is_refused_with_the_nearest_that_is_on_it(self):
        problem = self.problem(scenes.PENDULUM_BY_CONSTRAINT, {"x": 0.3})
        self.assertIn("'string'", problem["errors"][0]["detail"])
        nearest = problem["nearest"]
        self.assertEqual(nearest["x"], 0.3, "what is given stays")
        self.assertAlmostEqual(nearest["y"], -math.sqrt(0.49 - 0.09), 14)
        self.ask("simulate", {"system": scenes.PENDULUM_BY_CONSTRAINT, "initial": nearest, "t_end": 1})

    def test_a_whole_state_that_slips_is_refused(self):
        nearest = self.problem(scenes.ROLLING_DISK, {"x": 0, "theta": 0, "x_dot": 1, "theta_dot": 1})["nearest"]
        self.assertAlmostEqual(nearest["x_dot"], 0.1 * nearest["theta_dot"], 14)

    def test_what_is_all_given_moves_to_the_nearest(self):
        nearest = self.problem(scenes.PENDULUM_BY_CONSTRAINT, {"x": 0.6, "y": -0.8, "x_dot": 1, "y_dot": 1})["nearest"]
        self.assertAlmostEqual(nearest["x"], 0.42, 12)
        self.assertAlmostEqual(nearest["y"], -0.56, 12)
        self.assertAlmostEqual(nearest["x_dot"], 0.8 * (0.8 + 0.6), 12)  # the part along the circle

    def test_a_velocity_off_the_surface_is_refused(self):
        problem = self.problem(scenes.ROLLING_DISK, {"x_dot": 1})
        self.assertEqual(problem["nearest"]["theta_dot"], 10)
        self.problem(scenes.PENDULUM_BY_CONSTRAINT, {"x_dot": 1, "y_dot": 0})

    def test_thirteen_digits_are_enough(self):
        initial = {"x": 0.3, "y": float(f"{-math.sqrt(0.4):.13g}")}
        self.ask("simulate", {"system": scenes.PENDULUM_BY_CONSTRAINT, "initial": initial, "t_end": 1})
        self.problem(scenes.PENDULUM_BY_CONSTRAINT, initial | {"y": float(f"{-math.sqrt(0.4):.8g}")})

    def test_the_time_of_the_state_counts(self):
        x, y = math.cos(1.3), math.sin(1.3)
        request = {"system": scenes.ROTATING_WIRE, "t_start": 1, "t_end": 2,
                   "initial": {"x": x, "y": y, "x_dot": -1.3 * y, "y_dot": 1.3 * x}}
        self.ask("simulate", request)
        self.refused("simulate", request | {"t_start": 0})


class Refusals(Service):
    def wrong(self, scene, constraints, code, **more):
        problem = self.refused("simulate", {"system": {**scene, "constraints": constraints, "valid_while": [], **more},
                                            "t_end": 1})
        self.assertEqual({code}, {error["code"] for error in problem["errors"]}, problem)
        return problem["errors"][0]

    def test_redundant_and_contradictory_constraints_are_named(self):
        string = scenes.PENDULUM_BY_CONSTRAINT["constraints"][0]
        for expression in ("2*l^2 - 2*x^2 - 2*y^2", "x^2 + y^2 - 4*l^2", "x*x_dot + y*y_dot", "sqrt(x^2 + y^2) - l"):
            error = self.wrong(scenes.PENDULUM_BY_CONSTRAINT, [string, {"name": "again", "expression": expression}], "redundant")
            self.assertIn("'again'", error["detail"])
            self.assertIn("'string'", error["detail"])
            self.assertTrue(error["pointer"].endswith("/constraints/1"))
        self.wrong(scenes.DOUBLE_PENDULUM, [{"name": name, "expression": text} for name, text in
                                            {"a": "x1 - x2", "b": "x1 - y1", "c": "y1 - x2"}.items()], "redundant")

    def test_constraints_that_agree_in_a_state_alone_leave_it_undetermined(self):
        scene = {**scenes.DOUBLE_PENDULUM, "coordinates": scenes.coordinates(
            x1=("m", "1", "0"), y1=("m", "1", "0"), x2=("m", "0", "0"), y2=("m", "2", "0"))}
        error = self.wrong(scene, [{"name": "line", "expression": "x1 - y1"}, {"name": "curve", "expression": "x1^2 - y1^2"}],
                           "invalid_state")
        self.assertIn("'line', 'curve'", error["detail"])

    def test_a_constraint_without_a_slope_where_it_holds_has_no_force(self):
        for near in (0, 1e-13):
            scene = {**scenes.PENDULUM_BY_CONSTRAINT, "coordinates": scenes.coordinates(
                x=("m", f"{0.7 * (1 + near)!r}", "0"), y=("m", "0", "0"))}
            self.wrong(scene, [{"name": "c", "expression": "(x^2 + y^2 - l^2)^2"}], "invalid_state")

    def test_what_is_no_constraint(self):
        pendulum = scenes.PENDULUM_BY_CONSTRAINT
        for expression, code in (("x_dot^2 + y_dot^2 - g*l", "not_linear"), ("abs(x) - l", "not_applicable"),
                                 ("l - 2*l", "no_coordinate"), ("x + g", "wrong_dimension"), ("x + z", "unknown_symbol"),
                                 ("x +", "syntax"), ("lambda_c + x", "unknown_symbol")):
            with self.subTest(expression=expression):
                self.wrong(pendulum, [{"name": "c", "expression": expression}], code)
        self.wrong(pendulum, [{"name": f"c{i}", "expression": f"x - {i}*y"} for i in range(3)], "redundant")
        self.wrong(pendulum, [{"name": "c", "expression": "x - l", "multiplier": "g"}], "duplicate_name")

    def test_a_force_is_linear_in_a_multiplier(self):
        force = {"vector": ["lambda_string^2*x*l/(m*g)", "0"], "point": "bob"}
        self.wrong(scenes.PENDULUM_BY_CONSTRAINT, scenes.PENDULUM_BY_CONSTRAINT["constraints"], "not_linear", forces=[force])

    def test_questions_that_are_not_answered_under_constraints_say_so(self):
        questions = {"turning_points": {"coordinate": "x"}, "gait": {}}
        for scene in (scenes.PENDULUM_BY_CONSTRAINT, scenes.DOUBLE_PENDULUM):
            for endpoint, more in questions.items():
                with self.subTest(endpoint=endpoint, scene=scene["name"]):
                    request = {"system": scene} | more
                    if endpoint == "turning_points" and "x" not in [q["name"] for q in scene["coordinates"]]:
                        request["coordinate"] = "x1"
                    self.refused(endpoint, request)

    def test_a_scene_without_constraints_has_no_multipliers(self):
        answer = self.ask("simulate", {"system": "cart_pendulum", "t_end": 1, "include": ["multipliers"]})
        self.assertEqual(list(answer["trajectory"]), ["t", "x", "theta", "x_dot", "theta_dot"])
        outputs = json.loads(self.raw("GET", "/v1/systems/cart_pendulum").data)["outputs"]
        self.assertIn("theta_ddot", [output["name"] for output in outputs])

    def test_a_massless_part_that_a_constraint_carries_is_answered(self):
        scene = copy.deepcopy(scenes.PENDULUM_BY_CONSTRAINT)
        scene["coordinates"] += scenes.coordinates(s=("m", "l*sin(1)", "0"))
        scene["constraints"].append({"name": "shadow", "expression": "s - x"})
        found = self.ask("energy", {"system": scene})
        self.assertAlmostEqual(found["multipliers"]["lambda_shadow"], 0, 14)


if __name__ == "__main__":
    unittest.main()
