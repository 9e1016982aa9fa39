"""HDF5 of robomimic, LIBERO and DROID to recording folders, one a demo.

A row is at its number divided by the rate that `env_args` says (control_freq), our exporter's `ep_meta` (frame_hz), or
`--rate`. Pictures are `obs/NAME_image` (LIBERO: `obs/NAME_rgb`, which are upside down where the file says so), depth
`obs/NAME_depth` in m. A trajectory.h5 of DROID is one demo, by its own clock; its pictures are in other files.
"""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede.faults import fault
from stampede.recordings import rows as steps
from stampede.recordings.folder import FolderWriter
from stampede.recordings.given import Given
from stampede.recordings.hdf5 import attribute, described, numbers, opened, truth
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
_LEAST_HZ, _MOST_HZ = 0.01, 1e5
_MOST_S = 9e9  # since the epoch: as ns it is less than 2^63
_DROID_OPENING_M = 0.085  # of its hand, a Robotiq 2F-85; `gripper_position` is 0 there, and 1 where it is shut


def add_arguments(parser: argparse.ArgumentParser) -> None:
    steps.add_arguments(parser)
    parser.add_argument(
        "--rate", type=float, default=0, metavar="HZ", help="steps a second, where the file does not say it"
    )


def convert(given: Given, options: argparse.Namespace) -> list[Path]:
    """Raises Error for what is no such file, and for another robot."""
    folders = []
    try:
        with opened(options.source) as file:
            if _DROID_STATE in file:
                return [_write_droid(file, given, options)]
            data = file.get("data")
            if not hasattr(data, "keys") or not len(data):
                cure = "name a file of robomimic, LIBERO or DROID"
                raise fault(options.source, "it has no group `data` with demos", cure)
            names = sorted(data, key=_natural)
            wanted = steps.numbers_of(options.episodes, len(names), options.source)
            for number in wanted:
                path = steps.folder_of(given, number, len(wanted))
                with FolderWriter(path, options.skip_bad) as folder:
                    _write(folder, data, names[number], given, options)
                folders.append(path)
    except OSError as error:
        raise fault(options.source, f"it cannot be read, ends early or is damaged: {error}", "copy it again") from error
    given.tell(f"{len(folders)} demos of {options.source}")
    return folders


def _natural(name: str) -> list[Any]:
    """demo_9 comes before demo_10; any name has a place."""
    parts: list[Any] = re.split(r"([0-9]+)", name)
    parts[1::2] = [(len(digits.lstrip("0")), digits.lstrip("0"), digits) for digits in parts[1::2]]
    return parts


def _write(folder: FolderWriter, data: Any, name: str, given: Given, options: argparse.Namespace) -> None:
    demo = data[name]
    place = f"{options.source}, {name}"
    if not hasattr(demo, "keys") or not hasattr(demo.get("obs"), "keys"):
        raise fault(place, "it has no observations", "make them with robomimic's dataset_states_to_obs.py")
    meta = described(demo, "ep_meta", place)
    meta = {"lang": _libero_sentence(data, options.source), **meta}
    rate = _rate(data, meta, options, place)
    rows = _rows(demo["obs"], rate, given, options, place)
    rows.labels = _labels(meta, rate, place)
    if "action_dict/joint_position" in demo:  # rad, as our exporter writes them
        command = numbers(demo, "action_dict/joint_position", place)
        rows.command = command if command.shape == rows.position.shape else None
    steps.write_numbers(folder, rows, given.robot.arm)
    for key in demo["obs"]:
        camera = camera_name(key.rpartition("_")[0])
        if key.endswith(("_image", "_rgb")):
            upside_down = key.endswith("_rgb") and data.attrs.get("macros_image_convention") == _OPENGL
            pictures = _colours(demo["obs"][key], rows, f"{place}, {key}", upside_down)
            steps.write_pictures(folder, "rgb", camera, pictures, f"{place}, {key}")
        elif key.endswith("_depth"):
            files = _depths(demo["obs"][key], rows, f"{place}, {key}")
            steps.write_pictures(folder, "depth", camera, files, f"{place}, {key}", unit_m=0.001, near_m=0.1, far_m=6.5)
    success = truth(meta.get("success", True), f"{place}, attribute ep_meta, success")
    about = {"task": meta.get("task") or "", "success": str(success), "frame_hz": rate}
    steps.finish(folder, given, rows, about, f"{options.source}, {name}")


def _rate(data: Any, meta: Json, options: argparse.Namespace, place: str) -> float:
    arguments = described(data, "env_args", options.source).get("env_kwargs") or {}
    said = arguments.get("control_freq") if isinstance(arguments, dict) else None
    rate = options.rate or said or meta.get("frame_hz")
    if not rate:
        raise fault(place, "it does not say how many steps a second it has", "--rate 20")
    return _hz(rate, place)


def _hz(rate: Any, place: str) -> float:
    try:
        number = float(rate)
    except (TypeError, ValueError):
        number = 0.0
    if not _LEAST_HZ <= number <= _MOST_HZ:
        raise fault(place, f"{rate!r} is no number of steps a second", "--rate 20")
    return number


def _rows(obs: Any, rate: float, given: Given, options: argparse.Namespace, place: str) -> Rows:
    arm = given.robot.arm
    unit = np.pi / 180 if options.degrees else 1.0

    prefix = _robot(obs, options.prefix, place)

    def found(keys: tuple[str, ...], *shape: int) -> Array | None:
        key = next((prefix + one for one in keys if prefix + one in obs), None)
        return None if key is None else numbers(obs, key, place, *shape)

    position = found(_POSITIONS)
    if position is None:
        raise fault(f"{place}/obs", f"none of {', '.join(_POSITIONS)} is there", f"it has {', '.join(obs)}")
    _check_joints(position, arm, place)
    rows = Rows([round(k * 1e9 / rate) for k in range(len(position))], position * unit, place=place)
    velocity, effort = (found(keys, *position.shape) for keys in (_VELOCITIES, _EFFORTS))
    gripper = found(_GRIPPERS, len(position), 0)
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


def _libero_sentence(data: Any, place: str) -> str | None:
    """What LIBERO's `problem_info` says, in whose files all demos are of one task."""
    said = described(data, "problem_info", place).get("language_instruction")
    if isinstance(said, list) and all(isinstance(one, str) for one in said):
        return "".join(said)
    return _sentence(said, f"{place}, attribute problem_info, language_instruction")


def _sentence(said: Any, place: str) -> str | None:
    if said is not None and not isinstance(said, str):
        raise fault(place, f"{said!r} is no sentence", "write text, or leave it out")
    return said or None


def _write_droid(file: Any, given: Given, options: argparse.Namespace) -> Path:
    """One trajectory.h5 of DROID's raw recordings."""
    state, place = file[_DROID_STATE], f"{options.source}, {_DROID_STATE}"
    position = numbers(state, "joint_positions", place)
    _check_joints(position, given.robot.arm, place)
    rows = Rows(_droid_stamps(file, len(position), options), position, place=options.source)
    for name, key in (("velocity", "joint_velocities"), ("effort", "motor_torques_measured")):
        if key in state:
            setattr(rows, name, numbers(state, key, place, *position.shape))
    if "gripper_position" in state:
        shut = numbers(state, "gripper_position", place, len(position), 0)
        if shut.shape[1] != 1:
            raise fault(f"{place}, gripper_position", f"it has {shut.shape[1]} numbers a step, not 1", "leave it out")
        rows.opening = (1.0 - shut[:, 0]) * _DROID_OPENING_M
    if "action/joint_position" in file:
        command = numbers(file, "action/joint_position", options.source)
        rows.command = command if command.shape == position.shape else None
    task = _sentence(attribute(file, "current_task", options.source), f"{options.source}, attribute current_task")
    if task:
        rows.labels = {"labelled_by": "person", "segments": [], "language": [{"level": "task", "text": task}]}
    with FolderWriter(given.out, options.skip_bad) as folder:
        steps.write_numbers(folder, rows, given.robot.arm)
        about = {
            "task": steps.name_of(task) if task else "",
            "success": str(_droid_success(file, options.source)),
            "frame_hz": _DROID_HZ,
        }
        steps.finish(folder, given, rows, about, options.source)
    given.tell(f"1 demo of {options.source}, without pictures: DROID keeps them beside it, as films")
    return given.out


def _droid_success(file: Any, source: str) -> bool:
    """What the file says, else whether it lies in a folder `success`, as DROID has it."""
    said = attribute(file, "success", source)
    if said is None:
        return "success" in Path(source).parts
    return truth(said, f"{source}, attribute success")


def _droid_stamps(file: Any, count: int, options: argparse.Namespace) -> list[int]:
    """Those of the robot, ns; where it has none, or `--rate` is given, even ones."""
    clock = "observation/timestamp/robot_state/robot_timestamp_"
    if options.rate or clock + "seconds" not in file:
        rate = _hz(options.rate or _DROID_HZ, options.source)
        return [round(k * 1e9 / rate) for k in range(count)]
    seconds, nanos = (numbers(file, clock + part, options.source, count, 0)[:, 0] for part in ("seconds", "nanos"))
    if not (np.abs(seconds) < _MOST_S).all() or not ((nanos >= 0) & (nanos < 1e9)).all():
        raise fault(f"{options.source}, {clock}seconds, nanos", "a time in it is none", "--rate 15 takes even ones")
    return (seconds.astype(np.int64) * 10**9 + nanos.astype(np.int64)).tolist()


def _labels(meta: Json, rate: float, place: str) -> Json:
    try:
        segments = [_segment(one, rate) for one in meta.get("segments") or []]
        language = [text for text in meta.get("instructions") or [meta.get("lang")] if text]
    except (AttributeError, KeyError, TypeError) as error:
        what = f"its segments are not as our exporter writes them ({type(error).__name__}: {error})"
        raise fault(f"{place}, attribute ep_meta", what, "leave `segments` out") from error
    sentences = [_sentence(text, f"{place}, attribute ep_meta") for text in language]
    if not segments and not sentences:
        return {}
    return {
        "labelled_by": "model" if segments else "person",
        "segments": segments,
        "language": [{"level": "task", "text": text} for text in sentences],
    }


def _segment(one: Json, rate: float) -> Json:
    return {
        "kind": "skill",
        "name": steps.name_of(one["skill"]),
        "arguments": one.get("arguments", []),
        "label": one.get("label", ""),
        "start_s": one["first_frame"] / rate,
        "end_s": one["end_frame"] / rate,
        "outcome": "success" if one.get("success", True) else "failure",
    }


def _colours(pictures: Any, rows: Rows, place: str, upside_down: bool) -> Iterator[tuple[int, bytes, str]]:
    _check_pictures(pictures, rows, place, (3,), "u", "store n x h x w x 3 uint8")
    for stamp, picture in zip(rows.stamps_ns, pictures, strict=True):
        yield stamp, packed(picture[::-1] if upside_down else picture), "png"


def _depths(pictures: Any, rows: Rows, place: str) -> Iterator[tuple[int, bytes, str]]:
    flat = len(getattr(pictures, "shape", ())) == 3
    _check_pictures(pictures, rows, place, () if flat else (1,), "fiu", "store n x h x w floats, m")
    for stamp, picture in zip(rows.stamps_ns, pictures, strict=True):
        metres = np.asarray(picture, dtype=float).reshape(picture.shape[:2])
        mm = np.nan_to_num(metres * 1000, nan=0.0, posinf=0.0, neginf=0.0)
        yield stamp, packed(np.where((mm > 0) & (mm < 65535.5), np.round(mm), 0).astype(np.uint16)), "png"


def _check_pictures(pictures: Any, rows: Rows, place: str, last: tuple[int, ...], kinds: str, cure: str) -> None:
    """last: what comes behind n x h x w."""
    shape, kind = getattr(pictures, "shape", ()), getattr(pictures, "dtype", np.dtype("V"))
    right_type = kind == np.uint8 if kinds == "u" else kind.kind in kinds
    if len(shape) != 3 + len(last) or shape[3:] != last or not all(shape[1:]) or not right_type:
        raise fault(place, f"pictures of shape {shape} and type {kind} are not read", cure)
    if shape[0] != len(rows.stamps_ns):
        raise fault(place, f"it has {shape[0]} pictures, and there are {len(rows.stamps_ns)} steps", "store one a step")
