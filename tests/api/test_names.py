"""A scene calls its own as it likes: what an answer calls so besides gets another name, or the request is refused."""

import math
import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402


def without_units(lagrangian, coordinates, parameters="", **more):
    pairs = [text.split() for text in parameters.split(";") if text.strip()]
    places = [text.split() for text in coordinates.split(";")]
    return {"name": "scene", "units": "none", "lagrangian": lagrangian,
            "parameters": [{"name": name, "default": value} for name, value in pairs],
            "coordinates": [{"name": name, "initial": at, "initial_rate": rate} for name, at, rate in places], **more}


def parameter(name, unit, default):
    return {"name": name, "unit": unit, "default": default}


def pendulum(multiplier, **more):
    """A bob on a string, by its places: it hangs still at the side, where the tension is 0.8 m g."""
    return {"name": "bob", "gravity": ["0", "-g"],
            "parameters": [parameter("m", "kg", "1"), parameter("l", "m", "1"), parameter("g", "m/s^2", "9.81")],
            "coordinates": [{"name": "x", "unit": "m", "initial": "0.6"}, {"name": "y", "unit": "m", "initial": "-0.8"}],
            "bodies": [{"kind": "particle", "mass": "m", "position": ["x", "y"]}],
            "constraints": [{"name": "string", "expression": "l-sqrt(x^2+y^2)", "multiplier": multiplier}], **more}


def condition(name, expression="m*g", unit="N"):
    return {"name": name, "unit": unit, "expression": expression, "reason": "ends", "message": "It ends."}


SIDE = 0.8 * 9.81  # the tension at the start


class Names(Service):
    def motion(self, scene, include, **more):
        return self.ask("simulate", {"system": scene, "t_end": 1, "samples": 3, "include": include, **more})

    def first(self, scene, *include):
        return {name: column[0] for name, column in self.motion(scene, list(include))["trajectory"].items()}

    def test_a_coordinate_h_stays_beside_the_energy(self):
        scene = without_units("(h_dot^2+x_dot^2)/2-k*(h-x)^2/2-h^4", "h 1 0.2; x 0.3 0", "k 1")
        answer = self.motion(scene, ["energy", "momenta"])
        self.assertEqual(answer["trajectory"]["h"][0], 1)
        self.assertAlmostEqual(answer["trajectory"]["h"][1], 0.596993, 5)
        self.assertAlmostEqual(answer["trajectory"]["jacobi_integral"][2], 0.02 + 0.245 + 1)
        self.assertEqual(set(answer["units"]), set(answer["trajectory"]))
        self.assertIn("jacobi_integral", answer["notes"][-1])
        request = {"system": scene, "t_end": 1, "samples": 3, "include": ["energy", "momenta"], "format": "csv"}
        header = self.post("simulate", request).data.decode().splitlines()[0].split(",")
        self.assertEqual(len(header), len(set(header)))

    def test_a_coordinate_keeps_its_name_before_any_quantity(self):
        for name in ("energy", "T", "V", "p_x", "bob_x", "kinetic_energy"):
            with self.subTest(name=name):
                scene = {"name": "two", "coordinates": [{"name": name, "unit": "m", "initial": "3"},
                                                        {"name": "x", "unit": "m", "initial": "0.3"}],
                         "parameters": [parameter("m", "kg", "1")], "points": [{"name": "bob", "components": ["x", "0"]}],
                         "bodies": [{"kind": "particle", "mass": "m", "position": "bob"},
                                    {"kind": "particle", "mass": "m", "position": ["0", name]}]}
                row = self.first(scene, "energy", "T", "V", "momenta", "positions")
                self.assertEqual(row[name], 3)
                self.assertEqual(len(row), 1 + 4 + 3 + 2 + 2)

    def test_a_point_and_a_momentum_of_one_name_are_two_columns(self):
        scene = {"name": "p", "coordinates": [{"name": "x", "unit": "m", "initial": "0.3", "initial_rate": "2"}],
                 "parameters": [parameter("m", "kg", "5")], "points": [{"name": "p", "components": ["x", "0"]}],
                 "bodies": [{"kind": "particle", "mass": "m", "position": "p"}]}
        for include in (["momenta", "positions"], ["positions", "momenta"]):
            row = self.first(scene, *include)
            self.assertEqual((row["p_x"], row["momentum_x"]), (0.3, 10))

    def test_a_tension_called_as_an_energy_is_the_tension(self):
        for name, include in (("T", "T"), ("V", "V"), ("energy", "energy"), ("p_x", "momenta")):
            with self.subTest(name=name):
                row = self.first(pendulum(name), "multipliers", include)
                self.assertAlmostEqual(row[name], SIDE, 6)

    def test_names_do_not_depend_on_what_else_is_asked_for(self):
        scene = pendulum("T")
        self.assertIn("kinetic_energy", self.first(scene, "T"))
        self.assertNotIn("T", self.first(scene, "T"))

    def test_a_condition_or_report_is_told_apart_from_an_energy(self):
        weight = {"name": "T", "unit": "N", "expression": "m*g"}
        for more in ({"reports": [weight]}, {"valid_while": [condition("T")]}):
            row = self.first(pendulum("N", **more), "T", "validity")
            self.assertAlmostEqual(row["T"], 9.81)
            self.assertEqual(row["kinetic_energy"], 0)

    def test_a_condition_called_as_a_coordinate_gets_a_longer_name(self):
        row = self.first(pendulum("N", valid_while=[condition("x")]), "validity", "multipliers")
        self.assertAlmostEqual(row["x"], 0.6)
        self.assertAlmostEqual(row["condition_x"], 9.81)
        row = self.first(pendulum("N", valid_while=[condition("N", "N")]), "validity", "multipliers")
        self.assertAlmostEqual(row["N"], SIDE)
        self.assertAlmostEqual(row["condition_N"], SIDE)

    def test_two_conditions_of_one_name_are_refused(self):
        for more, place in (({"valid_while": [condition("a"), condition("a")]}, "/valid_while/1/name"),
                            ({"valid_while": [condition("a")], "reports": [{"name": "a", "unit": "N", "expression": "m*g"}]},
                             "/reports/0/name")):
            problem = self.refused("simulate", {"system": pendulum("N", **more), "t_end": 1})
            self.assertEqual([(e["code"], e["pointer"]) for e in problem["errors"]],
                             [("duplicate_name", "#/system" + place)])

    def test_the_energies_at_a_state_keep_their_errors(self):
        answer = self.ask("energy", {"system": pendulum("T", valid_while=[condition("V")])})
        self.assertEqual(answer["T"], 0)
        self.assertAlmostEqual(answer["multipliers"]["T"], SIDE)
        for name, unit in (("T", "J"), ("multipliers/T", "kg*m/s^2"), ("V", "J"), ("validity/V", "N")):
            self.assertIn(name, answer["error"])
            self.assertEqual(answer["units"][name], unit)

    def test_an_equation_tells_a_parameter_from_the_energy(self):
        scene = {"name": "spring", "parameters": [parameter("m", "kg", "1"), parameter("E", "N/m", "0.5")],
                 "coordinates": [{"name": "x", "unit": "m", "initial": "1"}], "potential": "E*x^2/2",
                 "bodies": [{"kind": "particle", "mass": "m", "position": ["x", "0"]}]}
        answer = self.ask("turning_points", {"system": scene})
        self.assertEqual(answer["equation"]["text"], "1/2*E*x^2 = energy")
        self.assertEqual(answer["constants"], {"energy": 0.25})
        answer = self.ask("turning_points", {"system": without_units("m*x_dot^2/2-h*x^2/2", "x 1 0.7", "m 1; h 0.5")})
        self.assertEqual(answer["equation"]["text"], "1/2*h*x^2 = jacobi_integral")
        self.assertAlmostEqual(answer["constants"]["jacobi_integral"], 0.495)
        self.assertTrue(all("h" not in key or key == "jacobi_integral" for key in answer["exact"] if key != "equation"))
        assumed = answer["exact"]["jacobi_integral"]["assumes"]
        self.assertEqual(len(assumed), len(set(assumed)))

    def test_momenta_have_one_name_in_all_formulas(self):
        scene = without_units("m*(r_dot^2+r^2*ph_dot^2)/2-p_ph*r^2/2", "r 1 0; ph 0 2", "m 1; p_ph 3")
        answer = self.ask("turning_points", {"system": scene, "coordinate": "r"})
        self.assertEqual(answer["constants"]["momentum_ph"], 2)
        self.assertIn("momentum_ph", answer["equation"]["text"])
        found = self.ask("equations", {"system": scene})
        self.assertEqual(set(found["momenta"]), {"p_r", "momentum_ph"})
        self.assertIn("momentum_ph", found["hamiltonian"])

    def test_what_is_solved_for_has_a_field_of_its_own(self):
        def rod(name):
            return {"name": "rod", "parameters": [parameter(name, "N*m/rad", "5"), parameter("m", "kg", "1"),
                                                  parameter("l", "m", "1"), parameter("g", "m/s^2", "9.81")],
                    "coordinates": [{"name": "th", "unit": "rad"}], "gravity": ["0", "-g"],
                    "bodies": [{"kind": "particle", "mass": "m", "position": ["l*sin(th)", "l*cos(th)"]}],
                    "springs": [{"stiffness": name, "angle": "th"}]}

        request = {"system": rod("c"), "solve_for": "c", "at": {"th": 0.3}}
        answer = self.ask("equilibria", request)
        self.assertAlmostEqual(answer["c"], 9.81 * math.sin(0.3) / 0.3)
        for name in set(answer) - {"c"}:
            self.assertEqual(self.refused("equilibria", {**request, "system": rod(name), "solve_for": name})["errors"][0]
                             ["pointer"], "#/solve_for")
        for name in ("id", "stability"):
            self.refused("bifurcations", {"system": rod(name), "parameter": name, "from": 1, "to": 20})

    def test_a_formula_of_an_ambiguous_name_is_not_graded(self):
        def item(multiplier, of):
            expect = {"expression": {"system": pendulum(multiplier)}, "of": of}
            return {"items": [{"id": "a", "expect": expect, "submitted": "m/2*(x_dot^2+y_dot^2)"}]}

        for name in ("T", "V", "p_x"):
            self.refused_at("check", item(name, name), "#/items/0/expect/of")
        self.assertTrue(self.ask("check", item("N", "T"))["items"][0]["correct"])
        self.assertFalse(self.ask("check", item("N", "N"))["items"][0]["correct"])


if __name__ == "__main__":
    unittest.main()
