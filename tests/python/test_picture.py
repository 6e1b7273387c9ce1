# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""morphfoam.pictures.picture: what is where in the picture, pixel by pixel. The mesh is
the unit square, its field the x of the cell centres."""

import pathlib
import shutil
import subprocess

import numpy as np
import pytest

from boxCase import box
from foamCase import ROOT, environment

SCRIPT = """
from morphfoam.pictures.picture import picture
picture("case", "out/mesh.png", box=(-1, 1, 0, 1), lines=False, width=200)
picture("case", "out/lines.png", box=(0, 1, 0, 1), width=200)
picture("case", "out/field.png", box=(0, 1, 0, 1), field="X", range=(0, 1),
        lines=False, width=200)
for name, options in (("case", {"time": 3}), ("empty", {})):
    try:
        picture(name, "out/none.png", **options)
    except (ValueError, FileNotFoundError) as error:
        print(error)
"""


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    """The pictures as arrays of rows of pixels, and what was said."""
    image = pytest.importorskip("matplotlib.image")
    found = subprocess.run(
        [ROOT / "bin/python3With", "paraview.simple"],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    )
    if found.returncode or not shutil.which("xvfb-run"):
        pytest.skip("no ParaView")
    folder = tmp_path_factory.mktemp("pictures")
    case = box(
        folder / "case",
        {
            "sides": ("patch", "xMin xMax yMin yMax"),
            "front": ("empty", "zMin zMax"),
        },
        cells=(4, 4, 1),
    )
    # The times are those of folders: 1 and 2
    for time in ("1", "2"):
        case.write(
            f"{time}/X",
            "volScalarField",
            """
            dimensions [0 0 0 0 0 0 0]; internalField nonuniform List<scalar> 16
            ("""
            + " ".join("0.125 0.375 0.625 0.875" for _ in range(4))
            + """);
            boundaryField { sides { type zeroGradient; } front { type empty; } }
            """,
        )
    (folder / "empty").mkdir()
    (folder / "script.py").write_text(SCRIPT)
    done = subprocess.run(
        [ROOT / "bin/withDisplay", found.stdout.decode().strip(), "script.py"],
        cwd=folder,
        text=True,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    assert done.returncode == 0, done.stdout
    return (
        {
            path.stem: image.imread(path)[:, :, :3]
            for path in pathlib.Path(folder / "out").iterdir()
        },
        done.stdout,
    )


def test_the_box_is_what_the_picture_shows(pictures):
    mesh = pictures[0]["mesh"]
    assert mesh.shape[:2] == (100, 200)
    # Nothing left of x = 0, the mesh right of it; the edge may be shared
    assert (mesh[:, :98] == 1).all()
    assert (mesh[1:-1, 102:-2] < 0.999).any(axis=2).all()


def test_lines_are_where_the_cells_meet(pictures):
    lines = pictures[0]["lines"]
    dark = lines.sum(axis=2) < 2.3
    # The inner lines of 4 x 4 cells, along the row and the column of pixels
    # through the middle of cells
    for row in (dark[75], dark[:, 75]):
        at = np.flatnonzero(row[5:-5]) + 5
        assert sorted({round(k / 50) for k in at}) == [1, 2, 3]
        assert np.abs(at / 50 - np.round(at / 50)).max() < 0.05


def test_colours_follow_the_field(pictures):
    field = pictures[0]["field"]
    # Cool to warm: from left to right ever more red, ever less blue
    middle = field[20, [25, 75, 125, 175]]
    assert (np.diff(middle[:, 0] - middle[:, 2]) > 0).all()


def test_a_time_that_is_not_there_and_a_missing_mesh_are_errors(pictures):
    images, said = pictures
    assert "has no time 3, but [1.0, 2.0]" in said
    assert "empty has no mesh" in said
    assert "none" not in images
