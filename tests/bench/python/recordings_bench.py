"""What is recovered of recordings whose truth is known (laboratory.py), and how fast recordings come in.

recordings_bench.py recover [SEEDS] [SECONDS]     a table, a row a seed
recordings_bench.py speed [MINUTES] [jpeg|raw]    MCAP with two cameras to a catalogue
recordings_bench.py import [MINUTES] [jpeg|png] [PROGRAM…]   recording folders to a catalogue, by each program in turn
"""

from __future__ import annotations

import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
from laboratory import Truth, record, torque_errors
from laboratory_scripts import BASE, DICTIONARY, MARKER_M, SQUARE_M, SQUARES

import stampede
from stampede import torque_noise
from stampede.calibrate import calibrate
from stampede.calibrate.bundle import pose_error
from stampede.recordings import convert, import_folders
from stampede.recordings.folder import FolderWriter
from stampede.recordings.pictures import packed

BOARD = f"charuco:{SQUARES[0]}x{SQUARES[1]}:{SQUARE_M}:{MARKER_M}:{DICTIONARY[5:]}"


def recovered(folder: Path, seed: int, seconds: float) -> dict[str, float]:
    """Errors of what calibration finds, and how alike torques are."""
    truth = record(folder, seed, seconds)
    recording = folder / "recording"
    at = " ".join(map(str, BASE))
    convert(["mcap", str(folder / "bag"), "--out", str(recording), "--base", at], tell=lambda line: None)
    calibrate(["intrinsics", str(recording), "--board", BOARD])
    _, found = calibrate(["extrinsics", str(recording), "--board", BOARD, "--apply-joints"])
    errors = pose_errors(truth, found, seconds)
    noise_file = folder / "noise.json"
    _, noise = torque_noise.main([str(recording), "--out", str(noise_file)])
    fitted = torque_noise.fit(torque_noise.Recording(recording, corrected=True))
    noise_file.write_text(json.dumps({**json.loads(noise_file.read_text()), "recorded_s": 0}))  # the same cold start
    alike = torque_noise.comparison(fitted.residuals, torque_errors(folder, seed, noise_file), fitted.noise.joints)
    width = [np.ptp(np.array(one["quantiles_nm"])[[1, 5]]) for one in alike]
    other = [np.ptp(np.array(one["other_quantiles_nm"])[[1, 5]]) for one in alike]
    for name in ("coulomb", "white"):
        errors[f"{name} %"] = 100 * float(np.abs(getattr(fitted.noise, name) / truth.torque[name] - 1).max())
    return errors | {
        "load kg": noise["load_kg"],
        "KS": max(one["distance"] for one in alike),
        "5-95 % width": float(np.abs(np.array(other) / width - 1).max() * 100),
    }


def pose_errors(truth: Truth, found: dict[str, Any], seconds: float) -> dict[str, float]:
    """The base's x axis is where joint 1 reads 0, so the true camera is turned by what it reads beside the truth."""
    camera, entry = found["cameras"][0], found["camera_file"][0]
    turn = np.eye(4)
    sine, cosine = np.sin(-truth.joint_offsets[0]), np.cos(truth.joint_offsets[0])
    turn[:2, :2] = [[cosine, -sine], [sine, cosine]]
    base = np.eye(4)
    base[:3, 3] = BASE
    true = base @ turn @ np.linalg.inv(base) @ truth.world_from_camera
    way, angle = pose_error(np.array(entry["mount_from_camera"]), true)
    reference = camera["clock"]["reference_s"] - 1_700_000_000
    offset = truth.camera_offset_s + truth.drift_ppm * 1e-6 * reference
    joints = np.array([one["offset_rad"] for one in found["joints"]])[1:-1] - truth.joint_offsets[1:-1]
    return {
        "true offset ms": 1e3 * truth.camera_offset_s,
        "offset ms": 1e3 * abs(camera["clock"]["offset_s"] - offset),
        "drift ppm": abs(camera["clock"]["drift_ppm"] - truth.drift_ppm),
        "pose mm": 1e3 * way,
        "pose deg": float(np.degrees(angle)),
        "joints deg": float(np.degrees(np.abs(joints).max())),
        "focal px": abs(entry["camera_matrix"][0][0] - truth.matrix[0, 0]),
        "rms px": camera["rms_pixels"],
    }


def recover(seeds: int, seconds: float) -> None:
    rows = []
    for seed in range(1, seeds + 1):
        folder = Path(tempfile.mkdtemp()) / "laboratory"
        rows.append(recovered(folder, seed, seconds))
        shutil.rmtree(folder.parent)
        if seed == 1:
            print("| seed | " + " | ".join(rows[0]) + " |")
            print("|---" * (len(rows[0]) + 1) + "|")
        print(f"| {seed} | " + " | ".join(f"{value:.3g}" for value in rows[-1].values()) + " |", flush=True)
    print("| worst | " + " | ".join(f"{max(row[name] for row in rows):.3g}" for name in rows[0]) + " |")


def pictures() -> list[Any]:
    """Thirty of 640 x 480: blots, and the noise of a sensor."""
    import cv2

    rng = np.random.default_rng(0)
    blots = [cv2.GaussianBlur(rng.integers(0, 255, (480, 640, 3), dtype=np.uint8), (0, 0), 5) for _ in range(30)]
    noise = rng.normal(0, 4, (480, 640, 3))
    return [np.clip((one.astype(float) - 127) * 6 + 127 + noise, 0, 255).astype(np.uint8) for one in blots]


def as_jpeg(picture: Any) -> bytes:
    import cv2

    return cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, 85])[1].tobytes()


def write_folder(path: Path, minutes: float, form: str) -> None:
    """A recording folder: joint states at 100 Hz, two cameras at 30."""
    files = [as_jpeg(one) if form == "jpeg" else packed(one) for one in pictures()]
    ending = "jpg" if form == "jpeg" else "png"
    home = np.array([0, -np.pi / 4, 0, -3 * np.pi / 4, 0, np.pi / 2, np.pi / 4])
    with FolderWriter(path) as folder:
        joints = folder.series("joints", [f"joint{k}_position_rad" for k in range(1, 8)], "robot")
        cameras = [folder.pictures("rgb", name, "robot") for name in ("front", "wrist")]
        for tick in range(int(minutes * 60 * 300)):  # 300 Hz: both rates divide it
            stamp = tick * 10**9 // 300
            if tick % 3 == 0:
                joints.row(stamp, (home + 0.2 * np.sin(tick / 300 + np.arange(7))).tolist())
            if tick % 10 == 0:
                for stream, pictures_folder in cameras:
                    stream.picture(stamp, pictures_folder, files[tick // 10 % 30], ending)
        folder.finish({"task": "bench", "outcome": "success", "frame_hz": 30, "robot": {"name": "panda"}})
    print(f"{form}: {np.mean([len(one) for one in files]) / 1e3:.0f} kB a picture")


def import_speed(minutes: float, form: str, programs: list[str]) -> None:
    """Each program three times, in turn: wall and processor time, and what is stored must agree."""
    folder = Path(tempfile.mkdtemp())
    write_folder(folder / "recording", minutes, form)
    size = sum(one.stat().st_size for one in (folder / "recording").rglob("*") if one.is_file())
    hashes = set()
    for _ in range(3):
        for program in programs:
            catalogue = folder / "demos.db"
            os.sync()
            before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.time()
            subprocess.run(
                [program, "import", "recording", str(folder / "recording"), "--out", str(catalogue)],
                check=True,
                capture_output=True,
            )
            after, wall = resource.getrusage(resource.RUSAGE_CHILDREN), time.time() - begin
            user, system = after.ru_utime - before.ru_utime, after.ru_stime - before.ru_stime
            print(
                f"{program}: {size / 1e9:.2f} GB in {wall:.1f} s wall, {user:.1f} s user, {system:.1f} s system, "
                f"at most {after.ru_maxrss / 1e3:.0f} MB so far",
                flush=True,
            )
            told = subprocess.run([program, "query", str(catalogue), "--hash"], check=True, capture_output=True)
            hashes.add(told.stdout)
            catalogue.unlink()
    shutil.rmtree(folder)
    assert len(hashes) == 1, "the programs do not store the same"


def speed(minutes: float, form: str) -> None:
    """Pictures of 640 x 480, 30 a second of each camera, as JPEG or as raw pixels; joint states at 100 Hz."""
    from ros_bag import RosBag

    folder = Path(tempfile.mkdtemp())
    shown = pictures()
    files = [as_jpeg(one) for one in shown]
    names = [f"panda_joint{k}" for k in range(1, 8)] + ["panda_finger_joint1", "panda_finger_joint2"]
    home = np.array([0, -np.pi / 4, 0, -3 * np.pi / 4, 0, np.pi / 2, np.pi / 4, 0.03, 0.03])
    with RosBag(folder / "bag") as bag:
        for tick in range(int(minutes * 60 * 300)):  # 300 Hz: both rates divide it
            stamp = 1_700_000_000 * 10**9 + tick * 10**9 // 300
            if tick % 3 == 0:
                q = home + np.array([0.2] * 7 + [0.0] * 2) * np.sin(tick / 300 + np.arange(9))
                bag.joint_state("/joint_states", stamp, stamp, names, q, np.zeros(9), np.zeros(9))
            if tick % 10 == 0:
                for camera in ("front", "wrist"):
                    which, log = tick // 10 % 30, stamp + 10**7
                    if form == "raw":
                        bag.image(f"/{camera}/image_raw", stamp, log, "rgb8", shown[which], camera)
                    else:
                        bag.compressed(f"/{camera}/image/compressed", stamp, log, "jpeg", files[which], camera)
                    if tick == 0:
                        bag.camera_info(
                            f"/{camera}/camera_info",
                            stamp,
                            stamp,
                            (640, 480),
                            np.array([[600, 0, 320], [0, 600, 240], [0, 0, 1.0]]),
                            np.zeros(5),
                            camera,
                        )
                        bag.transform("/tf_static", stamp, stamp, "world", camera, [1, 0, 1.5, 0.0, 0.0, 0.0, 1.0])
    size = sum(one.stat().st_size for one in (folder / "bag").iterdir()) / 1e6
    each = shown[0].nbytes if form == "raw" else np.mean([len(one) for one in files])
    print(f"bag: {size:.0f} MB, pictures of {each / 1e3:.0f} kB")
    begin, cpu = time.time(), time.process_time()
    convert(["mcap", str(folder / "bag"), "--out", str(folder / "recording"), "--frame-hz", "30"], tell=print)
    print(f"MCAP to a recording folder: {time.time() - begin:.1f} s wall, {time.process_time() - cpu:.1f} s CPU")
    begin = time.time()
    import_folders([folder / "recording"], folder / "demos.db", print)
    print(f"recording folder to a catalogue: {time.time() - begin:.1f} s wall")
    shutil.rmtree(folder)


if __name__ == "__main__":
    what, *numbers = sys.argv[1:] or ["recover"]
    if what in ("speed", "import"):
        minutes = float(numbers[0]) if numbers else 10
        form = numbers[1] if len(numbers) > 1 else "jpeg"
        if form not in ("jpeg", "raw" if what == "speed" else "png"):
            sys.exit(__doc__)
        ours = str(Path(stampede.__file__).parent / "engine" / "bin" / "stampede")
        if what == "speed":
            speed(minutes, form)
        else:
            import_speed(minutes, form, numbers[2:] or [ours])
    else:
        recover(int(numbers[0]) if numbers else 5, float(numbers[1]) if len(numbers) > 1 else 60)
