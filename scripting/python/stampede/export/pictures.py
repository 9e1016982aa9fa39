"""Colours that one camera saw, as PNG files."""

from __future__ import annotations

import struct
import zlib

import numpy as np

from stampede.catalogue import StoredEpisode
from stampede.export.steps import Array


def png_files(episode: StoredEpisode, camera: str) -> list[bytes]:
    """One a frame: those that are stored as they are; where some are not, or not as PNG, all are drawn or read, and
    packed."""
    stored = episode.catalogue.query(
        "SELECT data FROM images WHERE episode = ?1 AND camera = ?2 AND kind = 'rgb' ORDER BY frame", episode.id, camera
    )
    files: list[bytes] = stored.values("data")  # type: ignore[assignment]
    if len(files) == episode.frames and all(map(is_png, files)):
        return files
    return [packed(picture) for picture in episode.pictures(f"{camera}_rgb", draw=True)]


def is_png(file: bytes) -> bool:
    """Else it is JPEG, as real robots' cameras have it."""
    return file[:8] == b"\x89PNG\r\n\x1a\n"


def packed(picture: Array) -> bytes:
    """height x width x 3 uint8 as a PNG file."""
    height, width = picture.shape[:2]
    rows = np.hstack([np.zeros((height, 1), dtype=np.uint8), picture.reshape(height, -1)])  # 0: a row as it is
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)  # 8 bits a channel, 2: red, green and blue
    parts = [(b"IHDR", head), (b"IDAT", zlib.compress(rows.tobytes())), (b"IEND", b"")]
    chunks = [
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in parts
    ]
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunks)


def size_of(png: bytes) -> tuple[int, int]:
    """Height and width of a PNG file."""
    width, height = struct.unpack(">II", png[16:24])
    return height, width
