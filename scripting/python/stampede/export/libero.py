"""LIBERO's HDF5: a file a task and variation, with its keys, its order of steps and its attributes.

Differences that matter: pictures are upright (attribute `macros_image_convention` is `opencv`; LIBERO's own are
rotated by 180 degrees); nothing is cut from the beginning; `states` are ours, with their names in `state_names`.
"""

from __future__ import annotations

import argparse
import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from stampede.catalogue import StoredEpisode
from stampede.export import cameras_of
from stampede.export.hdf5 import DemoFiles, add_action_argument, put_pictures
from stampede.export.steps import Steps, rotation_vectors

# LIBERO's names of the two cameras that its policies look through.
_CAMERAS = {"front": "agentview_rgb", "wrist": "eye_in_hand_rgb"}


class Writer:
    """Writes FOLDER/TASK_VARIATION_demo.hdf5, one for each."""

    def __init__(self, folder: Path, options: argparse.Namespace, episodes: Sequence[StoredEpisode]) -> None:
        self._options = options
        self._demos = DemoFiles(folder, episodes, [_file_name(episode) for episode in episodes])

    @staticmethod
    def add_arguments(parser: argparse.ArgumentParser) -> None:
        add_action_argument(parser)

    def has(self, episode: StoredEpisode) -> bool:
        return self._demos.has(episode)

    def write(self, episode: StoredEpisode) -> None:
        steps = Steps(episode)
        data = self._demos.data(episode)
        if "env_name" not in data.attrs:
            self._describe(data, steps)
        demo = self._demos.begin(episode)
        demo.attrs["num_samples"] = steps.count
        demo.attrs["ep_meta"] = json.dumps(steps.meta())
        pose = steps.observed("gripper_pose")
        fingers = steps.observed("gripper_joint_positions")
        states = np.hstack([steps.observed("joint_positions"), fingers, steps.observed("task_low_dim_state")])
        demo.attrs["init_state"] = states[0]
        demo.create_dataset("actions", data=steps.actions(self._options.action).astype(np.float64))
        demo.create_dataset("states", data=states)
        # Fingers, then the tool's position and quaternion x y z w.
        demo.create_dataset("robot_states", data=np.hstack([fingers, pose]))
        last = np.zeros(steps.count, dtype=np.uint8)
        last[-1] = 1
        demo.create_dataset("rewards", data=steps.success.astype(np.uint8))
        demo.create_dataset("dones", data=last)
        turned = rotation_vectors(np.tile([0.0, 0.0, 0.0, 1.0], (steps.count, 1)), pose[:, 3:])
        observed = demo.create_group("obs")
        observed.create_dataset("gripper_states", data=fingers)
        observed.create_dataset("joint_states", data=steps.observed("joint_positions"))
        observed.create_dataset("ee_states", data=np.hstack([pose[:, :3], turned]))
        observed.create_dataset("ee_pos", data=pose[:, :3])
        observed.create_dataset("ee_ori", data=turned)
        for camera in cameras_of(episode, self._options):
            pictures = episode.pictures(f"{camera}_rgb", range(steps.count), draw=self._options.draw)
            put_pictures(observed, _CAMERAS.get(camera, f"{camera}_rgb"), pictures)
        self._demos.end(episode)

    def finish(self) -> None:
        self._demos.finish(lambda file, episodes: file["data"].attrs.__setitem__("num_demos", len(episodes)))

    def close(self) -> None:
        self._demos.close()

    def _describe(self, data: Any, steps: Steps) -> None:
        episode = steps.episode
        lower, upper = steps.bounds(self._options.action)
        names = [
            f"{column}/{label}"
            for column in ("joint_positions", "gripper_joint_positions", "task_low_dim_state")
            for label in steps.arrays.column(column).labels
        ]
        bddl = episode.catalogue.query(
            "SELECT text FROM problems WHERE episode = ?1 AND kind = 'bddl_libero'", episode.id
        ).values("text")
        environment = {"type": 2, "env_type": 2, "env_name": f"stampede/{episode.task}", "env_kwargs": {}}
        attributes = {
            "env_name": f"stampede/{episode.task}",
            "env_args": json.dumps(environment),
            "problem_info": json.dumps(
                {
                    "problem_name": episode.task,
                    "domain_name": episode.task,
                    "language_instruction": steps.instruction,
                    "variation": episode.variation,
                }
            ),
            "bddl_file_name": f"{episode.task}.bddl",
            "bddl_file_content": str(bddl[0]) if bddl else "",
            "macros_image_convention": "opencv",
            "tag": "stampede",
            "action_space": self._options.action,
            "action_names": steps.action_names(self._options.action),
            "action_lower": [*lower, 0.0],
            "action_upper": [*upper, 0.08],
            "state_names": names,
        }
        for name, value in attributes.items():
            data.attrs[name] = value


def _file_name(episode: StoredEpisode) -> str:
    words = re.sub(r"[^a-z0-9]+", "_", f"{episode.task} {episode.variation}".lower()).strip("_")
    return f"{words}_demo.hdf5"
