# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Which parameters matter, where that is known in closed form."""

import numpy as np
import pytest

from morphfoam.optimisation import influence


def ishigami(x):
    return (
        np.sin(x[:, 0])
        + 7 * np.sin(x[:, 1]) ** 2
        + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])
    )


def test_indices_of_ishigamis_function():
    """Ishigami and Homma (1990); its variances are integrals: V1 = (1 + b
    pi^4/5)^2/2, V2 = a^2/8, V13 = 8 b^2 pi^8/225."""
    a, b, pi = 7, 0.1, np.pi
    v1, v2, v13 = (
        (1 + b * pi**4 / 5) ** 2 / 2,
        a**2 / 8,
        8 * b**2 * pi**8 / 225,
    )
    v = v1 + v2 + v13
    first, total = influence.total_indices(
        ishigami, np.full(3, -pi), np.full(3, pi), 2**13
    )
    assert first == pytest.approx([v1 / v, v2 / v, 0], abs=0.01)
    assert total == pytest.approx([(v1 + v13) / v, v2 / v, v13 / v], abs=0.01)


def test_indices_agree_with_openturns():
    """The peer is OpenTURNS' Sobol' sensitivity analysis, where it is
    installed (python3-openturns)."""
    ot = pytest.importorskip("openturns")
    law = ot.ComposedDistribution([ot.Uniform(-np.pi, np.pi)] * 3)
    size = 4096
    design = ot.SobolIndicesExperiment(law, size).generate()
    answers = ot.Sample(ishigami(np.array(design))[:, None].tolist())
    peer = ot.JansenSensitivityAlgorithm(design, answers, size)
    total = influence.total_indices(
        ishigami, np.full(3, -np.pi), np.full(3, np.pi)
    )[1]
    assert total == pytest.approx(list(peer.getTotalOrderIndices()), abs=0.05)


def test_what_does_not_vary_has_no_indices():
    first, total = influence.total_indices(
        lambda x: np.ones(len(x)), np.zeros(2), np.ones(2), 64
    )
    assert not first.any() and not total.any()


def test_a_ridge_has_one_active_direction():
    """f = (w.x)^2: every gradient is a multiple of w."""
    w = np.array([3, 0, 4]) / 5
    x = np.random.default_rng(1).normal(size=(50, 3))
    gradients = 2 * (x @ w)[:, None] * w
    values, vectors, activity = influence.active_subspace(gradients)
    assert values[1] < 1e-12 * values[0]
    assert abs(vectors[:, 0] @ w) == pytest.approx(1)
    assert activity == pytest.approx(values[0] * w**2)


def test_contributions_add_up_to_the_change():
    """Of x^2 y along a bent path, with the trapezoidal rule's error of 1/n^2."""
    t = np.linspace(0, 1, 400)[:, None]
    path = np.hstack([1 + t, 2 * t**2])
    gradients = np.stack(
        [2 * path[:, 0] * path[:, 1], path[:, 0] ** 2], axis=1
    )
    given = influence.contributions(path, gradients)
    assert given.sum() == pytest.approx(8, rel=1e-5)
    # By x: the integral of 2 (1 + t) 2 t^2 dt
    assert given[0] == pytest.approx(4 * (1 / 3 + 1 / 4), rel=1e-5)
