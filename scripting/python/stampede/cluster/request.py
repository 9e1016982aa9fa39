"""What a run is asked to be, checked before anything is submitted."""

from __future__ import annotations

import json
import os
from typing import Any

from stampede import _core, program
from stampede.faults import fault

PLACE = "stampede.cluster.generate"
_FEW_TASKS = 8  # the program hashes the files of so many one by one, of more all at once

PathLike = str | os.PathLike[str]


def absolute(path: PathLike) -> str:
    return os.path.abspath(path)


def plain_request(request: dict[str, Any]) -> dict[str, Any]:
    """The request as it is read back from JSON, where tuples are lists."""
    try:
        plain: dict[str, Any] = json.loads(json.dumps(request))
    except (TypeError, ValueError) as error:
        cure = "give numbers, texts, lists and dicts: workers on other machines get no more"
        raise fault(PLACE, f"a request is plain values ({error})", cure) from error
    return plain


def check_request(tasks: list[str], episodes: int, request: dict[str, Any], root: str | None, paths: list[str]) -> None:
    """Raises what `run_all` would: a part of the run that has no episodes is run here."""
    beyond = len(tasks) * max(episodes, 1) + 1
    session = _core.Session(root=root, paths=paths)
    session.run_all(tasks, episodes=episodes, shard=(beyond, beyond), sink=lambda episode: None, **request)


def made_of(tasks: list[str], root: str | None, paths: list[str]) -> dict[str, Any]:
    """What decides on the data beside the request: the release, and by task a hash of all files that it reads."""
    where = [*(["--root", root] if root else []), *(word for path in paths for word in ("--path", path))]

    def lines(*what: str) -> list[str]:
        command = ["list", *what, "--hash", *where]
        listed = program.call(*command)
        if listed.returncode:
            raise fault(PLACE, listed.stderr.strip() or f"exit code {listed.returncode}", " ".join(command))
        return listed.stdout.split("\n")

    if len(tasks) <= _FEW_TASKS:
        hashes = {task: lines(task)[0] for task in tasks}
    else:
        by_task = {name: digest for digest, _, name in (line.partition(" ") for line in lines())}
        hashes = {task: by_task[task] for task in tasks}
    return {"stampede": _core.__version__, "scripts": hashes}
