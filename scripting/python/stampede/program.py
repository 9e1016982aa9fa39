"""The engine's program, which is in the package, called."""

from __future__ import annotations

import subprocess
from pathlib import Path

from stampede.faults import fault

PROGRAM = Path(__file__).parent / "engine" / "bin" / "stampede"
BAD_INPUT = 3  # exit code: it can be read, and is not what the command is for


def call(*words: str | Path, folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    """`stampede WORDS…`: in the folder, where one is given, so that what it says names no place outside."""
    command = [str(PROGRAM), *map(str, words)]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, errors="replace", check=False)


def said(done: subprocess.CompletedProcess[str]) -> str:
    """Its error, with the cure on further lines."""
    return done.stderr.strip().removeprefix("error: ") or f"exit code {done.returncode}"


def answer(folder: Path, *words: str | Path) -> str:
    """What it prints. Raises Error with what it says where it fails."""
    done = call(*words, folder=folder)
    if done.returncode:
        what, _, cure = done.stderr.strip().partition("\n")
        raise fault(f"stampede {words[0]}", what or f"exit code {done.returncode}", cure.strip())
    return done.stdout
