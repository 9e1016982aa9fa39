"""MCAP, a file an episode, as Foxglove shows it without a plug-in.

| topic | schema | what |
|---|---|---|
| `/camera/NAME/image` | foxglove.CompressedImage | the stored PNG as it is; foxglove.RawImage where it is drawn |
| `/camera/NAME/calibration` | foxglove.CameraCalibration | |
| `/tf` | foxglove.FrameTransforms | tool, things and cameras in the world |
| `/scene` | foxglove.SceneUpdate | things as boxes of their size |
| `/skills` | foxglove.Log | the label of a skill when it begins, its outcome when it ends |
| `/segments` | stampede.Segment | subgoals, skills and motions, at their first frame |
| `/joints`, `/action`, `/progress`, `/facts` | stampede.* | numbers for plots; the facts that hold, when they change |

Messages are JSON; times are of the simulation, from 0.
"""

from __future__ import annotations

import argparse
import base64
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from stampede.catalogue import StoredEpisode
from stampede.export import cameras_of
from stampede.export.steps import Array, bodies_of, known

Message = dict[str, Any]

_NUMBER, _TEXT = {"type": "number"}, {"type": "string"}
_TIME = {"type": "object", "properties": {"sec": {"type": "integer"}, "nsec": {"type": "integer"}}}
_NUMBERS = {"type": "array", "items": _NUMBER}


def _object(**properties: Any) -> Message:
    return {"type": "object", "properties": properties}


def _list(items: Message) -> Message:
    return {"type": "array", "items": items}


_VECTOR = _object(x=_NUMBER, y=_NUMBER, z=_NUMBER)
_QUATERNION = _object(x=_NUMBER, y=_NUMBER, z=_NUMBER, w=_NUMBER)
_POSE = _object(position=_VECTOR, orientation=_QUATERNION)
_COLOUR = _object(r=_NUMBER, g=_NUMBER, b=_NUMBER, a=_NUMBER)
_TRANSFORM = _object(
    timestamp=_TIME, parent_frame_id=_TEXT, child_frame_id=_TEXT, translation=_VECTOR, rotation=_QUATERNION
)
_CUBE = _object(pose=_POSE, size=_VECTOR, color=_COLOUR)
_ENTITY = _object(
    timestamp=_TIME, frame_id=_TEXT, id=_TEXT, lifetime=_TIME, frame_locked={"type": "boolean"}, cubes=_list(_CUBE)
)

SCHEMAS: dict[str, Message] = {
    "foxglove.CompressedImage": _object(
        timestamp=_TIME, frame_id=_TEXT, data={"type": "string", "contentEncoding": "base64"}, format=_TEXT
    ),
    "foxglove.RawImage": _object(
        timestamp=_TIME,
        frame_id=_TEXT,
        width={"type": "integer"},
        height={"type": "integer"},
        encoding=_TEXT,
        step={"type": "integer"},
        data={"type": "string", "contentEncoding": "base64"},
    ),
    "foxglove.CameraCalibration": _object(
        timestamp=_TIME,
        frame_id=_TEXT,
        width={"type": "integer"},
        height={"type": "integer"},
        distortion_model=_TEXT,
        D=_NUMBERS,
        K=_NUMBERS,
        R=_NUMBERS,
        P=_NUMBERS,
    ),
    "foxglove.FrameTransforms": _object(transforms=_list(_TRANSFORM)),
    "foxglove.SceneUpdate": _object(deletions=_list(_object()), entities=_list(_ENTITY)),
    "foxglove.Log": _object(
        timestamp=_TIME, level={"type": "integer"}, message=_TEXT, name=_TEXT, file=_TEXT, line={"type": "integer"}
    ),
    "stampede.Segment": _object(
        kind=_TEXT, name=_TEXT, arguments=_list(_TEXT), label=_TEXT, start_s=_NUMBER, end_s=_NUMBER, success=_TEXT
    ),
    "stampede.Numbers": _object(),
    "stampede.Facts": _object(facts=_list(_TEXT)),
}

_JOINTS = ("joint_positions", "joint_velocities", "joint_forces")

_INFO, _ERROR = 2, 4  # levels of foxglove.Log


def library() -> Any:
    """The writer of the mcap package. Raises ImportError that says how to install it."""
    try:
        from mcap import writer
    except ImportError as error:
        raise ImportError('mcap is missing\n    pip install "stampede[mcap]"') from error
    return writer


class Writer:
    """Writes FOLDER/TASK_000001.mcap, by number of the episode."""

    def __init__(self, folder: Path, options: argparse.Namespace, episodes: Sequence[StoredEpisode]) -> None:
        self._folder, self._options = folder, options
        library()

    @staticmethod
    def add_arguments(parser: argparse.ArgumentParser) -> None:
        """None of its own."""

    def has(self, episode: StoredEpisode) -> bool:
        return self._path(episode).exists()

    def write(self, episode: StoredEpisode) -> None:
        path = self._path(episode)
        partial = path.with_name(path.name + ".part")
        with partial.open("wb") as stream:
            _EpisodeFile(stream, episode).write(cameras_of(episode, self._options))
        partial.rename(path)

    def finish(self) -> None:
        """Every file is complete by itself."""

    def close(self) -> None:
        """No file is open between two episodes."""

    def _path(self, episode: StoredEpisode) -> Path:
        return self._folder / f"{episode.task}_{episode.id:06d}.mcap"


class _EpisodeFile:
    """One file while it is written."""

    def __init__(self, stream: Any, episode: StoredEpisode) -> None:
        self._episode = episode
        self._writer = library().Writer(stream)
        self._channels: dict[str, int] = {}
        self._schemas: dict[str, int] = {}

    def write(self, cameras: list[str]) -> None:
        self._writer.start(profile="", library="stampede")
        self._writer.add_metadata("episode", self._about())
        bodies = bodies_of(self._episode)
        arrays = self._episode.arrays()
        sizes = {row["object"]: row for row in self._episode.table("objects")}
        poses = {name: known(arrays[f"object_pose/{name}"]) for name in bodies}
        self._write_segments(arrays.segments)
        facts = arrays["facts"]
        for frame in range(self._episode.frames):
            time_ns = self._time_ns(frame)
            transforms = [_transform("tool", arrays["gripper_pose"][frame])]
            transforms += [_transform(name, pose[frame]) for name, pose in poses.items()]
            for camera in cameras:
                transforms.append(_camera_transform(camera, arrays[f"{camera}_camera_extrinsics"][frame]))
            for one in transforms:
                one["timestamp"] = _stamp(time_ns)
            self._put("/tf", "foxglove.FrameTransforms", time_ns, {"transforms": transforms})
            entities = [_box(name, poses[name][frame], sizes[name], time_ns) for name in bodies if name in sizes]
            self._put("/scene", "foxglove.SceneUpdate", time_ns, {"deletions": [], "entities": entities})
            self._put_numbers("/joints", time_ns, arrays, _JOINTS, frame)
            if frame + 1 < self._episode.frames:
                actions = ("action/joint_position", "action/gripper")
                self._put_numbers("/action", time_ns, arrays, actions, frame)
            self._put_numbers("/progress", time_ns, arrays, ("progress", "reward"), frame)
            if frame == 0 or (facts[frame] != facts[frame - 1]).any():
                holding = [str(arrays.atoms[k]) for k in np.flatnonzero(facts[frame])]
                self._put("/facts", "stampede.Facts", time_ns, {"facts": holding})
        for camera in cameras:
            self._write_camera(camera, arrays)
        self._writer.finish()

    def _about(self) -> dict[str, str]:
        e = self._episode
        about = {"task": e.task, "variation": e.variation, "seed": e.seed, "success": e.success, "reason": e.reason}
        return {name: str(value) for name, value in about.items()} | {"instruction": "; ".join(e.instructions())}

    def _write_segments(self, segments: Sequence[Any]) -> None:
        rate = self._episode.frame_hz
        for one in sorted(segments, key=lambda s: (s.first_frame, s.id)):
            start = self._time_ns(one.first_frame)
            segment = {
                "kind": one.kind,
                "name": one.name,
                "arguments": list(one.arguments),
                "label": one.label,
                "start_s": one.first_frame / rate,
                "end_s": one.end_frame / rate,
                "success": str(one.success).lower(),
            }
            self._put("/segments", "stampede.Segment", start, segment)
            if one.kind == "skill":
                self._log(start, _INFO, one.label or one.name, one.name)
                end = f"{one.label or one.name}: {'done' if one.success else one.reason}"
                self._log(self._time_ns(one.end_frame), _INFO if one.success else _ERROR, end, one.name)

    def _log(self, time_ns: int, level: int, message: str, name: str) -> None:
        line = {"timestamp": _stamp(time_ns), "level": level, "message": message, "name": name, "file": "", "line": 0}
        self._put("/skills", "foxglove.Log", time_ns, line)

    def _write_camera(self, camera: str, arrays: Any) -> None:
        stored = self._episode.catalogue.query(
            "SELECT frame, data, width, height, focal_x, focal_y, centre_x, centre_y FROM images "
            "WHERE episode = ?1 AND camera = ?2 AND kind = 'rgb' ORDER BY frame",
            self._episode.id,
            camera,
        )
        if len(stored) == self._episode.frames:
            for row in stored:
                data, time_ns = base64.b64encode(row["data"]).decode(), self._time_ns(row["frame"])
                image = {"timestamp": _stamp(time_ns), "frame_id": camera, "data": data, "format": "png"}
                self._put(f"/camera/{camera}/image", "foxglove.CompressedImage", time_ns, image)
                k = [row["focal_x"], 0, row["centre_x"], 0, row["focal_y"], row["centre_y"], 0, 0, 1]
                self._write_calibration(camera, time_ns, row["width"], row["height"], k)
            return
        k = arrays[f"{camera}_camera_intrinsics"].ravel().tolist()
        for frame, picture in enumerate(self._episode.pictures(f"{camera}_rgb", draw=True)):
            time_ns, (height, width) = self._time_ns(frame), picture.shape[:2]
            image = {
                "timestamp": _stamp(time_ns),
                "frame_id": camera,
                "width": width,
                "height": height,
                "encoding": "rgb8",
                "step": 3 * width,
                "data": base64.b64encode(picture.tobytes()).decode(),
            }
            self._put(f"/camera/{camera}/image", "foxglove.RawImage", time_ns, image)
            self._write_calibration(camera, time_ns, width, height, k)

    def _write_calibration(self, camera: str, time_ns: int, width: int, height: int, k: list[float]) -> None:
        calibration = {
            "timestamp": _stamp(time_ns),
            "frame_id": camera,
            "width": width,
            "height": height,
            "distortion_model": "",
            "D": [],
            "K": k,
            "R": [1, 0, 0, 0, 1, 0, 0, 0, 1],
            "P": [*k[:3], 0, *k[3:6], 0, *k[6:], 0],
        }
        self._put(f"/camera/{camera}/calibration", "foxglove.CameraCalibration", time_ns, calibration)

    def _put_numbers(self, topic: str, time_ns: int, arrays: Any, columns: Sequence[str], frame: int) -> None:
        """Names to numbers, so that a plot has a path for each."""
        message: Message = {}
        for name in columns:
            column = arrays.column(name)
            value = column.values[frame]
            if column.labels:
                message[name.replace("/", "_")] = dict(zip(column.labels, map(float, value), strict=True))
            else:
                message[name.replace("/", "_")] = float(value)
        self._put(topic, "stampede.Numbers", time_ns, message)

    def _put(self, topic: str, schema: str, time_ns: int, message: Message) -> None:
        if topic not in self._channels:
            if schema not in self._schemas:
                text = json.dumps({"title": schema, **SCHEMAS[schema]})
                self._schemas[schema] = self._writer.register_schema(schema, "jsonschema", text.encode())
            self._channels[topic] = self._writer.register_channel(topic, "json", self._schemas[schema])
        data = json.dumps(message).encode()
        self._writer.add_message(self._channels[topic], log_time=time_ns, publish_time=time_ns, data=data)

    def _time_ns(self, frame: int) -> int:
        return round(frame * 1e9 / self._episode.frame_hz)


def _stamp(time_ns: int) -> Message:
    return {"sec": time_ns // 10**9, "nsec": time_ns % 10**9}


def _vector(values: Array) -> Message:
    return dict(zip("xyz", map(float, values), strict=True))


def _quaternion(values: Array) -> Message:
    return dict(zip("xyzw", map(float, values), strict=True))


def _transform(name: str, pose: Array) -> Message:
    """world_from_NAME."""
    return {
        "parent_frame_id": "world",
        "child_frame_id": name,
        "translation": _vector(pose[:3]),
        "rotation": _quaternion(pose[3:] if pose[3:].any() else np.array([0, 0, 0, 1.0])),
    }


def _camera_transform(name: str, extrinsics: Array) -> Message:
    """world_from_camera, whose z looks ahead and whose y is down, as calibrations have it."""
    turn = extrinsics[:3, :3]
    w = np.sqrt(max(0.0, 1 + np.trace(turn))) / 2
    if w > 1e-3:
        axis = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / (4 * w)
    else:  # a half turn: its axis is the column that the symmetric part shows
        k = int(np.argmax(np.diag(turn)))
        axis = (turn[:, k] + np.eye(3)[k]) / np.linalg.norm(turn[:, k] + np.eye(3)[k])
        w = 0.0
    return _transform(name, np.concatenate([extrinsics[:3, 3], axis, [w]]))


def _box(name: str, pose: Array, size: dict[str, Any], time_ns: int) -> Message:
    """A thing as the box around it, in the world."""
    extent = [float(size[f"size_{axis}"] or 0) for axis in "xyz"]
    known_pose = pose if pose[3:].any() else np.array([*pose[:3], 0, 0, 0, 1.0])
    return {
        "timestamp": _stamp(time_ns),
        "frame_id": "world",
        "id": name,
        "lifetime": _stamp(0),
        "frame_locked": True,
        "cubes": [
            {
                "pose": {"position": _vector(known_pose[:3]), "orientation": _quaternion(known_pose[3:])},
                "size": _vector(np.array(extent)),
                "color": {"r": 0.6, "g": 0.7, "b": 0.9, "a": 0.5},
            }
        ],
    }
