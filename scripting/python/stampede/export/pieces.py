"""Episodes as finished pieces in a hidden folder, of which a dataset is put together at the end."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

_PIECES = ".pieces"


class Pieces:
    """One folder a piece, which has its name once all of it has been written."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder / _PIECES

    def has(self, number: int) -> bool:
        return self.of(number).is_dir()

    def of(self, number: int) -> Path:
        return self._folder / f"{number:06d}"

    @contextmanager
    def making(self, number: int) -> Iterator[Path]:
        """A folder to write into; it is the piece when the block ends well."""
        partial = self._folder / f"{number:06d}.partial"
        shutil.rmtree(partial, ignore_errors=True)
        partial.mkdir(parents=True)
        yield partial
        partial.rename(self.of(number))

    def remove(self) -> None:
        shutil.rmtree(self._folder, ignore_errors=True)


def place(piece: Path, final: Path) -> None:
    """Gives a file its name in the dataset too. It stays in its piece, so that `finish` may be repeated."""
    final.parent.mkdir(parents=True, exist_ok=True)
    final.unlink(missing_ok=True)
    try:
        os.link(piece, final)
    except OSError:  # not every file system has links
        partial = final.with_name(final.name + ".part")
        shutil.copyfile(piece, partial)
        partial.replace(final)
