"""Noise on what a robot observes: models that are called with an array."""

from abc import ABC, abstractmethod

import numpy as np


class NoiseModel(ABC):
    """A noise model. Draws come from numpy's global generator, so `np.random.seed` makes them repeatable."""

    @abstractmethod
    def apply(self, val: np.ndarray) -> np.ndarray:
        """Returns `val`, an array of floats, with noise; `val` itself stays as it is."""


class Identity(NoiseModel):
    """No noise."""

    def apply(self, val: np.ndarray) -> np.ndarray:
        return val


class GaussianNoise(NoiseModel):
    """
    Adds independent normal noise of mean 0.

    variance: the **standard deviation**, in the unit of what it is applied to; RLBench has it under this name.
    min_max_clip: bounds of the result; None: none.
    """

    def __init__(self, variance: float, min_max_clip: tuple[float, float] | None = None) -> None:
        self._deviation = variance
        self._min_max_clip = min_max_clip

    def apply(self, val: np.ndarray) -> np.ndarray:
        noisy = val + np.random.normal(0.0, self._deviation, np.shape(val)).astype(np.asarray(val).dtype)
        return noisy if self._min_max_clip is None else np.clip(noisy, *self._min_max_clip)
