# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Reads the study file: README.md's keys, each checked, nothing else allowed."""

import itertools
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from .descend_section import read_descend
from .infill_section import read_infill
from .errors import StudyError
from .expressions import Condition, Expression, RESERVED
from .response_section import read_response
from .section import Section, interval, load, number

# How many designs, or which: the key that each method of sampling takes
METHODS = {
    "latinHypercube": "designs",
    "sobol": "designs",
    "factorial": "levels",
    "table": "file",
}
# NAME.dryRun is the strategy NAME without the solver
DRY_RUN = ".dryRun"
STARTS = ("baseline", "nearest", "template")
# Of a parameter that has certain values only
MOST_VALUES = 10000
# The study's own folders and columns
TAKEN = {"baseline", "outcomes", "workflow", "template"}


@dataclass
class Target:
    """An entry of a dictionary of the case."""

    file: str
    entry: str


@dataclass
class Parameter:
    name: str
    low: float
    high: float
    baseline: float
    target: Target | None
    values: np.ndarray | None = None  # ascending; None: any between bounds

    def nearest(self, x):
        """The value it may have that is nearest."""
        if self.values is None:
            return x
        i = np.abs(np.asarray(x)[..., None] - self.values).argmin(axis=-1)
        return self.values[i]

    def of_share(self, x):
        """Values of numbers between the bounds, so that evenly spread numbers
        give each value alike often."""
        if self.values is None:
            return x
        n = len(self.values)
        share = (np.asarray(x) - self.low) / (self.high - self.low)
        return self.values[np.clip((share * n).astype(int), 0, n - 1)]

    @property
    def whole(self):
        return self.values is not None and (self.values % 1 == 0).all()


@dataclass
class Derived:
    name: str
    expression: Expression
    target: Target | None


@dataclass
class Sampling:
    method: str
    designs: int | None
    levels: dict | None
    seed: int
    file: str | None = None


@dataclass
class Step:
    name: str
    run: str
    timeout: float | None
    expect: str | None


@dataclass
class Strategy:
    name: str
    start: str
    steps: list


@dataclass
class Optimise:
    objectives: dict = field(default_factory=dict)  # name: +1 maximise, -1
    constraints: list = field(default_factory=list)
    population: int = 200
    generations: int = 200
    seed: int = 1
    max_clusters: int = 8
    feasibility: float = 0.5  # least probability to succeed


def read_target(section):
    file, entry = section.text("file", None), section.text("entry", None)
    if (file is None) != (entry is None):
        raise StudyError(f"{section.where} needs file and entry together")
    return Target(file, entry) if file else None


def read_range(item):
    """Bounds, and the values between them if not all are allowed."""
    if "values" in item:
        for refused in ("bounds", "step"):
            if refused in item:
                raise StudyError(
                    f"{item.where} has values and {refused}: use one of them"
                )
        values = np.unique(
            [number(v, item.at("values")) for v in item.items("values")]
        )
        if len(values) < 2:
            raise StudyError(
                f"{item.at('values')} must be two numbers or more"
            )
        return values[0], values[-1], values
    low, high = interval(item.get("bounds"), item.at("bounds"))
    if "step" not in item:
        return low, high, None
    step = item.number("step", low=0)
    n = (high - low) / step if step > 0 else 0
    if not 1 <= n <= MOST_VALUES or abs(n - round(n)) > 1e-9 * n:
        raise StudyError(
            f"{item.at('step')} is {step:g}; it must divide the bounds into"
            f" equal parts, {MOST_VALUES} at most"
        )
    return low, high, low + step * np.arange(round(n) + 1)


def read_steps(section, timeout):
    steps = []
    for name, value in section.names("steps").items():
        where = f"{section.at('steps')}/{name}"
        if isinstance(value, str):
            value = {"run": value}
        step = Section(value, where, ("run", "timeout", "expect"))
        steps.append(
            Step(
                name,
                step.text("run"),
                step.number("timeout", timeout, low=1e-3),
                step.regex("expect", None),
            )
        )
    return steps


class StudyFile:
    """A study file that was found right, and what follows from it."""

    KEYS = (
        "template",
        "exclude",
        "folder",
        "parametersFile",
        "parameters",
        "derived",
        "constraints",
        "sampling",
        "cores",
        "baseline",
        "strategies",
        "iterations",
        "responses",
        "notes",
        "failure",
        "picture",
        "fit",
        "optimise",
        "infill",
        "descend",
    )

    def __init__(self, path, content=None):
        """content: the file whose words count, while paths are relative to
        path."""
        self.path = Path(path).resolve()
        self.root = self.path.parent
        file = Section(load(content or path), "", self.KEYS)

        self.template = (self.root / file.text("template")).resolve()
        self.exclude = file.items("exclude", [])
        self.folder = (
            self.root / file.text("folder", self.path.stem + ".study")
        ).resolve()
        self.parameters_file = file.text("parametersFile", None)
        self.cores = file.number("cores", 1, low=1, whole=True)
        self.picture = file.text("picture", None)

        self._read_parameters(file)
        self._read_derived(file)
        self.constraints = self._conditions(
            file, "constraints", list(self.values(self.baseline))
        )
        self._read_sampling(file)
        self._read_strategies(file)
        self._read_responses(file)
        self._read_fit(file)
        self._read_optimise(file)
        self.infill = read_infill(file, self)
        self.descend = read_descend(file, self)

    @property
    def names(self):
        return [p.name for p in self.parameters]

    @property
    def lows(self):
        return np.array([p.low for p in self.parameters])

    @property
    def highs(self):
        return np.array([p.high for p in self.parameters])

    @property
    def discrete(self):
        """The names of those that have certain values only."""
        return [p.name for p in self.parameters if p.values is not None]

    def nearest(self, points):
        """Rows of points with the nearest values that they may have."""
        columns = np.asarray(points, float).reshape(-1, len(self.names)).T
        return np.stack(
            [p.nearest(x) for p, x in zip(self.parameters, columns)], axis=1
        )

    def spread(self, points):
        """Rows of evenly spread points with values that they may have."""
        columns = np.asarray(points, float).reshape(-1, len(self.names)).T
        return np.stack(
            [p.of_share(x) for p, x in zip(self.parameters, columns)], axis=1
        )

    def as_written(self, values):
        """As a case's dictionaries have them: whole numbers without a point."""
        whole = {p.name for p in self.parameters if p.whole}
        return {
            name: int(value) if name in whole else float(value)
            for name, value in values.items()
        }

    def values(self, parameters):
        """Parameters and derived quantities, by name; arrays as well."""
        values = dict(parameters)
        for item in self.derived:
            values[item.name] = item.expression(values, self.baseline_values)
        return values

    def feasible(self, points):
        """Which rows of points (one column per parameter) keep to all
        constraints."""
        values = self.values(dict(zip(self.names, np.asarray(points).T)))
        missed = sum(
            (
                np.asarray(c.violation(values, self.baseline_values))
                for c in self.constraints
            ),
            np.zeros(len(points)),
        )
        return missed == 0

    def broken(self, parameters):
        """The constraints that one design breaks."""
        values = self.values(parameters)
        return [
            c.text
            for c in self.constraints
            if c.violation(values, self.baseline_values) > 0
        ]

    def needs_baseline(self, strategy):
        """Whether the baseline has to have run: designs start from it, or an
        expression asks for its responses."""
        expressions = [
            r.expression
            for r in [*self.responses.values(), *self.notes.values()]
            if r.expression
        ]
        conditions = [
            *(self.optimise.constraints if self.optimise else []),
            *(self.descend.constraints if self.descend else []),
        ]
        asked = set().union(
            *(e.baseline_names for e in expressions),
            *(leaf.baseline_names for c in conditions for leaf in c.leaves),
        )
        return self.strategy(strategy).start != "template" or bool(
            asked & set(self.responses)
        )

    def strategy(self, name):
        """By its name; of a dry run, what comes before the solver."""
        if not name.endswith(DRY_RUN):
            return self.strategies[name]
        whole = self.strategies[name.removesuffix(DRY_RUN)]
        solver = self.iteration_step or whole.steps[-1].name
        steps = list(
            itertools.takewhile(lambda step: step.name != solver, whole.steps)
        )
        if not steps:
            raise StudyError(
                f"strategy {whole.name} has no step before {solver}, which a"
                " dry run leaves out: there is nothing to do. Make morphing"
                " and checking the mesh steps of their own"
            )
        start = "template" if whole.start == "template" else "baseline"
        return Strategy(name, start, steps)

    def targets(self):
        return [
            (item.name, item.target)
            for item in [*self.parameters, *self.derived]
            if item.target
        ]

    def _new_name(self, name, where):
        if name in RESERVED:
            raise StudyError(
                f"{where}: the name {name} has a meaning in"
                " expressions. Choose another"
            )
        if name in self._seen:
            raise StudyError(
                f"{where}: {name} stands there twice, as a"
                " parameter, derived quantity or response"
            )
        self._seen.add(name)

    def _read_parameters(self, file):
        self.parameters, self._seen = [], set()
        for name, content in file.names("parameters").items():
            item = Section(
                content,
                f"parameters/{name}",
                ("bounds", "values", "step", "baseline", "file", "entry"),
            )
            self._new_name(name, item.where)
            low, high, values = read_range(item)
            baseline = item.number("baseline")
            if values is not None and baseline not in values:
                raise StudyError(
                    f"{item.at('baseline')} is {baseline:g}, which is none of"
                    " the values " + " ".join(f"{v:g}" for v in values)
                )
            self.parameters.append(
                Parameter(name, low, high, baseline, read_target(item), values)
            )
        self.baseline = {p.name: p.baseline for p in self.parameters}

    def _read_derived(self, file):
        self.derived, self.baseline_values = [], dict(self.baseline)
        for name, content in (
            file.names("derived").items() if "derived" in file else ()
        ):
            where = f"derived/{name}"
            self._new_name(name, where)
            if not isinstance(content, dict):
                content = {"expression": content}
            item = Section(content, where, ("expression", "file", "entry"))
            expression = Expression(item.get("expression"), where)
            expression.check(list(self.baseline_values))
            self.derived.append(Derived(name, expression, read_target(item)))
            self.baseline_values[name] = expression(
                self.baseline_values, self.baseline_values
            )

    def _conditions(self, section, key, known):
        conditions = []
        for text in section.items(key, []):
            conditions.append(Condition(text, section.at(key)))
            conditions[-1].check(known)
        return conditions

    def _read_sampling(self, file):
        item = Section(
            file.get("sampling"),
            "sampling",
            ("method", "seed", *dict.fromkeys(METHODS.values())),
        )
        method = item.text("method")
        if method not in METHODS:
            raise StudyError(
                f"sampling/method is {method}; it must be one of"
                f" {' '.join(METHODS)}"
            )
        needs = METHODS[method]
        for refused in METHODS.values():
            if refused in item and refused != needs:
                raise StudyError(
                    f"sampling/{refused} says nothing to {method},"
                    f" which takes {needs}"
                )
        self.sampling = Sampling(
            method, None, None, item.number("seed", 1, low=0, whole=True)
        )
        if needs == "designs":
            self.sampling.designs = item.number("designs", low=1, whole=True)
            return
        if needs == "file":
            self.sampling.file = item.text("file")
            return
        levels = item.get("levels")
        if not isinstance(levels, dict):
            levels = dict.fromkeys(self.names, levels)
        levels = Section(levels, "sampling/levels", self.names)
        self.sampling.levels = {
            name: levels.number(name, low=1, whole=True) for name in self.names
        }

    def _read_strategies(self, file):
        failure = Section(
            file.get("failure", {}), "failure", ("timeout", "retries")
        )
        timeout = failure.number("timeout", None, low=1e-3)
        self.retries = failure.number("retries", 0, low=0, whole=True)

        self.strategies = {}
        for name, content in file.names("strategies").items():
            if name in TAKEN:
                raise StudyError(
                    f"strategies: {name} is a folder of the"
                    " study's own. Choose another name"
                )
            item = Section(content, f"strategies/{name}", ("start", "steps"))
            start = item.text("start", "baseline")
            if start not in STARTS:
                raise StudyError(
                    f"{item.at('start')} is {start}; it must be"
                    f" one of {' '.join(STARTS)}"
                )
            self.strategies[name] = Strategy(
                name, start, read_steps(item, timeout)
            )

        self.baseline_steps = None
        if "baseline" in file or any(
            s.start != "template" for s in self.strategies.values()
        ):
            item = Section(file.get("baseline"), "baseline", ("steps",))
            self.baseline_steps = read_steps(item, timeout)
        self._read_iterations(file)

    def _read_iterations(self, file):
        item = Section(
            file.get("iterations", {}), "iterations", ("step", "regex")
        )
        self.iteration_step = item.text("step", None)
        self.iteration_regex = item.regex("regex", r"^Time = ")
        for strategy in self.strategies.values():
            steps = [step.name for step in strategy.steps]
            if self.iteration_step not in (None, *steps):
                raise StudyError(
                    f"iterations/step: strategy {strategy.name} has no step"
                    f" {self.iteration_step}, but {' '.join(steps)}"
                )

    def _read_responses(self, file):
        steps = set.intersection(
            *(
                {step.name for step in s.steps}
                for s in self.strategies.values()
            )
        )
        self.responses = {}
        for name, content in file.names("responses").items():
            self._new_name(name, "responses")
            response = read_response(name, content, f"responses/{name}", steps)
            if response.expression:
                response.expression.check(
                    [*self.baseline_values, *self.responses]
                )
                self._needs_baseline(response.expression)
            self.responses[name] = response

        steps = {
            step.name for s in self.strategies.values() for step in s.steps
        }
        self.notes = {}
        for name, content in (
            file.names("notes").items() if "notes" in file else ()
        ):
            self._new_name(name, "notes")
            note = read_response(name, content, f"notes/{name}", steps)
            if note.expression:
                note.expression.check([*self.baseline_values, *self.responses])
            self.notes[name] = note

    def _needs_baseline(self, expression):
        """baseline.x of a response is what the baseline's run gave."""
        asked = expression.baseline_names & set(self.responses)
        if asked and self.baseline_steps is None:
            raise StudyError(
                f"{expression.where}: there is no baseline.{min(asked)},"
                " because no baseline is run. Add baseline/steps"
            )

    def _known(self, names, where):
        for name in names:
            if name not in self.responses:
                raise StudyError(
                    f"{where}: there is no response {name}. The responses are"
                    f" {' '.join(self.responses)}"
                )

    def _read_fit(self, file):
        item = Section(file.get("fit", {}), "fit", ("responses",))
        self.fitted = item.items("responses", [])
        self._known(self.fitted, "fit/responses")

    def _read_optimise(self, file):
        self.optimise = None
        if "optimise" in file:
            item = Section(
                file.get("optimise"),
                "optimise",
                (
                    "objectives",
                    "constraints",
                    "population",
                    "generations",
                    "seed",
                    "maxClusters",
                    "feasibility",
                ),
            )
            objectives = item.names("objectives")
            self._known(objectives, "optimise/objectives")
            senses = {"maximise": 1, "minimise": -1}
            for name, sense in objectives.items():
                if sense not in senses:
                    raise StudyError(
                        f"optimise/objectives/{name} is {sense};"
                        " it must be maximise or minimise"
                    )
            self.optimise = Optimise(
                {name: senses[sense] for name, sense in objectives.items()},
                self._conditions(
                    item,
                    "constraints",
                    [*self.baseline_values, *self.responses],
                ),
                item.number("population", 200, low=4, whole=True),
                item.number("generations", 200, low=1, whole=True),
                item.number("seed", 1, low=0, whole=True),
                item.number("maxClusters", 8, low=1, whole=True),
                item.number("feasibility", 0.5, low=0),
            )
            if self.optimise.feasibility >= 1:
                raise StudyError(
                    f"optimise/feasibility is {self.optimise.feasibility:g};"
                    " no design is certain to succeed: give a probability"
                    " below 1"
                )
            if self.optimise.population % 4:
                raise StudyError(
                    f"optimise/population is {self.optimise.population};"
                    " NSGA-II pairs tournaments: use a multiple of 4"
                )
        if not self.fitted:
            self.fitted = list(
                self.optimise.objectives if self.optimise else self.responses
            )
        if self.optimise:
            needed = set(self.optimise.objectives).union(
                *(
                    c.names & set(self.responses)
                    for c in self.optimise.constraints
                )
            )
            if not needed <= set(self.fitted):
                self.fitted += sorted(needed - set(self.fitted))
