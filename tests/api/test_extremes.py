"""At the edge of what can be asked: finite numbers or a problem that says where, never a failure or a hang; and
every field of a simulation does what the contract says."""

import concurrent.futures
import csv
import io
import json
import math
import pathlib
import sys
import tempfile
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service, numbers_in, strict_json, textbook_scene  # noqa: E402

ALL = ["energy", "momenta", "positions", "accelerations", "validity"]
ENOUGH = 1e-8  # of one run at the default tolerances, 1e-9 and 1e-12, against a tighter one


def simulation(system="spring_pendulum", **fields):
    return {"system": system, "t_end": 1, "samples": 3} | fields


def forced(text):
    return simulation("forced_spring_pendulum", inputs={"F": text})


def body_with(member):
    return '{"system": "spring_pendulum", "t_end": 1, ' + member + "}"


class Extremes(Service):
    def assert_well_behaved(self, endpoint, request):
        """Finite numbers or a problem that says where; the status."""
        response = self.post(endpoint, request)
        answer = strict_json(response.data)
        self.assertTrue(all(math.isfinite(number) for number in numbers_in(answer)))
        self.assertIn(response.status, (200, 400, 422), response.data[:300])
        if response.status != 200:
            self.assertEqual(response.getheader("Content-Type"), "application/problem+json")
            self.assertEqual(answer["status"], response.status)
            self.assertTrue(answer["detail"])
            for error in answer.get("errors", []):
                self.assertTrue(error["pointer"].startswith("#"), error)
                self.assertTrue(error["detail"], error)
        return response.status

    def test_values_far_from_any_experiment_give_finite_numbers_or_a_problem(self):
        systems = {"spring_pendulum": ["m", "k", "l0", "g", "l", "theta", "l_dot", "theta_dot"],
                   "rolling_disk_platform": ["m", "r", "Omega", "g", "q", "q_dot"],
                   "cart_pendulum": ["M", "m", "k", "l", "x", "theta_dot"],
                   "whirling_pendulum": ["R", "l", "theta_dot"],
                   "orbiting_pendulum": ["r", "omega0"], "free_spin_pendulum": ["theta", "psi_dot"],
                   "compass_walker": ["M", "m", "gamma", "phi"], "rotating_l_bar": ["Omega", "theta"]}
        statuses = set()
        for system, names in systems.items():
            for name in names:
                state = name not in ("m", "M", "k", "l0", "g", "r", "R", "Omega", "omega0", "gamma") and not (
                    name == "l" and system != "spring_pendulum")
                for number in (0, -1, 1e-300, 1e-12, -1e300, 1e300):
                    with self.subTest(system, name=name, number=number):
                        fields = {"initial" if state else "parameters": {name: number}}
                        statuses.add(self.assert_well_behaved("energy", {"system": system} | fields))
                        request = simulation(system, t_end=1e-3, on_invalid="continue", include=ALL) | fields
                        statuses.add(self.assert_well_behaved("simulate", request))
        self.assertEqual(statuses, {200, 422})

    def test_a_mass_must_be_positive_and_a_tiny_foot_is_as_none(self):
        self.refused_at("simulate", simulation(parameters={"m": 0}), "#/parameters/m")
        self.refused_at("simulate", simulation(parameters={"m": -1, "k": -1}), "#/parameters/m", "#/parameters/k")
        self.refused_at("simulate", simulation(initial={"l": 0}), "#/initial/l")
        walks = [self.ask("simulate", simulation("compass_walker", parameters={"m": m}, t_end=3))["trajectory"]
                 for m in (0, 1e-300, 1e-12)]
        self.assertEqual(walks[0], walks[1])
        for name, column in walks[2].items():
            for number, expected in zip(column, walks[0][name]):
                self.assertLess(abs(number - expected), ENOUGH)

    def test_a_heavy_bob_falls_freely(self):
        found = self.ask("simulate", simulation(parameters={"m": 1e300}, initial={"theta": 0, "l": 1}, include=ALL))
        self.assertLess(abs(found["trajectory"]["l"][-1] - (1 + 9.81/2)), ENOUGH)

    def test_a_spring_that_swings_through_its_pivot_stops_where_its_angle_is_undefined(self):
        fall = {"parameters": {"k": 1}, "initial": {"l": 0.3, "theta": 0, "l_dot": -20}}
        found = self.ask("simulate", simulation(**fall))
        self.assertEqual((found["status"], found["stop"]["reason"]), ("stopped", "coordinate_singularity"))
        self.assertEqual(found["trajectory"]["t"], [0])
        onward = self.ask("simulate", simulation(**fall, on_invalid="continue"))
        self.assertEqual(onward["status"], "stopped")  # no answer exists beyond
        near = self.ask("simulate", simulation(parameters={"k": 1}, initial={"l": 0.3, "theta": 0.1, "l_dot": -20}))
        self.assertEqual(near["status"], "complete")

    def test_a_stiff_spring_that_rests_where_it_hangs_is_a_pendulum(self):
        k = 1e9
        length = 0.37 + 0.5*9.81/k
        found = self.ask("simulate", simulation(parameters={"k": k}, initial={"l": length, "theta": 0}, method="bdf"))
        self.assertLess(abs(found["trajectory"]["l"][-1] - length), 1e-9)
        self.assertLess(abs(found["trajectory"]["theta"][-1]), 1e-9)

    def test_a_platform_at_rest_and_one_that_whirls(self):
        rest = self.ask("simulate", simulation("rolling_disk_platform", parameters={"Omega": 0}))
        self.assertLess(abs(rest["trajectory"]["q"][-1] - 1), ENOUGH)
        fast = simulation("rolling_disk_platform", parameters={"Omega": 1e6})
        self.assertEqual(self.ask("simulate", fast)["stop"]["reason"], "lift_off")
        problem = self.refused("simulate", fast | {"on_invalid": "continue"})
        self.assertEqual(problem["reason"], "blow-up")
        self.assertLess(problem["t_reached"], 1e-3)
        self.assertEqual(set(problem["last_state"]), {"q", "q_dot"})

    def test_work_without_end_is_given_up(self):
        for request in (simulation("whirling_pendulum", parameters={"Omega": 1e6}), simulation(t_end=1e9)):
            with self.subTest(request["system"]):
                problem = self.refused("simulate", request)
                self.assertEqual(problem["type"], "/errors/integration-failed")
                self.assertEqual(problem["reason"], "step-limit")
                self.assertGreater(problem["t_reached"], 0)

    def test_fields_out_of_range_are_refused_where_they_stand(self):
        for name, numbers in {"t_end": (0, -1, 1e300, "x", None, True, [1]), "samples": (0, 1, -3, 2.5, 1000000, "3"),
                              "rtol": (0, 1e-300, 1e10, -1), "atol": (0, -1, 2), "digits": (0, 18, 3.5),
                              "method": ("magic", 3), "on_invalid": ("perhaps",), "verify": ("no", 1),
                              "impacts": (1, "no"), "nonsense": (1,), "initial": (1, [])}.items():
            for number in numbers:
                with self.subTest(name, value=number):
                    self.refused_at("simulate", simulation() | {name: number}, f"#/{name}")
        self.refused_at("simulate", simulation(include=["energy", "nope"]), "#/include/1")
        self.assertEqual(self.assert_well_behaved("simulate", simulation(t_end=1e-300)), 422)
        self.assertEqual(self.assert_well_behaved("simulate", simulation(rtol=1e-14, atol=1e-14)), 200)
        self.assertEqual(self.assert_well_behaved("simulate", simulation(atol=1e-300)), 200)

    def test_as_many_rows_as_the_limit_says(self):
        limits = strict_json(self.raw("GET", "/v1/limits").data)
        self.assertEqual((limits["rows"], limits["numbers"]), (100000, 1000000))
        found = self.ask("simulate", simulation(samples=100000))
        self.assertEqual(len(found["trajectory"]["t"]), 100000)
        self.refused_at("simulate", simulation(samples=100000, include=ALL), "#/include")  # 14 columns

    def test_numbers_that_are_none_in_json(self):
        for text in ("NaN", "Infinity", "-Infinity", "1e999", "-1e999", "1" + "0"*400, "01", "0x10", "1.", "+1"):
            with self.subTest(text):
                self.refused("simulate", body_with(f'"initial": {{"theta": {text}}}'), 400)
        found = self.ask("simulate", body_with('"initial": {"theta": 0.' + "1"*900 + "}"))
        self.assertEqual(found["request"]["initial"]["theta"], 1/9)
        self.refused("simulate", body_with('"initial": {"theta": 0.' + "1"*5000 + "}"), 422)
        self.refused("energy", '{"system": "spring_pendulum", "t": 1e-999}', 400)  # neither 0 nor a double

    def test_units_of_another_dimension(self):
        self.refused_at("simulate", simulation(initial={"l": "30deg", "theta": "30cm", "theta_dot": "1 rad"},
                                               parameters={"m": "3s", "k": "40 bananas"}),
                        "#/initial/l", "#/initial/theta", "#/initial/theta_dot", "#/parameters/m", "#/parameters/k")
        found = self.ask("energy", {"system": "spring_pendulum", "initial": {"l": "50 cm", "theta": "30deg"}})
        self.assertEqual(found["request"]["initial"]["l"], 0.5)
        self.assertEqual(found["request"]["initial"]["theta"], 0.5235987755982989)  # next to pi/6 = ...829887...
        found = self.ask("energy", {"system": "whirling_pendulum", "parameters": {"Omega": "2 rev/s"}})
        self.assertEqual(found["request"]["parameters"]["Omega"], 4*math.pi)

    def test_bodies_that_are_no_request(self):
        for body, status in (("", 400), ("{", 400), ("nonsense", 400), (b"\xff\xfe", 400), ("[]", 422), ("null", 422),
                             ('"x"', 422), ("{}", 422), ("["*100000, 413), ("["*1000, 422), ('{"a":'*1000, 422),
                             ("["*100 + "]"*100, 422), ('{"system":"spring_pendulum","t_end":1}{}', 400)):
            with self.subTest(body[:20]):
                self.assertEqual(self.refused("simulate", body, status)["status"], status)

    def test_members_that_stand_twice(self):
        self.refused_at("simulate", body_with('"t_end": 2'), "#/t_end")
        self.refused_at("simulate", body_with('"parameters": {"m": 1, "m": 1}'), "#/parameters/m")

    def test_systems_that_do_not_exist(self):
        problem = self.refused_at("simulate", simulation("spring_pendlum"), "#/system")
        self.assertEqual(problem["errors"][0]["did_you_mean"], "spring_pendulum")
        for system in (5, None, [], "", "../scenes/schema", "x"*1000):
            with self.subTest(system):
                self.refused_at("simulate", simulation(system), "#/system")

    def test_an_inline_scene_that_is_wrong_in_five_places_is_told_all_five(self):
        scene = textbook_scene("plane_pendulum")
        scene["points"][1]["components"][0] = "l*sin(theta) + m"
        scene["gravity"][1] = "-gg"
        scene["springs"] = [{"name": "spring", "stiffness": "m", "length": "l"}]
        scene["potential"] = "m*l"
        scene["valid_while"] = [{"name": "v", "unit": "N", "expression": "m*", "reason": "slack", "message": "M."}]
        self.refused_at("simulate", simulation(scene), "#/system/points/1/components/0", "#/system/gravity/1",
                        "#/system/springs/0/stiffness", "#/system/potential", "#/system/valid_while/0/expression")

    def test_inputs_that_cannot_be_read(self):
        for text in ("0.8*cos(4*t", "q*t", "1/0", "theta", "", "9^9^9^9", "10^400", "sin", "t t", "F", "t;t", "\u03c9*t",
                     "("*1000 + "t" + ")"*1000, "+".join(["sin(t)"]*5000), "+".join(f"sin({i}*t)" for i in range(300))):
            with self.subTest(text[:20]):
                self.refused_at("simulate", forced(text), "#/inputs/F")
        self.refused_at("simulate", simulation(inputs={"F": "1"}), "#/inputs/F")

    def test_inputs_that_become_infinite(self):
        for text, reason in (("1/t", "nonfinite"), ("sqrt(-1 - t)", "nonfinite"), ("log(t)", "nonfinite"),
                             ("exp(exp(exp(10*t)))", "blow-up")):
            with self.subTest(text):
                self.assertEqual(self.refused("simulate", forced(text))["reason"], reason)

    def test_events_that_cannot_be_read(self):
        for text in ("theta==", "zzz=1", "theta=0*", "", "theta", "theta=1/0", "theta=30deg", 5, None, "=0", "theta=0+-"):
            with self.subTest(text):
                self.refused_at("simulate", simulation(events=["l=1", text]), "#/events/1")
        self.refused_at("simulate", simulation(events=["theta=0"]*21), "#/events")
        self.refused_at("simulate", simulation(events="theta=0"), "#/events")


class Fields(Service):
    def test_grids_are_exactly_the_instants_asked_for(self):
        for fields, instants in (({"samples": 5}, [0, 0.25, 0.5, 0.75, 1]), ({"dt": 0.1}, [i/10 for i in range(11)]),
                                 ({"times": [0, 0.3, 1/3, 1]}, [0, 0.3, 1/3, 1]), ({"times": [0.7]}, [0.7]),
                                 ({"t_start": 0.5, "samples": 3}, [0.5, 0.75, 1])):
            with self.subTest(fields):
                found = self.ask("simulate", {"system": "spring_pendulum", "t_end": 1} | fields)
                self.assertEqual(found["trajectory"]["t"], instants)
                self.assertEqual(found["t_reached"], 1)
        self.assertEqual(len(self.ask("simulate", {"system": "spring_pendulum", "t_end": 1})["trajectory"]["t"]), 101)
        late = self.ask("simulate", {"system": "spring_pendulum", "times": [0.1, 0.7]})
        self.assertEqual((late["t_reached"], late["request"]["t_end"]), (0.7, 0.7))

    def test_grids_that_contradict_themselves(self):
        for fields, place in (({"dt": 0.3}, "dt"), ({"dt": 0}, "dt"), ({"dt": -1}, "dt"), ({"dt": 1e-9}, "dt"),
                              ({"dt": 1e-300}, "dt"), ({"times": [0.3, 0.1]}, "times"), ({"times": [0.1, 0.1]}, "times"),
                              ({"times": [2]}, "times"), ({"times": [-1]}, "times"), ({"t_start": 2}, "t_end"),
                              ({"samples": 3, "dt": 0.5}, "dt")):
            with self.subTest(fields):
                self.refused_at("simulate", {"system": "spring_pendulum", "t_end": 1} | fields, f"#/{place}")
        self.refused_at("simulate", {"system": "spring_pendulum"}, "#/t_end")
        self.refused_at("simulate", {"system": "spring_pendulum", "times": []}, "#/times")

    def test_an_empty_list_of_instants_is_refused(self):
        self.refused_at("simulate", {"system": "spring_pendulum", "t_end": 1, "times": []}, "#/times")

    def test_the_end_of_time_and_events_are_told_with_the_other_mistakes(self):
        self.refused_at("simulate", {"system": "spring_pendulum", "t_end": -1, "digits": 99, "events": ["zz=0"]},
                        "#/t_end", "#/digits", "#/events/0")

    def test_an_input_that_cannot_be_read_is_told_with_the_other_mistakes(self):
        self.refused_at("simulate",
                        {"system": "forced_spring_pendulum", "t_end": 1, "digits": 99, "inputs": {"F": "q"}},
                        "#/inputs/F", "#/digits")

    def test_an_unknown_unit_has_no_mistakes_in_its_train(self):
        scene = textbook_scene("plane_pendulum")
        scene["parameters"][0]["unit"] = "kgg"
        self.refused_at("simulate", {"system": scene, "t_end": 1}, "#/system/parameters/0/unit")

    def test_watching_a_domain_costs_less_than_the_steps(self):
        found = self.ask("simulate", {"system": "spring_pendulum", "t_end": 1, "samples": 3})["diagnostics"]
        self.assertLess(found["rhs_evaluations"], 25 * found["steps"])

    def test_rows_come_one_by_one_as_ndjson(self):
        columns = self.ask("simulate", {"system": "spring_pendulum", "t_end": 1, "samples": 3})["trajectory"]
        response = self.raw("POST", "/v1/simulate", '{"system":"spring_pendulum","t_end":1,"samples":3}',
                            {"Accept": "application/x-ndjson"})
        rows = [json.loads(line) for line in response.data.splitlines()]
        self.assertEqual({name: [row[name] for row in rows] for name in columns}, columns)

    def test_every_column_asked_for_has_a_unit_and_a_number_in_every_row(self):
        for system, columns in (
                ("spring_pendulum", "t l theta l_dot theta_dot energy p_l p_theta pivot_x pivot_y bob_x bob_y l_ddot theta_ddot"),
                ("rod_pendulum", None), ("compass_walker", None), ("rolling_disk_platform", None)):
            with self.subTest(system):
                found = self.ask("simulate", simulation(system, samples=11, include=ALL, on_invalid="continue"))
                trajectory = found["trajectory"]
                self.assertEqual(set(trajectory), set(found["units"]))
                self.assertTrue(all(len(column) == 11 for column in trajectory.values()))
                if columns:
                    self.assertEqual(list(trajectory), columns.split())
                first = self.ask("energy", {"system": system})
                self.assertEqual(trajectory["energy"][0], first["E"])
                for name, number in first["accelerations"].items():
                    self.assertEqual(trajectory[name][0], number)
                for name, number in first.get("validity", {}).items():
                    self.assertEqual(trajectory[name][0], number)
                for name in trajectory:
                    if name.startswith("p_"):
                        self.assertEqual(trajectory[name][0], first[name])

    def test_positions_are_those_of_the_pendulum(self):
        rows = self.ask("simulate", simulation(include=["positions"]))["trajectory"]
        for l, theta, x, y in zip(rows["l"], rows["theta"], rows["bob_x"], rows["bob_y"]):
            self.assertLess(math.hypot(x - l*math.sin(theta), y + l*math.cos(theta)), 1e-15)

    def test_events_stand_apart_and_leave_the_rows_alone(self):
        plain = self.ask("simulate", simulation(t_end=5, samples=101))
        found = self.ask("simulate", simulation(t_end=5, samples=101, events=["theta=0+", "theta=0-", "l=0.5"]))
        self.assertEqual(json.dumps(plain["trajectory"]), json.dumps(found["trajectory"]))
        self.assertEqual(plain["events"], [])
        instants = [event["t"] for event in found["events"]]
        self.assertEqual(instants, sorted(instants))
        self.assertEqual({event["name"] for event in found["events"]}, {"theta=0+", "theta=0-", "l=0.5"})
        for event in found["events"]:
            state = event["state"]
            if event["name"] == "l=0.5":
                self.assertLess(abs(state["l"] - 0.5), 1e-10)
                continue
            self.assertLess(abs(state["theta"]), 1e-10)
            self.assertEqual(state["theta_dot"] > 0, event["name"] == "theta=0+")
        crossings = sum(a*b < 0 for a, b in zip(plain["trajectory"]["theta"], plain["trajectory"]["theta"][1:]))
        self.assertEqual(crossings, sum(event["name"] != "l=0.5" for event in found["events"]))

    def test_digits_round_every_number_of_the_trajectory(self):
        full = self.ask("simulate", simulation(samples=11, include=ALL))["trajectory"]
        for digits in (1, 3, 10, 17):
            rounded = self.ask("simulate", simulation(samples=11, include=ALL, digits=digits))["trajectory"]
            for name, column in full.items():
                self.assertEqual(rounded[name], [float(f"{number:.{digits}g}") for number in column], name)

    def test_csv_has_the_columns_of_the_json(self):
        request = simulation(samples=11, include=ALL)
        columns = self.ask("simulate", request)["trajectory"]
        for body, headers in ((request | {"format": "csv"}, {}), (request, {"Accept": "text/csv"})):
            response = self.raw("POST", "/v1/simulate", json.dumps(body), headers)
            self.assertEqual((response.status, response.getheader("Content-Type").split(";")[0]), (200, "text/csv"))
            rows = list(csv.reader(io.StringIO(response.data.decode())))
            self.assertEqual(rows[0], list(columns))
            self.assertEqual([[float(cell) for cell in row] for row in rows[1:]],
                             [list(row) for row in zip(*columns.values())])

    def test_the_same_request_has_the_same_bytes_from_any_thread(self):
        requests = [("simulate", simulation(samples=101, include=ALL, events=["theta=0"])),
                    ("simulate", simulation("compass_walker", t_end=5)), ("energy", {"system": "rod_pendulum"}),
                    ("equations", {"system": textbook_scene("triple_pendulum")})]*4
        alone = [self.post(*request).data for request in requests]
        with concurrent.futures.ThreadPoolExecutor(8) as pool:
            together = list(pool.map(lambda request: self.post_until_there_is_room(*request).data, requests))
        self.assertEqual(alone, together)
        self.assertEqual(len(set(alone)), 4)

    def test_the_resolved_request_asks_for_the_same_answer(self):
        first = self.ask("simulate", simulation("cart_pendulum", initial={"theta": "30deg"}))
        self.assertEqual(self.ask("simulate", first["request"]), first)

    def test_content_types(self):
        body = json.dumps({"system": "spring_pendulum"})
        for headers, status in (({}, 200), ({"Content-Type": "application/x-www-form-urlencoded"}, 200),
                                ({"Content-Type": "application/json; charset=utf-8"}, 200),
                                ({"Content-Type": "text/plain"}, 415), ({"Content-Type": "multipart/form-data"}, 415)):
            with self.subTest(headers):
                response = self.raw("POST", "/v1/energy", body, headers)
                self.assertEqual(response.status, status)
                strict_json(response.data)


class OwnScenes(Service):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory()
        scene = textbook_scene("driven_pivot") | {"name": "shaken_pendulum", "problem": "11"}
        pathlib.Path(cls.directory.name, "shaken_pendulum.json").write_text(json.dumps(scene), encoding="utf-8")
        cls.arguments = ("--threads", "2", "--scenes", cls.directory.name)
        super().setUpClass()

    @classmethod
    def tearDownClass(cls):
        super().tearDownClass()
        cls.directory.cleanup()

    def test_a_scene_from_a_directory_is_a_system_like_the_others(self):
        systems = strict_json(self.raw("GET", "/v1/systems").data)["systems"]
        self.assertEqual([entry["name"] for entry in systems if entry["problem"] == "11"], ["shaken_pendulum"])
        self.assertEqual(len(systems), 12)
        self.assertEqual(self.raw("GET", "/v1/systems/shaken_pendulum").status, 200)
        named = self.ask("simulate", simulation("shaken_pendulum", include=ALL))
        inline = self.ask("simulate", simulation(textbook_scene("driven_pivot"), include=ALL))
        self.assertEqual(named["trajectory"], inline["trajectory"])
        self.assertEqual(self.ask("equations", {"system": "shaken_pendulum"})["accelerations"],
                         {"theta_ddot": "(a*w^2*cos(w*t) - g)*sin(theta)/l"})


if __name__ == "__main__":
    unittest.main()
