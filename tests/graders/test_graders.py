"""Every grader's folder: its README sets it up in under ten lines of a teacher's own text, and it grades as nobody, without
network, at half a CPU. This runs the tests in the folders, and tests the place they run in.
"""

import pathlib
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from sandbox import new_directory, run_confined  # noqa: E402

HERE = pathlib.Path(__file__).parent
PYTHON = "/usr/bin/python3"


class Place(unittest.TestCase):
    def test_has_no_network(self):
        for family in ("INET", "INET6", "UNIX"):
            run = run_confined([PYTHON, "-c", f"import socket; socket.socket(socket.AF_{family})"], "/", 20)
            self.assertIn("PermissionError", run.stderr)

    def test_is_nobodys(self):
        run = run_confined([PYTHON, "-c", "import os; print(os.getuid()); open('/etc/shadow')"], new_directory(), 20)
        self.assertNotEqual(run.stdout, "0\n")
        self.assertIn("PermissionError", run.stderr)

    def test_has_half_a_cpu(self):
        spin = "import time\nend = time.monotonic() + 2\nwhile time.monotonic() < end: pass\nprint(time.process_time())"
        run = run_confined([PYTHON, "-c", spin], "/", 20)
        self.assertLess(float(run.stdout), 1.3)

    def test_ends_in_time(self):
        before = time.monotonic()
        with self.assertRaises(Exception):
            run_confined(["sleep", "30"], "/", 1)
        self.assertLess(time.monotonic() - before, 10)


def load_tests(loader, tests, _):
    for file in sorted(HERE.glob("*/test_*.py")):
        tests.addTests(loader.discover(str(file.parent), file.name, top_level_dir=str(file.parent)))
    return tests


if __name__ == "__main__":
    unittest.main()
