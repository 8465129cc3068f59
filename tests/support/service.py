"""What the tests of answers share: a served qdot for a class of tests, requests with a limit on patience, scenes."""

import http.client
import json
import pathlib
import sys
import time
import unittest
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests" / "server"))

from running_qdot import RunningQdot, answer  # noqa: E402  (its directory had to be named first)

PATIENCE = 90  # seconds; an answer that takes longer counts as a hang: the others of this machine go first
REFERENCE = ROOT / "tests" / "reference"


def textbook_scene(name):
    return json.loads((REFERENCE / "scenes" / f"{name}.json").read_text(encoding="utf-8"))


TEXTBOOK = sorted(file.stem for file in (REFERENCE / "scenes").glob("*.json"))


def reference_cases(*quantities):
    for file in sorted(REFERENCE.glob("*.json")):
        for case in json.loads(file.read_text(encoding="utf-8"))["cases"]:
            if case["quantity"] in quantities:
                yield case


def no_constant(text):
    raise AssertionError(f"{text} is not JSON")


def strict_json(data):
    """The value of a text of JSON, in which NaN, Infinity and members that appear twice are mistakes."""

    def members(pairs):
        result = dict(pairs)
        assert len(result) == len(pairs), "a member appears twice"
        return result

    return json.loads(data, parse_constant=no_constant, object_pairs_hook=members)


def numbers_in(value):
    """Every number of a JSON value, however deep."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        for entry in value:
            yield from numbers_in(entry)
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        yield value


class Service(unittest.TestCase):
    """One server for all tests of a class."""

    arguments = ("--threads", "2")

    @classmethod
    def setUpClass(cls):
        cls.server = RunningQdot("--deadline", "80", *cls.arguments)  # what it says matters here, not how soon

    @classmethod
    def tearDownClass(cls):
        cls.server.__exit__()

    def raw(self, method, target, body=None, headers=None):
        """The response, its body in `.data`; no answer within PATIENCE is an error."""
        connection = http.client.HTTPConnection("127.0.0.1", self.server.port, timeout=PATIENCE)
        try:
            return answer(connection, method, target, body, headers)
        finally:
            connection.close()

    def post(self, endpoint, request):
        """The response to a request, sent as it is or written as JSON."""
        body = request if isinstance(request, (str, bytes)) else json.dumps(request)
        return self.raw("POST", f"/v1/{endpoint}", body, {"Content-Type": "application/json"})

    def post_until_there_is_room(self, endpoint, request):
        """As post, asking again where the server is too busy, as Retry-After tells a client to."""
        for _ in range(PATIENCE):
            response = self.post(endpoint, request)
            if response.status != 503:
                break
            time.sleep(1)
        return response

    def get(self, endpoint, query):
        return self.raw("GET", f"/v1/{endpoint}?{urllib.parse.urlencode(query)}")

    def ask(self, endpoint, request):
        """The answer to a request that is in order."""
        response = self.post(endpoint, request)
        self.assertEqual(response.status, 200, response.data[:600])
        self.assertEqual(response.getheader("Content-Type"), "application/json")
        return strict_json(response.data)

    def refused(self, endpoint, request, status=422):
        """The problem that answers a request that is not in order."""
        response = self.post(endpoint, request)
        self.assertEqual(response.status, status, response.data[:600])
        self.assertEqual(response.getheader("Content-Type"), "application/problem+json")
        return strict_json(response.data)

    def refused_at(self, endpoint, request, *pointers):
        """As refused, with exactly these mistakes."""
        problem = self.refused(endpoint, request)
        self.assertEqual(sorted({error["pointer"] for error in problem["errors"]}), sorted(pointers), problem)
        return problem
