"""Springs between places, torsion springs, dampers, drag and generalized forces against closed forms and SciPy."""

import copy
import math
import pathlib
import sys
import unittest

import numpy
from scipy.integrate import solve_ivp

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import rigid_scenes as scenes  # noqa: E402
from constrained_scenes import coordinates, parameters  # noqa: E402
from service import Service  # noqa: E402


class Springs(Service):
    def omegas(self, scene, **more):
        return [mode.get("omega") for mode in self.ask("modes", {"system": scene} | more)["modes"]]

    def test_two_masses_on_a_spring_between_them(self):
        free, swing = self.omegas(scenes.TWO_MASSES, equilibrium={"x1": 0, "x2": 0.5})
        self.assertEqual(free, 0)
        self.assertAlmostEqual(swing, math.sqrt(12 * (1 / 0.4 + 1 / 0.9)), 12)

    def test_a_spring_between_places_is_one_of_their_distance(self):
        written = copy.deepcopy(scenes.TWO_MASSES)
        written["springs"] = [{"stiffness": "k", "length": "abs(x2 - x1)", "rest_length": "l0"}]
        del written["dampers"]
        request = {"t_end": 1, "samples": 11, "max_error": 1e-10, "initial": {"x1": -0.1, "x2": 0.7, "x1_dot": 0.3}}
        one, other = (self.ask("simulate", {"system": s} | request)["trajectory"] for s in (scenes.TWO_MASSES, written))
        for name in ("x1", "x2"):
            self.assertLess(numpy.abs(numpy.array(one[name]) - other[name]).max(), 1e-10)

    def test_without_a_natural_length_places_may_meet(self):
        scene = copy.deepcopy(scenes.TWO_MASSES)
        scene["springs"][0]["rest_length"] = 0
        del scene["dampers"]
        answer = self.ask("simulate", {"system": scene, "t_end": 2, "samples": 21, "initial": {"x1": 0, "x2": 0.5}})
        rate = math.sqrt(12 * (1 / 0.4 + 1 / 0.9))
        for t, a, b in zip(answer["trajectory"]["t"], answer["trajectory"]["x1"], answer["trajectory"]["x2"]):
            self.assertAlmostEqual(b - a, 0.5 * math.cos(rate * t), 7)

    def test_a_torsion_spring_turns_about_its_rest(self):
        scene = scenes.about_axis({"kind": "sphere", "radius": "r"}, [1, 1, 0], r="0.2")
        scene["springs"][0]["rest_angle"] = "0.3"
        found = self.ask("modes", {"system": scene, "equilibrium": {"theta": 0.3}})
        self.assertAlmostEqual(found["modes"][0]["omega"], math.sqrt(0.2 / (0.4 * 0.7 * 0.04)), 11)
        energy = self.ask("energy", {"system": scene, "initial": {"theta": 0.8}})
        self.assertAlmostEqual(energy["V"], 0.1 * 0.25, 15)

    def test_far_from_the_origin(self):
        """The same motion wherever it is; multiplied out, distances would lose digits, and the energy does."""
        for z in (10, 1000, 100000, 10000000):
            spring = {"stiffness": "5", "rest_length": "1", "between": [["x", "y"], [str(z - 1), "0"]]}
            coordinates = [{"name": "x", "initial": f"{z}.3"}, {"name": "y", "initial": "0.4"}]
            body = {"kind": "particle", "mass": "1", "position": ["x", "y"]}
            there = {"name": "far", "units": "none", "coordinates": coordinates}
            near = {"name": "near", "units": "none", "coordinates": [dict(coordinates[0], initial="1.3"), coordinates[1]]}
            form = f"sqrt(x^2 - {2*z - 2}*x + {(z - 1)**2} + y^2)"
            beside = dict(near, bodies=[body], springs=[dict(spring, between=[["x", "y"], ["0", "0"]])])
            true = self.ask("simulate", {"system": beside, "t_end": 1, "samples": 2})["trajectory"]["x"][-1]
            for scene, last_digits in ((dict(there, bodies=[body], springs=[spring]), 64),
                                       (dict(there, lagrangian=f"x_dot^2/2 + y_dot^2/2 - 5/2*({form} - 1)^2"), None)):
                with self.subTest(z=z, digits=last_digits):
                    answer = self.ask("simulate", {"system": scene, "t_end": 1, "samples": 2})
                    self.assertNotIn("reason", answer["accuracy"])
                    error = answer["accuracy"]["max_abs_error"]["x"]
                    self.assertLessEqual(abs(answer["trajectory"]["x"][-1] - (z - 1) - true), error + 1e-15)
                    if last_digits:
                        self.assertLess(error, last_digits * z * 2**-52)


class Dampers(Service):
    def test_a_damper_between_places(self):
        answer = self.ask("simulate", {"system": scenes.TWO_MASSES, "parameters": {"c": 0.8}, "t_end": 3, "samples": 31,
                                       "max_error": 1e-9})
        mass = 0.4 * 0.9 / 1.3
        decay = 0.8 / (2 * mass)
        rate = math.sqrt(12 / mass - decay**2)
        for t, a, b in zip(*(answer["trajectory"][n] for n in ("t", "x1", "x2"))):
            known = 0.5 + 0.2 * math.exp(-decay * t) * (math.cos(rate * t) + decay / rate * math.sin(rate * t))
            self.assertLess(abs(b - a - known), 3e-9)
        self.assertNotIn("energy", [one["name"] for one in answer["diagnostics"]["conserved"]])

    def test_each_thing_that_moves_may_be_damped(self):
        base = {"parameters": parameters(m=("kg", "2"), r=("m", "0.3"), c=("N*s/m", "1.5"), k=("N*m*s", "0.4")),
                "coordinates": coordinates(x=("m", "0", "2"), a=("rad", "0", "3")), "name": "damped",
                "bodies": [{"kind": "ring", "mass": "m", "radius": "r", "centre": ["x", 0], "angle": "a"}]}
        inertia = 2 * 0.09
        for damper, name, known in (
            ({"coefficient": "c", "length": "x"}, "x_dot", 2 * math.exp(-1.5 / 2)),
            ({"coefficient": "c", "point": ["x", 0]}, "x_dot", 2 * math.exp(-1.5 / 2)),
            ({"coefficient": "k", "angle": "a"}, "a_dot", 3 * math.exp(-0.4 / inertia)),
            ({"coefficient": 0.7, "law": "quadratic", "length": "x"}, "x_dot", 1 / (1 / 2 + 0.7 / 2)),
            ({"coefficient": 0.7, "law": "quadratic", "angle": "a"}, "a_dot", 1 / (1 / 3 + 0.7 / inertia)),
            ({"coefficient": 0.7, "law": "quadratic", "point": ["x", 0]}, "x_dot", 1 / (1 / 2 + 0.7 / 2)),
        ):
            answer = self.ask("simulate", {"system": base | {"dampers": [damper]}, "t_end": 1, "samples": 2, "max_error": 1e-10})
            self.assertAlmostEqual(answer["trajectory"][name][-1], known, 9, damper)

    def test_a_ball_falls_to_its_last_speed(self):
        scene = copy.deepcopy(scenes.THROWN)
        scene["coordinates"] = coordinates(y=("m", "0", "0"))
        scene["points"][0]["components"] = [0, "y"]
        answer = self.ask("simulate", {"system": scene, "t_end": 3, "samples": 31, "max_error": 1e-9})
        last = math.sqrt(0.2 * 9.81 / 0.03)
        for t, v in zip(answer["trajectory"]["t"], answer["trajectory"]["y_dot"]):
            self.assertLess(abs(v + last * math.tanh(9.81 * t / last)), 1e-8)

    def test_drag_in_two_directions(self):
        answer = self.ask("simulate", {"system": scenes.THROWN, "t_end": 2, "samples": 21, "max_error": 1e-9})
        slope = lambda _, y: [*y[2:], *(-0.15 * math.hypot(*y[2:]) * numpy.array(y[2:]) - [0, 9.81])]  # noqa: E731
        known = solve_ivp(slope, (0, 2), [0, 0, 7, 9], rtol=1e-11, atol=1e-12, t_eval=answer["trajectory"]["t"], method="DOP853")
        for k, name in enumerate(("x", "y", "x_dot", "y_dot")):
            self.assertLess(numpy.abs(known.y[k] - answer["trajectory"][name]).max(), 1e-8)
        # work balance: what the energy loses is the work of the drag
        t = numpy.array(answer["trajectory"]["t"])
        energy = [self.ask("energy", {"system": scenes.THROWN, "initial": {n: answer["trajectory"][n][i] for n in (
            "x", "y", "x_dot", "y_dot")}})["E"] for i in (0, 20)]
        fine = solve_ivp(lambda s, y: [*slope(s, y[:4]), -0.03 * math.hypot(y[2], y[3]) ** 3], (0, 2), [0, 0, 7, 9, 0],
                         rtol=1e-11, atol=1e-12, method="DOP853")
        self.assertEqual(t[-1], 2)
        self.assertAlmostEqual(energy[1] - energy[0], fine.y[4, -1], 7)


class Forces(Service):
    def test_a_motor_between_two_links(self):
        scene = {"name": "motor", "parameters": parameters(J=("kg*m^2", "0.2"), K=("kg*m^2", "0.5"), tau=("N*m", "0.3"), w=("rad/s", "1")),
                 "coordinates": coordinates(a=("rad", "0", "0"), b=("rad", "0", "0")),
                 "bodies": [{"kind": "rigid_body", "mass": 1, "inertia": i, "centre": [0, 0], "angle": q} for i, q in ("Ja", "Kb")],
                 "forces": [{"name": "motor", "value": "tau*cos(w*t)", "along": "b - a"}]}
        answer = self.ask("simulate", {"system": scene, "t_end": 2, "samples": 11, "max_error": 1e-10})
        for t, a, b in zip(*(answer["trajectory"][n] for n in ("t", "a_dot", "b_dot"))):
            self.assertLess(abs(a + 0.3 * math.sin(t) / 0.2), 1e-9)
            self.assertLess(abs(b - 0.3 * math.sin(t) / 0.5), 1e-9)

    def test_a_force_that_follows_its_body(self):
        # Ziegler's link pushed along itself at its tip does no work on it and no torque about its foot
        scene = {"name": "follower", "parameters": parameters(m=("kg", "1"), l=("m", "1"), F=("N", "50"), k=("N*m", "4")),
                 "coordinates": coordinates(theta=("rad", "0.2", "0")),
                 "points": [{"name": "tip", "components": ["l*sin(theta)", "l*cos(theta)"]}],
                 "bodies": [{"kind": "rod", "mass": "m", "start": [0, 0], "end": "tip"}],
                 "springs": [{"stiffness": "k", "angle": "theta"}],
                 "forces": [{"vector": ["-F*sin(theta)", "-F*cos(theta)"], "point": "tip"}]}
        answer = self.ask("simulate", {"system": scene, "t_end": 2, "samples": 11, "max_error": 1e-9})
        for t, a in zip(answer["trajectory"]["t"], answer["trajectory"]["theta"]):
            self.assertLess(abs(a - 0.2 * math.cos(math.sqrt(12) * t)), 1e-8)
        self.assertEqual(answer["diagnostics"]["conserved"][0]["name"], "energy")

    def test_a_chain_of_twelve_coordinates(self):
        n = 12
        scene = {"name": "chain", "parameters": parameters(m=("kg", "1"), k=("N/m", "1"), a=("m", "0.1")),
                 "coordinates": coordinates(**{f"x{i}": ("m", f"{i}*a" if i != 1 else "3*a/2", "0") for i in range(1, n + 1)}),
                 "points": [{"name": f"P{i}", "components": [f"x{i}", 0]} for i in range(1, n + 1)],
                 "bodies": [{"kind": "particle", "mass": "m", "position": f"P{i}"} for i in range(1, n + 1)],
                 "springs": [{"stiffness": "k", "length": f"x{i + 1} - x{i}", "rest_length": "a"} for i in range(1, n)]}
        scene["springs"].append({"stiffness": "k", "length": "x1", "rest_length": "a"})
        found = self.ask("modes", {"system": scene, "equilibrium": {f"x{i}": 0.1 * i for i in range(1, n + 1)}})["modes"]
        for i, mode in enumerate(found):  # one end held, one free
            self.assertAlmostEqual(mode["omega"], 2 * math.sin((2 * i + 1) * math.pi / (4 * n + 2)), 10)
        self.assertEqual(self.ask("simulate", {"system": scene, "t_end": 5, "samples": 6})["status"], "complete")
        scene["coordinates"].append({"name": "x13", "unit": "m"})
        self.refused_at("modes", {"system": scene}, "#/system/coordinates")


class Mistakes(Service):
    def test_each_is_told_at_its_place(self):
        def spring(**fields):
            return scenes.TWO_MASSES | {"springs": [fields]}, "/springs/0"

        def damper(**fields):
            return scenes.TWO_MASSES | {"dampers": [fields]}, "/dampers/0"

        def force(**fields):
            return scenes.TWO_MASSES | {"forces": [fields]}, "/forces/0"

        for (scene, place), *pointers in (
            (spring(stiffness="k"), ""),
            (spring(stiffness="k", between=["P1"]), "/between"),
            (spring(stiffness="k", between=["P1", "P3"]), "/between/1"),
            (spring(stiffness="k", between=["P1", "P1"]), "/between"),
            (spring(stiffness="k", between=["P1", "P2"], length="x1"), "/between"),
            (spring(stiffness="k", between=["P1", "P2"], rest_angle=1), "/rest_angle"),
            (spring(stiffness="k", angle="x1/l0"), "/stiffness"),
            (spring(stiffness="k", angle="x1/l0", rest_length="l0"), "/angle"),
            (damper(coefficient="k", length="x1"), "/coefficient"),
            (damper(coefficient="c", law="quadratic", length="x1"), "/coefficient"),
            (damper(coefficient="c", law="cubic", length="x1"), "/law"),
            (damper(coefficient="c"), ""),
            (damper(coefficient="c", length="x1_dot"), "/length"),
            (force(vector=["k*x1", 0]), ""),
            (force(value="k*x1"), ""),
            (force(along="x1"), ""),
            (force(value="m1", along="x1"), "/value"),
            (force(value="k*x1", along="x1", point="P1"), "/along", "/value"),
            (force(torque=[0, 0, 1], body="P1"), "/body", "/torque"),
            (force(torque=[0, 1]), ""),
        ):
            self.refused_at("energy", {"system": scene}, *("#/system" + place + p for p in pointers))


if __name__ == "__main__":
    unittest.main()
