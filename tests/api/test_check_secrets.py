"""/v1/check: what is submitted costs no more than its size, and nothing of the key leaves with the verdict."""

import unittest

from test_check import ANGLES, SHAPE, TURNING_POINT, Check


class Hostile(Check):
    """Whatever is handed in ends soon, and the next item is graded."""

    BOMBS = ["(" * 4000, "{" * 4000, "\\frac" * 800, "9^9^9^9^9", "x" * 4096, "m" * 48, "1+" * 2040, "-" * 4000 + "1", "m^64^64", "sin(" * 300,
             "(theta + l + m + k + g + l0)^64", "((theta + l + m)^64 + (theta - l)^64)^64", "(theta+l)^60*(theta+m)^60*(theta+k)^60*(theta+g)^60",
             "*".join(f"(sin({i}*theta)+cos({i}*l)+m)" for i in range(2, 60)), "+".join(f"sqrt(theta+{i})" for i in range(1, 300)),
             "exp(" * 60 + "theta" + ")" * 60, "tan(" * 60 + "theta" + ")" * 60, "1/(1+" * 60 + "l" + ")" * 60, "theta" + "'" * 3000,
             "__import__('os').system('id')", "\\input{/etc/passwd}", "$(id)", "`id`", "<script>", "\u202e\u0430", "theta\u0000",
             "e^" * 500 + "l", "abs(" * 60 + "theta" + ")" * 60, "|" * 2000, "Derivative(" * 300, "d/dt(" * 60 + "theta" + ")" * 60, "=" * 4000, "1e308*1e308",
             "t,l\n" + "0,0\n" * 200000, "a" * 500000]

    def test_bombs(self):
        expected = ({"expression": {"system": "rod_spring_pendulum"}, "of": "r_ddot"}, {"equation": {"system": "rod_spring_pendulum"}, "of": "r"},
                    {"expression": {"system": "spring_pendulum"}, "of": "T"}, TURNING_POINT, {"simulate": {"system": "spring_pendulum", "t_end": 1}, "columns": ["l"]})
        for bomb in self.BOMBS:
            for expect in expected:
                for text in (bomb, f"{bomb} = 0"):
                    with self.subTest(bomb=bomb[:60], expect=list(expect)[0]):
                        items = [{"expect": expect, "submitted": text}, {"expect": TURNING_POINT, "submitted": "55.13deg"}]
                        status, answer = self.check(items)
                        self.assertEqual(status, 200, answer)
                        self.assertIsNot(answer["items"][0]["correct"], True)
                        self.assertIs(answer["items"][1]["correct"], True)

    def test_other_types(self):
        for value in (None, True, 3, -1e300, [], {}, [[[[]]]], {"a": {"b": []}}, ["x"] * 5000, [1e308] * 3):
            for expect in (TURNING_POINT, ANGLES, SHAPE, {"expression": {"system": "spring_pendulum"}, "of": "T"}, {"equation": {"system": "spring_pendulum"}},
                           {"simulate": {"system": "spring_pendulum", "t_end": 1}}):
                with self.subTest(value=str(value)[:40], expect=list(expect)[0]):
                    status, answer = self.check([{"expect": expect, "submitted": value}])
                    self.assertEqual(status, 200, answer)
                    self.assertIsNot(answer["items"][0]["correct"], True)


class Secrets(Check):
    def test_nothing_of_the_key_leaves(self):
        items = [{"expect": TURNING_POINT, "submitted": 1}, {"expect": ANGLES, "submitted": [0], "rule": {"any_order": True}},
                 {"expect": {"equation": {"system": "cart_pendulum", "parameters": {"g": 7.125}}, "of": "theta"}, "submitted": "theta'' = g x"},
                 {"expect": {"expression": {"system": "cart_pendulum", "parameters": {"k": 7.125}}, "of": "V"}, "submitted": "k x"},
                 {"expect": {"expression": {"system": "cart_pendulum"}, "is": "7.125 l"}, "submitted": "m g"}]
        body = {"items": [{"id": str(i), **item} for i, item in enumerate(items)]}
        text = self.post("check", body).data.decode()
        for secret in ("0.962", "55.13", "0.668", "7.125", "expected", "turning_points", "cart_pendulum"):
            self.assertNotIn(secret, text)
        _, revealed = self.check(items, reveal=True)
        self.assertEqual(revealed["items"][0]["expected"], 0.9622333375061675)
        self.assertIn("x_ddot*cos(theta)", revealed["items"][2]["expected"]["text"])

    SECRETS = {
        "equation": lambda g: {"equation": {"system": "cart_pendulum", "parameters": {"g": g}}, "of": "theta"},
        "equations": lambda g: {"equation": {"system": "cart_pendulum", "parameters": {"g": g}}},
        **{of: lambda g, of=of: {"expression": {"system": "cart_pendulum", "parameters": {"g": g}}, "of": of} for of in ("T", "V", "H", "theta_ddot")},
        "formula": lambda g: {"expression": {"system": "cart_pendulum"}, "is": f"{g}*l"},
        "number": lambda g: {"energy": {"system": "cart_pendulum", "parameters": {"g": g}}, "at": "/V"},
        "numbers": lambda g: {"modes": {"system": "cart_pendulum", "parameters": {"g": g}}, "at": "/modes/*/omega"},
        "columns": lambda g: {"simulate": {"system": "spring_pendulum", "parameters": {"g": g}, "t_end": 1}, "columns": ["l"]},
        "fact": lambda g: {"equilibria": {"system": "whirling_pendulum", "parameters": {"g": g, "Omega": 50}}, "at": "/equilibria/0/stability"}}
    PROBES = ["g", "exp(g)", "theta'' = g", "theta'' = 1/g", "l*theta'' + x''*cos(theta) + 2*g*sin(theta) = 0", "l theta'' + x'' cos(theta) - g sin(theta) = 0",
              "x'' = g; theta'' = g", "w = theta'; w' = g", "L = m*g", "theta''^2 = g^2", "abs(theta'') = g", "g = g", "g = 0", "m*l*x", "m*g*l*cos(theta) + k*x",
              "1/(g-g)", "sqrt(g-100)", "g^g", "", "none", 1, 3.5, "3 rad", [1, 2], {"a": 1}, "t,l\n0,0.5\n0.5,0.6\n1,0.7", "stable", "theta_ddot + g*t"]

    def said_of(self, expect, **more):
        status, answer = self.check([{"expect": expect, "submitted": probe} for probe in self.PROBES], **more)
        self.assertEqual(status, 200, answer)
        return answer["items"]

    def test_of_two_keys_with_different_secrets_the_same_is_said(self):
        for kind, expect in self.SECRETS.items():
            with self.subTest(kind=kind):
                self.assertEqual(self.said_of(expect(7.125)), self.said_of(expect(8.8125)))
        for kind in ("V", "formula", "number", "numbers"):  # which is seen where they are revealed
            self.assertNotEqual(self.said_of(self.SECRETS[kind](7.125), reveal=True), self.said_of(self.SECRETS[kind](8.8125), reveal=True))

    def test_the_same_submission_and_seed_have_the_same_bytes(self):
        item = {"id": "a", "expect": {"equation": {"system": "compass_walker"}, "of": "phi"}, "submitted": "phi'' = theta''"}
        once, again, other = (self.post("check", {"items": [item], "seed": seed}).data for seed in (3, 3, 4))
        self.assertEqual(once, again)
        self.assertNotEqual(once, other)


if __name__ == "__main__":
    unittest.main()
