# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A box to move: its mesh, the dictionaries of a case, and what it should do.

    case = box(tmp_path, {"xMin": "wall", ...}, cells=(4, 4, 4))

A box has six faces: xMin xMax yMin yMax zMin zMax. Patches are made of them;
meshes that were made once in a session are copied.
"""

import atexit
import functools
import pathlib
import shutil
import tempfile

from foamCase import FoamCase

SIDES = {
    "xMin": "0 4 7 3",
    "xMax": "1 2 6 5",
    "yMin": "0 1 5 4",
    "yMax": "3 7 6 2",
    "zMin": "0 3 2 1",
    "zMax": "4 5 6 7",
}

MESH = """
scale 1;
vertices ( {vertices} );
blocks ( hex ({block}) box ({cells}) simpleGrading ({grading}) );
edges ();
defaultPatch {{ name defaultFaces; type patch; }}
boundary ( {boundary} );
"""

CONTROL = """
startFrom {startFrom}; startTime 0; stopAt endTime; endTime {end};
deltaT {deltaT}; writeControl timeStep; writeInterval {writeInterval};
writeFormat {format}; writePrecision {digits}; writeCompression off;
timeFormat general; timePrecision 6; runTimeModifiable no;
"""

SCHEMES = """
divSchemes {} gradSchemes { default Gauss linear; }
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; } snGradSchemes { default corrected; }
"""

SOLUTION = """
solvers { "cell(Displacement|MotionU).*"
{ solver PCG; preconditioner DIC; tolerance 1e-14; relTol 0; } }
"""

_meshes = pathlib.Path(tempfile.mkdtemp(prefix="morphFoamMeshes"))
atexit.register(shutil.rmtree, _meshes, ignore_errors=True)


@functools.lru_cache(maxsize=None)
def _meshed(block_mesh_dict):
    """The folder of a case with this mesh, made once."""
    case = FoamCase(tempfile.mkdtemp(dir=_meshes))
    write_control(case)
    case.write("system/fvSchemes", "dictionary", SCHEMES)
    case.write("system/fvSolution", "dictionary", SOLUTION)
    case.write("system/blockMeshDict", "dictionary", block_mesh_dict)
    case.run("blockMesh")
    return case.path


def words(numbers):
    return " ".join(repr(float(x)) for x in numbers)


def vectors(rows):
    """OpenFOAM's list of vectors, with all digits."""
    return "(" + " ".join(f"({words(row)})" for row in rows) + ")"


def block_mesh(
    patches,
    cells=(4, 4, 4),
    low=(0, 0, 0),
    high=(1, 1, 1),
    grading=(1, 1, 1),
    corners=None,
    axis=False,
):
    """The blockMeshDict of a box.

    corners: in place of low and high, in the order of hex.
    axis: its edges at yMin coincide, as at the axis of a wedge.

    patches: name -> (type and other entries, names of sides). A patch without
    names of sides is the side of that name.
    """
    if corners is None:
        (x0, y0, z0), (x1, y1, z1) = low, high
        corners = [
            (x, y, z)
            for z in (z0, z1)
            for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))
        ]
    label = {"4": "0", "5": "1"} if axis else {}
    boundary = ""
    for name, given in patches.items():
        kind, sides = given if isinstance(given, tuple) else (given, name)
        faces = " ".join(
            f"({' '.join(label.get(v, v) for v in SIDES[side].split())})"
            for side in sides.split()
        )
        kind = kind if ";" in kind else f"{kind};"
        boundary += f"{name} {{ type {kind} faces ({faces}); }}\n"
    return MESH.format(
        vertices=vectors(corners)[1:-1],
        boundary=boundary,
        block=" ".join(label.get(v, v) for v in "01234567"),
        cells="{} {} {}".format(*cells),
        grading=words(grading),
    )


def write_control(
    case,
    end=1,
    deltaT=1,
    format="ascii",
    digits=17,
    startFrom="startTime",
    writeInterval=1,
):
    case.write(
        "system/controlDict",
        "dictionary",
        CONTROL.format(
            end=end,
            deltaT=deltaT,
            format=format,
            digits=digits,
            startFrom=startFrom,
            writeInterval=writeInterval,
        ),
    )


def from_block_mesh(path, block_mesh_dict, control=None):
    """A meshed case; control: arguments of write_control()."""
    shutil.copytree(_meshed(block_mesh_dict), path, dirs_exist_ok=True)
    case = FoamCase(path)
    write_control(case, **(control or {}))
    return case


def box(path, patches, control=None, **mesh):
    """A meshed box; control: arguments of write_control()."""
    return from_block_mesh(path, block_mesh(patches, **mesh), control)


def point_field(conditions, dimensions="0 1 0 0 0 0 0"):
    """A pointVectorField with these boundary conditions."""
    boundary = "\n".join(
        f"{patch} {{ type {condition}"
        + (" }" if condition.endswith(";") else "; }")
        for patch, condition in conditions.items()
    )
    return (
        "pointVectorField",
        f"dimensions [{dimensions}];\n"
        "internalField uniform (0 0 0);\n"
        f"boundaryField\n{{\n{boundary}\n}}",
    )


def fixed(*value):
    """A fixedValue condition."""
    return f"fixedValue; value uniform ({words(value)});"
