"""The folder that is published: whole under its name, or not there."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from stampede.faults import fault
from stampede.files import made_beside

SUMS = "SHA256SUMS"
_MARK = f"# A data set that python -m stampede.publish made: sha256sum -c {SUMS}"
_CURE = "name a new folder, or take out of this one what you want to keep"


@dataclass(frozen=True)
class File:
    name: str  # below the folder, with /
    size: int  # bytes
    sha256: str


def files_in(folder: Path) -> list[File]:
    """By name."""
    paths = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if not path.is_dir())
    return [_file(folder, name) for name in paths]


def _file(folder: Path, name: str) -> File:
    with (folder / name).open("rb") as file:
        return File(name, os.fstat(file.fileno()).st_size, hashlib.file_digest(file, "sha256").hexdigest())


@contextmanager
def made_whole(target: Path) -> Iterator[Path]:
    """An empty folder beside, which gets the name in the end. One of that name that we made is replaced.

    Raises Error where there is something else under that name: before work starts, and after it.
    """
    target = Path(os.path.abspath(target))
    _check(target)
    with made_beside(target) as half:
        half.mkdir()
        yield half
        sums = [f"{file.sha256}  {file.name}\n" for file in files_in(half)]
        (half / SUMS).write_text("".join([_MARK, "\n", *sums]))
        _check(target)
        if target.exists():
            target.rename(half.with_name("old"))
        half.rename(target)


def _check(target: Path) -> None:
    if target.is_symlink() or (target.exists() and not target.is_dir()):
        raise fault(str(target), "it is no folder", "name a new one")
    if not target.exists() or not any(target.iterdir()):
        return
    listed = (target / SUMS).read_text(errors="replace").splitlines() if (target / SUMS).is_file() else []
    if listed[:1] != [_MARK]:
        raise fault(str(target), "the folder is not empty, and no data set that this made", _CURE)
    sums = {name: digest for digest, _, name in (line.partition("  ") for line in listed[1:])}
    for path in sorted(target.rglob("*")):
        name = path.relative_to(target).as_posix()
        if path.is_symlink() or (not path.is_dir() and name != SUMS and name not in sums):
            raise fault(str(target), f"{name} is in it, which this did not make", _CURE)
    for name, digest in sums.items():
        if (target / name).is_file() and _file(target, name).sha256 != digest:
            raise fault(str(target), f"{name} is not as this made it", _CURE)
