"""The keys of the practice sheet, api/about/keys: what the sheet derives is right, in its own letters, and a near miss is wrong."""

import json
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests" / "server"))

from running_qdot import qdot  # noqa: E402

KEYS = ROOT / "api" / "about" / "keys"

# For every item an answer that is right and one that is wrong.
ANSWERS = {
    1: {"T": (r"\frac{1}{2}m(\dot l^2 + l^2\dot\theta^2)", "1/2 m (l' + l theta')^2"),
        "V": ("-mgl cos theta + 1/2 k(l-l0)^2", "mgl cos theta + 1/2 k(l-l0)^2"),
        "l": ("m l'' - m l theta'^2 - mg cos theta + k(l-l0) = 0", "m l'' - mg cos theta + k(l-l0) = 0"),
        "theta": ("m l^2 theta'' + 2 m l l' theta' + m g l sin theta = 0", "m l^2 theta'' + m g l sin theta = 0"),
        "omega": ("4.4625, sqrt(80)", "4.4625, 8")},
    2: {"Q_l": ("F sin theta", "F cos theta"), "Q_theta": ("F l cos theta", "F l sin theta"),
        "l": ("m l'' - m l theta'^2 - m g cos theta + k(l-l0) = F sin theta", "m l'' - m l theta'^2 - m g cos theta + k(l-l0) = 0"),
        "theta": ("m l^2 theta'' + 2 m l l' theta' + m g l sin theta = F l cos theta", "m l^2 theta'' + 2 m l l' theta' + m g l sin theta = F cos theta"),
        "theta_ddot": ("(10*cos(pi/6) - 9.81/2)/0.55", "6.13")},
    3: {"T": ("3/4 m q'^2 - 3/2 m r Omega q' + 1/2 m Omega^2 q^2 + 3/4 m r^2 Omega^2", "3/4 m q'^2 + 1/2 m Omega^2 q^2"),
        "q": ("q'' = 2/3 (Omega^2 q - g sin Omega t)", "q'' = 2/3 (Omega^2 q - g cos Omega t)"),
        "q_ddot": ("-0.603 m/s^2", "0.603 m/s^2")},
    4: {"T": ("3/2 m x'^2 + m l x' theta' cos theta + 1/2 m l^2 theta'^2", "m x'^2 + m l x' theta' cos theta + 1/2 m l^2 theta'^2"),
        "V": ("1/2 k x^2 - m g l cos theta", "1/2 k x^2 + m g l sin theta"),
        "x": ("3 m x'' + m l theta'' cos theta - m l theta'^2 sin theta + k x = 0", "3 m x'' + m l theta'' cos theta + m l theta'^2 sin theta + k x = 0"),
        "theta": ("l theta'' + x'' cos theta + g sin theta = 0", "l theta'' + g sin theta = 0"),
        "lambda": ("1/2, 2", "1, 2"), "shape_1": ("(1, 1)", "(1, -2)"), "shape_2": ("(-1/2, 1)", "(1, 2)"),
        "omega": ("3.502 rad/s, 7.004 rad/s", "3.502, 6")},
    5: {"T": ("1/2 m l^2 (4/3 theta'^2 + phi'^2 + 2 theta' phi' cos(theta - phi))", "1/2 m l^2 (4/3 theta'^2 + phi'^2)"),
        "V": ("-m g l (3/2 cos theta + cos phi)", "-m g l (cos theta + cos phi)"),
        "equations": ("4/3 theta'' + cos(theta-phi) phi'' + phi'^2 sin(theta-phi) + 3g/(2l) sin theta = 0\n"
                      "phi'' + cos(theta-phi) theta'' - theta'^2 sin(theta-phi) + g/l sin phi = 0",
                      "4/3 theta'' + cos(theta-phi) phi'' + phi'^2 sin(theta-phi) + 3g/(2l) sin theta = 0\n"
                      "phi'' + cos(theta-phi) theta'' + theta'^2 sin(theta-phi) + g/l sin phi = 0"),
        "lambda": ("(17-sqrt(217))/4, (17+sqrt(217))/4", "0.6, 8.5"),
        "spring": ("1/6 m l^2 theta'^2 + m/2 (l^2 theta'^2 + r'^2 + r^2 phi'^2 + 2 l theta' (r phi' cos(theta-phi) + r' sin(phi-theta)))",
                   "1/6 m l^2 theta'^2 + m/2 (l^2 theta'^2 + r'^2 + r^2 phi'^2 + 2 l theta' (r phi' cos(theta-phi) - r' sin(phi-theta)))"),
        "omega": ("3.336, 12.476", "3.336, 8.8")},
    6: {"T": ("1/2 m l^2 theta'^2 + m R Omega l theta' cos theta + 1/2 m Omega^2 (R^2 + l^2 sin^2 theta)", "1/2 m l^2 theta'^2"),
        "theta": ("theta'' = sin theta (Omega^2 cos theta - g/l)", "theta'' = -g/l sin theta"), "Omega_c": ("sqrt(g/l)", "sqrt(l/g)"), "rate": ("4.43 rad/s", "1.42")},
    7: {"T": ("1/2 m l^2 phi'^2 + m omega0 phi' (r l cos phi + l^2) + m omega0^2 (r l cos phi + 1/2 (r^2 + l^2))", "1/2 m l^2 (phi' + omega0)^2"),
        "phi": (r"\ddot\phi + \frac{r}{l}\omega_0^2\sin\phi = 0", r"\ddot\phi + \frac{l}{r}\omega_0^2\sin\phi = 0"),
        "h": ("1/2 m l^2 phi'^2 - 1/2 m omega0^2 (2 r l cos phi + r^2 + l^2)", "1/2 m l^2 phi'^2 + 1/2 m omega0^2 (2 r l cos phi + r^2 + l^2)"),
        "phi_max": ("60deg", "90deg")},
    8: {"T": ("1/2 m l^2 (theta'^2 + (1/2 + sin theta)^2 psi'^2)", "1/2 m l^2 (theta'^2 + sin^2 theta psi'^2)"),
        "beta": ("m l^2 (1/2 + sin theta)^2 psi'", "m l^2 (1/2 + sin theta) psi'"),
        "equations": ("theta'' = psi'^2 (1/2 + sin theta) cos theta - g/l sin theta; (1/2 + sin theta) psi'' = -2 psi' theta' cos theta",
                      "theta'' = psi'^2 sin theta cos theta - g/l sin theta; (1/2 + sin theta) psi'' = -2 psi' theta' cos theta"),
        "theta_max": ("0.9622", "0.9522"), "energy": ("yes", "no")},
    9: {"L": ("1/2 (M + 4 m sin(phi/2)^2) l^2 theta'^2 - 2 m l^2 sin(phi/2)^2 theta' phi' + 1/2 m l^2 phi'^2 - M g l cos(theta-gamma)"
              " - 2 m g l sin(phi/2) sin(phi/2 - theta + gamma)",
              "1/2 (M + 4 m sin(phi/2)^2) l^2 theta'^2 - 2 m l^2 sin(phi/2)^2 theta' phi' + 1/2 m l^2 phi'^2 - M g l cos(theta-gamma)"
              " - 2 m g l sin(phi/2)^2 sin(phi/2 - theta + gamma)"),
        "p_theta": ("l^2 ((M + 2 m (1 - cos phi)) theta' - m (1 - cos phi) phi')", "l^2 (M + 2 m (1 - cos phi)) theta'"),
        "p_phi": ("m l^2 (phi' - (1 - cos phi) theta')", "m l^2 phi'"),
        "step_time": ("0.9885 s, 1.2396 s", "3.096, 3.812"), "stable": ("yes", "no")},
    10: {"T": ("1/2 m l^2 (55/3 theta'^2 + Omega^2 (18 sin^2 theta + 1/3 cos^2 theta - 3 sin theta cos theta))",
               "1/2 m l^2 (55/3 theta'^2 + Omega^2 (18 sin^2 theta + 1/3 cos^2 theta + 3 sin theta cos theta))"),
         "V": ("-1/2 m g l (15 cos theta + sin theta)", "-15/2 m g l cos theta"),
         "theta": ("55/3 theta'' - 53/3 Omega^2 sin theta cos theta - 3/2 Omega^2 (sin^2 theta - cos^2 theta) = -g/(2l) (15 sin theta - cos theta)",
                   "55/3 theta'' - 35/3 Omega^2 sin theta cos theta - 3/2 Omega^2 (sin^2 theta - cos^2 theta) = -g/(2l) (15 sin theta - cos theta)"),
         "Omega": ("4.856 rad/s", "4.8 rad/s")},
}


def graded(number, which, *arguments):
    """What `qdot check` says of the right (0) or of the wrong (1) answers to a problem."""
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump({item: pair[which] for item, pair in ANSWERS[number].items()}, file)
        file.flush()
        return qdot("check", "--key", str(KEYS / f"problem_{number}.json"), "--answers", file.name, *arguments)


class Keys(unittest.TestCase):
    def test_every_item_has_answers_here(self):
        for number, answers in ANSWERS.items():
            key = json.loads((KEYS / f"problem_{number}.json").read_text())
            self.assertEqual([item["id"] for item in key["items"]], list(answers))
        self.assertEqual(len(list(KEYS.glob("*.json"))), 10)

    def test_right_answers(self):
        for number in ANSWERS:
            run = graded(number, 0, "--strict")
            with self.subTest(problem=number):
                self.assertEqual(run.stderr, b"")
                wrong = [item for item in json.loads(run.stdout)["items"] if item["correct"] is not True]
                self.assertEqual((wrong, run.returncode), ([], 0))

    def test_wrong_answers(self):
        for number in ANSWERS:
            run = graded(number, 1)
            with self.subTest(problem=number):
                self.assertEqual(run.returncode, 0)
                right = [item for item in json.loads(run.stdout)["items"] if item["correct"] is not False]
                self.assertEqual(right, [])
            self.assertEqual(graded(number, 1, "--strict").returncode, 1)

    def test_answers_may_be_csv(self):
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
            file.write('id,submitted\nphi_max,60deg\nphi,"\\ddot\\phi + \\frac{r}{l}\\omega_0^2\\sin\\phi = 0"\n')
            file.flush()
            run = qdot("check", "--key", str(KEYS / "problem_7.json"), "--answers", file.name)
        verdicts = {item["id"]: item["correct"] for item in json.loads(run.stdout)["items"]}
        self.assertEqual(verdicts, {"T": None, "phi": True, "h": None, "phi_max": True})

    def test_an_answer_that_is_too_long_leaves_the_others_graded(self):
        rows = "t,l\n" + "0.12345678901,0.5512345678901\n" * 1_000_000
        for name, content in (("json", json.dumps({"phi": rows, "phi_max": "60deg"})), ("csv", f'id,submitted\nphi,"{rows}"\nphi_max,60deg\n'),
                              ("csv", f'\ufeffid,submitted\nphi,"{rows}"\nphi_max,60deg\n')):
            with self.subTest(name=name), tempfile.NamedTemporaryFile("w", suffix="." + name) as file:
                file.write(content)
                file.flush()
                run = qdot("check", "--key", str(KEYS / "problem_7.json"), "--answers", file.name)
                items = {item["id"]: item for item in json.loads(run.stdout)["items"]}
                self.assertEqual(items["phi"]["format_errors"], [f"It is too long, of {len(rows)} bytes."])
                self.assertIs(items["phi_max"]["correct"], True)

    def test_files_that_do_not_go_together(self):
        key = str(KEYS / "problem_7.json")
        for content in ("phi_max\n60deg\n", '{"none_such": 1}', "{", '{"a": 1, "a": 2}', "id,submitted\nphi_max,1,2\n"):
            with self.subTest(answers=content), tempfile.NamedTemporaryFile("w") as file:
                file.write(content)
                file.flush()
                run = qdot("check", "--key", key, "--answers", file.name)
                self.assertEqual((run.returncode, run.stdout), (2, b""))
        self.assertEqual(qdot("check", "--key", key).returncode, 2)
        self.assertEqual(qdot("check", "x=1").returncode, 2)


class Formats(unittest.TestCase):
    """Each grader's file has what that grader's documents ask for."""

    def test_gradescope(self):
        answer = json.loads(graded(7, 1, "--format", "gradescope").stdout)
        for test in answer["tests"]:
            self.assertLessEqual({"name", "number", "score", "max_score", "output", "visibility"}, set(test))
            self.assertEqual(test["score"], 0)
        self.assertEqual(graded(7, 0, "--format", "gradescope", "--strict").returncode, 0)

    def test_prairielearn(self):
        answer = json.loads(graded(7, 0, "--format", "prairielearn").stdout)
        self.assertEqual((answer["gradable"], answer["score"]), (True, 1))
        self.assertTrue(all(test["points"] == test["max_points"] for test in answer["tests"]))
        self.assertEqual(graded(7, 1, "--format", "prairielearn", "--strict").returncode, 1)

    def test_coderunner(self):
        answer = json.loads(graded(7, 1, "--format", "coderunner").stdout)
        self.assertEqual(answer["fraction"], 0)
        self.assertEqual(answer["testresults"][0][0], "iscorrect")
        self.assertEqual(len(answer["testresults"]), 5)


if __name__ == "__main__":
    unittest.main()
