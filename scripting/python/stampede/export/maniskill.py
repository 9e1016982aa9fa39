"""ManiSkill's trajectories: an HDF5 file and a JSON file of the same name, with an entry an episode.

Differences that matter: `env_states` are poses as ManiSkill has them (x y z, quaternion w x y z, then linear and
angular velocities, which are not stored and 0), for the things of the scene; the robot's are its joints. `source_type`
is `motionplanning`.
"""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from stampede.catalogue import StoredEpisode
from stampede.export import cameras_of
from stampede.export.hdf5 import GrowingFile, add_action_argument, put_pictures
from stampede.export.steps import Array, Steps, bodies_of, known

# ManiSkill's names of our action spaces.
_CONTROL = {"joint_position": "pd_joint_pos", "joint_delta": "pd_joint_delta_pos", "tool_delta": "pd_ee_delta_pose"}


class Writer:
    """Writes FOLDER/trajectory.OBSERVATIONS.CONTROL.bullet_cpu.h5 and .json."""

    def __init__(self, folder: Path, options: argparse.Namespace, episodes: Sequence[StoredEpisode]) -> None:
        self._options = options
        self._episodes = list(episodes)
        self._number = {episode.id: number for number, episode in enumerate(episodes)}
        pictures = bool(cameras_of(episodes[0], options))
        name = f"trajectory.{'rgb' if pictures else 'state_dict'}.{_CONTROL[options.action]}.bullet_cpu"
        self._growing = GrowingFile(folder / f"{name}.h5")
        self._json = folder / f"{name}.json"

    @staticmethod
    def add_arguments(parser: argparse.ArgumentParser) -> None:
        add_action_argument(parser)

    def has(self, episode: StoredEpisode) -> bool:
        return self._growing.has(f"traj_{self._number[episode.id]}")

    def write(self, episode: StoredEpisode) -> None:
        bodies = bodies_of(episode)
        steps = Steps(episode, ["object_pose", "object_joint_positions", *_camera_columns(episode, self._options)])
        group = self._growing.begin(f"traj_{self._number[episode.id]}")
        group.create_dataset("actions", data=steps.actions(self._options.action))
        group.create_dataset("rewards", data=steps.rewards.astype(np.float32))
        group.create_dataset("success", data=steps.success)
        group.create_dataset("terminated", data=steps.success)
        ended = np.zeros(steps.count, dtype=bool)
        ended[-1] = not episode.success
        group.create_dataset("truncated", data=ended)
        group.create_dataset("fail", data=ended)
        actors = group.create_group("env_states/actors")
        for name in bodies:
            actors.create_dataset(name, data=_actor(known(steps.arrays[f"object_pose/{name}"])))
        articulations = group.create_group("env_states/articulations")
        articulations.create_dataset("panda", data=self._robot(steps))
        agent, extra = group.create_group("obs/agent"), group.create_group("obs/extra")
        arrays = steps.arrays
        agent.create_dataset("qpos", data=np.hstack([arrays["joint_positions"], arrays["gripper_joint_positions"]]))
        agent.create_dataset("qvel", data=np.hstack([arrays["joint_velocities"], arrays["gripper_joint_velocities"]]))
        extra.create_dataset("tcp_pose", data=_pose(arrays["gripper_pose"]))
        extra.create_dataset("task_low_dim_state", data=known(arrays["task_low_dim_state"]))
        for camera in cameras_of(episode, self._options):
            sensor = group.create_group(f"obs/sensor_data/{camera}")
            put_pictures(sensor, "rgb", episode.pictures(f"{camera}_rgb", draw=self._options.draw))
            parameters = group.create_group(f"obs/sensor_param/{camera}")
            intrinsics = np.broadcast_to(arrays[f"{camera}_camera_intrinsics"], (episode.frames, 3, 3))
            parameters.create_dataset("intrinsic_cv", data=intrinsics)
            parameters.create_dataset("cam2world_cv", data=arrays[f"{camera}_camera_extrinsics"])
        self._growing.end(group)

    def finish(self) -> None:
        text = json.dumps(self._description(), indent=1)
        partial = self._json.with_name(self._json.name + ".part")
        partial.write_text(text)
        self._growing.finish()
        os.replace(partial, self._json)

    def close(self) -> None:
        self._growing.close()

    def _robot(self, steps: Steps) -> Array:
        """Pose and velocity of the base, joints, their velocities."""
        arrays = steps.arrays
        base = np.zeros((steps.count + 1, 13))
        base[:, 3] = 1
        joints = [arrays["joint_positions"], arrays["gripper_joint_positions"]]
        speeds = [arrays["joint_velocities"], arrays["gripper_joint_velocities"]]
        return np.hstack([base, *joints, *speeds])

    def _description(self) -> dict[str, Any]:
        first = self._episodes[0]
        control = _CONTROL[self._options.action]
        episodes = [
            {
                "episode_id": self._number[episode.id],
                "episode_seed": episode.seed,
                "reset_kwargs": {"seed": episode.seed, "options": {"variation": episode.variation}},
                "control_mode": control,
                "elapsed_steps": episode.frames - 1,
                "success": episode.success,
                "fail": not episode.success,
                "info": Steps(episode).meta(),
            }
            for episode in self._episodes
        ]
        return {
            "env_info": {
                "env_id": f"stampede/{first.task}",
                "max_episode_steps": max(episode.frames - 1 for episode in self._episodes),
                "env_kwargs": {"action": self._options.action, "normalise_actions": True, "control_mode": control},
            },
            "episodes": episodes,
            "source_type": "motionplanning",
            "source_desc": "demonstrations of Stampede's task and motion planner",
        }


def _camera_columns(episode: StoredEpisode, options: argparse.Namespace) -> list[str]:
    cameras = cameras_of(episode, options)
    return [f"{camera}_camera_{what}" for camera in cameras for what in ("intrinsics", "extrinsics")]


def _pose(poses: Array) -> Array:
    """x y z, quaternion w x y z."""
    return poses[:, [0, 1, 2, 6, 3, 4, 5]]


def _actor(poses: Array) -> Array:
    """The same and velocities, n x 13."""
    return np.hstack([_pose(poses), np.zeros((len(poses), 6))])
