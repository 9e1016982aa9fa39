"""robomimic's HDF5: a file a task, a group a demo, and filter keys for the splits.

Attributes say what is in it: `data.attrs["env_args"]` the environment, each demo's `ep_meta` our labels (task,
variation, seed, sentences, skill segments), `action_names`, `action_lower` and `action_upper` what -1 and 1 stand for,
`state_names`.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from stampede.catalogue import StoredEpisode
from stampede.export import cameras_of, split_of
from stampede.export.hdf5 import DemoFiles, add_action_argument, put_pictures
from stampede.export.steps import OPENING, Array, Steps, known

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

    @staticmethod
    def add_arguments(parser: argparse.ArgumentParser) -> None:
        add_action_argument(parser)
        parser.add_argument("--next-obs", action="store_true", help="also the observation after each action")

    def has(self, episode: StoredEpisode) -> bool:
        return self._demos.has(episode)

    def write(self, episode: StoredEpisode) -> None:
        steps = Steps(episode, self.columns(episode))
        demo = self._demos.begin(episode)
        demo.attrs["num_samples"] = steps.count
        demo.attrs["ep_meta"] = json.dumps(steps.meta())
        demo.create_dataset("actions", data=steps.actions(self._options.action))
        demo.create_dataset("actions_abs", data=steps.natural_actions("joint_position"))
        states, names = _states(steps)
        demo.create_dataset("states", data=states)
        demo.create_dataset("rewards", data=steps.rewards)
        demo.create_dataset("dones", data=steps.success.astype(np.int64))
        observed = _observed(steps)
        cameras = cameras_of(episode, self._options)
        for which, part in (("obs", slice(0, -1)), ("next_obs", slice(1, None)))[: 1 + self._options.next_obs]:
            group = demo.create_group(which)
            for name, values in observed.items():
                group.create_dataset(name, data=values[part])
        for camera in cameras:
            pictures = episode.pictures(f"{camera}_rgb", draw=self._options.draw)
            put_pictures(demo["obs"], f"{camera}_image", pictures[:-1])
            if self._options.next_obs:
                put_pictures(demo["next_obs"], f"{camera}_image", pictures[1:])
        data = self._demos.data(episode)
        self.write_more(demo, data, steps)
        if "action_names" not in data.attrs:
            lower, upper = steps.bounds(self._options.action)
            data.attrs["action_space"] = self._options.action
            data.attrs["action_names"] = steps.action_names(self._options.action)
            data.attrs["action_lower"] = [*lower, 0.0]
            data.attrs["action_upper"] = [*upper, OPENING]
            data.attrs["state_names"] = names
        self._demos.end(episode)

    def finish(self) -> None:
        self._demos.finish(self._complete)

    def close(self) -> None:
        self._demos.close()

    def columns(self, episode: StoredEpisode) -> list[str]:
        """What `write_more` needs to be read."""
        return []

    def write_more(self, demo: Any, data: Any, steps: Steps) -> None:
        """What a format that extends this one adds to a demo, and to the group of all."""

    def _complete(self, file: Any, episodes: list[StoredEpisode]) -> None:
        name = f"stampede/{episodes[0].task}"
        arguments = {"action": self._options.action, "normalise_actions": True}
        # Readers look for one key or the other; 2 is their number for environments of Gym.
        environment = {"env_name": name, "type": 2, "env_type": 2, "env_kwargs": arguments}
        file["data"].attrs["env_args"] = json.dumps(environment)
        mask = file.require_group("mask")
        for split in ("train", "valid", "test"):
            names = [self._demos.demo_name(e) for e in episodes if split_of(e, self._options.valid) == split]
            if names and split not in mask:
                mask.create_dataset(split, data=np.array(names, dtype="S"))


def _observed(steps: Steps) -> dict[str, Array]:
    """Numbers at all frames, by robomimic's names."""
    pose = steps.arrays["gripper_pose"]
    observed = {name: known(steps.arrays[column]) for name, column in _OBSERVED.items()}
    return {**observed, "robot0_eef_pos": pose[:, :3], "robot0_eef_quat": pose[:, 3:]}


def _states(steps: Steps) -> tuple[Array, list[str]]:
    """Joint positions and velocities of the robot, then poses and joints of all things; with their names."""
    parts, names = [], []
    for column in ("joint_positions", "joint_velocities", "gripper_joint_positions", "task_low_dim_state"):
        parts.append(steps.observed(column))
        names += [f"{column}/{label}" for label in steps.arrays.column(column).labels]
    return np.hstack(parts), names
