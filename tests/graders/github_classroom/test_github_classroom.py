"""A push graded as GitHub Classroom does: the workflow's steps are run with a shell in the repository, by the documents of
its command grader, and a step that ends with 0 earns its score.
"""

import pathlib
import shutil
import sys
import unittest

import yaml

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from sandbox import MOST_LINES, Setup, new_directory, run_confined, validate, writable  # noqa: E402

GRADER = "classroom-resources/autograding-command-grader@v1"


class GitHubClassroom(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.setup = Setup(HERE)
        cls.template = cls.setup.directory / "swing"
        cls.workflow = yaml.safe_load((cls.template / ".github" / "workflows" / "classroom.yml").read_text())
        (cls.job,) = cls.workflow["jobs"].values()

    def pushed(self, answers):
        """{test name: (score, log)} of the steps, in a checkout with these answers."""
        checkout = new_directory() / "swing"
        shutil.copytree(self.template, checkout)
        writable(checkout / ".github")
        (checkout / "answers.csv").write_bytes(answers)
        found = {}
        for step in self.job["steps"]:
            if step["uses"] == GRADER:
                asked = step["with"]
                run = run_confined(["bash", "-c", f"{asked['setup-command']}\n{asked['command']}"], checkout, 60 * asked["timeout"])
                found[asked["test-name"]] = (asked["max-score"] if run.returncode == 0 else 0, run.stdout + run.stderr)
        return found

    def submission(self, name):
        return (HERE / "submissions" / f"{name}.csv").read_bytes()

    def test_a_teacher_writes_little(self):
        self.assertLessEqual(self.setup.lines, MOST_LINES)

    def test_the_workflow_is_one_of_classrooms(self):
        validate(self.workflow, HERE)
        graders = [step for step in self.job["steps"] if step["uses"] == GRADER]
        (reporter,) = [step for step in self.job["steps"] if "reporter" in step["uses"]]
        ids = [step["id"] for step in graders]
        self.assertEqual(reporter["with"]["runners"], ",".join(ids))
        self.assertEqual(reporter["env"], {f"{name.upper()}_RESULTS": f"${{{{ steps.{name}.outputs.result }}}}" for name in ids})
        self.assertEqual([(step["with"]["test-name"], step["with"]["max-score"]) for step in graders], [("theta_max", 2), ("theta", 3)])

    def test_right(self):
        self.assertEqual(self.pushed(self.submission("right")), {"theta_max": (2, "Right.\n"), "theta": (3, "Right.\n")})

    def test_wrong(self):
        graded = self.pushed(self.submission("wrong"))
        self.assertEqual([score for score, _ in graded.values()], [0, 0])
        self.assertEqual(graded["theta_max"][1], "theta_max is not right. The sign is wrong.\n")

    def test_unreadable(self):
        answers = [self.submission("unreadable"), (self.template / "answers.csv").read_bytes(), b"", b"\xff\xfe",
                   b"id,submitted\ntheta_max,0.9\ntheta_max,0.96\n", b"id\ntheta_max\n"]
        for answer in answers:
            with self.subTest(answer=answer):
                graded = self.pushed(answer)
                self.assertEqual([score for score, _ in graded.values()], [0, 0])
                self.assertNotIn("Traceback", graded["theta_max"][1])


if __name__ == "__main__":
    unittest.main()
