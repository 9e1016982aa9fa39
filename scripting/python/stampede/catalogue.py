"""A catalogue of episodes, to be read: SQL, numpy arrays, pictures, segments, facts."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from stampede import _core, shown
from stampede._core import EpisodeArrays, Segment
from stampede.faults import fault, unknown

_SHOWN_ROWS = 20  # of a table in a notebook

SqlValue = None | int | float | str | bytes


class Table:
    """An answer of a catalogue: named columns of equal length.

    `table["skill"]` is one column as a numpy array: int64, float64 (NULL is NaN), or object for texts and for whole
    numbers with NULL among them. `list(table)` gives rows as dicts. pandas, pyarrow, polars and DuckDB take it as it is
    (`pandas.DataFrame(table.to_dict())`, `pyarrow.table(table)`, `polars.from_arrow(table)`).
    """

    def __init__(self, columns: Sequence[str], rows: Sequence[tuple[SqlValue, ...]]) -> None:
        self.columns = list(columns)
        self._rows = list(rows)

    def __len__(self) -> int:
        return len(self._rows)

    def __iter__(self) -> Iterator[dict[str, Any]]:
        for row in self._rows:
            yield dict(zip(self.columns, row, strict=True))

    def values(self, column: str) -> list[SqlValue]:
        """A column as Python's own values. Raises Error for one that is not there."""
        if column not in self.columns:
            raise unknown("Table", "column", column, self.columns)
        place = self.columns.index(column)
        return [row[place] for row in self._rows]

    def __getitem__(self, column: str) -> NDArray[Any]:
        if isinstance(column, int | slice):
            raise fault("Table", "it is a table of columns", 'table["task"] is a column, list(table)[0] a row')
        values = self.values(column)
        kinds = {type(value) for value in values}
        if kinds <= {int}:
            return np.array(values, dtype=np.int64)
        if kinds <= {int, float, type(None)} and float in kinds:
            return np.array([np.nan if value is None else value for value in values], dtype=np.float64)
        column_values = np.empty(len(values), dtype=object)
        column_values[:] = values
        return column_values

    def to_dict(self) -> dict[str, NDArray[Any]]:
        """Columns by name."""
        return {name: self[name] for name in self.columns}

    def to_pandas(self) -> Any:
        """A pandas.DataFrame."""
        pandas = _optional("pandas")
        return pandas.DataFrame(self.to_dict(), columns=self.columns)

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        """The Arrow PyCapsule interface, by way of pyarrow."""
        arrow = _optional("pyarrow")
        return arrow.table({name: arrow.array(self.values(name)) for name in self.columns}).__arrow_c_stream__(
            requested_schema
        )

    def __repr__(self) -> str:
        return f"Table({len(self)} rows: {', '.join(self.columns)})"

    def _repr_html_(self) -> str:
        """The first rows, for notebooks."""
        more = f"{len(self)} rows" if len(self) > _SHOWN_ROWS else ""
        return shown.table(self.columns, self._rows[:_SHOWN_ROWS], more)


@dataclass(frozen=True)
class StoredEpisode:
    """One episode of a catalogue. Nothing but its head has been read."""

    catalogue: Catalogue
    id: int
    task: str
    variation: str  # canonical text; empty: the task has none
    seed: int | None  # None: a real one
    split: str  # train, test
    success: bool
    reason: str  # `none`, or why it failed
    frames: int
    frame_hz: float
    duration_s: float  # simulated

    def arrays(self, *columns: str) -> EpisodeArrays:
        """Columns or groups by name as numpy arrays without copies; none named: all but `applicable`.

        Shapes, units and frames of reference: `arrays.column(name)`, and the table in engine/episode/README.md.
        """
        return self.catalogue._reader.arrays(self.id, list(columns))

    def pictures(
        self, column: str, frames: Sequence[int] | range | None = None, *, draw: bool = False, threads: int = 2
    ) -> NDArray[Any]:
        """What one camera saw: frames x height x width (x 3 for colours), decoded in threads.

        column: `front_rgb` (uint8, sRGB), `wrist_depth` (float32, m along the camera's z, 0: nothing in range),
        `front_mask`, `front_semantic_mask` (uint16). frames: in any order; None: all. draw: frames whose picture is
        not stored are drawn now. Raises Error for unknown columns and for what is not stored.
        """
        wanted = range(self.frames) if frames is None else frames
        return self.catalogue._reader.pictures(self.id, column, [int(f) for f in wanted], draw, threads)

    @cached_property
    def stored_pictures(self) -> dict[str, list[int]]:
        """Frames whose picture is stored, by column."""
        endings = {"rgb": "_rgb", "depth": "_depth", "instance": "_mask", "semantic": "_semantic_mask"}
        stored: dict[str, list[int]] = {}
        question = "SELECT camera, kind, frame FROM images WHERE episode = ?1 AND kind != 'points' ORDER BY frame"
        for camera, kind, frame in self.catalogue.query(question, self.id)._rows:
            stored.setdefault(f"{camera}{endings[str(kind)]}", []).append(int(frame))  # type: ignore[arg-type]
        return stored

    @cached_property
    def segments(self) -> list[Segment]:
        """Subgoals, skills and motions, by id."""
        return list(self.arrays("skill").segments)

    def instructions(self, level: Literal["task", "world", "skill"] = "task") -> list[str]:
        """What the episode is called in words: its task, its world, or its skills one after the other."""
        return self.catalogue.query(
            "SELECT text FROM instructions WHERE episode = ?1 AND level = ?2 ORDER BY ordinal", self.id, level
        ).values("text")

    def table(self, view: str) -> Table:
        """Its rows of a view: `facts`, `segments`, `verdicts` … (db/README.md)."""
        if not view.isidentifier():
            raise fault("StoredEpisode.table", f"'{view}' is not the name of a view", "db/README.md lists them")
        return self.catalogue.query(f"SELECT * FROM {view} WHERE episode = ?1", self.id)

    def state(self, frame: int) -> _core.WorldState:
        """The world in symbols and numbers at one frame."""
        return self.catalogue._reader.state(self.id, frame)

    def picture(self, frame: int, camera: str = "front", **wanted: Any) -> dict[str, NDArray[Any]]:
        """One frame drawn now at any size; see CatalogueReader.picture."""
        return self.catalogue._reader.picture(self.id, frame, camera, **wanted)

    def __repr__(self) -> str:
        end = self._end
        return f"StoredEpisode({self.id}: {self.task} {self.variation}, seed {self.seed}, {end}, {self.frames} frames)"

    @property
    def _end(self) -> str:
        return "success" if self.success else self.reason

    def _repr_html_(self) -> str:
        """For notebooks."""
        facts = {"episode": self.id, "task": self.task, "variation": self.variation, "seed": self.seed}
        facts |= {"split": self.split, "end": self._end, "frames": f"{self.frames}, {self.frame_hz:g} a second"}
        return shown.about(facts | {"instruction": next(iter(self.instructions()), "")})


_HEADS = """SELECT episode, task, variation, seed, split, outcome = 'success', reason, frames, frame_hz, duration_s
FROM episodes"""


_TASKS = """SELECT task, count(*) AS episodes, sum(outcome = 'success') AS successful FROM episodes
GROUP BY task ORDER BY task"""


class Catalogue:
    """A file of episodes, to be read; or several, read as one; or a folder with an index (`stampede index DIR`).

    Of several (`Catalogue("a.db", "b.db")`), episodes are numbered anew, file by file, and one that two files have is
    there once. `file_of(episode)` and `number_in_file(episode)` tell SQL where a row is from. What a question reads,
    but pictures, is copied aside. Raises CatalogueError naming both where two files have other content under one key.

    Threads, forked and spawned processes may share one object: each opens the file for itself. Episodes that another
    process adds meanwhile are seen. Raises CatalogueError for a file that is no catalogue.
    """

    def __init__(self, path: str | os.PathLike[str], *more: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        self.paths = [self.path, *map(Path, more)]
        self._local = threading.local()
        _ = self._reader  # opens: a file that cannot serve is told of here

    @property
    def _reader(self) -> _core.CatalogueReader:
        # A connection must not cross a fork, nor serve two threads.
        if getattr(self._local, "process", None) != os.getpid():
            self._local.reader = _core.CatalogueReader(self.paths)
            self._local.process = os.getpid()
        return self._local.reader

    def query(self, question: str, *parameters: SqlValue, limit: int = 0) -> Table:
        """One SELECT over the views, or the name of a ready question. parameters: for ?1, ?2 …; limit 0: all rows."""
        return Table(*self._reader.query(question, parameters, limit))

    def questions(self) -> dict[str, str]:
        """Ready questions: name -> what it answers."""
        return {one.name: one.description for one in _core.ready_questions()}

    def episodes(self, where: str = "", *parameters: SqlValue) -> list[StoredEpisode]:
        """Episodes, good and bad, by id. where: a condition on view `episodes`, such as `split = 'test'`."""
        condition = f" WHERE {where}" if where else ""
        heads = self.query(f"{_HEADS}{condition} ORDER BY episode", *parameters)
        return [
            StoredEpisode(self, *row[:5], bool(row[5]), *row[6:])  # type: ignore[arg-type]
            for row in heads._rows
        ]

    def demos(self, where: str = "", *parameters: SqlValue) -> list[StoredEpisode]:
        """Those that succeeded."""
        return self.episodes(f"outcome = 'success' AND ({where})" if where else "outcome = 'success'", *parameters)

    def __getitem__(self, episode: int) -> StoredEpisode:
        found = self.episodes("episode = ?1", episode)
        if not found:
            raise fault(str(self.path), f"there is no episode {episode}", "Catalogue.episodes() lists them")
        return found[0]

    def __len__(self) -> int:
        return int(self.query("SELECT count(*) AS n FROM episodes")["n"][0])

    def __iter__(self) -> Iterator[StoredEpisode]:
        return iter(self.episodes())

    def __reduce__(self) -> tuple[type[Catalogue], tuple[Path, ...]]:
        return Catalogue, tuple(self.paths)

    def __repr__(self) -> str:
        return f"Catalogue({', '.join(repr(str(path)) for path in self.paths)})"

    def _repr_html_(self) -> str:
        """Its tasks, for notebooks."""
        tasks = self.query(_TASKS)
        return shown.table(tasks.columns, tasks._rows, f"{self!r}: {len(self)} episodes")


def _optional(module: str) -> Any:
    import importlib

    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(f'{module} is missing\n    pip install "stampede-sim[tables]"') from error
