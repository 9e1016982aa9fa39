"""What it costs to get data out of a catalogue: exports, and windows for a learner.

    PYTHONPATH=scripting/python python tests/bench/python/data_bench.py [episodes]

Makes so many episodes of pick_and_lift with the cameras front and wrist in a temporary folder. Exports are run as
commands, with all that Python loads; a window is 16 frames of joint positions and one camera at a random place.
"""

import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import stampede

EXPORTS = {
    "robomimic, no pictures": ["robomimic", "--cameras", ""],
    "rlds, no pictures": ["rlds", "--cameras", ""],
    "rlds, two cameras": ["rlds"],
    "lerobot v3.0, two cameras": ["lerobot"],
    "parquet": ["parquet"],
}
WINDOWS = 300


def seconds_to_export(catalogue: Path, out: Path, arguments: list[str]) -> float:
    name, *options = arguments
    begin = time.perf_counter()
    command = [sys.executable, "-m", "stampede.export", name, str(catalogue), "--out", str(out), *options]
    subprocess.run(command, check=True, capture_output=True)
    return time.perf_counter() - begin


def seconds_of_windows(catalogue: Path) -> list[float]:
    data = stampede.FrameDataset(str(catalogue), ["joint_positions", "front_rgb"], window=16, threads=2)
    taken = []
    for place in np.random.default_rng(0).integers(len(data), size=WINDOWS):
        begin = time.perf_counter()
        data[int(place)]
        taken.append(time.perf_counter() - begin)
    return taken


if __name__ == "__main__":
    episodes = int(sys.argv[1]) if len(sys.argv) > 1 else 50
    with tempfile.TemporaryDirectory() as folder:
        catalogue = Path(folder, "demos.db")
        pictures = {"cameras": ["front", "wrist"]}
        session = stampede.Session(catalogue=catalogue)
        session.run_all(["pick_and_lift"], episodes=episodes, workers=2, pictures=pictures)
        count = len(stampede.Catalogue(catalogue).demos())
        for i, (name, arguments) in enumerate(EXPORTS.items()):
            taken = seconds_to_export(catalogue, Path(folder, str(i)), arguments)
            print(f"{name}: {count} episodes in {taken:.1f} s, {1000 * taken / count:.0f} ms each")
        windows = seconds_of_windows(catalogue)
        print(f"window of 16 frames, one camera: median {1000 * statistics.median(windows):.1f} ms")
