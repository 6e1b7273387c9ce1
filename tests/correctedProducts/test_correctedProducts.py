# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Products of temporaries, where Debian's OpenFOAM gets them wrong.

Where its libraries are right, or OpenFOAM is the user's own, there is no
libmorphCorrectedProducts, and nothing to test.
"""

import os
import pathlib
import re
import shutil
import subprocess

import numpy as np
import pytest

from foamCase import environment

LIBRARY = "libmorphCorrectedProducts.so"

pytestmark = pytest.mark.skipif(
    LIBRARY not in environment().get("LD_PRELOAD", ""),
    reason="this OpenFOAM's products of temporaries are right",
)


def uncorrected():
    """The environment without the library."""
    return {**environment(), "LD_PRELOAD": ""}


def products(env):
    """The largest relative error of each product, by checkProducts."""
    run = subprocess.run(
        ["checkProducts"], env=env, text=True, capture_output=True
    )
    rows = re.findall(
        r"^(volume|surface|point|list) +(.+?)  (\S+)$",
        run.stdout,
        re.MULTILINE,
    )
    assert len(rows) == 91
    errors = {f"{where} {what}": float(error) for where, what, error in rows}
    assert run.returncode == int(max(errors.values()) > 1e-12)
    return errors


def test_products_of_temporaries_are_those_of_plain_loops():
    """Truth: loops over the cells in checkProducts.C."""
    assert max(products(environment()).values()) <= 1e-12


def test_without_the_library_each_inner_product_is_wrong():
    """The library corrects what is wrong, and nothing else is."""
    wrong = {
        what
        for what, error in products(uncorrected()).items()
        if error > 1e-12
    }
    assert len(wrong) == 42
    assert all(" dot " in what for what in wrong)


def test_programs_without_openfoam_do_not_notice_the_library():
    run = subprocess.run(
        ["/bin/sh", "-c", "echo right"],
        env=environment(),
        capture_output=True,
        text=True,
        check=True,
    )
    assert (run.stdout, run.stderr) == ("right\n", "")


def test_what_the_user_preloads_stays():
    """And sourcing twice adds nothing."""
    root = pathlib.Path(__file__).resolve().parents[2]
    run = subprocess.run(
        ["bash", "-c", ". etc/bashrc && . etc/bashrc && echo $LD_PRELOAD"],
        cwd=root,
        env={**os.environ, "LD_PRELOAD": "libm.so.6"},
        capture_output=True,
        text=True,
        check=True,
    )
    first, second = run.stdout.strip().split(":")
    assert first.endswith(LIBRARY)
    assert second == "libm.so.6"


def cavity(folder, angle, env):
    """OpenFOAM's buoyantCavity, coarse and laminar, with its mesh and gravity
    turned about z: speed of each cell after an iteration."""
    tutorial = pathlib.Path(env["FOAM_TUTORIALS"])
    shutil.copytree(
        tutorial / "heatTransfer/buoyantSimpleFoam/buoyantCavity", folder
    )

    def replace(file, pattern, text):
        path = folder / file
        old = path.read_text()
        new = re.sub(pattern, text, old, flags=re.DOTALL)
        assert new != old, f"{pattern} is not in {file}"
        path.write_text(new)

    replace("system/blockMeshDict", r"\(35 150 15\)", "(10 20 4)")
    replace("system/controlDict", r"endTime +\d+", "endTime 1")
    replace("system/controlDict", r"writeInterval +\d+", "writeInterval 1")
    replace("system/controlDict", r"writePrecision +\d+", "writePrecision 12")
    # One iteration: the start from rest is violent, and round-off grows
    replace("system/fvSolution", r"relTol +[\d.]+", "relTol 0")
    replace("system/fvSolution", r"tolerance +\S+;", "tolerance 1e-13;")
    replace(
        "constant/turbulenceProperties",
        r"simulationType +RAS",
        "simulationType laminar",
    )
    down = 9.81 * np.array([np.sin(angle), -np.cos(angle), 0])
    replace(
        "constant/g",
        r"\(0 -9.81 0\)",
        "({:.17g} {:.17g} {:.17g})".format(*down),
    )

    def run(*command):
        subprocess.run(
            command,
            cwd=folder,
            env={**env, "PWD": str(folder)},
            check=True,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )

    run("blockMesh")
    run("transformPoints", "-rollPitchYaw", f"(0 0 {np.degrees(angle)})")
    run(pathlib.Path(env["FOAM_APPBIN"]) / "buoyantSimpleFoam")

    text = (folder / "1/U").read_text()
    values = re.search(r"internalField.*?\(\n(.*?)\n\)", text, re.DOTALL)
    rows = values.group(1).replace("(", "").replace(")", "").split("\n")
    return np.linalg.norm(np.array([r.split() for r in rows], float), axis=1)


def difference(one, other):
    """The largest, of the range."""
    return np.abs(one - other).max() / np.ptp(other)


def test_a_flow_does_not_depend_on_the_direction_of_its_axes(tmp_path):
    """A shipped solver, which has its own copy of a product, and whose pressure
    gradient is fvc::reconstruct. Truth: the same case along the axes."""
    along = cavity(tmp_path / "along", 0, environment())
    turned = cavity(tmp_path / "turned", np.radians(30), environment())
    assert difference(turned, along) < 1e-6

    wrong = cavity(tmp_path / "uncorrected", np.radians(30), uncorrected())
    assert difference(wrong, along) > 1e-2
