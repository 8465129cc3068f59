"""server/bundle makes an archive that starts where nothing else is: in an empty root as nobody, without /proc, /tmp or a
shell, on a disk that cannot be written, and beside the libraries of another system.

It needs root, for chroot.
"""

import http.client
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tarfile
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests" / "server"))

from running_qdot import QDOT, qdot  # noqa: E402

LARGEST = 15e6  # bytes, compressed
NOBODY = 65534
REQUEST = '{"system": "cart_pendulum"}'


def nobody_in(root):
    """For preexec_fn: this process sees nothing but `root`, and has no rights there."""

    def enter():
        os.chroot(root)
        os.chdir("/")
        os.setgroups([])
        os.setgid(NOBODY)
        os.setuid(NOBODY)

    return enter


class Bundle(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.directory.cleanup)
        cls.work = pathlib.Path(cls.directory.name)
        cls.work.chmod(0o755)
        cls.archive = cls.work / "qdot-bundle.tar.gz"
        cls.make(cls.archive)
        with tarfile.open(cls.archive) as archive:
            archive.extractall(cls.work / "root" / "any where")
        cls.bundle = cls.work / "root" / "any where" / "qdot"

    @staticmethod
    def make(archive):
        made = subprocess.run([ROOT / "server" / "bundle", archive], capture_output=True, text=True, check=False,
                              env={**os.environ, "QDOT_BINARY": QDOT})
        assert made.returncode == 0, made.stderr
        assert made.stdout.strip() == str(archive)

    def run_alone(self, *words, stdin="", root=None, program="/any where/qdot/qdot", **environment):
        return subprocess.run([program, *words], input=stdin.encode(), capture_output=True, timeout=60, check=False,
                              env=environment, preexec_fn=nobody_in(root or self.work / "root"))

    def test_is_small_and_holds_nothing_but_its_directory(self):
        size = self.archive.stat().st_size
        print(f"{size / 1e6:.1f} MB")
        self.assertLess(size, LARGEST)
        with tarfile.open(self.archive) as archive:
            for member in archive:
                self.assertTrue(member.name == "qdot" or member.name.startswith("qdot/"), member.name)
                self.assertTrue(member.isdir() or member.isreg(), member.name)
                self.assertEqual((member.uid, member.gid, member.mode & 0o022), (0, 0, 0), member.name)

    def test_the_same_program_gives_the_same_bytes(self):
        again = self.work / "again.tar.gz"
        self.make(again)
        self.assertEqual(again.read_bytes(), self.archive.read_bytes())

    def test_every_library_comes_with_its_terms(self):
        libraries = [file for file in (self.bundle / "lib").iterdir() if file.name != "qdot"]
        self.assertGreater(len(libraries), 4)
        licences = {file.name for file in (self.bundle / "licences").iterdir()}
        self.assertLessEqual({"qdot", "libc6", "libgmp10", "libsleef3"}, licences)

    def test_answers_in_an_empty_root_as_the_build_does(self):
        self.assertEqual(os.listdir(self.work / "root"), ["any where"])
        alone = self.run_alone("modes", "--request", "-", stdin=REQUEST)
        self.assertEqual((alone.returncode, alone.stderr), (0, b""))
        self.assertEqual(alone.stdout, qdot("modes", "--request", "-", stdin=REQUEST).stdout)

    def test_says_what_the_program_says(self):
        wrong = self.run_alone("modes", "cart_pendulum", "kk=3")
        self.assertEqual(wrong.returncode, 3)
        self.assertEqual(json.loads(wrong.stderr)["errors"][0]["did_you_mean"], "k")
        self.assertEqual(self.run_alone("modess").returncode, 2)

    def test_grades(self):
        shutil.copy(ROOT / "api" / "about" / "keys" / "problem_7.json", self.bundle / "key.json")
        (self.bundle / "answers.csv").write_text("id,submitted\nphi_max,60deg\n")
        graded = self.run_alone("check", "--key", "/any where/qdot/key.json", "--answers", "/any where/qdot/answers.csv")
        self.assertEqual(graded.returncode, 0, graded.stderr)
        self.assertEqual(json.loads(graded.stdout)["points"], 1)

    def test_serves(self):
        server = subprocess.Popen(["/any where/qdot/qdot", "serve", "--port", "0"], stdout=subprocess.PIPE,
                                  stderr=subprocess.DEVNULL, env={}, preexec_fn=nobody_in(self.work / "root"))
        try:
            port = json.loads(server.stdout.readline())["port"]
            connection = http.client.HTTPConnection("127.0.0.1", port, timeout=20)
            connection.request("POST", "/v1/modes", REQUEST, {"Content-Type": "application/json"})
            self.assertEqual(connection.getresponse().status, 200)
            connection.close()
        finally:
            server.send_signal(signal.SIGTERM)
            server.communicate(timeout=30)
        self.assertEqual(server.returncode, 0)

    def test_is_found_through_links(self):
        for link, to in (("to_it", "any where/qdot/qdot"), ("to_link", "to_it"), ("to_directory", "any where/qdot")):
            (self.work / "root" / link).symlink_to(to)
            self.addCleanup((self.work / "root" / link).unlink)
        for program in ("/to_it", "/to_link", "/to_directory/qdot", "any where/qdot/qdot", "./any where/../to_link"):
            with self.subTest(program=program):
                run = self.run_alone("--version", program=program)
                self.assertEqual((run.returncode, run.stdout), (0, qdot("--version").stdout), run.stderr)

    def test_takes_no_library_of_the_machine(self):
        """A loader that looked elsewhere would stop at these."""
        broken = self.work / "root" / "broken"
        broken.mkdir()
        self.addCleanup(shutil.rmtree, broken)
        for library in (self.bundle / "lib").iterdir():
            (broken / library.name).write_bytes(b"\x7fELF of another system")
        run = self.run_alone("--version", LD_LIBRARY_PATH="/broken", LD_PRELOAD="/broken/libc.so.6")
        self.assertEqual((run.returncode, run.stderr), (0, b""))

    def test_starts_soon(self):
        before = os.times()
        for _ in range(5):
            self.run_alone("--version")
        used = os.times().children_user - before.children_user
        self.assertLess(used / 5, 0.05, "seconds of user time")

    def test_says_when_a_directory_cannot_be(self):
        (self.work / "root" / "a:b").symlink_to("any where")  # a link is followed
        self.addCleanup((self.work / "root" / "a:b").unlink)
        self.assertEqual(self.run_alone("--version", program="/a:b/qdot/qdot").returncode, 0)
        other = self.work / "other"
        shutil.copytree(self.bundle, other / "a:b")
        run = self.run_alone("--version", root=other, program="/a:b/qdot")
        self.assertEqual(run.returncode, 127)
        self.assertIn(b"/a:b", run.stderr)
        os.unlink(other / "a:b" / "lib" / "ld-linux-x86-64.so.2")
        (other / "a:b").rename(other / "ab")
        run = self.run_alone("--version", root=other, program="/ab/qdot")
        self.assertEqual(run.returncode, 127)
        self.assertIn(b"/ab/lib/ld-linux-x86-64.so.2: No such file", run.stderr)


if __name__ == "__main__":
    if os.geteuid() != 0:
        print("skipped: chroot needs root")
        sys.exit(0)
    unittest.main()
