"""SymPy derives the motion of every classic from its file, and along ours the work balances by its Lagrangian."""

import json
import pathlib
import sys
import unittest

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests" / "support"))
from scene_by_sympy import BySympy, names_of  # noqa: E402
from service import Service  # noqa: E402

SCENES = {file.stem: json.loads(file.read_text(encoding="utf-8")) for file in sorted((ROOT / "api/scenes/classics").glob("*.json"))}
# Distances of a satellite's ends from the Earth differ in the fifth digit, which costs as many.
LOOSER = {"gravity_gradient": 1e-9}
WITHOUT_LAGRANGE = {"quadrotor", "driven_oscillator"}  # forces that no energy gives


class SympyClassics(Service):
    def of(self, endpoint, name, **body):
        return self.ask(endpoint, {"system": name, **body})

    def values_of(self, answer, name):
        given = answer["request"]["parameters"]
        return [float(given[p["name"]]) for p in SCENES[name].get("parameters", [])]

    def test_sympy_derives_the_same_motion(self):
        for name, scene in SCENES.items():
            if name in WITHOUT_LAGRANGE:
                continue
            with self.subTest(name=name):
                answer = self.of("energy", name)
                state = [float(answer["request"]["initial"][q + rate]) for rate in ("", "_dot") for q in names_of(scene)]
                expected = BySympy(scene).accelerations(state, self.values_of(answer, name))
                found = [answer["accelerations"][q + "_ddot"] for q in names_of(scene)]
                size = max(1e-9, *map(abs, expected))
                self.assertLess(max(abs(a - b) for a, b in zip(expected, found)), LOOSER.get(name, 1e-11) * size, (expected, found))

    def test_the_work_balances(self):
        """h of SymPy's Lagrangian changes by what the time in it does, along our motions."""
        for name, scene in SCENES.items():
            if name in WITHOUT_LAGRANGE or "impact" in scene:
                continue
            with self.subTest(name=name):
                end = 1e-2 if name == "kapitza_pendulum" else 0.3
                answer = self.of("simulate", name, t_end=end, samples=201, rtol=1e-12, atol=1e-14, verify=False)
                columns = answer["trajectory"]
                values = self.values_of(answer, name)
                balance = BySympy(scene).balance()
                rows = [[*(columns[q][i] for q in names_of(scene)), *(columns[q + "_dot"][i] for q in names_of(scene))]
                        for i in range(len(columns["t"]))]
                both = numpy.array([[float(x) for x in balance(*row, *values, t)] for row, t in zip(rows, columns["t"])])
                if len(rows) % 2 == 0:
                    both = both[:-1]
                step = columns["t"][1] - columns["t"][0]
                power = both[:, 1]
                work = step / 3 * (power[0] + power[-1] + 4 * power[1:-1:2].sum() + 2 * power[2:-1:2].sum())
                size = max(numpy.abs(both[:, 0]).max(), numpy.abs(power).max() * end, numpy.abs(both[:, 2]).max())
                self.assertLess(abs(both[-1, 0] - both[0, 0] - work), 1e-8 * size, name)


if __name__ == "__main__":
    sys.exit(unittest.main())
