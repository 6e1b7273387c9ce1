# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The reference of dictionary entries is complete: no entry that the sources
read without a row in the table of its class, no row without an entry. Source
of truth: the C++ sources, which stop on any entry that they do not list.
"""

import importlib
import pathlib

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def reference():
    return importlib.import_module("reference")


def rows(reference, name):
    return [
        reference.plain(row[0]) for row in reference.header(name).entries()
    ]


def test_no_entry_is_without_a_row(reference):
    missing = {
        title: sorted(
            reference.entries_of(name, sources) - set(rows(reference, name))
        )
        for title, name, sources in reference.DICTIONARIES
    }
    assert not {title: names for title, names in missing.items() if names}


def test_no_row_is_without_an_entry(reference):
    idle = {
        title: sorted(
            set(rows(reference, name)) - reference.entries_of(name, sources)
        )
        for title, name, sources in reference.DICTIONARIES
    }
    assert not {title: names for title, names in idle.items() if names}


def test_every_source_that_reads_a_dictionary_has_a_place(reference):
    """A new dictionary gets a line in docs/reference.py."""
    known = {
        source
        for _, name, sources in reference.DICTIONARIES
        for source in sources or [name]
    } | set(reference.NOT_A_USERS)
    homeless = {
        path.stem: sorted(reference.entries_read(path.read_text()))
        for path in (ROOT / "src").rglob("*.C")
        if "lnInclude" not in path.parts
        and path.stem not in known
        and reference.entries_read(path.read_text())
    }
    assert not homeless


def test_every_row_says_what_it_is_and_whether_it_is_required(reference):
    for title, name, _ in reference.DICTIONARIES:
        for entry, what, required, _ in reference.header(name).entries():
            assert what and required, f"{title}: {entry}"


def test_every_table_of_entries_is_in_the_reference(reference):
    names = {name for _, name, _ in reference.DICTIONARIES}
    # Classes that others build on; their rows are in the tables of those
    names |= {"ffdBoxes"}
    homeless = [
        path.stem
        for path in (ROOT / "src").rglob("*.H")
        if "lnInclude" not in path.parts
        and path.stem not in names
        and reference.ClassHeader(path).entries()
    ]
    assert not homeless


@pytest.mark.parametrize(
    "source, read",
    [
        ('a = dict.get<vector>("span");', {"span"}),
        ('n_(dict.getOrDefault<scalar>("min", -GREAT)),', {"min"}),
        ('if (coeffs.found("controlPoints"))', {"controlPoints"}),
        ('getPositive(dict, "radius")', {"radius"}),
        ('Function1<scalar>::New("value", dict)', {"value"}),
        (
            'onlyKeys\n(\n    dict,\n    {"type", name + "Coeffs"}\n);',
            {"type", "<name>Coeffs"},
        ),
        (
            'wordList keys({"tolerance", "maxPoints"});',
            {"tolerance", "maxPoints"},
        ),
        ('keys.append("degree");', {"degree"}),
        (
            'for (const char* key : {"surface", "target"})',
            {"surface", "target"},
        ),
        ('return {"origin", "axis"};', {"origin", "axis"}),
        ('{ policy::error, "error" }', set()),
        ("<< \"Entry 'order' is \" << order", set()),
        ('mesh.lookupObject<pointVectorField>("pointDisplacement")', set()),
    ],
)
def test_entries_are_found_in_sources(reference, source, read):
    """Each form in which the sources name an entry."""
    assert reference.entries_read(source) == read


def test_the_page_has_every_row_with_its_words(reference):
    page = reference.page()
    for title, name, _ in reference.DICTIONARIES:
        assert reference.heading(title) in page
        for entry in rows(reference, name):
            assert f"| `{entry}` |" in page, f"{title}: {entry}"
    for rest in ("\\table", "\\verbatim", "\\f[", "\\c ", "\\<"):
        assert rest not in page
