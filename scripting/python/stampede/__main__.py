"""The engine's program, from the package: `stampede run …`, or `python -m stampede run …`."""

from __future__ import annotations

import os
import sys

from stampede.program import PROGRAM


def run_engine() -> None:
    """Becomes the engine's program, with this program's arguments."""
    os.execv(PROGRAM, ["stampede", *sys.argv[1:]])


if __name__ == "__main__":
    run_engine()
