"""What runs functions elsewhere: the least that is asked of it, and Ray as such."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any, Protocol


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
