"""Notebooks graded by Otter's rule: cells run in order, then each test file's cases as doctests among the notebook's names."""

import json
import pathlib
import runpy
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from notebooks import run_submission  # noqa: E402
from sandbox import MOST_LINES, Setup, validate  # noqa: E402


class Otter(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.setup = Setup(HERE)

    def graded(self, submission):
        notebook = json.loads((HERE / "swing.ipynb").read_text())
        answers = json.loads((HERE / "submissions" / f"{submission}.json").read_text())
        _, results = run_submission(notebook, answers, self.setup.directory / "key.json", self.setup.directory / "tests")
        return {test["name"]: (test["score"], test["output"]) for test in results["tests"]}

    def test_a_teacher_writes_little(self):
        self.assertLessEqual(self.setup.lines, MOST_LINES)

    def test_the_test_files_have_ok_format(self):
        files = sorted((self.setup.directory / "tests").glob("*.py"))
        self.assertEqual(len(files), 2)
        for file in files:
            test = runpy.run_path(str(file))["test"]
            validate(test, HERE)
            self.assertEqual(test["name"], file.stem)
        self.assertEqual(test["points"], 2)

    def test_the_notebook_has_the_cell_of_the_readme(self):
        notebook = json.loads((HERE / "swing.ipynb").read_text())
        first = next(cell for cell in notebook["cells"] if cell["cell_type"] == "code")
        self.assertEqual(first["source"] + "\n", (self.setup.directory / "cells.py").read_text())

    def test_right(self):
        self.assertEqual(self.graded("right"), {"theta_max": (2, ""), "theta": (3, "")})

    def test_wrong(self):
        graded = self.graded("wrong")
        self.assertEqual([score for score, _ in graded.values()], [0, 0])
        self.assertIn("AssertionError: theta_max is not right. The sign is wrong.", graded["theta_max"][1])

    def test_a_cell_that_fails_holds_up_no_other(self):
        graded = self.graded("broken")
        self.assertIn("NameError", graded["theta_max"][1])
        self.assertEqual(graded["theta"], (3, ""))


if __name__ == "__main__":
    unittest.main()
