"""A calibration written into the recording that it was made from."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

from stampede.calibrate.bundle import Result
from stampede.calibrate.recorded import MEASURED, Recording
from stampede.faults import fault
from stampede.files import inside, made_beside
from stampede.recordings.folder import UNPLACED

Json = dict[str, Any]


def write_whole(file: Path, document: Any) -> None:
    """As JSON; the file has its name once all of it is there. Raises Error where something else has that name: a link,
    a device, a folder, or a file without this document's first key."""
    check_replaceable(file, next(iter(document)))
    with made_beside(file) as made:
        made.write_text(json.dumps(document, indent=1) + "\n")
        made.replace(file)


def check_replaceable(file: Path, key: str) -> None:
    """Raises Error where a JSON file with this key may not take that name. Call it ahead of long work."""
    if file.is_symlink():
        raise fault(str(file), "this is a link", "name the file itself, or remove the link")
    if not file.exists():
        return
    if not file.is_file():
        raise fault(str(file), "this is a folder or a device, and no file", "name a file")
    try:
        known = json.loads(file.read_text() or "{}")
    except ValueError:
        known = None
    if not isinstance(known, dict) or (known and key not in known):
        raise fault(str(file), f"this file is there already, and holds no '{key}'", "name a new file, or remove it")


def apply(recording: Recording, result: Result, report: Json, with_joints: bool) -> None:
    """cameras.json, the cameras' clocks, calibration.json with what was found; joints.csv, if that is wanted."""
    folder = recording.folder
    name = str(recording.document.get("cameras", "cameras.json"))
    file = inside(folder, name)
    known = json.loads(file.read_text())["cameras"] if file.is_file() else []
    new = {entry["name"] for entry in report["camera_file"]}
    write_whole(file, {"cameras": [one for one in known if one["name"] not in new] + report["camera_file"]})
    write_whole(folder / "calibration.json", report)
    if with_joints:
        _correct_joints(recording, result)
    clocks = dict(recording.document.get("clocks", {}))
    for one in report["cameras"]:
        clocks[recording.pictures(one["camera"]).clock] = one["clock"]
    placed = [one for one in recording.unplaced() if one["camera"] in new]
    streams = [*recording.document["streams"], *placed]
    write_whole(recording.file, {**recording.document, "cameras": name, "clocks": clocks, "streams": streams})
    if placed:  # after recording.json: what is in both is not lost
        write_whole(folder / UNPLACED, {"streams": [one for one in recording.unplaced() if one not in placed]})


def _correct_joints(recording: Recording, result: Result) -> None:
    file = recording.folder / recording.joints_name
    measured = file.with_name(MEASURED)
    if not measured.exists():
        with made_beside(measured) as made:
            shutil.copyfile(file, made)
            made.replace(measured)
    offsets = {
        f"{joint}_position_rad": float(offset)
        for joint, offset in zip(recording.robot.arm, result.offsets, strict=True)
    }
    lines = measured.read_text().splitlines()
    shifts = [offsets.get(column, 0.0) for column in lines[0].split(",")]
    with made_beside(file) as made:
        with made.open("w") as stream:
            stream.write(lines[0] + "\n")
            for line in lines[1:]:
                fields = line.split(",")
                fields = [
                    repr(float(field) + shift) if shift and field else field
                    for field, shift in zip(fields, shifts, strict=True)
                ]
                stream.write(",".join(fields) + "\n")
        made.replace(file)
