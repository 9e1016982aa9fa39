"""What we export comes back as recordings; LeRobot's and robomimic's forms, and what is wrong with them."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from test_recordings import refused, run, table

import stampede
from stampede.export import export
from stampede.recordings import convert
from stampede.recordings.folder import FolderWriter


@pytest.fixture(scope="module")
def demos(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("demos") / "demos.db"
    pictures = {"cameras": ["front"], "width": 32, "height": 24, "depth": False, "mask": False, "semantic_mask": False}
    stampede.Session(catalogue=path).run_all(["pick_and_lift"], episodes=2, seed=7, pictures=pictures)
    return path


@pytest.mark.parametrize("form", ["mcap", "lerobot", "robomimic"])
def test_what_we_export_comes_back(demos: Path, tmp_path: Path, form: str) -> None:
    export([form, str(demos), "--out", str(tmp_path / "export"), "--limit", "1"], tell=lambda line: None)
    source = {"mcap": "*.mcap", "lerobot": ".", "robomimic": "*.hdf5"}[form]
    found = tmp_path / "export" if source == "." else next((tmp_path / "export").glob(source))
    out, _ = run(found, tmp_path / "out", form=form)
    episode = stampede.Catalogue(demos)[1]
    arrays = episode.arrays("joint_positions", "joint_velocities", "gripper_opening")
    rows = table(out / "joints.csv")
    assert len(rows) in (episode.frames, episode.frames - 1)  # steps are one fewer than frames
    positions = np.array([[float(row[f"joint{k}_position_rad"]) for k in range(1, 8)] for row in rows])
    assert np.allclose(positions, arrays["joint_positions"][: len(rows)], atol=1e-6)
    times = [float(row["time_s"]) for row in rows]
    assert np.allclose(times, np.arange(len(rows)) / episode.frame_hz)
    opening = [float(row["opening_m"]) for row in table(out / "gripper.csv")]
    assert np.allclose(opening, arrays["gripper_opening"][: len(rows)], atol=2e-3)
    pictures = sorted((out / "front_rgb").iterdir())
    assert len(pictures) == len(rows)
    seen = np.asarray(Image.open(pictures[-1])).astype(int)
    true = episode.pictures("front_rgb", [len(rows) - 1])[0].astype(int)
    assert np.abs(seen - true).mean() < (8 if form == "lerobot" else 0.01)  # films lose a little
    labels = json.loads((out / "labels.json").read_text())
    skills = [one for one in episode.segments if one.kind == "skill"]
    told = [one for one in labels["segments"] if one["kind"] == "skill"]
    assert told[0]["label"] == skills[0].label and told[0]["start_s"] == pytest.approx(
        skills[0].first_frame / episode.frame_hz
    )
    assert json.loads((out / "recording.json").read_text())["labels"] == "labels.json"


def test_lerobot_of_two_versions_and_episodes(demos: Path, tmp_path: Path) -> None:
    for version in ("2.1", "3.0"):
        export(["lerobot", str(demos), "--out", str(tmp_path / version), "--version", version], tell=lambda line: None)
    folders = [
        convert(["lerobot", str(tmp_path / version), "--out", str(tmp_path / f"out{version}")], tell=lambda line: None)
        for version in ("2.1", "3.0")
    ]
    assert [one.name for one in folders[0]] == ["episode_000000", "episode_000001"]
    for old, new in zip(*folders, strict=True):
        assert (old / "joints.csv").read_text() == (new / "joints.csv").read_text()
    second = convert(
        ["lerobot", str(tmp_path / "3.0"), "--out", str(tmp_path / "o"), "--episodes", "1"], tell=lambda line: None
    )
    assert (second[0] / "joints.csv").read_text() == (folders[0][1] / "joints.csv").read_text()
    with pytest.raises(stampede.Error, match="there is no episode 5"):
        convert(["lerobot", str(tmp_path / "3.0"), "--out", str(tmp_path / "p"), "--episodes", "5"])
    film = next((tmp_path / "3.0" / "videos").rglob("*.mp4"))
    film.write_bytes(film.read_bytes()[:2000])
    with pytest.raises(stampede.Error, match="film"):
        convert(["lerobot", str(tmp_path / "3.0"), "--out", str(tmp_path / "q"), "--episodes", "0"])
    assert not (tmp_path / "q").exists()


def test_a_recording_without_labels_names_no_file_of_them(tmp_path: Path) -> None:
    for language in ([], [{"level": "task", "text": "lift it"}]):
        with FolderWriter(tmp_path / f"{len(language)}") as folder:
            document: dict[str, object] = {}
            folder.write_labels(document, {"labelled_by": "person", "segments": [], "language": language})
            folder.finish(document)
        described = json.loads((tmp_path / f"{len(language)}" / "recording.json").read_text())
        assert ("labels" in described) == (tmp_path / f"{len(language)}" / "labels.json").exists() == bool(language)


def test_other_arms_in_lerobot_and_robomimic(tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "six.hdf5", "w") as file:
        file.create_dataset("data/demo_0/obs/robot0_joint_pos", data=np.zeros((4, 6)))
        file["data"].attrs["env_args"] = json.dumps({"env_kwargs": {"control_freq": 20}})
    assert "another robot" in refused(tmp_path, tmp_path / "six.hdf5", form="robomimic").message
    (tmp_path / "text.hdf5").write_text("no HDF5")
    assert "damaged" in refused(tmp_path, tmp_path / "text.hdf5", form="robomimic").message
    assert "no LeRobotDataset" in refused(tmp_path, tmp_path, form="lerobot").message
