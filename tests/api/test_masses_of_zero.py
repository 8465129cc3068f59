"""What answers say of small and negative masses, and of poles of positions."""

import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import DOWN, G, lagrangian, particle, scene  # noqa: E402

PENDULUM = scene("pendulum", f"m kg 1; l m 0.5; {G}", "th rad 0.1", gravity=DOWN, bodies=[particle("m", "l*sin(th)", "-l*cos(th)")])
POLE = PENDULUM | {"bodies": [particle("m", "l*tan(th)", "0")]}

FALL = lagrangian("fall", "m - 1; g - 9.81", "x - 0.5", "m*x_dot^2/2 - m*g*x^2")
SPRING = lagrangian("spring", "m - 1; k - 3", "x - 0.5", "m*x_dot^2/2 - k*x^2/2")
PAIR = lagrangian("pair", "m - 1; M - 3; k - 3", "x - 0.5; y - 0.1", "m*x_dot^2/2 + M*(x_dot + y_dot)^2/2 - k*(x^2 + y^2)/2")
OF_ACCELERATIONS = {"energy": {}, "simulate": {"t_end": 1}, "modes": {}, "accuracy": {"t_end": 1},
                    "turning_points": {"coordinate": "x", "t_end": 1}}


class MassesOfZero(Service):
    def test_every_endpoint_says_that_a_limit_moves_a_coordinate(self):
        for endpoint, more in (OF_ACCELERATIONS | {"equilibria": {}}).items():
            with self.subTest(endpoint=endpoint):
                answer = self.ask(endpoint, {"system": FALL, "parameters": {"m": 0}} | more)
                self.assertIn("the equation of x vanishes. Its limit stands for it", answer["notes"][0])
        lost = lagrangian("lost", "m - 1; M - 3", "x - 0.5", "(m + M - 4)*(x_dot^2/2 - x^2)")
        self.assertIn("notes", self.ask("energy", {"system": lost}))
        self.assertNotIn("notes", self.ask("energy", {"system": lost, "parameters": {"m": 2}}))

    def test_a_motion_that_a_limit_moves_has_no_energy_and_is_followed(self):
        at = {"system": FALL, "parameters": {"m": 0}}
        missing = self.refused("turning_points", at)["errors"][0]
        self.assertEqual(missing["pointer"], "#/t_end")
        self.assertIn("the energy of the coordinate vanishes with its equation", missing["detail"])
        followed = self.ask("turning_points", at | {"t_end": 1})
        self.assertAlmostEqual(followed["x_min"], -0.5, delta=1e-9)

    def test_every_endpoint_names_the_parameter_that_leaves_no_accelerations(self):
        for system, why in ((SPRING, "With m = 0 nothing that has mass moves with 'x'"),
                            (PAIR, "With m = 0 some motion of the coordinates moves no mass")):
            for endpoint, more in OF_ACCELERATIONS.items():
                with self.subTest(endpoint=endpoint, system=system["name"]):
                    refused = self.refused(endpoint, {"system": system, "parameters": {"m": 0}} | more)["errors"][0]
                    self.assertEqual(refused["pointer"], "#/parameters")
                    self.assertIn(why, refused["detail"])

    def test_what_a_parameter_that_moves_leaves_zero_is_told_of_critical_values(self):
        well = lagrangian("well", "m - 1; k - 1", "x - 0.6", "m*x_dot^2/2 - (x^4/4 - k*x^2/2)")
        moved = {"from": -1, "to": 2}
        refused = self.refused("bifurcations", {"system": well, "parameters": {"m": 0}, "parameter": "k"} | moved)["errors"][0]
        self.assertIn("With m = 0 nothing that has mass moves with 'x'", refused["detail"])
        self.ask("bifurcations", {"system": well, "parameters": {"m": 0}, "parameter": "m"} | moved)
        limit = lagrangian("limit", "m - 1; k - 1", "x - 0.6", "m*x_dot^2/2 - m*(x^4/4 - k*x^2/2)")
        answer = self.ask("bifurcations", {"system": limit, "parameters": {"m": 0}, "parameter": "k"} | moved)
        self.assertIn("the equation of x vanishes. Its limit stands for it", answer["notes"][0])
        self.assertNotIn("notes", self.ask("bifurcations", {"system": limit, "parameters": {"m": 0}, "parameter": "m"} | moved))
        inverse = lagrangian("inverse", "m - 1; k - 4", "x - 0.6", "x_dot^2/2/m - k*x^2/2")
        refused = self.refused("bifurcations", {"system": inverse, "parameters": {"m": 0}, "parameter": "k"} | moved)["errors"][0]
        self.assertIn("no finite value of L in any state", refused["detail"])
        self.ask("bifurcations", {"system": inverse, "parameters": {"m": 0}, "parameter": "m"} | moved)

    def test_a_limit_without_mass_tells_no_more_than_where_forces_vanish(self):
        lost = lagrangian("lost", "m - 0", "x - 0.6", "m^2*x_dot^2/2 - m*2*sin(x)")
        answer = self.ask("equilibria", {"system": lost})
        self.assertIn("tells where forces vanish, but no acceleration follows from it", answer["notes"][0])
        self.assertIn("The mass matrix has no inverse here", answer["equilibria"][0]["nonlinear"])

    def test_two_that_are_zero_are_named_together(self):
        refused = self.refused("energy", {"system": lagrangian("two", "m - 0; M - 0", "x - 0.5", "(m + M)*x_dot^2/2 - (m + 1)*x^2")})["errors"][0]
        self.assertIn("With m = 0 and M = 0 nothing that has mass", refused["detail"])

    def test_a_lagrangian_that_has_no_value_in_any_state_has_no_answers(self):
        for text in ("x_dot^2/2/m + y_dot^2/2 - k*(x^2 + y^2)/2", "x_dot^2/2 + y_dot^2/2 + m*log(m)*x - k*(x^2 + y^2)/2"):
            inverse = lagrangian("inverse", "m - 1; k - 4", "x - 0.6; y - 0.1", text)
            for endpoint, more in (OF_ACCELERATIONS | {"equilibria": {}}).items():
                with self.subTest(text, endpoint=endpoint):
                    refused = self.refused(endpoint, {"system": inverse, "parameters": {"m": 0}} | more)["errors"][0]
                    self.assertIn("m", refused["detail"].partition("in any state: ")[2])
                    self.ask(endpoint, {"system": inverse} | more)

    def test_a_constraint_may_hold_what_has_no_mass(self):
        tied = PAIR | {"lagrangian": "m*x_dot^2/2 + M*y_dot^2/2 - k*y^2/2",
                       "constraints": [{"name": "w", "expression": "x - y"}]}
        for k in (3, 0):
            self.ask("energy", {"system": tied, "parameters": {"m": 0, "k": k}, "initial": {"x": 0.1}})

    def test_a_default_outside_its_own_domain_is_found_in_the_scene(self):
        mass = PENDULUM["parameters"][0] | {"default": "-1", "domain": "> 0"}
        wrong = PENDULUM | {"parameters": [mass] + PENDULUM["parameters"][1:]}
        refused = self.refused("energy", {"system": wrong})["errors"][0]
        self.assertEqual(refused["pointer"], "#/system/parameters/0/default")
        self.ask("energy", {"system": wrong, "parameters": {"m": 2}})
        follower = FALL["parameters"][1] | {"default": "m - 0.5", "domain": "> 0"}
        follows = FALL | {"parameters": [FALL["parameters"][0], follower]}
        refused = self.refused("energy", {"system": follows, "parameters": {"m": 0.25}})["errors"][0]
        self.assertEqual(refused["pointer"], "#/parameters")

    def test_the_limit_of_a_vanishing_mass_is_called_one(self):
        answer = self.ask("modes", {"system": PENDULUM, "parameters": {"m": 0}})
        self.assertIn("the equation of th vanishes", answer["notes"][0])
        self.assertNotIn("notes", self.ask("modes", {"system": PENDULUM}))

    def test_a_negative_mass_swings_as_a_positive_one(self):
        found = [self.ask("equilibria", {"system": PENDULUM, "parameters": {"m": m}})["equilibria"] for m in (1, -1)]
        for heavy, light in zip(*found):
            self.assertEqual(heavy["stability"], light["stability"])

    def test_one_eigenvalue_does_not_coincide_with_others(self):
        refused = self.refused("modes", {"system": PENDULUM, "parameters": {"m": 1e-300}})
        self.assertNotIn("coincide", refused["detail"])

    def test_a_state_at_a_pole_has_no_energy(self):
        self.refused("energy", {"system": POLE, "initial": {"th": "pi/2", "th_dot": 1}})
        near = self.ask("energy", {"system": POLE, "initial": {"th": "pi/2 - 1e-3", "th_dot": 1}})
        self.assertLess(near["error"]["T"], 1e-9 * near["T"])

    def test_nothing_rests_at_a_pole(self):
        for th in ("pi/2", "-90deg"):
            at = {"system": POLE, "initial": {"th": th}}
            for endpoint, more in (("simulate", {"t_end": 1}), ("turning_points", {})):
                problem = self.refused(endpoint, at | more)
                self.assertIn("there is no finite value of", problem["errors"][0]["detail"])
        near = {"system": POLE, "initial": {"th": "pi/2 - 1e-3"}}
        self.assertEqual(self.ask("simulate", near | {"t_end": 1e-9})["status"], "complete")

    def test_a_sleeping_top_by_angles_that_fail_there(self):
        refused = self.refused("modes", {"system": "symmetric_top", "initial": {"theta": 0, "phi_dot": 0}})
        self.assertIn("At theta = 0 the forces have no value", refused["detail"])


if __name__ == "__main__":
    unittest.main()
