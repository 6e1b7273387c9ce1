# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A flow goes on while its mesh is re-meshed.

Sources of truth: the uniform velocity itself (geometric conservation); where
the dictionary says that points go; the uninterrupted run.
"""

import re
import shutil

import numpy as np
import pytest

from boxCase import (
    block_mesh,
    from_block_mesh,
    write_control,
)
from cellFields import read_internal
from rbfCase import CUBE
from uniformFlow import VELOCITY, write_flow


SCHEMES = """
ddtSchemes {{ default {ddt}; }} gradSchemes {{ default Gauss linear; }}
divSchemes {{ default Gauss linear; div(phi,U) Gauss upwind; }}
laplacianSchemes {{ default Gauss linear limited 0.33; }}
interpolationSchemes {{ default linear; }}
snGradSchemes {{ default limited 0.33; }}
"""

SOLUTION = """
solvers
{
    "U.*" { solver PBiCGStab; preconditioner DILU; tolerance 1e-14; relTol 0; }
    "(p|pcorr).*"
    { solver PCG; preconditioner DIC; tolerance 1e-14; relTol 0; }
}
PIMPLE { nOuterCorrectors 1; nCorrectors 2; %s }
"""

DYNAMIC = """
dynamicFvMesh       morphRemeshFvMesh;
dynamicFvMeshLibs   (morphRemesh);
motionSolverLibs    (morphMotionSolvers);
motionSolver        {solver};
rbfMotionSolverCoeffs {{ supportRadius 1.5; {coeffs} }}
remesh
{{
    engine madlib; region cavity; layers 2; keepLayers 0; keepPatches (zMax);
    limits {{ nonOrthogonality {limit}; skewness 20; }} {remesh}
}}
"""

STEP = 0.02

# The mesh between is sheared by as much as it is high
MOTION = (
    "oscillatingDisplacement; amplitude (3.5 0 0); omega 1;"
    " value uniform (0 0 0);"
)


def flow(
    path,
    end=22,
    limit=58,
    ddt="Euler",
    solver="rbfMotionSolver",
    coeffs="",
    remesh="",
    controls="",
):
    """Uniform flow through a box whose top shears its mesh."""
    case = from_block_mesh(
        path,
        block_mesh(CUBE, cells=(6, 6, 6)),
        {"end": end * STEP, "deltaT": STEP, "writeInterval": 4},
    )
    write_flow(
        case,
        DYNAMIC.format(
            solver=solver, coeffs=coeffs, limit=limit, remesh=remesh
        ),
        SCHEMES.format(ddt=ddt),
        SOLUTION % controls,
        MOTION,
    )
    return case


def remeshings(output):
    return len(re.findall(r"Re-meshing \d+: \d+ cells", output))


def times(case):
    return sorted(
        (p.name for p in case.path.glob("0.*") if (p / "U").exists()),
        key=float,
    )


@pytest.fixture(scope="module")
def uniform(tmp_path_factory):
    case = flow(tmp_path_factory.mktemp("uniform"))
    return case, case.run("pimpleFoam")


def test_uniform_flow_stays_uniform_across_a_remeshing(uniform):
    case, output = uniform
    assert remeshings(output) >= 1
    worst = max(
        np.abs(read_internal(case, f"{time}/U") - VELOCITY).max()
        for time in times(case)
    )
    print(f"{remeshings(output)} re-meshings, largest deviation {worst:.2g}")
    assert worst < 1e-10


def test_continuity_errors_stay_small(uniform):
    _, output = uniform
    errors = re.findall(r"sum local = (\S+),", output)
    assert max(map(float, errors)) < 1e-10


def test_the_top_is_where_it_should_be(uniform):
    """Displacements are those of the whole motion, also after re-meshing."""
    case, _ = uniform
    last = times(case)[-1]
    assert float(last) > 0.3
    points = case.points(f"{last}/polyMesh/points")
    top = points[points[:, 2] > 1 - 1e-9]
    away = 3.5 * np.sin(float(last))
    corners = [(away, 0), (1 + away, 0), (away, 1), (1 + away, 1)]
    for x, y in corners:
        off = np.abs(top - [x, y, 1]).max(1).min()
        assert off < 1e-12


def test_restart_goes_on(uniform, tmp_path):
    """From the mesh of a time after re-meshing: the same cells, and points to
    the digits written."""
    case, output = uniform
    with_mesh = [
        t for t in times(case) if (case.path / t / "polyMesh/faces").exists()
    ]
    assert with_mesh and with_mesh[0] != times(case)[-1]
    assert "motionOrigin" in [
        f.name for f in (case.path / with_mesh[0]).iterdir()
    ]
    other = flow(tmp_path, end=0)
    shutil.copytree(case.path / with_mesh[0], tmp_path / with_mesh[0])
    write_control(
        other, end=0.44, deltaT=STEP, writeInterval=4, startFrom="latestTime"
    )
    other.run("pimpleFoam")
    last = times(case)[-1]
    whole = case.points(f"{last}/polyMesh/points")
    again = other.points(f"{last}/polyMesh/points")
    assert whole.shape == again.shape
    np.testing.assert_allclose(again, whole, atol=1e-9)
    np.testing.assert_allclose(
        read_internal(other, f"{last}/U"),
        np.broadcast_to(VELOCITY, (len(read_internal(case, f"{last}/U")), 3)),
        atol=1e-10,
    )


@pytest.mark.parametrize(
    "arguments, says",
    [
        ({"ddt": "backward"}, ["backward", "Use Euler"]),
        ({"ddt": "CrankNicolson 0.9"}, ["CrankNicolson", "Use Euler"]),
        (
            {"solver": "displacementLaplacian"},
            ["displacementLaplacian", "rbfMotionSolver"],
        ),
        ({"controls": "correctPhi no;"}, ["correctPhi", "Remove it"]),
    ],
)
def test_errors_say_what_to_do(tmp_path, arguments, says):
    output = flow(tmp_path, **arguments).run("pimpleFoam", status=1)
    for words in says:
        assert words in output


def test_at_max_remeshes_the_last_valid_mesh_is_written(tmp_path):
    case = flow(tmp_path, remesh="maxRemeshes 1;")
    output = case.run("pimpleFoam", status=1)
    assert "re-meshed 1 times, which is all that 'maxRemeshes'" in output
    time = re.search(r"have been written to ([\d.]+)\. Allow more", output)[1]
    cells = int(re.search(r"Re-meshing 1: \d+ cells, then (\d+)", output)[1])
    assert len(read_internal(case, f"{time}/remeshSize")) == cells
    check = case.run("checkMesh", "-time", time)
    assert re.search(r"cells:\s+%d\n" % cells, check)
    assert "Mesh OK" in check


def test_new_points_of_a_body_go_with_it(tmp_path):
    """Wherever they are put on the top: it stays plane, and all of it makes the
    motion that is prescribed."""
    case = flow(
        tmp_path, remesh="region all; sizeFactor 0.5; passes 1;", end=18
    )
    output = case.run("pimpleFoam")
    assert remeshings(output) >= 1
    time = times(case)[-1]
    points = case.points(f"{time}/polyMesh/points")
    origin = read_internal(case, f"{time}/motionOrigin")
    top = points[:, 2] > 1 - 1e-6
    away = 3.5 * np.sin(float(time))
    assert top.sum() > 49
    np.testing.assert_allclose(
        points[top], origin[top] + [away, 0, 0], rtol=0, atol=1e-12
    )
