"""tests/room finds what it is to run: the rooms and the scripts that tests/api/rooms.txt names are there."""

import unittest

from test_includes import ROOT, plan


class Rooms(unittest.TestCase):
    def test_each_line_names_a_room_and_scripts_that_exist(self):
        lines = (ROOT / "tests/api/rooms.txt").read_text(encoding="utf-8").splitlines()
        self.assertGreater(len(lines), 0)
        for line in lines:
            room, scripts = line.split(": ")
            self.assertIn(room, plan())
            for script in scripts.split():
                self.assertTrue((ROOT / f"tests/api/test_{script}.py").is_file(), f"{room}: {script}")


if __name__ == "__main__":
    unittest.main()
