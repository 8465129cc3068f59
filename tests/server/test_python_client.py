"""api/clients/qdot.py: its docstrings are executed, its methods are the endpoints with all their fields."""

import doctest
import inspect
import json
import sys
import unittest

from running_qdot import QDOT, ROOT, RunningQdot

sys.path.append(str(ROOT / "api" / "clients"))

import qdot as client  # noqa: E402
from qdot import Problem, Qdot, Unreachable  # noqa: E402


class PythonClient(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = RunningQdot("--deadline", "60")
        cls.address = f"http://localhost:{cls.server.port}"
        cls.qdot = Qdot(cls.address)

    @classmethod
    def tearDownClass(cls):
        cls.server.__exit__()

    def test_docstrings(self):
        finder = doctest.DocTestFinder()
        runner = doctest.DocTestRunner(verbose=False)
        for test in finder.find(client, globs=dict(vars(client))):
            for example in test.examples:
                here = example.source.replace("http://localhost:8080", self.address)
                example.source = here.replace("Qdot()", f'Qdot("{self.address}")')
            runner.run(test)
        self.assertGreater(runner.tries, 8)
        self.assertEqual(runner.failures, 0)

    def test_methods_are_the_endpoints_with_their_fields(self):
        document = json.loads(self.server.request("GET", "/openapi.json").data)
        paths = [path for path, methods in document["paths"].items() if "post" in methods and "." not in path]
        self.assertGreaterEqual(len(paths), 9)
        for path in paths:
            method = getattr(Qdot, path.removeprefix("/v1/"), None)
            with self.subTest(path=path):
                self.assertIsNotNone(method)
                self.assertTrue(method.__doc__)
                content = document["paths"][path]["post"]["requestBody"]["content"]["application/json"]
                fields = set(document["components"]["schemas"][content["schema"]["$ref"].split("/")[-1]]["properties"])
                words = {name.rstrip("_") for name in inspect.signature(method).parameters} - {"self", "symbols"}
                self.assertEqual(words, fields - {"format"})

    def test_symbols_find_their_places(self):
        with_names = self.qdot.energy("forced_spring_pendulum", k=30, theta="30deg", theta_dot=1, F="cos(t)")
        in_places = self.qdot.energy("forced_spring_pendulum", parameters={"k": 30}, inputs={"F": "cos(t)"},
                                     initial={"theta": "30deg", "theta_dot": 1})
        self.assertEqual(with_names, in_places)
        self.assertEqual(with_names["request"]["inputs"], {"F": "cos(t)"})

    def test_a_scene_of_ones_own_has_symbols_too(self):
        scene = {"name": "block", "parameters": [{"name": "k", "unit": "N/m", "default": 4}],
                 "coordinates": [{"name": "x", "unit": "m"}],
                 "bodies": [{"kind": "particle", "mass": 1, "position": ["x", "0"]}], "potential": "1/2*k*x^2"}
        self.assertEqual(self.qdot.energy(scene, k=9, x=2)["V"], 18)

    def test_http_and_command_line_are_the_same(self):
        by_command = Qdot(command=QDOT)
        for ask in (lambda q: q.modes("cart_pendulum", k=10), lambda q: q.systems("rod_pendulum"),
                    lambda q: q.problems(8), lambda q: q.simulate("spring_pendulum", t_end=1, samples=3)):
            self.assertEqual(ask(by_command), ask(self.qdot))

    def test_problems_say_what_to_write(self):
        for qdot in (self.qdot, Qdot(command=QDOT)):
            with self.assertRaises(Problem) as caught:
                qdot.simulate("spring_pendulum", t_end=1, parameters={"K": 45}, theta="30 dge")
            said = str(caught.exception)
            for words in ("#/parameters/K", "Did you mean 'k'?", "#/initial/theta", "Did you mean '30 deg'?"):
                self.assertIn(words, said)
            self.assertEqual(caught.exception.status, 422)
            self.assertEqual(len(caught.exception.errors), 2)

    def test_nobody_there(self):
        with self.assertRaisesRegex(Unreachable, "qdot serve"):
            Qdot("localhost:1").systems()

    def test_a_token_is_sent(self):
        with RunningQdot(QDOT_TOKEN="a secret") as server:
            address = f"localhost:{server.port}"
            self.assertTrue(Qdot(address, token="a secret").systems()["systems"])
            with self.assertRaisesRegex(Problem, "token"):
                Qdot(address).systems()


if __name__ == "__main__":
    unittest.main()
