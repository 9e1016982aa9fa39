"""A task as a Gymnasium environment whose agent acts by set-points."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from stampede import _core

from .alone import alone
from .base import EpisodeEnv, Result, Settings
from .sessions import PathLike
from .spaces import ActionCodec

OBSERVATIONS = ("joint_positions", "joint_velocities", "gripper_open", "gripper_pose", "task_low_dim_state")


class Env(EpisodeEnv):
    """A task as a Gymnasium environment.

    Arguments:
        task: name of a task, `stack_blocks`.
        action: space of the agent's actions: joint_position, joint_delta, joint_velocity, joint_torque, tool_pose,
            tool_delta, tool_velocity, tool_impedance, tool_path, tool_path_delta or gripper (stampede.Action says what
            each does). `step` takes a stampede.Action of any other space as well.
        observations: channels by name or group (engine/episode/README.md). Texts go into info.
        reward: sparse (1 at success), dense (how far the plan for the goal has come), or the task's own.
        variation: canonical text or axes of it; None: drawn at each reset.
        split: `train` (seeds below 1'000'000) or `test` (from there up).
        gripper: actions end with the opening of the fingers, m. Without, the fingers stay as they were told last.
        normalise_actions: actions are -1 … 1, from bound to bound.
        render_mode: `rgb_array`: `render` draws what `camera` sees.
        frame_hz, physics_hz: rates; 0: the world's. horizon_s: simulated; 0: the task's.
        image_size: (height, width) of all pictures, or one number for both; None: each camera's own.
        hidden: observe also what no eye can see.
        randomise, perturb: of every start; see stampede.Reset.
        record: episodes that end are kept: in `catalogue`, where given, and as info["recorded"].
        root, paths: folders of scripts; see stampede.Session.

    Raises stampede.Error for unknown names and unusable files, each with its place and cure.
    """

    def __init__(
        self,
        task: str,
        *,
        action: str = "joint_delta",
        observations: Sequence[str] = OBSERVATIONS,
        reward: str = "sparse",
        variation: str | None = None,
        split: str = "train",
        gripper: bool = True,
        normalise_actions: bool = False,
        render_mode: str | None = None,
        camera: str = "front",
        frame_hz: float = 0,
        physics_hz: float = 0,
        horizon_s: float = 0,
        image_size: int | tuple[int, int] | None = None,
        hidden: bool = False,
        randomise: bool = False,
        perturb: str = "",
        record: bool = False,
        catalogue: PathLike | None = None,
        root: PathLike | None = None,
        paths: Sequence[PathLike] = (),
    ) -> None:
        settings = Settings(
            observations=observations,
            reward=reward,
            variation=variation,
            split=split,
            render_mode=render_mode,
            camera=camera,
            frame_hz=frame_hz,
            physics_hz=physics_hz,
            horizon_s=horizon_s,
            image_size=image_size,
            hidden=hidden,
            randomise=randomise,
            perturb=perturb,
            record=record,
            catalogue=catalogue,
            root=root,
            paths=paths,
        )
        super().__init__(task, settings)
        self._acting = {"action": action, "gripper": gripper, "normalise_actions": normalise_actions}
        self._actions = ActionCodec(self._environment.spaces(), action, gripper, normalise_actions)
        self.action_space = self._actions.space

    @property
    def action_names(self) -> list[str]:
        """Of the components of an action."""
        return self._actions.names

    @property
    def action_units(self) -> list[str]:
        """Of the components of an action, where actions are not normalised."""
        return self._actions.units

    @property
    def arguments(self) -> dict[str, Any]:
        """All that this environment was made with, but the task."""
        return {**vars(self.settings), **self._acting}

    def action(self, action: np.ndarray | Sequence[float] | _core.Action) -> _core.Action:
        """The engine's action for one of the action space."""
        return self._actions(action)

    @alone
    def step(self, action: np.ndarray | Sequence[float] | _core.Action) -> Result:
        """Acts for one frame, or for as long as a path, skill or hold lasts.

        An action that cannot be done changes nothing: info["refusal"] says why, the reward is 0, and the step counts
        as one frame of the horizon. info["limited"] lists what kept the arm from going as the action asks, such as
        "tool_speed" or "contact": see stampede.Step. Raises stampede.Error for an action of another shape.
        """
        self._check_begun("step")
        if self._account.over:
            return self._result(self._account.after_end())
        return self._result(self._account.after(self._environment.step(self._actions(action))))
