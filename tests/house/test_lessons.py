"""Each header begins with its lesson: after "#pragma once" a comment of at least one whole sentence, which says what the
header is about before anybody meets its includes.
"""

import re
import unittest

from test_includes import ROOT

LESSON = re.compile(r"(?:#pragma once\n)?((?://.*\n)+)")  # bodies that are included many times have no #pragma
FEWEST_WORDS = 6  # "Numbers in sentences." is a title, not a sentence


def has_lesson(text):
    found = LESSON.match(text)
    words = " ".join(line.lstrip("/") for line in found[1].splitlines()).split() if found else []
    return len(words) >= FEWEST_WORDS and any(word.rstrip(")\"'").endswith((".", ":")) for word in words)


class Lessons(unittest.TestCase):
    def test_each_header_begins_with_one(self):
        headers = [path for house in ("core", "api", "server", "tests") for path in sorted((ROOT / house).rglob("*.hpp"))]
        self.assertGreater(len(headers), 500)
        without = [path.relative_to(ROOT).as_posix() for path in headers if not has_lesson(path.read_text(encoding="utf-8"))]
        self.assertEqual(without, [])


class TheSearchItself(unittest.TestCase):
    def test_wants_a_sentence_and_wants_it_first(self):
        lesson = "// A step is accepted only with a bound.\n"
        self.assertTrue(has_lesson("#pragma once\n" + lesson + "\n#include <span>\n"))
        self.assertFalse(has_lesson("#pragma once\n\n#include <span>\n\n" + lesson))
        self.assertFalse(has_lesson("#pragma once\n// Numbers in sentences.\n"))
        self.assertFalse(has_lesson("#pragma once\n// one two three four five six\n"))


if __name__ == "__main__":
    unittest.main()
