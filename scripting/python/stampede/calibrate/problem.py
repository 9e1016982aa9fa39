"""What a calibration of poses is about: cameras and boards, what they are fixed to, what was seen of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede.calibrate.boards import Sighting, opencv
from stampede.calibrate.lens import Lens
from stampede.calibrate.poses import inverse, nearest_rotation, robot_world
from stampede.calibrate.recorded import JointStates
from stampede.faults import fault
from stampede.robots import Robot

Array = NDArray[Any]

_FEWEST = 8  # pictures of a camera
_LEAST_TURN = 0.3  # rad: the hand's rotations must spread by so much


@dataclass
class Camera:
    name: str
    mount: str  # link of the robot; its base: it stands
    lens: Lens
    pose: Array = field(default_factory=lambda: np.eye(4))  # mount_from_camera
    offset_s: float = 0.0  # of its clock: what is added to its stamps


@dataclass
class FixedBoard:
    text: str
    mount: str
    pose: Array | None = None  # mount_from_board; None: not known
    deviation: tuple[float, float] | None = None  # m and rad, of a pose that is known


@dataclass
class Seen:
    """A board in one picture."""

    camera: int
    board: int
    time: float  # s, on the camera's clock
    sighting: Sighting
    camera_from_board: Array = field(default_factory=lambda: np.eye(4))


def locate(seen: list[Seen], cameras: list[Camera]) -> list[Seen]:
    """Finds camera_from_board of each by its corners alone; those where that fails are left out."""
    cv2 = opencv()
    found = []
    for one in seen:
        lens = cameras[one.camera].lens
        sight = one.sighting
        worked, turn, way = cv2.solvePnP(
            sight.points, sight.pixels, lens.matrix, lens.distortion, flags=cv2.SOLVEPNP_IPPE
        )
        if not worked or not np.isfinite(way).all():
            continue
        one.camera_from_board = np.eye(4)
        one.camera_from_board[:3, :3] = cv2.Rodrigues(turn)[0]
        one.camera_from_board[:3, 3] = np.ravel(way)
        found.append(one)
    return found


def start(
    robot: Robot,
    joints: JointStates,
    cameras: list[Camera],
    boards: list[FixedBoard],
    seen: list[Seen],
    search_s: float,
) -> None:
    """First values of poses and clocks, good to some centimetres and half a period of the joint states.

    Raises Error where pictures and joint states do not overlap, or the arm has hardly turned.
    """
    for number, camera in enumerate(cameras):
        own = [one for one in seen if one.camera == number]
        if len(own) < _FEWEST:
            raise fault(
                f"camera {camera.name}", f"a board is seen in {len(own)} pictures", f"{_FEWEST} at least, better 100"
            )
        known = [one for one in own if boards[one.board].pose is not None]
        moving = [one for one in own if boards[one.board].mount != camera.mount]
        if moving:
            first = max({one.board for one in moving}, key=lambda b: sum(one.board == b for one in moving))
            chosen = [one for one in moving if one.board == first]
            x, y, camera.offset_s = _search(robot, joints, camera, boards[first], chosen, search_s)
            if boards[first].pose is None:
                camera.pose, boards[first].pose = x, y
                continue
            known = known or chosen
        if not known:
            raise fault(
                f"camera {camera.name}",
                "it sees only boards that stand still to it, of unknown pose",
                "move a board with the hand, or say where one is: --board-at",
            )
        camera.pose = _mean(
            [
                inverse(mount) @ board @ _pose(boards[one.board]) @ inverse(one.camera_from_board)
                for one, mount, board in _mounted(robot, joints, camera, boards, known)
            ]
        )
    for number, board in enumerate(boards):
        if board.pose is not None:
            continue
        of_it = [one for one in seen if one.board == number]
        if not of_it:
            raise fault(f"board {board.text}", "no picture shows it", "check its size, its dictionary and the light")
        found = []
        for index, camera in enumerate(cameras):
            own = [one for one in of_it if one.camera == index]
            found += [
                inverse(held) @ mount @ camera.pose @ one.camera_from_board
                for one, mount, held in _mounted(robot, joints, camera, boards, own)
            ]
        board.pose = _mean(found)


def _pose(board: FixedBoard) -> Array:
    assert board.pose is not None
    return board.pose


def _mounted(
    robot: Robot, joints: JointStates, camera: Camera, boards: list[FixedBoard], seen: list[Seen]
) -> list[tuple[Seen, Array, Array]]:
    """base_from_mount of the camera and of the board, for each."""
    if not seen:
        return []
    times = np.array([one.time for one in seen]) + camera.offset_s
    links = sorted({camera.mount, *(boards[one.board].mount for one in seen)})
    poses = robot.poses(joints.at(times), links)
    return [(one, poses[camera.mount][k], poses[boards[one.board].mount][k]) for k, one in enumerate(seen)]


def _search(
    robot: Robot, joints: JointStates, camera: Camera, board: FixedBoard, seen: list[Seen], search_s: float
) -> tuple[Array, Array, float]:
    """Poses, and the offset of the clock at which the rotations fit best."""
    times = np.array([one.time for one in seen])
    inside = (times > joints.times[0] - search_s) & (times < joints.times[-1] + search_s)
    if inside.sum() < _FEWEST:
        raise fault(
            f"camera {camera.name}",
            f"{int(inside.sum())} of its pictures of the board are from when the arm was recorded: they are from "
            f"{times.min():.1f} to {times.max():.1f} s, joint states from 0 to {joints.times[-1]:.1f} s",
            "give the clocks' offset in recording.json, or convert with --clock log",
        )
    seen = [one for one, there in zip(seen, inside, strict=True) if there]
    times = times[inside]
    seen_poses = np.stack([one.camera_from_board for one in seen])
    backwards = inverse(seen_poses)
    spacing = float(np.median(np.diff(joints.times)))
    step = max(2 * spacing, 0.02)

    def fit(offset: float) -> tuple[Array, Array, float]:
        poses = robot.poses(joints.at(times + offset), [camera.mount, board.mount])
        first = inverse(poses[board.mount]) @ poses[camera.mount]
        return robot_world(first, backwards)

    poses = robot.poses(joints.at(times), [camera.mount, board.mount])
    relative = inverse(poses[board.mount]) @ poses[camera.mount]
    axes = relative[:, :3, :3] @ relative[0, :3, :3].T
    turns = np.arccos(np.clip((np.trace(axes, axis1=1, axis2=2) - 1) / 2, -1, 1))
    if turns.max() < _LEAST_TURN:
        raise fault(
            f"camera {camera.name}",
            f"the hand has turned by {np.degrees(turns.max()):.0f} degrees at most while the board was seen",
            "turn it about two axes by 20 degrees and more",
        )
    offsets = np.arange(-search_s, search_s + step / 2, step)
    best = min(offsets, key=lambda offset: fit(float(offset))[2])
    x, y, _ = fit(float(best))
    return x, y, float(best)


def _mean(poses: list[Array]) -> Array:
    """Of poses that are nearly the same: their median place and mean rotation."""
    stacked = np.stack(poses)
    result = np.eye(4)
    result[:3, 3] = np.median(stacked[:, :3, 3], axis=0)
    result[:3, :3] = nearest_rotation(stacked[:, :3, :3].mean(axis=0))
    return result
