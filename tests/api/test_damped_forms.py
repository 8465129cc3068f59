"""The formulas of small motions with friction: omega^2 = K/M - rate^2, rate = D/(2 M) of one coordinate, the two rates
where it creeps, and those of each mode where friction leaves the shapes as they are, at random parameters against
mpmath."""

import pathlib
import random
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import DOWN, G, lagrangian, particle, scene  # noqa: E402

mpmath.mp.dps = 30
SPRING = scene("damped_spring", "m kg 1; k N/m 4; c kg/s 0.6", "x m 0.1", bodies=[particle("m", "x", "0")],
               springs=[{"stiffness": "k", "length": "x"}], dampers=[{"coefficient": "c", "length": "x"}])
PENDULUM = scene("damped_pendulum", f"m kg 1; l m 0.5; c kg*m^2/s 0.1; {G}", "th rad 0.1", gravity=DOWN,
                 bodies=[particle("m", "l*sin(th)", "-l*cos(th)")], dissipation="c*th_dot^2/2")
HANGING = scene("hanging", f"m kg 1; k N/m 9; b kg/s 0.2; {G}", "y m 0.1", gravity=DOWN, bodies=[particle("m", "0", "-y")],
                springs=[{"stiffness": "k", "length": "y"}], dissipation="b*y_dot^2/2")
NEGATIVE = scene("driven_by_friction", "m kg 1; k N/m 4; c kg/s 0.6", "x m 0.1", bodies=[particle("m", "x", "0")],
                 potential="k*x^2/2", forces=[{"value": "c*x_dot", "along": "x"}])
FORMS = [(SPRING, "k/m - c^2/(4*m^2)", "c/(2*m)"), (PENDULUM, "g/l - c^2/(4*m^2*l^4)", "c/(2*m*l^2)"),
         (HANGING, "k/m - b^2/(4*m^2)", "b/(2*m)"), (NEGATIVE, "k/m - c^2/(4*m^2)", "c/(2*m)")]

CHAINS = {"two": ("x 0.1; y 0", "(x_dot^2 + y_dot^2)", "(x^2 + y^2 + (x - y)^2)"),
          "three": ("x 0.1; y 0; z 0", "(x_dot^2 + y_dot^2 + z_dot^2)", "(x^2 + z^2 + (x - y)^2 + (y - z)^2)")}
DRAG = {"two": "c*(x_dot^2 + y_dot^2)/2", "three": "c*(x_dot^2 + y_dot^2 + z_dot^2)/2"}
ALONG = "c*(x_dot^2 + y_dot^2 + (x_dot - y_dot)^2)/2"
SQUARES = {"two": ["k/m", "3*k/m"], "three": ["(2 - sqrt(2))*k/m", "2*k/m", "(2 + sqrt(2))*k/m"]}
FRICTIONS = {DRAG["two"]: ["c^2/(4*m^2)"] * 2, DRAG["three"]: ["c^2/(4*m^2)"] * 3, ALONG: ["c^2/(4*m^2)", "9*c^2/(4*m^2)"]}
PROPORTIONAL = [("two", DRAG["two"], ["c/(2*m)"] * 2), ("three", DRAG["three"], ["c/(2*m)"] * 3),
                ("two", ALONG, ["c/(2*m)", "3*c/(2*m)"])]


def chain(name, dissipation):
    coordinates, kinetic, potential = CHAINS[name]
    coordinates = "; ".join(" ".join([one.split()[0], "-", one.split()[1]]) for one in coordinates.split(";"))
    return lagrangian(name, "m - 1; k - 4; c - 0.3", coordinates, f"m*{kinetic}/2 - k*{potential}/2", dissipation=dissipation)


def exponents(name, dissipation, known):
    """All s of det(M s^2 + D s + K) = 0, by the first-order matrix."""
    n = 2 if name == "two" else 3
    stiffness = mpmath.matrix(n)
    for i in range(n):
        stiffness[i, i] = 2 * known["k"]
        if i:
            stiffness[i, i - 1] = stiffness[i - 1, i] = -known["k"]
    friction = stiffness * known["c"] / known["k"] if dissipation == ALONG else mpmath.eye(n) * known["c"]
    whole = mpmath.zeros(2 * n)
    for i in range(n):
        whole[i, n + i] = 1
        for j in range(n):
            whole[n + i, j] = -stiffness[i, j] / known["m"]
            whole[n + i, n + j] = -friction[i, j] / known["m"]
    return mpmath.eig(whole, left=False, right=False)


class DampedForms(Service):
    def test_what_courses_print(self):
        for asked, square, rate in FORMS:
            mode, = self.ask("modes", {"system": asked})["modes"]
            exact = mode["exact"]
            self.assertEqual((exact["of"], exact["text"], exact["rate"]["text"]), ("omega^2", square, rate))
            self.assertEqual(exact["omega"]["text"], f"sqrt({square})")
        place = self.ask("modes", {"system": HANGING})["equilibrium"]["exact"]["y"]["text"]
        self.assertEqual(place, "m*g/k")

    def test_their_numbers(self):
        draw = random.Random(16)
        for asked, square, rate in FORMS:
            for _ in range(25):
                values = {one["name"]: round(draw.uniform(0.1, 9), 4) for one in asked["parameters"]}
                mode = self.ask("modes", {"system": asked, "parameters": values})["modes"][0]
                known = {name: mpmath.mpf(repr(value)) for name, value in values.items()}
                omega2, size = (eval(text.replace("^", "**"), known) for text in (square, rate))
                self.assertEqual(mode["exact"]["of"], "omega^2" if omega2 > 0 else "rate")
                if omega2 > 0:
                    self.assertLessEqual(abs(mode["rate"] - size), mode["rate_error"])
                    self.assertLessEqual(abs(mode["omega"] - mpmath.sqrt(omega2)), mode["error"])

    def test_what_creeps_has_two_rates(self):
        fast, slow = self.ask("modes", {"system": SPRING, "parameters": {"c": 5}})["modes"]
        self.assertEqual((fast["exact"]["of"], fast["exact"]["text"]), ("rate", "sqrt(c^2/(4*m^2) - k/m) + c/(2*m)"))
        self.assertEqual((slow["exact"]["of"], slow["exact"]["text"]), ("rate", "c/(2*m) - sqrt(c^2/(4*m^2) - k/m)"))
        for mode in self.ask("modes", {"system": SPRING, "parameters": {"c": 4}})["modes"]:
            self.assertEqual(mode["exact"]["text"], "c/(2*m)")
            self.assertIn("k/m = c^2/(4*m^2)", mode["exact"]["assumes"])  # critically damped

    def test_what_only_rubs(self):
        rest, decay = self.ask("modes", {"system": SPRING, "parameters": {"k": 0}})["modes"]
        self.assertNotIn("exact", rest)
        self.assertEqual(decay["exact"]["text"], "c/m")

    def test_an_inverted_pendulum_with_friction_falls_and_settles(self):
        falls = {"system": PENDULUM, "equilibrium": {"th": "pi"}}
        texts = {mode["kind"]: mode["exact"]["text"] for mode in self.ask("modes", falls)["modes"]}
        self.assertEqual(set(texts), {"growth", "decay"})
        known = {"m": 1, "l": mpmath.mpf("0.5"), "c": mpmath.mpf("0.1"), "g": mpmath.mpf("9.81"), "sqrt": mpmath.sqrt}
        root = mpmath.sqrt(known["g"] / known["l"] + mpmath.mpf("0.2") ** 2)
        for kind, rate in (("growth", root - mpmath.mpf("0.2")), ("decay", root + mpmath.mpf("0.2"))):
            self.assertLess(abs(eval(texts[kind].replace("^", "**"), dict(known)) - rate), 1e-25)

    def test_several_coordinates_with_proportional_friction(self):
        for name, dissipation, rates in PROPORTIONAL:
            found = self.ask("modes", {"system": chain(name, dissipation)})["modes"]
            self.assertEqual([mode["exact"]["rate"]["text"] for mode in found], rates)
            self.assertEqual([mode["exact"]["text"] for mode in found],
                             [f"{spring} - {friction}" for spring, friction in zip(SQUARES[name], FRICTIONS[dissipation])])

    def test_their_numbers_by_a_matrix(self):
        draw = random.Random(17)
        for name, dissipation, _ in PROPORTIONAL:
            for _ in range(8):
                values = {"m": round(draw.uniform(0.5, 3), 3), "k": round(draw.uniform(1, 9), 3), "c": round(draw.uniform(0.1, 9), 3)}
                known = {key: mpmath.mpf(repr(value)) for key, value in values.items()}
                truth = exponents(name, dissipation, known)
                found = self.ask("modes", {"system": chain(name, dissipation), "parameters": values})["modes"]
                left = list(truth)
                for mode in found:
                    self.assertIn("exact", mode)
                    known["sqrt"] = mpmath.sqrt
                    value = eval(mode["exact"]["text"].replace("^", "**"), dict(known))
                    omega = mpmath.sqrt(value) if mode["omega"] else 0
                    rate = value if not mode["omega"] else eval(mode["exact"]["rate"]["text"].replace("^", "**"), dict(known))
                    nearest = min(left, key=lambda root: abs(-rate + 1j * omega - root))
                    self.assertLess(abs(-rate + 1j * omega - nearest), 1e-20)
                    left.remove(nearest)
                self.assertFalse([root for root in left if root.imag >= 0])

    def test_friction_that_changes_shapes_has_none(self):
        found = self.ask("modes", {"system": chain("two", "c*x_dot^2/2")})["modes"]
        self.assertEqual(["exact" in mode for mode in found], [False, False])


if __name__ == "__main__":
    unittest.main()
