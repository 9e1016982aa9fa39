"""Frames that move: how they did, and whether one moved with another."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

_FIXED = 2e-3  # m and rad: what moves by less beside a link hangs from it
_GAP_NS = 10**8  # poses further apart say nothing of the time between them
_WINDOW_NS = 25 * 10**7
_MOST = 4096  # poses kept of a frame
_ASKED = 200  # moments at which two frames are compared


class Tracks:
    """Poses of moving frames over time. Of a long recording every second, fourth … window of 0.25 s is kept, the same
    of all frames: within one they are as dense as they came."""

    def __init__(self) -> None:
        self._times: dict[str, list[int]] = {}
        self._poses: dict[str, list[Array]] = {}
        self._every = 1

    def __contains__(self, frame: str) -> bool:
        return frame in self._times

    def add(self, frame: str, time_ns: int, pose: Array) -> None:
        times, poses = self._times.setdefault(frame, []), self._poses.setdefault(frame, [])
        if not self._keeps(time_ns) or (times and time_ns <= times[-1]):
            return
        times.append(time_ns)
        poses.append(pose)
        if len(times) > _MOST:
            self._every *= 2
            self._thin()

    def times(self, frames: Sequence[str]) -> list[int]:
        """Moments at which one of the frames has a pose, evenly chosen."""
        every = sorted({time for frame in frames for time in self._times.get(frame, [])})
        if len(every) <= _ASKED:
            return every
        return [every[k] for k in np.linspace(0, len(every) - 1, _ASKED).astype(int)]

    def at(self, frame: str, time_ns: int) -> Array | None:
        """Between two poses the mean of both, weighed by time; before the first that one; None: it is not known."""
        times, poses = self._times[frame], self._poses[frame]
        k = bisect_left(times, time_ns)
        if k == len(times):
            return None
        if k == 0 or times[k] == time_ns:
            return poses[k]
        span = times[k] - times[k - 1]
        if span > _GAP_NS:
            return None
        share = (time_ns - times[k - 1]) / span
        return rigid((1 - share) * poses[k - 1] + share * poses[k])

    def _keeps(self, time_ns: int) -> bool:
        return time_ns // _WINDOW_NS % self._every == 0

    def _thin(self) -> None:
        for frame, times in self._times.items():
            kept = [k for k, time in enumerate(times) if self._keeps(time)]
            self._times[frame] = [times[k] for k in kept]
            self._poses[frame] = [self._poses[frame][k] for k in kept]


@dataclass(frozen=True)
class Carried:
    """How one frame sat in another."""

    pose: Array  # 4 x 4, the mean
    spread: float  # m and rad: how far it was from that at most

    @property
    def holds(self) -> bool:
        return self.spread <= _FIXED


def carried(poses: Array) -> Carried:
    """n x 4 x 4."""
    mean = rigid(poses.mean(axis=0))
    moved = np.linalg.norm(poses[:, :3, 3] - mean[:3, 3], axis=1)
    turned = np.linalg.norm(poses[:, :3, :3] - mean[:3, :3], axis=(1, 2)) / np.sqrt(2)  # of small turns the angle
    return Carried(mean, float(max(moved.max(), turned.max())))


def rigid(pose: Array) -> Array:
    """The transform nearest to a mean of some."""
    left, _, right = np.linalg.svd(pose[:3, :3])
    result = np.eye(4)
    result[:3, :3] = left @ np.diag([1, 1, np.linalg.det(left @ right)]) @ right
    result[:3, 3] = pose[:3, 3]
    return result
