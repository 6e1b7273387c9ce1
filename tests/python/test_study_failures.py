# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Why designs fail: by class, in the log's own words. Sources of truth: logs of
OpenFOAM v1912 and of morphMesh, as they were written."""

import pytest

from study_case import make_study, read

from morphfoam.study import (
    designs,
    failures,
    outcomes,
    report,
    status,
    worker,
)

FOLD = """
--> FOAM FATAL IO ERROR: (openfoam-1912 patch=200626)
Box 'bulb' folds: at (s t p) = (0.5 0.5 1), which is (0 0 0.2),
    the Jacobian determinant of its map is not positive.
    Parameters that bring it about: mu1 mu2
    Largest safe scale: 0.4321 times the values of all parameters of the box

file: constant/dynamicMeshDict.ffdMotionSolverCoeffs.boxes.bulb
"""
INVALID = """The motion makes the mesh invalid: 3 wrongly oriented faces.
    It is valid up to the fraction 0.61
    Nothing is written
"""
FATAL = """
--> FOAM FATAL ERROR: (openfoam-1912 patch=200626)
Maximum number of iterations exceeded: 100

    From function Thermo
"""


def script(log, status):
    """A step that writes this log and exits so."""
    return f"cat > said <<'EOF'\n{log}\nEOF\ncat said; exit {status}"


@pytest.fixture
def study(tmp_path):
    """A strategy whose one step is what the design's own script says."""
    path = make_study(
        tmp_path,
        (
            "  remesh:\n    start: template\n"
            "    steps: {solve: bash solver.sh}",
            "  remesh:\n    start: template\n    steps: {solve: 'bash"
            " $MORPHSTUDY_STUDY/step.$(basename $PWD)'}",
        ),
    )
    return read(path)


def fail(study, *logs):
    """A design for each log; their outcomes."""
    designs.add(
        study, [(0.1 * i, 0.1) for i in range(len(logs))], designs.SAMPLED
    )
    found = []
    for number, (log, code) in enumerate(logs, 1):
        (study.root / f"step.{number:04d}").write_text(script(log, code))
        worker.Worker(study, "remesh", number).work()
        found.append(outcomes.read(study, "remesh", number))
    return found


def test_the_largest_safe_scale_of_a_fold_is_what_is_attainable(study):
    (outcome,) = fail(study, (FOLD, 1))
    assert outcome.motion["attainable"] == 0.4321
    assert "Box 'bulb' folds" in outcome.reason
    assert "Largest safe scale: 0.4321" in outcome.reason
    assert "mu1 mu2" in outcome.reason


def test_each_failure_has_its_class(study):
    kinds = [
        failures.kind(outcome)
        for outcome in fail(
            study,
            (FOLD, 1),
            (INVALID, 1),
            ("Time = 3\nsigFpe\n", 136),
            (FATAL, 1),
            ("f = nan\ng = 1", 0),
            ("nothing", 3),
        )
    ]
    assert kinds == [
        "solve: a lattice folds",
        "solve: the mesh becomes invalid",
        "solve: diverged",
        "solve: OpenFOAM error",
        "responses",
        "solve: other",
    ]


def test_designs_that_ran_out_of_time_are_a_class():
    late = outcomes.Outcome(
        strategy="a",
        number=1,
        parameters={},
        reason="mesh: timeout after 3 s",
    )
    assert failures.kind(late) == "mesh: timeout"


def test_failures_are_grouped_in_status_and_report(study, capsys):
    fail(study, (FATAL, 1), ("sigFpe", 136), (FATAL, 1))
    status.status(study)
    said = capsys.readouterr().out
    assert (
        "2 x solve: OpenFOAM error (0001 0003): solve: Maximum number of"
        " iterations exceeded: 100" in said
    )
    assert "1 x solve: diverged (0002)" in said
    report.report(study)
    page = (study.folder / "report.html").read_text()
    assert "<td>2</td>" in page and "solve: OpenFOAM error" in page


def test_long_reasons_do_not_overflow_the_page(study):
    fail(study, (FATAL.replace("100", "x" * 400), 1))
    report.report(study)
    page = (study.folder / "report.html").read_text()
    style = page[page.index("<style>") : page.index("</style>")]
    assert "overflow-wrap: anywhere" in style
    # The column that needs it is marked
    assert '<td class="text">solve: Maximum' in page
