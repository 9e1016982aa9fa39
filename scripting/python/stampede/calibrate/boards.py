"""Boards that cameras are calibrated with, and where pictures show their corners. Needs OpenCV."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede.faults import fault, unknown
from stampede.files import plain_file

Array = NDArray[Any]

_FORMS = "charuco:COLUMNSxROWS:SQUARE_M:MARKER_M:4X4_50, checkerboard:COLUMNSxROWS:SQUARE_M, aruco:ID:SIDE_M:4X4_50"
_LEAST = 4  # corners


def opencv() -> Any:
    """cv2. Raises ImportError that says how to install it."""
    try:
        import cv2
    except ImportError as error:
        raise ImportError('OpenCV is missing\n    pip install "stampede-sim[calibrate]"') from error
    return cv2


@dataclass(frozen=True)
class Sighting:
    """Corners of a board in one picture."""

    points: Array  # n x 3, m, in the board's frame: x right, y down, z into it
    pixels: Array  # n x 2, OpenCV's: the centre of the first pixel is (0, 0)


class Board:
    """`charuco:5x4:0.05:0.037:4X4_50` (squares), `checkerboard:9x6:0.025` (squares), `aruco:7:0.08:4X4_50` (one
    marker).

    A checkerboard has one side with an even and one with an odd number of squares, else it looks the same upside down.
    """

    def __init__(self, text: str) -> None:
        self.text = text
        words = text.split(":")
        self.kind = words[0]
        counts = {"charuco": 5, "checkerboard": 3, "aruco": 4}
        if self.kind not in counts:
            raise unknown(f"board {text}", "kind of board", self.kind, counts)
        if len(words) != counts[self.kind]:
            raise fault(f"board {text}", f"it has {len(words)} parts", f"write one of {_FORMS}")
        try:
            if self.kind == "aruco":
                self._marker, self._side = int(words[1]), float(words[2])
                self.size = (1, 1)
            else:
                columns, rows = words[1].split("x")
                self.size, self._side = (int(columns), int(rows)), float(words[2])
            marker = float(words[3]) if self.kind == "charuco" else 0.0
        except ValueError as error:
            raise fault(f"board {text}", f"{error}", f"write one of {_FORMS}") from error
        if (
            not self._side > 0
            or (self.kind != "aruco" and min(self.size) < 3)
            or (self.kind == "charuco" and not 0 < marker < self._side)
        ):
            raise fault(f"board {text}", "there is no board of this size", f"write one of {_FORMS}")
        if self.kind == "checkerboard" and sum(self.size) % 2 == 0:
            raise fault(
                f"board {text}", "it looks the same upside down", "take one with an even and an odd number of squares"
            )
        self._detector = self._prepared(words, marker)

    def _prepared(self, words: list[str], marker: float) -> Any:
        cv2 = opencv()
        if self.kind == "checkerboard":
            return None
        name = f"DICT_{words[-1].upper().removeprefix('DICT_')}"
        known = [one for one in dir(cv2.aruco) if one.startswith("DICT_")]
        if name not in known:
            raise unknown(f"board {self.text}", "dictionary of markers", words[-1], (one[5:] for one in known))
        dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, name))
        parameters = cv2.aruco.DetectorParameters()
        parameters.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
        if self.kind == "aruco":
            return cv2.aruco.ArucoDetector(dictionary, parameters)
        board = cv2.aruco.CharucoBoard(self.size, self._side, marker, dictionary)
        detector = cv2.aruco.CharucoDetector(board)
        detector.setDetectorParameters(parameters)
        return detector

    def find(self, picture: Array) -> Sighting | None:
        """picture: height x width uint8. None: the board cannot be seen well enough."""
        if self.kind == "charuco":
            pixels, numbers, _, _ = self._detector.detectBoard(picture)
            if numbers is None or len(numbers) < _LEAST:
                return None
            points = np.asarray(self._detector.getBoard().getChessboardCorners())[np.ravel(numbers)]
        elif self.kind == "aruco":
            corners, numbers, _ = self._detector.detectMarkers(picture)
            at = [] if numbers is None else np.flatnonzero(np.ravel(numbers) == self._marker)
            if len(at) != 1:
                return None
            pixels = corners[at[0]]
            points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]) * self._side
        else:
            return self._checkerboard(picture)
        pixels = np.reshape(pixels, (-1, 2)).astype(float)
        if _on_a_line(pixels):
            return None
        return Sighting(np.asarray(points, dtype=float), pixels)

    def _checkerboard(self, picture: Array) -> Sighting | None:
        cv2 = opencv()
        columns, rows = self.size[0] - 1, self.size[1] - 1
        found, pixels = cv2.findChessboardCornersSB(picture, (columns, rows), flags=cv2.CALIB_CB_NORMALIZE_IMAGE)
        if not found:
            return None
        pixels = np.reshape(pixels, (rows, columns, 2)).astype(float)
        # The corner from which it counts may be either of two that are opposite: the square outside of ours is black.
        if _outer_square(picture, pixels) > _outer_square(picture, pixels[::-1, ::-1]):
            pixels = pixels[::-1, ::-1]
        x, y = np.meshgrid(np.arange(columns), np.arange(rows))
        points = np.stack([x, y, np.zeros_like(x)], axis=-1).reshape(-1, 3) * self._side
        return Sighting(points.astype(float), pixels.reshape(-1, 2).copy())


def _outer_square(picture: Array, corners: Array) -> float:
    """How light the square is beyond the first corner."""
    first = corners[0, 0] - 0.5 * (corners[0, 1] - corners[0, 0]) - 0.5 * (corners[1, 0] - corners[0, 0])
    column, row = np.clip(np.round(first).astype(int), 0, np.array(picture.shape[1::-1]) - 1)
    return float(picture[row, column])


def _on_a_line(pixels: Array) -> bool:
    """Corners of one row say nothing of the board's turn."""
    spread = np.linalg.svd(pixels - pixels.mean(axis=0), compute_uv=False)
    return bool(spread[-1] < 2.0 * np.sqrt(len(pixels)))


def read_grey(file: Path) -> Array:
    """Raises Error for what is no picture."""
    cv2 = opencv()
    try:
        data = np.frombuffer(plain_file(file).read_bytes(), dtype=np.uint8)
    except OSError as error:
        raise fault(str(file), f"it cannot be read: {error.strerror}", "check its name and permissions") from error
    picture = cv2.imdecode(data, cv2.IMREAD_GRAYSCALE) if len(data) else None
    if picture is None:
        raise fault(str(file), "it is no picture that can be read", "give PNG or JPEG files")
    return picture  # type: ignore[no-any-return]


def sightings(board: Board, files: Iterable[Path]) -> tuple[list[tuple[int, Sighting]], tuple[int, int]]:
    """Of the files in which the board is seen: their place and what is seen; and width and height of all of them."""
    found: list[tuple[int, Sighting]] = []
    size: tuple[int, int] | None = None
    for place, file in enumerate(files):
        picture = read_grey(file)
        own = (picture.shape[1], picture.shape[0])
        if size is not None and own != size:
            raise fault(
                str(file), f"it has {own[0]} x {own[1]} pixels, the others {size[0]} x {size[1]}", "take them apart"
            )
        size = own
        seen = board.find(picture)
        if seen is not None:
            found.append((place, seen))
    return found, size or (0, 0)
