"""Bags as drivers of real robots leave them: an MCAP file with the standard messages of ROS 2 in CDR."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from stampede.files import check_new, give_name, made_beside

Array = NDArray[Any]

_JOINT_STATE = "sensor_msgs/msg/JointState"
_COMPRESSED = "sensor_msgs/msg/CompressedImage"


class BagWriter(Protocol):
    """What takes a recording's messages. Times are ns."""

    def joint_state(
        self,
        topic: str,
        stamp_ns: int,
        log_ns: int,
        names: Sequence[str],
        position: Any,
        velocity: Any = (),
        effort: Any = (),
    ) -> None: ...

    def compressed(
        self, topic: str, stamp_ns: int, log_ns: int, form: str, data: bytes, frame_id: str = ""
    ) -> None: ...


class McapBagWriter:
    """An MCAP file, by way of the packages mcap and rosbags: under its name once it is whole, and gone after an
    error."""

    def __init__(self, path: Path) -> None:
        try:
            from mcap import writer
            from rosbags.typesys import Stores, get_typestore
        except ImportError as error:
            raise ImportError(f'{error.name} is missing\n    pip install "stampede-sim[recordings]"') from error
        self._path = path
        self._held = ExitStack()
        self._library = writer
        self._types = get_typestore(Stores.ROS2_HUMBLE)
        self._channels: dict[str, int] = {}
        self._schemas: dict[str, int] = {}

    def __enter__(self) -> McapBagWriter:
        check_new(self._path)
        self._made = self._held.enter_context(made_beside(self._path))
        self._stream = self._held.enter_context(self._made.open("wb"))
        self._writer = self._library.Writer(self._stream)
        self._writer.start(profile="ros2", library="stampede")
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with self._held:
            if kind is None:
                self._writer.finish()
                self._stream.close()
                give_name(self._made, self._path)

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
        of_joints = [np.asarray(values, dtype=np.float64).ravel() for values in (position, velocity, effort)]
        self._put(topic, _JOINT_STATE, log_ns, self._header(stamp_ns, ""), list(names), *of_joints)

    def compressed(self, topic: str, stamp_ns: int, log_ns: int, form: str, data: bytes, frame_id: str = "") -> None:
        picture = np.frombuffer(data, dtype=np.uint8)
        self._put(topic, _COMPRESSED, log_ns, self._header(stamp_ns, frame_id), form, picture)

    def _header(self, stamp_ns: int, frame_id: str) -> Any:
        known = self._types.types
        stamp = known["builtin_interfaces/msg/Time"](stamp_ns // 10**9, stamp_ns % 10**9)
        return known["std_msgs/msg/Header"](stamp, frame_id)

    def _put(self, topic: str, schema: str, log_ns: int, *fields: Any) -> None:
        if topic not in self._channels:
            if schema not in self._schemas:
                text, _ = self._types.generate_msgdef(schema, ros_version=2)
                self._schemas[schema] = self._writer.register_schema(schema, "ros2msg", text.encode())
            self._channels[topic] = self._writer.register_channel(topic, "cdr", self._schemas[schema])
        data = bytes(self._types.serialize_cdr(self._types.types[schema](*fields), schema))
        self._writer.add_message(self._channels[topic], log_time=log_ns, publish_time=log_ns, data=data)
