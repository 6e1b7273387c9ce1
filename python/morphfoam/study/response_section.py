# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A response or note of the study file."""

import math
from dataclasses import dataclass

from .errors import StudyError
from .expressions import Expression
from .section import Section, interval


@dataclass
class Gradient:
    """A table of derivatives, one row per parameter, its name first."""

    file: str
    column: str | int


@dataclass
class Response:
    """One source: file with column or regex, command, or expression."""

    name: str
    file: str | None = None
    column: str | int | None = None
    regex: str | None = None
    window: float | None = None
    command: str | None = None
    expression: Expression | None = None
    limits: tuple = (-math.inf, math.inf)
    row: str | None = None
    gradient: Gradient | None = None


KEYS = (
    "file",
    "column",
    "row",
    "regex",
    "window",
    "command",
    "expression",
    "limits",
    "gradient",
)


def read_response(name, content, where, steps):
    """steps: those whose logs there will be."""
    item = Section(content, where, KEYS)
    sources = [k for k in ("file", "command", "expression") if k in item]
    if len(sources) != 1:
        raise StudyError(
            f"{where} needs one of file, command, expression;"
            f" it has {' and '.join(sources) or 'none'}"
        )
    response = Response(
        name,
        item.text("file", None),
        item.get("column", None),
        item.regex("regex", None, groups=1),
        item.number("window", None, low=1e-300),
        item.text("command", None),
        row=item.text("row", None),
    )
    if "limits" in item:
        response.limits = interval(item.get("limits"), item.at("limits"))
    if "expression" in item:
        response.expression = Expression(
            item.get("expression"), item.at("expression")
        )
    if "gradient" in item:
        response.gradient = read_gradient(item)
    check(response, item, where, steps)
    return response


def read_gradient(item):
    if "expression" in item:
        raise StudyError(
            f"{item.at('gradient')}: the gradient of an expression follows"
            " from those of what it is made of. Leave it out"
        )
    part = Section(
        item.get("gradient"), item.at("gradient"), ("file", "column")
    )
    return Gradient(part.text("file"), part.get("column"))


def check(response, item, where, steps):
    """What belongs together."""
    if response.file and ("column" in item) == ("regex" in item):
        raise StudyError(
            f"{where} has a file; it needs a column of its table,"
            " or a regex for its text, one of the two"
        )
    if (
        not response.file
        and {"column", "row", "regex", "window"} & item.content.keys()
    ):
        raise StudyError(
            f"{where}: column, row, regex and window belong to a file"
        )
    if response.row and ("column" not in item or response.window):
        raise StudyError(
            f"{where}/row is the name of a row, the first word of it: it goes"
            " with a column, and without window"
        )
    if response.file and response.file.startswith("log."):
        if response.file[4:] not in steps:
            raise StudyError(
                f"{where}/file: not every strategy has a step that writes"
                f" {response.file}. Steps that they share:"
                f" {' '.join(sorted(steps)) or 'none'}"
            )
