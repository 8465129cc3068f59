"""Textbook scenes, sent inline, move as their closed forms and as SciPy's motion of hand-written equations."""

import math
import pathlib
import sys
import unittest

import numpy
from scipy.integrate import solve_ivp
from scipy.special import ellipk

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, textbook_scene  # noqa: E402

TIGHT = {"rtol": 1e-13, "atol": 1e-14}
CLOSED = 1e-10  # against a closed form: TIGHT over the some hundred steps of each motion, a thousand times enlarged
OTHER = 1e-9  # against DOP853 at rtol 1e-12, over the some thousand steps of each motion


class TextbookDynamics(Service):
    def move(self, scene, t_end, samples=101, **fields):
        request = {"system": textbook_scene(scene), "t_end": t_end, "samples": samples} | TIGHT | fields
        answer = self.ask("simulate", request)
        self.assertEqual(answer["status"], "complete")
        return answer, {name: numpy.array(column) for name, column in answer["trajectory"].items()}

    def assert_same(self, actual, expected, tolerance=CLOSED):
        """Within `tolerance` of the largest of what is expected."""
        self.assertLess(numpy.max(numpy.abs(actual - expected)), tolerance*numpy.max(numpy.abs(expected)))

    def test_kepler_ellipse_closes_after_its_period_and_keeps_its_angular_momentum(self):
        period = 2*math.pi  # mu = 1, semi-major axis 1
        answer, rows = self.move("kepler", 3*period, 301, include=["momenta"], events=["r_dot=0+"])
        r, theta = rows["r"], rows["theta"]
        self.assert_same(r*(1 + 0.5*numpy.cos(theta)), numpy.full_like(r, 0.75))  # the ellipse, p = a(1 - e^2)
        self.assert_same(r[::100], numpy.full(4, 0.5))
        self.assert_same(theta[::100], 2*math.pi*numpy.arange(4))
        self.assert_same(rows["p_theta"], numpy.full_like(r, 0.25*3.4641016151377544))
        self.assert_same(rows["r"][50::100], numpy.full(3, 1.5))
        self.assert_same(numpy.array([event["t"] for event in answer["events"]])[:2], period*numpy.array([1, 2]))
        drifts = {quantity["name"]: quantity["max_rel_drift"] for quantity in answer["diagnostics"]["conserved"]}
        self.assertEqual(set(drifts), {"energy", "p_theta"})
        self.assertLess(max(drifts.values()), CLOSED)

    def test_atwood_masses_fall_with_constant_acceleration(self):
        _, rows = self.move("atwood", 1.0, include=["accelerations"])
        a = 9.81*(0.5 - 0.4)/(0.5 + 0.4)
        self.assert_same(rows["x_ddot"], numpy.full(101, a))
        self.assert_same(rows["x"], 0.3 + a*rows["t"]**2/2)

    def test_damped_oscillator_decays_as_its_closed_form(self):
        _, rows = self.move("damped_oscillator", 10.0)
        m, b, k = 0.5, 0.3, 8.0
        decay = b/(2*m)
        omega = math.sqrt(k/m - decay**2)
        t = rows["t"]
        x = 0.2*numpy.exp(-decay*t)*(numpy.cos(omega*t) + decay/omega*numpy.sin(omega*t))
        self.assert_same(rows["x"], x)

    def test_damped_oscillator_under_a_harmonic_force_settles_to_the_amplitude_of_the_resonance_curve(self):
        _, rows = self.move("damped_oscillator", 150.0, 3001, inputs={"F": "0.4*cos(3*t)"})
        m, b, k, w = 0.5, 0.3, 8.0, 3.0
        late = rows["t"] > 140  # exp(-0.3*140) = 6e-19 is left of the start
        t, z = rows["t"][late], 0.4/complex(k - m*w**2, b*w)
        self.assert_same(rows["x"][late], (z*numpy.exp(1j*w*t)).real)

    def test_charge_in_a_magnetic_field_runs_on_a_helix(self):
        _, rows = self.move("magnetic_particle", 20.0)
        w, t = 0.002*0.5/0.001, rows["t"]
        self.assert_same(rows["x"], numpy.sin(w*t)/w)
        self.assert_same(rows["y"], (numpy.cos(w*t) - 1)/w)
        self.assert_same(rows["z"], 0.1*t)

    def test_foucault_pendulum_precesses_at_omega_sine_latitude(self):
        _, rows = self.move("foucault", 3600.0, 61)
        turn, g, l = 7.292115e-5*math.sin(0.8527), 9.81, 67.0
        omega, t = math.sqrt(g/l + turn**2), rows["t"]
        # In the frame that turns with -turn it is an ellipse: z = x + i y, z'' + 2 i turn z' + (g/l) z = 0.
        z = 3*numpy.exp(-1j*turn*t)*(numpy.cos(omega*t) + 1j*turn/omega*numpy.sin(omega*t))
        self.assert_same(rows["x"], z.real, 1e-9)  # phases of 1400 rad, kept to 1e-13 a step
        self.assert_same(rows["y"], z.imag, 1e-9)

    def test_bead_rests_where_the_hoop_turns_it_out_and_oscillates_about_there(self):
        Omega, r, g = 8.0, 0.3, 9.81
        rest = math.acos(g/(r*Omega**2))
        _, rows = self.move("bead_on_hoop", 10.0, initial={"theta": rest, "theta_dot": 0})
        self.assert_same(rows["theta"], numpy.full(101, rest))
        small = 1e-5
        omega = Omega*math.sin(rest)
        _, rows = self.move("bead_on_hoop", 5.0, initial={"theta": rest + small, "theta_dot": 0})
        deviation = small*numpy.cos(omega*rows["t"])
        self.assert_same(rows["theta"] - rest, deviation, 20*small)  # of the next order: phase and centre shift
        _, rows = self.move("bead_on_hoop", 5.0, parameters={"Omega": 5}, initial={"theta": small})
        omega = math.sqrt(g/r - 25)
        self.assert_same(rows["theta"], small*numpy.cos(omega*rows["t"]), 1e-8)  # small^2, times the phase

    def test_plane_pendulum_has_the_period_of_the_elliptic_integral(self):
        period = 4*math.sqrt(0.8/9.81)*ellipk(math.sin(0.5)**2)
        answer, _ = self.move("plane_pendulum", 10*period, events=["theta_dot=0-"])
        times = numpy.array([event["t"] for event in answer["events"]])
        times = times[times > period/2]  # the start is a turning point too
        self.assert_same(times[:9], period*numpy.arange(1, 10))

    def test_spherical_pendulum_can_go_round_on_a_cone(self):
        rate = math.sqrt(9.81/(0.8*math.cos(1.0)))
        _, rows = self.move("spherical_pendulum", 5.0, initial={"theta": 1, "theta_dot": 0, "phi_dot": rate})
        self.assert_same(rows["theta"], numpy.ones(101))
        self.assert_same(rows["phi"], rate*rows["t"])

    def test_triple_pendulum_in_a_mode_swings_at_a_zero_of_the_laguerre_polynomial(self):
        zero = 0.41577455678347908  # the least of L_3, Abramowitz and Stegun, table 25.9
        omega, small = math.sqrt(zero*9.81/0.3), 1e-6
        stiffness, mass = numpy.diag([3.0, 2, 1]), numpy.array([[3.0, 2, 1], [2, 2, 1], [1, 1, 1]])
        shape = numpy.linalg.svd(stiffness - zero*mass)[2][-1]
        shape = shape/shape[0]
        start = {f"q{i + 1}": small*shape[i] for i in range(3)}
        _, rows = self.move("triple_pendulum", 10.0, initial=start)
        for i in range(3):
            self.assert_same(rows[f"q{i + 1}"], small*shape[i]*numpy.cos(omega*rows["t"]), 1e-7)  # atol over small

    def compare_with_scipy(self, scene, right_side, names, start, t_end, **fields):
        _, rows = self.move(scene, t_end, 201, **fields)
        solution = solve_ivp(right_side, (0, t_end), start, "DOP853", rows["t"], rtol=1e-12, atol=1e-13)
        for name, expected in zip(names, solution.y):
            self.assert_same(rows[name], expected, OTHER)

    def test_shaken_pivot_holds_the_pendulum_upright_as_scipy_says(self):
        l, a, w, g = 0.2, 0.02, 150.0, 9.81

        def right_side(t, y):
            return [y[1], -(g - a*w**2*math.cos(w*t))/l*math.sin(y[0])]

        self.compare_with_scipy("driven_pivot", right_side, ["theta", "theta_dot"], [3, 0], 3.0)
        _, rows = self.move("driven_pivot", 3.0, 3001)  # a^2 w^2 = 9 > 2 g l = 3.9
        self.assertLess(numpy.max(numpy.abs(rows["theta"] - math.pi)), 0.5)
        _, rows = self.move("driven_pivot", 3.0, 3001, parameters={"w": 60})  # a^2 w^2 = 1.4
        self.assertGreater(numpy.max(numpy.abs(rows["theta"] - math.pi)), 1)

    def test_triple_pendulum_moves_as_scipy_says(self):
        def right_side(_, y):
            q, v = y[:3], y[3:]
            count = numpy.array([[3.0, 2, 1], [2, 2, 1], [1, 1, 1]])
            difference = q[:, None] - q[None, :]
            mass = count*numpy.cos(difference)
            force = (count*numpy.sin(difference)) @ v**2 + 9.81/0.3*numpy.array([3, 2, 1])*numpy.sin(q)
            return numpy.concatenate([v, numpy.linalg.solve(mass, -force)])

        self.compare_with_scipy("triple_pendulum", right_side, ["q1", "q2", "q3"],
                                numpy.array([0.5, 0.6, 0.8, 0, 0, 0]), 3.0)

    def test_another_equation_would_be_seen(self):
        _, rows = self.move("atwood", 1.0)
        with self.assertRaises(AssertionError):
            self.assert_same(rows["x"], 0.3 + (1 + 1e-8)*1.09*rows["t"]**2/2)


if __name__ == "__main__":
    unittest.main()
