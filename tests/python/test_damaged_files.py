"""Damaged files of every form that is read: an Error with place and cure, or what could be read; nothing by halves."""

from __future__ import annotations

import json
import os
import random
import shutil
import signal
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

stampede = pytest.importorskip("stampede")
for needed in ("rosbags", "mcap", "h5py", "pyarrow", "av", "PIL"):
    pytest.importorskip(needed)

from damage import cases, damaged  # noqa: E402
from test_recordings_joints import ARM, HOME, START, write_ros_1  # noqa: E402

from stampede import torque_noise  # noqa: E402
from stampede.export import export  # noqa: E402
from stampede.recordings import convert  # noqa: E402
from stampede.rlbench.observation_config import ObservationConfig  # noqa: E402
from stampede.rlbench.utils import stored_demos  # noqa: E402

sys.path.insert(0, str(Path(__file__).parents[1] / "bench" / "python"))
from ros_bag import RosBag  # noqa: E402

PATIENCE_S = 60


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A small dataset of each form."""
    root = tmp_path_factory.mktemp("whole")
    size = {"width": 16, "height": 12, "mask": True, "semantic_mask": False}
    session = stampede.Session(catalogue=root / "demos.db")
    session.run_all(["reach_target"], episodes=1, seed=7, pictures={"cameras": ["front"], "depth": True, **size})
    for form in ("mcap", "lerobot", "robomimic", "rlbench"):
        export([form, str(root / "demos.db"), "--out", str(root / form)], tell=lambda line: None)
    for form in ("mcap", "db3"):
        with RosBag(root / f"ros_{form}", form) as bag:
            for k in range(20):
                bag.joint_state("/joint_states", START + k * 10**7, START + k * 10**7, ARM, HOME)
    write_ros_1(root / "plain.bag", "")
    write_ros_1(root / "packed.bag", "LZ4")
    source = next((root / "robomimic").glob("*.hdf5"))
    convert(["robomimic", str(source), "--out", str(root / "folder")], tell=lambda line: None)
    (root / "cameras.json").write_text(json.dumps({"cameras": [{"name": "front", "width": 16, "height": 12}]}))
    (root / "robot.json").write_text(json.dumps({"name": "panda"}))
    return root


def converted(form: str, *options: str) -> Callable[[Path, Path], None]:
    return lambda source, out: void(convert([form, str(source), "--out", str(out / "o"), *options], lambda line: None))


def void(*_: object) -> None: ...


def with_file(option: str) -> Callable[[Path, Path], None]:
    """The file is what an option names."""

    def read(file: Path, out: Path) -> None:
        source = file.parent / "ros_mcap"
        convert(["rosbag2", str(source), "--out", str(out / "o"), option, str(file)], lambda line: None)

    return read


def demos_of(root: Path, out: Path) -> None:
    variation = next((root / "reach_target").iterdir()).name.removeprefix("variation")
    config = ObservationConfig()
    config.set_all_high_dim(False)
    config.front_camera.set_all(True)
    stored_demos(root, "reach_target", int(variation), [], config, 1, False, False, 0)


def fitted(folder: Path, out: Path) -> None:
    torque_noise.main([str(folder), "--out", str(out / "t.json")])


# What is read, which of its files are damaged, and how it is read.
FORMS: dict[str, tuple[str, str, Callable[[Path, Path], None]]] = {
    "Foxglove's MCAP": ("mcap/*.mcap", "", converted("mcap")),
    "ROS 2's MCAP": ("ros_mcap/*.mcap", "", converted("mcap")),
    "MCAP that is cut off": ("ros_mcap/*.mcap", "", converted("mcap", "--truncated")),
    "ROS 2's SQLite": ("ros_db3/*.db3", "", converted("rosbag2")),
    "a folder of ROS 2": ("ros_db3", "metadata.yaml", converted("rosbag2")),
    "ROS 1's bag": ("plain.bag", "", converted("rosbag1")),
    "ROS 1's packed bag": ("packed.bag", "", converted("rosbag1")),
    "robomimic's HDF5": ("robomimic/*.hdf5", "", converted("robomimic")),
    "LeRobot's tables": ("lerobot", "*.parquet", converted("lerobot")),
    "LeRobot's films": ("lerobot", "*.mp4", converted("lerobot")),
    "LeRobot's info": ("lerobot", "*.json", converted("lerobot")),
    "RLBench's pickles": ("rlbench", "*.pkl", demos_of),
    "RLBench's pictures": ("rlbench", "*.png", demos_of),
    "a camera file": ("cameras.json", "", with_file("--cameras")),
    "a robot": ("robot.json", "", with_file("--robot")),
    "a recording folder": ("folder", "*.json", fitted),
    "a recording's joints": ("folder", "*.csv", fitted),
}


@contextmanager
def patience(what: str) -> Iterator[None]:
    def over(*_: object) -> None:
        raise TimeoutError(what)

    signal.signal(signal.SIGALRM, over)
    signal.alarm(PATIENCE_S)
    try:
        yield
    finally:
        signal.alarm(0)


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("form", FORMS)
def test_what_is_damaged_is_an_error_with_place_and_cure(form: str, made: Path, tmp_path: Path) -> None:
    pattern, files, read = FORMS[form]
    whole = next(made.glob(pattern))
    draw = random.Random(form)
    refused = 0
    count = cases(25)
    copies = tmp_path / "in"
    for case in range(count):
        shutil.rmtree(copies, ignore_errors=True)
        copies.mkdir()
        if with_file_beside := not files and whole.suffix == ".json":
            shutil.copytree(made / "ros_mcap", copies / "ros_mcap")
        source = copies / whole.name
        (shutil.copytree if whole.is_dir() else shutil.copy)(whole, source)
        victim = draw.choice(sorted(source.rglob(files))) if files else source
        victim.write_bytes(damaged(victim.read_bytes(), draw, 600 if with_file_beside else 4096))
        out = tmp_path / "out"
        out.mkdir()
        try:
            with patience(f"{form}, case {case}"), warnings.catch_warnings():
                read(source, out)
        except stampede.Error as error:
            refused += 1
            text = str(error)
            assert ": " in text and "\n    " in text, f"{form}, case {case}: no place or no cure: {text}"
            assert not list(out.iterdir()), f"{form}, case {case}: something half written is left"
        shutil.rmtree(out)
    assert refused > 0, "nothing was damaged"


# Files of a form that are a pipe which nobody writes to: readers must not wait for it.
PIPES = {
    "an MCAP file": ("ros_mcap/*.mcap", "", converted("mcap")),
    "a bag": ("ros_mcap/*.mcap", "", converted("rosbag2")),
    "a bag of ROS 1": ("plain.bag", "", converted("rosbag1")),
    "a bag's MCAP": ("ros_mcap", "*.mcap", converted("rosbag2")),
    "a bag's SQLite": ("ros_db3", "*.db3", converted("rosbag2")),
    "a bag's metadata": ("ros_db3", "metadata.yaml", converted("rosbag2")),
    "robomimic's HDF5": ("robomimic/*.hdf5", "", converted("robomimic")),
    "LeRobot's info": ("lerobot", "info.json", converted("lerobot")),
    "LeRobot's tables": ("lerobot", "tasks.parquet", converted("lerobot")),
    "LeRobot's films": ("lerobot", "*.mp4", converted("lerobot")),
    "RLBench's pickles": ("rlbench", "low_dim_obs.pkl", demos_of),
    "RLBench's pictures": ("rlbench", "0.png", demos_of),
    "a recording": ("folder", "recording.json", fitted),
    "a recording's joints": ("folder", "joints.csv", fitted),
}


@pytest.mark.parametrize("form", PIPES)
def test_a_pipe_is_no_file(form: str, made: Path, tmp_path: Path) -> None:
    pattern, files, read = PIPES[form]
    whole = next(made.glob(pattern))
    source = tmp_path / whole.name
    (shutil.copytree if whole.is_dir() else shutil.copy)(whole, source)
    pipe = next(source.rglob(files)) if files else source
    pipe.unlink()
    os.mkfifo(pipe)
    (tmp_path / "out").mkdir()
    with pytest.raises(stampede.Error, match="it is no file|is missing") as caught, patience(form):
        read(source, tmp_path / "out")
    assert str(pipe) in str(caught.value)
    assert not list((tmp_path / "out").iterdir())


@pytest.mark.parametrize("option", ["--cameras", "--robot"])
def test_a_pipe_is_no_option(option: str, made: Path, tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.json"
    os.mkfifo(pipe)
    command = ["rosbag2", str(made / "ros_mcap"), "--out", str(tmp_path / "o"), option, str(pipe)]
    with pytest.raises(stampede.Error, match="pipe.json: (it is no file|there is no such)"), patience(option):
        convert(command, lambda line: None)


def test_a_dataset_names_no_file_of_others(made: Path, tmp_path: Path) -> None:
    shutil.copytree(made / "lerobot", tmp_path / "given")
    info = tmp_path / "given" / "meta" / "info.json"
    whole = info.read_text()
    for kind in ("data_path", "video_path"):
        for name in ("../secret.parquet", "/secret.mp4"):
            info.write_text(json.dumps({**json.loads(whole), kind: name}))
            with pytest.raises(stampede.Error, match=f"its {kind} leads out of the dataset: {name}"):
                converted("lerobot")(tmp_path / "given", tmp_path)
    info.write_text(whole)
    film = next((tmp_path / "given").rglob("*.mp4"))
    film.rename(tmp_path / "secret.mp4")
    film.write_text(f"ffconcat version 1.0\nfile {tmp_path / 'secret.mp4'}\n")
    with pytest.raises(stampede.Error, match="the film ends early or is damaged"):
        converted("lerobot")(tmp_path / "given", tmp_path)


def test_interrupts_and_what_is_missing_pass() -> None:
    from stampede.faults import reading

    for kind in (KeyboardInterrupt, SystemExit, ImportError, NameError):
        with pytest.raises(kind), reading("here"):
            raise kind
    for error in (MemoryError(), AssertionError(), RecursionError(), UnicodeDecodeError("utf8", b"", 0, 1, "x")):
        match = r"here: it ends early or is damaged \(\w+.*\)\n    copy it"
        with pytest.raises(stampede.Error, match=match), reading("here"):
            raise error
    told = stampede.Error("a: b")
    with pytest.raises(stampede.Error) as caught, reading("here"):
        raise told
    assert caught.value is told
