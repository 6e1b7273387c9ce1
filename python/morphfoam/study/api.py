# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A study from Python: what the command morphStudy does, and its results as
tables."""

import contextlib
import importlib
import io
import sys

from morphfoam import frames

from . import designs, outcomes, results
from .errors import StudyError
from .study_file import StudyFile


class Study:
    """A sweep of shapes, opened by its study file.

    >>> import morphfoam
    >>> study = morphfoam.Study("study.yaml")
    >>> study.strategies
    ['morph', 'near', 'remesh']
    >>> added = study.sample()
    >>> finished = study.run()
    >>> study.results().f.idxmin()
    '0001'

    Everything is written to the study's folder, as by the command, with
    which calls may be mixed: what is finished is not run again. Wrong study
    files raise morphfoam.StudyError, whose text says what to do. Methods that
    take a strategy mean the first of the file by default; those that return
    tables return pandas DataFrames.

    verbose print what the command would
    file    the study file as it was read (morphfoam.study.study_file)
    folder  where everything is written
    """

    def __init__(self, path, verbose=False):
        self.file = StudyFile(path)
        self.verbose = verbose
        self.folder = self.file.folder
        self.strategies = list(self.file.strategies)

    def _strategy(self, name):
        if name is not None and name not in self.strategies:
            raise StudyError(
                f"there is no strategy {name}; the strategies are"
                f" {' '.join(self.strategies)}"
            )
        return name or self.strategies[0]

    def _verb(self, name, *arguments, **options):
        # Late: what one verb needs should not slow the others
        module = importlib.import_module(f".{name}", __package__)
        verb = "run" if name == "sweep" else name
        said = sys.stdout if self.verbose else io.StringIO()
        with contextlib.redirect_stdout(said):
            return getattr(module, verb)(self.file, *arguments, **options)

    def check(self):
        """Raise StudyError where the study file, the template or a command
        is known to be wrong. Nothing is run or written."""
        self._verb("check", quiet=True)

    def sample(self):
        """Choose the designs that the study file asks for, beside those there
        are; the number of those added."""
        return len(self._verb("sample"))

    def run(
        self,
        strategy=None,
        cores=None,
        only=(),
        redo=(),
        profile=None,
        dry_run=False,
    ):
        """Run what is not finished; whether every design has an outcome now.

        cores    of this machine; default: all
        only     numbers of designs; default: all
        redo     numbers of designs to make again; or "failed", "baseline"
        profile  of Snakemake, for a cluster
        dry_run  morph and check meshes, without the solver

        >>> study.run(redo=[2])
        True
        """
        return not self._verb(
            "sweep",
            self._strategy(strategy),
            cores,
            only,
            redo,
            profile,
            dry_run,
        )

    def outcomes(self, strategy=None):
        """What became of each design that is finished: a list of
        morphfoam.study.outcomes.Outcome. Needs no pandas.

        >>> [round(o.responses["f"], 3) for o in study.outcomes()][:2]
        [0.24, 0.54]
        """
        strategy = self._strategy(strategy)
        found = [
            outcomes.read(self.file, strategy, design.number)
            for design in designs.read(self.file)
        ]
        return [outcome for outcome in found if outcome]

    def designs(self):
        """Origin and parameters of each design, by its number."""
        rows = [
            {"design": d.id, "origin": d.origin, **d.parameters}
            for d in designs.read(self.file)
        ]
        return frames.frame(rows, "design")

    def results(self, strategy=None):
        """One row per finished design, the baseline first: parameters,
        responses, times, figures of the mesh, the reason of a failure.

        >>> table = study.results("morph")
        >>> table[table.status == "done"][["x", "y", "f"]].head(3)
                    x    y     f
        design
        baseline  0.5  0.5  0.75
        0001      0.2  0.2  0.24
        0002      0.2  0.5  0.54
        """
        rows = results.rows(self.file, self._strategy(strategy))
        return frames.frame(rows, "design")

    def fit(self, strategy=None):
        """Fit the metamodels: {response: Model}. A model is called with rows
        of parameters.

        >>> models = study.fit()
        >>> round(float(models["f"].q2), 1)
        1.0
        >>> models["f"]([[0.2, 0.4]]).round(2)
        array([0.44])
        """
        return self._verb("fit", self._strategy(strategy))

    def optimise(self, strategy=None, verify=True, cores=None, profile=None):
        """Find the optimum, or front, on the metamodels and run its
        representatives (verify); the table of these, predicted beside
        computed.

        >>> best = study.optimise(verify=False)
        >>> list(best[["f.predicted", "g.predicted"]].columns)
        ['f.predicted', 'g.predicted']
        """
        strategy = self._strategy(strategy)
        self._verb(
            "optimise",
            strategy,
            no_runs=not verify,
            cores=cores,
            profile=profile,
        )
        return self.representatives(strategy)

    def _optimised(self, strategy, name):
        path = self.folder / f"optimise.{self._strategy(strategy)}" / name
        if not path.exists():
            raise StudyError(
                f"there is no {path} yet. Call optimise() first, or"
                f" 'morphStudy optimise {self.file.path.name}'"
            )
        return path

    def front(self, strategy=None):
        """The points of the front, or the one optimum: parameters, predicted
        objectives, cluster."""
        return frames.read_csv(self._optimised(strategy, "front.csv"))

    def representatives(self, strategy=None):
        """The designs that stand for the clusters of the front."""
        return frames.read_csv(
            self._optimised(strategy, "representatives.csv"), "design"
        )

    def infill(self, strategy=None, cores=None, profile=None):
        """Run designs where the metamodels expect most, as infill of the study
        file says; whether all have an outcome."""
        strategy = self._strategy(strategy)
        return not self._verb("infill", strategy, cores, profile)

    def descend(self, strategy=None, cores=None, profile=None):
        """Descend from the baseline (and other starts) to the nearest optimum;
        the table of where the starts ended, the best first. history() has the
        steps.

        >>> best = study.descend()
        >>> round(best.f[0], 2), len(study.history()) > 1
        (0.24, True)
        """
        strategy = self._strategy(strategy)
        self._verb("descend", strategy, cores, profile)
        return frames.read_csv(self._descended(strategy, "optima.csv"))

    def history(self, strategy=None):
        """The iterations of descend()."""
        return frames.read_csv(self._descended(strategy, "history.csv"))

    def _descended(self, strategy, name):
        path = self.folder / f"descend.{self._strategy(strategy)}" / name
        if not path.exists():
            raise StudyError(
                f"there is no {path} yet. Call descend() first, or"
                f" 'morphStudy descend {self.file.path.name}'"
            )
        return path

    def report(self):
        """Write the page with all there is so far; its path."""
        return self._verb("report")
