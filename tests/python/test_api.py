# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""import morphfoam: what its documentation shows is what it does. The solver is
arithmetic (study_case.py): f = x^2 + y, g = 1 - x y."""

import doctest
import pathlib
import subprocess
import sys

import pytest

import morphfoam

ROOT = pathlib.Path(__file__).resolve().parents[2]
COEFFICIENTS = "# Time Cd Cl\n1 0.3 1\n2 0.25 -1\n"


def bare(code, *missing, cwd=None):
    """What Python says where packages are missing."""
    block = "".join(f"sys.modules['{name}'] = None\n" for name in missing)
    done = subprocess.run(
        [sys.executable, "-c", "import sys\n" + block + code],
        cwd=cwd,
        text=True,
        env={"PYTHONPATH": str(ROOT / "python")},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    return done.stdout


def test_output_is_read_without_any_package(tmp_path):
    (tmp_path / "coefficient.dat").write_text(COEFFICIENTS)
    said = bare(
        "import morphfoam\n"
        "print(morphfoam.read_columns('coefficient.dat')['Cd'])",
        *("numpy", "pandas", "scipy", "yaml", "matplotlib"),
        cwd=tmp_path,
    )
    assert said == "[0.3, 0.25]\n"


def test_a_missing_pandas_is_named_with_what_to_do(tmp_path):
    (tmp_path / "coefficient.dat").write_text(COEFFICIENTS)
    said = bare(
        "import morphfoam\nmorphfoam.read_table('coefficient.dat')",
        "pandas",
        cwd=tmp_path,
    )
    assert "ImportError: pandas is not installed" in said
    assert "apt install python3-pandas" in said


def test_every_name_that_is_promised_is_there_and_documented():
    for name in morphfoam.__all__:
        assert getattr(morphfoam, name).__doc__, name
        assert name in morphfoam.__doc__
        assert name in dir(morphfoam)
    with pytest.raises(AttributeError, match="no attribute 'studies'"):
        morphfoam.studies


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A study on a grid of three by three designs, and a table."""
    pytest.importorskip("pandas")
    case = pytest.importorskip("study_case")
    folder = tmp_path_factory.mktemp("api")
    case.make_study(
        folder,
        ("bounds: [0, 1]", "bounds: [0.2, 0.8]"),
        ("latinHypercube, designs: 4", "factorial, levels: 3"),
        ("optimise:", "descend: {objective: {f: minimise}}\noptimise:"),
    )
    forces = folder / "postProcessing/forces/0"
    forces.mkdir(parents=True)
    (forces / "coefficient.dat").write_text("# Time Cd\n1 0.25\n")
    return folder


def test_the_examples_of_the_documentation_give_what_they_say(
    folder, monkeypatch
):
    from morphfoam import frames
    from morphfoam.study import api

    monkeypatch.chdir(folder)
    study = morphfoam.Study("study.yaml")
    finder = doctest.DocTestFinder(exclude_empty=True)
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
    tests = [
        test
        for module in (api, frames)
        for test in finder.find(module)
        if test.examples
    ]
    # What opens and runs the study comes first; the rest goes on with it
    tests.sort(key=lambda test: test.name != "morphfoam.study.api.Study")
    assert len(tests) >= 6
    for test in tests:
        test.globs.update(study=study)
        runner.run(test)
    assert runner.failures == 0


def test_tables_have_what_the_study_computed(folder):
    study = morphfoam.Study(folder / "study.yaml")
    table = study.results().drop("baseline")
    assert list(table.f) == pytest.approx(list(table.x**2 + table.y))
    assert list(study.designs().index) == list(table.index)
    assert {o.name: o.responses["g"] for o in study.outcomes()} == dict(
        table.g
    )
    assert study.front().f.min() < 0.3
    assert study.report() == study.folder / "report.html"


def test_what_is_not_there_is_said(folder):
    study = morphfoam.Study(folder / "study.yaml")
    with pytest.raises(morphfoam.StudyError, match="no strategy mesh"):
        study.results("mesh")
    with pytest.raises(morphfoam.StudyError, match="Call optimise"):
        study.front("remesh")
