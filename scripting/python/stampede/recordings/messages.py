"""Messages of a bag as plain values, whoever wrote them: ROS 2's in CDR, or Foxglove's schemas as JSON."""

from __future__ import annotations

import base64
import json
import struct
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede._core import Error
from stampede.faults import fault
from stampede.recordings.cdr import READERS, CdrReader

Array = NDArray[Any]


@dataclass(frozen=True)
class Message:
    """What every reading has. Times are ns since any epoch."""

    stamp_ns: int  # of its header; 0: it has none
    log_ns: int  # when the recorder got it


@dataclass(frozen=True)
class JointReading(Message):
    names: tuple[str, ...]
    position: Array  # empty: none of it was recorded
    velocity: Array
    effort: Array


@dataclass(frozen=True)
class WrenchReading(Message):
    wrench: Array  # force x y z N, torque x y z N m
    frame_id: str


@dataclass(frozen=True)
class PictureReading(Message):
    encoding: str  # of raw pixels: rgb8, 16UC1 …; of a file: its format, as the message says it
    data: bytes
    width: int = 0  # 0: a file
    height: int = 0
    step: int = 0  # bytes a row
    big: bool = False
    frame_id: str = ""


@dataclass(frozen=True)
class LensReading(Message):
    width: int
    height: int
    model: str  # plumb_bob …
    distortion: Array
    matrix: Array  # 3 x 3
    frame_id: str


@dataclass(frozen=True)
class TransformReading(Message):
    transforms: list[tuple[str, str, Array]]  # parent, child, pose x y z and quaternion x y z w


@dataclass(frozen=True)
class SegmentReading(Message):
    """A labelled stretch, as our own exporter writes it."""

    fields: dict[str, Any] = field(default_factory=dict)


# What a topic's type means here. ROS 2 writes types with or without `msg`.
KINDS = {
    "sensor_msgs/msg/JointState": "joints",
    "geometry_msgs/msg/WrenchStamped": "wrench",
    "sensor_msgs/msg/Image": "picture",
    "sensor_msgs/msg/CompressedImage": "picture",
    "sensor_msgs/msg/CameraInfo": "lens",
    "tf2_msgs/msg/TFMessage": "transforms",
    "foxglove.JointStates": "joints",
    "foxglove.CompressedImage": "picture",
    "foxglove.RawImage": "picture",
    "foxglove.CameraCalibration": "lens",
    "foxglove.FrameTransforms": "transforms",
    "stampede.Segment": "segments",
}


def type_name(schema: str) -> str:
    """`sensor_msgs/JointState` -> `sensor_msgs/msg/JointState`."""
    parts = schema.split("/")
    return f"{parts[0]}/msg/{parts[1]}" if len(parts) == 2 else schema


def decoder(topic: str, schema: str, encoding: str) -> Callable[[bytes, int], Message]:
    """What turns the bytes of a topic's messages, and their log times, into readings. Raises Error for an encoding
    that is not read; the decoder raises one, with the topic, for a message that is damaged."""
    name = type_name(schema)
    if encoding == "cdr" and name in READERS:
        read = READERS[name]
        return _guarded(topic, lambda data, log_ns: _of_ros(name, read(CdrReader(data)), log_ns))
    if encoding == "json" and name in KINDS:
        return _guarded(topic, lambda data, log_ns: _of_json(name, json.loads(data), log_ns))
    raise fault(
        f"topic {topic}",
        f"messages of type {schema} in the encoding '{encoding}' are not read",
        "record them as ROS 2 does (cdr), or Foxglove's schemas as JSON; `--map` names other topics",
    )


def _guarded(topic: str, decode: Callable[[bytes, int], Message]) -> Callable[[bytes, int], Message]:
    def read(data: bytes, log_ns: int) -> Message:
        try:
            return decode(data, log_ns)
        except Error:
            raise
        except (struct.error, ValueError, KeyError, TypeError, IndexError) as error:
            raise fault(
                f"topic {topic}, message logged at {log_ns / 1e9:.6f} s",
                f"it is damaged: {error}",
                "record again, or leave the topic out with --map",
            ) from error

    return read


def _of_ros(name: str, m: dict[str, Any], log_ns: int) -> Message:
    stamp = m.get("stamp_ns", 0)
    if name.endswith("JointState"):
        return JointReading(stamp, log_ns, m["name"], m["position"], m["velocity"], m["effort"])
    if name.endswith("WrenchStamped"):
        return WrenchReading(stamp, log_ns, m["wrench"], m["frame_id"])
    if name.endswith("CompressedImage"):
        return PictureReading(stamp, log_ns, m["format"], m["data"], frame_id=m["frame_id"])
    if name.endswith("Image"):
        size = (m["width"], m["height"], m["step"], m["big"])
        return PictureReading(stamp, log_ns, m["encoding"], m["data"], *size, frame_id=m["frame_id"])
    if name.endswith("CameraInfo"):
        matrix = np.reshape(m["k"], (3, 3))
        return LensReading(stamp, log_ns, m["width"], m["height"], m["model"], m["d"], matrix, m["frame_id"])
    hung = [(one["frame_id"], one["child"], one["pose"]) for one in m["transforms"]]
    first = m["transforms"][0]["stamp_ns"] if m["transforms"] else 0
    return TransformReading(first, log_ns, hung)


def _stamp(m: dict[str, Any]) -> int:
    time = m.get("timestamp", {})
    return int(time.get("sec", 0)) * 10**9 + int(time.get("nsec", 0))


def _of_json(name: str, m: dict[str, Any], log_ns: int) -> Message:
    # Our exporter's clock begins at 0, so a stamp of 0 is one: the log time says the same.
    stamp = _stamp(m) or log_ns
    frame = m.get("frame_id", "")
    if name == "foxglove.JointStates":
        joints = m["joints"]
        columns = [
            np.array([one.get(part, np.nan) for one in joints], dtype=float)
            for part in ("position", "velocity", "effort")
        ]
        return JointReading(stamp, log_ns, tuple(str(one["name"]) for one in joints), *columns)
    if name == "foxglove.CompressedImage":
        return PictureReading(stamp, log_ns, m["format"], base64.b64decode(m["data"]), frame_id=frame)
    if name == "foxglove.RawImage":
        data = base64.b64decode(m["data"])
        return PictureReading(stamp, log_ns, m["encoding"], data, m["width"], m["height"], m["step"], frame_id=frame)
    if name == "foxglove.CameraCalibration":
        matrix = np.reshape(np.array(m["K"], dtype=float), (3, 3))
        bent = np.array(m.get("D", []), dtype=float)
        return LensReading(stamp, log_ns, m["width"], m["height"], m.get("distortion_model", ""), bent, matrix, frame)
    if name == "foxglove.FrameTransforms":
        hung = [
            (
                one["parent_frame_id"],
                one["child_frame_id"],
                np.array([*(one["translation"][a] for a in "xyz"), *(one["rotation"][a] for a in "xyzw")], dtype=float),
            )
            for one in m["transforms"]
        ]
        return TransformReading(stamp, log_ns, hung)
    return SegmentReading(stamp, log_ns, m)
