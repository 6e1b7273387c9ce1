#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Spoils files of cases that run, and judges what the programs do then.

    fuzzer.py [-seed N] [-n 1000] [-workers 2] [-only SITUATION] [-keep FOLDER]

What is right: exit status 0 and files without NaN, or exit status 1 and a
message that names the file or the entry that was spoilt. No signal, no run
without end, nothing written when refused. Exit status 1 if there are faults.
"""

import argparse
import collections
import concurrent.futures
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time

import numpy as np

import fuzzCases
from fuzzCases import SITUATIONS
from foamCase import FoamCase, environment, read_vectors
from mutations import mutate

TIMEOUT = 240
SIGNAL = re.compile(
    r"exited on signal|sigFpe|sigSegv|terminate called|"
    r"Signal: |Traceback \(most recent|Caught exception"
)
ERROR = re.compile(
    r"FOAM FATAL|^Failed: |^Error|^morphStudy|error:", re.MULTILINE
)
NOT_A_NUMBER = re.compile(rb"(?<![\w/])-?(nan|inf)(?![\w])", re.IGNORECASE)


class Trial:
    """One mutation: what was spoilt, what was run, what is wrong about it."""

    def __init__(self, number, seed):
        self.number = number
        self.seed = seed
        self.fault = ""
        self.foreign = ""


class Templates:
    """The cases, made once, serial and decomposed, with what they give."""

    def __init__(self, folder, names, needs_ranks):
        self.folder = pathlib.Path(folder)
        self.expected = {}
        self.words = {}
        for name in names:
            self.make(name, needs_ranks)

    def path(self, name, ranks):
        return self.folder / f"{name}.{ranks}".replace(" ", "_")

    def make(self, name, needs_ranks):
        situation = SITUATIONS[name]
        whole = self.path(name, 1)
        situation.make(whole)
        # It has to run before anything is spoilt
        run = copy(whole, self.folder / "trial")
        FoamCase(run).run(*situation.command)
        if situation.moved:
            self.expected[name] = read_vectors(run / situation.moved)
        shutil.rmtree(run)
        if needs_ranks and 2 in situation.ranks:
            parts = FoamCase(copy(whole, self.path(name, 2)))
            parts.decompose(
                (2, 1, 1), *(["-latestTime"] if "restart" in name else [])
            )


def copy(source, target):
    shutil.copytree(source, target, symlinks=True)
    return target


def spoilt_file(case, file, ranks, rng):
    """On two ranks files of a rank lie in its folder."""
    if (
        ranks > 1
        and not file.startswith("constant/")
        or ranks > 1
        and "polyMesh" in file
    ):
        part = case / f"processor{rng.randrange(ranks)}" / file
        if "uniform" in file:
            part = case / "processor0" / file
        return part
    return case / file


def execute(case, command, ranks):
    """Exit status and output; status None if it does not end."""
    words = [str(w) for w in command]
    if ranks > 1:
        words = [
            "mpirun",
            "--oversubscribe",
            "-np",
            str(ranks),
            *words,
            "-parallel",
        ]
    process = subprocess.Popen(
        words,
        cwd=case,
        env={
            **environment(),
            "PWD": str(case),
            "OMPI_MCA_mpi_yield_when_idle": "1",
        },
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        start_new_session=True,
    )
    try:
        output, _ = process.communicate(timeout=TIMEOUT)
        return process.returncode, output.decode(errors="replace")
    except subprocess.TimeoutExpired:
        import os
        import signal

        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return None, ""


def written_nan(case, before):
    """The first file that the run wrote and that has no number in it."""
    for path in sorted(case.rglob("*")):
        # A histogram has a class without an upper bound, base64 has words, and
        # OpenFOAM shows where faces of two ranks do not match
        if (
            not path.is_file()
            or path.name == "histogram.dat"
            or path.suffix == ".vtp"
            or path.name.startswith("procBound")
        ):
            continue
        stat = path.stat()
        if before.get(str(path)) == (stat.st_mtime_ns, stat.st_size):
            continue
        if NOT_A_NUMBER.search(path.read_bytes()):
            return str(path.relative_to(case))
    return ""


def snapshot(case):
    return {
        str(path): (path.stat().st_mtime_ns, path.stat().st_size)
        for path in case.rglob("*")
        if path.is_file()
    }


def foreign(situation, output, change):
    """What OpenFOAM itself does before any code of ours is called."""
    program = situation.command[0]
    if "Unknown solver type" in output:
        return "OpenFOAM"
    ours = (
        "Selecting motion solver" in output
        and "motionSolverLibs" not in change
    )
    return "" if program != "moveDynamicMesh" or ours else "OpenFOAM"


def named(output, path, change):
    """Does the message name the file, or an entry of what was changed?"""
    error = output[ERROR.search(output).start() :]
    if "file: IOstream" in error:
        return False
    if path.name in error or path.stem in error:
        return True
    # Files of a mesh belong together: which one is wrong cannot always be told
    if path.parent.name == "polyMesh" and "polyMesh" in error:
        return True
    if (
        "Failed: the moved mesh would be invalid" in error
        or "makes the mesh invalid" in error
    ):
        return True
    if any(place in error for place in re.findall(r"\([-\d. e]+\)", change)):
        return True
    # A point elsewhere is a fault of no file: of the group that cannot be there
    if path.name == "points" and "dynamicMeshDict" in error:
        return True
    words = set(re.findall(r"[A-Za-z]{3,}", change)) - {
        "line",
        "whole",
        "file",
    }
    if path.suffix == ".yaml":
        # The one file of a study: a key that it has or lacks is enough
        words |= set(re.findall(r"[A-Za-z]{3,}", fuzzCases.STUDY))
    return any(re.search(rf"\b{word}\b", error) for word in words)


def judge(trial, case, path, before, status, output, expected):
    situation = SITUATIONS[trial.situation]
    if status is None:
        return f"does not end within {TIMEOUT} s"
    if SIGNAL.search(output) or status not in (0, 1):
        first = SIGNAL.search(output)
        return f"exit status {status}" + (
            f": {first.group()}" if first else ""
        )
    nan = written_nan(case, before)
    if nan:
        return f"NaN or infinity written to {nan}"
    if status == 1:
        if not ERROR.search(output):
            return "exit status 1 without a message"
        if not named(output, path, trial.change):
            return "the message does not name what is wrong"
        changed = [
            p
            for p, s in snapshot(case).items()
            if p.endswith("/points") and before.get(p) != s
        ]
        return f"refused, but wrote {changed[0]}" if changed else ""
    if expected is not None:
        moved = (
            FoamCase(case).decomposed_points(situation.moved)
            if trial.ranks > 1
            else read_vectors(case / situation.moved)
        )
        off = np.abs(moved - expected).max()
        if off > 1e-5:
            return f"accepted, but the mesh is off by {off:.2g}"
    return ""


def run_trial(number, seed, templates, names, serial, keep):
    rng = random.Random(f"{seed}:{number}")
    trial = Trial(number, seed)
    weights = [SITUATIONS[name].weight for name in names]
    trial.situation = rng.choices(names, weights)[0]
    situation = SITUATIONS[trial.situation]
    two = not serial and 2 in situation.ranks and rng.random() < 0.25
    trial.ranks = 2 if two else 1
    folder = pathlib.Path(tempfile.mkdtemp(dir=templates.folder))
    case = copy(templates.path(trial.situation, trial.ranks), folder / "case")
    file = rng.choice(situation.files)
    path = spoilt_file(case, file, trial.ranks, rng)
    trial.mistake, trial.change = mutate(path, rng, situation.kinds)
    trial.file = str(path.relative_to(case))
    before = snapshot(case)
    status, output = execute(case, situation.command, trial.ranks)
    trial.status = status
    try:
        trial.fault = judge(
            trial,
            case,
            path,
            before,
            status,
            output,
            templates.expected.get(trial.situation),
        )
    except (AssertionError, ValueError, OSError, AttributeError) as wrong:
        trial.fault = f"accepted, and wrote what cannot be read: {wrong}"[:200]
    if trial.fault:
        trial.foreign = foreign(situation, output, trial.change)
        if trial.foreign:
            trial.fault = ""
    if trial.fault and keep:
        target = pathlib.Path(keep) / f"{seed}.{number}"
        shutil.rmtree(target, ignore_errors=True)
        shutil.copytree(case, target)
        (target / "log.fuzz").write_text(output)
    shutil.rmtree(folder, ignore_errors=True)
    return trial


def table(trials, seconds):
    """A row for each situation and number of ranks."""
    rows = [
        "| situation | ranks | mutations | ran | refused | stopped by"
        " OpenFOAM itself | faults |",
        "|---|---|---|---|---|---|---|",
    ]
    keys = sorted({(t.situation, t.ranks) for t in trials})
    total = collections.Counter()
    for situation, ranks in keys:
        those = [
            t for t in trials if (t.situation, t.ranks) == (situation, ranks)
        ]
        n = collections.Counter(
            mutations=len(those),
            ran=sum(t.status == 0 for t in those),
            refused=sum(t.status == 1 for t in those),
            foreign=sum(bool(t.foreign) for t in those),
            faults=sum(bool(t.fault) for t in those),
        )
        total += n
        rows.append(row(situation, ranks, n))
    rows.append(row("**all**", "", total))
    return "\n".join(rows) + f"\n\n{seconds:.0f} s.\n"


def row(name, ranks, n):
    return (
        f"| {name} | {ranks} | {n['mutations']} | {n['ran']} |"
        f" {n['refused']} | {n['foreign']} | {n['faults']} |"
    )


def fuzz(seed, n, workers=2, only=None, keep=None, serial=False):
    """Run n mutations; returns the trials and the seconds they took."""
    names = [name for name in SITUATIONS if not only or only in name]
    start = time.time()
    base = "/dev/shm" if pathlib.Path("/dev/shm").is_dir() else None
    with tempfile.TemporaryDirectory(
        prefix="morphFoamFuzz", dir=base
    ) as folder:
        templates = Templates(folder, names, not serial)
        with concurrent.futures.ThreadPoolExecutor(workers) as pool:
            runs = [
                pool.submit(run_trial, i, seed, templates, names, serial, keep)
                for i in range(n)
            ]
            trials = []
            for done in concurrent.futures.as_completed(runs):
                trial = done.result()
                trials.append(trial)
                if trial.fault:
                    print(
                        f"FAULT {seed}:{trial.number} {trial.situation},"
                        f" {trial.ranks} ranks, {trial.file},"
                        f" {trial.mistake}: {trial.fault}\n"
                        f"      {trial.change}",
                        flush=True,
                    )
    trials.sort(key=lambda t: t.number)
    return trials, time.time() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-seed", type=int, default=1)
    parser.add_argument("-n", type=int, default=1000)
    parser.add_argument("-workers", type=int, default=2)
    parser.add_argument("-only", help="situations with this in their name")
    parser.add_argument("-keep", help="folder for the cases of faults")
    parser.add_argument("-serial", action="store_true", help="one rank alone")
    parser.add_argument("-table", help="file to write the table of results to")
    args = parser.parse_args()
    trials, seconds = fuzz(
        args.seed, args.n, args.workers, args.only, args.keep, args.serial
    )
    text = f"Seed {args.seed}, {args.n} mutations\n\n" + table(trials, seconds)
    print("\n" + text)
    if args.table:
        pathlib.Path(args.table).write_text(text)
    return any(t.fault for t in trials)


if __name__ == "__main__":
    sys.exit(main())
