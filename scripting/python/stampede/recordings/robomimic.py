"""robomimic's HDF5 to recording folders, one a demo.

A row is at its number divided by the rate that `env_args` says (control_freq), our exporter's `ep_meta` (frame_hz), or
`--rate`. Pictures are `obs/NAME_image`, depth `obs/NAME_depth` in m.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede.export.hdf5 import library
from stampede.faults import fault
from stampede.recordings import rows as steps
from stampede.recordings.folder import FolderWriter
from stampede.recordings.given import Given
from stampede.recordings.pictures import packed
from stampede.recordings.roles import camera_name
from stampede.recordings.rows import Rows

Array = NDArray[Any]
Json = dict[str, Any]

_POSITIONS = ("robot0_joint_pos", "joint_positions", "joint_pos")
_VELOCITIES = ("robot0_joint_vel", "joint_velocities", "joint_vel")
_EFFORTS = ("robot0_joint_torques", "joint_forces", "joint_effort")
_GRIPPERS = ("robot0_gripper_qpos", "gripper_qpos")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    steps.add_arguments(parser)
    parser.add_argument(
        "--rate", type=float, default=0, metavar="HZ", help="steps a second, where the file does not say it"
    )


def convert(given: Given, options: argparse.Namespace) -> list[Path]:
    """Raises Error for what is no such file, and for another robot."""
    h5py = library()
    folders = []
    try:
        with h5py.File(options.source, "r") as file:
            if "data" not in file or not len(file["data"]):
                raise fault(options.source, "it has no group `data` with demos", "name a file of robomimic's form")
            names = sorted(file["data"], key=lambda name: int(name.rpartition("_")[2]) if name[-1].isdigit() else 0)
            numbers = steps.numbers_of(options.episodes, len(names), options.source)
            for number in numbers:
                path = steps.folder_of(given, number, len(numbers))
                path.parent.mkdir(parents=True, exist_ok=True)
                with FolderWriter(path, options.skip_bad) as folder:
                    _write(folder, file["data"], names[number], given, options)
                folders.append(path)
    except OSError as error:
        raise fault(options.source, f"it cannot be read, ends early or is damaged: {error}", "copy it again") from error
    given.tell(f"{len(folders)} demos of {options.source}")
    return folders


def _write(folder: FolderWriter, data: Any, name: str, given: Given, options: argparse.Namespace) -> None:
    demo = data[name]
    place = f"{options.source}, {name}"
    if "obs" not in demo:
        raise fault(place, "it has no observations", "make them with robomimic's dataset_states_to_obs.py")
    meta = json.loads(demo.attrs.get("ep_meta", "{}"))
    rate = _rate(data, meta, options, place)
    rows = _rows(demo["obs"], rate, given, options, place)
    rows.labels = _labels(meta, rate)
    if "action_dict/joint_position" in demo:  # rad, as our exporter writes them
        command = np.asarray(demo["action_dict/joint_position"], dtype=float)
        rows.command = command if command.shape == rows.position.shape else None
    steps.write_numbers(folder, rows, given.robot.arm)
    for key in demo["obs"]:
        camera = camera_name(key.rpartition("_")[0])
        if key.endswith("_image"):
            steps.write_pictures(
                folder, "rgb", camera, _colours(demo["obs"][key], rows, f"{place}, {key}"), f"{place}, {key}"
            )
        elif key.endswith("_depth"):
            files = _depths(demo["obs"][key], rows)
            steps.write_pictures(folder, "depth", camera, files, f"{place}, {key}", unit_m=0.001, near_m=0.1, far_m=6.5)
    about = {"task": meta.get("task", ""), "success": str(meta.get("success", True)), "frame_hz": rate}
    steps.finish(folder, given, rows, about, f"{options.source}, {name}")


def _rate(data: Any, meta: Json, options: argparse.Namespace, place: str) -> float:
    arguments = json.loads(data.attrs.get("env_args", "{}")).get("env_kwargs", {})
    rate = float(options.rate or arguments.get("control_freq") or meta.get("frame_hz") or 0)
    if not rate > 0:
        raise fault(place, "it does not say how many steps a second it has", "--rate 20")
    return rate


def _rows(obs: Any, rate: float, given: Given, options: argparse.Namespace, place: str) -> Rows:
    arm = given.robot.arm
    unit = np.pi / 180 if options.degrees else 1.0

    def found(keys: tuple[str, ...]) -> Array | None:
        key = next((one for one in keys if one in obs), None)
        return None if key is None else np.asarray(obs[key], dtype=float)

    position = found(_POSITIONS)
    if position is None:
        raise fault(f"{place}/obs", f"none of {', '.join(_POSITIONS)} is there", f"it has {', '.join(obs)}")
    if position.shape[1] != len(arm):
        raise fault(
            place, f"it has {position.shape[1]} joints, the arm {len(arm)}: another robot", "--robot names another one"
        )
    rows = Rows([round(k * 1e9 / rate) for k in range(len(position))], position * unit, place=place)
    velocity, effort, gripper = found(_VELOCITIES), found(_EFFORTS), found(_GRIPPERS)
    rows.velocity = None if velocity is None else velocity * unit
    rows.effort = effort
    if gripper is not None:  # robosuite's fingers open to both sides of 0
        rows.opening = np.abs(gripper).sum(axis=1)
    return rows


def _labels(meta: Json, rate: float) -> Json:
    segments = [
        {
            "kind": "skill",
            "name": steps.name_of(one["skill"]),
            "arguments": one.get("arguments", []),
            "label": one.get("label", ""),
            "start_s": one["first_frame"] / rate,
            "end_s": one["end_frame"] / rate,
            "outcome": "success" if one.get("success", True) else "failure",
        }
        for one in meta.get("segments", [])
    ]
    language = [{"level": "task", "text": text} for text in meta.get("instructions", [meta.get("lang")]) if text]
    if not segments and not language:
        return {}
    return {"labelled_by": "model" if segments else "person", "segments": segments, "language": language}


def _colours(pictures: Any, rows: Rows, place: str) -> Iterator[tuple[int, bytes, str]]:
    if (
        pictures.dtype != np.uint8
        or pictures.ndim != 4
        or pictures.shape[3] != 3
        or len(pictures) != len(rows.stamps_ns)
    ):
        raise fault(
            place,
            f"pictures of shape {pictures.shape} and type {pictures.dtype} are not read",
            "store n x h x w x 3 uint8",
        )
    for stamp, picture in zip(rows.stamps_ns, pictures, strict=True):
        yield stamp, packed(picture), "png"


def _depths(pictures: Any, rows: Rows) -> Iterator[tuple[int, bytes, str]]:
    for stamp, picture in zip(rows.stamps_ns, pictures, strict=True):
        mm = np.nan_to_num(np.squeeze(np.asarray(picture, dtype=float)) * 1000, nan=0.0, posinf=0.0, neginf=0.0)
        yield stamp, packed(np.where(mm < 65535.5, np.round(mm), 0).astype(np.uint16)), "png"
