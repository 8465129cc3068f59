"""Formulas of small motions under constraints in the velocities, at rest and about steady motions."""

import pathlib
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402


def scene(lagrangian, coordinates, constraints, **parameters):
    return {"name": "scene", "units": "none", "lagrangian": lagrangian, "coordinates": coordinates,
            "parameters": [{"name": name, "default": value} for name, value in parameters.items()],
            "constraints": [{"name": f"c{i}", "expression": e} for i, e in enumerate(constraints)]}


BOWL = scene("m*(x_dot^2 + y_dot^2)/2 + m*r^2/5*(u_dot^2 + v_dot^2 + w_dot^2) - m*g*(x^2 + y^2)/(2*R)",
             [{"name": name} for name in "xyuvw"], ["x_dot - r*v_dot", "y_dot + r*u_dot"], m=1, R=2, r=0.3, g=9.81)
SLEIGH = scene("m*((x_dot - a*th_dot*sin(th))^2 + (y_dot + a*th_dot*cos(th))^2)/2 + J*th_dot^2/2",
               [{"name": "x", "initial_rate": "v"}, {"name": "y"}, {"name": "th"}],
               ["-x_dot*sin(th) + y_dot*cos(th)"], m=2, a=0.4, J=0.5, v=3)
TRAILER = scene("m*x_dot^2/2 + J*th_dot^2/2", [{"name": "x", "initial_rate": "v"}, {"name": "th"}],
                ["-x_dot*sin(th) - b*th_dot"], m=2, J=0.5, b=0.5, v=2)
DISK = {"name": "disk", "gravity": ["0", "0", "-g"],
        "parameters": [{"name": "m", "unit": "kg", "default": 1}, {"name": "r", "unit": "m", "default": 0.3},
                       {"name": "g", "unit": "m/s^2", "default": 9.81}, {"name": "W", "unit": "rad/s", "default": 3}],
        "coordinates": [{"name": "x", "unit": "m", "initial_rate": "r*W"}, {"name": "y", "unit": "m"},
                        {"name": "psi", "unit": "rad"}, {"name": "th", "unit": "rad"},
                        {"name": "phi", "unit": "rad", "initial_rate": "W"}],
        "bodies": [{"kind": "rigid_body", "name": "disk", "mass": "m",
                    "principal_moments": ["m*r^2/4", "m*r^2/2", "m*r^2/4"],
                    "centre": ["x + r*sin(th)*sin(psi)", "y - r*sin(th)*cos(psi)", "r*cos(th)"],
                    "orientation": {"sequence": "ZXY", "angles": ["psi", "th", "phi"]}}],
        "constraints": [{"name": "along", "expression": "x_dot - r*phi_dot*cos(psi)"},
                        {"name": "across", "expression": "y_dot - r*phi_dot*sin(psi)"}]}


class RollingForms(Service):
    def modes(self, system, **more):
        return [mode for mode in self.ask("modes", {"system": system} | more)["modes"] if "exact" in mode]

    def only(self, system, kind, **more):
        modes = self.modes(system, **more)
        self.assertEqual([mode["kind"] for mode in modes], [kind])
        return modes[0]

    def test_a_ball_in_a_bowl_may_spin_as_it_likes(self):
        modes = self.modes(BOWL)
        self.assertEqual([mode["exact"]["text"] for mode in modes], ["5*g/(7*R)"] * 2)
        for mode in modes:
            self.assertAlmostEqual(mode["omega"], mpmath.sqrt(5*9.81/14), 14)

    def test_the_sleigh_straightens(self):
        mode = self.only(SLEIGH, "decay")
        self.assertEqual((mode["exact"]["of"], mode["exact"]["text"]), ("rate", "m*a*v/(J + m*a^2)"))
        self.assertAlmostEqual(mode["rate"], 2*0.4*3/(0.5 + 2*0.4**2), 14)
        typed = self.only(SLEIGH, "decay", initial={"x_dot": 1.5})
        self.assertEqual(typed["exact"]["text"], "m*a*x_dot/(J + m*a^2)")
        self.assertIn("x_dot > 0", typed["exact"]["assumes"])

    def test_it_turns_round_when_it_is_pushed_backwards(self):
        mode = self.only(SLEIGH, "growth", initial={"x_dot": -1.5})
        self.assertEqual(mode["exact"]["text"], "-m*a*x_dot/(J + m*a^2)")

    def test_a_trailer_follows(self):
        self.assertEqual(self.only(TRAILER, "decay")["exact"]["text"], "v/b")

    def test_a_disk_that_rolls_upright_falls_unless_it_is_fast(self):
        # Of rate^2 = 4 g/(5 r) - 12/5 W^2; Neimark, Fufaev, Dynamics of Nonholonomic Systems, VI.2.
        slow = self.modes(DISK)
        self.assertEqual([(mode["kind"], mode["exact"]["text"]) for mode in slow],
                         [(kind, "sqrt(4/5*(g/r - 3*W^2))") for kind in ("growth", "decay")])
        self.assertAlmostEqual(slow[0]["rate"], mpmath.sqrt(4*9.81/1.5 - 12*9/5.), 13)
        fast = self.only(DISK, "oscillation", parameters={"W": 7})
        self.assertEqual(fast["exact"]["text"], "4/5*(3*W^2 - g/r)")
        for mode, condition in ((slow[0], "g > 3*r*W^2"), (slow[1], "g > 3*r*W^2"), (fast, "3*r*W^2 > g")):
            self.assertEqual(sorted(mode["exact"]["assumes"]), sorted(["r > 0", "g > 0", "W > 0", condition]))

    def test_a_rate_that_is_left_out_is_said(self):
        # A disk that spins upright on its place is steady only seen from a frame that turns with it.
        answer = self.ask("modes", {"system": DISK, "initial": {"x_dot": 0, "phi_dot": 0, "psi_dot": 15}})
        self.assertEqual(answer["equilibrium"]["state"]["psi_dot"], 0)
        self.assertIn("The start has psi_dot = 15", answer["notes"][0])
        self.assertNotIn("notes", self.ask("modes", {"system": DISK}))

    def test_rates_that_constraints_give_need_no_symbol(self):
        typed = self.only(DISK, "oscillation", initial={"x_dot": 2.1, "phi_dot": 7})
        self.assertEqual(typed["exact"]["text"], "4/5*(3*phi_dot^2 - g/r)")
        rooted = self.only(DISK, "oscillation", initial={"x_dot": "3*sqrt(g*r)", "phi_dot": "3*sqrt(g/r)"})
        self.assertAlmostEqual(rooted["omega"], mpmath.sqrt(4/5.*26*9.81/0.3), 12)


if __name__ == "__main__":
    unittest.main()
