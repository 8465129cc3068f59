"""Runs a notebook's code cells in their order in one namespace, an error ends its cell alone, as nbgrader and Otter run them:
    run_notebook.py IN.ipynb OUT.ipynb [OTTER_TESTS]
OUT has the outputs (nbformat 4). With a directory of Otter's test files (OK format), their results are printed as JSON.
"""

import contextlib
import doctest
import io
import json
import pathlib
import runpy
import sys
import traceback


def run_cell(cell, number, namespace):
    out = io.StringIO()
    cell["execution_count"], cell["outputs"] = number, []
    try:
        with contextlib.redirect_stdout(out):
            exec(compile("".join(cell["source"]), f"<cell {number}>", "exec"), namespace)
    except BaseException as error:
        cell["outputs"].append({"output_type": "error", "ename": type(error).__name__, "evalue": str(error),
                                "traceback": traceback.format_exception(error)})
    if out.getvalue():
        cell["outputs"].insert(0, {"output_type": "stream", "name": "stdout", "text": out.getvalue()})


def run_case(code, name, namespace):
    """What doctest says of one case; empty where it passes."""
    said = io.StringIO()
    test = doctest.DocTestParser().get_doctest(code, dict(namespace), name, None, None)
    doctest.DocTestRunner(verbose=False).run(test, out=said.write)
    return said.getvalue()


def run_test_file(file, namespace):
    test = runpy.run_path(str(file))["test"]
    (suite,) = test["suites"]
    failures = [said for case in suite["cases"] if (said := run_case(case["code"], test["name"], namespace))]
    return {"name": test["name"], "max_score": test["points"], "score": 0 if failures else test["points"],
            "output": "\n".join(failures)}


def main(source, target, tests=None):
    notebook = json.loads(pathlib.Path(source).read_text())
    namespace = {"__name__": "__main__"}
    code = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    for number, cell in enumerate(code, 1):
        run_cell(cell, number, namespace)
    pathlib.Path(target).write_text(json.dumps(notebook))
    if tests:
        results = [run_test_file(file, namespace) for file in sorted(pathlib.Path(tests).glob("*.py"))]
        json.dump({"tests": results}, sys.stdout)


if __name__ == "__main__":
    main(*sys.argv[1:])
