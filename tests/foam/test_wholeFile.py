# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Files are written whole or not at all, also on a disk that is full.

Source of truth: the file that was there before, byte for byte; a limit on the
size of files (setrlimit, EFBIG) stands for a disk without room.
"""

import gzip
import resource

import pytest
from boxCase import fixed, write_control
from ffdCase import ffd_box, ffd_case, parameter
from fuzzCases import surface
from rbfCase import CUBE, rbf_case

BOX = ffd_box("b", parameter("mu", [((1, 1, 1), (0, 0, 1))]))


def run_with_limit(case, size, *command, status=1, ranks=1):
    """Run with files of at most so many bytes.

    As root, mpirun keeps the limit for its ranks; its own files are small.
    """
    return case.run(
        *command,
        ranks=ranks,
        status=status,
        before=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)),
    )


@pytest.mark.parametrize(
    "control", [{}, {"format": "binary"}], ids=["ascii", "binary"]
)
def test_morphMesh_leaves_the_mesh_when_the_disk_is_full(tmp_path, control):
    case = ffd_case(tmp_path, BOX, control=control, cells=(6, 6, 6))
    before = case.tree()
    output = run_with_limit(case, 2000, "morphMesh", "-overwrite")
    assert "Cannot write" in output
    assert "constant/polyMesh/points0" in output
    assert case.tree() == before


def test_the_old_points_stay_where_the_new_ones_do_not_fit(tmp_path):
    case = ffd_case(tmp_path, BOX, cells=(6, 6, 6))
    points = case.path / "constant/polyMesh/points"
    (case.path / "constant/polyMesh/points0").write_bytes(points.read_bytes())
    before = points.read_bytes()
    # Moved points have more digits than those there are
    output = run_with_limit(case, len(before) + 100, "morphMesh", "-overwrite")
    assert "constant/polyMesh/points" in output
    assert points.read_bytes() == before
    assert not list(points.parent.glob("partial*"))


def test_compressed_points_are_whole(tmp_path):
    case = ffd_case(tmp_path, BOX, cells=(6, 6, 6))
    control = case.path / "system/controlDict"
    control.write_text(
        control.read_text().replace(
            "writeCompression off", "writeCompression on"
        )
    )
    output = run_with_limit(case, 2000, "morphMesh")
    assert "polyMesh/points.gz" in output
    assert not (case.path / "0/polyMesh/points.gz").exists()
    case.run("morphMesh")
    with gzip.open(case.path / "0/polyMesh/points.gz", "rt") as points:
        assert points.read().count("(") > 7**3


def test_all_ranks_keep_their_points_if_one_cannot_write(tmp_path):
    case = rbf_case(
        tmp_path,
        patches=CUBE,
        cells=(6, 6, 6),
        conditions={
            "zMax": fixed(0, 0, 0.1),
            **{s: "slip" for s in ("xMin", "xMax")},
            **{s: fixed(0, 0, 0) for s in ("yMin", "yMax", "zMin")},
        },
    )
    write_control(case)
    case.decompose((2, 1, 1))
    points = {
        p: p.read_bytes()
        for p in case.path.glob("processor*/constant/polyMesh/points")
    }
    size = min(len(content) for content in points.values())
    # Only one of them is refused: rank 1 may write nothing
    folder = case.path / "processor1/constant/polyMesh/points0"
    folder.mkdir()
    output = case.run("morphMesh", "-overwrite", ranks=2, status=1)
    assert "points0" in output and size > 0
    assert all(p.read_bytes() == content for p, content in points.items())


@pytest.mark.parametrize("kind", ["stl", "obj", "stlb"])
def test_morphSurface_writes_no_half_surface(tmp_path, kind):
    case = surface(tmp_path)
    output = case.path / f"out.{kind}"
    output.write_text("as it was")
    said = run_with_limit(case, 150, "morphSurface", "in.obj", output)
    assert str(output) in said
    assert output.read_text() == "as it was"
    case.run("morphSurface", "in.obj", output)
    assert output.read_bytes() != b"as it was"


def test_figures_that_cannot_be_written_are_an_error(tmp_path):
    case = ffd_case(tmp_path, BOX, cells=(2, 2, 2))
    (case.path / "postProcessing").write_text(
        "a file where a folder has to be"
    )
    output = case.run("morphMesh", status=1)
    assert "Cannot write" in output and "quality.dat" in output
