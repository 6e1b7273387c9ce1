# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The section descend of the study file."""

from dataclasses import dataclass

from .errors import StudyError
from .expressions import Condition
from .section import Section

SENSES = {"maximise": 1, "minimise": -1}
METHODS = ("finiteDifference",)
SCHEMES = ("forward", "central", "auto")


@dataclass
class Descend:
    """README.md has the keys."""

    objective: str
    sense: int
    constraints: list
    parameters: list
    geometry: str | None
    scheme: str
    step: float
    radius: float
    min_radius: float
    max_iterations: int
    tolerance: float
    noise: float
    starts: int
    seed: int
    # Of the folder's name
    suffix: str = ""


def fraction(item, key, default):
    value = item.number(key, default, low=0)
    if not 0 < value <= 0.5:
        raise StudyError(
            f"{item.at(key)} is {value:g}; it is a part of the distance"
            " between the bounds: more than 0, at most 0.5"
        )
    return value


def read_descend(file, study):
    """The section, or None where there is none."""
    if "descend" not in file:
        return None
    item = Section(
        file.get("descend"),
        "descend",
        (
            "objective",
            "constraints",
            "parameters",
            "geometry",
            "gradient",
            "radius",
            "minRadius",
            "maxIterations",
            "tolerance",
            "noise",
            "starts",
            "seed",
        ),
    )
    name, sense = read_objective(item, study)
    known = [*study.baseline_values, *study.responses]
    constraints = []
    for text in item.items("constraints", []):
        condition = Condition(text, item.at("constraints"), equalities=True)
        condition.check(known)
        # Known now to be a conjunction of comparisons
        condition.sides()
        constraints.append(condition)
    gradient = Section(
        item.get("gradient", {}),
        item.at("gradient"),
        ("method", "step", "scheme"),
    )
    choose(gradient, "method", METHODS[0], METHODS)
    return Descend(
        name,
        sense,
        constraints,
        read_parameters(item, study),
        item.text("geometry", None),
        choose(gradient, "scheme", "forward", SCHEMES),
        fraction(gradient, "step", 0.01),
        fraction(item, "radius", 0.125),
        fraction(item, "minRadius", 0.002),
        item.number("maxIterations", 20, low=1, whole=True),
        item.number("tolerance", 1e-3, low=0),
        item.number("noise", 1e-5, low=0),
        item.number("starts", 1, low=1, whole=True),
        item.number("seed", 1, low=0, whole=True),
    )


def read_objective(item, study):
    objective = item.names("objective")
    if len(objective) != 1:
        raise StudyError(
            f"{item.at('objective')} has {' and '.join(objective)}. A descent"
            " has one objective: weigh them in a response with an expression,"
            " or let optimise find their front"
        )
    (name,) = objective
    if name not in study.responses:
        raise StudyError(
            f"{item.at('objective')}: there is no response {name}. The"
            f" responses are {' '.join(study.responses)}"
        )
    if objective[name] not in SENSES:
        raise StudyError(
            f"{item.at('objective')}/{name} is {objective[name]}; it must be"
            " maximise or minimise"
        )
    return name, SENSES[objective[name]]


def choose(item, key, default, words):
    word = item.text(key, default)
    if word not in words:
        raise StudyError(
            f"{item.at(key)} is {word}; it must be one of {' '.join(words)}"
        )
    return word


def read_parameters(item, study):
    names = item.items(
        "parameters", [n for n in study.names if n not in study.discrete]
    )
    if not names:
        raise StudyError(
            "descend: all parameters have certain values only, and a descent"
            " moves between values. Use optimise or infill"
        )
    for name in names:
        if name in study.discrete:
            raise StudyError(
                f"{item.at('parameters')}: {name} has certain values only, and"
                " a descent moves between values. Leave it out, and it stays"
                " at the baseline's"
            )
        if name not in study.names:
            raise StudyError(
                f"{item.at('parameters')}: there is no parameter {name}. The"
                f" parameters are {' '.join(study.names)}"
            )
    if len(set(names)) < len(names) or not names:
        raise StudyError(
            f"{item.at('parameters')}: list each parameter that is to move"
            " once, at least one"
        )
    return [name for name in study.names if name in names]
