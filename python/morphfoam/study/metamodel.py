# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Kriging of one response, and how well it predicts designs it has not seen.

Gaussian process of constant mean, y = m + Z(x) + e, with the anisotropic Matern
covariance of smoothness 5/2 and a noise term; variance, one length per parameter
and the noise maximise the likelihood (Rasmussen and Williams 2006, Gaussian
Processes for Machine Learning, chapters 2, 4.2 and 5.4; Simpson et al. 2001, Eng.
with Computers 17, 129-150, doi 10.1007/PL00007198). Parameters are in units of
their bounds.

Leave-one-out: each design is predicted by the model without it, its covariance
kept; Q2 = 1 - sum (y_i - prediction_i)^2 / sum (y_i - mean)^2.
"""

import warnings
from dataclasses import dataclass

import numpy as np

from .errors import StudyError

LENGTHS = (0.05, 50)
NOISE = (1e-8, 1)
RESTARTS = 4


@dataclass
class Model:
    """A fitted response with its leave-one-out predictions."""

    name: str
    study: object
    x: np.ndarray  # designs in units of the bounds
    y: np.ndarray
    process: object
    predicted: np.ndarray  # leave-one-out
    deviation: np.ndarray
    numbers: list  # of the designs

    def __call__(self, points):
        """Mean at rows of points in the parameters' units."""
        return self.process.predict(unit(self.study, points))

    def with_deviation(self, points):
        return self.process.predict(unit(self.study, points), return_std=True)

    def without(self, number, point):
        """Mean and standard deviation at a design, by the model without it
        where it is one of those that were fitted."""
        if number in self.numbers:
            i = self.numbers.index(number)
            return float(self.predicted[i]), float(self.deviation[i])
        mean, deviation = self.with_deviation(point)
        return float(mean[0]), float(deviation[0])

    @property
    def errors(self):
        return self.predicted - self.y

    @property
    def q2(self):
        spread = np.sum((self.y - self.y.mean()) ** 2)
        return 1 - np.sum(self.errors**2) / spread if spread > 0 else 1.0

    @property
    def lengths(self):
        """Correlation length of each parameter, in units of its bounds."""
        return np.broadcast_to(
            self.process.kernel_.k1.k2.length_scale, self.x.shape[1]
        )

    @property
    def noise(self):
        """Standard deviation of the noise, in the response's units."""
        return np.sqrt(self.process.kernel_.k2.noise_level) * self.y.std()


def unit(study, points):
    return (np.asarray(points) - study.lows) / (study.highs - study.lows)


def fit(study, name, points, values, numbers=()):
    """The model of one response from designs (rows) and its values there."""
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import (
        ConstantKernel,
        Matern,
        WhiteKernel,
    )

    x, y = unit(study, points), np.asarray(values, dtype=float)
    d = x.shape[1]
    if len(y) < d + 2:
        raise StudyError(
            f"{len(y)} finished designs are too few for a model of {name} with"
            f" {d} parameters: at least {d + 2}, better ten per parameter"
        )
    kernel = ConstantKernel(1.0, (1e-3, 1e4)) * Matern(
        np.full(d, 0.5), LENGTHS, nu=2.5
    ) + WhiteKernel(1e-4, NOISE)
    with warnings.catch_warnings():
        # Lengths at a bound: a parameter without influence
        warnings.simplefilter("ignore")
        process = GaussianProcessRegressor(
            kernel,
            normalize_y=True,
            n_restarts_optimizer=RESTARTS,
            random_state=0,
        ).fit(x, y)
        predicted, deviation = leave_one_out(process.kernel_, x, y)
    return Model(
        name, study, x, y, process, predicted, deviation, list(numbers)
    )


def leave_one_out(kernel, x, y):
    """Mean and standard deviation of each design from all others."""
    from sklearn.gaussian_process import GaussianProcessRegressor

    predictions = []
    for i in range(len(y)):
        others = np.arange(len(y)) != i
        without = GaussianProcessRegressor(
            kernel, normalize_y=True, optimizer=None
        ).fit(x[others], y[others])
        predictions.append(without.predict(x[i : i + 1], return_std=True))
    mean, deviation = np.array(predictions)[:, :, 0].T
    return mean, deviation
