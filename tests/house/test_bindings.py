"""No lambda captures a structured binding, which names a part and is no variable: GCC takes it, and Clang 14, which builds
the sanitizers, refuses it. "[a = a]" makes a variable of it."""

import re
import unittest

from test_includes import ROOT

ASIDE = re.compile(r'//[^\n]*|R"\(.*?\)"|"(?:\\.|[^"\\\n])*"|' + r"'(?:\\.|[^'\\\n])'", re.DOTALL)
BINDING = re.compile(r"\bauto\s*&{0,2}\s*\[([\w\s,]+)\]")
LAMBDA = re.compile(r"(?<![\w\])\[])\s*\[([^\[\]]*)\]\s*(?:\(([^{}]*?)\)[^{}();]*)?\{")


def closing(text, begin):
    """The place of the first bracket of any kind that closes what was opened before `begin`."""
    depth = 0
    for i in range(begin, len(text)):
        depth += (text[i] in "([{") - (text[i] in ")]}")
        if depth < 0:
            return i
    return len(text)


def scope(text, begin):
    """What follows a binding and may use it: the rest of the block, or the block that a loop repeats."""
    end = closing(text, begin)
    block = re.compile(r"\)[^;{]*\{").match(text, end)
    return text[begin : closing(text, block.end()) if block else end]


def captured(text):
    text, found = ASIDE.sub('""', text), set()
    for binding in BINDING.finditer(text):
        within = scope(text, binding.end())
        for function in LAMBDA.finditer(within):
            captures, body = re.split(r",\s*", function[1]), within[function.end() : closing(within, function.end())]
            for name in re.findall(r"\w+", binding[1]):
                made = re.search(rf"(?<![\w.])(?!return|else|throw|case)\w[\w:<>]*[&*]*\s+{name}\b|auto&{{0,2}} \[[^\]]*\b{name}\b", body)
                is_own = made or re.search(rf"\b{name} =", function[1]) or re.search(rf"\b{name}\b", function[2] or "")
                by_default = captures[0] in ("&", "=") and re.search(rf"(?<![\w.:])(?<!->){name}\b", body)
                if not is_own and (by_default or name in captures or "&" + name in captures):
                    found.add(name)
    return sorted(found)


class Bindings(unittest.TestCase):
    def test_are_captured_by_no_lambda(self):
        for path in (path for house in ("core", "api", "server", "tests") for path in (ROOT / house).rglob("*.?pp")):
            self.assertEqual(captured(path.read_text(encoding="utf-8")), [], path)

    def test_are_found_where_they_are_captured_and_nowhere_else(self):
        wrong = "[&a] { return a; }", "[this, a](int) { return a; }", "[&] { return f(a); }", "[=](int x) mutable { return x + a; }"
        right = "[a = a] { return a; }", "[&, &a = a] { return a; }", "[&](int a) { return a; }", "[&] { double a = 1; return a; }", "[&] { return x.a + y->a; }", "v[a]"
        for function in (*wrong, *right):
            for text in ("{ const auto [a, b] = pair; g(FUNCTION); }", "{ for (const auto& [a, b] : pairs) g(FUNCTION); }"):
                self.assertEqual(captured(text.replace("FUNCTION", function)), ["a"] if function in wrong else [], function)
        self.assertEqual(captured("{ for (const auto& [a, b] : c) f(a); double a; g([&] { return a; }); }"), [])


if __name__ == "__main__":
    unittest.main()
