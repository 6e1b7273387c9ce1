#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""messages.py [FILE]: one page with every error and warning, found in the C++
sources, and what to do about each: as the message itself says, or as
remedies.txt beside this file adds.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]

# Folder of src or applications, and what its messages are about
SUBJECTS = {
    "controlPointGroups": "Groups of control points",
    "motion": "Prescribed displacements",
    "bodies": "Rigid bodies in the flow",
    "controlPoints": "Control points",
    "sliding": "Sliding surfaces",
    "rbfMotionSolver": "rbfMotionSolver",
    "ffd": "Boxes and parameters",
    "shapeConstraints": "Constraints of shapes",
    "ffdMotionSolver": "ffdMotionSolver",
    "meshSymmetry": "Symmetric and periodic meshes",
    "meshValidity": "Invalid meshes",
    "foam": "Any dictionary",
    "controlGeometry": "Function object motionControls",
    "catalyst": "Function object catalyst",
    "remesh": "Re-meshing",
    "numerics": "Numerical core",
    "morphMesh": "morphMesh",
    "morphSurface": "morphSurface",
    "morphRemesh": "morphRemesh",
}

# What the solvers check before the core would find out
OF_THE_CORE = (
    "The motion solvers check this before they call the core: "
    "please report it, with the case."
)

# What starts a message, whether it is an error, and what ends it
EMITTERS = re.compile(
    r"\b(?P<kind>Fatal(?:IO)?ErrorInFunction|(?:IO)?WarningInFunction)\b"
    r"(?:\s*\((?:[^()]|\([^()]*\))*\))?\s*(?=<<)"
    r"|\bthrow std::\w+\s*(?=\()"
    r"|\bmessage\s*(?=<<)"
    r"|\bmessage\s*=\s*(?=\")"
)


class Message:
    """What a statement of the sources says, with … for what it fills in: its
    first sentence and the rest."""

    def __init__(self, path, warning, text):
        self.path = path
        self.warning = warning
        lines = [
            re.sub(r"\s+", " ", line).strip() for line in text.split("\n")
        ]
        lines = [line for line in lines if line.strip(" .…")]
        while len(lines) > 1 and (
            lines[0].endswith(",") or lines[1][0].islower()
        ):
            lines[:2] = [f"{lines[0]} {lines[1]}"]
        first, _, more = lines[0].partition(". ")
        self.fact = first.lstrip(": ")
        self.remedy = " ".join([more] + lines[1:]).strip()

    def of_the_core(self):
        return "numerics" in self.path.parts

    def subject(self):
        parts = self.path.relative_to(ROOT).parts
        return SUBJECTS.get(parts[1], parts[1])


def statements(text):
    """(emitter, rest of its statement) for each message in a source."""
    for match in EMITTERS.finditer(text):
        yield match, text[match.end() : _end(text, match.end())]


def _end(text, start):
    """The semicolon that ends a statement; strings are skipped."""
    for token in re.finditer(
        r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])\'|;', text[start:]
    ):
        if token[0] == ";":
            return start + token.start()
    return len(text)


def said(statement):
    """The words of a statement: its strings, ... for expressions, and lines."""
    # A number of things, in the plural
    statement = re.sub(
        r'(?:plainText::)?counted\s*\([^;"]*?,\s*"([\w ]+)"\s*\)(?:\.c_str\(\))?',
        r'"… \1s"',
        statement,
    )
    text = ""
    for token in re.finditer(
        r'"((?:\\.|[^"\\])*)"|\b(nl|endl)\b|(\bexit\b|\babort\b)|[\w.:]+',
        statement,
    ):
        if token[3]:
            break
        if token[1] is not None:
            text += token[1].replace("\\n", "\n").replace('\\"', '"')
        elif token[2]:
            text += "\n"
        elif not text.endswith("…"):
            text += "…"
    return text.lstrip("…") if text.strip("…\n ") else ""


def messages():
    """All messages of src and applications."""
    found = []
    for folder in ("src", "applications"):
        for path in sorted((ROOT / folder).rglob("*")):
            if (
                path.suffix not in (".C", ".H", ".cpp", ".hpp")
                or "lnInclude" in path.parts
            ):
                continue
            for emitter, rest in statements(path.read_text()):
                words = said(rest)
                if words:
                    found.append(
                        Message(
                            path, "Warning" in (emitter["kind"] or ""), words
                        )
                    )
    return found


def remedies():
    """Of remedies.txt: what to do by first sentence."""
    found = {}
    text = (ROOT / "docs/remedies.txt").read_text()
    for block in re.split(r"\n\s*\n", re.sub(r"^#.*\n", "", text, flags=re.M)):
        fact, _, remedy = block.strip().partition("\n")
        found[fact.strip()] = " ".join(remedy.split())
    return found


def _escaped(text):
    return re.sub(r"([<*_\[\]])", r"\\\1", text)


def page():
    added = remedies()
    by_subject = {}
    for message in messages():
        by_subject.setdefault(message.subject(), []).append(message)

    parts = []
    for subject in [
        *SUBJECTS.values(),
        *sorted(set(by_subject) - set(SUBJECTS.values())),
    ]:
        if subject not in by_subject:
            continue
        parts.append(f"## {subject}")
        for message in dict((m.fact, m) for m in by_subject[subject]).values():
            kind = "Warning: " if message.warning else ""
            remedy = (
                message.remedy
                or added.get(message.fact)
                or (OF_THE_CORE if message.of_the_core() else "")
            )
            parts.append(
                f"{kind}**{_escaped(message.fact)}**  \n" f"{_escaped(remedy)}"
            )
    return "\n\n".join(parts) + "\n"


if __name__ == "__main__":
    if len(sys.argv) > 1:
        pathlib.Path(sys.argv[1]).write_text(page())
    else:
        print(page(), end="")
