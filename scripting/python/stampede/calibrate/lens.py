"""Focal lengths, principal point and distortion, from pictures of a board (Zhang, 2000, doi:10.1109/34.888718)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede.calibrate.boards import Sighting, opencv
from stampede.faults import fault

Array = NDArray[Any]
Json = dict[str, Any]

_FEWEST = 5  # pictures
_LEAST_TILT = 0.2  # rad
_MOST = 80  # that are used; more are slow and say little


@dataclass
class Lens:
    """What a camera does to points before it. OpenCV's pixel centres."""

    width: int
    height: int
    focal: Array  # 2, pixels
    centre: Array  # 2, pixels
    distortion: Array  # k1 k2 p1 p2 k3
    rms: float = 0.0  # pixels
    errors: Array | None = None  # pixels, of each picture
    deviations: Array | None = None  # of focal, centre, distortion
    pictures: int = 0

    @property
    def matrix(self) -> Array:
        return np.array([[self.focal[0], 0, self.centre[0]], [0, self.focal[1], self.centre[1]], [0, 0, 1.0]])

    def project(self, points: Array) -> Array:
        """n x 3, camera's frame, to pixels."""
        x, y = points[:, 0] / points[:, 2], points[:, 1] / points[:, 2]
        k1, k2, p1, p2, k3 = self.distortion
        square = x * x + y * y
        radial = 1 + square * (k1 + square * (k2 + square * k3))
        bent_x = x * radial + 2 * p1 * x * y + p2 * (square + 2 * x * x)
        bent_y = y * radial + p1 * (square + 2 * y * y) + 2 * p2 * x * y
        return np.stack([bent_x, bent_y], axis=1) * self.focal + self.centre

    def entry(self, name: str) -> Json:
        """Its part of a camera file."""
        return {
            "name": name,
            "width": self.width,
            "height": self.height,
            "camera_matrix": self.matrix.tolist(),
            "distortion": [float(one) for one in self.distortion],
            "pixel_centres": "integer",
        }


def lens_from(entry: Json) -> Lens:
    """Of an entry of a camera file."""
    matrix = np.array(entry["camera_matrix"], dtype=float)
    shift = 0.5 if entry.get("pixel_centres", "integer") == "half" else 0.0
    bent = np.array((list(entry.get("distortion", [])) + [0.0] * 5)[:5], dtype=float)
    return Lens(entry["width"], entry["height"], matrix[[0, 1], [0, 1]], matrix[:2, 2] - shift, bent)


def spread(seen: Sequence[Sighting], most: int) -> list[int]:
    """Which of these to use: each next one is the one that looks least like those chosen."""
    if len(seen) <= most:
        return list(range(len(seen)))
    about = np.array([_looks(one) for one in seen])
    about = (about - about.mean(axis=0)) / (about.std(axis=0) + 1e-9)
    chosen = [int(np.argmax([len(one.pixels) for one in seen]))]
    way = np.linalg.norm(about - about[chosen[0]], axis=1)
    while len(chosen) < most:
        chosen.append(int(np.argmax(way)))
        way = np.minimum(way, np.linalg.norm(about - about[chosen[-1]], axis=1))
    return sorted(chosen)


def _looks(one: Sighting) -> Array:
    """Where the board is in the picture, and its affine shape there."""
    centred = one.points[:, :2] - one.points[:, :2].mean(axis=0)
    shape, *_ = np.linalg.lstsq(centred, one.pixels - one.pixels.mean(axis=0), rcond=None)
    return np.concatenate([one.pixels.mean(axis=0), shape.ravel()])


def _tilt(one: Sighting) -> float:
    """About how far the board is turned away from the picture's plane, rad."""
    long, short = np.linalg.svd(_looks(one)[2:].reshape(2, 2), compute_uv=False)
    return float(np.arccos(np.clip(short / long, 0, 1)))


def find_lens(seen: Sequence[Sighting], size: tuple[int, int], place: str, with_k3: bool = False) -> Lens:
    """Raises Error where there are too few pictures, or they are too much alike."""
    if len(seen) < _FEWEST:
        raise fault(
            place, f"the board is seen in {len(seen)} pictures", f"take {_FEWEST} at least, better 30, from all sides"
        )
    tilt = max(_tilt(one) for one in seen)
    if tilt < _LEAST_TILT:
        raise fault(
            place,
            f"the board is tilted by {np.degrees(tilt):.0f} degrees at most, so nothing says what the focal length is",
            "take them from all sides, tilted by 30 degrees",
        )
    cv2 = opencv()
    chosen = [seen[k] for k in spread(seen, _MOST)]
    flags = 0 if with_k3 else cv2.CALIB_FIX_K3
    try:
        rms, matrix, bent, _, _, deviations, _, errors = cv2.calibrateCameraExtended(
            [one.points.astype(np.float32) for one in chosen],
            [one.pixels.astype(np.float32) for one in chosen],
            size,
            None,
            None,
            flags=flags,
        )
    except cv2.error as error:
        raise fault(
            place, f"no lens fits these pictures: {error.err}", "take them from all sides, tilted by 30 degrees"
        ) from error
    spread_ = np.ravel(deviations)[:9]
    lens = Lens(
        size[0], size[1], matrix[[0, 1], [0, 1]], matrix[:2, 2], np.ravel(bent)[:5], float(rms), np.ravel(errors)
    )
    lens.deviations, lens.pictures = spread_, len(chosen)
    if not np.isfinite(rms) or not np.all(np.isfinite(spread_)) or spread_[0] > 0.05 * lens.focal[0]:
        raise fault(
            place,
            f"the pictures do not say what the focal length is: {lens.focal[0]:.0f} ± {spread_[0]:.0f} pixels",
            "take them from all sides, tilted by 30 degrees",
        )
    return lens
