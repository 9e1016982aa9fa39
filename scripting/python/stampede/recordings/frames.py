"""Where a bag's transforms say that cameras are, as entries of a camera file."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede.export.steps import matrices
from stampede.recordings.messages import LensReading, TransformReading
from stampede.robots import Robot

Array = NDArray[Any]
Json = dict[str, Any]

_MOVED = 1e-4  # m and 1: a frame whose pose changes by more is not fixed
_TERMS = 5  # of distortion that a camera file has


class Frames:
    """Transforms as they come; those that never change are kept."""

    def __init__(self) -> None:
        self._hung: dict[str, tuple[str, Array]] = {}
        self._moving: set[str] = set()

    def add(self, reading: TransformReading) -> None:
        for parent, child, pose in reading.transforms:
            frame = matrices(np.asarray(pose, dtype=float)[None])[0]
            known = self._hung.setdefault(child, (parent, frame))
            if known[0] != parent or np.abs(known[1] - frame).max() > _MOVED:
                self._moving.add(child)

    def mount_of(self, frame: str, robot: Robot, world_from_base: Array) -> tuple[str, Array] | None:
        """`world` or `robot.LINK`, and mount_from_frame; None: the transforms do not say it."""
        pose = np.eye(4)
        seen: set[str] = set()
        while frame not in seen:
            seen.add(frame)
            link = link_named(frame, robot)
            if link == robot.base:
                return "world", world_from_base @ pose
            if link:
                return f"robot.{link}", pose
            if frame == "world":
                return "world", pose
            if frame not in self._hung or frame in self._moving:
                return None
            frame, above = self._hung[frame]
            pose = above @ pose
        return None


def link_named(frame: str, robot: Robot) -> str | None:
    """The link that a frame's name means: the same, or one that it ends in, `panda_hand`."""
    links = [robot.base, *(joint.child for joint in robot.joints)]
    if frame in links:
        return frame
    ending = [link for link in links if frame.endswith((f"_{link}", f".{link}", f"/{link}"))]
    return max(ending, key=len) if ending else None


def lens_entry(camera: str, lens: LensReading) -> Json | str:
    """Its entry in a camera file, without a mount; or why there can be none."""
    if not (lens.matrix[0, 0] > 0 and lens.matrix[1, 1] > 0):
        return "it was not calibrated: its focal length is 0"
    return entry(camera, lens.width, lens.height, lens.matrix, lens.distortion, lens.model)


def entry(camera: str, width: int, height: int, matrix: Array, distortion: Array, model: str) -> Json | str:
    bent = [float(one) for one in distortion]
    if model in ("equidistant", "fisheye", "kannala_brandt4") or any(bent[_TERMS:]):
        return f"its distortion ({model or len(bent)}) is not k1 k2 p1 p2 k3 (plumb_bob)"
    return {
        "name": camera,
        "width": int(width),
        "height": int(height),
        "camera_matrix": [[float(value) for value in row] for row in matrix],
        "distortion": (bent + [0.0] * _TERMS)[:_TERMS],
        "pixel_centres": "integer",
    }
