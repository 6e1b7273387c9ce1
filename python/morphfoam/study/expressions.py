# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Arithmetic of the study file, evaluated without eval.

    Expression("0.9*e + 0.35")({"e": 0.6})          # 0.89
    Condition("0 <= E - e <= 1").violation(values)  # 0 where it holds

Values may be numbers or arrays. baseline.x is the value of x at the baseline.
"""

import ast
import operator

import numpy as np

from .errors import StudyError

OPERATORS = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: np.true_divide,
    ast.Pow: np.power,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}
FUNCTIONS = {
    "abs": np.abs,
    "sqrt": np.sqrt,
    "exp": np.exp,
    "log": np.log,
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": np.arctan,
    "radians": np.radians,
    "degrees": np.degrees,
    "min": lambda *v: np.minimum.reduce(np.broadcast_arrays(*v)),
    "max": lambda *v: np.maximum.reduce(np.broadcast_arrays(*v)),
}
CONSTANTS = {"pi": np.pi}
RESERVED = {*FUNCTIONS, *CONSTANTS, "baseline", "and", "or", "not"}

# What rounding may cost a comparison, in parts of its two sides
ROUNDING = 1e-10


def parse(text, where):
    try:
        return ast.parse(str(text), mode="eval").body
    except SyntaxError as error:
        raise StudyError(
            f"{where}: '{text}' is no expression ({error.msg}). Write numbers,"
            " names and + - * / ** ( )"
        ) from None


class Expression:
    """A number computed from named values."""

    def __init__(self, text, where="expression", node=None):
        self.text, self.where = str(text), where
        self.node = parse(text, where) if node is None else node
        self.names, self.baseline_names = set(), set()
        self._inspect(self.node)

    def _refuse(self, node, why):
        raise StudyError(
            f"{self.where}: '{ast.unparse(node)}' in '{self.text}' {why}."
            " Allowed are numbers, names, + - * / **, and "
            + " ".join(sorted(FUNCTIONS))
            + " pi"
        )

    def _inspect(self, node):
        """Collect the names; refuse whatever is not arithmetic."""
        if isinstance(node, ast.Constant):
            if type(node.value) not in (int, float):
                self._refuse(node, "is no number")
        elif isinstance(node, ast.Name):
            if node.id not in CONSTANTS:
                self.names.add(node.id)
        elif isinstance(node, ast.Attribute):
            if not (
                isinstance(node.value, ast.Name)
                and node.value.id == "baseline"
            ):
                self._refuse(node, "is not baseline.NAME")
            self.baseline_names.add(node.attr)
        elif isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
            self._inspect(node.left)
            self._inspect(node.right)
        elif isinstance(node, ast.UnaryOp) and type(node.op) in OPERATORS:
            self._inspect(node.operand)
        elif isinstance(node, ast.Call):
            if (
                not (
                    isinstance(node.func, ast.Name)
                    and node.func.id in FUNCTIONS
                )
                or node.keywords
            ):
                self._refuse(node, "is no known function")
            several = node.func.id in ("min", "max")
            if not node.args or (len(node.args) > 1 and not several):
                self._refuse(node, "has the wrong number of arguments")
            for argument in node.args:
                self._inspect(argument)
        else:
            self._refuse(node, "is not allowed")

    def check(self, known):
        """Stop unless all names are known."""
        unknown = (self.names | self.baseline_names) - set(known)
        if unknown:
            raise StudyError(
                f"{self.where}: '{self.text}' uses {', '.join(sorted(unknown))}"
                ", which stands nowhere before it. Known here: "
                + (", ".join(known) or "nothing")
            )

    def __call__(self, values, baseline=None):
        with np.errstate(all="ignore"):
            return self._value(self.node, values, baseline)

    def _value(self, node, values, baseline):
        if isinstance(node, ast.Constant):
            return float(node.value)
        if isinstance(node, ast.Name):
            return CONSTANTS.get(node.id, values.get(node.id))
        if isinstance(node, ast.Attribute):
            return baseline[node.attr]
        if isinstance(node, ast.BinOp):
            return OPERATORS[type(node.op)](
                self._value(node.left, values, baseline),
                self._value(node.right, values, baseline),
            )
        if isinstance(node, ast.UnaryOp):
            return OPERATORS[type(node.op)](
                self._value(node.operand, values, baseline)
            )
        return FUNCTIONS[node.func.id](
            *(self._value(a, values, baseline) for a in node.args)
        )


class Condition:
    """A comparison of expressions, or several with and, or, not."""

    def __init__(self, text, where="constraint", equalities=False):
        self.text, self.where = str(text), where
        self.leaves, self.equalities = [], equalities
        self.root = self._build(parse(text, where))

    @property
    def names(self):
        return set().union(*(leaf.names for leaf in self.leaves))

    def check(self, known):
        for leaf in self.leaves:
            leaf.check(known)

    def _leaf(self, node):
        leaf = Expression(self.text, self.where, node)
        self.leaves.append(leaf)
        return leaf

    def _build(self, node, negate=False):
        """Nested tuples ('all'|'any', parts) and (side, side): left <= right,
        or ('equal', side, side)."""
        if isinstance(node, ast.BoolOp):
            every = isinstance(node.op, ast.And) != negate
            return (
                "all" if every else "any",
                [self._build(v, negate) for v in node.values],
            )
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
            return self._build(node.operand, not negate)
        if not isinstance(node, ast.Compare):
            raise StudyError(
                f"{self.where}: '{self.text}' compares nothing. Write for"
                " example 'a <= 2*b'"
            )
        sides = [self._leaf(n) for n in [node.left, *node.comparators]]
        parts = []
        for left, comparison, right in zip(sides, node.ops, sides[1:]):
            if isinstance(comparison, (ast.LtE, ast.Lt)) != negate:
                parts.append((left, right))
            elif isinstance(comparison, (ast.GtE, ast.Gt, ast.LtE, ast.Lt)):
                parts.append((right, left))
            elif (
                isinstance(comparison, ast.Eq)
                and self.equalities
                and not negate
            ):
                parts.append(("equal", left, right))
            else:
                raise StudyError(
                    f"{self.where}: '{self.text}' compares by something other"
                    " than < <= > >=. An equality leaves no room for designs:"
                    " make one of the two a derived quantity"
                )
        return ("any" if negate else "all", parts)

    def sides(self):
        """[(left, right, whether they must be equal)], of which all must hold:
        left <= right. Stops where it has alternatives."""
        found, waiting = [], [self.root]
        while waiting:
            node = waiting.pop(0)
            if node[0] == "any" and len(node[1]) > 1:
                raise StudyError(
                    f"{self.where}: '{self.text}' has alternatives, between"
                    " which a descent cannot choose. Make a study of each"
                )
            if node[0] in ("all", "any"):
                waiting = [*node[1], *waiting]
            else:
                found.append((*node[-2:], node[0] == "equal"))
        return found

    def violation(self, values, baseline=None):
        """By how much it is missed; 0 where it holds."""
        return self._violation(self.root, values, baseline)

    def _violation(self, node, values, baseline):
        if node[0] in ("all", "any"):
            parts = [self._violation(n, values, baseline) for n in node[1]]
            return (np.add if node[0] == "all" else np.minimum).reduce(
                np.broadcast_arrays(*parts)
            )
        left, right = (side(values, baseline) for side in node[-2:])
        missed = np.nan_to_num(left - right, nan=np.inf)
        if node[0] == "equal":
            missed = np.abs(missed)
        return np.where(
            missed > ROUNDING * (np.abs(left) + np.abs(right)), missed, 0.0
        )
