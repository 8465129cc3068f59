"""Extrema of motions that are followed: beside a second coordinate, and with an impact on the way, each is within its
error. They are where the energy of x is all potential."""

import pathlib
import sys
import unittest

from mpmath import exp, findroot, log, mp, mpf, tanh

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mp.dps = 40

SECOND = " + y_dot^2/2 - 2*y^2 - y^4"
FUNCTIONS = {"exp": exp, "log": log, "tanh": tanh}


def potential(text):
    """As a function of x; decimals are those that are typed."""
    words = "".join(c if c.isalnum() or c in "._" else f" {c} " for c in text.replace("^", "**")).split()
    exact = [f"mpf('{word}')" if word[0].isdigit() and words[i - 2 : i] != ["*", "*"] else word
             for i, word in enumerate(words)]
    joined = " ".join(exact).replace("* *", "**")
    return lambda x: eval(joined, {"x": x, "mpf": mpf, **FUNCTIONS})  # noqa: S307


class FollowedExtrema(Service):
    def assert_extremum(self, answer, name, place, energy, v):
        known = findroot(lambda x: v(x) - energy, mpf(place))
        self.assertLessEqual(abs(mpf(answer[name]) - known), answer["error"][name], name)

    def motion(self, text, start, rate, beside="", **members):
        coordinates = f"x - {start} {rate}" + ("; y - 0.3 0.5" if beside else "")
        scene = lagrangian("followed", "", coordinates, f"x_dot^2/2 - ({text}){beside}", **members)
        del scene["parameters"]
        v = potential(text)
        return scene, v, mpf(rate) ** 2 / 2 + v(mpf(start))

    def test_beside_a_second_coordinate(self):
        motions = (
            ("7.9*x^2/2 + (-1.92)*exp(-((x - 1.65)/0.14)^2) + (-1.59)*tanh((x - 0.826)/0.068) + 0.313*log(1 + x^2)",
             "0.455", "0.552", 7.7, "-0.49", "0.49"),
            ("1.53*x^4/4 + (-0.0618)*log(1 + x^2)", "0.146", "1.86", 7.66, "-1.47", "1.47"),
        )
        for text, start, rate, end, lowest, highest in motions:
            with self.subTest(text):
                scene, v, energy = self.motion(text, start, rate, SECOND)
                answer = self.ask("turning_points", {"system": scene, "coordinate": "x", "t_end": end})
                self.assertEqual(answer["method"], "trajectory")
                self.assert_extremum(answer, "x_min", lowest, energy, v)
                self.assert_extremum(answer, "x_max", highest, energy, v)
                self.assertLess(answer["error"]["x_max"], 1e-13)

    def test_before_an_impact_on_the_way(self):
        motions = (
            ("0.542*x^2/2 + (-2.06)*exp(-((x - 1.99)/0.19)^2)", "0.205", "2.96", "0.617", 5.59, "0.8", "-3.24"),
            ("2.09*x^2/2 + (-1.58)*exp(-((x - 1.3)/0.15)^2)", "0.313", "-1.98", "0.969", 5.53, "0.8", "-1.4"),
        )
        for text, start, rate, wall, end, restitution, lowest in motions:
            with self.subTest(text):
                event = {"name": "w", "expression": f"{wall} - x", "direction": "falling"}
                impact = {"event": "w", "restitution": restitution}
                scene, v, energy = self.motion(text, start, rate, events=[event], impacts=[impact])
                answer = self.ask("turning_points", {"system": scene, "coordinate": "x", "t_end": end})
                if mpf(rate) > 0:  # the wall comes first, and takes a part of the speed
                    energy = v(mpf(wall)) + (energy - v(mpf(wall))) * mpf(restitution) ** 2
                self.assert_extremum(answer, "x_min", lowest, energy, v)
                self.assertLessEqual(abs(mpf(answer["x_max"]) - mpf(wall)), answer["error"]["x_max"])

    def test_times_have_errors(self):
        scene, _, _ = self.motion("4*x^2/2", "0.5", "0", SECOND)
        answer = self.ask("turning_points", {"system": scene, "coordinate": "x", "t_end": 2})
        self.assertLessEqual(abs(mpf(answer["t_min"]) - mp.pi / 2), answer["error"]["t_min"])


if __name__ == "__main__":
    unittest.main()
