#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Builds the documentation site into build/site: pages of docs/pages, pages
made from class headers, messages, tutorials and READMEs, and the numerical core
by Doxygen.
"""

import pathlib
import re
import shutil
import subprocess
import sys

import messages
import reference

ROOT = pathlib.Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
WORK = ROOT / "build/docs"
PAGES = WORK / "pages"
KATEX = pathlib.Path("/usr/share/javascript/katex")


def tutorials():
    """The gallery: each tutorial's README under its pictures."""
    parts = [
        "# Tutorials",
        "Each is run by one command, `tutorials/<name>/Allrun`, which makes its "
        "mesh, moves it, compares with the number given here and draws the "
        "pictures (`-noPictures` does without ParaView). A click enlarges a "
        "picture.",
    ]
    for readme in sorted((ROOT / "tutorials").glob("*/README.md")):
        name = readme.parent.name
        parts.append(f"## {name}")
        pictures = sorted((DOCS / "pictures").glob(f"{name}.*png"))
        if pictures:
            links = "\n\n".join(
                f"[![{name}](pictures/{p.name})](pictures/{p.name})"
                for p in pictures
            )
            parts.append(f'<div class="row" markdown>\n\n{links}\n\n</div>')
        parts.append(from_readme(_summary(readme.read_text()), readme.parent))
    return "\n\n".join(parts) + "\n"


def _summary(text):
    """What comes before the first section, a paragraph for each line."""
    return "\n\n".join(
        line for line in text.split("\n## ")[0].splitlines() if line
    )


def from_readme(text, folder):
    """A README as a page: links to what is not in the site become text, and
    what is in a list is indented by four."""

    def link(match):
        if "://" in match[2] or match[2].startswith("#"):
            return match[0]
        return f"`{(folder/match[2]).relative_to(ROOT)}`"

    text = re.sub(r"(?<!!)\[([^\]]+)\]\(([^)]+)\)", link, text)
    lines, listed = [], False
    for line in text.splitlines():
        if line.strip() and not line.startswith(" "):
            listed = bool(re.match(r"\d+\. ", line))
        lines.append(" " + line if listed and line.startswith("   ") else line)
    return "\n".join(lines) + "\n"


def study():
    """The manual of morphStudy, wherever the package has it."""
    found = [
        path
        for path in ROOT.glob("*/**/README.md")
        if path.relative_to(ROOT).parts[0] in ("scripts", "python")
        and path.read_text().startswith("# morphStudy")
    ]
    if not found:
        raise SystemExit("build.py: there is no README of morphStudy")
    return from_readme(found[0].read_text(), found[0].parent)


def troubleshooting():
    text = (DOCS / "pages/troubleshooting.md").read_text()
    mark = "<!-- messages -->"
    if mark not in text:
        raise SystemExit(f"build.py: troubleshooting.md has no line {mark}")
    return text.replace(mark, messages.page())


def contributing():
    page = ROOT / "CONTRIBUTING.md"
    if page.exists():
        return from_readme(page.read_text(), ROOT)
    return (DOCS / "pages/contributing.md").read_text()


GENERATED = {
    "reference.md": reference.page,
    "troubleshooting.md": troubleshooting,
    "tutorials.md": tutorials,
    "study.md": study,
    "contributing.md": contributing,
    "benchmarks.md": lambda: from_readme(
        (ROOT / "benchmarks/README.md").read_text(), ROOT / "benchmarks"
    ),
    "architecture.md": lambda: (DOCS / "architecture.md").read_text()
    + "\nClasses and functions of the numerical core: [its own pages]"
    "(api/index.html).\n",
}


def collect():
    """All that the site is made of, in build/docs."""
    shutil.rmtree(WORK, ignore_errors=True)
    shutil.copytree(DOCS / "pages", PAGES)
    shutil.copytree(DOCS / "pictures", PAGES / "pictures")
    for name, make in GENERATED.items():
        (PAGES / name).write_text(make())
    shutil.copy(DOCS / "mkdocs.yml", WORK)
    for name in ("site.css", "equations.js"):
        shutil.copy(DOCS / name, PAGES)
    # Fonts as browsers take them, without those for others
    (PAGES / "katex/fonts").mkdir(parents=True)
    for path in [
        KATEX / "katex.min.css",
        KATEX / "katex.min.js",
        *(KATEX / "fonts").glob("*.woff2"),
    ]:
        shutil.copy(path, PAGES / "katex" / path.relative_to(KATEX))


def main():
    collect()
    subprocess.run(["doxygen", "docs/Doxyfile"], cwd=ROOT, check=True)
    subprocess.run(
        [
            sys.executable,
            "-m",
            "mkdocs",
            "build",
            "--strict",
            "--quiet",
            "--config-file",
            WORK / "mkdocs.yml",
        ],
        check=True,
    )


if __name__ == "__main__":
    main()
