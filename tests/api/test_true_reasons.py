"""Reasons that answers give are true."""

import math
import pathlib
import re
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402


def parameter(name, unit, default):
    return {"name": name, "unit": unit, "default": default}


def charge(forces):
    return {"name": "charge", "parameters": [parameter("m", "kg", "1"), parameter("B", "N*s/m", "2")],
            "coordinates": [{"name": "x", "unit": "m"}, {"name": "y", "unit": "m", "initial_rate": "1"}],
            "bodies": [{"kind": "particle", "mass": "m", "position": ["x", "y"]}],
            "forces": [{"vector": forces, "point": ["x", "y"]}]}


def chain(n, coupled=""):
    q = [f"q{i}" for i in range(n)]
    kinetic = "+".join(f"m*{name}_dot^2/2" for name in q)
    springs = "-".join(f"k*({a}-{b})^2/2" for a, b in zip(q, q[1:]))
    return {"name": "chain", "units": "none", "lagrangian": f"{kinetic}-{springs}{coupled}",
            "parameters": [{"name": "m", "default": "1"}, {"name": "k", "default": "1"}],
            "coordinates": [{"name": name} for name in q]}


def free_particle(place, speed, force):
    return {"name": "free", "units": "none", "lagrangian": "x_dot^2/2", "forces": [force],
            "coordinates": [{"name": "x", "initial": place, "initial_rate": speed}]}


def on_curve(curve, x, y):
    return {"name": "curve", "units": "none", "lagrangian": "m/2*(x_dot^2 + y_dot^2) - m*g*y",
            "parameters": [{"name": "m", "default": "1"}, {"name": "g", "default": "9.81"}],
            "coordinates": [{"name": "x", "initial": x}, {"name": "y", "initial": y}],
            "constraints": [{"name": "w", "expression": curve}]}


class TrueReasons(Service):
    def test_factors_that_no_answer_needs_refuse_none(self):
        """A full mass matrix: whether its entries divide an equation takes numbers of thousands of digits to find out."""
        for b, a, d in (("2/5", "9/10", "1/4"), ("2", "9", "4")):
            u, v, w = f"-a + {b}*b + p*d", f"{a}*a + b + {d}*d", "-2*a - 1/2*b + d"
            dot = ["(" + re.sub("([abd])", r"\1_dot", form) + ")" for form in (u, v, w)]
            full = {"name": "full", "units": "none", "coordinates": [{"name": q, "initial": "0.1"} for q in "abd"],
                    "parameters": [{"name": n, "default": x} for n, x in (("m", "1.3"), ("M", "2.1"), ("k", "0.8"), ("c", "0.6"), ("p", "1.7"))],
                    "lagrangian": f"m*({dot[0]}^2 + {dot[1]}^2)/2 + M*{dot[2]}^2/2 - k*cos(({u})^2 + ({v})^2) - c*({w})^3"}
            with self.subTest(a=a):
                run = self.ask("simulate", {"system": full, "t_end": 1})
                self.assertLess(run["diagnostics"]["conserved"][0]["max_rel_drift"], 1e-9)
                self.ask("energy", {"system": full})
                self.ask("modes", {"system": full})

    def test_a_coordinate_that_is_nowhere_is_named(self):
        """Beside terms that are kept as they are written, too."""
        for potential in ("a^2", "cos((p*a + p*b)^2 + 25/16*b^2)"):
            idle = {"name": "idle", "units": "none", "coordinates": [{"name": q, "initial": "0.1"} for q in "abd"],
                    "parameters": [{"name": "p", "default": "1.7"}], "lagrangian": f"(a_dot^2 + b_dot^2)/2 - {potential}"}
            (error,) = self.refused("simulate", {"system": idle, "t_end": 1})["errors"]
            self.assertEqual((error["pointer"], error["code"]), ("#/system/coordinates/2", "no_inertia"))

    def test_where_nothing_obeys_a_constraint_no_forces_are_spoken_of_alone(self):
        found = self.ask("equilibria", {"system": on_curve("x^2 + y^2 + 1", "1", "0")})
        self.assertEqual((found["equilibria"], found["complete"]), ([], True))
        self.assertIn("there is no place where the constraints hold", found["reason"])

    def test_two_coordinates_that_move_a_mass_in_the_same_way(self):
        slider = {"name": "slider", "units": "none", "coordinates": [{"name": "x"}, {"name": "th"}],
                  "lagrangian": "(x_dot^2 + 2*x_dot*th_dot*cos(th) + th_dot^2)/2 + 9.81*cos(th) - 3*x^2/2"}
        self.assertIn("some motion of the coordinates moves no mass", self.refused("modes", {"system": slider})["detail"])

    def test_modes_are_about_the_stable_place_downhill_on_a_curve_that_starts_upright(self):
        for curve, x, y, lowest in (("x^2 + y^2 - 1", "1", "0", -1), ("x^2 + y^2 - 1", "-1", "0", -1),
                                    ("x^2 + y^2 - 1e-6", "1e-3", "0", -1e-3), ("x^2/4 + y^2/9 - 1", "2", "0", -3)):
            with self.subTest(curve=curve, x=x):
                found = self.ask("modes", {"system": on_curve(curve, x, y)})
                place = found["equilibrium"]
                self.assertEqual(place["stability"], "stable")
                self.assertAlmostEqual(place["state"]["y"], lowest, delta=1e-12)

    def test_modes_are_about_the_stable_place_downhill_though_an_unstable_one_is_nearer(self):
        for curve, x, y, lowest in (("x^2 + y^2 - 1", "0.6", "0.8", -1), ("x^2/4 + y^2 - 1", "1.2", "0.8", -1),
                                    ("(y - x^2)*(1 + x^2) - x^4/10", "0.1", "0.01", 0)):
            with self.subTest(curve=curve, x=x):
                place = self.ask("modes", {"system": on_curve(curve, x, y)})["equilibrium"]
                self.assertEqual(place["stability"], "stable")
                self.assertAlmostEqual(place["state"]["y"], lowest, delta=1e-12)
        hinged = {"name": "rod", "units": "none", "bodies": [{"kind": "rigid_body", "mass": "1", "centre": ["x", "y"],
                                                              "inertia": "1/3", "angle": "th"}],
                  "gravity": ["0", "-9.81"],
                  "coordinates": [{"name": "x", "initial": "0.1"}, {"name": "y", "initial": "0.99"},
                                  {"name": "th", "initial": "0.1"}],
                  "constraints": [{"name": "a", "expression": "x - sin(th)"}, {"name": "b", "expression": "y - cos(th)"}]}
        answer = self.ask("modes", {"system": hinged})
        self.assertEqual(answer["equilibrium"]["stability"], "stable")
        self.assertAlmostEqual(answer["equilibrium"]["state"]["y"], -1, delta=1e-12)
        self.assertAlmostEqual(answer["modes"][0]["omega"]**2, 9.81*3/4, delta=1e-12)

    def test_where_no_force_acts_along_the_surface_nothing_goes_downhill(self):
        top = self.ask("modes", {"system": on_curve("x^2 + y^2 - 1", "0", "1")})["equilibrium"]
        self.assertEqual((top["state"]["y"], top["stability"]), (1, "unstable"))

    def test_a_place_that_valid_while_forbids_is_not_gone_down_to(self):
        pushed = on_curve("x^2 + y^2 - 1", "0.6", "0.8") | {
            "valid_while": [{"name": "above", "expression": "y + 0.5", "reason": "below", "message": "It is below."}]}
        self.assertEqual(self.ask("modes", {"system": pushed})["equilibrium"]["state"]["y"], 1)

    def test_modes_at_a_cone_of_the_potential_speak_of_it(self):
        frame = {"name": "Varignon", "units": "none", "coordinates": [{"name": "x", "initial": "0.3"}, {"name": "y", "initial": "0.3"}],
                 "lagrangian": "(x_dot^2 + y_dot^2)/2 - 2*sqrt(x^2 + y^2) - sqrt((x - 1)^2 + y^2) - sqrt(x^2 + (y - 1)^2)"}
        for place in ({}, {"equilibrium": {"x": 0, "y": 0}}):
            detail = self.refused("modes", {"system": frame} | place)["detail"]
            self.assertIn("At x = 0, y = 0 a distance in the forces is 0", detail)
            self.assertIn("the system rests there", detail)
        line = {"name": "line", "units": "none", "coordinates": [{"name": "x", "initial": "0.3"}],
                "lagrangian": "x_dot^2/2 - 2*sqrt((x - 1)^2)"}
        self.assertIn("An abs() or a sign() in the forces has kinks", self.refused("modes", {"system": line})["detail"])

    def test_modes_where_constraints_depend_on_each_other_speak_of_those(self):
        touching = {"name": "touching", "units": "none", "coordinates": [{"name": "x", "initial": "1"}, {"name": "y"}, {"name": "z"}],
                    "bodies": [{"kind": "particle", "mass": "1", "position": ["x", "y", "z"]}], "gravity": ["0", "0", "-9.81"],
                    "constraints": [{"name": "a", "expression": "x^2 + y^2 - 1"}, {"name": "b", "expression": "x - 1"}]}
        for endpoint in ("modes", "energy"):
            self.assertIn("the constraints 'a', 'b' depend on each other", self.refused(endpoint, {"system": touching})["errors"][0]["detail"])

    def test_a_constraint_alone_depends_on_no_other(self):
        for constraint, reason in (("sin(x)^2 + cos(x)^2 - 1", "'w' says nothing of the velocities"),
                                   ("x^2", "the constraint 'w' has no slope")):
            answer = self.refused("energy", {"system": on_curve(constraint, "0", "0")})
            self.assertIn(reason, answer["errors"][0]["detail"])

    def test_a_momentum_is_constant_where_no_constraint_acts_along_it_either(self):
        system = {"name": "rolling", "units": "none", "lagrangian": "(x_dot^2 + y_dot^2 + z_dot^2)/2",
                  "coordinates": [{"name": name, "initial": "1"} for name in "xyz"],
                  "constraints": [{"name": "w", "expression": "z_dot - y*x_dot"}]}
        whys = {one["name"]: one["why"] for one in self.ask("equations", {"system": system})["conserved"]}
        self.assertIn("and no force beside it acts along y, so its momentum is constant", whys["p_y"])
        self.assertFalse({"p_x", "p_z"} & set(whys), whys)

    def test_a_force_across_the_velocity_does_no_work(self):
        answer = self.ask("equations", {"system": charge(["B*y_dot", "-B*x_dot"])})
        self.assertNotIn("energy_not_conserved", answer.get("reasons", {}))
        energy = [entry for entry in answer["conserved"] if entry["name"] == "energy"]
        self.assertEqual(len(energy), 1)
        self.assertIn("do no work", energy[0]["why"])
        drag = self.ask("equations", {"system": charge(["B*y_dot-B*x_dot", "-B*x_dot"])})
        self.assertEqual(drag["reasons"]["energy_not_conserved"], "Forces outside the Lagrangian do work.")

    def test_a_lagrangian_alone_keeps_h(self):
        answer = self.ask("equations", {"system": chain(2)})
        self.assertIn("constant is h", answer["reasons"]["energy_not_conserved"])

    def test_nothing_is_said_of_equilibria_that_are_not_there(self):
        slope = {"name": "slope", "gravity": ["0", "-g"],
                 "parameters": [parameter("m", "kg", "1"), parameter("al", "rad", "0.2"), parameter("g", "m/s^2", "9.81")],
                 "coordinates": [{"name": "s", "unit": "m"}],
                 "bodies": [{"kind": "particle", "mass": "m", "position": ["s*cos(al)", "-s*sin(al)"]}]}
        answer = self.ask("equilibria", {"system": slope})
        self.assertEqual(answer["equilibria"], [])
        self.assertNotIn("given are", answer["free_reason"])

    def test_the_hamiltonian_of_many_separate_masses_is_written(self):
        for n in (4, 6, 12):
            text = self.ask("equations", {"system": chain(n)})["hamiltonian"]
            self.assertEqual(text.count("/(2*m)"), n, text)
        coupled = self.ask("equations", {"system": chain(4, "+q0_dot*q2_dot/2")})["hamiltonian"]
        at = {"m": 1, "k": 2, **{f"q{i}": x for i, x in enumerate((1, 3, 4, 8))},
              **{f"p_q{i}": p for i, p in enumerate((3, 1, 5, 2))}}
        # p0^2 - p0 p2 + p2^2 over 2 (1 - 1/4), the others alone, and springs stretched by 2, 1 and 4
        self.assertAlmostEqual(eval(coupled.replace("^", "**"), {}, at), 19 / 1.5 + 0.5 + 2 + 21)
        together = "".join(f"+q{i}_dot*q{i + 1}_dot/8" for i in range(4))
        self.assertIsNone(self.ask("equations", {"system": chain(5, together)})["hamiltonian"])

    def test_with_constraints_the_constraints_belong_to_what_is_to_be_solved(self):
        places = [(f"x{i}", f"y{i}") for i in range(3)]
        before = [("0", "0"), *places]
        scene = {"name": "bobs", "units": "none", "parameters": [{"name": "g", "default": "1"}],
                 "coordinates": [{"name": name, "initial": str(i + 1) if name[0] == "x" else "0"}
                                 for i, pair in enumerate(places) for name in pair],
                 "lagrangian": "+".join(f"({x}_dot^2+{y}_dot^2)/2-g*{y}" for x, y in places),
                 "constraints": [{"name": f"c{i}", "expression": f"({x}-({a}))^2+({y}-({b}))^2-1"}
                                 for i, ((x, y), (a, b)) in enumerate(zip(places, before))]}
        answer = self.ask("equations", {"system": scene})
        for name in ("accelerations", "hamiltonian"):
            if answer[name] is None:
                self.assertIn("with the constraints", answer["reasons"][name])

    def test_beside_a_narrow_pulse_nothing_grows(self):
        pulse = {"name": "f", "value": "47620000000000*(1/cosh((t - 1.146)/0.000000000000021))", "along": "x"}
        problem = self.refused("simulate", {"system": free_particle("0.1", "0.276", pulse), "t_end": 3.392,
                                            "samples": 2, "max_error": 1e-8})
        self.assertEqual(problem["reason"], "step-limit")
        pole = self.refused("simulate", {"system": free_particle("1", "0", {"name": "f", "value": "x^3", "along": "x"}),
                                         "t_end": 9, "samples": 2})
        self.assertEqual(pole["reason"], "blow-up")

    def test_a_puck_on_a_rough_table_comes_to_rest(self):
        speed = "sqrt(x_dot^2 + y_dot^2)"
        for v, w, k in ((1, 0.5, 0), (2, 0.5, 0), (0.3, -0.4, 0), (1, 0.5, 1)):
            puck = {"name": "puck", "units": "none", "lagrangian": f"(x_dot^2 + y_dot^2)/2 - {k}*(x^2 + y^2)/2",
                    "coordinates": [{"name": "x", "initial": "0.3", "initial_rate": str(v)},
                                    {"name": "y", "initial_rate": str(w)}],
                    "forces": [{"value": f"-3*{q}_dot/{speed}", "along": q} for q in "xy"]}
            problem = self.refused("simulate", {"system": puck, "t_end": 2})
            self.assertEqual(problem["reason"], "undetermined")
            self.assertIn("x_dot^2 + y_dot^2 comes to 0", problem["detail"])
            self.assertIn("comes to rest", problem["detail"])
            if k == 0:
                self.assertAlmostEqual(problem["t_reached"], math.hypot(v, w) / 3, delta=1e-9)

    def test_too_many_kinks_are_told_early(self):
        """A mass that goes to and fro over a kink ten million times a second."""
        kink = {"name": "f", "value": "-2*sign(x - 0.7000000000000013)", "along": "x"}
        problem = self.refused("simulate", {"system": free_particle("0.7", "0", kink), "t_end": 1, "samples": 3})
        self.assertEqual(problem["reason"], "step-limit")
        slower = {**kink, "value": "-2*sign(x - 0.700001)"}  # sqrt(2e-6 m/a) = 1 ms for a quarter
        answer = self.ask("simulate", {"system": free_particle("0.7", "0", slower), "t_end": 1, "samples": 3})
        self.assertEqual(answer["status"], "complete")

    def test_where_nothing_can_rest_no_other_guess_is_asked_for(self):
        for system in ("bouncing_ball", "wedge_and_block", "atwood_machine"):
            self.assertIn("is the same everywhere", self.refused("modes", {"system": system})["detail"])
        balanced = self.ask("modes", {"system": "atwood_machine", "parameters": {"m1": 2, "m2": 2}})
        self.assertEqual(balanced["modes"][0]["kind"], "rigid")


if __name__ == "__main__":
    unittest.main()
