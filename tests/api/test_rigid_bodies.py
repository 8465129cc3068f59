"""Rigid bodies against textbooks' formulas, SciPy's rotations and elliptic functions, and SymPy's equations."""

import itertools
import math
import pathlib
import random
import sys
import unittest

import numpy
import sympy
from scipy.spatial.transform import Rotation
from scipy.special import ellipj, ellipk
from sympy.physics import mechanics

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import rigid_scenes as scenes  # noqa: E402
from service import Service  # noqa: E402

ROUND_OFF = 1e-12
MOMENTS = numpy.array([1.0, 2.0, 3.0])
SEQUENCES = ["".join(s) for n in (2, 3) for s in itertools.product("XYZ", repeat=n) if all(a != b for a, b in zip(s, s[1:]))]


def body_rates(turned, angles, rates):
    """The angular velocity in the body's axes by a difference quotient of turned(angles)."""
    h = 1e-5
    forward, back = (turned([a + s * h * w for a, w in zip(angles, rates)]) for s in (1, -1))
    return (back.inv() * forward).as_rotvec() / (2 * h)


class Moments(Service):
    """No principal moment is larger than the sum of the other two: I3 = I1 + I2 - 2 sum of m z^2."""

    def refusal(self, endpoint="energy", **request):
        (error,) = self.refused(endpoint, request)["errors"]
        return error["pointer"], error["detail"]

    def test_those_of_no_body_are_refused_with_the_parameters_that_make_them(self):
        turned = {"sequence": "ZXZ", "angles": ["a", "b", "c"]}
        for moments, which in ((("1", "1", "3"), "third"), (("1", "3.5", "2"), "second"), (("0.31", "0.1", "0.2"), "first")):
            pointer, detail = self.refusal(system=scenes.free_body(turned, moments))
            self.assertEqual(pointer, "#/parameters")
            self.assertIn(f"With these parameters the {which} principal moment of 'body' is larger", detail)
        self.assertIn("third", self.refusal("simulate", system=scenes.free_body(turned), parameters={"I3": 3.001}, t_end=1)[1])

    def test_those_of_a_plate_are_let_pass_as_decimals(self):
        turned = {"sequence": "ZXZ", "angles": ["a", "b", "c"]}
        for moments in (("0.1", "0.2", "0.3"), ("0.3", "0.1", "0.2"), ("0.7", "0.6", "0.1"), ("1", "1", "2")):
            self.ask("energy", {"system": scenes.free_body(turned, moments)})

    def test_numbers_that_no_parameter_changes_are_refused_in_the_scene(self):
        scene = scenes.free_body({"sequence": "ZXZ", "angles": ["a", "b", "c"]})
        scene["bodies"][0]["principal_moments"] = ["0.1", "0.1", "0.3"]
        self.assertEqual(self.refusal("equations", system=scene), ("#/system/bodies/0", "No principal moment is larger than the sum of the other two."))
        scene["bodies"][0]["principal_moments"] = ["0.1", "0.1", "0.2"]
        self.ask("equations", {"system": scene})

    def test_those_that_no_parameters_make_possible_are_refused_in_the_scene(self):
        scene = scenes.free_body({"sequence": "ZXZ", "angles": ["a", "b", "c"]})
        for parameter in scene["parameters"]:
            parameter["domain"] = "> 0"
        for third, is_refused in (("3*I1", True), ("2*I1", False), ("I1", False)):
            scene["bodies"][0]["principal_moments"] = ["I1", "I1", third]
            self.check_scene(scene, is_refused)
        for third, is_refused in (("I1 + I2 + I3", True), ("5*I1 + 2*I2", True), ("I1 + I2", False), ("2*I1 + I3", False)):
            scene["bodies"][0]["principal_moments"] = ["I1", "I2", third]
            self.check_scene(scene, is_refused)
        scene["parameters"][3]["domain"] = ">= 0"  # a plate, where it is 0
        scene["bodies"][0]["principal_moments"] = ["I1", "I2", "I1 + I2 + I3"]
        self.check_scene(scene, False)

    def check_scene(self, scene, is_refused):
        if is_refused:
            self.assertEqual(self.refusal("equations", system=scene), ("#/system/bodies/0", "No principal moment is larger than the sum of the other two."))
        else:
            self.ask("equations", {"system": scene})

    def test_a_parameter_is_not_given_a_value_that_is_that_of_no_body(self):
        start = {"theta": 0.5, "psi_dot": 100, "phi_dot": 1}
        answer = self.ask("equilibria", {"system": scenes.SYMMETRIC_TOP, "solve_for": "C", "at": {"theta": 0.5}, "initial": start})
        self.assertEqual(answer["all"], [])
        self.assertIn("the third principal moment of 'top' is larger than the sum of the other two", answer["reason"])
        start["psi_dot"] = 400  # a quarter of it, for the same momentum
        self.assertEqual(len(self.ask("equilibria", {"system": scenes.SYMMETRIC_TOP, "solve_for": "C", "at": {"theta": 0.5}, "initial": start})["all"]), 1)

    def test_a_critical_value_of_no_body_is_left_out_and_told(self):
        request = {"system": scenes.SLEEPING_TOP, "parameter": "C", "from": 0.0005, "to": 0.02}
        start = {"a": 0, "b": 0, "psi": 0, "a_dot": 0, "b_dot": 0}
        answer = self.ask("bifurcations", request | {"initial": start | {"psi_dot": 25}})
        self.assertEqual(answer["critical"], [])
        self.assertIn("the third principal moment of 'top' is larger than the sum of the other two", answer["reason"])
        answer = self.ask("bifurcations", request | {"initial": start | {"psi_dot": 60}})
        self.assertEqual(len(answer["critical"]), 2)  # upright and hanging


class Energies(Service):
    def kinetic(self, scene, state):
        return self.ask("energy", {"system": scene, "initial": state})["T"]

    def test_every_sequence_turns_as_in_scipy(self):
        rng = random.Random(3)
        for sequence in SEQUENCES + [s.lower() for s in SEQUENCES]:
            names = "abc"[:len(sequence)]
            angles, rates = ([rng.uniform(-2, 2) for _ in names] for _ in range(2))
            state = dict(zip(names, angles)) | {f"{n}_dot": w for n, w in zip(names, rates)}
            scene = scenes.free_body({"sequence": sequence, "angles": list(names)}, names=names)
            omega = body_rates(lambda a: Rotation.from_euler(sequence, a), angles, rates)
            self.assertAlmostEqual(self.kinetic(scene, state), MOMENTS @ omega**2 / 2, 7, sequence)

    def test_axes_may_point_anywhere(self):
        slanted = ["cos(0.3)", 0, "sin(0.3)"]
        numbers = {"cos(0.3)": math.cos(0.3), "sin(0.3)": math.sin(0.3)}
        for axes in ([[1, 2, 2], [0, 3, -4]], [[1, 1, 0], slanted], [[0, 0, 1], [1, 1, 0], [0, 0, 1]]):
            unit = [numpy.array([numbers.get(x, x) for x in axis], float) for axis in axes]
            unit = [n / numpy.linalg.norm(n) for n in unit]
            turned = lambda a: math.prod(  # noqa: E731
                (Rotation.from_rotvec(x * n) for x, n in zip(a, unit)), start=Rotation.identity())  # noqa: B023
            names = "abc"[:len(axes)]
            scene = scenes.free_body({"rotations": [{"axis": n, "angle": a} for n, a in zip(axes, names)]}, names=names)
            angles, rates = [0.3, -1.1, 0.7][:len(axes)], [1.5, 0.4, -0.8][:len(axes)]
            state = dict(zip(names, angles)) | {f"{n}_dot": w for n, w in zip(names, rates)}
            omega = body_rates(turned, angles, rates)
            self.assertAlmostEqual(self.kinetic(scene, state), MOMENTS @ omega**2 / 2, 7)


def gauss(a, b):
    nodes, weights = numpy.polynomial.legendre.leggauss(12)
    return (a + b) / 2 + (b - a) / 2 * nodes, (b - a) / 2 * weights


def gyration_squared(*ranges, place, weight=lambda *u: 1.0):
    """(rho_1^2, rho_2^2, rho_3^2) by integration over parameters of a body's places."""
    total, sums = 0.0, numpy.zeros(3)
    for nodes in itertools.product(*(list(zip(*gauss(*r))) for r in ranges)):
        u = [node for node, _ in nodes]
        dm = math.prod(w for _, w in nodes) * weight(*u)
        x, y, z = place(*u)
        total += dm
        sums += dm * numpy.array([y * y + z * z, z * z + x * x, x * x + y * y])
    return sums / total


TURN = (0, 2 * math.pi)
ROUND = lambda r, f, z: (r * math.cos(f), r * math.sin(f), z)  # noqa: E731
BALL = lambda r, u, f: (r * math.sqrt(1 - u * u) * math.cos(f), r * math.sqrt(1 - u * u) * math.sin(f), r * u)  # noqa: E731
SHAPES = {
    "disk": ({"radius": 0.2}, lambda: gyration_squared((0, 0.2), TURN, place=lambda r, f: ROUND(r, f, 0), weight=lambda r, f: r)),
    "ring": ({"radius": 0.2}, lambda: gyration_squared(TURN, place=lambda f: ROUND(0.2, f, 0))),
    "sphere": ({"radius": 0.2}, lambda: gyration_squared((0, 0.2), (-1, 1), TURN, place=BALL, weight=lambda r, u, f: r * r)),
    "shell": ({"radius": 0.2}, lambda: gyration_squared((-1, 1), TURN, place=lambda u, f: BALL(0.2, u, f))),
    "cylinder": ({"radius": 0.2, "length": 0.5}, lambda: gyration_squared(
        (0, 0.2), TURN, (-0.25, 0.25), place=ROUND, weight=lambda r, f, z: r)),
    "box": ({"width": 0.2, "height": 0.3, "depth": 0.7}, lambda: gyration_squared(
        (-0.1, 0.1), (-0.15, 0.15), (-0.35, 0.35), place=lambda x, y, z: (x, y, z))),
}


class Shapes(Service):
    def omega(self, scene):
        return self.ask("modes", {"system": scene, "equilibrium": {"theta": 0}})["modes"][0]["omega"]

    def test_every_shape_has_the_moments_of_its_integral(self):
        for kind, (sizes, integral) in SHAPES.items():
            words = {"a": sizes.get("radius", sizes.get("width")), "b": sizes.get("length", sizes.get("height", 1)),
                     "c": sizes.get("depth", 1)}
            body = {"kind": kind} | dict(zip(sizes, words))
            rho = integral()
            for k, axis in enumerate(numpy.eye(3, dtype=int).tolist()):
                omega = self.omega(scenes.about_axis(body, axis, **{n: str(v) for n, v in words.items()}))
                self.assertAlmostEqual(omega**2 * 0.7 * rho[k] / 0.2, 1, 8, (kind, k))

    def test_physical_pendula_in_the_plane(self):
        for kind, (sizes, integral) in SHAPES.items():
            words = {n: v for n, v in sizes.items() if n not in ("length", "depth")}
            scene = scenes.pendulum({"kind": kind} | {n: f"s{i}" for i, n in enumerate(words)},
                                    **{f"s{i}": str(v) for i, v in enumerate(words.values())})
            self.assertAlmostEqual(self.omega(scene) ** 2, 9.81 * 0.3 / (integral()[2] + 0.09), 8, kind)
        known = scenes.pendulum({"kind": "rigid_body", "inertia": "m*d^2"})
        self.assertAlmostEqual(self.omega(known) ** 2, 9.81 / 0.6, 11)

    def test_a_rod_by_its_ends_is_a_thin_box(self):
        rod = scenes.pendulum({"kind": "particle"}) | {
            "bodies": [{"kind": "rod", "mass": "m", "start": [0, 0], "end": ["2*d*sin(theta)", "-2*d*cos(theta)"]}]}
        box = scenes.pendulum({"kind": "box", "width": 0, "height": "2*d"})
        self.assertAlmostEqual(self.omega(rod), self.omega(box), 13)


class Tops(Service):
    """A = 0.002 + m l^2 about the fixed point. Goldstein, Classical Mechanics, 3rd ed., 5.7."""

    A, C, M = 0.002 + 0.5 * 0.1**2, 0.001, 0.5 * 9.81 * 0.1

    def motion(self, scene, initial, t_end, **more):
        request = {"system": scene, "initial": initial, "t_end": t_end, "samples": 101} | more
        answer = self.ask("simulate", request)
        self.assertEqual(answer["status"], "complete", answer.get("stop"))
        return answer

    def test_steady_precession(self):
        theta, spin = 0.6, 300.0  # w3; A cos(theta) w^2 - C w3 w + m g l = 0
        for w in numpy.roots([self.A * math.cos(theta), -self.C * spin, self.M]):
            start = {"theta": theta, "phi_dot": w, "psi_dot": spin - w * math.cos(theta)}
            answer = self.motion(scenes.SYMMETRIC_TOP, start, 1, max_error=1e-9)
            self.assertLess(max(abs(x - theta) for x in answer["trajectory"]["theta"]), 1e-7)
            turned = answer["trajectory"]["phi"][-1] - answer["trajectory"]["phi"][0]
            self.assertAlmostEqual(turned, w, 5)

    def test_what_is_kept(self):
        answer = self.motion(scenes.SYMMETRIC_TOP, {"phi_dot": 3, "psi_dot": 80}, 2)
        kept = {one["name"]: one for one in answer["diagnostics"]["conserved"]}
        self.assertEqual(set(kept), {"energy", "p_phi", "p_psi"})
        for one in kept.values():
            self.assertLess(one["max_rel_drift"], 1e-8, one)

    def test_nutation_turns_where_the_effective_potential_says(self):
        theta, spin = 0.5, 250.0
        b, a_, beta = self.C * spin / self.A, self.C * spin * math.cos(theta) / self.A, 2 * self.M / self.A
        # released from rest: u = cos(theta) between u0 and the other root of (1 - u^2) beta - b^2 (u0 - u) = 0
        self.assertAlmostEqual(a_, b * math.cos(theta), 12)
        u = min(numpy.roots([-beta, b * b, beta - b * b * math.cos(theta)]))
        answer = self.ask("turning_points", {"system": scenes.SYMMETRIC_TOP, "coordinate": "theta",
                                             "initial": {"theta": theta, "psi_dot": spin}})
        self.assertAlmostEqual(answer["theta_min"], theta, 12)
        self.assertAlmostEqual(answer["theta_max"], math.acos(u), 9)

    def test_a_top_sleeps_above_its_threshold(self):
        threshold = 2 * math.sqrt(self.A * self.M) / self.C
        for spin, sleeps in ((1.1 * threshold, True), (0.9 * threshold, False)):
            answer = self.motion(scenes.SLEEPING_TOP, {"a": 1e-4, "b": 0, "psi": 0, "psi_dot": spin}, 3, accuracy="fast")
            way = max(math.hypot(a, b) for a, b in zip(answer["trajectory"]["a"], answer["trajectory"]["b"]))
            self.assertEqual(way < 1e-3, sleeps, (spin, way))


class FreeBodies(Service):
    def space_momentum(self, trajectory, i):
        angles = [trajectory[n][i] for n in "abc"]
        rates = [trajectory[f"{n}_dot"][i] for n in "abc"]
        phi, theta, psi = angles
        dphi, dtheta, dpsi = rates  # Goldstein (4.87)
        omega = numpy.array([dphi * math.sin(theta) * math.sin(psi) + dtheta * math.cos(psi),
                             dphi * math.sin(theta) * math.cos(psi) - dtheta * math.sin(psi), dphi * math.cos(theta) + dpsi])
        return Rotation.from_euler("ZXZ", angles).apply(MOMENTS * omega), omega

    def test_a_racket_turns_over_as_jacobi_says(self):
        # about the middle axis: w1 = a1 cn, w2 = a2 sn, w3 = a3 dn for 2 E I2 < L^2; Landau and Lifshitz, Mechanics, 37
        scene = scenes.free_body({"sequence": "ZXZ", "angles": ["a", "b", "c"]})
        small, fast = 0.02, 2.0
        theta, psi = 1.3, 0.4  # w = (small, 0, .) turned into rates of the angles
        w = numpy.array([small, fast, small * 1.5])
        dphi = (w[0] * math.sin(psi) + w[1] * math.cos(psi)) / math.sin(theta)
        start = {"a": 0.2, "b": theta, "c": psi, "a_dot": dphi, "b_dot": w[0] * math.cos(psi) - w[1] * math.sin(psi),
                 "c_dot": w[2] - dphi * math.cos(theta)}
        answer = self.ask("simulate", {"system": scene, "initial": start, "t_end": 20, "samples": 401, "max_error": 1e-8,
                                       "on_invalid": "continue"})
        self.assertEqual(answer["status"], "complete", answer.get("stop"))
        first, _ = self.space_momentum(answer["trajectory"], 0)
        found = []
        for i in range(401):
            momentum, omega = self.space_momentum(answer["trajectory"], i)
            self.assertLess(numpy.linalg.norm(momentum - first), 1e-6)
            found.append(omega[1])
        self.assertLess(min(found), -1.99, "the racket turns over")
        i1, i2, i3 = MOMENTS
        two_e, l_squared = MOMENTS @ w**2, MOMENTS**2 @ w**2
        a2 = math.sqrt((two_e * i3 - l_squared) / (i2 * (i3 - i2)))
        rate = math.sqrt((i3 - i2) * (l_squared - two_e * i1) / (i1 * i2 * i3))
        k = (i2 - i1) * (two_e * i3 - l_squared) / ((i3 - i2) * (l_squared - two_e * i1))
        if k > 1:  # 2 E I2 > L^2: the same with axes 1 and 3 exchanged
            a2 = math.sqrt((l_squared - two_e * i1) / (i2 * (i2 - i1)))
            rate = math.sqrt((i2 - i1) * (two_e * i3 - l_squared) / (i1 * i2 * i3))
            k = 1 / k
        # at which phase it starts: sn there is w2/a2, and Euler's equation says which way w2 goes on
        grid = numpy.linspace(0, 4 * ellipk(k), 400001)
        wave = a2 * ellipj(grid, k)[0]
        slope = (i3 - i1) * w[2] * w[0] / i2
        near = [u for u, x, d in zip(grid, wave - w[1], numpy.gradient(wave)) if abs(x) < 2e-6 and d * slope > 0]
        errors = [max(abs(a2 * ellipj(u + rate * t, k)[0] - x) for t, x in zip(answer["trajectory"]["t"], found)) for u in near]
        self.assertLess(min(errors), 5e-3)

    def test_a_torque_changes_the_momentum_at_its_rate(self):
        scene = scenes.free_body({"sequence": "ZXZ", "angles": ["a", "b", "c"]},
                                 forces=[{"torque": ["P*t", "0.2", "-0.1"], "body": "body"}])
        scene["parameters"].append({"name": "P", "unit": "W", "default": 0.3})
        start = {"a": 0.2, "b": 1.3, "c": 0.4, "a_dot": 0.7, "b_dot": 0.1, "c_dot": 1.1}
        answer = self.ask("simulate", {"system": scene, "initial": start, "t_end": 1, "samples": 5, "max_error": 1e-10})
        first, _ = self.space_momentum(answer["trajectory"], 0)
        for i, t in enumerate(answer["trajectory"]["t"]):
            gained = self.space_momentum(answer["trajectory"], i)[0] - first
            self.assertLess(numpy.abs(gained - [0.15 * t * t, 0.2 * t, -0.1 * t]).max(), 1e-8)
        self.assertEqual(answer["diagnostics"]["conserved"], [])


class SameAsSympy(Service):
    def test_accelerations_of_an_asymmetric_top(self):
        t = mechanics.dynamicsymbols._t
        q = mechanics.dynamicsymbols("phi theta psi")
        space, frame = mechanics.ReferenceFrame("N"), mechanics.ReferenceFrame("R")
        frame.orient(space, "Body", q, "ZXZ")
        m, l, a, b, c, g = 0.5, 0.1, 0.002, 0.0025, 0.001, 9.81
        pivot = mechanics.Point("O")
        pivot.set_vel(space, 0)
        centre = pivot.locatenew("G", l * frame.z)
        centre.v2pt_theory(pivot, space, frame)
        body = mechanics.RigidBody("B", centre, frame, m, (mechanics.inertia(frame, a, b, c), centre))
        body.potential_energy = m * g * l * frame.z.dot(space.z)
        method = mechanics.LagrangesMethod(mechanics.Lagrangian(space, body), q)
        method.form_lagranges_equations()
        plain = {x.diff(t): sympy.Symbol(f"v{i}") for i, x in enumerate(q)} | {x: sympy.Symbol(f"q{i}") for i, x in enumerate(q)}
        known = sympy.lambdify([list(plain.values())], (method.mass_matrix.subs(plain), method.forcing.subs(plain)), "numpy")
        scene, rng = scenes.heavy_top(("A", "B", "C")), random.Random(1)
        for _ in range(10):
            state = [rng.uniform(-20, 20) for _ in q] + [rng.uniform(0.3, 2.8) for _ in q]
            matrix, forcing = known(state)
            true = numpy.linalg.solve(numpy.array(matrix, float), numpy.array(forcing, float)).ravel()
            initial = dict(zip(("phi_dot", "theta_dot", "psi_dot", "phi", "theta", "psi"), state))
            found = self.ask("energy", {"system": scene, "initial": initial})["accelerations"]
            for name, value in zip(("phi", "theta", "psi"), true):
                self.assertLess(abs(found[f"{name}_ddot"] - value), 1e-9 * max(1, numpy.abs(true).max()))


class Mistakes(Service):
    def test_each_is_told_at_its_place(self):
        def change(**body):
            scene = scenes.free_body({"sequence": "ZXZ", "angles": ["a", "b", "c"]})
            merged = scene["bodies"][0] | body
            return scene | {"bodies": [{k: v for k, v in merged.items() if v is not None}]}

        plane = scenes.pendulum({"kind": "disk", "radius": "d"})
        in_plane = lambda **body: plane | {"bodies": [{k: v for k, v in (plane["bodies"][0] | body).items() if v is not None}]}  # noqa: E731
        for scene, pointer in (
            (change(orientation={"sequence": "ZXQ", "angles": ["a", "b", "c"]}), "/orientation/sequence"),
            (change(orientation={"sequence": "ZxZ", "angles": ["a", "b", "c"]}), "/orientation/sequence"),
            (change(orientation={"sequence": "ZXZ", "angles": ["a", "b"]}), "/orientation/angles"),
            (change(orientation={"sequence": "ZXZ"}), "/orientation/angles"),
            (change(orientation={"sequence": "ZXZ", "angles": ["a", "b", "m"]}), "/orientation/angles/2"),
            (change(orientation={"rotations": [{"axis": [0, 0, 0], "angle": "a"}]}), "/orientation/rotations/0/axis"),
            (change(orientation={"rotations": [{"axis": [0, 1], "angle": "a"}]}), "/orientation/rotations/0/axis"),
            (change(orientation={"rotations": [{"axis": [0, "a", 1], "angle": "a"}]}), "/orientation/rotations/0/axis/1"),
            (change(orientation=None, angle="a"), "/angle"),
            (change(principal_moments=["I1", "I2"]), "/principal_moments"),
            (change(principal_moments=["I1", "I2", "m"]), "/principal_moments/2"),
            (change(principal_moments=None, inertia="I1"), "/inertia"),
            (change(kind="cylinder", principal_moments=None, radius=1), ""),
            (in_plane(orientation={"sequence": "Z", "angles": ["theta"]}, angle=None), "/orientation"),
            (in_plane(kind="cylinder", length=1), "/length"),
            (in_plane(radius="m"), "/radius"),
            (in_plane(angle=None), ""),
        ):
            self.refused_at("energy", {"system": scene}, "#/system/bodies/0" + pointer)

    def test_words_of_others_are_told_ours(self):
        for word, ours in (("hoop", "ring"), ("Ball", "sphere"), ("wheel", "disk"), ("bar", "rod"), ("plate", "box"), ("bob", "particle")):
            problem = self.refused("energy", {"system": scenes.pendulum({"kind": word, "radius": "d"})})
            (error,) = problem["errors"]
            self.assertEqual((error["pointer"], error["did_you_mean"]), ("#/system/bodies/0/kind", ours))

    def test_angles_that_say_the_same_have_no_inertia(self):
        self.refused("energy", {"system": scenes.free_body({"sequence": "ZXZ", "angles": ["a", "b - b", "c"]})})


if __name__ == "__main__":
    unittest.main()
