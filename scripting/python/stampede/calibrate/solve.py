"""Nonlinear least squares: Levenberg and Marquardt, robust by Huber's weights, with what its answer is worth."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

_HUBER = 1.345  # of the noise; 95 % as good as least squares where there are no outliers
_ROUNDS = 100


@dataclass
class Answer:
    values: Array
    deviations: Array  # standard, of values
    residuals: Array
    rounds: int
    noise: float  # standard deviation of the residuals, robust


def least_squares(
    residuals: Callable[[Array], Array],
    start: Array,
    steps: Array,
    prior: Array,
    groups: Array,
) -> Answer:
    """Minimises the squares of `residuals`, and of (values - start) / prior.

    steps: for differences, by value. prior: standard deviation of each value about `start`, inf for none; 0 keeps it
    as it is. groups: for each two residuals (a point's x and y), the picture they are of. Errors within a picture go
    together: the deviations are those of the sandwich estimator over pictures (White, 1980, doi:10.2307/1912934), so
    they hold where a picture as a whole is off.
    """
    free = np.flatnonzero(prior > 0)
    values = start.astype(float).copy()
    weight = np.where(np.isfinite(prior[free]), 1 / np.where(prior[free] > 0, prior[free], 1), 0.0)
    damping, now = 1e-3, residuals(values)
    rounds = 0
    while rounds < _ROUNDS:
        rounds += 1
        noise, huber = _weights(now)
        jacobian = _jacobian(residuals, values, now, steps, free)
        scaled, pull = jacobian * huber[:, None], now * huber
        beside = (values - start)[free] * weight * noise
        normal = scaled.T @ scaled + np.diag((weight * noise) ** 2)
        slope = scaled.T @ pull + weight * noise * beside
        cost = pull @ pull + beside @ beside
        better = False
        for _ in range(12):
            change = -np.linalg.solve(normal + damping * np.diag(np.diag(normal) + 1e-12), slope)
            tried = values.copy()
            tried[free] += change
            then = residuals(tried)
            off = (tried - start)[free] * weight * noise
            new_cost = (then * huber) @ (then * huber) + off @ off
            if np.isfinite(new_cost) and new_cost <= cost:
                better = True
                break
            damping *= 10
        if not better:
            break
        values, now, damping = tried, then, max(damping / 10, 1e-9)
        if (np.abs(change) < 1e-3 * steps[free]).all() or cost - new_cost < 1e-9 * cost:
            break
    noise, huber = _weights(now)
    jacobian = _jacobian(residuals, values, now, steps, free) * huber[:, None]
    deviations = np.zeros(len(values))
    deviations[free] = _deviations(jacobian, now * huber, weight * noise, noise, groups)
    return Answer(values, deviations, now, rounds, noise)


def _weights(residuals: Array) -> tuple[float, Array]:
    """The noise, and the root of the weight of each residual; those of one point go together."""
    size = np.linalg.norm(residuals.reshape(-1, 2), axis=1)
    noise = float(np.median(size) / 1.1774) or 1e-12  # of a Rayleigh distribution
    share = np.minimum(1.0, _HUBER * 1.5 * noise / np.maximum(size, 1e-12))
    return noise, np.repeat(np.sqrt(share), 2)


def _jacobian(residuals: Callable[[Array], Array], values: Array, now: Array, steps: Array, free: Array) -> Array:
    columns = []
    for one in free:
        beside = values.copy()
        beside[one] += steps[one]
        columns.append((residuals(beside) - now) / steps[one])
    return np.stack(columns, axis=1)


def _deviations(jacobian: Array, residuals: Array, prior: Array, noise: float, groups: Array) -> Array:
    bread = np.linalg.pinv(jacobian.T @ jacobian + np.diag(prior**2))
    scores = (jacobian * residuals[:, None]).reshape(len(groups), 2, -1).sum(axis=1)
    numbers = np.unique(groups, return_inverse=True)[1]
    summed = np.zeros((numbers.max() + 1, jacobian.shape[1]))
    np.add.at(summed, numbers, scores)
    count = len(summed)
    used = int(jacobian.shape[1])
    meat = summed.T @ summed * (count / max(1, count - used / 2)) + np.diag(prior**2) * noise**2
    return np.sqrt(np.maximum(np.diag(bread @ meat @ bread), 0))
