"""MCAP and rosbag2 to a recording folder.

What a topic is, its type says (roles.py). Stamps are those of the messages' headers, on one clock of the robot and
one of each camera; a topic whose first header has no stamp, and all topics with `--clock log`, have the recorder's
times. A stamp that comes twice is taken once. NaN in velocities and efforts, as drivers write what they do not know,
is no reading. Pictures that are JPEG or PNG files go through as they are.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede.export.scene import quaternion
from stampede.faults import fault
from stampede.recordings.bags import Bag, open_bag
from stampede.recordings.folder import FolderWriter, Stream
from stampede.recordings.frames import Frames, lens_entry, link_named
from stampede.recordings.given import Given
from stampede.recordings.messages import (
    JointReading,
    LensReading,
    Message,
    PictureReading,
    SegmentReading,
    TransformReading,
    WrenchReading,
    decoder,
)
from stampede.recordings.pictures import Packers, file_of
from stampede.recordings.roles import Roles, parse_map, roles_of

Array = NDArray[Any]
Json = dict[str, Any]

_WRENCH = ["force_x_n", "force_y_n", "force_z_n", "torque_x_nm", "torque_y_nm", "torque_z_nm"]
_DEPTH = {"unit_m": 0.001}  # of the PNG files that are written here, and of a RealSense's


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--map",
        action="append",
        default=[],
        metavar="WHAT=TOPIC",
        help="joints, gripper, rgb.CAMERA, "
        "depth.CAMERA, lens.CAMERA, wrench.NAME; `=none` leaves a kind out (default: by type and name)",
    )
    parser.add_argument(
        "--prefix",
        metavar="TEXT",
        help="what stands before the names of the robot's joints, of several arms on one topic (default: found)",
    )
    parser.add_argument(
        "--clock", choices=("header", "log"), default="header", help="whose times (default: %(default)s)"
    )
    parser.add_argument("--skip-bad", action="store_true", help="leave out readings that are NaN or go back in time")
    parser.add_argument("--truncated", action="store_true", help="of a file that ends early, take what is whole")
    parser.add_argument("--depth-range", default="0.1,6.5", metavar="NEAR,FAR", help="m (default: %(default)s)")


def convert(given: Given, options: argparse.Namespace) -> list[Path]:
    """Writes the folder. Raises Error for a bag that cannot serve; then there is no folder."""
    source = Path(options.source)
    bag = open_bag(source, options.truncated)
    roles = roles_of(bag, str(source), given.robot, parse_map(options.map), options.prefix)
    cores = len(os.sched_getaffinity(0))
    with FolderWriter(given.out, options.skip_bad) as folder, ThreadPoolExecutor(cores) as pool:
        _Conversion(bag, roles, given, options, folder, Packers(pool)).run()
    return [given.out]


class _Conversion:
    def __init__(
        self,
        bag: Bag,
        roles: Roles,
        given: Given,
        options: argparse.Namespace,
        folder: FolderWriter,
        packers: Packers,
    ) -> None:
        self._bag, self._roles, self._given, self._options, self._folder = bag, roles, given, options, folder
        self._packers = packers
        self._logged: dict[str, bool] = {}  # topics whose times are the recorder's
        self._frames = Frames()
        self._lenses: dict[str, LensReading] = {}
        self._camera_frames: dict[str, str] = {}
        self._segments: list[Json] = []
        self._near, self._far = _range(options.depth_range)

    def run(self) -> None:
        topics = {topic.name: topic for topic in self._bag.topics()}
        wanted = self._roles.all()
        read = {name: decoder(name, topics[name].schema, topics[name].encoding) for name in wanted}
        takers: dict[str, Callable[[Message, int], None]] = {}
        for name, log_ns, data in self._bag.messages(wanted):
            message = read[name](data, log_ns)
            if name not in takers:
                takers[name] = self._taker(name, message)
            takers[name](message, self._time_of(name, message))
        self._packers.finish()
        if not any(one.described["kind"] == "joints" and one.counts.written for one in self._folder.streams):
            raise fault(str(self._options.source), "no joint state in it can be used", "record again")
        self._finish()

    def _time_of(self, topic: str, message: Message) -> int:
        if topic not in self._logged:
            self._logged[topic] = self._options.clock == "log" or message.stamp_ns == 0
        if self._logged[topic]:
            return message.log_ns
        return message.stamp_ns

    def _clock(self, topic: str, name: str, message: Message) -> str:
        self._time_of(topic, message)
        return "log" if self._logged[topic] else name

    def _taker(self, topic: str, first: Message) -> Callable[[Message, int], None]:
        """What is done with a topic's messages."""
        place = f"{self._options.source}, topic {topic}"
        if isinstance(first, JointReading):
            takers = []
            clock = self._clock(topic, "robot", first)
            if topic == self._roles.joints:
                takers.append(self._joints(place, clock))
            if topic in (self._roles.gripper, self._roles.joints) and (
                topic == self._roles.gripper or not self._roles.gripper
            ):
                takers.append(self._gripper(place, clock))
            return lambda message, time: _give(takers, message, time)
        if isinstance(first, PictureReading):
            return self._picture(place, topic, first)
        if isinstance(first, WrenchReading):
            return self._wrench(place, topic, first)
        if isinstance(first, LensReading):
            camera = self._roles.lenses[topic]
            return lambda message, time: self._keep_lens(camera, message)  # type: ignore[arg-type]
        if isinstance(first, TransformReading):
            return lambda message, time: self._frames.add(message, time)  # type: ignore[arg-type]
        return lambda message, time: self._keep_segment(message)  # type: ignore[arg-type]

    def _joints(self, place: str, clock: str) -> Callable[[Any, int], None]:
        arm = self._given.robot.arm
        parts = [("position", "position_rad")]
        columns = (("velocity", "velocity_rad_s"), ("effort", "effort_nm"))
        parts += [(part, column) for part, column in columns if part in self._roles.measured]
        stream = self._folder.series("joints", [f"{j}_{column}" for _, column in parts for j in arm], clock, place)
        state = _Merged(self._roles.arm, [part for part, _ in parts])

        def take(message: JointReading, time: int) -> None:
            values = state.with_(message)
            if values is None or not stream.takes(time):
                return
            position = values[0]
            if not np.isfinite(position).all():
                bad = arm[int(np.flatnonzero(~np.isfinite(position))[0])]
                stream.skip(_lack_of(message) or f"the position of {bad} is not a number")
                return
            stream.row(time, values.ravel().tolist())

        return take

    def _gripper(self, place: str, clock: str) -> Callable[[Any, int], None]:
        fingers = self._roles.fingers
        if not fingers:
            return lambda message, time: None
        stream = self._folder.series("gripper", ["opening_m"], clock, place)
        state = _Merged(fingers, ["position"])

        def take(message: JointReading, time: int) -> None:
            values = state.with_(message)
            if values is None or not stream.takes(time):
                return
            opening = float(values.sum()) * (2 if len(fingers) == 1 else 1)
            if not np.isfinite(opening):
                stream.skip(_lack_of(message) or "the opening of the fingers is not a number")
                return
            stream.row(time, [opening])

        return take

    def _picture(self, place: str, topic: str, first: PictureReading) -> Callable[[Any, int], None]:
        kind, camera = self._roles.pictures[topic]
        further = {**_DEPTH, "near_m": self._near, "far_m": self._far} if kind == "depth" else {}
        stream, folder = self._folder.pictures(kind, camera, self._clock(topic, camera, first), place, **further)
        if kind == "rgb" or camera not in self._camera_frames:
            self._camera_frames[camera] = first.frame_id

        def take(message: PictureReading, time: int) -> None:
            if stream.takes(time):
                here = f"{place}, picture {stream.counts.written + 1}"
                if message.width == 0:
                    stream.picture(time, folder, *file_of(message, kind, here))
                else:
                    self._packers.put(stream.picture_file(time, folder, "png"), message, kind, here)
            if not self._logged[topic]:
                stream.counts.latency_ns.append(message.log_ns - message.stamp_ns)

        return take

    def _wrench(self, place: str, topic: str, first: WrenchReading) -> Callable[[Any, int], None]:
        robot = self._given.robot
        link = link_named(first.frame_id, robot) or robot.hand
        name = self._roles.wrenches[topic]
        clock = self._clock(topic, "robot", first)
        stream = self._folder.series("wrench", _WRENCH, clock, place, name=name, link=link)

        def take(message: WrenchReading, time: int) -> None:
            if not stream.takes(time):
                return
            if not np.isfinite(message.wrench).all():
                stream.skip("the wrench is not a number")
                return
            stream.row(time, message.wrench.tolist())

        return take

    def _keep_lens(self, camera: str, lens: LensReading) -> None:
        self._lenses.setdefault(camera, lens)

    def _keep_segment(self, message: SegmentReading) -> None:
        one = message.fields
        kept = {name: one[name] for name in ("kind", "name", "arguments", "start_s", "end_s", "label") if name in one}
        self._segments.append({**kept, "outcome": "success" if one.get("success", True) else "failure"})

    def _finish(self) -> None:
        self._tell_streams()
        self._find_base()
        about = self._bag.about()
        document = self._given.document(about)
        document["source"] = f"{Path(self._options.source).name}: " + ", ".join(sorted(self._roles.all()))
        language = [{"level": "task", "text": one} for one in about.get("instruction", "").split("; ") if one]
        if self._segments or language:
            joints = next(one for one in self._folder.streams if one.described["kind"] == "joints")
            segments = self._given.fit(self._segments, about, joints.counts.duration_s)
            labels = {"labelled_by": "model", "model": "stampede", "segments": segments, "language": language}
            self._folder.write_labels(document, labels)
        self._write_cameras(document)
        self._given.copy_files(self._folder)
        self._folder.finish(document)

    def _write_cameras(self, document: Json) -> None:
        if self._given.copy_cameras(self._folder, document):
            return
        cameras = sorted({camera for _, camera in self._roles.pictures.values()})
        placed, lenses = [], []
        for camera in cameras:
            lens = self._lenses.get(camera)
            found = "there is no CameraInfo of it" if lens is None else lens_entry(camera, lens)
            if isinstance(found, str):
                self._given.tell(f"camera {camera}: {found}; python -m stampede.calibrate intrinsics finds its lens")
                continue
            lenses.append(found)
            assert lens is not None
            frame = self._camera_frames.get(camera) or lens.frame_id
            mount = self._frames.mount_of(frame, self._given.robot, self._given.world_from_base)
            if isinstance(mount, str):
                self._given.tell(
                    f"camera {camera}: {mount}; python -m stampede.calibrate extrinsics finds its pose, "
                    "--cameras FILE gives it"
                )
                continue
            placed.append({**found, "mount": mount[0], "mount_from_camera": mount[1].tolist()})
        if lenses:
            self._folder.write_json("lenses.json", {"cameras": lenses})
        if placed:
            self._folder.write_json("cameras.json", {"cameras": placed})
            document["cameras"] = "cameras.json"
            for camera in self._folder.leave_out(one["name"] for one in placed):
                self._given.tell(
                    f"camera {camera}: its pictures are in the folder, but left out of the recording; "
                    f"python -m stampede.calibrate extrinsics {self._given.out} --camera {camera} --apply brings them "
                    "in, or convert again with --cameras FILE"
                )

    def _find_base(self) -> None:
        """Where the robot stands, as the transforms say, unless the command line did."""
        stands = None if self._given.base_said else self._frames.base_in_world(self._given.robot)
        if stands is None:
            return
        self._given.base = [*map(float, stands[:3, 3]), *map(float, quaternion(stands[:3, :3]))]
        self._given.tell("base: at " + " ".join(f"{one:.4g}" for one in self._given.base) + ", as the transforms say")

    def _tell_streams(self) -> None:
        for stream in self._folder.streams:
            self._given.tell(_line(stream))


def _lack_of(message: JointReading) -> str:
    """What its positions lack, if there are not as many as names."""
    if len(message.position) == len(message.names):
        return ""
    return f"it has {len(message.position)} positions for {len(message.names)} names of joints"


def _give(takers: list[Callable[[Any, int], None]], message: Message, time: int) -> None:
    for take in takers:
        take(message, time)


def _line(stream: Stream) -> str:
    """`joints: 60000 readings in 600.0 s`, and what is not as it should be."""
    counts = stream.counts
    name = stream.described.get("name") or stream.described["kind"]
    camera = stream.described.get("camera")
    line = f"{name}{f' of {camera}' if camera else ''}: {counts.written} readings in {counts.duration_s:.1f} s"
    if counts.latency_ns:
        line += f", logged {np.median(counts.latency_ns) / 1e6:.1f} ms after their stamps"
    if counts.repeated:
        line += f", {counts.repeated} of a stamp that was there"
    if counts.skipped:
        line += f", {counts.skipped} left out"
    return line


class _Merged:
    """The state of some joints, of messages that each may have some of them: drivers may share a topic."""

    def __init__(self, joints: Sequence[str], parts: Sequence[str]) -> None:
        self._rows = {joint: row for row, joint in enumerate(joints)}
        self._parts = parts
        self._values = np.full((len(parts), len(joints)), np.nan)
        self._missing = set(joints)  # since the last whole state
        self._places: dict[tuple[str, ...], tuple[list[int], list[int]]] = {}  # in messages with these names, and here

    def with_(self, message: JointReading) -> Array | None:
        """Parts x joints, where each has been told of since the last time; NaN is what was not measured."""
        if message.names not in self._places:
            at = [k for k, name in enumerate(message.names) if name in self._rows]
            self._places[message.names] = at, [self._rows[message.names[k]] for k in at]
        at, rows = self._places[message.names]
        for part, values in zip(self._parts, self._values, strict=True):
            told = getattr(message, part)
            values[rows] = told[at] if len(told) > max(at, default=0) else np.nan
        self._missing.difference_update(message.names[k] for k in at)
        if not at or self._missing:
            return None
        self._missing = set(self._rows)
        return self._values.copy()


def _range(text: str) -> tuple[float, float]:
    try:
        near, far = (float(word) for word in text.split(","))
    except ValueError:
        near = far = 0.0
    if not 0 < near < far:
        raise fault("--depth-range", f"'{text}' is no range", "--depth-range 0.3,3")
    return near, far
