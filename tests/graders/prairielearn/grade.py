#!/usr/bin/env python3
"""PrairieLearn's external grader: /grade/data/data.json and /grade/tests/key.json in, /grade/results/results.json out."""

import json
import pathlib
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent  # /grade/serverFilesCourse/qdot
GRADE = HERE.parents[1]


def graded():
    """What qdot says of the answers that the key asks for."""
    key = GRADE / "tests" / "key.json"
    submitted = json.loads((GRADE / "data" / "data.json").read_text(encoding="utf-8"))["submitted_answers"]
    asked = [item["id"] for item in json.loads(key.read_text(encoding="utf-8"))["items"]]
    with tempfile.NamedTemporaryFile("w", suffix=".json") as answers:
        json.dump({name: submitted[name] for name in asked if name in submitted}, answers)
        answers.flush()
        run = subprocess.run([str(HERE / "qdot"), "check", "--key", str(key), "--answers", answers.name, "--format", "prairielearn"],
                             stdout=subprocess.PIPE, check=True)
    return json.loads(run.stdout.decode())


def main():
    results = GRADE / "results"
    results.mkdir(exist_ok=True)
    (results / "results.json").write_text(json.dumps(graded()), encoding="utf-8")


if __name__ == "__main__":
    main()
