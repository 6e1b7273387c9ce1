# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A design's case: copied from the template or from the baseline's case, with
the design's parameters in its dictionaries."""

import fnmatch
import hashlib
import os
import re
import shutil
from pathlib import Path

from . import foam_entry
from .errors import StudyError

LEFT_BEHIND = ("processor*", "postProcessing", "log.*", "*.foam")
# [bytes]
HASHED = 10**6


def is_time(name):
    try:
        return float(name) >= 0
    except ValueError:
        return False


def latest_time(case):
    """The folder name of the case's largest time, or None. Of a decomposed
    case, that of its processor folders."""
    times = [p.name for p in case.iterdir() if p.is_dir() and is_time(p.name)]
    first = case / "processor0"
    if first.is_dir():
        times += [p.name for p in first.iterdir() if is_time(p.name)]
    return max(times, key=float, default=None)


def left_out(study):
    """What of the template is not copied, as shutil.copytree asks for it: what
    runs leave behind, what the study excludes, and the study itself."""

    def ignore(folder, names):
        left = set()
        for name in names:
            full = os.path.join(folder, name)
            relative = os.path.relpath(full, study.template)
            patterns = [*study.exclude]
            if folder == str(study.template):
                patterns += LEFT_BEHIND
            if full == str(study.folder) or any(
                fnmatch.fnmatch(name, p) or fnmatch.fnmatch(relative, p)
                for p in patterns
            ):
                left.add(name)
        return left

    return ignore


def copy_template(study, target):
    shutil.copytree(
        study.template, target, symlinks=True, ignore=left_out(study)
    )


def template_files(study):
    """The files that are copied, in the order of their names."""
    ignore = left_out(study)
    for folder, folders, files in os.walk(study.template):
        left = ignore(folder, [*folders, *files])
        folders[:] = sorted(set(folders) - left)
        for name in sorted(set(files) - left):
            yield Path(folder) / name


def template_hash(study):
    """Of what is in the template's files, or of large ones (meshes) how large
    they are."""
    digest = hashlib.sha256()
    for path in template_files(study):
        digest.update(str(path.relative_to(study.template)).encode())
        if path.is_symlink():
            digest.update(os.readlink(path).encode())
        elif path.stat().st_size > HASHED:
            digest.update(str(path.stat().st_size).encode())
        else:
            digest.update(path.read_bytes())
    return digest.hexdigest()


def copy_case(source, target):
    """What a run continues from: everything but logs, what function objects
    wrote, and the times between 0 and the last."""
    latest = latest_time(source)

    def ignore(folder, names):
        top = folder == str(source)
        if not top and not os.path.basename(folder).startswith("processor"):
            return set()
        left = {
            n for n in names if is_time(n) and float(n) != 0 and n != latest
        }
        if top:
            left |= {
                n
                for n in names
                if any(
                    fnmatch.fnmatch(n, p)
                    for p in (
                        "postProcessing",
                        "log.*",
                        "*.foam",
                        "picture.png",
                    )
                )
            }
        return left

    shutil.copytree(source, target, symlinks=True, ignore=ignore)
    return latest


def replace_fields(source, target):
    """The last time's fields of one case in place of another's, whose mesh and
    whose name of the time stay."""
    cases = [("", source, target)] + [
        (p.name, p, target / p.name) for p in source.glob("processor*")
    ]
    for _, source_, target_ in cases:
        time, own = latest_time(source_), latest_time(target_)
        if time is None or own is None or not (source_ / time).is_dir():
            continue
        folder = target_ / own
        for path in sorted(folder.rglob("*")):
            if path.is_file() and "polyMesh" not in path.parts:
                path.unlink()
        shutil.copytree(
            source_ / time,
            folder,
            dirs_exist_ok=True,
            ignore=shutil.ignore_patterns("polyMesh"),
        )
        # It has the other case's count of time
        (folder / "uniform/time").unlink(missing_ok=True)


def parameters_text(study, values):
    lines = [
        f"{name:<15} {float(value)!r};\n" for name, value in values.items()
    ]
    return "// Written by morphStudy for this design\n" + "".join(lines)


def write_parameters(study, case, parameters):
    """The design's values: the file of parameters, and the entries."""
    values = study.values(parameters)
    if study.parameters_file:
        path = case / study.parameters_file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(parameters_text(study, values))
    for name, target in study.targets():
        path = case / target.file
        try:
            path.write_text(
                foam_entry.replaced(
                    path.read_text(), target.entry, values[name]
                )
            )
        except (OSError, foam_entry.EntryError) as error:
            raise StudyError(f"{name}, {target.file}: {error}") from None


def first_error(text):
    """The message of an OpenFOAM error, in one line."""
    found = re.search(
        r"--> FOAM FATAL.*?ERROR:?.*?\n(.*?)\n\s*(?:\n|From|file:)",
        text,
        re.DOTALL,
    )
    lines = [
        line.strip()
        for line in (found.group(1) if found else text).splitlines()
        if line.strip()
    ]
    return " ".join(lines[:3] if found else lines[-1:])
