"""Real episodes: cameras that bags carry about, those that nobody has placed, and exports of what has no seed."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import stampede
from stampede.calibrate.apply import apply
from stampede.calibrate.recorded import Recording
from stampede.export import export, split_of
from stampede.export.pictures import is_png, png_files
from stampede.recordings import convert
from stampede.recordings.carried import Tracks, carried
from stampede.recordings.frames import Frames
from stampede.recordings.messages import TransformReading
from stampede.robots import robot_of

PROGRAM = Path(stampede.__file__).parent / "engine" / "bin" / "stampede"
STEPS = ["lerobot", "robomimic", "rlds", "libero", "maniskill", "mimicgen"]
PANDA = robot_of("panda")


@pytest.fixture(scope="module")
def demos(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("demos") / "demos.db"
    pictures = {"cameras": ["front", "wrist"], "width": 32, "height": 24}
    pictures |= dict.fromkeys(("depth", "mask", "semantic_mask"), False)
    stampede.Session(catalogue=path).run_all(["pick_and_lift"], episodes=1, seed=5, pictures=pictures)
    return path


@pytest.fixture(scope="module")
def recorded(demos: Path) -> Path:
    """The episode as a recording folder."""
    folder = demos.parent / "recorded"
    subprocess.run([PROGRAM, "export", "recording", demos, "--out", folder], check=True, capture_output=True)
    return folder


def imported(recorded: Path, without: tuple[str, ...]) -> Path:
    """A catalogue of the recording without streams of these kinds."""
    file = recorded / "recording.json"
    whole = file.read_text()
    catalogue = recorded.parent / ("_".join(["real", *without]) + ".db")
    document = json.loads(whole)
    document["streams"] = [one for one in document["streams"] if one["kind"] not in without]
    try:
        file.write_text(json.dumps(document))
        if not catalogue.exists():
            command = [PROGRAM, "import", "recording", recorded, "--out", catalogue]
            subprocess.run(command, check=True, capture_output=True)
    finally:
        file.write_text(whole)
    return catalogue


def written(form: str, catalogue: Path, out: Path) -> Path:
    assert export([form, str(catalogue), "--out", str(out)], tell=lambda line: None) == 1
    assert not list(out.rglob("*.part*")) and not (out / ".pieces").exists()
    return out


@pytest.mark.parametrize("form", ["mcap", "lerobot", "robomimic"])
def test_exports_become_real_episodes(demos: Path, tmp_path: Path, form: str) -> None:
    pytest.importorskip({"mcap": "mcap", "lerobot": "pyarrow", "robomimic": "h5py"}[form])
    exported = written(form, demos, tmp_path / "export")
    source = exported if form == "lerobot" else next(exported.glob("pick_and_lift*"))
    told: list[str] = []
    convert([form, str(source), "--out", str(tmp_path / "out"), "--into", str(tmp_path / "real.db")], tell=told.append)
    (made,) = stampede.Catalogue(demos).episodes()
    (real,) = stampede.Catalogue(tmp_path / "real.db").episodes()
    assert real.frame_hz == made.frame_hz and real.frames in (made.frames, made.frames - 1)
    assert set(real.instructions()) <= set(made.instructions()) and real.instructions()
    assert {name: len(frames) for name, frames in real.stored_pictures.items()} == dict.fromkeys(
        ("front_rgb", "wrist_rgb"), real.frames
    )
    columns = ["joint_positions", *(["wrist_camera_extrinsics", "front_camera_extrinsics"] if form == "mcap" else [])]
    truth, found = made.arrays(*columns), real.arrays(*columns)
    for column in columns:  # of a bag also where the cameras were: the wrist's is found to hang from the hand
        assert np.allclose(found[column], truth[column][: real.frames], atol=1e-5)
    if form == "mcap":
        cameras = {
            one["name"]: one["mount"] for one in json.loads((tmp_path / "out/cameras.json").read_text())["cameras"]
        }
        assert cameras == {"front": "world", "wrist": "robot.hand"}
        assert json.loads((tmp_path / "out/recording.json").read_text())["robot"]["base"]["position"] == [-0.3, 0, 0.75]


# Cameras that move.


def moved(frames: Frames, frame: str, parent: str, off: float = 0.0, late_ns: int = 0, jitter: float = 0.0) -> None:
    """A second of transforms at 100 Hz: x runs at 0.3 m/s."""
    for k in range(100):
        time = k * 10**7 + late_ns
        pose = np.array([3e-10 * time + off + jitter * (k % 2), 0, 0.5, 0, 0, 0, 1.0])
        frames.add(TransformReading(time, time, [(parent, frame, pose)]), time)


def test_a_camera_hangs_from_the_link_that_it_moves_with() -> None:
    frames = Frames()
    moved(frames, "panda_hand", "panda_link0")
    moved(frames, "tracked", "panda_link0", off=0.07, late_ns=4 * 10**6)  # by another driver, at times of its own
    mount = frames.mount_of("tracked", PANDA, np.eye(4))
    assert not isinstance(mount, str) and mount[0] == "robot.hand"
    assert np.allclose(mount[1][:3, 3], [0.07, 0, 0], atol=1e-6)


def test_a_camera_that_shakes_stands() -> None:
    frames = Frames()
    moved(frames, "panda_hand", "panda_link0")
    for k in range(100):
        pose = np.array([0.001 * (k % 2), 0, 1.0, 0, 0, 0, 1])
        frames.add(TransformReading(k * 10**7, k * 10**7, [("panda_link0", "shaken", pose)]), k * 10**7)
    world_from_base = np.eye(4)
    world_from_base[2, 3] = 0.75
    mount = frames.mount_of("shaken", PANDA, world_from_base)
    assert not isinstance(mount, str) and mount[0] == "world" and mount[1][2, 3] == pytest.approx(1.75)


def test_a_camera_that_moves_with_no_link() -> None:
    frames = Frames()
    moved(frames, "panda_hand", "panda_link0")
    moved(frames, "loose", "panda_link0", jitter=0.02)
    assert "moves with no link of panda: with hand it does so best, and is off by 10 mm" in str(
        frames.mount_of("loose", PANDA, np.eye(4))
    )
    alone = Frames()
    moved(alone, "loose", "map")
    assert "no transform says where a link of panda is" in str(alone.mount_of("loose", PANDA, np.eye(4)))
    assert "no transform says where nothing is" in str(alone.mount_of("nothing", PANDA, np.eye(4)))


def test_long_tracks_are_thinned_alike() -> None:
    tracks = Tracks()
    for k in range(20_000):
        for frame in ("a", "b") if k > 3000 else ("a",):
            tracks.add(frame, k * 10**7, np.eye(4))
    times = tracks.times(["b"])
    assert len(times) == 200 and all(tracks.at("a", time) is not None for time in times)
    assert tracks.at("a", 10**13) is None
    assert carried(np.array([np.eye(4)] * 3)).holds


# Cameras that nobody has placed.


def test_pictures_of_unplaced_cameras_wait_for_a_calibration(recorded: Path, tmp_path: Path) -> None:
    pytest.importorskip("rosbags")
    from test_recordings import RosBag, write_bag

    class Unplaced(RosBag):  # type: ignore[misc]
        def transform(self, topic: str, stamp: int, log: int, parent: str, child: str, pose: Any) -> None:
            if child != "wrist_optical":
                super().transform(topic, stamp, log, parent, child, pose)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("test_recordings.RosBag", Unplaced)
        bag = write_bag(tmp_path / "bag")
    out, told = tmp_path / "out", []
    options = ["--out", str(out), "--frame-hz", "10", "--map", "depth=none"]
    convert(["rosbag2", str(bag), *options, "--into", str(tmp_path / "real.db")], tell=told.append)
    assert any("camera wrist: no transform says where wrist_optical is" in line for line in told)
    assert any(f"calibrate extrinsics {out} --camera wrist --apply" in line and "--cameras" in line for line in told)
    (episode,) = stampede.Catalogue(tmp_path / "real.db").episodes()
    assert set(episode.stored_pictures) == {"front_rgb"}
    assert all(is_png(file) for file in png_files(episode, "front"))  # stored as JPEG: exports of PNG pack them
    recording = Recording(out)
    assert recording.cameras() == ["front", "wrist"] and len(recording.pictures("wrist").files) == 2
    entry = {**(recording.lens_entry("wrist") or {}), "mount": "robot.hand", "mount_from_camera": np.eye(4).tolist()}
    report = {"camera_file": [entry], "cameras": [{"camera": "wrist", "clock": {"offset_s": 0.0}}]}
    apply(recording, None, report, with_joints=False)  # type: ignore[arg-type]
    assert not Recording(out).unplaced()
    command = [PROGRAM, "import", "recording", out, "--out", tmp_path / "placed.db"]
    subprocess.run(command, check=True, capture_output=True)
    (episode,) = stampede.Catalogue(tmp_path / "placed.db").episodes()
    assert set(episode.stored_pictures) == {"front_rgb", "wrist_rgb"}


# Exports of real episodes.


@pytest.mark.parametrize("form", STEPS)
@pytest.mark.parametrize("without", [(), ("command",)])
def test_real_episodes_are_exported(recorded: Path, tmp_path: Path, form: str, without: tuple[str, ...]) -> None:
    pytest.importorskip("pyarrow" if form == "lerobot" else "numpy" if form == "rlds" else "h5py")
    catalogue = imported(recorded, without)
    (episode,) = stampede.Catalogue(catalogue).episodes()
    assert episode.seed is None and episode.variation is None and split_of(episode, 0.5) in ("train", "valid")
    out = written(form, catalogue, tmp_path / form)
    # Without commands the arm's next joints are what it was to do.
    wanted = episode.arrays("action")["action/joint_position"][:-1]
    if form == "lerobot":
        from pyarrow import parquet

        table = parquet.read_table(out / "data/chunk-000/file-000.parquet")
        assert "observation.environment_state" not in table.column_names
        assert np.allclose(np.array(table["action"].to_pylist())[:, :7], wanted, atol=1e-6)
    elif form == "rlds":
        assert next(out.rglob("*.tfrecord-*")).stat().st_size > 10_000
    else:
        import h5py

        with h5py.File(next(file for file in out.rglob("*") if file.suffix in (".h5", ".hdf5"))) as file:
            numbers: list[Any] = []
            file.visititems(lambda _, one: numbers.append(one) if isinstance(one, h5py.Dataset) else None)
            assert all(np.isfinite(one[()]).all() for one in numbers if one.dtype.kind == "f")
            if form in ("robomimic", "mimicgen"):
                assert np.allclose(file["data/demo_0/action_dict/joint_position"][()], wanted)


def test_channels_without_components_are_refused(recorded: Path, tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    arguments = ["lerobot", str(imported(recorded, ())), "--out", str(tmp_path), "--channels", "object_joint_positions"]
    with pytest.raises(stampede.Error, match="channel 'object_joint_positions' has no component"):
        export(arguments, tell=lambda line: None)


def test_camera_files_that_lack_a_camera(demos: Path, recorded: Path, tmp_path: Path) -> None:
    pytest.importorskip("h5py")
    source = next(written("robomimic", demos, tmp_path / "export").glob("*.hdf5"))
    file = tmp_path / "front.json"
    known = json.loads((recorded / "cameras.json").read_text())["cameras"]
    file.write_text(json.dumps({"cameras": [one for one in known if one["name"] == "front"]}))
    told: list[str] = []
    arguments = ["robomimic", str(source), "--out", str(tmp_path / "out"), "--cameras", str(file)]
    convert([*arguments, "--into", str(tmp_path / "real.db")], tell=told.append)
    assert any("camera wrist: it is not in" in line and "left out" in line for line in told)
    (episode,) = stampede.Catalogue(tmp_path / "real.db").episodes()
    assert set(episode.stored_pictures) == {"front_rgb"}
    file.write_text("{")
    arguments[3] = str(tmp_path / "other")
    with pytest.raises(stampede.Error, match="no camera file"):
        convert(arguments, tell=told.append)
    assert not list(tmp_path.glob("other*"))


@pytest.mark.parametrize("form", STEPS)
def test_steps_without_a_gripper_are_refused(recorded: Path, tmp_path: Path, form: str) -> None:
    pytest.importorskip("pyarrow" if form == "lerobot" else "numpy" if form == "rlds" else "h5py")
    with pytest.raises(stampede.Error, match="without any opening of the gripper") as caught:
        written(form, imported(recorded, ("gripper", "command")), tmp_path / form)
    assert caught.value.where == "episode 1" and "stream `gripper`" in caught.value.hint


def test_bags_take_what_there_is_and_rlbench_nothing(recorded: Path, tmp_path: Path) -> None:
    pytest.importorskip("mcap")
    catalogue = imported(recorded, ("gripper", "command"))
    assert len(list(written("mcap", catalogue, tmp_path / "mcap").glob("*.mcap"))) == 1
    pytest.importorskip("PIL")
    with pytest.raises(stampede.Error, match="recording of a real robot") as caught:
        written("rlbench", catalogue, tmp_path / "rlbench")
    assert "source <> 'real'" in caught.value.hint
