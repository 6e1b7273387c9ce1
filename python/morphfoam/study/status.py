# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The verb status: how far each strategy is."""

import os

from . import designs, failures, outcomes, results, sweep


def status(study, cores=None):
    table = designs.read(study)
    at_once = max(1, (cores or len(os.sched_getaffinity(0))) // study.cores)
    print(f"{len(table)} designs in {study.folder}")
    if study.baseline_steps is not None:
        outcome = outcomes.read(study, outcomes.BASELINE)
        print(
            "baseline: "
            + (sweep.describe(outcome) if outcome else "not finished")
        )
    for strategy in study.strategies:
        found = [outcomes.read(study, strategy, d.number) for d in table]
        finished = [o for o in found if o]
        failed = [o for o in finished if not outcomes.is_done(o)]
        waiting = len(found) - len(finished)
        line = (
            f"{strategy}: {len(finished) - len(failed)} done,"
            f" {len(failed)} failed, {waiting} not finished"
        )
        if finished and waiting:
            times = [o.seconds for o in finished]
            line += (
                "; some "
                + sweep.duration(sweep.time_left(times, waiting, at_once))
                + f" on {at_once*study.cores} cores"
            )
        print(line)
        for group in failures.groups(failed):
            print(f"    {group}")
        if finished:
            print(f"    {results.write(study, strategy)}")
