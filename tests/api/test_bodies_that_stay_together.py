"""Plastic impacts: bodies that go on together meet once, whether nothing presses them or the motion ends there."""

import pathlib
import random
import sys
import unittest

from mpmath import mp, mpf

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

mp.dps = 30


class BodiesThatStayTogether(Service):
    def test_carts_that_stick_and_roll_on_meet_once(self):
        draw = random.Random(811)
        for _ in range(30):
            m, gap, v, u = draw.randint(5, 30)/10, draw.randint(3, 20)/10, draw.randint(10, 40)/10, draw.randint(-9, 9)/10
            scene = {"name": "carts", "units": "none", "lagrangian": f"x_dot^2/2 + {m}*y_dot^2/2",
                     "coordinates": [{"name": "x", "initial": "0", "initial_rate": str(v)},
                                     {"name": "y", "initial": str(gap), "initial_rate": str(u)}],
                     "events": [{"name": "w", "expression": "y - x", "direction": "falling"}],
                     "impacts": [{"event": "w", "restitution": "0"}]}
            with self.subTest(m=m, gap=gap, v=v, u=u):
                t_end = 3.71
                answer = self.ask("simulate", {"system": scene, "t_end": t_end, "samples": 2, "events": ["w"]})
                met = mpf(str(gap)) / (mpf(str(v)) - mpf(str(u)))
                together = (mpf(str(v)) + mpf(str(m)) * mpf(str(u))) / (1 + mpf(str(m)))
                happens = met < t_end
                self.assertEqual(len(answer["events"]), int(happens))
                self.assertNotIn("'w'", answer["accuracy"].get("reason", ""))
                place = mpf(str(v)) * met + together * (mpf(str(t_end)) - met) if happens else mpf(str(v)) * mpf(str(t_end))
                self.assertLessEqual(abs(answer["trajectory"]["x"][-1] - place), answer["accuracy"]["max_abs_error"]["x"] + 4e-16)
                if happens:
                    self.assertLessEqual(abs(answer["events"][0]["t"] - met), answer["events"][0]["error"])

    def test_three_that_stick_have_one_velocity_within_their_errors(self):
        """Two and two meet again and again, until rounding hides what is left."""
        for m, n, l, v, u, w in ((1.5, 2.3, 3, 2.7, 0.6, 0.2), (1, 1, 1, 2, 0.3, -0.1), (0.7, 4, 1.9, 3.1, 0, 0)):
            scene = {"name": "carts", "units": "none", "lagrangian": f"{m}*a_dot^2/2 + {n}*b_dot^2/2 + {l}*d_dot^2/2",
                     "coordinates": [{"name": name, "initial": place, "initial_rate": str(rate)}
                                     for name, place, rate in (("a", "0", v), ("b", "0.5", u), ("d", "0.9", w))],
                     "events": [{"name": "first", "expression": "b - a", "direction": "falling"},
                                {"name": "second", "expression": "d - b", "direction": "falling"}],
                     "impacts": [{"event": "first", "restitution": "0"}, {"event": "second", "restitution": "0"}]}
            answer = self.ask("simulate", {"system": scene, "t_end": 4, "samples": 13})
            exact = [mpf(str(number)) for number in (m, n, l, v, u, w)]
            together = sum(p*q for p, q in zip(exact, exact[3:])) / sum(exact[:3])
            for name in ("a_dot", "b_dot", "d_dot"):
                error = answer["accuracy"]["max_abs_error"][name]
                self.assertLessEqual(abs(answer["trajectory"][name][-1] - together), error, (m, name))
                self.assertLess(error, 1e-12)

    def test_four_that_stick_go_on_with_what_they_brought(self):
        """Each two of them would come together before the next one has a turn."""
        for masses, rates in (((2, 1.5, 1, 1.5), (3, 0, 0, -0.6)), ((0.3, 3, 0.5, 3), (3, 0.2, 0, -0.6)),
                              ((1.5, 1, 1, 1.5), (2.5, 0, -0.2, -0.9)), ((2, 0.3, 2, 0.5), (2, 0, 0, -0.9))):
            names = "abde"
            scene = {"name": "carts", "units": "none", "lagrangian": " + ".join(f"{m}*{n}_dot^2/2" for m, n in zip(masses, names)),
                     "coordinates": [{"name": n, "initial": place, "initial_rate": str(rate)}
                                     for n, place, rate in zip(names, ("0", "0.5", "0.9", "1.2"), rates)],
                     "events": [{"name": n, "expression": f"{n} - {m}", "direction": "falling"} for m, n in zip(names, names[1:])],
                     "impacts": [{"event": n, "restitution": "0"} for n in names[1:]]}
            answer = self.ask("simulate", {"system": scene, "t_end": 3, "samples": 4})
            self.assertEqual(answer["status"], "complete", masses)
            exact = [mpf(str(number)) for number in (*masses, *rates)]
            together = sum(m*v for m, v in zip(exact, exact[4:])) / sum(exact[:4])
            for name in names:
                error = answer["accuracy"]["max_abs_error"][f"{name}_dot"]
                self.assertLessEqual(abs(answer["trajectory"][f"{name}_dot"][-1] - together), error, (masses, name))
                self.assertLess(error, 1e-9)

    def test_forces_that_press_by_less_than_can_be_told_are_in_the_errors(self):
        """Pressed, they stay together: each is elsewhere than alone."""
        for m, n, gap, v, u, at_x, at_y in (("1.1", "1.9", "0.3", "1.8", "-0.5", "4.07", "7.029999999999981"),
                                            ("1", "2", "0.2", "1.5", "0", "3", "5.99999999999998"),
                                            ("0.8", "0.7", "0.5", "2", "0.4", "0.000000000000004", "0")):
            scene = {"name": "carts", "units": "none", "lagrangian": f"{m}*x_dot^2/2 + {n}*y_dot^2/2",
                     "coordinates": [{"name": "x", "initial": "0", "initial_rate": v}, {"name": "y", "initial": gap, "initial_rate": u}],
                     "forces": [{"name": "on_x", "along": "x", "value": at_x}, {"name": "on_y", "along": "y", "value": at_y}],
                     "events": [{"name": "w", "expression": "y - x", "direction": "falling"}],
                     "impacts": [{"event": "w", "restitution": "0"}]}
            answer = self.ask("simulate", {"system": scene, "t_end": 2, "samples": 3})
            m, n, gap, v, u, at_x, at_y = map(mpf, (m, n, gap, v, u, at_x, at_y))
            closer, faster = (at_x/m - at_y/n)/2, v - u
            met = 2*gap/(faster + mp.sqrt(faster**2 + 4*closer*gap))
            place = v*met + at_x/m*met**2/2
            speed = (m*(v + at_x/m*met) + n*(u + at_y/n*met))/(m + n)
            later, together = 2 - met, (at_x + at_y)/(m + n)
            for name, value in (("x", place + speed*later + together*later**2/2), ("x_dot", speed + together*later)):
                for column in (name, name.replace("x", "y")):
                    error = answer["accuracy"]["max_abs_error"][column]
                    self.assertLessEqual(abs(answer["trajectory"][column][-1] - value), error, (at_y, column))
                    self.assertLess(error, 1e-13)

    def test_forces_that_part_them_by_less_than_can_be_told_press_nothing(self):
        for m, n, gap, v, u, square in (("2.2", "2.5", "0.5", "3", "-0.1", "2.3"), ("1.6", "0.7", "0.7", "2.8", "0", "2.3"),
                                        ("1", "2.7", "0.4", "1.9", "0.4", "2.3"), ("0.9", "1.3", "0.6", "2.4", "-0.5", "2.3")):
            scene = {"name": "carts", "units": "none",
                     "lagrangian": f"{m}*x_dot^2/2 + {n}*y_dot^2/2 - {square}*({m}*x^2/2 + {n}*y^2/2)",
                     "coordinates": [{"name": "x", "initial": "0", "initial_rate": v}, {"name": "y", "initial": gap, "initial_rate": u}],
                     "forces": [{"name": "on_y", "along": "y", "value": f"{n}*1e-15"}],
                     "events": [{"name": "w", "expression": "y - x", "direction": "falling"}],
                     "impacts": [{"event": "w", "restitution": "0"}]}
            for t_end in (2, 4, 10):
                self.assertEqual(self.ask("simulate", {"system": scene, "t_end": t_end, "samples": 3})["status"], "complete", (m, t_end))

    def test_bodies_that_are_pressed_only_after_the_impact_do_not_run_through_each_other(self):
        """A bullet and a block that its spring holds at rest: nothing presses at the instant itself."""
        for potential, is_pressed in (("5*(b - 1)^2", True), ("2*(b - 1)^4", True), ("3*(b - 1)^3", True), ("0*b", False),
                                      ("-5*(b - 1)^2", False)):
            scene = {"name": "bullet", "units": "none", "lagrangian": f"a_dot^2/2 + b_dot^2 - ({potential})",
                     "coordinates": [{"name": "a", "initial": "0", "initial_rate": "3"}, {"name": "b", "initial": "1"}],
                     "events": [{"name": "c", "expression": "b - a", "direction": "falling"}],
                     "impacts": [{"event": "c", "restitution": "0"}]}
            with self.subTest(potential=potential):
                answer = self.ask("simulate", {"system": scene, "t_end": 0.8, "samples": 5, "events": ["c"]})
                self.assertEqual(len(answer["events"]), 1)
                self.assertEqual(answer["status"], "stopped" if is_pressed else "complete")
                rows = answer["trajectory"]
                for a, b in zip(rows["a"], rows["b"]):
                    self.assertGreater(b - a, -1e-12)

    def test_springs_that_pull_both_alike_leave_them_together(self):
        """Nothing presses and nothing parts them: whether they touch once more changes no more than rounding."""
        draw, told = random.Random(812), 0
        for _ in range(12):
            m, square, gap, v = draw.randint(5, 30)/10, draw.randint(3, 40)/10, draw.randint(2, 9)/10, draw.randint(10, 30)/10
            scene = {"name": "carts", "units": "none",
                     "lagrangian": f"x_dot^2/2 + {m}*y_dot^2/2 - {square}*(x^2/2 + {m}*y^2/2)",
                     "coordinates": [{"name": "x", "initial": "0", "initial_rate": str(v)}, {"name": "y", "initial": str(gap)}],
                     "events": [{"name": "w", "expression": "y - x", "direction": "falling"}],
                     "impacts": [{"event": "w", "restitution": "0"}]}
            with self.subTest(m=m, square=square, gap=gap, v=v):
                answer = self.ask("simulate", {"system": scene, "t_end": draw.choice((2, 2, 4)), "samples": 6})
                self.assertEqual(answer["status"], "complete")
                rate, y, u, mass = mp.sqrt(mpf(str(square))), mpf(str(gap)), mpf(str(v)), mpf(str(m))
                met = mp.atan(y * rate / u) / rate
                place = u / rate * mp.sin(rate * met)
                speed = (u * mp.cos(rate * met) - mass * y * rate * mp.sin(rate * met)) / (1 + mass)
                rows, errors = answer["trajectory"], answer["accuracy"]["max_abs_error"]
                for t, one, other in zip(rows["t"], rows["x"], rows["y"]):
                    later = mpf(t) - met
                    known = [place * mp.cos(rate * later) + speed / rate * mp.sin(rate * later)] * 2
                    if later < 0:
                        known = [u / rate * mp.sin(rate * mpf(t)), y * mp.cos(rate * mpf(t))]
                    self.assertLessEqual(abs(one - known[0]), errors["x"] + 2e-16)
                    self.assertLessEqual(abs(other - known[1]), errors["y"] + 2e-16)
                told += max(errors.values()) < 1e-6
        self.assertGreater(told, 10)

    def test_a_ball_lands_once_on_a_floor_that_moves_on(self):
        for speed in ("0.5", "-0.3", "0", "1.25"):
            scene = {"name": "lift", "units": "none", "lagrangian": "y_dot^2/2 - 9.81*y", "coordinates": [{"name": "y", "initial": "1"}],
                     "events": [{"name": "p", "expression": f"y - ({speed})*t", "direction": "falling"}],
                     "impacts": [{"event": "p", "map": {"y_dot": speed}}]}
            with self.subTest(speed=speed):
                answer = self.ask("simulate", {"system": scene, "t_end": 2, "samples": 2, "events": ["p"]})
                g, u = mpf("9.81"), mpf(speed)
                met = (-u + mp.sqrt(u * u + 2 * g)) / g
                self.assertEqual(len(answer["events"]), 1)
                self.assertLessEqual(abs(answer["events"][0]["t"] - met), answer["events"][0]["error"])
                self.assertIn("stay in contact, pressed together", answer["stop"]["message"])


if __name__ == "__main__":
    unittest.main()
