"""No file of code is longer than 400 lines: what grows beyond is more than one idea."""

import pathlib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LONGEST = 400
CODE = {".cpp", ".hpp", ".py", ".js", ".mjs", ".css"}
# People copy it beside their programs, so it stays one file.
ONE_FILE = {"api/clients/qdot.py"}


def lengths(root=ROOT):
    """{file: its lines}"""
    files = [path for house in ("core", "api", "server", "tests") for path in (root / house).rglob("*")
             if path.suffix in CODE and path.is_file() and "node_modules" not in path.parts]
    return {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8").count("\n") for path in files}


class Lengths(unittest.TestCase):
    def test_no_file_of_code_is_longer_than_its_idea(self):
        found = lengths()
        self.assertGreater(len(found), 1000, "Hardly any file was found.")
        self.assertEqual({name: lines for name, lines in found.items() if lines > LONGEST and name not in ONE_FILE}, {})

    def test_what_is_let_off_is_still_too_long(self):
        found = lengths()
        self.assertEqual({name for name in ONE_FILE if found[name] <= LONGEST}, set())


if __name__ == "__main__":
    unittest.main()
