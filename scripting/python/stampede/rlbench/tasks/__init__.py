"""
The tasks that come with the engine, one class each: `from stampede.rlbench.tasks import ReachTarget`.

Each has a module of its own beside this file, `stampede.rlbench.tasks.reach_target`, written when the package is built.
FS10_V1 … FS95_V1, MT15_V1 … MT100_V1: RLBench's task sets (../task_sets.py).
"""

import difflib
import importlib
import threading
from functools import cache

from stampede._core import Error, Session
from stampede.rlbench.backend.task import Task
from stampede.rlbench.task_sets import SET_NAMES, task_sets

_lock = threading.Lock()


@cache
def _names() -> dict[str, str]:
    """Class name -> task name."""
    with _lock:
        return {class_name(task): task for task in Session().tasks()}


def class_name(task: str) -> str:
    """`reach_target` -> `ReachTarget`"""
    return "".join(word.capitalize() for word in task.split("_"))


@cache
def task_of(name: str) -> type[Task]:
    """The class of a task that need not come with the engine: one of an Environment's `paths`."""
    if name in _names().values():
        return getattr(importlib.import_module(f"{__name__}.{name}"), class_name(name))
    return type(class_name(name), (Task,), {"task_name": name, "__module__": __name__})


def task_class(name: str) -> type[Task]:
    """The class of a task that comes with the engine, by the task's name. Raises `stampede.Error` for any other."""
    known = list(_names().values())
    if name not in known:
        raise Error(f"there is no task '{name}'{_did_you_mean(name, known)}")
    return task_of(name)


def _did_you_mean(name: str, known: list[str]) -> str:
    near = difflib.get_close_matches(name, known, 1)
    return f"\n    did you mean '{near[0]}'?" if near else ""


def __getattr__(name: str):
    if name == "__all__":
        return [*_names(), *SET_NAMES]
    if name in SET_NAMES:
        members = task_sets(list(_names().values()))[name]
        return {part: [task_of(task) for task in chosen] for part, chosen in members.items()}
    if name.startswith("_"):
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    if name not in _names():
        hint = _did_you_mean(name, [*_names(), *SET_NAMES])
        raise AttributeError(f"module '{__name__}' has no task '{name}'{hint}", name=name)
    return task_of(_names()[name])


def __dir__() -> list[str]:
    return sorted([*globals(), *_names(), *SET_NAMES])
