# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Runs OpenFOAM's tutorials that move a mesh as they are and with our solver.

    dropIn.py [-keep FOLDER] [-list] [-page] [CASE...]

    CASE            part of a tutorial's path; without, all of them, and
                    docs/pages/dropIn.md is written
    -keep FOLDER    where cases and logs stay
    -list           the tutorials, without running them
    -page           the page from what was measured before

Exit status 1 if a case is wrong without a word or a message leads nowhere.
"""

import argparse
import json
import os
import pathlib
import shutil
import sys
import tempfile
import traceback

import numpy as np

import dropInPage
from foamCase import ROOT, environment
from tutorialCase import FREE, Mesh, TutorialCase, warnings
from movingTutorials import tutorials

RESULTS = ROOT / "build/dropIn"
# Seconds; shorter runs are repeated
LONG = 2.0
FIELDS = [
    name + suffix
    for name in ("pointDisplacement", "pointMotionU")
    for suffix in ("", "x", "y", "z")
]


def prescribed(tutorial, original, mesh):
    """The points whose motion the case prescribes, and not the solver."""
    if tutorial.rigid:
        return None
    patches = set(tutorial.bodies)
    for field in FIELDS:
        types = original.conditions(field)
        patches.update(
            patch
            for patch, kind in types.items()
            if kind not in FREE and not kind.startswith(("cyclic", "proc"))
        )
    sets = [mesh.patches[name] for name in patches if name in mesh.patches]
    return np.unique(np.concatenate(sets)) if sets else np.zeros(0, int)


def compare(tutorial, original, ours):
    """How far our points are from the original's, at every time written."""
    start = original.points()
    mesh = Mesh(original.folder)
    points = prescribed(tutorial, original, mesh)
    if points is None:
        points = np.arange(len(start))
    part = mesh.parts(len(start))
    small = 1e-14 * np.abs(start).max()
    result = {"moved": 0.0, "difference": 0.0, "restless": 0, "ours": 0.0}
    times = {time.name: time for time in ours.times()}
    for time in original.times():
        if time.name not in times:
            return dict(result, difference=float("nan"))
        was = original.points(time)
        now = ours.points(times[time.name])
        if was.shape != start.shape or now.shape != start.shape:
            return dict(result, difference=float("nan"), topology=True)
        d = np.linalg.norm(was - start, axis=1)
        e = np.linalg.norm(now - start, axis=1)
        largest = d.max()
        result["moved"] = max(result["moved"], float(largest))
        result["ours"] = max(result["ours"], float(e.max()))
        far = np.linalg.norm(now - was, axis=1)[points]
        if len(far):
            scale = largest if largest > small else 1
            result["difference"] = max(
                result["difference"], float(far.max() / scale)
            )
        # Points that rest: prescribed ones, and parts that nothing moves
        still = np.zeros(len(start), bool)
        still[points] = d[points] <= small
        farthest = np.zeros(part.max() + 1)
        np.maximum.at(farthest, part, d)
        still |= farthest[part] <= max(small, 1e-6 * largest)
        result["restless"] = max(
            result["restless"], int((still & (e > small)).sum())
        )
    return result


def seconds(*runs):
    """(median, first) of the motion's steps, of repeated runs the smallest;
    the CPU of the whole run."""
    steps = [run.motion_seconds() for run in runs]
    steps = [s for s in steps if len(s)]
    if not steps:
        return {"cpu": min(run.cpu for run in runs)}
    return {
        "step": float(
            min(np.median(s[1:] if len(s) > 1 else s) for s in steps)
        ),
        "first": float(min(s[0] for s in steps)),
        "cpu": float(min(run.cpu for run in runs)),
    }


def same(tutorial, found):
    return found["difference"] <= tutorial.tolerance and not found["restless"]


def measure(case, original, dictionary, name):
    """A run of ours beside the original: what came of it."""
    ours = case.run(name, dictionary)
    result = {"good": ours.good, "warnings": warnings(ours.log)}
    if not ours.good:
        result["message"] = ours.message
        return result
    if not original.good:
        return result
    result.update(compare(case.tutorial, original, ours))
    theirs, mine = [original], [ours]
    if original.cpu < LONG:
        theirs.append(case.run("original.again"))
        mine.append(case.run(name + ".again", dictionary))
    result["original"] = seconds(*theirs)
    result["morphFoam"] = seconds(*mine)
    result["quality"] = [original.quality(), ours.quality()]
    return result


def try_out(tutorial, source, folder):
    """The tutorial as it is, with two lines changed, and as we say."""
    result = {
        "name": tutorial.name,
        "solver": "",
        "outcome": "",
        "changed": tutorial.changed,
        "limit": tutorial.limit,
        "reason": tutorial.reason,
    }
    case = TutorialCase(tutorial, source, folder)
    text = (case.case / "constant" / tutorial.dict).read_text()
    result["solver"] = dropInPage.solver(text)
    if "dynamicFvMesh" not in text:
        result["outcome"] = "limit"
        result["reason"] = "control points of an optimiser, not a mesh motion"
        return result
    if tutorial.reason:
        result["outcome"] = "not run"
        return result
    try:
        case.prepare()
    except RuntimeError as error:
        result.update(outcome="not run", reason=str(error))
        return result
    original = case.run("original")
    result["program"] = case.application if tutorial.own else "moveDynamicMesh"
    result["points"] = len(original.points())
    if not original.good:
        result["reason"] = "original: " + original.message
    two = measure(case, original, case.two_lines(), "twoLines")
    result["two"] = two
    if two["good"] and original.good and same(tutorial, two):
        result["outcome"] = "same"
        return result
    said = two.get("message") or "\n".join(two["warnings"])
    if not original.good and said == original.message:
        result["outcome"] = "not run"
        return result
    if not said:
        result["outcome"] = "silent" if original.good else "not run"
        return result
    coefficients = (
        tutorial.change(said, case.others()) if tutorial.change else ""
    )
    if coefficients:
        result["change"] = measure(
            case, original, case.two_lines(coefficients), "change"
        )
        changed = result["change"]
        if changed["good"] and not original.good:
            result["outcome"] = "not run"
        elif changed["good"] and same(tutorial, changed):
            result["outcome"] = "change"
        elif changed["good"]:
            result["outcome"] = "silent"
        else:
            result["outcome"] = "nowhere"
        return result
    if tutorial.limit and tutorial.limit in said:
        result["outcome"] = "limit"
    else:
        result["outcome"] = "nowhere"
    return result


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-keep")
    parser.add_argument("-list", action="store_true")
    parser.add_argument("-page", action="store_true")
    parser.add_argument("cases", nargs="*")
    options = parser.parse_args(arguments)

    source = pathlib.Path(environment()["FOAM_TUTORIALS"])
    every = tutorials(source)
    names = {tutorial.name for tutorial in every}
    chosen = [
        tutorial
        for tutorial in every
        if not options.cases
        or any(
            part == tutorial.name if part in names else part in tutorial.name
            for part in options.cases
        )
    ]
    if options.list:
        print("\n".join(tutorial.name for tutorial in chosen))
        return 0

    RESULTS.mkdir(parents=True, exist_ok=True)
    results = []
    for tutorial in chosen:
        file = RESULTS / (tutorial.name.replace("/", ".") + ".json")
        if options.page:
            if file.exists():
                results.append(json.loads(file.read_text()))
            continue
        folder = tempfile.mkdtemp() if not options.keep else None
        where = pathlib.Path(folder or options.keep) / file.stem
        try:
            result = try_out(tutorial, source, where)
        except Exception:  # a fault of one is no fault of the others
            result = {
                "name": tutorial.name,
                "outcome": "not run",
                "solver": "",
                "reason": traceback.format_exc(),
            }
        finally:
            if folder:
                shutil.rmtree(folder)
        file.write_text(json.dumps(result, indent=1))
        results.append(result)
        print(dropInPage.line(result), flush=True)
    print(dropInPage.summary(results))
    if options.page or not options.cases:
        page = ROOT / "docs/pages/dropIn.md"
        page.write_text(dropInPage.page(results))
        print(os.path.relpath(page))
    wrong = [r for r in results if r["outcome"] in ("silent", "nowhere")]
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
