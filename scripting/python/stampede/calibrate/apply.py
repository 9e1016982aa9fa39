"""A calibration written into the recording that it was made from."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

from stampede.calibrate.bundle import Result
from stampede.calibrate.recorded import MEASURED, Recording
from stampede.recordings.folder import UNPLACED

Json = dict[str, Any]


def write_whole(file: Path, document: Any) -> None:
    """As JSON; the file has its name once all of it is there."""
    part = file.with_name(file.name + ".part")
    part.write_text(json.dumps(document, indent=1) + "\n")
    part.replace(file)


def apply(recording: Recording, result: Result, report: Json, with_joints: bool) -> None:
    """cameras.json, the cameras' clocks, calibration.json with what was found; joints.csv, if that is wanted."""
    folder = recording.folder
    name = str(recording.document.get("cameras", "cameras.json"))
    file = folder / name
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
        part = measured.with_name(measured.name + ".part")
        shutil.copyfile(file, part)
        part.replace(measured)
    offsets = {
        f"{joint}_position_rad": float(offset)
        for joint, offset in zip(recording.robot.arm, result.offsets, strict=True)
    }
    lines = measured.read_text().splitlines()
    shifts = [offsets.get(column, 0.0) for column in lines[0].split(",")]
    part = file.with_name(file.name + ".part")
    with part.open("w") as stream:
        stream.write(lines[0] + "\n")
        for line in lines[1:]:
            fields = line.split(",")
            fields = [
                repr(float(field) + shift) if shift and field else field
                for field, shift in zip(fields, shifts, strict=True)
            ]
            stream.write(",".join(fields) + "\n")
    part.replace(file)
