"""Equilibria of two double wells along skewed directions, a = p.x and b = q.x with p and q nearly parallel: nine places,
known in closed form, and proven to be all."""

import math
import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402

DIRECTIONS = (((2, 1), (1, 1)), ((1, 2), (1, 1)), ((1, 2), (1, -1)), ((3, 1), (1, 2)), ((1, 1), (0, 1)))
SQUARES = ((1.85, 1.58), (0.66, 1.09), (1.1, 1.94))


class SkewedWells(Service):
    def test_all_nine_places_are_found_and_proven_to_be_all(self):
        for p, q in DIRECTIONS:
            for c, d in SQUARES:
                a, b = (f"({u}*x + ({v})*y)" for u, v in (p, q))
                scene = lagrangian("wells", "", "x -; y -", f"(x_dot^2 + y_dot^2)/2 - (({a}^2 - {c})^2 + ({b}^2 - {d})^2)/4")
                del scene["parameters"]
                with self.subTest(p=p, q=q, c=c, d=d):
                    answer = self.ask("equilibria", {"system": scene})
                    self.assertTrue(answer["complete"], answer.get("reason"))
                    known = sorted(self.place(p, q, m * math.sqrt(c), n * math.sqrt(d)) for m in (-1, 0, 1) for n in (-1, 0, 1))
                    found = sorted((e["state"]["x"], e["state"]["y"]) for e in answer["equilibria"])
                    self.assertEqual(len(found), 9)
                    for (x, y), (u, v) in zip(found, known):
                        self.assertAlmostEqual(x, u, 10)
                        self.assertAlmostEqual(y, v, 10)

    @staticmethod
    def place(p, q, a, b):
        """Where p.x = a and q.x = b."""
        det = p[0] * q[1] - p[1] * q[0]
        return (round((a * q[1] - b * p[1]) / det, 13), round((b * p[0] - a * q[0]) / det, 13))


if __name__ == "__main__":
    unittest.main()
