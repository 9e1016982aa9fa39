"""HDF5 of robomimic, LIBERO and DROID to recording folders, one a demo.

A row is at its number divided by the rate that `env_args` says (control_freq), our exporter's `ep_meta` (frame_hz), or
`--rate`. Pictures are `obs/NAME_image` (LIBERO: `obs/NAME_rgb`, which are upside down where the file says so), depth
`obs/NAME_depth` in m. A trajectory.h5 of DROID is one demo, by its own clock; its pictures are in other files.
"""

from __future__ import annotations

import argparse
import json
import re
from collections.abc import Iterator, Sequence
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

# Behind `robot0_`, `robot1_` … or nothing: robosuite's names, ours, LIBERO's.
_POSITIONS = ("joint_pos", "joint_positions", "joint_states")
_VELOCITIES = ("joint_vel", "joint_velocities")
_EFFORTS = ("joint_torques", "joint_forces", "joint_effort")
_GRIPPERS = ("gripper_qpos", "gripper_states")
_OPENGL = "opengl"  # of LIBERO's `macros_image_convention`: the lowest row comes first
_DROID_STATE = "observation/robot_state"
_DROID_HZ = 15.0
_DROID_OPENING_M = 0.085  # of its hand, a Robotiq 2F-85; `gripper_position` is 0 there, and 1 where it is shut


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
            if _DROID_STATE in file:
                return [_write_droid(file, given, options)]
            if "data" not in file or not len(file["data"]):
                cure = "name a file of robomimic, LIBERO or DROID"
                raise fault(options.source, "it has no group `data` with demos", cure)
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
    meta = {"lang": _libero_sentence(data), **meta}
    rate = _rate(data, meta, options, place)
    rows = _rows(demo["obs"], rate, given, options, place)
    rows.labels = _labels(meta, rate)
    if "action_dict/joint_position" in demo:  # rad, as our exporter writes them
        command = np.asarray(demo["action_dict/joint_position"], dtype=float)
        rows.command = command if command.shape == rows.position.shape else None
    steps.write_numbers(folder, rows, given.robot.arm)
    for key in demo["obs"]:
        camera = camera_name(key.rpartition("_")[0])
        if key.endswith(("_image", "_rgb")):
            upside_down = key.endswith("_rgb") and data.attrs.get("macros_image_convention") == _OPENGL
            pictures = _colours(demo["obs"][key], rows, f"{place}, {key}", upside_down)
            steps.write_pictures(folder, "rgb", camera, pictures, f"{place}, {key}")
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

    prefix = _robot(obs, options.prefix, place)

    def found(keys: tuple[str, ...]) -> Array | None:
        key = next((prefix + one for one in keys if prefix + one in obs), None)
        return None if key is None else np.asarray(obs[key], dtype=float)

    position = found(_POSITIONS)
    if position is None:
        raise fault(f"{place}/obs", f"none of {', '.join(_POSITIONS)} is there", f"it has {', '.join(obs)}")
    _check_joints(position, arm, place)
    rows = Rows([round(k * 1e9 / rate) for k in range(len(position))], position * unit, place=place)
    velocity, effort, gripper = found(_VELOCITIES), found(_EFFORTS), found(_GRIPPERS)
    rows.velocity = None if velocity is None else velocity * unit
    rows.effort = effort
    if gripper is not None:  # robosuite's fingers open to both sides of 0
        rows.opening = np.abs(gripper).sum(axis=1)
    return rows


def _robot(obs: Any, wanted: str | None, place: str) -> str:
    """What stands before the keys of the robot: `robot0_`, or nothing."""
    prefixes = {key.removesuffix(end) for key in obs for end in _POSITIONS if key.endswith(end)}
    prefixes = sorted(one for one in prefixes if re.fullmatch(r"(robot\d+_)?", one) and wanted in (None, one))
    if len(prefixes) > 1:
        several = ", ".join(f"'{one}'" for one in prefixes)
        raise fault(place, f"it has several arms, with the prefixes {several}", f"--prefix {prefixes[-1]}")
    return prefixes[0] if prefixes else wanted or ""


def _check_joints(position: Array, arm: Sequence[str], place: str) -> None:
    if position.ndim != 2 or position.shape[1] != len(arm):
        count = position.shape[1] if position.ndim == 2 else 1
        raise fault(place, f"it has {count} joints, the arm {len(arm)}: another robot", "--robot names another one")


def _libero_sentence(data: Any) -> str | None:
    """What LIBERO's `problem_info` says, in whose files all demos are of one task."""
    said = json.loads(data.attrs.get("problem_info", "{}")).get("language_instruction")
    return "".join(said) if said else None


def _write_droid(file: Any, given: Given, options: argparse.Namespace) -> Path:
    """One trajectory.h5 of DROID's raw recordings."""
    state, place = file[_DROID_STATE], options.source
    position = np.asarray(state["joint_positions"], dtype=float)
    _check_joints(position, given.robot.arm, place)
    rows = Rows(_droid_stamps(file, len(position), options.rate), position, place=place)
    for name, key in (("velocity", "joint_velocities"), ("effort", "motor_torques_measured")):
        if key in state:
            setattr(rows, name, np.asarray(state[key], dtype=float))
    if "gripper_position" in state:
        rows.opening = (1.0 - np.ravel(np.asarray(state["gripper_position"], dtype=float))) * _DROID_OPENING_M
    if "action/joint_position" in file:
        command = np.asarray(file["action/joint_position"], dtype=float)
        rows.command = command if command.shape == position.shape else None
    task = str(file.attrs.get("current_task", ""))
    if task:
        rows.labels = {"labelled_by": "person", "segments": [], "language": [{"level": "task", "text": task}]}
    with FolderWriter(given.out, options.skip_bad) as folder:
        steps.write_numbers(folder, rows, given.robot.arm)
        success = bool(file.attrs.get("success", "success" in Path(place).parts))
        about = {"task": steps.name_of(task) if task else "", "success": str(success), "frame_hz": _DROID_HZ}
        steps.finish(folder, given, rows, about, place)
    given.tell(f"1 demo of {place}, without pictures: DROID keeps them beside it, as films")
    return given.out


def _droid_stamps(file: Any, count: int, rate: float) -> list[int]:
    """Those of the robot, ns; where it has none, or `--rate` is given, even ones."""
    clock = "observation/timestamp/robot_state/robot_timestamp_"
    if rate or clock + "seconds" not in file:
        return [round(k * 1e9 / (rate or _DROID_HZ)) for k in range(count)]
    seconds, nanos = (np.asarray(file[clock + part], dtype=np.int64) for part in ("seconds", "nanos"))
    return (seconds * 10**9 + nanos).tolist()


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


def _colours(pictures: Any, rows: Rows, place: str, upside_down: bool) -> Iterator[tuple[int, bytes, str]]:
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
        yield stamp, packed(picture[::-1] if upside_down else picture), "png"


def _depths(pictures: Any, rows: Rows) -> Iterator[tuple[int, bytes, str]]:
    for stamp, picture in zip(rows.stamps_ns, pictures, strict=True):
        mm = np.nan_to_num(np.squeeze(np.asarray(picture, dtype=float)) * 1000, nan=0.0, posinf=0.0, neginf=0.0)
        yield stamp, packed(np.where(mm < 65535.5, np.round(mm), 0).astype(np.uint16)), "png"
