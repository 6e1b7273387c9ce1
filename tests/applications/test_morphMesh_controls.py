# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""morphMesh -lattice, -pictures, -derivatives, -constraints and
-sensitivityFields: what controls a motion, before a flow.

Sources of truth: a cube whose height a lattice of eight points scales by 1 + mu:
volume 1 + mu, area 2 + 4 (1 + mu), centroid at half the height.
"""

import json

import numpy as np
import pytest

import rbfCase
from ffdCase import ffd_box, ffd_case, parameter

MU = 0.25

RISE = [((i, j, 1), (0, 0, 1)) for i in (0, 1) for j in (0, 1)]


def cube(path, extra="min -0.5; max 2;"):
    return ffd_case(
        path,
        ffd_box(
            "cube",
            parameter("mu", RISE, MU, extra),
            order=(1, 1, 1),
            origin=(0, 0, 0),
            span=(1, 1, 1),
        ),
        cells=(4, 3, 2),
    )


def table(file):
    return [line.split() for line in file.read_text().splitlines()]


@pytest.mark.parametrize("ranks", [1, 2])
def test_derivatives_of_a_closed_boundary(tmp_path, ranks):
    case = cube(tmp_path)
    if ranks > 1:
        case.decompose((2, 1, 1))
    case.run(
        "morphMesh",
        "-time",
        "1",
        "-dryRun",
        "-derivatives",
        '(".*")',
        ranks=ranks,
    )
    folder = tmp_path / "postProcessing/morphMesh/1"
    head, before, after = table(folder / "measures.dat")
    assert head == "# shape area volume volumeCx volumeCy volumeCz".split()
    np.testing.assert_allclose(
        np.array(before[1:], float), [6, 1, 0.5, 0.5, 0.5], rtol=1e-14
    )
    np.testing.assert_allclose(
        np.array(after[1:], float),
        [2 + 4 * (1 + MU), 1 + MU, 0.5, 0.5, (1 + MU) / 2],
        rtol=1e-14,
    )
    head, row = table(folder / "derivatives.dat")
    assert row[0] == "cube.mu" and float(row[1]) == MU
    np.testing.assert_allclose(
        np.array(row[2:], float), [4, 1, 0, 0, 0.5], atol=1e-14
    )
    assert (folder / "derivatives.vtp").stat().st_size > 100
    assert not (tmp_path / "1/polyMesh").exists()


def test_an_open_patch_has_an_area_and_no_volume(tmp_path):
    case = cube(tmp_path)
    case.run("morphMesh", "-time", "1", "-dryRun", "-derivatives", "(xMin)")
    head, _, after = table(
        tmp_path / "postProcessing/morphMesh/1/measures.dat"
    )
    assert head == "# shape area areaCx areaCy areaCz".split()
    np.testing.assert_allclose(
        np.array(after[1:], float), [1 + MU, 0, 0.5, (1 + MU) / 2], atol=1e-14
    )


@pytest.mark.parametrize("ranks", [1, 2])
def test_lattice_and_bounds_are_shown(tmp_path, ranks):
    case = cube(tmp_path)
    if ranks > 1:
        case.decompose((1, 1, 2))
    case.run("morphMesh", "-time", "1", "-lattice", ranks=ranks)
    folder = tmp_path / "postProcessing/morphMesh/1/controls"
    assert {path.name for path in folder.iterdir()} == {
        "cube.vtk",
        "cubeAtRest.vtk",
        "cube.mu.min.vtp",
        "cube.mu.max.vtp",
        "surface.vtp",
    }
    lines = (folder / "cube.vtk").read_text().splitlines()
    first = (
        next(i for i, line in enumerate(lines) if line.startswith("POINTS 8"))
        + 1
    )
    points = np.array(
        [line.split() for line in lines[first : first + 8]], float
    )
    assert sorted(points[:, 2]) == [0] * 4 + [1 + MU] * 4


def test_control_points_of_radial_basis_functions_are_shown(tmp_path):
    case = rbfCase.rbf_case(
        tmp_path,
        coeffs=rbfCase.groups(
            top="type moving; patches (zMax);"
            " displacement { type uniform; value (0 0 0.1); }",
            bottom="type fixed; patches (zMin);",
        ),
    )
    output = case.run(
        "morphMesh", "-time", "1", "-lattice", "-derivatives", "(zMax)"
    )
    assert (
        tmp_path / "postProcessing/morphMesh/1/controls" "/controlPoints.vtk"
    ).exists()
    assert "has no parameters" not in output
    assert (tmp_path / "postProcessing/morphMesh/1/derivatives.dat").exists()


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_patch_that_is_not_there_is_an_error(tmp_path, ranks):
    case = cube(tmp_path)
    if ranks > 1:
        case.decompose((2, 1, 1))
    output = case.run(
        "morphMesh",
        "-time",
        "1",
        "-derivatives",
        "(hull)",
        ranks=ranks,
        status=1,
    )
    assert "no patch or patch group is called" in output
    assert "zMax" in output
    assert not list(tmp_path.glob("**/1/polyMesh/points"))


CORNERS = (
    "box { type corners; corners ((0 0 0) (1 0 0) (1.2 1 0) (0 1 0)"
    " (0 0 1) (1 0 1) (1.2 1 1) (0 1.1 1)); order (2 2 2); units metres;"
    " continuity none; parameters { a { value %r; moves ("
    " ((1 1 1) (0.1 0.2 0.3)) ((2 1 0) (0.1 0 0)) ); } } axis {"
    " through ((0.5 0.5 0) (0.5 0.5 1)); variables { t { type twist;"
    " value %r; along ((0 0) (0.5 1) (1 0)); } } } }"
)


def fields(case, ranks):
    """dx/dmu of both parameters in the order of the whole mesh."""
    if ranks > 1:
        return [
            case.decomposed_points(f"1/d_{name}")
            for name in ("box.a", "box.t")
        ]
    return [case.points(f"1/d_{name}") for name in ("box.a", "box.t")]


def test_sensitivity_fields_are_central_differences(tmp_path):
    """Through the constraints of the mesh: points of a symmetry plane keep it.
    On three ranks the same to the bit."""

    def moved(a, t, *options, ranks=1, folder="case"):
        case = ffd_case(
            tmp_path / folder,
            CORNERS % (a, t),
            "onInvalidMesh ignore;",
            cells=(4, 3, 5),
            patches={
                "zMin": "symmetryPlane",
                "rest": ("patch", "xMin xMax yMin yMax zMax"),
            },
        )
        if ranks > 1:
            case.decompose((3, 1, 1))
        case.run("morphMesh", "-time", "1", *options, ranks=ranks)
        return case

    h = 1e-4
    case = moved(0.3, 8.0, "-sensitivityFields")
    exact = fields(case, 1)
    for derivative, step in zip(exact, ((h, 0), (0, h))):
        up = moved(0.3 + step[0], 8 + step[1], folder="up")
        down = moved(0.3 - step[0], 8 - step[1], folder="down")
        difference = (
            up.points("1/polyMesh/points") - down.points("1/polyMesh/points")
        ) / (2 * h)
        assert np.abs(derivative).max() > 3e-3
        np.testing.assert_allclose(derivative, difference, rtol=0, atol=1e-8)
    parallel = moved(0.3, 8.0, "-sensitivityFields", ranks=3, folder="ranks")
    for one, other in zip(exact, fields(parallel, 3)):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("ranks", [1, 3])
def test_constraints_of_patches(tmp_path, ranks):
    """Closed forms of a cube that becomes higher."""
    case = ffd_case(
        tmp_path,
        ffd_box(
            "cube",
            parameter("mu", RISE, MU),
            order=(1, 1, 1),
            origin=(0, 0, 0),
            span=(1, 1, 1),
        ),
        """constraints { patches (".*");
            height { type thickness; stations ((0.4 0.3 0.5));
                     direction (0 0 1); max 1.2; }
            tank { type volume; relative yes; }
            skin { type wettedArea; } }""",
        cells=(4, 3, 2),
    )
    if ranks > 1:
        case.decompose((3, 1, 1))
    case.run("morphMesh", "-time", "1", "-dryRun", "-constraints", ranks=ranks)
    folder = tmp_path / "postProcessing/morphMesh/1"
    values = {row[0]: row[1:] for row in table(folder / "constraints.dat")[1:]}
    slopes = {
        row[0]: row[1:]
        for row in table(folder / "constraintDerivatives.dat")[1:]
    }
    for name, value, slope in (
        ("height.0", 1 + MU, 1),
        ("tank", 1 + MU, 1),
        ("skin", 2 + 4 * (1 + MU), 4),
    ):
        assert float(values[name][0]) == pytest.approx(value, abs=1e-13)
        assert float(slopes[name][0]) == pytest.approx(slope, abs=1e-13)
    assert float(values["height.0"][4]) == pytest.approx(0.05, abs=1e-13)


def test_a_box_around_patches_is_where_they_are(tmp_path):
    """A cube of 1 m, 10 % on every side, or 0.2 m: the formula of the box that
    is written by hand."""
    moves = [((1, 1, 1), (0, 0.3, 0))]
    for margin, low, span in (
        ("10 %", -0.1, 1.2),
        ("0.2", -0.2, 1.4),
        (None, -0.05, 1.1),
    ):
        text = "" if margin is None else f"margin {margin};"
        case = ffd_case(
            tmp_path / "around",
            'b { around (xMin "[xy]Max");'
            f" {text} order (2 2 2); parameters {{"
            + parameter("a", moves, "1")
            + "} }",
            cells=(3, 3, 3),
        )
        case.run("morphMesh", "-time", "1")
        other = ffd_case(
            tmp_path / "hand",
            ffd_box(
                "b",
                parameter("a", moves, "1"),
                origin=[low] * 3,
                span=[span] * 3,
            ),
            cells=(3, 3, 3),
        )
        other.run("morphMesh", "-time", "1")
        np.testing.assert_allclose(
            case.points("1/polyMesh/points"),
            other.points("1/polyMesh/points"),
            rtol=0,
            atol=1e-14,
        )


@pytest.mark.parametrize(
    "entries, words",
    [
        ("around (hull);", ["'around'", "hull", "xMin"]),
        ("around (xMin); origin (0 0 0);", ["'origin'", "beside 'around'"]),
        ("around (xMin);", ["flat", "'margin'"]),
        ("around (xMin); margin lots;", ["'margin'", "5 %"]),
    ],
)
def test_a_wrong_fit_is_an_error_that_helps(tmp_path, entries, words):
    case = ffd_case(
        tmp_path,
        f"b {{ {entries} order (2 2 2); parameters {{"
        + parameter("a", [((1, 1, 1), (0, 0.3, 0))])
        + "} }",
    )
    output = case.run("morphMesh", "-time", "1", status=1)
    for word in words:
        assert word in output


def test_one_picture_of_every_parameter_at_its_bounds(tmp_path):
    pytest.importorskip("matplotlib")
    case = cube(tmp_path)
    output = case.run("morphMesh", "-time", "1", "-pictures")
    sheet = tmp_path / "postProcessing/morphMesh/1/controls/preview.png"
    assert sheet.stat().st_size > 5000
    assert "1 parameters" in output or "1 parameter" in output


def test_times_of_a_lattice_are_one_series(tmp_path):
    """Each with its file, in the order of time."""
    case = cube(tmp_path)
    for time in ("2", "10", "0.5"):
        case.run("morphMesh", "-time", time, "-lattice")
    folder = tmp_path / "postProcessing/morphMesh"
    for shape in ("cube", "cubeAtRest"):
        series = json.loads((folder / f"{shape}.vtk.series").read_text())
        assert series["file-series-version"] == "1.0"
        assert [row["time"] for row in series["files"]] == [0.5, 2, 10]
        for row in series["files"]:
            assert (folder / row["name"]).is_file()
