"""A Lagrangian whose mass matrix is singular by an identity is refused by every endpoint, for that reason."""

import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402

NAMES = "xyzuvw"


def scene(lagrangian, n):
    coordinates = [{"name": name, "unit": "m", "initial": "1", "initial_rate": "1", "meaning": "a length"}
                   for name in NAMES[:n]]
    parameters = [{"name": "c", "unit": "J*s/m", "default": "1", "domain": "> 0", "meaning": "a constant"},
                  {"name": "k", "unit": "N/m", "default": "1", "domain": "> 0", "meaning": "a stiffness"}]
    return {"name": "path", "parameters": parameters, "coordinates": coordinates, "lagrangian": lagrangian}


def squares(n, suffix=""):
    return " + ".join(f"{name}{suffix}^2" for name in NAMES[:n])


class SingularMass(Service):
    QUESTIONS = {"equations": {}, "energy": {}, "simulate": {"t_end": 1}, "modes": {}, "equilibria": {},
                 "turning_points": {"coordinate": "x", "t_end": 1},
                 "bifurcations": {"parameter": "k", "from": 1, "to": 2}, "accuracy": {"t_end": 1}}

    def test_every_endpoint_gives_the_true_reason(self):
        for n in (1, 2, 3, 4, 6):
            system = scene(f"c*sqrt({squares(n, '_dot')}) - k*({squares(n)})/2", n)
            for endpoint, more in self.QUESTIONS.items():
                with self.subTest(endpoint=endpoint, n=n):
                    problem = self.refused(endpoint, {"system": system} | more)
                    error = problem["errors"][0]
                    self.assertEqual(error["code"], "no_inertia", problem)
                    self.assertIn("/coordinates", error["pointer"])

    def test_what_is_regular_is_answered(self):
        for n in (1, 4):
            system = scene(f"-c*sqrt(1 - 1e-3*({squares(n, '_dot')})) - k*({squares(n)})/2", n)
            system["parameters"][0]["unit"] = "J"
            system["parameters"].append({"name": "s", "unit": "s/m", "default": "0.03", "meaning": "a slowness"})
            system["lagrangian"] = system["lagrangian"].replace("1e-3*", "s^2*")
            self.ask("energy", {"system": system})


if __name__ == "__main__":
    unittest.main()
