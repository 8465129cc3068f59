#!/usr/bin/env python3
"""Writes tests/<item>.py, a test file in OK format, for every item of key.json; the answer is the variable of that name."""

import json
import os
import pprint


def test_of(item):
    case = {"code": f">>> key.assert_right({item['id']!r}, {item['id']})\n", "hidden": False, "locked": False}
    suite = {"cases": [case], "scored": True, "setup": "", "teardown": "", "type": "doctest"}
    return {"name": item["id"], "points": item.get("points", 1), "suites": [suite]}


def main():
    os.makedirs("tests", exist_ok=True)
    with open("key.json", encoding="utf-8") as file:
        items = json.load(file)["items"]
    for item in items:
        if not item["id"].isidentifier():
            raise SystemExit(f"The item {item['id']!r} is no name of a variable; its test has to be written by hand.")
        with open(os.path.join("tests", item["id"] + ".py"), "w", encoding="utf-8") as file:
            file.write("OK_FORMAT = True\n\ntest = " + pprint.pformat(test_of(item), sort_dicts=False) + "\n")


if __name__ == "__main__":
    main()
