"""Many environments of one task at once, each in a thread of the engine's."""

import os
import threading
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode
from gymnasium.vector import VectorEnv as GymnasiumVectorEnv
from gymnasium.vector.utils import batch_space

from stampede import _core

from .account import EpisodeAccount
from .alone import alone
from .base import Settings, made_again, shown_arguments, spaces_shown
from .env import OBSERVATIONS
from stampede.faults import fault, unknown
from .sessions import shared_session
from .spaces import ActionCodec, Observation, ObservationCodec
from .starts import Start, Starts

VectorResult = tuple[Observation, np.ndarray, np.ndarray, np.ndarray, dict[str, Any]]


class VectorEnv(GymnasiumVectorEnv[Observation, np.ndarray, np.ndarray]):
    """Environments of one task that act at once, in threads, without the GIL.

    Each gives what an Env of the same settings and seed gives, bit for bit.

    Arguments (the others are Env's):
        num_envs: how many. threads: None: as many as there are cores for this process, and environments.
        autoreset_mode: NEXT_STEP, SAME_STEP or DISABLED of gymnasium.vector.AutoresetMode, or its value as text. With
            DISABLED, an environment that has ended refuses further actions until `reset(options={"reset_mask": …})`.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 20}

    def __init__(
        self,
        task: str,
        num_envs: int = 1,
        *,
        threads: int | None = None,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        action: str = "joint_delta",
        observations: Sequence[str] = OBSERVATIONS,
        gripper: bool = True,
        normalise_actions: bool = False,
        **settings: Any,
    ) -> None:
        super().__init__()
        self.closed = True  # until all is made
        self._use = threading.RLock()
        self._arguments = {
            "num_envs": num_envs,
            "threads": threads,
            "autoreset_mode": autoreset_mode,
            "action": action,
            "observations": observations,
            "gripper": gripper,
            "normalise_actions": normalise_actions,
            **settings,
        }
        if num_envs < 1:
            raise fault("num_envs=", f"{num_envs} environments", "one or more")
        self.settings = Settings(observations, **settings)
        self.task = task
        self.num_envs = num_envs
        self.render_mode = self.settings.render_mode
        self.autoreset_mode = _mode(autoreset_mode)
        self._shared = shared_session(self.settings.root, self.settings.paths, self.settings.catalogue)
        session = self._shared.core
        self._starts = Starts(
            session,
            task,
            self.settings.variation,
            self.settings.split,
            self.settings.randomise,
            self.settings.perturb,
        )
        count = min(num_envs, threads or len(os.sched_getaffinity(0)))
        self._group = _core.environment_group(session, task, num_envs, count, **self.settings.engine())
        example = self._run_one(0, self._starts.first())
        if self.render_mode:
            self._group.pictures(self.settings.camera, 1)  # raises where there is no such camera
        self._codec = ObservationCodec(example)
        self._actions = ActionCodec(self._group.spaces(0), action, gripper, normalise_actions)
        self.single_observation_space = self._codec.space
        self.single_action_space = self._actions.space
        self.observation_space = batch_space(self._codec.space, num_envs)
        self.action_space = batch_space(self._actions.space, num_envs)
        rate = self._group.frame_hz(0)
        self.metadata = {**self.metadata, "render_fps": rate, "autoreset_mode": self.autoreset_mode}
        self._accounts = [EpisodeAccount(task) for _ in range(num_envs)]
        self._all = np.ones(num_envs, np.bool_)
        self._columns: dict[str, tuple[list[Any], np.ndarray]] = {}  # of the infos of the last step
        self._randoms: list[np.random.Generator | None] = [None] * num_envs
        self._seeds: list[int | None] = [None] * num_envs
        self.closed = False

    def __reduce__(self) -> tuple[Any, ...]:
        return made_again, (type(self), self.task, self._arguments), {"spec": self.spec}

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.task!r}{shown_arguments(self._arguments, type(self))})"

    def _repr_html_(self) -> str:
        """For notebooks."""
        return spaces_shown(self)

    @property
    def action_names(self) -> list[str]:
        """Of the components of an action of one environment."""
        return self._actions.names

    @property
    def action_units(self) -> list[str]:
        """Of the components of an action of one environment, where actions are not normalised."""
        return self._actions.units

    @property
    def np_random(self) -> tuple[np.random.Generator, ...]:
        """Each environment's own."""
        return tuple(self._random(i) for i in range(self.num_envs))

    @property
    def np_random_seed(self) -> tuple[int | None, ...]:
        """Of each environment's `np_random`."""
        return tuple(self._seeds)

    @alone
    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """New starts. seed: of the first environment (others count on from it), or one each.

        options: as of Env.reset, and `reset_mask`, bool (num_envs,): only those begin anew; the others stay as they
        are, and only those have infos.
        """
        self._check_open("reset")
        seeds = _seeds(seed, self.num_envs)
        each = dict(options or {})
        chosen = self._chosen(each.pop("reset_mask", None))
        infos: dict[str, Any] = {}
        for i, info in self._begin(chosen, seeds, each).items():
            infos = self._add_info(infos, info, i)
        return self._observation(), infos

    @alone
    def step(self, actions: np.ndarray | Sequence[Any]) -> VectorResult:
        """Each environment acts, as Env.step; those that ended do what the autoreset mode says.

        actions: num_envs x components, or a list with an array or a stampede.Action for each.
        """
        self._check_begun("step")
        if len(actions) != self.num_envs:
            raise fault("step(actions)", f"{len(actions)} actions", f"one for each of the {self.num_envs} environments")
        next_step = self.autoreset_mode is AutoresetMode.NEXT_STEP
        ended = [account.over for account in self._accounts]
        asked = zip(ended, actions, strict=True)
        steps = self._group.run([None if over else self._actions(action) for over, action in asked])
        rewards = np.zeros(self.num_envs, np.float64)
        terminations = np.zeros(self.num_envs, np.bool_)
        truncations = np.zeros(self.num_envs, np.bool_)
        each: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for i, account in enumerate(self._accounts):
            if ended[i] and next_step:
                continue
            verdict = account.after_end() if ended[i] else account.after(steps[i])
            rewards[i], terminations[i], truncations[i], each[i] = verdict
            if self.settings.record and account.over and not ended[i]:
                each[i]["recorded"] = self._group.episode(i)
        infos: dict[str, Any] = {}
        anew: list[int] = []
        if next_step:
            anew = [i for i, over in enumerate(ended) if over]
        elif self.autoreset_mode is AutoresetMode.SAME_STEP:
            anew = [i for i, account in enumerate(self._accounts) if account.over]
            for i in anew:
                final = {"final_obs": self._codec(self._accounts[i].raw), "final_info": each[i]}
                infos = self._add_info(infos, final, i)
        if anew:
            for i, info in self._begin(anew, [None] * self.num_envs, {}).items():
                each[i] = info
        return self._observation(), rewards, terminations, truncations, self._batched(each, infos)

    @alone
    def render(self) -> tuple[np.ndarray, ...] | None:
        """What each environment's `camera` sees: height x width x 3, uint8. None without a render mode."""
        self._check_begun("render")
        return tuple(self._group.pictures(self.settings.camera, self.num_envs)) if self.render_mode else None

    @alone
    def skills(self) -> tuple[list[_core.SkillChoice], ...]:
        """Of each environment: every ground skill of the scene, with what can be done now."""
        self._check_begun("skills")
        return tuple(self._group.skills(i) for i in range(self.num_envs))

    @alone
    def close(self, **further: Any) -> None:
        """Lets go of engine and session. Any use from now on raises stampede.Error."""
        super().close(**further)

    def close_extras(self, **_: Any) -> None:
        """Lets go of the engine's environments and threads."""
        del self._group, self._shared

    def _random(self, i: int) -> np.random.Generator:
        random = self._randoms[i]
        if random is None:
            random, self._seeds[i] = seeding.np_random()
            self._randoms[i] = random
        return random

    def _chosen(self, mask: np.ndarray | None) -> list[int]:
        if mask is None:
            return list(range(self.num_envs))
        mask = np.asarray(mask)
        if mask.shape != (self.num_envs,) or mask.dtype != np.bool_ or not mask.any():
            raise fault(
                "reset(options=)",
                f"a reset_mask of {mask.dtype}, shape {mask.shape}",
                f"an array of bool of shape ({self.num_envs},), with True somewhere",
            )
        chosen = np.flatnonzero(mask).tolist()
        if not all(account.begun or mask[i] for i, account in enumerate(self._accounts)):
            raise fault("reset(options=)", "some environments have not begun", "reset all of them first")
        return chosen

    def _begin(
        self, chosen: Sequence[int], seeds: Sequence[int | None], options: Mapping[str, Any]
    ) -> dict[int, dict[str, Any]]:
        """Begins new episodes, at once; their infos."""
        for i in chosen:
            if seeds[i] is not None:
                self._randoms[i], self._seeds[i] = seeding.np_random(seeds[i])
        starts = {i: self._starts.draw(self._random(i), seeds[i], options) for i in chosen}
        began = self._try_at_once(starts)
        if began is None:  # one cannot be made, and what the others gave is lost: the same again, one by one
            began = {
                i: self._starts.begin(
                    self._random(i), None, options, lambda request, i=i: self._run_one(i, request), first=start
                )
                for i, start in starts.items()
            }
        infos = {}
        for i, (start, raw) in began.items():
            self._codec.check(raw)
            horizon = round(self._group.horizon_s(i) * self._group.frame_hz(i))
            infos[i] = self._accounts[i].begin(start, raw, horizon, self._group.instructions(i))
        return infos

    def _try_at_once(self, starts: Mapping[int, Start]) -> dict[int, tuple[Start, dict[str, Any]]] | None:
        try:
            steps = self._group.run([starts[i].request if i in starts else None for i in range(self.num_envs)])
        except _core.Error:
            return None
        return {i: (start, steps[i].observation) for i, start in starts.items()}

    def _run_one(self, i: int, request: _core.Reset) -> dict[str, Any]:
        return self._group.run([request if j == i else None for j in range(self.num_envs)])[i].observation

    def _observation(self) -> Observation:
        return self._codec.batch([account.raw for account in self._accounts])

    def _batched(self, each: Sequence[dict[str, Any]], infos: dict[str, Any]) -> dict[str, Any]:
        """Infos in Gymnasium's form for vectors; `infos` has what is batched already."""
        first = each[0]
        if infos or any(one.keys() != first.keys() for one in each):
            for i, one in enumerate(each):
                infos = self._add_info(infos, one, i)
            return infos
        # Almost every step: all have the same keys. Each array is made at once, or is that of the step before; one mask
        # is that of all.
        mask = self._all.copy()
        for key in first:
            values = [one[key] for one in each]
            before = self._columns.get(key)
            if before is None or before[0] != values:
                before = self._columns[key] = values, _column(values)
            infos[key] = before[1]
            infos[f"_{key}"] = mask
        return infos

    def _check_open(self, use: str) -> None:
        if self.closed:
            raise fault(f"VectorEnv.{use}", "the environments are closed", "make others")

    def _check_begun(self, use: str) -> None:
        self._check_open(use)
        if not all(account.begun for account in self._accounts):
            raise fault(f"VectorEnv.{use}", "nothing has begun", "call reset() first")


def _column(values: list[Any]) -> np.ndarray:
    """An array of numbers, or of anything else as it is; not to be written to, as later steps may give it again."""
    kind = type(values[0])
    column = np.empty(len(values), kind if kind in (bool, int, float) else object)
    for i, value in enumerate(values):
        column[i] = value
    column.setflags(write=False)
    return column


def _mode(mode: AutoresetMode | str) -> AutoresetMode:
    try:
        return AutoresetMode(mode)
    except ValueError:
        raise unknown("autoreset_mode=", "mode", str(mode), [one.value for one in AutoresetMode]) from None


def _seeds(seed: int | Sequence[int | None] | None, count: int) -> list[int | None]:
    if seed is None:
        return [None] * count
    if isinstance(seed, (int, np.integer)):
        return [int(seed) + i for i in range(count)]
    if len(seed) != count:
        raise fault("reset(seed=)", f"{len(seed)} seeds for {count} environments", "one number, or one each")
    return list(seed)
