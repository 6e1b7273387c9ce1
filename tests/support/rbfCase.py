# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Cases whose mesh rbfMotionSolver moves.

    case = rbf_case(tmp_path, conditions={"zMax": fixed(0, 0, 0.1), ...})
    case = rbf_case(tmp_path, coeffs="controlPoints { ... }")
    points = move(case)
"""

import re
import shutil

import numpy as np

from boxCase import box, point_field, words, write_control

CUBE = {
    side: "patch" for side in ("xMin", "xMax", "yMin", "yMax", "zMin", "zMax")
}

DROP_IN = """
dynamicFvMesh       dynamicMotionSolverFvMesh;
motionSolverLibs    (morphMotionSolvers);
motionSolver        rbfMotionSolver;
"""


def rbf_case(
    path,
    conditions=None,
    coeffs=None,
    patches=None,
    extra="",
    control=None,
    **mesh,
):
    """A box that rbfMotionSolver moves.

    conditions: of 0/pointDisplacement; without, there is no such file.
    coeffs: rbfMotionSolverCoeffs; without, the drop-in dictionary.
    """
    case = box(path, patches or CUBE, control, **mesh)
    dictionary = DROP_IN + extra
    if coeffs is not None:
        dictionary += f"rbfMotionSolverCoeffs\n{{\n{coeffs}\n}}"
    case.write("constant/dynamicMeshDict", "dictionary", dictionary)
    if conditions is not None:
        case.write("0/pointDisplacement", *point_field(conditions))
    return case


def groups(**bodies):
    """controlPoints with these groups."""
    return (
        "controlPoints\n{\n"
        + "\n".join(f"{name} {{ {body} }}" for name, body in bodies.items())
        + "\n}"
    )


def reference(case):
    """The points of the mesh before it moves."""
    return case.points("constant/polyMesh/points")


def move(case, time="1", rests=False, **run):
    """The points after moveDynamicMesh, which ends at this time.

    Fails where nothing has moved, unless that is what should happen.
    """
    case.run("moveDynamicMesh", **run)
    points = points_at(case, time)
    assert np.array_equal(points, reference(case)) == rests
    return points


def points_at(case, time):
    if list(case.path.glob("processor[0-9]*")):
        return case.decomposed_points(f"{time}/polyMesh/points")
    return case.points(f"{time}/polyMesh/points")


def restart_from(case, half, end, control, ranks, restart_ranks):
    """Make a case that ran to its end one that goes on from half of it.

    control: arguments of write_control(); ranks: those it ran on, and those on
    which it is to go on.
    """
    if ranks > 1:
        case.run("reconstructPar", "-time", half)
        for folder in case.path.glob("processor*"):
            shutil.rmtree(folder)
    else:
        shutil.rmtree(case.path / end)
    write_control(case, **{**control, "startFrom": "latestTime"})
    if restart_ranks > 1:
        case.decompose((1, restart_ranks, 1), "-latestTime")


def bent_top(path, height, settings="", **rest):
    """A unit box whose top bends by height(points); its walls slide.

    settings: entries of the coefficients beside the groups.
    """
    case = rbf_case(
        path,
        coeffs="supportRadius 1;"
        + settings
        + groups(
            top="type moving; patches (zMax); displacement"
            ' { type file; file "constant/top.txt"; }',
            bottom="type fixed; patches (zMin);",
            walls='type sliding; patches ("[xy].*");',
        ),
        **rest,
    )
    x = reference(case)
    x = x[side(x, "zMax")]
    (case.path / "constant/top.txt").write_text(
        "".join(f"{words(a)} 0 0 {float(z)!r}\n" for a, z in zip(x, height(x)))
    )
    return case, x


def side(points, name):
    """Which points of a box at (0 0 0) (1 1 1) are on a side."""
    at = 1 if "Max" in name else 0
    return np.abs(points[:, "xyz".index(name[0])] - at) < 1e-9


def ulps(points):
    """An absolute tolerance of a few units in the last place of points."""
    return 4 * np.finfo(float).eps * np.abs(points).max()


SELECTED = (
    r"^rbfMotionSolver: selected (\d+) of (\d+) control points, "
    r"largest error (\S+) \(tolerance (\S+)\), selection (\S+) s$"
)


def selections(output):
    """What the log says of each selection: selected, of, error, tolerance."""
    return [
        (int(n), int(of), float(error), float(tolerance))
        for n, of, error, tolerance, _ in re.findall(
            SELECTED, output, re.MULTILINE
        )
    ]
