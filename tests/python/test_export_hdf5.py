"""Exports to HDF5, read back with h5py; what is left of an export that was killed."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import stampede
from stampede.export import export, robomimic
from stampede.export.libero import _file_names
from stampede.export.steps import Steps

h5py = pytest.importorskip("h5py")

LIFTS = "task = 'pick_and_lift' AND episode <= 2"


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Episodes 1 and 2 lift with pictures, 3 lifts without, 4 fills a drawer, 5 is of the test split."""
    path = tmp_path_factory.mktemp("hdf5") / "demos.db"
    session = stampede.Session(catalogue=path)
    pictures = {"cameras": ["front", "wrist"], "width": 32, "height": 24, "depth": False, "mask": False}
    pictures["semantic_mask"] = False
    session.run_all(["pick_and_lift"], episodes=2, seed=7, pictures=pictures)
    session.run_all(["pick_and_lift"], episodes=1, seed=9)
    session.run_all(["put_item_in_drawer"], episodes=1, seed=1)
    session.run_all(["reach_target"], episodes=1, seed=1_000_000)
    assert len(stampede.Catalogue(path).demos()) == 5
    return path


def run(made: Path, folder: Path, name: str, *options: str) -> Path:
    export([name, str(made), "--out", str(folder), *options], tell=lambda line: None)
    assert not [path for path in folder.rglob("*") if path.suffix == ".part" or path.name.startswith(".")]
    return folder


def listing(path: Path) -> dict[str, Any]:
    """All that is in a file: attributes and values by place."""
    found: dict[str, Any] = {}

    def note(name: str, one: Any) -> None:
        found[name] = one[()].tobytes() if isinstance(one, h5py.Dataset) else None
        found.update({f"{name}@{key}": np.asarray(value).tolist() for key, value in one.attrs.items()})

    with h5py.File(path) as file:
        file.visititems(note)
    return found


def test_robomimic(made: Path, tmp_path: Path) -> None:
    folder = run(made, tmp_path / "out", "robomimic", "--where", "episode <= 2", "--valid", "0.5", "--next-obs")
    assert [path.name for path in folder.iterdir()] == ["pick_and_lift.hdf5"]
    episode = stampede.Catalogue(made)[1]
    with h5py.File(folder / "pick_and_lift.hdf5") as file:
        data = file["data"]
        assert sorted(data) == ["demo_0", "demo_1"]
        assert data.attrs["total"] == sum(demo.attrs["num_samples"] for demo in data.values())
        environment = json.loads(data.attrs["env_args"])
        assert environment["env_name"] == "stampede/pick_and_lift"
        assert environment["type"] == environment["env_type"] == 2
        demo = data["demo_0"]
        n = demo.attrs["num_samples"]
        assert n == episode.frames - 1 and set(demo.attrs) == {"num_samples", "ep_meta"}
        assert demo["actions"].shape == (n, 8) and demo["actions"].dtype == np.float32
        assert {len(data.attrs[f"action_{what}"]) for what in ("names", "lower", "upper")} == {8}
        assert demo["states"].shape == (n, len(data.attrs["state_names"]))
        assert demo["obs/front_image"].shape == (n, 24, 32, 3)
        assert np.array_equal(demo["obs/front_image"][5], episode.pictures("front_rgb", [5])[0])
        assert np.array_equal(demo["next_obs/front_image"][5], episode.pictures("front_rgb", [6])[0])
        assert np.array_equal(demo["obs/robot0_eef_pos"][:], episode.arrays("gripper_pose")["gripper_pose"][:-1, :3])
        assert demo["rewards"][-1] == demo["dones"][-1] == 1 and demo["dones"][:-1].sum() == 0
        meta = json.loads(demo.attrs["ep_meta"])
        assert meta["seed"] == episode.seed and [s["skill"] for s in meta["segments"]] == ["pick", "lift"]
        assert len(meta["key"]) == 32 and meta["episode"] == 1
        masks = {name: {text.decode() for text in rows[:]} for name, rows in file["mask"].items()}
        assert set().union(*masks.values()) == set(data) and sum(len(names) for names in masks.values()) == 2
    folder = run(made, tmp_path / "test", "robomimic", "--where", "episode = 5")
    with h5py.File(folder / "reach_target.hdf5") as file:
        assert list(file["mask"]) == ["test"]


def test_parts_of_robomimics_actions_are_the_same_motion(made: Path, tmp_path: Path) -> None:
    folder = run(made, tmp_path / "out", "robomimic", "--where", "episode = 3")
    arrays = stampede.Catalogue(made)[3].arrays()
    with h5py.File(folder / "pick_and_lift.hdf5") as file:
        demo = file["data/demo_0"]
        parts = {name: part[:] for name, part in demo["action_dict"].items()}
        scale = file["data"].attrs
        lower, upper = scale["action_lower"], scale["action_upper"]
        natural = lower + (demo["actions"][:] + 1) / 2 * (upper - lower)
        assert np.allclose(natural[:, :7], parts["joint_position"], atol=1e-6)
        assert np.array_equal(demo["actions_abs"][:, :7], parts["joint_position"])
        assert np.allclose(demo["actions"][:, 7:], parts["gripper"])
    assert np.array_equal(parts["joint_position"], arrays["action/joint_position"][:-1])
    assert np.array_equal(parts["abs_pos"], arrays["action/tool_pose"][:-1, :3])
    assert np.allclose(arrays["gripper_pose"][0, :3] + parts["rel_pos"].cumsum(axis=0), parts["abs_pos"])
    # The pose that was commanded is reached a few frames later, so its matrix is near the measured one.
    rows = arrays["gripper_matrix"][1:, :2, :3].reshape(-1, 6)
    assert np.abs(parts["abs_rot_6d"] - rows).mean() < 0.02
    angle = np.linalg.norm(parts["abs_rot_axis_angle"], axis=1)
    trace = 1 + 2 * np.cos(angle)
    assert np.allclose(trace[-1], np.trace(arrays["gripper_matrix"][-1, :3, :3]), atol=0.02)


def edges_to_spans(signals: list[np.ndarray], count: int) -> list[tuple[int, int]]:
    """Spans of subtasks as MimicGen's documentation has them: a subtask ends with the step whose signal is first 1."""
    ends = [int(np.flatnonzero(np.diff(signal) == 1)[0]) + 2 for signal in signals] + [count]
    return list(zip([0, *ends[:-1]], ends, strict=True))


def test_mimicgens_subtasks_are_our_skills(made: Path, tmp_path: Path) -> None:
    folder = run(made, tmp_path / "out", "mimicgen", "--cameras", "", "--where", "episode = 4")
    steps = Steps(stampede.Catalogue(made)[4])
    with h5py.File(folder / "put_item_in_drawer.hdf5") as file:
        (spec,) = json.loads(file["data"].attrs["task_spec"])
        assert [name.decode() for name in file[f"mask/{spec['filter_key']}"]] == ["demo_0"]
        assert list(spec["subtasks"]) == ["subtask_1", "subtask_2", "subtask_3"]
        subtasks = list(spec["subtasks"].values())
        names = [one["subtask_term_signal"] for one in subtasks]
        assert names == ["open_1", "pick_1", None]
        # What is put in is in the hand; where it goes is what the motion depends on.
        drawer = steps.skills[0].arguments[0]
        assert [one["object_ref"] for one in subtasks] == [drawer, "item", drawer]
        info = file["data/demo_0/datagen_info"]
        spans = edges_to_spans([info[f"subtask_term_signals/{name}"][:] for name in names[:-1]], steps.count)
        assert [end for _, end in spans[:-1]] == [skill.end_frame for skill in steps.skills[:-1]]
        assert info["eef_pose"].shape == info["target_pose"].shape == (steps.count, 4, 4)
        assert info["gripper_action"].shape == (steps.count, 1)
        for name in (drawer, "item"):
            place = steps.episode.arrays(f"object_pose/{name}")[f"object_pose/{name}"][:-1, :3]
            assert np.allclose(info[f"object_poses/{name}"][:, :3, 3], place)


def test_mimicgens_task_specs_say_which_demos_they_fit(made: Path, tmp_path: Path) -> None:
    folder = run(made, tmp_path / "out", "mimicgen", "--cameras", "", "--where", "task = 'pick_and_lift'")
    demos = stampede.Catalogue(made).demos("task = 'pick_and_lift'")
    with h5py.File(folder / "pick_and_lift.hdf5") as file:
        specs = json.loads(file["data"].attrs["task_spec"])
        fitting = {spec["variation"]: [n.decode() for n in file[f"mask/{spec['filter_key']}"]] for spec in specs}
    expected: dict[str, list[str]] = {}
    for number, episode in enumerate(demos):
        expected.setdefault(episode.variation, []).append(f"demo_{number}")
    assert fitting == expected


def test_libero(made: Path, tmp_path: Path) -> None:
    folder = run(made, tmp_path / "out", "libero", "--where", LIFTS)
    files = sorted(folder.iterdir())
    assert len(files) == 2 and all(path.name.endswith("_demo.hdf5") for path in files)
    with h5py.File(files[0]) as file:
        data = file["data"]
        problem = json.loads(data.attrs["problem_info"])
        assert problem["language_instruction"] and data.attrs["num_demos"] == 1
        demo = data["demo_0"]
        n = demo.attrs["num_samples"]
        shapes = {"agentview_rgb": (24, 32, 3), "eye_in_hand_rgb": (24, 32, 3), "gripper_states": (2,), "ee_pos": (3,)}
        shapes |= {"joint_states": (7,), "ee_states": (6,), "ee_ori": (3,)}
        assert {name: one.shape for name, one in demo["obs"].items()} == {k: (n, *s) for k, s in shapes.items()}
        assert demo["robot_states"].shape == (n, 9) and demo["dones"].dtype == np.uint8
        assert demo["dones"][:].sum() == demo["dones"][-1] == 1
        # LIBERO has no word for a thing in the hand.
        assert data.attrs["bddl_file_content"] == "" and "holding" in data.attrs["bddl_refusal"]


def test_liberos_files_have_the_problem_in_its_dialect(made: Path, tmp_path: Path) -> None:
    folder = run(made, tmp_path / "out", "libero", "--where", "episode = 4")
    (path,) = folder.iterdir()
    with h5py.File(path) as file:
        attributes = file["data"].attrs
        assert attributes["bddl_file_content"].lstrip(" ;").find("(define (problem") >= 0
        assert attributes["bddl_file_name"].endswith(".bddl") and "bddl_refusal" not in attributes


def test_variations_that_differ_in_signs_only_have_files_of_their_own(made: Path) -> None:
    class Of:
        def __init__(self, variation: str) -> None:
            self.task, self.variation = "reach", variation

    episodes: list[Any] = [Of(text) for text in ("x=0.1", "x=-0.1", "x=0.1", "x=.1", "")]
    names = _file_names(episodes)
    assert names[0] == names[2] == "reach_x_0_1_demo.hdf5" and names[4] == "reach_demo.hdf5"
    assert len(set(names)) == 4


def test_maniskill(made: Path, tmp_path: Path) -> None:
    folder = run(made, tmp_path / "out", "maniskill", "--where", f"({LIFTS}) OR episode = 5")
    assert (folder / "reach_target" / "trajectory.state_dict.pd_joint_pos.bullet_cpu.h5").exists()
    path = folder / "pick_and_lift" / "trajectory.rgb.pd_joint_pos.bullet_cpu.h5"
    described = json.loads(path.with_suffix(".json").read_text())
    assert [one["episode_id"] for one in described["episodes"]] == [0, 1]
    assert described["env_info"]["env_id"] == "stampede/pick_and_lift"
    episode = stampede.Catalogue(made)[1]
    with h5py.File(path) as file:
        assert sorted(file) == ["traj_0", "traj_1"]
        one = file["traj_0"]
        frames = episode.frames
        assert one["actions"].shape == (frames - 1, 8) and one["success"][-1] and not one["truncated"][:].any()
        assert one["obs/agent/qpos"].shape == (frames, 9) and one["obs/extra/tcp_pose"].shape == (frames, 7)
        robot = one["env_states/articulations/panda"]
        assert robot.shape == (frames, 31)
        # Where it stands is above the pedestal, upright; its velocity is 0.
        pedestal = next(row for row in episode.table("poses") if row["object"] == "pedestal")
        assert np.allclose(robot[0, :2], [pedestal["x"], pedestal["y"]]) and np.allclose(robot[:, :13], robot[0, :13])
        assert np.allclose(robot[0, 3:13], [1, 0, 0, 0, 0, 0, 0, 0, 0, 0])
        assert np.array_equal(robot[:, 13:20], episode.arrays("joint_positions")["joint_positions"])
        names = described["env_info"]["state_names"]
        assert len(names) == one["obs/extra/task_low_dim_state"].shape[1]
        assert all(actor.shape == (frames, 13) for actor in one["env_states/actors"].values())
        assert np.allclose(one["obs/extra/tcp_pose"][:, 3], episode.arrays("gripper_pose")["gripper_pose"][:, 6])
        assert one["obs/sensor_data/front/rgb"].shape == (frames, 24, 32, 3)
        assert described["episodes"][0]["elapsed_steps"] == frames - 1
        # The front camera sees the hand, whichever way its pose is written.
        camera = one["obs/sensor_param/front"]
        hand = np.append(one["obs/extra/tcp_pose"][-1, :3], 1)
        seen = camera["extrinsic_cv"][-1] @ hand
        column, row = (camera["intrinsic_cv"][-1] @ seen)[:2] / seen[2]
        assert seen[2] > 0 and 0 <= column < 32 and 0 <= row < 24
        opengl = np.linalg.inv(camera["cam2world_gl"][-1]) @ hand
        assert np.allclose(opengl, [seen[0], -seen[1], -seen[2], 1], atol=1e-4)


def test_maniskills_reset_makes_the_start_of_the_episode(made: Path, tmp_path: Path) -> None:
    """Of the test split too, whose seeds are beyond those that `Env.reset(seed=…)` takes."""
    folder = run(made, tmp_path / "out", "maniskill", "--where", "episode = 5")
    path = folder / "reach_target" / "trajectory.state_dict.pd_joint_pos.bullet_cpu.h5"
    described = json.loads(path.with_suffix(".json").read_text())
    env = stampede.Env("reach_target", observations=("joint_positions",))
    observed, _ = env.reset(**described["episodes"][0]["reset_kwargs"])
    with h5py.File(path) as file:
        assert np.allclose(file["traj_0/obs/agent/qpos"][0, :7], observed["joint_positions"], atol=1e-6)


KILLED = """
import os, sys
from stampede.export import export, robomimic
put = robomimic.put_pictures
def die(group, name, pictures):
    if os.path.isdir(sys.argv[-1] + "/.pieces/000001"):
        os._exit(9)
    put(group, name, pictures)
robomimic.put_pictures = die
export(sys.argv[1:], tell=lambda line: None)
"""


def test_an_export_that_was_killed_goes_on_with_what_was_whole(
    made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "out"
    arguments = ["robomimic", str(made), "--where", LIFTS, "--out", str(folder)]
    assert subprocess.run([sys.executable, "-c", KILLED, *arguments], check=False).returncode == 9
    assert sorted(path.name for path in (folder / ".pieces").iterdir()) == ["000001", "000002.partial"]
    (folder / "pick_and_lift.hdf5.part").write_bytes(b"\x89HDF\r\n\x1a\n" + b"cut" * 100)  # killed at the end
    written: list[int] = []
    write = robomimic.Writer.write

    def counted(self: robomimic.Writer, episode: stampede.StoredEpisode) -> None:
        written.append(episode.id)
        write(self, episode)

    monkeypatch.setattr(robomimic.Writer, "write", counted)
    assert export(arguments, tell=lambda line: None) == 2 and written == [2]
    again = run(made, tmp_path / "again", "robomimic", "--where", LIFTS)
    assert [path.name for path in folder.iterdir()] == ["pick_and_lift.hdf5"]
    assert listing(folder / "pick_and_lift.hdf5") == listing(again / "pick_and_lift.hdf5")


def test_a_file_that_was_finished_before_the_catalogue_grew_is_whole(
    made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    catalogue = shutil.copy(made, tmp_path / "demos.db")
    arguments = ["robomimic", str(catalogue), "--out", str(tmp_path / "out"), "--cameras", ""]
    complete = robomimic.Writer.complete

    def cut_off(self: Any, file: Any, name: str, *rest: Any) -> None:
        if name != "pick_and_lift.hdf5":
            raise KeyboardInterrupt
        complete(self, file, name, *rest)

    monkeypatch.setattr(robomimic.Writer, "complete", cut_off)
    with pytest.raises(KeyboardInterrupt):
        export(arguments, tell=lambda line: None)
    assert (tmp_path / "out/pick_and_lift.hdf5").exists()
    monkeypatch.setattr(robomimic.Writer, "complete", complete)
    for task, seed in (("pick_and_lift", 20), ("reach_target", 1_000_020)):
        stampede.Session(catalogue=catalogue).run_all([task], episodes=1, seed=seed)
    assert export(arguments, tell=lambda line: None) == 5
    whole = run(made, tmp_path / "whole", "robomimic", "--cameras", "")
    for path in whole.iterdir():
        assert listing(path) == listing(tmp_path / "out" / path.name)


def test_episodes_that_do_not_fit_into_one_file(made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("robomimic", "mimicgen", "maniskill"):
        with pytest.raises(stampede.Error, match="episode 3: its stored pictures are those of no camera, but of front"):
            export([name, str(made), "--out", str(tmp_path / name), "--where", "task = 'pick_and_lift'"])
    run(made, tmp_path / "none", "robomimic", "--where", "task = 'pick_and_lift'", "--cameras", "")

    bounds = Steps.bounds
    monkeypatch.setattr(Steps, "bounds", lambda self, kind: tuple(b / self.episode.id for b in bounds(self, kind)))
    with pytest.raises(stampede.Error, match="episode 2: its action_lower differ from those of episode 1"):
        export(["robomimic", str(made), "--out", str(tmp_path / "scales"), "--where", LIFTS])
