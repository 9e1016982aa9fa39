"""One run, made in shards by whatever executor there is: a process pool, submitit, Dask, Ray.

    from concurrent.futures import ProcessPoolExecutor

    for part in stampede.cluster.generate(
        ["stack_blocks"], "parts", episodes=1000, shards=100, executor=lambda: ProcessPoolExecutor(8)
    ):
        print(part.shard, part.episodes, stampede.Catalogue(part.file))

Each shard is a catalogue of its own in one folder. All of them together are what one `Session.run_all` of the same
arguments makes, bit for bit: `stampede.Catalogue(*files)` reads them as one, `stampede merge all.db parts/*.db` makes
one of them. A shard whose worker is lost is made again; one that is finished never is.
"""

from __future__ import annotations

import importlib
import json
import os
import subprocess
import time
import uuid
from collections import Counter, deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import BrokenExecutor
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Protocol

from stampede import _core
from stampede._core import CatalogueError, Error
from stampede.catalogue import Catalogue
from stampede.faults import fault

_PLACE = "stampede.cluster.generate"
_RUN_FILE = "run.json"  # in the folder: what its parts are of
_HALF = ".half"  # how names of parts end that are not finished; SQLite's own beside them end in -wal, -shm
_HOPELESS = 4  # so many shards given up, and none finished: nothing will be
_FEW_TASKS = 8  # the program hashes the files of so many one by one, of more all at once
_SHORTEST_S, _LONGEST_S = 0.01, 1.0  # between two looks at what is in flight
_ALL_SHOWN = 8  # differences, or errors of shards, that are told in words; of more the first
_SHOWN = 200  # letters of what a library says

PathLike = str | os.PathLike[str]


class Job(Protocol):
    """What an executor's `submit` gives: a Future, a Job of submitit."""

    def done(self) -> bool:
        """Whether it is over, well or not. Does not wait."""

    def result(self) -> Any:
        """What the function gave. Raises what it raised, or what became of its worker."""


class Executor(Protocol):
    """What runs functions elsewhere. If its jobs have `cancel`, and it has `shutdown`, they are used."""

    def submit(self, function: Callable[..., Any], /, *arguments: Any) -> Job:
        """Has `function(*arguments)` called."""


@dataclass(frozen=True)
class Part:
    """A shard that is finished."""

    shard: int  # from 1
    shards: int  # how many there are
    file: Path  # a catalogue of its own
    episodes: int  # in it, good and bad
    succeeded: int  # of them
    tries: int  # that it took; 0: it was there before


@dataclass(frozen=True)
class Progress:
    """How far a call of `generate` is."""

    done: int  # shards that are finished
    shards: int  # all there are
    in_flight: int  # shards that the executor has
    lost: str  # what has just been lost, in words; empty: a shard was finished


class LostShards(Error):
    """Shards that were lost more often than `retries` allows. All others are finished, and stay so."""

    errors: dict[int, Exception]  # by shard: what became of its last try


def generate(
    tasks: str | Sequence[str],
    out: PathLike,
    *,
    episodes: int = 1,
    seed: int = 0,
    shards: int,
    executor: Executor | Callable[[], Executor],
    in_flight: int = 8,
    retries: int = 2,
    progress: Callable[[Progress], object] | None = None,
    workers: int = 1,
    root: PathLike | None = None,
    paths: Sequence[PathLike] = (),
    **request: Any,
) -> Iterator[Part]:
    """Makes the episodes of one run in shards, and gives each shard as it is finished, in any order.

    Nothing is submitted before the first part is asked for. Who stops asking leaves the rest undone; the same call goes
    on from there, and gives parts that are there already too. Mistakes in the arguments are told of at once.

    Arguments:
        tasks: one name or several.
        out: a folder that this machine and all workers see by one path, such as a cluster's shared disk. Parts are
            `part-0003-of-0100.db`; `run.json` says what run they are of.
        episodes, seed: how many of each task, and the first one's seed, as of Session.run_all.
        shards: how many parts. A worker makes one at a time, and makes it anew when it is lost: minutes are good.
        executor: has `submit(function, *arguments)`, whose answer has `done()` and `result()`: one of
            concurrent.futures, of submitit, `client.get_executor()` of Dask, `ray_executor()`. Or a function that
            makes one: it is called again when a pool breaks, which takes no more work once a worker was killed.
        in_flight: shards that are submitted and not yet given, at most. Twice the number of workers keeps all busy.
        retries: how often a shard is made again whose worker was lost. Where a pool breaks nobody knows by which
            shard: those it had are tried in halves until it is known, and that one only counts.
        progress: called with a Progress after each shard that is finished or lost.
        workers: threads of each worker. They do not change the data.
        root, paths: as of stampede.Session; the workers read them too.
        request: as of Session.run: variation, goal, pictures and more. Plain values.

    Raises stampede.Error for bad input, and where `out` holds parts of another run. Raises LostShards in the end, when
    all other shards are finished; earlier only if none is and many were lost.
    """
    asked = _plain_request(request)
    names = [tasks] if isinstance(tasks, str) else list(tasks)
    for name, value, least in (("shards", shards, 1), ("in_flight", in_flight, 1), ("retries", retries, 0)):
        if not isinstance(value, int) or value < least:
            raise fault(f"{name}=", f"it is at least {least}, not {value!r}")
    if not callable(executor) and not hasattr(executor, "submit"):
        cure = "an executor, or a function that makes one: executor=lambda: ProcessPoolExecutor(2)"
        raise fault("executor=", f"{type(executor).__name__} has no submit()", cure)
    scripts = (None if root is None else _absolute(root), [_absolute(path) for path in paths])
    _check(names, episodes, {**asked, "seed": seed, "workers": workers}, *scripts)
    run = {"tasks": names, "episodes": episodes, "seed": seed, "shards": shards, "request": asked}
    folder = Path(_absolute(out))
    run |= _made_of(names, *scripts)
    _claim(folder, run)
    flight = _Flight(_Pool(executor), (str(folder), run, *scripts, workers), in_flight, retries, progress)
    return flight.parts()


def ray_executor(**options: Any) -> Executor:
    """Ray as an executor: each shard is a task of the cluster that `ray.init` joined.

    Arguments:
        options: as of ray.remote: num_cpus, memory, runtime_env … Ray itself tries nothing again (max_retries 0),
            unless it is told to here: `generate` does.
    """
    return _RayExecutor(options)


class _RayExecutor:
    def __init__(self, options: dict[str, Any]) -> None:
        self._ray: Any = importlib.import_module("ray")
        self._call = self._ray.remote(**{"max_retries": 0, **options})(_call)

    def submit(self, function: Callable[..., Any], /, *arguments: Any) -> Job:
        return _RayJob(self._ray, self._call.remote(function, *arguments))


class _RayJob:
    def __init__(self, ray: Any, reference: Any) -> None:
        self._ray, self._reference = ray, reference

    def done(self) -> bool:
        return bool(self._ray.wait([self._reference], timeout=0)[0])

    def result(self) -> Any:
        return self._ray.get(self._reference)

    def cancel(self) -> None:
        self._ray.cancel(self._reference)


def _call(function: Callable[..., Any], *arguments: Any) -> Any:
    return function(*arguments)


# What is asked.


def _absolute(path: PathLike) -> str:
    return os.path.abspath(path)


def _plain_request(request: dict[str, Any]) -> dict[str, Any]:
    """The request as it is read back from JSON, where tuples are lists."""
    try:
        plain: dict[str, Any] = json.loads(json.dumps(request))
    except (TypeError, ValueError) as error:
        cure = "give numbers, texts, lists and dicts: workers on other machines get no more"
        raise fault(_PLACE, f"a request is plain values ({error})", cure) from error
    return plain


def _check(tasks: list[str], episodes: int, request: dict[str, Any], root: str | None, paths: list[str]) -> None:
    """Raises what `run_all` would: a part of the run that has no episodes is run here."""
    beyond = len(tasks) * max(episodes, 1) + 1
    session = _core.Session(root=root, paths=paths)
    session.run_all(tasks, episodes=episodes, shard=(beyond, beyond), sink=lambda episode: None, **request)


def _made_of(tasks: list[str], root: str | None, paths: list[str]) -> dict[str, Any]:
    """What decides on the data beside the request: the release, and by task a hash of all files that it reads."""
    program = Path(_core.__file__).parent / "engine" / "bin" / "stampede"
    where = [*(["--root", root] if root else []), *(word for path in paths for word in ("--path", path))]

    def lines(*what: str) -> list[str]:
        command = [str(program), "list", *what, "--hash", *where]
        listed = subprocess.run(command, capture_output=True, text=True, check=False)
        if listed.returncode:
            raise fault(_PLACE, listed.stderr.strip() or f"exit code {listed.returncode}", " ".join(command[1:]))
        return listed.stdout.split("\n")

    if len(tasks) <= _FEW_TASKS:
        hashes = {task: lines(task)[0] for task in tasks}
    else:
        by_task = {name: digest for digest, _, name in (line.partition(" ") for line in lines())}
        hashes = {task: by_task[task] for task in tasks}
    return {"stampede": _core.__version__, "scripts": hashes}


# The folder.


def _part_file(folder: Path, shard: int, shards: int) -> Path:
    width = max(4, len(str(shards)))
    return folder / f"part-{shard:0{width}}-of-{shards:0{width}}.db"


def _part_there(file: Path, shard: int, shards: int) -> Part:
    """Raises CatalogueError for a file that is none."""
    (counts,) = Catalogue(file).query("SELECT count(*) AS all_, total(outcome = 'success') AS good FROM episodes")
    return Part(shard, shards, file, int(counts["all_"]), int(counts["good"]), tries=0)


def _claim(folder: Path, run: dict[str, Any]) -> None:
    """Makes the folder this run's. Raises Error where parts of another one are in it."""
    folder.mkdir(parents=True, exist_ok=True)
    try:
        _check_run(folder, run)
        return
    except Error:
        if any(folder.glob("part-*-of-*.db")):
            raise
    for half in folder.glob(f"part-*{_HALF}*"):
        half.unlink(missing_ok=True)
    written = folder / f"{_RUN_FILE}.{uuid.uuid4().hex[:8]}"
    written.write_text(json.dumps(run, indent=1) + "\n")
    os.replace(written, folder / _RUN_FILE)


def _check_run(folder: Path, run: dict[str, Any], cure: str = "") -> None:
    """Raises Error where the folder is not this run's."""
    file = folder / _RUN_FILE
    cure = cure or f"the same arguments and scripts go on there; others need another folder, or {folder} removed"
    try:
        there, here = _flat(json.loads(file.read_text())), _flat(run)
    except FileNotFoundError:
        raise fault(str(file), "it is not there, and says what run the parts are of", cure) from None
    except (ValueError, AttributeError) as error:
        raise fault(str(file), f"it is damaged ({error})", cure) from error
    differences = [
        f"{key} is {_shown(there.get(key))} there and {_shown(here.get(key))} here"
        for key in {**here, **there}
        if there.get(key) != here.get(key)
    ]
    if differences:
        shown = "; ".join(differences[:_ALL_SHOWN]) + (" …" if len(differences) > _ALL_SHOWN else "")
        raise fault(str(file), f"it is of another run: {shown}", cure)


def _flat(run: dict[str, Any]) -> dict[str, Any]:
    """With entries of its dicts beside its own: `request.goal`, `scripts.stack_blocks`."""
    flat: dict[str, Any] = {}
    for key, value in run.items():
        flat |= {f"{key}.{inner}": one for inner, one in value.items()} if isinstance(value, dict) else {key: value}
    return flat


def _shown(value: Any) -> str:
    text = "not said" if value is None else json.dumps(value)
    return text if len(text) <= _SHOWN else text[:_SHOWN] + " …"


def _tidy(folder: Path) -> None:
    """Removes what lost tries left of parts that are finished."""
    for half in folder.glob(f"part-*{_HALF}*"):
        if half.with_name(half.name.split(".")[0] + ".db").exists():
            half.unlink(missing_ok=True)


# What workers do.


def _make(
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
    final = _part_file(folder, shard, run["shards"])
    if final.exists():
        return _part_there(final, shard, run["shards"])
    here = {**run, **_made_of(run["tasks"], root, paths)}
    cure = "let this worker see the folder, the scripts and the release that the caller sees"
    _check_run(folder, here, cure)
    half = final.with_suffix(f".{uuid.uuid4().hex[:8]}{_HALF}")  # a try that is not as lost as it seems has another
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
        _check_run(folder, here, cure)  # nobody has taken the folder meanwhile
        if not final.exists():
            os.replace(half, final)
    finally:
        for rest in folder.glob(f"{half.name}*"):
            rest.unlink(missing_ok=True)
    return Part(shard, run["shards"], final, tally.finished, tally.succeeded, tries=1)


# What the caller does.


class _Pool:
    """The executor that was given, or those that a function makes, one after another."""

    def __init__(self, given: Executor | Callable[[], Executor]) -> None:
        is_one = hasattr(given, "submit") and not isinstance(given, type)
        self._executor: Any = given if is_one else None
        self._maker: Any = None if is_one else given

    def executor(self) -> Executor:
        executor: Executor = self._maker() if self._executor is None else self._executor
        self._executor = executor
        return executor

    def renew(self, error: Exception) -> None:
        if self._maker is None:
            cure = "executor=lambda: ProcessPoolExecutor(2) is made anew; the same call goes on where this one ended"
            raise fault(_PLACE, f"the executor is broken, and takes no more work ({_told(error)})", cure) from error
        self.close(wait=False)

    def close(self, wait: bool) -> None:
        if self._maker and self._executor and hasattr(self._executor, "shutdown"):
            self._executor.shutdown(wait=wait)
        self._executor = None if self._maker else self._executor


class _Flight:
    """Shards on their way: waiting, in flight, landed."""

    def __init__(
        self,
        pool: _Pool,
        order: tuple[str, dict[str, Any], str | None, list[str], int],
        most: int,
        retries: int,
        progress: Callable[[Progress], object] | None,
    ) -> None:
        self._pool, self._order, self._most, self._retries, self._progress = pool, order, most, retries, progress
        self._folder, self._shards = Path(order[0]), int(order[1]["shards"])
        self._waiting: deque[int] = deque()
        self._flying: dict[int, Job] = {}
        self._tries: Counter[int] = Counter()
        self._lost: Counter[int] = Counter()
        self._given_up: dict[int, Exception] = {}
        self._done = 0
        self._fallen: list[int] = []  # with a pool that broke, of which some may be still in flight
        self._suspects: set[int] = set()  # of having broken it; they are in flight, or wait before all others
        self._group = most  # so many of them are tried at once

    def parts(self) -> Iterator[Part]:
        _tidy(self._folder)
        there: deque[tuple[Path, int]] = deque()
        for shard in range(1, self._shards + 1):
            file = _part_file(self._folder, shard, self._shards)
            if file.exists():
                there.append((file, shard))
            else:
                self._waiting.append(shard)
        finished = False
        try:
            while there or self._waiting or self._flying:
                self._top_up()
                part = _part_there(*there.popleft(), self._shards) if there else self._next()
                if part:
                    self._done += 1
                    self._tell()
                    yield part
            finished = True
        finally:
            for job in self._flying.values():
                with suppress(Exception):
                    job.cancel()  # type: ignore[attr-defined]  # that it may lack
            self._pool.close(wait=finished)
            _tidy(self._folder)
        if self._given_up:
            raise self._lost_shards()

    def _top_up(self) -> None:
        """Submits as much as may be in flight."""
        while self._waiting and not self._fallen:
            shard = self._waiting[0]
            if len(self._flying) >= (self._group if self._suspects else self._most):
                return
            if self._suspects and shard not in self._suspects:
                return
            executor = self._pool.executor()
            self._waiting.popleft()
            self._tries[shard] += 1
            try:
                self._flying[shard] = executor.submit(_make, shard, uuid.uuid4().hex, *self._order)
            except BrokenExecutor as error:
                self._fall(shard, error)
            except Exception as error:
                self._lose(shard, error)

    def _next(self) -> Part | None:
        """Waits until a shard lands; None: it was lost."""
        if not self._flying:
            return None
        shard = self._landed()
        try:
            part = self._flying.pop(shard).result()
        except BrokenExecutor as error:
            self._fall(shard, error)
            return None
        except Exception as error:
            self._lose(shard, error)
            return None
        if isinstance(part, Exception):
            raise part
        self._suspects.discard(shard)
        made: Part = replace(part, tries=self._tries[shard])
        return made

    def _landed(self) -> int:
        pause_s = _SHORTEST_S
        while True:
            for shard, job in self._flying.items():
                if job.done():
                    return shard
            time.sleep(pause_s)
            pause_s = min(1.1 * pause_s, _LONGEST_S)

    def _fall(self, shard: int, error: Exception) -> None:
        """It was in a pool that broke. When all have landed that were, those that fell are tried again."""
        self._fallen.append(shard)
        if self._flying:
            return
        fallen, self._fallen = sorted(self._fallen), []
        self._pool.renew(error)
        self._suspects = set(fallen)
        self._group = max(1, len(fallen) // 2)
        if len(fallen) == 1:
            self._lose(shard, error)
        else:
            self._waiting.extendleft(reversed(fallen))
            self._tell(f"shards {_listed(fallen)}: {_told(error)}")

    def _lose(self, shard: int, error: Exception) -> None:
        """A try of this shard was lost, by nobody's fault but its own."""
        self._lost[shard] += 1
        if self._lost[shard] > self._retries:
            self._given_up[shard] = error
            self._suspects.discard(shard)
        else:
            self._waiting.appendleft(shard)
        self._tell(f"shard {shard}: {_told(error)}")
        if len(self._given_up) >= _HOPELESS and not self._done:
            raise self._lost_shards()

    def _tell(self, lost: str = "") -> None:
        if self._progress:
            self._progress(Progress(self._done, self._shards, len(self._flying), lost))

    def _lost_shards(self) -> LostShards:
        errors = dict(sorted(self._given_up.items()))
        told = [f"shard {shard}: {_told(error)}" for shard, error in errors.items()]
        more = [f"{len(told) - _ALL_SHOWN} more: LostShards.errors"] if len(told) > _ALL_SHOWN else []
        what = f"of {self._shards} shards, {_listed(list(errors))} were lost {self._retries + 1} times each"
        then = f"{self._done} are finished; the same call tries the others again"
        cure = "\n    ".join([*told[:_ALL_SHOWN], *more, then])
        lost = LostShards(f"{self._folder}: {what}\n    {cure}")
        lost.where, lost.message, lost.hint = str(self._folder), what, cure
        lost.errors = errors
        return lost


def _told(error: Exception) -> str:
    said = " ".join(str(error).split())[:_SHOWN]
    return type(error).__name__ + (f": {said}" if said else "")


def _listed(shards: Sequence[int]) -> str:
    return ", ".join(map(str, shards))
