# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A cluster of Slurm on this machine: a controller and nodes of one processor
each, with files, ports and a key of their own.

    with SlurmCluster(folder) as cluster:       # folder: short and not shared
        subprocess.run(["sbatch", ...], env=cluster.environment)
        cluster.kill("n1")
        cluster.start("n1")
"""

import getpass
import os
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "scancel")

CONF = """
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
SlurmctldPort={ports[0]}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool.%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.%n.pid
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SlurmdParameters=config_overrides
MpiDefault=none
SwitchType=switch/none
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
KillWait=2
SlurmdTimeout=5
{settings}
"""


def missing():
    """The programs that are not installed."""
    path = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
    return [name for name in PROGRAMS if not shutil.which(name, path=path)]


def free_ports(n):
    sockets = [socket.socket() for _ in range(n)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


class SlurmCluster:
    def __init__(self, folder, nodes=("n1", "n2"), settings=""):
        self.folder, self.nodes = Path(folder), nodes
        self.processes = {}
        host = socket.gethostname()
        ports = free_ports(1 + len(nodes))
        (self.folder / "state").mkdir(parents=True)
        text = CONF.format(
            host=host,
            user=getpass.getuser(),
            ports=ports,
            folder=folder,
            settings=settings,
        )
        for node, port in zip(nodes, ports[1:]):
            (self.folder / f"spool.{node}").mkdir()
            text += (
                f"NodeName={node} NodeHostname={host} NodeAddr=127.0.0.1"
                f" Port={port} CPUs=1\n"
            )
        names = ",".join(nodes)
        text += (
            f"PartitionName=main Nodes={names} Default=YES State=UP"
            " PriorityTier=1\n"
            f"PartitionName=urgent Nodes={names} State=UP PriorityTier=2\n"
        )
        self.conf = self.folder / "slurm.conf"
        self.conf.write_text(text)
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o600)
        self.environment = {
            **os.environ,
            "SLURM_CONF": str(self.conf),
            "PATH": os.environ["PATH"] + ":/usr/sbin:/sbin",
        }

    def _launch(self, name, *command):
        with (self.folder / f"{name}.log").open("a") as log:
            self.processes[name] = subprocess.Popen(
                command,
                env=self.environment,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    def _wait(self, condition, what):
        end = time.monotonic() + 60
        while not condition():
            assert time.monotonic() < end, (
                what
                + "\n"
                + "\n".join(
                    p.read_text()[-1500:] for p in self.folder.glob("*.log")
                )
            )
            time.sleep(0.1)

    def __enter__(self):
        self._launch(
            "munged",
            "munged",
            "--foreground",
            "--force",
            f"--socket={self.folder}/munge.socket",
            f"--key-file={self.folder}/munge.key",
            f"--pid-file={self.folder}/munged.pid",
            f"--seed-file={self.folder}/munged.seed",
            f"--log-file={self.folder}/munged.log",
        )
        self._wait((self.folder / "munge.socket").exists, "munged")
        self._launch("slurmctld", "slurmctld", "-D", "-f", self.conf)
        for node in self.nodes:
            self.start(node)
        self._wait(
            lambda: all(self.state(n).startswith("IDLE") for n in self.nodes),
            "nodes are not idle",
        )
        return self

    def __exit__(self, *_):
        for node in self.nodes:
            self.kill(node)
        for process in self.processes.values():
            process.kill()
            process.wait()

    def ask(self, *command):
        return subprocess.run(
            command,
            env=self.environment,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        ).stdout

    def state(self, node):
        told = self.ask("scontrol", "-o", "show", "node", node)
        return told.partition("State=")[2].partition(" ")[0]

    def hasten(self):
        """Jobs put back into the queue wait for two minutes otherwise."""
        for line in self.ask("squeue", "--noheader", "-o", "%i %r").split(
            "\n"
        ):
            number, _, reason = line.partition(" ")
            if reason == "BeginTime":
                self.ask(
                    "scontrol", "update", f"JobId={number}", "StartTime=now"
                )

    def start(self, node):
        self._launch(node, "slurmd", "-D", "-N", node, "-f", self.conf)

    def kill(self, node):
        """The node with all that runs on it, as when its power fails."""
        self.processes[node].kill()
        self.processes[node].wait()
        for entry in Path("/proc").iterdir():
            try:
                text = (entry / "environ").read_bytes()
                line = (entry / "cmdline").read_bytes()
            except OSError:
                continue
            mine = f"SLURM_CONF={self.conf}".encode() in text
            if mine and (
                f"SLURMD_NODENAME={node}\0".encode() in text
                or b"slurmstepd" in line
                and f"SLURMD_NODENAME={node}".encode() in text
            ):
                try:
                    os.kill(int(entry.name), signal.SIGKILL)
                except OSError:
                    pass
