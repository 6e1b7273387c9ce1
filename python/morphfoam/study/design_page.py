# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A page per design: what it is, its picture, how its run converged."""

import contextlib
import html
import os
import re

from . import outcomes, plots, responses
from .page import document, table

# Lines of OpenFOAM's solvers; the first of a field in an iteration counts
RESIDUAL = re.compile(r"Solving for (\S+), Initial residual = (\S+),")


def path(study, strategy, name):
    return study.folder / "pages" / strategy / f"{name}.html"


def residuals(study, step, log):
    """{field: [initial residual of each iteration]} of a log."""
    found, iteration, seen = {}, 0, set()
    tick = re.compile(study.iteration_regex)
    for line in log.read_text(errors="replace").splitlines():
        if tick.search(line):
            iteration += 1
            seen = set()
        match = RESIDUAL.search(line)
        if match and match[1] not in seen:
            seen.add(match[1])
            with contextlib.suppress(ValueError):
                found.setdefault(match[1], []).append(
                    (iteration, float(match[2]))
                )
    return found


def histories(study, case):
    """{response: [(count, value)]} of responses that a table or a log has more
    than one value of: forces, temperatures."""
    found = {}
    for name, response in study.responses.items():
        with contextlib.suppress(responses.ResponseError, OSError):
            values = responses.history(case, response)
            if len(values) > 1:
                found[name] = list(enumerate(values, 1))
    return found


def write(study, strategy, outcome):
    """The page of one design, unless it is there since the outcome; its path in
    the study's folder."""
    number = outcome.number
    page = path(study, strategy, outcome.name)
    source = outcomes.path(study, outcome.strategy, number)
    if page.exists() and page.stat().st_mtime >= source.stat().st_mtime:
        return page.relative_to(study.folder)
    page.parent.mkdir(parents=True, exist_ok=True)
    case = outcomes.case(study, outcome.strategy, number)
    title = f"{html.escape(study.path.stem)}: {strategy} {outcome.name}"
    parts = [
        f"<h1>{title}</h1>",
        f'<p><a href="{os.path.relpath(study.folder, page.parent)}'
        '/report.html">The study</a></p>',
        table([{"status": outcome.status, "reason": outcome.reason}]),
        table([{**outcome.parameters, **outcome.derived}]),
        table([{**outcome.responses, **outcome.notes}]),
        "<h2>Mesh</h2>",
        table([{**outcome.motion, **outcome.quality}]),
    ]
    if outcome.picture and (study.folder / outcome.picture).is_file():
        source = os.path.relpath(study.folder / outcome.picture, page.parent)
        parts.append(f'<p><img alt="picture" src="{html.escape(source)}"></p>')
    parts += convergence(study, outcome, case, page)
    parts += [
        "<h2>Steps</h2>",
        table(
            [
                {
                    "step": step,
                    "time [s]": wall,
                    "processor [s]": outcome.cpu.get(step, ""),
                }
                for step, wall in outcome.wall.items()
            ]
        ),
    ]
    page.write_text(document(title, parts))
    return page.relative_to(study.folder)


def convergence(study, outcome, case, page):
    """Residuals and responses over the iterations."""
    steps = list(outcome.wall)
    step = study.iteration_step or (steps[-1] if steps else None)
    log = case / f"log.{step}"
    found = residuals(study, step, log) if log.is_file() else {}
    values = histories(study, case)
    if not found and not values:
        return []
    picture = page.with_suffix(".png")
    plots.convergence(found, values, picture)
    return [
        f"<h2>Convergence, {outcome.iterations or 0} iterations</h2>",
        f'<p><img alt="convergence" src="{picture.name}"></p>',
    ]
