"""Messages of a bag as plain values, whoever wrote them: ROS's, by way of rosbags, or Foxglove's schemas as JSON."""

from __future__ import annotations

import base64
import json
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede.faults import fault, reading

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
    name = f"{parts[0]}/msg/{parts[1]}" if len(parts) == 2 else schema
    return "tf2_msgs/msg/TFMessage" if name == "tf/msg/tfMessage" else name  # as old bags of ROS 1 call it


def decoder(topic: str, schema: str, encoding: str) -> Callable[[bytes, int], Message]:
    """What turns the bytes of a topic's messages, and their log times, into readings. Raises Error for an encoding
    that is not read; the decoder raises one, with the topic, for a message that is damaged."""
    name = type_name(schema)
    if encoding in _OF_ROS and name in _READINGS:
        store, made = _typestore(encoding), _READINGS[name]
        read = store.deserialize_cdr if encoding == "cdr" else store.deserialize_ros1
        return _guarded(topic, lambda data, log_ns: made(read(data, name), log_ns))
    if encoding == "json" and name in KINDS:
        return _guarded(topic, lambda data, log_ns: _of_json(name, json.loads(data), log_ns))
    raise fault(
        f"topic {topic}",
        f"messages of type {schema} in the encoding '{encoding}' are not read",
        "record them as ROS does (cdr, ros1), or Foxglove's schemas as JSON; `--map` names other topics",
    )


def _guarded(topic: str, decode: Callable[[bytes, int], Message]) -> Callable[[bytes, int], Message]:
    def read(data: bytes, log_ns: int) -> Message:
        place = f"topic {topic}, message logged at {log_ns / 1e9:.6f} s"
        with reading(place, "record again, or leave the topic out with --map"):
            return decode(data, log_ns)

    return read


# The messages that are read are the same in all versions of ROS 2, and of ROS 1.
_OF_ROS = {"cdr": "ROS2_HUMBLE", "ros1": "ROS1_NOETIC"}


@cache
def _typestore(encoding: str) -> Any:
    from rosbags.typesys import Stores, get_typestore

    return get_typestore(Stores[_OF_ROS[encoding]])


def _stamp_of(header: Any) -> int:
    return int(header.stamp.sec) * 10**9 + int(header.stamp.nanosec)


def _joint_state(m: Any, log_ns: int) -> Message:
    return JointReading(_stamp_of(m.header), log_ns, tuple(m.name), m.position, m.velocity, m.effort)


def _wrench(m: Any, log_ns: int) -> Message:
    values = np.array([getattr(part, axis) for part in (m.wrench.force, m.wrench.torque) for axis in "xyz"])
    return WrenchReading(_stamp_of(m.header), log_ns, values, m.header.frame_id)


def _image(m: Any, log_ns: int) -> Message:
    size = (m.width, m.height, m.step, bool(m.is_bigendian))
    stamp, data = _stamp_of(m.header), bytes(m.data)
    return PictureReading(stamp, log_ns, m.encoding, data, *size, frame_id=m.header.frame_id)


def _compressed(m: Any, log_ns: int) -> Message:
    return PictureReading(_stamp_of(m.header), log_ns, m.format, bytes(m.data), frame_id=m.header.frame_id)


def _camera_info(m: Any, log_ns: int) -> Message:
    matrix, bent = (m.k, m.d) if hasattr(m, "k") else (m.K, m.D)  # ROS 1 has capitals
    return LensReading(
        _stamp_of(m.header),
        log_ns,
        m.width,
        m.height,
        m.distortion_model,
        np.asarray(bent, dtype=float),
        np.reshape(matrix, (3, 3)),
        m.header.frame_id,
    )


def _transforms(m: Any, log_ns: int) -> Message:
    hung = []
    for one in m.transforms:
        place, turn = one.transform.translation, one.transform.rotation
        pose = np.array([place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w])
        hung.append((one.header.frame_id, one.child_frame_id, pose))
    first = _stamp_of(m.transforms[0].header) if m.transforms else 0
    return TransformReading(first, log_ns, hung)


_READINGS: dict[str, Callable[[Any, int], Message]] = {
    "sensor_msgs/msg/JointState": _joint_state,
    "geometry_msgs/msg/WrenchStamped": _wrench,
    "sensor_msgs/msg/Image": _image,
    "sensor_msgs/msg/CompressedImage": _compressed,
    "sensor_msgs/msg/CameraInfo": _camera_info,
    "tf2_msgs/msg/TFMessage": _transforms,
}


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
