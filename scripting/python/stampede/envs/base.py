"""What environments that act by set-points and by skills have in common."""

import inspect
import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import gymnasium
import numpy as np

from stampede import _core, shown

from .account import EpisodeAccount, Verdict, skill_text
from .alone import alone
from stampede.faults import fault
from .sessions import PathLike, shared_session
from .spaces import Observation, ObservationCodec
from .starts import Start, Starts

Result = tuple[Observation, float, bool, bool, dict[str, Any]]


@dataclass(frozen=True)
class Settings:
    """How an environment observes, is rewarded and starts. The arguments of Env, which says what they mean."""

    observations: Sequence[str]
    reward: str = "sparse"
    variation: str | None = None
    split: str = "train"
    render_mode: str | None = None
    camera: str = "front"
    frame_hz: float = 0
    physics_hz: float = 0
    horizon_s: float = 0
    image_size: int | tuple[int, int] | None = None
    hidden: bool = False
    randomise: bool = False
    perturb: str = ""
    record: bool = False
    catalogue: PathLike | None = None
    root: PathLike | None = None
    paths: Sequence[PathLike] = ()

    def engine(self, further_channels: Sequence[str] = ()) -> dict[str, Any]:
        """Arguments of `_core.Session.environment`."""
        height, width = (self.image_size,) * 2 if isinstance(self.image_size, int) else self.image_size or (0, 0)
        return {
            "channels": list(dict.fromkeys([*self.channels, *further_channels])),
            "hidden": self.hidden,
            "reward": self.reward,
            "frame_hz": self.frame_hz,
            "physics_hz": self.physics_hz,
            "horizon_s": self.horizon_s,
            "record": self.record,
            "width": width,
            "height": height,
        }

    @property
    def channels(self) -> list[str]:
        return [self.observations] if isinstance(self.observations, str) else list(self.observations)


@dataclass(frozen=True)
class SavedEpisode:
    """A moment of an episode to which an environment can go back."""

    state: _core.SavedState
    start: Start
    motionless: int
    task: str

    def __repr__(self) -> str:
        return f"SavedEpisode({self.task} {self.start.variation}, seed {self.start.seed})"


def made_again(kind: type, task: str, arguments: Mapping[str, Any]) -> Any:
    return kind(task, **arguments)


def shown_arguments(arguments: Mapping[str, Any], kind: type) -> str:
    """`, action='tool_delta'`: those that are not the usual ones."""
    usual = inspect.signature(kind).parameters
    return "".join(
        f", {name}={value!r}"
        for name, value in arguments.items()
        if name not in usual or usual[name].default != value
    )


def spaces_shown(env: Any) -> str:
    """What an environment, or several, take and give, as HTML."""
    rows = [("action", env.action_space), *env.observation_space.spaces.items()]
    return shown.table(("", "space"), [(name, _space_text(space)) for name, space in rows], repr(env))


def _space_text(space: gymnasium.Space[Any]) -> str:
    if isinstance(space, gymnasium.spaces.Discrete):
        return f"{space.n} choices"
    return f"{' x '.join(map(str, space.shape or ())) or 1} {space.dtype}"


class EpisodeEnv(gymnasium.Env[Observation, Any]):
    """A task whose episodes are begun, drawn, saved and kept; subclasses say how an agent acts.

    Used by one thread at a time: another one gets an Error meanwhile. pickle and copy.deepcopy make another environment
    of the same arguments, which begins with reset().
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 20}

    def __init__(self, task: str, settings: Settings, inner_channels: Sequence[str] = ()) -> None:
        """inner_channels: what the environment itself reads and the agent does not see."""
        self._closed = True  # until all is made: a constructor that raises leaves nothing open
        self._use = threading.RLock()
        if settings.render_mode not in (None, *self.metadata["render_modes"]):
            raise fault("render_mode=", f"there is no render mode '{settings.render_mode}'", "rgb_array, or None")
        self.task = task
        self.settings = settings
        self.render_mode = settings.render_mode
        self._shared = shared_session(settings.root, settings.paths, settings.catalogue)
        self._starts = Starts(
            self.session, task, settings.variation, settings.split, settings.randomise, settings.perturb
        )
        self._inner_channels = inner_channels
        self._environment = self.session.environment(task, **self.engine_settings())
        example = self._environment.reset(self._starts.first())
        if self.render_mode:
            self._environment.picture(settings.camera)  # raises where there is no such camera
        self._codec = ObservationCodec(example, frozenset(inner_channels) - frozenset(settings.channels))
        self.observation_space = self._codec.space
        self.metadata = {**self.metadata, "render_fps": self._environment.frame_hz}
        self._account = EpisodeAccount(task)
        self._start: Start | None = None
        self._kept = False  # whether the episode has been handed over
        self._closed = False

    @property
    def arguments(self) -> dict[str, Any]:
        """All that this environment was made with, but the task."""
        raise NotImplementedError

    def __reduce__(self) -> tuple[Any, ...]:
        return made_again, (type(self), self.task, self.arguments), {"spec": self.spec}

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.task!r}{shown_arguments(self.arguments, type(self))})"

    def _repr_html_(self) -> str:
        """For notebooks."""
        return spaces_shown(self)

    @property
    def session(self) -> _core.Session:
        return self._shared.core

    def engine_settings(self) -> dict[str, Any]:
        """Arguments of `_core.Session.environment`, for all that this environment reads."""
        return self.settings.engine(self._inner_channels)

    @property
    def frame_hz(self) -> float:
        """Frames a second; a set-point lasts one."""
        return self.metadata["render_fps"]

    @property
    def _horizon(self) -> int:
        return round(self._environment.horizon_s * self.frame_hz)

    @alone
    def reset(
        self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """A new start. The same seed gives the same bits.

        seed: the engine's is its remainder by 1'000'000, and that much more in the test split. None: drawn.
        options: variation, seed (the engine's own), where and goal (PDDL), perturb, randomise, or episode and frame.
        A start that was drawn and cannot be made gives way to the next draw, up to ten; info says which was taken.
        """
        self._check_open("reset")
        super().reset(seed=seed)
        self._account.end()
        self._kept = False
        self._start, raw = self._starts.begin(self.np_random, seed, options or {}, self._environment.reset)
        self._codec.check(raw)
        info = self._account.begin(self._start, raw, self._horizon, self._environment.instructions())
        return self._codec(raw), info

    @alone
    def render(self) -> np.ndarray | None:
        """What `camera` sees at this frame: height x width x 3, uint8. None without a render mode."""
        self._check_begun("render")
        return self._environment.picture(self.settings.camera) if self.render_mode else None

    @alone
    def close(self) -> None:
        """Lets go of engine and session. Any use from now on raises stampede.Error."""
        if self._closed:
            return
        self._closed = True
        self._account.end()
        del self._environment, self._shared

    @alone
    def skills(self) -> list[_core.SkillChoice]:
        """Every ground skill of the scene, in a fixed order, with what can be done now."""
        self._check_begun("skills")
        return self._environment.skills()

    @alone
    def save(self) -> SavedEpisode:
        """This moment, between two steps. What follows a save and a restore is equal, bit for bit."""
        self._check_begun("save")
        assert self._start is not None
        return SavedEpisode(self._environment.save(), self._start, self._account.motionless, self.task)

    @alone
    def restore(self, saved: SavedEpisode) -> tuple[Observation, dict[str, Any]]:
        """Goes to a moment of an episode of the same task, whatever start is under way; gives what reset gives, there."""
        self._check_open("restore")
        if not isinstance(saved, SavedEpisode):
            raise fault(f"{type(self).__name__}.restore", f"{saved!r} is no saved moment", "give what save() returned")
        if self._account.begun and self._start == saved.start and not self._kept:
            raw = self._environment.restore(saved.state)
            return self._codec(raw), self._account.go_back(raw, saved.motionless)
        raw = self._environment.reset(saved.state)
        self._start, self._kept = saved.start, False
        self._account.begin(saved.start, raw, self._horizon, self._environment.instructions())
        return self._codec(raw), self._account.go_back(raw, saved.motionless)

    @alone
    def episode(self) -> _core.Episode:
        """Ends and keeps the episode that is under way; with `record` alone. One that ends by itself is kept then."""
        self._check_begun("episode")
        episode = self._environment.episode()
        self._account.end()
        return episode

    @cached_property
    def observation_labels(self) -> dict[str, list[str]]:
        """Names of the components of channels that have some, by channel."""
        self._check_open("observation_labels")
        ground = {
            "facts": [str(atom) for atom in self._environment.atoms()],
            "applicable": [skill_text(choice) for choice in self._environment.skills()],
        }
        ground["known"] = ground["goal"] = ground["facts"]
        labels = {**self._environment.labels(), **ground}
        return {name: labels[name] for name in self.observation_space if name in labels}

    def observation(self, raw: Mapping[str, Any]) -> Observation:
        """What the agent sees of channels as the engine gives them."""
        self._codec.check(raw)
        return self._codec(raw)

    def _result(self, verdict: Verdict) -> Result:
        if self.settings.record and self._account.over and not self._kept:
            verdict[-1]["recorded"] = self._environment.episode()
            self._kept = True
        return self._codec(self._account.raw), *verdict

    def _check_open(self, use: str) -> None:
        if self._closed:
            raise fault(f"{type(self).__name__}.{use}", "the environment is closed", "make another one")

    def _check_begun(self, use: str) -> None:
        self._check_open(use)
        if not self._account.begun:
            raise fault(f"{type(self).__name__}.{use}", "no episode is under way", "call reset() first")
