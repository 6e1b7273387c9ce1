# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Numbers from what a run leaves behind in a case folder."""

import contextlib
import math
import re
import subprocess

import numpy as np

from .case_folder import is_time

# [s]
COMMAND_TIMEOUT = 600


class ResponseError(Exception):
    """Why a response could not be read."""


def newest(case, pattern):
    """The file that matches, of the largest time in its path."""
    return by_time(case, pattern)[-1]


def by_time(case, pattern):
    """The files that match, by the times in their paths."""
    paths = [p for p in case.glob(pattern) if p.is_file()]
    if not paths:
        raise ResponseError(f"there is no file {pattern}")

    def key(path):
        parts = path.relative_to(case).parts
        return ([float(part) for part in parts if is_time(part)], str(path))

    return sorted(paths, key=key)


def history(case, response):
    """All values that a response's column or regular expression finds, of all
    times; none of other responses."""
    if response.file is None or response.row is not None:
        return []
    if response.regex:
        return text_values(newest(case, response.file), response)
    return [
        value
        for path in by_time(case, response.file)
        for _, value in table_values(path, response)
    ]


def columns(path):
    """Names and rows of a table as OpenFOAM's function objects write it."""
    names, rows = [], []
    for line in path.read_text().splitlines():
        words = (
            line.replace("(", " ").replace(")", " ").replace(",", " ").split()
        )
        if line.startswith("#"):
            names = line[1:].split() if not rows else names
        elif words:
            rows.append(words)
    if not rows:
        raise ResponseError(f"{path.name} has no row of values")
    return names, rows


def table_values(path, response):
    """Pairs of the first column and the response's."""
    names, rows = columns(path)
    column = response.column
    if isinstance(column, str):
        if column not in names:
            raise ResponseError(
                f"{path.name} has no column {column}; its"
                f" columns are {' '.join(names) or 'unnamed'}"
            )
        column = names.index(column)
    if response.row is not None:
        rows = [row for row in rows if row[0] == response.row]
        if not rows:
            raise ResponseError(f"{path.name} has no row {response.row}")
        # The first word is its name
        rows = [["0", *row[1:]] for row in rows]
    try:
        return [(float(row[0]), float(row[column])) for row in rows]
    except (IndexError, ValueError) as error:
        raise ResponseError(
            f"{path.name}, column {response.column}: {error}"
        ) from None


def of_table(path, response):
    table = table_values(path, response)
    if response.window is None:
        return table[-1][1]
    end = table[-1][0]
    return float(np.mean([v for t, v in table if t > end - response.window]))


def of_derivatives(path, gradient):
    """{parameter: derivative}; a parameter of a box is called box.name."""
    names, rows = columns(path)
    column = gradient.column
    if isinstance(column, str):
        if column not in names:
            raise ResponseError(
                f"{path.name} has no column {column}; its columns are"
                f" {' '.join(names) or 'unnamed'}"
            )
        column = names.index(column)
    try:
        return {row[0].rpartition(".")[2]: float(row[column]) for row in rows}
    except (IndexError, ValueError) as error:
        raise ResponseError(
            f"{path.name}, column {gradient.column}: {error}"
        ) from None


def text_values(path, response):
    found = re.findall(
        response.regex, path.read_text(errors="replace"), re.MULTILINE
    )
    if not found:
        raise ResponseError(f"{path.name} has nothing like {response.regex}")
    try:
        return [float(v) for v in found]
    except ValueError as error:
        raise ResponseError(f"{path.name}: {error}") from None


def of_text(path, response):
    count = 1 if response.window is None else int(response.window)
    return float(np.mean(text_values(path, response)[-count:]))


def of_command(command, case, environment):
    """The lines 'name value' that a command prints."""
    try:
        done = subprocess.run(
            ["bash", "-c", command],
            cwd=case,
            text=True,
            timeout=COMMAND_TIMEOUT,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
    except subprocess.TimeoutExpired:
        raise ResponseError(f"'{command}' ran into the timeout") from None
    if done.returncode:
        last = done.stderr.strip().splitlines()[-1:] or ["nothing"]
        raise ResponseError(
            f"'{command}' exits with {done.returncode} and" f" says: {last[0]}"
        )
    values = {}
    for line in done.stdout.splitlines():
        words = line.split()
        if len(words) == 2:
            try:
                values[words[0]] = float(words[1])
            except ValueError:
                pass
    return values


class Reader:
    """Reads the responses and notes of one case.

    baseline  values at the baseline, its responses among them; None: this is
              the baseline
    """

    def __init__(self, study, case, parameters, environment, baseline=None):
        self.study, self.case = study, case
        self.environment = environment
        self.known = dict(study.values(parameters))
        self.baseline = self.known if baseline is None else baseline
        self.printed = {}

    def responses(self, names=None):
        """All of them, or those of these names. Raises ResponseError, naming
        the response."""
        values = {}
        for name, response in self.study.responses.items():
            if names is not None and name not in names:
                continue
            try:
                value = self._read_one(response)
            except ResponseError as error:
                raise ResponseError(f"response {name}: {error}") from None
            low, high = response.limits
            if not math.isfinite(value):
                raise ResponseError(f"response {name} is {value}")
            if not low <= value <= high:
                raise ResponseError(
                    f"response {name} is {value:g}, outside its limits"
                    f" [{low:g}, {high:g}]"
                )
            self.known[name] = values[name] = value
        return values

    def gradients(self, names=None):
        """{response: {parameter: derivative}}, of those that have a table."""
        values = {}
        for name, response in self.study.responses.items():
            if (
                not response.gradient
                or names is not None
                and (name not in names)
            ):
                continue
            try:
                values[name] = of_derivatives(
                    newest(self.case, response.gradient.file),
                    response.gradient,
                )
            except ResponseError as error:
                raise ResponseError(
                    f"response {name}/gradient: {error}"
                ) from None
            if not values[name].keys() & self.study.baseline_values.keys():
                raise ResponseError(
                    f"response {name}/gradient: none of its rows"
                    f" ({' '.join(list(values[name])[:8])}) has the name of a"
                    " parameter or derived quantity of the study"
                )
        return values

    def notes(self):
        """Those that can be read."""
        values = {}
        for name, note in self.study.notes.items():
            with contextlib.suppress(ResponseError, KeyError):
                values[name] = self._read_one(note)
        return values

    def _read_one(self, response):
        if response.expression:
            return float(response.expression(self.known, self.baseline))
        if response.command:
            values = self._print(response.command)
            if response.name not in values:
                raise ResponseError(
                    f"'{response.command}' prints no line"
                    f" '{response.name} VALUE'"
                )
            return values[response.name]
        path = newest(self.case, response.file)
        return (of_text if response.regex else of_table)(path, response)

    def _print(self, command):
        if command not in self.printed:
            self.printed[command] = of_command(
                command, self.case, self.environment
            )
        return self.printed[command]
