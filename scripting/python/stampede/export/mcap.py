"""MCAP, a file an episode, as Foxglove shows it without a plug-in.

| topic | schema | what |
|---|---|---|
| `/camera/NAME/image` | foxglove.CompressedImage | the stored PNG as it is; foxglove.RawImage where it is drawn |
| `/camera/NAME/calibration` | foxglove.CameraCalibration | |
| `/tf` | foxglove.FrameTransforms | things, links of the robot, `tool` (between the pads) and cameras |
| `/scene` | foxglove.SceneUpdate | shapes of things and of the robot, once; they move with `/tf` |
| `/joints` | foxglove.JointStates | of the robot and of things |
| `/skills` | foxglove.Log | the label of a skill when it begins, its outcome when it ends |
| `/segments` | stampede.Segment | subgoals, skills and motions, at their first frame |
| `/action` | stampede.Action | commanded joints and opening, for plots |
| `/progress` | stampede.Progress | how much of the goal holds, and the reward |
| `/facts` | stampede.Facts | the facts that hold, when they change |
| `/channels/NAME` | stampede.Channel | what `--channels` named, a dot for each slash |

Names of joints have `_` for `.` in `/action`, as paths of plots want it. A hull is shown as the box around it; what is
not known is left out.
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
from stampede.export.pictures import is_png
from stampede.export.scene import Part, parts_of, pose_of, quaternion
from stampede.export.steps import Array, channels_of, matrices
from stampede.file_names import file_name

Message = dict[str, Any]

_NUMBER, _TEXT = {"type": "number"}, {"type": "string"}
_COUNT, _FLAG = {"type": "integer", "minimum": 0}, {"type": "boolean"}
_BYTES = {"type": "string", "contentEncoding": "base64"}


def _object(**properties: Any) -> Message:
    return {"type": "object", "properties": properties}


def _list(items: Message) -> Message:
    return {"type": "array", "items": items}


_TIME = _object(sec=_COUNT, nsec=_COUNT)
_NUMBERS = _list(_NUMBER)
_VECTOR = _object(x=_NUMBER, y=_NUMBER, z=_NUMBER)
_QUATERNION = _object(x=_NUMBER, y=_NUMBER, z=_NUMBER, w=_NUMBER)
_POSE = _object(position=_VECTOR, orientation=_QUATERNION)
_COLOUR = _object(r=_NUMBER, g=_NUMBER, b=_NUMBER, a=_NUMBER)
_TRANSFORM = _object(
    timestamp=_TIME, parent_frame_id=_TEXT, child_frame_id=_TEXT, translation=_VECTOR, rotation=_QUATERNION
)
_SOLID = {"pose": _POSE, "size": _VECTOR, "color": _COLOUR}
_ENTITY = _object(
    timestamp=_TIME,
    frame_id=_TEXT,
    id=_TEXT,
    lifetime=_TIME,
    frame_locked=_FLAG,
    metadata=_list(_object(key=_TEXT, value=_TEXT)),
    arrows=_list(_object()),
    cubes=_list(_object(**_SOLID)),
    spheres=_list(_object(**_SOLID)),
    cylinders=_list(_object(**_SOLID, bottom_scale=_NUMBER, top_scale=_NUMBER)),
    lines=_list(_object()),
    triangles=_list(_object()),
    texts=_list(_object()),
    models=_list(_object()),
)
_PICTURE = {"timestamp": _TIME, "frame_id": _TEXT, "data": _BYTES}

SCHEMAS: dict[str, Message] = {
    "foxglove.CompressedImage": _object(**_PICTURE, format=_TEXT),
    "foxglove.RawImage": _object(**_PICTURE, width=_COUNT, height=_COUNT, encoding=_TEXT, step=_COUNT),
    "foxglove.CameraCalibration": _object(
        timestamp=_TIME,
        frame_id=_TEXT,
        width=_COUNT,
        height=_COUNT,
        distortion_model=_TEXT,
        D=_NUMBERS,
        K=_NUMBERS,
        R=_NUMBERS,
        P=_NUMBERS,
    ),
    "foxglove.FrameTransforms": _object(transforms=_list(_TRANSFORM)),
    "foxglove.SceneUpdate": _object(
        deletions=_list(_object(timestamp=_TIME, type=_COUNT, id=_TEXT)), entities=_list(_ENTITY)
    ),
    "foxglove.JointStates": _object(
        timestamp=_TIME, joints=_list(_object(name=_TEXT, position=_NUMBER, velocity=_NUMBER, effort=_NUMBER))
    ),
    "foxglove.Log": _object(timestamp=_TIME, level=_COUNT, message=_TEXT, name=_TEXT, file=_TEXT, line=_COUNT),
    "stampede.Segment": _object(
        kind=_TEXT, name=_TEXT, arguments=_list(_TEXT), label=_TEXT, start_s=_NUMBER, end_s=_NUMBER, success=_FLAG
    ),
    "stampede.Progress": _object(progress=_NUMBER, reward=_NUMBER),
    "stampede.Facts": _object(facts=_list(_TEXT)),
    "stampede.Channel": _object(values=_NUMBERS),
}

# Columns of joints: positions, velocities and forces of the arm, the fingers and things.
_JOINTS = ("joint", "gripper_joint", "object_joint")

_INFO, _ERROR = 2, 4  # levels of foxglove.Log


def library() -> Any:
    """The writer of the mcap package. Raises ImportError that says how to install it."""
    try:
        from mcap import writer
    except ImportError as error:
        raise ImportError('mcap is missing\n    pip install "stampede-sim[mcap]"') from error
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
            _EpisodeFile(stream, episode).write(cameras_of(episode, self._options), self._options.channels)
        partial.rename(path)

    def finish(self) -> None:
        """Every file is complete by itself."""

    def close(self) -> None:
        """No file is open between two episodes."""

    def _path(self, episode: StoredEpisode) -> Path:
        return self._folder / f"{file_name(episode.task)}_{episode.id:06d}.mcap"


class _EpisodeFile:
    """One file while it is written."""

    def __init__(self, stream: Any, episode: StoredEpisode) -> None:
        self._episode = episode
        self._writer = library().Writer(stream)
        self._channels: dict[str, int] = {}
        self._schemas: dict[str, int] = {}

    def write(self, cameras: list[str], channels: list[str]) -> None:
        self._writer.start(profile="", library="stampede")
        self._writer.add_metadata("episode", self._about())
        arrays = self._episode.arrays()
        parts = parts_of(self._episode)
        self._write_segments(arrays.segments)
        self._put("/scene", "foxglove.SceneUpdate", 0, {"deletions": [], "entities": [_entity(p) for p in parts]})
        bases = [part.frame for part in parts if part.parent == "world" and f"object_pose/{part.frame}" in arrays]
        facts = arrays["facts"]
        further = channels_of(self._episode, arrays, channels)
        for frame in range(self._episode.frames):
            time_ns = self._time_ns(frame)
            joints = _joints(arrays, frame)
            self._put("/joints", "foxglove.JointStates", time_ns, {"timestamp": _stamp(time_ns), "joints": joints})
            poses = {("world", "tool"): arrays["gripper_pose"][frame]}
            poses |= {("world", base): arrays[f"object_pose/{base}"][frame] for base in bases}
            positions = {one["name"]: one.get("position", np.nan) for one in joints}
            for part in parts:
                if part.frame not in bases:
                    pose = part.pose(positions[part.joint] if part.joint else 0.0)
                    poses[part.parent, part.frame] = pose
            for camera in cameras:
                looks = arrays[f"{camera}_camera_extrinsics"][frame]
                poses["world", camera] = np.concatenate([looks[:3, 3], quaternion(looks[:3, :3])])
            transforms = [
                _transform(parent, child, pose, time_ns)
                for (parent, child), pose in poses.items()
                if not np.isnan(pose).any()
            ]
            self._put("/tf", "foxglove.FrameTransforms", time_ns, {"transforms": transforms})
            if frame + 1 < self._episode.frames:
                self._write_action(arrays, frame)
            progress = {name: float(arrays[name][frame]) for name in ("progress", "reward")}
            self._put("/progress", "stampede.Progress", time_ns, _known(progress))
            for name, rows in further.items():
                self._put(f"/channels/{name}", "stampede.Channel", time_ns, {"values": rows[frame].tolist()})
            if frame == 0 or (facts[frame] != facts[frame - 1]).any():
                holding = [str(arrays.atoms[k]) for k in np.flatnonzero(facts[frame])]
                self._put("/facts", "stampede.Facts", time_ns, {"facts": holding})
        for camera in cameras:
            self._write_camera(camera)
        self._writer.finish()

    def _about(self) -> dict[str, str]:
        e = self._episode
        about: Message = {
            "task": e.task,
            "variation": e.variation,
            "seed": e.seed,
            "success": e.success,
            "reason": e.reason,
            "frame_hz": e.frame_hz,
        }
        about["key"] = e.catalogue.query("SELECT key FROM episodes WHERE episode = ?1", e.id).values("key")[0]
        return {name: str(value) for name, value in about.items() if value is not None} | {
            "instruction": "; ".join(e.instructions())
        }

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
                "success": one.success,
            }
            self._put("/segments", "stampede.Segment", start, segment)
            if one.kind == "skill":
                self._log(start, _INFO, one.label or one.name, one.name)
                end = f"{one.label or one.name}: {'done' if one.success else one.reason}"
                self._log(self._time_ns(one.end_frame), _INFO if one.success else _ERROR, end, one.name)

    def _log(self, time_ns: int, level: int, message: str, name: str) -> None:
        line = {"timestamp": _stamp(time_ns), "level": level, "message": message, "name": name, "file": "", "line": 0}
        self._put("/skills", "foxglove.Log", time_ns, line)

    def _write_action(self, arrays: Any, frame: int) -> None:
        joints = arrays.column("action/joint_position")
        names = [name.replace(".", "_") for name in joints.labels]
        values = map(float, joints.values[frame])
        message = {
            "joint_position": _known(dict(zip(names, values, strict=True))),
            **_known({"gripper": float(arrays["action/gripper"][frame])}),
        }
        schema = _object(joint_position=_object(**dict.fromkeys(names, _NUMBER)), gripper=_NUMBER)
        self._put("/action", "stampede.Action", self._time_ns(frame), message, schema)

    def _write_camera(self, camera: str) -> None:
        stored = self._episode.catalogue.query(
            "SELECT frame, data, width, height, focal_x, focal_y, centre_x, centre_y FROM images "
            "WHERE episode = ?1 AND camera = ?2 AND kind = 'rgb' ORDER BY frame",
            self._episode.id,
            camera,
        )
        lens = next(row for row in self._episode.table("cameras") if row["camera"] == camera)
        if len(stored) == self._episode.frames:
            for row in stored:
                time_ns, data = self._time_ns(row["frame"]), base64.b64encode(row["data"]).decode()
                form = "png" if is_png(row["data"]) else "jpeg"
                image = {"timestamp": _stamp(time_ns), "frame_id": camera, "data": data, "format": form}
                self._put(f"/camera/{camera}/image", "foxglove.CompressedImage", time_ns, image)
                self._write_calibration(camera, time_ns, {**lens, **row})
            return
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
            self._write_calibration(camera, time_ns, lens)

    def _write_calibration(self, camera: str, time_ns: int, lens: Message) -> None:
        fx, fy = lens["focal_x"], lens["focal_y"]
        cx, cy = lens["centre_x"] - 0.5, lens["centre_y"] - 0.5  # ROS counts from the middle of the first pixel
        calibration = {
            "timestamp": _stamp(time_ns),
            "frame_id": camera,
            "width": lens["width"],
            "height": lens["height"],
            "distortion_model": "plumb_bob",
            "D": [lens[name] for name in ("k1", "k2", "p1", "p2", "k3")],
            "K": [fx, 0, cx, 0, fy, cy, 0, 0, 1],
            "R": [1, 0, 0, 0, 1, 0, 0, 0, 1],
            "P": [fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0],
        }
        self._put(f"/camera/{camera}/calibration", "foxglove.CameraCalibration", time_ns, calibration)

    def _put(self, topic: str, schema: str, time_ns: int, message: Message, described: Message | None = None) -> None:
        """described: the schema, if it depends on the episode."""
        if topic not in self._channels:
            if schema not in self._schemas:
                text = json.dumps({"title": schema, **(described or SCHEMAS[schema])})
                self._schemas[schema] = self._writer.register_schema(schema, "jsonschema", text.encode())
            self._channels[topic] = self._writer.register_channel(topic, "json", self._schemas[schema])
        data = json.dumps(message, allow_nan=False).encode()
        self._writer.add_message(self._channels[topic], log_time=time_ns, publish_time=time_ns, data=data)

    def _time_ns(self, frame: int) -> int:
        return round(frame * 1e9 / self._episode.frame_hz)


def _stamp(time_ns: int) -> Message:
    return {"sec": time_ns // 10**9, "nsec": time_ns % 10**9}


def _vector(values: Array) -> Message:
    return dict(zip("xyz", map(float, values), strict=True))


def _quaternion(values: Array) -> Message:
    return dict(zip("xyzw", map(float, values), strict=True))


def _pose(pose: Array) -> Message:
    return {"position": _vector(pose[:3]), "orientation": _quaternion(pose[3:])}


def _known(numbers: dict[str, float]) -> dict[str, float]:
    return {name: number for name, number in numbers.items() if not np.isnan(number)}


def _joints(arrays: Any, frame: int) -> list[Message]:
    joints: list[Message] = []
    for kind in _JOINTS:
        columns = (f"{kind}_positions", f"{kind}_velocities", f"{kind}_forces")
        if columns[0] not in arrays:  # nothing moves but the robot
            continue
        names = arrays.column(columns[0]).labels
        for k, name in enumerate(names):
            position, velocity, effort = (float(arrays[column][frame, k]) for column in columns)
            joints.append({"name": name, **_known({"position": position, "velocity": velocity, "effort": effort})})
    return joints


def _transform(parent: str, child: str, pose: Array, time_ns: int) -> Message:
    """parent_from_child."""
    return {
        "timestamp": _stamp(time_ns),
        "parent_frame_id": parent,
        "child_frame_id": child,
        "translation": _vector(pose[:3]),
        "rotation": _quaternion(pose[3:]),
    }


def _entity(part: Part) -> Message:
    """A part's shapes in its own frame."""
    entity: Message = {
        "timestamp": _stamp(0),
        "frame_id": part.frame,
        "id": part.frame,
        "lifetime": _stamp(0),  # for ever
        "frame_locked": True,
    }
    entity |= {name: [] for name in _ENTITY["properties"] if name not in entity}
    for shape in part.shapes:
        _add_shape(entity, shape)
    return entity


def _add_shape(entity: Message, shape: Message) -> None:
    pose, colour = pose_of(shape["part_from_shape"]), shape["colour"]
    kind, width, length = shape["kind"], 2 * shape["radius"], shape["length"]

    def solid(place: Array, *size: float) -> Message:
        rgba = {name[0]: colour[name] for name in ("red", "green", "blue", "alpha")}
        return {"pose": _pose(place), "size": _vector(np.array(size)), "color": rgba}

    def along_z(distance: float) -> Array:
        return np.concatenate([pose[:3] + distance * matrices(pose[None])[0, :3, 2], pose[3:]])

    if kind == "box":
        entity["cubes"].append(solid(pose, *shape["size"]))
    elif kind == "hull":
        points = np.array(shape["points"])
        lower, upper = points.min(axis=0), points.max(axis=0)
        centre = matrices(pose[None])[0] @ np.append((lower + upper) / 2, 1)
        entity["cubes"].append(solid(np.concatenate([centre[:3], pose[3:]]), *(upper - lower)))
    if kind in ("cylinder", "capsule", "cone"):
        scales = {"bottom_scale": 1.0, "top_scale": 0.0 if kind == "cone" else 1.0}
        entity["cylinders"].append(solid(pose, width, width, length) | scales)
    if kind == "sphere":
        entity["spheres"].append(solid(pose, width, width, width))
    if kind == "capsule":
        ends = [along_z(length / 2), along_z(-length / 2)]
        entity["spheres"] += [solid(end, width, width, width) for end in ends]
