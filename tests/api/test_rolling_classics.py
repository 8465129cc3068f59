"""The classics that roll on a plane: the rattleback and Euler's disk, beside a motion by Newton's and Euler's equations."""

import math
import pathlib
import sys
import unittest

import mpmath
import numpy
import sympy

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from rolling_body import RollingBody, U, place_of_support  # noqa: E402
from service import Service  # noqa: E402

SECOND_ROAD = 1e-8  # what the other integration may be off by, where motions part like e^(3 t)


def rational(text):
    return sympy.Rational(text)


def stone():
    a, b, s, c = map(rational, ("0.3", "0.02", "0.02", "0.02"))
    height = c + (a * U[0]**2 + 2 * s * U[0] * U[1] + b * U[1]**2) / 2
    return RollingBody(rational("1"), map(rational, ("0.0004", "0.002", "0.0022")), place_of_support(height), rational("9.81"))


def disk():
    m, r = rational("0.4"), rational("0.04")
    place = r * sympy.Matrix([U[0], U[1], 0]) / sympy.sqrt(U[0]**2 + U[1]**2)
    return RollingBody(m, (m * r**2 / 4, m * r**2 / 4, m * r**2 / 2), place, rational("9.81"))


def of_stone(row):
    """(u, w) in the stone's axes, turned by phi, alpha, beta about z, x, y."""
    a, b = row["alpha"], row["beta"]
    turning, roll, pitch = row["phi_dot"], row["alpha_dot"], row["beta_dot"]
    return [-math.cos(a) * math.sin(b), math.sin(a), math.cos(a) * math.cos(b),
            roll * math.cos(b) - turning * math.cos(a) * math.sin(b), pitch + turning * math.sin(a),
            roll * math.sin(b) + turning * math.cos(a) * math.cos(b)]


def of_disk(row):
    """(u, w) in the disk's axes, turned by Euler's angles."""
    theta, psi = row["theta"], row["psi"]
    precession, nutation, spin = row["phi_dot"], row["theta_dot"], row["psi_dot"]
    return [math.sin(theta) * math.sin(psi), math.sin(theta) * math.cos(psi), math.cos(theta),
            precession * math.sin(theta) * math.sin(psi) + nutation * math.cos(psi),
            precession * math.sin(theta) * math.cos(psi) - nutation * math.sin(psi), precession * math.cos(theta) + spin]


class Rolling(Service):
    def rows(self, system, times, **more):
        answer = self.ask("simulate", {"system": system, "times": list(map(float, times)), **more})
        columns = answer["trajectory"]
        return [{name: columns[name][i] for name in columns} for i in range(len(columns["t"]))], answer

    def assert_moves_like(self, body, system, state_of, times, **more):
        rows, answer = self.rows(system, times, **more)
        self.assertEqual(answer["status"], "complete")
        largest = max(answer["accuracy"]["max_abs_error"].values())
        found = numpy.array([state_of(row) for row in rows])
        expected = body.motion(found[0], times)
        size = abs(expected).max(axis=0)
        self.assertLess((abs(found - expected) / numpy.maximum(size, 1)).max(), SECOND_ROAD + 10 * largest)
        self.assertLess(largest, 1e-5)
        (energy,) = (one for one in answer["diagnostics"]["conserved"] if one["name"] == "energy")
        self.assertLess(abs(energy["initial"] - body.energy(found[0])), 1e-14)
        self.assertLess(energy["max_rel_drift"], 1e-9)

    def test_the_rattleback_moves_as_by_newton_and_euler(self):
        for spin in (5, -5):
            self.assert_moves_like(stone(), "rattleback", of_stone, numpy.linspace(0, 4, 9), parameters={"spin": spin}, rtol=1e-12)

    def test_the_rattleback_turns_back_one_way_at_once_and_the_other_way_slowly(self):
        rows, _ = self.rows("rattleback", range(11), verify=False)
        self.assertLess(max(row["phi_dot"] for row in rows[6:]), -4)
        rows, _ = self.rows("rattleback", range(46), verify=False, parameters={"spin": -5})
        self.assertLess(max(row["phi_dot"] for row in rows[:16]), -4)
        self.assertGreater(max(row["phi_dot"] for row in rows), 4)

    def test_a_stone_that_is_not_skew_keeps_its_sense(self):
        for spin in (5, -5):
            rows, _ = self.rows("rattleback", range(11), verify=False, parameters={"spin": spin, "s": 0})
            self.assertLess(max(abs(row["phi_dot"] - spin) for row in rows), 0.1)

    def test_the_ground_bears_the_stone(self):
        rows, _ = self.rows("rattleback", numpy.linspace(0, 2, 11), verify=False, include=["validity", "accelerations"])
        for row in rows:
            self.assertAlmostEqual(row["push"], 9.81 + row["z_ddot"], places=11)

    def test_eulers_disk_moves_as_by_newton_and_euler(self):
        self.assert_moves_like(disk(), "euler_disk", of_disk, numpy.linspace(0, 1, 9), rtol=1e-12)

    def test_the_centre_of_eulers_disk_rests_at_its_rate(self):
        """phi_dot^2 = 4 g/(r sin(theta)), and it turns as the circle of the contact is shorter than the rim."""
        for theta in (0.05, 0.3, 1.2):
            rate = f"2*sqrt(g/(r*sin({theta})))"
            steady = {"theta": theta, "theta_dot": 0, "y_dot": 0, "phi_dot": rate, "psi_dot": f"-{rate}*cos({theta})"}
            answer = self.ask("energy", {"system": "euler_disk", "initial": steady})
            size = 4 * 9.81 / (0.04 * math.sin(theta))
            self.assertLess(max(map(abs, answer["accelerations"].values())), 1e-14 * size)
            self.assertAlmostEqual(answer["validity"]["normal_force"], 0.4 * 9.81, places=13)
            faster = self.ask("energy", {"system": "euler_disk", "initial": steady | {
                "phi_dot": f"1.01*{rate}", "psi_dot": f"-1.01*{rate}*cos({theta})"}})
            self.assertGreater(max(map(abs, faster["accelerations"].values())), 1e-3 * size * math.sin(2 * theta))

    def test_a_disk_that_is_let_go_falls_flat(self):
        """About its lowest point, with 5/4 m r^2."""
        rest = {"theta": 0.3, "phi_dot": 0, "theta_dot": 0, "psi_dot": 0, "y_dot": 0}
        answer = self.ask("simulate", {"system": "euler_disk", "initial": rest, "t_end": 1, "samples": 2})
        self.assertEqual(answer["stop"]["reason"], "flat")
        speed = lambda theta: mpmath.sqrt(8 * mpmath.mpf("9.81") / 5 / mpmath.mpf("0.04") * (mpmath.sin(0.3) - mpmath.sin(theta)))  # noqa: E731
        self.assertAlmostEqual(answer["stop"]["t"], float(mpmath.quad(lambda theta: 1 / speed(theta), [0.001, 0.3])), places=9)

    def test_a_disk_that_is_thrown_leaves_the_ground(self):
        answer = self.ask("simulate", {"system": "euler_disk", "parameters": {"theta0": 1.2, "push": 20}, "t_end": 1, "samples": 2})
        self.assertEqual(answer["stop"]["reason"], "lift_off")


if __name__ == "__main__":
    sys.exit(unittest.main())
