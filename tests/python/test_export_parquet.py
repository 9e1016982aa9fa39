"""Tables of Parquet: questions have the catalogue's answers, folders grow, and what is cut off goes on."""

from __future__ import annotations

import json
import os
import shutil
import sqlite3
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import stampede
from stampede.export import export, parquet

arrow = pytest.importorskip("pyarrow")
data = pytest.importorskip("pyarrow.dataset")
files = pytest.importorskip("pyarrow.parquet")

VIEWS = {"episodes": "episodes", "segments": "segments", "facts": "facts", "steps": "steps", "pictures": "images"}
PICTURES = {"cameras": ["front"], "width": 32, "height": 24, "depth": False, "mask": False, "semantic_mask": False}


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two episodes with pictures, and one without that is as if it had failed."""
    path = tmp_path_factory.mktemp("parquet") / "demos.db"
    session = stampede.Session(catalogue=path)
    assert session.run_all(["pick_and_lift"], episodes=2, seed=7, pictures=PICTURES).succeeded == 2
    assert session.run_all(["reach_target"], episodes=1, pictures={"frames": "none"}).succeeded == 1
    with sqlite3.connect(path) as file:
        file.execute("UPDATE episode SET outcome = 'failure', reason = 'timeout' WHERE task = 'reach_target'")
    return path


def run(made: Path, folder: Path, *options: str) -> Path:
    export(["parquet", str(made), "--out", str(folder), *options], tell=lambda line: None)
    hidden = [path for path in folder.rglob("*") if path.name.startswith(".") or path.suffix == ".part"]
    assert not hidden and not (folder / "stampede-export.json").exists()
    return folder


@pytest.fixture(scope="module")
def lake(made: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return run(made, tmp_path_factory.mktemp("lake"))


def bytes_of(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def episodes_in(folder: Path) -> int:
    return data.dataset(folder / "episodes", partitioning="hive").count_rows()


@pytest.mark.parametrize("table", VIEWS)
def test_a_table_is_its_view(made: Path, lake: Path, table: str) -> None:
    """Its names, its rows, plain types; but the bytes of pictures."""
    answer = stampede.Catalogue(made).query(f"SELECT * FROM {VIEWS[table]}")
    rows = data.dataset(lake / table, partitioning="hive").to_table()
    assert {"key", "file", "number_in_file"} >= set(rows.column_names) - set(answer.columns)
    assert set(answer.columns) - set(rows.column_names) == ({"data"} if table == "pictures" else set())
    assert {str(field.type) for field in rows.schema} <= {"int64", "double", "string"}
    common = [column for column in answer.columns if column in rows.column_names]
    theirs = [tuple(row[column] for column in common) for row in rows.to_pylist()]
    ours = [tuple(row[column] for column in common) for row in answer]
    assert len(ours) >= 3 and sorted(theirs, key=repr) == sorted(ours, key=repr)
    if table in ("pictures", "episodes"):
        assert set(rows["file"].to_pylist()) == {str(made)} and rows["number_in_file"] == rows["episode"]


def test_units_and_frames_are_those_of_the_documents(lake: Path) -> None:
    described = json.loads((lake / "_schema.json").read_text())["tables"]
    documents = (Path(__file__).parents[2] / "db/README.md").read_text().split("\n### ")
    for table, view in VIEWS.items():
        text = next(one for one in documents if one.startswith(f"{view}\n"))
        lines = [[cell.strip() for cell in line.split(" | ")] for line in text.splitlines() if line.startswith("| `")]
        known = {name.strip("|` "): [cell.strip("–") for cell in (unit, frame)] for name, _, unit, frame, _ in lines}
        schema = files.read_schema(next((lake / table).rglob("*.parquet")))
        for column in described[table]["columns"]:
            name, metadata = column["name"], schema.field(column["name"]).metadata or {}
            told = [column.get("unit", ""), column.get("frame", "")]
            assert [metadata.get(key, b"").decode() for key in (b"unit", b"frame")] == told
            assert told == known.get(name, told) and str(schema.field(name).type) == column["type"], (view, name)
        assert [one["name"] for one in described[table]["columns"]] == schema.names


QUESTIONS = (
    "SELECT task, skill, count(*), sum(end_frame - first_frame) FROM segments WHERE kind = 'skill' GROUP BY 1, 2",
    "SELECT fact FROM facts WHERE episode = 1 AND first_frame <= 10 AND 10 < end_frame",
    "SELECT task, count(*), sum(j1), sum(action_gripper), sum(reward), max(time_s) FROM steps GROUP BY task",
    "SELECT e.variation, s.skill, count(*) FROM episodes e JOIN steps s ON s.episode = e.episode GROUP BY 1, 2",
    "SELECT camera, kind, count(*), sum(bytes) FROM images WHERE task = 'pick_and_lift' GROUP BY 1, 2",
    "SELECT outcome, reason, count(*) FROM episodes GROUP BY 1, 2",
)


@pytest.mark.parametrize("question", QUESTIONS)
def test_duckdb_answers_as_the_catalogue_does(made: Path, lake: Path, question: str) -> None:
    """With the views that the folder's own README gives."""
    duckdb = pytest.importorskip("duckdb").connect()
    views = (lake / "README.md").read_text().split("```sql\n")[1].split("```")[0]
    duckdb.execute(views.replace("read_parquet('", f"read_parquet('{lake}/"))
    theirs = sorted(duckdb.execute(question).fetchall(), key=repr)
    ours = sorted((tuple(row.values()) for row in stampede.Catalogue(made).query(question)), key=repr)
    assert len(theirs) == len(ours) > 0
    for one, other in zip(theirs, ours, strict=True):
        assert list(one) == [pytest.approx(x, rel=1e-12) if isinstance(x, float) else x for x in other]


def test_pandas_reads_it(made: Path, lake: Path) -> None:
    pandas = pytest.importorskip("pandas")
    steps = pandas.read_parquet(lake / "steps")
    frames = stampede.Catalogue(made).query("SELECT task, sum(frames) AS n FROM episodes GROUP BY task")
    assert steps.groupby("task", observed=True).size().to_dict() == {row["task"]: row["n"] for row in frames}
    joined = steps.merge(pandas.read_parquet(lake / "episodes")[["key", "outcome"]], on="key")
    assert len(joined) == len(steps) and set(joined["outcome"]) == {"success", "failure"}


def test_the_same_catalogue_gives_the_same_bytes(
    made: Path, lake: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert bytes_of(run(made, tmp_path / "again")) == bytes_of(lake)
    monkeypatch.setattr(parquet, "_GROUP", 1)  # each episode is a row group
    folder = run(made, tmp_path / "small")
    assert set(bytes_of(folder)) == set(bytes_of(lake))
    file = files.ParquetFile(next(folder.glob("steps/task=pick_and_lift/*.parquet")))
    assert file.num_row_groups == 2 and file.metadata.row_group(0).column(0).compression == "ZSTD"
    whole = files.ParquetFile(next(lake.glob("steps/task=pick_and_lift/*.parquet")))
    assert whole.num_row_groups == 1 and file.read().equals(whole.read())


def test_a_folder_grows_and_shrinks_by_files(made: Path, lake: Path, tmp_path: Path) -> None:
    """What is there already is neither written again nor touched, though two catalogues have it."""
    catalogue = Path(shutil.copy(made, tmp_path / "more.db"))
    assert stampede.Session(catalogue=catalogue).run_all(["reach_target"], episodes=1, seed=5).succeeded == 1
    folder = tmp_path / "lake"
    shutil.copytree(lake, folder)
    run(catalogue, folder)
    grown, before = bytes_of(folder), bytes_of(lake)
    assert {name: grown[name] for name in before} == before and len(grown) - len(before) == len(VIEWS)
    assert episodes_in(folder) == 4
    assert bytes_of(run(catalogue, folder)) == grown
    own = run(catalogue, tmp_path / "own", "--where", "seed = 5")
    assert bytes_of(own).items() <= grown.items()  # so files may as well be copied
    name = next(own.glob("episodes/*/*.parquet")).name
    for file in folder.glob(f"*/*/{name}"):
        file.unlink()
    assert bytes_of(folder) == before


def test_what_was_cut_off_goes_on(made: Path, lake: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Between two episodes, and between two tables of a task; nothing half done has its name."""
    write, write_table = parquet.Writer.write, parquet.Writer._write_table
    written: list[int] = []
    tables: list[str] = []

    def one_episode(self: Any, episode: stampede.StoredEpisode) -> None:
        if len(written) == 1:
            raise KeyboardInterrupt
        written.append(episode.id)
        write(self, episode)

    def other_episodes(self: Any, episode: stampede.StoredEpisode) -> None:
        written.append(episode.id)
        write(self, episode)

    def some_tables(self: Any, name: str, path: Path, episodes: Any) -> None:
        if len(tables) == 7:
            path.parent.mkdir(parents=True)
            path.with_name(f".{path.name}.part").write_bytes(b"PAR1")
            raise KeyboardInterrupt
        tables.append(name)
        write_table(self, name, path, episodes)

    folder = tmp_path / "out"
    monkeypatch.setattr(parquet.Writer, "write", one_episode)
    with pytest.raises(KeyboardInterrupt):
        run(made, folder)
    assert not list(folder.rglob("*.parquet"))
    monkeypatch.setattr(parquet.Writer, "write", other_episodes)
    monkeypatch.setattr(parquet.Writer, "_write_table", some_tables)
    with pytest.raises(KeyboardInterrupt):
        run(made, folder)
    first, second = (f"task={task}" for task in ("pick_and_lift", "reach_target"))
    assert len(list(folder.glob(f"*/{first}/*.parquet"))) == len(VIEWS)
    assert len(list(folder.glob(f"*/{second}/*.parquet"))) == 2 and not (folder / "episodes" / second).exists()
    monkeypatch.setattr(parquet.Writer, "_write_table", write_table)
    assert bytes_of(run(made, folder)) == bytes_of(lake)
    assert written == [1, 2, 3]


HOSTILE = ("../x", "a=b", 'it\'s "q" & 100%2F', "büro/京 🤖", "a b+c", "..", "__x", "task=a\n")


def test_names_of_tasks_are_read_back(made: Path, tmp_path: Path) -> None:
    names = {}
    for name in HOSTILE:
        catalogue = Path(shutil.copy(made, tmp_path / "hostile.db"))
        with sqlite3.connect(catalogue) as file:
            file.execute("DELETE FROM episode WHERE id > 1")
            file.execute("UPDATE episode SET task = ?, variation = ?, key = ?", (name, name, str(len(names))))
        run(catalogue, tmp_path / "out/lake")
        names[str(len(names))] = name
    assert os.listdir(tmp_path / "out") == ["lake"]
    assert all(len(path.relative_to(tmp_path / "out/lake").parts) < 4 for path in (tmp_path / "out").rglob("*"))
    table = data.dataset(tmp_path / "out/lake/episodes", partitioning="hive").to_table().to_pylist()
    assert {row["key"]: row["task"] for row in table} == {row["key"]: row["variation"] for row in table} == names
    duckdb = pytest.importorskip("duckdb")
    place = f"{tmp_path}/out/lake/episodes/**/*.parquet"
    rows = duckdb.execute("SELECT key, task FROM read_parquet(?, hive_types = {'task': VARCHAR})", [place]).fetchall()
    assert dict(rows) == names


def test_a_folder_of_catalogues(made: Path, tmp_path: Path) -> None:
    (tmp_path / "shards").mkdir()
    shutil.copy(made, tmp_path / "shards/part1.db")
    stampede.Session(catalogue=tmp_path / "shards/part2.db").run("reach_target", seed=5)
    program = Path(stampede.__file__).parent / "engine/bin/stampede"
    subprocess.run([program, "index", tmp_path / "shards"], check=True, capture_output=True)
    folder = run(tmp_path / "shards", tmp_path / "out")
    rows = data.dataset(folder / "episodes", partitioning="hive").to_table().to_pylist()
    places = {(row["episode"], Path(row["file"]).name, row["number_in_file"]) for row in rows}
    assert places == {*((number, "part1.db", number) for number in (1, 2, 3)), (4, "part2.db", 1)}
    frames = sum(row["frames"] for row in rows)
    assert data.dataset(folder / "steps").count_rows() == frames


def test_bad_input(made: Path, lake: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "full"
    folder.mkdir()
    (folder / "thesis.txt").write_text("mine")
    with pytest.raises(stampede.Error, match="the folder is not empty\n    name a new one"):
        run(made, folder)
    (folder / "_schema.json").write_text("{}")  # of another release
    with pytest.raises(stampede.Error, match="the folder is not empty"):
        run(made, folder)
    assert sorted(path.name for path in folder.iterdir()) == ["_schema.json", "thesis.txt"]
    with pytest.raises(stampede.Error, match="no episode fulfils"):
        run(made, tmp_path / "out", "--where", "task = 'none'")
    with pytest.raises(SystemExit):  # pictures are where they are
        run(made, tmp_path / "out", "--draw")
    shutil.copytree(lake, tmp_path / "damaged")
    damaged = next((tmp_path / "damaged").glob("episodes/*/*.parquet"))
    damaged.write_bytes(damaged.read_bytes()[:-9])
    with pytest.raises(stampede.Error, match=f"{damaged.name}: it ends early or is damaged"):
        run(made, tmp_path / "damaged")
    long = Path(shutil.copy(made, tmp_path / "long.db"))
    with sqlite3.connect(long) as file:
        file.execute("UPDATE episode SET task = ?", ("京" * 84,))
    with pytest.raises(stampede.Error, match="episode 1: the name of its task is too long"):
        run(long, tmp_path / "out")
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(ImportError, match=r"stampede-sim\[tables\]"):
        run(made, tmp_path / "out")
    assert not (tmp_path / "out").exists()  # the right command may follow
