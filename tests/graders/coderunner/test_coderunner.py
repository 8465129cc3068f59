"""A question graded as CodeRunner and Jobe do: the imported template is expanded, and run in a fresh directory as Python."""

import base64
import html
import json
import pathlib
import sys
import unittest
import xml.etree.ElementTree

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from sandbox import MOST_LINES, Setup, new_directory, run_confined, validate, writable  # noqa: E402


def twig_py(text):
    """The escaper e('py') of CodeRunner's templates."""
    return text.replace("\\", "\\\\").replace('"', '\\"')


class CodeRunner(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.setup = Setup(HERE)
        quiz = xml.etree.ElementTree.parse(cls.setup.directory / "question.xml").getroot()
        (cls.question,) = quiz.findall("question")
        cls.support = {file.get("name"): base64.b64decode(file.text) for file in cls.question.iter("file")}

    def graded(self, answer):
        """What the template prints for this content of the answer box."""
        program = self.question.findtext("template")
        program = program.replace("{{ QUESTION.globalextra | e('py') }}", twig_py(self.question.findtext("globalextra")))
        program = program.replace("{{ STUDENT_ANSWER | e('py') }}", twig_py(answer))
        self.assertNotIn("{{", program.replace("{{}}", ""))
        run_directory = writable(new_directory() / "run")
        for name, content in self.support.items():
            (run_directory / name).write_bytes(content)
        (run_directory / "__tester__.python3").write_text(program)
        run = run_confined(["/usr/bin/python3", "__tester__.python3"], run_directory,
                           2 * int(self.question.findtext("cputimelimitsecs")))
        self.assertEqual(run.returncode, 0, run.stderr)
        result = json.loads(run.stdout)
        validate(result, HERE)
        return result

    def submission(self, name):
        return (HERE / "submissions" / f"{name}.csv").read_text()

    def test_a_teacher_writes_little(self):
        self.assertLessEqual(self.setup.lines, MOST_LINES)

    def test_the_question_is_a_combinator_template_grader(self):
        self.assertEqual(self.question.get("type"), "coderunner")
        self.assertEqual((self.question.findtext("grader"), self.question.findtext("iscombinatortemplate")), ("TemplateGrader", "1"))
        self.assertEqual(self.question.findtext("defaultgrade"), "5")
        self.assertEqual(self.question.findtext("answerpreload"), "id,submitted\ntheta_max,\ntheta,\n")

    def rows(self, result):
        header, *rows = result["testresults"]
        shown = [name for name in header if name not in ("iscorrect", "ishidden")]
        self.assertEqual(len(result["columnformats"]), len(shown))
        self.assertTrue(all(len(row) == len(header) for row in rows))
        return [dict(zip(header, row)) for row in rows]

    def test_right(self):
        result = self.graded(self.submission("right"))
        self.assertEqual(result["fraction"], 1)
        self.assertEqual([row["iscorrect"] for row in self.rows(result)], [1, 1])

    def test_wrong(self):
        result = self.graded(self.submission("wrong"))
        self.assertEqual(result["fraction"], 0)
        self.assertEqual([row["iscorrect"] for row in self.rows(result)], [0, 0])
        self.assertIn("The sign is wrong.", self.rows(result)[0]["Result"])

    def test_what_is_submitted_is_shown_as_text(self):
        """A column of HTML holds nothing that a student wrote as HTML."""
        result = self.graded('id,submitted\ntheta_max,"<b onclick=x>1</b>"\n')
        text = self.rows(result)[0]["Result"]
        self.assertEqual(result["columnformats"][1], "%h")
        self.assertNotIn("<b", text.replace("<br>", ""))
        self.assertNotEqual(html.unescape(text), text)

    def test_unreadable(self):
        for answer in (self.submission("unreadable"), "", '"""', "\\", 'id,submitted\ntheta_max,"""\n'):
            with self.subTest(answer=answer):
                self.assertEqual(self.graded(answer)["fraction"], 0)

    def test_the_box_as_it_is_at_first(self):
        self.assertEqual(self.graded(self.question.findtext("answerpreload"))["fraction"], 0)


if __name__ == "__main__":
    unittest.main()
