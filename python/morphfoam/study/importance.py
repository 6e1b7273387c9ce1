# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The verb importance: which parameters a descent owes its gain to, what it
reaches with few of them, and indices of the metamodel where there is one."""

import copy
import dataclasses

import numpy as np

from morphfoam.optimisation import influence

from . import descend, fit, plots
from .errors import StudyError
from .report import read_table

# Designs per parameter from which a metamodel's indices say something
DENSE = 3


def importance(study, strategy=None, counts=(), cores=None, profile=None):
    """Returns the exit status. counts: of parameters with which to descend
    again, those that matter most."""
    if study.descend is None:
        raise StudyError(
            "importance needs a descent: the study file has no descend. Add"
            " for example 'descend: {objective: {drag: minimise}}', then say"
            " 'morphStudy descend' first"
        )
    strategy = strategy or next(iter(study.strategies))
    check_counts(study, counts)
    path = study.folder / f"importance.{strategy}"
    path.mkdir(parents=True, exist_ok=True)
    rows, subspace = rank(study, strategy)
    add_indices(study, strategy, rows)
    descend.write_table(path / "parameters.csv", list(rows[0]), rows)
    descend.write_table(
        path / "activeSubspace.csv", list(subspace[0]), subspace
    )
    say(rows, subspace)
    names = [row["parameter"] for row in rows]
    if counts:
        eliminate(study, strategy, path, names, counts, cores, profile)
    table = path / "elimination.csv"
    plots.importance(
        rows,
        read_table(table) if table.exists() else [],
        study.descend.objective,
        path / "importance.png",
    )
    print(path / "importance.png")
    return 0


def check_counts(study, counts):
    most = len(study.descend.parameters)
    for count in counts:
        if not 1 <= count <= most:
            raise StudyError(
                f"-counts {count}: the descent has {most} parameters; give"
                f" numbers from 1 to {most}"
            )


def taken_path(study, strategy):
    """Of the best start: its points in parts of the bounds, and the gradients
    of objective and Lagrangian there."""
    folder = descend.folder(study, strategy)
    if not (folder / "gradients.csv").exists():
        raise StudyError(
            f"there is no {folder/'gradients.csv'} yet. Say 'morphStudy"
            f" descend {study.path.name}' first"
        )
    names = study.descend.parameters
    best = read_table(folder / "optima.csv")[0]["start"]

    def rows(table, **wanted):
        return np.array(
            [
                [float(r[n]) for n in names]
                for r in read_table(folder / table)
                if r["start"] == best
                and all(r[k] == v for k, v in wanted.items())
            ]
        ).reshape(-1, len(names))

    at = [study.names.index(n) for n in names]
    points = rows("history.csv", taken="yes")
    points = (points - study.lows[at]) / (study.highs - study.lows)[at]
    objective = rows("gradients.csv", of="objective")
    lagrangian = rows("gradients.csv", of="lagrangian")
    if len(points) < 2:
        raise StudyError(
            "the descent took no step, so that no parameter contributed to it"
        )
    return points, objective, lagrangian


def rank(study, strategy):
    """Rows of the parameters, those first to which the descent owes most, and
    of the active subspace. What a parameter gives is what it adds to the
    change of the Lagrangian: so a parameter that pays for a constraint, which
    others then use, has its part."""
    points, objective, lagrangian = taken_path(study, strategy)
    given = influence.contributions(points, lagrangian)
    alone = influence.contributions(points, objective)
    values, vectors, activity = influence.active_subspace(objective)
    names = study.descend.parameters
    scale = given.sum() or 1.0
    rows = [
        {
            "parameter": names[j],
            "share": given[j] / scale,
            "contribution": alone[j],
            "meanSquaredDerivative": activity[j],
            "first direction": vectors[j, 0],
        }
        for j in np.argsort(-given / scale)
    ]
    subspace = [
        {
            "direction": k + 1,
            "eigenvalue": values[k],
            "share": values[k] / values.sum(),
            **dict(zip(names, vectors[:, k])),
        }
        for k in range(min(len(points), len(values)))
    ]
    return rows, subspace


def add_indices(study, strategy, rows):
    """Sobol indices of the objective's metamodel, where there are designs
    enough all over the bounds."""
    sampled = [
        pair
        for pair in fit.finished(study, strategy)
        if pair[0].origin == "sample"
    ]
    if len(sampled) < DENSE * len(study.names):
        print(
            f"No Sobol indices: {len(sampled)} sampled designs are finished,"
            f" and a metamodel of {len(study.names)} parameters wants"
            f" {DENSE*len(study.names)} or more"
        )
        return
    only = copy.copy(study)
    only.fitted = [study.descend.objective]
    model = fit.models(only, strategy)[study.descend.objective]
    first, total = influence.total_indices(model, study.lows, study.highs)
    print(f"Sobol indices of a metamodel with Q2 {model.q2:.3f}")
    for row in rows:
        j = study.names.index(row["parameter"])
        row["sobol"], row["sobolTotal"] = float(first[j]), float(total[j])


def eliminate(study, strategy, path, names, counts, cores, profile):
    """Descend again with the first few parameters; those left out stay at the
    baseline. Designs are shared with all other descents."""
    folder = descend.folder(study, strategy)
    rows = [reached(study, folder, len(names), names)]
    for count in sorted(counts, reverse=True):
        if count == len(names):
            continue
        few = copy.copy(study)
        few.descend = dataclasses.replace(
            study.descend,
            parameters=[n for n in study.names if n in names[:count]],
            suffix=f".{count}",
            starts=1,
        )
        print(f"with {count} parameters: {' '.join(names[:count])}")
        descend.descend(few, strategy, cores, profile)
        rows.append(
            reached(few, descend.folder(few, strategy), count, names[:count])
        )
        whole = rows[0]["gain"] or 1.0
        for row in rows:
            row["part"] = row["gain"] / whole
        descend.write_table(path / "elimination.csv", list(rows[0]), rows)
    for row in rows:
        print(
            f"{row['parameters']} parameters: {row['objective']:.6g},"
            f" {100*row['gain']:.1f} % better, {row['runs']} runs"
        )


def reached(study, folder, count, names):
    """What a descent reached, as a row."""
    history = read_table(folder / "history.csv")
    name = study.descend.objective
    best = read_table(folder / "optima.csv")[0]
    first = float(history[0][name])
    value = float(best[name])
    return {
        "parameters": count,
        "objective": value,
        "gain": study.descend.sense * (value - first) / (abs(first) or 1.0),
        "part": 1.0,
        "missed": float(best["missed"]),
        "runs": int(best["runs"]),
        "which": " ".join(names),
    }


def say(rows, subspace):
    total = 0
    for row in rows:
        total += row["share"]
        print(
            f"{row['parameter']}: {100*row['share']:.1f} % of the gain,"
            f" {100*total:.1f} % with those above"
        )
    print(
        "active subspace: the first direction has"
        f" {100*subspace[0]['share']:.0f} % of the squared gradient"
    )
