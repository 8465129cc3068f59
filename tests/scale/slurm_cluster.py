"""A Slurm cluster of three nodes on this machine: a controller, and a daemon a node in a process namespace of its own."""

import os
import pathlib
import shutil
import socket
import subprocess
import time

from ports import free_ports

PROGRAMS = ("slurmctld", "slurmd", "sbatch", "squeue", "sinfo", "munged", "unshare", "runuser")
NODES = ("n1", "n2", "n3")
# No control groups and no accounting; and what is lost is missed soon.
CONFIGURATION = """
ClusterName=qdot
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={directory}/munge/munge.socket,cred_expire=5
StateSaveLocation={directory}/state
SlurmdSpoolDir={directory}/spool.%n
SlurmctldPidFile={directory}/slurmctld.pid
SlurmdPidFile={directory}/slurmd.%n.pid
SlurmctldLogFile={directory}/slurmctld.log
SlurmdLogFile={directory}/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=2,bf_interval=2
SlurmdTimeout=5
MessageTimeout=3
KillWait=2
ReturnToService=2
{nodes}
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE
"""


def why_not():
    """Why there can be no cluster here; empty where there can."""
    missing = [program for program in PROGRAMS if shutil.which(program) is None]
    if missing:
        return f"{', '.join(missing)} not installed: run server/install scale"
    if os.geteuid() != 0:
        return "several nodes on one machine need root"
    spaces = subprocess.run(["unshare", "--pid", "--fork", "--mount-proc", "true"], capture_output=True, check=False)
    return "" if spaces.returncode == 0 else "this machine gives no process namespaces"


def run(*command, **options):
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(command)}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}")
    return done.stdout.strip()


class Cluster:
    """`with Cluster(directory) as cluster:` has three idle nodes; leaving it ends all that it has started."""

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)
        self.environment = {**os.environ, "SLURM_CONF": str(self.directory / "slurm.conf")}
        self.processes = {}

    def __enter__(self):
        try:
            self.write_configuration()
            self.start_munge()
            self.start("slurmctld", "slurmctld", "-D")
            for node in NODES:
                # The namespace ends with its first process, and so does all that runs in it: a node that loses its power.
                self.start(node, "unshare", "--pid", "--fork", "--mount-proc", "--kill-child", "slurmd", "-D", "-N", node)
            self.wait_for(lambda: self.ask("sinfo", "-h", "-t", "idle", "-o", "%D") == "3", 60, "three idle nodes")
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for name in reversed(list(self.processes)):
            self.lose(name)

    def write_configuration(self):
        ports = free_ports(1 + len(NODES))
        host = socket.gethostname().split(".")[0]
        nodes = "\n".join(f"NodeName={node} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs=1"
                          for node, port in zip(NODES, ports[1:]))
        (self.directory / "slurm.conf").write_text(
            CONFIGURATION.format(host=host, ports=ports, directory=self.directory, nodes=nodes))
        for name in ("state", *(f"spool.{node}" for node in NODES)):
            (self.directory / name).mkdir()

    def start_munge(self):
        home = self.directory / "munge"
        home.mkdir(mode=0o755)
        (home / "key").write_bytes(os.urandom(128))
        (home / "key").chmod(0o400)
        for place in (home, home / "key"):
            shutil.chown(place, "munge", "munge")
        self.start("munged", "runuser", "-u", "munge", "--", "munged", "--foreground", f"--key-file={home}/key",
                   f"--socket={home}/munge.socket", f"--pid-file={home}/munged.pid", f"--log-file={home}/munged.log",
                   f"--seed-file={home}/seed")
        self.wait_for((home / "munge.socket").exists, 30, "munge's socket")

    def start(self, name, *command):
        with open(self.directory / f"{name}.out", "w", encoding="utf-8") as log:
            self.processes[name] = subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=log,
                                                    stderr=log, start_new_session=True)

    def lose(self, name):
        """As when its power fails, with all that runs there."""
        process = self.processes.pop(name)
        if name == "munged":
            process.terminate()  # runuser passes it on
        else:
            process.kill()
        process.wait(30)

    def ask(self, *command):
        done = subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False, timeout=60)
        return done.stdout.strip() if done.returncode == 0 else None  # the controller may not be there yet

    def submit(self, directory, *words, **environment):
        """The number of the job."""
        return run("sbatch", "--parsable", *words, cwd=directory, env={**self.environment, **environment})

    def wait_for(self, reached, seconds, what):
        end = time.monotonic() + seconds
        while not reached():
            if time.monotonic() > end:
                logs = "\n".join(f"{log.name}:\n{log.read_text(errors='replace')[-1500:]}" for log in self.directory.glob("*.log"))
                raise AssertionError(f"no {what} after {seconds} s\n{logs}")
            time.sleep(0.1)
