"""/v1/sweep: every row has the bits of the request asked alone; grids and samples against a second road."""

import csv
import io
import json
import pathlib
import sys
import time
import unittest
from fractions import Fraction

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import PATIENCE, Service, textbook_scene  # noqa: E402

import hostile_inputs  # noqa: E402
import wire  # noqa: E402
from running_qdot import qdot  # noqa: E402

mpmath.mp.dps = 40


def split_mix(seed):
    """The fractions of SplitMix64, as its authors write it."""
    state = seed
    while True:
        state = (state + 0x9E3779B97F4A7C15) % 2**64
        z = state
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9 % 2**64
        z = (z ^ (z >> 27)) * 0x94D049BB133111EB % 2**64
        yield Fraction((z ^ (z >> 31)) >> 11, 2**53)


def at(answer, pointer):
    for step in pointer.split("/")[1:]:
        answer = answer[int(step) if isinstance(answer, list) else step]
    return answer


def bits(number):
    return number.hex() if isinstance(number, float) else number


class Rows(Service):
    def assert_rows_are_requests(self, question, base, vary, collect, **more):
        """Each row beside the request asked alone, which is sent with the row's numbers as the answer has them."""
        answer = self.ask("sweep", {"ask": {question: base}, "vary": vary, "collect": collect, **more})
        columns = answer["columns"]
        self.assertEqual(list(columns), [*vary, *collect])
        failed = {entry["row"]: entry for entry in answer["failed"]}
        for row in range(answer["rows"]):
            request = json.loads(json.dumps(base))
            for name in vary:
                group = "parameters" if name in self.parameters(base["system"]) else "initial"
                request.setdefault(group, {})[name] = columns[name][row]
            single = self.post(question, request)
            if row in failed and single.status != 200:
                self.assertEqual(failed[row]["status"], single.status)
                self.assertTrue(all(columns[name][row] is None for name in collect))
                continue
            self.assertEqual(single.status, 200)
            for name, pointer in collect.items():
                if columns[name][row] is None:
                    self.assertIn(row, failed)
                    continue
                self.assertEqual(bits(columns[name][row]), bits(at(json.loads(single.data), pointer)), (row, name))
        return answer

    def parameters(self, system):
        if isinstance(system, dict):
            return [parameter["name"] for parameter in system["parameters"]]
        return [p["name"] for p in json.loads(self.raw("GET", f"/v1/systems/{system}").data)["parameters"]]

    def test_of_turning_points(self):
        answer = self.assert_rows_are_requests(
            "turning_points", {"system": "free_spin_pendulum"},
            {"psi_dot": {"from": 1, "to": 20, "count": 20}, "l": {"values": [0.3, "50 cm"]}},
            {"max": "/theta_max", "T": "/period", "kind": "/motion"})
        self.assertEqual(answer["columns"]["l"], [0.3, 0.5]*20)
        self.assertEqual(answer["columns"]["psi_dot"], [value for value in map(float, range(1, 21)) for _ in range(2)])
        self.assertEqual(answer["units"], {"psi_dot": "rad/s", "l": "m", "max": "rad", "T": "s", "kind": "1"})
        # Energy with p_psi = m l^2 psi_dot/4 (theta = 0 at the start): the root, by mpmath.
        for psi_dot, l, found in zip(*(answer["columns"][name] for name in ("psi_dot", "l", "max"))):
            g, l, psi_dot = mpmath.mpf("9.81"), mpmath.mpf(l), mpmath.mpf(psi_dot)

            def excess(theta):
                return l**2*psi_dot**2/32/(mpmath.mpf(1)/2 + mpmath.sin(theta))**2 - g*l*mpmath.cos(theta) \
                    - (l**2*psi_dot**2/8 - g*l)

            self.assertLess(abs(mpmath.findroot(excess, found) - found), 1e-12)

    def test_of_modes_energy_and_equilibria(self):
        self.assert_rows_are_requests("modes", {"system": "cart_pendulum", "parameters": {"m": 0.25}},
                                      {"k": {"from": 1, "to": 50, "count": 7}}, {"a": "/modes/0/omega", "b": "/modes/1/omega"})
        self.assert_rows_are_requests("energy", {"system": "spring_pendulum"},
                                      {"theta": {"from": "-90deg", "to": "90deg", "count": 9}, "l_dot": {"values": [0, 0.1]}},
                                      {"T": "/T", "V": "/V", "a": "/accelerations/theta_ddot"})
        self.assert_rows_are_requests("equilibria", {"system": "whirling_pendulum"},
                                      {"Omega": {"from": 0, "to": 10, "count": 11}}, {"theta": "/equilibria/1/state/theta"})

    def test_of_motions(self):
        self.assert_rows_are_requests("simulate", {"system": "spring_pendulum", "t_end": 2, "samples": 3, "max_error": 1e-6},
                                      {"theta": {"uniform": [-1, 1]}, "k": {"normal": [40, 2]}},
                                      {"end": "/trajectory/theta/2"}, count=12, seed=5)

    def test_collect_from_every_member_of_an_answer(self):
        """Only what is collected of an answer is written; it is what the whole answer has."""
        request = {"system": "spring_pendulum", "t_end": 2, "samples": 3, "max_error": 1e-6, "events": ["theta=0"]}
        collect = {"k0": "/request/parameters/m", "bound": "/accuracy/max_abs_error/l", "steps": "/diagnostics/steps",
                   "crossing": "/events/0/t", "ended": "/status", "unit": "/units/l_dot", "version": "/service_version",
                   "drift": "/diagnostics/conserved/0/max_abs_drift", "end": "/trajectory/theta/2", "reached": "/t_reached"}
        for some in (collect, *({name: pointer} for name, pointer in collect.items())):
            answer = self.assert_rows_are_requests("simulate", request, {"theta": {"values": [0.3, -0.8]}}, some)
            self.assertEqual(answer["failed"], [])
        # What an answer would have beside what is collected is not computed.
        for some in ({"omega": "/modes/1/omega"}, {"square": "/modes/0/exact/text"}, {"other": "/modes/1/exact/text", "omega": "/modes/1/omega"}):
            self.assert_rows_are_requests("modes", {"system": "cart_pendulum", "parameters": {"M": "2*m"}}, {"k": {"values": ["2*m*g/l", 7]}}, some)
        for some in ({"max": "/theta_max"}, {"period": "/period"}, {"of": "/error/period"}, {"at": "/exact/theta_max/text"},
                     {"unit": "/units/period"}, {"motion": "/motion", "E": "/constants/E"}):
            self.assert_rows_are_requests("turning_points", {"system": "free_spin_pendulum"},
                                          {"psi_dot": {"values": [1, "2*sqrt(g/l)", 9]}}, some)
        for some in ({"least": "/validity/tension/min"}, {"holds": "/validity/tension/holds"}, {"why": "/reason/period"}):
            self.assert_rows_are_requests("turning_points", {"system": "orbiting_pendulum"}, {"phi_dot": {"values": [0.1, 3, 40]}}, some)
        energy = {"system": "spring_pendulum"}
        self.assert_rows_are_requests("energy", energy, {"theta": {"values": [0.3]}}, {"p": "/p_theta", "l": "/request/initial/l"})

    def test_of_a_scene_and_of_an_input(self):
        scene = textbook_scene("plane_pendulum")
        self.assert_rows_are_requests("turning_points", {"system": scene},
                                      {scene["parameters"][0]["name"]: {"values": [0.5, 1, 2]}}, {"T": "/period"})
        forced = {"system": "forced_spring_pendulum", "inputs": {"F": "0.8*cos(4*t)"}, "t_end": 1, "samples": 2}
        self.assert_rows_are_requests("simulate", forced, {"k": {"from": 30, "to": 50, "count": 5}}, {"x": "/trajectory/l/1"})

    def test_an_expression_speaks_of_what_varies(self):
        answer = self.ask("sweep", {"ask": {"modes": {"system": "cart_pendulum", "parameters": {"k": "2*m*g/l"}}},
                                    "vary": {"l": {"values": [0.2, 0.8]}}, "collect": {"k": "/request/parameters/k",
                                                                                      "omega": "/modes/0/omega"}})
        self.assertEqual(answer["columns"]["k"], [2*0.5*9.81/0.2, 2*0.5*9.81/0.8])

    def test_a_row_that_fails_spoils_no_other(self):
        answer = self.assert_rows_are_requests("turning_points", {"system": "free_spin_pendulum"},
                                               {"l": {"values": [0.5, -1, 0, 0.7]}}, {"max": "/theta_max"})
        self.assertEqual([(entry["row"], entry["status"]) for entry in answer["failed"]], [(1, 422), (2, 422)])
        self.assertIn("'l' must be > 0", answer["failed"][0]["reason"])
        self.assertEqual(answer["columns"]["l"], [0.5, -1, 0, 0.7])

    def test_what_an_answer_does_not_have_is_missing_with_its_reason(self):
        answer = self.ask("sweep", {"ask": {"equilibria": {"system": "whirling_pendulum"}},
                                    "vary": {"Omega": {"values": [0, 10]}},
                                    "collect": {"first": "/equilibria/0/state/theta", "fourth": "/equilibria/3/state/theta"}})
        self.assertIsNone(answer["columns"]["fourth"][0])
        self.assertIsNotNone(answer["columns"]["first"][0])
        self.assertEqual((answer["failed"][0]["row"], answer["failed"][0]["status"]), (0, 200))
        self.assertIn("fourth", answer["failed"][0]["reason"])
        scene = textbook_scene("plane_pendulum")
        name = scene["coordinates"][0]["name"]
        rolling = self.ask("sweep", {"ask": {"turning_points": {"system": scene}},
                                     "vary": {name + "_dot": {"values": [0, 100]}}, "collect": {"most": f"/{name}_max"}})
        self.assertIsNone(rolling["columns"]["most"][1])
        single = self.ask("turning_points", {"system": scene, "initial": {name + "_dot": 100}})
        self.assertEqual(rolling["failed"], [{"row": 1, "status": 200, "reason": "most: " + single["reason"][f"{name}_max"]}])

    def test_digits_beyond_a_double_reach_every_row(self):
        body = '{"ask": {"simulate": {"system": "spring_pendulum", "parameters": {"k": %s}, "t_end": 1, "samples": 2,' \
               ' "precision": "extended"}}, "vary": {"theta": {"values": [0.2]}}, "collect": {"l": "/trajectory/l/1"}}'
        found = {self.post("sweep", body % k).data.split(b'"l":[')[1].split(b"]")[0] for k in
                 ("40.1234567890123456", "40.1234567890123456789012345")}
        single = self.post("simulate", '{"system": "spring_pendulum", "parameters": {"k": 40.1234567890123456789012345},'
                           ' "initial": {"theta": 0.2}, "t_end": 1, "samples": 2, "precision": "extended"}').data
        self.assertTrue(any(value.strip(b'"') in single for value in found), found)


class Values(Service):
    def column(self, variable, name="k", **more):
        answer = self.ask("sweep", {"ask": {"energy": {"system": "spring_pendulum"}}, "vary": {name: variable},
                                    "collect": {"V": "/V"}, **more})
        return answer["columns"][name]

    def test_a_linear_grid(self):
        self.assertEqual(self.column({"from": 1, "to": 20, "count": 191}), [(10 + i)/10 for i in range(191)])
        self.assertEqual(self.column({"from": 5, "to": 1, "count": 3}), [5, 3, 1])
        self.assertEqual(self.column({"from": 5, "to": 9, "count": 1}), [5])
        self.assertEqual(self.column({"from": "0 deg", "to": "180 deg", "count": 2}, name="theta"), [0, float(mpmath.pi)])

    def test_a_logarithmic_grid(self):
        for begin, end, count in ((1, 1000, 4), (1e-3, 7, 50), (9, 2, 11)):
            column = self.column({"from": begin, "to": end, "count": count, "spacing": "log"})
            for i, value in enumerate(column):
                exact = mpmath.mpf(begin)*(mpmath.mpf(end)/begin)**(mpmath.mpf(i)/(count - 1))
                self.assertLess(abs(value/exact - 1), 6e-16)  # a ratio, a power and a product, each rounded
            self.assertEqual((column[0], column[-1]), (begin, end))

    def test_a_sample_is_split_mix(self):
        answer = self.ask("sweep", {"ask": {"energy": {"system": "spring_pendulum"}}, "count": 300, "seed": 11,
                                    "vary": {"k": {"uniform": [30, 50]}, "theta": {"normal": [0.1, 0.02]}}, "collect": ["/V"]})
        fractions = split_mix(11)
        for k, theta in zip(answer["columns"]["k"], answer["columns"]["theta"], strict=True):
            self.assertAlmostEqual(k, 30 + 20*float(next(fractions)), delta=1e-14)
            u, v = (mpmath.mpf(f.numerator)/f.denominator for f in (next(fractions), next(fractions)))
            normal = mpmath.sqrt(-2*mpmath.log(1 - u))*mpmath.cos(2*mpmath.pi*v)
            self.assertAlmostEqual(theta, float(mpmath.mpf("0.1") + mpmath.mpf("0.02")*normal), delta=1e-16)

    def test_a_seed_chooses_the_sample(self):
        columns = [self.column({"uniform": [1, 2]}, count=5, **seed) for seed in ({}, {"seed": 0}, {"seed": 1})]
        self.assertEqual(columns[0], columns[1])
        self.assertNotEqual(columns[1], columns[2])

    def test_the_last_variable_varies_fastest(self):
        answer = self.ask("sweep", {"ask": {"energy": {"system": "spring_pendulum"}}, "collect": ["/V"],
                                    "vary": {"m": {"values": [1, 2]}, "k": {"values": [3, 4, 5]}, "g": {"values": [6, 7]}}})
        rows = list(zip(*(answer["columns"][name] for name in "mkg")))
        self.assertEqual(rows, [(m, k, g) for m in (1, 2) for k in (3, 4, 5) for g in (6, 7)])


class Forms(Service):
    REQUEST = {"ask": {"turning_points": {"system": "free_spin_pendulum"}}, "vary": {"l": {"values": [0.5, -1]}},
               "collect": {"max": "/theta_max", "kind": "/motion"}}

    def test_csv_and_ndjson_say_the_same(self):
        answer = self.ask("sweep", self.REQUEST)
        table = list(csv.DictReader(io.StringIO(self.post("sweep", {**self.REQUEST, "format": "csv"}).data.decode())))
        lines = [json.loads(line) for line in self.post("sweep", {**self.REQUEST, "format": "ndjson"}).data.splitlines()]
        for row in range(2):
            for name in ("l", "max", "kind"):
                value = answer["columns"][name][row]
                self.assertEqual(lines[row][name], value)
                self.assertEqual(table[row][name], "" if value is None else str(value))
        reason = answer["failed"][0]["reason"]
        self.assertEqual((table[1]["status"], table[1]["reason"]), ("422", reason))
        self.assertEqual((lines[1]["status"], lines[1]["reason"]), (422, reason))
        self.assertNotIn("status", lines[0])
        for suffix, form in ((".csv", "csv"), (".ndjson", "ndjson")):
            self.assertEqual(self.post("sweep" + suffix, self.REQUEST).data,
                             self.post("sweep", {**self.REQUEST, "format": form}).data)

    def test_a_query_has_one_variable(self):
        query = {"ask": "modes", "system": "cart_pendulum", "vary": "k", "from": 1, "to": 50, "count": 50,
                 "collect": "/modes/0/omega,/modes/1/omega", "m": "0.25"}
        response = self.get("sweep", query)
        self.assertEqual(response.status, 422)  # both would be called omega
        query["collect"] = "/modes/0/omega"
        answer = json.loads(self.get("sweep", query).data)
        body = {"ask": {"modes": {"system": "cart_pendulum", "parameters": {"m": 0.25}}},
                "vary": {"k": {"from": 1, "to": 50, "count": 50}}, "collect": {"omega": "/modes/0/omega"}}
        self.assertEqual(answer, self.ask("sweep", body))
        flat = {"ask": body["ask"], "vary": "k", "from": 1, "to": 50, "count": 50, "collect": "/modes/0/omega"}
        self.assertEqual(answer, self.ask("sweep", flat))
        values = json.loads(self.get("sweep", {"ask": "energy", "system": "spring_pendulum", "vary": "theta",
                                               "values": "10deg,0.3", "collect": "/V"}).data)
        self.assertEqual(values["columns"]["theta"], [float(mpmath.pi/18), 0.3])

    def test_the_command_line_has_the_same_bytes(self):
        response = self.post("sweep", self.REQUEST)
        self.assertEqual(qdot("sweep", stdin=json.dumps(self.REQUEST)).stdout, response.data)
        words = ("cart_pendulum", "ask=modes", "vary=k", "from=1", "to=50", "count=3", "collect=/modes/0/omega")
        query = "&".join(["system=cart_pendulum", *words[1:]])
        self.assertEqual(qdot("sweep", *words).stdout, self.raw("GET", "/v1/sweep?" + query).data)


class Refused(Service):
    GOOD = {"ask": {"modes": {"system": "cart_pendulum"}}, "vary": {"k": {"from": 1, "to": 2, "count": 3}},
            "collect": {"omega": "/modes/0/omega"}}

    def test_all_that_is_wrong_is_said_before_a_row_is_asked(self):
        cases = {
            "#/ask/modes/parameters/kk": {"ask": {"modes": {"system": "cart_pendulum", "parameters": {"kk": 1}}}},
            "#/ask/modes/system": {"ask": {"modes": {}}},
            "#/ask/modus": {"ask": {"modus": {"system": "cart_pendulum"}}},
            "#/ask": {"ask": {}},
            "#/ask/modes": {"ask": {"modes": 3}},
            "#/ask/check": {"ask": {"check": {}}},
            "#/ask/simulate/format": {"ask": {"simulate": {"system": "cart_pendulum", "t_end": 1, "format": "csv"}},
                                      "collect": ["/trajectory/x/0"]},
            "#/vary/kk": {"vary": {"kk": {"values": [1]}}},
            "#/vary/k/too": {"vary": {"k": {"from": 1, "to": 2, "too": 3, "count": 2}}},
            "#/vary/k": {"vary": {"k": {}}},
            "#/vary/k/count": {"vary": {"k": {"from": 1, "to": 2, "count": 0}}},
            "#/vary/k/from": {"vary": {"k": {"from": "1 kg", "to": 2, "count": 3}}},
            "#/vary/k/spacing": {"vary": {"k": {"from": -1, "to": 2, "count": 3, "spacing": "log"}}},
            "#/vary/k/values/1": {"vary": {"k": {"values": [1, "two"]}}},
            "#/vary/k/normal": {"vary": {"k": {"normal": [1, -1]}}, "count": 3},
            "#/vary/k/uniform": {"vary": {"k": {"uniform": [1]}}, "count": 3},
            "#/vary": {"vary": {}},
            "#/count": {"vary": {"k": {"uniform": [1, 2]}}},
            "#/seed": {"seed": 3},
            "#/from": {"from": 3},
            "#/collect/omega": {"collect": {"omega": "/mode/0/omega"}},
            "#/collect": {"collect": {}},
            "#/collect/all": {"collect": {"all": "/modes"}},
            "#/collect/k": {"collect": {"k": "/modes/0/omega"}},
            "#/collect/0": {"collect": ["no pointer"]},
            "#/nothing": {"nothing": 1},
        }
        for pointer, change in cases.items():
            with self.subTest(pointer=pointer):
                problem = self.refused("sweep", {**self.GOOD, **change})
                self.assertIn(pointer, [error["pointer"] for error in problem["errors"]], problem)
        problem = self.refused("sweep", {**self.GOOD, "vary": {"kk": {"values": [1]}}, "collect": {"a": "/mods/0/omega"}})
        self.assertEqual([error["did_you_mean"] for error in problem["errors"]], ["k", "modes"])

    def test_what_varies_is_not_given_too(self):
        ask = {"modes": {"system": "cart_pendulum", "parameters": {"k": 3}}}
        self.refused_at("sweep", {**self.GOOD, "ask": ask}, "#/vary")
        self.refused_at("sweep", {**self.GOOD, "vary": {"k": {"values": [1]}, "l": {"uniform": [1, 2]}}, "count": 2}, "#/vary")

    def test_rows_are_bounded(self):
        most = json.loads(self.raw("GET", "/v1/limits").data)["sweep_rows"]
        ask = {"ask": {"energy": {"system": "spring_pendulum"}}, "collect": {"V": "/V"}}
        answer = self.ask("sweep", {**ask, "vary": {"k": {"from": 1, "to": 2, "count": most}}})
        self.assertEqual((answer["rows"], answer["failed"]), (most, []))
        for vary in ({"k": {"from": 1, "to": 2, "count": most + 1}}, {"k": {"from": 1, "to": 2, "count": 10**9}},
                     {name: {"from": 1, "to": 2, "count": most // 2} for name in "kgm"}):
            problem = self.refused("sweep", {**ask, "vary": vary})
            self.assertEqual(problem["errors"][0]["code"], "too_many")
        self.assertEqual(self.refused("sweep", {**ask, "vary": {"k": {"uniform": [1, 2]}}, "count": most + 1})["errors"][0]["code"],
                         "too_many")


class Work(Service):
    def running(self):
        metrics = wire.exchange(self.server.port, hostile_inputs.get(b"/metrics")).body.decode()
        return sum(float(line.split()[1]) for line in metrics.splitlines() if line.startswith("qdot_in_flight{"))

    def test_it_ends_when_its_client_leaves(self):
        body = json.dumps({"ask": {"simulate": {"system": "spring_pendulum", "t_end": 2000, "samples": 2}},
                           "vary": {"k": {"from": 30, "to": 50, "count": 10000}}, "collect": {"l": "/trajectory/l/1"}}).encode()
        head = b"POST /v1/sweep HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n"
        with wire.connect(self.server.port) as sock:
            sock.sendall(head % len(body) + body)
            deadline = time.monotonic() + PATIENCE
            while self.running() == 0:
                self.assertLess(time.monotonic(), deadline)
                time.sleep(0.01)
            time.sleep(0.3)
            self.assertGreater(self.running(), 0)
        left = time.monotonic()
        while self.running() > 0:
            self.assertLess(time.monotonic() - left, 5)
            time.sleep(0.01)

    def test_one_and_many_threads_have_the_same_bytes(self):
        request = json.dumps({"ask": {"simulate": {"system": "rod_pendulum", "t_end": 2, "samples": 2}},
                              "vary": {"l": {"from": 0.2, "to": 2, "count": 60}}, "collect": {"a": "/trajectory/theta/1"}})
        served = self.post("sweep", request).data
        self.assertEqual(qdot("sweep", stdin=request).stdout, served)
        self.assertEqual(json.loads(qdot("batch", stdin='{"sweep": ' + request + "}").stdout)["answer"], json.loads(served))


if __name__ == "__main__":
    unittest.main()
