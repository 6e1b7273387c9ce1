# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The verb check: what can be known to be wrong before anything runs."""

import contextlib
import fnmatch
import re
import shlex
import subprocess
from pathlib import Path

import numpy as np

from . import case_folder, foam_entry, outcomes, responses, sampling
from .errors import StudyError

# What editors and people leave beside a file
BACKUPS = ("*.bak", "*~", "*.old", "*.swp", "*.save", "#*#", ".#*")
# Of a dictionary; a text in quotes may hold what looks like one
COMMENT = re.compile(r'("(?:\\.|[^"\\\n])*")|//[^\n]*|/\*.*?\*/', re.DOTALL)

# Columns of tables that have the same in every case
COLUMNS = {
    "coefficient.dat": (
        "Time Cd Cs Cl CmRoll CmPitch CmYaw Cd(f) Cd(r) Cs(f) Cs(r) Cl(f)"
        " Cl(r)"
    ),
}

# Larger files of a template are meshes and fields
TEXT_LIMIT = 10**6


def check(study, quiet=False):
    """Stops with a StudyError; otherwise says what the study is."""
    check_folders(study)
    check_targets(study)
    check_commands(study)
    unknown = check_columns(study)
    share = check_feasible(study)
    if not quiet:
        describe(study, share, unknown)


def check_folders(study):
    if not study.template.is_dir():
        raise StudyError(
            f"template: {study.template} is no folder. Give the"
            " template case's, relative to the study file"
        )
    if study.folder == study.template or study.folder in (
        study.template.parents
    ):
        raise StudyError(
            f"folder: {study.folder} holds the template. Give the study a"
            " folder of its own"
        )


def texts(study):
    """The template's text files, as far as they are copied and somebody reads
    them, without comments: {path: text}."""
    found = {}
    for path in case_folder.template_files(study):
        if any(fnmatch.fnmatch(path.name, p) for p in BACKUPS):
            continue
        if path.is_file() and path.stat().st_size < TEXT_LIMIT:
            with contextlib.suppress(UnicodeDecodeError):
                text = path.read_text()
                # Where a shell's wildcard would begin one
                if not text.startswith("#!") and path.suffix != ".sh":
                    text = COMMENT.sub(r"\1", text)
                found[path.relative_to(study.template)] = text
    return found


def check_targets(study):
    """Every parameter must go somewhere, and that must be there."""
    used = set().union(*(d.expression.names for d in study.derived))
    aimed = {name for name, _ in study.targets()}
    if study.parameters_file:
        check_parameters_file(study, used | aimed)
    else:
        for name in study.names:
            if name not in used | aimed:
                raise StudyError(
                    f"parameters/{name} goes nowhere. Give it file and entry,"
                    " or give the study a parametersFile"
                )
    for name, target in study.targets():
        check_entry(study, name, target)


def check_parameters_file(study, elsewhere):
    own = Path(study.parameters_file)
    files = texts(study)
    present = files.pop(own, None)
    readers = {p: t for p, t in files.items() if own.name in t}
    including = [
        p
        for p, t in readers.items()
        if re.search(rf'#include\w*\s+"[^"]*\b{re.escape(own.name)}"', t)
    ]
    steps = " ".join(
        step.run for s in study.strategies.values() for step in s.steps
    )
    if not readers and own.name not in steps:
        raise StudyError(
            f"parametersFile: no file of {study.template} mentions {own.name}."
            f' Write #include "{own.name}" (with the path from there) into the'
            " dictionaries that use the parameters"
        )
    if present is not None:
        check_same_names(study, own, present)
    if len(including) == len(readers) and own.name not in steps:
        everything = "\n".join(files.values())
        for name in study.names:
            if name not in elsewhere and not re.search(
                rf"\$(\{{)?{name}\b", everything
            ):
                raise StudyError(
                    f"parameters/{name} goes nowhere: no dictionary of"
                    f" {study.template} uses ${name}, no derived quantity"
                    " does, and it has no file and entry"
                )


def check_same_names(study, own, text):
    """A file of parameters in the template is replaced: it must not have more
    than what replaces it."""
    plain = re.sub(
        r"//.*|/\*.*?\*/|FoamFile\s*\{.*?\}",
        "",
        text,
        flags=re.DOTALL if "/*" in text else 0,
    )
    there = re.findall(r"^\s*([A-Za-z_]\w*)\s+[^;{]*;", plain, re.MULTILINE)
    extra = [name for name in there if name not in study.baseline_values]
    if extra:
        raise StudyError(
            f"parametersFile: {own} of the template also sets"
            f" {', '.join(extra)}, which the study does not. It is replaced in"
            " each design: make these derived quantities of the study, or put"
            " them into another file"
        )


def check_entry(study, name, target):
    path = study.template / target.file
    if not path.is_file():
        raise StudyError(
            f"{name}/file: {target.file} is no file of" f" {study.template}"
        )
    try:
        foam_entry.number(path.read_text(), target.entry)
    except (UnicodeDecodeError, foam_entry.EntryError) as error:
        raise StudyError(
            f"{name}/entry: {target.file}: {error}. What comes by #include is"
            " set in the included file"
        ) from None


def check_columns(study):
    """Names of columns, where there is a table already or OpenFOAM's are known;
    those that could not be checked."""
    unknown = []
    for kind in ("responses", "notes"):
        for name, response in getattr(study, kind).items():
            if not isinstance(response.column, str):
                continue
            where, columns = known_columns(study, response.file)
            if not columns:
                unknown.append((response.column, response.file))
            elif response.column not in columns:
                raise StudyError(
                    f"{kind}/{name}/column: {where} has no column"
                    f" {response.column}, but {' '.join(columns)}"
                )
    return unknown


def known_columns(study, pattern):
    """Where a table like that is, and its columns: of the template as it was
    run, or of the baseline where that is made of the template as it is."""
    cases = [study.template]
    baseline = outcomes.read(study, outcomes.BASELINE)
    if not baseline or baseline.template_hash == case_folder.template_hash(
        study
    ):
        cases.append(outcomes.case(study, outcomes.BASELINE))
    for case in cases:
        with contextlib.suppress(responses.ResponseError, OSError):
            path = responses.newest(case, pattern)
            return path, responses.columns(path)[0]
    name = Path(pattern).name
    return f"forceCoeffs' {name}", COLUMNS.get(name, "").split()


def commands(study):
    """All commands with the place where they stand."""
    for strategy in study.strategies.values():
        for step in strategy.steps:
            yield f"strategies/{strategy.name}/steps/{step.name}", step.run
    for step in study.baseline_steps or []:
        yield f"baseline/steps/{step.name}", step.run
    for response in study.responses.values():
        if response.command:
            yield f"responses/{response.name}", response.command
    if study.picture:
        yield "picture", study.picture
    if study.descend and study.descend.geometry:
        yield "descend/geometry", study.descend.geometry


def check_commands(study):
    """The first word of each command must be something that can be run."""
    for where, command in commands(study):
        syntax = subprocess.run(
            ["bash", "-n", "-c", command], text=True, stderr=subprocess.PIPE
        )
        if syntax.returncode:
            raise StudyError(
                f"{where}: '{command}' is no command:"
                f" {syntax.stderr.strip().splitlines()[-1]}"
            )
        word = first_word(command)
        if word and not found(word, study.template):
            raise StudyError(
                f"{where}: there is no command {word}"
                + (
                    f" in {study.template}"
                    if "/" in word
                    else " on the path. Is OpenFOAM's environment sourced?"
                )
            )


def first_word(command):
    """The program a command starts, where that is plain to see."""
    try:
        words = shlex.split(command)
    except ValueError:
        return None
    for word in words:
        if not re.match(r"\w+=", word):
            return word if re.fullmatch(r"[\w./+-]+", word) else None
    return None


def found(word, folder):
    return (
        subprocess.run(
            ["bash", "-c", f"type -t {shlex.quote(word)}"],
            cwd=folder,
            stdout=subprocess.DEVNULL,
        ).returncode
        == 0
    )


def check_feasible(study):
    """The feasible share of the box; stops where there is none."""
    if study.sampling.method == "factorial":
        sampling.sample(study, [])
    return sampling.feasible_probes(study)[1]


def describe(study, share, unknown):
    print(
        f"{study.path.name}: {len(study.names)} parameters,"
        f" {len(study.responses)} responses, strategies"
        f" {' '.join(study.strategies)}"
    )
    print(f"feasible: {100*share:.3g} % of the box of the bounds")
    for column, file in unknown:
        print(
            f"Note: the column {column} of {file} cannot be checked before the"
            " baseline has run"
        )
    outside = [
        p.name for p in study.parameters if not p.low <= p.baseline <= p.high
    ]
    broken = study.broken(study.baseline)
    if outside or broken:
        print(
            "Note: the baseline is outside the designs' space ("
            + ", ".join([*outside, *broken])
            + ")"
        )
    if study.sampling.method == "factorial":
        points = np.prod(list(study.sampling.levels.values()))
        print(
            f"factorial: {len(sampling.sample(study, []))} of {points} points"
            " of the grid keep to the constraints"
        )
    print("No mistake found")
