"""A body that comes to rest on a wall that moves, speeds up or is tilted, or begins there: what pulls it onto the wall leaves
no motion, and it does not fall through. Against flights in closed form, along the distance g'' = -a."""

import pathlib
import random
import sys
import unittest
from decimal import Decimal

from mpmath import mp, mpf

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, strict_json  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mp.dps = 40
OPTIONS = ({}, {"accuracy": "accurate"}, {"accuracy": "fast"}, {"max_error": 1e-9}, {"method": "gauss", "h": 0.01})


class Body:
    """Along x, pulled by -f, above the wall x = p t + q t^2, or x = -b y where it moves along y as well."""

    def __init__(self, draw, begins):
        def number(low, high):
            return Decimal(str(round(draw.uniform(low, high), draw.choice((1, 2, 3, 4, 16)))))

        self.e = draw.choice(("0", "0", "0.5", "0.001", "3e-6", "2e-9", "7e-13")) if begins == "above" else draw.choice(("0", "0.5", "1"))
        pull, p, q, b, u = number(1, 10), number(-0.6, 0.6), number(-0.3, 0.3), number(-0.6, 0.6), number(-1, 1)
        x, v = (number(0.7, 1.5), number(-2, 2)) if begins == "above" else (number(0, 1), None)
        if draw.random() < 0.4:
            x = x if begins == "above" else Decimal(0)
            v = -b * u if v is None else v
            self.height, self.speed, self.fall = x, v + b * u, pull
            self.wall, place, kinetic = f"x + ({b})*y", f"x - {x} {v}; y - 0 {u}", "x_dot^2/2 + y_dot^2/2"
            self.turned = 1 + b * b  # an impact goes along the wall's normal
        else:
            v, offset = (p, x) if v is None else (v, Decimal(0))
            self.height, self.speed, self.fall = x - offset, v - p, pull + 2 * q
            self.wall, place, kinetic = f"x - ({offset}) - ({p})*t - ({q})*t^2", f"x - {x} {v}", "x_dot^2/2"
        self.scene = lagrangian("body", "", place, kinetic, forces=[{"name": "f", "value": f"-({pull})", "along": "x"}],
                                events=[{"name": "w", "expression": self.wall, "direction": "falling"}],
                                impacts=[{"event": "w", "restitution": self.e}])
        del self.scene["parameters"]

    def rests_at(self):
        height, speed, fall, e = (mpf(str(x)) for x in (self.height, self.speed, self.fall, self.e))
        if height == 0:
            return mpf(0)
        hit = mp.sqrt(speed**2 + 2 * fall * height)
        return (speed + hit) / fall + 2 * hit * e / (fall * (1 - e))


class ContactWithMovingWalls(Service):
    def each(self, begins, cases, seed):
        draw, told = random.Random(seed), 0
        for _ in range(cases):
            body, options = Body(draw, begins), draw.choice(OPTIONS)
            request = {"system": body.scene, "t_end": 12, "samples": 5, **options}
            with self.subTest(request=request):
                answer = self.ask("simulate", request)
                self.assertEqual((answer["status"], answer["stop"]["reason"]), ("stopped", "impacts_accumulate"))
                if "error" in answer["stop"]:
                    told += 1
                    self.assertLessEqual(abs(answer["stop"]["t"] - body.rests_at()), answer["stop"]["error"])
                else:
                    self.assertTrue(answer["accuracy"]["reason"])
                    self.assertLess(abs(answer["stop"]["t"] - body.rests_at()), 1e-3)
        return told

    def test_what_falls_comes_to_rest_when_it_should(self):
        self.assertGreater(self.each("above", 200, 1), 150)

    def test_what_begins_in_contact_stays_there(self):
        self.each("on it", 150, 2)

    def test_what_begins_on_a_wall_and_moves_onto_it_hits_it_however_slowly(self):
        for place, wall in (("x - 0.222 {}", "x - 0.222"), ("x - 0.521 {}", "x - 0.521"), ("x - 0.15136 {}; y - 0.172 0", "x - 0.88*y")):
            for rate in ("-2e-18", "-3e-24", "-1e-9", "0", "2e-18"):
                scene = lagrangian("body", "", place.format(rate), "x_dot^2/2" + (" + y_dot^2/2" if "y" in place else ""),
                                   forces=[{"name": "f", "value": "1.2", "along": "x"}],
                                   events=[{"name": "w", "expression": wall, "direction": "falling"}],
                                   impacts=[{"event": "w", "restitution": "0.5"}])
                del scene["parameters"]
                with self.subTest(rate=rate, wall=wall):
                    answer = self.ask("simulate", {"system": scene, "t_end": 1, "samples": 2, "events": ["w"]})
                    self.assertEqual([event["t"] for event in answer["events"]], [0] if rate.startswith("-") else [])

    def test_a_wall_that_kicks_by_little_is_no_place_of_rest(self):
        """Each flight is as long as the one before: there are more of them than are computed, or than are seen."""
        for kick in ("1e-8", "3e-9", "2e-11", "1e-13", "1e-15"):
            for wall, least in (("x", "0"), ("x - 0.2*t", "0.2")):
                scene = lagrangian("body", "", "x - 0.707 0.406", "x_dot^2/2", forces=[{"name": "f", "value": "-4.308", "along": "x"}],
                                   events=[{"name": "w", "expression": wall, "direction": "falling"}],
                                   impact={"event": "w", "map": {"x_dot": f"{least} + {kick}"}})
                del scene["parameters"]
                with self.subTest(kick=kick, wall=wall):
                    response = self.post("simulate", {"system": scene, "t_end": 2, "samples": 3, "max_evaluations": 20000})
                    answer = strict_json(response.data)
                    if response.status == 200 and float(kick) > 1e-14:
                        self.assertNotIn("error", answer["stop"])
                        self.assertNotIn("contact", answer["stop"]["message"])
                    elif response.status != 200:
                        self.assertEqual((response.status, answer["type"]), (422, "/errors/integration-failed"))

    def test_forces_that_lift_end_no_motion(self):
        """A body that loses its speed at the wall, where the force -a + j t has changed its sign, and that leads away."""
        for place, rate, pull, rise in (("0.841", "-1.278", "1.824", "5.339"), ("0.8", "-1.18", "1.454", "4.058"), ("0.63", "-0.4", "2.369", "3.467")):
            for wall in ("x", "x - 0.1*t", "x + 0.2*t"):
                scene = lagrangian("body", "", f"x - {place} {rate}", "x_dot^2/2", forces=[{"name": "f", "value": f"-{pull} + {rise}*t", "along": "x"}],
                                   events=[{"name": "w", "expression": wall, "direction": "falling"}], impacts=[{"event": "w", "restitution": "0"}])
                del scene["parameters"]
                with self.subTest(place=place, wall=wall):
                    answer = self.ask("simulate", {"system": scene, "t_end": 3, "samples": 2, "events": ["w"]})
                    hit = answer["events"][0]["t"]
                    rise_at = mpf(rise) * hit - mpf(pull)
                    self.assertEqual(answer["status"], "complete" if rise_at > 0 else "stopped")
                    if rise_at > 0:
                        self.assertEqual(len(answer["events"]), 1)
                        left, speed = 3 - mpf(hit), mpf(answer["events"][0]["state"]["x"])
                        carried = {"x": 0, "x - 0.1*t": mpf("0.1"), "x + 0.2*t": mpf("-0.2")}[wall]
                        known = speed + carried * left + rise_at * left**2 / 2 + mpf(rise) * left**3 / 6
                        self.assertLess(abs(answer["trajectory"]["x"][-1] - known), 1e-12)

    def test_a_force_that_presses_and_lifts_soon_leaves_no_way_through(self):
        scene = lagrangian("body", "", "x - 0.501 0.448", "x_dot^2/2", forces=[{"name": "f", "value": "-2.481 + 2.066*t", "along": "x"}],
                           events=[{"name": "w", "expression": "x", "direction": "falling"}], impacts=[{"event": "w", "restitution": "0"}])
        del scene["parameters"]
        answer = self.ask("simulate", {"system": scene, "t_end": 2, "samples": 3, "accuracy": "accurate"})
        self.assertEqual((answer["status"], answer["stop"]["reason"]), ("stopped", "impacts_accumulate"))

    def test_an_end_just_before_impacts_accumulate_may_be_reached(self):
        scene = lagrangian("body", "", "x - 0.256 -0.866", "x_dot^2/2", forces=[{"name": "f", "value": "-5.097", "along": "x"}],
                           events=[{"name": "w", "expression": "x", "direction": "falling"}], impacts=[{"event": "w", "restitution": "0.5"}])
        del scene["parameters"]
        for end, told in ((0.9089228688315784, True), (0.908922869, True), (1.2, False)):
            with self.subTest(end=end):
                answer = self.ask("simulate", {"system": scene, "t_end": end, "samples": 2})
                self.assertLessEqual(answer["t_reached"], end)
                self.assertEqual("may come to its end" in answer["accuracy"].get("reason", ""), told)

    def test_an_impact_where_the_motion_ends_is_in_doubt(self):
        for place, rate, end in (("0.21", "-0.7", 0.3), ("0.5", "-1", 0.5), ("0.42", "-0.6", 0.7)):
            scene = lagrangian("body", "", f"x - {place} {rate}", "x_dot^2/2",
                               events=[{"name": "w", "expression": "x", "direction": "falling"}],
                               impacts=[{"event": "w", "restitution": "0.5"}])
            del scene["parameters"]
            with self.subTest(place=place, rate=rate):
                for later in (0, -0.01, 0.01):
                    answer = self.ask("simulate", {"system": scene, "t_end": end + later, "samples": 2, "events": ["w"]})
                    self.assertEqual("at_impacts" in answer["accuracy"], later == 0)
                    self.assertEqual("w" in answer["accuracy"].get("reason", ""), later == 0)
                    self.assertEqual(len(answer["events"]), 1 if later > 0 else 0)


if __name__ == "__main__":
    unittest.main()
