"""A parameter that is written as an expression of another one follows it wherever that moves."""

import math
import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

DEFAULTS = {"m": "1", "l": "0.5", "k": "30", "c": "k*l^2/2", "g": "9.81"}
UNITS = {"m": "kg", "l": "m", "k": "N/m", "c": "N*m", "g": "m/s^2", "K": "N/m"}


def inverted(**defaults):
    """A pendulum on its head, held by a torsion spring c."""
    values = {**DEFAULTS, **defaults}
    return {"name": "inverted", "gravity": ["0", "-g"],
            "parameters": [{"name": name, "unit": UNITS[name], "default": value} for name, value in values.items()],
            "coordinates": [{"name": "th", "unit": "rad"}],
            "bodies": [{"kind": "particle", "mass": "m", "position": ["l*sin(th)", "l*cos(th)"]}],
            "springs": [{"stiffness": "c", "angle": "th"}]}


CRITICAL = 2 * 9.81 / 0.5


class TiedParameters(Service):
    def bifurcations(self, scene, **more):
        return self.ask("bifurcations", {"system": scene, "parameter": "k", "from": 10, "to": 100, **more})

    def test_a_default_follows_the_parameter_that_moves(self):
        for scene in (inverted(), inverted(c="K*l^2", K="k/2")):
            answer = self.bifurcations(scene)
            self.assertEqual([critical["kind"] for critical in answer["critical"]], ["pitchfork"])
            self.assertLessEqual(abs(answer["critical"][0]["value"] - CRITICAL), answer["critical"][0]["error"] + 1e-13)
            self.assertEqual(answer["critical"][0]["exact"]["text"], "2*m*g/l")

    def test_what_a_request_writes_follows_too(self):
        answer = self.bifurcations(inverted(c="3"), parameters={"c": "k*l^2/2"})
        self.assertAlmostEqual(answer["critical"][0]["value"], CRITICAL)
        self.assertEqual(self.bifurcations(inverted(), parameters={"c": "3 N*m"})["critical"], [])

    def test_a_length_that_is_in_both_moves_both(self):
        answer = self.ask("bifurcations", {"system": inverted(), "parameter": "l", "from": 0.1, "to": 2})
        self.assertAlmostEqual(answer["critical"][0]["value"], 2 * 9.81 / 30)

    def test_the_branches_are_the_equilibria_of_each_value(self):
        branches = self.bifurcations(inverted())["branches"]
        self.assertTrue(branches)
        for branch in branches:
            for k, th in list(zip(branch["k"], branch["th"]))[::20]:
                found = self.ask("equilibria", {"system": inverted(), "parameters": {"k": k}})["equilibria"]
                self.assertLess(min(abs(entry["state"]["th"] - th) for entry in found), 1e-6)

    def test_a_parameter_is_solved_for_with_what_follows_it(self):
        answer = self.ask("equilibria", {"system": inverted(), "solve_for": "k", "at": {"th": 0.3}})
        self.assertLessEqual(abs(answer["k"] - CRITICAL * math.sin(0.3) / 0.3), answer["error"] + 1e-13)
        found = self.ask("equilibria", {"system": inverted(), "parameters": {"k": answer["k"]}})["equilibria"]
        self.assertTrue(any(abs(entry["state"]["th"] - 0.3) < 1e-9 for entry in found))

    def test_an_input_speaks_of_what_follows(self):
        scene = {**inverted(), "inputs": [{"name": "M", "unit": "N*m", "default": "0"}],
                 "forces": [{"value": "M", "along": "th"}]}
        request = {"system": scene, "solve_for": "k", "at": {"th": 0.3}}
        pushed = self.ask("equilibria", {**request, "inputs": {"M": "c/10"}})["k"]
        self.assertAlmostEqual(pushed, CRITICAL * math.sin(0.3) / (0.3 - 0.1))

    def test_a_chain_of_parameters_follows(self):
        scene = inverted(c="K*l^2", K="k/2")
        answer = self.ask("equilibria", {"system": scene, "solve_for": "k", "at": {"th": 0.3}})
        self.assertAlmostEqual(answer["k"], CRITICAL * math.sin(0.3) / 0.3)


if __name__ == "__main__":
    unittest.main()
