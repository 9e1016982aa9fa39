"""The entry: tasks by class, with one way to act and one way to observe."""

from __future__ import annotations

import os
from functools import cached_property
from pathlib import Path

import numpy as np

from stampede import _core
from stampede._core import Error
from stampede.rlbench.action_modes.action_mode import ActionMode
from stampede.rlbench.backend.descriptions import Descriptions
from stampede.rlbench.backend.pictures import CAMERA_COLUMNS, CameraView, camera_misc
from stampede.rlbench.backend.scene import Scene
from stampede.rlbench.backend.task import Task
from stampede.rlbench.demo import Demo
from stampede.rlbench.observation_config import CAMERAS, ObservationConfig
from stampede.rlbench.sim2real.domain_randomization import (
    DynamicsRandomizationConfig,
    RandomizeEvery,
    VisualRandomizationConfig,
)
from stampede.rlbench.task_environment import TaskEnvironment
from stampede.rlbench.utils import check_dataset_root, stored_demos

SUPPORTED_ROBOTS = ("panda",)


class Environment:
    """
    Makes a `TaskEnvironment` of a task's class. Arguments are RLBench's; README.md beside this file says what differs.

    dataset_root: a folder of demos in RLBench's layout, or a catalogue, the file that `stampede run` writes.
    static_positions: every reset of a variation makes the same start. randomize_every: EPISODE draws looks, light,
    cameras and dynamics anew at every reset. shaped_rewards: how far a plan for the goal has come, instead of 0 and 1.
    paths: folders of tasks of your own (tasks/, skills/, worlds/), whose files win over those that came along.
    """

    def __init__(
        self,
        action_mode: ActionMode,
        dataset_root: str | os.PathLike[str] = "",
        obs_config: ObservationConfig | None = None,
        headless: bool = False,
        static_positions: bool = False,
        robot_setup: str = "panda",
        randomize_every: RandomizeEvery | None = None,
        frequency: int = 1,
        visual_randomization_config: VisualRandomizationConfig | None = None,
        dynamics_randomization_config: DynamicsRandomizationConfig | None = None,
        attach_grasped_objects: bool = True,
        shaped_rewards: bool = False,
        arm_max_velocity: float = 1.0,
        arm_max_acceleration: float = 4.0,
        *,
        paths: list[str | os.PathLike[str]] | None = None,
    ) -> None:
        if robot_setup not in SUPPORTED_ROBOTS:
            there = ", ".join(SUPPORTED_ROBOTS)
            raise Error(f"there is no robot '{robot_setup}' here\n    robot_setup is one of {there}")
        if randomize_every is not None and getattr(randomize_every, "name", "") != "EPISODE":
            raise Error(f"looks cannot be drawn at {randomize_every}\n    randomize_every=RandomizeEvery.EPISODE")
        if frequency != 1 and randomize_every is not None:
            raise Error(f"looks cannot be drawn at every {frequency}th episode only\n    frequency=1")
        for config in (visual_randomization_config, dynamics_randomization_config):
            if config is not None and (config.whitelist or config.blacklist):
                raise Error("objects cannot be kept from randomisation\n    leave whitelist and blacklist empty")
        self._action_mode = action_mode
        self._dataset_root = str(dataset_root or "")
        self._config = obs_config if obs_config is not None else ObservationConfig()
        self._static_positions = static_positions
        self._shaped_rewards = shaped_rewards
        self._randomise = randomize_every is not None
        self._paths = [Path(path) for path in paths or []]

    @cached_property
    def session(self) -> _core.Session:
        return _core.Session(paths=self._paths)

    @cached_property
    def descriptions(self) -> Descriptions:
        return Descriptions(self.session)

    def launch(self) -> None:
        """Reads the scripts now, and not with the first task."""
        _ = self.session

    def shutdown(self) -> None:
        """Lets go of everything; tasks that were got stay usable."""
        for name in ("session", "descriptions"):
            self.__dict__.pop(name, None)

    def __enter__(self) -> Environment:
        self.launch()
        return self

    def __exit__(self, *error: object) -> None:
        self.shutdown()

    def get_task(self, task_class: type[Task]) -> TaskEnvironment:
        """A task to act in. task_class: of `stampede.rlbench.tasks`, or `tasks.task_of("name")` for one in `paths`."""
        name = getattr(task_class, "task_name", "")
        if not (isinstance(task_class, type) and issubclass(task_class, Task) and name):
            raise Error(
                f"{task_class!r} is no class of a task\n"
                "    such as stampede.rlbench.tasks.ReachTarget; a task of your own is a Lua file: tasks.task_of(…)"
            )
        return TaskEnvironment(
            self,
            name,
            self._action_mode,
            self._config,
            self._dataset_root,
            self._static_positions,
            self._shaped_rewards,
            self._randomise,
        )

    @property
    def action_shape(self) -> tuple[int, ...]:
        """Of the array that `TaskEnvironment.step` takes."""
        return self._action_mode.action_shape(Scene)

    def action_bounds(self) -> tuple[np.ndarray, np.ndarray]:
        """Least and greatest values; NotImplementedError where the action mode has none."""
        return self._action_mode.action_bounds()

    def get_demos(
        self,
        task_name: str,
        amount: int,
        variation_number: int = 0,
        image_paths: bool = False,
        random_selection: bool = True,
        from_episode_number: int = 0,
    ) -> list[Demo]:
        """Stored demos of a task by name; see `TaskEnvironment.get_demos`."""
        return stored_demos(
            check_dataset_root(self._dataset_root),
            task_name,
            variation_number,
            self.session.variations(task_name),
            self._config,
            amount,
            image_paths,
            random_selection,
            from_episode_number,
        )

    def get_scene_data(self) -> dict[str, object]:
        """Cameras as `Observation.misc` has them, at their own size; the wrist's where the arm starts."""
        scene = self.session.environment(
            self.session.tasks()[0],
            channels=[f"{camera}_camera_{what}" for camera in CAMERAS for what in CAMERA_COLUMNS],
        )
        seen = scene.reset()
        data: dict[str, object] = {}
        for camera in CAMERAS:
            data |= camera_misc(
                camera, CameraView(**{what: seen[f"{camera}_camera_{what}"] for what in CAMERA_COLUMNS})
            )
        return data
