#!/usr/bin/env python3
"""Prints the workflow for key.json, a step for each item; with the word `answers`, the file that students fill in."""

import json
import sys

HEAD = """name: Autograding Tests
on: [push, workflow_dispatch]
permissions: {checks: write, actions: read, contents: read}
jobs:
  run-autograding-tests:
    runs-on: ubuntu-latest
    if: github.actor != 'github-classroom[bot]'
    steps:
      - uses: actions/checkout@v4"""
STEP = """      - id: item-{number}
        uses: classroom-resources/autograding-command-grader@v1
        with:
          test-name: {name}
          setup-command: ""
          command: python3 .github/grade.py {name}
          timeout: 1
          max-score: {points}"""
REPORT = """      - uses: classroom-resources/autograding-grading-reporter@v1
        env:
{results}
        with:
          runners: {runners}"""
RESULT = '          ITEM-{number}_RESULTS: "${{{{ steps.item-{number}.outputs.result }}}}"'


def workflow(items):
    numbers = range(1, len(items) + 1)
    steps = [STEP.format(number=number, name=item["id"], points=item.get("points", 1)) for number, item in zip(numbers, items)]
    results = "\n".join(RESULT.format(number=number) for number in numbers)
    return "\n".join([HEAD, *steps, REPORT.format(results=results, runners=",".join(f"item-{number}" for number in numbers))])


def main(words):
    with open("key.json", encoding="utf-8") as file:
        items = json.load(file)["items"]
    for item in items:
        if not item["id"].isidentifier():
            raise SystemExit(f"The item {item['id']!r} needs a name of letters, digits and _ here.")
    print("\n".join(["id,submitted", *[item["id"] + "," for item in items]]) if words == ["answers"] else workflow(items))


if __name__ == "__main__":
    main(sys.argv[1:])
