"""Fields of a scene that would do nothing are refused: whoever wrote them meant something else."""

import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402


def parameter(name, unit, default):
    return {"name": name, "unit": unit, "default": default}


def pendulum(**more):
    return {"name": "pendulum", "gravity": ["0", "-g"],
            "parameters": [parameter("m", "kg", "1"), parameter("l", "m", "1"), parameter("g", "m/s^2", "9.81")],
            "coordinates": [{"name": "th", "unit": "rad", "initial": "0.3"}],
            "points": [{"name": "bob", "components": ["l*sin(th)", "-l*cos(th)"]}],
            "bodies": [{"kind": "particle", "mass": "m", "position": "bob"}], **more}


class FieldsThatDoNothing(Service):
    def refused_scene(self, place, code, **more):
        problem = self.refused("equations", {"system": pendulum(**more)})
        self.assertEqual([(error["pointer"], error["code"]) for error in problem["errors"]], [(f"#/system{place}", code)])

    def test_a_force_along_what_does_not_move(self):
        self.refused_scene("/forces/0/along", "no_coordinate", forces=[{"value": "m*g", "along": "l"}])
        self.refused_scene("/forces/0/point", "no_coordinate", forces=[{"vector": ["m*g", "0"], "point": ["0", "0"]}])
        self.ask("equations", {"system": pendulum(forces=[{"value": "m*g", "along": "l*th"}])})

    def test_a_damper_along_what_does_not_move(self):
        damper = {"coefficient": "m*sqrt(g/l)", "length": "l"}
        self.refused_scene("/dampers/0/length", "no_coordinate", dampers=[damper])
        self.ask("equations", {"system": pendulum(dampers=[{**damper, "length": "l*th"}])})

    def test_a_dissipation_without_a_velocity(self):
        self.refused_scene("/dissipation", "no_velocity", dissipation="m*l^2*sqrt(g/l)^3")

    def test_lines_between_points_that_are_not_there(self):
        self.refused_scene("/lines/0/1", "unknown_point", lines=[["bob", "foot"]])

    def test_a_reaction_of_a_length_that_nothing_uses(self):
        held = {"held_lengths": [{"name": "s", "unit": "m", "value": "l"}]}
        condition = {"name": "tension", "unit": "N", "reaction": {"length": "s", "sign": -1}, "reason": "slack",
                     "message": "It is slack."}
        self.refused_scene("/valid_while/0/reaction/length", "no_reaction", valid_while=[condition], **held)
        points = [{"name": "bob", "components": ["s*sin(th)", "-s*cos(th)"]}]
        self.ask("equations", {"system": pendulum(valid_while=[condition], points=points, **held)})


if __name__ == "__main__":
    unittest.main()
