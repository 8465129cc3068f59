"""The command line for people: text on a terminal and JSON in a pipe, advice, manual page and completion."""

import json
import os
import pty
import re
import shutil
import subprocess
import unittest

from running_qdot import ENVIRONMENT, QDOT, qdot

COLOUR = re.compile(r"\x1b\[[0-9;]*m")


def on_a_terminal(*arguments, **environment):
    """What a person sees: exit code and the text of both streams, as a terminal leaves it: the line that tells how far
    a slow machine is has been wiped out."""
    leader, follower = pty.openpty()
    process = subprocess.Popen([QDOT, *arguments], stdin=follower, stdout=follower, stderr=follower,
                               env={**ENVIRONMENT, "TERM": "xterm", **environment})
    os.close(follower)
    seen = b""
    while True:
        try:
            part = os.read(leader, 65536)
        except OSError:  # the end, on Linux
            break
        if not part:
            break
        seen += part
    os.close(leader)
    return process.wait(timeout=60), seen.decode().replace("\r\n", "\n").rpartition("\r\x1b[K")[2]


class Text(unittest.TestCase):
    def test_a_terminal_gets_text_and_a_pipe_json(self):
        code, seen = on_a_terminal("modes", "cart_pendulum", "k=10")
        self.assertEqual(code, 0)
        self.assertRegex(seen, COLOUR)
        plain = COLOUR.sub("", seen)
        self.assertRegex(plain, r"(?m)^cart_pendulum$")
        self.assertRegex(plain, r"(?m)^  kind +omega +")
        self.assertRegex(plain, r"(?m)^  oscillation +2\.4525697 ")
        self.assertNotIn("{", plain.split("modes")[0])
        self.assertEqual(json.loads(qdot("modes", "cart_pendulum", "k=10").stdout)["system"], "cart_pendulum")

    def test_a_closed_form_is_one_line_below_the_table(self):
        text = qdot("modes", "cart_pendulum", "--format", "table").stdout.decode()
        self.assertRegex(text, r"(?m)^  1\. omega\^2 = g/\(2\*l\), shape x = 1, theta = 1/l, assumes l > 0, g > 0, ")
        self.assertEqual(text.count("omega^2"), 2)
        self.assertNotIn("frac", text)

    def test_json_on_a_terminal_when_it_is_wanted(self):
        for option in ("--json", "--pretty", "--format=json"):
            code, seen = on_a_terminal("modes", "cart_pendulum", option)
            self.assertEqual((code, json.loads(seen)["system"]), (0, "cart_pendulum"))

    def test_the_description_of_the_service_is_text_too(self):
        """It has schemas of formulas, which are no formulas."""
        code, seen = on_a_terminal("openapi")
        self.assertEqual(code, 0, seen)
        self.assertEqual(qdot("openapi", "--format", "table").returncode, 0)

    def test_no_colours_for_those_who_want_none(self):
        for environment in ({"NO_COLOR": "1"}, {"TERM": "dumb"}):
            self.assertNotIn("\x1b", on_a_terminal("systems", **environment)[1])
        self.assertNotIn(b"\x1b", qdot("modes", "cart_pendulum", "--format", "table").stdout)

    def test_every_number_of_the_answer_is_in_the_text(self):
        for words in (("modes", "rod_pendulum"), ("energy", "orbiting_pendulum"), ("equilibria", "whirling_pendulum"),
                      ("turning_points", "free_spin_pendulum"), ("gait", "compass_walker"),
                      ("equations", "cart_pendulum"), ("simulate", "spring_pendulum", "t_end=1", "samples=9")):
            with self.subTest(words=words):
                digits = [] if words[0] == "equations" else ["digits=8"]
                answer = json.loads(qdot(*words, *digits).stdout)
                text = qdot(*words, "--format", "table").stdout.decode()
                for member in ("system", "model_version", "service_version", "request", "units"):
                    answer.pop(member, None)
                missing = [leaf for leaf in leaves(answer) if leaf not in text]
                self.assertEqual(missing, [])

    def test_a_document_for_programs_is_text_too(self):
        text = qdot("openapi", "--format", "table").stdout.decode()
        for path in json.loads(qdot("openapi").stdout)["paths"]:
            self.assertIn(f"{path}\n", text)

    def test_columns_can_be_plotted_as_they_are(self):
        text = qdot("simulate", "spring_pendulum", "t_end=2", "samples=9", "--format", "table").stdout.decode()
        answer = json.loads(qdot("simulate", "spring_pendulum", "t_end=2", "samples=9", "digits=8").stdout)
        rows = [[float(cell) for cell in line.split()] for line in text.splitlines() if not line.startswith("#")]
        columns = list(answer["trajectory"].values())
        self.assertEqual(rows, [list(row) for row in zip(*columns)])
        names = next(line for line in text.splitlines() if line.split()[:2] == ["#", "t"])
        self.assertEqual(names.split()[1:], list(answer["trajectory"]))
        self.assertRegex(text, r"(?m)^# theta +[▁▂▃▄▅▆▇█]{9}$")

    def test_a_problem_is_text_on_a_terminal(self):
        code, seen = on_a_terminal("modes", "cart_pendulum", "kk=10", "m=3 furlong")
        self.assertEqual(code, 3)
        self.assertIn("kk: There is no field 'kk'. Did you mean k?", COLOUR.sub("", seen))
        self.assertNotIn("{", seen)

    def test_work_of_some_seconds_shows_that_it_goes_on(self):
        code, seen = on_a_terminal("accuracy", "spring_pendulum", "t_end=2000", "samples=2", "--bounded", "--json")
        self.assertIn(code, (0, 4))
        if "computing" not in seen:
            self.skipTest("this machine computes it within a second")
        self.assertIn("\r\x1b[Kcomputing, 1 s", seen)
        self.assertTrue(seen.split("\x1b[K")[-1].startswith("{"))


def not_for_a_terminal(value):
    """LaTeX, and of a mode's formulas those that follow from omega^2."""
    return {"latex", "omega", "rate", "period", "lambda", "shape_scaled", "general"} if "of" in value else {"latex"}


def leaves(value):
    """Numbers and texts of an answer, as text has them."""
    if isinstance(value, dict):
        return [leaf for name, part in value.items() if name not in not_for_a_terminal(value) for leaf in leaves(part)]
    if isinstance(value, list):
        return [leaf for part in value for leaf in leaves(part)]
    if value is None or isinstance(value, bool):
        return []
    return [value if isinstance(value, str) else json.dumps(value)]


class Advice(unittest.TestCase):
    def test_stdin_that_never_ends_is_refused(self):
        with open("/dev/zero", "rb") as zeros:
            run = subprocess.run([QDOT, "simulate"], stdin=zeros, capture_output=True, timeout=20, check=False,
                                 env=ENVIRONMENT)
        self.assertEqual(run.returncode, 2)
        self.assertIn(b"longer than", run.stderr)

    def test_a_port_that_is_taken_is_nobodys_mistake(self):
        import socket
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            run = qdot("serve", "--port", str(taken.getsockname()[1]))
        self.assertEqual(run.returncode, 2)
        self.assertIn(b"--port 0", run.stderr)

    def test_help_has_the_symbols_of_a_system(self):
        text = qdot("modes", "cart_pendulum", "--help").stdout.decode()
        self.assertIn("stiffness of the spring between cart and wall (in N/m; default 2*m*g/l)", " ".join(text.split()))
        self.assertIn("velocity of theta (in rad/s; default 0)", text)

    def test_examples_in_every_help_are_answered(self):
        document = json.loads(qdot("openapi").stdout)
        commands = [path.removeprefix("/v1/") for path, m in document["paths"].items() if "post" in m and "." not in path]
        self.assertGreaterEqual(len(commands), 9)
        for command in commands:
            text = qdot(command, "--help").stdout.decode()
            example = re.search(r"(?m)^Example: qdot (.*)$", text)
            with self.subTest(command=command):
                self.assertIsNotNone(example)
                run = subprocess.run(["sh", "-c", f"'{QDOT}' {example.group(1)}"], capture_output=True, timeout=120,
                                     check=False, stdin=subprocess.DEVNULL, env=ENVIRONMENT)
                self.assertEqual(run.returncode, 0, run.stderr)


class Documents(unittest.TestCase):
    def test_the_manual_page_has_every_command_and_no_mistake_of_roff(self):
        page = qdot("manual").stdout.decode()
        commands = re.findall(r"(?m)^  (\w+) +\S", qdot("--help").stdout.decode().split("Subcommands:")[1])
        self.assertGreaterEqual(len(commands), 14)
        for command in commands:
            self.assertIn(f".SS qdot {command}\n", page)
        for line in page.splitlines():
            if line.startswith("."):
                self.assertRegex(line, r'^\.(TH|SH|SS|TP|PP|B|nf|fi)\b')
        if shutil.which("groff"):
            run = subprocess.run(["groff", "-man", "-Tutf8", "-ww"], input=page.encode(), capture_output=True, check=False)
            self.assertEqual((run.returncode, run.stderr), (0, b""))

    def complete(self, *words):
        script = ('source <(qdot completion); COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); '
                  'compopt() { :; }; _qdot; printf "%s\\n" "${COMPREPLY[@]}"')
        run = subprocess.run(["bash", "-c", script.replace("qdot completion", f"'{QDOT}' completion"), "bash", *words],
                             capture_output=True, timeout=20, check=True, text=True, env=ENVIRONMENT)
        self.assertEqual(run.stderr, "")
        return run.stdout.split()

    def test_bash_completes_commands_systems_fields_symbols_and_values(self):
        self.assertEqual(self.complete("qdot", "turn"), ["turning_points"])
        self.assertEqual(self.complete("qdot", "modes", "cart"), ["cart_pendulum"])
        self.assertEqual(self.complete("qdot", "systems", "compass"), ["compass_walker"])
        self.assertEqual(self.complete("qdot", "modes", "cart_pendulum", "theta"), ["theta=", "theta_dot="])
        self.assertEqual(self.complete("qdot", "simulate", "cart_pendulum", "t_"), ["t_start=", "t_end="])
        self.assertEqual(self.complete("qdot", "simulate", "cart_pendulum", "method", "=", "ta"), ["taylor"])
        self.assertIn("adams", self.complete("qdot", "simulate", "cart_pendulum", "method", "="))
        self.assertEqual(self.complete("qdot", "modes", "--pre"), ["--pretty"])


if __name__ == "__main__":
    unittest.main()
