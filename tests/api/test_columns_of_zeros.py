"""A column that is 0 all along has no size that an error could be compared with: what is kept for underflow is not what
keeps a promise from being met."""

import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402


def parameter(name, unit, default):
    return {"name": name, "unit": unit, "default": default}


# A block that is pulled on another one, both sliding: h is held at 0.
STACK = {"name": "stack", "gravity": ["0", "-g"],
         "parameters": [parameter("m", "kg", "1"), parameter("M", "kg", "2"), parameter("mu", "1", "0.3"),
                        parameter("F", "N", "12"), parameter("g", "m/s^2", "9.81")],
         "coordinates": [{"name": name, "unit": "m"} for name in ("X", "x", "h")],
         "bodies": [{"kind": "particle", "mass": "M", "position": ["X", "0"]},
                    {"kind": "particle", "mass": "m", "position": ["x", "h"]}],
         "constraints": [{"name": "on", "expression": "h", "multiplier": "N"}],
         "forces": [{"value": "-mu*N*sign(x_dot-X_dot)", "along": "x-X"}, {"value": "F", "along": "X"}]}


class ColumnsOfZeros(Service):
    def test_the_promise_is_met_beside_a_column_of_zeros(self):
        for accuracy in ("fast", "balanced", "accurate"):
            found = self.ask("simulate", {"system": STACK, "t_end": 1, "samples": 3, "accuracy": accuracy})["accuracy"]
            error = found["max_abs_error"]
            self.assertLess(error["h"], 1e-200)
            self.assertLess(error["X"], 1e-12)
            self.assertTrue(found["meets_request"], found.get("reason"))


if __name__ == "__main__":
    unittest.main()
