"""Recordings of real robots as recording folders: `python -m stampede.recordings FORMAT SOURCE --out FOLDER`.

A format is a module here with `add_arguments` and `convert`; `--into demos.db` then imports what it wrote. `synthesize`
goes the other way: of a simulated episode it makes a recording that looks real.
"""

from __future__ import annotations

import argparse
import importlib
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Protocol

from stampede import program
from stampede.faults import fault, reading
from stampede.recordings import given as given_options
from stampede.recordings.given import Given

FORMATS = {
    "mcap": ("bag", "MCAP with ROS 2's messages, or with Foxglove's as JSON"),
    "rosbag2": ("bag", "a bag of ROS 2: its folder, or a .mcap or .db3 file"),
    "rosbag1": ("bag", "a bag of ROS 1: a .bag file"),
    "lerobot": ("lerobot", "LeRobotDataset v2.1 or v3.0: a folder an episode"),
    "robomimic": ("robomimic", "HDF5 of robomimic, LIBERO and DROID: a folder a demo"),
}
_SYNTHESIZE = "synthesize"


class Format(Protocol):
    """What a module does."""

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Its own flags."""

    def convert(self, given: Given, options: argparse.Namespace) -> list[Path]:
        """Writes recording folders and names them. Raises Error; what is not whole has no final name."""


def convert(arguments: Sequence[str] | None = None, tell: Callable[[str], None] | None = None) -> list[Path]:
    """Runs the command line; gives the folders that were written, or the bag. Raises Error for bad input."""
    options = _parse(arguments)
    say = tell or (lambda line: print(line, file=sys.stderr))
    if options.format == _SYNTHESIZE:
        return [_synthesizer().synthesize(options, say)]
    given = given_options.given_by(options, say)
    with reading(str(options.source)):
        folders = _module(options.format).convert(given, options)
    if options.into:
        import_folders(folders, Path(options.into), say)
    return folders


def import_folders(folders: Sequence[Path], catalogue: Path, tell: Callable[[str], None]) -> None:
    """Each becomes an episode of the catalogue, by the engine's program. Raises Error with what that says."""
    for folder in folders:
        command = ["import", "recording", str(folder), "--out", str(catalogue)]
        done = program.call(*command)
        for line in done.stderr.splitlines() if done.returncode == 0 else []:
            tell(line)
        if done.returncode:
            said = program.said(done)
            raise fault(str(folder), f"it was written, but not imported: {said}", " ".join(command))


def _module(name: str) -> Any:
    return importlib.import_module(f"stampede.recordings.{FORMATS[name][0]}")


def _synthesizer() -> Any:
    return importlib.import_module(f"stampede.recordings.{_SYNTHESIZE}")


def _parse(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m stampede.recordings",
        description="Writes recording folders from what robots recorded; `stampede import recording` reads them.",
    )
    formats = parser.add_subparsers(dest="format", required=True, metavar="FORMAT")
    for name, (_, what) in FORMATS.items():
        one = formats.add_parser(name, help=what, description=what)
        one.add_argument("source", metavar="SOURCE")
        given_options.add_arguments(one)
        _module(name).add_arguments(one)
    what = "a bag that looks like a real recording, of a simulated episode, and its truth"
    _synthesizer().add_arguments(formats.add_parser(_SYNTHESIZE, help=what, description=what))
    return parser.parse_args(arguments)
