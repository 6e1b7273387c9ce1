# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A uniform flow through all sides of a box, as if they were not there."""

from boxCase import fixed, point_field
from rbfCase import CUBE

VELOCITY = (1, 0.5, 0.25)


def write_flow(case, motion, schemes, solution, top):
    """What pimpleFoam reads. motion: of dynamicMeshDict; top: the condition of
    pointDisplacement there."""
    files = {
        "constant/dynamicMeshDict": motion,
        "constant/transportProperties": "transportModel Newtonian; nu 0.001;",
        "constant/turbulenceProperties": "simulationType laminar;",
        "system/fvSchemes": schemes,
        "system/fvSolution": solution,
    }
    for name, body in files.items():
        case.write(name, "dictionary", body)
    velocity = "uniform (%g %g %g)" % VELOCITY
    case.write(
        "0/U",
        "volVectorField",
        "dimensions [0 1 -1 0 0 0 0];"
        f" internalField {velocity}; boundaryField {{"
        f' ".*" {{ type fixedValue; value {velocity}; }}'
        " xMax { type zeroGradient; } }",
    )
    case.write(
        "0/p",
        "volScalarField",
        "dimensions [0 2 -2 0 0 0 0]; internalField uniform 0;"
        ' boundaryField { ".*" { type zeroGradient; }'
        " xMax { type fixedValue; value uniform 0; } }",
    )
    case.write(
        "0/pointDisplacement",
        *point_field(
            {
                **{side: "zeroGradient" for side in CUBE},
                "zMin": fixed(0, 0, 0),
                "zMax": top,
            }
        ),
    )
