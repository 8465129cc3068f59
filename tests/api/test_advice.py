"""Messages about scenes: what they advise is right when it is done."""

import json
import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

BEAD = {"name": "bead", "units": "none", "parameters": [{"name": "g", "default": 9.81}],
        "coordinates": [{"name": "x"}, {"name": "y"}], "lagrangian": "(x_dot^2 + y_dot^2)/2 - g*y",
        "constraints": [{"name": "wire", "expression": "y - x", "multiplier": "N"}]}


class Advice(Service):
    def errors(self, endpoint="energy", request=None, **fields):
        body = json.dumps({"system": BEAD | fields} | (request or {}))
        answer = self.raw("POST", f"/v1/{endpoint}", body=body)
        self.assertEqual(answer.status, 422, answer.data)
        return json.loads(answer.data)["errors"]

    def only(self, *arguments, **fields):
        errors = self.errors(*arguments, **fields)
        self.assertEqual(len(errors), 1, errors)
        return errors[0]

    def test_a_name_that_is_taken_is_said_once(self):
        error = self.only(coordinates=[{"name": "x"}, {"name": "y"}, {"name": "x"}])
        self.assertEqual((error["pointer"], error["detail"]),
                         ("#/system/coordinates/2/name", "The name 'x' is used twice."))

    def test_one_mistake_is_one_error(self):
        errors = self.errors("equilibria", {"solve_for": ["g"], "at": {"x": 1}})
        self.assertEqual([error["pointer"] for error in errors], ["#/solve_for"])

    def test_a_name_that_may_be_a_velocity_is_not_told_that_it_may_not(self):
        error = self.only(impacts=[{"event": "y", "map": {"y_ddot": "1"}}])
        self.assertIn("at the end _dot for a velocity but no _ddot", error["detail"])


if __name__ == "__main__":
    unittest.main()
