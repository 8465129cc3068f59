"""The schema of scenes, which the service prints from its tables, accepts and refuses what the reader does."""

import copy
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from jsonschema import Draft202012Validator

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.extend([str(ROOT / "tests" / "support"), str(ROOT / "tests" / "server")])

from running_qdot import ENVIRONMENT, QDOT  # noqa: E402
from service import Service  # noqa: E402

SYSTEMS = [json.loads(file.read_text(encoding="utf-8"))
           for file in sorted((ROOT / "api" / "scenes" / "systems").glob("*.json"))]
TEXTBOOK = [json.loads(file.read_text(encoding="utf-8"))
            for file in sorted((ROOT / "tests" / "reference" / "scenes").glob("*.json"))]
TABLE = json.loads((ROOT / "tests" / "api" / "scenes" / "scene_mistakes.json").read_text(encoding="utf-8"))


def merged(target, change):
    """`change` merged into `target` as in RFC 7396."""
    if not isinstance(change, dict):
        return change
    result = dict(target) if isinstance(target, dict) else {}
    for key, value in change.items():
        if value is None:
            result.pop(key, None)
        else:
            result[key] = merged(result.get(key), value)
    return result


def places(value, place=()):
    """The path of every value inside."""
    entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in entries:
        yield place + (key,)
        yield from places(inner, place + (key,))


def at(value, place):
    for key in place:
        value = value[key]
    return value


def mutations(scene):
    """The scene with each of its members in turn left out, of another type, and with one member too many."""
    for place in places(scene):
        *parent, key = place
        changed = copy.deepcopy(scene)
        del at(changed, parent)[key]
        yield f"without {place}", changed
        for other in (None, True, 7, "x y", "", [], ["x"], {}):
            changed = copy.deepcopy(scene)
            at(changed, parent)[key] = other
            yield f"{other!r} for {place}", changed
        if isinstance(at(scene, place), dict):
            for name in ("extra", "latex", "radius", "reaction"):
                changed = copy.deepcopy(scene)
                at(changed, place).setdefault(name, "x")
                yield f"{name} in {place}", changed


def refused_by_the_reader(scenes):
    """The numbers of the scenes that a directory of them is refused for. Their names repeat, which is no matter here."""
    with tempfile.TemporaryDirectory() as directory:
        for number, scene in enumerate(scenes):
            (pathlib.Path(directory) / f"{number}.json").write_text(json.dumps(scene), encoding="utf-8")
        done = subprocess.run([QDOT, "systems", "--scenes", directory], capture_output=True, text=True,
                              env=ENVIRONMENT, check=False)
    lines = [line.removeprefix("qdot: ") for line in done.stderr.splitlines()]
    return {int(line.split(".json: ")[0]) for line in lines if ".json: " in line and " is taken by " not in line}


class SceneSchema(Service):
    def setUp(self):
        response = self.raw("GET", "/v1/scene-schema")
        self.assertEqual(response.status, 200)
        self.schema = json.loads(response.data)
        self.validator = Draft202012Validator(self.schema)

    def test_is_a_schema_at_the_address_that_it_names(self):
        Draft202012Validator.check_schema(self.schema)
        self.assertEqual(self.schema["$id"], "/v1/scene-schema")

    def test_comes_as_a_schema_for_those_who_ask_for_one(self):
        for accept in ("application/schema+json", "application/json"):
            response = self.raw("GET", "/v1/scene-schema", headers={"Accept": accept})
            self.assertEqual((response.status, response.getheader("Content-Type")), (200, accept))

    def test_accepts_every_scene(self):
        self.assertGreaterEqual(len(SYSTEMS), 11)
        for scene in SYSTEMS + TEXTBOOK + [TABLE["scene"]]:
            with self.subTest(scene["name"]):
                self.assertEqual([error.message for error in self.validator.iter_errors(scene)], [])

    def test_refuses_what_the_reader_refuses(self):
        for mistake in TABLE["mistakes"]:
            with self.subTest(mistake["fact"]):
                self.assertFalse(self.validator.is_valid(merged(TABLE["scene"], mistake["change"])))

    def test_agrees_with_the_reader_on_every_scene_with_one_member_changed(self):
        walker, disk, cart = (next(s for s in SYSTEMS if s["name"] == name)
                              for name in ("compass_walker", "rolling_disk_platform", "cart_pendulum"))
        rod, forced = (next(s for s in SYSTEMS if s["name"] == name)
                       for name in ("rod_spring_pendulum", "forced_spring_pendulum"))
        cases = [case for scene in (walker, disk, cart, rod, forced) for case in mutations(scene)]
        refused = refused_by_the_reader([scene for _, scene in cases])
        self.assertTrue(len(cases) // 4 < len(refused) < len(cases), "some are refused, some are not")
        for number, (what, scene) in enumerate(cases):
            if self.validator.is_valid(scene) != (number not in refused):
                self.fail(f"{scene.get('name')}, {what}: refused by {'reader' if number in refused else 'schema'} only")


if __name__ == "__main__":
    unittest.main()
