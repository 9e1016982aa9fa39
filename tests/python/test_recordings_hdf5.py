"""HDF5 files of others: nothing of other files comes in, demos have any name, and what is wrong is told by its key."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

stampede = pytest.importorskip("stampede")
h5py = pytest.importorskip("h5py")
pytest.importorskip("pinocchio")

from stampede.recordings import convert  # noqa: E402

HOME = np.array([0, -0.78, 0, -2.35, 0, 1.57, 0.78])
STEPS = 4
PIXELS = np.arange(STEPS * 2 * 3 * 3, dtype=np.uint8).reshape(STEPS, 2, 3, 3)
POSITIONS = "obs/robot0_joint_pos"


def run(source: Path, *options: str) -> list[Path]:
    out = source.with_name("out")
    return convert(["robomimic", str(source), "--out", str(out), *options], tell=lambda line: None)


def write(folder: Path, names: tuple[str, ...] = ("demo_0",)) -> Path:
    source = folder / "given.hdf5"
    with h5py.File(source, "w") as file:
        file.create_group("data").attrs["env_args"] = json.dumps({"env_kwargs": {"control_freq": 20}})
        for number, name in enumerate(names):
            demo = file.create_group(f"data/{name}")
            demo[POSITIONS] = HOME + 0.01 * number + 0.001 * np.arange(STEPS)[:, None]
            demo["obs/front_image"] = PIXELS
    return source


def refused(source: Path) -> stampede.Error:
    with pytest.raises(stampede.Error) as caught:
        run(source)
    assert caught.value.hint and "damaged" not in caught.value.message
    assert not source.with_name("out").exists()
    return caught.value


def secret(folder: Path) -> Path:
    """A file that whoever made the recording does not have."""
    file = folder / "secret.hdf5"
    with h5py.File(file, "w") as other:
        other["pixels"], other["positions"] = PIXELS, HOME + np.zeros((STEPS, 1))
        other["demo/obs/robot0_joint_pos"] = HOME + np.zeros((STEPS, 1))
    return file


def of_raw_bytes(demo: Any, other: Path) -> None:
    del demo["obs/front_image"]
    demo.create_dataset("obs/front_image", PIXELS.shape, "u1", external=[(str(other), 0, PIXELS.size)])


def of_a_virtual_dataset(demo: Any, other: Path) -> None:
    del demo["obs/front_image"]
    layout = h5py.VirtualLayout(PIXELS.shape, "u1")
    layout[:] = h5py.VirtualSource(str(other), "pixels", PIXELS.shape)
    demo.create_virtual_dataset("obs/front_image", layout)


def of_a_link(demo: Any, other: Path) -> None:
    del demo[POSITIONS]
    demo[POSITIONS] = h5py.ExternalLink(str(other), "positions")


def of_a_link_behind_a_link(demo: Any, other: Path) -> None:
    del demo[POSITIONS]
    demo.file["elsewhere"] = h5py.ExternalLink(str(other), "/")
    demo[POSITIONS] = h5py.SoftLink("/elsewhere/positions")


@pytest.mark.parametrize(
    ("bring_in", "where", "what"),
    [
        (of_raw_bytes, "data/demo_0/obs/front_image", "its data lie in another file"),
        (of_a_virtual_dataset, "data/demo_0/obs/front_image", "it is virtual"),
        (of_a_link, f"data/demo_0/{POSITIONS}", "it is a link to another file"),
        (of_a_link_behind_a_link, "elsewhere", "it is a link to another file"),
    ],
)
def test_nothing_of_another_file_comes_in(
    tmp_path: Path, bring_in: Callable[[Any, Path], None], where: str, what: str
) -> None:
    source = write(tmp_path)
    with h5py.File(source, "a") as file:
        bring_in(file["data/demo_0"], secret(tmp_path))
    error = refused(source)
    assert error.where == f"{source}, {where}" and what in error.message


def test_links_within_the_file_are_followed(tmp_path: Path) -> None:
    source = write(tmp_path)
    with h5py.File(source, "a") as file:
        file["shared"] = file[f"data/demo_0/{POSITIONS}"]
        del file[f"data/demo_0/{POSITIONS}"]
        file[f"data/demo_0/{POSITIONS}"] = h5py.SoftLink("/shared")
    (out,) = run(source)
    assert len((out / "joints.csv").read_text().splitlines()) == STEPS + 1


def test_a_droid_file_brings_in_nothing_either(tmp_path: Path) -> None:
    source = tmp_path / "trajectory.h5"
    with h5py.File(source, "w") as file:
        file["observation/robot_state/joint_positions"] = h5py.ExternalLink(str(secret(tmp_path)), "positions")
    assert "it is a link to another file" in refused(source).message


def test_demos_of_any_name_come_in_natural_order(tmp_path: Path) -> None:
    names = ("demo_10", "demo_9", "demo1", "traj_a1", "demo_²", "x", "demo_" + "9" * 5000)
    folders = run(write(tmp_path, names))
    sources = [json.loads((one / "recording.json").read_text())["source"] for one in folders]
    order = ["demo1", "demo_9", "demo_10", "demo_" + "9" * 5000, "demo_²", "traj_a1", "x"]
    assert [one.rpartition(", ")[2] for one in sources] == order


def set_attribute(name: str, value: Any, of: str = "data") -> Callable[[Any], None]:
    return lambda file: file[of].attrs.__setitem__(name, value)


def put(key: str, values: Any) -> Callable[[Any], None]:
    def replace(file: Any) -> None:
        if key in file["data/demo_0"]:
            del file["data/demo_0"][key]
        file["data/demo_0"][key] = values

    return replace


DEMO = "data/demo_0"
FLAT = "obs/robot0_gripper_qpos"


@pytest.mark.parametrize(
    ("change", "key", "what"),
    [
        (set_attribute("env_args", "[1]"), "attribute env_args", "it is JSON, but no object"),
        (set_attribute("env_args", "{"), "attribute env_args", "it is no JSON"),
        (set_attribute("env_args", 5), "attribute env_args", "it is no JSON"),
        (set_attribute("env_args", "null"), "demo_0", "it does not say how many steps a second"),
        (set_attribute("env_args", '{"env_kwargs": null}'), "demo_0", "it does not say how many steps a second"),
        (set_attribute("env_args", '{"env_kwargs": {"control_freq": [20]}}'), "demo_0", "[20] is no number of steps"),
        (set_attribute("env_args", '{"env_kwargs": {"control_freq": -1}}'), "demo_0", "-1 is no number of steps"),
        (set_attribute("ep_meta", "[1]", DEMO), "attribute ep_meta", "it is JSON, but no object"),
        (set_attribute("ep_meta", '{"segments": [{}]}', DEMO), "attribute ep_meta", "its segments are not as"),
        (set_attribute("ep_meta", '{"lang": 5}', DEMO), "attribute ep_meta", "5 is no sentence"),
        (set_attribute("ep_meta", '{"success": "so so"}', DEMO), "ep_meta, success", "says neither yes nor no"),
        (set_attribute("problem_info", "[1]"), "attribute problem_info", "it is JSON, but no object"),
        (put("obs/robot0_joint_vel", np.zeros((3, 7))), "robot0_joint_vel", "it has 3 rows, and there are 4 steps"),
        (put("obs/robot0_joint_vel", np.zeros((4, 6))), "robot0_joint_vel", "7 numbers are expected"),
        (put("obs/robot0_joint_torques", 1.0), "robot0_joint_torques", "it has 1 rows, and there are 4 steps"),
        (put(POSITIONS, np.full((4, 7), b"x")), "robot0_joint_pos", "it is no array of numbers"),
        (put(FLAT, np.zeros((3, 2))), "robot0_gripper_qpos", "it has 3 rows, and there are 4 steps"),
        (put("obs/front_image", PIXELS[:2]), "front_image", "it has 2 pictures, and there are 4 steps"),
        (put("obs/front_depth", np.zeros((2, 2, 3))), "front_depth", "it has 2 pictures, and there are 4 steps"),
        (put("obs/front_depth", np.zeros(4)), "front_depth", "are not read"),
    ],
)
def test_what_does_not_fit_is_told_by_its_key(
    tmp_path: Path, change: Callable[[Any], None], key: str, what: str
) -> None:
    source = write(tmp_path)
    with h5py.File(source, "a") as file:
        change(file)
    error = refused(source)
    assert key in error.where and what in error.message


def test_a_hand_of_one_number_and_depths_of_three_axes(tmp_path: Path) -> None:
    source = write(tmp_path)
    with h5py.File(source, "a") as file:
        put(FLAT, np.full(STEPS, 0.04))(file)
        put("obs/front_depth", np.full((STEPS, 2, 3), 1.5))(file)
    (out,) = run(source)
    assert (out / "gripper.csv").read_text().splitlines()[1] == "0.000000000,0.04"
    image = pytest.importorskip("PIL.Image")
    assert (np.asarray(image.open(next((out / "front_depth").iterdir()))) == 1500).all()


@pytest.mark.parametrize(
    ("said", "outcome"),
    [(True, "success"), (False, "failure"), ("False", "failure"), ("true", "success"), (np.array([0]), "failure")],
)
def test_what_droid_says_of_success(tmp_path: Path, said: Any, outcome: str) -> None:
    source = tmp_path / "trajectory.h5"
    with h5py.File(source, "w") as file:
        file["observation/robot_state/joint_positions"] = HOME + np.zeros((STEPS, 1))
        file.attrs["success"] = said
    (out,) = run(source)
    assert json.loads((out / "recording.json").read_text())["outcome"] == outcome


@pytest.mark.parametrize(
    ("said", "outcome"), [(False, "failure"), (0, "failure"), ("false", "failure"), (1, "success")]
)
def test_what_robomimic_says_of_success(tmp_path: Path, said: Any, outcome: str) -> None:
    source = write(tmp_path)
    with h5py.File(source, "a") as file:
        file[DEMO].attrs["ep_meta"] = json.dumps({"success": said})
    (out,) = run(source)
    assert json.loads((out / "recording.json").read_text())["outcome"] == outcome


def test_what_droid_cannot_say(tmp_path: Path) -> None:
    source = tmp_path / "trajectory.h5"
    for name, value, what in (
        ("success", "perhaps", "'perhaps' says neither yes nor no"),
        ("success", [1, 0], "it is no number and no text"),
        ("current_task", 5, "5 is no sentence"),
    ):
        with h5py.File(source, "w") as file:
            file["observation/robot_state/joint_positions"] = HOME + np.zeros((STEPS, 1))
            file.attrs[name] = value
        error = refused(source)
        assert f"attribute {name}" in error.where and what in error.message
    with h5py.File(source, "w") as file:
        state = file.create_group("observation/robot_state")
        state["joint_positions"], state["joint_velocities"] = HOME + np.zeros((STEPS, 1)), np.zeros((STEPS, 6))
    assert "joint_velocities" in refused(source).where
