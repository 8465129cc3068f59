"""What people type first: each line of first_tries.txt is answered, or refused in words that say what to write."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from running_qdot import ENVIRONMENT, QDOT, ROOT, RunningQdot

HERE = pathlib.Path(__file__).parent
FEWEST = 150
# An error status of HTTP is an error of curl, whose message is then the body.
CURL_SETTINGS = "silent\nshow-error\nfail-with-body\n"
# Python shows the body of an error only to those who ask for it.
PYTHON = """
import sys, urllib.error
try:
    exec(sys.argv[1])
except urllib.error.HTTPError as error:
    sys.exit(error.read().decode())
"""


def read_tries(text):
    """[(line to type, "answers" or "names", words)]"""
    tries = []
    typed = []
    for line in text.splitlines():
        expected = re.fullmatch(r"    (answers|names):(.*)", line)
        if expected:
            words = [word.strip() for word in expected.group(2).split(" | ") if word.strip()]
            tries.append(("\n".join(typed), expected.group(1), words))
            typed = []
        elif typed or (line.strip() and not line.startswith("#")):
            typed.append(line)
    return tries


class FirstTries(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = RunningQdot("--deadline", "60")
        cls.directory = tempfile.TemporaryDirectory()
        home = pathlib.Path(cls.directory.name)
        (home / ".curlrc").write_text(CURL_SETTINGS)
        (home / "request.json").write_text('{"system": "cart_pendulum"}')
        (home / "bin").mkdir()
        (home / "bin" / "qdot").symlink_to(QDOT)
        cls.environment = {**ENVIRONMENT, "HOME": str(home), "no_proxy": "localhost", "PYTHONDONTWRITEBYTECODE": "1",
                           "PATH": f"{home}/bin:{os.environ['PATH']}", "PYTHONPATH": str(ROOT / "api" / "clients")}

    @classmethod
    def tearDownClass(cls):
        cls.server.__exit__()
        cls.directory.cleanup()

    def type(self, line):
        """Whether it went well, and all that was printed."""
        line = line.replace("localhost:8080", f"localhost:{self.server.port}")
        program = [sys.executable, "-c", PYTHON, line[4:]] if line.startswith("py: ") else ["bash", "-c", line]
        run = subprocess.run(program, cwd=self.directory.name, stdin=subprocess.DEVNULL, capture_output=True,
                             timeout=60, check=False, text=True, env=self.environment)
        self.assertNotIn(run.returncode, (5, 126, 127), run.stderr)
        is_redirection = '"location":' in run.stdout
        return run.returncode == 0 and not is_redirection, (run.stdout + run.stderr).replace('\\"', '"')

    def test_each_is_answered_or_told_what_to_write(self):
        tries = read_tries((HERE / "first_tries.txt").read_text())
        self.assertGreaterEqual(len(tries), FEWEST)
        for line, kind, words in tries:
            with self.subTest(line=line):
                went_well, said = self.type(line)
                for word in words:
                    self.assertIn(word.lower(), said.lower())
                self.assertEqual(went_well, kind == "answers", said)


if __name__ == "__main__":
    unittest.main()
