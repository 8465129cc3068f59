"""The trade of error against work, asked over HTTP."""

import math
import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, reference_cases  # noqa: E402

TRAJECTORY = next(case for case in reference_cases("trajectory") if case["system"] == "spring_pendulum")
MOTION = {key: TRAJECTORY[key] for key in ("system", "parameters", "initial", "times")}


class WorkPrecision(Service):
    def answer(self, **fields):
        return self.ask("accuracy", MOTION | fields)

    def test_a_point_has_the_error_that_it_states(self):
        """Asked again with simulate, against twenty digits computed elsewhere."""
        answer = self.answer()
        self.assertGreater(len(answer["points"]), 20)
        for point in answer["points"][::5]:
            setting = {key: point[key] for key in ("method", "rtol", "atol", "h") if key in point}
            if "rtol" in setting:
                setting["rtol"] = max(setting["rtol"], 1e-14)
            motion = self.ask("simulate", MOTION | setting | {"verify": False})
            for column, stated in point["max_abs_error"].items():
                true = max(abs(a - b) for a, b in zip(motion["trajectory"][column], TRAJECTORY["expected"][column]))
                self.assertLessEqual(true, stated + 1e-14, (setting, column))

    def test_the_front_and_the_recommendations_follow_from_the_points(self):
        answer = self.answer()
        points = [point for point in answer["points"] if point["error"] is not None]
        self.assertTrue(points and answer["recommendations"])
        for point in points:
            beaten = any(p["error"] <= point["error"] and p["evaluations"] <= point["evaluations"]
                         and (p["error"], p["evaluations"]) != (point["error"], point["evaluations"])
                         for p in points)
            self.assertEqual(point["on_front"], not beaten, point)
        for said in answer["recommendations"]:
            fits = [p["evaluations"] for p in points if p["error"] <= said["max_error"]]
            if fits:
                self.assertEqual(said["evaluations"], min(fits))
                self.assertLessEqual(said["error"], said["max_error"])
                self.assertIn(said["method"], said["text"])
            else:
                self.assertTrue(said["reason"])

    def test_one_wanted_error_and_some_methods(self):
        answer = self.answer(max_error=1e-8, methods=["erk", "taylor"])
        self.assertEqual({point["method"] for point in answer["points"]}, {"erk", "taylor"})
        self.assertEqual([said["max_error"] for said in answer["recommendations"]], [1e-8])
        self.assertEqual(answer, self.answer(max_error=1e-8, methods=["erk", "taylor"]))

    def test_what_no_method_reaches(self):
        said = self.answer(max_error=1e-14, t_end=5, methods=["erk", "adams"])["recommendations"][0]
        self.assertIsNone(said["method"])
        self.assertTrue(said["reason"])

    def test_time_is_measured_on_request_only(self):
        self.assertNotIn("measured", self.answer()["points"][0])
        for point in self.answer(measure=True, methods=["taylor"])["points"]:
            self.assertGreater(point["measured"]["cpu_us"], 0)
            self.assertTrue(math.isfinite(point["measured"]["cpu_us"]))

    def test_a_force_with_a_kink_is_compared_by_all_methods(self):
        answer = self.ask("accuracy", {"system": "forced_spring_pendulum", "inputs": {"F": "abs(sin(t))"}, "t_end": 3})
        self.assertEqual(answer["reference"]["method"], "taylor")
        self.assertIn("taylor", {point["method"] for point in answer["points"]})

    def test_bad_requests(self):
        self.refused_at("accuracy", {"system": "spring_pendulum"}, "#/t_end")
        self.refused_at("accuracy", MOTION | {"methods": []}, "#/methods")
        self.refused_at("accuracy", MOTION | {"methods": ["euler"]}, "#/methods/0")
        self.refused_at("accuracy", MOTION | {"rtol": 1e-6}, "#/rtol")


if __name__ == "__main__":
    unittest.main()
