"""What is JSON is read, and what is not is refused as such; Python's own reader is the second opinion."""

import json
import unittest

import hostile_inputs
import json_cases
import wire
from running_qdot import RunningQdot


def read_strictly(text):
    def no_constant(name):
        raise ValueError(name)

    return json.loads(text.decode("utf-8").removeprefix("\ufeff"), parse_constant=no_constant)


class JsonTexts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = RunningQdot("--threads", "1")

    @classmethod
    def tearDownClass(cls):
        cls.server.__exit__()

    def answer(self, text):
        """Status, and the type of the problem."""
        reply = wire.exchange(self.server.port, hostile_inputs.post(text))
        return reply.status, json.loads(reply.body).get("type")

    def test_the_table_is_right(self):
        for name, text in json_cases.BROKEN.items():
            with self.subTest(name), self.assertRaises(ValueError):
                read_strictly(text)
        for name, text in (json_cases.ACCEPTED | json_cases.REFUSED | json_cases.SPELLINGS).items():
            with self.subTest(name):
                read_strictly(text)

    def test_what_is_not_json_is_refused_as_such(self):
        for name, text in (json_cases.BROKEN | json_cases.REFUSED).items():
            with self.subTest(name):
                self.assertEqual(self.answer(text), (400, "/errors/invalid-json"))

    def test_a_break_anywhere_is_found(self):
        for name, text in json_cases.BROKEN.items():
            with self.subTest(name):
                self.assertEqual(self.answer(b'{"system":"spring_pendulum","t_end":' + text + b"}")[0], 400)

    def test_json_is_read(self):
        for name, text in json_cases.ACCEPTED.items():
            with self.subTest(name):
                self.assertEqual(self.answer(text), (422, "/errors/invalid-request"))

    def test_spelling_does_not_matter(self):
        replies = [wire.exchange(self.server.port, hostile_inputs.post(text)) for text in json_cases.SPELLINGS.values()]
        self.assertEqual({reply.status for reply in replies}, {200})
        self.assertEqual(len({reply.body for reply in replies}), 1)

    def test_limits_are_told_apart_from_mistakes(self):
        cases = {"seventeen deep": (b"[" * 17 + b"]" * 17, (422, "/errors/limit-exceeded")),
                 "many values": (b"[" + b"0," * 19999 + b"0]", (422, "/errors/limit-exceeded")),
                 "many bytes": (b'"' + b"a" * 65536 + b'"', (413, "/errors/payload-too-large")),
                 "a key twice": (b'{"system":"spring_pendulum","t_end":1,"t_end":1}', (422, "/errors/invalid-request")),
                 "a key twice, far down": (b'{"a":[{"b":{"c":1,"c":2}}]}', (422, "/errors/invalid-request"))}
        for name, (text, expected) in cases.items():
            with self.subTest(name):
                self.assertEqual(self.answer(text), expected)


if __name__ == "__main__":
    unittest.main()
