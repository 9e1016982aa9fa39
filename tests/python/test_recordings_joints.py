"""Whose joints a source has: one prefix for all of them, messages in parts, several arms; other people's layouts."""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

stampede = pytest.importorskip("stampede")
pytest.importorskip("rosbags")

sys.path.insert(0, str(Path(__file__).parents[1] / "bench" / "python"))
from ros_bag import RosBag  # noqa: E402

from stampede.recordings import convert  # noqa: E402

ARM = [f"panda_joint{k}" for k in range(1, 8)]
HAND = ["panda_finger_joint1", "panda_finger_joint2"]
HOME = np.array([0, -0.78, 0, -2.35, 0, 1.57, 0.78])
START = 1_700_000_000 * 10**9  # ns
TEN_MS = 10**7


def run(source: Path, out: Path, *options: str, form: str = "rosbag2") -> Path:
    return convert([form, str(source), "--out", str(out), *options], tell=lambda line: None)[0]


def columns(file: Path, last: str) -> np.ndarray:
    """Values of the columns whose names end so."""
    with file.open() as stream:
        return np.array([[float(v) for k, v in row.items() if k.endswith(last)] for row in csv.DictReader(stream)])


def put(bag: Any, k: int, names: list[str], position: Any, topic: str = "/joint_states", late_ns: int = 0) -> None:
    stamp = START + k * TEN_MS + late_ns
    bag.joint_state(topic, stamp, stamp, names, position)


def test_a_rail_on_the_topic_is_not_the_arms_first_joint(tmp_path: Path) -> None:
    with RosBag(tmp_path / "bag") as bag:
        for k in range(10):
            names = ["rail_joint1", *ARM, "lift.joint1", "camera_joint7", *HAND]
            put(bag, k, names, [5.0, *(HOME + 0.01 * k), 6.0, 7.0, 0.02, 0.02])
    out = run(tmp_path / "bag", tmp_path / "out")
    assert np.allclose(columns(out / "joints.csv", "position_rad"), HOME + 0.01 * np.arange(10)[:, None])
    assert np.allclose(columns(out / "gripper.csv", "opening_m"), 0.04)


def test_joints_of_different_arms_are_no_arm(tmp_path: Path) -> None:
    with RosBag(tmp_path / "bag") as bag:
        put(bag, 0, ["left_joint1", *[f"right_joint{k}" for k in range(2, 8)]], HOME)
    with pytest.raises(stampede.Error, match="no prefix is that of all of the arm's joints.*left_joint1"):
        run(tmp_path / "bag", tmp_path / "out")


def test_of_two_arms_on_a_topic_the_prefix_says_which(tmp_path: Path) -> None:
    names = [f"{side}_joint{k}" for side in ("left", "right") for k in range(1, 8)]
    hands = [f"{side}_finger_joint{k}" for side in ("left", "right") for k in (1, 2)]
    with RosBag(tmp_path / "bag") as bag:
        for k in range(3):
            put(bag, k, names + hands, [*HOME, *(HOME + 0.1), 0.01, 0.01, 0.03, 0.03])
    with pytest.raises(stampede.Error, match="prefixes 'left_', 'right_'\n    --prefix right_"):
        run(tmp_path / "bag", tmp_path / "out")
    with pytest.raises(stampede.Error, match="have the prefix 'middle_'"):
        run(tmp_path / "bag", tmp_path / "out", "--prefix", "middle_")
    for prefix, off, opening in (("left_", 0.0, 0.02), ("right_", 0.1, 0.06)):
        out = run(tmp_path / "bag", tmp_path / prefix, "--prefix", prefix)
        assert np.allclose(columns(out / "joints.csv", "position_rad"), HOME + off)
        assert np.allclose(columns(out / "gripper.csv", "opening_m"), opening)


def test_names_without_a_prefix_beside_those_of_a_second_arm(tmp_path: Path) -> None:
    plain = [f"joint{k}" for k in range(1, 8)]
    names = [*plain, *[f"left_joint{k}" for k in range(1, 8)], "finger_joint1", "finger_joint2", "left_finger_joint1"]
    with RosBag(tmp_path / "bag") as bag:
        put(bag, 0, names, [*HOME, *(HOME + 0.1), 0.01, 0.01, 0.5])
    with pytest.raises(stampede.Error, match="prefixes '', 'left_'"):
        run(tmp_path / "bag", tmp_path / "out")
    out = run(tmp_path / "bag", tmp_path / "plain", "--prefix", "")
    assert np.allclose(columns(out / "joints.csv", "position_rad"), HOME)
    assert np.allclose(columns(out / "gripper.csv", "opening_m"), 0.02)


@pytest.mark.parametrize("hand_first", [True, False])
def test_arm_and_hand_apart_on_one_topic(tmp_path: Path, hand_first: bool) -> None:
    with RosBag(tmp_path / "bag") as bag:
        for k in range(20):
            arm, hand = (ARM, HOME + 0.01 * k, 0), (HAND, [0.01, 0.02], TEN_MS // 2)
            for names, position, late in (hand, arm) if hand_first else (arm, hand):
                if names is ARM or k % 2 == 0:
                    put(bag, k, names, position, late_ns=late)
    out = run(tmp_path / "bag", tmp_path / "out")
    assert np.allclose(columns(out / "joints.csv", "position_rad"), HOME + 0.01 * np.arange(20)[:, None])
    opening = columns(out / "gripper.csv", "opening_m")
    assert np.allclose(opening, 0.03) and len(opening) == 10


def test_an_arm_in_parts_is_put_together(tmp_path: Path) -> None:
    with RosBag(tmp_path / "bag") as bag:
        for k in range(10):
            put(bag, k, ARM[:4], HOME[:4] + 0.01 * k)
            put(bag, k, ARM[4:], HOME[4:] + 0.01 * k, late_ns=1000)
    out = run(tmp_path / "bag", tmp_path / "out")
    assert np.allclose(columns(out / "joints.csv", "position_rad"), HOME + 0.01 * np.arange(10)[:, None])


def test_a_hand_on_a_topic_of_its_own(tmp_path: Path) -> None:
    with RosBag(tmp_path / "bag") as bag:
        for k in range(3):
            put(bag, k, ARM, HOME)
            put(bag, k, HAND, [0.01, 0.02], topic="/hand/joint_states")
            put(bag, k, ["lift_joint"], [1.0], topic="/lift/joint_states")
    assert np.allclose(columns(run(tmp_path / "bag", tmp_path / "out") / "gripper.csv", "opening_m"), 0.03)


def write_ros_1(file: Path, compression: str) -> None:
    from rosbags.rosbag1 import Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS1_NOETIC)
    types = store.types
    writer = Writer(file)
    if compression:
        writer.set_compression(getattr(Writer.CompressionFormat, compression))
    with writer:
        kind = "sensor_msgs/msg/JointState"
        topic = writer.add_connection("/joint_states", kind, typestore=store)
        for k in range(5):
            stamp = START + k * TEN_MS
            time = types["builtin_interfaces/msg/Time"](stamp // 10**9, stamp % 10**9)
            head = types["std_msgs/msg/Header"](k, time, "")
            message = types[kind](head, ARM, HOME + 0.01 * k, 0 * HOME, np.zeros(0))
            writer.write(topic, stamp, store.serialize_ros1(message, kind))


@pytest.mark.parametrize("compression", ["", "BZ2", "LZ4"])
def test_bags_of_ros_1(tmp_path: Path, compression: str) -> None:
    write_ros_1(tmp_path / "one.bag", compression)
    out = run(tmp_path / "one.bag", tmp_path / "out", form="rosbag1")
    assert np.allclose(columns(out / "joints.csv", "position_rad"), HOME + 0.01 * np.arange(5)[:, None])
    assert columns(out / "joints.csv", "velocity_rad_s").shape == (5, 7)
    assert columns(out / "joints.csv", "effort_nm").shape == (5, 0)


@pytest.mark.parametrize("storage", ["MCAP", "SQLITE3"])
@pytest.mark.parametrize("mode", ["FILE", "MESSAGE", "STORAGE"])
def test_compressed_bags_of_ros_2(tmp_path: Path, storage: str, mode: str) -> None:
    from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    if (storage, mode) == ("SQLITE3", "STORAGE"):
        pytest.skip("SQLite compresses nothing itself")
    store = get_typestore(Stores.ROS2_HUMBLE)
    kind = "sensor_msgs/msg/JointState"
    writer = Writer(tmp_path / "bag", version=9, storage_plugin=StoragePlugin[storage])
    writer.set_compression(CompressionMode[mode], CompressionFormat.ZSTD)
    with writer:
        topic = writer.add_connection("/joint_states", kind, typestore=store)
        time = store.types["builtin_interfaces/msg/Time"](1, 0)
        head = store.types["std_msgs/msg/Header"](time, "")
        message = store.types[kind](head, ARM, HOME, np.zeros(0), np.zeros(0))
        writer.write(topic, START, store.serialize_cdr(message, kind))
    assert np.allclose(columns(run(tmp_path / "bag", tmp_path / "out") / "joints.csv", "position_rad"), HOME)


def test_two_arms_in_robosuites_keys(tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "two.hdf5", "w") as file:
        for robot in (0, 1):
            file.create_dataset(f"data/demo_0/obs/robot{robot}_joint_pos", data=np.full((4, 7), 0.1 * robot))
    with pytest.raises(stampede.Error, match="several arms, with the prefixes 'robot0_', 'robot1_'"):
        run(tmp_path / "two.hdf5", tmp_path / "out", "--rate", "20", form="robomimic")
    out = run(tmp_path / "two.hdf5", tmp_path / "out", "--rate", "20", "--prefix", "robot1_", form="robomimic")
    assert np.allclose(columns(out / "joints.csv", "position_rad"), 0.1)


def test_libero(tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    image = pytest.importorskip("PIL.Image")
    pictures = np.zeros((4, 8, 6, 3), np.uint8)
    pictures[:, 0] = 200  # OpenGL's first row is the lowest
    with h5py.File(tmp_path / "libero.hdf5", "w") as file:
        data = file.create_group("data")
        data.attrs["env_args"] = json.dumps({"env_kwargs": {"control_freq": 20}})
        data.attrs["problem_info"] = json.dumps({"language_instruction": ["open the drawer"]})
        data.attrs["macros_image_convention"] = "opengl"
        obs = data.create_group("demo_0/obs")
        obs["joint_states"] = HOME + 0.01 * np.arange(4)[:, None]
        obs["gripper_states"] = np.tile([0.02, -0.02], (4, 1))
        obs["ee_states"], obs["ee_pos"], obs["ee_ori"] = np.zeros((4, 6)), np.zeros((4, 3)), np.zeros((4, 3))
        obs["agentview_rgb"], obs["eye_in_hand_rgb"] = pictures, pictures
        data["demo_0/actions"] = np.zeros((4, 7))
    out = run(tmp_path / "libero.hdf5", tmp_path / "out", form="robomimic")
    assert np.allclose(columns(out / "joints.csv", "position_rad"), HOME + 0.01 * np.arange(4)[:, None])
    assert np.allclose(columns(out / "gripper.csv", "opening_m"), 0.04)
    recording = json.loads((out / "recording.json").read_text())
    assert {one["camera"] for one in recording["streams"] if one["kind"] == "rgb"} == {"agentview", "eye_in_hand"}
    assert json.loads((out / "labels.json").read_text())["language"] == [{"level": "task", "text": "open the drawer"}]
    first = np.asarray(image.open(next(one for one in out.rglob("*.png") if "agentview" in str(one))))
    assert first[-1].min() == 200 and first[:-1].max() == 0


def test_droid(tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "trajectory.h5", "w") as file:
        file.attrs["success"], file.attrs["current_task"] = True, "Put the marker in the mug"
        state = file.create_group("observation/robot_state")
        state["joint_positions"] = HOME + 0.01 * np.arange(5)[:, None]
        state["joint_velocities"], state["gripper_position"] = np.zeros((5, 7)), [0, 0, 0.5, 1, 1]
        state["cartesian_position"] = np.zeros((5, 6))
        clock = file.create_group("observation/timestamp/robot_state")
        clock["robot_timestamp_seconds"], clock["robot_timestamp_nanos"] = np.full(5, 7), np.arange(5) * 66_666_667
        file["action/joint_position"], file["action/gripper_position"] = np.tile(HOME, (5, 1)), np.zeros(5)
    out = run(tmp_path / "trajectory.h5", tmp_path / "out", form="robomimic")
    assert np.allclose(columns(out / "joints.csv", "position_rad"), HOME + 0.01 * np.arange(5)[:, None])
    assert np.allclose(columns(out / "joints.csv", "time_s").ravel(), 7 + np.arange(5) / 15, atol=1e-6)
    assert np.allclose(columns(out / "gripper.csv", "opening_m").ravel(), [0.085, 0.085, 0.0425, 0, 0])
    assert np.allclose(columns(out / "command.csv", "position_rad"), HOME)
    recording = json.loads((out / "recording.json").read_text())
    assert recording["task"] == "put_the_marker_in_the_mug" and recording["outcome"] == "success"
