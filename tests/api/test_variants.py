"""qdot variant: numbers for each student, drawn from a key's ranges, and a key that grades them."""

import concurrent.futures
import json
import os
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests" / "server"))

from running_qdot import RunningQdot, qdot  # noqa: E402

KEYS = sorted((ROOT / "api" / "about" / "keys").glob("*.json"))
SEEDS = int(os.environ.get("QDOT_VARIANT_SEEDS", "60"))
COSTLY = {"problem_7": 4}  # ten times the work of another: one seed of so many
MOST_ITEMS = 100  # of one request, which has one share of algebra for what is expected


def variant(key, seed, *words):
    """The run for a key, a file or a value."""
    if isinstance(key, pathlib.Path):
        return qdot("variant", str(key), "--seed", str(seed), *words)
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        file.write(key if isinstance(key, str) else json.dumps(key))
        file.flush()
        return qdot("variant", file.name, "--seed", str(seed), *words)


def drawn(key, seed):
    run = variant(key, seed)
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)


def seeds_of(name):
    return range(0, SEEDS, COSTLY.get(name, 1))


def splitmix64(state):
    """Steele, Lea, Flood 2014."""
    while True:
        state = (state + 0x9E3779B97F4A7C15) % 2**64
        z = (state ^ (state >> 30)) * 0xBF58476D1CE4E5B9 % 2**64
        z = (z ^ (z >> 27)) * 0x94D049BB133111EB % 2**64
        yield z ^ (z >> 31)


def symbolic_key(ranges, *expressions):
    """A key in which every draw is good: the values only change a formula."""
    return {"ranges": ranges,
            "items": [{"id": str(number), "expect": {"expression": {"system": "cart_pendulum", "parameters": {"M": text}}, "of": "T"}}
                      for number, text in enumerate(expressions)]}


class Drawing(unittest.TestCase):
    def test_bits_are_those_of_splitmix64(self):
        key = symbolic_key({"a": {"from": 1, "to": 4, "step": 0.25, "unit": "kg"}, "b": {"values": [2, 3, 5]}}, "$a", "$b*m")
        for seed in (0, 1, 7, 2**53):
            bits = splitmix64(seed)
            a, b = next(bits) % 13, next(bits) % 3
            values = drawn(key, seed)["variant"]["values"]
            self.assertEqual(values, {"a": f"{1 + a / 4:.2f} kg", "b": str([2, 3, 5][b])})

    def test_the_same_seed_gives_the_same_bytes(self):
        for key in KEYS:
            self.assertEqual(variant(key, 5).stdout, variant(key, 5).stdout)

    def test_values_are_decimals_as_students_write_them(self):
        for bounds, example in (({"from": 0.4, "to": 1.2}, 2), ({"from": 20, "to": 60}, 0), ({"from": -0.03, "to": 0.03}, 3),
                                ({"from": 1000, "to": 9000}, 0), ({"from": 0.1, "to": 0.3, "step": 0.1}, 1)):
            for seed in range(20):
                value = drawn(symbolic_key({"a": bounds}, "(5 + $a)*m"), seed)["variant"]["values"]["a"]
                self.assertEqual(len(value.partition(".")[2]), example, value)
                self.assertTrue(bounds["from"] <= float(value) <= bounds["to"], value)

    def test_both_ends_are_drawn(self):
        key = symbolic_key({"a": {"from": 0.1, "to": 0.3, "step": 0.1}}, "$a*m")
        self.assertEqual({drawn(key, seed)["variant"]["values"]["a"] for seed in range(40)}, {"0.1", "0.2", "0.3"})

    def test_where_values_are_put(self):
        key = symbolic_key({"a": {"values": [1.5], "unit": "kg"}, "b": {"values": [-2]}}, "$a", "3*m + $b*m")
        items = drawn(key, 0)["items"]
        texts = [item["expect"]["expression"]["parameters"]["M"] for item in items]
        self.assertEqual(texts, ["1.5 kg", "3*m + (-2)*m"])


class Degenerate(unittest.TestCase):
    """Draws in which a usual slip would count as right are not given to anybody."""

    @staticmethod
    def key(values, question, at, rule=None):
        item = {"id": "1", "expect": {**question, "at": at}}
        return {"ranges": {"a": {"values": values}}, "items": [{**item, "rule": rule} if rule else item]}

    def values(self, key):
        return {drawn(key, seed)["variant"]["values"]["a"] for seed in range(12)}

    def test_zero_has_no_factor(self):
        key = self.key([0, 0.3], {"energy": {"system": "spring_pendulum", "initial": {"theta": "$a"}}}, "/accelerations/theta_ddot")
        self.assertEqual(self.values(key), {"0.3"})

    def test_a_rate_that_is_its_period(self):
        question = {"modes": {"system": "spring_pendulum", "parameters": {"m": "1", "k": "$a"}}}
        self.assertEqual(self.values(self.key([6.2832, 30], question, "/modes/1/omega")), {"30"})
        self.assertEqual(self.values(self.key([6.2832, 30], question, "/modes/1/omega", {"rtol": 1e-7})), {"6.2832", "30"})

    def test_one_is_its_square(self):
        key = self.key([1, 2.25], {"modes": {"system": "spring_pendulum", "parameters": {"m": "1", "k": "$a"}}}, "/modes/1/omega")
        self.assertEqual(self.values(key), {"2.25"})

    def test_no_answer(self):
        key = self.key([0.5, 5], {"equilibria": {"system": "whirling_pendulum", "parameters": {"Omega": "$a"}}}, "/equilibria/3/state/theta")
        self.assertEqual(self.values(key), {"5"})

    def test_when_all_are_degenerate(self):
        key = self.key([0], {"energy": {"system": "spring_pendulum", "initial": {"theta": "$a"}}}, "/accelerations/theta_ddot")
        run = variant(key, 1)
        self.assertEqual((run.returncode, run.stdout), (3, b""))
        self.assertIn(b"no draw of 200", run.stderr)


class Refused(unittest.TestCase):
    def refused(self, key, *words):
        run = variant(key, 1)
        self.assertEqual((run.returncode, run.stdout), (3, b""), run.stderr)
        for word in words:
            self.assertIn(word.encode(), run.stderr)

    def test_ranges(self):
        for text, place in (("3", "ranges"), ('{"a": 3}', "ranges/a"), ('{"a b": {"values": [1]}}', "ranges/a b"),
                            ('{"a": {}}', "ranges/a"), ('{"a": {"from": 1}}', "ranges/a"), ('{"a": {"from": 2, "to": 1}}', "ranges/a"),
                            ('{"a": {"from": 1, "to": 2, "step": 0}}', "step"), ('{"a": {"from": 1, "to": 2, "step": -1}}', "step"),
                            ('{"a": {"from": 0, "to": 1, "step": 1e-6}}', "1000"), ('{"a": {"from": 1e300, "to": 2e300}}', "ranges/a"),
                            ('{"a": {"from": "1", "to": 2}}', "ranges/a"), ('{"a": {"values": []}}', "values"),
                            ('{"a": {"values": [1, "x"]}}', "values"), ('{"a": {"values": [1], "from": 1}}', "either"),
                            ('{"a": {"values": [1], "unit": "mm/parsec"}}', "unit"), ('{"a": {"values": [1], "unit": 3}}', "unit"),
                            ('{"a": {"values": [1], "default": "x"}}', "default"), ('{"a": {"values": [1], "defualt": 1}}', "defualt"),
                            ("{}", "ranges")):
            with self.subTest(ranges=text):
                self.refused('{"ranges": %s, "items": []}' % text, place)

    def test_what_stands_for_a_value(self):
        self.refused(symbolic_key({"a": {"values": [1]}}, "$b*m"), "$b")
        self.refused(symbolic_key({"a": {"values": [1]}, "b": {"values": [1]}}, "$a*m"), "$b")
        self.refused(symbolic_key({"a": {"values": [1], "unit": "kg"}}, "2*$a"), "unit")
        self.refused(symbolic_key({"a": {"values": [1]}}, "$"), "no range")

    def test_a_key_that_is_none(self):
        for text in ("", "[]", "{", '{"items": 3}', '{"ranges": {"a": {"values": [1]}}}', '{"a": 1, "a": 2}'):
            self.refused(text, "qdot variant")
        self.refused(symbolic_key({"a": {"values": [1]}}, "$a*q"), "q")
        self.assertEqual(qdot("variant", "/none/such.json", "--seed", "1").returncode, 2)
        self.assertEqual(qdot("variant", str(KEYS[0])).returncode, 2)
        self.assertEqual(qdot("variant", str(KEYS[0]), "--seed", "x").returncode, 2)

    def test_grading_by_a_key_that_was_not_drawn(self):
        with tempfile.NamedTemporaryFile("w") as key, tempfile.NamedTemporaryFile("w") as answers:
            key.write(json.dumps(symbolic_key({"a": {"values": [1]}}, "$a*m")))
            answers.write("{}")
            key.flush()
            answers.flush()
            run = qdot("check", "--key", key.name, "--answers", answers.name)
        self.assertEqual(run.returncode, 2)
        self.assertIn(b"draw a variant", run.stderr)


class ShippedKeys(unittest.TestCase):
    """Of the ten keys, many variants: each can be graded, right is right, and the slips are wrong."""

    @classmethod
    def setUpClass(cls):
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            cls.variants = {key.stem: list(pool.map(lambda seed, key=key: drawn(key, seed), seeds_of(key.stem))) for key in KEYS}
        cls.server = RunningQdot("--deadline", "60")
        cls.addClassCleanup(cls.server.__exit__)

    def graded(self, items, reveal=False):
        """Of many items, each with its own id in place of the key's, what check says."""
        result = []
        for at in range(0, len(items), MOST_ITEMS):
            part = [{**item, "id": str(number)} for number, item in enumerate(items[at:at + MOST_ITEMS])]
            response = self.server.request("POST", "/v1/check", json.dumps({"items": part, "reveal": reveal}),
                                           {"Content-Type": "application/json"})
            self.assertEqual(response.status, 200, response.data[:500])
            result += json.loads(response.data)["items"]
        return result

    @staticmethod
    def numbers(variants):
        """The items of variants that depend on what was drawn, and expect numbers."""
        return [item for variant in variants for item in variant["items"]
                if "at" in item["expect"] and "is" not in item["expect"]]

    def test_there_are_ten_with_ranges(self):
        self.assertEqual(len(KEYS), 10)
        for key in KEYS:
            different = {json.dumps(variant["variant"]["values"]) for variant in self.variants[key.stem]}
            self.assertGreater(len(different), min(len(seeds_of(key.stem)) / 4, 30))

    def test_right_is_right_and_slips_are_wrong(self):
        for name, variants in self.variants.items():
            items = self.numbers(variants)
            self.assertGreaterEqual(len(items), len(variants), name)
            asked = self.graded([{**item, "submitted": "0" if "any_order" in item.get("rule", {}) else 0.0} for item in items], True)
            expected = [self.expected(item, of) for item, of in zip(asked, items)]
            tried = [(factor, {**item, "submitted": self.times(factor, numbers)}) for item, numbers in zip(items, expected)
                     for factor in (1, 2, 0.5, 57.29577951308232)
                     if factor == 1 or not item.get("rule", {}).get("any_scale")]
            graded = self.graded([item for _, item in tried])
            wrong = [(factor, item, said) for (factor, item), said in zip(tried, graded) if said["correct"] is not (factor == 1)]
            self.assertEqual(wrong[:1], [], name)

    def expected(self, said, item):
        """What is expected; where a single 0 is no answer, [1, 1] asks once more."""
        if "expected" in said and said["expected"] is not None:
            return said["expected"]
        (again,) = self.graded([{**item, "submitted": [1, 1]}], True)
        return again["expected"]

    @staticmethod
    def times(factor, numbers):
        return [factor * number for number in numbers] if isinstance(numbers, list) else factor * numbers

    def test_a_variant_is_a_key(self):
        """Of check, as it was printed."""
        variant_of_7 = self.variants["problem_7"][3]
        ratio = float(variant_of_7["variant"]["values"]["ratio"])
        (item,) = self.numbers([variant_of_7])
        with tempfile.NamedTemporaryFile("w", suffix=".json") as key, tempfile.NamedTemporaryFile("w") as answers:
            key.write(json.dumps(variant_of_7))
            # phi'^2 = 4 r/l omega0^2 sin^2(phi/2) less: cos(phi_max) = 1 - l/(2 r)
            answers.write(json.dumps({"phi_max": f"acos(1 - 1/(2*{ratio}))"}))
            key.flush()
            answers.flush()
            run = qdot("check", "--key", key.name, "--answers", answers.name)
        graded = {entry["id"]: entry["correct"] for entry in json.loads(run.stdout)["items"]}
        self.assertIs(graded[item["id"]], True)


if __name__ == "__main__":
    unittest.main()
