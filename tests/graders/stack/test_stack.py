"""The Maxima of a STACK question, run as STACK runs it: question variables, a student's answers, feedback variables, the test
of a node. Maxima runs as nobody, without network, at half a CPU.
"""

import collections
import json
import pathlib
import sys
import unittest
import xml.etree.ElementTree

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from sandbox import ROOT, MOST_LINES, Setup, new_directory, run_confined, validate, writable  # noqa: E402

PATIENCE = 20  # seconds on half a CPU; STACK's own limit is ten on a whole one


class Stack(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.setup = Setup(HERE)
        cls.question = cls.read(cls.setup.directory)

    @staticmethod
    def read(directory):
        (question,) = xml.etree.ElementTree.parse(directory / "question.xml").getroot()
        return question

    def scores(self, answers, question=None):
        """Of each answer, 1 or 0. A statement that Maxima stops at has no value, as in STACK, and the others go on."""
        question = question or self.question
        statements = [question.findtext("questionvariables/text"), *[f"{answer}: {text};" for answer, text in answers.items()]]
        for tree in question.findall("prt"):
            node = tree.find("node")
            statements += [f"kill({node.findtext('sans')});", tree.findtext("feedbackvariables/text"),
                           f'print("{tree.findtext("name")}", is({node.findtext("sans")} = {node.findtext("tans")}));']
        program = "\n".join(f"errcatch({line.rstrip(';')});" for text in statements for line in text.splitlines())
        run = run_confined(["maxima", "--very-quiet", "--batch-string", program], "/", PATIENCE,
                           MAXIMA_USERDIR=str(writable(new_directory() / "maxima")))
        return [1 if f"\nprt_{answer} true" in run.stdout else 0 for answer in answers]

    def test_a_teacher_writes_little(self):
        self.assertLessEqual(self.setup.lines, MOST_LINES)

    def test_the_question_has_the_elements_of_one(self):
        elements = collections.defaultdict(list)
        for part in self.question.iter():
            elements[part.tag].append({child.tag: child.text or "" for child in part})
        validate(dict(elements), HERE)
        text = self.question.findtext("questiontext/text")
        for name in [part.findtext("name") for part in self.question.findall("input")]:
            self.assertIn(f"[[input:{name}]] [[validation:{name}]] [[feedback:prt_{name}]]", text)
        words = self.question.findall("input")[2].findtext("allowwords").split(", ")
        self.assertLessEqual({"theta_ddot", "psi_dot", "theta"}, set(words))
        self.assertEqual(self.question.findtext("defaultgrade"), "6")

    def test_right(self):
        for answers in json.loads((HERE / "submissions" / "right.json").read_text()):
            with self.subTest(answers=answers):
                self.assertEqual(self.scores(answers), [1, 1, 1])

    def test_wrong(self):
        for answers in json.loads((HERE / "submissions" / "wrong.json").read_text()):
            with self.subTest(answers=answers):
                self.assertEqual(self.scores(answers), [0, 0, 0])

    def test_the_questions_own_tests(self):
        for test in self.question.findall("qtest"):
            answers = {given.findtext("name"): given.findtext("value") for given in test.findall("testinput")}
            expected = [int(tree.findtext("expectedscore")) for tree in test.findall("expected")]
            self.assertEqual(self.scores(answers), expected)

    def test_the_keys_of_the_practice_sheet(self):
        """What these questions can hold of the ten keys passes its own tests."""
        for number in (4, 5, 6, 8, 10):
            key = json.loads((ROOT / "api" / "about" / "keys" / f"problem_{number}.json").read_text())
            key["items"] = [item for item in key["items"] if self.fits(item)]
            (self.setup.directory / "key.json").write_text(json.dumps(key))
            self.setup.carry_out("", "sh", f"python3 make_question.py 'Problem {number}' > question.xml")
            question = self.read(self.setup.directory)
            right, wrong = question.findall("qtest")
            for test, score in ((right, 1), (wrong, 0)):
                answers = {given.findtext("name"): given.findtext("value") for given in test.findall("testinput")}
                with self.subTest(problem=number, score=score):
                    self.assertEqual(self.scores(answers, question), [score] * len(answers))

    def test_ranges_stand_at_their_defaults(self):
        system = {"system": "rod_pendulum", "parameters": {"l": "$l", "g": "$g*2"}}
        key = {"ranges": {"l": {"values": [40, 70], "unit": "cm", "default": 70}, "g": {"values": [4, 5], "default": 4}},
               "items": [{"id": "V", "expect": {"expression": system, "of": "V"}}]}
        (self.setup.directory / "key.json").write_text(json.dumps(key))
        self.setup.carry_out("", "sh", "python3 make_question.py Rods > question.xml")
        question = self.read(self.setup.directory)
        self.assertEqual(self.scores({"ans1": "-8*m*7/10*(3/2*cos(theta) + cos(phi))"}, question), [1])
        self.assertEqual(self.scores({"ans1": "-8*m*4/10*(3/2*cos(theta) + cos(phi))"}, question), [0])

    @staticmethod
    def fits(item):
        expect = item["expect"]
        if "equation" in expect:
            return "of" in expect
        is_plain_number = not item.get("rule", {}).keys() - {"rtol"} and "*" not in expect.get("at", "*") and "is" not in expect
        return "expression" in expect or is_plain_number


if __name__ == "__main__":
    unittest.main()
