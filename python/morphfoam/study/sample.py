# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The verb sample: adds the designs that the study file asks for."""

from . import check, designs, sampling, sweep


def sample(study):
    check.check(study, quiet=True)
    with sweep.only_one(study):
        # Verifications of optima are no part of the sampling
        table = [d for d in designs.read(study) if d.origin == designs.SAMPLED]
        points = sampling.sample(study, designs.points(study, table))
        added = designs.add(study, points, designs.SAMPLED)
    print(
        f"{len(added)} designs added to {len(table)}:"
        f" {designs.path(study)}"
    )
    if len(added) and len(table) + len(added) > 1:
        distance = sampling.smallest_distance(
            study, designs.points(study, [*table, *added])
        )
        print(
            f"smallest distance of two designs: {distance:.3g} of the bounds"
        )
    return added
