"""One task of an environment: reset, step, demos."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from stampede._core import Error
from stampede.rlbench.action_modes.action_mode import ActionMode
from stampede.rlbench.backend.exceptions import DemoError, InvalidActionError
from stampede.rlbench.backend.observation import Observation
from stampede.rlbench.backend.recorded import STOP_AT_VIAS, columns, demo_observations
from stampede.rlbench.backend.scene import Scene, Start
from stampede.rlbench.demo import Demo, Demos
from stampede.rlbench.observation_config import ObservationConfig
from stampede.rlbench.utils import check_dataset_root, stored_demos

if TYPE_CHECKING:
    from stampede.rlbench.environment import Environment

__all__ = ["InvalidActionError", "TaskEnvironment"]

_MOST_STARTS = 40  # that are tried for one reset
_TRAIN_SEEDS = 1_000_000  # those from here on are the test split's


class TaskEnvironment:
    """A task to act in; made by `Environment.get_task`. Used by one thread."""

    def __init__(
        self,
        environment: Environment,
        task: str,
        action_mode: ActionMode,
        obs_config: ObservationConfig,
        dataset_root: str,
        static_positions: bool = False,
        shaped_rewards: bool = False,
        randomise: bool = False,
    ) -> None:
        self._environment = environment
        self._task = task
        self._action_mode = action_mode
        self._config = obs_config
        self._dataset_root = dataset_root
        self._static_positions = static_positions
        self._randomise = randomise
        self._variations: list[str] = environment.session.variations(task)
        self._variation = 0
        self._was_reset = False
        self._scene = Scene(environment.session, task, obs_config, shaped_rewards, action_mode.channels)

    def get_name(self) -> str:
        """`reach_target`"""
        return self._task

    def variation_count(self) -> int:
        return len(self._variations)

    def set_variation(self, v: int) -> None:
        """From the next reset on. v: place in the task's order. Raises `stampede.Error` where there is none."""
        if not 0 <= v < len(self._variations):
            raise Error(f"{self._task} has no variation {v}\n    they go from 0 to {len(self._variations) - 1}")
        self._variation = int(v)

    def sample_variation(self) -> int:
        """Sets one at random, and gives its place."""
        self._variation = int(np.random.randint(len(self._variations)))
        return self._variation

    def reset(self, demo: Demo | None = None) -> tuple[list[str], Observation]:
        """
        A start of the variation that is set, or of `demo`: the task in sentences, and what is observed first.

        Draws come from numpy's global generator, so `np.random.seed` makes them repeatable.
        """
        if demo is not None:
            return self.reset_to_demo(demo)
        for attempt in range(_MOST_STARTS):
            try:
                return self._begin(self._draw_start(attempt), self._variation)
            except Error:
                if attempt == _MOST_STARTS - 1:
                    raise
        raise AssertionError("unreachable: the last attempt raises or returns")

    def reset_to_demo(self, demo: Demo) -> tuple[list[str], Observation]:
        """
        The start of a demo, bit for bit, and numpy's global generator as it was then.

        Raises `stampede.Error` for a demo that another simulator, or another task, made.
        """
        if demo.__dict__.get("seed") is None:
            raise Error("the demo has no seed: it was not made by this engine\n    act from `reset()` instead")
        if demo.variation not in self._variations:
            raise Error(f"{self._task} has no variation '{demo.variation}'\n    the demo is of another task")
        if demo.random_seed is not None:
            demo.restore_state()
        self._variation = self._variations.index(demo.variation)
        return self._begin(Start(demo.variation, demo.seed, demo.randomise), self._variation)

    def step(self, action: np.ndarray) -> tuple[Observation, float, bool]:
        """
        One action: (observation, reward, whether the episode is over).

        Reward is 1.0 at success and else 0.0, or shaped. A step after the end changes nothing and gives the last
        answer again. Raises InvalidActionError for what cannot be done, and nothing has changed then.
        """
        if not self._was_reset:
            raise Error("there is no start yet\n    call reset() before step()")
        self._action_mode.action(self._scene, action)
        self._scene.wait_for_verdict()
        return self._scene.observation(), self._scene.reward, self._scene.over

    def get_observation(self) -> Observation:
        """Of the present frame."""
        if not self._was_reset:
            raise Error("there is no start yet\n    call reset() before get_observation()")
        return self._scene.observation()

    def get_demos(
        self,
        amount: int,
        live_demos: bool = False,
        image_paths: bool = False,
        callable_each_step: Callable[[Observation], None] | None = None,
        max_attempts: int = 10,
        random_selection: bool = True,
        from_episode_number: int = 0,
        stop_at_vias: bool = False,
    ) -> list[Demo]:
        """
        Demos of the variation that is set: made now by the planner, or stored in the environment's `dataset_root`.

        amount: of stored ones -1 is all. image_paths: pictures of stored ones are paths of files. callable_each_step:
        gets each observation of a live demo. max_attempts: starts that are drawn for one live demo. random_selection:
        which stored ones; else those from `from_episode_number` on. stop_at_vias: in live demos the arm stands at each
        via-point and where its way bends, and they end without the wait for the verdict: rules that find keyframes by
        stops then find all that is needed to do the task. Raises DemoError where that is not to be had.
        """
        if live_demos:
            if amount < 1:
                raise Error(f"{amount} live demos cannot be made\n    ask for at least one")
            return Demos(self._live_demo(callable_each_step, max_attempts, stop_at_vias) for _ in range(amount))
        return stored_demos(
            check_dataset_root(self._dataset_root),
            self._task,
            self._variation,
            self._variations,
            self._config,
            amount,
            image_paths,
            random_selection,
            from_episode_number,
        )

    def _live_demo(
        self, callable_each_step: Callable[[Observation], None] | None, max_attempts: int, stop_at_vias: bool
    ) -> Demo:
        session = self._environment.session
        before = np.random.get_state()
        reason = ""
        for attempt in range(max_attempts):
            start = self._draw_start(attempt)
            try:
                episode = session.run(
                    self._task,
                    variation=start.variation,
                    seed=start.seed,
                    randomise=start.randomise,
                    set=[STOP_AT_VIAS] if stop_at_vias else [],
                )
            except Error as error:
                reason = str(error)
                continue
            if not episode.success:
                reason = f"{episode.reason} {episode.detail}".strip()
                continue
            arrays = session.arrays(episode, columns(self._config.cameras_on))
            observations = []
            draw = partial(session.picture, episode)
            for seen in demo_observations(self._config, arrays, draw, self._variation, stop_at_vias):
                observations.append(seen)
                if callable_each_step is not None:
                    callable_each_step(seen)
            return Demo(observations, before, attempt + 1, start.variation, start.seed, start.randomise)
        raise DemoError(
            f"no demo of {self._task} '{self._variations[self._variation]}' in {max_attempts} attempts: {reason}\n"
            "    raise max_attempts, or look at the failures with `stampede run`"
        )

    def _draw_start(self, attempt: int) -> Start:
        seed = attempt if self._static_positions else int(np.random.randint(_TRAIN_SEEDS))
        return Start(self._variations[self._variation], seed, self._randomise)

    def _begin(self, start: Start, variation_index: int) -> tuple[list[str], Observation]:
        self._scene.reset(start, variation_index)
        self._was_reset = True
        sentences = self._environment.descriptions.of(self._task, start.variation, start.seed)
        return sentences, self._scene.observation()
