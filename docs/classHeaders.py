# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The comment at the head of a class, as Markdown: its description, usage,
tables and notes."""

import re
import textwrap

SECTIONS = (
    "Class",
    "Namespace",
    "Group",
    "Description",
    "Usage",
    "Note",
    "SourceFiles",
)

COLUMNS = ("Property", "Description", "Required", "Default")


class ClassHeader:
    """The sections of a header file, by name; a section may come twice."""

    def __init__(self, path):
        self.path = path
        self.sections = []
        for line in _comment(path.read_text()).splitlines():
            if line in SECTIONS:
                self.sections.append((line, []))
            elif self.sections:
                self.sections[-1][1].append(line)
        self.sections = [
            (name, textwrap.dedent("\n".join(lines)).strip())
            for name, lines in self.sections
        ]

    def text(self, *names):
        """What sections of these names say."""
        return "\n\n".join(
            text for name, text in self.sections if name in names
        )

    def name(self):
        """Name of the class, without its namespace."""
        return self.text("Class").split("::")[-1]

    def entries(self):
        """Rows of the tables of dictionary entries: lists of four cells."""
        return [
            row
            for table in tables(self.text("Description", "Usage"))
            if is_of_entries(table)
            for row in table[1:]
        ]

    def markdown(self, *names):
        return markdown(self.text(*names))


def _comment(text):
    start = re.search(r"^(Class|Namespace)$", text, re.MULTILINE)
    if not start:
        return ""
    return text[start.start() : text.index("\\*---", start.start())]


def tables(text):
    """The tables of a text: rows, and in each its cells, markup and all."""
    return [
        _rows(body)
        for body in re.findall(r"\\table\n(.*?)\\endtable", text, re.DOTALL)
    ]


def _rows(body):
    rows = [
        [cell.strip() for cell in line.strip().rstrip("|").split("|")]
        for line in body.splitlines()
        if line.strip()
    ]
    width = len(rows[0])
    return [row + [""] * (width - len(row)) for row in rows]


def is_of_entries(table):
    return tuple(table[0]) == COLUMNS


def plain(cell):
    """A cell without markup: the entry that a row is about."""
    return re.sub(r"\\[cea] +|\\(?=[<>])", "", cell)


def markdown(text):
    """A comment for Doxygen as Markdown."""
    parts = re.split(
        r"(\\verbatim\n.*?\\endverbatim|\\table\n.*?\\endtable)",
        text,
        flags=re.DOTALL,
    )
    return "\n\n".join(filter(None, (_part(part) for part in parts)))


def _part(part):
    if part.startswith("\\verbatim"):
        code = textwrap.dedent(
            part[len("\\verbatim\n") : -len("\\endverbatim")]
        ).strip("\n ")
        return f"```\n{code}\n```"
    if part.startswith("\\table"):
        head, *rows = tables(part)[0]
        if is_of_entries([head]):
            rows = [
                [f"`{plain(row[0])}`"] + [_inline(c) for c in row[1:]]
                for row in rows
            ]
        else:
            rows = [[_inline(c) for c in row] for row in rows]
        return "\n".join(
            "| " + " | ".join(row) + " |"
            for row in [head, ["---"] * len(head)] + rows
        )
    return _lists(_inline(textwrap.dedent(part.strip("\n")).strip()))


def _inline(text):
    """Words and formulas; identifiers and places are code by themselves."""
    formulas = re.split(
        r"(\\f\[.*?\\f\]|\\f\$.*?\\f\$)", text, flags=re.DOTALL
    )
    for i, piece in enumerate(formulas):
        if piece.startswith("\\f["):
            formulas[i] = f"\n\n$$\n{piece[3:-3].strip()}\n$$\n\n"
        elif piece.startswith("\\f$"):
            formulas[i] = f"${piece[3:-3]}$"
        else:
            piece = re.sub(
                r"\\c +((?:\\.|[^\s,;:.)]|[.:](?=\w))+)",
                lambda m: "`" + plain(m[1]) + "`",
                piece,
            )
            piece = re.sub(r"</?b>", "**", piece)
            piece = re.sub(
                r"(?<![`\w/])((?:[\w.]+/)*<\w+>(?:/[\w<>]+(?:\.\w+)*)*)",
                r"`\1`",
                piece.replace("\\<", "<").replace("\\>", ">"),
            )
            formulas[i] = re.sub(
                r"\bDOI (10\.\S+?)(?=\s|$)",
                r"[doi:\1](https://doi.org/\1)",
                piece,
            )
    return "".join(formulas)


def _lists(text):
    """A blank line before a list, as Markdown wants it."""
    lines = text.splitlines()
    for i in range(len(lines) - 1, 0, -1):
        if (
            lines[i].startswith("- ")
            and not lines[i - 1].startswith(("- ", " "))
            and lines[i - 1]
        ):
            lines.insert(i, "")
    return "\n".join(lines)
