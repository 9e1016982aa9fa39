"""Files of MCAP hold what a viewer draws: frames that hang together, shapes where they are, numbers that are known."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

import stampede
from stampede.export import export
from stampede.export.scene import parts_of, quaternion
from stampede.export.steps import matrices

reader = pytest.importorskip("mcap.reader")
mcap = pytest.importorskip("stampede.export.mcap")

Messages = dict[str, list[Any]]


@pytest.fixture(scope="module")
def episode(tmp_path_factory: pytest.TempPathFactory) -> stampede.StoredEpisode:
    path = tmp_path_factory.mktemp("mcap") / "demos.db"
    session = stampede.Session(catalogue=path)
    pictures = {"cameras": ["front"], "depth": False, "mask": False, "semantic_mask": False}
    assert session.run_all(["close_drawer"], episodes=1, seed=3, pictures=pictures).succeeded == 1
    return stampede.Catalogue(path)[1]


@pytest.fixture(scope="module")
def messages(episode: stampede.StoredEpisode, tmp_path_factory: pytest.TempPathFactory) -> Messages:
    folder = tmp_path_factory.mktemp("out") / "mcap"
    export(["mcap", str(episode.catalogue.path), "--out", str(folder)], tell=lambda line: None)
    found: Messages = {}
    with next(folder.iterdir()).open("rb") as stream:
        for _, channel, message in reader.make_reader(stream).iter_messages():
            found.setdefault(channel.topic, []).append(json.loads(message.data))
    return found


def world_from(transforms: list[dict[str, Any]], frame: str) -> np.ndarray:
    """4 x 4, along the chain of parents."""
    if frame == "world":
        return np.eye(4)
    one = next(one for one in transforms if one["child_frame_id"] == frame)
    pose = [*(one["translation"][axis] for axis in "xyz"), *(one["rotation"][axis] for axis in "xyzw")]
    return world_from(transforms, one["parent_frame_id"]) @ matrices(np.array([pose]))[0]


def test_frames_of_the_robot_and_of_drawers_hang_where_the_engine_has_them(
    episode: stampede.StoredEpisode, messages: Messages
) -> None:
    arrays = episode.arrays()
    drawers = [name for name in arrays.column("object_joint_positions").labels if name.endswith("drawer")]
    last = episode.frames - 1
    moved = 0.0
    for frame in (0, last // 2, last):
        transforms = messages["/tf"][frame]["transforms"]
        tip = world_from(transforms, "panda.hand") @ [0, 0, 0.1034, 1]
        assert np.allclose(tip[:3], arrays["gripper_pose"][frame, :3], atol=1e-6)
        assert np.allclose(world_from(transforms, "tool"), arrays["gripper_matrix"][frame], atol=1e-6)
        fingers = [world_from(transforms, f"panda.{side}_finger")[:3, 3] for side in ("left", "right")]
        opening = np.linalg.norm(fingers[0] - fingers[1])
        assert np.isclose(opening, arrays["gripper_joint_positions"][frame].sum(), atol=1e-6)
        for name in drawers:
            pose = matrices(arrays[f"object_pose/{name}"][frame : frame + 1])[0]
            assert np.allclose(world_from(transforms, name), pose, atol=1e-6)
            way = arrays[f"object_pose/{name}"][frame] - arrays[f"object_pose/{name}"][0]
            moved = max(moved, float(np.abs(way).max()))
    assert drawers and moved > 0.05  # one was closed


def test_shapes_stand_in_frames_that_are_there(episode: stampede.StoredEpisode, messages: Messages) -> None:
    assert len(messages["/scene"]) == 1
    entities = {one["id"]: one for one in messages["/scene"][0]["entities"]}
    frames = {one["child_frame_id"] for one in messages["/tf"][0]["transforms"]}
    assert {one["frame_id"] for one in entities.values()} <= frames and set(entities) == {
        part.frame for part in parts_of(episode)
    }
    table = entities["table"]["cubes"]
    sizes = next(row for row in episode.table("objects") if row["object"] == "table")
    spans = [max(abs(one["pose"]["position"][axis]) + one["size"][axis] / 2 for one in table) for axis in "xy"]
    assert np.allclose(2 * np.array(spans), [sizes["size_x"], sizes["size_y"]])
    assert entities["panda.link1"]["cylinders"]


def shape(kind: str, **values: Any) -> dict[str, Any]:
    half = np.sqrt(0.5)
    turn = matrices(np.array([[0, 0, 0, half, 0, 0, half]]))[0, :3, :3]  # z becomes -y
    place = {"origin": [1.0, 2.0, 3.0], "rotation": turn.ravel().tolist()}
    colour = {"red": 1.0, "green": 0.5, "blue": 0.25, "alpha": 1.0}
    blank = {"radius": 0.0, "length": 0.0, "size": [0, 0, 0], "points": []}
    return {**blank, "kind": kind, "part_from_shape": place, "colour": colour, **values}


def test_every_kind_of_shape_is_drawn() -> None:
    entity: dict[str, Any] = {"cubes": [], "spheres": [], "cylinders": []}
    points = [[0, 0, 0], [0.2, 0, 0], [0, 0.4, 0], [0, 0, 0.6]]
    for one in (
        shape("box", size=[0.1, 0.2, 0.3]),
        shape("hull", points=points),
        shape("sphere", radius=0.5),
        shape("cone", radius=0.1, length=0.4),
        shape("capsule", radius=0.1, length=0.4),
    ):
        mcap._add_shape(entity, one)
    box, hull = entity["cubes"]
    assert box["size"] == {"x": 0.1, "y": 0.2, "z": 0.3} and box["color"] == {"r": 1.0, "g": 0.5, "b": 0.25, "a": 1.0}
    assert hull["size"] == pytest.approx({"x": 0.2, "y": 0.4, "z": 0.6})
    assert hull["pose"]["position"] == pytest.approx({"x": 1.1, "y": 1.7, "z": 3.2})
    cone, capsule = entity["cylinders"]
    assert (cone["top_scale"], capsule["top_scale"]) == (0, 1) and capsule["size"]["z"] == 0.4
    ball, upper, lower = entity["spheres"]
    assert ball["size"]["x"] == 1.0 and upper["size"]["x"] == 0.2
    assert (upper["pose"]["position"]["y"], lower["pose"]["position"]["y"]) == pytest.approx((1.8, 2.2))


def test_quaternions_of_matrices_half_turns_among_them() -> None:
    turns = np.array([[0, 0, 0, 1], [1, 0, 0, 0], [0, 0.6, 0.8, 0], [0.5, -0.5, 0.5, 0.5], [0.1, 0.7, -0.1, 0.7]])
    turns = turns / np.linalg.norm(turns, axis=1, keepdims=True)
    for turn in turns:
        rotation = matrices(np.array([[0, 0, 0, *turn]]))[0, :3, :3]
        assert abs(quaternion(rotation) @ turn) == pytest.approx(1) and quaternion(rotation)[3] >= 0


def test_joints_actions_and_what_is_not_known(episode: stampede.StoredEpisode, messages: Messages) -> None:
    arrays = episode.arrays()
    joints = {one["name"]: one for one in messages["/joints"][5]["joints"]}
    assert joints["panda.joint3"]["velocity"] == arrays["joint_velocities"][5, 2]
    assert {"panda.left_finger_joint", *arrays.column("object_joint_positions").labels} <= set(joints)
    assert len(messages["/action"]) == episode.frames - 1
    assert messages["/action"][4]["joint_position"]["panda_joint2"] == arrays["action/joint_position"][4, 1]
    assert mcap._known({"progress": 0.5, "reward": float("nan")}) == {"progress": 0.5}
    skill = next(one for one in episode.segments if one.kind == "skill")
    told = next(one for one in messages["/segments"] if one["kind"] == "skill")
    assert told["end_s"] == skill.end_frame / episode.frame_hz and told["success"] is True


def test_calibrations_count_pixels_as_ros_does(episode: stampede.StoredEpisode, messages: Messages) -> None:
    cameras = episode.catalogue.query("SELECT camera, width, height, centre_x, centre_y FROM cameras")
    for name, width, height, x, y in zip(*cameras.to_dict().values(), strict=True):
        if name != "front":
            continue
        lens = messages["/camera/front/calibration"][0]
        assert (lens["width"], lens["height"]) == (width, height)
        assert (lens["K"][2], lens["K"][5]) == (x - 0.5, y - 0.5)  # 0 is the middle of the first pixel
        return
    raise AssertionError("there is no camera")
