"""Colours that one camera saw, as PNG files."""

from __future__ import annotations

import struct

from stampede.catalogue import StoredEpisode
from stampede.png import png_of


def png_files(episode: StoredEpisode, camera: str) -> list[bytes]:
    """One a frame: those that are stored as they are; where some are not, or not as PNG, all are drawn or read, and
    packed."""
    stored = episode.catalogue.query(
        "SELECT data FROM images WHERE episode = ?1 AND camera = ?2 AND kind = 'rgb' ORDER BY frame", episode.id, camera
    )
    files: list[bytes] = stored.values("data")  # type: ignore[assignment]
    if len(files) == episode.frames and all(map(is_png, files)):
        return files
    return [png_of(picture, "rlds") for picture in episode.pictures(f"{camera}_rgb", draw=True)]


def is_png(file: bytes) -> bool:
    """Else it is JPEG, as real robots' cameras have it."""
    return file[:8] == b"\x89PNG\r\n\x1a\n"


def size_of(png: bytes) -> tuple[int, int]:
    """Height and width of a PNG file."""
    width, height = struct.unpack(">II", png[16:24])
    return height, width
