# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Uniform flow stays uniform while the mesh moves inside (geometric
conservation): 100 steps of pimpleFoam in a box whose top moves to and fro, and
the mesh with it. Fluid passes through all sides, as if
they were not there.

Source of truth: the uniform velocity itself. displacementLaplacian beside it
shows what the flow solver leaves on a mesh that another motion solver moves.
"""

import re

import numpy as np

from boxCase import block_mesh, from_block_mesh
from rbfCase import CUBE, DROP_IN
from uniformFlow import VELOCITY, write_flow

STEPS = 100
STEP = 0.05

SCHEMES = """
ddtSchemes { default Euler; } gradSchemes { default Gauss linear; }
divSchemes { default Gauss linear; }
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; } snGradSchemes { default corrected; }
"""

SOLUTION = """
solvers
{
    "U.*" { solver PBiCGStab; preconditioner DILU; tolerance 1e-14; relTol 0; }
    "(p|pcorr|cellDisplacement).*"
    { solver PCG; preconditioner DIC; tolerance 1e-14; relTol 0; }
}
PIMPLE { nOuterCorrectors 1; nCorrectors 2; }
"""

LAPLACIAN = """
dynamicFvMesh dynamicMotionSolverFvMesh; motionSolverLibs (fvMotionSolvers);
motionSolver displacementLaplacian;
displacementLaplacianCoeffs { diffusivity uniform; }
"""

# To and fro twice
TOP = (
    "oscillatingDisplacement; amplitude (0.2 0.1 0.1);"
    " omega 2.5132741228718345; value uniform (0 0 0);"
)


def velocities(path):
    text = path.read_text()
    if "internalField   uniform" in text:
        return np.array([VELOCITY])
    body = re.search(
        r"nonuniform List<vector>\s*\d+\s*\((.*?)\n\)", text, re.DOTALL
    )
    numbers = body.group(1).replace("(", " ").replace(")", " ").split()
    return np.array(numbers, float).reshape(-1, 3)


def deviation(path, motion):
    """The largest of the velocity, of all times."""
    case = from_block_mesh(
        path,
        block_mesh(CUBE, cells=(8, 8, 8)),
        {"end": STEPS * STEP, "deltaT": STEP, "writeInterval": STEPS // 8},
    )
    write_flow(case, motion, SCHEMES, SOLUTION, TOP)
    case.run("pimpleFoam")
    times = [
        time
        for time in case.path.glob("[0-9]*")
        if time.name != "0" and (time / "U").exists()
    ]
    assert len(times) >= 8
    points = np.array(
        [case.points(time / "polyMesh/points") for time in times]
    )
    assert np.ptp(points, axis=0).max() > 0.3
    return max(
        np.abs(velocities(time / "U") - VELOCITY).max() for time in times
    )


def test_uniform_flow_stays_uniform_while_the_mesh_moves(tmp_path):
    ours = deviation(tmp_path / "ours", DROP_IN)
    laplacian = deviation(tmp_path / "laplacian", LAPLACIAN)
    print(
        f"largest deviation: {ours:.2g}, displacementLaplacian "
        f"{laplacian:.2g}"
    )
    assert ours < 1e-9
    assert ours < 30 * laplacian
