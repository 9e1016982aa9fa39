"""Pictures of a recording as the files that a recording folder takes: JPEG and PNG as they are, raw pixels packed."""

from __future__ import annotations

from collections import deque
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede.faults import fault
from stampede.png import png_of
from stampede.recordings.messages import PictureReading

Array = NDArray[Any]

_PNG, _JPEG = b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff"
_DEPTH_HEAD = 12  # bytes before the PNG of a compressedDepth message
_CHANNELS = {"rgb8": 3, "bgr8": 3, "rgba8": 4, "bgra8": 4, "mono8": 1, "8UC1": 1, "8UC3": 3, "8UC4": 4}
_DEPTHS = {"16UC1": "u2", "mono16": "u2", "32FC1": "f4"}
_CURE = "record rgb8, bgr8, mono8, 16UC1, 32FC1, or compressed as JPEG or PNG; --map rgb=none leaves pictures out"


def packed(picture: Array) -> bytes:
    """A PNG file of height x width x 3 uint8, or of height x width uint16. Quick rather than small."""
    return png_of(picture, "recordings")


class Packers:
    """Threads that pack raw pictures into files. What was put last is there after finish(), which raises the first
    Error in the order of put(). The pool is the caller's, and ends before the folder does."""

    _MOST = 8  # that wait: they are large

    def __init__(self, pool: ThreadPoolExecutor) -> None:
        self._pool = pool
        self._waiting: deque[Future[int]] = deque()

    def put(self, path: Path, picture: PictureReading, kind: str, place: str) -> None:
        if len(self._waiting) == self._MOST:
            self._waiting.popleft().result()
        self._waiting.append(self._pool.submit(lambda: path.write_bytes(file_of(picture, kind, place)[0])))

    def finish(self) -> None:
        while self._waiting:
            self._waiting.popleft().result()


def file_of(picture: PictureReading, kind: str, place: str) -> tuple[bytes, str]:
    """The picture as a file, and its name's ending. kind: rgb or depth. Raises Error for what is not read."""
    if picture.width == 0:
        return _of_file(picture, kind, place)
    if kind == "depth":
        return packed(_depth(picture, place)), "png"
    return packed(_colours(picture, place)), "png"


def _of_file(picture: PictureReading, kind: str, place: str) -> tuple[bytes, str]:
    data = picture.data
    if "compressedDepth" in picture.encoding:
        if not picture.encoding.startswith(("16UC1", "mono16")):
            raise fault(place, f"'{picture.encoding}' is not read", "record depth as 16UC1, in mm")
        data = data[_DEPTH_HEAD:]
    if data.startswith(_PNG):
        if not data.rstrip(b"\0").endswith(b"IEND\xaeB`\x82"):
            raise fault(place, "a PNG picture ends early", "record again, or leave the topic out with --map")
        return data, "png"
    if data.startswith(_JPEG) and kind == "rgb":
        if b"\xff\xd9" not in data[-64:]:
            raise fault(place, "a JPEG picture ends early", "record again, or leave the topic out with --map")
        return data, "jpg"
    raise fault(place, f"compressed pictures in the format '{picture.encoding}' are not read", _CURE)


def _pixels(picture: PictureReading, place: str, width: int, channels: int) -> Array:
    """height x width x bytes of a pixel, rows without their padding."""
    used = picture.width * channels * width
    step = picture.step or used
    if picture.height == 0 or step < used or len(picture.data) < step * picture.height:
        raise fault(
            place,
            f"a picture of {picture.width} x {picture.height} in {picture.encoding} has {len(picture.data)} bytes",
            "record again, or leave the topic out with --map",
        )
    rows = np.frombuffer(picture.data, dtype=np.uint8, count=step * picture.height).reshape(picture.height, step)
    return rows[:, :used]


def _colours(picture: PictureReading, place: str) -> Array:
    channels = _CHANNELS.get(picture.encoding)
    if channels is None:
        raise fault(place, f"pixels in the encoding '{picture.encoding}' are not read", _CURE)
    pixels = _pixels(picture, place, 1, channels).reshape(picture.height, picture.width, channels)
    if channels == 1:
        return np.repeat(pixels, 3, axis=2)
    # 8UC3 says no order; OpenCV, which writes it, has blue first.
    return pixels[..., :3] if picture.encoding.startswith("rgb") else pixels[..., 2::-1]


def _depth(picture: PictureReading, place: str) -> Array:
    """height x width uint16, mm; 0: no reading."""
    kind = _DEPTHS.get(picture.encoding)
    if kind is None:
        raise fault(place, f"depth in the encoding '{picture.encoding}' is not read", _CURE)
    order = ">" if picture.big else "<"
    values = np.ascontiguousarray(_pixels(picture, place, int(kind[1]), 1)).view(order + kind)
    if kind == "u2":
        return values.astype(np.uint16)
    mm = np.nan_to_num(values * 1000.0, nan=0.0, posinf=0.0, neginf=0.0)
    return np.where((mm > 0) & (mm < 65535.5), np.round(mm), 0).astype(np.uint16)
