#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""reference.py [FILE]: one page with every dictionary entry, made from the
headers of the classes that read them. tests/docs/test_reference.py holds the
tables of those headers against what the sources read.
"""

import pathlib
import re
import sys

from classHeaders import ClassHeader, plain

ROOT = pathlib.Path(__file__).resolve().parents[1]

# What a dictionary is called, the class whose header has its table, and, where
# they are not those of the class itself, the sources that read its entries
DICTIONARIES = [
    (
        "rbfMotionSolverCoeffs",
        "rbfMotionSolver",
        [
            "rbfMotionSolver",
            "rbfMotionSettings",
            "controlPointGroups",
            "motionLimiter",
            "motionZone",
            "rigidMotion",
        ],
    ),
    (
        "A group of controlPoints",
        "controlPointGroup",
        ["controlPointGroup", "controlPointGroupEntries"],
    ),
    ("surface or target: a cylinder", "cylinderSurface", []),
    ("surface or target: others", "analyticSurface", ["slidingSurface"]),
    ("displacement: pointDisplacement", "fieldDisplacement", []),
    ("displacement: cellDisplacement", "cellDisplacement", []),
    ("displacement: uniform", "uniformDisplacement", []),
    ("displacement: velocity", "velocityDisplacement", []),
    ("displacement: solidBody", "solidBodyDisplacement", []),
    (
        "displacement: values",
        "valuesDisplacement",
        ["valuesDisplacement", "tabulatedDisplacement"],
    ),
    (
        "displacement: polyline",
        "polylineDisplacement",
        ["polylineDisplacement", "tabulatedDisplacement"],
    ),
    (
        "displacement: file",
        "fileDisplacement",
        ["fileDisplacement", "tabulatedDisplacement"],
    ),
    (
        "displacement: ffd",
        "ffdDisplacement",
        ["ffdDisplacement", "ffdBoxes", "ffdBoxesStages"],
    ),
    (
        "displacement: sixDoFRigidBody",
        "sixDoFRigidBodyDisplacement",
        ["sixDoFRigidBodyDisplacement", "bodyInFlow", "sixDoFRigidBody"],
    ),
    (
        "displacement: rigidBody",
        "rigidBodyDisplacement",
        ["rigidBodyDisplacement", "bodyInFlow", "jointedBodies", "bodyTree"],
    ),
    (
        "ffdMotionSolverCoeffs",
        "ffdMotionSolver",
        [
            "ffdMotionSolver",
            "ffdBoxes",
            "ffdBoxesStages",
            "motionLimiter",
            "motionZone",
        ],
    ),
    (
        "A box of boxes",
        "ffdBox",
        [
            "ffdBox",
            "ffdBoxEntries",
            "ffdBoxFaces",
            "ffdBoxSettings",
            "ffdDeformation",
            "ffdFrames",
        ],
    ),
    ("A parameter of a box", "ffdParameter", []),
    ("bulk: many parameters at once", "ffdBulk", []),
    ("axis: reference axis and variables", "ffdAxis", []),
    ("A box of type axis", "ffdAxisDeformation", []),
    ("A box of type lattice", "ffdLatticeFile", []),
    ("A box around patches", "ffdFit", []),
    (
        "constraints of shapes",
        "shapeConstraint",
        ["shapeConstraint", "shapeConstraintTypes", "shapeConstraints"],
    ),
    ("optimise, and system/optimiseDict", "optimiseSettings", []),
    ("keep: what stays as it is", "ffdCorrection", []),
    (
        "remesh: cells replaced by tetrahedra",
        "remeshSettings",
        ["remeshSettings", "remeshEngine", "externalEngine"],
    ),
    ("morphRemeshFvMesh: in a running solver", "morphRemeshFvMesh", []),
    ("Function object motionControls", "motionControls", []),
    ("Function object morphMetric", "morphMetric", []),
    ("Function object catalyst", "catalystFunctionObject", []),
    (
        "A channel of catalyst: mesh",
        "meshChannel",
        ["meshChannel", "catalystChannel"],
    ),
    (
        "A channel of catalyst: controls",
        "controlsChannel",
        ["controlsChannel", "catalystChannel"],
    ),
]

# Entries whose values need more than a row: what they are, and the class
EXPLAINED = [
    ("onInvalidMesh", "motionLimiter"),
    ("images", "motionImages"),
    ("How a mesh is optimised", "meshOptimiser"),
]

# Sources that read what no user writes, and why
NOT_A_USERS = {
    "caseSelection": "options of applications",
    "rbfMotionState": "the file that a restart reads",
    "cellDisplacementField": "OpenFOAM's own field file",
    "otherSolvers": "entries of OpenFOAM's motion solvers, for messages",
    "pointDisplacementField": "OpenFOAM's own field file",
    "motionZone": "entries of OpenFOAM's, which the solvers refuse",
    "velocityFields": "field files of OpenFOAM's motion solvers, for messages",
    "prescribedDisplacement": "the type of a displacement: in each table",
}

# Entries that a base class of OpenFOAM reads
READ_BY_OPENFOAM = {
    "motionControls": {"type", "region"},
    "morphMetric": {"type", "region"},
    "catalystFunctionObject": {"type"},
    "analyticSurface": {"type"},
}

# Likewise single entries, as (source, entry)
NOT_AN_ENTRY = {
    ("rigidMotion", "diffusivity"): "of OpenFOAM's solvers that deform",
    ("sixDoFRigidBody", "deltaT"): "in the file that a restart reads",
    ("controlPointGroupEntries", "n"): "written by OpenFOAM's own condition",
    ("ffdFit", "boxes"): "the boxes of the dictionary",
    ("ffdFit", "origin"): "an entry of the box",
    ("ffdFit", "span"): "an entry of the box",
    ("ffdFit", "rotation"): "an entry of the box",
    ("ffdFit", "type"): "an entry of the box",
    ("ffdCorrection", "min"): "refused: a number to keep has no bounds",
    ("ffdCorrection", "max"): "refused: a number to keep has no bounds",
    ("morphRemeshFvMesh", "correctPhi"): "of OpenFOAM's fvSolution",
    ("morphRemeshFvMesh", "ddtSchemes"): "of OpenFOAM's fvSchemes",
    ("morphRemeshFvMesh", "inVain"): "in the file that a restart reads",
    ("morphRemeshFvMesh", "lastStep"): "in the file that a restart reads",
    ("morphRemeshFvMesh", "remeshings"): "in the file that a restart reads",
    ("ffdBulk", "s"): "a direction",
    ("ffdBulk", "t"): "a direction",
    ("ffdBulk", "p"): "a direction",
}


def header(name):
    """The header of a class of ours, by its name."""
    found = sorted((ROOT / "src").rglob(name + ".H"))
    found = [path for path in found if "lnInclude" not in path.parts]
    if len(found) != 1:
        raise SystemExit(f"reference.py: there is no header {name}.H in src")
    return ClassHeader(found[0])


def entries_read(text):
    """The names of dictionary entries in a C++ source: those that it takes
    from a dictionary, and those that it allows there."""
    text = re.sub(r"//.*", "", text)
    methods = (
        r"get|getOrDefault|getCheck\w*|found|findDict|subDict\w*|lookup"
        r"|findEntry|isDict|readIfPresent|readEntry|optionalSubDict"
    )
    names = re.findall(
        rf"(?:\.|->|\b)(?:{methods})(?:<[^()]*>)?\s*\(\s*\"(\w+)\"", text
    )
    # Through a function of ours: (dict, "entry", or (name, dict) of a Function1
    names += re.findall(r"\(\s*\w*[dD]ict\w*(?:\(\))?,\s*\"(\w+)\"", text)
    names += re.findall(r"::New\s*\(\s*\"(\w+)\",\s*\w*[dD]ict", text)
    # Lists of names
    lists = re.findall(
        r"(?:onlyKeys\s*\([^{;]*|wordList(?: \w+)?\s*\(\s*|"
        r"return )\{([^{};]*)\}",
        text,
    )
    for call in re.findall(r"(?:onlyKeys|checkValues)\s*\(([^;]*);", text):
        lists += re.findall(r"\{([^{};]*)\}", call)
    lists += re.findall(r"keys\.append\((\"\w+\")\)", text)
    lists += re.findall(r"const char\* key :\s*\{([^{}]*)\}", text)
    for one in lists:
        names += re.findall(r'"(\w+)"', one)
        if re.search(r'\w+ \+ "Coeffs"', one):
            names.append("<name>Coeffs")
    return {name for name in names if name != "Coeffs"}


def source_text(name):
    found = [
        path
        for path in (ROOT / "src").rglob(name + ".C")
        if "lnInclude" not in path.parts
    ]
    return found[0].read_text() if found else ""


def entries_of(name, sources):
    """What the sources of a dictionary read."""
    return READ_BY_OPENFOAM.get(name, set()) | {
        entry
        for source in sources or [name]
        for entry in entries_read(source_text(source))
        if (source, entry) not in NOT_AN_ENTRY
    }


def anchor(title):
    return re.sub(r"[^\w]+", "-", title.lower()).strip("-")


def index(dictionaries):
    """All entries by name, with where they stand."""
    places = {}
    for title, name, _ in dictionaries:
        for row in header(name).entries():
            places.setdefault(plain(row[0]), []).append(
                f"[{title}](#{anchor(title)})"
            )
    lines = ["| Entry | In |", "| --- | --- |"]
    for entry in sorted(places, key=str.lower):
        where = list(dict.fromkeys(places[entry]))
        lines.append(f"| `{entry}` | {', '.join(where)} |")
    return "\n".join(lines)


def heading(title):
    return f"## {title} {{#{anchor(title)}}}"


def linked(text):
    """Headers that a text refers to become links to what they say here."""
    places = {name: title for title, name, *_ in DICTIONARIES + EXPLAINED}

    def link(match):
        name = match[1]
        if name not in places:
            return f"`{match[0]}`"
        return f"[{places[name]}](#{anchor(places[name])})"

    # Not in code
    pieces = re.split(r"(```.*?```|`[^`]*`)", text, flags=re.DOTALL)
    pieces[::2] = [re.sub(r"\b(\w+)\.H\b", link, p) for p in pieces[::2]]
    return "".join(pieces)


def page():
    parts = [
        "# Every entry",
        "Made from the headers of the classes that read these dictionaries. "
        "An entry that is not here is an error. Times and factors that are "
        "*Function1 of time* may be a number or any of OpenFOAM's functions: "
        "`constant 1`, `table ((0 0) (1 0.5))`, `sine`, ...",
        "## All entries by name",
        index(DICTIONARIES),
    ]
    for title, name, _ in DICTIONARIES:
        head = header(name)
        notes = head.markdown("Note")
        parts += [
            heading(title),
            head.markdown("Description"),
            head.markdown("Usage"),
            notes and "**Notes**",
            notes,
        ]
    for title, name in EXPLAINED:
        head = header(name)
        parts += [
            heading(title),
            head.markdown("Description"),
            head.markdown("Note"),
        ]
    return linked("\n\n".join(filter(None, parts))) + "\n"


if __name__ == "__main__":
    if len(sys.argv) > 1:
        pathlib.Path(sys.argv[1]).write_text(page())
    else:
        print(page(), end="")
