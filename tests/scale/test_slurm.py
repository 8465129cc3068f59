"""Slurm spreads a file of requests over three nodes, one of which is lost in the middle: each answer is there, once."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "server"))

import one_machine  # noqa: E402
import slurm_cluster  # noqa: E402
from running_qdot import QDOT  # noqa: E402

JOB = pathlib.Path(__file__).with_name("slurm_array.sh")
SLICES, LINES = 6, 240


@unittest.skipIf(slurm_cluster.why_not(), slurm_cluster.why_not())
class Slurm(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.home = pathlib.Path(temporary.name)
        self.home.chmod(0o755)  # munge's user looks into it
        self.work = self.home / "work"
        self.work.mkdir()
        one_machine.write_motions(self.work / "requests.ndjson", LINES, t_end=1500)
        subprocess.run(["split", "-d", "-a", "3", "-n", f"l/{SLICES}", "requests.ndjson", "in."], cwd=self.work, check=True)

    def slice_in_the_middle(self, cluster, job, node):
        """A file that a task on the node has begun to write."""
        running = cluster.ask("squeue", "-h", "-r", "-j", job, "-t", "running", "-w", node, "-o", "%K") or ""
        for task in running.split():
            for part in self.work.glob(f"part.{int(task):03d}.*"):
                if part.stat().st_size > 0:
                    return part
        return None

    def test_a_node_is_lost_and_nothing_else(self):
        found = []
        with slurm_cluster.Cluster(self.home) as cluster:
            job = cluster.submit(self.work, f"--array=0-{SLICES - 1}", str(JOB), QDOT=QDOT)
            cluster.wait_for(lambda: found or found.extend(filter(None, [self.slice_in_the_middle(cluster, job, "n2")])),
                             60, "slice in the middle on n2")
            cluster.lose("n2")
            self.assertFalse((self.work / ("out." + found[0].name.split(".")[1])).exists(), "it was done already")
            cluster.wait_for(lambda: cluster.ask("squeue", "-h", "-j", job) == "", 240, "end of the job")
        self.assertEqual(self.put_together(), 0)
        self.assertEqual((self.work / "answers.ndjson").read_bytes(), one_machine.answers(self.work / "requests.ndjson"))
        self.assertTrue(found[0].exists(), "what the lost node had begun was taken for whole")
        (self.work / "out.003").unlink()
        self.assertNotEqual(self.put_together(), 0, "a slice is missing")

    def put_together(self):
        """As the job's file says."""
        recipe = re.search(r"cat \$\(.*\) > answers.ndjson", JOB.read_text()).group()
        return subprocess.run(["sh", "-c", recipe], cwd=self.work, stderr=subprocess.DEVNULL, check=False).returncode


if __name__ == "__main__":
    unittest.main()
