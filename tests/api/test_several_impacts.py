"""Several impacts in one scene, impacts of one instant, and impacts under constraints."""

import math
import pathlib
import sys
import unittest

import mpmath as mp
import numpy

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from constrained_scenes import DOUBLE_PENDULUM, coordinates, parameters  # noqa: E402
from service import Service, strict_json  # noqa: E402

mp.mp.dps = 30


def bounces(*events, restitution="e"):
    return {"events": [{"name": name, "expression": distance, "direction": "falling"} for name, distance in events],
            "impacts": [{"event": name, "restitution": restitution} for name, _ in events]}


def balls(masses, places, speeds):
    """In a row, each as large as nothing; those at one place touch."""
    count = len(masses)
    return {
        "name": "balls",
        "parameters": parameters(**{f"m{i}": ("kg", str(m)) for i, m in enumerate(masses)}, e=("1", "1")),
        "coordinates": coordinates(**{f"x{i}": ("m", str(x), str(v)) for i, (x, v) in enumerate(zip(places, speeds))}),
        "bodies": [{"kind": "particle", "mass": f"m{i}", "position": [f"x{i}", 0]} for i in range(count)],
    } | bounces(*((f"hit{i}", f"x{i + 1} - x{i}") for i in range(count - 1)))


ROOM = {
    "name": "room",
    "parameters": parameters(m=("kg", "0.3"), e=("1", "1"), b=("m", "2"), g=("m/s^2", "0")),
    "coordinates": coordinates(x=("m", "0.5", "1"), y=("m", "0.5", "0.7")),
    "bodies": [{"kind": "particle", "mass": "m", "position": ["x", "y"]}],
    "gravity": [0, "-g"],
} | bounces(("left", "x"), ("right", "b - x"), ("floor", "y"), ("ceiling", "b - y"))


class SeveralImpacts(Service):
    def last(self, scene, t_end=1.0, **fields):
        answer = self.ask("simulate", {"system": scene, "t_end": t_end, "samples": 2, **fields})
        self.assertEqual(answer["status"], "complete", answer.get("stop"))
        return {name: values[-1] for name, values in answer["trajectory"].items()}, answer

    def test_a_ball_in_a_room_moves_as_its_images_do(self):
        answer = self.ask("simulate", {"system": ROOM, "t_end": 20, "samples": 41, "max_error": 1e-9})
        self.assertTrue(answer["accuracy"]["meets_request"])
        for i, t in enumerate(answer["trajectory"]["t"]):
            for name, start, speed in (("x", 0.5, 1), ("y", 0.5, 0.7)):
                image = (start + speed * t) % 4
                self.assertAlmostEqual(answer["trajectory"][name][i], min(image, 4 - image), 11)
        self.assertEqual({e["name"] for e in answer["events"]}, {"left", "right", "floor", "ceiling"})

    def test_both_walls_of_a_corner_count(self):
        at, answer = self.last(ROOM, initial={"x": 1, "y": 1, "x_dot": 1, "y_dot": 1}, t_end=1.5)
        self.assertEqual([e["name"] for e in answer["events"]], ["right", "ceiling"])
        self.assertEqual(len(answer["strides"]), 1)
        for name, value in (("x", 1.5), ("y", 1.5), ("x_dot", -1), ("y_dot", -1)):
            self.assertAlmostEqual(at[name], value, 12)

    def test_an_order_that_cannot_be_told_is_told_and_both_are_in_the_errors(self):
        """Two walls, one behind the other by less than rounding, and a corner that is met beside its edge."""
        for nearer in (1, -1):
            walls = [("near", "x + 0.5"), ("far", "x + 0.50000000000000000003" if nearer > 0 else "x + 0.49999999999999999997")]
            scene = {"name": "walls", "units": "none", "lagrangian": "x_dot^2/2",
                     "coordinates": [{"name": "x", "initial": "0.7", "initial_rate": "-1.3"}]} | bounces(*walls)
            scene["impacts"][0]["restitution"], scene["impacts"][1]["restitution"] = "0.2", "1"
            at, answer = self.last(scene, t_end=1.5)
            met = mp.mpf("1.2") / mp.mpf("1.3")
            speed = mp.mpf("1.3") * (mp.mpf("0.2") if nearer > 0 else 1)
            for name, true in (("x", -mp.mpf("0.5") + speed * (mp.mpf("1.5") - met)), ("x_dot", speed)):
                self.assertLessEqual(abs(at[name] - true), answer["accuracy"]["max_abs_error"][name])
            self.assertIn("their order is not known", answer["accuracy"]["reason"])
            self.assertEqual([e["error"] for e in answer["events"]], [None, None])
        corner = ROOM | bounces(("right", "b - x"), ("slope", "2*b - x - y"), restitution="e")
        at, answer = self.last(corner, initial={"x": 1, "y": 1, "x_dot": 1, "y_dot": 1}, t_end=1.5)
        self.assertIn("their order is not known", answer["accuracy"]["reason"])

    def test_a_cradle_hands_the_push_on(self):
        for count in (3, 5):
            scene = balls([1] * count, [-1] + [0] * (count - 1), [2] + [0] * (count - 1))
            at, answer = self.last(scene)
            speeds = [at[f"x{i}_dot"] for i in range(count)]
            numpy.testing.assert_allclose(speeds, [0] * (count - 1) + [2], atol=1e-12)
            self.assertEqual([e["name"] for e in answer["events"]], [f"hit{i}" for i in range(count - 1)])
            self.assertTrue(all(e["t"] == 0.5 for e in answer["events"]))

    def test_balls_that_touch_follow_their_collisions(self):
        masses, e = [2, 1, 3], 0.4
        speeds = numpy.array([1.0, 0, 0])
        while True:  # each pair in turn, as long as it approaches
            pairs = [i for i in range(2) if speeds[i] - speeds[i + 1] > 1e-14]
            if not pairs:
                break
            i = pairs[0]
            a, b = masses[i], masses[i + 1]
            push = (1 + e) * (speeds[i] - speeds[i + 1]) * a * b / (a + b)
            speeds[i] -= push / a
            speeds[i + 1] += push / b
        at, _ = self.last(balls(masses, [-0.3, 0, 0], [1, 0, 0]), parameters={"e": e})
        numpy.testing.assert_allclose([at[f"x{i}_dot"] for i in range(3)], speeds, atol=1e-12)

    def test_balls_apart_meet_one_after_the_other(self):
        at, answer = self.last(balls([1, 1, 1], [0, 1, 1.5], [2, 0, 0]), t_end=2)
        self.assertEqual([(e["name"], e["t"]) for e in answer["events"]], [("hit0", 0.5), ("hit1", 0.75)])
        numpy.testing.assert_allclose([at[f"x{i}"] for i in range(3)], [1, 1.5, 4], atol=1e-12)

    def test_rest_comes_in_time_and_place_between_walls(self):
        scene = ROOM | bounces(("left", "x"), ("right", "b - x"))
        scene["events"] += [{"name": "floor", "expression": "y", "direction": "falling"}]
        scene["impacts"][0]["restitution"] = scene["impacts"][1]["restitution"] = 1
        scene["impacts"] += [{"event": "floor", "restitution": "e"}]
        answer = self.ask("simulate", {"system": scene, "parameters": {"e": 0.5, "g": 10}, "t_end": 20, "samples": 3,
                                       "initial": {"y": 1.25, "y_dot": 0, "x_dot": 3}})
        self.assertEqual(answer["stop"]["reason"], "impacts_accumulate")
        self.assertAlmostEqual(answer["stop"]["t"], 0.5 * 3, 7)
        last = answer["strides"][-1]["state"]
        image = (0.5 + 3 * 1.5) % 4
        self.assertAlmostEqual(last["x"], min(image, 4 - image), 6)
        self.assertAlmostEqual(last["y"], 0, 7)

    def test_taking_turns_accumulates_too(self):
        # along the slopes of a groove at right angles each bounce keeps half of its speed
        scene = ROOM | bounces(("left", "(y - x)/sqrt(2)"), ("right", "(y + x)/sqrt(2)"))
        answer = self.ask("simulate", {"system": scene, "parameters": {"e": 0.5, "g": 10}, "t_end": 20, "samples": 3,
                                       "initial": {"x": 0.1, "y": 0.6, "x_dot": 0, "y_dot": 0}})
        self.assertEqual((answer["status"], answer["stop"]["reason"]), ("stopped", "impacts_accumulate"))
        # of each slope alone: a fall of (y -+ x)/sqrt(2) at g/sqrt(2), the later one rests last
        rest = max(math.sqrt(2 * d / 10) for d in (0.5, 0.7)) * (1 + 2 * 0.5 / (1 - 0.5))
        self.assertLess(answer["stop"]["t"], rest * (1 + 1e-6))

    def test_a_series_of_one_pair_does_not_end_what_the_other_pair_goes_on_with(self):
        # the upper ball is pulled down on the lower one, which nothing pulls; the ends by 70 digits
        def stacked(masses, places, speed, pull, restitutions):
            scene = {"name": "stacked", "units": "none",
                     "coordinates": [{"name": "x", "initial": places[0]},
                                     {"name": "y", "initial": places[1], "initial_rate": speed}],
                     "lagrangian": f"{masses[0]}*x_dot^2/2 + {masses[1]}*y_dot^2/2",
                     "forces": [{"name": "f", "value": f"-{masses[1]}*{pull}", "along": "y"}]}
            scene |= bounces(("floor", "x"), ("between", "y - x"))
            for impact, e in zip(scene["impacts"], restitutions):
                impact["restitution"] = e
            return scene

        for end, t_end, scene in (
                (2.97819473131, 3, stacked(("1.115", "2.899"), ("0.245", "0.491"), "-0.041", "2.699", ("0.9", "0.8"))),
                (7.28240419374, 12, stacked(("1.896", "1.337"), ("0.170", "0.438"), "0.697", "1.949", ("0.8", "0.9"))),
                (1.92415746982, 12, stacked(("1.543", "0.343"), ("0.114", "0.525"), "0", "7.377", ("0.282", "0.837")))):
            answer = self.ask("simulate", {"system": scene, "t_end": t_end, "samples": 4, "events": ["floor", "between"]})
            self.assertEqual(answer["stop"]["reason"], "impacts_accumulate")
            self.assertIn("left out", answer["stop"]["message"])
            error = answer["stop"].get("error")
            if error is not None:
                self.assertLess(abs(answer["stop"]["t"] - end), error)

    def test_extrema_see_every_impact(self):
        answer = self.ask("turning_points", {"system": ROOM, "coordinate": "x", "t_end": 10})
        self.assertAlmostEqual(answer["x_max"], 2, 12)
        self.assertAlmostEqual(answer["x_min"], 0, 12)

    def test_a_motion_that_ends_with_an_impact_does_not_doubt_it(self):
        ball = {"name": "ball", "units": "none", "coordinates": [{"name": "x", "initial": "1"}],
                "lagrangian": "x_dot^2/2 - 9.81*x"} | bounces(("floor", "x"), restitution="0.9")
        ball["events"][0]["direction"] = "falling"
        for request in ({"system": "compass_walker", "steps": 3, "t_end": 30, "events": ["heel_strike"]},
                        {"system": ball, "steps": 3, "events": ["floor"]}, {"system": ball, "steps": 3}):
            answer = self.ask("simulate", {"samples": 3, **request})
            self.assertEqual(len(answer["events"]), 3)
            self.assertEqual(answer["events"][-1]["t"], answer["t_reached"])
            self.assertNotIn("reason", answer["accuracy"])

    def test_a_plastic_impact_happens_once(self):
        for start, rate in (("1", "0"), ("1", "0.5"), ("0.37", "-0.8"), ("2.81", "1.3"), ("0.5", "0.1"), ("1.9", "0")):
            for t_end in (1, 2, 3, 5):
                ball = {"name": "ball", "units": "none", "coordinates": [{"name": "x", "initial": start, "initial_rate": rate}],
                        "lagrangian": "x_dot^2/2 - 9.81*x"} | bounces(("floor", "x"), restitution="0")
                met = (float(rate) + math.sqrt(float(rate)**2 + 2*9.81*float(start)))/9.81
                answer = self.ask("simulate", {"system": ball, "t_end": t_end, "samples": 2, "events": ["floor"], "steps": 2})
                [event] = answer["events"]
                self.assertLess(abs(event["t"] - met), max(event["error"], 1e-15))
                self.assertEqual(event["t"], answer["stop"]["t"])
                self.assertEqual(len(answer["strides"]), 1)

    def test_a_map_without_a_value_is_no_mistake_of_the_start(self):
        scene = {"name": "ball", "units": "none", "coordinates": [{"name": "x", "initial": "1"}, {"name": "y", "initial": "1"}],
                 "lagrangian": "(x_dot^2 + y_dot^2)/2 - 9.81*x", "events": [{"name": "floor", "expression": "x"}],
                 "impact": {"event": "floor", "map": {"x_dot": "1/y_dot"}}}
        response = self.post("simulate", {"system": scene, "t_end": 3})
        problem = strict_json(response.data)
        self.assertEqual(problem["type"], "/errors/not-applicable")
        self.assertIn("Where 'floor' happens, at t = 0.451524, the impact's map has no finite value", problem["detail"])

    def test_mistakes_are_told_at_their_places(self):
        one = {"event": "left", "restitution": "e"}
        for scene, pointer in (
            (ROOM | {"impacts": [one, {"event": "wall", "restitution": "e"}]}, "/impacts/1/event"),
            (ROOM | {"impacts": [one, one]}, "/impacts/1/event"),
            (ROOM | {"impacts": [one, {"event": "right", "restitution": 2}]}, "/impacts/1/restitution"),
            (ROOM | {"impact": one}, "/impacts"),
        ):
            self.refused_at("energy", {"system": scene}, "#/system" + pointer)
        self.assertIn("several impacts", self.refused("gait", {"system": ROOM})["detail"])


class Constrained(Service):
    def test_a_pendulum_hits_a_wall_by_angle_and_by_constraint(self):
        wall = bounces(("wall", "x + b"))
        common = {"gravity": [0, "-g"], "bodies": [{"kind": "particle", "mass": "m", "position": ["x", "y"]}]}
        bound = common | {
            "name": "bound", "parameters": parameters(m=("kg", "1"), l=("m", "1"), g=("m/s^2", "10"), b=("m", "0.2"), e=("1", "0.7")),
            "coordinates": coordinates(x=("m", "0.6", "0"), y=("m", "-0.8", "0")),
            "constraints": [{"name": "rod", "expression": "x^2 + y^2 - l^2"}]} | wall
        free = common | {
            "name": "free", "parameters": bound["parameters"],
            "coordinates": coordinates(a=("rad", "asin(3/5)", "0")),
            "bodies": [{"kind": "particle", "mass": "m", "position": ["l*sin(a)", "-l*cos(a)"]}],
        } | bounces(("wall", "l*sin(a) + b"))
        found = self.ask("simulate", {"system": bound, "t_end": 5, "samples": 31, "max_error": 1e-11})
        known = self.ask("simulate", {"system": free, "t_end": 5, "samples": 31, "max_error": 1e-11})
        self.assertGreater(len(found["events"]), 2)
        for one, other in zip(found["events"], known["events"]):
            self.assertAlmostEqual(one["t"], other["t"], 9)
        numpy.testing.assert_allclose(found["trajectory"]["x"], numpy.sin(known["trajectory"]["a"]), atol=1e-8)
        for kept in found["diagnostics"]["constraints"]:
            self.assertLess(kept["max_abs_rate"], 1e-12)

    def test_what_hangs_together_takes_the_push_together(self):
        place, speed = (0.6, -0.8, 1.4, -1.4), (0.8, 0.6, 1.1, 1.0)
        names = [c["name"] for c in DOUBLE_PENDULUM["coordinates"]]
        scene = DOUBLE_PENDULUM | bounces(("wall", "1.400000001*l - x2"), restitution="1/2")
        request = {"system": scene, "parameters": {"g": 0}, "t_end": 1e-7, "times": [1e-7],
                   "initial": dict(zip(names, place)) | dict(zip((n + "_dot" for n in names), speed))}
        # the two rods keep their lengths: M (v+ - v-) = a Lambda + A^T nu, with A v+ = 0
        a1 = numpy.array([place[0], place[1], 0, 0])
        d = (place[2] - place[0], place[3] - place[1])
        a2 = numpy.array([-d[0], -d[1], d[0], d[1]])
        self.assertLess(abs(a1 @ speed) + abs(a2 @ speed), 1e-12)
        mass = numpy.eye(4)
        matrix = numpy.zeros((7, 7))
        matrix[:4, :4] = mass
        for k, row in enumerate((a1, a2, numpy.array([0, 0, 1.0, 0]))):
            matrix[4 + k, :4] = matrix[:4, 4 + k] = row
        after = numpy.linalg.solve(matrix, numpy.concatenate([mass @ speed, [0, 0, -speed[2] / 2]]))[:4]
        answer = self.ask("simulate", request)
        self.assertEqual(len(answer["events"]), 1)
        numpy.testing.assert_allclose([answer["trajectory"][n + "_dot"][-1] for n in names], after, atol=1e-6)

    def test_a_written_map_has_to_keep_the_constraints(self):
        scene = {"name": "bead", "parameters": parameters(m=("kg", "1")),
                 "coordinates": coordinates(x=("m", "1", "-1"), y=("m", "1", "-1")),
                 "bodies": [{"kind": "particle", "mass": "m", "position": ["x", "y"]}],
                 "constraints": [{"name": "wire", "expression": "y - x"}],
                 "events": [{"name": "stop", "expression": "x", "direction": "falling"}]}
        good = scene | {"impact": {"event": "stop", "map": {"x_dot": "-x_dot/2", "y_dot": "-y_dot/2"}}}
        bad = scene | {"impact": {"event": "stop", "map": {"x_dot": "-x_dot/2"}}}
        answer = self.ask("simulate", {"system": good, "t_end": 2, "samples": 2})
        self.assertAlmostEqual(answer["trajectory"]["y"][-1], 0.5, 12)
        problem = self.refused("simulate", {"system": bad, "t_end": 2, "samples": 2})
        self.assertIn("constraints", problem["errors"][0]["detail"])

    def test_a_wall_that_the_constraints_hide_is_refused(self):
        scene = {"name": "bead", "parameters": parameters(m=("kg", "1"), e=("1", "1")),
                 "coordinates": coordinates(x=("m", "1", "-1"), y=("m", "0", "0")),
                 "bodies": [{"kind": "particle", "mass": "m", "position": ["x", "y"]}],
                 "constraints": [{"name": "wire", "expression": "y"}]} | bounces(("floor", "y"))
        self.refused_at("energy", {"system": scene}, "#/system/impacts/0")

    def test_gaits_under_constraints_are_refused(self):
        scene = {"name": "bead", "parameters": parameters(m=("kg", "1"), e=("1", "1")),
                 "coordinates": coordinates(x=("m", "1", "-1"), y=("m", "1", "-1")),
                 "bodies": [{"kind": "particle", "mass": "m", "position": ["x", "y"]}],
                 "constraints": [{"name": "wire", "expression": "y - x"}]} | bounces(("floor", "y"))
        self.assertIn("constraints", self.refused("gait", {"system": scene})["detail"])


def swung(t, amplitude, length):
    """A pendulum that is let go at -amplitude, and its period: sin(theta/2) = -k cd(w t, k)."""
    k, w = mp.sin(amplitude/2), mp.sqrt(mp.mpf("9.81")/length)
    place, slope = (mp.ellipfun(name, w*t, m=k*k) for name in ("cd", "sd"))
    rate = 2*k*w*(1 - k*k)*slope*mp.ellipfun("nd", w*t, m=k*k)/mp.sqrt(1 - (k*place)**2)
    return -2*mp.asin(k*place), rate, 4*mp.ellipk(k*k)/w


class Cradle(Service):
    """Equal balls that hang side by side: the first and the last take turns in one pendulum's swing, and those between rest but
    for rounding, which says nothing about the others."""

    def cradle(self, count):
        scene = {"name": "cradle", "gravity": ["0", "-g"],
                 "parameters": parameters(m=("kg", "0.3"), l=("m", "1"), d=("m", "0.05"), g=("m/s^2", "9.81")),
                 "coordinates": coordinates(**{f"q{i}": ("rad", "0", "0") for i in range(count)}),
                 "bodies": [{"kind": "particle", "mass": "m", "position": [f"{i}*d + l*sin(q{i})", f"-l*cos(q{i})"]} for i in range(count)]}
        return scene | bounces(*((f"hit{i}", f"q{i + 1} - q{i}") for i in range(count - 1)), restitution="1")

    def test_swings_as_one_pendulum(self):
        for count, amplitude, length, rows in ((3, "0.5", "1", 9), (3, "1.1", "0.4", 8), (4, "0.3", "0.6", 5), (5, "0.7", "1.7", 7)):
            found = self.ask("simulate", {"system": self.cradle(count), "parameters": {"l": length}, "t_end": 4, "samples": rows,
                                          "initial": {"q0": "-" + amplitude}})
            stated, columns = found["accuracy"]["max_abs_error"], found["trajectory"]
            self.assertLess(max(stated.values()), 1e-6)
            self.assertIsNone(found["accuracy"]["horizon"])
            for row in range(rows):
                angle, rate, period = swung(mp.mpf(4)*row/(rows - 1), mp.mpf(amplitude), mp.mpf(length))
                for i in range(count):
                    swings = i == (0 if angle < 0 else count - 1)
                    for name, true in ((f"q{i}", angle), (f"q{i}_dot", rate)):
                        self.assertLessEqual(abs(columns[name][row] - swings*true), stated[name], (count, row, name))
            self.assertTrue(any(event["error"] is not None for event in found["events"]))
            for event in found["events"]:
                off = (mp.mpf(event["t"])/period - 0.25)*2
                if event["error"] is not None:
                    self.assertLessEqual(abs(off - mp.nint(off))*period/2, event["error"], (count, event["name"]))


if __name__ == "__main__":
    unittest.main()
