"""A method of integration is added by its stepper and its record: nothing else goes by its name."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
NAMED = re.compile(r"\bMethod::(\w+)")
LIST = {"core/integrate/methods.hpp", "core/integrate/methods.cpp"}
# Motions are computed by the first unless another is asked for, stiff ones by the second, and a second road for
# what is short and smooth is the third; adams is what a request has before its method is set.
CHOSEN = {"taylor", "bdf", "erk", "adams"}


def named(root=ROOT):
    """{file: the methods that it goes by}."""
    sources = [path for house in ("core", "api", "server") for path in (root / house).rglob("*.[ch]pp")]
    texts = {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8") for path in sources}
    return {name: set(NAMED.findall(text)) for name, text in texts.items() if name not in LIST}


class Lists(unittest.TestCase):
    def test_only_methods_that_are_chosen_unasked_are_named_outside_their_list(self):
        found = named()
        self.assertGreater(sum(map(len, found.values())), 5, "Hardly any method was found.")
        self.assertEqual({name: methods - CHOSEN for name, methods in found.items() if methods - CHOSEN}, {})


if __name__ == "__main__":
    unittest.main()
