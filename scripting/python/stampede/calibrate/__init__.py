"""Cameras calibrated from pictures of a board: `python -m stampede.calibrate WHAT SOURCE --board BOARD`.

`intrinsics` finds a lens, `extrinsics` where cameras are in the robot's base or on its links, what clocks and joints
are off by, each with its standard deviation. Needs OpenCV and Pinocchio: `pip install "stampede-sim[calibrate]"`.
"""

from __future__ import annotations

import argparse
import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from stampede.calibrate.apply import apply, write_whole
from stampede.calibrate.boards import Board, sightings
from stampede.calibrate.bundle import Bundle, CameraResult, Result
from stampede.calibrate.lens import find_lens, lens_from
from stampede.calibrate.options import parse
from stampede.calibrate.recorded import Recording
from stampede.calibrate.problem import Camera, FixedBoard, Seen, locate, start
from stampede.calibrate.words import lens_words, pose_words
from stampede.export.steps import matrices
from stampede.faults import fault, reading, unknown
from stampede.files import plain_file
from stampede.robots import Robot

Json = dict[str, Any]

_LENSES = "lenses.json"
_MOST_OFF = 3.0  # pixels, the median corner
_MOST_OFFSET = np.radians(5)  # of a joint
_ENDINGS = (".png", ".jpg", ".jpeg")


def calibrate(arguments: Sequence[str] | None = None) -> tuple[str, Json]:
    """Runs the command line; gives what it found, in words and as JSON. Raises Error for bad input."""
    options = parse(arguments)
    with reading(str(options.source)):
        words, report = (_intrinsics if options.what == "intrinsics" else _extrinsics)(options)
    return (json.dumps(report, indent=1) if options.json else words), report


# A lens


def _intrinsics(options: argparse.Namespace) -> tuple[str, Json]:
    source = Path(options.source)
    board = Board(options.board[0])
    is_recording = (source / "recording.json").is_file()
    if is_recording:
        recording = Recording(source)
        camera = options.camera[0] if options.camera else _only(recording.cameras(), source)
        files = recording.pictures(camera).files
    else:
        camera = options.camera[0] if options.camera else "camera"
        files = sorted(one for one in source.glob("*") if one.suffix.lower() in _ENDINGS)
        if not files:
            raise fault(
                str(source), "there are no pictures in it", "name a folder of PNG or JPEG files, or a recording"
            )
    if not re.fullmatch(r"[a-z][a-z0-9_]*", camera):
        raise fault("--camera", f"'{camera}' is not a name", "use small letters, digits and _, a letter first")
    seen, size = sightings(board, _some(files, options.most))
    lens = find_lens([one for _, one in seen], size, str(source), options.k3)
    out = Path(options.out) if options.out else (source if is_recording else Path()) / _LENSES
    _put_lens(out, lens.entry(camera))
    return lens_words(camera, lens, out), {
        "camera": lens.entry(camera),
        "rms_pixels": lens.rms,
        "pictures": lens.pictures,
        "deviations": _numbers(lens.deviations),
        "file": str(out),
    }


def _put_lens(file: Path, entry: Json) -> None:
    """Into a file of lenses, where another camera's stay."""
    known = json.loads(file.read_text()).get("cameras", []) if file.is_file() else []
    write_whole(file, {"cameras": [one for one in known if one.get("name") != entry["name"]] + [entry]})


def _extrinsics(options: argparse.Namespace) -> tuple[str, Json]:
    recording = Recording(Path(options.source))
    robot = recording.robot
    boards = _boards(options, robot)
    cameras = _cameras(options, recording, robot)
    seen: list[Seen] = []
    for number, camera in enumerate(cameras):
        pictures = recording.pictures(camera.name)
        chosen = _places(len(pictures.files), options.most)
        for index, board in enumerate(boards):
            found, size = sightings(Board(board.text), [pictures.files[k] for k in chosen])
            if found and size != (camera.lens.width, camera.lens.height):
                raise fault(
                    f"camera {camera.name}",
                    f"its pictures are {size[0]} x {size[1]}, its lens is of "
                    f"{camera.lens.width} x {camera.lens.height}",
                    "calibrate the lens at this size",
                )
            seen += [Seen(number, index, float(pictures.times[chosen[place]]), sight) for place, sight in found]
    seen = locate(seen, cameras)
    start(robot, recording.joints, cameras, boards, seen, options.search)
    result = Bundle(
        robot, recording.joints, cameras, boards, seen, not options.keep_lens, not options.keep_joints
    ).solve()
    _check(result)
    report = _report(result, recording)
    if options.out:
        write_whole(Path(options.out), {"cameras": report["camera_file"]})
    if options.apply or options.apply_joints:
        apply(recording, result, report, with_joints=options.apply_joints)
    return pose_words(result, recording), report


def _boards(options: argparse.Namespace, robot: Robot) -> list[FixedBoard]:
    boards = []
    for text in options.board:
        spec, _, mount = text.partition("@")
        Board(spec)  # raises for one that there is not
        boards.append(FixedBoard(spec, _link(mount or robot.hand, robot)))
    metres, degrees = _pair(options.board_sd, "--board-sd")
    for text in options.board_at:
        number, _, pose = text.partition("=")
        numbers = [float(word) for word in pose.split()] if re.fullmatch(r"[-+0-9.e ]+", pose) else []
        if not number.isdecimal() or not 1 <= int(number) <= len(boards) or len(numbers) != 7:
            raise fault(
                "--board-at",
                f"'{text}' is no pose of a board",
                "--board-at '1=X Y Z QX QY QZ QW', in its mount's frame, m",
            )
        boards[int(number) - 1].pose = matrices(np.array([numbers]))[0]
        boards[int(number) - 1].deviation = (metres, float(np.radians(degrees)))
    return boards


def _cameras(options: argparse.Namespace, recording: Recording, robot: Robot) -> list[Camera]:
    known = _file_entries(options.lens)
    cameras = []
    for text in options.camera or [_only(recording.cameras(), recording.folder)]:
        name, _, mount = text.partition("@")
        if name not in recording.cameras():
            raise unknown(str(recording.file), "camera with colours", name, recording.cameras())
        entry = known.get(name) or recording.lens_entry(name)
        if entry is None:
            raise fault(
                f"camera {name}",
                "nothing is known of its lens",
                f"python -m stampede.calibrate intrinsics {recording.folder} --camera {name} --board …; or --lens FILE",
            )
        cameras.append(Camera(name, _link(mount or "world", robot), lens_from(entry)))
    return cameras


def _file_entries(file: str | None) -> dict[str, Json]:
    if file is None:
        return {}
    plain_file(Path(file))
    try:
        return {str(one["name"]): one for one in json.loads(Path(file).read_text())["cameras"]}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise fault(file, f"no camera file: {error}", "python -m stampede.calibrate intrinsics writes one") from error


def _link(mount: str, robot: Robot) -> str:
    """`world` is the robot's base, which stands."""
    if mount == "world":
        return robot.base
    name = mount.removeprefix("robot.")
    links = robot.links
    if name not in links:
        raise unknown("@", "link", name, ["world", *links])
    return name


def _check(result: Result) -> None:
    """Raises Error where the answer is worth nothing."""
    for camera in result.cameras:
        way, turn = camera.pose_deviation[:3].max(), camera.pose_deviation[3:].max()
        if not np.isfinite(way) or way > 0.05 or turn > 0.1:
            raise fault(
                f"camera {camera.name}",
                f"the pictures do not say where it is: ± {1e3 * way:.0f} mm, ± {np.degrees(turn):.1f} degrees",
                "turn the hand about two axes, by 20 degrees and more, all over the picture",
            )
        if camera.median > _MOST_OFF:
            raise fault(
                f"camera {camera.name}",
                f"corners are {camera.median:.1f} pixels beside where they should be",
                "check the board's size, what it is fixed to (@hand, @world), and the robot",
            )
    worst = float(np.abs(result.offsets).max())
    if worst > _MOST_OFFSET:
        raise fault(
            "joints",
            f"one would read {np.degrees(worst):.1f} degrees beside the truth, which no joint does",
            "check the board's size, what it is fixed to (@hand, @world), and the robot; --keep-joints",
        )


def _report(result: Result, recording: Recording) -> Json:
    world_from_base = matrices(np.array([recording.base], dtype=float))[0]
    entries, cameras = [], []
    for one in result.cameras:
        stands = one.mount == recording.robot.base
        pose = world_from_base @ one.pose if stands else one.pose
        mount = "world" if stands else f"robot.{one.mount}"
        entries.append({**one.lens.entry(one.name), "mount": mount, "mount_from_camera": pose.tolist()})
        cameras.append(
            {
                "camera": one.name,
                "pose_deviation_m_rad": _numbers(one.pose_deviation),
                "clock": _clock(one, recording),
                "offset_deviation_s": one.offset_deviation_s,
                "drift_deviation_ppm": one.drift_deviation_ppm,
                "rms_pixels": one.rms,
                "median_pixels": one.median,
                "pictures": one.pictures,
                "corners": one.corners,
            }
        )
    joints = [
        {"joint": name, "offset_rad": float(offset), "deviation_rad": float(sd), "fixed": not free}
        for name, offset, sd, free in zip(
            recording.robot.arm, result.offsets, result.offset_deviations, result.freed, strict=True
        )
    ]
    boards = [
        {"mount_from_board": pose.tolist(), "deviation_m_rad": _numbers(sd)}
        for pose, sd in zip(result.boards, result.board_deviations, strict=True)
    ]
    return {"camera_file": entries, "cameras": cameras, "joints": joints, "boards": boards, "rms_pixels": result.rms}


def _clock(one: CameraResult, recording: Recording) -> Json:
    """As recording.json has it."""
    return {
        "offset_s": one.offset_s,
        "drift_ppm": one.drift_ppm,
        "reference_s": one.reference_s + recording.zero_ns / 1e9,
    }


def _numbers(values: Any) -> list[float]:
    return [float(one) for one in values]


def _only(cameras: list[str], place: Path) -> str:
    if len(cameras) != 1:
        raise fault(str(place), f"it has {len(cameras)} cameras: {', '.join(cameras)}", "--camera NAME")
    return cameras[0]


def _places(count: int, most: int) -> list[int]:
    return sorted({int(k) for k in np.linspace(0, count - 1, min(count, most))}) if count else []


def _some(files: list[Path], most: int) -> list[Path]:
    return [files[k] for k in _places(len(files), most)]


def _pair(text: str, flag: str) -> tuple[float, float]:
    try:
        first, second = (float(word) for word in text.split(","))
    except ValueError:
        first = second = 0.0
    if not (first > 0 and second > 0):
        raise fault(flag, f"'{text}' is no pair of numbers above 0", f"{flag} 0.0005,0.05")
    return first, second
