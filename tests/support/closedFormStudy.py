# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The study file of a study whose solver is closed-form arithmetic."""

STUDY = """
template: case
parametersFile: parameters
parameters:
  x: {bounds: [0, 1], baseline: 0.5}
  y: {bounds: [0, 1], baseline: 0.5}
sampling: {method: latinHypercube, designs: 4}
baseline:
  steps: {solve: bash solver.sh}
strategies:
  morph:
    steps: {solve: bash solver.sh}
  near:
    start: nearest
    steps: {solve: bash solver.sh}
  remesh:
    start: template
    steps: {solve: bash solver.sh}
responses:
  f: {file: log.solve, regex: 'f = (\\S+)'}
  g: {file: log.solve, regex: 'g = (\\S+)'}
optimise:
  objectives: {f: minimise, g: minimise}
  population: 40
  generations: 20
"""
