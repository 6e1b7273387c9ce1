# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Tables as pandas DataFrames, where pandas is installed."""

from morphfoam.output.tables import read_columns


def pandas():
    """The module; says what to do where it is missing."""
    try:
        import pandas
    except ImportError:
        raise ImportError(
            "pandas is not installed, and tables as DataFrames need it."
            " Install it (Debian: apt install python3-pandas), or use"
            " Study.outcomes() and read_columns(), which do without"
        ) from None
    return pandas


def read_table(path):
    """A table of a function object, or of morphMesh, as a DataFrame.

    >>> import morphfoam
    >>> forces = morphfoam.read_table(
    ...     "postProcessing/forces/0/coefficient.dat")
    >>> forces.Cd.tail(100).mean()
    0.25
    """
    return pandas().DataFrame(read_columns(path))


def frame(rows, index=None):
    """A DataFrame of dictionaries; blank where a value is missing."""
    found = pandas().DataFrame(
        [{k: None if v == "" else v for k, v in row.items()} for row in rows]
    )
    return found.set_index(index) if index and len(found) else found


def read_csv(path, index=None):
    """A table of a study's folder; the numbers of designs stay words."""
    return pandas().read_csv(path, index_col=index, dtype={"design": str})
