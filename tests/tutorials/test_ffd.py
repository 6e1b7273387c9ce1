# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorials of free-form deformation: ffd2D, ffdEllipsoid, bulb, rudder and
motorBikeSurface.

Sources of truth: Koshakji (2011), tables 5.1 to 5.4; closed forms; the surface
deformed by morphSurface for the mesh deformed by morphMesh.
"""

import re

import numpy as np
import pytest

from tutorialCase import run, tutorial


def measures(log):
    """Rows before and after of morphSurface and morphMesh -derivatives"""
    names = re.search(r"^# shape(.*)$", log, re.MULTILINE)[1].split()
    return {
        row: dict(
            zip(
                names,
                map(
                    float,
                    re.search(
                        rf"^{row}((?: +[-+.0-9e]+){{{len(names)}}})$",
                        log,
                        re.MULTILINE,
                    )[1].split(),
                ),
            )
        )
        for row in ("before", "after")
    }


@pytest.fixture(scope="module")
def flat(tmp_path_factory):
    case = tutorial("ffd2D", tmp_path_factory.mktemp("ffd2D"))
    run(case, "./Allrun", "-noPictures")
    return case


def points(file):
    text = file.read_text()
    body = text[text.index("(", text.rindex("}")) + 1 :]
    return np.fromstring(
        body.replace("(", " ").replace(")", " ").split("//")[0], sep=" "
    ).reshape(-1, 3)


def moved(flat, name):
    return (
        points(flat / "constant/polyMesh/points"),
        points(flat / "runs" / name / "1/polyMesh/points"),
    )


def bernstein(n, i, x):
    from math import comb

    return comb(n, i) * x**i * (1 - x) ** (n - i)


def test_figure_2_7_is_the_bernstein_polynomial(flat):
    before, after = moved(flat, "inside")
    d = 0.6 * bernstein(4, 1, before[:, 0]) * bernstein(4, 2, before[:, 1])
    expected = before + d[:, None] * [1, 0, 0]
    np.testing.assert_allclose(after, expected, atol=1e-15)


def test_figure_2_9_is_refused_with_the_safe_scale(flat):
    told = (flat / "results/folded.txt").read_text()
    scale = float(re.search(r"Largest safe scale: (\S+)", told)[1])
    # The Jacobian 1 - 5 mu t b_1^5(s) vanishes first at s = 1/5, t = 0
    exact = 1 / (5 * 0.6 * bernstein(5, 1, 0.2))
    assert 0.999 * exact < scale <= exact
    assert "whole" in told and "(mu)" in told
    assert not (flat / "runs/folded/1/polyMesh").exists()


def test_a_local_box_leaves_the_rest_to_the_bit(flat):
    before, after = moved(flat, "local")
    outside = np.abs(before[:, :2] - 0.5).max(axis=1) > 0.25 + 1e-12
    np.testing.assert_array_equal(after[outside], before[outside])
    # Upwards by half of half a box at the maximum of b_1^4 b_2^4
    highest = (after - before)[:, 1].max()
    assert highest == pytest.approx(
        0.5 * 0.5 * bernstein(4, 1, 0.25) * bernstein(4, 2, 0.5), rel=1e-6
    )


def test_a_rotated_box_moves_along_its_own_axes(flat):
    before, after = moved(flat, "rotated")
    d = after - before
    far = np.linalg.norm(d, axis=1) > 1e-3
    turn = np.radians(10)
    np.testing.assert_allclose(
        d[far] @ [np.cos(turn), np.sin(turn), 0], 0, atol=1e-15
    )
    assert far.sum() > 100


@pytest.fixture(scope="module")
def bodies(tmp_path_factory):
    logs = {}
    for name in ("ffdEllipsoid", "bulb", "rudder"):
        case = tutorial(name, tmp_path_factory.mktemp(name))
        if name == "bulb":
            run(case, "./Allrun", "-noPictures")
            logs["mesh"] = (case / "log.morphMesh").read_text()
            logs["bulb"] = (case / "log.morphSurface").read_text()
            logs["case"] = case
            continue
        # The shape alone: the mesh takes a while
        body = name.replace("ffdE", "e")
        run(
            case,
            "bash",
            "-c",
            ". ../../etc/bashrc; mkdir -p constant/triSurface; "
            "$(python3With numpy) -m morphfoam.bodies"
            f" {body} constant/triSurface/body.stl && morphSurface"
            " -derivatives constant/triSurface/body.stl results/body.stl"
            " > log.morphSurface",
        )
        logs[name] = (case / "log.morphSurface").read_text()
    return logs


def test_ellipsoid_grows_about_its_centre(bodies):
    rows = measures(bodies["ffdEllipsoid"])
    exact = np.pi / 6 * 1 * 0.5 * 0.3
    assert rows["before"]["volume"] == pytest.approx(exact, rel=2e-3)
    assert rows["after"]["volume"] == pytest.approx(0.0886, rel=1e-3)
    centre = [rows["after"][f"volumeC{x}"] for x in "xyz"]
    np.testing.assert_allclose(centre, 0, atol=1e-12)


def test_bulb_keeps_the_volume_of_the_thesis(bodies):
    # Table 5.1: 0.7156 and 0.5725 m3
    rows = measures(bodies["bulb"])
    assert rows["before"]["volume"] == pytest.approx(0.7156, rel=1e-6)
    assert rows["after"]["volume"] == pytest.approx(0.5725, rel=2e-3)


def test_rudder_keeps_the_volume_of_the_thesis(bodies):
    # Table 5.3: 0.0298 and 0.0207 m3
    rows = measures(bodies["rudder"])
    assert rows["before"]["volume"] == pytest.approx(0.0298, rel=1e-6)
    assert rows["after"]["volume"] == pytest.approx(0.0207, abs=5e-5)


def test_the_mesh_about_the_bulb_follows_its_surface(bodies):
    # The patch of 2,700 faces has another volume than the surface, but the
    # same share of it goes
    surface, mesh = measures(bodies["bulb"]), measures(bodies["mesh"])
    share = [
        abs(rows["after"]["volume"] / rows["before"]["volume"])
        for rows in (surface, mesh)
    ]
    assert share[1] == pytest.approx(share[0], rel=5e-3)


def test_mesh_about_the_bulb_is_valid_and_shown(bodies):
    case = bodies["case"]
    folder = case / "postProcessing/morphMesh/1"
    rows = (folder / "quality.dat").read_text().splitlines()
    assert rows[-1].split()[-2:] == ["0", "0"]
    assert float(rows[-1].split()[3]) < 50
    shown = {path.name for path in (folder / "controls").iterdir()}
    assert {
        "bulb.vtk",
        "bulbAtRest.vtk",
        "bulb.mu1.min.vtp",
        "bulb.mu10.max.vtp",
    } <= shown
    table = (folder / "derivatives.dat").read_text().splitlines()
    assert len(table) == 1 + 20


def test_motor_bike(tmp_path):
    case = tutorial("motorBikeSurface", tmp_path)
    run(case, "./Allrun", "-noPictures")
    rows = measures((case / "log.morphSurface").read_text())
    assert rows["before"]["area"] == pytest.approx(12.1486, rel=1e-5)
    assert rows["after"]["area"] == pytest.approx(13.8505, rel=1e-4)
    assert "volume" not in rows["before"]
