# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Every error and warning of the C++ is in the documentation, with what to do.
Source of truth: the sources, in which each message is found.
"""

import importlib
import pathlib
import re

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def messages():
    return importlib.import_module("messages")


def test_every_message_says_what_to_do(messages):
    """The rest of the message does, or docs/remedies.txt."""
    remedies = messages.remedies()
    bare = {
        f"{message.path.name}: {message.fact}"
        for message in messages.messages()
        if not message.remedy
        and message.fact not in remedies
        and not message.of_the_core()
    }
    assert not bare


def test_no_remedy_is_without_a_message(messages):
    facts = {message.fact for message in messages.messages()}
    assert not set(messages.remedies()) - facts


def test_no_statement_is_overlooked(messages):
    """Each use of a macro of OpenFOAM's that starts a message is found."""
    for folder in ("src", "applications"):
        for path in (ROOT / folder).rglob("*.[CH]"):
            if "lnInclude" in path.parts:
                continue
            text = path.read_text()
            uses = len(
                re.findall(r"\b(?:Fatal\w*ErrorIn|\w*WarningIn)\w*", text)
            )
            found = sum(bool(m["kind"]) for m, _ in messages.statements(text))
            assert found == uses, path.name


def test_the_page_has_every_message(messages):
    page = re.sub(r"\\(.)", r"\1", messages.page())
    for message in messages.messages():
        assert message.fact in page
    assert "**  \n\n" not in page


@pytest.mark.parametrize(
    "source, fact, remedy",
    [
        (
            "FatalIOErrorInFunction(dict())\n    << \"Entry 'a' is \" << a << nl\n"
            '    << "    Use " << b << nl << exit(FatalIOError);',
            "Entry 'a' is …",
            "Use …",
        ),
        (
            'WarningInFunction\n    << "Gone; twice" << nl << "    Look" << endl;',
            "Gone; twice",
            "Look",
        ),
        (
            'FatalErrorInFunction\n    << "There is no " << f << ". Write it"\n'
            "    << exit(FatalError);",
            "There is no …",
            "Write it",
        ),
        (
            'throw std::invalid_argument("weights have to be positive");',
            "weights have to be positive",
            "",
        ),
    ],
)
def test_messages_are_found_in_sources(messages, source, fact, remedy):
    """Each form in which the sources say something."""
    ((_, statement),) = messages.statements(source)
    said = messages.Message(
        ROOT / "src/foam/a.C", False, messages.said(statement)
    )
    assert (said.fact, said.remedy) == (fact, remedy)
