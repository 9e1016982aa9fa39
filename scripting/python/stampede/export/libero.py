"""LIBERO's HDF5: a file a task and variation, with its keys, its order of steps and its attributes.

Differences that matter: pictures are upright (attribute `macros_image_convention` is `opencv`; LIBERO's own are
rotated by 180 degrees); nothing is cut from the beginning; `states` are ours, with their names in `state_names`.
`bddl_file_content` is what `stampede export bddl --dialect libero --leave-out hand_empty` writes of the first demo's
start; where LIBERO has no words for the goal it is empty, and `bddl_refusal` says why.
"""

from __future__ import annotations

import argparse
import json
import re
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from stampede import program
from stampede.catalogue import StoredEpisode
from stampede.export import common_cameras
from stampede.export.hdf5 import (
    Demo,
    DemoFiles,
    Facts,
    add_action_argument,
    environment_of,
    put_pictures,
    scale_of,
)
from stampede.export.steps import Steps, rotation_vectors
from stampede.file_names import file_name

# LIBERO's names of the two cameras that its policies look through.
_CAMERAS = {"front": "agentview_rgb", "wrist": "eye_in_hand_rgb"}

_STATES = ("joint_positions", "gripper_joint_positions", "task_low_dim_state")


class Writer:
    """Writes FOLDER/TASK_VARIATION_demo.hdf5, one for each."""

    def __init__(self, folder: Path, options: argparse.Namespace, episodes: Sequence[StoredEpisode]) -> None:
        self._options = options
        self._demos = DemoFiles(folder, episodes, _file_names(episodes))
        self._cameras = {name: common_cameras(some, options) for name, some in self._demos.episodes.items()}

    @staticmethod
    def add_arguments(parser: argparse.ArgumentParser) -> None:
        add_action_argument(parser)

    def has(self, episode: StoredEpisode) -> bool:
        return self._demos.has(episode)

    def write(self, episode: StoredEpisode) -> None:
        steps = Steps(episode, channels=self._options.channels)
        pose = steps.observed("gripper_pose")
        fingers = steps.observed("gripper_joint_positions")
        states = np.hstack([steps.observed(column) for column in _STATES])
        names = [f"{column}/{label}" for column in _STATES for label in steps.arrays.column(column).labels]
        shared = {**scale_of(steps, self._options.action), "state_names": names}
        unturned = np.broadcast_to([0.0, 0.0, 0.0, 1.0], (steps.count, 4))
        turned = rotation_vectors(unturned, pose[:, 3:])
        last = np.zeros(steps.count, dtype=np.uint8)
        last[-1] = 1
        with self._demos.making(episode, shared, {"instruction": steps.instruction}) as demo:
            demo.attrs["num_samples"] = steps.count
            demo.attrs["ep_meta"] = json.dumps(steps.meta())
            demo.attrs["init_state"] = states[0]
            demo.create_dataset("actions", data=steps.actions(self._options.action).astype(np.float64))
            demo.create_dataset("states", data=states)
            # Fingers, then the tool's position and quaternion x y z w.
            demo.create_dataset("robot_states", data=np.hstack([fingers, pose]))
            demo.create_dataset("rewards", data=steps.success.astype(np.uint8))
            demo.create_dataset("dones", data=last)
            observed = demo.create_group("obs")
            observed.create_dataset("gripper_states", data=fingers)
            observed.create_dataset("joint_states", data=steps.observed("joint_positions"))
            observed.create_dataset("ee_states", data=np.hstack([pose[:, :3], turned]))
            observed.create_dataset("ee_pos", data=pose[:, :3])
            observed.create_dataset("ee_ori", data=turned)
            for name, values in steps.channels.items():
                observed.create_dataset(name, data=values[:-1])
            for camera in self._cameras[self._demos.file_of(episode)]:
                pictures = episode.pictures(f"{camera}_rgb", range(steps.count), draw=self._options.draw)
                put_pictures(observed, _CAMERAS.get(camera, f"{camera}_rgb"), pictures)

    def finish(self) -> None:
        self._problems = _problems([episodes[0] for episodes in self._demos.episodes.values()])
        self._demos.finish(self._complete)

    def close(self) -> None:
        """Nothing is open between two episodes."""

    def _complete(self, file: Any, name: str, demos: list[Demo], shared: Facts) -> None:
        episode = demos[0].episode
        problem = {
            "problem_name": episode.task,
            "domain_name": episode.task,
            "language_instruction": demos[0].facts["instruction"],
            "variation": episode.variation or "",
        }
        attributes = {
            **shared,
            **self._problems[episode.id],
            "env_name": f"stampede/{episode.task}",
            "env_args": json.dumps(environment_of(episode.task, self._options.action)),
            "problem_info": json.dumps(problem),
            "macros_image_convention": "opencv",
            "num_demos": len(demos),
            "tag": "stampede",
            "total": sum(demo.episode.frames - 1 for demo in demos),
        }
        for key, value in attributes.items():
            file["data"].attrs[key] = value


def _problems(episodes: Sequence[StoredEpisode]) -> dict[int, dict[str, str]]:
    """Attributes that say each episode's problem in LIBERO's dialect of BDDL, by episode."""
    with tempfile.TemporaryDirectory() as folder:
        command = ["export", "bddl", str(episodes[0].catalogue.path), "--out", folder]
        command += ["--dialect", "libero", "--leave-out", "hand_empty"]
        for episode in episodes:
            command += ["--episode", str(episode.id)]
        ran = program.call(*command)
        index = Path(folder) / "index.json"
        rows = {row["episode"]: row for row in json.loads(index.read_text())} if index.exists() else {}
        problems = {}
        for episode in episodes:
            row = rows.get(episode.id, {"file": "", "refusal": ran.stderr.strip()})
            name = Path(row["file"]).name or f"{episode.task}.bddl"
            text = (Path(folder) / row["file"]).read_text() if row["file"] else ""
            problems[episode.id] = {"bddl_file_name": name, "bddl_file_content": text}
            if not text:
                problems[episode.id]["bddl_refusal"] = row["refusal"]
    return problems


def _file_names(episodes: Sequence[StoredEpisode]) -> list[str]:
    """A name for each task and variation; a number tells apart those whose letters and digits are the same."""
    names: dict[tuple[str, str], str] = {}
    for episode in episodes:
        words = re.sub(r"[^a-z0-9]+", "_", f"{episode.task} {episode.variation or ''}".lower()).strip("_")
        kind = (episode.task, episode.variation)
        if kind not in names:
            taken = set(names.values())
            candidates = [words, *(f"{words}_{number}" for number in range(2, len(taken) + 3))]
            names[kind] = next(name for name in candidates if name not in taken)
    return [f"{file_name(names[episode.task, episode.variation])}_demo.hdf5" for episode in episodes]
