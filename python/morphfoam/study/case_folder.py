# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A design's case: copied from the template or from the baseline's case, with
the design's parameters in its dictionaries."""

import datetime
import fnmatch
import hashlib
import os
import re
import shutil
from pathlib import Path

from . import foam_entry, outcomes
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


def content(path):
    """What is in a file, or of a large one (a mesh) how large it is."""
    if path.is_symlink():
        return os.readlink(path).encode()
    if path.stat().st_size > HASHED:
        return str(path.stat().st_size).encode()
    return path.read_bytes()


def digest(path):
    return hashlib.sha256(content(path)).hexdigest()


def template_hash(study):
    """Of all that is in the template."""
    whole = hashlib.sha256()
    for path in template_files(study):
        whole.update(str(path.relative_to(study.template)).encode())
        whole.update(content(path))
    return whole.hexdigest()


def digests(study, case):
    """{file: digest in the template, digest of the copy}, before steps run."""
    found = {}
    for path in template_files(study):
        name = str(path.relative_to(study.template))
        found[name] = [digest(path), digest(case / name)]
    return found


def corrections(study, baseline):
    """What has changed in the template since the baseline was made of it: the
    files that designs made from now on get, and those that stay as the
    baseline has them, because its steps changed them or they are its mesh."""
    case = outcomes.case(study, outcomes.BASELINE)
    corrected, kept = [], []
    for path in template_files(study):
        name = str(path.relative_to(study.template))
        if name == study.parameters_file or not has_changed(
            path, name, baseline
        ):
            continue
        before = baseline.template_files.get(name)
        own = case / name
        theirs = "polyMesh" in path.parts
        if before:
            theirs |= not own.exists() or digest(own) != before[1]
        elif baseline.template_files:
            theirs |= own.exists()
        (kept if theirs else corrected).append(name)
    return corrected, kept


def has_changed(path, name, baseline):
    if baseline.template_files:
        return baseline.template_files.get(name, [None])[0] != digest(path)
    # An outcome without digests, from before there were any
    made = datetime.datetime.fromisoformat(baseline.finished)
    return path.lstat().st_mtime > made.timestamp()


def copy_files(study, names, target):
    """Files of the template into a case."""
    for name in names:
        own = target / name
        own.parent.mkdir(parents=True, exist_ok=True)
        own.unlink(missing_ok=True)
        shutil.copy2(study.template / name, own, follow_symlinks=False)


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
    lines = [f"{name:<15} {value!r};\n" for name, value in values.items()]
    return "// Written by morphStudy for this design\n" + "".join(lines)


def write_parameters(study, case, parameters):
    """The design's values: the file of parameters, and the entries."""
    values = study.as_written(study.values(parameters))
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
