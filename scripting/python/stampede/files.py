"""Files that are given, and files that are made, by the engine's own rules (engine/base/read_file.h, output_file.h)."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from stampede._core import Error
from stampede.faults import fault


def plain_file(path: Path) -> Path:
    """The path, for who opens it. Raises Error for a pipe or a device, which would make a reader wait for ever, and for
    a folder; what is not there, or may not be seen, is for the reader to tell."""
    if os.path.exists(path) and not path.is_file():
        raise fault(str(path), "it is no file", "name a plain file")
    return path


def inside(folder: Path, name: str) -> Path:
    """The file or folder that a document in this folder names. Raises Error where it really lies elsewhere: what was
    given by others does not read what they do not have."""
    path = folder / name
    if not path.resolve().is_relative_to(folder.resolve()):
        raise fault(str(path), f"it leads out of {folder}", "copy the file itself into the folder")
    return path


def make_folder(folder: Path) -> None:
    """With those above it, where they are missing. Raises Error where that cannot be."""
    if os.path.lexists(folder) and not folder.is_dir():
        raise fault(str(folder), "it is no folder", "name a new one")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise _unwritable(folder, error) from error


def check_new(target: Path) -> None:
    """Raises Error where something has that name, be it a link that leads nowhere. Call it ahead of long work."""
    if os.path.lexists(target):
        raise fault(str(target), "there is something of that name", "name a new one, or remove it")


@contextmanager
def made_beside(target: Path) -> Iterator[Path]:
    """A path in a new hidden folder beside `target`, for what is to get that name once it is whole: `give_name`.

    Nothing but what is in the hidden folder is removed in the end. Raises Error where there can be no such folder.
    """
    make_folder(target.parent)
    try:
        folder = tempfile.TemporaryDirectory(prefix=".stampede-", dir=target.parent)
    except OSError as error:
        raise _unwritable(target, error) from error
    with folder as name:
        yield Path(name) / "made"


def give_name(made: Path, target: Path) -> None:
    """The name, unless something has taken it meanwhile: then an Error."""
    check_new(target)
    try:
        if made.is_dir():
            made.rename(target)
            return
        try:
            os.link(made, target)  # unlike rename it replaces nothing
        except FileExistsError:
            check_new(target)
            raise
        except OSError:  # not every disk has links
            made.rename(target)
    except OSError as error:
        raise _unwritable(target, error) from error


def _unwritable(target: Path, error: OSError) -> Error:
    cure = "name another place, one that you may write to"
    return fault(str(target), f"it cannot be written: {error.strerror}", cure)
