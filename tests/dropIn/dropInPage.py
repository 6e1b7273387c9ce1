# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""What came of the tutorials, as a page of the documentation.

Of each: the largest difference of points whose motion is prescribed, over the
largest displacement; points that rest in the original and move here; quality
of the last mesh; medians of CPU times of the steps after the first, the smaller
of two runs that took turns; CPU time of the whole run, its first step included.
"""

import collections
import re


def solver(text):
    """The motion solvers that a dynamicMeshDict selects."""
    text = re.sub(r"//.*|/\*.*?\*/", "", text)
    names = re.findall(r"^\s*(?:motionSolver|solver)\s+(\w+);", text, re.M)
    return " + ".join(names)


def line(result):
    """Of the log."""
    runs = [result.get(key, {}) for key in ("two", "change")]
    ours = next((run for run in runs[::-1] if "morphFoam" in run), {})
    text = f"{result['outcome']:9}{result['name']}"
    if "difference" in ours:
        text += (
            f": difference {ours['difference']:.2g},"
            f" restless {ours['restless']}, moved {ours['moved']:.3g}"
        )
    if "step" in ours.get("morphFoam", {}):
        was, now = ours["original"], ours["morphFoam"]
        text += (
            f", step {1e3 * was['step']:.3g} -> {1e3 * now['step']:.3g} ms,"
            f" first {1e3 * was['first']:.3g} -> {1e3 * now['first']:.3g} ms,"
            f" run {was['cpu']:.2f} -> {now['cpu']:.2f} s"
        )
    message = result.get("two", {}).get("message")
    if message:
        text += "\n             two lines: " + message.split("\n")[0]
    message = result.get("change", {}).get("message")
    if message:
        text += "\n             changed: " + message.split("\n")[0]
    if result.get("reason"):
        text += "\n             " + result["reason"].strip().split("\n")[-1]
    return text


def counts(results):
    """How many there are of each outcome, in words."""
    n = collections.Counter(result["outcome"] for result in results)
    return [
        ("two lines, the same motion", n["same"]),
        ("a documented change", n["change"]),
        ("a stated limit", n["limit"]),
        ("wrong without a word", n["silent"]),
        ("a message that leads nowhere", n["nowhere"]),
        ("the original does not run here", n["not run"]),
    ]


def summary(results):
    return ", ".join(f"{what}: {n}" for what, n in counts(results))


def measured(result):
    """The run that came out right, if one did."""
    for key in ("change", "two"):
        if "morphFoam" in result.get(key, {}):
            return result[key]
    return None


def ratios(results):
    """Our CPU time of the motion in a step over the original's."""
    found = {}
    for result in results:
        run = measured(result)
        if result["outcome"] in ("same", "change") and run:
            was, now = run["original"].get("step"), run["morphFoam"].get(
                "step"
            )
            if was and now:
                found[result["name"]] = now / was
    return found


def row(result):
    run = measured(result)
    cells = [name(result), result["solver"], outcome(result)]
    if not run:
        return cells + [""] * 7
    was, now = run["original"], run["morphFoam"]
    moved = "at rest" if run["moved"] == 0 else number(run["difference"])
    (angle, skewness), (our_angle, our_skewness) = run["quality"]
    cells += [
        moved,
        str(run["restless"]),
        f"{number(angle)} → {number(our_angle)}",
        f"{number(skewness)} → {number(our_skewness)}",
    ]
    if "step" not in was or "step" not in now or not was["step"]:
        return cells + ["no motion", "", ""]
    return cells + [
        f"{1e3 * was['step']:.3g} → {1e3 * now['step']:.3g}",
        f"{now['step'] / was['step']:.2f}",
        f"{now['cpu'] / was['cpu']:.2f}",
    ]


def name(result):
    return result["name"].replace("/constant", "").replace("_", "\\_")


def number(x):
    if x == 0:
        return "0"
    return f"{x:.1e}" if x < 1e-2 else f"{x:.3g}"


def outcome(result):
    words = {
        "same": "same",
        "change": result.get("changed", ""),
        "limit": "limit",
        "silent": "**wrong**",
        "nowhere": "**no way**",
        "not run": "not run",
    }
    return words[result["outcome"]]


def said(result):
    """The first sentence of what two lines end in, or of why nothing ran."""
    two = result.get("two", {})
    text = two.get("message") or "\n".join(two.get("warnings", ()))
    if result.get("reason") and not (
        two.get("message") and result["outcome"] == "limit"
    ):
        text = result["reason"].strip()
        if text.startswith("Traceback"):
            text = text.splitlines()[-1]
            if "TimeoutExpired" in text:
                text = "not within the time limit on the machine of this run"
    lines = [line.strip() for line in text.strip().splitlines()]
    if result["outcome"] == "limit" and result.get("limit"):
        lines = [line for line in lines if result["limit"] in line]
    return lines[0].replace("|", "\\|").replace("_", "\\_") if lines else ""


HEADER = [
    "case",
    "original solver",
    "outcome",
    "largest difference",
    "moved, rested",
    "non-orthogonality [°]",
    "skewness",
    "CPU of the motion per step [ms]",
    "ratio",
    "whole run",
]


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)


def page(results):
    adjoint = [r for r in results if "adjointOptimisationFoam" in r["name"]]
    results = [r for r in results if r not in adjoint]
    of = {
        kind: [r for r in results if r["outcome"] == kind]
        for kind in ("same", "change", "limit", "silent", "nowhere", "not run")
    }
    every = sorted(ratios(results).values())
    median = every[len(every) // 2] if every else float("nan")
    above = sorted(
        (
            (ratio, case)
            for case, ratio in ratios(results).items()
            if ratio > 1.1
        ),
        reverse=True,
    )
    parts = [
        START,
        table(
            ["tutorials that move a mesh", "n"],
            [[what, str(n)] for what, n in counts(results)],
        ),
        f"CPU time of the motion in a step over the original's: median"
        f" {median:.2f} of {len(every)}"
        + (
            "; above 1.1: "
            + ", ".join(f"`{case}` {ratio:.2f}" for ratio, case in above)
            if above
            else ""
        )
        + ".",
        "## Two lines suffice",
        table(HEADER, map(row, of["same"])),
        "## The message prints what else changes",
        CHANGES,
        table(HEADER, map(row, of["change"])),
        "## Limits",
        LIMITS.format(n=len(adjoint)),
        table(
            ["case", "original solver", "what two lines end in"],
            [[name(r), r["solver"], said(r)] for r in of["limit"]],
        ),
    ]
    for kind, title in (
        ("silent", "Wrong without a word"),
        ("nowhere", "Messages that lead nowhere"),
        ("not run", "Originals that do not run here"),
    ):
        if of[kind]:
            parts += [
                f"## {title}",
                table(
                    ["case", "original solver", "why"],
                    [[name(r), r["solver"], said(r)] for r in of[kind]],
                ),
            ]
    return "\n\n".join(parts) + "\n"


START = """# OpenFOAM's own tutorials

Tutorials of OpenFOAM v1912 that move a mesh, made small, run as they are
and with `rbfMotionSolver`: `tests/dropIn/Allrun` writes this page. Cases
whose mesh flow moves, and overset ones, run their own solver; the others
`moveDynamicMesh`.

- *largest difference*: of points whose motion the case prescribes, over the
  largest displacement, at the times written
- *moved, rested*: points that rest in the original (prescribed, or in a part
  of the mesh that rests) and move here
- *non-orthogonality*, *skewness*: the largest at the end, original → here
- *CPU*: of the motion solver in a step, median after the first step, the
  smaller of two runs that take turns; *whole run*: the ratio of the CPU times
  of whole runs, first step and flow included"""

CHANGES = """What stands in `rbfMotionSolverCoeffs` is what the message of the run with
two lines prints or describes: velocities and components of the displacement
become groups of control points, and a body that floats becomes a group with
the displacement `sixDoFRigidBody`, beside the patches that stay. There flow
moves the body, in either run its own."""

LIMITS = """The message says so. Beside these there are {n} tutorials of
`adjointOptimisationFoam`, which has control points of its own to optimise;
its mesh can follow by `rbfMotionSolver` ([how](time.md#adjoint-optimisation))."""
