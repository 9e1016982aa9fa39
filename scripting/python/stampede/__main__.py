"""The engine's program, from the package: `stampede run …`, or `python -m stampede run …`."""

from __future__ import annotations

import os
import sys
from pathlib import Path


def run_engine() -> None:
    """Becomes the engine's program, with this program's arguments."""
    program = Path(__file__).parent / "engine" / "bin" / "stampede"
    os.execv(program, ["stampede", *sys.argv[1:]])


if __name__ == "__main__":
    run_engine()
