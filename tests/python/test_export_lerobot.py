"""LeRobot's datasets: what happens while an export is cut off, and columns of language."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import stampede
from stampede.export import export
from stampede.export.steps import Steps

parquet = pytest.importorskip("pyarrow.parquet")
av = pytest.importorskip("av")
lerobot = pytest.importorskip("stampede.export.lerobot")


def make(path: Path, task: str, seed: int) -> None:
    pictures = {"cameras": ["front"], "width": 32, "height": 24, "depth": False, "mask": False, "semantic_mask": False}
    assert stampede.Session(catalogue=path).run_all([task], episodes=2, seed=seed, pictures=pictures).succeeded == 2


@pytest.fixture
def made(tmp_path: Path) -> Path:
    make(tmp_path / "demos.db", "reach_target", 1_000_000)
    return tmp_path / "demos.db"


def run(made: Path, folder: Path, *options: str) -> Path:
    export(["lerobot", str(made), "--out", str(folder), "--valid", "0", *options], tell=lambda line: None)
    assert not list(folder.rglob("*.part")) and not (folder / ".pieces").exists()
    return folder


def check_rows(made: Path, folder: Path, count: int) -> None:
    """Each episode's rows, films and columns are those of the same episode of the catalogue."""
    table = parquet.read_table(folder / "data/chunk-000/file-000.parquet").to_pydict()
    episodes = parquet.read_table(folder / "meta/episodes/chunk-000/file-000.parquet").to_pylist()
    subtasks = parquet.read_table(folder / "meta/subtasks.parquet").to_pydict()
    of = {(one.task, one.seed): one for one in stampede.Catalogue(made)}
    assert len(episodes) == count
    for number, row in enumerate(episodes):
        steps = Steps(of.pop((row["stampede/task"], row["stampede/seed"])))
        rows = slice(row["dataset_from_index"], row["dataset_to_index"])
        joints = np.array(table["observation.state"][rows])[:, :7]
        assert np.allclose(joints, steps.arrays["joint_positions"][:-1], atol=1e-6)
        assert set(table["episode_index"][rows]) == {number} and row["tasks"] == [steps.instruction]
        first = subtasks["subtask"][subtasks["subtask_index"].index(table["subtask_index"][rows][0])]
        assert first == steps.skills[0].label
        place = (row["videos/observation.images.front/chunk_index"], row["videos/observation.images.front/file_index"])
        film = folder / "videos/observation.images.front/chunk-{:03d}/file-{:03d}.mp4".format(*place)
        with av.open(str(film)) as video:
            assert sum(1 for _ in video.decode(video=0)) == row["length"] == steps.count
    assert table["index"] == list(range(len(table["index"])))


def test_what_comes_to_the_catalogue_while_an_export_is_cut_off_is_not_in_it(
    made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Episodes of training would come before those of tests, so all numbers would change."""
    finish = lerobot.Writer.finish

    def cut_off(self: Any) -> None:
        raise KeyboardInterrupt

    make(made, "pick_and_lift", 0)
    monkeypatch.setattr(lerobot.Writer, "finish", cut_off)
    with pytest.raises(KeyboardInterrupt):
        run(made, tmp_path / "out")
    make(made, "reach_target", 0)
    monkeypatch.setattr(lerobot.Writer, "finish", finish)
    folder = run(made, tmp_path / "out")
    assert json.loads((folder / "meta/info.json").read_text())["splits"] == {"train": "0:2", "test": "2:4"}
    check_rows(made, folder, 4)


@pytest.mark.parametrize("links", [True, False])
def test_what_is_cut_off_at_the_very_end_is_done_again(
    made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, links: bool
) -> None:
    if not links:

        def refuse(*_: Any) -> None:
            raise OSError("no links on this file system")

        monkeypatch.setattr("os.link", refuse)
    write_index = lerobot.Writer._write_index

    def cut_off(self: Any, name: str, *rest: Any) -> None:
        if name == "subtasks":
            raise KeyboardInterrupt
        write_index(self, name, *rest)

    monkeypatch.setattr(lerobot.Writer, "_write_index", cut_off)
    with pytest.raises(KeyboardInterrupt):
        run(made, tmp_path / "out")
    monkeypatch.setattr(lerobot.Writer, "_write_index", write_index)
    check_rows(made, run(made, tmp_path / "out"), 2)


def test_columns_of_language(made: Path, tmp_path: Path) -> None:
    make(made, "pick_and_lift", 0)
    folder = run(made, tmp_path / "out", "--where", "task = 'pick_and_lift'", "--cameras", "", "--language")
    features = json.loads((folder / "meta/info.json").read_text())["features"]
    assert features["language_persistent"]["dtype"] == features["language_events"]["dtype"] == "language"
    file = parquet.ParquetFile(folder / "data/chunk-000/file-000.parquet")
    assert file.num_row_groups == 2
    demo = stampede.Catalogue(made).demos("task = 'pick_and_lift'")[0]
    skills = Steps(demo).skills
    table = file.read_row_group(0).to_pydict()
    rows = table["language_persistent"][0]
    assert all(one == rows for one in table["language_persistent"])  # the same at every frame
    assert set(map(str, table["language_events"])) == {"[]"}
    assert [one["timestamp"] for one in rows] == sorted(one["timestamp"] for one in rows)
    assert {one["timestamp"] for one in rows} <= set(table["timestamp"])  # each at a frame

    def contents(style: str) -> list[str]:
        return [one["content"] for one in rows if one["style"] == style]

    assert contents("subtask") == [skill.label for skill in skills]
    assert contents("plan") == ["\n".join(f"{k}. {skill.label}" for k, skill in enumerate(skills, 1))]
    assert contents("task_aug") == demo.instructions()[1:]
    lasting = [one for one in demo.segments if one.kind == "motion" and one.first_frame < one.end_frame]
    assert contents("motion") == [" ".join([one.name, *one.arguments]) for one in lasting] != []
    with pytest.raises(stampede.Error, match="--version 3.0"):
        run(made, tmp_path / "old", "--version", "2.1", "--language")
