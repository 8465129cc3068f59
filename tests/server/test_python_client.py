"""api/clients/qdot.py: its docstrings are executed, its methods have all fields of their endpoints."""

import doctest
import inspect
import json
import sys
import time
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

    def test_methods_have_the_fields_of_their_endpoints(self):
        document = json.loads(self.server.request("GET", "/openapi.json").data)
        paths = [path for path, methods in document["paths"].items() if "post" in methods and "." not in path]
        methods = {path: vars(Qdot)[path.removeprefix("/v1/")] for path in paths if path.removeprefix("/v1/") in vars(Qdot)}
        self.assertGreaterEqual(len(methods), 9)
        for path, method in methods.items():
            with self.subTest(path=path):
                self.assertTrue(method.__doc__)
                content = document["paths"][path]["post"]["requestBody"]["content"]
                words = {name.rstrip("_") for name in inspect.signature(method).parameters} - {"self", "symbols"}
                if "application/json" not in content:
                    self.assertEqual((set(content), words), ({"application/x-ndjson"}, {"lines"}))
                    continue
                schema = content["application/json"]["schema"]["$ref"].split("/")[-1]
                fields = set(document["components"]["schemas"][schema]["properties"])
                self.assertEqual(words, fields - {"format"})

    def test_an_endpoint_without_a_method_is_asked_by_its_name(self):
        requests = {"modes": ("cart_pendulum", {"k": 10, "digits": 6, "parameters": {"g": 9}}),
                    "bifurcations": ("whirling_pendulum", {"parameter": "Omega", "from_": 3, "to": 5})}
        for name, (system, fields) in requests.items():
            for qdot in (self.qdot, Qdot(command=QDOT)):
                expected = getattr(qdot, name)(system, **fields)
                method = vars(Qdot)[name]
                delattr(Qdot, name)
                try:
                    self.assertEqual(getattr(qdot, name)(system, **fields), expected)
                finally:
                    setattr(Qdot, name, method)

    def test_a_name_that_nothing_has_is_told_what_is_near(self):
        for qdot in (self.qdot, Qdot(command=QDOT), Qdot("localhost:1")):
            with self.assertRaisesRegex(AttributeError, "did you mean modes?"):
                qdot.mods
            self.assertFalse(hasattr(qdot, "_repr_html_"))

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
                    lambda q: q.problems(8), lambda q: q.simulate("spring_pendulum", t_end=1, samples=3),
                    lambda q: q.sweep({"energy": {"system": "spring_pendulum"}}, vary="k", values=[30, "40"], collect=["/V"]),
                    lambda q: list(q.batch([{"energy": {"system": "spring_pendulum"}}, {"modes": 1}, {}]))):
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


def motions(count, **fields):
    """Lines of a batch, none before it is asked for; how many have been is in `motions.read`."""
    motions.read = 0
    for number in range(count):
        motions.read += 1
        yield {"id": number, "simulate": {"system": "spring_pendulum", "t_end": 1, "samples": 3, "verify": False, **fields}}


class Batches(unittest.TestCase):
    def roads(self, *arguments):
        """Over HTTP and by the command line."""
        with RunningQdot(*arguments) as server:
            yield Qdot(f"localhost:{server.port}")
        yield Qdot(command=QDOT)

    def test_answers_come_in_order_however_many_there_are(self):
        for qdot in self.roads():
            answers = list(qdot.batch(motions(1234)))
            self.assertEqual([answer["id"] for answer in answers], list(range(1234)))
            self.assertEqual({answer["status"] for answer in answers}, {200})
            self.assertEqual(list(qdot.batch([])), [])

    def test_lines_are_read_as_answers_are(self):
        for qdot in self.roads():
            answers = qdot.batch(motions(1_000_000))
            self.assertEqual([next(answers)["id"] for _ in range(3)], [0, 1, 2])
            self.assertLess(motions.read, 50_000)
            answers.close()

    def test_what_is_too_much_at_once_is_asked_in_parts(self):
        started = time.monotonic()
        self.assertEqual(len(list(Qdot(command=QDOT).batch(motions(100, t_end=500)))), 100)
        third = (time.monotonic() - started) / 3
        with RunningQdot("--deadline", f"{third:.2f}") as server:
            answers = list(Qdot(f"localhost:{server.port}").batch(motions(100, t_end=500)))
        self.assertEqual([(answer["id"], answer["status"]) for answer in answers], [(i, 200) for i in range(100)])
        with RunningQdot("--deadline", "60") as server:  # of 1 MB each: more than one answer may have
            lengths = [len(answer["answer"]["trajectory"]["t"])
                       for answer in Qdot(f"localhost:{server.port}").batch(motions(40, samples=10_000))]
        self.assertEqual(lengths, [10_000] * 40)

    def test_a_line_that_is_too_long_fails_alone(self):
        good = {"id": "good", "energy": {"system": "spring_pendulum"}}
        for qdot in self.roads():
            answers = list(qdot.batch([good, {"id": "long", "energy": {"system": "x" * 2_000_000}}, good]))
            self.assertEqual([answer["status"] for answer in answers], [200, 413, 200])

    def test_what_the_callers_iterator_raises_reaches_the_caller(self):
        def broken():
            yield from motions(2)
            raise ZeroDivisionError

        for qdot in self.roads():
            with self.assertRaises(ZeroDivisionError):
                list(qdot.batch(broken()))


if __name__ == "__main__":
    unittest.main()
