# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Mappings of a YAML file whose keys are known, and what their values may be."""

import math
import re
from pathlib import Path

import yaml

from .errors import StudyError

NAME = re.compile(r"[A-Za-z_]\w*$")


class UniqueKeys(yaml.SafeLoader):
    """YAML in which a key that stands twice is an error."""

    def construct_mapping(self, node, deep=False):
        seen = set()
        for key, _ in node.value:
            if key.value in seen:
                raise StudyError(
                    f"line {key.start_mark.line + 1}: the key '{key.value}'"
                    " stands twice. Keep one of them"
                )
            seen.add(key.value)
        return super().construct_mapping(node, deep)


def load(path):
    """The content of a YAML file."""
    try:
        content = yaml.load(Path(path).read_text("utf-8"), UniqueKeys)
    except OSError as error:
        raise StudyError(f"{path} cannot be read: {error.strerror}") from None
    except (
        # Of bytes that are no text, values that only look like numbers or
        # dates, and keys that are lists
        yaml.YAMLError,
        StudyError,
        ValueError,
        TypeError,
        RecursionError,
    ) as error:
        raise StudyError(f"{path} is no YAML file: {error}") from None
    return content


class Section:
    """A mapping of the file whose keys are taken out one by one."""

    def __init__(self, content, where, allowed):
        self.where = where
        if not isinstance(content, dict):
            raise StudyError(
                f"{where or 'The study file'} must be a list of 'key: value'"
                f" with the keys {' '.join(allowed)}; it is '{content}'"
            )
        unknown = [str(key) for key in content if key not in allowed]
        if unknown:
            raise StudyError(
                f"{self.at(unknown[0])} is no key of a study file. Allowed"
                f" {'in ' + where if where else 'here'}: {' '.join(allowed)}"
            )
        self.content = content

    def at(self, key):
        return f"{self.where}/{key}" if self.where else str(key)

    def __contains__(self, key):
        return self.content.get(key) is not None

    def get(self, key, default=...):
        if key in self:
            return self.content[key]
        if default is ...:
            raise StudyError(
                f"{self.at(key)} is missing; README.md of"
                " morphStudy says what belongs there"
            )
        return default

    def number(self, key, default=..., low=-math.inf, whole=False):
        value = self.get(key, default)
        if value is None:
            return None
        value = number(value, self.at(key))
        if whole and value != int(value) or value < low:
            raise StudyError(
                f"{self.at(key)} is {value:g}; it must be a"
                f"{' whole' if whole else ''} number of at least {low:g}"
            )
        return int(value) if whole else value

    def text(self, key, default=...):
        value = self.get(key, default)
        if value is not None and not isinstance(value, str):
            raise StudyError(f"{self.at(key)} is '{value}'; it must be a text")
        return value

    def regex(self, key, default=..., groups=None):
        text = self.text(key, default)
        if text is None:
            return None
        try:
            found = re.compile(text).groups
        except re.error as error:
            raise StudyError(
                f"{self.at(key)}: '{text}' is no regular"
                f" expression ({error})"
            ) from None
        if groups is not None and found != groups:
            raise StudyError(
                f"{self.at(key)}: '{text}' has {found} groups; put ( ) round"
                " the number, and (?: ) where you only group"
            )
        return text

    def items(self, key, default=...):
        value = self.get(key, default)
        value = [value] if isinstance(value, str) else value
        if not isinstance(value, list):
            raise StudyError(f"{self.at(key)} is '{value}'; it must be a list")
        return value

    def names(self, key):
        """The mapping under key, its names checked."""
        content = self.get(key)
        if not isinstance(content, dict) or not content:
            raise StudyError(
                f"{self.at(key)} must be a list of 'name: ...' with at least"
                f" one name; it is '{content}'"
            )
        for name in content:
            if not isinstance(name, str) or not NAME.match(name):
                raise StudyError(
                    f"{self.at(key)}: '{name}' is no name. Use letters, digits"
                    " and _, a letter first"
                )
        return content


def number(value, where):
    # YAML takes 1e-5 for a text
    try:
        if isinstance(value, bool):
            raise ValueError
        value = float(value)
    except (TypeError, ValueError):
        raise StudyError(f"{where} is '{value}', which is no number") from None
    if not math.isfinite(value):
        raise StudyError(f"{where} is {value}; it must be finite")
    return value


def interval(value, where):
    if not isinstance(value, list) or len(value) != 2:
        raise StudyError(f"{where} is '{value}'; write [lowest, highest]")
    low, high = (number(v, where) for v in value)
    if not low < high:
        raise StudyError(
            f"{where} is [{low:g}, {high:g}]: the first must be the smaller"
        )
    return low, high
