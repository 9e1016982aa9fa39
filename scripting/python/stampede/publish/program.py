"""The engine's program, called."""

from __future__ import annotations

import subprocess
from pathlib import Path

from stampede import _core
from stampede.faults import fault

BAD_INPUT = 3  # exit code: it can be read, and is not what the command is for


def call(folder: Path, *words: str | Path) -> subprocess.CompletedProcess[str]:
    """`stampede WORDS…` in the folder, so that what it says names no place outside."""
    program = Path(_core.__file__).parent / "engine" / "bin" / "stampede"
    return subprocess.run([program, *words], cwd=folder, capture_output=True, text=True, errors="replace", check=False)


def said(done: subprocess.CompletedProcess[str]) -> str:
    """Its error, without the cure."""
    return done.stderr.strip().split("\n")[0].removeprefix("error: ") or f"exit code {done.returncode}"


def answer(folder: Path, *words: str | Path) -> str:
    """What it prints. Raises Error with what it says where it fails."""
    done = call(folder, *words)
    if done.returncode:
        what, _, cure = done.stderr.strip().partition("\n")
        raise fault(f"stampede {words[0]}", what or f"exit code {done.returncode}", cure.strip())
    return done.stdout
