"""Bags with the standard messages of ROS 2, by way of rosbags: another hand than the one that reads them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

_STORE = get_typestore(Stores.ROS2_HUMBLE)
_TYPES = _STORE.types
_FORMS = {"mcap": StoragePlugin.MCAP, "db3": StoragePlugin.SQLITE3}


def _floats(values: Any) -> Any:
    return np.array(values, dtype=np.float64).ravel()


class RosBag:
    """A folder with metadata.yaml and a file. Times are ns."""

    def __init__(self, folder: Path, form: str = "mcap") -> None:
        self.folder = folder
        self._writer = Writer(folder, version=9, storage_plugin=_FORMS[form])
        self._topics: dict[str, Any] = {}

    def __enter__(self) -> RosBag:
        self._writer.open()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._writer.close()

    def put(self, topic: str, message: Any, log_ns: int) -> None:
        kind = message.__msgtype__
        if topic not in self._topics:
            self._topics[topic] = self._writer.add_connection(topic, kind, typestore=_STORE)
        self._writer.write(self._topics[topic], log_ns, _STORE.serialize_cdr(message, kind))

    def joint_state(
        self,
        topic: str,
        stamp_ns: int,
        log_ns: int,
        names: Sequence[str],
        position: Any,
        velocity: Any = (),
        effort: Any = (),
    ) -> None:
        values = [_floats(one) for one in (position, velocity, effort)]
        self.put(topic, _TYPES["sensor_msgs/msg/JointState"](_header(stamp_ns), list(names), *values), log_ns)

    def compressed(self, topic: str, stamp_ns: int, log_ns: int, form: str, data: bytes, frame_id: str = "") -> None:
        bytes_ = np.frombuffer(data, dtype=np.uint8)
        self.put(topic, _TYPES["sensor_msgs/msg/CompressedImage"](_header(stamp_ns, frame_id), form, bytes_), log_ns)

    def image(self, topic: str, stamp_ns: int, log_ns: int, encoding: str, pixels: Any, frame_id: str = "") -> None:
        height, width = pixels.shape[:2]
        data = np.frombuffer(pixels.tobytes(), dtype=np.uint8)
        head = _header(stamp_ns, frame_id)
        message = _TYPES["sensor_msgs/msg/Image"](head, height, width, encoding, 0, len(data) // height, data)
        self.put(topic, message, log_ns)

    def camera_info(
        self, topic: str, stamp_ns: int, log_ns: int, size: tuple[int, int], matrix: Any, bent: Any, frame_id: str = ""
    ) -> None:
        region = _TYPES["sensor_msgs/msg/RegionOfInterest"](0, 0, 0, 0, False)
        projection = np.hstack([np.asarray(matrix, dtype=float), np.zeros((3, 1))])
        values = (_floats(bent), _floats(matrix), _floats(np.eye(3)), _floats(projection))
        message = _TYPES["sensor_msgs/msg/CameraInfo"](
            _header(stamp_ns, frame_id), size[1], size[0], "plumb_bob", *values, 0, 0, region
        )
        self.put(topic, message, log_ns)

    def wrench(self, topic: str, stamp_ns: int, log_ns: int, wrench: Sequence[float], frame_id: str = "") -> None:
        vector = _TYPES["geometry_msgs/msg/Vector3"]
        both = _TYPES["geometry_msgs/msg/Wrench"](vector(*wrench[:3]), vector(*wrench[3:]))
        self.put(topic, _TYPES["geometry_msgs/msg/WrenchStamped"](_header(stamp_ns, frame_id), both), log_ns)

    def transform(self, topic: str, stamp_ns: int, log_ns: int, parent: str, child: str, pose: Sequence[float]) -> None:
        made = _TYPES["geometry_msgs/msg/Transform"](
            _TYPES["geometry_msgs/msg/Vector3"](*pose[:3]), _TYPES["geometry_msgs/msg/Quaternion"](*pose[3:])
        )
        stamped = _TYPES["geometry_msgs/msg/TransformStamped"](_header(stamp_ns, parent), child, made)
        self.put(topic, _TYPES["tf2_msgs/msg/TFMessage"]([stamped]), log_ns)


def _header(stamp_ns: int, frame_id: str = "") -> Any:
    time = _TYPES["builtin_interfaces/msg/Time"](stamp_ns // 10**9, stamp_ns % 10**9)
    return _TYPES["std_msgs/msg/Header"](time, frame_id)
