"""A qdot server for the length of a test, and the command line as a function."""

import atexit
import gzip
import http.client
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
QDOT = os.environ.get("QDOT_BINARY", str(ROOT / "build" / "release" / "qdot"))
SANITIZED = "asan" in QDOT or "tsan" in QDOT  # their memory is not ours, and they are ten times slower
# A developer's own settings must not reach the tests.
ENVIRONMENT = {k: v for k, v in os.environ.items() if not k.startswith("QDOT_")}


# A directory: what is asked and answered is written there, and tests/openapi holds it against the document.
RECORDINGS = os.environ.get("QDOT_RECORDINGS")


class RunningQdot:
    """`with RunningQdot() as server:` serves on a free port; leaving it sends SIGTERM to that process only."""

    def __init__(self, *arguments, port=0, **environment):
        self.log = tempfile.TemporaryFile(mode="w+")
        address = [] if port is None else ["--port", str(port)]
        self.process = subprocess.Popen([QDOT, "serve", *address, *arguments], stdout=subprocess.PIPE,
                                        stderr=self.log, text=True, env={**ENVIRONMENT, **environment})
        self.start_line = self.process.stdout.readline()
        self.port = json.loads(self.start_line).get("port") if self.start_line else None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.terminate()
        self.process.wait(timeout=60)
        self.process.stdout.close()
        self.log.close()

    def connect(self):
        return http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)

    def request(self, method, target, body=None, headers=None):
        """The response of one request on its own connection, with its body in `.data`."""
        connection = self.connect()
        try:
            return answer(connection, method, target, body, headers)
        finally:
            connection.close()

    def request_until_there_is_room(self, *request):
        """As request, asking again where the server is too busy, as Retry-After tells a client to."""
        for _ in range(60):
            response = self.request(*request)
            if response.status != 503:
                break
            time.sleep(0.5)
        return response

    def log_lines(self):
        self.log.seek(0)
        return [json.loads(line) for line in self.log]


def answer(connection, method, target, body=None, headers=None):
    connection.request(method, target, body, headers or {})
    response = connection.getresponse()
    response.data = response.read()
    if RECORDINGS:
        record(method, target, body, response)
    return response


recording = threading.Lock()
recorded = None


def text_of(data):
    return data.decode("utf-8", "replace") if isinstance(data, bytes) else data


def record(method, target, body, response):
    global recorded
    packed = response.getheader("Content-Encoding") == "gzip" and response.data
    exchange = {"method": method, "target": target, "request": text_of(body), "status": response.status,
                "type": (response.getheader("Content-Type") or "").split(";")[0],
                "answer": text_of(gzip.decompress(response.data) if packed else response.data)}
    with recording:
        if recorded is None:
            os.makedirs(RECORDINGS, exist_ok=True)
            name = pathlib.Path(sys.argv[0]).stem + ".ndjson"
            recorded = open(os.path.join(RECORDINGS, name), "w", encoding="utf-8")
            atexit.register(recorded.close)
        recorded.write(json.dumps(exchange) + "\n")


def qdot(*arguments, stdin="", **environment):
    """Runs one command to its end: returncode, stdout and stderr as bytes."""
    return subprocess.run([QDOT, *arguments], input=stdin.encode(), capture_output=True, timeout=180, check=False,
                          env={**ENVIRONMENT, **environment})
