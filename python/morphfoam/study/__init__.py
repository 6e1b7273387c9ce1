# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Sweeps of shapes, each morphed from one baseline and started from its fields.

The command is bin/morphStudy; morphfoam.Study is the same from Python.
README.md beside this file has every key of the study file. One module per
concern:

    api           the study from Python
    expressions   what constraints and derived quantities may say
    section       mappings of a file, with the keys they may have
    study_file    reads the study file and says what is wrong with it;
                  response_section, descend_section parts of it
    sampling      factorial, Latin hypercube, Sobol, under constraints
    designs       the table of designs, which only grows
    case_folder   a design's case, from the template or the baseline
    foam_entry    a number in a dictionary file
    process       a command with a log, a timeout, and an end
    responses     numbers from what a run leaves behind
    outcomes      what became of a design, written last and at once
    worker        one design from folder to outcome
    sweep         all of them, by Snakemake
    results       outcomes as one table
    metamodel     kriging and its leave-one-out error
    pareto        NSGA-II and the clusters of its front
    plots         pictures of all this
    geometry      responses that need no flow
    slopes        derivatives by the chain rule
    shape_problem what the optimiser asks of a study
    check, sample, status, fit, optimise, descend, importance, report: the verbs
"""
