# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Reading tables and logs. Source of truth: what OpenFOAM's function objects and
solvers write."""

import csv

import pytest

from morphfoam.output import tables

COEFFICIENTS = """# Force coefficients
# magUInf       : 2.600000e+01
# Time          \tCd            \tCl
1               \t2.5e-01       \t-1
2               \t2.0e-01       \tnan?
"""


def test_columns_have_the_names_of_the_last_comment_before_them(tmp_path):
    (tmp_path / "a").write_text(COEFFICIENTS + "# the end\n")
    assert tables.read_columns(tmp_path / "a") == {
        "Time": [1, 2],
        "Cd": [0.25, 0.2],
        "Cl": [-1, "nan?"],
    }


def test_tables_that_are_none_are_errors(tmp_path):
    (tmp_path / "a").write_text("# Time a\n")
    with pytest.raises(ValueError, match="no row"):
        tables.read_columns(tmp_path / "a")
    (tmp_path / "a").write_text("# Time a\n1 2 3\n")
    with pytest.raises(ValueError, match="names 2 columns and has 3"):
        tables.read_columns(tmp_path / "a")


@pytest.mark.parametrize(
    "end, converged",
    [
        ("\nSIMPLE solution converged in 3 iterations\n", True),
        ("\nEnd\n", False),
    ],
)
def test_iterations_are_counted(tmp_path, end, converged):
    log = "Build\nTime = 1\n\nExecutionTime = 0.1 s\nTime = 2\n\nTime = 3\n"
    (tmp_path / "log").write_text(log + end)
    assert tables.iterations(tmp_path / "log") == (3, converged)


def test_a_table_is_written_as_csv_and_markdown(tmp_path, capsys):
    rows = [{"case": "a", "Cd": 0.123456789}, {"case": "bb", "Cd": 2}]
    tables.write_table(rows, tmp_path / "new/table")
    with (tmp_path / "new/table.csv").open() as file:
        assert [float(r["Cd"]) for r in csv.DictReader(file)] == [
            0.123456789,
            2,
        ]
    markdown = (tmp_path / "new/table.md").read_text()
    assert markdown == capsys.readouterr().out
    assert markdown.splitlines() == [
        "| case | Cd       |",
        "|------|----------|",
        "| a    | 0.123457 |",
        "| bb   | 2        |",
    ]


def test_trajectories_are_compared_at_the_times_of_the_reference(tmp_path):
    from morphfoam.output.trajectories import compare

    # 2 t against 2 t + 0.1 at every fourth of it, to the earlier end
    compare(
        ([0, 1, 2], [0, 2, 4]),
        ([0, 0.5, 1.5, 3], [0.1, 1.1, 3.1, 9]),
        "other",
        ["sway [m]"],
        tmp_path / "motion",
    )
    with (tmp_path / "motion.csv").open() as file:
        (row,) = csv.DictReader(file)
    assert float(row["largest, rbf"]) == pytest.approx(3)
    assert float(row["largest, other"]) == pytest.approx(3.1)
    assert float(row["largest difference, of that"]) == pytest.approx(
        0.1 / 3.1
    )
