"""A method of integration and a printed form are added by their code and their record: nothing else goes by their
names, and what lists them for people lists all of them."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
NAMED = re.compile(r"\bMethod::(\w+)")
LIST = {"core/integrate/methods.hpp", "core/integrate/methods.cpp"}
# Motions are computed by the first unless another is asked for, stiff ones by the second, and a second road for
# what is short and smooth is the third.
CHOSEN = {"taylor", "bdf", "erk"}


def named(root=ROOT):
    """{file: the methods that it goes by}."""
    sources = [path for house in ("core", "api", "server") for path in (root / house).rglob("*.[ch]pp")]
    texts = {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8") for path in sources}
    return {name: set(NAMED.findall(text)) for name, text in texts.items() if name not in LIST}


def said_by_name(root=ROOT):
    """{file: the methods of a fixed step that its sentences name}, as "method gauss" does."""
    fixed = re.findall(r'MethodRecord\{Method::\w+, "(\w+)", "[^"]*",\s*Step::fixed', (root / "core/integrate/methods.cpp").read_text(encoding="utf-8"))
    said = re.compile(r'"[^"\n]*\b[Mm]ethod (' + "|".join(fixed) + r")\b")
    sources = [path for house in ("core", "api", "server") for path in (root / house).rglob("*.[ch]pp")]
    found = {path.relative_to(root).as_posix(): said.findall(path.read_text(encoding="utf-8")) for path in sources}
    return fixed, {name: methods for name, methods in found.items() if methods}


def printed_forms(root=ROOT):
    return re.findall(r'PrintForm\{Form::\w+, "(\w+)"', (root / "core/expr/print/print.cpp").read_text(encoding="utf-8"))


def listed_forms(root=ROOT):
    """{file: the forms that it lists}: the page's menu, the README and the Python client."""
    def text(name):
        return (root / name).read_text(encoding="utf-8")

    menu = re.search(r"const forms = \[(.*?)\n\];", text("server/web/view_equations.js"), re.DOTALL)
    sentence = re.search(r"`form` is ([^.]*)\.", text("README.md"))
    docstring = re.search(r"; form: ([^.]*)\.", text("api/clients/qdot.py"))
    return {
        "page": re.findall(r'\["(\w+)"', menu[1]),
        "README": re.findall(r"`(\w+)`", sentence[1]),
        "Python": re.findall(r"\b(?!or\b)\w+", docstring[1]),
    }


def method_records(root=ROOT):
    return re.findall(r'MethodRecord\{Method::\w+, "(\w+)"', (root / "core/integrate/methods.cpp").read_text(encoding="utf-8"))


def listed_methods(root=ROOT):
    """What the README lists, and what it tells about in the paragraph after the list."""
    listed, told = re.search(r"^`method` is ([^.]*)\.(.*?)\n\n", (root / "README.md").read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE).groups()
    return re.findall(r"`(\w+)`", listed), set(re.findall(r"`(\w+)`", told))


class Lists(unittest.TestCase):
    def test_no_sentence_calls_a_fixed_step_by_the_name_of_one_method(self):
        fixed, said = said_by_name()
        self.assertGreater(len(fixed), 0)
        self.assertEqual(said, {})

    def test_the_page_the_readme_and_the_python_client_list_every_printed_form(self):
        forms = printed_forms()
        self.assertGreater(len(forms), 4)
        for place, listed in listed_forms().items():
            self.assertCountEqual(listed, forms, place)

    def test_the_readme_lists_every_method_and_tells_what_it_is(self):
        methods = method_records()
        self.assertGreater(len(methods), 3)
        listed, told = listed_methods()
        self.assertCountEqual(listed, ["auto", *methods])
        self.assertEqual(set(listed) - told, set())

    def test_only_methods_that_are_chosen_unasked_are_named_outside_their_list(self):
        found = named()
        self.assertGreater(sum(map(len, found.values())), 5, "Hardly any method was found.")
        self.assertEqual({name: methods - CHOSEN for name, methods in found.items() if methods - CHOSEN}, {})


if __name__ == "__main__":
    unittest.main()
