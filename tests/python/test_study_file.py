# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""What a study file may say, and what morphStudy answers to what it may not.
Source of truth: python/morphfoam/study/README.md."""

import numpy as np
import pytest

from study_case import ROOT, command, make_study, read

from morphfoam.study import check
from morphfoam.study.errors import StudyError
from morphfoam.study.expressions import Condition, Expression

HAS_X = "x: {bounds: [0, 1], baseline: 0.5}"


def refused(tmp_path, *changes):
    """The message about a study file with these changes."""
    with pytest.raises(StudyError) as caught:
        check.check(read(make_study(tmp_path, *changes)), quiet=True)
    return str(caught.value)


def test_the_study_of_these_tests_is_right(tmp_path):
    assert "No mistake found" in command("check", make_study(tmp_path))
    assert not (tmp_path / "study.study").exists()


@pytest.mark.parametrize(
    "old, new, said",
    [
        ("template: case", "template: cas", "is no folder"),
        ("template: case", "templat: case", "templat is no key"),
        (
            HAS_X,
            "x: {bound: [0, 1], baseline: 0.5}",
            "parameters/x/bound is no key",
        ),
        (HAS_X, "x: {bounds: [1, 0], baseline: 0.5}", "must be the smaller"),
        (HAS_X, "x: {bounds: [0], baseline: 0.5}", "write [lowest, highest]"),
        (
            HAS_X,
            "x: {bounds: [0, one], baseline: 0.5}",
            "'one', which is no number",
        ),
        (HAS_X, "x: {bounds: [0, 1]}", "parameters/x/baseline is missing"),
        (HAS_X, HAS_X + "\n  " + HAS_X, "the key 'x' stands twice"),
        (HAS_X, "sin: {bounds: [0, 1], baseline: 0.5}", "has a meaning"),
        ("parametersFile: parameters", "", "parameters/x goes nowhere"),
        (
            "parametersFile: parameters",
            "parametersFile: shape",
            "mentions shape",
        ),
        (
            HAS_X,
            "x: {bounds: [0, 1], baseline: 0.5, file: no, entry: a}",
            "must be a text",
        ),
        (
            HAS_X,
            "x: {bounds: [0, 1], baseline: 0.5, file: none, entry: a}",
            "none is no file",
        ),
        ("sampling:", "constraints: [x > 2]\nsampling:", "nothing to sample"),
        ("sampling:", "constraints: [x > z]\nsampling:", "uses z"),
        (
            "sampling:",
            "constraints: [x == y]\nsampling:",
            "other than < <= > >=",
        ),
        ("sampling:", "constraints: [x + y]\nsampling:", "compares nothing"),
        ("sampling:", "derived: {a: b + 1}\nsampling:", "uses b"),
        (
            "sampling:",
            "derived: {x: y + 1}\nsampling:",
            "x stands there twice",
        ),
        ("latinHypercube", "random", "must be one of"),
        ("designs: 4", "designs: 0", "at least 1"),
        (
            "designs: 4",
            "designs: 4, levels: 3",
            "says nothing to latinHypercube",
        ),
        ("latinHypercube, designs: 4", "factorial", "levels is missing"),
        ("start: nearest", "start: last", "must be one of"),
        ("steps: {solve: bash solver.sh}", "steps: {}", "at least one name"),
        (
            "steps: {solve: bash solver.sh}",
            "steps: {solve: noSolver}",
            "no command noSolver",
        ),
        (
            "steps: {solve: bash solver.sh}",
            "steps: {solve: ./solver}",
            "no command ./solver",
        ),
        (
            "steps: {solve: bash solver.sh}",
            "steps: {solve: 'bash ('}",
            "is no command",
        ),
        ("file: log.solve", "file: log.other", "writes log.other"),
        ("'f = (\\S+)'", "'f = \\S+'", "put ( ) round the number"),
        ("'f = (\\S+)'", "'f = ('", "no regular expression"),
        ("{file: log.solve, regex: 'f = (\\S+)'}", "{}", "one of file"),
        (
            "{file: log.solve, regex: 'f = (\\S+)'}",
            "{file: a}",
            "needs a column",
        ),
        (
            "{file: log.solve, regex: 'f = (\\S+)'}",
            "{expression: q}",
            "uses q",
        ),
        ("{f: minimise, ", "{h: minimise, ", "no response h"),
        ("{f: minimise, ", "{f: less, ", "maximise or minimise"),
        ("population: 40", "population: 42", "multiple of 4"),
        ("optimise:", "fit: {responses: [h]}\noptimise:", "no response h"),
        (
            "optimise:",
            "iterations: {step: mesh}\noptimise:",
            "has no step mesh",
        ),
    ],
)
def test_a_mistake_is_named_before_anything_runs(tmp_path, old, new, said):
    assert said in refused(tmp_path, (old, new))
    assert not (tmp_path / "study.study").exists()


def test_a_parameter_that_no_dictionary_uses_is_named(tmp_path):
    path = make_study(tmp_path)
    (tmp_path / "case/solver.sh").write_text("true")
    (tmp_path / "case/dict").write_text('#include "parameters"\na $x;\n')
    with pytest.raises(StudyError, match=r"parameters/y.*uses \$y"):
        check.check(read(path), quiet=True)


def test_the_template_may_not_set_what_the_study_does_not(tmp_path):
    path = make_study(tmp_path)
    (tmp_path / "case/parameters").write_text("x 1; // one\nheight 2;\n")
    with pytest.raises(StudyError, match="also sets height"):
        check.check(read(path), quiet=True)


def test_messages_reach_the_user_without_a_traceback(tmp_path):
    path = make_study(tmp_path, ("designs: 4", "designs: four"))
    said = command("run", path, status=1)
    assert said.startswith("Error: sampling/designs is 'four'")
    assert "Traceback" not in said


def test_every_key_of_the_readme_is_one_and_the_other_way_round(tmp_path):
    text = (ROOT / "python/morphfoam/study/README.md").read_text()
    text = text.split("```yaml\n")[1].split("```")[0]
    (tmp_path / "study.yaml").write_text(text)
    study = read(tmp_path / "study.yaml")
    assert [s.name for s in study.strategies["morph"].steps] == [
        "morph",
        "solve",
    ]
    assert study.strategies["morph"].steps[1].timeout == 1200
    assert study.strategies["morph"].steps[0].timeout == 3600
    keys = {
        line.split(":")[0] for line in text.splitlines() if line[:1].isalpha()
    }
    assert keys == set(study.KEYS)


def test_expressions_give_what_python_gives():
    text = "-x**2 + max(y, 3, 2*x)/sqrt(4) - min(x, y)*cos(pi)"
    x, y = 1.7, -0.3
    assert Expression(text)({"x": x, "y": y}) == pytest.approx(
        -(x**2) + max(y, 3, 2 * x) / 2 + min(x, y)
    )


def test_expressions_take_arrays():
    x = np.linspace(0, 2, 5)
    np.testing.assert_array_equal(
        Condition("0.5 <= x <= 1 or not x < 2").violation({"x": x}),
        [0.5, 0, 0, 0.5, 0],
    )


@pytest.mark.parametrize(
    "text",
    [
        "__import__('os').system('true')",
        "x.real",
        "[x]",
        "f(x)",
        "lambda: x",
        "x if x else x",
        "'x'",
        "True",
        "x < 1",
        "x[0]",
        "(x := 1)",
        "1 +",
        "x @ x",
    ],
)
def test_nothing_but_arithmetic_is_evaluated(text):
    with pytest.raises(StudyError, match="expression"):
        Expression(text)


def test_baseline_values_are_at_hand(tmp_path):
    study = read(
        make_study(
            tmp_path,
            ("sampling:", "derived: {dx: x - baseline.x, n: 2*dx}\nsampling:"),
        )
    )
    assert study.values({"x": 0.75, "y": 0})["n"] == 0.5
    assert study.baseline_values["n"] == 0


@pytest.mark.parametrize(
    "name", ["dict.bak", "dict~", ".dict.swp", "dict.old"]
)
def test_copies_that_an_editor_leaves_do_not_count(tmp_path, name):
    path = make_study(tmp_path)
    (tmp_path / "case/solver.sh").write_text("true")
    (tmp_path / "case" / name).write_text('#include "parameters"\na $x $y;\n')
    with pytest.raises(StudyError, match="no file of .* mentions parameters"):
        check.check(read(path), quiet=True)


def test_what_is_commented_out_does_not_count(tmp_path):
    path = make_study(tmp_path)
    (tmp_path / "case/solver.sh").write_text("true")
    (tmp_path / "case/dict").write_text(
        '#include "parameters"\na $x; // $y\n/* b $y; */\n'
    )
    with pytest.raises(StudyError, match="parameters/y goes nowhere"):
        check.check(read(path), quiet=True)


FORCES = "  f: {file: 'postProcessing/*/0/coefficient.dat', column: CL}"
READ = "  f: {file: log.solve, regex: 'f = (\\S+)'}"


def test_a_column_that_openfoam_does_not_write_is_named(tmp_path):
    """forceCoeffs of v1912 writes Time Cd Cs Cl ... (coefficient.dat)."""
    said = refused(tmp_path, (READ, FORCES))
    assert "responses/f/column: " in said and "CL" in said and " Cl " in said


def test_columns_are_read_where_there_are_some(tmp_path):
    """From the template's own run, and from a finished design."""
    table = "# Time mean max\n1 2 3\n"
    change = (READ, FORCES.replace("coefficient.dat", "mine.dat"))
    path = make_study(tmp_path, change)
    check.check(read(path), quiet=True)
    for folder in ("case", "study.study/baseline"):
        there = tmp_path / folder / "postProcessing/a/0"
        there.mkdir(parents=True)
        (there / "mine.dat").write_text(table)
        with pytest.raises(StudyError, match="no column CL.*Time mean max"):
            check.check(read(path), quiet=True)
        (there / "mine.dat").unlink()
    there = tmp_path / "case/postProcessing/a/0"
    (there / "mine.dat").write_text(table.replace("mean", "CL"))
    check.check(read(path), quiet=True)


def test_a_column_that_cannot_be_checked_is_said(tmp_path):
    change = (READ, FORCES.replace("coefficient.dat", "mine.dat"))
    said = command("check", make_study(tmp_path, change))
    assert "column CL of" in said and "before the baseline" in said
