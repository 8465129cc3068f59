"""The reference cases, computed by other programs to 20 digits, come back through HTTP."""

import json
import math
import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, reference_cases  # noqa: E402

# An error made on the way grows by the case's `amplification`; what is left after dividing by it is, for each
# method at its tolerances, ten times what was measured over all cases.
TOLERANCES = {"taylor": {"rtol": 1e-14, "atol": 1e-16}, "erk": {"rtol": 1e-14, "atol": 1e-14},
              "adams": {"rtol": 1e-13, "atol": 1e-13}, "bdf": {"rtol": 1e-12, "atol": 1e-12}}
REACHED = {"taylor": 1e-13, "erk": 4e-13, "adams": 6e-11, "bdf": 7e-9}
PROMISED = 1e-8  # times the amplification, at the tightest tolerances: what every case asks for
STATE = 1e-13  # relative; energies and momenta are some hundred roundings from the state
CONSERVED = {"taylor": 1e-12, "erk": 1e-12, "adams": 1e-9, "bdf": 1e-7}  # drift of h relative to its value, per amplification
NAMES = {"kinetic": "T", "potential": "V", "total": "E", "lagrangian": "L", "jacobi": "h", "hamiltonian": "H"}
FORCES = {"string_tension": "tension", "normal_force": "normal_force"}


def force_text(force):
    if force["type"] == "constant":
        return repr(force["amplitude"])
    return f"{force['amplitude']!r}*cos({force['omega']!r}*t + {force['phase']!r})"


def request_of(case):
    request = {"system": case["system"], "parameters": case["parameters"], "initial": case["initial"]}
    if "force" in case:
        request["inputs"] = {"F": force_text(case["force"])}
    return request


def simulation_of(case, method="erk"):
    request = request_of(case) | {"times": case["times"], "method": method, "on_invalid": "continue"}
    if case["system"] == "compass_walker":
        request["impacts"] = False
    return request | TOLERANCES[method]


def flattened(request):
    """The query that says the same as a body."""
    query = {}
    for name, entry in request.items():
        if isinstance(entry, dict):
            query |= entry
        elif isinstance(entry, list):
            query[name] = ",".join(map(str, entry))
        else:
            query[name] = str(entry).lower() if isinstance(entry, bool) else entry
    return query


class Reference(Service):
    def assert_close(self, actual, expected, tolerance, what=None):
        self.assertLessEqual(abs(actual - expected), tolerance, what)

    def check_trajectory(self, case, method):
        found = self.ask("simulate", simulation_of(case, method))
        self.assertEqual(found["status"], "complete")
        self.assertEqual(found["trajectory"]["t"], case["times"])
        for column, expected in case["expected"].items():
            self.assertEqual(len(found["trajectory"][column]), len(expected))
            for actual, number, amplification in zip(found["trajectory"][column], expected, case["amplification"]):
                unit = amplification*max(1, abs(number))
                self.assert_close(actual, number, min(PROMISED, REACHED[method])*unit, column)
        if "jacobi_integral" in case:
            watched = found["diagnostics"]["conserved"][0]
            self.assertIn(watched["name"], ("energy", "h"))
            expected = case["jacobi_integral"]
            self.assert_close(watched["initial"], expected, STATE*max(1, abs(expected)))
            self.assertLess(watched["max_rel_drift"], CONSERVED[method]*max(case["amplification"]))

    def test_trajectories(self):
        count = 0
        for case in reference_cases("trajectory"):
            for method in TOLERANCES:
                with self.subTest(case["id"], method=method):
                    self.check_trajectory(case, method)
                    count += 1
        self.assertEqual(count, len(TOLERANCES)*16)

    def test_energies_and_accelerations(self):
        for case in reference_cases("energy"):
            with self.subTest(case["id"]):
                found = self.ask("energy", request_of(case) | {"t": case["time"]})
                expected = dict(case["expected"])
                scale = max(abs(expected[name]) for name in ("kinetic", "potential"))
                for q, number in expected.pop("accelerations").items():
                    self.assert_close(found["accelerations"][q + "_ddot"], number, STATE*max(1, abs(number)), q)
                for name, number in expected.items():
                    actual = found["validity"][FORCES[name]] if name in FORCES else found[NAMES[name]]
                    self.assert_close(actual, number, STATE*max(scale, abs(number)), name)
                self.assert_close(found["T"], math.fsum(found[part] for part in ("T2", "T1", "T0")), STATE*scale)

    def test_momenta_and_hamiltonian(self):
        for case in reference_cases("momenta"):
            with self.subTest(case["id"]):
                found = self.ask("energy", request_of(case) | {"t": case["time"]})
                for name, number in case["expected"].items():
                    self.assert_close(found[NAMES.get(name, name)], number, STATE*max(1, abs(number)), name)

    def test_a_query_gives_the_bytes_that_the_body_gives(self):
        requests = [("simulate", simulation_of(case)) for case in reference_cases("trajectory")]
        requests += [("energy", request_of(case) | {"t": case["time"]}) for case in reference_cases("energy", "momenta")]
        for endpoint, request in requests:
            with self.subTest(endpoint, system=request["system"]):
                posted, got = self.post(endpoint, request), self.get(endpoint, flattened(request))
                self.assertEqual((posted.status, got.status), (200, 200), got.data[:300])
                self.assertEqual(got.data, posted.data)

    def test_forces_that_a_string_or_a_platform_can_give(self):
        sampled = 401  # the reference's minimum is over that many instants
        for case in reference_cases("trajectory"):
            if "validity" not in case:
                continue
            with self.subTest(case["id"]):
                validity = case["validity"]
                request = simulation_of(case) | {"t_end": case["times"][-1], "samples": sampled, "include": ["validity"]}
                del request["times"]
                found = self.ask("simulate", request)["trajectory"]
                forces = found[FORCES[validity["force"]]]
                least = min(range(sampled), key=forces.__getitem__)
                self.assert_close(forces[least], validity["sampled_min"], 1e-5*abs(validity["sampled_min"]))  # 6 digits
                self.assert_close(found["t"][least], validity["at"], 1e-12)
                self.assertEqual(min(forces) > 0, validity["valid"])

    def test_where_the_model_stops_holding_the_rows_end(self):
        stopped = 0
        for case in reference_cases("trajectory"):
            if "validity" not in case:
                continue
            with self.subTest(case["id"]):
                request = simulation_of(case) | {"t_end": case["times"][-1], "samples": 101, "include": ["validity"]}
                del request["times"]
                onward = self.ask("simulate", request)
                found = self.ask("simulate", request | {"on_invalid": "stop"})
                self.assertEqual(onward["status"], "complete")
                self.assertEqual(len(onward["trajectory"]["t"]), 101)
                if case["validity"]["valid"]:
                    self.assertEqual(found["trajectory"], onward["trajectory"])
                    self.assertNotIn("stop", found)
                    continue
                stopped += 1
                self.assertEqual(found["status"], "stopped")
                self.assertEqual(found["stop"]["reason"], "lift_off")
                self.assertEqual(found["stop"]["t"], found["t_reached"])
                rows = len(found["trajectory"]["t"])
                self.assertLess(rows, 101)
                self.assertLessEqual(found["trajectory"]["t"][-1], found["t_reached"])
                self.assertGreater(onward["trajectory"]["t"][rows], found["t_reached"])
                for column, numbers in found["trajectory"].items():
                    self.assertEqual(numbers, onward["trajectory"][column][:rows])
                force = FORCES[case["validity"]["force"]]
                self.assertTrue(all(number >= 0 for number in found["trajectory"][force][1:]))
                self.assertLess(onward["trajectory"][force][rows], 0)
        self.assertEqual(stopped, 2)

    def test_a_string_goes_slack_where_the_closed_form_has_no_tension(self):
        """Problem 7 from rest at phi = 2.5, l = r: (1 + phi')^2 = -cos(phi) there, with phi'^2 = 2 (cos(phi) - cos(2.5))."""
        request = {"system": "orbiting_pendulum", "parameters": {"l": 1, "r": 1, "omega0": 1}, "t_end": 5,
                   "initial": {"phi": 2.5, "phi_dot": 0}, "rtol": 1e-12, "atol": 1e-13}
        found = self.ask("simulate", request)
        self.assertEqual((found["status"], found["stop"]["reason"]), ("stopped", "string_slack"))
        low, high = 2.0, 2.5  # the tension over m is negative below, positive at the start
        for _ in range(200):
            middle = (low + high)/2
            rate = -math.sqrt(2*(math.cos(middle) - math.cos(2.5)))
            low, high = (middle, high) if (1 + rate)**2 + math.cos(middle) < 0 else (low, middle)
        at_stop = self.ask("simulate", request | {"on_invalid": "continue", "times": [found["stop"]["t"]], "t_end": 5,
                                                  "include": ["validity"]})
        self.assert_close(at_stop["trajectory"]["phi"][0], high, 1e-10)  # rtol over some steps
        self.assert_close(at_stop["trajectory"]["tension"][0], 0, 1e-10)


if __name__ == "__main__":
    unittest.main()
