"""Includes run the way the plan draws them: the room() lines of core/ and api/ say what each room may use.

What is read here are texts alone, so that a wrong include is found even where it happens to compile. A header and its
source count as one file.
"""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROOM = re.compile(r"^room\((\w+)(?:\s+(?:LOOPS|SHARED_BY_THREADS))*(?:\s+DEPENDS_ON\s+([\w:\s]+?))?(?:\s+LIBRARIES\s.*?)?\)", re.MULTILINE | re.DOTALL)
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)


def planned_rooms(house, text):
    """Each room of a CMakeLists.txt and the rooms it may use directly: "core/expr" -> {"core/numerics"}."""

    def folder(target):
        return house if target == house else target.replace("_", "/", 1)

    return {
        f"{house}/{name}": {folder(target) for target in targets.split() if re.match("(core|api)", target)}
        for name, targets in ROOM.findall(text)
    }


def plan():
    """For every room the rooms it may use, those below the ones it names included."""
    direct = {}
    for house in ("core", "api"):
        direct |= planned_rooms(house, (ROOT / house / "CMakeLists.txt").read_text(encoding="utf-8"))
    direct["core"] = {room for room in direct if room.startswith("core/")}
    direct["api"] = {room for room in direct if room.startswith("api/")}
    direct |= {"server": {"api", "server/web"}, "server/web": {"api"}}
    return {room: reached(direct, room) - {room} for room in direct}


def reached(arrows, start):
    found, waiting = set(), [start]
    while waiting:
        here = waiting.pop()
        if here not in found:
            found.add(here)
            waiting.extend(arrows.get(here, ()))
    return found


def includes(root=ROOT):
    """{file: the project's files that it includes}, all from the root."""
    sources = [path for house in ("core", "api", "server") for path in sorted((root / house).rglob("*.[ch]pp"))]
    names = {path.relative_to(root).as_posix(): path for path in sources}
    return {
        name: [other for other in INCLUDE.findall(path.read_text(encoding="utf-8")) if other in names]
        for name, path in names.items()
    }


def room_of(name, rooms):
    """The room whose folder holds the file: the longest that fits."""
    return max((room for room in rooms if name.startswith(room + "/")), key=len)


def against_the_plan(files, allowed):
    """Sentences. In core a room does not even include what stands in a folder inside its own."""
    for name, others in files.items():
        room = room_of(name, allowed)
        for other in others:
            target = room_of(other, allowed)
            if target != room and target not in allowed[room]:
                yield f"{name} includes {other}, but {room} may not use {target}"
            elif target == room and name.startswith("core/") and pathlib.PurePath(name).parent in pathlib.PurePath(other).parent.parents:
                yield f"{name} includes {other}, which stands in a room inside its own"


def cycles(files):
    """Groups of files that reach each other, header and source of one name taken as one."""

    def unit(name):
        return name.rsplit(".", 1)[0]

    arrows = {}
    for name, others in files.items():
        arrows.setdefault(unit(name), set()).update(unit(other) for other in others if unit(other) != unit(name))
    below = {name: reached(arrows, name) for name in arrows}
    groups = {frozenset(b for b in below[a] if a in below[b]) for a in arrows}
    return sorted(sorted(group) for group in groups if len(group) > 1)


class Includes(unittest.TestCase):
    def test_no_file_includes_what_its_room_may_not_use(self):
        files, allowed = includes(), plan()
        self.assertGreater(sum(map(len, files.values())), 500, "Hardly any include was found.")
        self.assertEqual(list(against_the_plan(files, allowed)), [])

    def test_no_files_include_each_other_in_a_circle(self):
        self.assertEqual(cycles(includes()), [])

    def test_no_rooms_use_each_other(self):
        allowed = plan()
        self.assertGreater(len(allowed), 15, "Hardly any room was found.")
        self.assertEqual([(a, b) for a in allowed for b in allowed[a] if a in allowed.get(b, ())], [])

    def test_every_folder_with_sources_belongs_to_a_room(self):
        rooms = plan()
        for name in includes():
            self.assertIn(room_of(name, rooms), rooms)
            self.assertFalse(name.startswith("core/") and room_of(name, rooms) == "core" and name != "core/pipeline.hpp", name)


class TheSearchItself(unittest.TestCase):
    """The search finds what it is for, in a house with a fault."""

    rooms = {"core/low": set(), "core/high": {"core/low"}, "core/beside": {"core/low"}}

    def test_finds_an_include_upwards_and_one_to_the_side(self):
        files = {"core/low/a.hpp": ["core/high/b.hpp"], "core/high/b.hpp": ["core/beside/c.hpp", "core/low/d.hpp"]}
        self.assertEqual(
            list(against_the_plan(files, self.rooms)),
            [
                "core/low/a.hpp includes core/high/b.hpp, but core/low may not use core/high",
                "core/high/b.hpp includes core/beside/c.hpp, but core/high may not use core/beside",
            ],
        )

    def test_finds_an_include_of_an_inner_room(self):
        files = {"core/low/a.hpp": ["core/low/inner/b.hpp"], "core/low/inner/b.hpp": ["core/low/c.hpp"]}
        self.assertEqual(len(list(against_the_plan(files, self.rooms))), 1)

    def test_finds_a_circle_through_a_source(self):
        files = {"core/low/a.hpp": [], "core/low/a.cpp": ["core/low/b.hpp"], "core/low/b.hpp": ["core/low/a.hpp"]}
        self.assertEqual(cycles(files), [["core/low/a", "core/low/b"]])

    def test_reads_rooms_with_and_without_what_they_use(self):
        text = "room(base)\nroom(expr LOOPS SHARED_BY_THREADS DEPENDS_ON base\n  LIBRARIES x)\nroom(top DEPENDS_ON core_expr core_base other::lib)\n"
        self.assertEqual(
            planned_rooms("core", text), {"core/base": set(), "core/expr": set(), "core/top": {"core/expr", "core/base"}}
        )


if __name__ == "__main__":
    sys.exit(unittest.main())
