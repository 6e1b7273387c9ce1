# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Fields of a mesh that was re-meshed.

Sources of truth: the sum of volume times value before and after, with volumes
that OpenFOAM's own function objects write; constant and linear fields, known
everywhere.
"""

import numpy as np
import pytest

from boxCase import box
from cellFields import measure, read_internal, write_field
from rbfCase import CUBE

pytestmark = pytest.mark.filterwarnings("error")

REMESH = "remesh { engine madlib; region all; keepLayers 1; %s }"

FIELDS = {
    "constant": lambda x: np.full(len(x), 3.7),
    "linear": lambda x: 2 + x @ [1.0, -2.0, 0.5],
    "velocity": lambda x: x @ [[1, 2, 3], [0, 1, -1], [2, 0, 5]] + [1, 0, 2],
    "stress": lambda x: np.hstack([x, 2 - x, x[:, ::-1]]),
    "jump": lambda x: (x[:, 0] + 0.3 * x[:, 1] > 0.6).astype(float),
    "ramp": lambda x: np.clip(3 * (x[:, 0] - 0.4), 0, 1),
    "wave": lambda x: np.sin(5 * x[:, 0]) * np.cos(4 * x[:, 1]) + x[:, 2],
}


def remeshed(path, amplitude):
    """Fields by formula on a mesh whose points inside are off by an amplitude;
    what they are before and after."""
    case = box(path, CUBE, {"end": 2}, cells=(7, 6, 6))
    x = case.points("constant/polyMesh/points")
    inside = ((x > 1e-9) & (x < 1 - 1e-9)).all(1)
    x[inside] += amplitude * np.random.default_rng(1).uniform(
        -1, 1, (inside.sum(), 3)
    )
    case.write(
        "constant/polyMesh/points",
        "vectorField",
        f"{len(x)}\n(\n"
        + "\n".join("(%.17g %.17g %.17g)" % tuple(row) for row in x)
        + "\n)",
    )
    (case.path / "0").mkdir(exist_ok=True)
    write_field(case, "0/none", [0.0])
    centres, volumes = measure(case, "0")
    (case.path / "0/none").unlink()
    for name in ("C", "Cx", "Cy", "Cz", "V"):
        (case.path / "0" / name).unlink(missing_ok=True)
    for name, formula in FIELDS.items():
        write_field(case, f"0/{name}", formula(centres))
    case.write(
        "system/remeshDict", "dictionary", REMESH % "limits { skewness 9; }"
    )
    case.run("morphRemesh")
    after = {name: read_internal(case, f"1/{name}") for name in FIELDS}
    new_centres, new_volumes = measure(case, "1")
    assert len(new_volumes) != len(volumes)
    before = {
        name: formula(centres).reshape(len(centres), -1)
        for name, formula in FIELDS.items()
    }
    return before, volumes, after, new_volumes, new_centres


@pytest.fixture(scope="module")
def plane(tmp_path_factory):
    return remeshed(tmp_path_factory.mktemp("plane"), 0)


@pytest.fixture(scope="module")
def warped(tmp_path_factory):
    return remeshed(tmp_path_factory.mktemp("warped"), 0.02)


@pytest.mark.parametrize("mesh", ["plane", "warped"])
def test_nothing_is_lost(mesh, request):
    before, volumes, after, new_volumes, _ = request.getfixturevalue(mesh)
    for name in FIELDS:
        scale = volumes @ np.abs(before[name])
        lost = new_volumes @ after[name] - volumes @ before[name]
        assert np.abs(lost / scale).max() < 1e-12, name


@pytest.mark.parametrize("mesh", ["plane", "warped"])
def test_constants_stay_and_bounds_are_kept(mesh, request):
    _, _, after, _, _ = request.getfixturevalue(mesh)
    assert np.abs(after["constant"] - 3.7).max() < 1e-13
    for name in ("jump", "ramp"):
        assert after[name].min() >= 0 and after[name].max() <= 1
        assert np.ptp(after[name]) == 1


def test_linear_fields_are_exact(plane):
    _, _, after, _, centres = plane
    for name in ("linear", "velocity", "stress"):
        exact = FIELDS[name](centres).reshape(after[name].shape)
        assert np.abs(after[name] - exact).max() < 1e-12, name


def test_linear_fields_are_almost_exact_in_cells_with_warped_faces(warped):
    """Where OpenFOAM's centre of a cell is not its centroid."""
    _, _, after, _, centres = warped
    assert (
        np.abs(after["linear"][:, 0] - FIELDS["linear"](centres)).max() < 1e-3
    )


def test_smooth_fields_are_close(plane):
    """To second order: the old cells are 1/7 to 1/6 long."""
    _, _, after, volumes, centres = plane
    error = after["wave"][:, 0] - FIELDS["wave"](centres)
    assert np.sqrt(volumes @ error**2 / volumes.sum()) < 0.04
