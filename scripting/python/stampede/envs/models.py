"""Learners' models as policies of the engine."""

import inspect
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import gymnasium
import numpy as np

from stampede import _core

from .env import Env
from stampede.faults import fault
from .sessions import PathLike
from .skill_env import HOLD, SkillEnv

AnyEnv = Env | SkillEnv


class ModelPolicy:
    """A model with `predict` as what acts in one episode."""

    def __init__(self, model: Any, envs: Mapping[str, AnyEnv], deterministic: bool) -> None:
        """envs: by task; they say what the model observes and how it acts."""
        self._model = model
        self._envs = envs
        self._env: AnyEnv = next(iter(envs.values()))
        self._deterministic = deterministic
        self._flat = isinstance(model.observation_space, gymnasium.spaces.Box)
        self._normaliser = model.get_vec_normalize_env() if hasattr(model, "get_vec_normalize_env") else None
        self._state: Any = None
        self._first = True

    def begin(self, call: _core.PolicyCall) -> None:
        self._env = self._envs[call.task]

    def act(self, raw: Mapping[str, Any]) -> _core.Action:
        """The model's action for channels as the engine gives them."""
        observation: Any = self._env.observation(raw)
        if self._flat:
            observation = gymnasium.spaces.flatten(self._env.observation_space, observation)
        if self._normaliser is not None:
            observation = self._normaliser.normalize_obs(observation)
        action, self._state = self._model.predict(
            observation,
            state=self._state,
            episode_start=np.array([self._first]),
            deterministic=self._deterministic,
            **self._further_arguments(raw),
        )
        self._first = False
        return self._env.action(action)

    def _further_arguments(self, raw: Mapping[str, Any]) -> dict[str, Any]:
        """Of the model's `predict`."""
        return {}


class SkillModelPolicy(ModelPolicy):
    """A model that chooses skills. As SkillEnv does, it waits for the verdict where a skill has reached the goal."""

    _env: SkillEnv

    def __init__(self, model: Any, envs: Mapping[str, Any], deterministic: bool) -> None:
        """envs: SkillEnv of each task."""
        super().__init__(model, envs, deterministic)
        self._masked = "action_masks" in inspect.signature(model.predict).parameters
        self._waits = False  # whether the last action was a skill of the model's

    def act(self, raw: Mapping[str, Any]) -> _core.Action:
        if self._waits and raw["progress"] == 1:
            self._waits = False
            return _core.Action(HOLD)
        self._waits = True
        return super().act(raw)

    def _further_arguments(self, raw: Mapping[str, Any]) -> dict[str, Any]:
        return {"action_masks": self._env.masks(raw)} if self._masked else {}


def model_policy(
    model: Any,
    tasks: Sequence[str],
    env: gymnasium.Env | Mapping[str, Any] | None,
    deterministic: bool,
    root: PathLike | None,
    paths: Sequence[PathLike],
) -> tuple[Callable[[], ModelPolicy], dict[str, Any]]:
    """What makes the model a policy of these tasks, and the settings that Session.evaluate needs for it.

    A model whose actions are a Box acts by set-points, any other by skills. Raises stampede.Error where the model's
    spaces are not those of a task.
    """
    kind: type[AnyEnv] = Env if isinstance(model.action_space, gymnasium.spaces.Box) else SkillEnv
    arguments = {**_arguments_of(model, env, kind), "root": root, "paths": paths, "variation": None}
    arguments |= {"record": False, "catalogue": None, "render_mode": None}
    if arguments.get("frames"):
        raise fault("evaluate(env=)", "its steps are parts of skills", "frames=0: a step is a whole skill")
    envs = {task: kind(task, **arguments) for task in tasks}
    if not envs:
        raise fault("evaluate(tasks=)", "no task", "name one or more")
    for one in envs.values():
        _check_spaces(model, one)
    settings = one.engine_settings()
    del settings["record"]
    policy = ModelPolicy if kind is Env else SkillModelPolicy
    return lambda: policy(model, envs, deterministic), settings


def _arguments_of(model: Any, env: gymnasium.Env | Mapping[str, Any] | None, kind: type[AnyEnv]) -> dict[str, Any]:
    if isinstance(env, Mapping):
        return dict(env)
    if env is None and getattr(model, "get_env", None) is not None and model.get_env() is not None:
        return dict(model.get_env().get_attr("arguments")[0])
    if env is None:
        raise fault("evaluate(env=)", "the model does not say in what it was trained", "give the Env, or its arguments")
    if not isinstance(env.unwrapped, kind):
        cure = f"by the model's actions, a stampede.{kind.__name__}, wrapped or not"
        raise fault("evaluate(env=)", f"a {type(env.unwrapped).__name__}", cure)
    return dict(env.unwrapped.arguments)


def _check_spaces(model: Any, env: AnyEnv) -> None:
    observations: gymnasium.Space = env.observation_space
    if isinstance(model.observation_space, gymnasium.spaces.Box):
        observations = gymnasium.spaces.flatten_space(observations)
    for what, of_model, of_task in (
        ("observation", model.observation_space, observations),
        ("action", model.action_space, env.action_space),
    ):
        if of_model != of_task:
            raise fault(
                f"task '{env.task}'",
                f"its {what} space is not the model's",
                f"{of_task} here, {of_model} there: give env= as the model was trained, or tasks of that shape",
            )
