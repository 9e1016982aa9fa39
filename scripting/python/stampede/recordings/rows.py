"""What LeRobot and robomimic have in common: a row a step, all on one clock, episodes in one source."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede.faults import fault
from stampede.recordings.folder import FolderWriter
from stampede.recordings.given import Given
from stampede.recordings.roles import the_prefix

Array = NDArray[Any]
Json = dict[str, Any]

CLOCK = "dataset"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--episodes", default="", metavar="LIST", help="numbers, `0,3,5-9` (default: all)")
    parser.add_argument("--degrees", action="store_true", help="angles are in degrees")
    parser.add_argument(
        "--prefix",
        metavar="TEXT",
        help="what stands before the names of the robot's joints, where there are several arms (default: found)",
    )
    parser.add_argument("--skip-bad", action="store_true", help="leave out rows with positions that are not numbers")


@dataclass
class Rows:
    """Numbers of one episode, a row a step."""

    stamps_ns: list[int]
    position: Array  # steps x joints of the arm, rad
    velocity: Array | None = None
    effort: Array | None = None
    opening: Array | None = None  # steps, m
    command: Array | None = None  # steps x joints of the arm, rad
    labels: Json = field(default_factory=dict)  # segments, language
    place: str = ""


def numbers_of(text: str, count: int, place: str) -> list[int]:
    """`0,3,5-9`; empty: all. Raises Error."""
    wanted: list[int] = []
    for part in text.split(",") if text else []:
        ends = re.fullmatch(r"(\d+)(?:-(\d+))?", part.strip())
        if not ends:
            raise fault("--episodes", f"'{part}' is no number", "--episodes 0,3,5-9")
        wanted += range(int(ends[1]), int(ends[2] or ends[1]) + 1)
    for one in wanted:
        if one >= count:
            raise fault(place, f"there is no episode {one}", f"it has {count}, from 0")
    return wanted if text else list(range(count))


def columns_of(
    names: Sequence[str], width: int, arm: Sequence[str], place: str, wanted: str | None = None
) -> tuple[list[int], int | None]:
    """Places of the arm's joints and of the gripper among the components of a state. Where they have no names of
    joints, the first are the arm's, and one behind them is the gripper's. wanted: the prefix of the joints' names."""
    plain = [re.sub(r"[._](pos|position|q)$", "", name) for name in names]
    prefix = the_prefix(arm, plain, wanted, place)
    if prefix is not None:
        grippers = [k for k, name in enumerate(plain) if re.search(r"gripper|opening", name)]
        grippers = [k for k in grippers if plain[k].startswith(prefix)] if len(grippers) > 1 else grippers
        if len(grippers) > 1:
            both = ", ".join(plain[k] for k in grippers)
            raise fault(place, f"several of its values are of a hand: {both}", "--prefix says which arm it is")
        return [plain.index(prefix + joint) for joint in arm], grippers[0] if grippers else None
    unnamed = not names or all(re.fullmatch(r"(motor|joint|state|dim)?_?\d+|gripper", name) for name in plain)
    if unnamed and width in (len(arm), len(arm) + 1):
        return list(range(len(arm))), len(arm) if width > len(arm) else None
    raise fault(
        place,
        f"its {width} values are not the joints {', '.join(arm)}: it is of another robot"
        + (f", with {', '.join(names)}" if names else ""),
        "--robot names another one",
    )


def write_numbers(folder: FolderWriter, rows: Rows, arm: Sequence[str]) -> None:
    """Streams joints, gripper and command. Raises Error for positions that are not numbers."""
    parts = [("position_rad", rows.position), ("velocity_rad_s", rows.velocity), ("effort_nm", rows.effort)]
    there = [(unit, values) for unit, values in parts if values is not None]
    joints = folder.series("joints", [f"{joint}_{unit}" for unit, _ in there for joint in arm], CLOCK, rows.place)
    whole = np.concatenate([np.asarray(values, dtype=float) for _, values in there], axis=1)
    used = []
    for stamp, row in zip(rows.stamps_ns, whole, strict=True):
        if not joints.takes(stamp):
            continue
        if not np.isfinite(row[: len(arm)]).all():
            joints.skip("a joint's position is not a number")
            continue
        joints.row(stamp, row.tolist())
        used.append(stamp)
    if not used:
        raise fault(rows.place, "it has no step", "name another episode with --episodes")
    if rows.opening is not None:
        _series(folder, "gripper", ["opening_m"], rows, np.asarray(rows.opening, dtype=float)[:, None])
    if rows.command is not None:
        _series(
            folder, "command", [f"{joint}_position_rad" for joint in arm], rows, np.asarray(rows.command, dtype=float)
        )


def _series(folder: FolderWriter, kind: str, columns: list[str], rows: Rows, values: Array) -> None:
    stream = folder.series(kind, columns, CLOCK, f"{rows.place}, {kind}")
    for stamp, row in zip(rows.stamps_ns, values, strict=True):
        if np.isfinite(row).all() and stream.takes(stamp):
            stream.row(stamp, row.tolist())


def write_pictures(
    folder: FolderWriter, kind: str, camera: str, files: Iterable[tuple[int, bytes, str]], place: str, **fields: Any
) -> None:
    """files: stamp (ns), bytes and ending."""
    stream, pictures = folder.pictures(kind, camera, CLOCK, place, **fields)
    for stamp, data, ending in files:
        if stream.takes(stamp):
            stream.picture(stamp, pictures, data, ending)


def finish(folder: FolderWriter, given: Given, rows: Rows, about: Json, source: str) -> None:
    document = given.document(about, source=source)
    last_s = (rows.stamps_ns[-1] - rows.stamps_ns[0]) / 1e9
    segments = given.fit(rows.labels.get("segments", []), about, last_s)
    folder.write_labels(document, {**rows.labels, "segments": segments})
    given.copy_cameras(folder, document)
    given.copy_files(folder)
    folder.finish(document)


def folder_of(given: Given, number: int, count: int) -> Path:
    """One episode has the folder that was named; of several each has one in it."""
    return given.out if count == 1 else given.out / f"episode_{number:06d}"


def name_of(text: str) -> str:
    """A name such as skills have, of a sentence."""
    return re.sub(r"[^a-z0-9]+", "_", text.lower()).strip("_")[:60] or "unnamed"
