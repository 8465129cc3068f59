"""GET /openapi.json: it is linted, its examples are executed on both roads, and the tests of answers can fail."""

import json
import pathlib
import sys
import tempfile
import unittest
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.extend([str(ROOT / "tests" / "support"), str(ROOT / "tests" / "server")])

from node import node, require_packages  # noqa: E402
from running_qdot import qdot  # noqa: E402
from service import Service  # noqa: E402

# The rule that is off does not see the properties beside an applicator: {"properties": ..., "not": {"required": ...}}.
LINT_RULES = {"extends": ["recommended-strict"], "rules": {"no-required-schema-properties-undefined": "off"}}


def flattened(body):
    """The query that says what a body says."""
    query = {}
    for name, value in body.items():
        if name in ("equilibrium", "at"):
            query.update({f"{name}.{symbol}": v for symbol, v in value.items()})
        elif isinstance(value, dict):
            query.update(value)
        elif isinstance(value, list):
            query[name] = ",".join(str(v) for v in value)
        else:
            query[name] = str(value).lower() if isinstance(value, bool) else value
    return urllib.parse.urlencode(query)


class Document(Service):
    @classmethod
    def setUpClass(cls):
        require_packages()
        super().setUpClass()
        cls.document = json.loads(cls.raw(cls, "GET", "/openapi.json").data)

    def examples(self):
        for path, methods in self.document["paths"].items():
            content = methods.get("post", {}).get("requestBody", {}).get("content", {})
            for example in content.get("application/json", {}).get("examples", {}).values():
                yield path, example["value"]

    def test_examples_on_both_roads(self):
        count = 0
        for path, body in self.examples():
            with self.subTest(path=path, body=body):
                answer = self.raw("POST", path, json.dumps(body), {"Content-Type": "application/json"})
                self.assertEqual(answer.status, 200, answer.data[:300])
                count += 1
                if "get" not in self.document["paths"][path] or path.startswith("/v1/sweep"):  # of one variable: test_sweep.py
                    continue
                twin = self.raw("GET", f"{path}?{flattened(body)}")
                self.assertEqual(twin.data, answer.data)
        self.assertGreaterEqual(count, 20)

    def test_operations_without_fields(self):
        for path, methods in self.document["paths"].items():
            captures = {"{name}": "overloaded" if path.startswith("/errors") else self.first_system(), "{number}": "8", "{file}": "style.css"}
            for capture, value in captures.items():
                path = path.replace(capture, value)
            if "post" not in methods:
                with self.subTest(path=path):
                    self.assertEqual(self.raw("GET", path).status, 200)

    def first_system(self):
        return self.document["components"]["schemas"]["SystemName"]["enum"][0]

    def test_is_what_the_command_prints(self):
        printed = qdot("openapi")
        self.assertEqual(printed.returncode, 0, printed.stderr)
        # A server has addresses that the program alone has not: pages and metrics.
        document = json.loads(printed.stdout)
        self.assertEqual(document["components"]["schemas"], self.document["components"]["schemas"])
        self.assertLess(set(document["paths"]), set(self.document["paths"]))

    def test_has_no_findings_of_the_linter(self):
        with tempfile.TemporaryDirectory() as directory:
            file = pathlib.Path(directory, "openapi.json")
            file.write_text(json.dumps(self.document))
            rules = pathlib.Path(directory, "redocly.yaml")
            rules.write_text(json.dumps(LINT_RULES))
            lint = node("@redocly/cli/bin/cli.js", "lint", str(file), "--config", str(rules), "--format", "json")
            self.assertEqual(lint.returncode, 0, lint.stdout[:3000] + lint.stderr[-500:])

    def test_validation_can_fail(self):
        exchange = {"method": "GET", "target": "/version", "request": None, "status": 200, "type": "application/json",
                    "answer": '{"service_version": "1"}'}
        request = {"method": "POST", "target": "/v1/modes", "status": 200, "type": "text/csv", "answer": ""}
        wrong = [{**exchange, "answer": '{"service_version": 1}'}, {**exchange, "answer": '{"service_version": "1", "b": 2}'},
                 {**exchange, "answer": "{}"}, {**exchange, "status": 202}, {**exchange, "type": "text/html"},
                 {**request, "request": '{"system": 1}'}, {**request, "request": '{"system": "none", "x": 1}'}]
        self.assertEqual(self.mistakes([exchange]), "1 answers validated, 0 mistakes")
        for one in wrong:
            with self.subTest(exchange=one):
                self.assertRegex(self.mistakes([one]), "1 answers validated, [12] mistakes$")

    def mistakes(self, exchanges):
        with tempfile.TemporaryDirectory() as directory:
            document, recording = (pathlib.Path(directory, name) for name in ("openapi.json", "recording.ndjson"))
            document.write_text(json.dumps(self.document))
            recording.write_text("\n".join(json.dumps(exchange) for exchange in exchanges))
            return node(ROOT / "tests/openapi/validate.mjs", str(document), str(recording)).stdout.strip().splitlines()[-1]


if __name__ == "__main__":
    unittest.main()
