"""Tables beside a catalogue, for who reads no SQLite: CSV files, and what their columns are."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from stampede import program
from stampede.catalogue import Catalogue
from stampede.publish.words import cell

INTEGER, FLOAT, TEXT = "Integer", "Float", "Text"  # of schema.org


@dataclass(frozen=True)
class Column:
    name: str
    kind: str
    meaning: str
    unit: str = ""


@dataclass(frozen=True)
class Table:
    name: str  # of the file too, without its ending
    meaning: str
    key: Sequence[str]
    columns: Sequence[Column]


_EPISODES = {
    **dict.fromkeys(("episode", "seed", "frames", "skills", "undone"), INTEGER),
    **dict.fromkeys(("frame_hz", "duration_s"), FLOAT),
    **dict.fromkeys(("key", "task", "world", "variation", "split", "outcome", "reason", "source"), TEXT),
}
_SEGMENTS = {
    **dict.fromkeys(("episode", "segment", "parent", "first_frame", "end_frame"), INTEGER),
    **dict.fromkeys(("start_s", "end_s"), FLOAT),
    **dict.fromkeys(("kind", "skill", "arguments", "outcome", "reason", "label"), TEXT),
}
_SENTENCE = Column("sentence", TEXT, "how the task is said in words: the first of its sentences")
_SENTENCES = """LEFT JOIN (SELECT episode, min(ordinal), text AS sentence FROM instructions WHERE level = 'task'
GROUP BY episode) USING (episode)"""


def write_tables(folder: Path, demos: Catalogue) -> list[Table]:
    """episodes.csv and segments.csv. Their columns are those of the views, and mean the same."""
    views = json.loads(program.answer(folder, "query", "--views", "--json"))

    def columns(view: str, kinds: Mapping[str, str]) -> list[Column]:
        rows = [row for row in views if row["view"] == view and row["column"] in kinds]
        return [Column(row["column"], kinds[row["column"]], row["meaning"], row["unit"] or "") for row in rows]

    of_episodes, of_segments = [*columns("episodes", _EPISODES), _SENTENCE], columns("segments", _SEGMENTS)
    episodes = Table("episodes", "Every episode, good or bad", ["episode"], of_episodes)
    spans = "Labelled spans of episodes: subgoals, skills, motions"
    segments = Table("segments", spans, ["episode", "segment"], of_segments)
    for table, more in ((episodes, _SENTENCES), (segments, "")):
        names = ", ".join(column.name for column in table.columns)
        write(folder, table, demos.query(f"SELECT {names} FROM {table.name} {more} ORDER BY {', '.join(table.key)}"))
    return [episodes, segments]


def write(folder: Path, table: Table, rows: Iterable[Mapping[str, Any]]) -> None:
    """Rows in their order."""
    with (folder / f"{table.name}.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([column.name for column in table.columns])
        for row in rows:
            writer.writerow([cell(row[column.name]) for column in table.columns])
