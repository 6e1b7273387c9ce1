# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The manual pages of the Debian package.

Source of truth: the options that the sources register, and VERSION.
"""

import re

import pytest

from foamCase import ROOT


def page(name):
    return (ROOT / f"debian/man/{name}.1").read_text()


@pytest.mark.parametrize("name", ["morphMesh", "morphSurface", "morphRemesh"])
def test_every_option_of_a_command_has_a_paragraph(name):
    source = (ROOT / f"applications/{name}/{name}.C").read_text()
    options = re.findall(r'argList::add(?:Bool)?Option\s*\(\s*"(\w+)"', source)
    assert len(options) >= 4
    described = re.findall(r"^\.TP\n\.BI? \\-(\w+)", page(name), re.MULTILINE)
    assert set(options) <= set(described)


@pytest.mark.parametrize(
    "name", ["morphMesh", "morphSurface", "morphRemesh", "morphStudy"]
)
def test_pages_have_the_version(name):
    version = (ROOT / "VERSION").read_text().strip()
    assert f'"morphFoam {version}"' in page(name)
