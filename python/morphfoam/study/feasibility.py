# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""How likely a design is to succeed: mesh, run and limits of responses.

Gaussian process classification with the covariance of the metamodels (Matern,
smoothness 5/2, a length per parameter), the latent function by Laplace's
approximation (Rasmussen and Williams 2006, Gaussian Processes for Machine
Learning, section 3.4). What it learns from is whether each design that was run
is done; why it failed makes no difference.
"""

import warnings
from dataclasses import dataclass

import numpy as np

from . import designs, metamodel, outcomes

# A likelihood that grows as the sides become certain has no optimum
VARIANCE = (1e-2, 1e3)
RESTARTS = 2


@dataclass
class Feasibility:
    """Probability that a design succeeds, over the parameters."""

    study: object
    x: np.ndarray  # designs in units of the bounds
    done: np.ndarray
    process: object  # None: all designs are alike
    predicted: np.ndarray  # of each design, by the model without it
    numbers: list  # of the designs

    def __call__(self, points):
        if self.process is None:
            return np.full(len(points), float(self.done.all()))
        x = metamodel.unit(self.study, points)
        return self.process.predict_proba(x)[:, 1]

    @property
    def right(self):
        """How many designs are told right by the model without them."""
        return int(np.sum((self.predicted >= 0.5) == self.done))

    def __str__(self):
        if self.process is None:
            return f"feasibility: all {len(self.done)} designs succeeded"
        return (
            f"feasibility: {self.done.sum()} of {len(self.done)} designs"
            f" succeeded; {self.right} are told right by the model without"
            " them"
        )


def fit(study, strategy):
    """The model of all designs that were run, in this strategy."""
    pairs = [
        (d, outcomes.read(study, strategy, d.number))
        for d in designs.read(study)
    ]
    pairs = [(d, outcome) for d, outcome in pairs if outcome]
    x = metamodel.unit(study, designs.points(study, [d for d, _ in pairs]))
    done = np.array([outcome.done for _, outcome in pairs], dtype=bool)
    numbers = [d.number for d, _ in pairs]
    if done.all() or not done.any():
        return Feasibility(study, x, done, None, done * 1.0, numbers)
    process = classifier(x, done)
    return Feasibility(
        study, x, done, process, leave_one_out(process, x, done), numbers
    )


def classifier(x, done, kernel=None):
    """Of designs in units of the bounds; with a kernel: that one, as it is."""
    from sklearn.gaussian_process import GaussianProcessClassifier
    from sklearn.gaussian_process.kernels import ConstantKernel, Matern

    own = kernel or ConstantKernel(10.0, VARIANCE) * Matern(
        np.full(x.shape[1], 0.5), metamodel.LENGTHS, nu=2.5
    )
    options = (
        {"optimizer": None} if kernel else {"n_restarts_optimizer": RESTARTS}
    )
    with warnings.catch_warnings():
        # Lengths at a bound: a parameter without influence
        warnings.simplefilter("ignore")
        return GaussianProcessClassifier(own, random_state=0, **options).fit(
            x, done
        )


def leave_one_out(process, x, done):
    """The probability of each design from all others."""
    found = []
    for i in range(len(x)):
        others = np.arange(len(x)) != i
        if done[others].all() or not done[others].any():
            found.append(float(done[others].all()))
            continue
        without = classifier(x[others], done[others], process.kernel_)
        found.append(float(without.predict_proba(x[i : i + 1])[0, 1]))
    return np.array(found)
