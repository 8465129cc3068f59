"""/v1/sweep: how long its answers may be, where its pointers may lead, and numbers near the largest."""

import json
import pathlib
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

from running_qdot import qdot  # noqa: E402

mpmath.mp.dps = 60
LARGEST = 1.7976931348623157e308
ENERGY = {"ask": {"energy": {"system": "spring_pendulum"}}}


def falling(rows, columns, bytes_of_message=1000):
    """A sweep whose rows have a long text in each column."""
    scene = {"name": "falling", "units": "none", "parameters": [{"name": "a", "default": 1}],
             "coordinates": [{"name": "x", "initial": 0.3}], "lagrangian": "x_dot^2/2 - a*x",
             "valid_while": [{"name": "up", "expression": "x - 0.2", "reason": "fell", "message": "m"*bytes_of_message}]}
    return {"ask": {"simulate": {"system": scene, "t_end": 2, "samples": 2, "verify": False}},
            "vary": {"a": {"from": 1, "to": 2, "count": rows}},
            "collect": {f"c{i}": "/stop/message" for i in range(columns)}}


class Bytes(Service):
    def most(self):
        return json.loads(self.raw("GET", "/v1/limits").data)["sweep_answer_bytes"]

    def test_texts_are_sent_up_to_the_limit_and_refused_beyond(self):
        rows = self.most() // (50*1003)
        for form in ("json", "csv", "ndjson"):
            response = self.post("sweep", {**falling(rows - 8, 50), "format": form})
            self.assertEqual(response.status, 200, response.data[:300])
            self.assertLessEqual(len(response.data), self.most())
            self.assertGreater(len(response.data), 0.97*self.most())
            problems = [self.refused("sweep", {**falling(count, 50), "format": form}) for count in (rows + 8, 10000, rows + 8)]
            for problem in problems:
                self.assertEqual(problem, problems[0])
                self.assertEqual(problem["type"], "/errors/limit-exceeded")
                self.assertIn(f"longer than {self.most()} bytes", problem["detail"])
                self.assertIn("fewer rows or columns", problem["detail"])

    def test_reasons_count_too(self):
        missing = {**ENERGY, "vary": {"k": {"from": 1, "to": 50, "count": 10000}},
                   "collect": {f"{'name'*12}_{i}": f"/conserved/{10**12 + i}/value" for i in range(50)}}
        self.assertEqual(self.refused("sweep", missing)["type"], "/errors/limit-exceeded")
        missing["vary"]["k"]["count"] = 100
        self.assertEqual(len(self.ask("sweep", missing)["failed"]), 100)

    def test_a_line_of_a_batch_is_refused_alone(self):
        lines = "".join(json.dumps(line) + "\n" for line in ({"sweep": falling(2, 1)}, {"sweep": falling(1000, 50)}, {"sweep": falling(2, 1)}))
        answers = [json.loads(line) for line in self.raw("POST", "/v1/batch", lines, {"Content-Type": "application/x-ndjson"}).data.splitlines()]
        self.assertEqual([answer["status"] for answer in answers], [200, 422, 200])

    def test_ones_own_machine_has_no_such_limit(self):
        answer = qdot("sweep", stdin=json.dumps(falling(800, 50)))
        self.assertEqual(answer.returncode, 0, answer.stderr[:300])
        self.assertGreater(len(answer.stdout), self.most())


class Pointers(Service):
    def test_an_index_that_no_list_has_is_refused(self):
        for index in (2**64 - 1, 2**64, 10**20 - 1, "01", "00"):
            pointer = f"/conserved/{index}/value"
            problem = self.refused_at("sweep", {**ENERGY, "vary": {"m": {"values": [1]}}, "collect": {"v": pointer}}, "#/collect/v")
            self.assertEqual(problem["errors"][0]["code"], "unknown_place")
            query = {"ask": "energy", "system": "spring_pendulum", "vary": "m", "values": 1, "collect": pointer}
            self.assertEqual(json.loads(self.get("sweep", query).data)["errors"][0]["parameter"], "collect")
            item = {"id": "a", "expect": {"energy": {"system": "spring_pendulum"}, "at": pointer}, "submitted": "1"}
            self.assertEqual(self.post("check", {"items": [item]}).status, 422)

    def test_an_index_that_this_list_lacks_is_told_in_the_row(self):
        for index in (7, 2**64 - 2):
            answer = self.ask("sweep", {**ENERGY, "vary": {"m": {"values": [1]}}, "collect": {"v": f"/conserved/{index}/value"}})
            self.assertEqual(answer["columns"]["v"], [None])
            self.assertIn(f"nothing at '/conserved/{index}/value'", answer["failed"][0]["reason"])


class Large(Service):
    def column(self, variable, **more):
        return self.ask("sweep", {**ENERGY, "vary": {"l_dot": variable}, "collect": ["/V"], **more})["columns"]["l_dot"]

    def test_grids_may_have_any_ends(self):
        for begin, end, count in ((-1e308, 1e308, 5), (1e308, 1.1e308, 5), (-LARGEST, LARGEST, 4), (LARGEST, LARGEST, 7), (1e-300, LARGEST, 1000)):
            decimals = mpmath.mpf(repr(begin)), mpmath.mpf(repr(end))
            exact = [float((decimals[0]*(count - 1 - i) + decimals[1]*i)/(count - 1)) for i in range(count)]
            self.assertEqual(self.column({"from": begin, "to": end, "count": count}), exact)
        for begin, end, count in ((1e300, LARGEST, 9), (LARGEST, 1.7976931348623155e308, 5), (-1e-300, -LARGEST, 100)):
            decimals = mpmath.mpf(repr(begin)), mpmath.mpf(repr(end))
            exact = [float(decimals[0]*(decimals[1]/decimals[0])**(mpmath.mpf(i)/(count - 1))) for i in range(count)]
            self.assertEqual(self.column({"from": begin, "to": end, "count": count, "spacing": "log"}), exact)

    def test_samples_may_have_any_ends(self):
        begin, end = -1e308, 1.7e308
        unit = self.column({"uniform": [0, 1]}, count=300, seed=3)
        for drawn, fraction in zip(self.column({"uniform": [begin, end]}, count=300, seed=3), unit, strict=True):
            self.assertLess(abs(drawn - (begin + (mpmath.mpf(end) - begin)*fraction)), 1e293)

    def test_counts_beyond_all_bounds_are_called_too_large(self):
        for count in (1e30, 10**30, 2**53 + 2, -1e20):
            problem = self.refused_at("sweep", {**ENERGY, "vary": {"m": {"from": 1, "to": 2, "count": count}}, "collect": ["/V"]}, "#/vary/m/count")
            self.assertEqual(problem["errors"][0]["code"], "out_of_range")
            self.assertIn("must be from 1 to ", problem["errors"][0]["detail"])
        query = {"ask": "energy", "system": "spring_pendulum", "vary": "m", "from": 1, "to": 2, "collect": "/V"}
        for count, code in (("1e30", "out_of_range"), ("2.5", "wrong_type"), ("1e400", "wrong_type")):
            self.assertEqual(json.loads(self.get("sweep", {**query, "count": count}).data)["errors"][0]["code"], code)


if __name__ == "__main__":
    unittest.main()
