"""Demos from recorded episodes: of a session's run, or of a catalogue."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import pairwise

import numpy as np

from stampede._core import EpisodeArrays
from stampede.rlbench.backend.observation import NUMBERS, STANDS_RAD_PER_S, Observation
from stampede.rlbench.backend.observing import observation_of
from stampede.rlbench.backend.pictures import CAMERA_COLUMNS, CameraView
from stampede.rlbench.observation_config import CameraConfig, ObservationConfig

STOP_AT_VIAS = "motion.stop_at_vias=1"  # setting of a run

_AROUND_OBSTACLES = ("move_to", "move_through", "move_joints")
_FRAMES_OF_VERDICT = 3  # that a trimmed demo keeps: whoever replays it arrives a little later
_SHUT_M = 1e-3  # a hand that was told to open less wide than that was told to close

# picture(frame, camera, width, height, rgb, depth, mask, shadows) -> what `Session.picture` gives
Draw = Callable[..., Mapping[str, np.ndarray]]


def columns(cameras: Iterable[str]) -> list[str]:
    """Of `EpisodeArrays`, that a demo with these cameras is made from."""
    about_cameras = [f"{camera}_camera_{what}" for camera in cameras for what in CAMERA_COLUMNS]
    return [*NUMBERS, "action/joint_position", "action/gripper", "motion", *about_cameras]


def kept_frames(arrays: EpisodeArrays, gripper_frames: bool, trimmed: bool = False) -> list[int]:
    """
    Frames that a demo has. gripper_frames: also those while the fingers open or close and the arm waits. trimmed: without
    most of those of the wait for the verdict, in which nothing moves any more.
    """
    dropped: set[int] = set()
    if trimmed:
        for segment in arrays.segments:
            if segment.kind == "motion" and segment.name == "hold" and segment.end_frame >= arrays.frames - 1:
                dropped.update(range(segment.first_frame + _FRAMES_OF_VERDICT + 1, arrays.frames))
    if not gripper_frames:
        for segment in arrays.segments:
            if segment.kind == "motion" and segment.name in ("open_hand", "close_hand"):
                dropped.update(range(segment.first_frame + 1, segment.end_frame))
    return [frame for frame in range(arrays.frames) if frame not in dropped]


def ignoring_frames(arrays: EpisodeArrays) -> set[int]:
    """
    Frames whose motion was not planned around obstacles: `Observation.ignore_collisions`. Also those in which the arm
    stands: what the hand is about to let go of may lie on something. Where a demo stops at its via-points, the way after
    the first of them, which is of lines, is one of these.
    """
    ignoring: set[int] = set()
    for segment in arrays.segments:
        if segment.kind != "motion":
            continue
        first = segment.first_frame
        if segment.name in _AROUND_OBSTACLES:
            first = _end_of_free_way(arrays, segment.first_frame, segment.end_frame)
        ignoring.update(range(first, segment.end_frame))
    return ignoring


def _end_of_free_way(arrays: EpisodeArrays, first: int, end: int) -> int:
    """The frame after that in which the arm first stands between the ends of a motion; `end`: it does not."""
    stands = np.abs(arrays["joint_velocities"][first:end]).max(axis=1, initial=0.0) <= STANDS_RAD_PER_S
    moving = np.flatnonzero(~stands)
    between = np.flatnonzero(stands[moving[0] : moving[-1]]) if moving.size else moving
    return first + int(moving[0] + between[0]) + 1 if between.size else end


def demo_misc(arrays: EpisodeArrays, frames: list[int], variation_index: int) -> Iterator[dict[str, object]]:
    """
    `misc` of each frame of a demo, without the cameras.

    joint_position_action, (8,) float64: what led to the frame: joint positions (rad), and 1.0 where the hand was told
    to open, else 0.0; the first frame has none. frame: of the episode.
    """
    joints = arrays["action/joint_position"]
    yield {"variation_index": variation_index, "frame": frames[0]}
    for _, frame in pairwise(frames):
        action = np.append(joints[frame - 1], float(_told_to_open(arrays, frame)))
        yield {"variation_index": variation_index, "frame": frame, "joint_position_action": action}


def numbers_at(arrays: EpisodeArrays, frame: int) -> dict[str, np.ndarray]:
    """`NUMBERS` of a frame. A demo's hand lets go by opening just far enough: it is open where it was told to be."""
    numbers = {name: arrays[name][frame] for name in NUMBERS}
    numbers["gripper_open"] = np.maximum(numbers["gripper_open"], float(_told_to_open(arrays, frame)))
    return numbers


def _told_to_open(arrays: EpisodeArrays, frame: int) -> bool:
    """Whether what the hand was told before the frame was to open, however wide."""
    return frame > 0 and bool(arrays["action/gripper"][frame - 1] > _SHUT_M)


def demo_observations(
    config: ObservationConfig, arrays: EpisodeArrays, draw: Draw, variation_index: int, trimmed: bool = False
) -> Iterator[Observation]:
    """The observations of a demo in their order, each with its pictures drawn as `config` has them."""
    cameras = config.cameras_on
    frames = kept_frames(arrays, config.record_gripper_closing, trimmed)
    ignoring = ignoring_frames(arrays)
    for frame, misc in zip(frames, demo_misc(arrays, frames, variation_index), strict=True):
        views = {name: _drawn_view(arrays, draw, frame, name, camera) for name, camera in cameras.items()}
        yield observation_of(config, numbers_at(arrays, frame), views, misc, frame in ignoring)


def _drawn_view(arrays: EpisodeArrays, draw: Draw, frame: int, name: str, config: CameraConfig) -> CameraView:
    width, height = config.width_and_height
    drawn = draw(
        frame,
        name,
        width=width,
        height=height,
        rgb=config.rgb,
        depth=config.needs_depth,
        mask=config.mask,
        shadows=config.shadows,
    )
    return CameraView(
        extrinsics=drawn["extrinsics"],
        intrinsics=drawn["intrinsics"],
        near=float(arrays[f"{name}_camera_near"]),
        far=float(arrays[f"{name}_camera_far"]),
        rgb=drawn.get("rgb"),
        depth=drawn.get("depth"),
        mask=drawn.get("mask"),
    )
