"""A task that runs: the engine's environment as actions and observations need it."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from stampede import _core
from stampede.rlbench.backend.exceptions import InvalidActionError
from stampede.rlbench.backend.observation import NUMBERS, STANDS_RAD_PER_S, Observation
from stampede.rlbench.backend.observing import observation_of
from stampede.rlbench.backend.pictures import CAMERA_COLUMNS, CameraView
from stampede.rlbench.observation_config import ObservationConfig

_NO_HORIZON_S = 1e9  # RLBench's episodes have no time limit
_SLOW_RAD_PER_S = 0.05  # an arm that stands, and trembles with what it holds
_THERE_RAD = 0.005
_LATEST_FRAMES = 40


@dataclass(frozen=True)
class Start:
    """What a start is made from; the same start, the same bits."""

    variation: str  # canonical text
    seed: int
    randomise: bool = False  # looks, light, cameras and dynamics


class Scene:
    """
    The world of one task. `act` is how action modes move the robot; `numbers` is what was measured last, by the
    engine's names of channels.
    """

    joint_count = 7
    opening_m = 0.08  # between the pads

    def __init__(
        self,
        session: _core.Session,
        task: str,
        config: ObservationConfig,
        dense_reward: bool = False,
        extra_channels: tuple[str, ...] = (),
    ) -> None:
        self._config = config
        self._cameras = config.cameras_on
        self._environment = session.environment(
            task,
            channels=[*dict.fromkeys((*NUMBERS, "gripper_opening", "progress", *extra_channels)), *self._pictures()],
            hidden=True,
            reward="dense" if dense_reward else "sparse",
            horizon_s=_NO_HORIZON_S,
            picture_sizes={name: camera.width_and_height for name, camera in self._cameras.items()},
            shadows=any(camera.shadows for camera in self._cameras.values()),
        )
        self.numbers: dict[str, Any] = {}
        self.over = True
        self.reward = 0.0
        self.variation_index = 0
        self.told_to_open: bool | None = None  # the hand, last, by Discrete
        self._asked: _core.Action | None = None  # last

    def _pictures(self) -> list[str]:
        channels: list[str] = []
        for name, camera in self._cameras.items():
            channels += [f"{name}_camera_{what}" for what in CAMERA_COLUMNS]
            channels += [f"{name}_rgb"] * camera.rgb + [f"{name}_depth"] * camera.needs_depth
            channels += [f"{name}_mask"] * camera.mask
        return channels

    def reset(self, start: Start, variation_index: int) -> None:
        """Raises `stampede.Error` for a start that cannot be made."""
        self.numbers = self._environment.reset(
            _core.Reset(variation=start.variation, seed=start.seed, randomise=start.randomise)
        )
        self.over, self.reward, self.variation_index = False, 0.0, variation_index
        self.told_to_open = self._asked = None

    def act(self, action: _core.Action) -> None:
        """
        One action of the engine, `stampede.Action("joint_delta", [0.01] * 7)`; nothing once the episode is over.

        Raises InvalidActionError for what cannot be done; nothing has changed then.
        """
        if self.over:
            return
        step = self._environment.step(action)
        if step.refusal is not None:
            raise InvalidActionError(str(step.refusal))
        self.numbers, self.reward = step.observation, float(step.reward)
        self.over = step.terminated or step.truncated
        self._asked = action

    def arrive(self) -> None:
        """Until the arm is where joint positions have just sent it, or stands."""
        if self._asked is None or self._asked.space != "joint_position":
            return
        for frame in range(_LATEST_FRAMES):
            off = float(np.abs(self.numbers["joint_positions"] - self._asked.values).max())
            if self.over or off < _THERE_RAD or (frame > 0 and self.stands):
                break
            self.act(self._asked)

    @property
    def _fastest_joint(self) -> float:
        return float(np.abs(self.numbers["joint_velocities"]).max())

    @property
    def stands(self) -> bool:
        return self._fastest_joint < STANDS_RAD_PER_S

    def wait_for_verdict(self) -> None:
        """Where the goal holds and the arm stands, stands still until it has held for as long as the task asks."""
        if not self.over and self._fastest_joint < _SLOW_RAD_PER_S and float(self.numbers["progress"]) == 1.0:
            self.act(_core.Action("hold"))

    def save(self) -> _core.SavedState:
        return self._environment.save()

    def restore(self, state: _core.SavedState) -> None:
        """Goes back to a moment of this episode at which it was not over."""
        self.numbers = self._environment.restore(state)
        self.over, self.reward = False, 0.0
        self._asked = None  # what was asked after that moment never was

    @cached_property
    def _bounds(self) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        return {
            space.name: (
                np.array([one.lower for one in space.components]),
                np.array([one.upper for one in space.components]),
            )
            for space in self._environment.spaces()
        }

    def within_bounds(self, space: str, values: np.ndarray) -> np.ndarray:
        """The nearest values that the robot can be asked for."""
        return np.clip(values, *self._bounds[space])

    def observation(self) -> Observation:
        now = self.numbers
        views = {
            name: CameraView(
                extrinsics=now[f"{name}_camera_extrinsics"],
                intrinsics=now[f"{name}_camera_intrinsics"],
                near=float(now[f"{name}_camera_near"]),
                far=float(now[f"{name}_camera_far"]),
                rgb=now.get(f"{name}_rgb"),
                depth=now.get(f"{name}_depth"),
                mask=now.get(f"{name}_mask"),
            )
            for name in self._cameras
        }
        return observation_of(self._config, now, views, {"variation_index": self.variation_index})
