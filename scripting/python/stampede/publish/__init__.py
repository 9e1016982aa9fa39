"""A catalogue as a folder for a data set hub: `python -m stampede.publish demos.db --out FOLDER --name NAME`.

The folder has the layout of Hugging Face: the card (README.md), the catalogue, its lock, tables of episodes and
segments, a film, Croissant's metadata, and hashes of all. The same catalogue gives the same files. With --repository
it is uploaded, unless --dry-run is said. `--shipped` makes a set of our own: a lock of each task that came along.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from stampede.publish import demos, hub, shipped
from stampede.publish.folder import files_in, made_whole
from stampede.publish.options import parse

__all__ = ["publish"]


def publish(arguments: Sequence[str] | None = None, tell: Callable[[str], None] = print) -> Path:
    """Runs the command line; gives the folder. Raises Error for bad input; nothing half made has its final name."""
    options = parse(arguments)
    library = hub.ready(options.repository) if options.repository and not options.dry_run else None
    folder = Path(options.out)
    with made_whole(folder) as half:
        (shipped if options.shipped else demos).fill(half, options, tell)
    files = files_in(folder)
    if not options.date:
        tell("no --date: croissant.json does not say when it was published")
    if options.dry_run:
        for file in files:
            tell(f"{file.size:>12} {file.name}")
    if library:
        hub.upload(library, folder, options.repository)
    where = f"uploaded to {options.repository}" if library else f"in {folder}, nothing uploaded"
    tell(f"{len(files)} files, {sum(file.size for file in files)} bytes {where}")
    return folder
