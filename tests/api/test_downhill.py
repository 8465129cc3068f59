"""'modes' without a place is about the one in which strong damping would bring the system to rest: the next
minimum down from 'initial', on the near side of every ridge."""

import os
import pathlib
import random
import sys
import unittest

from mpmath import asin, findroot, mp, mpf, pi, sin
from scipy.integrate import solve_ivp

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

mp.dps = 30
CASES = int(os.environ.get("QDOT_DOWNHILL_CASES", "60"))


class Wavy:
    """V = sum of a cos(k x + p) + b x + c x^2, with decimals."""

    def __init__(self, draw):
        self.waves = [(round(draw.uniform(0.1, 1), 3), round(draw.uniform(0.5, 6), 3), round(draw.uniform(-3, 3), 3))
                      for _ in range(draw.randint(1, 3))]
        self.b, self.c = round(draw.uniform(-0.5, 0.5), 3), round(draw.uniform(0.01, 0.2), 3)

    def text(self, x):
        return "+".join(f"{a}*cos({k}*{x}+({p}))" for a, k, p in self.waves) + f"+({self.b})*{x}+{self.c}*{x}^2"

    def slope(self, x):
        return sum(-a*k*sin(k*x + p) for a, k, p in self.waves) + self.b + 2*self.c*x

    def start(self, draw):
        """Two of three beside a crest."""
        x = round(draw.uniform(-15, 15), 3)
        if draw.random() < 0.33:
            return x
        while not self.slope(x) > 0 >= self.slope(x + 0.01):
            x += 0.01
            if x > 15:
                return x
        crest = findroot(self.slope, (x, x + 0.01), solver="anderson")
        return round(float(crest) + draw.choice((-1, 1))*10**draw.uniform(-7, -1.3), 10)

    def rest(self, start):
        """The first zero of the slope downhill, by steps a hundred times shorter than the shortest wave."""
        x, down, step = mpf(repr(start)), -1 if self.slope(start) > 0 else 1, mpf("1e-6")
        while (self.slope(x + down*step) > 0) == (down < 0):
            x, step = x + down*step, min(2*step, mpf("0.01"))
        return findroot(self.slope, (x, x + down*step), solver="anderson")


def particle(lagrangian, **initial):
    return {"name": "particle", "units": "none", "lagrangian": lagrangian,
            "coordinates": [{"name": name, "initial": str(value)} for name, value in initial.items()]}


def on_surface(constraint, gravity, **initial):
    names = list(initial)
    return {"name": "slide", "units": "none", "bodies": [{"kind": "particle", "mass": "1", "position": names}],
            "gravity": gravity, "coordinates": [{"name": name, "initial": str(value)} for name, value in initial.items()],
            "constraints": [{"name": "surface", "expression": constraint}]}


class Downhill(Service):
    def place(self, system):
        found = self.ask("modes", {"system": system})
        return found["equilibrium"], found.get("notes", [])

    def assert_rest(self, system, truth, within=1e-9):
        place, notes = self.place(system)
        for name, value in truth.items():
            self.assertAlmostEqual(place["state"][name], float(value), delta=within, msg=str(system))
        self.assertEqual((place["stability"], notes), ("stable", []))

    def test_beside_a_crest_the_next_well_is_found_on_either_side(self):
        for start in ("0.01", "-0.02", "0.03", "0.1"):
            self.assert_rest(particle("x_dot^2/2 - (cos(x) + 0.1*x)", x=start), {"x": -pi - asin(mpf(1)/10)})
        self.assert_rest(particle("x_dot^2/2 - (cos(x) + 0.1*x)", x="0.101"), {"x": pi - asin(mpf(1)/10)})

    def test_a_square_that_rounding_puts_below_zero_is_not_leapt_over(self):
        """x^2 - 2 sqrt(2) x + 2 under a root is |x - sqrt(2)|: a crest, behind which another well lies."""
        hill = "-1.3*sqrt(x^2 - 2*sqrt(2)*x + 2) + x^2/2 - 0.2*x"
        self.assert_rest(particle(f"x_dot^2/2 - ({hill})", x="1.73"), {"x": 1.5})

    def test_random_waves_along_a_line(self):
        draw = random.Random(63)
        for _ in range(CASES):
            wavy = Wavy(draw)
            start = wavy.start(draw)
            self.assert_rest(particle(f"x_dot^2/2 - ({wavy.text('x')})", x=start), {"x": wavy.rest(start)})

    def test_random_waves_along_a_curve(self):
        draw = random.Random(64)
        for _ in range(CASES // 2):
            wavy = Wavy(draw)
            start = wavy.start(draw)
            curve = on_surface(f"y - ({wavy.text('x')})", ["0", "-9.81"], x=start, y=wavy.text(f"({start})"))
            self.assert_rest(curve, {"x": wavy.rest(start)})

    def test_random_waves_in_a_plane(self):
        draw = random.Random(65)
        for _ in range(CASES // 2):
            waves = [[round(draw.uniform(-3, 3), 2) for _ in range(4)] for _ in range(3)]
            text = "+".join(f"({a/4})*cos(({k})*x + ({l})*y + ({p}))" for a, k, l, p in waves)
            start = [round(draw.uniform(-4, 4), 2) for _ in range(2)]

            def down(_, q, waves=waves):
                parts = [(a/4*float(sin(k*q[0] + l*q[1] + p)), k, l) for a, k, l, p in waves]
                return [sum(s*k for s, k, _ in parts) - 0.2*q[0], sum(s*l for s, _, l in parts) - 0.2*q[1]]

            rest = solve_ivp(down, (0, 1000), start, method="LSODA", rtol=1e-10, atol=1e-12).y[:, -1]
            system = particle(f"(x_dot^2 + y_dot^2)/2 - ({text} + 0.1*x^2 + 0.1*y^2)", x=start[0], y=start[1])
            self.assert_rest(system, {"x": rest[0], "y": rest[1]}, 1e-6)

    def test_a_rim_beside_the_way_is_left_where_the_start_is_on_no_symmetry(self):
        torus = on_surface("(sqrt(x^2 + y^2) - 2)^2 + z^2 - 1", ["-9.81", "0", "0"], x="1.02", y="0.05", z="0.2")
        self.assert_rest(torus, {"x": -3, "y": 0, "z": 0})
        self.assert_rest(particle("(x_dot^2 + y_dot^2)/2 - (x^2/2 - y^2/2 + y^4/4)", x="0.3", y="1e-14"), {"y": 1})

    def test_on_a_ridge_exactly_the_way_ends_in_a_saddle_and_a_note_says_so(self):
        place, notes = self.place(particle("(x_dot^2 + y_dot^2)/2 - (x^2/2 - y^2/2 + y^4/4)", x="0.3", y="0"))
        self.assertEqual((place["state"]["y"], place["stability"]), (0, "unstable"))
        self.assertIn("beside the ridge it leads on", notes[0])

    def test_where_nothing_is_downhill_or_the_way_is_not_proven_a_note_says_so(self):
        _, notes = self.place(particle("x_dot^2/2 + x^2/2", x="0.3"))
        self.assertIn("Downhill of 'initial' no stable place was found", notes[0])
        place, notes = self.place(particle("x_dot^2/2 - x^4", x="0.3"))
        self.assertEqual(place["state"]["x"], 0)
        self.assertIn("seen at points only", notes[0])

    def test_a_start_at_rest_is_the_place(self):
        place, notes = self.place(particle("x_dot^2/2 - cos(x)", x="0"))
        self.assertEqual((place["state"]["x"], place["stability"], notes), (0, "unstable", []))


if __name__ == "__main__":
    unittest.main()
