"""What is published of a catalogue."""

from __future__ import annotations

import argparse
import json
import subprocess
from collections.abc import Callable
from pathlib import Path

from stampede import program
from stampede.catalogue import Catalogue
from stampede.export import export
from stampede.faults import fault
from stampede.publish import croissant
from stampede.publish.demos_card import FILE, LOCK, Made, card_of
from stampede.publish.tables import write_tables

# Of one that shows much.
_SHOWN = "SELECT episode FROM demos WHERE scene IS NOT NULL ORDER BY skills DESC, episode LIMIT 1"


def fill(folder: Path, options: argparse.Namespace, tell: Callable[[str], None]) -> None:
    demos = _copy([Path(file).absolute() for file in options.what], folder)
    content = json.loads(program.answer(folder, "query", FILE, "--hash", "--json"))[0]["content_hash"]
    unlocked = _lock(folder)
    shown = next((demos[row["episode"]] for row in demos.query(_SHOWN)), None)
    film = shown is not None and _draw(folder, shown.id, tell)
    if options.lerobot:
        export(["lerobot", str(folder / FILE), "--out", str(folder / "lerobot")], tell=lambda line: None)
    made = Made(demos, write_tables(folder, demos), content, unlocked, shown, film)
    what = f"{len(demos)} episodes of robot tasks in one SQLite catalogue, with skills, facts and sentences as labels."
    croissant.write(folder, options, f"{what} Content hash {content}.", content, made.tables)
    (folder / "README.md").write_text("\n".join(card_of(made, options)) + "\n", encoding="utf-8")


def _copy(files: list[Path], folder: Path) -> Catalogue:
    """All in one file. `merge` copies what lies in a file's log too, and leaves out what was deleted or is its owner's
    own; a file of several releases stays one, and several files of several releases are refused."""
    for file in files:
        if not file.is_file():
            raise fault(str(file), "there is no such file", "name catalogues that `stampede run` wrote")
        Catalogue(file)  # raises for what is none
    program.answer(folder, "merge", FILE, *files, *(["--mixed"] if len(files) == 1 else []))
    demos = Catalogue(folder / FILE)
    if not len(demos):
        raise fault(str(files[0]), "it has no episodes", "publish it once something has been run")
    return demos


def _lock(folder: Path) -> str:
    """Writes it, or says why there is none."""
    done = program.call("lock", FILE, folder=folder)
    if done.returncode == program.BAD_INPUT:
        return _first_line(done).removeprefix(f"{FILE}: ")
    if done.returncode:
        raise fault("stampede lock", _first_line(done))
    (folder / LOCK).write_text(done.stdout)
    return ""


def _draw(folder: Path, episode: int, tell: Callable[[str], None]) -> bool:
    """Whether there is a film beside the contact sheet: it needs ffmpeg's libraries."""
    program.answer(folder, "render", FILE, str(episode), "--sheet", "sheet.png")
    done = program.call("render", FILE, str(episode), "--video", "film.mp4", folder=folder)
    if done.returncode:
        (folder / "film.mp4").unlink(missing_ok=True)
        tell(f"no film, a contact sheet only: {_first_line(done)}")
    return done.returncode == 0


def _first_line(done: subprocess.CompletedProcess[str]) -> str:
    return program.said(done).split("\n")[0]
