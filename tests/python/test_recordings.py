"""Recordings as recording folders: bags that rosbags writes, our own MCAP files, LeRobot and robomimic."""

from __future__ import annotations

import csv
import io
import json
import shutil
import struct
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import stampede
from stampede.recordings import convert
from stampede.recordings.folder import FolderWriter, stamp_text
from stampede.recordings.messages import decoder
from stampede.recordings.pictures import packed
from stampede.recordings.roles import camera_name, prefixes_of
from stampede.robots import robot_of

pytest.importorskip("rosbags")
pytest.importorskip("mcap")
sys.path.insert(0, str(Path(__file__).parents[1] / "bench" / "python"))
from ros_bag import RosBag  # noqa: E402

NAMES = [f"panda_joint{k}" for k in range(1, 8)] + ["panda_finger_joint1", "panda_finger_joint2"]
HOME = np.array([0, -0.78, 0, -2.35, 0, 1.57, 0.78, 0.02, 0.02])
STEP = np.array([0.001] * 7 + [0.0002] * 2)  # rad, m
START = 1_700_000_000 * 10**9  # ns
PIXELS = np.arange(6 * 8 * 3, dtype=np.uint8).reshape(6, 8, 3)
DEPTH = (np.arange(48, dtype=np.uint16) * 100).reshape(6, 8)
MATRIX = np.array([[600.0, 0, 4], [0, 601.0, 3], [0, 0, 1]])


def jpeg() -> bytes:
    stream = io.BytesIO()
    Image.fromarray(PIXELS).save(stream, "JPEG")
    return stream.getvalue()


def write_bag(folder: Path, form: str = "mcap", count: int = 20, **other: Any) -> Path:
    """An arm at 100 Hz, two cameras at 10, a wrench. other: what is otherwise than usual."""
    with RosBag(folder, form) as bag:
        bag.transform("/tf_static", START, START, "panda_link0", "front_optical", [1, 0, 0.5, 0.0, 0.0, 0.0, 1.0])
        bag.transform("/tf_static", START, START, "panda_hand", "wrist_optical", [0.07, 0, 0, 0.0, 0.0, 0.0, 1.0])
        for k in range(count):
            stamp = START + k * 10**7
            if other.get("backwards") == k:
                stamp -= 5 * 10**7
            q = HOME + k * STEP
            if other.get("nan") == k:
                q[2] = np.nan
            names = other.get("names", NAMES)
            effort = np.arange(9.0) if k else np.where(np.arange(9) == 3, np.nan, np.arange(9.0))
            bag.joint_state(
                "/joint_states",
                stamp if other.get("stamped", True) else 0,
                START + k * 10**7 + 300,
                names,
                q,
                0 * q,
                effort,
            )
            bag.wrench("/ft_sensor/wrench", stamp, stamp + 300, [1, 2, 3, 0.1, 0.2, k], "panda_hand")
            if k % 10 == 0:
                bag.compressed(
                    "/front/color/image_raw/compressed",
                    stamp,
                    stamp + 10**7,
                    "rgb8; jpeg compressed bgr8",
                    jpeg(),
                    "front_optical",
                )
                bag.image("/front/color/image_raw", stamp, stamp + 10**7, "rgb8", PIXELS, "front_optical")
                bag.image(
                    "/front/aligned_depth_to_color/image_raw", stamp, stamp + 10**7, "16UC1", DEPTH, "front_optical"
                )
                bag.image(
                    "/wrist/image_raw",
                    stamp,
                    stamp + 10**7,
                    other.get("encoding", "bgr8"),
                    PIXELS[..., ::-1],
                    "wrist_optical",
                )
                for camera in ("front", "wrist"):
                    bag.camera_info(
                        f"/{camera}/camera_info", stamp, stamp, (8, 6), MATRIX, [0.1, 0, 0, 0, 0], f"{camera}_optical"
                    )
    return folder


def run(source: Path, out: Path, *options: str, form: str = "mcap") -> tuple[Path, list[str]]:
    told: list[str] = []
    convert([form, str(source), "--out", str(out), *options], tell=told.append)
    assert not list(out.parent.glob(".stampede-*"))
    return out, told


def table(file: Path) -> list[dict[str, str]]:
    with file.open() as stream:
        return list(csv.DictReader(stream))


@pytest.mark.parametrize("form", ["mcap", "db3"])
def test_a_bag_becomes_a_folder_with_all_that_is_in_it(tmp_path: Path, form: str) -> None:
    bag = write_bag(tmp_path / "bag", form)
    out, told = run(bag, tmp_path / "out", "--base", "-0.3 0 0.75", "--task", "Pick up!", form="rosbag2")
    recording = json.loads((out / "recording.json").read_text())
    assert recording["stampede_recording"] == 1 and recording["task"] == "pick_up" and recording["outcome"] == "success"
    assert recording["robot"] == {"name": "panda", "base": {"position": [-0.3, 0, 0.75], "quaternion": [0, 0, 0, 1]}}
    streams = {(one["kind"], one.get("camera") or one.get("name")): one for one in recording["streams"]}
    assert set(streams) == {
        ("joints", None),
        ("gripper", None),
        ("wrench", "wrench"),
        ("rgb", "front"),
        ("depth", "front"),
        ("rgb", "wrist"),
    }
    assert streams["wrench", "wrench"]["link"] == "hand" and streams["depth", "front"]["unit_m"] == 0.001
    assert set(recording["clocks"]) == {"robot", "front", "wrist"}
    joints = table(out / "joints.csv")
    assert len(joints) == 20 and joints[1]["time_s"] == "1700000000.010000000"
    assert float(joints[5]["joint4_position_rad"]) == HOME[3] + 0.005 and float(joints[5]["joint6_effort_nm"]) == 5
    assert joints[0]["joint4_effort_nm"] == ""  # a driver's NaN is no reading
    assert float(table(out / "gripper.csv")[2]["opening_m"]) == pytest.approx(0.0408)
    assert float(table(out / "wrench.csv")[7]["torque_z_nm"]) == 7
    assert any("logged 10.0 ms after" in line for line in told)


def test_pictures_go_through_or_are_packed_without_loss(tmp_path: Path) -> None:
    out, _ = run(write_bag(tmp_path / "bag"), tmp_path / "out")
    assert (out / "front_rgb" / "000002.jpg").read_bytes() == jpeg()  # compressed goes before raw
    assert (np.asarray(Image.open(out / "wrist_rgb" / "000001.png")) == PIXELS).all()
    assert (np.asarray(Image.open(out / "front_depth" / "000001.png")) == DEPTH).all()
    assert [row["file"] for row in table(out / "front_rgb.csv")] == ["000001.jpg", "000002.jpg"]


def test_cameras_are_where_the_transforms_say(tmp_path: Path) -> None:
    out, _ = run(write_bag(tmp_path / "bag"), tmp_path / "out", "--base", "-0.3 0 0.75")
    cameras = {one["name"]: one for one in json.loads((out / "cameras.json").read_text())["cameras"]}
    assert cameras["front"]["mount"] == "world" and cameras["wrist"]["mount"] == "robot.hand"
    assert np.allclose(np.array(cameras["front"]["mount_from_camera"])[:3, 3], [0.7, 0, 1.25])
    assert np.allclose(np.array(cameras["wrist"]["mount_from_camera"])[:3, 3], [0.07, 0, 0])
    assert cameras["front"]["camera_matrix"] == MATRIX.tolist() and cameras["front"]["distortion"][0] == 0.1


def test_maps_and_clocks(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", stamped=False)
    out, _ = run(bag, tmp_path / "out", "--map", "rgb.side=/front/color/image_raw,depth=none,wrench=none")
    recording = json.loads((out / "recording.json").read_text())
    assert {one.get("camera") for one in recording["streams"] if one["kind"] == "rgb"} == {"side"}
    assert not [one for one in recording["streams"] if one["kind"] in ("depth", "wrench")]
    joints = next(one for one in recording["streams"] if one["kind"] == "joints")
    assert joints["clock"] == "log" and table(out / "joints.csv")[0]["time_s"] == "1700000000.000000300"
    out, _ = run(bag, tmp_path / "logged", "--clock", "log")
    assert set(json.loads((out / "recording.json").read_text())["clocks"]) == {"log"}


def test_names() -> None:
    assert camera_name("/camera/front/image") == "front" and camera_name("/front/color/image_raw/compressed") == "front"
    assert camera_name("/camera/color/image_raw") == "camera" and camera_name("/2nd/image") == "camera_2nd"
    two = ["joint1", "joint2"]
    assert prefixes_of(["joint1", "joint7"], NAMES) == ["panda_"]
    assert prefixes_of(two, ["rail_joint1", "joint1", "joint2"]) == [""]
    assert prefixes_of(two, ["a.joint1", "a.joint2", "b/joint2", "b/joint1"]) == ["a.", "b/"]
    assert prefixes_of(two, ["a_joint1", "b_joint2", "myjoint1", "myjoint2"]) == []
    assert stamp_text(1_700_000_000_000_000_001) == "1700000000.000000001" and stamp_text(-5) == "-0.000000005"
    assert prefixes_of(["joint1"], ["iiwa_joint_1"]) == []


# Bad input: an Error with place and cure, and no folder.


def refused(tmp_path: Path, bag: Path, *options: str, form: str = "mcap") -> stampede.Error:
    with pytest.raises(stampede.Error) as caught:
        run(bag, tmp_path / "out", *options, form=form)
    assert not (tmp_path / "out").exists() and not list(tmp_path.glob("out*")) and caught.value.hint
    return caught.value


def test_clocks_that_run_backwards(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", backwards=12)
    error = refused(tmp_path, bag, "--map", "wrench=none")
    assert (
        "runs backwards, from 1700000000.110000000 to 1700000000.070000000" in error.message
        and "/joint_states" in error.where
    )
    out, told = run(bag, tmp_path / "kept", "--skip-bad")
    assert len(table(out / "joints.csv")) == 19 and any("1 left out" in line for line in told)
    stamps = [float(row["time_s"]) for row in table(out / "joints.csv")]
    assert stamps == sorted(set(stamps))


def test_positions_that_are_no_numbers(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", nan=4)
    assert "position of joint3 is not a number" in refused(tmp_path, bag).message
    out, _ = run(bag, tmp_path / "kept", "--skip-bad")
    assert len(table(out / "joints.csv")) == 19


def test_a_joint_state_with_fewer_positions_than_names(tmp_path: Path) -> None:
    with RosBag(tmp_path / "bag") as bag:
        for k in range(5):
            stamp = START + k * 10**7
            bag.joint_state("/joint_states", stamp, stamp, NAMES, HOME[: 9 if k != 2 else 3])
    assert "it has 3 positions for 9 names of joints" in refused(tmp_path, tmp_path / "bag").message
    out, told = run(tmp_path / "bag", tmp_path / "again", "--skip-bad")
    assert len(table(out / "joints.csv")) == 4 and any("1 left out" in line for line in told)


def test_another_robot(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", names=[f"iiwa_joint_{k}" for k in range(1, 10)])
    error = refused(tmp_path, bag)
    assert "another robot" in error.message and "iiwa_joint_1" in error.message
    assert "did you mean 'panda'" in str(refused(tmp_path, bag, "--robot", "pandas"))


def test_missing_topics(tmp_path: Path) -> None:
    with RosBag(tmp_path / "bag") as bag:
        bag.wrench("/wrench", START, START, [0] * 6)
    error = refused(tmp_path, tmp_path / "bag")
    assert "no topic of joint states" in error.message and "/wrench" in error.hint
    whole = write_bag(tmp_path / "whole")
    assert "did you mean '/joint_states'" in str(refused(tmp_path, whole, "--map", "joints=/joint_state"))
    assert "did you mean 'depth'" in str(refused(tmp_path, whole, "--map", "dept.front=/x"))


def test_two_arms_must_be_told_apart(tmp_path: Path) -> None:
    with RosBag(tmp_path / "bag") as bag:
        for topic in ("/left/joint_states", "/right/joint_states"):
            bag.joint_state(topic, START, START, NAMES, HOME)
    assert "both have the arm's joints" in refused(tmp_path, tmp_path / "bag").message
    out, _ = run(tmp_path / "bag", tmp_path / "one", "--map", "joints=/left/joint_states")
    assert table(out / "joints.csv")


def test_truncated_files(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", count=400)
    file = next(bag.glob("*.mcap"))
    file.write_bytes(file.read_bytes()[: file.stat().st_size * 2 // 3])
    error = refused(tmp_path, bag)
    assert "ends early" in error.message and "--truncated" in error.hint
    sqlite = next(write_bag(tmp_path / "bag3", "db3", count=400).glob("*.db3"))
    sqlite.write_bytes(sqlite.read_bytes()[: sqlite.stat().st_size // 2])
    assert "ends early or is damaged" in refused(tmp_path, sqlite).message
    (tmp_path / "empty").write_bytes(b"")
    assert "neither MCAP" in refused(tmp_path, tmp_path / "empty").message
    assert "cannot be read" in refused(tmp_path, tmp_path / "nothing").message


def test_of_a_truncated_file_what_is_whole_is_taken(tmp_path: Path) -> None:
    from mcap.writer import Writer

    source = next(write_bag(tmp_path / "bag", count=400).glob("*.mcap"))
    from stampede.recordings.bags import open_bag

    bag = open_bag(source)
    short = tmp_path / "short.mcap"
    with short.open("wb") as stream:
        writer = Writer(stream, chunk_size=4096)
        writer.start()
        ids = {}
        for topic in bag.topics():
            ids[topic.name] = writer.register_channel(
                topic.name, "cdr", writer.register_schema(topic.schema, "ros2msg", b"")
            )
        for name, log_ns, data in bag.messages(set(ids)):
            writer.add_message(ids[name], log_ns, data, log_ns)
        writer.finish()
    short.write_bytes(short.read_bytes()[: short.stat().st_size // 2])
    refused(tmp_path, short)
    out, _ = run(short, tmp_path / "part", "--truncated")
    assert 20 < len(table(out / "joints.csv")) < 390


@pytest.mark.parametrize("encoding", ["bayer_rggb8", "yuv422"])
def test_unknown_encodings(tmp_path: Path, encoding: str) -> None:
    bag = write_bag(tmp_path / "bag", encoding=encoding)
    error = refused(tmp_path, bag)
    assert f"encoding '{encoding}'" in error.message and "/wrist/image_raw" in error.where and "rgb=none" in error.hint


def test_raw_pictures_are_packed_in_their_order(tmp_path: Path) -> None:
    """By several threads: each file is its picture, and of several bad ones the first is named."""

    def write(name: str, bad: tuple[int, ...]) -> Path:
        with RosBag(tmp_path / name) as bag:
            for k in range(60):
                stamp = START + k * 10**7
                bag.joint_state("/joint_states", stamp, stamp, NAMES, HOME, 0 * HOME, 0 * HOME)
                form = "rgba8" if k in bad else "rgb8"  # it says more bytes than there are
                tall = k % 3 + 1  # they take unlike times
                pixels = np.full((6 * (1 if k in bad else 40 * tall), 8, 3), k, dtype=np.uint8)
                bag.image("/front/image_raw", stamp, stamp, form, pixels, "front_optical")
        return tmp_path / name

    out, _ = run(write("good", ()), tmp_path / "whole")
    names = sorted(one.name for one in (out / "front_rgb").iterdir())
    assert names == [f"{k + 1:06d}.png" for k in range(60)] == [one["file"] for one in table(out / "front_rgb.csv")]
    for k, name in enumerate(names):
        with Image.open(out / "front_rgb" / name) as picture:
            pixels = np.asarray(picture)
        assert pixels.shape == (240 * (k % 3 + 1), 8, 3) and (pixels == k).all()
    for _ in range(5):
        error = refused(tmp_path, write("bad", (57, 58)))
        assert error.where.endswith("picture 58")
        shutil.rmtree(tmp_path / "bad")


def test_messages_in_other_encodings(tmp_path: Path) -> None:
    from mcap.writer import Writer

    file = tmp_path / "proto.mcap"
    with file.open("wb") as stream:
        writer = Writer(stream)
        writer.start()
        schema = writer.register_schema("foxglove.JointStates", "protobuf", b"")
        writer.add_message(writer.register_channel("/joints", "protobuf", schema), 1, b"\x00", 1)
        writer.finish()
    assert "encoding 'protobuf'" in refused(tmp_path, file).message


def test_damaged_messages_and_pictures(tmp_path: Path) -> None:
    read = decoder("/joints", "sensor_msgs/msg/JointState", "cdr")
    head = b"\0\1\0\0"
    for data in (b"", b"\7\7\0\0", head + b"\0" * 8 + struct.pack("<I", 1000), head + b"\xff" * 40):
        with pytest.raises(stampede.Error, match="topic /joints, message logged at 0.000000 s: it ends early or is damaged"):
            read(data, 0)
    with RosBag(tmp_path / "bag") as bag:
        bag.joint_state("/joint_states", START, START, NAMES, HOME)
        bag.compressed("/front/image", START, START, "jpeg", jpeg()[:-40], "front")
    assert "JPEG picture ends early" in refused(tmp_path, tmp_path / "bag").message


def test_a_folder_that_is_there_stays(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag")
    (tmp_path / "mine").mkdir()
    with pytest.raises(stampede.Error, match="there is something of that name"):
        run(bag, tmp_path / "mine")
    assert not list((tmp_path / "mine").iterdir())


@pytest.mark.parametrize("whole", [True, False])
def test_what_lies_beside_the_new_folder_stays(tmp_path: Path, whole: bool) -> None:
    bag = write_bag(tmp_path / "bag")
    mine = tmp_path / "new.part" / "notes.txt"
    mine.parent.mkdir()
    mine.write_text("mine")
    if whole:
        run(bag, tmp_path / "new")
    else:
        with pytest.raises(stampede.Error):
            run(bag, tmp_path / "new", "--map", "joints=/nothing")
    assert mine.read_text() == "mine"
    expected = {"bag", "new.part"} | ({"new"} if whole else set())
    assert {one.name for one in tmp_path.iterdir()} == expected  # nor is anything left


def test_a_name_that_is_taken_meanwhile_or_a_link_to_nowhere_is_not_written_over(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag")
    (tmp_path / "link").symlink_to(tmp_path / "nowhere")
    with pytest.raises(stampede.Error, match="there is something of that name"):
        run(bag, tmp_path / "link")
    (tmp_path / "file").write_text("mine")
    with pytest.raises(stampede.Error, match="file: it is no folder"):
        run(bag, tmp_path / "file" / "new")
    with pytest.raises(stampede.Error, match="there is something of that name"), FolderWriter(tmp_path / "new") as new:
        new.finish({"task": "wave"})
        (tmp_path / "new").write_text("mine")
    assert (tmp_path / "new").read_text() == "mine" and not (tmp_path / "nowhere").exists()


def test_what_big_endian_machines_write() -> None:
    # stamp, frame, no names, one position
    data = b"\0\0\0\0" + struct.pack(">iII", 7, 5, 2) + b"a\0\0\0" + struct.pack(">IId", 0, 1, 1.5)
    data += struct.pack(">II", 0, 0)
    one = decoder("/joints", "sensor_msgs/msg/JointState", "cdr")(data, 0)
    assert one.stamp_ns == 7 * 10**9 + 5 and one.position.tolist() == [1.5]  # type: ignore[attr-defined]


def test_packed_pictures_are_what_they_were() -> None:
    rng = np.random.default_rng(1)
    for picture in (rng.integers(0, 255, (5, 7, 3), dtype=np.uint8), rng.integers(0, 65535, (4, 6)).astype(np.uint16)):
        assert (np.asarray(Image.open(io.BytesIO(packed(picture)))) == picture).all()


def imports_recordings() -> bool:
    program = Path(stampede.__file__).parent / "engine" / "bin" / "stampede"
    return "recording" in subprocess.run([program, "import", "--help"], capture_output=True, text=True).stdout


@pytest.mark.skipif(not imports_recordings(), reason="this engine imports no recordings")
def test_a_bag_goes_into_a_catalogue(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", count=51)
    catalogue = tmp_path / "demos.db"
    run(bag, tmp_path / "out", "--base", "-0.3 0 0.75", "--frame-hz", "20", "--into", str(catalogue))
    episode = next(iter(stampede.Catalogue(catalogue)))
    source = episode.catalogue.query("SELECT source FROM episodes").values("source")
    assert source == ["real"] and episode.frames == 11 and episode.frame_hz == 20 and episode.task == "out"
    arrays = episode.arrays("joint_positions", "gripper_pose")
    assert np.allclose(arrays["joint_positions"][:, 3], HOME[3] + 0.001 * np.arange(0, 51, 5), atol=1e-6)
    hand = robot_of("panda").poses(arrays["joint_positions"])["hand"] @ [0, 0, 0.1034, 1]
    assert np.allclose(hand[:, :3] + [-0.3, 0, 0.75], arrays["gripper_pose"][:, :3], atol=1e-6)
    assert {"front_rgb", "wrist_rgb", "front_depth"} <= set(episode.stored_pictures)


@pytest.mark.skipif(not imports_recordings(), reason="this engine imports no recordings")
def test_what_the_engine_refuses_is_told_and_stays(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", count=200)  # the fingers open wider than they can
    with pytest.raises(stampede.Error, match="it was written, but not imported.*opens by 0.080 m"):
        run(bag, tmp_path / "out", "--into", str(tmp_path / "demos.db"))
    assert (tmp_path / "out" / "recording.json").is_file()
