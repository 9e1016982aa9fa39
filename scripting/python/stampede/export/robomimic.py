"""robomimic's HDF5: a file a task, a group a demo, and filter keys for the splits.

Attributes say what is in it: `data.attrs["env_args"]` the environment, each demo's `ep_meta` our labels (task,
variation, seed, sentences, skill segments), `action_names`, `action_lower` and `action_upper` what -1 and 1 stand for,
`state_names`. `action_dict` has the actions once more in rad and m, by robomimic's names for parts of them.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from stampede.catalogue import StoredEpisode
from stampede.export import common_cameras, split_of
from stampede.export.hdf5 import (
    Demo,
    DemoFiles,
    Facts,
    add_action_argument,
    environment_of,
    put_pictures,
    scale_of,
)
from stampede.export.steps import Array, Steps, known, matrices, rotation_vectors

# robomimic's and robosuite's name for a column of ours.
_OBSERVED = {
    "robot0_joint_pos": "joint_positions",
    "robot0_joint_vel": "joint_velocities",
    "robot0_gripper_qpos": "gripper_joint_positions",
    "robot0_gripper_qvel": "gripper_joint_velocities",
    "object": "task_low_dim_state",
}


class Writer:
    """Writes FOLDER/TASK.hdf5."""

    def __init__(self, folder: Path, options: argparse.Namespace, episodes: Sequence[StoredEpisode]) -> None:
        self._options = options
        self._demos = DemoFiles(folder, episodes, [f"{episode.task}.hdf5" for episode in episodes])
        self._cameras = {name: common_cameras(some, options) for name, some in self._demos.episodes.items()}

    @staticmethod
    def add_arguments(parser: argparse.ArgumentParser) -> None:
        add_action_argument(parser)
        parser.add_argument("--next-obs", action="store_true", help="also the observation after each action")

    def has(self, episode: StoredEpisode) -> bool:
        return self._demos.has(episode)

    def write(self, episode: StoredEpisode) -> None:
        steps = Steps(episode, self.columns(episode), self._options.channels)
        states, names = _states(steps)
        shared = {**scale_of(steps, self._options.action), "state_names": names}
        with self._demos.making(episode, shared, self.facts(steps)) as demo:
            demo.attrs["num_samples"] = steps.count
            demo.attrs["ep_meta"] = json.dumps(steps.meta())
            demo.create_dataset("actions", data=steps.actions(self._options.action))
            demo.create_dataset("actions_abs", data=steps.natural_actions("joint_position"))
            parts = demo.create_group("action_dict")
            for name, values in _action_parts(steps).items():
                parts.create_dataset(name, data=values)
            demo.create_dataset("states", data=states)
            demo.create_dataset("rewards", data=steps.rewards)
            demo.create_dataset("dones", data=steps.success.astype(np.int64))
            self._put_observations(demo, steps)
            self.write_more(demo, steps)

    def finish(self) -> None:
        self._demos.finish(self.complete)

    def close(self) -> None:
        """Nothing is open between two episodes."""

    def columns(self, episode: StoredEpisode) -> list[str]:
        """What `write_more` needs to be read."""
        return []

    def facts(self, steps: Steps) -> Facts:
        """What `complete` is told of the episode."""
        return {}

    def write_more(self, demo: Any, steps: Steps) -> None:
        """What a format that extends this one adds to a demo."""

    def complete(self, file: Any, name: str, demos: list[Demo], shared: Facts) -> None:
        """What is said of all demos of a file."""
        data = file["data"]
        for key, value in shared.items():
            data.attrs[key] = value
        data.attrs["total"] = sum(demo.episode.frames - 1 for demo in demos)
        data.attrs["env_args"] = json.dumps(environment_of(demos[0].episode.task, self._options.action))
        for split in ("train", "valid", "test"):
            names = [demo.name for demo in demos if split_of(demo.episode, self._options.valid) == split]
            if names:
                put_filter(file, split, names)

    def _put_observations(self, demo: Any, steps: Steps) -> None:
        episode = steps.episode
        parts = {"obs": slice(0, -1)}
        if self._options.next_obs:
            parts["next_obs"] = slice(1, None)
        observed = _observed(steps)
        for which, part in parts.items():
            group = demo.create_group(which)
            for name, values in observed.items():
                group.create_dataset(name, data=values[part])
        for camera in self._cameras[self._demos.file_of(episode)]:
            pictures = episode.pictures(f"{camera}_rgb", draw=self._options.draw)
            for which, part in parts.items():
                put_pictures(demo[which], f"{camera}_image", pictures[part])


def put_filter(file: Any, name: str, demos: Sequence[str]) -> None:
    """A filter key: names of demos that belong together."""
    file.create_dataset(f"mask/{name}", data=np.array(demos, dtype="S"))


def _observed(steps: Steps) -> dict[str, Array]:
    """Numbers at all frames, by robomimic's names."""
    pose = known(steps.arrays["gripper_pose"])
    observed = {name: known(steps.arrays[column]) for name, column in _OBSERVED.items()}
    observed = {name: rows for name, rows in observed.items() if rows.shape[1]}  # no things of a real one
    return {**observed, "robot0_eef_pos": pose[:, :3], "robot0_eef_quat": pose[:, 3:], **steps.channels}


def _action_parts(steps: Steps) -> dict[str, Array]:
    """Parts of the actions in rad and m; poses and their changes in the world. Six values a rotation: the matrix's
    first two rows, as robomimic converts them."""
    target = steps.commanded_tool[1:]
    moved = steps.natural_actions("tool_delta")[:, :6]
    unturned = np.broadcast_to([0.0, 0.0, 0.0, 1.0], (steps.count, 4))
    return {
        "joint_position": steps.commanded_joints[1:],
        "joint_delta": np.diff(steps.commanded_joints, axis=0),
        "abs_pos": target[:, :3],
        "abs_rot_axis_angle": rotation_vectors(unturned, target[:, 3:]),
        "abs_rot_6d": matrices(target)[:, :2, :3].reshape(-1, 6),
        "rel_pos": moved[:, :3],
        "rel_rot_axis_angle": moved[:, 3:],
        "gripper": steps.gripper[:, None],
    }


def _states(steps: Steps) -> tuple[Array, list[str]]:
    """Joint positions and velocities of the robot, then poses and joints of all things; with their names."""
    parts, names = [], []
    for column in ("joint_positions", "joint_velocities", "gripper_joint_positions", "task_low_dim_state"):
        parts.append(steps.observed(column))
        names += [f"{column}/{label}" for label in steps.arrays.column(column).labels]
    return np.hstack(parts), names
