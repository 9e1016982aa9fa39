"""What a worker does: one part, whole or not at all."""

from __future__ import annotations

import os
import uuid
from pathlib import Path
from typing import Any

from stampede import _core
from stampede._core import CatalogueError, Error

from .folder import HALF, Part, check_run, part_file, part_there
from .request import made_of


def make_part(
    shard: int, ticket: str, folder: str, run: dict[str, Any], root: str | None, paths: list[str], workers: int
) -> Part | Exception:
    """Makes one part, in a worker. Mistakes are given, not raised: no library wraps them on the way, or retries.

    ticket: another one each time; Dask takes two equal calls for one, whose loss it remembers.
    """
    del ticket
    try:
        return _made(shard, Path(folder), run, root, paths, workers)
    except CatalogueError:  # of a file that is new: the disk's fault, not the caller's
        raise
    except (Error, TypeError) as mistake:
        return mistake


def _made(shard: int, folder: Path, run: dict[str, Any], root: str | None, paths: list[str], workers: int) -> Part:
    final = part_file(folder, shard, run["shards"])
    if final.exists():
        return part_there(final, shard, run["shards"])
    here = {**run, **made_of(run["tasks"], root, paths)}
    cure = "let this worker see the folder, the scripts and the release that the caller sees"
    check_run(folder, here, cure)
    half = final.with_suffix(f".{uuid.uuid4().hex[:8]}{HALF}")  # a try that is not as lost as it seems has another
    try:
        tally = _core.Session(root=root, paths=paths, catalogue=half).run_all(
            run["tasks"],
            episodes=run["episodes"],
            seed=run["seed"],
            workers=workers,
            shard=(shard, run["shards"]),
            **run["request"],
        )  # nothing holds the session any more: its file is closed, and what was beside it is in it
        if tally.finished < tally.total:
            raise RuntimeError(f"it ended after {tally.finished} of {tally.total} episodes")
        check_run(folder, here, cure)  # nobody has taken the folder meanwhile
        if not final.exists():
            os.replace(half, final)
    finally:
        for rest in folder.glob(f"{half.name}*"):
            rest.unlink(missing_ok=True)
    return Part(shard, run["shards"], final, tally.finished, tally.succeeded, tries=1)
