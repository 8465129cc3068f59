"""Dry friction against the normal force that a constraint's multiplier gives, with sticking, against closed forms and SciPy."""

import math
import pathlib
import sys
import unittest

import numpy
from scipy.integrate import solve_ivp

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from constrained_scenes import coordinates, parameters  # noqa: E402
from service import Service  # noqa: E402

G = 9.81
LIFTS = {"name": "normal_force", "unit": "N", "expression": "N", "reason": "lift_off", "message": "The block lifts off."}

INCLINE = {
    "name": "block_with_friction",
    "parameters": parameters(m=("kg", "2"), alpha=("rad", "0.4"), mu=("1", "0.5"), v=("m/s", "3"), g=("m/s^2", "9.81")),
    "coordinates": coordinates(x=("m", "0", "-v*cos(alpha)"), y=("m", "0", "v*sin(alpha)")),
    "points": [{"name": "block", "components": ["x", "y"]}],
    "bodies": [{"kind": "particle", "mass": "m", "position": "block"}],
    "gravity": [0, "-g"],
    "constraints": [{"name": "plane", "expression": "x*sin(alpha) + y*cos(alpha)", "multiplier": "N"}],
    "forces": [{"name": "friction", "point": "block",
                "vector": ["-mu*N*cos(alpha)*sign(x_dot*cos(alpha) - y_dot*sin(alpha))",
                           "mu*N*sin(alpha)*sign(x_dot*cos(alpha) - y_dot*sin(alpha))"]}],
    "valid_while": [LIFTS],
}

SLEDGE = {
    "name": "pulled_sledge",
    "parameters": parameters(m=("kg", "4"), mu=("1", "0.3"), beta=("rad", "0.5"), P=("N/s", "5"), g=("m/s^2", "9.81")),
    "coordinates": coordinates(x=("m", "0", "0"), y=("m", "0", "0")),
    "points": [{"name": "sledge", "components": ["x", "y"]}],
    "bodies": [{"kind": "particle", "mass": "m", "position": "sledge"}],
    "gravity": [0, "-g"],
    "constraints": [{"name": "ground", "expression": "y", "multiplier": "N"}],
    "forces": [{"name": "rope", "vector": ["P*t*cos(beta)", "P*t*sin(beta)"], "point": "sledge"},
               {"name": "friction", "value": "-mu*N*sign(x_dot)", "along": "x"}],
    "valid_while": [LIFTS],
}

BOWL = {
    "name": "bead_in_a_bowl",
    "parameters": parameters(m=("kg", "0.5"), l=("m", "0.8"), mu=("1", "0.2"), g=("m/s^2", "9.81")),
    "coordinates": coordinates(x=("m", "l*sin(1)", "0"), y=("m", "-l*cos(1)", "0")),
    "points": [{"name": "bead", "components": ["x", "y"]}],
    "bodies": [{"kind": "particle", "mass": "m", "position": "bead"}],
    "gravity": [0, "-g"],
    "constraints": [{"name": "bowl", "expression": "l - sqrt(x^2 + y^2)", "multiplier": "N"}],
    # along the tangent (-y, x)/l
    "forces": [{"vector": ["mu*N*y/l*sign(x*y_dot - y*x_dot)", "-mu*N*x/l*sign(x*y_dot - y*x_dot)"], "point": "bead"}],
    "valid_while": [LIFTS],
}

# A bead on a wire is held from both sides: |N| rubs. By an angle and a radius that a constraint holds, by x and y, and with
# the normal force written by hand.
ON_WIRE = {
    "name": "bead_on_a_wire",
    "parameters": parameters(m=("kg", "0.5"), R=("m", "0.5"), mu=("1", "0.05"), w=("rad/s", "10"), g=("m/s^2", "9.81")),
    "coordinates": coordinates(theta=("rad", "0", "w"), r=("m", "R", "0")),
    "points": [{"name": "bead", "components": ["r*sin(theta)", "-r*cos(theta)"]}],
    "bodies": [{"kind": "particle", "mass": "m", "position": "bead"}],
    "gravity": [0, "-g"],
    "constraints": [{"name": "wire", "expression": "r - R", "multiplier": "N"}],
    "forces": [{"value": "-mu*R*abs(N)*sign(theta_dot)", "along": "theta"}],
}
ON_WIRE_IN_PLACES = ON_WIRE | {
    "coordinates": coordinates(x=("m", "0", "w*R"), y=("m", "-R", "0")),
    "points": [{"name": "bead", "components": ["x", "y"]}],
    "constraints": [{"name": "wire", "expression": "sqrt(x^2 + y^2) - R", "multiplier": "N"}],
    "forces": [{"vector": ["mu*abs(N)*y/R*sign(x*y_dot - y*x_dot)", "-mu*abs(N)*x/R*sign(x*y_dot - y*x_dot)"],
                "point": "bead"}],
}


class Friction(Service):
    def motion(self, scene, t_end, samples=41, **more):
        answer = self.ask("simulate", {"system": scene, "t_end": t_end, "samples": samples, "include": ["multipliers"],
                                       "max_error": 1e-8} | more)
        return answer, {name: numpy.array(values) for name, values in answer["trajectory"].items()}

    def test_a_block_slides_up_and_stays_or_comes_back(self):
        for mu in (0.2, 0.5):
            answer, rows = self.motion(INCLINE, 3, parameters={"mu": mu})
            slope, rub, t = G * math.sin(0.4), mu * G * math.cos(0.4), rows["t"]
            stop = 3 / (slope + rub)
            up = 3 * numpy.minimum(t, stop) - (slope + rub) * numpy.minimum(t, stop) ** 2 / 2
            back = max(0.0, slope - rub) * numpy.maximum(0, t - stop) ** 2 / 2
            self.assertLess(numpy.abs(-rows["x"] / math.cos(0.4) - (up - back)).max(), 1e-7)
            self.assertLess(numpy.abs(rows["N"] - 2 * G * math.cos(0.4)).max(), 1e-7)
            self.assertEqual(bool(answer.get("sticking")), mu > math.tan(0.4))
            if answer.get("sticking"):
                self.assertAlmostEqual(answer["sticking"][0]["from"], stop, 9)
            self.assertEqual(answer["diagnostics"]["conserved"], [], "friction takes energy")

    def test_a_bead_on_a_wire_rubs_on_both_of_its_sides(self):
        def fall(t, y, mu):
            force = abs(0.5*y[1]**2 + G*math.cos(y[0]))
            return [y[1], -(G*math.sin(y[0]) + mu*force*numpy.sign(y[1]))/0.5]

        for mu in (0.05, 0.01):  # falls back below the top, and goes over it
            _, rows = self.motion(ON_WIRE, 0.6, parameters={"mu": mu})
            turn = next((i for i, rate in enumerate(rows["theta_dot"]) if rate <= 0), len(rows["t"]))
            expected = solve_ivp(fall, (0, 0.6), [0, 10], "DOP853", rows["t"][:turn], args=(mu,), rtol=1e-11, atol=1e-13,
                                 max_step=1e-3).y
            self.assertLess(numpy.abs(rows["theta"][:turn] - expected[0]).max(), 1e-7)
            self.assertTrue((rows["N"][:turn] < 0).any() and (rows["N"][:turn] > 0).any(), "on either side")

    def test_a_bead_on_a_wire_comes_to_rest_at_the_same_place_in_all_coordinates(self):
        answer, rows = self.motion(ON_WIRE, 20, parameters={"mu": 0.3})
        in_places, places = self.motion(ON_WIRE_IN_PLACES, 20, parameters={"mu": 0.3})
        self.assertLess(numpy.abs(0.5*numpy.sin(rows["theta"]) - places["x"]).max(), 2e-8)
        self.assertLess(numpy.abs(rows["N"] - places["N"]).max(), 1e-6)
        for found in (answer, in_places):
            self.assertEqual(found["status"], "complete")
            self.assertTrue(found["sticking"])
        self.assertEqual(rows["theta_dot"][-1], 0)

    def test_friction_that_changes_its_own_reaction_is_no_function_of_the_state(self):
        ladder = {
            "name": "falling_ladder",
            "parameters": parameters(m=("kg", "1"), l=("m", "1"), mu=("1", "0.1"), g=("m/s^2", "9.81")),
            "coordinates": coordinates(theta=("rad", "0.3", "0"), x=("m", "l*sin(0.3)/2", "0"), y=("m", "l*cos(0.3)/2", "0")),
            "bodies": [{"kind": "rigid_body", "mass": "m", "inertia": "m*l^2/12", "centre": ["x", "y"], "angle": "-theta"}],
            "gravity": [0, "-g"],
            "constraints": [{"name": "floor", "expression": "y - l/2*cos(theta)", "multiplier": "N"}],
            "forces": [{"vector": ["-mu*abs(N)*sign(x_dot - l/2*theta_dot*cos(theta))", "0"],
                        "point": ["x - l/2*sin(theta)", "0"]}],
        }
        problem = self.refused_at("simulate", {"system": ladder, "t_end": 1}, "#/system/forces")
        self.assertIn("The friction of 'N' changes that reaction itself", problem["errors"][0]["detail"])

    def test_a_sledge_sticks_until_the_pull_exceeds_what_friction_holds(self):
        # P t cos(beta) = mu (m g - P t sin(beta))
        start = 0.3 * 4 * G / (5 * (math.cos(0.5) + 0.3 * math.sin(0.5)))
        answer, rows = self.motion(SLEDGE, 4)
        self.assertEqual((answer["sticking"][0]["from"], len(answer["sticking"])), (0, 1))
        self.assertAlmostEqual(answer["sticking"][0]["to"], start, 8)
        late = numpy.maximum(0, rows["t"] - start)
        jerk = 5 * (math.cos(0.5) + 0.3 * math.sin(0.5)) / 4
        self.assertLess(numpy.abs(rows["x"] - jerk * late**3 / 6).max(), 1e-7)
        self.assertLess(numpy.abs(rows["N"] - (4 * G - 5 * rows["t"] * math.sin(0.5))).max(), 1e-8)

    def test_a_sledge_lifts_off_where_its_normal_force_ends(self):
        answer, _ = self.motion(SLEDGE, 20)
        self.assertEqual(answer["stop"]["reason"], "lift_off")
        self.assertAlmostEqual(answer["stop"]["t"], 4 * G / (5 * math.sin(0.5)), 8)

    def test_a_bead_comes_to_rest_in_its_bowl_where_friction_holds_it(self):
        answer, rows = self.motion(BOWL, 6)
        rate = lambda s: lambda _, y: [y[1], -G / 0.8 * math.sin(y[0]) - s * 0.2 * (G / 0.8 * math.cos(y[0]) + y[1] ** 2)]  # noqa: E731
        halt = lambda _, y: y[1]  # noqa: E731
        halt.terminal = True
        t, state, known = 0.0, [1.0, 0.0], []
        for swing in range(20):
            side = -math.copysign(1, state[0])
            halt.direction = -side
            piece = solve_ivp(rate(side), (t, 6), [state[0], 1e-300 * side], rtol=1e-12, atol=1e-13, events=halt,
                              dense_output=True, method="DOP853")
            known.append((t, piece.t[-1], piece.sol))
            t, state = piece.t[-1], [piece.y[0, -1], 0.0]
            if abs(math.tan(state[0])) < 0.2 or t >= 6:
                break
        self.assertAlmostEqual(answer["sticking"][-1]["from"], t, 7)
        for s, x in zip(rows["t"], rows["x"]):
            angle = next((sol(s)[0] for a, b, sol in known if a <= s <= b), state[0])
            self.assertLess(abs(x - 0.8 * math.sin(angle)), 1e-6, s)

    def test_forces_are_linear_in_multipliers(self):
        for value in ("-mu*sqrt(abs(N)*m*g)*sign(x_dot)", "-mu*N^2/(m*g)"):
            wrong = SLEDGE | {"forces": [{"value": value, "along": "x"}]}
            self.refused_at("energy", {"system": wrong}, "#/system/forces/0")
        self.refused_at("energy", {"system": SLEDGE | {"forces": [{"value": "-mu*L*sign(x_dot)", "along": "x"}]}},
                        "#/system/forces/0/value")

    def test_modes_do_not_leave_friction_out(self):
        self.refused("modes", {"system": BOWL, "equilibrium": {"x": 0, "y": "-l"}})


if __name__ == "__main__":
    unittest.main()
