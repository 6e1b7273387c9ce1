# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Mistakes in files: what hands, editors, disks and other programs do to them.

    what, words = mutate(path, random)      # changes the file
"""

import re

NUMBER = re.compile(
    rb"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w.])"
)
WORD = re.compile(rb"[A-Za-z_][\w.]*")
ENTRY = re.compile(
    rb"^[ \t]*([A-Za-z_][\w.]*)[ \t]+[^;{}()\n]*;", re.MULTILINE
)

NUMBERS = [
    b"0",
    b"-1",
    b"1e300",
    b"-1e300",
    b"1e400",
    b"1e-150",
    b"nan",
    b"inf",
    b"99999",
    b"2000000000",
    b"99999999999999",
    b"1e15",
    b"1e-15",
    b"0.5",
    b"7",
    b"3.7",
    b"",
    b"one",
]
WORDS = [
    b"",
    b"none",
    b"yes",
    b"wall",
    b"0",
    b"1e5",
    b"auto",
    b"(",
    b"()",
    b'""',
    b"a" * 300,
    b"$x",
    b"#calc",
]


def pick(pattern, text, random):
    found = list(pattern.finditer(text))
    return random.choice(found) if found else None


def replaced(text, match, by):
    return text[: match.start()] + by + text[match.end() :]


def number(text, random):
    match = pick(NUMBER, text, random)
    return match and replaced(text, match, random.choice(NUMBERS))


def word(text, random):
    match = pick(WORD, text, random)
    others = [m.group() for m in WORD.finditer(text)][:200]
    return match and replaced(text, match, random.choice(WORDS + others))


def misspelt(text, random):
    match = pick(WORD, text, random)
    return match and replaced(text, match, match.group()[:-1] + b"q")


def valueless(text, random):
    match = pick(ENTRY, text, random)
    return match and replaced(text, match, match.group(1) + b";")


def braces(text, random):
    match = pick(ENTRY, text, random)
    return match and replaced(text, match, match.group(1) + b" { a 1; }")


def gone(text, random):
    match = pick(ENTRY, text, random)
    return match and replaced(text, match, b"")


def doubled(text, random):
    match = pick(ENTRY, text, random)
    return match and replaced(text, match, match.group() * 2)


def bracket(text, random):
    match = pick(re.compile(rb"[(){};]"), text, random)
    return match and replaced(
        text, match, random.choice([b"", b"(", b")", b"{", b"}", b";"])
    )


def count(text, random):
    match = pick(re.compile(rb"\b\d+(?=\s*[({])"), text, random)
    return match and replaced(
        text,
        match,
        random.choice(
            [
                b"2000000000",
                b"-1",
                b"0",
                b"1",
                str(int(match.group()) + 1).encode(),
                b"600000000",
            ]
        ),
    )


def repeated(text, random):
    return (
        re.sub(rb"\(", b"2000000000{", text, count=1)
        if random.random() < 0.5
        else text.replace(b"(", b"5{", 1)
    )


def line(text, random):
    lines = text.splitlines(keepends=True)
    if not lines:
        return None
    i = random.randrange(len(lines))
    return b"".join(
        random.choice(
            [
                lines[:i] + lines[i + 1 :],
                lines[:i] + [lines[i]] * 2 + lines[i + 1 :],
                lines[:i] + random.sample(lines, 1) + lines[i:],
            ]
        )
    )


def cut(text, random):
    return text[: random.randrange(len(text))] if text else None


def empty(text, random):
    return b""


def zeros(text, random):
    return bytes(len(text))


def flipped(text, random):
    if not text:
        return None
    data = bytearray(text)
    for _ in range(random.choice([1, 1, 4, 40])):
        data[random.randrange(len(data))] = random.randrange(256)
    return bytes(data)


def scaled(text, random):
    factor = random.choice([1e-150, 1e150, 1e-12, 0])
    return re.sub(
        rb"(?<![\w.])-?\d+\.\d+(?:e[-+]?\d+)?(?![\w.])",
        lambda m: repr(float(m.group()) * factor).encode(),
        text,
    )


def coincident(text, random):
    """One tuple of numbers in place of another one."""
    tuples = list(re.finditer(rb"\([^()a-z]*\)", text))
    if len(tuples) < 2:
        return None
    return replaced(text, random.choice(tuples), random.choice(tuples).group())


TEXT = [
    number,
    number,
    number,
    word,
    word,
    misspelt,
    valueless,
    braces,
    gone,
    doubled,
    bracket,
    count,
    repeated,
    line,
    cut,
    empty,
    zeros,
    flipped,
    coincident,
]
TABLE = [
    number,
    number,
    number,
    line,
    cut,
    empty,
    zeros,
    flipped,
    scaled,
    count,
    coincident,
    word,
]
BINARY = [cut, empty, zeros, flipped, flipped]


def mutate(path, random, kinds=TEXT):
    """Change the file; returns the name of the mistake and what was changed:
    the words around it, for which a message may be looked up."""
    before = path.read_bytes()
    for _ in range(50):
        mistake = random.choice(
            ["absent", "folder", *kinds] if random.random() < 0.1 else kinds
        )
        if mistake in ("absent", "folder"):
            path.unlink()
            if mistake == "folder":
                path.mkdir()
            return mistake, "whole file"
        after = mistake(before, random)
        if after is not None and after != before:
            path.write_bytes(after)
            return mistake.__name__, difference(before, after)
    return "nothing", ""


def difference(before, after):
    """The line of the first difference, before and after."""
    a, b = before.splitlines(), after.splitlines()
    for i in range(max(len(a), len(b))):
        old, new = a[i] if i < len(a) else b"", b[i] if i < len(b) else b""
        if old != new:
            return (
                f"line {i + 1}: {old[:70].decode(errors='replace')!r} -> "
                f"{new[:70].decode(errors='replace')!r}"
            )
    return ""
