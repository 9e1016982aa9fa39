"""Bags as drivers of real robots leave them: an MCAP file with the standard messages of ROS 2 in CDR."""

from __future__ import annotations

import struct
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

# As ROS 2 defines them: fields in the order in which they are on the wire, and the types that they need.
_RULE = "\n" + "=" * 80 + "\nMSG: "
_HEADER = (
    f"{_RULE}std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id"
    f"{_RULE}builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
)
_JOINT_STATE = "sensor_msgs/msg/JointState"
_COMPRESSED = "sensor_msgs/msg/CompressedImage"
_DEFINITIONS = {
    _JOINT_STATE: "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort",
    _COMPRESSED: "std_msgs/Header header\nstring format\nuint8[] data",
}


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


class CdrWriter:
    """Writes values one after the other, in the machine's usual order: little end first."""

    def __init__(self) -> None:
        self._data = bytearray((0, 1, 0, 0))  # CDR_LE; alignment counts from behind it

    def message(self) -> bytes:
        return bytes(self._data)

    def _align(self, size: int) -> None:
        self._data += bytes(-(len(self._data) - 4) % size)

    def u32(self, value: int) -> None:
        self._align(4)
        self._data += struct.pack("<I", value)

    def header(self, stamp_ns: int, frame_id: str) -> None:
        self._align(4)
        self._data += struct.pack("<iI", stamp_ns // 10**9, stamp_ns % 10**9)
        self.text(frame_id)

    def text(self, value: str) -> None:
        self.blob(value.encode() + b"\0")

    def texts(self, values: Sequence[str]) -> None:
        self.u32(len(values))
        for value in values:
            self.text(value)

    def blob(self, data: bytes) -> None:
        self.u32(len(data))
        self._data += data

    def float_list(self, values: Any) -> None:
        numbers = np.asarray(values, dtype="<f8").ravel()
        self.u32(len(numbers))
        if len(numbers):
            self._align(8)
            self._data += numbers.tobytes()


class McapBagWriter:
    """An MCAP file, by way of the package mcap: under its name once it is whole, and gone after an error."""

    def __init__(self, path: Path) -> None:
        try:
            from mcap import writer
        except ImportError as error:
            raise ImportError('mcap is missing\n    pip install "stampede[recordings]"') from error
        self._path, self._part = path, path.with_name(path.name + ".part")
        self._library = writer
        self._channels: dict[str, int] = {}
        self._schemas: dict[str, int] = {}

    def __enter__(self) -> McapBagWriter:
        self._stream = self._part.open("wb")
        self._writer = self._library.Writer(self._stream)
        self._writer.start(profile="ros2", library="stampede")
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            if kind is None:
                self._writer.finish()
                self._stream.close()
                self._part.rename(self._path)
        finally:
            self._stream.close()
            self._part.unlink(missing_ok=True)

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
        cdr = CdrWriter()
        cdr.header(stamp_ns, "")
        cdr.texts(names)
        for values in (position, velocity, effort):
            cdr.float_list(values)
        self._put(topic, _JOINT_STATE, log_ns, cdr)

    def compressed(self, topic: str, stamp_ns: int, log_ns: int, form: str, data: bytes, frame_id: str = "") -> None:
        cdr = CdrWriter()
        cdr.header(stamp_ns, frame_id)
        cdr.text(form)
        cdr.blob(data)
        self._put(topic, _COMPRESSED, log_ns, cdr)

    def _put(self, topic: str, schema: str, log_ns: int, cdr: CdrWriter) -> None:
        if topic not in self._channels:
            if schema not in self._schemas:
                text = _DEFINITIONS[schema] + _HEADER
                self._schemas[schema] = self._writer.register_schema(schema, "ros2msg", text.encode())
            self._channels[topic] = self._writer.register_channel(topic, "cdr", self._schemas[schema])
        self._writer.add_message(self._channels[topic], log_time=log_ns, publish_time=log_ns, data=cdr.message())
