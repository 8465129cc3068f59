"""Equilibria of V = a x^2/2 + c x + b |x - k| + d |x - k - gap|, a clearance or a backlash: all of them, whatever the gap,
against the pieces solved by hand."""

import pathlib
import random
import sys
import unittest
from fractions import Fraction

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

CASES = 60


def equilibria(a, c, b, d, k, gap):
    """a x + c + b s1 + d s2 = 0 on each side, and where a kink's two sides have opposite signs."""

    def slope(x, s1, s2):
        return a * x + c + b * s1 + d * s2

    places = []
    for s1, s2, low, high in ((-1, -1, None, k), (1, -1, k, k + gap), (1, 1, k + gap, None)):
        x = -(c + b * s1 + d * s2) / a
        if (low is None or x > low) and (high is None or x < high):
            places.append(x)
    for x, before, after in ((k, (-1, -1), (1, -1)), (k + gap, (1, -1), (1, 1))):
        if slope(x, *before) * slope(x, *after) < 0:
            places.append(x)
    return sorted(places)


class KinksSideBySide(Service):
    def test_all_equilibria_are_found_and_proven_to_be_all(self):
        draw = random.Random(20261126)
        for _ in range(CASES):
            a, c, b, d, k = (Fraction(draw.randint(-3000, 3000), 1000) for _ in range(5))
            gap = Fraction(1, 10 ** draw.randint(1, 8))
            if a == 0:
                continue
            text = " + ".join(f"({float(n)})*{term}" for n, term in
                              ((a / 2, "x^2"), (c, "x"), (b, f"abs(x - ({float(k)}))"), (d, f"abs(x - ({float(k + gap):.12g}))")))
            scene = lagrangian("clearance", "", "x - 0 0", f"x_dot^2/2 - ({text})")
            del scene["parameters"]
            with self.subTest(potential=text):
                answer = self.ask("equilibria", {"system": scene})
                self.assertTrue(answer["complete"], answer.get("reason"))
                found = sorted(place["state"]["x"] for place in answer["equilibria"])
                known = equilibria(a, c, b, d, k, gap)
                self.assertEqual(len(found), len(known))
                for x, place in zip(found, known):
                    self.assertLess(abs(Fraction(x) - place), Fraction(1, 10**12))


if __name__ == "__main__":
    unittest.main()
