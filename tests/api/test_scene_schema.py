"""The schema of scenes accepts every scene of the project and refuses what the reader refuses."""

import json
import pathlib
import unittest

from jsonschema import Draft202012Validator

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ROOT / "api" / "scenes"
SCHEMA = json.loads((SCENES / "schema.json").read_text(encoding="utf-8"))
TABLE = json.loads((ROOT / "tests" / "api" / "scene_mistakes.json").read_text(encoding="utf-8"))


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


class SceneSchema(unittest.TestCase):
    def setUp(self):
        self.validator = Draft202012Validator(SCHEMA)

    def test_is_a_schema(self):
        Draft202012Validator.check_schema(SCHEMA)

    def test_accepts_every_scene(self):
        files = [file for file in SCENES.glob("*.json") if file.name != "schema.json"]
        self.assertGreaterEqual(len(files), 11)
        files += (ROOT / "tests" / "reference" / "scenes").glob("*.json")
        for file in files:
            with self.subTest(file.name):
                scene = json.loads(file.read_text(encoding="utf-8"))
                self.assertEqual([error.message for error in self.validator.iter_errors(scene)], [])

    def test_accepts_the_scene_before_the_mistakes(self):
        self.assertTrue(self.validator.is_valid(TABLE["scene"]))

    def test_refuses_what_the_reader_refuses(self):
        for mistake in TABLE["mistakes"]:
            with self.subTest(mistake["fact"]):
                self.assertFalse(self.validator.is_valid(merged(TABLE["scene"], mistake["change"])))


if __name__ == "__main__":
    unittest.main()
