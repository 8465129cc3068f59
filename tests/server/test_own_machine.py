"""The command line computes what a service would refuse, tells how far it is, and ends when it is told to."""

import json
import os
import pty
import resource
import select
import signal
import subprocess
import tempfile
import time
import unittest

from running_qdot import ENVIRONMENT, QDOT, SANITIZED, RunningQdot, qdot

OK, INVALID, STOPPED = 0, 3, 128
# Of each: the command, its words, and how --bounded refuses it.
BEYOND = [("simulate", ["rolling_disk_platform", "method=gauss", "h=1e-4", "t_end=26", "samples=2", "verify=false"], INVALID),
          ("simulate", ["rolling_disk_platform", "t_end=1", "samples=100001", "verify=false"], INVALID),
          ("simulate", ["rolling_disk_platform", "t_end=1", "dt=1e-5", "verify=false"], INVALID),
          ("sweep", ["spring_pendulum", "ask=energy", "vary=k", "from=1", "to=2", "count=10001", "collect=/V"], INVALID)]
ENDLESS = ["spring_pendulum", "t_end=1e8", "samples=2"]
# Over the top and on: no turning point, and no end of looking for one.
TURNING = ["forced_spring_pendulum", "F=sin(t)", "theta_dot=30", "coordinate=theta", "t_end=1e7"]


class OwnMachine(unittest.TestCase):
    def test_work_and_rows_have_no_bounds_of_a_service(self):
        for command, words, refused in BEYOND:
            with self.subTest(command=command, words=words):
                self.assertEqual(qdot(command, *words).returncode, OK)
                self.assertEqual(qdot(command, *words, "--bounded").returncode, refused)

    def test_a_service_has_them(self):
        with RunningQdot("--deadline", "60") as server:
            for command, words, _ in BEYOND:
                query = "&".join(["system=" + words[0], *words[1:]])
                self.assertEqual(server.request("GET", f"/v1/{command}?{query}").status, 422)

    def test_lines_of_a_batch_neither(self):
        line = json.dumps({"simulate": {"system": "rolling_disk_platform", "t_end": 1, "samples": 100001, "verify": False,
                                        "format": "csv"}})
        self.assertEqual(json.loads(qdot("batch", stdin=line).stdout)["status"], 200)
        self.assertEqual(json.loads(qdot("batch", "--bounded", stdin=line).stdout)["status"], 422)

    @unittest.skipIf(SANITIZED, "a sanitizer's own memory is beyond any bound")
    def test_what_no_memory_holds_is_refused_as_that(self):
        gibibyte = 2**30
        for command, words in (("sweep", ["spring_pendulum", "ask=energy", "vary=k", "from=1", "to=2", "count=100000000", "collect=/V"]),
                               ("simulate", ["rolling_disk_platform", "t_end=1", "samples=33000000", "verify=false"])):
            with self.subTest(command=command):
                ended = subprocess.run([QDOT, command, *words], capture_output=True, timeout=60, check=False, env=ENVIRONMENT,
                                       preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (gibibyte, gibibyte)))
                problem = json.loads(ended.stderr)
                self.assertEqual((ended.returncode, problem["status"]), (INVALID, 422))
                self.assertIn("too little memory", problem["detail"])


def listen_to_signals():
    """A shell's background ignores Ctrl-C, and what it starts would go on ignoring it."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


class Ending(unittest.TestCase):
    def stopped(self, *command, by=signal.SIGINT, megabytes=10_000):
        """What is said on stdout and stderr by a command that is interrupted after a second's work."""
        process = subprocess.Popen([QDOT, *command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=ENVIRONMENT,
                                   preexec_fn=listen_to_signals)
        time.sleep(10 if SANITIZED else 1)
        with open(f"/proc/{process.pid}/status", encoding="ascii") as status:
            resident = next(int(line.split()[1]) for line in status if line.startswith("VmHWM:")) / 1024
        process.send_signal(by)
        sent = time.monotonic()
        answer, said = process.communicate(timeout=60)
        self.assertLess(time.monotonic() - sent, 50 if SANITIZED else 5)
        self.assertEqual(process.returncode, STOPPED + by, said)
        self.assertLess(resident, megabytes)
        return answer, said.decode()

    def test_control_c_ends_with_a_sentence(self):
        for command in (["simulate", *ENDLESS], ["turning_points", *TURNING]):
            with self.subTest(command=command[0]):
                answer, said = self.stopped(*command)
                self.assertEqual(answer, b"")
                self.assertRegex(said, r"^Stopped after \d+ s; there is no answer\.\n$")

    def test_a_hundred_million_rows_end_as_soon_and_take_no_memory_before_they_are_asked(self):
        rows = 100_000_000
        one = ["vary=k", "from=1", "to=50", f"count={rows}"]
        sample = json.dumps({"ask": {"energy": {"system": "cart_pendulum"}}, "vary": {"k": {"normal": [10, 1]}}, "count": rows,
                             "collect": ["/V"]})
        for words in (["cart_pendulum", "ask=energy", *one, "collect=/V", "--format", "csv"],
                      ["cart_pendulum", "ask=energy", *one, "spacing=log", "collect=/V"], [sample]):
            with self.subTest(words=words):
                self.stopped("sweep", *words, megabytes=1000 if SANITIZED else 200)
        self.stopped("simulate", "spring_pendulum", "t_end=1", f"samples={rows}")

    def test_control_c_leaves_the_rows_of_a_sweep_that_were_asked(self):
        """They are those of the same sweep, asked for so many."""
        ask = {"ask": {"simulate": {"system": "spring_pendulum", "t_end": 1000, "samples": 2}},
               "collect": {"l": "/trajectory/l/1"}}
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            json.dump({**ask, "vary": {"k": {"from": 10, "to": 50, "count": 100_000}}}, file)
            file.flush()
            answers = [self.stopped("sweep", "--request", file.name, by=by) for by in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)]
        for answer, said in answers:
            self.assertRegex(said, r"^Stopped after \d+ s\.\n$")
            answer = json.loads(answer)
            rows = answer["rows"]
            self.assertTrue(0 < rows < 100_000)
            self.assertIn(f"first {rows} of 100000 rows", answer["notes"][-1])
            asked = json.loads(qdot("sweep", stdin=json.dumps({**ask, "vary": {"k": {"values": answer["columns"]["k"]}}})).stdout)
            self.assertEqual((answer["columns"], answer["failed"]), (asked["columns"], []))

    def test_what_is_ignored_stays_ignored(self):
        """As a shell's background ignores Ctrl-C."""
        for command in (["simulate", *ENDLESS], ["batch", "--output", os.devnull]):
            with self.subTest(command=command[0]):
                process = subprocess.Popen([QDOT, *command], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, env=ENVIRONMENT,
                                           stderr=subprocess.DEVNULL, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN))
                time.sleep(10 if SANITIZED else 1)
                process.send_signal(signal.SIGINT)
                time.sleep(1)
                self.assertIsNone(process.poll())
                process.kill()
                process.communicate(timeout=20)

    def test_a_file_that_may_not_grow_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            ended = subprocess.run([QDOT, "batch", "--output", os.path.join(folder, "out")], input=b'{"modes": {"system": "cart_pendulum"}}\n'*20,
                                   capture_output=True, timeout=60, check=False, env=ENVIRONMENT,
                                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096)))
        self.assertEqual(ended.returncode, 7, ended.stderr)
        self.assertTrue(ended.stderr)

    def test_a_terminal_is_told_how_far_it_is(self):
        words = ["spring_pendulum", "ask=simulate", "t_end=100", "samples=2", "vary=k", "from=10", "to=50", "count=100000",
                 "collect=/trajectory/l/1"]
        for command, told in ((["sweep", *words], rb"computing, \d+ s, \d+ of 100000 rows, about \d+ s left"),
                              (["simulate", *ENDLESS], rb"computing, \d+ s")):
            terminal, its_end = pty.openpty()
            process = subprocess.Popen([QDOT, *command], stdout=subprocess.DEVNULL, stderr=its_end, env=ENVIRONMENT,
                                       preexec_fn=listen_to_signals)
            os.close(its_end)
            text, deadline = b"", time.monotonic() + 20
            while text.count(b"computing") < 2 and time.monotonic() < deadline:
                if select.select([terminal], [], [], 1)[0]:
                    text += os.read(terminal, 4096)
            process.send_signal(signal.SIGINT)
            process.wait(20)
            os.close(terminal)
            self.assertRegex(text, told)


if __name__ == "__main__":
    unittest.main()
