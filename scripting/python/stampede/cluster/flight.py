"""Shards on their way: submitted, lost, tried again, landed."""

from __future__ import annotations

import time
import uuid
from collections import Counter, deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import BrokenExecutor
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from stampede._core import Error
from stampede.faults import fault

from .executors import Executor, Job
from .folder import ALL_SHOWN, SHOWN, Part, part_file, part_there, tidy
from .request import PLACE
from .worker import make_part

_HOPELESS = 4  # so many shards given up, and none finished: nothing will be
_SHORTEST_S, _LONGEST_S = 0.01, 1.0  # between two looks at what is in flight


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


class Pool:
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
            raise fault(PLACE, f"the executor is broken, and takes no more work ({_told(error)})", cure) from error
        self.close(wait=False)

    def close(self, wait: bool) -> None:
        if self._maker and self._executor and hasattr(self._executor, "shutdown"):
            self._executor.shutdown(wait=wait)
        self._executor = None if self._maker else self._executor


class Flight:
    """Shards on their way: waiting, in flight, landed."""

    def __init__(
        self,
        pool: Pool,
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
        tidy(self._folder)
        there: deque[tuple[Path, int]] = deque()
        for shard in range(1, self._shards + 1):
            file = part_file(self._folder, shard, self._shards)
            if file.exists():
                there.append((file, shard))
            else:
                self._waiting.append(shard)
        finished = False
        try:
            while there or self._waiting or self._flying:
                self._top_up()
                part = part_there(*there.popleft(), self._shards) if there else self._next()
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
            tidy(self._folder)
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
                self._flying[shard] = executor.submit(make_part, shard, uuid.uuid4().hex, *self._order)
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
        more = [f"{len(told) - ALL_SHOWN} more: LostShards.errors"] if len(told) > ALL_SHOWN else []
        what = f"of {self._shards} shards, {_listed(list(errors))} were lost {self._retries + 1} times each"
        then = f"{self._done} are finished; the same call tries the others again"
        cure = "\n    ".join([*told[:ALL_SHOWN], *more, then])
        lost = LostShards(f"{self._folder}: {what}\n    {cure}")
        lost.where, lost.message, lost.hint = str(self._folder), what, cure
        lost.errors = errors
        return lost


def _told(error: Exception) -> str:
    said = " ".join(str(error).split())[:SHOWN]
    return type(error).__name__ + (f": {said}" if said else "")


def _listed(shards: Sequence[int]) -> str:
    return ", ".join(map(str, shards))
