"""RLDS, the form of Open X-Embodiment: a folder that `tfds.builder_from_directory(FOLDER/NAME/1.0.0)` opens.

An episode is a record: `steps`, a dataset of its own, and `episode_metadata`. It has a step for each of its frames. As
RLDS has it, the last is what was observed in the end, and its action, reward and discount mean nothing: the reward of 1
is that of the step before. That action is to stay, so that it does no harm to a learner which takes it for one. Actions
are in rad or m and rotation vectors, the opening of the gripper in m last.

Beyond the convention a step has its skill (`skill`, `skill_arguments`, `skill_label`, `segment`), its `motion` and the
true `facts`. Poses of things, `environment_state`, are there where all episodes have the same things.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import re
import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from stampede.catalogue import StoredEpisode
from stampede.export import common_cameras, split_of
from stampede.export.pictures import png_files, size_of
from stampede.export.pieces import Pieces
from stampede.export.steps import ACTIONS, Array, Steps, check_names, known
from stampede.export.tfrecord import example, features, record
from stampede.faults import fault
from stampede.png import pillow

Json = dict[str, Any]

_VERSION = "1.0.0"
_SHARD_BYTES = 200e6
_SPLITS = {"train": "train", "valid": "val", "test": "test"}  # by our names
_IMAGES = {"front": "image", "wrist": "wrist_image"}  # those that most models look at
_THINGS = "environment_state"
_CLASSES = "tensorflow_datasets.core.features"

# Kind and meaning of single values: of a step, and of an episode.
_STEP = {
    "reward": ("float32", "1 where the action led to success, else 0"),
    "discount": ("float32", "0 where the action led to success, else 1"),
    "is_first": ("bool", ""),
    "is_last": ("bool", "its action, reward and discount mean nothing"),
    "is_terminal": ("bool", "the last of an episode that succeeded"),
    "language_instruction": ("text", "what the task is called"),
    "segment": ("int64", "place of the skill that runs among those of the episode, -1: none"),
    "skill": ("text", "its name"),
    "skill_arguments": ("text", "its arguments, with blanks between them"),
    "skill_label": ("text", "what it does, in words"),
    "motion": ("text", "name of the motion that runs inside of it"),
    "facts": ("text", "those that are true, as PDDL has them"),
}
_EPISODE = {
    "episode": ("int64", "number in the catalogue"),
    "key": ("text", "hash of all that the episode was made from"),
    "file_path": ("text", "name of the catalogue"),
    "task": ("text", ""),
    "variation": ("text", ""),
    "seed": ("int64", "-1: a real episode"),
    "split": ("text", "the catalogue's: train or test"),
    "source": ("text", "sim or real"),
    "success": ("bool", ""),
    "frame_hz": ("float32", "steps a second"),
    "instructions": ("text", "all wordings of the task, a JSON list"),
    "segments": ("text", "skills with their arguments and frames, a JSON list"),
}


class Writer:
    """Writes FOLDER/NAME/1.0.0. There is nothing of that name until all of it is there."""

    def __init__(self, folder: Path, options: argparse.Namespace, episodes: Sequence[StoredEpisode]) -> None:
        if not re.fullmatch(r"[a-z][a-z0-9_]*", options.name):
            raise fault("--name", f"'{options.name}' is no name of a dataset", "such as block_stacking")
        self._options, self._episodes = options, episodes
        self._final = folder / options.name / _VERSION
        self._pieces = Pieces(folder)
        self._cameras = common_cameras(episodes, options)
        if self._cameras:
            pillow("rlds")

    @staticmethod
    def add_arguments(parser: argparse.ArgumentParser) -> None:
        parser.add_argument("--name", default="stampede", help="of the dataset (default: %(default)s)")
        parser.add_argument("--action", choices=ACTIONS, default="joint_position", help="(default: %(default)s)")

    def has(self, episode: StoredEpisode) -> bool:
        return self._final.exists() or self._pieces.has(episode.id)

    def write(self, episode: StoredEpisode) -> None:
        steps = Steps(episode, ["facts", "motion"], self._options.channels)
        images = {camera: png_files(episode, camera) for camera in self._cameras}
        values: dict[str, Array | list[bytes]] = {_observed(_image(camera)): files for camera, files in images.items()}
        values |= {f"steps/{name}": column for name, column in _columns(steps, self._options.action).items()}
        values |= {_observed(name): rows.astype(np.float32) for name, rows in steps.channels.items()}
        values |= {f"episode_metadata/{name}": value for name, value in _about(steps).items()}
        things = known(steps.arrays["task_low_dim_state"]).astype(np.float32)
        described = {
            "sizes": {camera: sorted({size_of(file) for file in files}) for camera, files in images.items()},
            "state": [*steps.arrays.column("joint_positions").labels, "gripper"],
            "action": steps.action_names(self._options.action),
            "things": list(steps.arrays.column("task_low_dim_state").labels),
            "channels": steps.channel_names,
        }
        with self._pieces.making(episode.id) as piece:
            (piece / "features").write_bytes(features(values))
            (piece / "things").write_bytes(features({_observed(_THINGS): things}))
            (piece / "described.json").write_text(json.dumps(described))

    def finish(self) -> None:
        if not self._final.exists():
            partial = self._final.with_name(f"{_VERSION}.part")
            shutil.rmtree(partial, ignore_errors=True)
            partial.mkdir(parents=True)
            self._put_together(partial)
            partial.rename(self._final)
        self._pieces.remove()

    def close(self) -> None:
        """No file is open between two episodes."""

    def _put_together(self, folder: Path) -> None:
        described = [
            json.loads((self._pieces.of(episode.id) / "described.json").read_text()) for episode in self._episodes
        ]
        first = described[0]
        for episode, one in zip(self._episodes, described, strict=True):
            check_names(episode, one["channels"], first["channels"])
            check_names(episode, {"state": one["state"]}, {"state": first["state"]})
        same_things = all(one["things"] == first["things"] for one in described)
        parts = ["features", "things"] if same_things else ["features"]
        splits = []
        for ours, theirs in _SPLITS.items():
            chosen = [episode for episode in self._episodes if split_of(episode, self._options.valid) == ours]
            if chosen:
                splits.append(self._put_split(folder, theirs, sorted(chosen, key=_place), parts))
        sizes = {camera: [size for one in described for size in one["sizes"][camera]] for camera in self._cameras}
        things = first["things"] if same_things else []
        layout = _layout(first["state"], first["action"], things, sizes, first["channels"])
        info = {
            "name": self._options.name,
            "version": _VERSION,
            "description": "Demonstrations of Stampede's task and motion planner.",
            "fileFormat": "tfrecord",
            "splits": splits,
        }
        (folder / "features.json").write_text(json.dumps(layout, indent=2))
        (folder / "dataset_info.json").write_text(json.dumps(info, indent=2))

    def _put_split(self, folder: Path, split: str, episodes: list[StoredEpisode], parts: list[str]) -> Json:
        """Writes its shards; gives its entry in dataset_info.json."""
        shards: list[list[list[Path]]] = []
        size, total = 0, 0
        for episode in episodes:
            files = [self._pieces.of(episode.id) / part for part in parts]
            if not shards or size > _SHARD_BYTES:
                shards.append([])
                size = 0
            shards[-1].append(files)
            size += sum(file.stat().st_size for file in files)
        for number, shard in enumerate(shards):
            name = f"{self._options.name}-{split}.tfrecord-{number:05d}-of-{len(shards):05d}"
            with (folder / name).open("wb") as stream:
                for files in shard:
                    message = example(b"".join(file.read_bytes() for file in files))
                    stream.write(record(message))
                    total += len(message)
        return {
            "name": split,
            "shardLengths": [str(len(shard)) for shard in shards],
            "numBytes": str(total),
            "filepathTemplate": "{DATASET}-{SPLIT}.{FILEFORMAT}-{SHARD_X_OF_Y}",
        }


def _image(camera: str) -> str:
    return _IMAGES.get(camera, f"{camera}_image")


def _observed(name: str) -> str:
    return f"steps/observation/{name}"


def _place(episode: StoredEpisode) -> bytes:
    """By this they are in an order that has nothing to do with tasks, which readers expect of such files."""
    return hashlib.sha256(f"{episode.task} {episode.variation} {episode.seed} {episode.id}".encode()).digest()


def _columns(steps: Steps, action: str) -> dict[str, Array | list[bytes]]:
    """F rows each, but for pictures and things."""
    arrays, frames = steps.arrays, steps.episode.frames
    actions = steps.natural_actions(action)
    stay = actions[-1] if action == "joint_position" else np.append(np.zeros(actions.shape[1] - 1), actions[-1, -1])
    numbers = np.arange(frames)
    over = steps.episode.success & (numbers >= frames - 2)  # the step that led to the end, and the end
    segments = np.full(frames, -1)
    for place, skill in enumerate(steps.skills):
        segments[skill.first_frame : skill.end_frame] = place
    skills = [steps.skills[place] if place >= 0 else None for place in segments]
    motions = {one.id: one.name for one in arrays.segments}
    atoms = [str(atom) for atom in arrays.atoms]
    state = np.hstack([arrays["joint_positions"], arrays["gripper_opening"][:, None]])
    return {
        "observation/state": known(state).astype(np.float32),
        "observation/tool_pose": known(arrays["gripper_pose"]).astype(np.float32),
        "action": np.vstack([actions, stay]).astype(np.float32),
        "reward": np.append(steps.rewards, 0).astype(np.float32),
        "discount": (~over).astype(np.float32),
        "is_first": numbers == 0,
        "is_last": numbers == frames - 1,
        "is_terminal": steps.episode.success & (numbers == frames - 1),
        "language_instruction": [steps.instruction.encode()] * frames,
        "segment": segments,
        "skill": [one.name.encode() if one else b"" for one in skills],
        "skill_arguments": [" ".join(one.arguments).encode() if one else b"" for one in skills],
        "skill_label": [one.label.encode() if one else b"" for one in skills],
        "motion": [motions.get(int(motion), "").encode() for motion in arrays["motion"]],
        "facts": [" ".join(atoms[k] for k in np.flatnonzero(row)).encode() for row in arrays["facts"]],
    }


def _about(steps: Steps) -> dict[str, Array | list[bytes]]:
    """What is known of the episode. Readers repeat each value for all steps, so none is a list."""
    meta = steps.meta() | {"file_path": steps.episode.catalogue.path.name}
    meta |= {"seed": -1 if meta["seed"] is None else meta["seed"], "variation": meta["variation"] or ""}
    about: dict[str, Array | list[bytes]] = {}
    for name, (kind, _) in _EPISODE.items():
        value = json.dumps(meta[name]) if isinstance(meta[name], list) else meta[name]
        about[name] = [value.encode()] if kind == "text" else np.array([value], dtype=kind)
    return about


def _layout(
    state: list[str],
    action: list[str],
    things: list[str],
    sizes: dict[str, list[list[int]]],
    channels: dict[str, list[str]],
) -> Json:
    """features.json: how tfds is told what is in a record. sizes: height and width of each camera's pictures."""
    observation = {
        "state": _vector(state, "rad, and the opening of the gripper in m"),
        "tool_pose": _vector(["x", "y", "z", "qx", "qy", "qz", "qw"], "m, 1; world"),
        **{_image(camera): _picture(some) for camera, some in sizes.items()},
        **{name: _vector(labels, "as engine/episode/README.md has it") for name, labels in channels.items()},
    }
    if things:
        observation[_THINGS] = _vector(things, "m, 1 and rad; world")
    step = {
        "observation": _dict(observation),
        "action": _vector(action, "rad and m, the opening of the gripper in m"),
        **{name: _single(kind, description) for name, (kind, description) in _STEP.items()},
    }
    steps = {
        "pythonClassName": f"{_CLASSES}.dataset_feature.Dataset",
        "sequence": {"feature": _dict(step), "length": "-1"},
    }
    about = {name: _single(kind, description) for name, (kind, description) in _EPISODE.items()}
    return _dict({"steps": steps, "episode_metadata": _dict(about)})


def _dict(parts: Json) -> Json:
    return {"pythonClassName": f"{_CLASSES}.features_dict.FeaturesDict", "featuresDict": {"features": parts}}


def _vector(names: list[str], unit: str) -> Json:
    shape = {"dimensions": [str(len(names))]}
    return {
        "pythonClassName": f"{_CLASSES}.tensor_feature.Tensor",
        "tensor": {"shape": shape, "dtype": "float32", "encoding": "none"},
        "description": f"{', '.join(names)}: {unit}",
    }


def _single(kind: str, description: str) -> Json:
    if kind == "text":
        return {"pythonClassName": f"{_CLASSES}.text_feature.Text", "text": {}, "description": description}
    tensor = {"shape": {}, "dtype": kind, "encoding": "none"}
    return {"pythonClassName": f"{_CLASSES}.scalar.Scalar", "tensor": tensor, "description": description}


def _picture(sizes: list[list[int]]) -> Json:
    height, width = sizes[0] if all(size == sizes[0] for size in sizes) else (-1, -1)  # -1: any
    shape = {"dimensions": [str(height), str(width), "3"]}
    image = {"shape": shape, "dtype": "uint8", "encodingFormat": "png"}
    return {"pythonClassName": f"{_CLASSES}.image_feature.Image", "image": image}
