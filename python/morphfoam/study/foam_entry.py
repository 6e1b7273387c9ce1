# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A number in a dictionary file, replaced where it stands.

foamDictionary would do it, but writes the whole file anew with six digits.

    entry(text, "solvers/p/tolerance")      # where its value stands
    replaced(text, "solvers/p/tolerance", 1e-7)
"""

import re

SPACE = re.compile(r"(?:\s+|//[^\n]*|/\*.*?\*/)*", re.DOTALL)
# What may hold a brace or a semicolon that is none
OPAQUE = re.compile(
    r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/|#\{.*?#\}', re.DOTALL
)
LINE = re.compile(r"[^\n]*")
KEYWORD = re.compile(r'"(?:\\.|[^"\\])*"|[^\s;{}"]+')
# A number alone, or after what may stand before one: a word (uniform, the name
# of a dimensioned scalar) and dimensions
NUMBER = re.compile(
    r"(?:[A-Za-z_]\w*\s+)?(?:\[[^\]]*\]\s*)?"
    r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\Z"
)


class EntryError(Exception):
    """Why an entry cannot be set."""


def skip(text, start, ends):
    """The position of the first of these characters outside brackets."""
    i, depth = start, 0
    while i < len(text):
        opaque = OPAQUE.match(text, i)
        if opaque:
            i = opaque.end()
            continue
        if depth == 0 and text[i] in ends:
            return i
        depth += (text[i] in "([{") - (text[i] in ")]}")
        i += 1
    raise EntryError(f"the file ends where one of '{ends}' is missing")


def entries(text, start, end):
    """Of a dictionary that stands there: (keyword, is a dictionary, start and
    end of its value), in order."""
    i = SPACE.match(text, start).end()
    while i < end:
        if text[i] == "#":
            i = LINE.match(text, i).end()
        elif text[i] in ";}":
            i += 1
        else:
            keyword = KEYWORD.match(text, i)
            if not keyword:
                raise EntryError(f"'{text[i:i + 20]}' is no keyword")
            value = SPACE.match(text, keyword.end()).end()
            is_dict = text[value : value + 1] == "{"
            stop = skip(text, value + is_dict, "}" if is_dict else ";")
            if not keyword.group().startswith("$"):
                yield keyword.group().strip(
                    '"'
                ), is_dict, value + is_dict, stop
            i = stop + 1
        i = SPACE.match(text, i).end()


def entry(text, path):
    """Start and end of the value of an entry; words are separated by '/'."""
    start, end, above = 0, len(text), "the file"
    *folders, last = path.split("/")
    for word, wants_dict in [*((w, True) for w in folders), (last, False)]:
        found = list(entries(text, start, end))
        # As OpenFOAM has it, the last of the same name counts
        spans = [e[2:] for e in found if e[0] == word and e[1] == wants_dict]
        if not spans:
            kind = "dictionary" if wants_dict else "entry"
            raise EntryError(
                f"there is no {kind} {word} in {above}, but"
                f" {' '.join(dict.fromkeys(e[0] for e in found)) or 'nothing'}"
            )
        start, end = spans[-1]
        above = word
    return start, end


def number(text, path):
    """Start and end of the number that an entry holds."""
    start, end = entry(text, path)
    value = text[start:end].rstrip()
    found = NUMBER.match(value)
    if not found:
        raise EntryError(
            f"the entry {path} is '{' '.join(value.split())[:60]}', which is no"
            " single number. Write $NAME there and use a parametersFile"
        )
    return start + found.start(1), start + found.end(1)


def replaced(text, path, value):
    """The file with this number, every digit of it."""
    start, end = number(text, path)
    return text[:start] + repr(value) + text[end:]
