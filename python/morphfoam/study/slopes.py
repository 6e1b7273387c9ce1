# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Derivatives by the parameters of whatever an expression is made of: by the
chain rule from tables of derivatives of responses, where there are such."""

import numpy as np

# Of central differences within an expression: its arithmetic is exact to 1e-16
STEP = 1e-5


class Slopes:
    """At one point.

    values     of parameters, derived quantities and responses
    tables     {response: {parameter or derived quantity: derivative}}
    baseline   what baseline.x means
    """

    def __init__(self, study, values, tables, baseline):
        self.study, self.tables = study, tables
        self.values, self.baseline = values, baseline
        self.derived = {d.name: d.expression for d in study.derived}
        self.known = {}

    def of(self, name):
        """By each parameter, or None where only differences can tell."""
        if name not in self.known:
            self.known[name] = self._of(name)
        return self.known[name]

    def _of(self, name):
        names = self.study.names
        if name in names:
            return np.eye(len(names))[names.index(name)]
        if name in self.derived:
            return self.of_expression(self.derived[name])
        if name in self.tables:
            # Of rows that have the name of no parameter nothing depends
            rows = [
                (row, derivative)
                for row, derivative in self.tables[name].items()
                if row in self.study.baseline_values
            ]
            return sum(
                (d * self.of(row) for row, d in rows), np.zeros(len(names))
            )
        expression = self.study.responses[name].expression
        return self.of_expression(expression) if expression else None

    def of_expression(self, expression):
        total = np.zeros(len(self.study.names))
        for name in sorted(expression.names):
            slope = self.of(name)
            if slope is None:
                return None
            total = total + self.partial(expression, name) * slope
        return total

    def partial(self, expression, name):
        """By one of its names."""
        at = float(self.values[name])
        step = STEP * max(abs(at), 1e-3)
        ends = [
            float(expression({**self.values, name: v}, self.baseline))
            for v in (at + step, at - step)
        ]
        return (ends[0] - ends[1]) / ((at + step) - (at - step))
