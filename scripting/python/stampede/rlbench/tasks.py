"""
The tasks that come with the engine, one class each: `from stampede.rlbench.tasks import ReachTarget`.

FS10_V1, MT15_V1: task sets under RLBench's names, made of tasks that are there; their members are not RLBench's.
"""

import difflib
import threading
from functools import cache

from stampede._core import Error, Session
from stampede.rlbench.backend.task import Task

_TRAIN = (
    "close_drawer",
    "lift_numbered_block",
    "meat_off_grill",
    "phone_on_base",
    "pick_and_lift",
    "pick_up_cup",
    "push_buttons",
    "put_rubbish_in_bin",
    "reach_target",
    "take_lid_off_saucepan",
)
_TEST = ("meat_on_grill", "pick_and_lift_small", "put_money_in_safe", "slide_block_to_target", "unplug_charger")
_SETS: dict[str, dict[str, tuple[str, ...]]] = {
    "FS10_V1": {"train": _TRAIN, "test": _TEST},
    "MT15_V1": {"train": _TRAIN + _TEST},
}

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
        return [*_names(), *_SETS]
    if name in _SETS:
        return {part: [task_of(task) for task in tasks] for part, tasks in _SETS[name].items()}
    if name.startswith("_"):
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    if name not in _names():
        hint = _did_you_mean(name, [*_names(), *_SETS])
        raise AttributeError(f"module '{__name__}' has no task '{name}'{hint}", name=name)
    return task_of(_names()[name])


def __dir__() -> list[str]:
    return sorted([*globals(), *_names(), *_SETS])
