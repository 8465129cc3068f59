"""The README's manifests: what would read them refuses nothing, refuses a misspelling, and their probes are answered.

Compose's own program reads the one. For Kubernetes there is no cluster here: TypeScript holds the other against the types
that are generated from Kubernetes' schema, which refuse unknown keys as a cluster does.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests" / "server"))

from running_qdot import RunningQdot  # noqa: E402

NPM = ROOT / "build" / "npm"
COMPOSE, KUBERNETES = re.findall(r"^```yaml\n(.*?)^```$", (ROOT / "README.md").read_text(), re.MULTILINE | re.DOTALL)
TYPES = {"Deployment": "kubernetes-types/apps/v1", "Service": "kubernetes-types/core/v1"}
DRAIN = 10  # seconds that qdot may take to finish what is in flight


def keys_of(tree):
    """Each key that is a word of the schema and not a name of ours."""
    if isinstance(tree, list):
        for part in tree:
            yield from keys_of(part)
    if isinstance(tree, dict):
        for key, part in tree.items():
            yield key
            if key not in ("environment", "matchLabels", "labels", "limits", "requests", "services", "selector"):
                yield from keys_of(part)


def misspelt(tree, word):
    if isinstance(tree, list):
        return [misspelt(part, word) for part in tree]
    if not isinstance(tree, dict):
        return tree
    return {key + "x" if key == word else key: misspelt(part, word) for key, part in tree.items()}


class Compose(unittest.TestCase):
    def setUp(self):
        if shutil.which("docker-compose") is None:
            self.skipTest("docker-compose not installed: run server/install scale")

    def complaints(self, manifest):
        with tempfile.TemporaryDirectory() as directory:
            path = pathlib.Path(directory) / "compose.yaml"
            path.write_text(manifest)
            return subprocess.run(["docker-compose", "-f", path, "config", "--quiet"], capture_output=True, text=True,
                                  check=False).stderr

    def test_it_is_read(self):
        self.assertEqual(self.complaints(COMPOSE), "")

    def test_misspellings_are_refused(self):
        tree = yaml.safe_load(COMPOSE)
        for word in sorted(set(keys_of(tree["services"]["qdot"]))):
            with self.subTest(word=word):
                self.assertIn(word + "x", self.complaints(yaml.safe_dump(misspelt(tree, word))))


class Kubernetes(unittest.TestCase):
    def setUp(self):
        for package in ("typescript", "scale/node_modules/kubernetes-types"):
            place = NPM / package if "/" in package else NPM / "node_modules" / package
            if not place.exists():
                self.skipTest(f"{place.name} not installed: run server/install test scale")

    def complaints(self, trees):
        """Of all together: the compiler takes seconds to start."""
        lines = [f'import type {{ {kind} }} from "{place}"' for kind, place in TYPES.items()]
        lines += [f'export const tree_{number}: {tree["kind"]} = {json.dumps(tree)}' for number, tree in enumerate(trees)]
        with tempfile.TemporaryDirectory(dir=NPM / "scale") as directory:
            (pathlib.Path(directory) / "manifests.ts").write_text("\n".join(lines))
            compiler = NPM / "node_modules" / "typescript" / "bin" / "tsc"
            options = ("--noEmit", "--strict", "--module", "esnext", "--moduleResolution", "bundler")
            done = subprocess.run(["node", compiler, *options, "manifests.ts"], cwd=directory, capture_output=True, text=True,
                                  check=False)
        return done.stdout

    def test_they_fit_the_schema(self):
        self.assertEqual(self.complaints(list(yaml.safe_load_all(KUBERNETES))), "")

    def test_misspellings_are_refused(self):
        trees, words = [], []
        for tree in yaml.safe_load_all(KUBERNETES):
            for word in sorted(set(keys_of(tree)) - {"kind"}):
                trees.append(misspelt(tree, word))
                words.append(word)
        self.assertGreater(len(words), 40)
        complaints = self.complaints(trees)
        lines = {int(number) for number in re.findall(r"^manifests.ts\((\d+),", complaints, re.MULTILINE)}
        accepted = [word for number, word in enumerate(words, len(TYPES) + 1) if number not in lines]
        self.assertEqual(accepted, [])


class Promises(unittest.TestCase):
    """What the manifest says of qdot is so."""

    def setUp(self):
        self.pod = yaml.safe_load(KUBERNETES.split("---")[0])["spec"]["template"]["spec"]
        self.container, = self.pod["containers"]
        self.environment = {entry["name"]: entry["value"] for entry in self.container["env"]}

    def test_probes_are_answered_as_the_kubelet_asks_them(self):
        # In the image it listens on all addresses; Host is the one that the probe names.
        with RunningQdot(QDOT_HOST="0.0.0.0", **self.environment) as server:
            for name in ("readinessProbe", "livenessProbe"):
                probe = self.container[name]["httpGet"]
                headers = {header["name"]: header["value"] for header in probe["httpHeaders"]}
                self.assertEqual(server.request("GET", probe["path"], headers=headers).status, 200)
                self.assertEqual(server.request("GET", probe["path"], headers={"Host": "elsewhere"}).status, 421)

    def test_the_service_reaches_it_by_its_name(self):
        service = yaml.safe_load(KUBERNETES.split("---")[1])
        with RunningQdot(**self.environment) as server:
            answer = server.request("GET", "/v1/modes?system=cart_pendulum", headers={"Host": service["metadata"]["name"]})
            self.assertEqual(answer.status, 200)
        self.assertEqual(service["spec"]["ports"][0]["targetPort"], self.container["ports"][0]["containerPort"])

    def test_the_variables_of_its_own_service_do_not_stop_it(self):
        service = yaml.safe_load(KUBERNETES.split("---")[1])
        name, (port,) = service["metadata"]["name"].upper(), service["spec"]["ports"]
        links = {f"{name}_PORT": f"tcp://10.96.0.12:{port['port']}"} if self.pod.get("enableServiceLinks", True) else {}
        with RunningQdot(**self.environment, **links, port=None if links else 0) as server:
            self.assertTrue(server.start_line)

    def test_there_is_time_to_finish(self):
        command, seconds = self.container["lifecycle"]["preStop"]["exec"]["command"]
        self.assertEqual(command, "sleep")
        # The endpoints of the service have heard of it by then, and what is in flight is finished before the kill.
        self.assertGreater(int(seconds), self.container["readinessProbe"]["periodSeconds"])
        self.assertGreater(self.pod["terminationGracePeriodSeconds"], int(seconds) + DRAIN)


if __name__ == "__main__":
    unittest.main()
