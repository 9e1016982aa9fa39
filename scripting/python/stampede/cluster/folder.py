"""The folder of a run: parts, and what run they are of."""

from __future__ import annotations

import json
import os
import uuid
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from stampede._core import Error
from stampede.catalogue import Catalogue
from stampede.faults import fault
from stampede.files import make_folder, plain_file

ALL_SHOWN = 8  # differences, or errors of shards, that are told in words; of more the first
SHOWN = 200  # letters of what a file or a library says
HALF = ".half"  # how names of parts end that are not finished; SQLite's own beside them end in -wal, -shm
_HALVES = f"part-*-of-*.{'[0-9a-f]' * 8}{HALF}*"
_RUN_FILE = "run.json"  # what the parts are of


@dataclass(frozen=True)
class Part:
    """A shard that is finished."""

    shard: int  # from 1
    shards: int  # how many there are
    file: Path  # a catalogue of its own
    episodes: int  # in it, good and bad
    succeeded: int  # of them
    tries: int  # that it took; 0: it was there before


def part_file(folder: Path, shard: int, shards: int) -> Path:
    width = max(4, len(str(shards)))
    return folder / f"part-{shard:0{width}}-of-{shards:0{width}}.db"


def part_there(file: Path, shard: int, shards: int) -> Part:
    """Raises CatalogueError for a file that is none."""
    (counts,) = Catalogue(file).query("SELECT count(*) AS all_, total(outcome = 'success') AS good FROM episodes")
    return Part(shard, shards, file, int(counts["all_"]), int(counts["good"]), tries=0)


def claim(folder: Path, run: dict[str, Any]) -> None:
    """Makes the folder this run's. Raises Error where parts of another one are in it, or another run.json."""
    make_folder(folder)
    try:
        check_run(folder, run)
        return
    except Error:
        if any(folder.glob("part-*-of-*.db")) or not _is_replaceable(folder / _RUN_FILE):
            raise
    for half in folder.glob(_HALVES):
        half.unlink(missing_ok=True)
    written = folder / f"{_RUN_FILE}.{uuid.uuid4().hex[:8]}"
    written.write_text(json.dumps(run, indent=1) + "\n")
    os.replace(written, folder / _RUN_FILE)


def _is_replaceable(file: Path) -> bool:
    if not os.path.lexists(file):
        return True
    try:
        known = json.loads(plain_file(file).read_text())
    except (Error, OSError, ValueError):
        return False
    return isinstance(known, dict) and {"tasks", "shards", "request"} <= known.keys()


def check_run(folder: Path, run: dict[str, Any], cure: str = "") -> None:
    """Raises Error where the folder is not this run's."""
    file = folder / _RUN_FILE
    cure = cure or f"the same arguments and scripts go on there; others need another folder, or {folder} removed"
    if not os.path.lexists(file):
        raise fault(str(file), "it is not there, and says what run the parts are of", cure)
    plain_file(file)
    try:
        there, here = _flat(json.loads(file.read_text())), _flat(run)
    except (ValueError, AttributeError) as error:
        raise fault(str(file), f"it is damaged ({error})", cure) from error
    differences = [
        f"{key} is {_shown(there.get(key))} there and {_shown(here.get(key))} here"
        for key in {**here, **there}
        if there.get(key) != here.get(key)
    ]
    if differences:
        shown = "; ".join(differences[:ALL_SHOWN]) + (" …" if len(differences) > ALL_SHOWN else "")
        raise fault(str(file), f"it is of another run: {shown}", cure)


def _flat(run: dict[str, Any]) -> dict[str, Any]:
    """With entries of its dicts beside its own: `request.goal`, `scripts.stack_blocks`."""
    flat: dict[str, Any] = {}
    for key, value in run.items():
        flat |= {f"{key}.{inner}": one for inner, one in value.items()} if isinstance(value, dict) else {key: value}
    return flat


def _shown(value: Any) -> str:
    text = "not said" if value is None else json.dumps(value)
    return text if len(text) <= SHOWN else text[:SHOWN] + " …"


def tidy(folder: Path) -> None:
    """Removes what lost tries left of parts that are finished."""
    for half in folder.glob(_HALVES):
        if half.with_name(half.name.split(".")[0] + ".db").exists():
            half.unlink(missing_ok=True)
