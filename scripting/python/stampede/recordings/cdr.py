"""Messages of ROS 2 as they are on the wire: CDR (OMG, DDS-XTypes 1.3, section 7.4), the types that recordings have.

Only these are read, field by field in the order of their definitions (common_interfaces): anything else in a bag is
left alone, and no library of ROS is needed.
"""

from __future__ import annotations

import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

_ENCAPSULATION = 4  # bytes: kind and options; alignment counts from behind them
_LITTLE = (0x01, 0x03)  # CDR_LE, PL_CDR_LE


class CdrReader:
    """Reads values one after the other. Raises struct.error or ValueError where the message ends early."""

    def __init__(self, data: bytes) -> None:
        if len(data) < _ENCAPSULATION or data[0] != 0 or data[1] > 0x03:
            raise ValueError("it does not begin as CDR does")
        self._data = memoryview(data)
        self._order = "<" if data[1] in _LITTLE else ">"
        self._at = _ENCAPSULATION
        self._u32 = struct.Struct(self._order + "I")

    def _align(self, size: int) -> int:
        self._at += -(self._at - _ENCAPSULATION) % size
        return self._at

    def u32(self) -> int:
        at = self._align(4)
        self._at = at + 4
        return self._u32.unpack_from(self._data, at)[0]  # type: ignore[no-any-return]

    def i32(self) -> int:
        value = self.u32()
        return value - (1 << 32) if value >= 1 << 31 else value

    def u8(self) -> int:
        self._at += 1
        return self._data[self._at - 1]

    def floats(self, count: int) -> NDArray[np.float64]:
        """float64 of fixed number."""
        if count == 0:
            return np.empty(0)
        at = self._align(8)
        self._at = at + 8 * count
        return np.frombuffer(self._data, dtype=f"{self._order}f8", count=count, offset=at)

    def float_list(self) -> NDArray[np.float64]:
        return self.floats(self._count())

    def text(self) -> str:
        size = self._count()
        at = self._at
        self._at = at + size
        return bytes(self._data[at : max(at, at + size - 1)]).decode()  # its last byte is 0

    def texts(self) -> tuple[str, ...]:
        return tuple(self.text() for _ in range(self._count()))

    def blob(self) -> bytes:
        size = self._count()
        at = self._at
        self._at = at + size
        return bytes(self._data[at : at + size])

    def _count(self) -> int:
        """Of what follows; more than there can be is an end that came early."""
        count = self.u32()
        if count > len(self._data) - self._at:
            raise ValueError(f"{count} values are announced, {len(self._data) - self._at} bytes are left")
        return count


def _header(cdr: CdrReader) -> dict[str, Any]:
    sec, nanosec = cdr.i32(), cdr.u32()
    return {"stamp_ns": sec * 10**9 + nanosec, "frame_id": cdr.text()}


def _joint_state(cdr: CdrReader) -> dict[str, Any]:
    return {
        **_header(cdr),
        "name": cdr.texts(),
        "position": cdr.float_list(),
        "velocity": cdr.float_list(),
        "effort": cdr.float_list(),
    }


def _wrench(cdr: CdrReader) -> dict[str, Any]:
    return {**_header(cdr), "wrench": cdr.floats(6)}


def _image(cdr: CdrReader) -> dict[str, Any]:
    head = _header(cdr)
    height, width = cdr.u32(), cdr.u32()
    encoding, big, step = cdr.text(), bool(cdr.u8()), cdr.u32()
    return {
        **head,
        "height": height,
        "width": width,
        "encoding": encoding,
        "big": big,
        "step": step,
        "data": cdr.blob(),
    }


def _compressed(cdr: CdrReader) -> dict[str, Any]:
    return {**_header(cdr), "format": cdr.text(), "data": cdr.blob()}


def _camera_info(cdr: CdrReader) -> dict[str, Any]:
    head = _header(cdr)
    height, width, model = cdr.u32(), cdr.u32(), cdr.text()
    return {**head, "height": height, "width": width, "model": model, "d": cdr.float_list(), "k": cdr.floats(9)}


def _transforms(cdr: CdrReader) -> dict[str, Any]:
    found = []
    for _ in range(cdr.u32()):
        head = _header(cdr)
        child = cdr.text()
        found.append({**head, "child": child, "pose": cdr.floats(7)})
    return {"transforms": found}


READERS = {
    "sensor_msgs/msg/JointState": _joint_state,
    "geometry_msgs/msg/WrenchStamped": _wrench,
    "sensor_msgs/msg/Image": _image,
    "sensor_msgs/msg/CompressedImage": _compressed,
    "sensor_msgs/msg/CameraInfo": _camera_info,
    "tf2_msgs/msg/TFMessage": _transforms,
}
