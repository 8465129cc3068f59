"""No name of an anonymous namespace stands in two sources of a room.

The release build compiles many sources of a room as one, where the alphabet cuts them: two of one name that happen to
lie in different parts today meet when somebody adds a file, and the build stops in files that nobody touched.
"""

import pathlib
import re
import unittest

from test_includes import ROOT, plan, room_of

HIDDEN = re.compile(r"^namespace \{\n(.*?)^\}  // namespace$", re.MULTILINE | re.DOTALL)
# What begins in the first column: a type, or a function or a value, whose name stands before its bracket, brace or "=".
TYPE = re.compile(r"^(?:class|struct|enum class|enum|union) (\w+)", re.MULTILINE)
ALIAS = re.compile(r"^using (\w+)( = [^;]*;)", re.MULTILINE)
VALUE = re.compile(r"^(?!class|struct|enum|union|using|namespace|template|static_assert)\w[\w:<>,*& ]*?[ &*](\w+)(?:\[\w*\])?(\(|\{| =|;)", re.MULTILINE)


def hidden_names(text):
    """Types and values by their names; functions with the types of their arguments, by which they may differ; aliases
    with what they stand for, which two may share."""
    found = set()
    for part in HIDDEN.findall(text):
        found.update(TYPE.findall(part), map("".join, ALIAS.findall(part)))
        for value in VALUE.finditer(part):
            found.add(value[1] + (arguments(part, value.end()) if value[2] == "(" else ""))
    return found


def arguments(text, begin):
    """"(const Graph&, NodeId)" of what stands after an opening bracket."""
    end, depth = begin, 1
    while depth > 0:
        depth += {"(": 1, ")": -1}.get(text[end], 0)
        end += 1
    given = re.split(r",(?![^<]*>)", text[begin : end - 1])
    return "(" + ", ".join(re.sub(r"(?<=[\s&*>])\w+\s*$", "", " ".join(one.split())).strip() for one in given) + ")"


def shared_names(sources):
    """Sentences, for {file: text} of one room."""
    where = {}
    for file, text in sources.items():
        for name in hidden_names(text):
            where.setdefault(name.split(" = ")[0], []).append((file, name))
    for name in [name for name in where if "(" in name]:
        where[name] += where.get(name.split("(")[0], [])  # a function may share it with another, not with a value
    return [f"{name}: {', '.join(sorted(file for file, _ in found))}" for name, found in sorted(where.items()) if len(found) > 1 and not is_one_alias(found)]


def is_one_alias(found):
    return len({name for _, name in found}) == 1 and " = " in found[0][1]


class HiddenNames(unittest.TestCase):
    def test_no_two_sources_of_a_room_share_one(self):
        rooms = plan()
        sources = {}
        for house in ("core", "api", "server"):
            for path in sorted((ROOT / house).rglob("*.cpp")):
                name = path.relative_to(ROOT).as_posix()
                sources.setdefault(room_of(name, rooms), {})[name] = path.read_text(encoding="utf-8")
        self.assertGreater(sum(len(hidden_names(text)) for room in sources.values() for text in room.values()), 1000)
        self.assertEqual([sentence for room in sources.values() for sentence in shared_names(room)], [])


class TheSearchItself(unittest.TestCase):
    def test_finds_constants_functions_and_types(self):
        text = "namespace {\n\nconstexpr double a = 1;\nstd::string b(int x) {\n  int inner = 2;\n}\nstruct C {\n  int d;\n};\n\n}  // namespace\nint e() {}\n"
        self.assertEqual(hidden_names(text), {"a", "b(int)", "C"})

    def test_tells_which_files_share_one(self):
        text = "namespace {\nconstexpr double rounding = 1e-9;\n}  // namespace\n"
        self.assertEqual(shared_names({"a.cpp": text, "b.cpp": text}), ["rounding: a.cpp, b.cpp"])

    def test_tells_a_function_from_a_value_of_its_name(self):
        value, function, other = ("namespace {\n" + line + "\n}  // namespace\n" for line in (
            "constexpr double farthest = 1e-3;", "Reals farthest(Reals numbers) {", "Reals farthest(double x) {"))
        self.assertEqual(shared_names({"a.cpp": value, "b.cpp": function}), ["farthest(Reals): a.cpp, b.cpp"])
        self.assertEqual(shared_names({"a.cpp": other, "b.cpp": function}), [])


if __name__ == "__main__":
    unittest.main()
