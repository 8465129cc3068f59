"""What the tests of nbgrader and Otter share: the assignment's notebook with a submission in its answer cells, run confined."""

import json
import pathlib
import shutil

from sandbox import new_directory, run_confined, unpack_bundle, writable

RUNNER = pathlib.Path(__file__).with_name("run_notebook.py")
PATIENCE = 30  # seconds; nbgrader's own limit for one cell


def answer_cells(notebook):
    return {cell["metadata"]["answers"]: cell for cell in notebook["cells"] if "answers" in cell["metadata"]}


def run_submission(notebook, answers, key, tests=None):
    """The executed notebook, and what Otter's tests say: `answers` has the content of each answer cell."""
    directory = writable(new_directory() / "submitted")
    unpack_bundle(directory)
    shutil.copy(key, directory)
    shutil.copy(RUNNER, directory)
    for name, cell in answer_cells(notebook).items():
        cell["source"] = answers[name]
    (directory / "swing.ipynb").write_text(json.dumps(notebook))
    if tests:
        shutil.copytree(tests, directory / "tests")
    words = ["swing.ipynb", "executed.ipynb", *(["tests"] if tests else [])]
    run = run_confined(["/usr/bin/python3", "run_notebook.py", *words], directory, PATIENCE)
    assert run.returncode == 0, run.stderr
    return json.loads((directory / "executed.ipynb").read_text()), json.loads(run.stdout or "{}")
