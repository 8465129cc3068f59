"""Dask spreads a file of requests over its workers, one of which is killed: the answers have one machine's bytes."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "server"))

import one_machine  # noqa: E402
from ports import free_ports  # noqa: E402
from running_qdot import QDOT  # noqa: E402

PROGRAM = pathlib.Path(__file__).with_name("dask_batch.py")
LINES, SLICE = 200, 10


@unittest.skipIf(shutil.which("dask-scheduler") is None, "dask not installed: run server/install scale")
class Dask(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory()
        cls.home = pathlib.Path(cls.directory.name)
        one_machine.write_motions(cls.home / "requests.ndjson", LINES, t_end=300)
        cls.expected = one_machine.answers(cls.home / "requests.ndjson")

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    def start(self, *command, **options):
        process = subprocess.Popen(command, cwd=self.home, stderr=subprocess.DEVNULL, **options)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def program(self, *words):
        return self.start("/usr/bin/python3", PROGRAM, "requests.ndjson", "answers.ndjson", "--program", QDOT, "--slice",
                          str(SLICE), *words)

    def assert_all_answered(self):
        self.assertEqual((self.home / "answers.ndjson").read_bytes(), self.expected)

    def test_workers_of_this_machine(self):
        self.assertEqual(self.program().wait(120), 0)
        self.assert_all_answered()

    def test_a_worker_or_a_task_is_killed_and_nothing_lost(self):
        port, = free_ports(1)
        address = f"tcp://127.0.0.1:{port}"
        self.start("dask-scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard")
        workers = [self.start("dask-worker", address, "--no-nanny", "--nthreads", "1", "--no-dashboard",
                              "--local-directory", str(self.home / name)) for name in ("one", "two")]
        program = self.program("--scheduler", address)
        os.kill(self.task_of(workers[1]), signal.SIGKILL)
        self.task_of(workers[0])
        workers[0].kill()
        self.assertIsNone(program.poll())
        self.assertEqual(program.wait(120), 0)
        self.assert_all_answered()

    def test_what_fails_leaves_the_answers_of_before(self):
        (self.home / "answers.ndjson").write_bytes(b"before")
        self.assertNotEqual(self.program("--program", "no_such_program").wait(120), 0)
        self.assertEqual((self.home / "answers.ndjson").read_bytes(), b"before")

    def task_of(self, worker):
        """A process of the program below the worker."""
        end = time.monotonic() + 60
        while time.monotonic() < end:
            found = subprocess.run(["pgrep", "-P", str(worker.pid), "qdot"], stdout=subprocess.PIPE, check=False).stdout.split()
            if found:
                return int(found[0])
            time.sleep(0.01)
        return self.fail("no task came to a worker")


if __name__ == "__main__":
    unittest.main()
