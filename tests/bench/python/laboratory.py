"""A laboratory that is not there: an arm with a board in its hand, recorded as a real one is, and what was true of it.

`record(folder, seed, …)` draws a robot that is not quite ours (other masses, joints that read beside the truth, torque
sensors with friction, drift and noise), a camera that stands elsewhere than planned and bends straight lines, and
clocks that disagree; lets the arm move; and writes what its drivers would have recorded, as ROS 2 does, in MCAP. The
truth is given back, for comparison alone: nothing of it is in the bag.
"""

from __future__ import annotations

import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray
from laboratory_scripts import BASE, DRIVER_EVERY, FRAME_HZ, SIZE, SQUARE_M, SQUARES, write_library
from ros_bag import RosBag

import stampede
from stampede.robots import Robot, robot_of, rotation

Array = NDArray[Any]

PICTURE_EVERY = 16  # frames: 15 Hz
EPOCH_S = 1_700_000_000
_HOME = np.array([0, -np.pi / 4, 0, -3 * np.pi / 4, 0, np.pi / 2, np.pi / 4])
_SPREAD = np.array([0.45, 0.35, 0.45, 0.40, 0.60, 0.45, 0.80])  # rad, about home


@dataclass
class Truth:
    """What the recording hides."""

    world_from_camera: Array  # 4 x 4
    matrix: Array  # 3 x 3, OpenCV's pixel centres
    distortion: Array  # k1 k2 p1 p2 k3
    hand_from_board: Array
    joint_offsets: Array  # rad: what joints are, less what they read
    camera_offset_s: float  # what is added to the camera's stamps to have the robot's
    drift_ppm: float
    torque: dict[str, Array] = field(default_factory=dict)  # coulomb, viscous, offset, drift, white, by joint
    drift_time_s: float = 60.0
    dropped: int = 0  # pictures


def draw_truth(seed: int, joint_offset_deg: float = 0.5) -> Truth:
    rng = np.random.default_rng([seed, 1])
    at = np.array([0.95, 0.05, 1.32]) + rng.uniform(-0.05, 0.05, 3)
    camera = _looking(at, np.array([0.20, 0.0, 1.12]) + rng.uniform(-0.03, 0.03, 3))
    camera[:3, :3] = camera[:3, :3] @ rotation(np.radians(rng.uniform(-4, 4, 3)))
    focal = rng.uniform(590, 640)
    matrix = np.array(
        [
            [focal, 0, 319.5 + rng.uniform(-8, 8)],
            [0, focal * rng.uniform(0.997, 1.003), 239.5 + rng.uniform(-8, 8)],
            [0, 0, 1],
        ]
    )
    bent = np.array([rng.uniform(-0.12, 0.08), rng.uniform(-0.06, 0.06), *rng.uniform(-0.001, 0.001, 2), 0.0])
    hand_from_board = np.eye(4)  # it hangs before the fingers and looks forward and up; OpenCV's z goes into it
    into = np.array([-np.cos(0.45), 0.0, np.sin(0.45)])
    right = np.array([0.0, -1.0, 0.0])
    tilt = rotation(np.radians(rng.uniform(-3, 3, 3)))
    hand_from_board[:3, :3] = tilt @ np.stack([right, np.cross(into, right), into], axis=1)
    centre = np.array([SQUARES[0], SQUARES[1], 0]) * SQUARE_M / 2
    hand_from_board[:3, 3] = (
        np.array([0.05, 0.0, 0.19]) + rng.uniform(-0.01, 0.01, 3) - hand_from_board[:3, :3] @ centre
    )
    arm = 7
    torque = {
        "coulomb": rng.uniform(0.2, 1.0, arm) * [1, 1, 1, 1, 0.4, 0.4, 0.4],
        "viscous": rng.uniform(0.1, 0.8, arm) * [1, 1, 1, 1, 0.4, 0.4, 0.4],
        "offset": rng.uniform(-1.0, 1.0, arm) * [1, 1, 1, 1, 0.3, 0.3, 0.3],
        "drift": rng.uniform(-0.8, 0.8, arm) * [1, 1, 1, 1, 0.3, 0.3, 0.3],
        "white": rng.uniform(0.05, 0.15, arm) * [1, 1, 1, 1, 0.4, 0.4, 0.4],
    }
    return Truth(
        world_from_camera=camera,
        matrix=matrix,
        distortion=bent,
        hand_from_board=hand_from_board,
        joint_offsets=np.radians(rng.uniform(-joint_offset_deg, joint_offset_deg, arm)),
        camera_offset_s=rng.uniform(-0.08, 0.08),
        drift_ppm=rng.uniform(-50, 50),
        torque=torque,
        drift_time_s=rng.uniform(20, 40),
    )


def _looking(at: Array, target: Array) -> Array:
    forward = (target - at) / np.linalg.norm(target - at)
    right = np.cross(forward, [0, 0, 1])
    right /= np.linalg.norm(right)
    pose = np.eye(4)
    pose[:3, :3] = np.stack([right, np.cross(forward, right), forward], axis=1)
    pose[:3, 3] = at
    return pose


def way_points(robot: Robot, truth: Truth, count: int, rng: np.random.Generator) -> Array:
    """Configurations in which the camera sees the whole board, well."""
    found: list[Array] = []
    corners = np.array([[x, y, 0, 1.0] for x in (0, 1) for y in (0, 1)]) * [*np.array(SQUARES) * SQUARE_M, 1, 1]
    camera_from_world = np.linalg.inv(truth.world_from_camera)
    while len(found) < count:
        tries = _HOME + rng.uniform(-1, 1, (400, 7)) * _SPREAD
        hands = robot.poses(tries, ["hand"])["hand"].copy()
        hands[:, :3, 3] += BASE
        boards = hands @ truth.hand_from_board
        seen = np.einsum("ij,njk,lk->nli", camera_from_world, boards, corners)
        pixels = seen[..., :2] / seen[..., 2:3] * truth.matrix[0, 0] + truth.matrix[:2, 2]
        inside = ((pixels > 25) & (pixels < np.array(SIZE) - 25)).all(axis=(1, 2)) & (seen[..., 2] > 0.4).all(axis=1)
        facing = np.einsum("ij,nj->ni", camera_from_world[:3, :3], boards[:, :3, 2])[:, 2] > np.cos(np.radians(50))
        high = (boards @ corners.T)[:, 2].min(axis=1) > 0.80
        found += list(tries[inside & facing & high])
    return np.array(found[:count])


def motion(points: Array, rng: np.random.Generator) -> Array:
    """Joint positions of every frame: from one point to the next with minimum jerk, some slowly, some fast."""
    rows = [np.repeat(points[:1], FRAME_HZ // 2, axis=0)]
    for start, end in zip(points[:-1], points[1:], strict=True):
        count = int(rng.uniform(1.2, 2.2) * max(1.0, np.abs(end - start).max() / 0.8) * FRAME_HZ)
        s = np.arange(1, count + 1) / count
        share = 10 * s**3 - 15 * s**4 + 6 * s**5
        rows.append(start + share[:, None] * (end - start))
    return np.concatenate(rows)


def move(folder: Path, truth: Truth, seed: int, seconds: float) -> stampede.StoredEpisode:
    """The arm moves about; the episode as it really was."""
    catalogue = folder / "true.db"
    session = stampede.Session(paths=[folder / "library"], catalogue=catalogue)
    world = session.environment("wave", channels=["joint_positions"], horizon_s=10 * seconds, record=True)
    now = world.reset(stampede.Reset(seed=seed))
    robot, rng = robot_of("panda"), np.random.default_rng([seed, 3])
    count = int(seconds / 1.4) + 2
    points = np.concatenate([now["joint_positions"][None], way_points(robot, truth, count, rng)])
    path = motion(points, rng)[: int(seconds * FRAME_HZ)]
    np.savetxt(folder / "motion.csv", path, delimiter=",")  # for `play`
    for row in path:
        step = world.step(stampede.Action("joint_position", row.tolist()))
        assert not step.refusal, step.refusal
    world.episode()
    return next(iter(stampede.Catalogue(catalogue)))


def record(folder: Path, seed: int, seconds: float = 60.0, form: str = "mcap", truth: Truth | None = None) -> Truth:
    """Writes folder/bag, what drivers recorded. form: mcap or db3. Gives the truth."""
    folder.mkdir(parents=True)
    truth = truth or draw_truth(seed)
    write_library(folder / "library", truth, seed)
    episode = move(folder, truth, seed, seconds)
    rng = np.random.default_rng([seed, 4])
    with RosBag(folder / "bag", form) as bag:
        _write_joints(bag, episode, truth, rng)
        _write_pictures(bag, episode, truth, rng)
    return truth


def torque_errors(folder: Path, seed: int, noise: Path) -> Array:
    """What `run --noise torque=FILE` adds to the torques of the recorded motion: samples x joints, N m."""
    program = Path(stampede.__file__).parent / "engine" / "bin" / "stampede"
    play = f"{sys.executable} {Path(__file__).with_name('play.py')} {folder / 'motion.csv'}"
    readings = []
    for name, options in (("ideal", []), ("noisy", ["--noise", f"torque={noise}"])):
        catalogue = folder / f"{name}.db"
        command = [
            str(program),
            "run",
            "wave",
            "--path",
            str(folder / "library"),
            "--seed",
            str(seed),
            "--policy",
            play,
        ]
        command += ["--observe", "time", "--out", str(catalogue), *options]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert catalogue.exists(), done.stderr
        readings.append(next(iter(stampede.Catalogue(catalogue))).arrays("sensor")["sensor/joint_torque"])
    return readings[1] - readings[0]


def measured_torques(torques: Array, velocities: Array, times: Array, truth: Truth, rng: np.random.Generator) -> Array:
    """What the sensors make of them."""
    t = truth.torque
    warm = 1 - np.exp(-times / truth.drift_time_s)
    friction = t["coulomb"] * np.tanh(velocities / 0.02) + t["viscous"] * velocities
    return torques + friction + t["offset"] + warm[:, None] * t["drift"] + t["white"] * rng.normal(size=torques.shape)


def _write_joints(bag: RosBag, episode: stampede.StoredEpisode, truth: Truth, rng: np.random.Generator) -> None:
    arrays = episode.arrays("joint_positions", "joint_velocities", "joint_forces", "gripper_joint_positions")
    times = np.arange(episode.frames) / FRAME_HZ
    positions = arrays["joint_positions"] - truth.joint_offsets + rng.normal(0, 2e-5, arrays["joint_positions"].shape)
    velocities = arrays["joint_velocities"] + rng.normal(0, 1e-3, positions.shape)
    forces = measured_torques(arrays["joint_forces"], arrays["joint_velocities"], times, truth, rng)
    fingers = arrays["gripper_joint_positions"]
    names = [f"panda_joint{k}" for k in range(1, 8)] + ["panda_finger_joint1", "panda_finger_joint2"]
    still = np.zeros(2)
    for frame in range(1, episode.frames, DRIVER_EVERY):  # no motor has worked at frame 0
        if rng.random() < 0.01:
            continue
        stamp_ns = round((EPOCH_S + times[frame]) * 1e9)
        values = [np.concatenate([positions[frame], fingers[frame]])]
        values += [np.concatenate([velocities[frame], still]), np.concatenate([forces[frame], still])]
        bag.joint_state("/joint_states", stamp_ns, stamp_ns + int(rng.uniform(0.2e6, 1.5e6)), names, *values)


def _write_pictures(bag: RosBag, episode: stampede.StoredEpisode, truth: Truth, rng: np.random.Generator) -> None:
    frames = list(range(PICTURE_EVERY, episode.frames, PICTURE_EVERY))
    start = 0
    while start < len(frames):
        some = frames[start : start + 64]
        start += len(some)
        for frame, picture in zip(some, episode.pictures("lab_rgb", some, draw=True, threads=2), strict=True):
            if rng.random() < 0.03:
                truth.dropped += 1
                continue
            true_s = frame / FRAME_HZ
            # The robot's time is camera_offset_s + stamp, and a little more for each second since the start.
            stamp_s = true_s - truth.camera_offset_s - truth.drift_ppm * 1e-6 * true_s + rng.normal(0, 5e-4)
            stamp_ns = round((EPOCH_S + stamp_s) * 1e9)
            noisy = np.clip(picture + rng.normal(0, 2, picture.shape), 0, 255).astype(np.uint8)
            data = cv2.imencode(".jpg", noisy[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, 92])[1].tobytes()
            log_ns = round((EPOCH_S + true_s + rng.uniform(0.02, 0.05)) * 1e9)
            bag.compressed(
                "/camera/lab/image/compressed", stamp_ns, log_ns, "rgb8; jpeg compressed bgr8", data, "lab_optical"
            )
