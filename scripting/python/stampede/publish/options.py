"""The command line of `python -m stampede.publish`."""

from __future__ import annotations

import argparse
import datetime
import re
from collections.abc import Sequence

from stampede.faults import fault

_WORD = r"[A-Za-z0-9][A-Za-z0-9._-]{0,95}"
_SHAPES = {  # none of them means anything to YAML, Markdown or a shell but a blank
    "name": (r"[A-Za-z0-9][A-Za-z0-9 ._-]{0,95}", "letters, digits, blanks, dots and dashes: --name 'Stacked blocks'"),
    "licence": (r"[A-Za-z0-9][A-Za-z0-9.+-]{0,63}", "an identifier of spdx.org/licenses, such as CC-BY-4.0"),
    "repository": (f"{_WORD}/{_WORD}", "the hub's USER/NAME"),
    "date": (r"\d{4}-\d\d-\d\d", "a day, such as 2026-01-31"),
}


def parse(arguments: Sequence[str] | None) -> argparse.Namespace:
    """Raises Error for what cannot be."""
    parser = argparse.ArgumentParser(
        prog="python -m stampede.publish", description="Makes a folder for a data set hub of a catalogue."
    )
    add = parser.add_argument
    add("what", nargs="*", metavar="FILE", help="catalogues, which become one; with --shipped tasks (default: all)")
    add("--out", required=True, metavar="FOLDER", help="new, or one that this made before")
    add("--name", help="what the data set is called")
    add("--licence", default="CC-BY-4.0", metavar="ID", help="of spdx.org/licenses (default: %(default)s)")
    add("--date", metavar="YYYY-MM-DD", help="when it is published: a catalogue does not know")
    add("--repository", metavar="USER/NAME", help="on the hub: the folder is uploaded there, for all to see")
    add("--dry-run", action="store_true", help="say what would be uploaded, and upload nothing")
    add("--lerobot", action="store_true", help="also as LeRobotDataset v3.0, in lerobot/")
    add("--shipped", action="store_true", help="locks of the tasks that came with the package, instead of a catalogue")
    add("--episodes", type=int, default=10, metavar="N", help="of each shipped task (default: %(default)s)")
    add("--catalogues", action="store_true", help="keep the catalogues of shipped tasks too")
    options = parser.parse_intermixed_args(arguments)
    if options.shipped:
        options.name = options.name or "Tasks of Stampede"
    _check(options)
    return options


def _check(options: argparse.Namespace) -> None:
    if not options.shipped and not options.what:
        raise fault("FILE", "no catalogue is named", "python -m stampede.publish demos.db --out FOLDER --name NAME")
    if options.shipped and options.lerobot:
        raise fault("--lerobot", "locks hold no data", "publish a catalogue, without --shipped")
    if options.catalogues and not options.shipped:
        raise fault("--catalogues", "it goes with --shipped", "leave it out: a catalogue is published as it is")
    if options.episodes < 1:
        raise fault("--episodes", f"{options.episodes} is no number of episodes", "1 or more")
    for option, (shape, cure) in _SHAPES.items():
        value = getattr(options, option)
        if value is None and option == "name":
            raise fault("--name", "it is missing", cure)
        if value is not None and not re.fullmatch(shape, value, re.ASCII):
            raise fault(f"--{option}", f"{value!r} cannot be one", cure)
    if options.date:
        try:
            datetime.date.fromisoformat(options.date)
        except ValueError as error:
            raise fault("--date", f"{options.date}: {error}", _SHAPES["date"][1]) from error
