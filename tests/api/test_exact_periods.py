"""Periods as formulas: those of textbooks, each held against quadrature by mpmath through the number beside it."""

import pathlib
import sys
import unittest

import mpmath
import sympy

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import DOWN, G, lagrangian, particle, scene  # noqa: E402

IN_THE_PLANE = [particle("m", "r*cos(phi)", "r*sin(phi)")]


def on_a_line(name, parameters, start, potential):
    return scene(name, parameters, f"x m {start}", bodies=[particle("m", "x", "0")], potential=potential)


# Scene or name, and the period by the parameters and the constants of the motion: Landau and Lifshitz, Mechanics,
# sections 11 (problem 2), 14 and 15 (problem 1); Huygens' cycloid; Goldstein, 3.7.
PERIODS = [
    ("cycloid_pendulum", "4*pi*sqrt(a/g)"),
    ("kepler", "2*pi*mu*sqrt((m/(2*Abs(E)))**3)"),
    (on_a_line("oscillator", "m kg 1; k N/m 3; l0 m 1", "0.3", "k*(x - l0)^2/2"), "2*pi*sqrt(m/k)"),
    (on_a_line("morse", "m kg 1.3; D J 2; a 1/m 1.5", "0.2", "D*(exp(-2*a*x) - 2*exp(-a*x))"), "pi/a*sqrt(2*m/Abs(E))"),
    (on_a_line("well", "m kg 1.3; U0 J 2; a 1/m 1.5", "0.2", "-U0/cosh(a*x)^2"), "pi/a*sqrt(2*m/Abs(E))"),
    (on_a_line("tangent", "m kg 1.3; U0 J 2; a 1/m 1.5", "0.2", "U0*tan(a*x)^2"), "pi/a*sqrt(2*m/(E + U0))"),
    (on_a_line("wedge", "m kg 1.3; F N 2", "0.2", "F*abs(x)"), "4*sqrt(2*m*E)/F"),
    (on_a_line("valley", "m kg 1.3; F N 2; b m 1; a 1 2", "0.2", "F*abs(a*x - b)"), "4*sqrt(2*m*E)/(F*a)"),
    (on_a_line("centrifugal", "m kg 1.3; A J*m^2 2; k N/m 3", "0.4", "A/x^2 + k*x^2/2"), "pi*sqrt(m/k)"),
    (on_a_line("attracted", "m kg 1.3; A J*m^2 2; B J*m 3", "1", "A/x^2 - B/x"), "pi*B*sqrt(m/(2*Abs(E)**3))"),
    (scene("isotropic", "m kg 1.3; k N/m 3", "r m 1; phi rad 0 1.3", bodies=IN_THE_PLANE, potential="k*r^2/2"),
     "pi*sqrt(m/k)"),
    (scene("precessing", "m kg 1.3; k N*m^2 3; C J*m^2 0.1", "r m 1; phi rad 0 1.3", bodies=IN_THE_PLANE,
           potential="-k/r + C/r^2"), "pi*k*sqrt(m/(2*Abs(E)**3))"),
    (scene("cusps", f"m kg 1; a m 0.3; {G}", "u rad 1", gravity=DOWN,
           bodies=[particle("m", "a*(u - sin(u))", "a*(1 + cos(u))")]), "4*pi*sqrt(a/g)"),
    (lagrangian("poschl_teller", "A - 1; B - 2", "x - 0.6", "x_dot^2/2 - A/sin(x)^2 - B/cos(x)^2"), "pi/sqrt(2*h)"),
    ("plane_pendulum", "4*sqrt(l/g)*ellipk(sin(1/2)^2)"),
    ("physical_pendulum", "4*sqrt(2*l/(3*g))*ellipk(sin(1/2)^2)"),
    ("orbiting_pendulum", "4*sqrt(l/r)/omega0*ellipk(l/(4*r))"),
]
TURNING = {"coordinates": [{"name": "x", "unit": "rad", "initial": "0.2", "initial_rate": "3"}]}
# Over the top, one turn: Whittaker, Analytical Dynamics, section 44.
TURNS = [
    ("plane_pendulum", {"theta": 0, "theta_dot": 7}, "2*sqrt(2*m*l**2/(E + m*g*l))*ellipk(2*m*g*l/(E + m*g*l))"),
    ("physical_pendulum", {"theta": 0.5, "theta_dot": -9},
     "2*sqrt(2*m*l**2/3/(E + m*g*l/2))*ellipk(m*g*l/(E + m*g*l/2))"),
    (scene("hands", f"m kg 1.3; l m 0.4; {G}", "a rad 0 12", gravity=DOWN, bodies=[particle("m", "l*cos(a)", "l*sin(a)")]),
     {}, "2*sqrt(2*m*l**2/(E + m*g*l))*ellipk(2*m*g*l/(E + m*g*l))"),
    (lagrangian("two_wells", "A - 1.5; B - 0.7", "x rad 0.2 3", "A*x_dot^2/2 + B*cos(x)^2") | TURNING, {},
     "2*sqrt(2*A/(h + B))*ellipk(B/(h + B))"),
]
# Turned by any angle: a pendulum in a train that gains speed.
TILTED = scene("tilted", f"m kg 1.3; l m 0.4; a m/s^2 3; {G}", "phi rad 0.3", gravity=DOWN,
               bodies=[particle("m", "a*t^2/2 + l*sin(phi)", "-l*cos(phi)")])
TILTED_PERIOD = "4*sqrt(l/sqrt(a**2 + g**2))*ellipk((1 + h/(m*l*sqrt(a**2 + g**2)))/2)"
# A potential of twice the angle: a body in orbit, a dipole in a field that alternates.
TWICE = lagrangian("swings_in_one_of_two", "A - 1.5; B - 0.7", "x - 0.6", "A*x_dot^2/2 + B*cos(x)^2")
TWICE_PERIOD = "2*sqrt(A/(B/2))/sqrt(1)*ellipk((h + B)/B)"
# Duffing's oscillator: through the middle, in one of two wells and over the hump between them, where its spring
# softens, and without a linear part; by h, or by the amplitude from which it is let go.
QUARTIC = "x_dot^2*m/2 - a*x^2/2 - b*x^4/4"
S = "sqrt(a**2 + 4*b*h)"
DUFFING = [
    ("m - 1.3; a - 2; b - 0.7", "0.4 1.1", f"4*sqrt(m/{S})*ellipk((1 - a/{S})/2)"),
    ("m - 1.3; a - -2; b - 0.7", "1.2 0.3", f"2*sqrt(2*m/({S} - a))*ellipk(2*{S}/({S} - a))"),
    ("m - 1.3; a - -2; b - 0.7", "1.2 3.1", f"4*sqrt(m/{S})*ellipk((1 - a/{S})/2)"),
    ("m - 1.3; a - 2; b - -0.7", "0.4 0.5", f"4*sqrt(2*m/(a + {S}))*ellipk((a - {S})/(a + {S}))"),
    ("m - 1.3; a - 2; b - 0.7", "1.5", "4*sqrt(m/(a + b*1.5**2))*ellipk(b*1.5**2/(2*(a + b*1.5**2)))"),
]
NOT_ELEMENTARY = ["spherical_pendulum", "hanging_mass", "particle_in_cone", "bead_on_parabola", "free_spin_pendulum"]


def value(text, numbers):
    names = {name: mpmath.mpf(number) for name, number in numbers.items()}
    functions = {"sqrt": mpmath.sqrt, "sin": mpmath.sin, "pi": mpmath.pi, "Abs": abs, "ellipk": mpmath.ellipk}
    expression = sympy.sympify(text.replace("^", "**"), locals={n: sympy.Symbol(n, real=True) for n in names})
    symbols = sorted(expression.free_symbols, key=str)
    return sympy.lambdify(symbols, expression, [functions, "mpmath"])(*(names[s.name] for s in symbols))


class ExactPeriods(Service):
    def test_the_periods_of_textbooks(self):
        for system, expected in PERIODS:
            with self.subTest(system=system if isinstance(system, str) else system["name"]):
                found = self.ask("turning_points", {"system": system})
                form = found["exact"]["period"]
                numbers = found["request"]["parameters"] | found["constants"]
                for text in (form["text"], expected):
                    number = value(text, numbers)
                    self.assertLess(abs(number - found["period"]), found["error"]["period"] + 1e-13 * found["period"], text)

    def assert_period(self, found, *formulas):
        numbers = found["request"]["parameters"] | found["constants"]
        for text in (found["exact"]["period"]["text"], *formulas):
            self.assertLess(abs(value(text, numbers) - found["period"]), found["error"]["period"] + 1e-13 * found["period"],
                            text)

    def test_what_goes_over_the_top_has_the_period_of_its_turns(self):
        for system, start, expected in TURNS:
            found = self.ask("turning_points", {"system": system, "initial": start})
            with self.subTest(system=system if isinstance(system, str) else system["name"]):
                self.assertEqual(found["motion"], "rotation")
                self.assert_period(found, expected)

    def test_an_oscillator_with_a_cubic_force(self):
        for parameters, start, expected in DUFFING:
            with self.subTest(parameters, start=start):
                found = self.ask("turning_points", {"system": lagrangian("duffing", parameters, f"x - {start}", QUARTIC)})
                self.assert_period(found, expected)
        quartic = lagrangian("quartic", "b - 0.7", "x - 0.4 1.1", "x_dot^2/2 - b*x^4/4")
        self.assert_period(self.ask("turning_points", {"system": quartic}), "4*sqrt(1/sqrt(4*b*h))*ellipk(0.5)")

    def test_a_start_by_the_parameters_gives_the_period_of_a_turn_by_them(self):
        found = self.ask("turning_points", {"system": "plane_pendulum", "initial": {"theta": 0, "theta_dot": "3*sqrt(g/l)"}})
        self.assertEqual(found["exact"]["period"]["text"], "4/3*sqrt(l/g)*ellipk(4/9)")

    def test_a_potential_of_twice_the_angle(self):
        self.assert_period(self.ask("turning_points", {"system": TWICE}), TWICE_PERIOD)

    def test_a_potential_turned_by_an_angle(self):
        self.assert_period(self.ask("turning_points", {"system": TILTED}), TILTED_PERIOD)
        over = self.ask("turning_points", {"system": TILTED, "initial": {"phi_dot": 15}})
        d = "(h + m*l*sqrt(a**2 + g**2))"
        self.assert_period(over, f"2*l*sqrt(2*m/{d})*ellipk(2*m*l*sqrt(a**2 + g**2)/{d})")

    def test_they_are_as_short_as_printed(self):
        for system, text in (("cycloid_pendulum", "4*pi*sqrt(a/g)"), ("plane_pendulum", "4*sqrt(l/g)*ellipk(sin(1/2)^2)")):
            self.assertEqual(self.ask("turning_points", {"system": system})["exact"]["period"]["text"], text)
        morse = next(system for system, _ in PERIODS if isinstance(system, dict) and system["name"] == "morse")
        form = self.ask("turning_points", {"system": morse})["exact"]["period"]
        self.assertEqual(form["text"], "pi*sqrt(-2*m/E)/a")
        self.assertIn("E < 0", form["assumes"])

    def test_squares_and_numbers_stand_before_the_rest(self):
        cycloid = lagrangian("cycloid", "m - 1; R - 1; g - 9.81", "x - 0.5", "4*m*R^2*cos(x/2)^2*x_dot^2 - m*g*R*(1 - cos(x))")
        cycloid["coordinates"][0]["unit"] = "rad"
        self.assertEqual(self.ask("turning_points", {"system": cycloid})["exact"]["period"]["text"], "4*pi*sqrt(2*R/g)")
        for text, start, equation in (("m*x_dot^2/2 + 2*D*x", "x - 0", "x = 0"),
                                      ("m*x_dot^2/2 - D*(1 - exp(-x))^2", "x - 0 0.5", "8*D*(exp(-x) - 1)^2 - m = 0")):
            system = lagrangian("plain", "m - 1; D - 2", start, text)
            self.assertEqual(self.ask("turning_points", {"system": system})["exact"]["equation"]["text"], equation)

    def test_a_start_in_decimals_leaves_formulas_by_the_constants(self):
        found = self.ask("turning_points", {"system": "kepler"})
        numbers = found["request"]["parameters"] | found["constants"]
        for name in ("r_max", "r_min"):
            self.assertAlmostEqual(float(value(found["exact"][name]["text"], numbers)), found[name], places=12)
        self.assertNotIn("equation", found["exact"])

    def test_a_parameter_may_have_the_name_of_a_momentum(self):
        numbers = []
        for name in ("c", "p_phi"):
            system = scene("orbit", f"m kg 1; k N*m^2 3; {name} kg*m^2/s 1", "r m 1; phi rad 0 1.3", bodies=IN_THE_PLANE,
                           potential=f"-k/r + {name}^2/(20*m*r^2)")
            found = self.ask("turning_points", {"system": system})
            self.assertAlmostEqual(found["constants"]["E"], 1.3**2/2 - 3 + 1/20, places=14)
            numbers.append([found[key] for key in ("r_max", "r_min", "period")])
        self.assertEqual(*numbers)

    def test_potentials_of_two_sides_have_both_halves(self):
        line = "m*x_dot^2/2 - "
        for potential, start, period, by_hand in (
                ("(k1 + k2)/4*x^2 - (k1 - k2)/4*x*abs(x)", "0.5", "pi*(sqrt(m/k1) + sqrt(m/k2))",
                 "pi*(sqrt(m/k1) + sqrt(m/k2))"),
                ("(k1 + k2)/4*x^2 - (k1 - k2)/4*x*abs(x)", "0 1", "pi*(sqrt(m/k1) + sqrt(m/k2))",
                 "pi*(sqrt(m/k1) + sqrt(m/k2))"),
                ("(k1 + k2)/2*abs(x) - (k1 - k2)/2*x", "0.5", "(2/k1 + 2/k2)*sqrt(2*m*h)", "(2/k1 + 2/k2)*sqrt(m*k1)"),
                ("k1*x^2/2 - k2*abs(x)", "0.5", "4*acos(2*k2/(k1 + 2*k2))*sqrt(m/k1)",
                 "4*acos(k2/sqrt(k1*(k1/4 + k2) + k2**2))*sqrt(m/k1)"),
                ("k1*(x^2 + x*abs(x))/4 - k2*(abs(x) - x)/2", "0.5", "pi*sqrt(m/k1) + sqrt(m*k1)/k2",
                 "pi*sqrt(m/k1) + sqrt(m*k1)/k2")):
            system = lagrangian("two_sides", "m - 1.3; k1 - 2; k2 - 3", f"x - {start}", line + potential)
            found = self.ask("turning_points", {"system": system})
            self.assertEqual(found["exact"]["period"]["text"], period)
            numbers = {"m": 1.3, "k1": 2, "k2": 3, "sqrt": mpmath.sqrt, "acos": mpmath.acos, "pi": mpmath.pi}
            self.assertAlmostEqual(found["period"], float(eval(by_hand, numbers)), delta=1e-13)  # noqa: S307

    def test_sides_with_equal_numbers_keep_their_names(self):
        for potential, period in (("(a*(x + abs(x))^2 + b*(x - abs(x))^2)/8", "pi*(sqrt(m/a) + sqrt(m/b))"),
                                  ("(a + b)*abs(x) + (a - b)*x", "(1/a + 1/b)*sqrt(2*m*h)"),
                                  ("a*x^2*(1 + sign(x)) + b*x^2*(1 - sign(x))", "1/2*pi*(sqrt(m/a) + sqrt(m/b))"),
                                  ("a*(x + abs(x))^4 + b*(x - abs(x))^4", None), ("a*(x + abs(x))^6 + b*(x - abs(x))^6", None)):
            found = self.ask("turning_points", {"system": lagrangian("alike", "m - 1.5; a - 2; b - 2", "x - 0.4", f"m*x_dot^2/2 - ({potential})")})
            self.assertEqual(found["exact"].get("period", {}).get("text"), period, potential)

    def test_none_is_claimed_where_it_is_no_such_integral(self):
        for system in NOT_ELEMENTARY:
            self.assertNotIn("period", self.ask("turning_points", {"system": system}).get("exact", {}), system)


if __name__ == "__main__":
    unittest.main()
