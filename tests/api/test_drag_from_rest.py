"""Quadratic drag |v| v in the plane and in space where the speed is zero: at the start, or on the way."""

import copy
import json
import math
import pathlib
import sys
import unittest

import numpy
from scipy.integrate import solve_ivp

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from constrained_scenes import coordinates, parameters  # noqa: E402
from rigid_scenes import THROWN  # noqa: E402
from service import Service  # noqa: E402

MASS, DRAG, GRAVITY = 0.2, 0.03, 9.81

ON_A_SPRING = {
    "name": "on_a_spring",
    "parameters": parameters(m=("kg", "0.2"), c=("kg/m", "0.03"), k=("N/m", "3"), g=("m/s^2", "9.81")),
    "coordinates": coordinates(x=("m", "0.3", "0"), y=("m", "-0.2", "0"), z=("m", "0.1", "0")),
    "points": [{"name": "ball", "components": ["x", "y", "z"]}],
    "bodies": [{"kind": "particle", "mass": "m", "position": "ball"}],
    "potential": "k/2*(x^2 + 4*y^2 + z^2)",
    "dampers": [{"coefficient": "c", "law": "quadratic", "point": "ball"}],
    "gravity": [0, 0, "-g"],
}


def fallen(t):
    """Height and velocity after a fall from rest."""
    limit = math.sqrt(MASS * GRAVITY / DRAG)
    return -limit**2 / GRAVITY * math.log(math.cosh(GRAVITY * t / limit)), -limit * math.tanh(GRAVITY * t / limit)


def thrown(t, speed):
    """Height and velocity after a throw straight up."""
    limit = math.sqrt(MASS * GRAVITY / DRAG)
    angle = math.atan(speed / limit)
    top = limit / GRAVITY * angle
    highest = -limit**2 / GRAVITY * math.log(math.cos(angle))
    if t > top:
        height, rate = fallen(t - top)
        return highest + height, rate
    left = angle - GRAVITY * t / limit
    return highest + limit**2 / GRAVITY * math.log(math.cos(left)), limit * math.tan(left)


class DragFromRest(Service):
    def check(self, scene, known, **request):
        """Against numbers on paper, the stated error being believed; relative rounding is 1e-14."""
        answer = self.ask("simulate", {"system": scene, "t_end": 2, "samples": 21, **request})
        columns, errors = answer["trajectory"], answer["accuracy"]["max_abs_error"]
        for i, t in enumerate(columns["t"]):
            for name, value in known(t).items():
                self.assertLessEqual(abs(columns[name][i] - value), errors[name] + 1e-14 * max(1, abs(value)), (name, t))
        self.assertTrue(answer["accuracy"]["bounded"], answer["accuracy"])
        return answer

    def test_a_ball_that_is_dropped(self):
        def known(t):
            y, rate = fallen(t)
            return {"x": 0, "x_dot": 0, "y": y, "y_dot": rate}

        rest = {"x_dot": 0, "y_dot": 0}
        self.check(THROWN, known, initial=rest)
        answer = self.check(THROWN, known, initial=rest, max_error=1e-11)
        self.assertTrue(answer["accuracy"]["meets_request"], answer["accuracy"])

    def test_a_ball_that_is_thrown_straight_up(self):
        def known(t):
            y, rate = thrown(t, 9)
            return {"x": 0, "x_dot": 0, "y": y, "y_dot": rate}

        self.check(THROWN, known, initial={"x_dot": 0, "y_dot": 9})
        answer = self.check(THROWN, known, initial={"x_dot": 0, "y_dot": 9}, max_error=1e-10)
        self.assertTrue(answer["accuracy"]["meets_request"], answer["accuracy"])

    def test_a_fall_along_a_slope_is_the_same_fall(self):
        scene = copy.deepcopy(THROWN)
        scene["gravity"] = ["0.6*g", "-0.8*g"]

        def known(t):
            y, rate = fallen(t)
            return {"x": -0.6 * y, "x_dot": -0.6 * rate, "y": 0.8 * y, "y_dot": 0.8 * rate}

        self.check(scene, known, initial={"x_dot": 0, "y_dot": 0})

    def test_a_start_after_the_origin_of_time(self):
        def known(t):
            y, rate = fallen(t - 1e3)
            return {"y": y, "y_dot": rate}

        self.check(THROWN, known, initial={"x_dot": 0, "y_dot": 0}, t_start=1e3, t_end=1e3 + 1)

    def test_a_ball_on_a_spring_in_space_starts_at_rest(self):
        def rates(_, s):
            q, v = s[:3], s[3:]
            drag = DRAG * math.sqrt(v @ v) * v
            return [*v, *((-3 * q * (1, 4, 1) - drag) / MASS - (0, 0, GRAVITY))]

        # beside the start |v| v has its kink far away: steps that begin short see a smooth motion
        exact = solve_ivp(rates, (0, 2), [0.3, -0.2, 0.1, 0, 0, 0], method="DOP853", rtol=3e-14, atol=1e-15,
                          first_step=1e-5, dense_output=True)
        answer = self.ask("simulate", {"system": ON_A_SPRING, "t_end": 2, "samples": 9, "max_error": 1e-10})
        self.assertTrue(answer["accuracy"]["meets_request"], answer["accuracy"])
        for i, t in enumerate(answer["trajectory"]["t"]):
            found = [answer["trajectory"][n][i] for n in ("x", "y", "z", "x_dot", "y_dot", "z_dot")]
            numpy.testing.assert_allclose(found, exact.sol(t) if t < 2 else exact.y[:, -1], atol=3e-10)

    def test_events_and_rows_beside_the_start_count(self):
        answer = self.ask("simulate", {"system": THROWN, "initial": {"x_dot": 0, "y_dot": 0}, "t_end": 1, "events": [
            "y + 1e-20 = 0"], "times": [0, 1e-9, 1e-8, 1]})
        self.assertAlmostEqual(answer["events"][0]["t"] / math.sqrt(2e-20 / GRAVITY), 1, 6)
        for t, rate in zip(answer["trajectory"]["t"][1:], answer["trajectory"]["y_dot"][1:]):
            self.assertAlmostEqual(rate / fallen(t)[1], 1, 7)

    def test_what_has_more_than_one_solution_is_still_refused(self):
        # Norton's dome: sqrt(x) is not Lipschitz where it rests
        dome = {"name": "dome", "units": "none", "coordinates": [{"name": "x", "initial": "0", "initial_rate": "0"}],
                "bodies": [{"kind": "particle", "mass": "1", "position": ["x", 0]}],
                "forces": [{"value": "sqrt(x)", "along": "x"}]}
        self.refused("simulate", {"system": dome, "t_end": 1})


class DragAlongALine(Service):
    """Its size is |v|, whose kink the motion knows, and not a root of v^2."""

    def test_of_a_line_and_of_a_circle(self):
        pendulum = {"name": "pendulum", "parameters": parameters(m=("kg", "1"), l=("m", "0.8"), c=("kg/m", "0.2"),
                                                                 d=("kg*m^2", "0.1"), g=("m/s^2", "9.81")),
                    "coordinates": coordinates(theta=("rad", "1", "0")), "gravity": [0, "-g"],
                    "points": [{"name": "bob", "components": ["l*sin(theta)", "-l*cos(theta)"]}],
                    "bodies": [{"kind": "particle", "mass": "m", "position": "bob"}]}
        for damper, force in (({"coefficient": "c", "point": "bob"}, "0.2*0.8^3"), ({"coefficient": "d", "angle": "theta"}, "0.1")):
            scene = pendulum | {"dampers": [damper | {"law": "quadratic"}]}
            self.assertNotIn("sqrt", json.dumps(self.ask("equations", {"system": scene})["accelerations"]))
            factor = eval(force.replace("^", "**"))/0.8**2  # noqa: S307
            run = solve_ivp(lambda t, y: (y[1], -9.81/0.8*math.sin(y[0]) - factor*abs(y[1])*y[1]), (0, 3), (1, 0),
                            "DOP853", rtol=1e-12, atol=1e-13)
            answer = self.ask("simulate", {"system": scene, "t_end": 3, "samples": 4})
            self.assertTrue(answer["accuracy"]["bounded"])
            for name, truth in zip(("theta", "theta_dot"), run.y[:, -1]):
                error = answer["accuracy"]["max_abs_error"][name]
                self.assertLess(error, 1e-6)
                self.assertLessEqual(abs(answer["trajectory"][name][-1] - truth), error + 1e-10)


if __name__ == "__main__":
    unittest.main()
