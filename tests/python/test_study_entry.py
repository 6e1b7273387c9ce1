# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Numbers in dictionaries. Source of truth: OpenFOAM's format of dictionaries
(test_study.py asks foamDictionary)."""

import pytest

from morphfoam.study import foam_entry

DICTIONARY = """FoamFile { version 2.0; object a; } // a; } comment {
#include "none.H"   // alone on its line
a       1.23456789012;      /* a 2; */
$macro;
solvers
{
    "(U|k)" { tolerance 1e-5; smoother "sym;{GaussSeidel"; }
    p       { tolerance 1e-6; nested { deep -3; } }
    p       { tolerance 1e-7; }
    div(phi,U)  .5;
}
DT      DT [0 2 -1 0 0 0 0] 4e-05;
nu      [0 2 -1 0 0 0 0]    4.;
T       uniform 300;
v       (0 1 0);
word    none;
code    #{ if (a) { b; } #};
field   constant 1.5 ;
last    7;
"""


@pytest.mark.parametrize(
    "path, old",
    [
        ("a", "1.23456789012"),
        ("solvers/(U|k)/tolerance", "1e-5"),
        ("solvers/p/tolerance", "1e-7"),
        ("solvers/div(phi,U)", ".5"),
        ("DT", "4e-05"),
        ("nu", "4."),
        ("T", "300"),
        ("field", "1.5"),
        ("last", "7"),
        ("FoamFile/version", "2.0"),
    ],
)
def test_a_number_is_replaced_and_nothing_else(path, old):
    start, end = foam_entry.number(DICTIONARY, path)
    assert DICTIONARY[start:end] == old
    new = foam_entry.replaced(DICTIONARY, path, 1 / 3)
    assert new == DICTIONARY[:start] + "0.3333333333333333" + DICTIONARY[end:]
    assert foam_entry.replaced(new, path, 1 / 3) == new


@pytest.mark.parametrize(
    "path, said",
    [
        ("b", "no entry b in the file, but FoamFile a solvers DT nu T v word"),
        ("solvers/U/tolerance", r"no dictionary U in solvers, but \(U"),
        ("solvers/p/nested/deep", "no dictionary nested in p, but tolerance"),
        ("solvers", "no entry solvers"),
        ("a/b", "no dictionary a"),
        ("v", r"is '\(0 1 0\)', which is no single number"),
        ("word", "is 'none'"),
        ("code", "no single number"),
    ],
)
def test_what_cannot_be_set_is_said(path, said):
    with pytest.raises(foam_entry.EntryError, match=said):
        foam_entry.number(DICTIONARY, path)


def test_a_file_that_ends_too_soon_is_an_error():
    with pytest.raises(foam_entry.EntryError, match="missing"):
        foam_entry.entry("a { b 1;", "a/b")
