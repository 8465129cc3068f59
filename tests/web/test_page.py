"""The page in Debian's Chromium: node's test runner drives it (tests/web/*.test.mjs), one file a test here.

`test_page.py Page.test_views` runs one.
"""

import os
import pathlib
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests" / "server"))

from running_qdot import ENVIRONMENT, QDOT, RunningQdot  # noqa: E402

HERE = pathlib.Path(__file__).parent
MODULES = pathlib.Path(os.environ.get("QDOT_PAGE_MODULES", ROOT / "build" / "npm" / "web" / "node_modules"))


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not (MODULES / "playwright-core").exists():
            raise AssertionError(f"{MODULES} is missing: run server/install test, which needs npm and its registry once")
        cls.server = RunningQdot("--deadline", "60")

    @classmethod
    def tearDownClass(cls):
        cls.server.__exit__()

    def run_file(self, name):
        environment = {**ENVIRONMENT, "QDOT_URL": f"http://127.0.0.1:{self.server.port}", "QDOT_PAGE_MODULES": str(MODULES), "QDOT_BINARY": QDOT, "NO_COLOR": "1"}
        run = subprocess.run(["node", "--test", "--test-reporter=spec", str(HERE / name)], capture_output=True, text=True, timeout=280, check=False, env=environment)
        self.assertEqual(run.returncode, 0, run.stdout[-12000:] + run.stderr[-3000:])
        self.assertNotRegex(run.stdout, "(?m)^.? ?(tests 0|skipped [1-9]|todo [1-9])")

    def test_types(self):
        """The modules say what they take and give (JSDoc), and tsc holds them to it."""
        check = subprocess.run([MODULES / ".bin" / "tsc", "--project", HERE / "tsconfig.json"], capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual(check.returncode, 0, check.stdout)


for file in HERE.glob("*.test.mjs"):
    setattr(Page, "test_" + file.name.removesuffix(".test.mjs"), lambda self, name=file.name: self.run_file(name))

if __name__ == "__main__":
    unittest.main()
