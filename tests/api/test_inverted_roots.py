"""Turning points that are logarithms, roots and inverse functions, and periods by gamma functions, at random parameters
against mpmath's roots and quadrature."""

import pathlib
import random
import re
import sys
import unittest

import mpmath

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

mpmath.mp.dps = 30
POTENTIALS = {"wall": "V*exp(-x/s)", "sixth": "V*x^6", "cubic": "V*abs(x)^3", "morse": "V*(1 - exp(-s*x))^2",
              "tangent": "V*tan(s*x)^2", "well": "-V/cosh(s*x)^2", "arc": "-V*cos(x/s)"}
FUNCTIONS = {name: getattr(mpmath, name) for name in ("exp", "log", "sqrt", "tan", "cos", "sin", "cosh", "asin", "acos", "atan", "gamma", "pi")}
FUNCTIONS |= {"abs": abs, "ellipk": mpmath.ellipk}


def value(text, known):
    exact = re.sub(r"(?<![\w.])(\d+(?:\.\d+)?)", r"mpf('\1')", text.replace("^", "**"))
    return eval(exact, FUNCTIONS | known | {"mpf": mpmath.mpf})


class InvertedRoots(Service):
    def potential(self, name, known):
        return lambda x: value(POTENTIALS[name], known | {"x": x})

    def test_places_and_periods(self):
        draw, found = random.Random(1717), {}
        for name, text in POTENTIALS.items():
            asked = lagrangian(name, "m - 1; V - 3; s - 2", "x - 0.1 0.5", f"m*x_dot^2/2 - ({text})")
            for _ in range(8):
                numbers = {"m": round(draw.uniform(0.5, 3), 3), "V": round(draw.uniform(2, 9), 3), "s": round(draw.uniform(0.5, 2), 3)}
                start = {"x": round(draw.uniform(0.05, 0.2), 3), "x_dot": round(draw.uniform(-0.6, 0.6), 3)}
                answer = self.ask("turning_points", {"system": asked, "parameters": numbers, "initial": start})
                exact = answer.get("exact", {})
                known = {key: mpmath.mpf(repr(one)) for key, one in numbers.items()}
                u, x0, v0 = self.potential(name, known), mpmath.mpf(repr(start["x"])), mpmath.mpf(repr(start["x_dot"]))
                known["h"] = known["m"] * v0 ** 2 / 2 + u(x0)
                for place in ("x_max", "x_min"):
                    if answer[place] is None:
                        continue
                    truth = mpmath.findroot(lambda x: u(x) - known["h"], answer[place])
                    self.assertLess(abs(value(exact[place]["text"], known) - truth), 1e-20, (name, exact[place]))
                    found[name, place] = found.get((name, place), 0) + 1
                if "period" in exact and answer["x_min"] is not None:
                    self.assertLess(abs(value(exact["period"]["text"], known) - answer["period"]), 1e-12 * answer["period"])
                    found[name, "period"] = found.get((name, "period"), 0) + 1
        self.assertTrue(all(found.get((name, "x_min"), 0) >= 6 for name in POTENTIALS), found)
        self.assertTrue(all(found.get((name, "period"), 0) >= 6 for name in ("sixth", "cubic", "morse", "tangent")), found)

    def test_as_a_book_prints_them(self):
        for name, place, text in (("wall", "x_min", "s*log(V/h)"), ("sixth", "x_max", "(h/V)^(1/6)"),
                                  ("sixth", "period", "1/3*(h/V)^(1/6)*sqrt(2*pi*m/h)*gamma(1/6)/gamma(2/3)")):
            asked = lagrangian(name, "m - 1; V - 3; s - 2", "x - 0.7 -0.5", f"m*x_dot^2/2 - ({POTENTIALS[name]})")
            self.assertEqual(self.ask("turning_points", {"system": asked})["exact"][place]["text"], text)

    def test_the_other_end_of_a_motion_from_rest(self):
        """Equations of which one root, or its square, is the start, and lengths beside what is drawn, at random parameters: V of
        both ends is the same."""
        draw = random.Random(5)
        for text, start, end in (("k*x^2/2 - q*x^3/3", 0.5, "x_min"), ("k*x^2/2 - q*x^3/3", -0.5, "x_max"),
                                 ("k/(2*x^2) + q*x", 0.6, "x_max"), ("k/(2*x^2) + q*x", 3, "x_min"),
                                 ("k/(2*x^2) + q*x^4", 0.6, "x_max"), ("k/(2*x^2) + q*x^4", 3, "x_min"),
                                 ("k*(sqrt(x^2 + q^2) - 1)^2/2", 0.3, "x_max"), ("k*(sqrt(x^2 + q^2) - 1)^2/2", -0.3, "x_min")):
            system = lagrangian("cubic", f"m - 1; k - 2; q - 0.3; c - {start}", "x - c", f"m*x_dot^2/2 - ({text})")
            for _ in range(6):
                numbers = {"m": 1, "k": round(draw.uniform(1, 3), 3), "q": round(draw.uniform(0.2, 0.5), 3)}
                answer = self.ask("turning_points", {"system": system, "parameters": numbers})
                known = {name: mpmath.mpf(repr(one)) for name, one in numbers.items()} | {"c": mpmath.mpf(repr(start))}
                known["h"] = value(text, known | {"x": known["c"]})
                x = value(answer["exact"][end]["text"], known)
                self.assertLess(abs(x - answer[end]), 1e-12)
                self.assertLess(abs(value(text, known | {"x": x}) - value(text, known | {"x": known["c"]})), 1e-20, (text, answer["exact"][end]))

    def test_sizes_are_written_by_what_has_a_sign(self):
        for text, parameters, start, expected in (
                ("m*x_dot^2/2 - F*abs(x)", "m - 1; F - 2; c - 0.4", "x - c", {"equation": "abs(x) - c = 0", "h": "F*c", "x_min": "-c"}),
                ("m*x_dot^2/2 - F*abs(x)", "m - 1; F - 2; c - -0.4", "x - c", {"equation": "c + abs(x) = 0", "h": "-F*c", "x_max": "-c"}),
                ("m*x_dot^2/2 + 2*k/sqrt(x^2 + d^2)", "m - 1; k - 2; d - 1; u - 0.7", "x - 0 u", {"equation": "k/d - k/sqrt(x^2 + d^2) - 1/4*m*u^2 = 0"}),
                ("m*x_dot^2/2 - V/tan(x)^2", "m - 1; V - 2; c - 1.4", "x - c", {"x_max": "pi - c"})):
            exact = self.ask("turning_points", {"system": lagrangian("sizes", parameters, start, text)})["exact"]
            self.assertEqual({name: exact[name]["text"] for name in expected}, expected)


if __name__ == "__main__":
    unittest.main()
