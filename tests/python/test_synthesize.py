"""Recordings made of simulated episodes: the same for a seed, readable by others, and what was true comes back."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import stampede
from stampede.recordings import convert, import_folders
from stampede.recordings.bag_writer import McapBagWriter

pytest.importorskip("mcap")
cv2 = pytest.importorskip("cv2")
rosbags_types = pytest.importorskip("rosbags.typesys")


@pytest.fixture(scope="module")
def demos(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("demos") / "demos.db"
    pictures = {"cameras": ["front", "wrist"], "width": 64, "height": 48}
    pictures |= {"depth": False, "mask": False, "semantic_mask": False}
    stampede.Session(catalogue=path).run_all(["pick_and_lift"], episodes=1, seed=7, pictures=pictures)
    return path


@pytest.fixture(scope="module")
def bare(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("bare") / "bare.db"
    stampede.Session(catalogue=path).run_all(["pick_and_lift"], episodes=1, seed=7)
    return path


def make(demos: Path, out: Path, *options: str, episode: int = 1) -> dict[str, Any]:
    """The truth."""
    command = ["synthesize", str(demos), "--episode", str(episode), "--out", str(out), *options]
    assert convert(command, tell=lambda line: None) == [out]
    return json.loads(out.with_suffix(".truth.json").read_text())  # type: ignore[no-any-return]


def messages(bag: Path) -> list[tuple[str, int, Any]]:
    """Topic, log time and message, by rosbags: another hand than the one that wrote them."""
    from mcap.reader import make_reader

    types = rosbags_types.get_typestore(rosbags_types.Stores.ROS2_HUMBLE)
    with bag.open("rb") as stream:
        return [
            (channel.topic, message.log_time, types.deserialize_cdr(message.data, schema.name))
            for schema, channel, message in make_reader(stream).iter_messages()
        ]


def stamp_ns(message: Any) -> int:
    return int(message.header.stamp.sec * 10**9 + message.header.stamp.nanosec)


def picture_of(message: Any) -> np.ndarray[Any, Any]:
    return cv2.imdecode(message.data, cv2.IMREAD_COLOR)[..., ::-1]


def test_the_same_bytes_for_a_seed_and_other_ones_for_another(demos: Path, tmp_path: Path) -> None:
    for name, seed in (("a", 3), ("b", 3), ("c", 4)):
        make(demos, tmp_path / f"{name}.mcap", "--seed", str(seed))
    for ending in (".mcap", ".truth.json"):
        first, again, other = ((tmp_path / f"{name}{ending}").read_bytes() for name in "abc")
        assert first == again and first != other
    assert not list(tmp_path.glob(".stampede-*"))


def test_others_read_it_and_find_what_the_truth_says(demos: Path, tmp_path: Path) -> None:
    options = ["--seed", "1", "--clock-offset", "0.25", "--drift", "400", "--drop", "0.3", "--latency", "0.5"]
    truth = make(demos, tmp_path / "lab.mcap", *options)
    episode = stampede.Catalogue(demos)[1]
    found = messages(tmp_path / "lab.mcap")
    start_ns = truth["start_s"] * 10**9
    joints = [message for topic, _, message in found if topic == "/joint_states"]
    kept = [frame for frame in range(1, episode.frames) if frame not in truth["dropped_frames"]["joints"]]
    assert 0 < len(kept) == len(joints) < episode.frames - 1
    assert [round((stamp_ns(one) - start_ns) / 1e9 * episode.frame_hz, 3) for one in joints] == kept
    assert joints[0].name[:7] == list(truth["joint_offsets_rad"]) and len(joints[0].name) == 9
    offsets = np.array(list(truth["joint_offsets_rad"].values()))
    assert 0 < np.degrees(np.abs(offsets)).max() <= 0.5
    read = np.array([one.position[:7] for one in joints])
    assert np.abs(read + offsets - episode.arrays("joint_positions")["joint_positions"][kept]).max() < 2e-4
    effort = np.array([one.effort[:7] for one in joints]) - episode.arrays("joint_forces")["joint_forces"][kept]
    assert np.abs(np.mean(effort, axis=0)).max() > 0.1  # sensors are off
    for camera in ("front", "wrist"):
        seen = [(log, one) for topic, log, one in found if topic == f"/camera/{camera}/image/compressed"]
        frames = [frame for frame in range(1, episode.frames) if frame not in truth["dropped_frames"][camera]]
        assert len(seen) == len(frames) < episode.frames - 1
        true_s = np.array(frames) / episode.frame_hz
        stamps = np.array([(stamp_ns(one) - start_ns) / 1e9 for _, one in seen])
        assert np.abs(stamps + 0.25 + 400e-6 * true_s - true_s).max() < 4e-3
        assert np.allclose([(log - start_ns) / 1e9 - 0.5 for log, _ in seen], true_s, atol=1e-6)
        stored = episode.pictures(f"{camera}_rgb", frames).astype(int)
        off = np.abs(np.array([picture_of(one) for _, one in seen]).astype(int) - stored)
        assert 0.5 < off.mean() < 8


def test_its_definitions_are_those_of_ros(demos: Path, tmp_path: Path) -> None:
    from mcap.reader import make_reader

    make(demos, tmp_path / "lab.mcap")
    with (tmp_path / "lab.mcap").open("rb") as stream:
        schemas = list(make_reader(stream).get_summary().schemas.values())
    known = rosbags_types.get_typestore(rosbags_types.Stores.ROS2_HUMBLE)
    assert len(schemas) == 2
    for schema in schemas:
        assert schema.encoding == "ros2msg"
        for name, fields in rosbags_types.get_types_from_msg(schema.data.decode(), schema.name).items():
            assert fields[1] == known.get_msgdef(name).fields


def test_import_recovers_the_episode(demos: Path, tmp_path: Path) -> None:
    truth = make(demos, tmp_path / "lab.mcap", "--seed", "2", "--noise", "0", "--pictures", "png")
    (tmp_path / "cameras.json").write_text(json.dumps(truth["camera_file"]))
    base = " ".join(map(str, truth["base"]["position"] + truth["base"]["quaternion"]))
    out = tmp_path / "lab"
    command = ["mcap", str(tmp_path / "lab.mcap"), "--out", str(out), "--base", base]
    convert([*command, "--frame-hz", "20", "--cameras", str(tmp_path / "cameras.json")], tell=lambda line: None)
    recording = json.loads((out / "recording.json").read_text())
    recording["clocks"] |= truth["clocks"]  # what calibration finds of a real one
    recording["start_s"] = truth["start_s"] + 0.05
    (out / "recording.json").write_text(json.dumps(recording))
    import_folders([out], tmp_path / "real.db", lambda line: None)
    real, true = stampede.Catalogue(tmp_path / "real.db")[1], stampede.Catalogue(demos)[1]
    assert real.seed is None and real.frames == true.frames - 1  # no motor has worked at frame 0
    kept = [frame for frame in range(1, true.frames) if frame not in truth["dropped_frames"]["joints"]]
    rows = np.array(kept) - 1
    names = ("joint_positions", "gripper_opening", "gripper_pose")
    (joints, opening, tool), was = (real.arrays(*names)[name] for name in names), true.arrays(*names)
    offsets = np.array(list(truth["joint_offsets_rad"].values()))
    assert np.abs(joints[rows] + offsets - was["joint_positions"][kept]).max() < 1e-6
    assert np.abs(opening[rows] - was["gripper_opening"][kept]).max() < 1e-6
    assert np.linalg.norm(tool[rows, :3] - was["gripper_pose"][kept, :3], axis=1).max() < 0.03  # of joints that are off
    for camera in ("front", "wrist"):
        frames = [frame for frame in range(1, true.frames) if frame not in truth["dropped_frames"][camera]]
        assert real.stored_pictures[f"{camera}_rgb"] == [frame - 1 for frame in frames]
        seen = real.pictures(f"{camera}_rgb", real.stored_pictures[f"{camera}_rgb"])
        assert (seen == true.pictures(f"{camera}_rgb", frames)).all()


def test_other_lenses_and_sizes(demos: Path, tmp_path: Path) -> None:
    options = ["--cameras", "wrist", "--noise", "0", "--drop", "0", "--pictures", "png", "--pictures-every", "20"]
    options += ["--size", "320x240"]
    straight = make(demos, tmp_path / "straight.mcap", *options)["camera_file"]["cameras"][0]
    bent = make(demos, tmp_path / "bent.mcap", *options, "--distortion=-0.4,0.1")["camera_file"]["cameras"][0]
    shown = {}
    for name in ("straight", "bent"):
        seen = [one for topic, _, one in messages(tmp_path / f"{name}.mcap") if "camera" in topic]
        shown[name] = picture_of(seen[0])
    drawn = stampede.Catalogue(demos)[1].picture(20, "wrist", width=320, height=240)
    assert (shown["straight"] == drawn["rgb"]).all()
    assert np.allclose(straight["camera_matrix"], drawn["intrinsics"]) and straight["distortion"] == [0] * 5
    assert bent["distortion"] == [-0.4, 0.1, 0, 0, 0] and bent["camera_matrix"] == straight["camera_matrix"]
    matrix = np.array(bent["camera_matrix"])
    matrix[:2, 2] -= 0.5  # OpenCV counts pixels from their centres
    undone = cv2.undistort(shown["bent"], matrix, np.array(bent["distortion"]))
    inner = (slice(40, -40), slice(50, -50))
    off = [np.abs(one[inner].astype(int) - shown["straight"][inner]).mean() for one in (undone, shown["bent"])]
    assert off[0] < 0.5 * off[1]


def test_an_episode_without_pictures(bare: Path, tmp_path: Path) -> None:
    out = tmp_path / "lab.mcap"
    with pytest.raises(stampede.Error, match="no pictures of it are stored") as caught:
        make(bare, out)
    assert "--cameras front draws them now" in caught.value.hint and not list(tmp_path.iterdir())
    make(bare, out, "--cameras", "")
    assert {topic for topic, _, _ in messages(out)} == {"/joint_states"}
    make(bare, tmp_path / "drawn.mcap", "--cameras", "front")
    assert {topic for topic, _, _ in messages(tmp_path / "drawn.mcap")} == {
        "/joint_states",
        "/camera/front/image/compressed",
    }


@pytest.mark.parametrize(
    ("options", "where", "what"),
    [
        (["--drop", "1"], "--drop", "not within 0 … 0.9"),
        (["--drop", "nan"], "--drop", "not within"),
        (["--noise", "-1"], "--noise", "not within"),
        (["--latency", "0.05,0.02"], "--latency", "most first"),
        (["--latency", "soon"], "--latency", "not 1 or 2 numbers"),
        (["--drift", "5000"], "--drift", "not within"),
        (["--clock-offset", "inf"], "--clock-offset", "not within"),
        (["--joint-offset", "90"], "--joint-offset", "not within"),
        (["--joints-every", "0"], "--joints-every", "not within"),
        (["--pictures-every", "0"], "--pictures-every", "not within"),
        (["--seed", "-1"], "--seed", "not within"),
        (["--distortion=0.1,0.1,0.1"], "--distortion", "not 2 or 4 or 5 numbers"),
        (["--distortion=7,0"], "--distortion", "not within"),
        (["--size", "640"], "--size", "no size"),
        (["--cameras", "frnt"], "episode 1", "there is no camera 'frnt'"),
    ],
)
def test_what_cannot_be(demos: Path, tmp_path: Path, options: list[str], where: str, what: str) -> None:
    with pytest.raises(stampede.Error) as caught:
        make(demos, tmp_path / "lab.mcap", *options)
    assert where in caught.value.where and what in caught.value.message and caught.value.hint
    assert not list(tmp_path.iterdir())


def test_episodes_and_names_that_cannot_be(demos: Path, tmp_path: Path) -> None:
    with pytest.raises(stampede.Error, match="there is no episode 9"):
        make(demos, tmp_path / "lab.mcap", episode=9)
    with pytest.raises(stampede.Error, match="no name of a bag"):
        make(demos, tmp_path / "lab.bag")
    with pytest.raises(stampede.Error, match="there is no folder"):
        make(demos, tmp_path / "none" / "lab.mcap")
    make(demos, tmp_path / "lab.mcap", "--cameras", "")
    before = (tmp_path / "lab.mcap").read_bytes()
    with pytest.raises(stampede.Error, match="there is something of that name"):
        make(demos, tmp_path / "lab.mcap", "--seed", "5")
    assert (tmp_path / "lab.mcap").read_bytes() == before
    convert(["mcap", str(tmp_path / "lab.mcap"), "--out", str(tmp_path / "lab")], tell=lambda line: None)
    import_folders([tmp_path / "lab"], tmp_path / "real.db", lambda line: None)
    with pytest.raises(stampede.Error, match="it is a real one"):
        make(tmp_path / "real.db", tmp_path / "again.mcap")


def test_after_an_error_nothing_is_left(tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt), McapBagWriter(tmp_path / "lab.mcap") as bag:
        bag.joint_state("/joint_states", 1, 2, ["panda_joint1"], [0.5])
        raise KeyboardInterrupt
    assert not list(tmp_path.iterdir())


def test_what_lies_beside_the_bag_stays(demos: Path, tmp_path: Path) -> None:
    for name in ("lab.mcap.part", "lab.truth.json.part"):
        (tmp_path / name).write_text("mine")
    make(demos, tmp_path / "lab.mcap", "--cameras", "")
    with pytest.raises(stampede.Error, match="there is something of that name"), McapBagWriter(tmp_path / "b.mcap"):
        (tmp_path / "b.mcap").write_text("mine")
    assert sum(file.is_file() and file.read_text(errors="replace") == "mine" for file in tmp_path.iterdir()) == 3
    assert len(list(tmp_path.iterdir())) == 5


def test_lossless_pictures_need_no_opencv(demos: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "cv2", None)
    make(demos, tmp_path / "lab.mcap", "--pictures", "png")
    with pytest.raises(ImportError, match="OpenCV is missing"):
        make(demos, tmp_path / "jpeg.mcap")
    assert not (tmp_path / "jpeg.mcap").exists()
