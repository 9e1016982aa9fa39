"""The tasks as Gymnasium environments: `gymnasium.make("rlbench/reach_target-state-v0")`."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces

from stampede._core import Error
from stampede.rlbench.action_modes.action_mode import JointPositionActionMode
from stampede.rlbench.backend.observation import Observation
from stampede.rlbench.environment import Environment
from stampede.rlbench.observation_config import ObservationConfig
from stampede.rlbench.tasks import task_class

_STATE = (
    "joint_velocities",
    "joint_positions",
    "joint_forces",
    "gripper_open",
    "gripper_pose",
    "gripper_joint_positions",
    "gripper_touch_forces",
    "task_low_dim_state",
)
_VISION = ("left_shoulder_rgb", "right_shoulder_rgb", "wrist_rgb", "front_rgb")


class RLBenchEnv(gymnasium.Env):
    """
    One task. Observations are dicts: eight fields of numbers as float32, with `vision` also four pictures, (128, 128,
    3) uint8. Actions are (8,) float32: changes of the joints, rad, and the position of each finger, m.

    render_mode: None or `rgb_array`, which gives what the camera `front` sees.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 20}

    def __init__(
        self,
        task_class: type,
        observation_mode: str = "state",
        render_mode: str | None = None,
        action_mode: Any = None,
    ) -> None:
        if observation_mode not in ("state", "vision"):
            raise Error(f"there is no observation mode '{observation_mode}'\n    one of state, vision")
        if render_mode not in (None, "rgb_array"):
            raise Error(f"there is no render mode '{render_mode}': nothing opens a window\n    rgb_array")
        self.render_mode = render_mode
        self._fields = _STATE + (_VISION if observation_mode == "vision" else ())
        config = ObservationConfig()
        config.set_all(False)
        config.set_all_low_dim(True)
        pictures = set(self._fields) | ({"front_rgb"} if render_mode == "rgb_array" else set())
        for name, camera in config.cameras.items():
            camera.rgb = f"{name}_rgb" in pictures
        action_mode = action_mode if action_mode is not None else JointPositionActionMode()
        self._environment = Environment(action_mode, obs_config=config, headless=True)
        self._task = self._environment.get_task(task_class)
        _, first = self._task.reset()
        self._seen: Observation = first
        self.observation_space = spaces.Dict({name: _space_of(value) for name, value in self._observed().items()})
        low, high = action_mode.action_bounds()
        self.action_space = spaces.Box(low.astype(np.float32), high.astype(np.float32))

    def reset(self, *, seed: int | None = None, options: dict | None = None) -> tuple[dict[str, np.ndarray], dict]:
        """seed: of numpy's global generator, from which starts are drawn. info: `text_descriptions`."""
        super().reset(seed=seed)
        if seed is not None:
            np.random.seed(seed)
        sentences, self._seen = self._task.reset()
        return self._observed(), {"text_descriptions": sentences}

    def step(self, action: np.ndarray) -> tuple[dict[str, np.ndarray], float, bool, bool, dict]:
        """A step after the end changes nothing."""
        self._seen, reward, over = self._task.step(action)
        return self._observed(), reward, over, False, {}

    def render(self) -> np.ndarray | None:
        """(128, 128, 3) uint8, what the camera `front` sees now; None without a render mode."""
        return None if self.render_mode is None else self._seen.front_rgb

    def close(self) -> None:
        self._environment.shutdown()

    def _observed(self) -> dict[str, np.ndarray]:
        values = {name: np.asarray(getattr(self._seen, name)) for name in self._fields}
        return {name: value if value.dtype == np.uint8 else value.astype(np.float32) for name, value in values.items()}


def _space_of(value: np.ndarray) -> spaces.Box:
    if value.dtype == np.uint8:
        return spaces.Box(0, 255, value.shape, np.uint8)
    return spaces.Box(-np.inf, np.inf, value.shape, np.float32)


def make(task: str, **settings: Any) -> RLBenchEnv:
    """The environment of a task by its name."""
    return RLBenchEnv(task_class(task), **settings)
