"""A set of our own: a lock of each task that came with the package, and what comes out of it."""

from __future__ import annotations

import argparse
import json
import os
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from stampede import program
from stampede._core import Session
from stampede.catalogue import Catalogue
from stampede.faults import unknown
from stampede.file_names import FileNames
from stampede.publish import card, croissant
from stampede.publish.tables import FLOAT, INTEGER, TEXT, Column, Table, write
from stampede.publish.words import code, plain

Row = dict[str, Any]

_COLUMNS = [
    Column("task", TEXT, "name of the task"),
    Column("episodes", INTEGER, "episodes, good and bad"),
    Column("success", INTEGER, "how many of them succeeded"),
    Column("skills", INTEGER, "segments of skills"),
    Column("duration_s", FLOAT, "how long all of them lasted, simulated", "s"),
    Column("content_hash", TEXT, "hash of all that the lock makes but host times"),
    Column("lock", TEXT, "file"),
    Column("sentence", TEXT, "how the task is said in words: the first sentence of its first episode"),
]
_TABLE = Table("tasks", "A row a task", ["task"], _COLUMNS)
_QUESTION = """SELECT count(*) AS episodes, sum(outcome = 'success') AS success, sum(duration_s) AS duration_s,
sum(skills) AS skills, min(engine_version) AS release, min(numerics) AS numerics,
(SELECT text FROM instructions WHERE level = 'task' ORDER BY episode, ordinal LIMIT 1) AS sentence FROM episodes"""


def fill(folder: Path, options: argparse.Namespace, tell: Callable[[str], None]) -> None:
    known = Session().tasks()
    for task in options.what:
        if task not in known:
            raise unknown("--shipped", "task", task, known)
    tasks = sorted(set(options.what or known))
    (folder / "locks").mkdir()
    rows, names = [], FileNames()
    with tempfile.TemporaryDirectory(dir=folder.parent) as aside:
        catalogues = folder / "catalogues" if options.catalogues else Path(aside)
        catalogues.mkdir(exist_ok=True)
        for number, task in enumerate(tasks, 1):
            name = names.take(task)
            row, lock = _make(catalogues / f"{name}.db", task, options.episodes)
            rows.append(row | {"task": task, "lock": f"locks/{name}.lock"})
            (folder / "locks" / f"{name}.lock").write_text(lock)
            tell(f"[{number}/{len(tasks)}] {task}: {row['episodes']} episodes, {row['success']} succeeded")
    write(folder, _TABLE, rows)
    what = f"Locks of {len(rows)} robot tasks: labelled demonstrations of each come out of them, bit for bit."
    content = croissant.digest_of(row["content_hash"] for row in rows)
    croissant.write(folder, options, what, content, [_TABLE])
    (folder / "README.md").write_text("\n".join(_card(rows, options)) + "\n", encoding="utf-8")


def _make(place: Path, task: str, episodes: int) -> tuple[Row, str]:
    """Runs the task; gives its row and its lock. Episodes that fail are episodes too."""
    Session(catalogue=place).run_all([task], episodes=episodes, workers=len(os.sched_getaffinity(0)))
    lock = program.answer(place.parent, "lock", place.name)
    (row,) = Catalogue(place).query(_QUESTION)
    return row | {"content_hash": json.loads(lock)["hash"]}, lock


def _card(rows: Sequence[Row], options: argparse.Namespace) -> list[str]:
    first = rows[0]
    total = {name: sum(row[name] for row in rows) for name in ("episodes", "success", "duration_s")}
    return [
        *card.front_matter(options, total["episodes"], ["robotics", "simulation", "stampede"], {"tasks": "tasks.csv"}),
        "",
        f"# {plain(options.name)}",
        "",
        f"Labelled demonstrations of {len(rows)} robot tasks, each as a lock of some kilobytes: episodes, options,",
        "scripts and a hash of all that comes out of it, which is the same, bit for bit, on release",
        f"{code(first['release'])} of Stampede and a processor of numerics {code(first['numerics'])}:",
        "",
        "```sh",
        f"stampede make {first['lock']} --out demos.db",
        f"stampede verify {first['lock']} demos.db",
        "stampede query demos.db success_by_task",
        "```",
        "",
        f"{total['episodes']} episodes in all, {total['success']} of them successful,",
        f"{total['duration_s'] / 3600:.2f} hours, none of the test split.",
        "`stampede query --views` says what a catalogue holds.",
        "",
        *card.grid(
            ["task", "sentence", "episodes", "success", "skills", "s", "content hash and lock"], map(_line, rows)
        ),
        *card.fields([_TABLE]),
        "",
        "## How to make this folder again",
        "",
        f"`{card.command(options)}`" + ("" if options.what else ": tasks that were added since are in it then."),
        "",
        "## Known weaknesses",
        "",
        f"- {card.SIMULATED}",
        "- Episodes that failed are in it: view `demos` leaves them out.",
        f"- {card.UNDRAWN}",
        "- Another release or class of processor makes other episodes, and `stampede make` says so.",
        *card.ending(options),
    ]


def _line(row: Row) -> list[object]:
    counts = [row["episodes"], row["success"], row["skills"], f"{row['duration_s']:.1f}"]
    return [code(row["task"]), plain(row["sentence"] or ""), *counts, f"[`{row['content_hash']}`]({row['lock']})"]
