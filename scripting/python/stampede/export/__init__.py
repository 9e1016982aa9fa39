"""Datasets in the formats that trainers read: `python -m stampede.export FORMAT demos.db --out FOLDER`.

A format is a module here with a class `Writer`. The rest is shared: which episodes, splits, progress, and that an
export which was cut off goes on where it stopped, with the episodes that it began with and nothing half done under a
final name.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib
import json
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Protocol

from stampede import files
from stampede.catalogue import Catalogue, StoredEpisode
from stampede.export import steps
from stampede.faults import fault, unknown

FORMATS = {
    "robomimic": "HDF5 of robomimic (arXiv:2108.03298), which robosuite and many trainers read",
    "libero": "HDF5 of LIBERO (arXiv:2306.03310)",
    "mimicgen": "source demonstrations of MimicGen (arXiv:2310.17596), with subtask signals from our segments",
    "maniskill": "trajectories of ManiSkill (arXiv:2410.00425): HDF5 and JSON",
    "lerobot": "LeRobotDataset v3.0, or v2.1: parquet and videos",
    "rlds": "RLDS as in Open X-Embodiment (arXiv:2310.08864): TFRecord files for tfds",
    "mcap": "MCAP files with Foxglove's schemas, one an episode",
    "rlbench": "RLBench's folders of pictures and pickled demos",
    "parquet": "the catalogue's own views as tables of Parquet, for DuckDB, pandas and Spark",
}

_MANIFEST = "stampede-export.json"


class Writer(Protocol):
    """What a format does. Made once for an export; episodes come one after the other, in the catalogue's order."""

    def __init__(self, folder: Path, options: argparse.Namespace, episodes: Sequence[StoredEpisode]) -> None: ...

    @staticmethod
    def add_arguments(parser: argparse.ArgumentParser) -> None:
        """The format's own flags."""

    def has(self, episode: StoredEpisode) -> bool:
        """Whether an export that was cut off has written all of it."""

    def write(self, episode: StoredEpisode) -> None:
        """All of it, or nothing that a later `has` takes for it."""

    def finish(self) -> None:
        """What needs all episodes; files get their final names here."""

    def close(self) -> None:
        """Lets go of files, after `finish` or after an error."""


def split_of(episode: StoredEpisode, valid: float) -> str:
    """`train`, `valid` or `test`: the catalogue's split, and of its training episodes a share that depends on each
    episode's task and seed alone; on the key of a real one."""
    if episode.split != "train":
        return episode.split
    name = f"{episode.task} {episode.variation} {episode.seed}"
    if steps.is_real(episode):
        name = f"{episode.task} {steps.key_of(episode)}"
    digest = hashlib.sha256(name.encode()).digest()
    return "valid" if int.from_bytes(digest[:8], "big") < valid * 2**64 else "train"


def cameras_of(episode: StoredEpisode, options: argparse.Namespace) -> list[str]:
    """Cameras whose colours are wanted and can be had: those named, else those with a picture of every frame."""
    stored = [
        name.removesuffix("_rgb")
        for name, frames in episode.stored_pictures.items()
        if name.endswith("_rgb") and len(frames) == episode.frames
    ]
    if options.cameras is None:
        return sorted(stored)
    known = episode.table("cameras").values("camera")
    for camera in options.cameras:
        if camera not in known:
            raise unknown(f"episode {episode.id}", "camera", camera, map(str, known))
        if camera not in stored and not options.draw:
            raise fault(
                f"episode {episode.id}",
                f"not every picture of camera '{camera}' is stored",
                "add --draw to draw what is missing, or store it: `stampede render FILE --into`",
            )
    return list(options.cameras)


def common_cameras(episodes: Sequence[StoredEpisode], options: argparse.Namespace) -> list[str]:
    """The cameras of all of these. Raises Error where they differ: readers expect the same keys of all episodes."""
    first = episodes[0]
    cameras = cameras_of(first, options)
    for episode in episodes[1:]:
        others = cameras_of(episode, options)
        if others != cameras:
            theirs, expected = (", ".join(names) or "no camera" for names in (others, cameras))
            raise fault(
                f"episode {episode.id}",
                f"its stored pictures are those of {theirs}, but of {expected} in episode {first.id}",
                "--cameras NAMES says which are wanted, '' none; with --draw what is missing is drawn",
            )
    return cameras


def export(arguments: Sequence[str] | None = None, tell: Callable[[str], None] | None = None) -> int:
    """Runs the command line; gives the number of episodes in the dataset. Raises Error for bad input."""
    options = _parse(arguments)
    catalogue = Catalogue(options.catalogue)
    folder = Path(options.out)
    fitting = catalogue.episodes(options.where)[: options.limit]
    episodes = _begun(folder, options, catalogue)
    begins = not episodes
    if begins:
        episodes = fitting
    if not episodes:
        raise fault(
            options.catalogue,
            f"no episode fulfils `{options.where}`",
            "`stampede show FILE` lists them; --where takes a condition on view `episodes`",
        )
    if begins and getattr(options, "channels", None):
        steps.channels_of(episodes[0], episodes[0].arrays(*options.channels), options.channels)  # raises for a bad one
    writer: Writer = _module(options.format).Writer(folder, options, episodes)
    try:
        if begins:
            _begin(folder, options, episodes)
        progress = _Progress(len(episodes), tell)
        for episode in episodes:
            if not writer.has(episode):
                writer.write(episode)
            progress.one_more(episode)
        writer.finish()
    finally:
        writer.close()
    (folder / _MANIFEST).unlink()
    progress.end(folder, later=len({one.id for one in fitting} - {one.id for one in episodes}))
    return len(episodes)


def _module(name: str) -> Any:
    return importlib.import_module(f"stampede.export.{name}")


def _parse(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m stampede.export", description="Writes episodes of a catalogue as a dataset of another format."
    )
    formats = parser.add_subparsers(dest="format", metavar="FORMAT", required=True)
    named = next((one for one in (sys.argv[1:] if arguments is None else arguments) if one in FORMATS), None)
    for name, text in FORMATS.items():
        one = formats.add_parser(name, help=text, description=text)
        one.add_argument("catalogue", help="file that `stampede run` wrote")
        one.add_argument("--out", required=True, metavar="FOLDER", help="where the dataset goes")
        one.add_argument(
            "--where",
            default="outcome = 'success'",
            metavar="SQL",
            help="which episodes: a condition on view `episodes` (default: %(default)s)",
        )
        one.add_argument("--limit", type=int, metavar="N", help="at most so many episodes")
        if name != "parquet":  # it has what the catalogue has
            _add_learners_arguments(one, channels=name != "rlbench")  # what is in its demos is fixed
        if name == named:  # other formats may need libraries that are not there
            _module(name).Writer.add_arguments(one)
    options = parser.parse_args(arguments)
    if not 0 <= getattr(options, "valid", 0) < 1:
        raise fault("--valid", f"{options.valid} is no share", "from 0 up to but not including 1")
    return options


def _add_learners_arguments(parser: argparse.ArgumentParser, channels: bool) -> None:
    """What the learner that reads a dataset wants in it."""
    parser.add_argument(
        "--cameras",
        type=lambda text: [camera for camera in text.split(",") if camera],
        metavar="NAMES",
        help="comma-separated, or '' for none (default: those with a stored picture of every frame)",
    )
    if channels:
        parser.add_argument(
            "--channels",
            type=lambda text: [channel for channel in text.split(",") if channel],
            default=[],
            metavar="NAMES",
            help="further columns of numbers, such as joint_forces,facts,object_pose (engine/episode/README.md)",
        )
    parser.add_argument("--draw", action="store_true", help="draw pictures that are not stored")
    parser.add_argument(
        "--valid", type=float, default=0.1, metavar="SHARE", help="of the training episodes (default: %(default)s)"
    )


def _begun(folder: Path, options: argparse.Namespace, catalogue: Catalogue) -> list[StoredEpisode]:
    """The episodes of the export that was cut off in the folder; empty: none was.

    Raises Error where it was another export, or another catalogue lies in that place now, or the folder is in use.
    """
    if os.path.lexists(folder) and not folder.is_dir():
        raise fault(str(folder), "it is no folder", "name a new one")
    if not (folder / _MANIFEST).exists():
        may_grow = getattr(_module(options.format), "may_grow", None)
        if folder.exists() and any(folder.iterdir()) and not (may_grow and may_grow(folder)):
            raise fault(str(folder), "the folder is not empty", "name a new one")
        return []
    asked, begun_with = _manifest_in(folder)
    if asked != _asked(options):
        raise fault(
            str(folder),
            "another export was cut off here",
            f"give the options of {folder / _MANIFEST} to go on with it, or name another folder",
        )
    known = {episode.id: episode for episode in catalogue.episodes()}
    episodes = [known[number] for number, _ in begun_with if number in known]
    if _keys(catalogue, episodes) != begun_with:
        raise fault(str(folder), f"{options.catalogue} is not the file that it began with", "name another folder")
    return episodes


def _manifest_in(folder: Path) -> tuple[Any, list[list[Any]]]:
    """What an export was asked for, and number and key of its episodes. Raises Error where it does not say that."""
    file = files.plain_file(folder / _MANIFEST)
    try:
        manifest = json.loads(file.read_text())
        return manifest["options"], [[int(number), str(key)] for number, key in manifest["episodes"]]
    except (OSError, ValueError, KeyError, TypeError, RecursionError) as error:
        what = f"it is damaged, or not of an export that was cut off ({type(error).__name__}: {error})"
        raise fault(str(file), what, "name another folder, or remove this one") from error


def _begin(folder: Path, options: argparse.Namespace, episodes: Sequence[StoredEpisode]) -> None:
    """Notes what the export is of: the same command goes on with these episodes, whatever comes to the catalogue."""
    files.make_folder(folder)
    manifest = {"options": _asked(options), "episodes": _keys(episodes[0].catalogue, episodes)}
    partial = folder / f"{_MANIFEST}.part"
    partial.write_text(json.dumps(manifest, indent=1))
    partial.replace(folder / _MANIFEST)


def _asked(options: argparse.Namespace) -> dict[str, Any]:
    """The command line, as JSON has it."""
    asked = {key: value for key, value in sorted(vars(options).items()) if key != "out"}
    return asked | {"catalogue": str(Path(options.catalogue).resolve())}


def _keys(catalogue: Catalogue, episodes: Sequence[StoredEpisode]) -> list[list[Any]]:
    """Number and key of each."""
    rows = {row["episode"]: row["key"] for row in catalogue.query("SELECT episode, key FROM episodes")}
    return [[episode.id, rows[episode.id]] for episode in episodes]


class _Progress:
    """One line on the terminal that changes; nothing where standard error is no terminal, but the end."""

    def __init__(self, total: int, tell: Callable[[str], None] | None) -> None:
        self.total, self.done, self.tell = total, 0, tell
        self.live = tell is None and sys.stderr.isatty()

    def one_more(self, episode: StoredEpisode) -> None:
        self.done += 1
        start = f"{episode.variation} seed {episode.seed}" if episode.seed is not None else f"episode {episode.id}"
        line = f"[{self.done}/{self.total}] {episode.task} {start}"
        if self.tell:
            self.tell(line)
        elif self.live:
            print(f"\r\033[K{line[:100]}", end="", file=sys.stderr, flush=True)

    def end(self, folder: Path, later: int) -> None:
        """later: how many episodes came to the catalogue after the export had begun."""
        line = f"{self.total} episodes in {folder}" + (f"; {later} that came later are not" if later else "")
        if self.tell:
            self.tell(line)
        else:
            print(f"\r\033[K{line}" if self.live else line, file=sys.stderr)
