"""What a release has promised of the package is still there: scripting/RELEASES.md says what that is."""

from __future__ import annotations

import importlib
import inspect
import os
from collections.abc import Iterator
from pathlib import Path

import stampede

MODULES = ["stampede", "stampede.cluster", "stampede.export", "stampede.rlbench"]


def names_of(place: str, value: object) -> Iterator[str]:
    """The name, its parameters, and what a class has."""
    yield place
    if inspect.isclass(value):
        for owner in value.__mro__:
            for name, inner in vars(owner).items() if owner.__module__.startswith("stampede") else ():
                if not name.startswith("_"):
                    yield from names_of(f"{place}.{name}", inner)
    elif inspect.isfunction(value):
        for parameter in inspect.signature(value).parameters.values():
            mark = {parameter.VAR_POSITIONAL: "*", parameter.VAR_KEYWORD: "**"}.get(parameter.kind, "")
            yield f"{place}({mark}{parameter.name})"


def names_now() -> set[str]:
    names = set()
    for module in map(importlib.import_module, MODULES):
        public = getattr(module, "__all__", None) or [name for name in dir(module) if not name.startswith("_")]
        for name in public:
            value = getattr(module, name)
            if str(getattr(value, "__module__", "")).startswith("stampede"):
                names |= set(names_of(f"{module.__name__}.{name}", value))
    return names


def test_what_this_release_has_promised_is_still_there() -> None:
    now = names_now()
    assert {
        "stampede.Session.run_all",
        "stampede.cluster.generate(executor)",
        "stampede.Catalogue.query(question)",
    } <= now
    version = stampede._core.__version__.rsplit(".", 1)[0]
    file = Path(__file__).parent / "promised" / f"{version}.txt"
    if "STAMPEDE_PROMISE" in os.environ:  # .ci/release
        file.parent.mkdir(exist_ok=True)
        file.write_text("".join(f"{name}\n" for name in sorted(now)))
    promised = set(file.read_text().split("\n")) - {""}
    assert len(promised) > 200
    assert sorted(promised - now) == [], "a name that goes takes a new version: see scripting/RELEASES.md"
