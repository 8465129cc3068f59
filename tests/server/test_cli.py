"""The command line: the same bytes as over HTTP, and exit codes that scripts can rely on."""

import json
import pathlib
import re
import socket
import subprocess
import tempfile
import unittest

from running_qdot import ENVIRONMENT, QDOT, RunningQdot, qdot

REQUEST = {"system": "spring_pendulum", "t_end": 2, "samples": 5}
OK, USAGE, INVALID, FAILED, UNREACHABLE, UNWRITTEN = 0, 2, 3, 4, 6, 7


class SameBytes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = RunningQdot()

    @classmethod
    def tearDownClass(cls):
        cls.server.__exit__()

    def assert_same(self, run, response):
        self.assertEqual(response.status, 200, response.data)
        self.assertEqual((run.returncode, run.stderr), (OK, b""))
        self.assertEqual(run.stdout, response.data)

    def test_stdin_and_file_are_a_post(self):
        body = json.dumps(REQUEST)
        for command, request in (("simulate", body), ("energy", '{"system": "spring_pendulum"}'),
                                 ("equations", '{"system": "spring_pendulum"}')):
            with self.subTest(command=command), tempfile.NamedTemporaryFile("w") as file:
                file.write(request)
                file.flush()
                response = self.server.request("POST", f"/v1/{command}", request)
                self.assert_same(qdot(command, stdin=request), response)
                self.assert_same(qdot(command, "--request", "-", stdin=request), response)
                self.assert_same(qdot(command, "--request", file.name), response)

    def test_words_are_the_query_of_a_get(self):
        run = qdot("simulate", "system=spring_pendulum", "t_end=2", "theta=30 deg", "samples=5")
        response = self.server.request("GET", "/v1/simulate?system=spring_pendulum&t_end=2&theta=30%20deg&samples=5")
        self.assert_same(run, response)

    def test_pretty_and_format_are_part_of_the_query(self):
        words = ("system=spring_pendulum", "t_end=2", "samples=5")
        query = "/v1/simulate?" + "&".join(words)
        self.assert_same(qdot("simulate", *words, "--pretty"), self.server.request("GET", query + "&pretty"))
        self.assert_same(qdot("simulate", *words, "--format", "csv"), self.server.request("GET", query + "&format=csv"))

    def test_systems(self):
        self.assert_same(qdot("systems"), self.server.request("GET", "/v1/systems"))
        self.assert_same(qdot("systems", "collection=classics"), self.server.request("GET", "/v1/systems?collection=classics"))
        self.assert_same(qdot("systems", "spring_pendulum"), self.server.request("GET", "/v1/systems/spring_pendulum"))

    def test_a_problem_goes_to_stderr(self):
        run = qdot("systems", "no_such_system")
        self.assertEqual((run.returncode, run.stdout), (INVALID, b""))
        self.assertEqual(run.stderr, self.server.request("GET", "/v1/systems/no_such_system").data)


class ExitCodes(unittest.TestCase):
    def test_version_and_help(self):
        version = qdot("--version")
        self.assertEqual(version.returncode, OK)
        self.assertRegex(version.stdout.decode(), r"^qdot \d+\.\d+\.\d+\n$")
        self.assertEqual(qdot("--help").returncode, OK)
        self.assertEqual(qdot("simulate", "--help").returncode, OK)

    @staticmethod
    def fields(document, path):
        """Those of the query; where there is none, those of the body."""
        methods = document["paths"][path]
        if "get" in methods:
            return methods["get"]["parameters"]
        content = methods["post"]["requestBody"]["content"]
        if "application/json" in content:
            schema = content["application/json"]["schema"]["$ref"].rsplit("/", 1)[1]
        else:  # each line is one of the body's
            schema = re.search(r"each an? (\w+) in JSON", content["application/x-ndjson"]["schema"]["description"]).group(1)
        properties = document["components"]["schemas"][schema]["properties"]
        return [{"name": name, "description": field["description"]} for name, field in properties.items()]

    def test_help_of_a_command_explains_every_field(self):
        document = json.loads(qdot("openapi").stdout)
        paths = [path for path, methods in document["paths"].items() if "post" in methods and "." not in path]
        self.assertGreaterEqual(len(paths), 9)
        for path in paths:
            text = " ".join(qdot(path.removeprefix("/v1/"), "--help").stdout.decode().split())
            for parameter in self.fields(document, path):
                if "name" in parameter:
                    with self.subTest(path=path, field=parameter["name"]):
                        meaning = parameter["description"].split("; each stands alone")[0].split(" (default ")[0]
                        self.assertIn(f" {parameter['name']} {meaning} (", text)
        self.assertIn("(number in s > 0)", qdot("simulate", "--help").stdout.decode())

    def test_usage(self):
        for arguments in ([], ["no_such_command"], ["simulate", "--no-such-option"], ["simulate", "system=x", "no_equals_sign"],
                          ["simulate", "=value"], ["simulate", "--request", "/no/such/file"],
                          ["simulate", "system=x", "--request", "-"], ["systems", "one", "two"],
                          ["serve", "--port", "65536"], ["serve", "--threads", "0"],
                          *([*command, dashes] for dashes in ("---", "----", "---x", "--=", "-=", "---=1")
                            for command in ([], ["serve"], ["systems"], ["batch"], ["modes", "cart_pendulum"]))):
            with self.subTest(arguments=arguments):
                run = qdot(*arguments)
                self.assertEqual((run.returncode, run.stdout), (USAGE, b""))
                self.assertNotEqual(run.stderr, b"")

    def test_a_variable_of_the_environment_is_named_where_it_is_wrong_and_matters_nowhere_else(self):
        # What the kubelet sets in every pod beside a Service named qdot.
        environment = {**ENVIRONMENT, "QDOT_PORT": "tcp://10.96.0.12:80", "QDOT_THREADS": "many"}
        for command, code, said in ((["serve"], USAGE, "qdot: QDOT_PORT in the environment is wrong"),
                                    (["serve", "--port", "0"], USAGE, "qdot: QDOT_THREADS in the environment is wrong"),
                                    (["serve", "--port", "x"], USAGE, "--port: "), (["health"], USAGE, "qdot: QDOT_PORT"),
                                    (["modes", "cart_pendulum"], OK, ""), (["manual"], OK, "")):
            with self.subTest(command=command):
                run = subprocess.run([QDOT, *command], capture_output=True, text=True, check=False, timeout=60, env=environment)
                self.assertEqual(run.returncode, code, run.stderr)
                self.assertTrue(run.stderr.startswith(said), run.stderr)
        self.assertIn("QDOT_PORT", qdot("manual").stdout.decode())

    def test_invalid_requests(self):
        for stdin in ("", "{", '{"system": "no_such_system"}', '{"system": "spring_pendulum", "kk": 1}'):
            with self.subTest(stdin=stdin):
                run = qdot("simulate", stdin=stdin)
                self.assertEqual((run.returncode, run.stdout), (INVALID, b""))
                self.assertIn("type", json.loads(run.stderr))

    def test_a_failed_computation(self):
        run = qdot("simulate", "system=spring_pendulum", "l=1e150", "t_end=1")
        self.assertEqual((run.returncode, run.stdout), (FAILED, b""))
        self.assertEqual(json.loads(run.stderr)["type"], "/errors/integration-failed")

    def test_an_answer_that_cannot_be_written(self):
        line = '{"id": 1, "modes": {"system": "cart_pendulum"}}'
        for command in (["modes", "cart_pendulum"], ["systems"], ["openapi"], ["manual"], ["--help"], ["batch"]):
            with self.subTest(command=command), open("/dev/full", "wb") as full:
                run = subprocess.run([QDOT, *command], input=line.encode(), stdout=full, stderr=subprocess.PIPE, check=False, timeout=60)
                self.assertEqual(run.returncode, UNWRITTEN)
                self.assertRegex(run.stderr, b"cannot write the answers?: No space left")

    def test_scenes_that_cannot_be_used(self):
        run = qdot("systems", "--scenes", "/nowhere")
        self.assertEqual((run.returncode, run.stdout), (USAGE, b""))
        with tempfile.TemporaryDirectory() as directory:
            (pathlib.Path(directory) / "mine.json").write_text('{"name": "mine"')
            run = qdot("systems", "--scenes", directory)
        self.assertEqual((run.returncode, run.stdout), (USAGE, b""))
        self.assertIn(b"mine.json", run.stderr)

    def test_health_and_wait(self):
        with RunningQdot() as server:
            self.assertEqual(qdot("health", "--port", str(server.port)).returncode, OK)
            self.assertEqual(qdot("health", QDOT_PORT=str(server.port), QDOT_HOST="0.0.0.0").returncode, OK)
            self.assertEqual(qdot("wait", "--port", str(server.port), "--timeout", "30").returncode, OK)

    def test_nobody_there(self):
        with socket.socket() as bound:  # bound and not listening: nobody else takes the port, nobody answers
            bound.bind(("127.0.0.1", 0))
            port = str(bound.getsockname()[1])
            self.assertEqual(qdot("health", "--port", port).returncode, UNREACHABLE)
            self.assertEqual(qdot("wait", "--port", port, "--timeout", "0.2").returncode, UNREACHABLE)


if __name__ == "__main__":
    unittest.main()
