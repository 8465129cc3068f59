"""What constraints leave constant: the spin and the rolling of balls, a knife's edge, coins. Each is found with its reason
and stays constant along motions; none is claimed that changes."""

import json
import math
import os
import pathlib
import random
import subprocess
import sys
import unittest

import sympy

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from short_scene import lagrangian, scene  # noqa: E402

QDOT = os.environ["QDOT_BINARY"]
ROUNDING = 1e-9  # of the largest value of a quantity or its terms: rtol 1e-12, over a second
FUNCTIONS = {name: getattr(math, name) for name in ("sin", "cos", "tan", "exp", "log", "sqrt", "atan", "pi")}


def lines_of(requests):
    text = "".join(json.dumps({"id": i, **line}) + "\n" for i, line in enumerate(requests))
    run = subprocess.run([QDOT, "batch"], input=text, capture_output=True, text=True, timeout=280)
    return [json.loads(line) for line in run.stdout.splitlines()]


def asked(requests):
    """The answers of `qdot batch` to requests, in order."""
    answers = lines_of(requests)
    assert all(line["status"] == 200 for line in answers), answers
    return [line["answer"] for line in answers]


def angular_velocity(sequence, angles=("phi", "theta", "psi")):
    """In the axes of space, as texts: each turn about an axis that those before it have carried along."""
    omega, carried = sympy.zeros(3, 1), sympy.eye(3)
    for letter, name in zip(sequence, angles):
        angle, rate = sympy.symbols(f"{name} {name}_dot")
        axis = sympy.zeros(3, 1)
        axis["XYZ".index(letter)] = 1
        omega += rate * carried * axis
        turn = {"X": sympy.rot_axis1, "Y": sympy.rot_axis2, "Z": sympy.rot_axis3}[letter](-angle)
        carried = carried * turn
    return [str(sympy.expand(component)).replace("**", "^") for component in omega]


def rolling_ball(sequence, tilt="0", moments=None, turntable=False):
    wx, wy, _ = angular_velocity(sequence)
    found = scene("ball", f"m kg 1.3; r m 0.5; g m/s^2 9.81; W rad/s 0.8; alpha rad {tilt}",
                  "x m 0.1 0; y m 0.2 0; phi rad 0.3 0.5; theta rad 0.7 0.4; psi rad 0.2 0.3")
    body = {"kind": "sphere", "radius": "r"}
    if moments:
        body = {"kind": "rigid_body", "principal_moments": [f"{i}*m*r^2" for i in moments]}
    slide = ("+ W*y", "- W*x") if turntable else ("", "")
    return found | {"bodies": [{**body, "mass": "m", "name": "ball", "centre": ["x", "y", "r"],
                                "orientation": {"sequence": sequence, "angles": ["phi", "theta", "psi"]}}],
                    "gravity": ["g*sin(alpha)", "0", "-g*cos(alpha)"],
                    "constraints": [{"name": "a", "expression": f"x_dot - r*({wy}) {slide[0]}"},
                                    {"name": "b", "expression": f"y_dot + r*({wx}) {slide[1]}"}]}


def coin(potential="0"):
    return lagrangian("coin", "m - 1.2; r - 0.5; k - 0.7", "x - 0.1; y - 0.2; phi - 0.3 0.5; psi - 0.2 0.7",
                      f"m*(x_dot^2 + y_dot^2)/2 + m*r^2*psi_dot^2/4 + m*r^2*phi_dot^2/8 - ({potential})",
                      constraints=[{"name": "a", "expression": "x_dot - r*psi_dot*cos(phi)"},
                                   {"name": "b", "expression": "y_dot - r*psi_dot*sin(phi)"}])


def knife(potential="0"):
    return lagrangian("knife", "m - 1.5; J - 0.2; k - 0.7", "x - 0.1; y - 0.2; phi - 0.3 0.5",
                      f"m*(x_dot^2 + y_dot^2)/2 + J*phi_dot^2/2 - ({potential})",
                      constraints=[{"name": "edge", "expression": "x_dot*sin(phi) - y_dot*cos(phi)"}])


def sleigh(a):
    return lagrangian("sleigh", f"m - 1.2; J - 0.3; a - {a}", "x - 0; y - 0; theta - 0.2 1",
                      "m*((x_dot - a*theta_dot*sin(theta))^2 + (y_dot + a*theta_dot*cos(theta))^2)/2 + J*theta_dot^2/2",
                      constraints=[{"name": "blade", "expression": "y_dot*cos(theta) - x_dot*sin(theta)"}])


def consistent(systems):
    """The states that obey the constraints nearest to those of the scenes, which need not."""
    starts = [{q["name"] + rate: q.get("initial" + more, "0") for q in system["coordinates"] for rate, more in (("", ""), ("_dot", "_rate"))}
              for system in systems]
    lines = lines_of({"energy": {"system": system, "initial": start}} for system, start in zip(systems, starts))
    return [start if line["status"] == 200 else line["answer"]["nearest"] for start, line in zip(starts, lines)]


def value(text, names):
    return eval(text.replace("^", "**"), {"__builtins__": {}}, FUNCTIONS | names)  # noqa: S307  (our own answer)


class Momenta(unittest.TestCase):
    def check(self, systems):
        """What each keeps, after a look at whether it does."""
        equations = asked([{"equations": {"system": system}} for system in systems])
        starts = consistent(systems)
        motions = asked([{"simulate": {"system": system, "initial": start, "t_end": 1, "samples": 7, "rtol": 1e-12, "atol": 1e-13,
                                       "verify": False, "include": []}} for system, start in zip(systems, starts)])
        result = []
        for system, answer, motion in zip(systems, equations, motions):
            trajectory, parameters = motion["trajectory"], motion["request"]["parameters"]
            for one in answer["conserved"]:
                values, size = [], 1.0
                for row in range(len(trajectory["t"])):
                    names = {name: column[row] for name, column in trajectory.items()} | parameters
                    values.append(value(one["value"], names))
                    size = max(size, abs(values[-1]), max(abs(names[q]) for q in trajectory) ** 2)
                self.assertLess(max(values) - min(values), ROUNDING * size, (system["name"], system["constraints"], one))
            result.append({one["name"]: one for one in answer["conserved"]})
        return result

    def names(self, system):
        return set(self.check([system])[0]) - {"h", "energy"}

    def test_a_ball_that_rolls_keeps_its_spin_and_its_rolling(self):
        by_euler, by_tait_bryan = self.check([rolling_ball("ZXZ"), rolling_ball("XYZ")])
        self.assertEqual(by_euler["p_phi"]["value"], "2/5*m*r^2*(phi_dot + psi_dot*cos(theta))")
        self.assertEqual(by_euler["roll_x"]["value"], "7/5*m*r^2*(theta_dot*cos(phi) + psi_dot*sin(phi)*sin(theta))")
        self.assertIn("roll_y", by_euler)
        self.assertEqual(by_tait_bryan["spin_z"]["value"], "2/5*m*r^2*(theta_dot*sin(phi) + psi_dot*cos(phi)*cos(theta))")
        self.assertTrue(by_tait_bryan["spin_z"]["why"].startswith(
            "Turning 'ball' about an axis through its centre parallel to z changes nothing, so "), by_tait_bryan["spin_z"])

    def test_chaplygins_ball_keeps_its_angular_momentum_about_the_contact(self):
        # The first angle of XYZ turns about the x axis of space: adding to it is that turn.
        self.assertLessEqual({"spin_z", "momentum_y_phi", "roll_y"}, self.names(rolling_ball("XYZ", moments=("1/5", "3/10", "2/5"))))
        self.assertLessEqual({"p_phi", "roll_x", "roll_y"}, self.names(rolling_ball("ZYX", moments=("1/5", "3/10", "2/5"))))

    def test_on_a_slope_the_rolling_grows_with_the_time(self):
        (found,) = self.check([rolling_ball("ZXZ", tilt="0.2")])
        self.assertEqual(found["roll_y"]["value"], "7/5*m*r^2*(theta_dot*sin(phi) - psi_dot*sin(theta)*cos(phi)) - m*r*g*t*sin(alpha)")

    def test_a_ball_on_a_turntable(self):
        self.assertLessEqual({"spin_z", "roll_y"}, self.names(rolling_ball("XYZ", turntable=True)))

    def test_a_ball_in_a_cylinder_is_told_once_what_it_keeps(self):
        wx, wy, wz = angular_velocity("ZXZ")
        golf = scene("golf", "m kg 1.3; r m 0.1; R m 0.5; g m/s^2 9.81",
                     "a rad 0.1 0.5; z m 0 0.2; phi rad 0.3 0.5; theta rad 0.7 0.4; psi rad 0.2 0.3")
        golf |= {"bodies": [{"kind": "sphere", "mass": "m", "radius": "r",
                             "centre": ["(R - r)*cos(a)", "(R - r)*sin(a)", "z"],
                             "orientation": {"sequence": "ZXZ", "angles": ["phi", "theta", "psi"]}}],
                 "gravity": ["0", "0", "-g"],
                 "constraints": [{"name": "round", "expression": f"(R - r)*a_dot + r*({wz})"},
                                 {"name": "down", "expression": f"z_dot + r*(({wx})*sin(a) - ({wy})*cos(a))"}]}
        found, = asked([{"equations": {"system": golf}}])
        self.assertEqual([q["name"] for q in found["conserved"]], ["energy", "momentum_a_phi", "boost_a_phi"])

    def test_a_coin_and_a_knife_keep_what_they_have_along_the_constraints(self):
        upright, sliding = self.check([coin(), knife()])
        self.assertEqual(upright["momentum_x_y_psi"]["value"], "3/2*m*r^2*psi_dot")
        self.assertEqual(sliding["momentum_x_y"]["why"],
                         "The small change dx = cos(phi) and dy = sin(phi), which the constraints allow, changes nothing, so "
                         "p_x*cos(phi) + p_y*sin(phi) is constant.")

    def test_none_is_claimed_that_changes(self):
        self.assertEqual(self.names(sleigh(0.4)), set())
        self.assertNotIn("momentum_x_y", self.names(knife("k*x")))
        self.assertNotIn("momentum_x_y_psi", self.names(coin("k*x")))
        self.assertEqual(self.names(coin("k*cos(phi)")), {"momentum_x_y_psi"})
        self.assertNotIn("momentum_x_y_psi", self.names(coin("k*sin(psi)")))

    def test_at_random(self):
        """Bodies that roll with any moments and sequences on any slope; coins and edges in potentials."""
        draw = random.Random(5)
        systems = []
        for _ in range(12):
            sequence = draw.choice(["ZXZ", "XYZ", "ZYX", "YZX", "ZYZ", "XZX"])
            moments = [draw.randint(4, 9) for _ in range(3)] if draw.random() < 0.5 else [4, 4, draw.randint(4, 7)]
            systems.append(rolling_ball(sequence, draw.choice(["0", "0.3"]), [f"{i}/20" for i in moments], draw.random() < 0.3))
        for _ in range(20):
            terms = [f"{draw.randint(1, 3)}*{f}" for f in ("x", "y", "sin(phi)", "phi", "x*y", "cos(x - phi)") if draw.random() < 0.3]
            systems.append(draw.choice([coin, knife])(" + ".join(terms) or "0"))
        found = self.check(systems)
        self.assertGreater(sum(len(one) for one in found), 60)


class MovingWire(unittest.TestCase):
    def test_a_constraint_is_no_conserved_quantity(self):
        wire = scene("moving_wire", "m kg 1; a m/s 0.5; g m/s^2 9.81", "x m 1; y m 0.5 a", gravity=["0", "-g"],
                     bodies=[{"kind": "particle", "mass": "m", "position": ["x", "y"]}],
                     constraints=[{"name": "wire", "expression": "y - x/2 - a*t"}])
        [found] = asked([{"equations": {"system": wire}}])
        self.assertIn("1/2*m*(x_dot^2 + y_dot^2) + 2*m*a*x_dot + m*g*y", [one["value"] for one in found["conserved"]])
        for one in found["conserved"]:
            self.assertIn("_dot", one["value"])
            self.assertNotIn("The small change ,", one["why"])


if __name__ == "__main__":
    sys.exit(unittest.main())
