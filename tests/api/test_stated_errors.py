"""Every answer that states an error: what 'digits' rounds away is in it, and the error is rounded up."""

import json
import pathlib
import sys
import unittest
from fractions import Fraction

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, textbook_scene  # noqa: E402

ALL_DIGITS = 17
COLUMNS = ["energy", "momenta", "positions", "accelerations", "validity", "T", "V"]
SOME_DIGITS = (1, 2, 3, 5, 8, 12, 14, 15, 16)


def state_pairs(state, errors):
    return [(state[name], errors[name]) for name in errors]


def pairs_of_energy(answer):
    values = {**answer, **answer["accelerations"], **answer.get("validity", {}), **answer.get("reports", {})}
    yield from ((values[name], error) for name, error in answer["error"].items())
    yield from ((kept["value"], kept["error"]) for kept in answer["conserved"])


def pairs_of_turning_points(answer):
    values = {**answer, **answer["constants"]}
    return [(values[name], error) for name, error in answer["error"].items()]


def pairs_of_modes(answer):
    yield from state_pairs(answer["equilibrium"]["state"], answer["equilibrium"]["error"])
    for mode in answer["modes"]:
        grows = mode["kind"] in ("growth", "decay") and mode["omega"] == 0
        yield mode["rate" if grows else "omega"], mode["error"]
        for name in ("f", "period", "rate"):
            if name + "_error" in mode:
                yield mode[name], mode[name + "_error"]
        if all(isinstance(component, (int, float)) for component in mode["shape"].values()):
            yield from state_pairs(mode["shape"], mode.get("shape_error", {}))


def pairs_of_equilibria(answer):
    for found in answer["equilibria"]:
        yield from state_pairs(found["state"], found["error"])
        if "rate2" in found:
            yield found["rate2"], found["rate2_error"]


def pairs_of_bifurcations(answer):
    for critical in answer["critical"]:
        yield critical["value"], critical["error"]
        yield from state_pairs(critical["state"], critical["state_error"])


def pairs_of_gait(answer):
    for gait in answer["gaits"]:
        for name in ("state", "pre_impact"):
            yield from state_pairs(gait[name], gait["error"][name])
        for name in ("step_time", "step_length"):
            yield gait[name], gait["error"][name]


class StatedErrors(Service):
    def check(self, endpoint, request, pairs_of):
        """The number with d digits is within its error of the true one, wherever that is within the error with all
        digits. Returns how many numbers were compared."""
        def ask(digits):
            return list(pairs_of(self.ask(endpoint, {**request, "digits": digits})))

        whole = ask(ALL_DIGITS)
        count = 0
        for digits in SOME_DIGITS:
            rounded = ask(digits)
            self.assertEqual(len(rounded), len(whole))
            for (value, error), (best, least) in zip(rounded, whole):
                if value is None or error is None:
                    continue
                needed = abs(Fraction(value) - Fraction(best)) + Fraction(least)*(1 - Fraction(1, 10**15))
                self.assertGreaterEqual(Fraction(error), needed, f"{endpoint} {request} digits {digits}: {value}")
                self.assertEqual(float(f"{error:.{digits - 1}e}"), error, "more digits than asked for")
                count += 1
        return count

    def extended_columns(self, request):
        """Of a motion in extended precision, with all digits."""
        answer = self.post("simulate", {**request, "precision": "extended"})
        self.assertEqual(answer.status, 200, answer.data)
        body = json.loads(answer.data, parse_float=Fraction)
        return body["trajectory"], body["accuracy"]["max_abs_error"]

    def first_row(self, request):
        columns, _ = self.extended_columns({**request, "t_end": 1e-9, "samples": 2})
        return {name: values[0] for name, values in columns.items()}

    def test_columns_along_a_motion(self):
        """Whatever is computed from a motion, against a run in extended precision; the errors are not far from what they
        are of."""
        for system in ("spring_pendulum", "cart_pendulum", "rod_spring_pendulum", "whirling_pendulum", "orbiting_pendulum",
                       textbook_scene("driven_pivot")):
            asked = {"system": system, "t_end": 2, "samples": 9, "include": COLUMNS}
            true, stated = self.extended_columns({**asked, "max_error": 1e-18})
            self.assertEqual(set(stated), set(true) - {"t"})
            for more in ({"accuracy": "fast"}, {"rtol": 1e-5, "method": "erk"}, {}, {"accuracy": "accurate"}, {"digits": 4}):
                answer = self.ask("simulate", {**asked, **more})
                errors = answer["accuracy"]["max_abs_error"]
                self.assertEqual(set(errors), set(answer["trajectory"]) - {"t"})
                for name, error in errors.items():
                    apart = max(abs(Fraction(a) - b) for a, b in zip(answer["trajectory"][name], true[name]))
                    size = max(abs(value) for value in true[name])
                    with self.subTest(system=answer["system"], name=name, **more):
                        self.assertLessEqual(apart, error)
                        self.assertLess(error, 5e3*apart + 1e-10*(1 + size))

    def test_columns_in_extended_precision(self):
        """Against a run to a hundred thousandth of the error."""
        for system in ("spring_pendulum", "rod_spring_pendulum", textbook_scene("driven_pivot")):
            asked = {"system": system, "t_end": 2, "samples": 9, "include": COLUMNS}
            true, _ = self.extended_columns({**asked, "max_error": 1e-23})
            for more in ({"max_error": 1e-16}, {"max_error": 1e-18, "digits": 12}):
                columns, errors = self.extended_columns({**asked, **more})
                for name, error in errors.items():
                    with self.subTest(system=system, name=name, **more):
                        self.assertLessEqual(max(abs(a - b) for a, b in zip(columns[name], true[name])), error)
                        self.assertLess(error, 1e-9)

    def test_values_at_a_state(self):
        """Against the first row of a motion in extended precision, which starts from the decimals as they are written."""
        count = 0
        for system in ("spring_pendulum", "cart_pendulum", "rod_spring_pendulum", "whirling_pendulum", "orbiting_pendulum",
                       "free_spin_pendulum", "rotating_l_bar"):
            for turn in range(8):
                coordinates = self.ask("energy", {"system": system})["request"]["initial"]
                asked = {"system": system, "initial": {name: (3 + turn*k)/7 + 1e-9*turn for k, name in enumerate(coordinates, 1)}}
                answer = self.ask("energy", asked)
                values = {**answer, **answer["accelerations"], **answer.get("validity", {})}
                row = self.first_row({**asked, "include": COLUMNS, "on_invalid": "continue"})
                for name, error in answer["error"].items():
                    if name in row:
                        apart = abs(Fraction(values[name]) - row[name])
                        with self.subTest(system=system, name=name, turn=turn):
                            self.assertLessEqual(apart, error)
                            self.assertLess(error, 1e-12*(1 + abs(values[name])))
                        count += 1
        self.assertGreater(count, 250)

    def test_accelerations_of_a_nearly_singular_mass_matrix(self):
        """A bob of 1e-9 kg on a heavy cart's string: the digits that the solution loses are in its error."""
        masses = {"system": "rod_spring_pendulum", "parameters": {"m": 1e-9}, "initial": {"r": 1e-7, "theta": 0.3, "phi": 1.1}}
        answer = self.ask("energy", masses)
        row = self.first_row({**masses, "include": ["accelerations"]})
        for name, value in answer["accelerations"].items():
            self.assertLessEqual(abs(Fraction(value) - row[name]), answer["error"][name])

    def test_energy(self):
        count = 0
        for system in ("spring_pendulum", "cart_pendulum", "rod_pendulum", "whirling_pendulum", "orbiting_pendulum",
                       textbook_scene("kepler"), textbook_scene("driven_pivot")):
            count += self.check("energy", {"system": system}, pairs_of_energy)
        self.assertGreater(count, 600)

    def test_an_error_that_is_wanted_is_that_of_coordinates_and_velocities(self):
        stiff = {"system": "cart_pendulum", "parameters": {"k": 1e7}, "initial": {"x": 1e-3}, "t_end": 0.01, "include": ["T", "V"], "max_error": 1e-6}
        accuracy = self.ask("simulate", stiff)["accuracy"]
        self.assertTrue(accuracy["meets_request"])
        self.assertEqual(list(accuracy["max_abs_error"]), ["x", "theta", "x_dot", "theta_dot", "T", "V"])

    def test_energies_that_have_no_column(self):
        answer = self.post("simulate", {"system": textbook_scene("foucault"), "t_end": 1, "include": ["V"]})
        error, = json.loads(answer.data)["errors"]
        self.assertEqual((answer.status, error["pointer"], error["code"]), (422, "#/include", "not_applicable"))
        self.assertTrue(error["detail"].startswith("A Lagrangian alone"))

    def test_turning_points(self):
        count = 0
        for request in ({"system": "free_spin_pendulum"}, {"system": "orbiting_pendulum"},
                        {"system": "whirling_pendulum", "initial": {"theta": 0.7, "theta_dot": 0.3}},
                        {"system": "rotating_l_bar", "initial": {"theta": 0.2, "theta_dot": 0.1}},
                        {"system": textbook_scene("plane_pendulum"), "initial": {"theta": 1, "theta_dot": -0.7}},
                        {"system": textbook_scene("kepler")},
                        {"system": textbook_scene("bead_on_hoop"), "initial": {"theta": 0.4}}):
            count += self.check("turning_points", request, pairs_of_turning_points)
        self.assertGreater(count, 300)

    def test_modes(self):
        count = 0
        for system in ("cart_pendulum", "rod_pendulum", "spring_pendulum", "whirling_pendulum", "rotating_l_bar",
                       textbook_scene("damped_oscillator"), textbook_scene("plane_pendulum")):
            count += self.check("modes", {"system": system}, pairs_of_modes)
        self.assertGreater(count, 300)

    def test_equilibria(self):
        count = 0
        for request in ({"system": "whirling_pendulum", "parameters": {"Omega": 7}}, {"system": "rotating_l_bar"},
                        {"system": "cart_pendulum"}, {"system": textbook_scene("bead_on_hoop")}):
            count += self.check("equilibria", request, pairs_of_equilibria)
        self.assertGreater(count, 100)

    def test_solving_for_a_parameter(self):
        request = {"system": "rotating_l_bar", "solve_for": "Omega", "at": {"theta": 0.3}}
        count = self.check("equilibria", request, lambda answer: [(answer["Omega"], answer["error"])])
        self.assertGreater(count, 5)

    def test_bifurcations(self):
        request = {"system": "whirling_pendulum", "parameter": "Omega", "from": 0, "to": 10}
        self.assertGreater(self.check("bifurcations", request, pairs_of_bifurcations), 20)

    def test_gaits(self):
        request = {"system": "compass_walker", "parameters": {"gamma": 0.009, "m": 0}}
        self.assertGreater(self.check("gait", request, pairs_of_gait), 100)


if __name__ == "__main__":
    unittest.main()
