"""Poses of cameras and boards, what joints read beside the truth, and what clocks are off by: all at once, from where
corners are in pictures.

A corner of board b in a picture of camera c, stamped s, is seen at
    project(inverse(base_from_mount_c(q) X_c) base_from_mount_b(q) Y_b corner),  q = joints(t) + offsets,
    t = s + offset_c + drift_c (s - reference_c).
Where nothing says which way joint 1 points, the base's x axis is where it reads 0; where nothing says how the board
sits in the hand, the last joint's zero is the hand's. So these two offsets are free only where a board's pose is
known: one that stands frees the first, one in the hand the last.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede.calibrate.lens import Lens
from stampede.calibrate.poses import inverse, moved, step_between
from stampede.calibrate.recorded import JointStates
from stampede.calibrate.problem import Camera, FixedBoard, Seen
from stampede.calibrate.solve import least_squares
from stampede.robots import Robot

Array = NDArray[Any]

_OFFSET = np.radians(2.0)  # rad: what joints are off by at most, about; a prior
_DRIFT = 100.0  # ppm: as quartz
_LENS = 8  # focal 2, centre 2, k1 k2 p1 p2
_PIXEL_SCALE = np.array([1.0, 1.0, 1.0, 1.0, 1e-3, 1e-3, 1e-4, 1e-4])


@dataclass
class CameraResult:
    name: str
    mount: str
    pose: Array  # mount_from_camera, base's frame where it stands
    pose_deviation: Array  # 3 m and 3 rad, in the camera's frame
    offset_s: float
    offset_deviation_s: float
    drift_ppm: float
    drift_deviation_ppm: float
    reference_s: float  # on the camera's clock
    lens: Lens
    lens_deviation: Array
    rms: float  # pixels
    median: float
    pictures: int
    corners: int
    worst: list[tuple[float, float]] = field(default_factory=list)  # time and rms of its worst pictures


@dataclass
class Result:
    cameras: list[CameraResult]
    boards: list[Array]  # mount_from_board
    board_deviations: list[Array]
    offsets: Array  # rad, to be added to what joints read
    offset_deviations: Array
    freed: list[bool]  # whether a joint's offset was looked for
    rms: float  # pixels
    noise: float  # pixels
    rounds: int


class Bundle:
    def __init__(
        self,
        robot: Robot,
        joints: JointStates,
        cameras: list[Camera],
        boards: list[FixedBoard],
        seen: list[Seen],
        refine_lens: bool = True,
        with_joints: bool = True,
        with_clocks: bool = True,
    ) -> None:
        self._robot, self._joints, self._cameras, self._boards = robot, joints, cameras, boards
        self._seen = sorted(seen, key=lambda one: one.camera)
        self._points = np.concatenate([one.sighting.points for one in self._seen])
        self._pixels = np.concatenate([one.sighting.pixels for one in self._seen])
        self._picture = np.repeat(np.arange(len(self._seen)), [len(one.sighting.points) for one in self._seen])
        self._camera_of = np.array([one.camera for one in self._seen])
        self._times = np.array([one.time for one in self._seen])
        self._references = np.array([np.mean(self._times[self._camera_of == number]) for number in range(len(cameras))])
        self._links = sorted({*(one.mount for one in cameras), *(one.mount for one in boards)})
        count, arm = len(cameras), len(robot.arm)
        self._at_boards = 6 * count
        self._at_joints = self._at_boards + 6 * len(boards)
        self._at_clocks = self._at_joints + arm
        self._at_lenses = self._at_clocks + 2 * count
        self.size = self._at_lenses + _LENS * count
        self.freed = self._free_joints(with_joints)
        self._prior = np.full(self.size, np.inf)
        for number, board in enumerate(boards):
            if board.deviation is not None:
                at = self._at_boards + 6 * number
                self._prior[at : at + 6] = np.repeat(board.deviation, 3)
        self._prior[self._at_joints : self._at_clocks] = np.where(self.freed, _OFFSET, 0.0)
        for number in range(count):
            at = self._at_clocks + 2 * number
            self._prior[at : at + 2] = [np.inf, _DRIFT] if with_clocks else [0, 0]
        if not refine_lens:
            self._prior[self._at_lenses :] = 0

    def _free_joints(self, wanted: bool) -> Array:
        free = np.full(len(self._robot.arm), wanted)
        base, hand = self._robot.base, self._robot.hand
        if not any(board.mount == base and board.deviation for board in self._boards):
            free[0] = False
        if not any(board.mount == hand and board.deviation for board in self._boards):
            free[-1] = False
        return free

    def solve(self) -> Result:
        start = np.zeros(self.size)
        for number, camera in enumerate(self._cameras):
            start[self._at_clocks + 2 * number] = camera.offset_s
        steps = np.full(self.size, 1e-5)
        for number in range(len(self._cameras)):
            steps[self._at_clocks + 2 * number] = 1e-4  # s
            steps[self._at_clocks + 2 * number + 1] = 1.0  # ppm
            at = self._at_lenses + _LENS * number
            steps[at : at + _LENS] = 1e-2  # of the scale
        prior = self._prior.copy()
        answer = least_squares(self.residuals, start, steps, prior, self._picture)
        return self._result(answer.values, answer.deviations, answer.residuals, answer.rounds, answer.noise)

    def residuals(self, values: Array) -> Array:
        """2 x corners, pixels: what is predicted less what was seen."""
        offsets = values[self._at_joints : self._at_clocks]
        clocks = values[self._at_clocks : self._at_lenses].reshape(-1, 2)[self._camera_of]
        times = self._times + clocks[:, 0] + clocks[:, 1] * 1e-6 * (self._times - self._references[self._camera_of])
        links = self._robot.poses(self._joints.at(times) + offsets, self._links)
        camera_from_board = np.empty((len(self._seen), 4, 4))
        for number, camera in enumerate(self._cameras):
            pose = self._camera_pose(values, number)
            for index, board in enumerate(self._boards):
                own = [k for k, one in enumerate(self._seen) if one.camera == number and one.board == index]
                if own:
                    hung = links[board.mount][own] @ self._board_pose(values, index)
                    camera_from_board[own] = inverse(links[camera.mount][own] @ pose) @ hung
        poses = camera_from_board[self._picture]
        seen = np.einsum("nij,nj->ni", poses[:, :3, :3], self._points) + poses[:, :3, 3]
        seen[:, 2] = np.maximum(seen[:, 2], 1e-3)
        predicted = np.empty_like(self._pixels)
        for number in range(len(self._cameras)):
            own_points = self._camera_of[self._picture] == number
            predicted[own_points] = self._lens(values, number).project(seen[own_points])
        return (predicted - self._pixels).ravel()

    def _camera_pose(self, values: Array, number: int) -> Array:
        return moved(self._cameras[number].pose, values[6 * number : 6 * number + 6])

    def _board_pose(self, values: Array, number: int) -> Array:
        at = self._at_boards + 6 * number
        pose = self._boards[number].pose
        assert pose is not None
        return moved(pose, values[at : at + 6])

    def _lens(self, values: Array, number: int) -> Lens:
        at = self._at_lenses + _LENS * number
        change = values[at : at + _LENS] * _PIXEL_SCALE
        lens = self._cameras[number].lens
        bent = lens.distortion.copy()
        bent[:4] += change[4:]
        return Lens(lens.width, lens.height, lens.focal + change[:2], lens.centre + change[2:4], bent)

    def _result(self, values: Array, deviations: Array, residuals: Array, rounds: int, noise: float) -> Result:
        off = np.linalg.norm(residuals.reshape(-1, 2), axis=1)
        cameras = []
        for number, camera in enumerate(self._cameras):
            own = self._camera_of[self._picture] == number
            clock = self._at_clocks + 2 * number
            lens_at = self._at_lenses + _LENS * number
            pictures = np.flatnonzero(self._camera_of == number)
            each = [float(np.sqrt((off[self._picture == k] ** 2).mean())) for k in pictures]
            worst = np.argsort(each)[::-1][:3]
            cameras.append(
                CameraResult(
                    name=camera.name,
                    mount=camera.mount,
                    pose=self._camera_pose(values, number),
                    pose_deviation=deviations[6 * number : 6 * number + 6],
                    offset_s=float(values[clock]),
                    offset_deviation_s=float(deviations[clock]),
                    drift_ppm=float(values[clock + 1]),
                    drift_deviation_ppm=float(deviations[clock + 1]),
                    reference_s=float(self._references[number]),
                    lens=self._lens(values, number),
                    lens_deviation=deviations[lens_at : lens_at + _LENS] * _PIXEL_SCALE,
                    rms=float(np.sqrt((off[own] ** 2).mean())),
                    median=float(np.median(off[own])),
                    pictures=len(pictures),
                    corners=int(own.sum()),
                    worst=[(float(self._times[pictures[k]]), each[k]) for k in worst],
                )
            )
        boards = [self._board_pose(values, number) for number in range(len(self._boards))]
        at = self._at_boards
        return Result(
            cameras=cameras,
            boards=boards,
            board_deviations=[deviations[at + 6 * k : at + 6 * k + 6] for k in range(len(boards))],
            offsets=values[self._at_joints : self._at_clocks],
            offset_deviations=deviations[self._at_joints : self._at_clocks],
            freed=[bool(one) for one in self.freed],
            rms=float(np.sqrt((off**2).mean())),
            noise=noise,
            rounds=rounds,
        )


def pose_error(found: Array, true: Array) -> tuple[float, float]:
    """m and rad between two poses."""
    step = step_between(true, found)
    return float(np.linalg.norm(found[:3, 3] - true[:3, 3])), float(np.linalg.norm(step[3:]))
