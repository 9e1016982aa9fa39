"""HDF5 files of others: what is in the file alone is read, and what it holds is told with its key."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede.export.hdf5 import library
from stampede.faults import fault
from stampede.files import plain_file

Array = NDArray[Any]
Json = dict[str, Any]

_NUMBERS = "fiub"  # kinds of types in NumPy


@contextmanager
def opened(source: str) -> Iterator[Any]:
    """The file, open. Raises Error where anything in it lies in another file: bytes of files that whoever gave this one
    does not have would land in the recording."""
    with library().File(plain_file(Path(source)), "r") as file:
        _check_whole(file, source)
        yield file


def _check_whole(file: Any, source: str) -> None:
    h5py = library()
    links: list[tuple[bytes, int]] = []
    file.id.links.visit(lambda name, link: links.append((name, link.type)), info=True)
    for name, kind in links:
        if kind == h5py.h5l.TYPE_SOFT:  # to another place in the file
            continue
        what = _elsewhere(h5py, file, name) if kind == h5py.h5l.TYPE_HARD else "it is a link to another file"
        if what:
            cure = "copy all of it into one file"
            raise fault(f"{source}, {name.decode(errors='backslashreplace')}", what, cure)


def _elsewhere(h5py: Any, file: Any, name: bytes) -> str:
    """Where a dataset's data are, if not in the file."""
    one = h5py.h5o.open(file.id, name)
    if not isinstance(one, h5py.h5d.DatasetID):
        return ""
    made = one.get_create_plist()
    if made.get_layout() == h5py.h5d.VIRTUAL:
        return "it is virtual: its data are those of other datasets"
    return "its data lie in another file" if made.get_external_count() else ""


def numbers(group: Any, key: str, place: str, rows: int | None = None, columns: int | None = None) -> Array:
    """A dataset of numbers, float64. rows, columns: that it must have; columns 0: those it has, laid flat. Raises
    Error, with the key, for another."""
    place = f"{place}, {key}"
    there = group.get(key) if hasattr(group, "keys") else None
    if there is None:
        raise fault(place, "it is not there", "record it, or name another file")
    shape = getattr(there, "shape", None)
    if shape is None or there.dtype.kind not in _NUMBERS:
        raise fault(place, "it is no array of numbers", "store floats")
    if rows is not None and shape[:1] != (rows,):
        count = shape[0] if shape else 1
        raise fault(place, f"it has {count} rows, and there are {rows} steps", "store a row a step, or leave it out")
    if columns and shape[1:] != (columns,):
        raise fault(place, f"its rows are of shape {shape[1:]}, and {columns} numbers are expected", "leave it out")
    values = np.asarray(there, dtype=float)
    return values.reshape(rows or 0, -1) if columns == 0 else values


def attribute(of: Any, key: str, place: str) -> Any:
    """As Python has it: numbers, truth values, text. Raises Error for arrays and the like; None: it is not there."""
    value = of.attrs.get(key)
    if isinstance(value, np.ndarray | np.generic) and np.size(value) == 1:
        value = value.item()
    if isinstance(value, bytes):
        value = value.decode(errors="replace")
    if value is not None and not isinstance(value, str | bool | int | float):
        raise fault(f"{place}, attribute {key}", "it is no number and no text", "write one value, or leave it out")
    return value


def truth(said: Any, place: str) -> bool:
    """Of a truth value, a number, or a word: whatever wrote the file has its own. Raises Error for another."""
    known = {"true": True, "1": True, "success": True, "false": False, "0": False, "failure": False}
    word = str(said).lower().removesuffix(".0")
    if word not in known:
        raise fault(place, f"{said!r} says neither yes nor no", "write true or false")
    return known[word]


def described(of: Any, key: str, place: str) -> Json:
    """An attribute that is a JSON object; empty where it is not there, or null. Raises Error for another."""
    text = attribute(of, key, place)
    if text is None:
        return {}
    try:
        value = json.loads(text)
    except (TypeError, ValueError, RecursionError) as error:
        raise _no_object(place, key, f"it is no JSON: {error}") from error
    if value is not None and not isinstance(value, dict):
        raise _no_object(place, key, f"it is JSON, but no object: {str(text)[:40]}")
    return value or {}


def _no_object(place: str, key: str, what: str) -> Exception:
    return fault(f"{place}, attribute {key}", what, 'write { "…": … }, or leave it out')
