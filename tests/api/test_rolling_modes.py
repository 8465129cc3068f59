"""Modes of bodies that roll, at rest and spinning: closed forms, and the eigenvalues of Newton's and Euler's equations."""

import math
import pathlib
import random
import sys
import unittest

import mpmath
import sympy

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import constrained_scenes as scenes  # noqa: E402
from rolling_body import RollingBody, U, place_of_support  # noqa: E402
from service import Service  # noqa: E402

mpmath.mp.dps = 40
ROUND_OFF = 1e-15
STONE = {"m": "1", "I1": "0.0004", "I2": "0.002", "I3": "0.0022", "a": "0.3", "b": "0.02", "s": "0.02", "c": "0.02", "g": "9.81"}

SPRING_AND_DISK = {
    "name": "disk_on_a_spring",
    "parameters": scenes.parameters(m=("kg", "2"), r=("m", "0.1"), k=("N/m", "30"), b=("N*s/m", "0")),
    "coordinates": scenes.coordinates(x=("m", "0", "0"), theta=("rad", "0", "0")),
    "bodies": [{"kind": "disk", "mass": "m", "radius": "r", "centre": ["x", "r"], "angle": "-theta"}],
    "springs": [{"stiffness": "k", "length": "x", "rest_length": "0"}],
    "dampers": [{"coefficient": "b", "length": "x"}],
    "constraints": [{"name": "rolling", "expression": "x_dot - r*theta_dot", "multiplier": "friction"}],
}

# A disk that rolls straight on; phi and theta say how it leans out of that.
WHEEL = {
    "name": "wheel",
    "parameters": scenes.parameters(m=("kg", "0.4"), r=("m", "0.04"), w=("rad/s", "20"), g=("m/s^2", "9.81")),
    "coordinates": scenes.coordinates(x=("m", "0", "-r*w"), y=("m", "0", "0"), phi=("rad", "0", "0"), theta=("rad", "pi/2", "0"),
                                      psi=("rad", "0", "w")),
    "bodies": [{"kind": "disk", "mass": "m", "radius": "r", "centre": ["x", "y", "r*sin(theta)"],
                "orientation": {"sequence": "ZXZ", "angles": ["phi", "theta", "psi"]}}],
    "gravity": ["0", "0", "-g"],
    "constraints": [
        {"name": "along", "expression": "x_dot*cos(phi) + y_dot*sin(phi) + r*(psi_dot + phi_dot*cos(theta))"},
        {"name": "across", "expression": "y_dot*cos(phi) - x_dot*sin(phi) + r*theta_dot*sin(theta)"}],
}


def stone(values):
    a, b, s, c, g = (sympy.Rational(values[name]) for name in ("a", "b", "s", "c", "g"))
    height = c + (a * U[0]**2 + 2 * s * U[0] * U[1] + b * U[1]**2) / 2
    return RollingBody(sympy.Rational(values["m"]), [sympy.Rational(values[f"I{i}"]) for i in (1, 2, 3)], place_of_support(height), g)


class RollingModes(Service):
    def modes(self, system, parameters=None, **more):
        return self.ask("modes", {"system": system, "parameters": parameters or {}} | more)

    def of_kind(self, found, *kinds):
        return [mode for mode in found["modes"] if mode["kind"] in kinds]

    def assert_within(self, value, error, true):
        self.assertLessEqual(abs(mpmath.mpf(value) - true), error + ROUND_OFF * abs(true), (value, true))
        self.assertLessEqual(error, 10 * ROUND_OFF * max(abs(value), 1))

    def test_a_disk_on_a_spring_has_one_and_a_half_times_its_mass(self):
        found = self.modes(SPRING_AND_DISK)
        (swing,) = self.of_kind(found, "oscillation")
        self.assert_within(swing["omega"], swing["error"], mpmath.sqrt(mpmath.mpf(30) / 3))
        self.assertEqual(swing["shape"], {"x": 1, "theta": 10})
        self.assertNotIn("rate_error", swing)
        (damped,) = self.of_kind(self.modes(SPRING_AND_DISK, {"b": 3}), "decay")
        self.assert_within(damped["rate"], damped["rate_error"], mpmath.mpf("0.5"))
        self.assert_within(damped["omega"], damped["error"], mpmath.sqrt(mpmath.mpf("9.75")))
        slow, fast = sorted(mode["rate"] for mode in self.of_kind(self.modes(SPRING_AND_DISK, {"b": 30}), "decay"))
        self.assertAlmostEqual(slow, 5 - math.sqrt(15), places=14)
        self.assertAlmostEqual(fast, 5 + math.sqrt(15), places=14)

    def test_a_stone_at_rest_pitches_and_rolls(self):
        """det(K - omega^2 M) = 0 with M = diag(I1, I2) + m c^2, K = m g (b, -s; -s, a)."""
        p = {name: mpmath.mpf(value) for name, value in STONE.items()}
        m1, m2 = p["I1"] + p["m"] * p["c"]**2, p["I2"] + p["m"] * p["c"]**2
        weight = p["m"] * p["g"]
        half = weight * (m1 * p["a"] + m2 * p["b"]) / (2 * m1 * m2)
        apart = mpmath.sqrt(half**2 - weight**2 * (p["a"] * p["b"] - p["s"]**2) / (m1 * m2))
        found = self.modes("rattleback", {"spin": 0, "tap": 0})
        swings = self.of_kind(found, "oscillation")
        self.assertEqual([mode["kind"] for mode in found["modes"]], ["rigid", "oscillation", "oscillation"])
        for mode, square in zip(swings, (half - apart, half + apart)):
            self.assert_within(mode["omega"], mode["error"], mpmath.sqrt(square))
            self.assertEqual(mode["shape"]["x"] / mode["shape"]["beta"], 0.02)
            self.assertEqual(mode["shape"]["y"] / mode["shape"]["alpha"], -0.02)
        self.assertEqual(found["modes"][0]["shape"]["phi"], 1)
        lying = self.modes("rattleback", {"spin": 0, "tap": 0, "s": 1})
        self.assertEqual(lying["equilibrium"]["stability"], "unstable")  # a b < s^2

    def assert_spins_as_by_newton_and_euler(self, values, spin):
        found = self.modes("rattleback", values | {"spin": spin, "tap": 0})
        true = [s for s in stone(STONE | values).exponents([0, 0, 1, 0, 0, mpmath.mpf(repr(spin))]) if s.imag > 1e-10]
        modes = [mode for mode in self.of_kind(found, "growth", "decay") if mode["omega"] > 0]
        self.assertEqual(len(modes), len(true))
        for mode, s in zip(modes, sorted(true, key=lambda s: s.imag)):
            self.assert_within(mode["omega"], mode["error"], s.imag)
            self.assert_within(mode["rate"], mode["rate_error"], abs(s.real))
            self.assertEqual(mode["kind"], "growth" if s.real > 0 else "decay")
        return [mode["kind"] for mode in modes]

    def test_a_spinning_stone_pitches_up_one_way_and_rolls_up_the_other(self):
        for spin in (0.3, 1, 5):
            self.assertEqual(self.assert_spins_as_by_newton_and_euler({}, spin), ["decay", "growth"])
            self.assertEqual(self.assert_spins_as_by_newton_and_euler({}, -spin), ["growth", "decay"])
            self.assertEqual(self.assert_spins_as_by_newton_and_euler({"s": "-0.02"}, spin), ["growth", "decay"])

    def test_random_stones(self):
        rng = random.Random(5)
        for _ in range(6):
            values = {"I1": round(rng.uniform(1e-4, 1e-3), 6), "I2": round(rng.uniform(1e-3, 4e-3), 6), "a": round(rng.uniform(0.5, 3), 3),
                      "b": round(rng.uniform(0.02, 0.2), 4), "s": round(rng.uniform(-0.05, 0.05), 4), "c": round(rng.uniform(0.005, 0.05), 4)}
            values["I3"] = round(values["I2"] + values["I1"]/2, 8)
            values = {name: str(value) for name, value in values.items()}
            if float(values["a"]) * float(values["b"]) > float(values["s"])**2:
                self.assert_spins_as_by_newton_and_euler(values, round(rng.uniform(-3, 3), 2))

    def test_what_grows_in_a_spin_decays_in_the_opposite_one(self):
        one, other = (self.modes("rattleback", {"spin": spin, "tap": 0})["modes"] for spin in (2, -2))
        for a, b in zip(one, other):
            self.assertEqual((a["omega"], a.get("rate")), (b["omega"], b.get("rate")))
            self.assertEqual({"growth": "decay", "decay": "growth"}.get(a["kind"], a["kind"]), b["kind"])

    def test_a_stone_that_is_not_skew_neither_grows_nor_decays(self):
        found = self.modes("rattleback", {"s": 0, "tap": 0})
        self.assertEqual(self.of_kind(found, "growth", "decay"), [])
        self.assertEqual(found["equilibrium"]["stability"], "neutral")

    def test_eulers_disk_nods(self):
        """omega^2 = (3 + sin^2(theta))/5 phi_dot^2; and a disk that stands aside seems to turn with phi_dot."""
        for theta in ("0.05", "0.3", "1.2"):
            found = self.modes("euler_disk", {"theta0": theta, "push": 0})
            sine = mpmath.sin(mpmath.mpf(theta))
            turning = 2 * mpmath.sqrt(mpmath.mpf("9.81") / (mpmath.mpf("0.04") * sine))
            nodding, aside = self.of_kind(found, "oscillation")
            self.assert_within(nodding["omega"], nodding["error"], turning * mpmath.sqrt((3 + sine**2) / 5))
            self.assert_within(aside["omega"], aside["error"], turning)
            self.assertEqual(aside["shape"]["theta"], {"re": 0, "im": 0})

    def test_eulers_disk_nods_in_a_simulation(self):
        found = self.of_kind(self.modes("euler_disk", {"push": 0}), "oscillation")[0]
        motion = self.ask("simulate", {"system": "euler_disk", "parameters": {"push": 1e-5}, "t_end": 5 * found["period"], "samples": 2,
                                       "rtol": 1e-13, "atol": 1e-16, "events": ["theta_dot=0-"]})
        times = [event["t"] for event in motion["events"]]
        self.assertAlmostEqual((times[4] - times[0]) / 4 / found["period"], 1, places=8)

    def test_a_wheel_stays_upright_above_its_speed(self):
        """s^2 = 4 g/(5 r) - 12/5 w^2: upright where w^2 > g/(3 r)."""
        for w in ("20", "9.1", "9", "0"):
            found = self.modes(WHEEL, {"w": w})
            square = 4 * mpmath.mpf("9.81") / (5 * mpmath.mpf("0.04")) - 12 * mpmath.mpf(w)**2 / 5
            (leaning,) = self.of_kind(found, "growth" if square > 0 else "oscillation")
            self.assert_within(leaning["rate" if square > 0 else "omega"], leaning["error"], mpmath.sqrt(abs(square)))
            self.assertEqual(found["equilibrium"]["stability"], "unstable" if square > 0 else "neutral")

    def test_what_is_not_steady_is_told(self):
        for system, more, words in (
            ("disk_on_incline", {}, "s_ddot"), ("rattleback", {"equilibrium": {"beta": "1deg"}}, "'ground'"),
            (WHEEL, {"parameters": {"w": 0}, "equilibrium": {"theta": "80deg"}}, "_ddot is not 0"),
            ("euler_disk", {"initial": {"phi_dot": "sqrt(g/r)", "y_dot": 0, "theta_dot": 0, "psi_dot": "-sqrt(g/r)*cos(theta0)"}}, "y_ddot"),
            ("euler_disk", {"initial": {"phi_dot": 10, "y_dot": 0, "theta_dot": 0, "psi_dot": -10 * math.cos(0.3)}}, "as an expression"),
            (scenes.BLOCK_WITH_FRICTION | {"constraints": [{"name": "rail", "expression": "x_dot*sin(alpha) + y_dot*cos(alpha)"}]}, {}, "sign"),
        ):
            problem = self.refused("modes", {"system": system, **more})
            self.assertEqual(problem["type"], "/errors/not-applicable")
            self.assertIn(words, problem["detail"])


if __name__ == "__main__":
    sys.exit(unittest.main())
