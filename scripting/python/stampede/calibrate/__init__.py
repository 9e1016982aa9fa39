"""Cameras calibrated from pictures of a board: `python -m stampede.calibrate WHAT SOURCE --board BOARD`.

`intrinsics` finds a lens, `extrinsics` where cameras are in the robot's base or on its links, what clocks and joints
are off by, each with its standard deviation. Needs OpenCV: `pip install "stampede[calibrate]"`.
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
from stampede.calibrate.lens import Lens, find_lens, lens_from
from stampede.calibrate.recorded import Recording
from stampede.calibrate.setup import Camera, FixedBoard, Seen, locate, start
from stampede.export.steps import matrices
from stampede.faults import fault, unknown
from stampede.robots import Robot

Json = dict[str, Any]

_LENSES = "lenses.json"
_MOST_OFF = 3.0  # pixels, the median corner
_MOST_OFFSET = np.radians(5)  # of a joint
_ENDINGS = (".png", ".jpg", ".jpeg")


def calibrate(arguments: Sequence[str] | None = None) -> tuple[str, Json]:
    """Runs the command line; gives what it found, in words and as JSON. Raises Error for bad input."""
    options = _parse(arguments)
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
    return _lens_words(camera, lens, out), {
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


def _lens_words(camera: str, lens: Lens, out: Path) -> str:
    d = lens.deviations
    assert d is not None and lens.errors is not None
    bent = "  ".join(
        f"{name} {value:.4f} ± {sd:.4f}"
        for name, value, sd in zip(("k1", "k2", "p1", "p2", "k3"), lens.distortion, d[4:], strict=True)
    )
    return "\n".join(
        [
            f"camera {camera}: {lens.width} x {lens.height}, {lens.pictures} pictures, reprojection error "
            f"{lens.rms:.3f} pixels "
            f"(worst picture {lens.errors.max():.3f})",
            f"  focal length {lens.focal[0]:.2f} ± {d[0]:.2f}, {lens.focal[1]:.2f} ± {d[1]:.2f} pixels",
            f"  centre {lens.centre[0]:.2f} ± {d[2]:.2f}, {lens.centre[1]:.2f} ± {d[3]:.2f} pixels",
            f"  distortion {bent}",
            f"  written to {out}",
        ]
    )


# Poses


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
    return _pose_words(result, recording), report


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
        if not number.isdigit() or not 1 <= int(number) <= len(boards) or len(numbers) != 7:
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
    try:
        return {str(one["name"]): one for one in json.loads(Path(file).read_text())["cameras"]}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise fault(file, f"no camera file: {error}", "python -m stampede.calibrate intrinsics writes one") from error


def _link(mount: str, robot: Robot) -> str:
    """`world` is the robot's base, which stands."""
    if mount == "world":
        return robot.base
    name = mount.removeprefix("robot.")
    links = [robot.base, *(joint.child for joint in robot.joints)]
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


def _pose_words(result: Result, recording: Recording) -> str:
    lines = []
    for one in result.cameras:
        at, sd = 1e3 * one.pose[:3, 3], one.pose_deviation
        lines += [
            f"camera {one.name} on {one.mount}: {one.pictures} pictures, {one.corners} corners, reprojection error "
            f"{one.rms:.3f} pixels (median {one.median:.3f})",
            f"  at {at[0]:.1f} {at[1]:.1f} {at[2]:.1f} mm, ± {1e3 * sd[:3].max():.1f} mm, ± "
            f"{np.degrees(sd[3:].max()):.3f} degrees",
            f"  clock: {1e3 * one.offset_s:+.2f} ± {1e3 * one.offset_deviation_s:.2f} ms, "
            f"{one.drift_ppm:+.0f} ± {one.drift_deviation_ppm:.0f} ppm",
            f"  focal length {one.lens.focal[0]:.2f} ± {one.lens_deviation[0]:.2f}, centre {one.lens.centre[0]:.2f} "
            f"{one.lens.centre[1]:.2f} ± {one.lens_deviation[2:4].max():.2f} pixels",
            "  worst pictures: " + ", ".join(f"{rms:.2f} pixels at {time:.2f} s" for time, rms in one.worst),
        ]
    lines.append("joints, to be added to what they read:")
    for name, offset, sd, free in zip(
        recording.robot.arm, result.offsets, result.offset_deviations, result.freed, strict=True
    ):
        found = f"{np.degrees(offset):+.3f} ± {np.degrees(sd):.3f} degrees" if free else "taken as it is"
        lines.append(f"  {name}: {found}")
    return "\n".join(lines)


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


def _parse(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m stampede.calibrate", description=__doc__.partition("\n")[0])
    kinds = parser.add_subparsers(dest="what", required=True, metavar="WHAT")
    lens = kinds.add_parser("intrinsics", help="focal length, centre and distortion")
    poses = kinds.add_parser("extrinsics", help="where cameras are; clocks; joints")
    for one in (lens, poses):
        one.add_argument(
            "source", metavar="SOURCE", help="a recording folder" + (", or one of pictures" if one is lens else "")
        )
        one.add_argument(
            "--board",
            action="append",
            required=True,
            help="charuco:5x4:0.05:0.037:4X4_50 (squares, m), "
            "checkerboard:9x6:0.025, aruco:7:0.08:4X4_50; for extrinsics with @LINK or @world (default: @hand)",
        )
        one.add_argument(
            "--camera", action="append", default=[], help="name; for extrinsics with @LINK (default: @world)"
        )
        one.add_argument(
            "--most", type=int, default=300, help="pictures looked at, evenly chosen (default: %(default)s)"
        )
        one.add_argument("--out", metavar="FILE", help="a camera file")
        one.add_argument("--json", action="store_true")
    lens.add_argument("--k3", action="store_true", help="look for k3 too: wide lenses")
    poses.add_argument("--lens", metavar="FILE", help="camera file with the lenses (default: that of the recording)")
    poses.add_argument("--keep-lens", action="store_true", help="do not refine it")
    poses.add_argument("--keep-joints", action="store_true", help="joints read the truth")
    poses.add_argument(
        "--search", type=float, default=0.5, metavar="S", help="clocks differ by at most so much (default: %(default)s)"
    )
    poses.add_argument(
        "--board-at",
        action="append",
        default=[],
        metavar="'N=X Y Z QX QY QZ QW'",
        help="the N-th board's pose in its mount is known: frees the first or last joint's offset",
    )
    poses.add_argument("--board-sd", default="0.0005,0.05", metavar="M,DEGREES", help="how well (default: %(default)s)")
    poses.add_argument("--apply", action="store_true", help="write cameras and clocks into the recording")
    poses.add_argument(
        "--apply-joints", action="store_true", help="and correct its joint positions; those measured are kept"
    )
    return parser.parse_args(arguments)
