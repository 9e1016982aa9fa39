"""What a laboratory's sensors make of what a simulated arm did and its cameras saw, as messages of a bag.

Joints read beside the truth, torque sensors have friction, an offset that drifts while they warm up, and noise; each
camera has a clock of its own; readings and pictures get lost, and are logged late. All of it is drawn by a seed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede.catalogue import StoredEpisode
from stampede.recordings.bag_writer import BagWriter

Array = NDArray[Any]

EPOCH_S = 1_700_000_000  # the stamp of frame 0 on the robot's clock
DROP = 0.03
LATENCY_S = (0.02, 0.05)
JOINT_OFFSET_DEG = 0.5
CLOCK_OFFSET_S, DRIFT_PPM = 0.08, 50.0  # at most

_POSITION, _VELOCITY = 2e-5, 1e-3  # rad, rad/s: deviations of what joints read
_STAMP_S, _GREY = 5e-4, 2.0  # deviations of a picture's stamp, and of its pixels in grey levels of 255
_WRIST = 3  # last joints of an arm, whose motors are small
_CHUNK = 64  # pictures in memory


@dataclass(frozen=True)
class Clock:
    """A camera's. The robot's time is offset_s + stamp, and a little more for each second since the start."""

    offset_s: float
    drift_ppm: float

    def stamp_s(self, true_s: float) -> float:
        return true_s - self.offset_s - self.drift_ppm * 1e-6 * true_s


@dataclass(frozen=True)
class Sensors:
    """What is true of them."""

    torque: dict[str, Array]  # coulomb, viscous, offset, drift, white: N m (viscous: N m s/rad) by joint
    drift_time_s: float
    joint_offsets: Array  # rad: what joints are, less what they read
    clocks: dict[str, Clock]  # by camera

    def torques(self, true: Array, velocities: Array, times: Array, rng: np.random.Generator) -> Array:
        """What torque sensors say, frames x joints, N m; times since the start, s."""
        t = self.torque
        warm = 1 - np.exp(-times / self.drift_time_s)
        friction = t["coulomb"] * np.tanh(velocities / 0.02) + t["viscous"] * velocities
        return true + friction + t["offset"] + warm[:, None] * t["drift"] + t["white"] * rng.normal(size=true.shape)


@dataclass(frozen=True)
class Recorder:
    """How readings get into the bag."""

    noise: float = 1.0  # factor of what joints, pixels and stamps of pictures are off by
    drop: float = DROP  # share of the pictures that get lost; of joint states a third of it
    latency_s: tuple[float, float] = LATENCY_S  # from a picture to its log time, least and most
    joints_every: int = 1  # frames
    pictures_every: int = 1


@dataclass
class Dropped:
    """Frames whose reading was lost."""

    joints: list[int] = field(default_factory=list)
    pictures: dict[str, list[int]] = field(default_factory=dict)  # by camera


def draw_sensors(
    rng: np.random.Generator,
    joints: int,
    cameras: Iterable[str],
    joint_offset_deg: float = JOINT_OFFSET_DEG,
    noise: float = 1.0,
) -> Sensors:
    """joint_offset_deg: at most. noise: factor of what torque sensors are off by."""
    wrist = np.arange(joints) >= joints - _WRIST
    rubbing, shifting = np.where(wrist, 0.4, 1.0), np.where(wrist, 0.3, 1.0)
    torque = {
        "coulomb": rng.uniform(0.2, 1.0, joints) * rubbing,
        "viscous": rng.uniform(0.1, 0.8, joints) * rubbing,
        "offset": rng.uniform(-1.0, 1.0, joints) * shifting,
        "drift": rng.uniform(-0.8, 0.8, joints) * shifting,
        "white": rng.uniform(0.05, 0.15, joints) * rubbing,
    }
    offsets = np.radians(rng.uniform(-joint_offset_deg, joint_offset_deg, joints))
    clocks = {
        camera: Clock(rng.uniform(-CLOCK_OFFSET_S, CLOCK_OFFSET_S), rng.uniform(-DRIFT_PPM, DRIFT_PPM))
        for camera in cameras
    }
    return Sensors({name: noise * one for name, one in torque.items()}, rng.uniform(20, 40), offsets, clocks)


Pictures = Callable[[str, Sequence[int]], Array]  # camera, frames: n x height x width x 3, uint8


def drawn_pictures(episode: StoredEpisode) -> Pictures:
    """Those that are stored; the others are drawn now."""
    return lambda camera, frames: episode.pictures(f"{camera}_rgb", frames, draw=True, threads=2)


def record(
    bag: BagWriter,
    episode: StoredEpisode,
    sensors: Sensors,
    recorder: Recorder,
    rng: np.random.Generator,
    pictures: Pictures,
    packed: Callable[[Array], tuple[bytes, str]],
) -> Dropped:
    """Writes /joint_states, and /camera/NAME/image/compressed of each camera that has a clock. packed: of a picture its
    file, and the file's form in a word. Gives what was lost."""
    dropped = Dropped(joints=_write_joints(bag, episode, sensors, recorder, rng))
    for camera in sensors.clocks:
        seen = _pictures(episode, camera, recorder, pictures)
        dropped.pictures[camera] = _write_pictures(bag, episode, camera, sensors, recorder, rng, seen, packed)
    return dropped


def joint_names(episode: StoredEpisode) -> list[str]:
    """Of the arm, as drivers call them: `panda_joint1`."""
    labels = episode.arrays("joint_positions").column("joint_positions").labels
    return [label.replace(".", "_") for label in labels]


def _write_joints(
    bag: BagWriter, episode: StoredEpisode, sensors: Sensors, recorder: Recorder, rng: np.random.Generator
) -> list[int]:
    names = ["joint_positions", "joint_velocities", "joint_forces", "gripper_joint_positions"]
    arrays = episode.arrays(*names)
    true, speeds, forces, fingers = (arrays[name] for name in names)
    times = np.arange(episode.frames) / episode.frame_hz
    positions = true - sensors.joint_offsets + rng.normal(0, _POSITION * recorder.noise, true.shape)
    velocities = speeds + rng.normal(0, _VELOCITY * recorder.noise, true.shape)
    efforts = sensors.torques(forces, speeds, times, rng)
    names = joint_names(episode) + [one.replace(".", "_") for one in arrays.column(names[-1]).labels]
    still = np.zeros(fingers.shape[1])
    dropped: list[int] = []
    for frame in range(1, episode.frames, recorder.joints_every):  # no motor has worked at frame 0
        if rng.random() < recorder.drop / 3:
            dropped.append(frame)
            continue
        stamp_ns = _ns(times[frame])
        log_ns = stamp_ns + int(rng.uniform(0.2e6, 1.5e6))
        values = [np.concatenate([positions[frame], fingers[frame]])]
        values += [np.concatenate([velocities[frame], still]), np.concatenate([efforts[frame], still])]
        bag.joint_state("/joint_states", stamp_ns, log_ns, names, *values)
    return dropped


def _pictures(
    episode: StoredEpisode, camera: str, recorder: Recorder, pictures: Pictures
) -> Iterator[tuple[int, Array]]:
    frames = range(recorder.pictures_every, episode.frames, recorder.pictures_every)
    for start in range(0, len(frames), _CHUNK):
        some = list(frames[start : start + _CHUNK])
        yield from zip(some, pictures(camera, some), strict=True)


def _write_pictures(
    bag: BagWriter,
    episode: StoredEpisode,
    camera: str,
    sensors: Sensors,
    recorder: Recorder,
    rng: np.random.Generator,
    pictures: Iterable[tuple[int, Array]],
    packed: Callable[[Array], tuple[bytes, str]],
) -> list[int]:
    dropped: list[int] = []
    last_stamp = last_log = 0
    for frame, picture in pictures:
        if rng.random() < recorder.drop:
            dropped.append(frame)
            continue
        true_s = frame / episode.frame_hz
        stamp_ns = _ns(sensors.clocks[camera].stamp_s(true_s) + rng.normal(0, _STAMP_S * recorder.noise))
        noisy = np.clip(picture + rng.normal(0, _GREY * recorder.noise, picture.shape), 0, 255).astype(np.uint8)
        data, form = packed(noisy)
        log_ns = _ns(true_s + rng.uniform(*recorder.latency_s))
        # A driver sends one picture after the other.
        last_stamp, last_log = max(stamp_ns, last_stamp + 1), max(log_ns, last_log + 1)
        words = f"rgb8; {form} compressed bgr8"
        bag.compressed(f"/camera/{camera}/image/compressed", last_stamp, last_log, words, data, f"{camera}_optical")
    return dropped


def _ns(since_start_s: float) -> int:
    return round((EPOCH_S + since_start_s) * 1e9)
