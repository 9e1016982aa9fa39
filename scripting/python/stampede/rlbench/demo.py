"""A demonstration: a list of observations."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from stampede._core import Error
from stampede.rlbench.backend.observation import Observation

_MT19937_WORDS = 624


class Demo:
    """
    What was observed while a task was shown.

    random_seed: state of numpy's global generator before the start was drawn (`np.random.get_state()`).
    num_reset_attempts: starts that were drawn until one led to success.
    variation: the variation's canonical text; seed: what all draws of the episode derive from; randomise: whether looks
    and dynamics were drawn too. From these three `reset_to_demo` makes the start again, bit for bit; seed is None in a
    demo that another simulator made. variation_number: the variation's place in the task's order, PerAct's field.
    """

    def __init__(
        self,
        observations: list[Observation],
        random_seed: tuple | None = None,
        num_reset_attempts: int | None = None,
        variation: str = "",
        seed: int | None = None,
        randomise: bool = False,
    ) -> None:
        self._observations = observations  # this name is part of the format of low_dim_obs.pkl
        self.random_seed = random_seed
        self.num_reset_attempts = num_reset_attempts
        self.variation = variation
        self.seed = seed
        self.randomise = randomise
        self.variation_number = 0

    def __len__(self) -> int:
        return len(self._observations)

    def __getitem__(self, index):
        return self._observations[index]

    def __iter__(self) -> Iterator[Observation]:
        return iter(self._observations)

    def restore_state(self) -> None:
        """
        Sets numpy's global generator to where it was before this demo. Raises Error where that was not kept, or is none:
        numpy itself does not look.
        """
        if self.random_seed is None:
            raise Error("the demo does not say where numpy's generator was\n    `reset_to_demo` needs its seed alone")
        if not _is_generator_state(self.random_seed):
            raise Error("`random_seed` is no state of numpy's generator\n    `reset_to_demo` needs its seed alone")
        np.random.set_state(self.random_seed)


class Demos(list[Demo]):
    """
    What `get_demos` gives. `np.array` of it has one entry a demo, as programs written for RLBench expect: demos are of
    different lengths, and there is no array of all their observations.
    """

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        demos = np.empty(len(self), dtype=object)
        for place, demo in enumerate(self):
            demos[place] = demo
        return demos


def _is_generator_state(state: Any) -> bool:
    """Whether it is one of a Mersenne Twister, as `np.random.get_state()` gives it."""
    if not isinstance(state, tuple) or len(state) != 5 or state[0] != "MT19937":
        return False
    _, key, place, has_spare, spare = state
    return (
        isinstance(key, np.ndarray)
        and (key.shape, key.dtype) == ((_MT19937_WORDS,), np.uint32)
        and isinstance(place, int)
        and 0 <= place <= _MT19937_WORDS
        and has_spare in (0, 1)
        and isinstance(spare, float)
    )
