"""Every answer that the scripts of this run have seen fits GET /openapi.json.

The scripts write what they send and get into the directory QDOT_RECORDINGS (tests/server/running_qdot.py); ctest runs
them before this one.
"""

import os
import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.extend([str(ROOT / "tests" / "support"), str(ROOT / "tests" / "server")])

from node import node, require_packages  # noqa: E402
from running_qdot import RunningQdot  # noqa: E402


class Responses(unittest.TestCase):
    def test_fit_the_document(self):
        require_packages()
        recordings = sorted(pathlib.Path(os.environ["QDOT_RECORDINGS"]).glob("*.ndjson"))
        self.assertTrue(recordings, "No script has run before this one: run them with ctest.")
        with RunningQdot() as server, tempfile.TemporaryDirectory() as directory:
            document = pathlib.Path(directory, "openapi.json")
            document.write_bytes(server.request("GET", "/openapi.json").data)
            validation = node(ROOT / "tests/openapi/validate.mjs", str(document), *map(str, recordings))
        print(validation.stdout.splitlines()[-1:] or validation.stderr)
        self.assertEqual(validation.returncode, 0, validation.stdout + validation.stderr[-3000:])
        count = int(re.search(r"(\d+) answers validated", validation.stdout).group(1))
        self.assertGreater(count, 0)


if __name__ == "__main__":
    unittest.main()
