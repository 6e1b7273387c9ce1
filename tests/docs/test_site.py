# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The documentation site: it builds, and a browser finds nothing wrong with it
(broken links, missing pictures, equations that are not drawn, pages that scroll
sideways on a phone). Source of truth: Chromium, which loads every page.
"""

import importlib
import pathlib
import shutil
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SITE = ROOT / "build/site"

MISSING = [
    package
    for package, there in (
        ("mkdocs-material", pathlib.Path("/usr/share/mkdocs/themes/material")),
        ("libjs-katex", pathlib.Path("/usr/share/javascript/katex")),
        ("doxygen", pathlib.Path("/usr/bin/doxygen")),
    )
    if not there.exists()
]
needs_builder = pytest.mark.skipif(
    bool(MISSING), reason=f"packages are missing: {' '.join(MISSING)}"
)
needs_browser = pytest.mark.skipif(
    not shutil.which("chromium"), reason="there is no chromium to look with"
)


@pytest.fixture(scope="module")
def browse():
    return importlib.import_module("browse")


@pytest.fixture(scope="module")
def site():
    subprocess.run([ROOT / "docs/Allrun", "-noBrowser"], check=True)
    return SITE


@needs_builder
def test_every_page_of_the_guide_is_built(site):
    for page in (ROOT / "docs/pages").glob("*.md"):
        assert (site / page.with_suffix(".html").name).is_file()
    for page in (
        "reference.html",
        "tutorials.html",
        "architecture.html",
        "study.html",
        "api/index.html",
    ):
        assert (site / page).is_file()


@needs_builder
def test_every_tutorial_is_in_the_gallery(site):
    gallery = (site / "tutorials.html").read_text()
    for readme in (ROOT / "tutorials").glob("*/README.md"):
        assert f'id="{readme.parent.name.lower()}"' in gallery


@needs_builder
@needs_browser
def test_a_browser_finds_nothing_wrong(site, browse):
    wrong, seen = browse.look(site)
    assert not wrong
    assert sum(page["equations"] for page in seen.values()) > 40
    assert sum(len(page["links"]) for page in seen.values()) > 500


PAGE = """<!DOCTYPE html><html><head><title>t</title>
<meta name="viewport" content="width=device-width"></head><body><article>{}""" + (
    "word " * 30 + "</article></body></html>"
)


@needs_browser
@pytest.mark.parametrize(
    "body, complaint",
    [
        ('<a href="gone.html">x</a>', "broken link gone.html"),
        ('<a href="#gone">x</a>', "broken link index.html#gone"),
        ('<img src="gone.png">', "no picture"),
        ('<div style="width:3000px">x</div>', "scrolls sideways on a phone"),
        ('<span class="arithmatex">x</span>', "equations are not drawn"),
        ("<script>throw new Error('bad')</script>", "bad"),
        ('<script>fetch("http://example.invalid/")</script>', "another host"),
    ],
)
def test_faults_are_found(browse, tmp_path, body, complaint):
    """Each kind of fault, planted in a page."""
    (tmp_path / "index.html").write_text(PAGE.format(body))
    wrong, _ = browse.look(tmp_path)
    assert any(complaint in what for _, what in wrong), wrong


@needs_browser
def test_a_page_without_faults_has_none(browse, tmp_path):
    (tmp_path / "index.html").write_text(
        PAGE.format('<a href="#a" id="a">x</a>')
    )
    wrong, _ = browse.look(tmp_path)
    assert not wrong
