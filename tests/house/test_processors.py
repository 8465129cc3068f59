"""What knows of instruction sets compiles for arm64, too: the sources that ask for one, and those that include who does."""

import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMPILER = "aarch64-linux-gnu-g++"
# What SLEEF's header has there and may lack here.
PAIRS = """
#include <arm_neon.h>
struct PairOfPairs { float64x2_t x, y; };
PairOfPairs Sleef_cinz_sincosd2_u10advsimdnofma(float64x2_t);
float64x2_t Sleef_cinz_powd2_u10advsimdnofma(float64x2_t, float64x2_t);
"""
ASKS = re.compile(r"__x86_64__|__aarch64__|__FMA__")


def sources():
    asking = [path for path in sorted((ROOT / "core").rglob("*.?pp")) if ASKS.search(path.read_text())]
    headers = [f'#include "{path.relative_to(ROOT)}"' for path in asking if path.suffix == ".hpp"]
    including = [path for path in sorted((ROOT / "core").rglob("*.cpp"))
                 if any(header in path.read_text() for header in headers)]
    return sorted({path for path in asking + including if path.suffix == ".cpp"})


class Processors(unittest.TestCase):
    def test_they_compile_for_arm64(self):
        names = [str(path.relative_to(ROOT)) for path in sources()]
        self.assertLessEqual({"core/integrate/series_at_four.cpp", "core/compile/compiled_function.cpp",
                              "core/compile/extended/kernels_plain.cpp"}, set(names))
        with tempfile.TemporaryDirectory() as place:
            here = next(pathlib.Path("/usr/include").glob("*/sleef.h"))
            (pathlib.Path(place) / "sleef.h").write_text(here.read_text() + PAIRS)
            done = subprocess.run([COMPILER, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-Wno-psabi",
                                   "-ffp-contract=off", "-fsigned-char", f"-I{ROOT}", "-isystem", place, "-isystem",
                                   "/usr/include/eigen3", *names], cwd=ROOT, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr[-3000:])


if __name__ == "__main__":
    unittest.main()
