"""ManiSkill's trajectories: for each task an HDF5 file and a JSON file of the same name, with an entry an episode.

Differences that matter: `env_states` of things are poses as ManiSkill has them, and 0 for their velocities, which are
not stored. All actions are -1 … 1, joint positions too; `env_info` says what that is in rad and m, and what the columns
of `task_low_dim_state` are (`state_names`). `reset_kwargs` are those of `stampede.Env`. `source_type` is
`motionplanning`.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from stampede.catalogue import StoredEpisode
from stampede.export import common_cameras
from stampede.export.hdf5 import Demo, DemoFiles, Facts, add_action_argument, put_pictures, scale_of
from stampede.export.scene import robot_base
from stampede.export.steps import Array, Steps, bodies_of, is_real, known
from stampede.file_names import file_name

# ManiSkill's names of our action spaces.
_CONTROL = {"joint_position": "pd_joint_pos", "joint_delta": "pd_joint_delta_pos", "tool_delta": "pd_ee_delta_pose"}


class Writer:
    """Writes FOLDER/TASK/trajectory.OBSERVATIONS.CONTROL.bullet_cpu.h5 and .json."""

    def __init__(self, folder: Path, options: argparse.Namespace, episodes: Sequence[StoredEpisode]) -> None:
        self._folder = folder
        self._options = options
        tasks: dict[str, list[StoredEpisode]] = {}
        for episode in episodes:
            tasks.setdefault(episode.task, []).append(episode)
        self._cameras = {task: common_cameras(some, options) for task, some in tasks.items()}
        names = [self._file_name(episode.task) for episode in episodes]
        self._demos = DemoFiles(folder, episodes, names, group="traj_{}")

    @staticmethod
    def add_arguments(parser: argparse.ArgumentParser) -> None:
        add_action_argument(parser)

    def has(self, episode: StoredEpisode) -> bool:
        return self._demos.has(episode)

    def write(self, episode: StoredEpisode) -> None:
        cameras = self._cameras[episode.task]
        parameters = [f"{camera}_camera_{what}" for camera in cameras for what in ("intrinsics", "extrinsics")]
        bodies = bodies_of(episode)
        steps = Steps(episode, [*(["object_pose"] if bodies else []), *parameters], self._options.channels)
        names = list(steps.arrays.column("task_low_dim_state").labels)
        shared = {**scale_of(steps, self._options.action), "state_names": names}
        with self._demos.making(episode, shared, {"info": steps.meta()}) as trajectory:
            self._put_steps(trajectory, steps)
            states = trajectory.create_group("env_states")
            for name in bodies:
                states.create_dataset(f"actors/{name}", data=_actor(known(steps.arrays[f"object_pose/{name}"])))
            states.create_dataset("articulations/panda", data=_robot(steps))
            self._put_observations(trajectory.create_group("obs"), steps)

    def finish(self) -> None:
        self._demos.finish(self._complete)

    def close(self) -> None:
        """Nothing is open between two episodes."""

    def _file_name(self, task: str) -> str:
        observations = "rgb" if self._cameras[task] else "state_dict"
        return f"{file_name(task)}/trajectory.{observations}.{_CONTROL[self._options.action]}.bullet_cpu.h5"

    def _put_steps(self, trajectory: Any, steps: Steps) -> None:
        ended = np.zeros(steps.count, dtype=bool)
        ended[-1] = not steps.episode.success
        trajectory.create_dataset("actions", data=steps.actions(self._options.action))
        trajectory.create_dataset("rewards", data=steps.rewards.astype(np.float32))
        for name, values in {"success": steps.success, "terminated": steps.success, "truncated": ended}.items():
            trajectory.create_dataset(name, data=values)
        trajectory.create_dataset("fail", data=ended)

    def _put_observations(self, observed: Any, steps: Steps) -> None:
        arrays = steps.arrays
        joints, speeds = _joints(steps)
        observed.create_dataset("agent/qpos", data=joints)
        observed.create_dataset("agent/qvel", data=speeds)
        observed.create_dataset("extra/tcp_pose", data=_pose(known(arrays["gripper_pose"])))
        observed.create_dataset("extra/task_low_dim_state", data=known(arrays["task_low_dim_state"]))
        for name, values in steps.channels.items():
            observed.create_dataset(f"extra/{name}", data=values)
        for camera in self._cameras[steps.episode.task]:
            pictures = steps.episode.pictures(f"{camera}_rgb", draw=self._options.draw)
            put_pictures(observed.require_group(f"sensor_data/{camera}"), "rgb", pictures)
            world_from_camera = arrays[f"{camera}_camera_extrinsics"]
            intrinsics = np.broadcast_to(_intrinsics(steps, camera), (len(world_from_camera), 3, 3))
            parameters = observed.require_group(f"sensor_param/{camera}")
            parameters.create_dataset("intrinsic_cv", data=intrinsics.astype(np.float32))
            parameters.create_dataset("extrinsic_cv", data=np.linalg.inv(world_from_camera)[:, :3].astype(np.float32))
            # OpenGL's camera looks along its -z, and its y points up.
            opengl = world_from_camera * np.array([1, -1, -1, 1])
            parameters.create_dataset("cam2world_gl", data=opengl.astype(np.float32))

    def _complete(self, file: Any, name: str, demos: list[Demo], shared: Facts) -> None:
        """The JSON beside it, before the HDF5 file gets its name."""
        description = self._description(demos, shared)
        path = (self._folder / name).with_suffix(".json")
        part = path.with_name(path.name + ".part")
        part.write_text(json.dumps(description, indent=1))
        part.replace(path)

    def _description(self, demos: list[Demo], shared: Facts) -> Facts:
        control = _CONTROL[self._options.action]
        return {
            "env_info": {
                "env_id": f"stampede/{demos[0].episode.task}",
                "max_episode_steps": max(demo.episode.frames - 1 for demo in demos),
                "env_kwargs": {"action": self._options.action, "normalise_actions": True},
                **shared,
            },
            "episodes": [
                {
                    "episode_id": number,
                    "episode_seed": demo.episode.seed,
                    "reset_kwargs": {"options": _start(demo.episode)},
                    "control_mode": control,
                    "elapsed_steps": demo.episode.frames - 1,
                    "success": demo.episode.success,
                    "fail": not demo.episode.success,
                    "info": demo.facts["info"],
                }
                for number, demo in enumerate(demos)
            ],
            **_source(demos),
        }


def _source(demos: list[Demo]) -> Facts:
    if any(is_real(demo.episode) for demo in demos):
        return {"source_type": "real", "source_desc": "recordings of a real robot"}
    return {"source_type": "motionplanning", "source_desc": "demonstrations of Stampede's task and motion planner"}


def _start(episode: StoredEpisode) -> Facts:
    """Options with which `stampede.Env.reset` makes the start of the episode."""
    return {
        name: value for name, value in (("variation", episode.variation), ("seed", episode.seed)) if value is not None
    }


def _intrinsics(steps: Steps, camera: str) -> Array:
    """3 x 3, pixel, of the pictures: those that are stored may have another size than the camera."""
    stored = steps.episode.catalogue.query(
        "SELECT focal_x, focal_y, centre_x, centre_y FROM images"
        " WHERE episode = ?1 AND camera = ?2 AND kind = 'rgb' LIMIT 1",
        steps.episode.id,
        camera,
    )
    for row in stored:
        return np.array([[row["focal_x"], 0, row["centre_x"]], [0, row["focal_y"], row["centre_y"]], [0, 0, 1]])
    return steps.arrays[f"{camera}_camera_intrinsics"]


def _joints(steps: Steps) -> tuple[Array, Array]:
    """Of arm and fingers at all frames: positions in rad and m, velocities."""
    arrays = steps.arrays
    positions = np.hstack([arrays["joint_positions"], arrays["gripper_joint_positions"]])
    return known(positions), known(np.hstack([arrays["joint_velocities"], arrays["gripper_joint_velocities"]]))


def _robot(steps: Steps) -> Array:
    """Pose of the base, which stands still, its velocities, joints, their velocities: F x 31."""
    base = _actor(np.tile(known(robot_base(steps.episode)), (steps.count + 1, 1)))
    return np.hstack([base, *_joints(steps)])


def _pose(poses: Array) -> Array:
    """x y z, quaternion w x y z."""
    return poses[:, [0, 1, 2, 6, 3, 4, 5]]


def _actor(poses: Array) -> Array:
    """The same and linear and angular velocities, F x 13."""
    return np.hstack([_pose(poses), np.zeros((len(poses), 6))])
