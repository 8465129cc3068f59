"""A submission graded as Gradescope's harness does: /autograder is laid out, run_autograder is run, results.json is read."""

import json
import pathlib
import shutil
import sys
import unittest
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from sandbox import MOST_LINES, Setup, new_directory, run_confined, unpack_bundle, validate, writable  # noqa: E402

PATIENCE = 20  # seconds; Gradescope itself waits for ten minutes


class Gradescope(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.setup = Setup(HERE)

    def graded(self, **files):
        """results.json for these submitted files."""
        autograder = new_directory() / "autograder"
        with zipfile.ZipFile(self.setup.directory / "autograder.zip") as archive:
            archive.extractall(autograder / "source")
        setup = (autograder / "source" / "setup.sh").read_text()
        self.assertIn("tar xf /autograder/source/qdot-bundle.tar.gz -C /autograder/source", setup)
        unpack_bundle(autograder / "source")  # as setup.sh does in its image
        shutil.copy(autograder / "source" / "run_autograder", autograder)
        (autograder / "run_autograder").chmod(0o755)
        (autograder / "submission").mkdir()
        for name, content in files.items():
            (autograder / "submission" / name.replace("_", ".")).write_text(content)
        writable(autograder / "results")
        run = run_confined([str(autograder / "run_autograder")], autograder, PATIENCE)
        self.assertEqual(run.returncode, 0, run.stderr)
        result = json.loads((autograder / "results" / "results.json").read_text())
        validate(result, HERE)
        return result

    def submission(self, name):
        return (HERE / "submissions" / f"{name}.csv").read_text()

    def test_a_teacher_writes_little(self):
        self.assertLessEqual(self.setup.lines, MOST_LINES)

    def test_right(self):
        tests = self.graded(answers_csv=self.submission("right"))["tests"]
        self.assertEqual([(test["score"], test["max_score"]) for test in tests], [(2, 2), (3, 3)])

    def test_wrong(self):
        tests = self.graded(answers_csv=self.submission("wrong"))["tests"]
        self.assertEqual([test["score"] for test in tests], [0, 0])
        self.assertIn("The sign is wrong.", tests[0]["output"])

    def test_json(self):
        tests = self.graded(answers_json='{"theta_max": 0.9622}')["tests"]
        self.assertEqual([test["score"] for test in tests], [2, 0])
        self.assertIn("There is no answer.", tests[1]["output"])

    def test_unreadable(self):
        result = self.graded(answers_csv=self.submission("unreadable"))
        self.assertEqual(result["score"], 0)
        self.assertIn("id,submitted", result["output"])

    def test_nothing_submitted(self):
        self.assertEqual(self.graded(notes_txt="none")["score"], 0)

    def test_a_file_that_is_a_million_lines(self):
        result = self.graded(answers_csv="id,submitted\n" + "theta_max,1\n" * 1_000_000)
        self.assertEqual(result["score"], 0)


if __name__ == "__main__":
    unittest.main()
