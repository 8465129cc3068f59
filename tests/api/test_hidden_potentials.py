"""Turning points and periods where a potential hides something between any two places that one may look at: kinks,
thin walls, narrow wells, fast harmonics, a maximum that is just not reached. Against mpmath at 40 digits."""

import pathlib
import random
import sys
import unittest

import mpmath
from mpmath import mpf

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

mpmath.mp.dps = 40
REFERENCE = mpf(10)**-30  # what the reference itself may be off


def typed(number):
    """The decimal that the request has for a double: what it asks about."""
    return mpf(repr(number))


def scene(coordinate, potential):
    """A particle of 1 kg on a line (x) or on a circle of 1 m (theta)."""
    line = coordinate == "x"
    return {"name": "hidden", "title": "A particle", "description": "A particle in a potential.",
            "parameters": [{"name": "m", "unit": "kg", "default": "1", "domain": "> 0"},
                           {"name": "u", "unit": "J", "default": "1"},
                           {"name": "a", "unit": "m", "default": "1", "domain": "> 0"}],
            "coordinates": [{"name": coordinate, "unit": "m" if line else "rad", "initial": "0"}],
            "points": [{"name": "p", "components": ["x", "0"] if line else ["a*sin(theta)", "-a*cos(theta)"]}],
            "bodies": [{"kind": "particle", "name": "p", "mass": "m", "position": "p"}],
            "potential": f"u*({potential})"}


class Corners:
    """V = k x^2/2 + sum s |x - c|: a parabola on each of its sides, so that everything has a closed form."""

    def __init__(self, k, corners):
        self.k, self.corners = mpf(k), sorted((mpf(c), mpf(s)) for c, s in corners)

    def text(self):
        return f"{float(self.k)!r}*(x/a)^2/2" + "".join(f" + ({float(s)!r})*abs(x/a - ({float(c)!r}))"
                                                        for c, s in self.corners)

    def __call__(self, x):
        return self.k*x*x/2 + sum(s*abs(x - c) for c, s in self.corners)

    def parabolas(self):
        """(from, to, b, e) with V = k x^2/2 + b x + e from one corner to the next."""
        places = [-mpmath.inf] + [c for c, _ in self.corners] + [mpmath.inf]
        for left, right in zip(places, places[1:]):
            signs = [(s if c <= left else -s, c) for c, s in self.corners]
            yield left, right, sum(s for s, _ in signs), -sum(s*c for s, c in signs)

    def bound(self, x0, energy, up):
        """The first place beyond x0 where V passes the energy; the sides are looked at in their order."""
        sides = list(self.parabolas())
        for left, right, b, e in sides if up else reversed(sides):
            if (right <= x0) if up else (left >= x0):
                continue
            root = mpmath.sqrt(max(mpf(0), b*b - 2*self.k*(e - energy)))
            if b*b - 2*self.k*(e - energy) <= 0:
                continue
            x = (-b + root)/self.k if up else (-b - root)/self.k  # where V rises in this direction
            if left <= x <= right and ((x > x0) if up else (x < x0)):
                return x
        raise AssertionError("it turns somewhere")

    def time(self, left, right, energy):
        """From one place to another: x'^2 = 2 (E - V) is a parabola, whose time is an arc of a sine."""
        total = mpf(0)
        for start, end, b, e in self.parabolas():
            p, q = max(left, start), min(right, end)
            if p < q:
                centre, amplitude = -b/self.k, mpmath.sqrt(b*b/self.k**2 - 2*(e - energy)/self.k)
                arc = [mpmath.asin(max(mpf(-1), min(mpf(1), (x - centre)/amplitude))) for x in (p, q)]
                total += (arc[1] - arc[0])/mpmath.sqrt(self.k)
        return total


class HiddenPotentials(Service):
    def within(self, answer, name, expected, relative=None):
        self.assertIsNotNone(answer[name], answer.get("reason"))
        error = mpf(answer["error"][name])
        self.assertLessEqual(abs(mpf(answer[name]) - expected), error + REFERENCE, (name, answer["request"]))
        if relative:
            self.assertLessEqual(error, relative*abs(expected), (name, answer["request"]))

    def test_corners(self):
        draw = random.Random(11)
        compared = 0
        for _ in range(40):
            dyadic = lambda low, high: draw.randint(32*low, 32*high)/32  # noqa: E731
            potential = Corners(dyadic(1, 3), [(dyadic(-3, 3), dyadic(-4, 4)) for _ in range(draw.randint(1, 4))])
            x0, rate = dyadic(-2, 2) + 1/128, dyadic(1, 3)
            energy = typed(rate)**2/2 + potential(typed(x0))
            answer = self.ask("turning_points", {"system": scene("x", potential.text()),
                                                 "initial": {"x": x0, "x_dot": rate}})
            low, high = (potential.bound(mpf(x0), energy, up) for up in (False, True))
            self.assertEqual(answer["motion"], "libration")
            self.within(answer, "x_max", high)
            self.within(answer, "x_min", low)
            self.within(answer, "period", 2*potential.time(low, high, energy))
            compared += 1
        self.assertEqual(compared, 40)

    def test_a_thin_wall_is_not_passed(self):
        draw = random.Random(12)
        for _ in range(25):
            width, height, place = 2**draw.randint(0, 20), draw.randint(1, 30), draw.randint(-40, 40)/8 or 1
            rate = draw.randint(1, 7)/8*mpmath.sqrt(2*height)
            rate = float(rate)*(1 if place > 0 else -1)
            wall = lambda x: height/(1 + (width*(x - mpf(place)))**2)  # noqa: B023, E731
            energy = typed(rate)**2/2 + wall(mpf(0))
            answer = self.ask("turning_points",
                              {"system": scene("x", f"{height}/(1 + ({width}*(x/a - ({place!r})))^2)"),
                               "initial": {"x": 0, "x_dot": rate}})
            if energy >= height:
                continue
            reach = mpmath.sqrt(height/energy - 1)/width
            self.within(answer, "x_max" if place > 0 else "x_min", place - reach if place > 0 else place + reach)
            self.assertEqual(answer["motion"], "unbounded")

    def test_fast_harmonics(self):
        for n, rate in ((3, 2.5), (32, 2.25), (32, 2.0009765625), (60, 2.125)):
            answer = self.ask("turning_points", {"system": scene("theta", f"cos({n}*theta)"),
                                                 "initial": {"theta": 0, "theta_dot": -rate}})
            self.assertEqual(answer["motion"], "rotation")
            most = typed(rate)**2/2 + 2  # the integral of 1/sqrt(2 (e - cos)) is a complete elliptic one
            self.within(answer, "period", 4*mpmath.ellipk(2/most)/mpmath.sqrt(2*most), 1e-11)

    def test_next_to_the_separatrix(self):
        for exponent in range(3, 50, 4):
            rate = 2 - 2.0**-exponent
            answer = self.ask("turning_points", {"system": scene("theta", "-cos(theta)"),
                                                 "initial": {"theta": 0, "theta_dot": rate}})
            k = typed(rate)/2
            self.within(answer, "theta_max", 2*mpmath.asin(k))
            self.within(answer, "period", 4*mpmath.ellipk(k*k), 1e-10)
            self.within(answer, "theta_max_deg", mpmath.degrees(2*mpmath.asin(k)))

    def test_a_barrier_that_is_just_passed(self):
        for exponent in range(5, 45, 3):
            place = 1.5 + 2.0**-exponent  # V = (x^2 - 9/8)^2, whose maximum is V(0) = V(3/2)
            height = (typed(place)**2 - mpf(9)/8)**2
            answer = self.ask("turning_points", {"system": scene("x", "((x/a)^2 - 9/8)^2"), "initial": {"x": place}})
            self.assertEqual(answer["motion"], "libration")
            self.within(answer, "x_min", -typed(place))
            # (A - z)(B + z) with z = x^2: an elliptic integral of modulus A/(A + B).
            root = mpmath.sqrt(height)
            outer, inner = mpf(9)/8 + root, root - mpf(9)/8
            period = 4*mpmath.ellipk(outer/(outer + inner))/mpmath.sqrt(2*(outer + inner))
            self.within(answer, "period", period, 1e-10)

    def test_a_narrow_well_shortens_the_period(self):
        for width in (2**8, 2**14, 2**17):
            answer = self.ask("turning_points",
                              {"system": scene("x", f"(x/a)^2/2 - 24/(1 + ({width}*(x/a - 1/4))^2)"),
                               "initial": {"x": 1}})
            potential = lambda x: x*x/2 - 24/(1 + (width*(x - mpf(1)/4))**2)  # noqa: B023, E731
            energy = potential(mpf(1))
            low = mpmath.findroot(lambda x: energy - potential(x), (-mpf(1), -mpf("0.999")), tol=mpf(10)**-70)
            rest = lambda x: (energy - potential(x))/((1 - x)*(x - low))  # noqa: E731
            phases = [mpmath.asin((mpf(1)/4 + sign*mpf(2)**k/width - (1 + low)/2)/((1 - low)/2))
                      for k in range(-2, int(mpmath.log(width, 2)) - 1) for sign in (-1, 1)]
            splits = sorted({-mpmath.pi/2, mpmath.pi/2, *phases})
            period = sum(mpmath.quad(lambda t: 2/mpmath.sqrt(2*rest((1 + low)/2 + (1 - low)/2*mpmath.sin(t))), [p, q],
                                     method="gauss-legendre", maxdegree=6) for p, q in zip(splits, splits[1:]))
            self.within(answer, "x_min", low)
            self.within(answer, "period", period, 1e-9)

    def test_a_condition_that_fails_between_places_fails(self):
        draw = random.Random(14)
        for _ in range(12):
            width, place = 10**draw.uniform(-4, -1), round(draw.uniform(-0.9, 0.9), 3)
            depth = draw.choice([0.5, 0.999, 1.001, 1.5])
            system = scene("x", "(x/a)^2/2")
            system["valid_while"] = [{"name": "grip", "unit": "1", "reason": "slips", "message": "It slips.",
                                      "expression": f"1 - {depth}*exp(-((x/a - ({place!r}))/{width!r})^2)"}]
            grip = self.ask("turning_points", {"system": system, "initial": {"x": 1}})["validity"]["grip"]
            self.assertEqual(grip["holds"], depth <= 1, system)
            self.assertLessEqual(abs(mpf(grip["min"]) - (1 - mpf(repr(depth)))), mpf(grip["error"]))
            self.assertLess(grip["error"], 1e-9)

    def test_a_singular_place_between_places_is_told(self):
        for expression, sentence in (("(x/a - 0.3)*(x/a - 0.3001)", "passes a singular place"),
                                     ("x/a - 1.0001", None), ("(x/a - 0.3)^2 + 1e-9", None)):
            system = scene("x", "(x/a)^2/2")
            system["singular_where"] = [{"name": "pole", "expression": expression, "message": "A pole."}]
            notes = self.ask("turning_points", {"system": system, "initial": {"x": 1}}).get("notes", [])
            self.assertEqual([sentence in note for note in notes], [True] if sentence else [], (expression, notes))


if __name__ == "__main__":
    unittest.main()
