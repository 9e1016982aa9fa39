"""The catalogue's own views as tables of Parquet, for DuckDB, pandas, pyarrow and Spark: `TABLE/task=NAME/HASH.parquet`.

Columns have the names, units and frames of reference of the views (db/README.md), and three are new: `key`, that of the
episode, in every table, as several catalogues may have an episode 1; `file` and `number_in_file` where its bytes lie.
Pictures are rows that say where each is, without `data`. All episodes are written, failed ones too, unless --where says
which.

A folder may grow: the next export adds files to it, of the episodes that are not there yet, and rewrites none. A file
is called by its episodes, the same in all tables, so all of one export can be taken away by its names.
"""

from __future__ import annotations

import argparse
import hashlib
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import quote

from stampede.catalogue import StoredEpisode
from stampede.export.pieces import Pieces
from stampede.faults import fault, reading

_DESCRIPTION = "_schema.json"  # readers of tables leave out what begins with _ or a dot
_GROUP = 100_000  # rows of a row group, of whole episodes: what is in memory at a time
_LONGEST = 255  # bytes of a folder's name


@dataclass(frozen=True)
class _Table:
    view: str
    order: str  # of an episode's rows
    columns: str


_TABLES = {  # `task` is in the name of a folder: pandas refuses it in both places
    "steps": _Table(
        view="steps",
        order="frame",
        columns="episode key variation seed frame time_s j1 j2 j3 j4 j5 j6 j7 gripper x y z qx qy qz qw "
        "action_j1 action_j2 action_j3 action_j4 action_j5 action_j6 action_j7 action_x action_y action_z "
        "action_qx action_qy action_qz action_qw action_gripper skill_segment skill arguments label motion subgoal "
        "reward done",
    ),
    "facts": _Table(
        view="facts",
        order="ordinal",
        columns="episode key variation seed ordinal predicate arg1 arg2 arg3 arg4 fact start_s end_s duration_s "
        "start_step end_step first_frame end_frame open_start open_end observed margin predicate_kind labelled_by",
    ),
    "segments": _Table(
        view="segments",
        order="segment",
        columns="episode key variation seed segment kind parent robot skill case_name arg1 arg2 arg3 arg4 arguments "
        "controller start_s end_s duration_s start_step end_step first_frame end_frame outcome reason detail "
        "precondition_held effect_held missing_effects forgotten searched_for label labelled_by",
    ),
    "pictures": _Table(
        view="images",
        order="frame, camera, kind",
        columns="episode key variation seed frame time_s camera kind width height focal_x focal_y centre_x centre_y "
        "bytes encoding taken_s file number_in_file",
    ),
    "episodes": _Table(  # the last: an episode is there when its row of this table is
        view="episodes",
        order="episode",
        columns="episode key world variation seed split outcome reason detail beside_goal frames steps duration_s "
        "physics_hz frame_hz draws state_hash source scene skills undone engine_version numerics options wall_s "
        "physics_wall_s file number_in_file",
    ),
}
_ELSEWHERE = {  # columns that a view does not have
    "key": "(SELECT e.key FROM episodes e WHERE e.episode = ?1)",
    "file": "file_of(episode)",
    "number_in_file": "number_in_file(episode)",
}

_NUMBERS = (  # columns that are no text: type, unit, frame of reference. Truth is 0 or 1, as in the catalogue
    ("episode seed frames steps skills undone number_in_file segment parent skill_segment ordinal", "int64", "", ""),
    ("precondition_held effect_held open_start open_end observed done", "int64", "", ""),
    ("frame first_frame end_frame", "int64", "frame", "episode start"),
    ("start_step end_step", "int64", "step", "episode start"),
    ("physics_hz frame_hz", "int64", "Hz", ""),
    ("width height", "int64", "pixel", ""),
    ("bytes", "int64", "byte", ""),
    ("draws reward", "double", "", ""),
    ("start_s end_s time_s taken_s", "double", "s", "episode start"),
    ("duration_s wall_s physics_wall_s", "double", "s", ""),
    ("margin", "double", "m; of `open`, `closed` the joint's, m or rad", ""),
    ("j1 j2 j3 j4 j5 j6 j7", "double", "rad", ""),
    ("action_j1 action_j2 action_j3 action_j4 action_j5 action_j6 action_j7", "double", "rad", ""),
    ("gripper action_gripper", "double", "m", ""),
    ("x y z action_x action_y action_z", "double", "m", "world"),
    ("qx qy qz qw action_qx action_qy action_qz action_qw", "double", "1", "world"),
    ("focal_x focal_y centre_x centre_y", "double", "pixel", "image"),
)
_KINDS = {name: kind for names, *kind in _NUMBERS for name in names.split()}

_README = """# Episodes as tables of Parquet

Each folder is a table, `task` is in the names of its folders, and `_schema.json` says types, units and frames of
reference of the columns (pyarrow finds units and frames as metadata of fields too). Columns are those of the views of
Stampede's catalogue: `stampede query --views` says what they mean.

```sql
CREATE VIEW episodes AS FROM read_parquet('episodes/**/*.parquet', hive_types = {'task': VARCHAR});
CREATE VIEW segments AS FROM read_parquet('segments/**/*.parquet', hive_types = {'task': VARCHAR});
CREATE VIEW facts AS FROM read_parquet('facts/**/*.parquet', hive_types = {'task': VARCHAR});
CREATE VIEW steps AS FROM read_parquet('steps/**/*.parquet', hive_types = {'task': VARCHAR});
CREATE VIEW images AS FROM read_parquet('pictures/**/*.parquet', hive_types = {'task': VARCHAR});
```

In DuckDB, with this, a question to the catalogue has the same answer here. Several catalogues may lie here: `episode` is
then the number in one of them, and `key` joins tables (`JOIN steps USING (key)`). `file` and `number_in_file` say which
catalogue has the episode, by the name that it was exported by. `pictures` has a row for each picture, whose bytes are there:

```sql
SELECT data FROM images WHERE episode = NUMBER_IN_FILE AND frame = FRAME AND camera = 'CAMERA' AND kind = 'KIND'
```

A file has the same name in all tables: to take its episodes away, remove `*/*/NAME.parquet`. What was exported to a folder
of its own may be copied into another one, file by file.
"""


def library() -> tuple[Any, Any]:
    """pyarrow and pyarrow.parquet. Raises ImportError that says how to install them."""
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError as error:
        raise ImportError('pyarrow is missing\n    pip install "stampede-sim[tables]"') from error
    return pyarrow, pyarrow.parquet


def may_grow(folder: Path) -> bool:
    """Whether a finished export is there, whose columns are these."""
    description = folder / _DESCRIPTION
    return description.is_file() and description.read_text("utf-8") == _described()


class Writer:
    """Writes TABLE/task=NAME/HASH.parquet, README.md and _schema.json."""

    def __init__(self, folder: Path, options: argparse.Namespace, episodes: Sequence[StoredEpisode]) -> None:
        library()
        self._folder = folder
        self._pieces = Pieces(folder)
        self._key_of = _keys_of(episodes)
        self._there = _keys_in(folder)
        self._missing: dict[str, list[StoredEpisode]] = {}  # by name of the folder
        for episode in episodes:
            if self._key_of[episode.id] not in self._there:
                self._missing.setdefault(_partition(episode), []).append(episode)

    @staticmethod
    def add_arguments(parser: argparse.ArgumentParser) -> None:
        parser.set_defaults(where="true")  # what fails is asked for as well

    def has(self, episode: StoredEpisode) -> bool:
        return self._key_of[episode.id] in self._there or self._pieces.has(episode.id)

    def write(self, episode: StoredEpisode) -> None:
        arrow, _ = library()
        with self._pieces.making(episode.id) as piece:
            for name in _TABLES:
                rows = _rows(episode, name)
                with arrow.ipc.new_file(str(piece / f"{name}.arrow"), rows.schema) as file:
                    file.write_table(rows)

    def finish(self) -> None:
        for partition, episodes in self._missing.items():
            keys = "".join(self._key_of[episode.id] for episode in episodes)
            file = f"{hashlib.sha256(keys.encode()).hexdigest()[:32]}.parquet"
            for name in _TABLES:
                self._write_table(name, self._folder / name / partition / file, episodes)
        if not may_grow(self._folder):
            (self._folder / "README.md").write_text(_README, encoding="utf-8")
            (self._folder / _DESCRIPTION).write_text(_described(), encoding="utf-8")
        self._pieces.remove()

    def close(self) -> None:
        """No file is open between two episodes."""

    def _write_table(self, name: str, path: Path, episodes: Sequence[StoredEpisode]) -> None:
        arrow, parquet = library()
        path.parent.mkdir(parents=True, exist_ok=True)
        partial = path.with_name(f".{path.name}.part")  # others may read the folder meanwhile
        with parquet.ParquetWriter(partial, _schema(name), compression="zstd") as file:
            group: list[Any] = []
            count = 0
            for episode in episodes:
                piece = (self._pieces.of(episode.id) / f"{name}.arrow").read_bytes()
                group.append(arrow.ipc.open_file(piece).read_all())
                count += group[-1].num_rows
                if count >= _GROUP or episode is episodes[-1]:
                    file.write_table(arrow.concat_tables(group), row_group_size=count or None)
                    group, count = [], 0
        partial.replace(path)


def _keys_of(episodes: Sequence[StoredEpisode]) -> dict[int, str]:
    rows = episodes[0].catalogue.query("SELECT episode, key FROM episodes")
    return {row["episode"]: row["key"] for row in rows}


def _keys_in(folder: Path) -> set[str]:
    """Episodes that are in the folder already."""
    _, parquet = library()
    keys: set[str] = set()
    for file in folder.glob("episodes/*/*.parquet"):
        with reading(str(file), "remove the files of this name in all tables, and export again"):
            keys |= set(parquet.read_table(file, columns=["key"], partitioning=None)["key"].to_pylist())
    return keys


def _partition(episode: StoredEpisode) -> str:
    """The name of a task's folder, of which readers make the task again."""
    # Spark makes a letter of each %XX, others a byte: what has more than one byte stays as it is.
    name = "task=" + "".join(quote(letter, safe="") if letter.isascii() else letter for letter in episode.task)
    if len(name.encode()) > _LONGEST:
        raise fault(f"episode {episode.id}", "the name of its task is too long for a folder", "--where leaves it out")
    return name


def _rows(episode: StoredEpisode, name: str) -> Any:
    """An episode's rows of a table."""
    arrow, _ = library()
    table = _TABLES[name]
    wanted = ", ".join(f"{_ELSEWHERE.get(column, column)} AS {column}" for column in table.columns.split())
    question = f"SELECT {wanted} FROM {table.view} WHERE episode = ?1 ORDER BY {table.order}"
    rows = episode.catalogue.query(question, episode.id)
    schema = _schema(name)
    return arrow.table([arrow.array(rows.values(field.name), field.type) for field in schema], schema=schema)


def _schema(name: str) -> Any:
    arrow, _ = library()
    kinds = {"int64": arrow.int64(), "double": arrow.float64(), "string": arrow.string()}
    return arrow.schema(
        arrow.field(one.pop("name"), kinds[one.pop("type")], metadata=one or None) for one in _columns(name)
    )


def _columns(name: str) -> list[dict[str, str]]:
    """Name, type, and where there are such unit and frame of reference."""
    described = []
    for column in _TABLES[name].columns.split():
        kind, unit, frame = _KINDS.get(column, ("string", "", ""))
        all_of_it = {"name": column, "type": kind, "unit": unit, "frame": frame}
        described.append({key: value for key, value in all_of_it.items() if value})
    return described


def _described() -> str:
    tables = {name: {"view": _TABLES[name].view, "columns": _columns(name)} for name in sorted(_TABLES)}
    partition = [{"name": "task", "type": "string"}]
    return json.dumps({"partitioned_by": partition, "tables": tables}, indent=1, ensure_ascii=False) + "\n"
