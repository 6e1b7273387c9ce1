# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The verb descend on closed-form arithmetic (study_case.py): f = x^2 + y,
g = 1 - x y, and a volume V = x y^2 whose table of derivatives is exact. Optima
are those of the formulas. x beyond 0.9 diverges."""

import csv
import os
import signal
import subprocess
import time

import numpy as np
import pytest

from study_case import ROOT, make_study, read

from morphfoam.study import (
    descend,
    designs,
    outcomes,
    report,
    shape_problem,
    sweep,
)
from morphfoam.study.errors import StudyError

GEOMETRY = """
. ./parameters.sh 2>/dev/null
sed -n 's/^\\([a-z]*\\) *\\(.*\\);/\\1=\\2/p' parameters > parameters.sh
. ./parameters.sh
echo "asked" >> "$MORPHSTUDY_STUDY/asked"
mkdir -p postProcessing/shape/0
awk "BEGIN { exit !($x + $y > ${FOLD:-9}) }" && {
    s=$(awk "BEGIN { print ${FOLD:-9}/($x + $y) }")
    printf '%s\\n' "Box 'b' folds: at (0 0 0)," \\
        "    the map's determinant is not positive." \\
        "    Parameters that cause it: x y" "    Largest safe scale: $s"
    exit 1
}
awk "BEGIN { printf \\"# shape volume\\nbefore 1\\nafter %.17g\\n\\", $x*$y^2 }" \\
    > postProcessing/shape/0/measures.dat
awk "BEGIN { printf \\"# parameter value dvolume\\nb.x 0 %.17g\\nb.y 0 %.17g\\n\\",
    $y^2, 2*$x*$y }" > postProcessing/shape/0/derivatives.dat
"""
VOLUME = """  V:
    file: postProcessing/shape/*/measures.dat
    row: after
    column: volume
    gradient: {file: postProcessing/shape/*/derivatives.dat, column: dvolume}
  Vr: {expression: V/baseline.V}
"""
OPTIMISE = """optimise:
  objectives: {f: minimise, g: minimise}
  population: 40
  generations: 20
"""


def study_file(folder, section, *changes):
    """A study with a section descend, and V."""
    path = make_study(
        folder,
        (OPTIMISE, VOLUME + "descend:\n" + section),
        ("solve: bash solver.sh", "solve: bash solver.sh && bash shape.sh"),
        *changes,
    )
    (folder / "case/shape.sh").write_text(GEOMETRY)
    return path


def table(study, name="history", strategy="morph"):
    path = study.folder / f"descend.{strategy}" / f"{name}.csv"
    with path.open() as file:
        return list(csv.DictReader(file))


def end(study):
    row = table(study, "optima")[0]
    return float(row["x"]), float(row["y"])


CASES = [
    # f falls with y to 0; then x^2 is least at 0
    ("{f: minimise}", "", (0, 0)),
    # x^2 + y with x + y = 0.7: x = 1/2
    ("{f: minimise}", "[x + y >= 0.7]", (0.5, 0.2)),
    ("{f: minimise}", "['x + y == 0.7']", (0.5, 0.2)),
    # of a response: x y >= 1/4, x^3 = 1/8
    ("{f: minimise}", "[g <= 0.75]", (0.5, 0.5)),
    # x y^2 >= 1/8: 2 x = lambda y^2, 1 = 2 lambda x y: 4 x^2 = y
    ("{f: minimise}", "[Vr >= 1]", (0.25**0.4 * 0.5**0.6, None)),
    ("{g: minimise}", "[f <= 0.75]", (0.5, 0.5)),
]


@pytest.mark.parametrize("objective, constraints, best", CASES)
def test_it_ends_at_the_optimum(
    tmp_path, at_once, objective, constraints, best
):
    x, y = best
    if y is None:
        # 4 x^2 = y with x y^2 = 1/8: x^5 = 1/128
        x = 128**-0.2
        y = 4 * x**2
    study = read(
        study_file(
            tmp_path,
            f"  objective: {objective}\n"
            f"  constraints: {constraints or '[]'}\n"
            "  gradient: {scheme: central, step: 0.002}\n"
            "  geometry: bash shape.sh\n"
            "  tolerance: 1e-7\n",
        )
    )
    assert descend.descend(study, "morph") == 0
    assert end(study) == pytest.approx((x, y), abs=5e-3)
    history = table(study)
    assert history[0]["design"] == "0001" and history[0]["taken"] == "yes"
    f = [float(r["f"]) for r in history if r["taken"] == "yes"]
    assert len(f) == 1 or f[-1] != f[0]
    assert int(history[-1]["runs"]) <= len(designs.read(study))


def test_exact_constraints_hold_at_every_step(tmp_path, at_once):
    """V is asked for without a run, so that no step misses it by more than
    1e-8, nor does rounding; only differences may."""
    study = read(
        study_file(
            tmp_path,
            "  objective: {f: minimise}\n  constraints: [V >= baseline.V]\n"
            "  geometry: bash shape.sh\n  tolerance: 1e-6\n",
        )
    )
    assert descend.descend(study, "morph") == 0
    steps = [d for d in designs.read(study) if d.origin == designs.DESCENT]
    assert len(steps) > 3
    for design in steps:
        x, y = design.parameters.values()
        assert x * y**2 >= 0.125 * (1 - 1e-8)
    kept = (tmp_path / "asked").read_text()
    assert descend.descend(study, "morph") == 0
    assert (tmp_path / "asked").read_text() == kept


def test_the_same_without_the_command_is_only_linear(tmp_path, at_once):
    """The derivative of a table serves in place of differences."""
    study = read(
        study_file(
            tmp_path,
            "  objective: {f: minimise}\n  constraints: [V >= baseline.V]\n",
        )
    )
    assert descend.descend(study, "morph") == 0
    assert outcomes.read(study, "morph", 1).gradients["V"] == {
        "x": 0.25,
        "y": 0.5,
    }
    assert end(study)[0] == pytest.approx(128**-0.2, abs=0.02)


def test_a_fold_is_known_without_a_run(tmp_path, at_once, monkeypatch):
    """g falls with x y; the lattice folds where x + y > 1.3."""
    monkeypatch.setenv("FOLD", "1.3")
    study = read(
        study_file(
            tmp_path,
            "  objective: {g: minimise}\n  constraints: [V >= 0]\n"
            "  geometry: bash shape.sh\n  maxIterations: 30\n",
        )
    )
    descend.descend(study, "morph")
    x, y = end(study)
    assert 1.28 < x + y <= 1.3
    noted = [r["note"] for r in table(study) if "not run" in r["note"]]
    assert noted and all("folds" in note for note in noted)
    steps = [d for d in designs.read(study) if d.origin == designs.DESCENT]
    assert all(sum(d.parameters.values()) <= 1.3 for d in steps)


def test_runs_that_fail_are_recorded_and_gone_on_from(tmp_path, at_once):
    """f grows with x; beyond 0.9 the solver diverges."""
    study = read(
        study_file(
            tmp_path,
            "  objective: {f: maximise}\n  constraints: [y <= 0.6]\n"
            "  maxIterations: 30\n",
        )
    )
    assert descend.descend(study, "morph") == 0
    x, y = end(study)
    assert 0.85 < x <= 0.9 and y == pytest.approx(0.6, abs=1e-6)
    failed = [r for r in table(study) if r["note"].startswith("failed")]
    assert failed and all("diverged" in r["note"] for r in failed)
    assert all(float(r["x"]) > 0.9 and r["f"] == "" for r in failed)
    assert int(table(study)[-1]["failed"]) >= len(failed)


def test_a_response_that_is_missing_is_a_failure(tmp_path, at_once):
    """Where x < 0.3 there is no number after g."""
    study = read(
        study_file(
            tmp_path,
            "  objective: {f: minimise}\n  maxIterations: 30\n",
        )
    )
    solver = tmp_path / "case/solver.sh"
    solver.write_text(
        solver.read_text().replace(
            '\\"g = \\" 1 - $x*$y',
            '\\"g = \\" (($x < 0.3) ? \\"\\" : 1 - $x*$y)',
        )
    )
    assert descend.descend(study, "morph") == 0
    assert 0.3 <= end(study)[0] < 0.35
    assert any("response g" in r["note"] for r in table(study))


def test_a_start_that_fails_is_an_error(tmp_path, at_once):
    path = study_file(
        tmp_path,
        "  objective: {f: minimise}\n",
        (
            "x: {bounds: [0, 1], baseline: 0.5}",
            "x: {bounds: [0, 1], baseline: 1}",
        ),
        (
            "baseline:\n  steps: {solve: bash solver.sh && bash shape.sh}",
            "baseline:\n  steps: {solve: 'echo f = 1; echo g = 1; bash shape.sh'}",
        ),
    )
    with pytest.raises(StudyError, match="cannot start.*diverged"):
        descend.descend(read(path), "remesh")


def test_what_cannot_be_met_is_said_with_the_least_that_is_missed(
    tmp_path, at_once, capsys
):
    """x + y is at most 1.9 - what diverges excluded - and 2.5 is asked for."""
    study = read(
        study_file(
            tmp_path,
            "  objective: {f: minimise}\n  constraints: [x + y >= 2.5]\n"
            "  maxIterations: 40\n",
            ("x: {bounds: [0, 1]", "x: {bounds: [0, 0.8]"),
            ("y: {bounds: [0, 1]", "y: {bounds: [0, 0.8]"),
        )
    )
    assert descend.descend(study, "morph") == 1
    said = capsys.readouterr().out
    assert "Not met: x + y >= 2.5, missed by 0.9" in said
    assert end(study) == pytest.approx((0.8, 0.8), abs=1e-6)


def test_other_starts_and_the_best_of_them(tmp_path, at_once):
    study = read(
        study_file(tmp_path, "  objective: {f: minimise}\n  starts: 3\n")
    )
    assert descend.descend(study, "morph") == 0
    rows = table(study, "optima")
    assert sorted(r["start"] for r in rows) == ["1", "2", "3"]
    f = [float(r["f"]) for r in rows]
    assert f == sorted(f)
    report.report(study)
    page = (study.folder / "report.html").read_text()
    assert "Descent" in page and "of descents" in page


def test_only_some_parameters_move(tmp_path, at_once):
    study = read(
        study_file(tmp_path, "  objective: {f: minimise}\n  parameters: [y]\n")
    )
    descend.descend(study, "morph")
    assert end(study) == pytest.approx((0.5, 0), abs=1e-9)


def without_times(study):
    return [
        {k: v for k, v in row.items() if k != "cpuTime"}
        for row in table(study)
    ]


def test_killed_it_goes_on_to_the_same_history(tmp_path):
    """By SIGKILL, at moments spread over the descent, with the workflow engine
    and its workers; the truth is a descent that nobody disturbs."""
    section = (
        "  objective: {f: minimise}\n  constraints: [Vr >= 1]\n"
        "  geometry: bash shape.sh\n  maxIterations: 4\n"
    )
    for name in ("whole", "killed"):
        (tmp_path / name).mkdir()
    whole = study_file(tmp_path / "whole", section)
    killed = study_file(tmp_path / "killed", section)
    command = [ROOT / "bin/morphStudy", "descend"]
    subprocess.run([*command, whole], check=True, stdout=subprocess.PIPE)
    for pause in (3, 8, 13):
        process = subprocess.Popen(
            [*command, killed],
            stdout=subprocess.PIPE,
            env={**os.environ, "PAUSE": "0.3"},
        )
        time.sleep(pause)
        process.send_signal(signal.SIGKILL)
        process.wait()
    time.sleep(1)
    subprocess.run([*command, killed], check=True, stdout=subprocess.PIPE)
    assert without_times(read(killed)) == without_times(read(whole))
    # and no finished design was run again
    for file in (tmp_path / "whole").glob("runs.*"):
        assert len(file.read_text().splitlines()) == 1


@pytest.mark.parametrize(
    "section, said",
    [
        ("  objective: {q: minimise}\n", "there is no response q"),
        ("  objective: {f: least}\n", "maximise or minimise"),
        ("  objective: {f: minimise, g: minimise}\n", "one objective"),
        (
            "  objective: {f: minimise}\n  constraints: [f <= 1 or g <= 1]\n",
            "alternatives",
        ),
        ("  objective: {f: minimise}\n  radius: 2\n", "at most 0.5"),
        (
            "  objective: {f: minimise}\n  gradient: {method: guess}\n",
            "must be one of finiteDifference",
        ),
        (
            "  objective: {f: minimise}\n  gradient: {scheme: upwind}\n",
            "must be one of forward central auto",
        ),
        (
            "  objective: {f: minimise}\n  parameters: [z]\n",
            "there is no parameter z",
        ),
        ("  objective: {f: minimise}\n  step: 1\n", "no key of a study file"),
        ("  objective: {f: minimise}\n  starts: 0\n", "at least 1"),
    ],
)
def test_wrong_entries_are_named(tmp_path, section, said):
    with pytest.raises(StudyError, match=said):
        read(study_file(tmp_path, section))


@pytest.mark.parametrize(
    "old, new, said",
    [
        (
            "row: after\n    column: volume",
            "row: after\n    regex: '(x)'",
            "goes with a column",
        ),
        ("column: dvolume}", "columns: dvolume}", "no key"),
        (
            "{expression: V/baseline.V}",
            "{expression: V, gradient: {file: a, column: 1}}",
            "follows from",
        ),
    ],
)
def test_wrong_rows_and_gradients_are_named(tmp_path, old, new, said):
    with pytest.raises(StudyError, match=said):
        read(study_file(tmp_path, "  objective: {f: minimise}\n", (old, new)))


def test_tables_that_do_not_fit_fail_the_run(tmp_path, at_once):
    """A row that is not there; derivatives by nothing that the study knows."""
    for old, new, said in (
        ("row: after", "row: later", "has no row later"),
        ("column: dvolume", "column: darea", "has no column darea"),
    ):
        folder = tmp_path / new.split()[1]
        folder.mkdir()
        study = read(
            study_file(folder, "  objective: {f: minimise}\n", (old, new))
        )
        with pytest.raises(StudyError, match=said):
            descend.descend(study, "morph")


def test_a_study_without_the_section_says_what_to_add(tmp_path):
    with pytest.raises(StudyError, match="has no descend"):
        descend.descend(read(make_study(tmp_path)))


def test_the_slope_of_derived_quantities_enters(tmp_path, at_once):
    """V's table has the row of z = 2 x - 1 in place of x's: by the chain
    rule dV/dx is twice it."""
    study = read(
        study_file(
            tmp_path,
            "  objective: {f: minimise}\n  constraints: [V >= 0.1]\n"
            "  geometry: bash shape.sh\n",
            ("sampling:", "derived: {z: 2*x - 1}\nsampling:"),
        )
    )
    script = tmp_path / "case/shape.sh"
    script.write_text(script.read_text().replace("b.x 0", "b.z 0"))
    with sweep.only_one(study):
        sweep.complete(study, "morph", [], 1, None)
    problem = shape_problem.ShapeProblem(
        study, "morph", 1, None, study.baseline
    )
    values, slopes = problem.exact(np.array([0.4, 0.6]))
    # Scaled by the larger of 0.125, the baseline's volume, and 0.1
    assert values[0] * 0.125 == pytest.approx(0.4 * 0.36 - 0.1, rel=1e-9)
    assert slopes[0] * 0.125 == pytest.approx([2 * 0.36, 0.48], rel=1e-8)
