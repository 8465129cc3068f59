"""No source calls libm's transcendental functions: glibc's have other bits where there is AVX2 or FMA. Those of
core/numerics/function.hpp and core/numerics/same_bits.hpp stand for them."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# In long double there is one road for all processors.
CALL = re.compile(r"std::(pow|exp|exp2|expm1|log|log2|log10|log1p|sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|asinh"
                  r"|acosh|atanh|cbrt|hypot)\(")
ALLOWED = {("core/numerics/eigenvalue_clusters.cpp", "hypot")}  # of long double


def calls(text):
    """(line, function) of each call, comments apart."""
    for number, line in enumerate(text.splitlines(), 1):
        for found in CALL.finditer(line.split("//")[0]):
            yield number, found[1]


class Libm(unittest.TestCase):
    def test_is_not_called_by_core_and_api(self):
        found = [f"{name}:{line} std::{function}"
                 for house in ("core", "api") for path in sorted((ROOT / house).rglob("*.[ch]pp"))
                 for name in [path.relative_to(ROOT).as_posix()]
                 for line, function in calls(path.read_text(encoding="utf-8")) if (name, function) not in ALLOWED]
        self.assertEqual(found, [])

    def test_a_call_would_be_found(self):
        self.assertEqual(list(calls("a = std::sqrt(x);\nb = std::pow(x, 2);  // std::exp(x)\n")), [(2, "pow")])


if __name__ == "__main__":
    unittest.main()
