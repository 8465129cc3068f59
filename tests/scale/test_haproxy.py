"""Three replicas behind HAProxy are restarted and killed one by one while requests come: each gets its answer."""

import csv
import http.client
import json
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "server"))

from ports import free_ports  # noqa: E402
from running_qdot import RunningQdot, qdot  # noqa: E402

CONFIGURATION = pathlib.Path(__file__).with_name("haproxy.cfg").read_text()
PATIENCE = 300  # s: what is lost must not depend on how busy this machine is, and a deadline is not what is tested
LIGHT = [("modes", {"system": "cart_pendulum", "parameters": {"k": k}}) for k in range(10, 30)]
LARGE = [("batch", "".join(json.dumps({"id": k, "energy": {"system": "spring_pendulum", "parameters": {"k": k}}}) + " " * 900 + "\n"
                           for k in range(1, 601)))]  # more than half a megabyte
LONG = [("simulate", {"system": "spring_pendulum", "parameters": {"k": k}, "t_end": 3000, "samples": 5}) for k in range(20, 24)]


def body(request):
    return request if isinstance(request, str) else json.dumps(request)


class Asking(threading.Thread):
    """Asks questions by turns, at a pace, on one connection, until it is told to stop."""

    def __init__(self, port, questions, gap):
        super().__init__()
        self.port, self.questions, self.gap = port, questions, gap
        self.expected = [qdot(name, stdin=body(request)).stdout for name, request in questions]
        self.sent, self.lost = 0, []
        self.stopped = threading.Event()

    def run(self):
        connection = http.client.HTTPConnection("localhost", self.port, timeout=PATIENCE)
        while not self.stopped.wait(self.gap):
            which = self.sent % len(self.questions)
            name, request = self.questions[which]
            self.sent += 1
            try:
                kind = "application/x-ndjson" if name == "batch" else "application/json"
                connection.request("POST", f"/v1/{name}", body(request), {"Content-Type": kind})
                response = connection.getresponse()
                answer = response.read()
                if (response.status, answer) != (200, self.expected[which]):
                    self.lost.append((response.status, answer[:200]))
            except (OSError, http.client.HTTPException) as error:
                self.lost.append(repr(error))
                connection.close()
        connection.close()

    def stop(self):
        self.stopped.set()
        self.join()


@unittest.skipIf(shutil.which("haproxy") is None, "haproxy not installed: run server/install scale")
class HaProxy(unittest.TestCase):
    def setUp(self):
        self.front, *self.ports = free_ports(4)
        self.replicas = [self.replica(port) for port in self.ports]
        self.addCleanup(lambda: [replica.__exit__() for replica in self.replicas])
        ports = dict(zip(("18080", "18081", "18082", "18083"), map(str, [self.front, *self.ports])))
        file = tempfile.NamedTemporaryFile("w", suffix=".cfg")
        self.addCleanup(file.close)
        self.statistics = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "statistics"
        patient = re.sub(r"timeout (client|server|queue) \d+s", f"timeout \\1 {PATIENCE}s", CONFIGURATION)
        patient = patient.replace("global\n", f"global\n    stats socket {self.statistics}\n")
        file.write(re.sub(r"\b1808\d\b", lambda port: ports[port.group()], patient))
        file.flush()
        process = subprocess.Popen(["haproxy", "-f", file.name], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.terminate)
        self.wait_until_it_answers(self.front)

    def replica(self, port):
        """Where one was killed, the port may be taken for a moment still."""
        for _ in range(100):
            server = RunningQdot("--allowed-hosts", f"localhost:{self.front}", "--deadline", str(PATIENCE), port=port)
            if server.port is not None:
                return server
            server.__exit__()
            time.sleep(0.1)
        self.fail(f"no replica could take port {port}")

    def wait_until_it_answers(self, port):
        for _ in range(100):
            try:
                connection = http.client.HTTPConnection("localhost", port, timeout=5)
                connection.request("GET", "/readyz")
                if connection.getresponse().status == 200:
                    return
            except OSError:
                pass
            finally:
                connection.close()
            time.sleep(0.1)
        self.fail(f"nothing answers at port {port}")

    def restart(self, which, end):
        end(self.replicas[which].process)
        self.replicas[which].__exit__()
        self.replicas[which] = self.replica(self.ports[which])
        self.wait_until_seen(f"q{which + 1}")

    def wait_until_seen(self, name):
        """Until HAProxy has looked at the new replica: it does so five times a second."""
        for _ in range(10 * PATIENCE):
            time.sleep(0.1)
            with socket.socket(socket.AF_UNIX) as asking:
                asking.connect(str(self.statistics))
                asking.sendall(b"show stat\n")
                rows = csv.DictReader(asking.makefile())
                if any(row["svname"] == name and row["status"] == "UP" for row in rows):
                    return
        self.fail(f"HAProxy does not see {name}")

    def lost_while(self, work):
        # There are always long ones on their way, so that a replica that ends has something to finish or to lose.
        asking = [Asking(self.front, questions, gap) for questions, gap in ((LIGHT, 0.02), (LARGE, 0), (LARGE, 0), (LONG, 0), (LONG, 0))]
        for each in asking:
            each.start()
        try:
            work()
            while sum(each.sent for each in asking) <= 50 and all(each.is_alive() for each in asking):
                time.sleep(0.1)
        finally:
            for each in asking:
                each.stop()
        return [lost for each in asking for lost in each.lost]

    def test_a_rolling_restart_loses_nothing(self):
        lost = self.lost_while(lambda: [self.restart(which, lambda process: process.terminate()) for which in (0, 1, 2, 0)])
        self.assertEqual(lost, [])

    def test_replicas_that_die_lose_nothing(self):
        lost = self.lost_while(lambda: [self.restart(which, lambda process: process.kill()) for which in (0, 1, 2, 0)])
        self.assertEqual(lost, [])

    def in_flight(self):
        texts = []
        for port in self.ports:
            connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE)
            connection.request("GET", "/metrics", headers={"Host": f"localhost:{self.front}"})
            texts.append(connection.getresponse().read().decode())
            connection.close()
        return sum(int(number) for text in texts for number in re.findall(r'qdot_in_flight{lane="(?:heavy|lengthy)"} (\d+)', text))

    def test_what_nobody_waits_for_ends(self):
        lines = "".join(json.dumps({"simulate": dict(LONG[0][1], parameters={"k": k})}) + "\n" for k in range(1, 601))
        connection = http.client.HTTPConnection("localhost", self.front, timeout=PATIENCE)
        connection.request("POST", "/v1/batch", lines, {"Content-Type": "application/x-ndjson"})
        self.wait_for(lambda: self.in_flight() > 0)
        connection.close()
        self.wait_for(lambda: self.in_flight() == 0)

    def wait_for(self, holds):
        for _ in range(100):
            if holds():
                return
            time.sleep(0.1)
        self.fail("not within ten seconds")


if __name__ == "__main__":
    unittest.main()
