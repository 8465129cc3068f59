"""/v1/sweep: what its columns hold: grids of decimals, all digits, units, and nulls."""

import json
import pathlib
import random
import sys
import unittest
from fractions import Fraction

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

mpmath.mp.dps = 40
MODES = {"modes": {"system": "cart_pendulum"}}


class Columns(Service):
    def sweep(self, ask, vary, collect, **more):
        return self.ask("sweep", {"ask": ask, "vary": vary, "collect": collect, **more})

    def over(self, **grid):
        return self.sweep({"energy": {"system": "spring_pendulum"}}, {"k": grid}, {"T": "/T"})["columns"]["k"]

    def test_a_grid_goes_over_the_decimals_that_were_written(self):
        draw = random.Random(5)
        for _ in range(40):
            start, end = (Fraction(draw.randint(1, 400), 10**draw.randint(0, 3)) for _ in range(2))
            count = draw.randint(2, 40)
            exact = [float(start + (end - start)*i/(count - 1)) for i in range(count)]
            self.assertEqual(self.over(**{"from": float(start), "to": float(end), "count": count}), exact)
        self.assertEqual(self.over(**{"from": "10 N/cm", "to": "0.1 kN/m", "count": 4}), [1000.0, 700.0, 400.0, 100.0])

    def test_equal_ratios_are_rounded_once(self):
        def by_ratio(start, end, count):
            return self.over(**{"from": start, "to": end, "count": count, "spacing": "log"})

        self.assertEqual(by_ratio(1, 1000, 4), [1, 10, 100, 1000])
        self.assertEqual(by_ratio(1e-3, 1e3, 7), [1e-3, 1e-2, 0.1, 1, 10, 100, 1e3])
        self.assertEqual(by_ratio(1024, 1, 11), [2.0**k for k in range(10, -1, -1)])
        self.assertEqual(by_ratio(1e-200, 1e200, 5), [1e-200, 1e-100, 1, 1e100, 1e200])
        found = by_ratio(0.3, 70, 23)
        exact = [float(mpmath.mpf("0.3")*(mpmath.mpf(70)/mpmath.mpf("0.3"))**(mpmath.mpf(i)/22)) for i in range(23)]
        self.assertEqual(found, exact)

    def test_extended_numbers_keep_their_digits(self):
        request = {"system": "spring_pendulum", "t_end": 1, "samples": 4, "precision": "extended", "max_error": 1e-20}
        place = "/trajectory/theta/3"
        for given in ({}, {"digits": 25}):
            sent = {"ask": {"simulate": {**request, **given}}, "vary": {"k": {"values": [40, 0.1]}}, "collect": {"end": place}}
            swept = self.raw("POST", "/v1/sweep", json.dumps(sent).encode()).data
            rows = json.loads(swept, parse_float=str)["columns"]["end"]
            lines = self.raw("POST", "/v1/sweep", json.dumps({**sent, "format": "csv"}).encode()).data.decode().splitlines()
            for i, k in enumerate((40, 0.1)):
                single = self.post("simulate", {**request, **given, "parameters": {"k": k}}).data
                written = json.loads(single, parse_float=str)["trajectory"]["theta"][3]
                self.assertGreater(len(written), 25)
                self.assertEqual(rows[i], written)
                self.assertEqual(lines[1 + i].split(",")[1], written)

    def test_units_are_those_of_the_numbers(self):
        for ask, units in (
                ({"simulate": {"system": "spring_pendulum", "t_end": 1, "samples": 3, "events": ["theta = 0.01"]}},
                 {"/t_reached": "s", "/events/0/t": "s", "/events/0/error": "s", "/diagnostics/conserved/0/initial": "J",
                  "/diagnostics/conserved/0/max_rel_drift": "1", "/events/0/state_error/theta": "rad", "/diagnostics/steps": "1"}),
                ({"energy": {"system": "spring_pendulum"}}, {"/conserved/0/value": "J", "/conserved/0/error": "J", "/error/p_theta": "kg*m^2/s"}),
                ({"equilibria": {"system": "spring_pendulum", "solve_for": "k", "at": {"l": 0.6, "theta": 0}}},
                 {"/k": "N/m", "/error": "N/m", "/all/0/error": "N/m", "/eigenvalues/0/im": "1/s", "/eigenvalues/0/error": "1/s"}),
                ({"modes": {"system": "spring_pendulum"}},
                 {"/modes/0/omega": "rad/s", "/modes/0/error": "rad/s", "/modes/0/f_error": "Hz", "/modes/0/period_error": "s"})):
            names = {f"c{i}": pointer for i, pointer in enumerate(units)}
            answer = self.sweep(ask, {"m": {"values": [0.5]}}, names)
            self.assertEqual({pointer: answer["units"][name] for name, pointer in names.items()}, units)

    def test_a_null_that_is_an_answer_fails_no_row(self):
        motion = {"system": "spring_pendulum", "t_end": 1, "samples": 3}
        answer = self.sweep({"simulate": motion}, {"k": {"values": [40]}}, {"h": "/accuracy/horizon"})
        self.assertEqual((answer["columns"]["h"], answer["failed"]), ([None], []))
        answer = self.sweep({"simulate": {**motion, "verify": False}}, {"k": {"values": [40]}}, {"e": "/accuracy/max_abs_error/theta"})
        single = json.loads(self.post("simulate", {**motion, "verify": False}).data)
        self.assertIn(single["accuracy"]["reason"], answer["failed"][0]["reason"])

    def test_as_many_values_as_there_may_be_rows(self):
        values = list(range(1, 10001))
        answer = self.sweep(MODES, {"k": {"values": values}}, {"omega": "/modes/0/omega"})
        self.assertEqual(answer["rows"], 10000)
        self.assertEqual(answer["failed"], [])

    def test_what_doubles_round_is_told(self):
        for value, is_told in (("180deg", True), ("pi", True), ("0.1", False), (0.1, False)):
            answer = self.sweep({"energy": {"system": "spring_pendulum"}}, {"theta": {"values": [value]}}, {"T": "/T"})
            self.assertEqual(any("is rounded" in note for note in answer.get("notes", [])), is_told, value)

    def test_nothing_varies(self):
        refused = json.loads(self.post("sweep", {"ask": MODES, "vary": {}, "collect": {"omega": "/modes/0/omega"}}).data)
        self.assertEqual([(e["pointer"], e["code"]) for e in refused["errors"]], [("#/vary", "empty")])

    def test_what_makes_no_difference_does_not_vary(self):
        """A column of the same numbers would look like a result."""
        whirling = {"system": "whirling_pendulum"}
        arm = {"bifurcations": {**whirling, "parameter": "Omega", "from": 1, "to": 9}}
        solved = {"equilibria": {**whirling, "solve_for": "Omega", "at": {"theta": 1}}}
        modes = {"modes": {"system": "cart_pendulum", "equilibrium": {"theta": 0}}}
        grid = {"values": [0.5, 1.5]}
        for ask, varied, place, why in ((arm, "Omega", "/critical/0/value", "'parameter' asks"),
                                        (solved, "Omega", "/Omega", "'solve_for' asks"), (solved, "theta", "/Omega", "'at' has"),
                                        (modes, "theta", "/modes/0/omega", "'equilibrium' has")):
            with self.subTest(ask=ask, varied=varied):
                problem = self.refused("sweep", {"ask": ask, "vary": {varied: grid}, "collect": {"y": place}})
                self.assertEqual([(e["pointer"], e["code"]) for e in problem["errors"]], [("#/vary", "not_applicable")])
                self.assertIn(why, problem["errors"][0]["detail"])
                others = self.sweep(ask, {"R" if varied == "Omega" or ask is solved else "k": grid}, {"y": place})
                self.assertEqual(others["failed"], [])
        where_at = self.sweep({"equilibria": {**whirling, "solve_for": "Omega"}}, {"theta": grid}, {"y": "/Omega"})["columns"]["y"]
        self.assertLess(where_at[0], where_at[1])
        query = "ask=equilibria&system=whirling_pendulum&solve_for=Omega&at.theta=1&from=1&to=2&count=2&collect=/error&vary="
        for varied in ("Omega", "theta"):
            self.assertEqual(self.raw("GET", f"/v1/sweep?{query}{varied}").status, 422)
        self.assertEqual(self.raw("GET", f"/v1/sweep?{query}l").status, 200)


if __name__ == "__main__":
    unittest.main()
