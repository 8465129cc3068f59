"""A question graded as PrairieLearn's grading container does: /grade is laid out, the entry point is run, results.json is read."""

import json
import pathlib
import shutil
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from sandbox import MOST_LINES, Setup, new_directory, run_confined, validate, writable  # noqa: E402

LARGEST = 1 << 20  # bytes of results.json


class PrairieLearn(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.setup = Setup(HERE)
        cls.course = cls.setup.directory / "course"
        cls.question = cls.course / "questions" / "swing"
        cls.info = json.loads((cls.question / "info.json").read_text())

    def graded(self, submitted):
        """results.json of a job with these submitted answers."""
        options = self.info["externalGradingOptions"]
        grade = writable(new_directory() / "grade")
        for name in options["serverFilesCourse"]:
            shutil.copytree(self.course / "serverFilesCourse" / name, grade / "serverFilesCourse" / name)
        shutil.copytree(self.question / "tests", grade / "tests")
        (grade / "student").mkdir()
        (grade / "data").mkdir()
        data = {"submitted_answers": submitted, "raw_submitted_answers": submitted, "params": {}, "correct_answers": {},
                "partial_scores": {}, "score": 0, "feedback": {}, "format_errors": {}, "variant_seed": 7, "options": {}}
        (grade / "data" / "data.json").write_text(json.dumps(data))
        entry = grade / options["entrypoint"].removeprefix("/grade/")
        entry.chmod(0o755)
        run = run_confined([str(entry)], grade, options["timeout"])
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        results = (grade / "results" / "results.json").read_bytes()
        self.assertLess(len(results), LARGEST)
        validate(json.loads(results), HERE)
        return json.loads(results)

    def submission(self, name):
        return json.loads((HERE / "submissions" / f"{name}.json").read_text())

    def test_a_teacher_writes_little(self):
        self.assertLessEqual(self.setup.lines, MOST_LINES)

    def test_the_inputs_are_the_keys_items(self):
        html = (self.question / "question.html").read_text()
        for item in self.setup.key["items"]:
            self.assertIn(f'answers-name="{item["id"]}"', html)
        self.assertEqual(self.info["gradingMethod"], "External")

    def test_right(self):
        result = self.graded(self.submission("right"))
        self.assertEqual((result["gradable"], result["score"]), (True, 1))
        self.assertEqual([test["points"] for test in result["tests"]], [2, 3])

    def test_wrong(self):
        result = self.graded(self.submission("wrong"))
        self.assertEqual((result["gradable"], result["score"]), (True, 0))
        self.assertIn("The term in sin(theta) has the wrong sign.", result["tests"][1]["output"])
        self.assertNotIn("0.96", json.dumps(result))

    def test_partly_right(self):
        self.assertEqual(self.graded({**self.submission("right"), "theta": "theta'' = 0"})["score"], 0.4)

    def test_unreadable_costs_no_attempt(self):
        result = self.graded(self.submission("unreadable"))
        self.assertFalse(result["gradable"])
        self.assertEqual(len(result["format_errors"]), 2)

    def test_nothing_submitted(self):
        self.assertFalse(self.graded({})["gradable"])


if __name__ == "__main__":
    unittest.main()
