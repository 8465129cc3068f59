"""Programs of Node for the tests, from the packages that `server/install test` puts into build/npm."""

import os
import pathlib
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
MODULES = pathlib.Path(os.environ.get("QDOT_NODE_MODULES", ROOT / "build" / "npm" / "node_modules"))


def require_packages():
    """Without them a test fails, and says what to do."""
    if shutil.which("node") is None:
        raise AssertionError("Node is missing: run server/install test")
    if not (MODULES / "ajv").exists():
        raise AssertionError(f"{MODULES} is missing: run server/install test, which needs npm and its registry once")


def node(program, *arguments, directory=None):
    """Runs a program of a package, or a file of ours, to its end, in the directory."""
    path = program if isinstance(program, pathlib.Path) else MODULES / program
    environment = {**os.environ, "QDOT_NODE_MODULES": str(MODULES), "REDOCLY_TELEMETRY": "off",
                   "REDOCLY_SUPPRESS_UPDATE_NOTICE": "true", "NO_COLOR": "1"}
    return subprocess.run(["node", str(path), *arguments], capture_output=True, text=True, timeout=280, check=False,
                          env=environment, cwd=directory)
