"""Everything that README.md shows is run: each block of commands gives exactly the answer that follows it.

The README's blocks, by what stands before them:
    ```sh                            commands; those with no answer after them only start programs of the checkout
    ```python                        a program
    ```json, ```csv, ```text         directly after commands or a program: their answer
    ```json                          otherwise: the file that the sentence before it names
"""

import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

from running_qdot import ENVIRONMENT, QDOT, ROOT, RunningQdot

README = (ROOT / "README.md").read_text()
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```\n", re.MULTILINE | re.DOTALL)
FILE_NAME = re.compile(r"`([\w/]+\.json)`:\n\n\Z")


def read_blocks(text):
    """(commands, answer or None) in order, and {file name: content}."""
    commands, files, end = [], {}, None
    for block in BLOCK.finditer(text):
        language, content = block.groups()
        name = FILE_NAME.search(text[:block.start()])
        if language == "sh":
            commands.append((content, None))
        elif language == "python":
            commands.append((f"'{sys.executable}' -B - <<'END'\n{content}END\n", None))
        elif block.start() == end and commands and commands[-1][1] is None:
            commands[-1] = (commands[-1][0], content)
        elif language == "json" and name:
            files[name.group(1)] = content
        end = block.end()
    return commands, files


class Readme(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.commands, files = read_blocks(README)
        cls.directory = tempfile.TemporaryDirectory()
        for name, content in files.items():
            path = os.path.join(cls.directory.name, name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w") as file:
                file.write(content)
        cls.server = RunningQdot("--deadline", "60")

    @classmethod
    def tearDownClass(cls):
        cls.server.__exit__()
        cls.directory.cleanup()

    def run_here(self, commands):
        """Standard output of shell commands, with this test's server and binary in the place of the README's."""
        commands = commands.replace("localhost:8080", f"localhost:{self.server.port}")
        commands = commands.replace("build/release/qdot", f"'{QDOT}'")
        run = subprocess.run(["sh", "-c", commands], cwd=self.directory.name, capture_output=True, timeout=60,
                             check=False, text=True, env={**ENVIRONMENT, "no_proxy": "localhost",
                                                     "PYTHONPATH": str(ROOT / "api" / "clients")})
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def test_answers(self):
        answered = [(command, answer) for command, answer in self.commands if answer is not None]
        self.assertGreaterEqual(sum("curl" in command for command, _ in answered), 5)
        self.assertGreaterEqual(sum("build/release/qdot" in command for command, _ in answered), 2)
        self.assertGreaterEqual(sum("import" in command for command, _ in answered), 3)
        for command, answer in answered:
            with self.subTest(command=command):
                self.assertEqual(self.run_here(command).strip(), answer.strip())

    def test_commands_without_an_answer_are_programs_of_the_checkout(self):
        lines = [line for command, answer in self.commands if answer is None for line in command.splitlines()]
        self.assertIn("./server/run", lines)
        self.assertIn("./tests/run", lines)
        for line in lines:
            with self.subTest(line=line):
                self.assertTrue(os.access(ROOT / line.split()[0], os.X_OK))

    def test_table_of_systems(self):
        def names(things):
            return ", ".join(thing["name"] for thing in things)

        expected = []
        for entry in self.get_json("/v1/systems")["systems"]:
            system = self.get_json(entry["href"])
            expected.append([entry["problem"], f"`{entry['name']}`", entry["title"], names(system["coordinates"]),
                             names(system["parameters"])])
        table = re.search(r"^\| problem \| name \| what it is \| coordinates \| parameters \|\n\|[-|]+\|\n((?:\|.*\n)*)",
                          README, re.MULTILINE)
        self.assertIsNotNone(table)
        rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in table.group(1).splitlines()]
        self.assertEqual(rows, expected)

    def test_paths_exist(self):
        paths = set(re.findall(r"`((?:api|core|server|tests)/[\w./]*)`", README))
        self.assertIn("core/pipeline.hpp", paths)
        for path in sorted(paths):
            with self.subTest(path=path):
                self.assertTrue((ROOT / path).exists())

    def test_the_new_problem_is_served(self):
        with RunningQdot("--deadline", "60", "--scenes", os.path.join(self.directory.name, "scenes")) as server:
            self.assertEqual(server.request("GET", "/v1/simulate?system=bead_on_hoop&t_end=1").status, 200)

    def get_json(self, target):
        response = self.server.request("GET", target)
        self.assertEqual(response.status, 200)
        return json.loads(response.data)


if __name__ == "__main__":
    unittest.main()
