"""The built server as a client sees it: start, requests, refusals, end."""

import concurrent.futures
import gzip
import json
import os
import select
import signal
import socket
import subprocess
import tempfile
import time
import unittest

from running_qdot import ENVIRONMENT, QDOT, SANITIZED, RunningQdot, answer

SIMULATE = json.dumps({"system": "spring_pendulum", "t_end": 1, "samples": 3})
FORM = {"Content-Type": "application/x-www-form-urlencoded"}  # what `curl -d` says
MEMBERS = {"type", "title", "status", "detail", "instance"}


class Served(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = RunningQdot("--threads", "2")

    @classmethod
    def tearDownClass(cls):
        cls.server.__exit__()

    def assert_problem(self, response, status):
        self.assertEqual(response.status, status, response.data[:300])
        self.assertEqual(response.getheader("Content-Type"), "application/problem+json")
        self.assertIsNone(response.getheader("EXCEPTION_WHAT"))
        body = json.loads(response.data)
        self.assertLessEqual(MEMBERS, body.keys())
        self.assertEqual(body["status"], status)
        self.assertRegex(body["type"], r"^/errors/[a-z0-9-]+$")
        self.assertTrue(response.data.endswith(b"}\n"))

    def test_start_line_says_where(self):
        self.assertEqual(json.loads(self.server.start_line),
                         {"listening": f"http://127.0.0.1:{self.server.port}", "port": self.server.port})

    def test_health(self):
        self.assertEqual(self.server.request("GET", "/healthz").status, 200)
        self.assertEqual(self.server.request("GET", "/readyz").status, 200)

    def test_one_connection_carries_many_requests(self):
        connection = self.server.connect()
        connection.connect()
        first = connection.sock
        for _ in range(300):
            self.assertEqual(answer(connection, "GET", "/v1/systems").status, 200)
            self.assertIs(connection.sock, first)
        connection.close()

    def test_more_idle_connections_than_threads_do_not_block(self):
        idle = [self.server.connect() for _ in range(100)]
        for connection in idle:
            connection.connect()
        self.assertEqual(self.server.request("GET", "/healthz").status, 200)
        for connection in idle:
            connection.close()

    def test_a_body_as_curl_sends_it(self):
        response = self.server.request("POST", "/v1/simulate", SIMULATE, FORM)
        self.assertEqual(response.status, 200, response.data)
        self.assertEqual(response.getheader("Content-Type"), "application/json")
        self.assertTrue(response.data.endswith(b"\n"))

    def test_the_same_question_has_the_same_bytes_in_any_thread(self):
        def ask(_):
            response = self.server.request_until_there_is_room("POST", "/v1/simulate", SIMULATE)
            return response.status, response.data

        with concurrent.futures.ThreadPoolExecutor(8) as pool:
            answers = set(pool.map(ask, range(64)))
        self.assertEqual([status for status, _ in answers], [200])

    def test_large_form_bodies_reach_the_reader_of_json(self):
        for size in (9 * 1024, 900 * 1024):
            with self.subTest(size=size):
                body = "{" * size
                response = self.server.request("POST", "/v1/simulate", body, FORM)
                self.assertIn(response.status, (400, 413, 422))
                self.assert_problem(response, response.status)

    def test_a_body_over_one_mebibyte_is_refused(self):
        response = self.server.request("POST", "/v1/simulate", "{" * (1024 * 1024 + 1), FORM)
        self.assert_problem(response, 413)

    def test_problems(self):
        cases = [("GET", "/no/such/path", None, 404), ("DELETE", "/v1/simulate", None, 405),
                 ("POST", "/v1/simulate", "{", 400), ("GET", "/v1/systems/no_such_system", None, 404),
                 ("GET", "/" + "a" * 9000, None, 414)]
        for method, target, body, status in cases:
            with self.subTest(method=method, target=target[:40]):
                self.assert_problem(self.server.request(method, target, body), status)

    def test_a_wrong_method_is_told_the_right_ones(self):
        self.assertIn("POST", self.server.request("DELETE", "/v1/simulate").getheader("Allow"))

    def test_refused_headers_are_problems(self):
        cases = [({"Transfer-Encoding": "chunked"}, 411), ({"Content-Encoding": "gzip"}, 415),
                 ({"Expect": "a-miracle"}, 417)]
        for headers, status in cases:
            with self.subTest(status=status):
                self.assert_problem(self.server.request("POST", "/v1/simulate", None, headers), status)

    def test_a_line_that_is_no_request_is_a_problem(self):
        with socket.create_connection(("127.0.0.1", self.server.port), timeout=60) as plain:
            plain.sendall(b"GARBAGE\r\n\r\n")
            received = b""
            while chunk := plain.recv(4096):
                received += chunk
        self.assertTrue(received.startswith(b"HTTP/1.1 400 "))
        self.assertIn(b"application/problem+json", received)

    def test_head_is_get_without_a_body(self):
        got = self.server.request("GET", "/v1/systems")
        head = self.server.request("HEAD", "/v1/systems")
        self.assertEqual((head.status, head.data), (200, b""))
        self.assertEqual(head.getheader("Content-Length"), got.getheader("Content-Length"))

    def test_range_and_unknown_encodings_change_nothing(self):
        plain = self.server.request("GET", "/v1/systems")
        asked = self.server.request("GET", "/v1/systems", headers={"Range": "bytes=0-3", "Accept-Encoding": "br"})
        self.assertEqual((asked.status, asked.data), (200, plain.data))

    def test_gzip_for_those_who_ask(self):
        plain = self.server.request("GET", "/v1/systems")
        asked = self.server.request("GET", "/v1/systems", headers={"Accept-Encoding": "br;q=1.0, gzip;q=0.8"})
        self.assertEqual(asked.getheader("Content-Encoding"), "gzip")
        self.assertLess(len(asked.data), len(plain.data))
        self.assertEqual(gzip.decompress(asked.data), plain.data)
        for response in (plain, asked):
            self.assertIn("Accept-Encoding", response.getheader("Vary"))
        refused = self.server.request("GET", "/v1/systems", headers={"Accept-Encoding": "gzip;q=0, *"})
        self.assertEqual(refused.data, plain.data)

    def test_an_unchanged_document_is_not_sent_again(self):
        for encoding in ("identity", "gzip"):
            first = self.server.request("GET", "/v1/systems", headers={"Accept-Encoding": encoding})
            again = self.server.request("GET", "/v1/systems", headers={"If-None-Match": first.getheader("ETag")})
            self.assertEqual((again.status, again.data), (304, b""))

    def test_timing_stands_in_a_header(self):
        timing = self.server.request("POST", "/v1/simulate", SIMULATE).getheader("Server-Timing")
        self.assertRegex(timing, r"^queue;dur=[0-9.]+, parse;dur=[0-9.]+, solve;dur=[0-9.]+, encode;dur=[0-9.]+$")

    def test_metrics(self):
        def value(name):
            lines = self.server.request("GET", "/metrics").data.decode().splitlines()
            return sum(float(line.split()[-1]) for line in lines if line.startswith(name))

        self.assertRegex(self.server.request("GET", "/metrics").getheader("Content-Type"), "^text/plain; version=0.0.4")
        answered = 'http_requests_total{method="POST",route="/v1/simulate",code="200"}'
        before = value(answered), value("qdot_evaluations_total"), value("http_request_duration_seconds_count")
        self.server.request("POST", "/v1/simulate", SIMULATE)
        self.assertEqual(value(answered), before[0] + 1)
        self.assertGreater(value("qdot_evaluations_total"), before[1] + 10)
        self.assertGreater(value("http_request_duration_seconds_count"), before[2])
        self.assertGreater(value("process_resident_memory_bytes"), 1e6)
        self.assertEqual(value("qdot_draining"), 0)
        self.server.request("GET", "/v1/systems/" + "x" * 100)
        self.assertNotIn(b"xxx", self.server.request("GET", "/metrics").data)

    def test_limits_are_published(self):
        limits = json.loads(self.server.request("GET", "/v1/limits").data)
        for name in ("body_bytes", "rows", "numbers", "evaluations", "integration_steps", "strides"):
            self.assertGreater(limits[name], 0)
        self.assertEqual(limits["atol"], {"above": 0, "at_most": 1})

    def test_request_id(self):
        sent = self.server.request("GET", "/healthz", headers={"X-Request-Id": "grade-7.b_C"})
        self.assertEqual(sent.getheader("X-Request-Id"), "grade-7.b_C")
        self.assertIn("grade-7.b_C", [line.get("id") for line in self.server.log_lines()])
        for bad in ("a b", "a" * 65, "<x>"):
            made = self.server.request("GET", "/healthz", headers={"X-Request-Id": bad})
            self.assertRegex(made.getheader("X-Request-Id"), r"^[0-9a-f]{16}$")


class Lifetime(unittest.TestCase):
    def test_sigterm_with_idle_connections_ends_with_0(self):
        for ending in (signal.SIGTERM, signal.SIGINT):
            with RunningQdot() as server:
                idle = server.connect()
                answer(idle, "GET", "/healthz")
                server.process.send_signal(ending)
                self.assertEqual(server.process.wait(timeout=60), 0)
                idle.close()

    def test_sigterm_lets_a_request_in_flight_finish(self):
        samples = 10000 if SANITIZED else 100000
        body = json.dumps({"system": "spring_pendulum", "t_end": 100, "samples": samples})
        with RunningQdot("--threads", "1") as server:
            connections = [server.connect() for _ in range(2)]
            for connection in connections:
                connection.request("POST", "/v1/simulate", body)
            time.sleep(0.1)  # read by the server, and not yet computed
            early = [bool(select.select([connection.sock], [], [], 0)[0]) for connection in connections]
            self.assertIn(False, early)
            server.process.terminate()
            for connection, answered in zip(connections, early):
                response = connection.getresponse()
                text = response.read()
                self.assertIn(response.status, (200, 503) if answered else (200,), text[:200])  # 503: no room for it
                json.loads(text)
                connection.close()
            self.assertEqual(server.process.wait(timeout=60), 0)

    def test_a_second_server_on_the_same_port_fails_and_says_why(self):
        with RunningQdot() as server:
            second = subprocess.run([QDOT, "serve", "--port", str(server.port)], capture_output=True, text=True,
                                    timeout=60, check=False, env=ENVIRONMENT)
            self.assertNotEqual(second.returncode, 0)
            self.assertIn("Address already in use", second.stderr)
            self.assertEqual(second.stdout, "")

    def test_flags_come_from_the_environment_too(self):
        with RunningQdot(QDOT_HOST="0.0.0.0", QDOT_THREADS="1", QDOT_ALLOWED_HOSTS="a.example,b.example:80",
                         QDOT_DEADLINE="3.5") as server:
            self.assertEqual(json.loads(server.start_line)["listening"], f"http://0.0.0.0:{server.port}")
            self.assertEqual(server.request("GET", "/healthz").status, 200)
            start = server.log_lines()[0]
            self.assertEqual((start["event"], start["threads"], start["deadline"]), ("start", 1, 3.5))
            self.assertEqual(start["allowed_hosts"], ["a.example", "b.example:80"])


class Strangers(unittest.TestCase):
    def test_names_and_origins(self):
        with RunningQdot("--allowed-hosts", "grader.example") as server:
            def status(**headers):
                return server.request("GET", "/v1/limits", headers=headers).status

            own = f"localhost:{server.port}"
            self.assertEqual(status(), 200)
            self.assertEqual(status(Host=own), 200)
            self.assertEqual(status(Host=f"[::1]:{server.port}"), 200)
            self.assertEqual(status(Host="grader.example"), 200)
            self.assertEqual(status(Host="evil.example"), 421)
            self.assertEqual(status(Host=f"localhost:{server.port + 1}"), 421)
            self.assertEqual(status(Host=own, Origin=f"http://{own}"), 200)
            self.assertEqual(status(Host=own, Origin="http://evil.example"), 403)
            answered = server.request("GET", "/v1/limits", headers={"Host": own, "Origin": f"http://{own}"})
            self.assertIsNone(answered.getheader("Access-Control-Allow-Origin"))

    def test_a_token(self):
        with RunningQdot(QDOT_TOKEN="open sesame") as server:
            refused = server.request("GET", "/v1/limits")
            self.assertEqual((refused.status, refused.getheader("WWW-Authenticate")), (401, "Bearer"))
            token = {"Authorization": "Bearer open sesame"}
            self.assertEqual(server.request("GET", "/v1/limits", headers=token).status, 200)
            self.assertEqual(server.request("GET", "/readyz").status, 200)
            self.assertEqual(server.request("GET", "/metrics").status, 401)
            self.assertNotIn("sesame", json.dumps(server.log_lines()))

    def test_a_unix_socket(self):
        with tempfile.TemporaryDirectory() as directory:
            path = os.path.join(directory, "qdot.sock")
            with RunningQdot(QDOT_UNIX_SOCKET=path, port=None) as server:
                self.assertEqual(json.loads(server.start_line), {"listening": f"unix:{path}", "unix_socket": path})
                self.assertEqual(os.stat(path).st_mode & 0o777, 0o600)
                self.assertEqual(subprocess.run([QDOT, "health", "--unix-socket", path], env=ENVIRONMENT).returncode, 0)
                server.process.kill()
                server.process.wait()
            self.assertEqual(subprocess.run([QDOT, "health", "--unix-socket", path], env=ENVIRONMENT).returncode, 6)
            with RunningQdot("--unix-socket", path) as server:  # what the killed one left is replaced
                self.assertEqual(server.request("GET", "/healthz").status, 200)
                self.assertEqual(subprocess.run([QDOT, "wait", "--unix-socket", path], env=ENVIRONMENT).returncode, 0)
            self.assertFalse(os.path.exists(path))


if __name__ == "__main__":
    unittest.main()
