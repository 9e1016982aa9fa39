"""An episode as the pairs of observation and action that learners expect.

Step t is what was observed at frame t and what was commanded until frame t + 1; the last frame has no action. So an
episode of F frames has F - 1 steps. Actions are in the scale of `stampede.Env(task, action=…, normalise_actions=True)`:
what learns from them acts in it without another one. Joint positions do the task when they are played back. Deltas are
those of the planner's reference, which does not stop between frames; an environment's arm does, lags behind, and adds
that up.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede._core import EpisodeArrays, Segment
from stampede.catalogue import Catalogue, StoredEpisode
from stampede.faults import fault

Array = NDArray[Any]
Json = dict[str, Any]

ACTIONS = ("joint_delta", "joint_position", "tool_delta")

# What -1 and 1 stand for in the action space of the tool (stampede/action.h), of every arm.
TOOL_SPEED = np.array([1.7, 1.7, 1.7, 2.5, 2.5, 2.5])  # m/s, rad/s

_COLUMNS = (
    "joint_positions",
    "joint_velocities",
    "gripper_joint_positions",
    "gripper_joint_velocities",
    "gripper_pose",
    "gripper_opening",
    "task_low_dim_state",
    "action",
    "skill",
)


def rotation_vectors(start: Array, end: Array) -> Array:
    """The turns that lead from one orientation to another, seen from the world: n x 3, rad. n x 4 each, x y z w."""
    x1, y1, z1, w1 = (-start[:, 0], -start[:, 1], -start[:, 2], start[:, 3])
    x2, y2, z2, w2 = end.T
    turn = np.stack(  # end * start^-1
        [
            w2 * x1 + x2 * w1 + y2 * z1 - z2 * y1,
            w2 * y1 - x2 * z1 + y2 * w1 + z2 * x1,
            w2 * z1 + x2 * y1 - y2 * x1 + z2 * w1,
            w2 * w1 - x2 * x1 - y2 * y1 - z2 * z1,
        ],
        axis=1,
    )
    turn *= np.where(turn[:, 3:] < 0, -1.0, 1.0)  # the shorter way
    sine = np.linalg.norm(turn[:, :3], axis=1)
    angle = 2 * np.arctan2(sine, turn[:, 3])
    factor = np.where(sine > 1e-9, angle / np.maximum(sine, 1e-9), 2.0)
    return turn[:, :3] * factor[:, None]


def matrices(poses: Array) -> Array:
    """n x 7 (x y z, quaternion x y z w) as n x 4 x 4, world_from_object."""
    x, y, z, w = poses[:, 3:].T
    result = np.zeros((len(poses), 4, 4))
    result[:, 0, :3] = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], axis=1)
    result[:, 1, :3] = np.stack([2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)], axis=1)
    result[:, 2, :3] = np.stack([2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)], axis=1)
    result[:, :3, 3] = poses[:, :3]
    result[:, 3, 3] = 1
    return result


def known(values: Array) -> Array:
    """What is not known, NaN, as 0."""
    return np.nan_to_num(values, nan=0.0)


def is_real(episode: StoredEpisode) -> bool:
    """Recorded from a robot: it has no seed, no variation, and no poses of things."""
    return episode.catalogue.query("SELECT source FROM episodes WHERE episode = ?1", episode.id).values("source") == [
        "real"
    ]


def key_of(episode: StoredEpisode) -> str:
    """What it is stored once by."""
    return str(episode.catalogue.query("SELECT key FROM episodes WHERE episode = ?1", episode.id).values("key")[0])


def bodies_of(episode: StoredEpisode) -> list[str]:
    """Names of things whose poses are known, without their parts, regions and the hand."""
    if is_real(episode):
        return []
    rows = episode.catalogue.query(
        "SELECT object FROM objects WHERE episode = ?1 AND kind = 'body' ORDER BY object", episode.id
    )
    return [str(name) for name in rows.values("object")]


def channels_of(episode: StoredEpisode, arrays: EpisodeArrays, asked: Sequence[str]) -> dict[str, Array]:
    """Columns, and those of groups such as `object_pose`, as F x k each, unknown values as 0; a dot for each slash."""
    found = {}
    for channel in asked:
        names = [name for name in arrays.keys() if name == channel or name.startswith(f"{channel}/")]
        values = [arrays[name] for name in names]
        if not names or any(one.dtype.kind not in "fiub" or one.shape[:1] != (episode.frames,) for one in values):
            cure = "engine/episode/README.md says which columns have F rows; --cameras chooses pictures"
            raise fault(f"episode {episode.id}", f"channel '{channel}' has no row of numbers for each frame", cure)
        for name, rows in zip(names, values, strict=True):
            found[name.replace("/", ".")] = known(rows.reshape(len(rows), -1))
    return found


def check_names(episode: StoredEpisode, names: Mapping[str, list[str]], first: Mapping[str, list[str]]) -> None:
    """Raises Error where a feature's components are not those of the first episode: it is the same in all."""
    for name, expected in first.items():
        if names.get(name) != expected:
            raise fault(
                f"episode {episode.id}",
                f"the components of {name} are not those of the first episode",
                "--where exports them apart, for instance by task or variation",
            )


def stored_scene(episode: StoredEpisode) -> Json | None:
    """The scene's document, which is in a table of the catalogue that no view shows; None: it has none, a real one."""
    rows = episode.catalogue.query(
        "SELECT document FROM scene WHERE hash = (SELECT scene FROM episodes WHERE episode = ?1)", episode.id
    )
    return _whole(json.loads(str(rows.values("document")[0])), episode.catalogue) if len(rows) else None


def _whole(json_: Any, catalogue: Catalogue) -> Any:
    """A document with the parts put in that it shares with others."""
    if isinstance(json_, list):
        return [_whole(one, catalogue) for one in json_]
    if not isinstance(json_, dict):
        return json_
    if "$asset" not in json_:
        return {name: _whole(one, catalogue) for name, one in json_.items()}
    rows = catalogue.query("SELECT body FROM asset WHERE hash = ?1", json_["$asset"])
    return json.loads(str(rows.values("body")[0]))


def _limits_of(episode: StoredEpisode) -> tuple[Array, float]:
    """The greatest speeds of the arm's joints, rad/s, and opening of the hand, m: of the robot that the episode has."""
    scene = stored_scene(episode)
    if scene is None:
        raise fault(f"episode {episode.id}", "its robot is not stored with it", "mcap needs no limits of joints")
    robot = scene["robot"]
    return np.array([one["velocity"] for one in robot["limits"]]), float(robot["opening_max"])


class Steps:
    """The steps of one episode. Arrays have F - 1 rows, unless they say otherwise.

    further: more columns that are read at once. channels: columns, or groups of them (`object_pose`), that were asked
    for beside the format's own. Raises Error for an episode of fewer than two frames, for one whose robot is not stored
    with it, and for a channel that is not there or has no row of numbers a frame.
    """

    def __init__(self, episode: StoredEpisode, further: Sequence[str] = (), channels: Sequence[str] = ()) -> None:
        if episode.frames < 2:
            raise fault(f"episode {episode.id}", "it has no step", "--where 'frames > 1' leaves it out")
        self.episode = episode
        self.arrays = episode.arrays(*_COLUMNS, *further, *channels)
        self.count = episode.frames - 1
        self._asked = channels
        self.joint_speed, self.opening = _limits_of(episode)  # rad/s, m: the most
        self._check_known()

    def _check_known(self) -> None:
        """Raises Error where a step lacks what the arm did or was to do: 0 would be a pose that it never had."""
        leave_out = f"--where \"outcome = 'success' AND episode <> {self.episode.id}\" leaves it out; mcap has no steps"
        needed = {
            "action/gripper": ("opening of the gripper", "a stream `gripper`, or `opening_m` in `command`"),
            "action/joint_position": ("command of the arm", "commands without gaps of more than 1 s"),
            "action/tool_pose": ("command of the tool", "commands without gaps of more than 1 s"),
            "joint_positions": ("position of the arm", "joint states without gaps"),
        }
        for column, (what, cure) in needed.items():
            values = self.arrays[column][: -1 if column.startswith("action") else None]
            missing = np.flatnonzero(np.isnan(values.reshape(len(values), -1)).any(axis=1))
            if len(missing):
                count = "any" if len(missing) == len(values) else f"{len(missing)} of {len(values)}"
                where = "" if count == "any" else f", the first at frame {missing[0]}"
                told = f"it was recorded without {count} {what}{where}: a dataset of steps needs it"
                raise fault(f"episode {self.episode.id}", told, f"record {cure}; {leave_out}")

    def observed(self, column: str) -> Array:
        """A column at the frames that have an action, unknown values as 0."""
        return known(self.arrays[column][:-1])

    @cached_property
    def channels(self) -> dict[str, Array]:
        """F x k each: what was asked for beside the format's own. Names have no slash."""
        return channels_of(self.episode, self.arrays, self._asked)

    @cached_property
    def channel_names(self) -> dict[str, list[str]]:
        """Of the components of each channel."""
        columns = {name.replace("/", "."): self.arrays.column(name) for name in self.arrays.keys()}
        names = {}
        for channel, rows in self.channels.items():
            labels = list(map(str, self.arrays.atoms if channel == "facts" else columns[channel].labels))
            names[channel] = labels if len(labels) == rows.shape[1] else [str(k) for k in range(rows.shape[1])]
        return names

    @property
    def success(self) -> Array:
        """bool: the step after which the episode had succeeded; the last, or none."""
        done = np.zeros(self.count, dtype=bool)
        done[-1] = self.episode.success
        return done

    @cached_property
    def rewards(self) -> Array:
        """1 at success, else 0."""
        return self.success.astype(np.float64)

    @cached_property
    def commanded_joints(self) -> Array:
        """F x joints of the arm, rad: where the reference was at each frame."""
        commanded = self.arrays["action/joint_position"][:-1]
        return np.concatenate([self.arrays["joint_positions"][:1], commanded])

    @cached_property
    def commanded_tool(self) -> Array:
        """F x 7: the reference's pose at each frame; m, quaternion x y z w, world."""
        return np.concatenate([self.arrays["gripper_pose"][:1], self.arrays["action/tool_pose"][:-1]])

    @cached_property
    def commanded_opening(self) -> Array:
        """m, between the pads."""
        return self.arrays["action/gripper"][:-1]

    @cached_property
    def gripper(self) -> Array:
        """-1: closed … 1: open."""
        return np.clip(2 * self.commanded_opening / max(self.opening, 1e-9) - 1, -1, 1)

    def natural_actions(self, kind: str) -> Array:
        """In rad, m and rotation vectors, the opening in m last."""
        opening = self.commanded_opening[:, None]
        if kind == "joint_position":
            return np.hstack([self.commanded_joints[1:], opening])
        if kind == "joint_delta":
            return np.hstack([np.diff(self.commanded_joints, axis=0), opening])
        moved = np.diff(self.commanded_tool[:, :3], axis=0)
        turned = rotation_vectors(self.commanded_tool[:-1, 3:], self.commanded_tool[1:, 3:])
        return np.hstack([moved, turned, opening])

    def actions(self, kind: str) -> Array:
        """float32 (F - 1, n + 1): -1 … 1 as `Env` with `normalise_actions` takes them, the gripper last."""
        natural = self.natural_actions(kind)[:, :-1]
        lower, upper = self.bounds(kind)
        scaled = 2 * (natural - lower) / (upper - lower) - 1
        return np.clip(np.hstack([scaled, self.gripper[:, None]]), -1, 1).astype(np.float32)

    def bounds(self, kind: str) -> tuple[Array, Array]:
        """What -1 and 1 stand for, without the gripper."""
        rate = self.episode.frame_hz
        if kind == "joint_delta":
            if not self.joint_speed.all():
                told = "a joint of its arm has no greatest speed"
                raise fault(f"episode {self.episode.id}", told, "--action joint_position")
            return -self.joint_speed / rate, self.joint_speed / rate
        if kind == "tool_delta":
            return -TOOL_SPEED / rate, TOOL_SPEED / rate
        return self._joint_limits

    @cached_property
    def _joint_limits(self) -> tuple[Array, Array]:
        names = self.arrays.column("joint_positions").labels
        rows = self.episode.catalogue.query(
            "SELECT joint, lower, upper FROM joints WHERE episode = ?1 AND frame = 0", self.episode.id
        )
        limits = {row["joint"]: (row["lower"], row["upper"]) for row in rows}
        return np.array([limits[name][0] for name in names]), np.array([limits[name][1] for name in names])

    def action_names(self, kind: str) -> list[str]:
        joints = self.arrays.column("joint_positions").labels
        return [*(["x", "y", "z", "rx", "ry", "rz"] if kind == "tool_delta" else joints), "gripper"]

    @cached_property
    def skills(self) -> list[Segment]:
        """Innermost skills, in time."""
        segments = [s for s in self.arrays.segments if s.kind == "skill"]
        parents = {s.parent for s in segments}
        return sorted((s for s in segments if s.id not in parents), key=lambda s: s.first_frame)

    @cached_property
    def instruction(self) -> str:
        """What the task is called in words; empty: it has no sentence."""
        sentences = self.episode.instructions()
        return sentences[0] if sentences else ""

    def meta(self) -> dict[str, Any]:
        """What identifies the episode and what is known of it, for formats that keep JSON."""
        heads = self.episode.catalogue.query("SELECT key, source FROM episodes WHERE episode = ?1", self.episode.id)
        return {
            "episode": self.episode.id,
            **next(iter(heads)),  # key, source
            "task": self.episode.task,
            "variation": self.episode.variation,
            "seed": self.episode.seed,
            "split": self.episode.split,
            "success": self.episode.success,
            "instructions": self.episode.instructions(),
            "lang": self.instruction,
            "frame_hz": self.episode.frame_hz,
            "segments": [
                {
                    "skill": s.name,
                    "arguments": list(s.arguments),
                    "label": s.label,
                    "first_frame": s.first_frame,
                    "end_frame": s.end_frame,
                    "success": s.success,
                }
                for s in self.skills
            ],
        }
