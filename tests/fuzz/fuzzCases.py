# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The cases whose files are spoilt. Each is made once, run as it is, and copied.

    situation = SITUATIONS["rbf dictionary"]
    situation.make(folder)                  # a case that runs
    situation.command, situation.files      # what runs, what may be spoilt
"""

import struct

import mutations
from boxCase import box, fixed, point_field, write_control
from closedFormStudy import STUDY
from foamCase import ROOT, FoamCase

SIDES = ("xMin", "xMax", "yMin", "yMax", "zMin", "zMax")
CUBE = {side: "patch" for side in SIDES}

HEAD = """
dynamicFvMesh       dynamicMotionSolverFvMesh;
motionSolverLibs    (morphMotionSolvers);
motionSolver        {solver};
{solver}Coeffs
{{
{coeffs}
}}
"""

RBF = """
kernel wendlandC2;
supportRadius 2;
greedy { tolerance 1e-4; maxPoints 500; algorithm incremental; }
featureAngle 30;
onInvalidMesh error;
subSteps 1;
controlPoints
{
    top
    {
        type moving;
        patches (zMax);
        displacement { type file; file "constant/moved"; tolerance 1e-5; }
    }
    bottom { type fixed; patches (zMin); }
    side { type sliding; patches (xMin); surface "side.obj"; }
    others { type sliding; patches (xMax); surface planar; }
    flank { type sliding; patches (yMin); surface curved; }
    inside
    {
        type moving;
        points ((0.5 0.5 0.5) (0.5 0.4 0.5));
        displacement
        {
            type values;
            values ((0 0 0.05) (0 0 0.04));
            scale 1;
        }
    }
    zone { type fixed; pointZones (middle); }
}
"""

RBF_SECOND = """
kernel wendlandC4;
supportRadiusFactor 6;
greedy { tolerance 1e-3; algorithm schur; restartFraction 0.2; }
surfaceCorrection yes;
images no;
onInvalidMesh limit;
controlPoints
{
    top
    {
        type moving;
        patches (zMax);
        displacement
        {
            type solidBody;
            solidBodyMotionFunction rotatingMotion;
            rotatingMotionCoeffs { origin (0.5 0.5 1); axis (0 0 1); omega 0.1; }
        }
    }
    bottom
    {
        type moving;
        patches (zMin);
        displacement
        {
            type polyline;
            vertices ((0 0 0) (0.5 0.5 0) (1 1 0));
            values ((0 0 0) (0 0 0.05) (0 0 0));
        }
    }
    pillar
    {
        type sliding;
        patches (yMax);
        target { type searchablePlane; planeType pointAndNormal;
                 pointAndNormalDict { point (0 1.02 0); normal (0 1 0); } }
    }
}
"""

FFD = """
combine chain;
onInvalidMesh error;
boxes
{
    bulb
    {
        origin (-0.1 -0.1 -0.1);
        span (1.2 1.2 1.2);
        rotation { type axisAngle; axis (0 0 1); angle 5; }
        order (3 2 2);
        basis bernstein;
        units box;
        continuity none;
        parameters
        {
            mu { value 0.1; min -1; max 1;
                 moves (((1 1 1) (0 0 1)) ((2 1 1) (0 0.5 0))); }
            nu { value table ((0 0) (1 0.05)); moves (((2 1 1) (1 0 0))); }
        }
    }
    ring
    {
        type cylindrical;
        origin (0.5 0.5 -0.5);
        axis (0 0 1);
        direction (1 0 0);
        start (0.1 0 0);
        span (2 360 2);
        order (2 8 2);
        units metres;
        continuity none;
        parameters { wide { value 0.02; moves (((1 2 1) (1 0 0))); } }
    }
    eight
    {
        type corners;
        corners ((-0.1 -0.1 -0.1) (1.1 -0.1 -0.1) (1.1 1.1 -0.1) (-0.1 1.1 -0.1)
                 (-0.1 -0.1 1.1) (1.1 -0.1 1.1) (1.1 1.1 1.1) (-0.1 1.1 1.1));
        order (6 3 3);
        basis bSpline;
        degree (3 2 2);
        continuity none;
        weights (((1 1 1) 2));
        parameters { far { value 0.05; moves (((3 1 1) (0 1 0))); } }
    }
}
"""

CONDITIONS = {
    "xMin": fixed(0, 0, 0),
    "xMax": "slip",
    "yMin": "slip",
    "yMax": "slip",
    "zMin": fixed(0, 0, 0),
    "zMax": "uniformFixedValue; uniformValue table"
    " ((0 (0 0 0)) (1 (0 0 0.1)) (2 (0 0 0.05)));",
}

OBJ = (
    "\n".join(
        [f"v 0 {y} {z}" for y in (-1, 0.5, 2) for z in (-1, 0.5, 2)]
        + ["g side"]
        + [
            f"f {a} {a + 3} {a + 4}\nf {a} {a + 4} {a + 1}"
            for a in (1, 2, 4, 5)
        ]
    )
    + "\n"
)


def dictionary(solver, coeffs):
    return HEAD.format(solver=solver, coeffs=coeffs)


def write_moved(case):
    points = case.points("constant/polyMesh/points")
    rows = [
        f"{x:.17g} {y:.17g} {z:.17g} 0 0 {0.05*x*y:.6g}"
        for x, y, z in points
        if z > 0.999
    ]
    (case.path / "constant/moved").write_text(
        "# x y z dx dy dz\n" + "\n".join(rows) + "\n"
    )


def rbf(folder, coeffs=RBF, control=None):
    case = box(folder, CUBE, control, cells=(4, 4, 4))
    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        dictionary("rbfMotionSolver", coeffs),
    )
    (folder / "constant/triSurface").mkdir(exist_ok=True)
    (folder / "constant/triSurface/side.obj").write_text(OBJ)
    case.write(
        "constant/polyMesh/pointZones",
        "regIOobject",
        "1\n(\nmiddle\n{\n    type pointZone;\n    pointLabels"
        " List<label> 2(37 38);\n}\n)",
    )
    write_moved(case)
    return case


def rbf_second(folder):
    return rbf(folder, RBF_SECOND)


def ffd(folder):
    case = box(folder, CUBE, cells=(4, 4, 4))
    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        dictionary("ffdMotionSolver", FFD),
    )
    return case


def drop_in(folder):
    case = box(
        folder, CUBE, dict(end=1, startFrom="latestTime"), cells=(4, 4, 4)
    )
    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        HEAD.split("{solver}Coeffs")[0].format(solver="rbfMotionSolver"),
    )
    case.write("0/pointDisplacement", *point_field(CONDITIONS))
    return case


def restart(folder):
    """Moved until 1; what it would be at 2 is beside it."""
    case = drop_in(folder)
    case.run("moveDynamicMesh")
    write_control(case, end=2, startFrom="latestTime")
    return case


def overwritten(folder):
    """Points of the mesh have moved once, with the reference beside them."""
    case = ffd(folder)
    case.run("morphMesh", "-overwrite")
    return case


def surface(folder):
    case = FoamCase(folder)
    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        dictionary("ffdMotionSolver", FFD),
    )
    facets = ((0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2))
    x = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))
    (folder / "in.obj").write_text(
        "\n".join(
            ["v {} {} {}".format(*v) for v in x]
            + ["f {} {} {}".format(*(i + 1 for i in f)) for f in facets]
        )
        + "\n"
    )
    (folder / "in.stl").write_text(
        "solid a\n"
        + "".join(
            "  facet normal 0 0 1\n    outer loop\n"
            + "".join("      vertex {} {} {}\n".format(*x[i]) for i in f)
            + "    endloop\n  endfacet\n"
            for f in facets
        )
        + "endsolid a\n"
    )
    with open(folder / "in.stlb", "wb") as stl:
        stl.write(b"a".ljust(80) + struct.pack("<i", len(facets)))
        for f in facets:
            stl.write(
                struct.pack("<12f", 0, 0, 1, *(c for i in f for c in x[i]))
                + b"\0\0"
            )
    return case


def study(folder):
    (folder / "case").mkdir(parents=True)
    (folder / "case/parameters").write_text("x 0.5;\ny 0.5;\n")
    (folder / "case/system").mkdir()
    (folder / "case/system/values").write_text('#include "../parameters"\n')
    (folder / "case/solver.sh").write_text(
        "cat parameters; echo 'f = 1'; echo 'g = 2'\n"
    )
    (folder / "study.yaml").write_text(STUDY + "constraints: [x + y <= 1.5]\n")
    return FoamCase(folder)


class Situation:
    def __init__(
        self,
        make,
        command,
        files,
        kinds=mutations.TEXT,
        ranks=(1, 2),
        weight=1,
        moved=None,
    ):
        self.make = make
        self.command = command
        self.files = files
        self.kinds = kinds
        self.ranks = ranks  # on how many ranks it may run
        self.weight = weight  # how often it is drawn
        self.moved = moved  # points that must be right if it succeeds


MESH = [
    f"constant/polyMesh/{file}"
    for file in ("points", "faces", "owner", "neighbour", "boundary")
]
STUDY_PROGRAM = str(ROOT / "bin/morphStudy")

SITUATIONS = {
    "rbf dictionary": Situation(
        rbf, ["morphMesh"], ["constant/dynamicMeshDict"], weight=5
    ),
    "rbf dictionary, schur": Situation(
        rbf_second,
        ["morphMesh", "-time", "1"],
        ["constant/dynamicMeshDict"],
        weight=3,
    ),
    "rbf tables and surfaces": Situation(
        rbf,
        ["morphMesh"],
        ["constant/moved", "constant/triSurface/side.obj"],
        mutations.TABLE,
        weight=3,
    ),
    "ffd dictionary": Situation(
        ffd,
        ["morphMesh", "-time", "1", "-lattice"],
        ["constant/dynamicMeshDict"],
        weight=5,
    ),
    "drop-in fields": Situation(
        drop_in,
        ["moveDynamicMesh"],
        ["0/pointDisplacement", "constant/dynamicMeshDict"],
        weight=2,
    ),
    "restart state": Situation(
        restart,
        ["moveDynamicMesh"],
        ["1/uniform/rbfMotionSolverProperties"],
        mutations.TABLE
        + [mutations.valueless, mutations.gone, mutations.braces],
        weight=4,
        moved="2/polyMesh/points",
    ),
    "restart fields": Situation(
        restart,
        ["moveDynamicMesh"],
        ["1/pointDisplacement", "1/polyMesh/points"],
        mutations.TABLE,
        weight=1,
    ),
    "points0": Situation(
        overwritten,
        ["morphMesh", "-overwrite"],
        ["constant/polyMesh/points0"],
        [
            mutations.empty,
            mutations.zeros,
            mutations.cut,
            mutations.count,
            mutations.repeated,
            mutations.scaled,
            mutations.bracket,
            mutations.flipped,
        ],
        ranks=(1,),
    ),
    "mesh of rbf": Situation(
        rbf,
        ["morphMesh"],
        MESH + ["constant/polyMesh/pointZones"],
        mutations.TABLE,
        weight=2,
    ),
    "mesh of ffd": Situation(
        ffd, ["morphMesh"], MESH, mutations.TABLE, weight=1
    ),
    "surface stl": Situation(
        surface,
        ["morphSurface", "in.stl", "out.stl"],
        ["in.stl"],
        mutations.TABLE,
        ranks=(1,),
    ),
    "surface binary stl": Situation(
        surface,
        ["morphSurface", "in.stlb", "out.stlb"],
        ["in.stlb"],
        mutations.BINARY,
        ranks=(1,),
    ),
    "surface obj": Situation(
        surface,
        ["morphSurface", "-derivatives", "in.obj", "out.obj"],
        ["in.obj"],
        mutations.TABLE,
        ranks=(1,),
        weight=2,
    ),
    "surface dictionary": Situation(
        surface,
        ["morphSurface", "-time", "1", "-lattice", "in.obj", "out.stl"],
        ["constant/dynamicMeshDict"],
        ranks=(1,),
        weight=2,
    ),
    "study": Situation(
        study,
        [STUDY_PROGRAM, "check", "study.yaml"],
        ["study.yaml"],
        [
            mutations.number,
            mutations.word,
            mutations.misspelt,
            mutations.line,
            mutations.cut,
            mutations.empty,
            mutations.zeros,
            mutations.flipped,
            mutations.bracket,
        ],
        ranks=(1,),
        weight=1,
    ),
}
