"""Catalogues read from Python: SQL, arrays, pictures, tables, windows, processes."""

from __future__ import annotations

import multiprocessing
import os
import pickle
import shutil
import subprocess
import threading
from pathlib import Path

import numpy as np
import pytest

import stampede


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("catalogue") / "demos.db"
    session = stampede.Session(catalogue=path)
    pictures = {"cameras": ["front", "wrist"], "width": 32, "height": 24, "semantic_mask": False}
    tally = session.run_all(["pick_and_lift"], episodes=2, seed=7, pictures=pictures)
    session.run("reach_target", seed=1_000_000, pictures={"frames": "none"})
    assert tally.succeeded == 2
    return path


@pytest.fixture
def demos(made: Path) -> stampede.Catalogue:
    return stampede.Catalogue(made)


def test_shards_are_parts_of_one_run(tmp_path: Path) -> None:
    session = stampede.Session(catalogue=tmp_path / "parts.db")
    for part in (1, 2, 3):
        tally = session.run_all(["reach_target"], episodes=5, shard=(part, 3))
        assert (tally.total, tally.existing) == (2 if part < 3 else 1, 0)
    assert session.run_all(["reach_target"], episodes=5).existing == 5
    with pytest.raises(stampede.Error, match="there is no part 4/3"):
        session.run_all(["reach_target"], shard=(4, 3))


def test_episodes_are_found_by_conditions(demos: stampede.Catalogue) -> None:
    assert len(demos) == 3
    assert [e.task for e in demos] == ["pick_and_lift", "pick_and_lift", "reach_target"]
    assert [e.split for e in demos.episodes("split = 'test'")] == ["test"]
    assert [e.seed for e in demos.demos("task = ?1", "pick_and_lift")] == [7, 8]
    assert demos[2].seed == 8
    with pytest.raises(stampede.Error, match="no episode 9"):
        demos[9]
    with pytest.raises(stampede.Error, match="no such column"):
        demos.episodes("sucess = 1")


def test_several_files_are_read_as_one(demos: stampede.Catalogue, made: Path, tmp_path: Path) -> None:
    other = tmp_path / "other.db"
    stampede.Session(catalogue=other).run("reach_target", seed=3)
    both = stampede.Catalogue(made, other)
    assert len(both) == 4 and both[4].seed == 3
    rows = both.query("SELECT file_of(episode) AS file, number_in_file(episode) AS n FROM episodes ORDER BY episode")
    assert list(rows["file"]) == [str(made)] * 3 + [str(other)] and list(rows["n"]) == [1, 2, 3, 1]
    alone = stampede.Catalogue(other)[1].arrays("joint_positions")
    assert np.array_equal(both[4].arrays("joint_positions")["joint_positions"], alone["joint_positions"])
    assert np.array_equal(both[1].pictures("front_rgb", [0]), demos[1].pictures("front_rgb", [0]))
    again = pickle.loads(pickle.dumps(both))
    assert again.query("success_by_task").to_dict().keys() == demos.query("success_by_task").to_dict().keys()
    assert repr(again) == f"Catalogue({str(made)!r}, {str(other)!r})" and len(again) == 4
    assert len(stampede.Catalogue(made, made)) == 3  # an episode that is there twice is counted once
    with pytest.raises(stampede.CatalogueError, match="no such file"):
        stampede.Catalogue(made, tmp_path / "none.db")


def test_a_folder_is_read_by_its_index(demos: stampede.Catalogue, made: Path, tmp_path: Path) -> None:
    shutil.copy(made, tmp_path / "part1.db")
    with pytest.raises(stampede.CatalogueError, match="has no index"):
        stampede.Catalogue(tmp_path)
    program = Path(stampede.__file__).parent / "engine/bin/stampede"
    subprocess.run([program, "index", tmp_path], check=True)
    folder = stampede.Catalogue(tmp_path)
    assert len(folder) == len(demos) == 3
    for mine, theirs in zip(folder, demos, strict=True):
        assert np.array_equal(
            mine.arrays("joint_positions")["joint_positions"], theirs.arrays("joint_positions")["joint_positions"]
        )
    assert np.array_equal(folder[1].pictures("front_rgb", [0]), demos[1].pictures("front_rgb", [0]))


def test_arrays_are_views_of_the_engines_memory(demos: stampede.Catalogue) -> None:
    episode = demos[1]
    arrays = episode.arrays("joint_positions", "facts", "skill")
    joints = arrays["joint_positions"]
    assert joints.shape == (episode.frames, 7) and joints.dtype == np.float64
    assert not joints.flags.owndata and not joints.flags.writeable
    assert arrays["facts"].dtype == np.bool_ and arrays["facts"].shape[1] == len(arrays.atoms)
    column = arrays.column("joint_positions")
    assert column.unit == "rad" and column.rate_hz == 20 and len(column.labels) == 7
    del arrays, column
    assert np.isfinite(joints).all()  # what they were cut from lives on
    with pytest.raises(stampede.Error, match="joint_positions"):
        episode.arrays("joint_postions")


def test_the_rows_of_sql_are_those_of_arrays(demos: stampede.Catalogue) -> None:
    rows = demos.query("SELECT position FROM joints WHERE episode = 1 AND joint = 'panda.joint4' ORDER BY frame")
    assert np.array_equal(rows["position"], demos[1].arrays("joint_positions")["joint_positions"][:, 3])


def test_pictures_are_decoded_and_drawn(demos: stampede.Catalogue) -> None:
    episode = demos[1]
    assert sorted(episode.stored_pictures) == [
        f"{camera}_{kind}" for camera in ("front", "wrist") for kind in ("depth", "mask", "rgb")
    ]
    colours = episode.pictures("front_rgb", threads=2)
    assert colours.shape == (episode.frames, 24, 32, 3) and colours.dtype == np.uint8
    assert np.array_equal(colours[[5, 3, 5]], episode.pictures("front_rgb", [5, 3, 5], threads=1))
    depth = episode.pictures("wrist_depth", [0])
    assert depth.dtype == np.float32 and 0 < depth.max() < 5
    assert episode.pictures("front_mask", [0]).dtype == np.uint16
    drawn = episode.picture(3, "front", width=32, height=24)
    assert np.array_equal(drawn["rgb"], colours[3])
    assert drawn["intrinsics"][0, 0] > 0 and drawn["extrinsics"].shape == (4, 4)

    with pytest.raises(stampede.Error, match="stampede render"):
        episode.pictures("front_semantic_mask", [0])
    assert episode.pictures("front_semantic_mask", [0], draw=True).max() > 0
    with pytest.raises(stampede.Error, match="front_rgb"):
        episode.pictures("fromt_rgb", [0])
    with pytest.raises(stampede.Error, match="is no picture"):
        episode.pictures("joint_positions", [0])
    with pytest.raises(stampede.Error, match="100000"):
        episode.pictures("front_rgb", [100000])
    with pytest.raises(stampede.Error, match="100000"):
        episode.pictures("front_rgb", [100000], draw=True)


def test_segments_facts_and_words(demos: stampede.Catalogue) -> None:
    episode = demos[1]
    skills = [s for s in episode.segments if s.kind == "skill"]
    assert [s.name for s in skills] == ["pick", "lift"]
    assert skills[0].end_frame <= skills[1].first_frame and skills[0].label.startswith("pick up")
    assert episode.instructions() and len(episode.instructions("skill")) == 2
    assert "(hand_empty panda.hand)" in episode.table("facts").values("fact")
    with pytest.raises(stampede.Error, match="not the name of a view"):
        episode.table("facts; DROP TABLE episode")
    with pytest.raises(stampede.Error):
        demos.query("DELETE FROM episode")


def test_ready_questions_have_names(demos: stampede.Catalogue) -> None:
    assert "failures_by_reason" in demos.questions()
    assert demos.query("failures_by_reason").columns
    assert len(demos.query("SELECT * FROM segments", limit=2)) == 2


def test_a_table_has_columns_by_name_only(demos: stampede.Catalogue) -> None:
    table = demos.query("SELECT skill, start_s FROM segments")
    for wrong, said in ((0, "table of columns"), (slice(2), "table of columns"), ("skil", "did you mean 'skill'")):
        with pytest.raises(stampede.Error, match=said):
            table[wrong]
    with pytest.raises(stampede.Error, match="no name of a column"):
        table.values(3)


def test_tables_go_to_pandas_arrow_and_duckdb(demos: stampede.Catalogue, made: Path) -> None:
    pandas = pytest.importorskip("pandas")
    arrow = pytest.importorskip("pyarrow")
    table = demos.query("SELECT skill, arg4, start_s, first_frame FROM segments WHERE episode = 1")
    frame = table.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and list(frame.columns) == table.columns and len(frame) == len(table)
    assert frame["first_frame"].dtype == np.int64 and frame["start_s"].dtype == np.float64
    whole = arrow.table(table)
    assert whole.num_rows == len(table) and whole.column("skill").to_pylist() == table.values("skill")
    duckdb = pytest.importorskip("duckdb")
    counted = duckdb.connect().execute("SELECT count(*) FROM whole WHERE skill = 'pick'").fetchall()
    assert counted == [(1,)]


def test_windows_have_labels_pictures_and_language(demos: stampede.Catalogue) -> None:
    data = stampede.FrameDataset(demos, ["joint_positions", "front_rgb"], window=8, where="task = 'pick_and_lift'")
    assert data.skills == ["lift", "pick"]
    assert len(data) == sum(e.frames for e in demos.demos("task = 'pick_and_lift'"))
    sample = data[10]
    assert sample["joint_positions"].shape == (8, 7) and sample["front_rgb"].shape == (8, 24, 32, 3)
    assert sample["episode"] == 1 and sample["frame"] == 10 and not sample["padding"].any()
    assert [data.skills[k] for k in sample["skill"]] == ["pick"] * 8
    assert sample["labels"][0].startswith("pick up") and isinstance(sample["instruction"], str)
    last = data[demos[1].frames - 1]
    assert last["padding"].tolist() == [False] + [True] * 7
    assert (last["joint_positions"] == last["joint_positions"][0]).all()

    skills = stampede.FrameDataset(demos, window=8, over="skill", where="task = 'pick_and_lift'")
    for i in range(len(skills)):
        sample = skills[i]
        assert len(set(sample["segment"].tolist())) == 1 and sample["segment"][0] >= 0

    with pytest.raises(stampede.Error, match="no episode fulfils"):
        stampede.FrameDataset(demos, where="split = 'test' AND task = 'stack_blocks'")


def test_a_stream_gives_each_window_once_in_an_order_of_its_seed(demos: stampede.Catalogue) -> None:
    data = stampede.FrameDataset(demos, ["joint_positions"], stride=5)
    one = [(s["episode"], s["frame"]) for s in stampede.WindowStream(data, seed=3, epochs=1)]
    again = [(s["episode"], s["frame"]) for s in stampede.WindowStream(data, seed=3, epochs=1)]
    other = [(s["episode"], s["frame"]) for s in stampede.WindowStream(data, seed=4, epochs=1)]
    assert one == again != other and sorted(one) == sorted(other) and len(set(one)) == len(data)


def _first_joint(demos: stampede.Catalogue) -> float:
    return float(demos[1].arrays("joint_positions")["joint_positions"][0, 0])


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_other_processes_read_with_the_same_object(demos: stampede.Catalogue, method: str) -> None:
    here = _first_joint(demos)
    with multiprocessing.get_context(method).Pool(2) as pool:
        assert pool.map(_first_joint, [demos] * 4) == [here] * 4
    assert _first_joint(demos) == here


def test_threads_read_with_the_same_object(demos: stampede.Catalogue) -> None:
    found: list[float] = []
    threads = [threading.Thread(target=lambda: found.append(_first_joint(demos))) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [_first_joint(demos)] * 4


def test_one_process_reads_while_another_writes(made: Path, tmp_path: Path) -> None:
    path = tmp_path / "growing.db"
    session = stampede.Session(catalogue=path)
    session.run("reach_target", seed=1)
    reader = stampede.Catalogue(path)
    assert len(reader) == 1
    session.run("reach_target", seed=2)
    assert len(reader) == 2 and reader[2].arrays("time")["time"][0] == 0
    assert len(pickle.loads(pickle.dumps(reader))) == 2


def test_numbers_beyond_64_bits_are_told(demos: stampede.Catalogue) -> None:
    for value in (2**70, -(2**63) - 1, 10**5000):
        with pytest.raises(stampede.Error, match="a parameter of a question: .* is too large") as caught:
            demos.query("select ?1", value)
        assert "64 bits" in caught.value.hint
        with pytest.raises(stampede.Error, match="a parameter of a question: .* is too large"):
            _ = demos[value]
    assert demos.query("select ?1 as n", 2**63 - 1).values("n") == [2**63 - 1]


def test_texts_that_utf_8_has_not_are_told(demos: stampede.Catalogue) -> None:
    with pytest.raises(stampede.Error, match=r"a parameter of a question: '\\ud800' is no text that UTF-8 has"):
        demos.query("select ?1", "\ud800")


def test_files_that_cannot_serve(tmp_path: Path) -> None:
    with pytest.raises(stampede.CatalogueError, match="none.db"):
        stampede.Catalogue(tmp_path / "none.db")
    (tmp_path / "text.db").write_text("this is no database, but a text that is long enough to be looked at" * 20)
    with pytest.raises(stampede.CatalogueError):
        stampede.Catalogue(tmp_path / "text.db")
    empty = stampede.Session(catalogue=tmp_path / "empty.db")
    with pytest.raises(stampede.Error, match="no task 'reach_targte'") as caught:
        empty.run("reach_targte")
    assert "reach_target" in caught.value.hint
    assert not os.path.exists(tmp_path / "empty.db")
