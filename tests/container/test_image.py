"""The Dockerfile is built for real, and its image run as it is meant to be: as nobody, on a read-only root, alone.

No registry is asked: debootstrap makes the base and buildah tags it with the Dockerfile's FROM. The build stage compiles
the program: in minutes, or in half a minute where ccache already knows what the release build compiled. It needs root, and
the packages that `server/install container` installs.
"""

import json
import os
import pathlib
import re
import select
import shutil
import signal
import subprocess
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORK = pathlib.Path(os.environ.get("QDOT_CONTAINER_WORK", ROOT / "build" / "container"))
BASE = WORK / "base.tar"
CACHE = pathlib.Path(os.environ.get("CCACHE_DIR", pathlib.Path.home() / ".cache" / "ccache"))
TOOLS = ("buildah", "debootstrap", "bwrap", "nsenter")
LARGEST = 60e6  # bytes beyond the base
REQUEST = '{"system": "cart_pendulum"}'
CLIENT = """
import http.client, sys
connection = http.client.HTTPConnection("127.0.0.1", 8080, timeout=20)
connection.request(*sys.argv[1:3], body=sys.argv[3] or None, headers={"Content-Type": "application/json"})
response = connection.getresponse()
print(response.status)
print(response.read().decode())
"""


def why_not():
    """Why this machine cannot build the image; empty where it can."""
    if os.geteuid() != 0:
        return "building an image without a container engine needs root"
    missing = [tool for tool in TOOLS if shutil.which(tool) is None]
    return f"{', '.join(missing)} not installed: run server/install container" if missing else ""


def run(*command, **options):
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(command)}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}")
    return done.stdout.strip()


def buildah(*arguments):
    policy = WORK / "policy.json"
    policy.write_text('{"default": [{"type": "insecureAcceptAnything"}]}')
    storage = ("--root", str(WORK / "storage"), "--runroot", str(WORK / "run"), "--storage-driver", "vfs")
    return run("buildah", *storage, *arguments[:1],
               *(("--signature-policy", str(policy)) if arguments[0] in ("commit", "build", "from") else ()),
               *arguments[1:])


def make_base(name):
    """Debian 12's minimal system under the name of the Dockerfile's FROM."""
    if not BASE.exists():
        tree = WORK / "base"
        run("debootstrap", "--variant=minbase", "bookworm", str(tree))
        leftovers = [f"--exclude=./var/{place}/*" for place in ("cache/apt", "lib/apt/lists", "log")]
        run("tar", "-C", str(tree), *leftovers, "-cf", str(BASE) + ".part", ".")
        os.rename(str(BASE) + ".part", BASE)
        shutil.rmtree(tree)
    container = buildah("from", "scratch")
    buildah("add", container, str(BASE), "/")
    buildah("commit", "--rm", container, name)


def mounted(image):
    return pathlib.Path(buildah("mount", buildah("from", "--pull-never", image)))


def bytes_of(tree):
    return int(run("du", "-sxb", str(tree)).split()[0])


class Sandbox:
    """The image's entry point as process 1: loopback alone, read-only root, its own user, no capabilities."""

    def __init__(self, tree, config):
        user, group = config["User"].split(":")
        info, child = os.pipe()
        environment = [part for setting in config["Env"] for part in ("--setenv", *setting.split("=", 1))]
        self.process = subprocess.Popen(
            ["bwrap", "--unshare-all", "--as-pid-1", "--die-with-parent", "--cap-drop", "ALL", "--clearenv", *environment,
             "--uid", user, "--gid", group, "--ro-bind", str(tree), "/", "--proc", "/proc", "--dev", "/dev",
             "--remount-ro", "/", "--info-fd", str(child), "--", *config["Entrypoint"], *config["Cmd"]],
            pass_fds=[child], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        os.close(child)
        with os.fdopen(info) as stream:
            self.pid = json.load(stream)["child-pid"]
        ready, _, _ = select.select([self.process.stdout], [], [], 20)
        self.start_line = self.process.stdout.readline() if ready else ""

    def inside(self, *command):
        return subprocess.run(["nsenter", "-t", str(self.pid), "-n", *command], capture_output=True, text=True, timeout=60,
                              check=False)

    def ask(self, method, target, body=""):
        done = self.inside("python3", "-c", CLIENT, method, target, body)
        status, _, text = done.stdout.partition("\n")
        return int(status or 0), text or done.stderr


@unittest.skipIf(why_not(), why_not())
class Image(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        WORK.mkdir(parents=True, exist_ok=True)
        cls.remove_storage()
        cls.addClassCleanup(cls.remove_storage)
        bases = set(re.findall(r"^FROM (\S+)", (ROOT / "Dockerfile").read_text(), re.MULTILINE))
        assert len(bases) == 1, bases
        base = "localhost/" + bases.pop()
        make_base(base)
        started = time.monotonic()
        CACHE.mkdir(parents=True, exist_ok=True)
        buildah("build", "--isolation", "chroot", "--pull-never", "--format", "docker", "--tag", "qdot",
                "--build-arg", "PURPOSES=build cache", "--volume", f"{CACHE}:/root/.cache/ccache", str(ROOT))
        print(f"built in {time.monotonic() - started:.0f} s")
        cls.config = json.loads(buildah("inspect", "--type", "image", "qdot"))["Docker"]["config"]
        cls.tree = mounted("qdot")
        cls.added = bytes_of(cls.tree) - bytes_of(mounted(base))

    @staticmethod
    def remove_storage():
        if (WORK / "storage").exists():
            buildah("rm", "--all")
            buildah("rmi", "--all", "--force")
            shutil.rmtree(WORK / "storage", ignore_errors=True)

    def test_is_small(self):
        print(f"{self.added / 1e6:.1f} MB beyond the base")
        self.assertLess(self.added, LARGEST)

    def test_says_how_to_run_it(self):
        self.assertRegex(self.config["User"], r"^[1-9]\d*:[1-9]\d*$")
        self.assertEqual(self.config["Healthcheck"]["Test"], ["CMD", "qdot", "health"])
        self.assertEqual(self.config["StopSignal"], "SIGTERM")
        self.assertIn("8080/tcp", self.config["ExposedPorts"])
        labels = self.config["Labels"]
        for label in ("title", "description", "version", "licenses"):
            self.assertTrue(labels.get("org.opencontainers.image." + label), label)
        version = run(str(self.tree / "usr/local/bin/qdot"), "--version").split()[-1]
        self.assertEqual(labels["org.opencontainers.image.version"], version)

    def test_runs_as_nobody_on_a_read_only_root_with_loopback_alone(self):
        sandbox = Sandbox(self.tree, self.config)
        try:
            self.assertEqual(json.loads(sandbox.start_line or "{}").get("port"), 8080, sandbox.process.poll())
            status, text = sandbox.ask("POST", "/v1/modes", REQUEST)
            self.assertEqual(status, 200, text)
            self.assertEqual(len(json.loads(text)["modes"]), 2)
            self.assertEqual(sandbox.ask("GET", "/readyz")[0], 200)
            health = sandbox.inside(str(self.tree / "usr/local/bin/qdot"), "health")
            self.assertEqual(health.returncode, 0, health.stderr)
            self.assertIn("CapEff:\t0000000000000000", pathlib.Path(f"/proc/{sandbox.pid}/status").read_text())
        finally:
            os.kill(sandbox.pid, signal.SIGTERM)
            sandbox.process.communicate(timeout=30)
        self.assertEqual(sandbox.process.returncode, 0)


if __name__ == "__main__":
    unittest.main()
