# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The command: morphStudy VERB STUDYFILE [options]."""

import argparse
import importlib
import sys

from .errors import StudyError

VERBS = {
    "check": "is the file right? Nothing is run or written",
    "sample": "choose the designs, adding to those there are",
    "run": "run what is not yet finished; killed, say it again",
    "status": "what is finished, what failed and why, time left",
    "fit": "kriging of each response, leave-one-out error",
    "optimise": "Pareto front, clusters, representatives, verification",
    "infill": "runs where the metamodels expect most; killed, say it again",
    "descend": "from the baseline to the nearest optimum; killed, say it again",
    "importance": "which parameters the descent owes its gain to",
    "report": "one HTML page",
}
# Those that run designs
RUNNING = ("run", "optimise", "infill", "descend", "importance")


def parser():
    top = argparse.ArgumentParser(
        prog="morphStudy",
        description="Sweeps of shapes from one baseline."
        " Every key of the study file: python/morphfoam/study/README.md",
    )
    verbs = top.add_subparsers(dest="verb", required=True, metavar="VERB")
    for verb, meaning in VERBS.items():
        one = verbs.add_parser(verb, help=meaning, description=meaning)
        one.add_argument("study", metavar="STUDYFILE")
        if verb in (*RUNNING, "fit"):
            one.add_argument("-strategy", help="default: the file's first")
        if verb in (*RUNNING, "status"):
            one.add_argument("-cores", type=int, help="default: all")
        if verb in RUNNING:
            one.add_argument(
                "-profile",
                help="a profile of Snakemake, for" " Slurm and the like",
            )
        if verb == "run":
            one.add_argument(
                "-only",
                type=int,
                nargs="+",
                default=[],
                metavar="ID",
                help="these designs",
            )
            one.add_argument(
                "-redo",
                nargs="+",
                default=[],
                metavar="ID",
                help="make these again, those that 'failed', or the"
                " 'baseline' and all that is made from it",
            )
            one.add_argument(
                "-dryRun",
                dest="dry_run",
                action="store_true",
                help="morph and check meshes, without the solver",
            )
        if verb == "report":
            one.add_argument(
                "-watch",
                action="store_true",
                help="write it again as designs finish, while a sweep is at"
                " work",
            )
        if verb == "importance":
            one.add_argument(
                "-counts",
                type=int,
                nargs="+",
                default=[],
                metavar="N",
                help="descend again with so many parameters, those that"
                " matter most",
            )
        if verb == "optimise":
            one.add_argument(
                "-noRuns",
                dest="no_runs",
                action="store_true",
                help="do not verify the representatives by runs",
            )
    return top


def redo_of(words):
    try:
        return [w if w in ("failed", "baseline") else int(w) for w in words]
    except ValueError:
        raise StudyError(
            f"-redo {' '.join(words)}: give numbers of designs,"
            " failed, or baseline"
        ) from None


def main():
    options = vars(parser().parse_args())
    verb = options.pop("verb")
    if verb == "run":
        options["redo"] = redo_of(options["redo"])
    # Late, so that what one verb needs does not slow the others
    from .study_file import StudyFile

    study = StudyFile(options.pop("study"))
    name = {"run": "sweep"}.get(verb, verb)
    module = importlib.import_module("." + name, __package__)
    found = getattr(module, verb)(study, **options)
    # The others return what they made
    return found if verb in RUNNING else 0


def command():
    """The same with errors as a line for the user; the exit status."""
    try:
        return main()
    except StudyError as error:
        print(f"Error: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(command())
