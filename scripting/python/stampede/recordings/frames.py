"""Where a bag's transforms say that cameras are, as entries of a camera file."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede.export.steps import matrices
from stampede.recordings.carried import Carried, Tracks, carried
from stampede.recordings.messages import LensReading, TransformReading
from stampede.robots import Robot

Array = NDArray[Any]
Json = dict[str, Any]

_MOVED = 1e-4  # m and 1: a frame whose pose changes by more is not fixed
_TERMS = 5  # of distortion that a camera file has


class Frames:
    """Transforms as they come: those that never change, and of the others how they moved."""

    def __init__(self) -> None:
        self._hung: dict[str, tuple[str, Array]] = {}
        self._last_ns: dict[str, int] = {}
        self._tracks = Tracks()
        self._torn: set[str] = set()  # frames with two parents: nothing is said of them

    def add(self, reading: TransformReading, time_ns: int) -> None:
        for parent, child, pose in reading.transforms:
            frame = matrices(np.asarray(pose, dtype=float)[None])[0]
            known = self._hung.setdefault(child, (parent, frame))
            if known[0] != parent:
                self._torn.add(child)
            elif child in self._tracks or np.abs(known[1] - frame).max() > _MOVED:
                if child not in self._tracks and child in self._last_ns:
                    self._tracks.add(child, self._last_ns[child], known[1])
                self._tracks.add(child, time_ns, frame)
            self._last_ns[child] = time_ns

    def mount_of(self, frame: str, robot: Robot, world_from_base: Array) -> tuple[str, Array] | str:
        """`world` or `robot.LINK`, and mount_from_frame; or why the transforms do not say it."""
        known = frame in self._hung or frame == "world" or link_named(frame, robot)
        if not known or frame in self._torn:
            return f"no transform says where {frame or 'it'} is"
        chain, pose = [frame], np.eye(4)
        while chain[-1] != "world":
            link = link_named(chain[-1], robot)
            if link == robot.base:
                return "world", world_from_base @ pose
            if link:
                return f"robot.{link}", pose
            if chain[-1] in self._tracks:
                return self._carried(frame, robot, world_from_base)
            if chain[-1] not in self._hung or self._hung[chain[-1]][0] in chain:
                return f"no transform leads from {chain[-1]} to the robot or to the world"
            parent, above = self._hung[chain[-1]]
            chain.append(parent)
            pose = above @ pose
        stands = self.base_in_world(robot)
        return "world", pose if stands is None else world_from_base @ np.linalg.inv(stands) @ pose

    def base_in_world(self, robot: Robot) -> Array | None:
        """World from the robot's base, where transforms that never change say it."""
        frame = self._frames_of_links(robot).get(robot.base, "")
        pose, seen = np.eye(4), set()
        while frame != "world":
            if frame in seen or frame not in self._hung or frame in self._tracks or frame in self._torn:
                return None
            seen.add(frame)
            frame, above = self._hung[frame]
            pose = above @ pose
        return pose

    def _carried(self, frame: str, robot: Robot, world_from_base: Array) -> tuple[str, Array] | str:
        """The link that a moving frame moves with."""
        times = self._tracks.times(self._chain(frame))
        fits: dict[str, Carried] = {}
        for link, name in self._frames_of_links(robot).items():
            pairs = [(self._at(name, time), self._at(frame, time)) for time in times]
            poses = [np.linalg.inv(a[1]) @ b[1] for a, b in pairs if a and b and a[0] == b[0]]
            if len(poses) > 1:
                fits[link] = carried(np.array(poses))
        if not fits:
            return f"{frame} moves, and no transform says where a link of {robot.name} is meanwhile"
        nearest = min(fits, key=lambda link: fits[link].spread)
        if not fits[nearest].holds:
            return (
                f"{frame} moves with no link of {robot.name}: with {nearest} it does so best, "
                f"and is off by {1000 * fits[nearest].spread:.0f} mm or mrad"
            )
        # Where several fit, the joints between them were still: each is right for this recording.
        fitting = [link for link, one in fits.items() if one.holds]
        wanted = [link for link in (robot.base, robot.hand) if link in fitting]
        link = wanted[0] if wanted else min(fitting, key=lambda one: float(np.linalg.norm(fits[one].pose[:3, 3])))
        pose = fits[link].pose
        return ("world", world_from_base @ pose) if link == robot.base else (f"robot.{link}", pose)

    def _frames_of_links(self, robot: Robot) -> dict[str, str]:
        """By link, the name of its frame: its own, else the shortest that means it."""
        names = sorted({*self._hung, *(parent for parent, _ in self._hung.values())}, key=lambda one: (len(one), one))
        own = [name for name in names if re.split(r"[._/]", name)[0] == robot.name]
        found: dict[str, str] = {}
        for name in [*own, *names]:
            link = link_named(name, robot)
            if link and (link not in found or name == link):
                found[link] = name
        return found

    def _chain(self, frame: str) -> list[str]:
        """A frame, its parent, and so on."""
        chain = [frame]
        while chain[-1] in self._hung and self._hung[chain[-1]][0] not in chain:
            chain.append(self._hung[chain[-1]][0])
        return chain

    def _at(self, frame: str, time_ns: int) -> tuple[str, Array] | None:
        """The root of its tree and root_from_frame; None: it is not known at this time."""
        chain, pose = self._chain(frame), np.eye(4)
        for one in chain[:-1]:
            if one in self._torn:
                return None
            above = self._tracks.at(one, time_ns) if one in self._tracks else self._hung[one][1]
            if above is None:
                return None
            pose = above @ pose
        return chain[-1], pose


def link_named(frame: str, robot: Robot) -> str | None:
    """The link that a frame's name means: the same, or one that it ends in, `panda_hand`."""
    links = robot.links
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
