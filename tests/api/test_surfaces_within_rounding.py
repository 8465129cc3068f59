"""Walls, kicks, events and ends of validity that lie within rounding of each other or of the start, bands of force between
two kinks, and functions whose roots are multiple. A mass flies straight: fractions tell where it goes, to the last digit."""

import dataclasses
import pathlib
import random
import sys
import unittest
from fractions import Fraction

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, strict_json  # noqa: E402

mpmath.mp.dps = 50
mpf = mpmath.mpf
GOALS = [{}, {"method": "erk"}, {"accuracy": "fast"}, {"accuracy": "accurate"}]
UNBOUNDED = "have no bound of what may happen between the places that they look at."
NEAR = "comes as near to"


def decimal(x):
    digits = 30
    whole, rest = divmod(abs(x)*10**digits, 10**digits)
    return f"{'-' if x < 0 else ''}{whole}.{int(rest):0{digits}d}"


@dataclasses.dataclass
class Surface:
    """Zero of factor*(x - place)."""
    name: str
    kind: str  # wall, kick, event or end
    place: Fraction
    factor: Fraction
    direction: int  # 1 rising, -1 falling, 0 either
    number: Fraction  # restitution, or what a kick multiplies the speed by

    def speed_after(self, speed):
        return -self.number*speed if self.kind == "wall" else self.number*speed if self.kind == "kick" else speed

    def written(self):
        text = f"({decimal(self.factor)})*x - ({decimal(self.factor*self.place)})"
        if self.kind == "end":
            return {"name": self.name, "expression": text, "reason": "touch", "message": "It touches."}
        return {"name": self.name, "expression": text, **({"direction": "rising" if self.direction > 0 else "falling"} if self.direction else {})}

    def impact(self):
        how = {"restitution": decimal(self.number)} if self.kind == "wall" else {"map": {"x_dot": f"{decimal(self.number)}*x_dot"}}
        return {"event": self.name, **how}


def flight(x, v, end, surfaces):
    """Names of what is met, whether it ends the motion, and the state at the end."""
    def sign(value):
        return (value > 0) - (value < 0)

    t, met = Fraction(0), []
    sides = [sign(s.factor*(x - s.place)) for s in surfaces]
    if any(s.kind == "end" and side < 0 for s, side in zip(surfaces, sides)):
        return met, True, x, v
    while True:
        ahead = [((s.place - x)/v, k) for k, s in enumerate(surfaces) if v != 0 and sides[k]*s.factor*v < 0]
        time, k = min(ahead, default=(end, -1))
        if t + time >= end:
            return met, False, x + v*(end - t), v
        s, to, before = surfaces[k], -sides[k], v
        t, x = t + time, s.place
        if s.kind == "end":
            return met, True, x, v
        if s.direction in (0, to):
            met.append(s.name)
            v = s.speed_after(v)
        if before*v > 0:
            sides[k] = to


def scene(x, v, surfaces):
    events = [s.written() for s in surfaces if s.kind != "end"]
    made = {"events": events, "impacts": [s.impact() for s in surfaces if s.kind in ("wall", "kick")],
            "valid_while": [s.written() for s in surfaces if s.kind == "end"]}
    return {"name": "flying", "units": "none", "coordinates": [{"name": "x", "initial": decimal(x), "initial_rate": decimal(v)}],
            "lagrangian": "x_dot^2/2", **{name: value for name, value in made.items() if value}}


def forced(x, v, force):
    return {"name": "forced", "units": "none", "coordinates": [{"name": "x", "initial": mpmath.nstr(x, 20), "initial_rate": mpmath.nstr(v, 20)}],
            "lagrangian": "x_dot^2/2", "forces": [{"name": "f", "value": force, "along": "x"}]}


def plain(x):
    return mpmath.nstr(x, 40, min_fixed=-99, max_fixed=99)


class SurfacesWithinRounding(Service):
    def setUp(self):
        self.random = random.Random(1126)

    def motion(self, system, **more):
        return strict_json(self.post("simulate", {"system": system, "samples": 2, **more}).data)

    def draw(self, kinds, first_place, smallest, largest):
        """Surfaces in order of their names, the first one of the first kind, the others beside it."""
        pick, surfaces = self.random.choice, []
        for number, kind in enumerate(kinds):
            gap = Fraction(int(10**(self.random.uniform(smallest, largest) + 27)), 10**27)*pick((-1, 1))
            factor = Fraction(pick(("1", "0.3", "-0.7")))
            surfaces.append(Surface(f"s{number}", kind, first_place + (gap if number or smallest < -19 else 0), factor, pick((1, 1, 0)),
                                    Fraction(pick(("0.2", "0.5", "0.9") if kind == "wall" else ("2", "0.5", "3")))))
        return surfaces

    def directed(self, surfaces, v):
        for s in surfaces:
            way = 1 if s.factor*v > 0 else -1
            s.direction *= way
            if s.kind == "end" and way > 0:
                s.factor = -s.factor
        return surfaces

    def judge(self, answer, truth, where):
        """True where all is as it should be without a word of doubt."""
        met, ends, x, v = truth
        self.assertIn("accuracy", answer, (answer, where))
        accuracy = answer["accuracy"]
        reason = accuracy.get("reason", "").split(UNBOUNDED)[-1]
        told = bool(reason) or any(event["error"] is None for event in answer["events"])
        stopped = answer["status"] == "stopped"
        if accuracy["max_abs_error"] is None or told:
            return False
        self.assertEqual(sorted(event["name"] for event in answer["events"]), sorted(met), where)
        self.assertEqual(stopped, ends, (where, answer.get("stop")))
        for name, true in (() if stopped else (("x", x), ("x_dot", v))):
            off = abs(Fraction(answer["trajectory"][name][-1]) - true)
            self.assertLessEqual(off, Fraction(accuracy["max_abs_error"][name]), (name, where, accuracy))
        return True

    def rounds(self, kinds, smallest, largest, count, at_start=False):
        certain = 0
        for _ in range(count):
            x, v = (Fraction(self.random.randrange(*ends), 1000) for ends in ((-900, 900), (400, 2000)))
            v *= self.random.choice((-1, 1))
            away = Fraction(0) if at_start else Fraction(self.random.randrange(100, 900), 1000)
            surfaces = self.directed(self.draw(kinds, x + (away if v > 0 else -away), smallest, largest), v)
            end = Fraction(int(10000*(away/abs(v) + Fraction(self.random.randrange(200, 900), 1000))), 10000)
            request = {"t_end": float(end), "events": [s.name for s in surfaces if s.kind != "end"], **self.random.choice(GOALS)}
            certain += self.judge(self.motion(scene(x, v, surfaces), **request), flight(x, v, end, surfaces), (request, surfaces, x, v))
        return certain

    def test_just_before_the_start_and_just_after_it(self):
        for kind in ("wall", "kick", "event", "end"):
            self.assertGreater(self.rounds((kind,), -22, -16.5, 12, at_start=True), 8, kind)

    def test_behind_a_wall_or_a_kick(self):
        """What a wall turns the motion away from may not be met, and what a kick drives it to is."""
        certain = 0
        for kinds in (("wall", "kick"), ("wall", "event"), ("wall", "end"), ("kick", "event"), ("kick", "end"), ("kick", "kick")):
            certain += self.rounds(kinds, -19, -14, 12)
        self.assertGreater(certain, 15)

    def test_kicks_one_after_the_other(self):
        self.assertGreater(self.rounds(("kick", "kick"), -13, -10, 20), 15)

    def test_a_condition_that_ends_at_a_wall_holds(self):
        """The mass bounces where validity ends, and never leaves it."""
        surfaces = [Surface("s0", "wall", Fraction("-0.5"), Fraction(1), -1, Fraction("0.5")),
                    Surface("s1", "end", Fraction("-0.5"), Fraction(1), -1, Fraction(0))]
        answer = self.motion(scene(Fraction("0.25"), Fraction(-1), surfaces), t_end=2, events=["s0"])
        self.assertTrue(self.judge(answer, (["s0"], False, Fraction("0.125"), Fraction("0.5")), answer))

    def test_a_band_of_force_between_two_kinks(self):
        for _ in range(30):
            x, v, away = (mpf(self.random.randrange(*ends))/1000 for ends in ((-900, 900), (400, 2000), (100, 800)))
            width = mpf(mpmath.nstr(mpf(10)**self.random.uniform(-13, -6), 4))
            force = mpf(mpmath.nstr(v*v*self.random.uniform(0.2, 1.5)/width, 6))
            end = round(float(away/v) + self.random.uniform(0.2, 0.9), 4)
            faster = mpmath.sqrt(v*v + 2*force*width)
            true = x + away + width + faster*(mpf(str(end)) - away/v - 2*width/(v + faster))
            text = f"{plain(force)}*(sign(x - ({plain(x + away)})) - sign(x - ({plain(x + away + width)})))/2"
            answer = self.motion(forced(x, v, text), t_end=end, **self.random.choice(GOALS))
            errors = answer["accuracy"]["max_abs_error"]
            for name, value in (("x", true), ("x_dot", faster)):
                self.assertLessEqual(abs(answer["trajectory"][name][-1] - value), mpf(errors[name]), (name, text, end, answer["accuracy"]))

    def test_a_band_within_one_instant_has_no_error(self):
        """Its forces would change the speed in less than rounding of the time."""
        system = forced(mpf(0), mpf("1.2"), "166829000000000*(sign(x - 0.9379) - sign(x - 0.9379000000000123))/2")
        answer = self.motion(system, t_end=1.4656)
        errors = answer["accuracy"]["max_abs_error"]
        true = mpmath.sqrt(mpf("1.44") + 2*mpf("166829e9")*mpf("1.23e-14"))
        self.assertTrue(errors is None or abs(answer["trajectory"]["x_dot"][-1] - true) <= errors["x_dot"], answer)
        self.assertTrue(errors is not None or "within one instant" in answer["accuracy"]["reason"], answer)

    def test_a_kink_at_a_multiple_root(self):
        for power in (3, 3, 3, 5):
            x, v, away, jump = mpf("0.619"), mpf("-1.65"), mpf(self.random.randrange(2000, 6000))/10000, mpf("0.13")
            place = x - away
            terms = [f"({plain(mpmath.binomial(power, k)*(-place)**(power - k))})*x^{k}" for k in range(power + 1)]
            answer = self.motion(forced(x, v, f"-{plain(jump)}*(1 - sign({' + '.join(terms)}))"), t_end=0.7226)
            after = mpf("0.7226") - away/-v
            true = {"x": place + v*after - jump*after**2, "x_dot": v - 2*jump*after}
            for name, value in true.items():
                off = abs(answer["trajectory"][name][-1] - value)
                self.assertLessEqual(off, mpf(answer["accuracy"]["max_abs_error"][name]), (name, power, place))

    def test_at_rest_beside_a_kink(self):
        for place, way in (("0.7000000000000013", -1), ("0.70000000000000000013", -1), ("0.69999999999999999987", 1)):
            answer = self.motion(forced(mpf("0.7"), mpf(0), f"2*sign(x - {place})"), t_end=1)
            self.assertLess(answer["accuracy"]["max_abs_error"]["x"], 1e-14)
            self.assertAlmostEqual(answer["trajectory"]["x"][-1], 0.7 + way, delta=1e-14)

    def test_a_jump_through_zero_is_a_change_of_sign_and_a_pole_is_none(self):
        """Each function is larger at the jump than where the step began."""
        jump = "1.8*(x - 0.42) + 0.358 - 0.358*(1 + sign(x - 0.42))"
        made = {"valid_while": [{"name": "e", "expression": jump, "reason": "touch", "message": "It touches."}]}
        answer = self.motion({**forced(mpf("0.284756"), mpf("1.23"), "0.7"), **made}, t_end=0.18005)
        met = (-mpf("1.23") + mpmath.sqrt(mpf("1.23")**2 + mpf("1.4")*mpf("0.135244")))/mpf("0.7")
        self.assertEqual(answer["status"], "stopped")
        self.assertLessEqual(abs(answer["stop"]["t"] - met), mpf(answer["stop"]["error"]))
        answer = self.motion(forced(mpf(0), mpf(1), "0*x"), t_end=2, events=["1/(x - 0.3)=0", "tan(3*x)=0"])
        self.assertEqual([event["name"] for event in answer["events"]], ["tan(3*x)=0"])

    def test_events_of_a_fifth_power_beside_a_turning_point(self):
        place, square = mpf("0.30806878"), "7.149"
        terms = [f"({plain(mpmath.binomial(5, k)*(-place)**(5 - k))})*x^{k}" for k in range(6)]
        for goal in ({"max_error": 1e-9}, {"method": "taylor", "rtol": 1e-10}, {}):
            answer = self.motion(forced(mpf("-0.3081"), mpf(0), f"-{square}*x"), t_end=2.337, events=[" + ".join(terms) + "=0"], **goal)
            reason = answer["accuracy"].get("reason", "")
            self.assertTrue(NEAR in reason or "how often it happens" in reason or len(answer["events"]) == 2, answer)

    def test_a_level_that_is_nearly_reached_is_told(self):
        for away, told in (("1e-6", False), ("1e-17", True), ("-1e-17", True), ("-1e-6", False)):
            level = mpmath.nstr(mpf("0.3081") + mpf(away), 30)
            answer = self.motion(forced(mpf("-0.3081"), mpf(0), "-7.149*x"), t_end=2.337, events=[f"x={level}"])
            doubted = NEAR in answer["accuracy"].get("reason", "") or any(event["error"] is None for event in answer["events"])
            self.assertEqual(doubted, told, (away, answer))
            if not told:
                self.assertEqual(len(answer["events"]), 2 if away.startswith("-") else 0)


if __name__ == "__main__":
    unittest.main()
