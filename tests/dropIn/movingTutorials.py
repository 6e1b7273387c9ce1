# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""OpenFOAM's tutorials that move a mesh: how each is made small, how far it
runs, and what has to change beside two lines where these do not suffice.
"""

import dataclasses
import pathlib
import re

# Meshes that are refined or at rest; motions that are no part of the case's run
AT_REST = re.compile(r"dynamicFvMesh\s+(dynamicRefineFvMesh|staticFvMesh)")


@dataclasses.dataclass
class Tutorial:
    """What is particular about one; defaults run OpenFOAM's moveDynamicMesh."""

    # From the folder of tutorials
    path: str
    # Number of blockMesh's cells in each direction that has more than one
    scale: float = 1
    # Taken from snappyHexMesh's levels
    levels: int = 0
    # (file, pattern, replacement) before the mesh is made
    edits: tuple = ()
    # The case's own solver, where flow moves the mesh or overset is solved
    own: bool = False
    deltaT: float = 0
    steps: int = 12
    # Makes the mesh: from the folder above the case; none is blockMesh
    script: str = ""
    # Of these folders one is copied
    root: str = ""
    dict: str = "dynamicMeshDict"
    # The solver that two lines replace, where there are several
    solver: str = r"\w+"
    # Patches that the flow moves
    bodies: tuple = ()
    # All points are prescribed
    rigid: bool = False
    # Largest difference, over the largest displacement: where flow moves a
    # body both runs have their own flow
    tolerance: float = 1e-9
    # What the two lines' message says that no change can give
    limit: str = ""
    # Replaces the coefficients, as the message says; a function of the message
    change: object = None
    changed: str = ""
    # What its own solver is linked with and moveDynamicMesh is not
    libs: str = ""
    # A program that has to run while it moves
    beside: str = ""
    # Why the original does not run
    reason: str = ""

    @property
    def name(self):
        suffix = self.dict.replace("dynamicMeshDict", "")
        return self.path + suffix


def printed_groups(message, _):
    """The block 'controlPoints { ... }' that a message prints."""
    found = re.search(r"^controlPoints\n\{\n.*?^\}", message, re.M | re.S)
    return found[0] if found else ""


def printed_body(message, others):
    """The group of a body that a message prints, and the patches that stay."""
    found = re.search(r"^body\n\{\n.*?^\}", message, re.M | re.S)
    return with_patches_that_stay(found[0], others) if found else ""


def with_patches_that_stay(body, others):
    return (
        "controlPoints\n{\n"
        + body
        + f"\nstay {{ type fixed; patches ({' '.join(others)}); }}\n}}"
    )


SLOSHING = "multiphase/interFoam/laminar/"
WAVES = SLOSHING + "waves/"
OVER = "multiphase/overInterDyMFoam/"
PIMPLE = "incompressible/pimpleFoam/"
CONE = dict(
    change=printed_groups, changed="`controlPoints` as printed", tolerance=1e-6
)
BODY = dict(
    own=True,
    change=printed_body,
    changed="the body as printed, patches that stay",
    tolerance=0.05,
)
SURFACE = dict(own=True, limit="interfaceTrackingFvMesh", steps=8)
WAVE = dict(deltaT=0.2, libs="libs (waveModels);")
ROTORS = dict(own=True, rigid=True, scale=0.5, steps=8)
CYLINDER = dict(own=True, scale=0.5, steps=8)
PROPELLER = dict(rigid=True, scale=0.75, levels=2, deltaT=4e-4)


def no_code(file, rho, x, y, z):
    """Numbers for the inertia of a cuboid that code computes: OpenFOAM does
    not compile code for root."""
    inertia = [
        rho * x * y * z * (a * a + b * b) / 12
        for a, b in ((y, z), (x, z), (x, y))
    ]
    return (
        file,
        r"momentOfInertia #codeStream\s*\{.*?#\};\s*\};",
        "momentOfInertia ({:.12g} {:.12g} {:.12g});".format(*inertia),
    )


# A hull in 20,295 cells: four of the six refinements about it, no layers
COARSE_HULL = (
    ("Allrun", "for i in 1 2 3 4 5 6", "for i in 2 3 4 5"),
    (
        "system/blockMeshDict",
        r"\(42 19 50\)(?= simpleGrading \(1 1 0)",
        "(28 12 12)",
    ),
    ("system/blockMeshDict", r"\(42 19 50\)", "(28 12 10)"),
    ("system/blockMeshDict", r"\(42 19 4\)", "(28 12 1)"),
    ("system/blockMeshDict", r"\(42 19 40\)", "(28 12 8)"),
    ("system/blockMeshDict", r"\(42 19 20\)", "(28 12 5)"),
    ("system/snappyHexMeshDict", r"addLayers +true", "addLayers false"),
)


KNOWN = [
    # Deforming meshes with conditions of pointDisplacement
    Tutorial(WAVES + "waveMakerFlap", 0.4, **WAVE),
    Tutorial(WAVES + "waveMakerPiston", 0.4, **WAVE),
    Tutorial(WAVES + "waveMakerSolitary", 0.5, **WAVE),
    Tutorial(WAVES + "waveMakerMultiPaddleFlap", 0.3, **WAVE),
    Tutorial(WAVES + "waveMakerMultiPaddlePiston", 0.3, **WAVE),
    Tutorial(
        "multiphase/potentialFreeSurfaceDyMFoam/oscillatingBox", deltaT=0.021
    ),
    Tutorial("mesh/moveDynamicMesh/SnakeRiverCanyon", 0.5, deltaT=1),
    Tutorial(
        "incompressible/lumpedPointMotion/building/steady",
        0.15,
        script="steady/Allrun.pre",
        root="..",
        beside="lumpedPointMovement -scale 0.01 -removeLock -slave"
        " ../mesh/files/response.txt",
        steps=6,
    ),
    # Components and velocities
    Tutorial(
        "combustion/XiDyMFoam/oscillatingCylinder",
        edits=(
            (
                "0/pointDisplacementy",
                r"type    codedFixedValue;\s*code\s*#\{.*?#\};\s*value[^;]*;",
                "type uniformFixedValue; uniformValue sine;"
                " uniformValueCoeffs { frequency 200; amplitude 0.001;"
                " scale 1; level 0; }",
            ),
        ),
        deltaT=2e-4,
        **CONE,
    ),
    Tutorial("compressible/rhoCentralDyMFoam/movingCone", deltaT=4e-7, **CONE),
    Tutorial("compressible/sonicDyMFoam/movingCone", deltaT=4e-7, **CONE),
    Tutorial(PIMPLE + "laminar/movingCone", deltaT=4e-5, **CONE),
    Tutorial(PIMPLE + "laminar/contactAngleCavity", **SURFACE),
    Tutorial(PIMPLE + "laminar/contaminatedDroplet2D", **SURFACE),
    Tutorial(PIMPLE + "laminar/sloshing2D", **SURFACE),
    # Layers, several solvers, code
    Tutorial(
        "multiphase/compressibleInterDyMFoam/laminar/sphereDrop",
        # Its flow diverges; the sphere falls as fast as it does at first
        edits=(
            (
                "0.orig/pointDisplacement",
                "type +sixDoFRigidBodyDisplacement;",
                "type uniformFixedValue; uniformValue table"
                " ((0 (0 0 0)) (1 (0 -3.77 0)));",
            ),
        ),
        limit="ayers",
    ),
    Tutorial(
        "mesh/moveDynamicMesh/relativeMotion/box2D_moveDynamicMesh",
        scale=0.5,
        solver="solidBodyDisplacementLaplacian",
        deltaT=0.005,
    ),
    Tutorial(
        "mesh/moveDynamicMesh/twistingColumn",
        limit="a coded motion keeps its solver",
    ),
    # Bodies that the flow moves
    Tutorial(
        "multiphase/interFoam/RAS/floatingObject",
        0.6,
        bodies=("floatingObject",),
        **BODY,
    ),
    Tutorial(
        "multiphase/interFoam/RAS/floatingObject",
        0.6,
        bodies=("floatingObject",),
        dict="dynamicMeshDict.sixDoF",
        edits=(
            no_code("constant/dynamicMeshDict.sixDoF", 500, 0.3, 0.2, 0.5),
        ),
        **BODY,
    ),
    Tutorial(
        "multiphase/interFoam/RAS/DTCHullMoving",
        bodies=("hull",),
        edits=COARSE_HULL,
        deltaT=0.005,
        **BODY,
    ),
    Tutorial(
        "multiphase/interFoam/RAS/DTCHullMoving",
        bodies=("hull",),
        edits=COARSE_HULL,
        deltaT=0.005,
        dict="dynamicMeshDict.sixDoF",
        **BODY,
    ),
    Tutorial(
        PIMPLE + "RAS/wingMotion/wingMotion2D_pimpleFoam",
        levels=1,
        bodies=("wing",),
        **BODY,
    ),
    # Overset meshes
    Tutorial("basic/overLaplacianDyMFoam/heatTransfer", own=True, steps=9),
    Tutorial(
        "basic/overPotentialFoam/cylinder/cylinderAndBackground",
        own=True,
        steps=2,
        root="..",
    ),
    Tutorial(
        "compressible/overRhoSimpleFoam/hotCylinder/cylinderAndBackground",
        root="..",
        **CYLINDER,
    ),
    Tutorial(
        "incompressible/overPimpleDyMFoam/cylinder/cylinderAndBackground",
        root="..",
        **CYLINDER,
    ),
    Tutorial(
        "incompressible/overSimpleFoam/aeroFoil/background_overset",
        root="..",
        own=True,
        levels=2,
        steps=4,
    ),
    Tutorial("compressible/overRhoPimpleDyMFoam/twoSimpleRotors", **ROTORS),
    Tutorial("incompressible/overPimpleDyMFoam/simpleRotor", **ROTORS),
    Tutorial("incompressible/overPimpleDyMFoam/twoSimpleRotors", **ROTORS),
    Tutorial(OVER + "twoSimpleRotors", **ROTORS),
    Tutorial(
        "heatTransfer/overBuoyantPimpleDyMFoam/movingBox",
        **dict(ROTORS, scale=1),
    ),
    Tutorial(
        OVER + "floatingBody/background",
        0.25,
        root="..",
        bodies=("floatingObject",),
        edits=(
            no_code(
                "background/constant/dynamicMeshDict", 700, 0.24, 0.24, 0.4
            ),
        ),
        steps=8,
        **BODY,
    ),
    Tutorial(
        OVER + "floatingBodyWithSpring/background",
        0.25,
        root="..",
        bodies=("floatingObject",),
        edits=(
            no_code(
                "background/constant/dynamicMeshDict", 500, 0.24, 0.24, 0.4
            ),
        ),
        solver="sixDoFRigidBodyMotion",
        steps=8,
        **BODY,
    ),
    Tutorial(
        OVER + "boatAndPropeller",
        # Coarser, no cells are left between the overset parts and the walls
        0.6,
        bodies=("hullWall", "propellerWall", "rudderWall"),
        steps=4,
        **BODY,
    ),
    # Rigid motion of the mesh or of zones
    Tutorial(
        "combustion/XiDyMFoam/annularCombustorTurbine",
        rigid=True,
        levels=1,
        scale=0.6,
    ),
    Tutorial(
        "compressible/rhoPimpleFoam/RAS/annularThermalMixer",
        rigid=True,
        levels=2,
    ),
    Tutorial(PIMPLE + "RAS/oscillatingInletACMI2D", 0.5, rigid=True),
    Tutorial(PIMPLE + "RAS/oscillatingInletPeriodicAMI2D", 0.5, rigid=True),
    Tutorial(PIMPLE + "RAS/propeller", **PROPELLER),
    Tutorial(PIMPLE + "RAS/rotatingFanInRoom", 0.6, rigid=True),
    Tutorial(PIMPLE + "laminar/mixerVesselAMI2D", rigid=True),
    Tutorial(
        "lagrangian/icoUncoupledKinematicParcelDyMFoam/mixerVesselAMI2D",
        rigid=True,
    ),
    Tutorial("multiphase/interFoam/RAS/mixerVesselAMI", 0.4, 1, rigid=True),
    Tutorial("multiphase/interPhaseChangeDyMFoam/propeller", **PROPELLER),
    Tutorial(
        "multiphase/multiphaseInterDyMFoam/laminar/mixerVesselAMI2D",
        rigid=True,
    ),
    Tutorial(
        "mesh/foamyHexMesh/mixerVessel",
        rigid=True,
        reason="its mesh needs foamyHexMesh, which Debian does not have",
    ),
    *[
        Tutorial(path, scale, rigid=True)
        for path, scale in (
            ("multiphase/compressibleInterDyMFoam/laminar/sloshingTank2D", 1),
            ("multiphase/interIsoFoam/sloshingTank2D", 1),
            (SLOSHING + "sloshingCylinder", 0.6),
            (SLOSHING + "sloshingTank2D", 1),
            (SLOSHING + "sloshingTank2D3DoF", 1),
            (SLOSHING + "sloshingTank3D", 0.6),
            (SLOSHING + "sloshingTank3D3DoF", 0.6),
            (SLOSHING + "sloshingTank3D6DoF", 0.6),
            (SLOSHING + "testTubeMixer", 1),
        )
    ],
]


def tutorials(folder):
    """Every tutorial below the folder whose dictionary moves a mesh, in order:
    those of other releases that nothing is known about run with defaults."""
    known = {tutorial.name: tutorial for tutorial in KNOWN}
    found = []
    for path in sorted(
        pathlib.Path(folder).rglob("constant/dynamicMeshDict*")
    ):
        if AT_REST.search(path.read_text()):
            continue
        case = str(path.parents[1].relative_to(folder))
        tutorial = Tutorial(case, dict=path.name)
        found.append(known.get(tutorial.name, tutorial))
    return found
