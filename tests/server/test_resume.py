"""qdot batch --resume goes on behind answers to the very lines, and touches no other file."""

import json
import os
import unittest

from running_qdot import qdot
from test_batch import QUESTIONS, Batch, line, lines


class Resume(Batch):
    def refused(self, text, target):
        """What is said of going on in the file with these lines; it is as it was."""
        before = self.read(target)
        run = qdot("batch", self.path("other", text), "--output", target, "--resume")
        self.assertEqual((run.returncode, self.read(target)), (2, before), (run.stderr, before))
        return run.stderr.decode()

    def test_answers_to_other_lines_are_left_alone(self):
        text = lines(5)
        target = self.path("out")
        qdot("batch", self.path("in", text), "--output", target)
        whole = text.splitlines(keepends=True)
        for number in range(5):
            for other in (line(7, *QUESTIONS[0]), line("0", *QUESTIONS[0]), json.dumps({"energy": {"system": "kepler"}}) + "\n"):
                self.assertIn(f"line {number + 1} has another id",
                              self.refused("".join(whole[:number] + [other] + whole[number + 1:]), target))
            turned = "".join(whole[:number] + whole[number + 1:] + [whole[0]])
            self.assertIn(f"line {number + 1} has another id", self.refused(turned, target))
        self.assertIn("more of them than lines, of which there are 3", self.refused(lines(3), target))

    def test_lines_that_were_all_changed_are_noticed_under_the_same_ids(self):
        bare = "".join(json.dumps({"energy": {"system": "spring_pendulum", "parameters": {"k": k}}}) + "\n" for k in range(1, 6))
        for text, change in ((lines(5), ('"system"', '"digits": 5, "system"')), (bare, ('"k"', '"m"'))):
            target, changed = self.path("out"), text.replace(*change)
            self.assertNotEqual(changed, text)
            for answered in (1, 3, 5):
                with self.subTest(change=change, answered=answered):
                    qdot("batch", self.path("in", "".join(text.splitlines(keepends=True)[:answered])), "--output", target)
                    self.assertIn(f"line {answered} is another now", self.refused(changed, target))

    def test_files_that_no_batch_has_written_are_left_alone(self):
        for text in ("my only line", "my first line\nmy second", '{"title": "mine"}', '{"id": 0, "status": 3}',
                     '{"id":0,"modes":{}', '{"id":1,"sta', "[", "\n", "\n{", "\0\n", "\0{", '{\0"\0', '{"id":0,\0\n'):
            with self.subTest(text=text):
                self.refused(lines(5), self.path("out", text))
        self.refused("", self.path("out", '{"id":0,'))

    def test_half_a_line_is_answered_again_when_it_is_whole(self):
        """Whoever writes the lines may have been in the middle of one."""
        for text in (lines(5), "".join(json.dumps({"energy": {"system": "spring_pendulum"}}) + "\n" for _ in range(3))):
            whole, target = self.path("whole"), self.path("out")
            qdot("batch", self.path("in", text), "--output", whole)
            for cut in (1, 2, 40):
                half = text[:-cut]
                for more in ([], ["--resume"]):
                    self.assertEqual(qdot("batch", self.path("in", half), "--output", target, *more).returncode, 0)
                self.assertEqual(json.loads(self.read(target).splitlines()[-1])["status"] == 400, cut > 1)
                for torn in (0, 1, 30):
                    os.truncate(target, os.path.getsize(target) - torn)
                    run = qdot("batch", self.path("in", text), "--output", target, "--resume")
                    self.assertEqual((run.returncode, run.stderr), (0, b""))
                    self.assertEqual(self.read(target), self.read(whole))

    def test_what_a_machine_that_fell_had_not_written_is_done_again(self):
        """A file may have grown before its bytes came to the disk; they are NULs then."""
        source, target, whole = self.path("in", lines(20)), self.path("out"), self.path("whole")
        qdot("batch", source, "--output", whole)
        answers = self.read(whole)
        begin, end = answers.index(b'{"id":7,'), answers.index(b'{"id":8,')
        for written in (0, 1, 12, begin - 1, begin, begin + 1, begin + 12, end - 1, len(answers) - 1, len(answers)):
            for nuls, behind in ((1, b""), (5000, b""), (100000, b""), (30, answers[written + 30:])):
                if behind and written < begin:
                    continue  # what it is cannot be told before there are answers
                with self.subTest(written=written, nuls=nuls, behind=len(behind)):
                    with open(target, "wb") as file:
                        file.write(answers[:written] + nuls * b"\0" + behind)
                    run = qdot("batch", source, "--output", target, "--resume")
                    self.assertEqual((run.returncode, run.stderr), (0, b""))
                    self.assertEqual(self.read(target), answers)

    def test_a_long_first_answer_that_was_written_in_part_is_done_again(self):
        source = self.path("in", line(0, "simulate", {"system": "spring_pendulum", "t_end": 1, "samples": 500}) + lines(3))
        target, whole = self.path("out"), self.path("whole")
        qdot("batch", source, "--output", whole)
        answers = self.read(whole)
        for hole in (range(5000, len(answers)), range(5000, 9096)):
            with open(target, "wb") as file:
                file.write(answers[:hole.start] + len(hole) * b"\0" + answers[hole.stop:])
            run = qdot("batch", source, "--output", target, "--resume")
            self.assertEqual((run.returncode, run.stderr), (0, b""))
            self.assertEqual(self.read(target), answers)

    def test_ids_are_those_of_the_answers_as_they_are_written(self):
        text = "".join(f'{{"energy": {{"system": "kepler"}}, "id": {id_}}}\n' for id_ in
                       ('1.0', '1e2', '"a\\u0041"', 'null', '"' + 200 * "\\u0041" + '"', '""', '"x\\",\\"status"', '-0'))
        text += "x" * 3_000_000 + "\n" + '{"id": [1]}\nnull\n\n' + line(3, *QUESTIONS[0])
        source, target, whole = self.path("in", text), self.path("out"), self.path("whole")
        qdot("batch", source, "--output", whole)
        ends = [0]
        for answer in self.read(whole).splitlines(keepends=True):
            ends.append(ends[-1] + len(answer))
        for end in ends + [end + 11 for end in ends[:-1]]:
            with open(target, "wb") as file:
                file.write(self.read(whole)[:end])
            run = qdot("batch", source, "--output", target, "--resume")
            self.assertEqual((run.returncode, run.stderr), (0, b""))
            self.assertEqual(self.read(target), self.read(whole))


if __name__ == "__main__":
    unittest.main()
