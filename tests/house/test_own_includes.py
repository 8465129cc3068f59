"""Each source includes, itself or through what it includes, the header of every function and type that it uses.

The release build compiles many sources of a room as one, so that a source sees what its neighbours include; the build
for editing compiles each by itself. What is looked for are names that a single header declares in the first column.
"""

import pathlib
import re
import unittest

from test_includes import INCLUDE, ROOT, reached

# Comments and what stands in quotes. An include has no names either, and the separator in 1'000 opens nothing.
SILENT = re.compile(r'//[^\n]*|R"(\w*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"|(?<!\w)\'(?:[^\'\\\n]|\\.)*\'|^#include[^\n]*', re.MULTILINE | re.DOTALL)
TYPE = re.compile(r"^(?:template <[^\n]*>\s)?(?:class|struct|enum class|enum|union) (?:\[\[\w+\]\] )?(\w+)(?= final| :| \{|;|\{)|^using (\w+) =", re.MULTILINE)
FUNCTION = re.compile(r"^(?:template <[^\n]*>\s)?(?:\[\[\w+\]\] )?(?:(?:inline|constexpr|extern) )*[\w:][\w:<>,*& ]*[ \n](\w+)\(", re.MULTILINE)
# Whatever declares a name for itself has its type before it: a member, a parameter, a lambda, an alias.
DECLARED = re.compile(r"(?:(\w+)|[>\]])(?:[*&]*|&&| \.\.\.)\s(\w+)(?=[({;=,):\[]| [={:])|(?:class|struct|enum class|enum|union|using|typename|class\.\.\.|concept) (\w+)")
NO_TYPE = {"return", "else", "case", "throw", "new", "delete", "co_return", "goto", "operator", "and", "or", "not", "do"}
# Tests have names of their own, and nothing is asked for a member or an element of a function.
NAMED = re.compile(r"^[A-Z][A-Z_]+\(\s*(\w+),\s*(\w+)", re.MULTILINE)
VALUE = re.compile(r"\b([a-z_]\w*)(?=\[|\.[a-z_])")
# A call, unless of a member or of another namespace, and a type by its capital.
USED = re.compile(r"(?<![\w.~])(?<!->)(?<!::)(?:qdot::)?(?:([a-z_]\w*)\(|([A-Z]\w*[a-z]\w*)\b)")


def spoken(text):
    return SILENT.sub(" ", text)


def declared(text):
    """What a text declares anywhere in it: what a header shows, and what a source calls its own."""
    return {name or kind for type_, name, kind in DECLARED.findall(text) if type_ not in NO_TYPE}.union(*NAMED.findall(text))


def shown(text):
    """The functions and types that a header declares at the level of a namespace."""
    return {name for pair in TYPE.findall(text) for name in pair if name} | set(FUNCTION.findall(text))


def used(text):
    return {function or type_ for function, type_ in USED.findall(text)}.difference(VALUE.findall(text))


def missing_includes(files):
    """Sentences, for {file: text} of a whole house. A text without its "#pragma once" is a part of what includes it."""
    texts = {file: spoken(text) for file, text in files.items()}
    arrows = {file: [other for other in INCLUDE.findall(text) if other in files] for file, text in files.items()}
    homes = {}
    for file, text in texts.items():
        for name in shown(text) if file.endswith(".hpp") else ():
            homes.setdefault(name, []).append(file)
    single = {name: found[0] for name, found in homes.items() if len(found) == 1}
    names = {file: declared(text) for file, text in texts.items()}
    uses = {file: used(text) & single.keys() for file, text in texts.items()}
    parts = {file for file, text in files.items() if file.endswith(".hpp") and "#pragma once" not in text}
    for file in sorted(files.keys() - parts):
        below = reached(arrows, file)
        for name in sorted(uses[file].union(*(uses[part] for part in below & parts))):
            if single[name] not in below and not any(name in names[other] for other in below):
                yield f"{file} uses {name}, but does not include {single[name]}"


class OwnIncludes(unittest.TestCase):
    def test_what_is_used_is_included(self):
        paths = [path for house in ("core", "api", "server", "tests") for path in sorted((ROOT / house).rglob("*.[ch]pp"))]
        files = {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8") for path in paths}
        self.assertGreater(len(files), 1000, "Hardly any source was found.")
        self.assertEqual(list(missing_includes(files)), [])


class TheSearchItself(unittest.TestCase):
    house = {
        "a.hpp": "#pragma once\n/// As b.\nstruct Motion {\n  double size() const;\n};\n[[nodiscard]] double round_off(double t);\n",
        "b.hpp": '#pragma once\n#include "a.hpp"\n',
    }

    def missing(self, text, file="c.cpp"):
        return list(missing_includes(self.house | {file: text}))

    def test_finds_a_function_and_a_type(self):
        self.assertEqual(
            self.missing("const double x = 2 * round_off(1);\nMotion motion;\n"),
            ["c.cpp uses Motion, but does not include a.hpp", "c.cpp uses round_off, but does not include a.hpp"],
        )
        self.assertEqual(len(self.missing("inline double x() { return qdot::round_off(1); }\n#pragma once\n", "c.hpp")), 1)

    def test_is_content_with_what_another_header_includes(self):
        self.assertEqual(self.missing('#include "b.hpp"\nMotion motion(round_off(1));\n'), [])

    def test_looks_past_comments_quotes_members_and_names_of_ones_own(self):
        self.assertEqual(self.missing('// round_off(1) of a Motion\nauto x = "Motion"; auto y = z.round_off(1), w = std::round_off(1);\n'), [])
        self.assertEqual(self.missing("TEST(Motion, Begins) {\n  std::vector<double> a(2), round_off(3);\n  round_off[0] = 1;\n}\n"), [])
        self.assertEqual(self.missing("double x(double (&round_off)(double));\nenum class Motion { up };\n"), [])
        self.assertEqual(self.missing("struct Motion;\nconst auto round_off = [] { return 1; };\nint x = round_off();\n"), [])

    def test_takes_a_text_that_is_included_twice_as_a_part_of_its_sources(self):
        self.house = self.house | {"body.hpp": "Motion part;\n"}
        self.assertEqual(len(self.missing('#include "body.hpp"\n')), 1)
        self.assertEqual(self.missing('#include "a.hpp"\n#include "body.hpp"\n'), [])


if __name__ == "__main__":
    unittest.main()
