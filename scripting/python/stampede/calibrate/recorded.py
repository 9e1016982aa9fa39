"""What calibration needs of a recording folder: joint states over time, and pictures with their stamps."""

from __future__ import annotations

import csv
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede._core import Error
from stampede.faults import fault, unknown
from stampede.files import inside, plain_file
from stampede.recordings.folder import UNPLACED
from stampede.robots import Robot, robot_of

Array = NDArray[Any]
Json = dict[str, Any]

MEASURED = "joints_measured.csv"  # what joints.csv was before a calibration corrected it


@dataclass
class JointStates:
    """Of the arm, in time. velocities, efforts: None where they were not recorded."""

    times: Array  # s since the recording's zero
    positions: Array  # n x joints
    velocities: Array | None
    efforts: Array | None

    def at(self, times: Array) -> Array:
        """Positions between readings: cubic where there are velocities, else linear. Beyond the ends, the ends."""
        clipped = np.clip(times, self.times[0], self.times[-1])
        after = np.clip(np.searchsorted(self.times, clipped), 1, len(self.times) - 1)
        span = (self.times[after] - self.times[after - 1])[:, None]
        s = (clipped - self.times[after - 1])[:, None] / span
        start, end = self.positions[after - 1], self.positions[after]
        if self.velocities is None:
            return start + s * (end - start)
        first, last = self.velocities[after - 1] * span, self.velocities[after] * span
        return (
            (2 * s**3 - 3 * s**2 + 1) * start
            + (s**3 - 2 * s**2 + s) * first
            + (3 * s**2 - 2 * s**3) * end
            + (s**3 - s**2) * last
        )


@dataclass
class Pictures:
    """Of one camera."""

    files: list[Path]
    times: Array  # s since the recording's zero, on the camera's clock
    clock: str


class Recording:
    """A recording folder. zero_ns: the epoch that times count from, so that float64 has all their digits.

    corrected: positions as a calibration left them, not as they were measured. Raises Error for what is no such folder.
    """

    def __init__(self, folder: Path, corrected: bool = False) -> None:
        self.folder = folder
        self.file = folder / "recording.json"
        _given(folder, self.file.name)
        try:
            self.document: Json = json.loads(self.file.read_text())
            self.streams: list[Json] = [*self.document["streams"], *self.unplaced()]
            described = self.document["robot"]
            if isinstance(described, dict) and "urdf" in described:
                _given(folder, described["urdf"])
        except Error:
            raise
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise fault(str(self.file), f"no recording: {error}", "python -m stampede.recordings writes one") from error
        self.robot: Robot = robot_of(described, folder)
        base = described.get("base", {})
        self.base = [*base.get("position", [0, 0, 0]), *base.get("quaternion", [0, 0, 0, 1])]
        self._joints_stream = next((one for one in self.streams if one.get("kind") == "joints"), None)
        if self._joints_stream is None:
            raise fault(str(self.file), "it has no stream of joints", "record joint states")
        self.joints_name = str(self._joints_stream["file"])
        measured = folder / MEASURED
        self.joints_file = _given(folder, MEASURED if measured.is_file() and not corrected else self.joints_name)
        self.zero_ns = 0
        names, stamps, values = self._table(self.joints_file)
        if len(stamps) < 2:
            raise fault(str(self.joints_file), "it has fewer than two readings", "record for longer")
        self.zero_ns = stamps[0]
        self.clock = str(self._joints_stream.get("clock", ""))
        self.joints = self._joint_states(names, stamps, np.array(values, dtype=float))

    def unplaced(self) -> list[Json]:
        """Streams that are left out as long as nobody knows where their cameras are."""
        file = self.folder / UNPLACED
        return list(json.loads(_given(self.folder, UNPLACED).read_text())["streams"]) if file.is_file() else []

    def cameras(self) -> list[str]:
        return [str(one["camera"]) for one in self.streams if one.get("kind") == "rgb"]

    def pictures(self, camera: str) -> Pictures:
        """Raises Error for a camera that has none."""
        found = [one for one in self.streams if one.get("kind") == "rgb" and one.get("camera") == camera]
        if not found:
            raise unknown(str(self.file), "camera with colours", camera, self.cameras())
        stream = found[0]
        folder = inside(self.folder, stream["folder"])
        if "times" in stream:
            _, stamps, rows = self._table(_given(self.folder, stream["times"]), texts=True)
            files = [inside(self.folder, f"{stream['folder']}/{row[0]}") for row in rows]
        else:
            files = [inside(self.folder, f"{stream['folder']}/{file.name}") for file in folder.iterdir()]
            files = sorted(files, key=lambda file: _stamp_ns(file.stem, str(file)))
            stamps = [_stamp_ns(file.stem, str(file)) for file in files]
        return Pictures(files, self._seconds(stamps), str(stream.get("clock", "")))

    def lens_entry(self, camera: str) -> Json | None:
        """Of lenses.json or cameras.json beside the recording."""
        for name in ("lenses.json", str(self.document.get("cameras", "cameras.json"))):
            if (self.folder / name).is_file():
                for entry in json.loads(_given(self.folder, name).read_text()).get("cameras", []):
                    if entry.get("name") == camera:
                        return dict(entry)
        return None

    def seconds_of(self, stamp_s: float) -> float:
        """A stamp in seconds as a time here."""
        return stamp_s - self.zero_ns / 1e9

    def _seconds(self, stamps: list[int]) -> Array:
        return np.array([(stamp - self.zero_ns) / 1e9 for stamp in stamps])

    def _joint_states(self, names: list[str], stamps: list[int], values: Array) -> JointStates:
        def columns(unit: str) -> Array | None:
            wanted = [f"{joint}_{unit}" for joint in self.robot.arm]
            if not all(one in names for one in wanted):
                return None
            return values[:, [names.index(one) for one in wanted]]

        positions = columns("position_rad")
        if positions is None:
            raise fault(
                str(self.joints_file),
                f"it lacks the position of a joint of {self.robot.name}: it has {', '.join(names)}",
                "name the robot that was recorded in recording.json",
            )
        velocities = columns("velocity_rad_s")
        if velocities is not None and not np.isfinite(velocities).all():
            velocities = None
        return JointStates(self._seconds(stamps), positions, velocities, columns("effort_nm"))

    def _table(self, file: Path, texts: bool = False) -> tuple[list[str], list[int], list[list[Any]]]:
        """Names of the columns behind time_s, stamps in ns, and rows. An empty field is NaN."""
        try:
            with file.open(newline="") as stream:
                reader = csv.reader(stream)
                names = next(reader, [])
                rows = list(reader)
        except OSError as error:
            raise fault(str(file), f"it cannot be read: {error.strerror}", "write the recording again") from error
        if not names or names[0] != "time_s" or any(len(row) != len(names) for row in rows):
            raise fault(str(file), "it is no table that begins with time_s", "write the recording again")
        stamps = [_stamp_ns(row[0], f"{file}, row {k + 2}") for k, row in enumerate(rows)]
        if texts:
            return names[1:], stamps, [row[1:] for row in rows]
        try:
            return names[1:], stamps, [[float(one) if one else np.nan for one in row[1:]] for row in rows]
        except ValueError as error:
            raise fault(str(file), str(error), "write the recording again") from error


def _given(folder: Path, name: str) -> Path:
    return plain_file(inside(folder, name))


def _stamp_ns(text: str, place: str) -> int:
    whole, _, part = text.partition(".")
    try:
        return int(whole) * 10**9 + int((part + "0" * 9)[:9])
    except ValueError as error:
        raise fault(place, f"'{text}' is no time in seconds", "write it as 1695.033333") from error
