"""A laboratory that is not there: an arm with a board in its hand, recorded as a real one is, and what was true of it.

`record(folder, seed, …)` draws a robot that is not quite ours (other masses), a camera that stands elsewhere than
planned and bends straight lines, and sensors and clocks as `python -m stampede.recordings synthesize` has them; lets the
arm move; and writes what its drivers would have recorded, as ROS 2 does, in MCAP. The truth is given back, for
comparison alone: nothing of it is in the bag.
"""

from __future__ import annotations

import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from laboratory_scripts import BASE, DRIVER_EVERY, FRAME_HZ, SIZE, SQUARE_M, SQUARES, write_library
from ros_bag import RosBag

import stampede
from stampede.calibrate.poses import turned
from stampede.recordings import sensors
from stampede.recordings.sensors import Recorder, Sensors
from stampede.recordings.synthesize import as_jpeg
from stampede.robots import Robot, robot_of

Array = NDArray[Any]

RECORDER = Recorder(joints_every=DRIVER_EVERY, pictures_every=16)  # pictures at 15 Hz
_HOME = np.array([0, -np.pi / 4, 0, -3 * np.pi / 4, 0, np.pi / 2, np.pi / 4])
_SPREAD = np.array([0.45, 0.35, 0.45, 0.40, 0.60, 0.45, 0.80])  # rad, about home


@dataclass
class Truth:
    """What the recording hides."""

    world_from_camera: Array  # 4 x 4
    matrix: Array  # 3 x 3, OpenCV's pixel centres
    distortion: Array  # k1 k2 p1 p2 k3
    hand_from_board: Array
    sensors: Sensors

    @property
    def joint_offsets(self) -> Array:
        return self.sensors.joint_offsets

    @property
    def torque(self) -> dict[str, Array]:
        return self.sensors.torque

    @property
    def camera_offset_s(self) -> float:
        return self.sensors.clocks["lab"].offset_s

    @property
    def drift_ppm(self) -> float:
        return self.sensors.clocks["lab"].drift_ppm


def draw_truth(seed: int, joint_offset_deg: float = 0.5) -> Truth:
    rng = np.random.default_rng([seed, 1])
    at = np.array([0.95, 0.05, 1.32]) + rng.uniform(-0.05, 0.05, 3)
    camera = _looking(at, np.array([0.20, 0.0, 1.12]) + rng.uniform(-0.03, 0.03, 3))
    camera[:3, :3] = camera[:3, :3] @ turned(np.radians(rng.uniform(-4, 4, 3)))
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
    tilt = turned(np.radians(rng.uniform(-3, 3, 3)))
    hand_from_board[:3, :3] = tilt @ np.stack([right, np.cross(into, right), into], axis=1)
    centre = np.array([SQUARES[0], SQUARES[1], 0]) * SQUARE_M / 2
    hand_from_board[:3, 3] = (
        np.array([0.05, 0.0, 0.19]) + rng.uniform(-0.01, 0.01, 3) - hand_from_board[:3, :3] @ centre
    )
    return Truth(
        world_from_camera=camera,
        matrix=matrix,
        distortion=bent,
        hand_from_board=hand_from_board,
        sensors=sensors.draw_sensors(rng, 7, ["lab"], joint_offset_deg),
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
        pictures = sensors.drawn_pictures(episode)
        sensors.record(bag, episode, truth.sensors, RECORDER, rng, pictures, as_jpeg)
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
