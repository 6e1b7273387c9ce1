# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Sweeps of shapes with morphFoam, and reading of what OpenFOAM writes.

    import morphfoam

    study = morphfoam.Study("study.yaml")     # a sweep: see help(study)
    study.sample()
    study.run()
    table = study.results()                   # a pandas DataFrame
    study.optimise()
    study.front()

    morphfoam.read_columns("postProcessing/forces/0/coefficient.dat")["Cd"]
    morphfoam.read_table(path)                # the same as a DataFrame
    morphfoam.iterations("log.simpleFoam")    # steps, converged
    morphfoam.read_vectors("constant/polyMesh/points")
    morphfoam.patch_points("constant/polyMesh", "walls")

Study                        a sweep, its results and its optimum
StudyError                   what is wrong with a study, and what to do
read_columns, read_table     tables of function objects and of morphMesh
iterations                   of a steady solver's log
read_vectors, patch_points   points and patches of a mesh in ascii files

What needs packages imports them when it is used: read_columns and iterations
need Python alone, read_vectors numpy, DataFrames pandas, a study what
pyproject.toml lists. Pictures: help("morphfoam.pictures").
"""

import importlib

__version__ = "1.0"

HOMES = {
    "Study": "morphfoam.study.api",
    "StudyError": "morphfoam.study.errors",
    "iterations": "morphfoam.output.tables",
    "patch_points": "morphfoam.output.mesh_files",
    "read_columns": "morphfoam.output.tables",
    "read_table": "morphfoam.frames",
    "read_vectors": "morphfoam.output.mesh_files",
}
__all__ = list(HOMES)


def __getattr__(name):
    """Imported when first used: a tutorial's Python may have no numpy."""
    if name not in HOMES:
        raise AttributeError(f"module 'morphfoam' has no attribute '{name}'")
    return getattr(importlib.import_module(HOMES[name]), name)


def __dir__():
    return sorted([*globals(), *HOMES])
