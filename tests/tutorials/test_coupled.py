# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorials flexiblePlate and hingedFloats by their own scripts, for some
steps. Source of truth: the work on either side of the interface is one; the
floats of OpenFOAM's own motion solver."""

import csv

from tutorialCase import run, tutorial


def table(path):
    with open(path) as file:
        return list(csv.DictReader(file))


def test_plate_and_flow_converge_and_do_the_same_work(tmp_path):
    case = tutorial("flexiblePlate", tmp_path)
    run(case, "./Allrun", "-noPictures", "-noRestart", "-endTime", "0.125")
    figures = {
        row["figure"]: float(row["value"])
        for row in table(case / "results/plate.csv")
    }
    assert figures["largest amplitude [m]"] > 1e-6
    assert figures["residual, largest after the third step"] < 1e-7
    assert (
        figures["work at the interface, largest difference of the largest"]
        < 1e-2
    )


def test_a_plate_that_fails_ends_the_flow(tmp_path):
    case = tutorial("flexiblePlate", tmp_path)
    (case / "plate.py").write_text("raise SystemExit(1)\n")
    told = run(case, "./Allrun", "-noPictures", "-noRestart", status=1)
    assert "runs/whole" in told
    log = (case / "runs/whole/log.pimpleFoam").read_text()
    assert "Wait time exceeded" not in log


def test_hinged_floats_move_as_openfoams(tmp_path):
    case = tutorial("hingedFloats", tmp_path)
    run(case, "./Allrun", "-noPictures", "-noRestart", "-endTime", "0.05")
    rows = table(case / "results/trajectory.csv")
    assert len(rows) == 4
    for row in rows:
        assert float(row["largest difference, of that"]) < 1e-2
    (row,) = table(case / "results/hinge.csv")
    assert float(row["value"]) < 1e-11
