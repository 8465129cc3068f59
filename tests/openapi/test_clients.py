"""Generated clients in TypeScript and the Python file give what plain HTTP gives, for the same questions."""

import contextlib
import http.client
import json
import pathlib
import socket
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.extend([str(ROOT / "tests" / "support"), str(ROOT / "tests" / "server"), str(ROOT / "api" / "clients")])

from node import MODULES, require_packages  # noqa: E402
from qdot import Problem, Qdot  # noqa: E402
from running_qdot import QDOT, RunningQdot  # noqa: E402
from typed_clients import GENERATORS, QUESTIONS, answers_of  # noqa: E402


def at(pointer, document):
    for part in pointer.strip("/").split("/"):
        document = document[int(part) if isinstance(document, list) else part]
    return document


def ask_in_python(client, question):
    """As a program would: the request's fields are the method's words, and its symbols stand alone."""
    words = {{"from": "from_"}.get(name, name): value for name, value in question["request"].items()}
    if not isinstance(words["system"], dict):
        for place in ("parameters", "initial", "inputs"):
            words.update(words.pop(place, {}))
    try:
        answer = getattr(client, question["ask"])(**words)
    except Problem as problem:
        return at(question["refused"], problem.document)
    return at(question["at"], answer)


class Clients(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        require_packages()
        cls.server = RunningQdot("--deadline", "60")
        cls.address = f"http://localhost:{cls.server.port}"
        cls.document = json.loads(cls.server.request("GET", "/openapi.json").data)
        cls.expected = [cls.raw(question) for question in QUESTIONS]

    @classmethod
    def tearDownClass(cls):
        cls.server.__exit__()

    @classmethod
    def raw(cls, question):
        answer = cls.server.request("POST", "/v1/" + question["ask"], json.dumps(question["request"]))
        if answer.status != (422 if "refused" in question else 200):
            raise AssertionError((question, answer.data))
        return at(question.get("at") or question["refused"], json.loads(answer.data))

    def assert_answers(self, answers):
        self.assertGreaterEqual(len(QUESTIONS), 30)
        self.assertNotIn(None, answers)
        for question, answer, expected in zip(QUESTIONS, answers, self.expected, strict=True):
            with self.subTest(question=question):
                self.assertEqual(answer, expected)

    def test_typescript(self):
        for generator in GENERATORS:
            with self.subTest(generator=generator), tempfile.TemporaryDirectory() as directory:
                self.assert_answers(answers_of(generator, self.document, self.address, directory))

    def test_python(self):
        for client in (Qdot(self.address), Qdot(command=QDOT)):
            with self.subTest(command=client.command):
                # A symbol that is unknown stands beside the fields, where the suggestion names its place.
                answers = [ask_in_python(client, question) for question in QUESTIONS]
                self.assert_answers([answer.removeprefix("parameters.") if isinstance(answer, str) else answer
                                     for answer in answers])

    def test_a_proxy_that_validates_finds_nothing(self):
        with tempfile.TemporaryDirectory() as directory, validating_proxy(self.document, self.address, directory) as port:
            for question in QUESTIONS:
                with self.subTest(question=question):
                    answer = post(port, question)
                    self.assertEqual(answer.status, 422 if "refused" in question else 200, answer.data[:500])
                    self.assertIsNone(answer.getheader("sl-violations"))
            refused = post(port, {"ask": "modes", "request": {"system": "cart_pendulum", "digits": "many"}})
            self.assertIn(b"digits", refused.data)
            self.assertNotIn(b"/errors/invalid-request", refused.data, "the proxy itself refuses what does not fit")


def post(port, question):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
    connection.request("POST", "/v1/" + question["ask"], json.dumps(question["request"]),
                       {"Content-Type": "application/json", "Accept": "application/json"})
    response = connection.getresponse()
    response.data = response.read()
    connection.close()
    return response


@contextlib.contextmanager
def validating_proxy(document, address, directory):
    """The port of Prism in front of the server: it answers for a request or an answer that does not fit."""
    file = pathlib.Path(directory, "openapi.json")
    file.write_text(json.dumps(document))
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    prism = subprocess.Popen(["node", str(MODULES / "@stoplight/prism-cli/dist/index.js"), "proxy", str(file), address,
                              "--errors", "--port", str(port), "--host", "127.0.0.1"],
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        wait_for(port)
        yield port
    finally:
        prism.terminate()
        prism.wait(timeout=30)


def wait_for(port):
    for _ in range(300):
        with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port), timeout=1):
            return
        time.sleep(0.1)
    raise AssertionError("the proxy did not start")


if __name__ == "__main__":
    unittest.main()
