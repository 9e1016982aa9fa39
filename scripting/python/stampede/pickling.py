"""What the classes of `stampede._core` do when they are pickled, or copied with the module `copy`."""

from __future__ import annotations

import copyreg
from collections.abc import Callable
from typing import Any, NoReturn

from stampede._core import Action, Environment, Episode, EpisodeArrays, Reset, SavedState, Session

_INSTEAD = {  # what to do instead, where no copy can be made
    Environment: "make another one there; stampede.Env can be pickled",
    Episode: "keep it in a catalogue, and pickle stampede.Catalogue(FILE)[NUMBER]; or its arrays",
    EpisodeArrays: "pickle {name: arrays[name] for name in arrays.keys()}, or the StoredEpisode",
    Reset: "pickle what it is made of",
    SavedState: "it is of this process: keep the seed and the actions that led there",
    Session: "make another one there, or use stampede.Catalogue, which can be pickled",
}


def _action(values: tuple[Any, ...]) -> Action:
    return Action(*values)


def _skill_call(values: tuple[Any, ...]) -> Action:
    return Action.skill_call(*values)


def _made_of(action: Action) -> tuple[Callable[..., Action], tuple[Any, ...]]:
    if action.skill:
        return _skill_call, ((action.skill, action.arguments, action.parameters, action.controller, action.frames),)
    values = (action.space, action.values, action.gripper, action.frame, action.controller, action.frames)
    return _action, (values,)


def _refuse(one: Any) -> NoReturn:
    raise TypeError(f"cannot pickle or copy {one!r}\n    {_INSTEAD[type(one)]}")


def register() -> None:
    copyreg.pickle(Action, _made_of)
    for kind in _INSTEAD:
        copyreg.pickle(kind, _refuse)
