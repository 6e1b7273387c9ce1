# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""pitchingAerofoilInSitu: a running pimpleFoam leaves pictures, reduced to its
first half second.

Source of truth: what the pipeline says of camera, colours and control points;
tests/catalyst/test_catalyst.py has what it receives to the bit.
"""

import pytest

from tutorialCase import ROOT, run, tutorial

matplotlib = pytest.importorskip("matplotlib.image")


def test_picture_of_the_running_solver(tmp_path):
    if not list((ROOT / "build").glob("*/lib/libmorphCatalyst.so")):
        pytest.skip("ParaView's development files are not on this machine")
    case = tutorial("pitchingAerofoilInSitu", tmp_path)
    run(case, "./Allrun", "-endTime", "0.5")
    log = (case / "runs/case/log.pimpleFoam").read_text()
    assert "selected 67 of 372 control points" in log
    assert "a script failed" not in log
    found = list(case.glob("runs/case/postProcessing/catalyst/*.png"))
    assert [path.name for path in found] == ["pitching_000050.png"]
    picture = matplotlib.imread(str(found[0]))[..., :3]
    assert picture.shape[:2] == (560, 900)
    red, green, blue = (picture[..., i] for i in range(3))
    # The aerofoil is a hole, control points are red, pressure is coloured
    assert 0.02 < ((red > 0.99) & (green > 0.99) & (blue > 0.99)).mean() < 0.2
    assert ((red > 0.75) & (green < 0.25) & (blue < 0.25)).sum() > 100
    assert (
        len(
            {
                tuple(pixel)
                for row in (picture[::20] * 255).astype(int)
                for pixel in row[::20]
            }
        )
        > 100
    )
    # No fields were written for it
    assert not (case / "runs/case/0.5/U").exists()
    assert (case / "results/contactSheet.png").exists()
