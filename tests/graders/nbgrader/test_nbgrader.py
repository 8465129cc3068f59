"""Notebooks graded by nbgrader's rule: cells run in order, and a test cell earns its points unless it ends in an error."""

import json
import pathlib
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from notebooks import run_submission  # noqa: E402
from sandbox import MOST_LINES, Setup, validate  # noqa: E402


def scores(notebook):
    """{grade_id: (points, what the cell's error says)}."""
    found = {}
    for cell in notebook["cells"]:
        about = cell["metadata"].get("nbgrader", {})
        if about.get("grade"):
            errors = [output["evalue"] for output in cell["outputs"] if output["output_type"] == "error"]
            found[about["grade_id"]] = (0 if errors else about["points"], " ".join(errors))
    return found


class NbGrader(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.setup = Setup(HERE)

    def graded(self, submission):
        notebook = json.loads((HERE / "swing.ipynb").read_text())
        answers = json.loads((HERE / "submissions" / f"{submission}.json").read_text())
        executed, _ = run_submission(notebook, answers, self.setup.directory / "key.json")
        validate(executed, HERE)
        return scores(executed)

    def test_a_teacher_writes_little(self):
        self.assertLessEqual(self.setup.lines, MOST_LINES)

    def test_the_notebook_has_the_cells_of_the_readme_and_the_points_of_the_key(self):
        notebook = json.loads((HERE / "swing.ipynb").read_text())
        validate(notebook, HERE)
        locked = [cell for cell in notebook["cells"] if cell["metadata"].get("nbgrader", {}).get("locked")]
        self.assertEqual([cell["source"] for cell in locked], (self.setup.directory / "cells.py").read_text().splitlines())
        points = [cell["metadata"]["nbgrader"]["points"] for cell in locked[1:]]
        self.assertEqual(points, [item["points"] for item in self.setup.key["items"]])

    def test_right(self):
        self.assertEqual(self.graded("right"), {"test_theta_max": (2, ""), "test_theta": (3, "")})

    def test_wrong(self):
        self.assertEqual(self.graded("wrong"), {"test_theta_max": (0, "theta_max is not right. The sign is wrong."),
                                                "test_theta": (0, "theta is not right. The motion does not obey it. The term in sin(theta) has the wrong sign.")})

    def test_a_cell_that_fails_holds_up_no_other(self):
        graded = self.graded("broken")
        self.assertEqual(graded["test_theta_max"][0], 0)
        self.assertEqual(graded["test_theta"], (3, ""))


if __name__ == "__main__":
    unittest.main()
