"""qdot batch: lines in, lines out, in order, in constant memory, and once each whatever ends it."""

import json
import os
import pty
import random
import select
import signal
import subprocess
import tempfile
import time
import unittest

from running_qdot import ENVIRONMENT, QDOT, SANITIZED, qdot

QUESTIONS = [("modes", {"system": "cart_pendulum"}), ("energy", {"system": "spring_pendulum"}),
             ("turning_points", {"system": "free_spin_pendulum"}),
             ("simulate", {"system": "rod_pendulum", "t_end": 1, "samples": 3}),
             ("energy", {"system": "spring_pendulum", "parameters": {"k": -1}})]
MOST_MEMORY = 100 << 20


def line(number, question, request):
    return json.dumps({"id": number, question: request}) + "\n"


def lines(count, seed=1):
    chosen = random.Random(seed)
    return "".join(line(i, *chosen.choice(QUESTIONS)) for i in range(count))


def listen_to_control_c():
    """What a shell starts in the background does not."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def read_until(terminal, mark):
    """What a program writes there, up to the mark; what has come after 30 seconds without it."""
    text = b""
    deadline = time.monotonic() + 30
    while mark not in text and time.monotonic() < deadline and select.select([terminal], [], [], 30)[0]:
        text += os.read(terminal, 4096)
    return text


class Batch(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.addCleanup(self.directory.cleanup)

    def path(self, name, text=None):
        path = os.path.join(self.directory.name, name)
        if text is not None:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        return path

    @staticmethod
    def read(path):
        with open(path, "rb") as file:
            return file.read()

    def answered(self, text, *arguments):
        """The answers to lines, as bytes and read."""
        run = subprocess.run([QDOT, "batch", *arguments], input=text, capture_output=True, timeout=120, check=False,
                             env=ENVIRONMENT)
        self.assertEqual((run.returncode, run.stderr), (0, b""))
        answers = run.stdout.split(b"\n")
        self.assertEqual(answers.pop(), b"")
        return answers


class Lines(Batch):
    def test_an_answer_has_the_bytes_of_the_single_request(self):
        for number, (question, request) in enumerate(QUESTIONS):
            with self.subTest(question=question):
                answer, = self.answered(line(number, question, request).encode())
                single = qdot(question, stdin=json.dumps(request))
                status = 200 if single.returncode == 0 else 422
                body = (single.stdout or single.stderr).removesuffix(b"\n")
                self.assertEqual(answer, b'{"id":%d,"status":%d,"answer":%s}' % (number, status, body))

    def test_digits_beyond_a_double_reach_the_question(self):
        request = '{"system": "spring_pendulum", "parameters": {"k": 40.12345678901234567890123}, "t_end": 1, "precision": "extended"}'
        answer, = self.answered(f'{{"simulate": {request}}}'.encode())
        self.assertEqual(answer, b'{"id":null,"status":200,"answer":%s}' % qdot("simulate", stdin=request).stdout.strip())

    def test_an_answer_that_is_not_json_is_a_text(self):
        request = {"system": "spring_pendulum", "t_end": 1, "samples": 3, "format": "csv"}
        answer, = self.answered(line("a", "simulate", request).encode())
        self.assertEqual(json.loads(answer)["answer"].encode(), qdot("simulate", stdin=json.dumps(request)).stdout)

    def test_order_is_kept_whatever_a_line_costs(self):
        long = {"system": "spring_pendulum", "t_end": 300, "samples": 2}
        text = "".join(line(i, "simulate", long) if i % 7 == 0 else line(i, *QUESTIONS[0]) for i in range(60))
        answers = self.answered(text.encode(), "--jobs", "4")
        self.assertEqual([json.loads(answer)["id"] for answer in answers], list(range(60)))
        self.assertEqual(answers, self.answered(text.encode(), "--jobs", "1"))

    def test_a_wrong_line_fails_alone(self):
        good = line("good", *QUESTIONS[1]).encode()
        wrong = {b'{"id": 1, "energy": {"system": "spring': 400, b"": 400, b"   ": 400, b"null": 422, b"[]": 422,
                 b'{"id": 1}': 422, b'{"id": 1, "no_such": {}}': 422, b'{"id": 1, "energy": {}, "modes": {}}': 422,
                 b'{"id": [1], "energy": {"system": "spring_pendulum"}}': 422, b"[" * 100000: 422,
                 b'{"id": 1, "energy": ' + b'{"a":' * 50 + b"1" + b"}" * 51: 422, b"\0": 400, b'{"id": "\0"}': 400,
                 b'{"id": "\xff", "energy": {}}': 400, b'{"id": 1, "id": 2, "energy": {}}': 422,
                 b'{"id": "' + b"x" * 300 + b'", "energy": {}}': 422, b'{"id": 1, "batch": {}}': 422,
                 b'{"id": 1, "energy": 3}': 422, b'{"id": 1e999, "energy": {}}': 400}
        for text, status in wrong.items():
            with self.subTest(text=text[:50]):
                first, answer, last = self.answered(good + text + b"\n" + good)
                self.assertEqual(first, last)
                self.assertEqual(json.loads(first)["status"], 200)
                answer = json.loads(answer)
                self.assertEqual(answer["status"], status)
                self.assertEqual(answer["answer"]["status"], status)
                self.assertLess(len(json.dumps(answer)), 3000)

    def test_the_last_line_needs_no_newline_and_windows_has_two_characters(self):
        text = lines(5)
        answers = self.answered(text.encode())
        self.assertEqual(self.answered(text.rstrip("\n").encode()), answers)
        self.assertEqual(self.answered(text.replace("\n", "\r\n").encode()), answers)
        self.assertEqual(self.answered(b""), [])

    def test_a_line_is_answered_before_the_next_one_comes(self):
        with subprocess.Popen([QDOT, "batch"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=ENVIRONMENT) as process:
            for number in range(3):
                process.stdin.write(line(number, *QUESTIONS[0]).encode())
                process.stdin.flush()
                self.assertTrue(select.select([process.stdout], [], [], 20)[0], "no answer")
                self.assertEqual(json.loads(process.stdout.readline())["id"], number)
            process.stdin.close()
            self.assertEqual(process.wait(20), 0)

    def test_usage(self):
        for arguments in (["/no/such/file"], ["--resume"], ["--jobs", "0"], ["--output", "/no/such/directory/file"],
                          ["--resume", "--output", "/dev/null"], ["--jbos", "2"]):
            run = qdot("batch", *arguments)
            self.assertEqual((run.returncode, run.stdout), (2, b""), run.stderr)

    def test_a_variable_of_the_shell_that_is_not_set_is_told(self):
        for what, *words in (["--output", "batch", "--output", ""], ["--output", "batch", "--output="],
                             ["--scenes", "batch", "--scenes", ""], ["a word of the command line is empty", "batch", ""], ["a word of the command line is empty", "modes", ""],
                             ["--request", "modes", "--request", ""], ["--request", "modes", "--request="],
                             ["--format", "modes", "cart_pendulum", "--format", ""], ["--key", "check", "--key", ""]):
            with self.subTest(words=words):
                run = qdot(*words)
                self.assertEqual((run.returncode, run.stdout), (2, b""), run.stderr)
                self.assertIn(f"{what} is empty; " if what[0] == "-" else what, run.stderr.decode())


class Memory(Batch):
    def peak(self, pieces):
        """Most bytes in memory while these pieces of text are answered, and the number of answers."""
        with tempfile.TemporaryFile() as output:
            process = subprocess.Popen([QDOT, "batch"], stdin=subprocess.PIPE, stdout=output, env=ENVIRONMENT)
            for piece in pieces:
                process.stdin.write(piece)
            process.stdin.close()
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            self.assertEqual(process.returncode, 0)
            output.seek(0)
            return usage.ru_maxrss * 1024, sum(1 for _ in output)

    @unittest.skipIf(SANITIZED, "their memory is not ours")
    def test_it_is_constant(self):
        request = json.dumps({"system": "spring_pendulum"})
        wide = f'{{"id": 1, "energy": {request}{" " * 60000}}}\n'.encode()  # what comes is long, and quickly answered
        bytes_in, answers = self.peak(wide for _ in range(300_000_000 // len(wide)))
        self.assertEqual(answers, 300_000_000 // len(wide))
        self.assertLess(bytes_in, MOST_MEMORY)

    @unittest.skipIf(SANITIZED, "their memory is not ours")
    def test_a_line_of_a_hundred_megabytes_is_not_kept(self):
        def pieces():
            yield b'{"id": "'
            for _ in range(1000):
                yield b"x" * 100_000
            yield b'"}\n' + lines(1).encode()

        bytes_in, answers = self.peak(pieces())
        self.assertEqual(answers, 2)
        self.assertLess(bytes_in, MOST_MEMORY)

    @unittest.skipIf(SANITIZED, "their memory is not ours")
    def test_nor_are_answers_behind_one_that_takes_long(self):
        slow = line(0, "simulate", {"system": "spring_pendulum", "t_end": 3000, "samples": 2})
        wide = line(1, "simulate", {"system": "spring_pendulum", "t_end": 1, "samples": 5000})
        bytes_in, answers = self.peak([slow.encode()] + [wide.encode()] * 600)  # of 0.4 MB each
        self.assertEqual(answers, 601)
        self.assertLess(bytes_in, MOST_MEMORY)


class Files(Batch):
    """What is refused has changed no file."""

    def refused(self, target, *arguments, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE):
        before = self.read(target)
        run = subprocess.run([QDOT, "batch", *arguments], stdin=stdin, stdout=stdout, stderr=subprocess.PIPE, timeout=60,
                             check=False, env=ENVIRONMENT)
        self.assertEqual((run.returncode, self.read(target)), (2, before), run.stderr)
        return run.stderr.decode()

    def test_the_lines_are_not_written_over(self):
        source = self.path("in", lines(3).removesuffix("\n"))
        os.symlink(source, self.path("symbolic"))
        os.link(source, self.path("hard"))
        for more in ([], ["--resume"]):
            for name in ("in", "symbolic", "hard"):
                with self.subTest(name=name, more=more):
                    said = self.refused(source, source, "--output", self.path(name), *more)
                    self.assertIn("over the lines that are read", said)
            with self.subTest(name="stdin", more=more), open(source, encoding="utf-8") as stdin:
                self.refused(source, "--output", source, *more, stdin=stdin)
        with open(source, "a", encoding="utf-8") as stdout:
            self.refused(source, source, stdout=stdout)

    def test_an_input_that_has_no_lines_leaves_the_answers(self):
        target = self.path("out", "answers of hours\n")
        for more in ([], ["--resume"]):
            with self.subTest(more=more):
                self.assertIn("directory", self.refused(target, self.directory.name, "--output", target, *more))

    def test_scenes_that_cannot_be_read_leave_the_answers(self):
        source, target = self.path("in", lines(2)), self.path("out", "answers of hours\n")
        for scenes in (self.path("no_such"), os.path.dirname(self.path("bad.json", "{"))):
            with self.subTest(scenes=scenes):
                self.refused(target, source, "--output", target, "--scenes", scenes)


class Resume(Batch):
    def run_until(self, source, target, seconds):
        """Runs, and kills it after so long; its exit code."""
        process = subprocess.Popen([QDOT, "batch", source, "--output", target, "--resume"], stderr=subprocess.PIPE,
                                   env=ENVIRONMENT)
        try:
            _, errors = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            process.kill()
            _, errors = process.communicate(timeout=20)
        return process.returncode, errors.decode()

    def test_after_any_number_of_kills_nothing_is_lost_or_doubled(self):
        slowness = 10 if SANITIZED else 1
        text = lines(4000 // slowness, seed=7)
        source, target, whole = self.path("in", text), self.path("out"), self.path("whole")
        self.assertEqual(qdot("batch", source, "--output", whole).returncode, 0)
        moments = random.Random(3)
        code, kills = None, 0
        while code != 0:
            # A busy machine gets nothing done in moments that are enough for others.
            moment = slowness * (1 + kills / 200) * moments.uniform(0.01, 0.2)
            code, errors = self.run_until(source, target, moment)
            self.assertIn(code, (0, -signal.SIGKILL), errors)
            kills += code != 0
            self.assertLess(kills, 2000)
            if code != 0 and kills % 3 == 0 and os.path.exists(target):  # and as a full disk or a fallen machine leaves it
                os.truncate(target, max(0, os.path.getsize(target) - moments.randrange(3000)))
        print(f"{kills} kills")
        self.assertGreater(kills, 0)
        self.assertEqual(self.read(target), self.read(whole))

    def test_a_torn_last_line_is_done_again(self):
        source, target = self.path("in", lines(20)), self.path("out")
        qdot("batch", source, "--output", target)
        whole = self.read(target)
        for cut in (1, 2, 50, len(whole.split(b"\n")[-2]), len(whole.split(b"\n")[-2]) + 1, len(whole) - 1, len(whole)):
            os.truncate(target, len(whole) - cut)
            run = qdot("batch", source, "--output", target, "--resume")
            self.assertEqual((run.returncode, run.stderr), (0, b""))
            self.assertEqual(self.read(target), whole)

    def test_without_it_the_file_begins_anew(self):
        target = self.path("out", "something\n")
        qdot("batch", self.path("in", lines(2)), "--output", target)
        self.assertEqual(self.read(target).count(b"\n"), 2)

    def test_two_do_not_write_one_file(self):
        target = self.path("out")
        with subprocess.Popen([QDOT, "batch", "--output", target], stdin=subprocess.PIPE, env=ENVIRONMENT) as first:
            first.stdin.write(line(1, *QUESTIONS[0]).encode())
            first.stdin.flush()
            deadline = time.monotonic() + 20
            while not (os.path.exists(target) and self.read(target)) and time.monotonic() < deadline:
                time.sleep(0.02)
            run = qdot("batch", self.path("in", lines(2)), "--output", target, "--resume")
            self.assertEqual(run.returncode, 2)
            self.assertIn(b"another batch", run.stderr)
            first.stdin.close()
            self.assertEqual(first.wait(20), 0)

    def test_control_c_ends_at_once_behind_a_whole_line(self):
        slow = {"system": "spring_pendulum", "t_end": 2000, "samples": 2}
        source = self.path("in", "".join(line(i, "simulate", slow) for i in range(1000)))
        for ending in (signal.SIGINT, signal.SIGTERM):
            target = self.path(f"out{ending}")
            with subprocess.Popen([QDOT, "batch", source, "--output", target], stderr=subprocess.PIPE, env=ENVIRONMENT,
                                  preexec_fn=listen_to_control_c) as process:
                deadline = time.monotonic() + 20
                while not (os.path.exists(target) and self.read(target)) and time.monotonic() < deadline:
                    time.sleep(0.02)
                process.send_signal(ending)
                _, errors = process.communicate(timeout=20)
            self.assertEqual(process.returncode, 128 + ending)
            written = self.read(target)
            self.assertTrue(written.endswith(b"\n"))
            self.assertIn(f"Stopped after {written.count(bytes([10]))} lines", errors.decode())
            self.assertIn("--resume", errors.decode())


class Terminal(Batch):
    def test_progress_is_told_on_a_terminal_only(self):
        slow = {"system": "spring_pendulum", "t_end": 500, "samples": 2}
        source = self.path("in", "".join(line(i, "simulate", slow) for i in range(100000)))
        terminal, its_end = pty.openpty()
        process = subprocess.Popen([QDOT, "batch", source, "--output", self.path("out"), "--jobs", "1"], stderr=its_end,
                                   stdout=its_end, env=ENVIRONMENT, preexec_fn=listen_to_control_c)
        os.close(its_end)
        text = read_until(terminal, b" left")
        process.send_signal(signal.SIGINT)
        text += read_until(terminal, b"--resume")
        self.assertEqual(process.wait(20), 128 + signal.SIGINT)
        os.close(terminal)
        self.assertRegex(text.decode(), r"\d+ lines, \d+ %, about [\d.]+ (s|min|h) left")
        self.assertRegex(text.decode(), r"Stopped after \d+ lines; --resume")


if __name__ == "__main__":
    unittest.main()
