# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The project's Python keeps to PEP 8. Source of truth: flake8 with the
settings of .flake8; for names, PEP 8's section "Naming Conventions".
"""

import ast
import importlib.util
import pathlib
import re
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def sources(*folders):
    made = {"build", "runs", "lnInclude", "__pycache__"}
    return [
        path
        for folder in folders
        for path in (ROOT / folder).rglob("*.py")
        if not made.intersection(path.relative_to(ROOT).parts)
    ]


def test_flake8_finds_nothing():
    if importlib.util.find_spec("flake8") is None:
        pytest.skip("flake8 is not installed")
    done = subprocess.run(
        [
            sys.executable,
            "-m",
            "flake8",
            "python",
            "tests",
            "tutorials",
            "benchmarks",
            "docs",
        ],
        cwd=ROOT,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    assert done.returncode == 0, done.stdout


def defined(tree):
    """Functions, classes, arguments and variables that a file gives names."""
    for node in ast.walk(tree):
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            yield type(node), node.name
        elif isinstance(node, ast.arg):
            yield ast.arg, node.arg
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield ast.Name, node.id


@pytest.mark.parametrize("folders", [("python",), ("tutorials",)])
def test_names_are_in_snake_case(folders):
    wrong = []
    for path in sources(*folders):
        if folders == ("python",) and not re.fullmatch(
            r"[a-z0-9_]+", path.stem
        ):
            wrong.append(path.name)
        for kind, name in defined(ast.parse(path.read_text())):
            good = (
                r"_*[A-Z][A-Za-z0-9]*"
                if kind is ast.ClassDef
                else r"_*[a-z0-9_]+|_*[A-Z0-9_]+|visit_\w+"
            )
            # A letter of the literature's, as E of the rib, is a name too
            if not re.fullmatch(good, name) and len(name) > 1:
                wrong.append(f"{path.name}: {name}")
    assert not wrong


def test_no_script_searches_for_its_modules():
    """PYTHONPATH of etc/bashrc, bin/morphStudy and tests/pytest.ini leads to
    them."""
    wrong = [
        str(path.relative_to(ROOT))
        for path in sources(
            "python", "tests", "tutorials", "benchmarks", "docs"
        )
        if re.search(r"^\s*sys\.path\b", path.read_text(), re.MULTILINE)
    ]
    assert not wrong
