# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Outcomes as one table, results.<strategy>.csv."""

import csv

from . import designs, failures, outcomes


def rows(study, strategy, baseline=True):
    """One dictionary per finished design, the baseline's first."""
    found = []
    if baseline and study.baseline_steps is not None:
        found.append((outcomes.read(study, outcomes.BASELINE), "baseline"))
    for design in designs.read(study):
        found.append(
            (outcomes.read(study, strategy, design.number), design.origin)
        )
    return [row(study, o, origin) for o, origin in found if o]


def row(study, outcome, origin):
    quality = {f"mesh.{k}": v for k, v in outcome.quality.items()}
    return {
        "design": outcome.name,
        "origin": origin,
        "status": outcome.status,
        **outcome.parameters,
        **outcome.derived,
        **{name: outcome.responses.get(name, "") for name in study.responses},
        **{name: outcome.notes.get(name, "") for name in study.notes},
        "iterations": outcome.iterations,
        "time": round(outcome.seconds, 3),
        "cpuTime": round(sum(outcome.cpu.values()), 3),
        **{f"time.{k}": v for k, v in outcome.wall.items()},
        **{f"cpuTime.{k}": v for k, v in outcome.cpu.items()},
        **outcome.motion,
        **quality,
        "startedFrom": outcome.started_from,
        "attempts": outcome.attempts,
        "picture": outcome.picture,
        "reason": outcome.reason,
    }


def write(study, strategy):
    """The table; returns its path."""
    table = rows(study, strategy)
    columns = []
    for item in table:
        columns += [name for name in item if name not in columns]
    path = study.folder / f"results.{strategy}.csv"
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, columns, restval="")
        writer.writeheader()
        writer.writerows(table)
    return path


def conclude(study, strategy, chosen):
    """Write the table, say how it went; the exit status."""
    found = [outcomes.read(study, strategy, d.number) for d in chosen]
    failed = [o for o in found if o and not outcomes.is_done(o)]
    missing = sum(o is None for o in found)
    path = write(study, strategy)
    print(
        f"{strategy}: {len(found) - len(failed) - missing} done,"
        f" {len(failed)} failed, {missing} not finished; {path}"
    )
    for group in failures.groups(failed):
        print(f"    {group}")
    if missing:
        baseline = outcomes.read(study, outcomes.BASELINE)
        if baseline and not outcomes.is_done(baseline):
            print(
                f"Error: the baseline failed: {baseline.reason}\n    See"
                f" {outcomes.case(study, outcomes.BASELINE)}; corrected, the"
                " same command goes on"
            )
        else:
            print(
                f"Error: {last_error(study.folder/'snakemake.log')}\n    See"
                f" {study.folder/'snakemake.log'}; corrected, the same command"
                " goes on"
            )
    return 1 if missing else 0


def last_error(log):
    """What the workflow engine, or a worker, last complained of."""
    lines = (
        [
            line.strip()
            for line in log.read_text().splitlines()
            if "Error" in line
        ]
        if log.exists()
        else []
    )
    own = [line for line in lines if not line.startswith("Error in rule")]
    found = (own or lines or ["the workflow engine was ended"])[-1]
    return found.removeprefix("Error: ")
