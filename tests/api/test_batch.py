"""/v1/batch: a line for a line, each with the bytes of the single request's answer."""

import json
import random
import sys
import pathlib
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))

from service import Service  # noqa: E402  (its directory had to be named first)

QUESTIONS = [("equations", {"system": "rolling_disk_platform"}), ("energy", {"system": "spring_pendulum"}),
             ("modes", {"system": "cart_pendulum"}), ("equilibria", {"system": "whirling_pendulum"}),
             ("turning_points", {"system": "free_spin_pendulum"}), ("gait", {"system": "compass_walker"}),
             ("simulate", {"system": "rod_pendulum", "t_end": 1, "samples": 3}),
             ("simulate", {"system": "rod_pendulum", "t_end": -1}), ("energy", {"system": "nothing"}),
             ("check", {"items": [{"id": "a", "expect": {"energy": {"system": "spring_pendulum"}, "at": "/T"},
                                   "submitted": "0"}]})]


class Batch(Service):
    def lines(self, text, content_type="application/x-ndjson"):
        response = self.raw("POST", "/v1/batch", text, {"Content-Type": content_type} if content_type else {})
        self.assertEqual(response.status, 200, response.data[:300])
        self.assertEqual(response.getheader("Content-Type"), "application/x-ndjson")
        self.assertTrue(response.data == b"" or response.data.endswith(b"\n"))
        return response.data.splitlines()

    def test_answers_have_the_bytes_of_single_requests(self):
        asked = QUESTIONS * 3
        random.Random(2).shuffle(asked)
        text = "".join(json.dumps({"id": i, name: request}) + "\n" for i, (name, request) in enumerate(asked))
        for i, (answer, (name, request)) in enumerate(zip(self.lines(text), asked, strict=True)):
            single = self.post(name, request)
            self.assertEqual(answer, b'{"id":%d,"status":%d,"answer":%s}' % (i, single.status, single.data.strip()))

    def test_a_wrong_line_fails_alone(self):
        good = b'{"id": 1, "energy": {"system": "spring_pendulum"}}'
        wrong = [b"{", b"", b"\xff", b"\0", b"[" * 5000, b'{"id": 2, "energie": {}}', b'{"energy": 3}']
        answers = [json.loads(line) for line in self.lines(good + b"\n" + b"\n".join(wrong) + b"\n" + good)]
        self.assertEqual([answer["status"] for answer in answers], [200, 400, 400, 400, 400, 422, 422, 422, 200])
        self.assertEqual(answers[0], answers[-1])
        self.assertEqual(answers[6]["answer"]["errors"][0]["did_you_mean"], "energy")

    def test_types_of_body(self):
        line = '{"energy": {"system": "spring_pendulum"}}\n'
        for content_type in ("application/x-ndjson", "application/jsonl", "application/json", "",
                             "application/x-www-form-urlencoded"):
            self.assertEqual(len(self.lines(line * 2, content_type)), 2)
        for content_type in ("text/csv", "application/xml", "application/x-ndjson-no"):
            response = self.raw("POST", "/v1/batch", line, {"Content-Type": content_type})
            self.assertEqual(response.status, 415)

    def test_its_limits(self):
        most = self.limits()["batch_lines"]
        line = '{"energy": {"system": "spring_pendulum"}}\n'
        self.assertEqual(len(self.lines(line * most)), most)
        problem = json.loads(self.raw("POST", "/v1/batch", line * (most + 1)).data)
        self.assertEqual((problem["status"], problem["type"]), (422, "/errors/limit-exceeded"))
        wide = json.dumps({"simulate": {"system": "spring_pendulum", "t_end": 1, "samples": 30000}}) + "\n"
        answers = self.lines(wide * 18)
        statuses = [json.loads(answer)["status"] for answer in answers]
        self.assertEqual(statuses, sorted(statuses))
        self.assertEqual(set(statuses), {200, 422})
        full = sum(len(answer) + 1 for answer in answers if json.loads(answer)["status"] == 200)
        self.assertLessEqual(full, self.limits()["batch_answer_bytes"])
        self.assertGreater(full + len(answers[0]), self.limits()["batch_answer_bytes"])
        self.assertEqual(self.lines(wide * 18), answers)

    def limits(self):
        return json.loads(self.raw("GET", "/v1/limits").data)

    def test_a_query_cannot_say_it(self):
        self.assertEqual(self.raw("GET", "/v1/batch").status, 405)


if __name__ == "__main__":
    unittest.main()
