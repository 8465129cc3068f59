"""What the tests of graders share: the bundle, a README's own words carried out, and a place to run what students hand in
as graders do: as nobody, without network, at half a CPU.

The place needs no container engine. Seccomp refuses every socket, a limit bounds the memory, and a process group that is
stopped half of the time on one CPU has half of that CPU. Only becoming nobody needs root; a developer's own user is left.
"""

import ctypes
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tarfile
import tempfile
import threading
import time

import jsonschema

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests" / "server"))

from running_qdot import QDOT  # noqa: E402

NOBODY = 65534
MEMORY = 768 << 20  # bytes, Gradescope's smallest container
MOST_LINES = 9  # of a teacher's own text
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```\n", re.MULTILINE | re.DOTALL)
FILE_NAME = re.compile(r"`([\w/.]+)`:\n\n\Z")

workplace = tempfile.TemporaryDirectory()
pathlib.Path(workplace.name).chmod(0o755)
archives = []


def bundle_archive():
    """The bundle of the program under test; made once."""
    if not archives:
        archive = pathlib.Path(workplace.name) / "qdot-bundle.tar.gz"
        subprocess.run([ROOT / "server" / "bundle", archive], check=True, capture_output=True,
                       env={**os.environ, "QDOT_BINARY": QDOT})
        archives.append(archive)
    return archives[0]


def new_directory():
    """A directory that everybody may read."""
    directory = pathlib.Path(tempfile.mkdtemp(dir=workplace.name))
    directory.chmod(0o755)
    return directory


class Setup:
    """A copy of a grader's folder in which everything that its README tells a teacher to write was written, and run."""

    def __init__(self, folder):
        self.directory = new_directory() / folder.name
        shutil.copytree(folder, self.directory)
        shutil.copy(bundle_archive(), self.directory)
        self.readme = (folder / "README.md").read_text()
        self.lines = 0
        for block in BLOCK.finditer(self.readme):
            self.lines += block.group(2).count("\n")
            self.carry_out(self.readme[:block.start()], *block.groups())

    def carry_out(self, before, language, text):
        if language == "sh":
            run = subprocess.run(["sh", "-ec", text], cwd=self.directory, capture_output=True, text=True, check=False)
            assert run.returncode == 0, run.stderr
            return
        name = FILE_NAME.search(before).group(1)
        (self.directory / name).write_text(text)

    @property
    def key(self):
        return json.loads((self.directory / "key.json").read_text())


def unpack_bundle(directory):
    with tarfile.open(bundle_archive()) as archive:
        archive.extractall(directory)
    return directory / "qdot"


class SockFilter(ctypes.Structure):
    _fields_ = [("code", ctypes.c_uint16), ("jt", ctypes.c_uint8), ("jf", ctypes.c_uint8), ("k", ctypes.c_uint32)]


class SockProgram(ctypes.Structure):
    _fields_ = [("length", ctypes.c_uint16), ("filter", ctypes.POINTER(SockFilter))]


LIBC = ctypes.CDLL(None, use_errno=True)
SOCKET, NOT_PERMITTED, ALLOW = 41, 0x00050001, 0x7FFF0000  # x86-64's number of socket(2); seccomp(2), SECCOMP_RET_*
STEPS = (SockFilter * 4)((0x20, 0, 0, 0),           # load the number of the system call
                         (0x15, 0, 1, SOCKET),      # another one than socket: skip a step
                         (0x06, 0, 0, NOT_PERMITTED), (0x06, 0, 0, ALLOW))
NO_SOCKETS = SockProgram(4, STEPS)


def confine():
    """Of the process that is about to run: nobody, no sockets, one CPU, little memory."""
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    if os.geteuid() == 0:
        os.setgroups([])
        os.setgid(NOBODY)
        os.setuid(NOBODY)
    assert LIBC.prctl(38, 1, 0, 0, 0) == 0  # PR_SET_NO_NEW_PRIVS
    assert LIBC.prctl(22, 2, ctypes.byref(NO_SOCKETS)) == 0  # PR_SET_SECCOMP


def halve(process):
    """Lets the group of a process run every other 20 ms until it has ended."""
    while process.poll() is None:
        for what in (signal.SIGSTOP, signal.SIGCONT):
            try:
                os.killpg(process.pid, what)
            except ProcessLookupError:
                return
            time.sleep(0.02)


def run_confined(command, cwd, timeout, text="", **environment):
    """The finished process, with stdout and stderr as text."""
    process = subprocess.Popen(command, cwd=cwd, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               text=True, start_new_session=True, preexec_fn=confine,
                               env={"PATH": "/usr/bin:/bin", "HOME": "/nonexistent", **environment})
    halver = threading.Thread(target=halve, args=(process,))
    halver.start()
    with process:
        try:
            out, err = process.communicate(text, timeout=timeout)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            raise
        finally:
            process.wait(timeout=10)
            halver.join()
    return subprocess.CompletedProcess(command, process.returncode, out, err)


def writable(directory):
    """A directory that nobody may write to."""
    directory.mkdir(parents=True, exist_ok=True)
    directory.chmod(0o777)
    return directory


def validate(value, folder):
    """That a grader's result has the form that its documents ask for, as the schema beside the test says it."""
    schema = json.loads((folder / "result_schema.json").read_text())
    jsonschema.Draft202012Validator(schema).validate(value)
