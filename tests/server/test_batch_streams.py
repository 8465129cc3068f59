"""qdot batch writes to a pipe or a device as to stdout, and no command takes a file for a standard stream."""

import contextlib
import os
import pathlib
import random
import signal
import subprocess
import time
import unittest

from running_qdot import ENVIRONMENT, QDOT, SANITIZED, qdot
from test_batch import QUESTIONS, Batch, line, lines

MORE_THAN_A_PIPE_HOLDS = 400  # lines have answers of some 2 kB


def shell(command, **options):
    return subprocess.run(["bash", "-c", command, QDOT], capture_output=True, timeout=60, check=False, env=ENVIRONMENT, **options)


class Streams(Batch):
    def answers_to(self, source):
        return qdot("batch", source).stdout


class Pipes(Streams):
    def started(self, *arguments):
        process = subprocess.Popen([QDOT, "batch", *arguments], stderr=subprocess.PIPE, env=ENVIRONMENT)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def pipe(self):
        os.mkfifo(self.path("pipe"))
        return self.path("pipe")

    def test_a_named_pipe_waits_for_its_reader(self):
        for count in (3, MORE_THAN_A_PIPE_HOLDS):
            with self.subTest(count=count):
                source, target = self.path("in", lines(count)), self.path(f"pipe{count}")
                os.mkfifo(target)
                process = self.started(source, "--output", target)
                with self.assertRaises(subprocess.TimeoutExpired):
                    process.wait(1)
                self.assertEqual(self.read(target), self.answers_to(source))
                self.assertEqual(process.wait(20), 0)

    def test_a_signal_ends_it_while_it_waits(self):
        process = self.started(self.path("in", lines(3)), "--output", self.pipe())
        with self.assertRaises(subprocess.TimeoutExpired):
            process.wait(0.5)
        process.terminate()
        self.assertEqual(process.wait(20), -signal.SIGTERM)

    def test_it_ends_when_the_reader_leaves(self):
        source, target = self.path("in", lines(MORE_THAN_A_PIPE_HOLDS)), self.pipe()
        process = self.started(source, "--output", target)
        with open(target, "rb") as reader:
            reader.read(100)
        self.assertEqual(process.wait(20), -signal.SIGPIPE)
        for command in ('"$0" batch in --output /dev/stdout | head -c 100 > /dev/null; exit ${PIPESTATUS[0]}',
                        '"$0" batch in --output >(head -c 100 > /dev/null); exit $?'):
            with self.subTest(command=command):
                self.assertEqual(shell("timeout 20 " + command, cwd=self.directory.name).returncode, 128 + signal.SIGPIPE)

    def test_a_signal_does_not_promise_to_resume_what_was_written_to_a_pipe(self):
        slow = line(1, "simulate", {"system": "spring_pendulum", "t_end": 2000, "samples": 2})
        target = self.pipe()
        process = self.started(self.path("in", slow * 1000), "--output", target)
        with open(target, "rb") as reader:
            reader.readline()
            process.send_signal(signal.SIGTERM)
            self.assertEqual(process.wait(20), 128 + signal.SIGTERM)
        self.assertRegex(process.stderr.read(), rb"Stopped after \d+ lines\.\n")

    def test_several_write_to_one_device(self):
        with subprocess.Popen([QDOT, "batch", "--output", "/dev/null"], stdin=subprocess.PIPE, env=ENVIRONMENT) as first:
            deadline = time.monotonic() + 20
            while "/dev/null" not in self.descriptors(first):
                self.assertLess(time.monotonic(), deadline)
            run = qdot("batch", self.path("in", lines(2)), "--output", "/dev/null")
            self.assertEqual((run.returncode, run.stderr), (0, b""))
            first.stdin.close()
            self.assertEqual(first.wait(20), 0)

    @staticmethod
    def descriptors(process):
        """What its files are; some may be closed meanwhile."""
        directory = pathlib.Path(f"/proc/{process.pid}/fd")
        found = []
        for name in os.listdir(directory):
            with contextlib.suppress(FileNotFoundError):
                found += [os.readlink(directory / name)] if int(name) > 2 else []
        return found

    def test_a_hyphen_is_stdout(self):
        source = self.path("in", lines(5))
        run = shell('"$0" batch in --output -', cwd=self.directory.name)
        self.assertEqual((run.returncode, run.stdout), (0, self.answers_to(source)))
        self.assertFalse(os.path.exists(self.path("-")))
        self.assertEqual(shell('"$0" batch in --output - --resume', cwd=self.directory.name).returncode, 2)
        shell('"$0" batch in --output ./-', cwd=self.directory.name)
        self.assertEqual(self.read(self.path("-")), run.stdout)


class Ends(Batch):
    def test_a_signal_may_come_while_a_batch_ends(self):
        moments = random.Random(5)
        for _ in range(20 if SANITIZED else 100):
            with subprocess.Popen([QDOT, "batch"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  env=ENVIRONMENT) as process:
                process.stdin.write(line(1, *QUESTIONS[0]).encode())
                process.stdin.flush()
                process.stdout.readline()
                process.stdin.close()
                time.sleep(moments.uniform(0, 0.003))
                process.terminate()
                self.assertIn(process.wait(20), (0, 128 + signal.SIGTERM), process.stderr.read())


class ClosedStreams(Streams):
    """A program may be started without one of them, or without any."""

    def run_without(self, streams, command, code, said=b""):
        run = shell(f'"$0" {command} {streams}', cwd=self.directory.name)
        self.assertEqual((run.returncode, run.stdout), (code, b""))
        self.assertIn(said, run.stderr)

    def test_messages_stay_out_of_the_answers(self):
        slow = line(1, "simulate", {"system": "spring_pendulum", "t_end": 2000, "samples": 2})
        source, target = self.path("in", slow * 1000), self.path("out")
        for streams in ("<&- 2>&-", ">&- 2>&-", "<&- >&- 2>&-"):
            with self.subTest(streams=streams):
                process = subprocess.Popen(["bash", "-c", f'exec "$0" batch in --output out {streams}', QDOT],
                                           cwd=self.directory.name, env=ENVIRONMENT)
                deadline = time.monotonic() + 20
                while not (os.path.exists(target) and self.read(target)) and time.monotonic() < deadline:
                    time.sleep(0.02)
                process.terminate()
                self.assertEqual(process.wait(20), 128 + signal.SIGTERM)
                answer, *others = self.read(target).splitlines(keepends=True)
                self.assertLessEqual(set(others), {answer})
                self.path("in", slow * (len(others) + 2))
                self.run_without(streams, "batch in --output out --resume", 0)
                self.assertEqual(self.read(target), answer * (len(others) + 2))
                self.path("in", slow * 1000)
                os.remove(target)

    def test_what_is_refused_is_not_said_in_the_answers(self):
        self.path("in", lines(2))
        self.path("out", "answers to others\n")
        for streams in ("<&- 2>&-", "<&- >&- 2>&-"):
            self.run_without(streams, "batch in --output out --resume", 2)
            self.assertEqual(self.read(self.path("out")), b"answers to others\n")

    def test_answers_that_have_nowhere_to_go_are_told(self):
        self.path("in", lines(2))
        for command in ("batch in", "modes cart_pendulum", "systems", "--help"):
            for streams in (">&-", "<&- >&-"):
                with self.subTest(command=command, streams=streams):
                    self.run_without(streams, command, 7, b"cannot write the answer")
        self.run_without(">&-", "batch in --output /dev/stdout", 2, b"cannot write /dev/stdout")
        self.run_without("<&-", "batch", 2, b"cannot read stdin")
        self.run_without("< /", "batch", 2, b"stdin is a directory")
        self.run_without("0> written", "batch", 2, b"cannot read stdin")


if __name__ == "__main__":
    unittest.main()
