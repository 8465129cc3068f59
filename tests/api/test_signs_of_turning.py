"""What formulas of turning points and periods assume is enough: at any other parameters that satisfy it the potential has there the energy, by 30 digits
of mpmath, and pushes back; a motion there and back takes the period, by quadrature between the zeros of h - V that polynomials, or bisection, tell."""

import pathlib
import random
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mpmath.mp.dps = 30
FUNCTIONS = {name: getattr(mpmath, name) for name in ("sqrt", "sin", "cos", "tan", "asin", "acos", "exp", "log", "pi", "ellipk")} | {"abs": abs}
SETS = 20

# V, parameters, the start, and what has to be assumed of x_max, x_min and the period; None: there is no such formula
CASES = [
    ("k*x^2/2 + (b - c)/x^2", "m - 1; k - 3; b - 0.2; c - 0.1", "x - 0.5 0.3", [], ["b > c"], ["b > c"]),
    ("m*g*x*(sin(c) - u*cos(c))", "m - 1; g - 9.81; c - 0.4; u - 0.2", "x - 2 4", ["sin(c) > u*cos(c)"], None, None),
    ("(A - a)*abs(x)", "m - 1; A - 3; a - 1", "x - 0.5 0.3", ["A > a"], ["A > a"], ["A > a"]),
    ("J/(2*x^2) - (k - q)/x", "m - 1; k - 3; J - 1; q - 1", "x - 0.5 0.3", [], [], ["k > q"]),
    ("(A - a)*tan(x)^2", "m - 1; A - 3; a - 1", "x - 0.5 0.3", ["A > a"], ["A > a"], ["A > a"]),
    ("(A - B)/sin(x)^2 + (C - D)/cos(x)^2", "m - 1; A - 3; B - 1; C - 2; D - 1", "x - 0.7 0.3", None, None, ["C > D", "A > B"]),
    # With b < c there is a well, but a motion may start beside it.
    ("a*x^2/2 + (b - c)*x^4/4", "m - 1; a - 3; b - 2; c - 1", "x - 0.7 0.3", ["b > c"], ["b > c"], ["b > c"]),
    ("(k - s)*x^2/2", "m - 1; k - 3; s - 1", "x - 0.5 0.3", ["k > s"], ["k > s"], ["k > s"]),
    ("k*x^2/2 - F*x + a*x", "m - 1; k - 3; a - 1; F - 3", "x - 0.5 0.3", [], [], []),
    ("b*x^4/4 - (a - c)*x^2/2", "m - 1; a - 3; b - 1; c - 1", "x - 1.5 0.1", [], [], []),
    ("(A - a)*x^4/4", "m - 1; A - 3; a - 1", "x - 0.5 0.3", ["A > a"], ["A > a"], ["A > a"]),
    ("-m*(g - a)*l*cos(x)", "m - 1; g - 9.81; l - 1; a - 2", "x - 0.5 0.3", ["g > a"], ["g > a"], []),
]

# What is assumed where the start is put in, of a way that a hill may bar, and of walls at poles; and nothing else
BESIDE = [
    ("m*x_dot^2/2 - (k - c)*x^2/2 + F*x", "m - 1; k - 9; c - 4; F - 2", "x - 0 1", "x_max", ["m > 0", "k > 0", "c > 0", "F > 0", "k > c"]),
    ("m*x_dot^2/2 - (k - c)*x^2/2 + F*x", "m - 1; k - 9; c - 4; F - 2", "x - 0", "x_max", ["k > 0", "c > 0", "F > 0", "k > c"]),
    ("m*x_dot^2/2 - (a - c*d)*x^2/2 + c*x", "m - 1; a - 3; c - 1; d - 2", "x - 0.3", "x_max", ["a > 0", "c > 0", "d > 0", "a > c*d"]),
    ("m*x_dot^2/2 + a*x^2/2 - b*x^4/4", "m - 1; a - 2; b - 1", "x - 2.5", "x_min", ["25*b > 8*a"]),
    ("m*x_dot^2/2 + a*x^2/2 - b*x^4/4", "m - 1; a - 2; b - 1; c - 2.5", "x - c", "x_min", ["c > 0", "b*c^2 > 2*a"]),
    ("m*x_dot^2/2 + A/x - C/x^2", "m - 1; A - 3; C - 0.3", "x - 1 0.1", "period", ["m > 0", "A > 0", "h < 0", "C > 0"]),
    ("m*x_dot^2/2 - k*x^2/2 - b/x^2", "m - 1; k - 3; b - 2", "x - 0.8 0.3", "period", ["m > 0", "k > 0", "b > 0"]),
    ("d*A*H*x_dot^2/2 - rho*g*A*x^2/2 + d*A*H*g*x", "rho - 1000; d - 600; A - 0.01; H - 0.3; g - 9.81", "x - 0.2", "x_min", ["rho > 0", "d > 0", "H > 0", "g > 0"]),
    ("m*x_dot^2/2 - k*x^2/2 + F*x", "m - 1; k - 3; F - 2", "x - 0.1", "period", ["m > 0", "k > 0"]),
    # Beside its top a hill is narrower than places lie apart at which one looks.
    ("m*x_dot^2/2 - k*x^2/2 + b*x^4/4", "m - 1; k - 3; b - 1; c - 1", "x - c", "period", ["m > 0", "k > 0", "b > 0", "c > 0", "k > b*c^2"]),
    # An arc of a cosine is a place of the first turn, where a motion from another does not come.
    ("m*l^2*x_dot^2/2 + m*g*l*cos(x)", "m - 1; g - 9.81; l - 0.7; c - 0.5", "x - c", "x_min", ["c > 0", "pi > c"]),
    ("m*l^2*x_dot^2/2 + m*g*l*cos(x)", "m - 1; g - 9.81; l - 0.7; c - 0.4; u - 0.5", "x - c u", "x_max", ["g > 0", "l > 0", "c > 0", "u > 0", "pi > c", "2*g + 2*g*cos(c) > l*u^2"]),
    # A hump rises at 0 just before the force at the start turns: one place in a hundred.
    ("m*l^2*x_dot^2/2 + m*g*l*cos(x) - k*x^2/2", "m - 1; g - 9.81; l - 0.7; k - 2", "x - 0.4", "x_min", ["2*k + 25*m*g*l > 25*m*g*l*cos(2/5)"]),
    ("m*x_dot^2/2 - a*(1 - cos(x)) - b*(1 - cos(2*x))", "m - 1; a - 1; b - 1", "x - 0.3", "x_min", ["a + 2*b + 2*b*cos(0.3) > 0"]),
    # The sign of an angle does not tell that of its sine.
    ("3*m/4*x_dot^2 - m*g*x*sin(al)", "e - 1; m - 1; g - 9.81; al - 0.3; u - 1", "x - 0 u", "x_max", ["g > 0", "al > 0", "u > 0", "sin(al) > 0"]),
    # Nor does that of a product tell those of its factors.
    ("m*x_dot^2/2 - m*g*x*sin(al)", "m - 1; g - 9.81; al - 0.4; c - 1; u - 2", "x - c u", "x_max", ["g > 0", "al > 0", "c > 0", "u > 0", "sin(al) > 0"]),
    # At 1 the logarithm is 0.
    ("m*x_dot^2/2 - k*log(x)^2 + q*log(x)^4", "m - 1; k - 5; q - 0.5; c - 1.4", "x - c", "x_min", ["c > 0", "log(c) > 0", "k > q*log(c)^2"]),
    # Beyond the top nothing comes back.
    ("m*x_dot^2/2 - (a - b)*x^2/2 - (c - d)*x^4/4", "m - 1; a - 3; b - 1; c - 1; d - 3", "x - 0.3 0.1", "x_min",
     ["a > 0", "b > 0", "c > 0", "d > 0", "h > 0", "100*a + 9*c > 100*b + 9*d", "a^2 + b^2 + 4*c*h > 2*a*b + 4*d*h"]),
]


def value(text, numbers):
    return eval(text.replace("^", "**"), {"__builtins__": {}}, FUNCTIONS | numbers)  # noqa: S307


def potential_at(potential, numbers):
    return lambda x: value(potential, numbers | {"x": x})


def sets(form, names):
    draw = random.Random(form["text"])
    for _ in range(40*SETS):
        numbers = {name: mpmath.mpf(10)**draw.uniform(-1, 1) for name in names} | {"h": draw.choice([-1, 1])*mpmath.mpf(10)**draw.uniform(-1, 1)}
        if all(assumed.startswith("ellipk") or value(assumed, numbers) for assumed in form["assumes"]):
            yield numbers


def is_real(number):
    return isinstance(number, mpmath.mpf) and mpmath.isfinite(number)


def zero(f, inside, outside):
    """Of a function that is positive inside; None at a pole."""
    size = f(inside)
    for _ in range(90):
        middle = (inside + outside)/2
        inside, outside = (middle, outside) if f(middle) > 0 else (inside, middle)
    return inside if f(inside) < size/1000 else None


def is_inside(v, x, h):
    try:
        return -1e20 < v(x) < h
    except ZeroDivisionError:
        return False


def motions(v, h):
    """Ends between which v < h, found on a grid that is close and wide, and has the poles of these potentials."""
    grid = sorted([0] + [mpmath.pi*k/2 for k in range(-4, 5)] + [s*mpmath.mpf(10)**(mpmath.mpf(k)/15) for k in range(-45, 31) for s in (-1, 1)] + [mpmath.mpf(k)/20 + mpmath.mpf(1)/997 for k in range(-62, 63)])
    inside = [is_inside(v, x, h) for x in grid]
    edges = [k for k in range(1, len(grid)) if inside[k] != inside[k - 1]]
    for begin, end in zip(edges, edges[1:]):
        if inside[begin]:
            yield zero(lambda x: h - v(x), grid[begin], grid[begin - 1]), zero(lambda x: h - v(x), grid[end - 1], grid[end])


def period(v, h, m, ends):
    middle, half = sum(ends)/2, (ends[1] - ends[0])/2
    speed = lambda u: mpmath.sqrt(2*(h - v(middle + half*mpmath.sin(u)))/m)  # noqa: E731
    with mpmath.workdps(20):
        return 2*mpmath.quad(lambda u: half*mpmath.cos(u)/speed(u), [-mpmath.pi/2, 0, mpmath.pi/2])


class SignsOfTurning(Service):
    def forms(self, potential, parameters, start, more=None):
        system = lagrangian("turns", parameters, start, f"m*x_dot^2/2 - ({potential})", **(more or {}))
        return self.ask("turning_points", {"system": system})["exact"]

    def check_signs(self, form, needed, where):
        signs = [assumed for assumed in form["assumes"] if not assumed.endswith(("> 0", "< 0")) and not assumed.startswith("ellipk")]
        self.assertEqual(signs, needed, where)

    def test_an_end_turns_the_motion_wherever_its_signs_hold(self):
        for potential, parameters, start, *needed in CASES:
            names = [words.split()[0] for words in parameters.split(";")]
            exact = self.forms(potential, parameters, start)
            for name, side, signs in (("x_max", 1, needed[0]), ("x_min", -1, needed[1])):
                if signs is None:
                    continue
                form = exact[name]
                self.check_signs(form, signs, (potential, name))
                for _, numbers in zip(range(SETS), sets(form, names)):
                    x = value(form["text"], numbers)
                    if is_real(x):
                        v = potential_at(potential, numbers)
                        self.assertLess(abs(v(x) - numbers["h"]), 1e-18*sum(map(abs, numbers.values()))**2*(1 + 1/x**2), (potential, form, numbers))
                        self.assertGreater(side*mpmath.diff(v, x), 0, (potential, form, numbers))

    def test_a_motion_takes_the_period_wherever_its_signs_hold(self):
        for potential, parameters, start, _, _, signs in CASES:
            names = [words.split()[0] for words in parameters.split(";")]
            if signs is None:
                continue
            form = self.forms(potential, parameters, start)["period"]
            self.check_signs(form, signs, (potential, "period"))
            for _, numbers in zip(range(5), sets(form, names)):
                said = value(form["text"], numbers)
                v = potential_at(potential, numbers)
                found = list(motions(v, numbers["h"])) if is_real(said) else []
                if found:
                    self.assertTrue(any(None not in ends and abs(period(v, numbers["h"], numbers["m"], ends) - said) < 1e-5*said for ends in found), (potential, form, numbers))

    def test_an_end_at_a_wall_is_one_where_the_energy_leads_there(self):
        wall = {"events": [{"name": "wall", "expression": "x - b", "direction": "rising"}],
                "impact": {"event": "wall", "map": {"x_dot": "-x_dot"}}}
        for potential, needed in (("k*x^2/2", ["2*h > k*b^2"]), ("k*abs(x)", ["h > k*abs(b)"])):
            exact = self.forms(potential, "m - 1; k - 3; b - 0.5", "x - 0.1 2.5", wall)
            self.assertEqual(exact["x_max"]["text"], "b")
            self.check_signs(exact["x_max"], needed, potential)
            exact = self.forms(potential, "m - 1; k - 3; b - 0.5", "x - 0.1 0.5", wall)
            self.check_signs(exact["x_max"], ["the motion comes to no impact"], potential)

    def test_formulas_assume_signs_of_what_they_do_not_speak_of(self):
        for text, parameters, start, name, needed in BESIDE:
            form = self.ask("turning_points", {"system": lagrangian("beside", parameters, start, text)})["exact"][name]
            self.assertEqual([assumed for assumed in form["assumes"] if "(0)" not in assumed and not assumed.startswith("ellipk")], needed, (text, form))

    def test_an_end_beyond_a_hump_assumes_what_lowers_it(self):
        """V(c) > V(0) is not enough: with a = 0.42, b = 0.435, q = 0.079 and c = 2.277 a hump bars the way from c to -c."""
        for potential, parameters, start, needed, barred in (
                ("a*x^2/2 - b*x^4/4 + q*x^6/6", "m - 1; a - 1; b - 1; q - 0.1; c - 0.4", "c", 2, {"a": 0.419997, "b": 0.435243, "q": 0.079203, "c": 2.276637}),
                ("a*x^8 - b*x^4 + k*x^2", "m - 1; a - 0.1; b - 0.001; k - 1; c - 0.4", "c", 2, {"a": 0.0993, "b": 0.7896, "k": 0.9828, "c": 1.3036}),
                ("a*x^2 - b*x^4 + d*x^6", "m - 1; a - 1; b - 0.01; d - 1", "0.2", 2, {"a": 0.00165, "b": 0.08, "d": 1}),
                ("k*x^2*(x^2 - a^2)^2", "m - 1; k - 1; a - 1", "2", 1, {"a": 1.99, "k": 1})):
            system = lagrangian("hump", parameters, "x - " + start, f"m*x_dot^2/2 - ({potential})")
            form = self.ask("turning_points", {"system": system})["exact"]["x_min"]
            assumed = [each for each in form["assumes"] if "(0)" not in each]
            self.assertGreaterEqual(len(assumed), needed, (potential, form))
            answer = self.ask("turning_points", {"system": system, "parameters": barred})
            self.assertEqual(answer["initial_is"], "max", potential)
            self.assertGreater(answer["x_min"], 0, potential)
            self.assertFalse(all(value(each, barred) for each in assumed), (potential, form))

    def test_an_end_assumes_that_its_start_is_above_the_top_however_far_out_it_is(self):
        for potential, parameters, start, needed in (("b*x^4/4 - a*x^2/2", "m - 1; a - 1; b - 1", "100", ["5000*b > a"]),
                                                     ("b*x^4/4 - a*x^2/2", "m - 1; a - 0.001; b - 1", "9", ["81*b > 2*a"]),
                                                     ("d*x^6/6 - a*x^2/2", "m - 1; a - 1; d - 1", "10", ["d > 0", "10000*d > 3*a"]),
                                                     ("a*x^2 - b*x^4", "m - 1; a - 1; b - 0.001", "0.03", ["10000*a > 9*b"])):
            form = self.forms(potential, parameters, "x - " + start)["x_min"]
            self.assertEqual([each for each in form["assumes"] if "(0)" not in each], needed, potential)
        self.assertIn("5000*b > a", self.forms("b*x^4/4 - a*x^2/2", "m - 1; a - 1; b - 1", "x - 100")["period"]["assumes"])

    def test_nothing_is_assumed_that_is_an_equality_at_rest(self):
        for text, parameters, start in (("m*x_dot^2/2 - D*(1 - exp(-a*(x - b)))^2", "m - 1; D - 1; a - 1.2; b - 0.4; c - 0.7", "x - c"),
                                        ("m*l^2*x_dot^2/6 - m*g*l*sin(x)/2", "m - 1; g - 9.81; l - 0.7; c - 1", "x - c")):
            for name, form in self.ask("turning_points", {"system": lagrangian("at_rest", parameters, start, text)})["exact"].items():
                barred = [assumed for assumed in form["assumes"] if "exp(a*b - a*c)" in assumed or assumed.startswith("2*h >")]
                self.assertEqual(barred, [], (text, name))

    def test_an_end_lies_in_the_domain_of_its_coordinate(self):
        system = lagrangian("inside", "m - 1; k - 3; F - 2; G - 1", "x - 0.4", "m*x_dot^2/2 - k*x^2/2 + F*x - G*x")
        system["coordinates"][0]["domain"] = "> 0"
        form = self.ask("turning_points", {"system": system})["exact"]["x_min"]
        self.assertIn("5*F > k + 5*G", form["assumes"])

    def test_a_cycloid_has_its_period_where_no_motion_passes_the_cusp(self):
        for rate in ("0.1", "3.6"):
            system = lagrangian("cycloid", "m - 1; a - 0.6; g - 9.81", f"x - 0.9 {rate}", "m*a^2*(1 + cos(x))*x_dot^2 - m*g*a*(1 - cos(x))")
            system["coordinates"][0]["unit"] = "rad"
            form = self.ask("turning_points", {"system": system})["exact"]["period"]
            self.assertEqual(form["assumes"], ["a > 0", "g > 0", "h > 0", "2*m*a*g > h"], rate)

    def test_a_period_to_and_fro_beside_a_barrier_assumes_the_momentum_that_raises_it(self):
        for text, parameters, barrier in (("-k*x^2/2", "m - 1; k - 3", "p_f^2 > 0"), ("-k*x^2/2", "m - 1; k - 3; n - 0.2", "p_f^2 > 0"),
                                          ("-k*x^2/2 - n/x^2", "m - 1; k - 3; n - 0.2", "p_f^2 + 2*m*n > 0")):
            for speed in ("0.5", "-0.5"):
                system = lagrangian("polar", parameters, f"x - 1; f - 0 {speed}", "m*(x_dot^2 + x^2*f_dot^2)/2 " + text)
                form = self.ask("turning_points", {"system": system})["exact"]["period"]
                self.assertEqual((form["text"], form["assumes"]), ("pi*sqrt(m/k)", ["m > 0", "k > 0", barrier]))
        still = self.ask("turning_points", {"system": lagrangian("polar", "m - 1; k - 3", "x - 1; f - 0 0", "m*(x_dot^2 + x^2*f_dot^2)/2 - k*x^2/2")})
        self.assertEqual(still["exact"]["period"]["text"], "2*pi*sqrt(m/k)")

    def test_a_pole_at_0_is_said_to_be_there(self):
        for text, start in (("m*x_dot^2/2 + (b - c)/x", "x - 0.8 0.3"), ("m*(x_dot^2 + x^2*f_dot^2)/2 + b/(2*x^2)", "x - 1 0.2; f - 0 1.3")):
            answer = self.ask("turning_points", {"system": lagrangian("pole", "m - 1; b - 5; c - 2", start, text)})
            self.assertIn("At x = 0 the potential has a pole", str(answer))


if __name__ == "__main__":
    unittest.main()
