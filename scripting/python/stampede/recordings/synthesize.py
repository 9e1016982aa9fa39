"""Recordings as real ones are, whose truth is known: of an episode of a catalogue, `synthesize DEMOS.DB --out lab.mcap`.

What the episode did is what was true. The bag has nothing of it; it is in lab.truth.json beside.
"""

from __future__ import annotations

import argparse
import json
import math
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede import program
from stampede.calibrate.boards import opencv
from stampede.catalogue import Catalogue, StoredEpisode
from stampede.export.scene import robot_base
from stampede.export.steps import is_real, matrices
from stampede.faults import fault, unknown
from stampede.files import check_new, give_name, made_beside
from stampede.recordings import sensors as sensing
from stampede.recordings.bag_writer import McapBagWriter
from stampede.recordings.pictures import packed
from stampede.recordings.sensors import Clock, Dropped, Recorder, Sensors

Array = NDArray[Any]
Json = dict[str, Any]

_QUALITY = 92  # of JPEG
_TERMS = (2, 4, 5)  # of a distortion that may be given: k1 k2, p1 p2, k3
_LENS = ("k1", "k2", "p1", "p2", "k3")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("source", metavar="DEMOS.DB", help="a catalogue")
    add("--episode", type=int, required=True, metavar="N", help="of a simulation")
    add("--out", required=True, metavar="FILE.mcap", help="a new file; the truth is beside it, FILE.truth.json")
    add("--seed", type=int, default=0, help="of all that is drawn (default: %(default)s)")
    add("--cameras", metavar="NAMES", help="front,wrist; '' none (default: those with stored pictures)")
    add("--size", metavar="WxH", help="of the pictures, which are drawn anew (default: the cameras')")
    add("--distortion", metavar="K1,K2[,P1,P2[,K3]]", help="pictures are drawn anew through such lenses")
    add("--pictures", choices=("jpeg", "png"), default="jpeg", help="png loses nothing (default: %(default)s)")
    add(
        "--clock-offset",
        type=float,
        metavar="S",
        help="what is added to cameras' stamps to have the robot's time "
        f"(default: drawn, at most {sensing.CLOCK_OFFSET_S})",
    )
    add(
        "--drift",
        type=float,
        metavar="PPM",
        help=f"by which it grows (default: drawn, at most {sensing.DRIFT_PPM:.0f})",
    )
    add(
        "--latency",
        default=",".join(map(str, sensing.LATENCY_S)),
        metavar="S[,S]",
        help="from a picture to its log time, or from least to most (default: %(default)s)",
    )
    add(
        "--drop",
        type=float,
        default=sensing.DROP,
        metavar="FRACTION",
        help="of pictures that get lost; of joint states a third of it (default: %(default)s)",
    )
    add(
        "--noise",
        type=float,
        default=1.0,
        metavar="FACTOR",
        help="of what sensors add to joints, torques, pixels and stamps; 0: nothing (default: %(default)s)",
    )
    add(
        "--joint-offset",
        type=float,
        default=sensing.JOINT_OFFSET_DEG,
        metavar="DEG",
        help="by which joints read beside the truth, at most (default: %(default)s)",
    )
    add("--joints-every", type=int, default=1, metavar="FRAMES", help="a joint state (default: %(default)s)")
    add("--pictures-every", type=int, default=1, metavar="FRAMES", help="a picture (default: %(default)s)")


def synthesize(options: argparse.Namespace, tell: Callable[[str], None]) -> Path:
    """Writes the bag and its truth; gives the bag. Raises Error for bad input; then there is neither."""
    out = Path(options.out)
    truth_file = _truth_file(out)
    size, distortion = _size(options.size), _distortion(options.distortion)
    recorder = _recorder(options)
    episode = _episode(options)
    joints = sensing.joint_names(episode)
    views = [_view(episode, camera, size, distortion) for camera in _cameras(episode, options.cameras)]
    anew = size is not None or distortion is not None
    sensors = _sensors(options, len(joints), [view["name"] for view in views])
    if views and (anew or options.pictures == "jpeg"):
        opencv()  # raises at once where it is missing
    encode = as_jpeg if options.pictures == "jpeg" else as_png
    rng = np.random.default_rng([options.seed, 4])
    with tempfile.TemporaryDirectory() as folder, made_beside(truth_file) as made:
        with McapBagWriter(out) as bag:
            pictures = _Renderer(episode, views, Path(folder)).pictures if anew else sensing.drawn_pictures(episode)
            dropped = sensing.record(bag, episode, sensors, recorder, rng, pictures, encode)
            truth = _truth(options, episode, joints, sensors, recorder, views, dropped)
            made.write_text(json.dumps(truth, indent=1) + "\n")
        give_name(made, truth_file)
    lost = sum(map(len, dropped.pictures.values()))
    tell(
        f"{out}: {episode.frames} frames, {len(views)} cameras; {lost} pictures and {len(dropped.joints)} joint "
        f"states were lost; the truth is in {truth_file}"
    )
    return out


def _truth_file(out: Path) -> Path:
    if out.suffix != ".mcap":
        raise fault("--out", f"'{out}' is no name of a bag", "--out lab.mcap")
    truth = out.with_suffix(".truth.json")
    for file in (out, truth):
        check_new(file)
    if not out.parent.is_dir():
        raise fault(str(out), f"there is no folder {out.parent}", f"mkdir -p {out.parent}")
    return truth


def _within(flag: str, value: float, least: float, most: float) -> float:
    if not least <= value <= most:  # nor is NaN
        raise fault(flag, f"{value:g} is not within {least:g} … {most:g}", f"{flag} {min(max(1, least), most):g}")
    return value


def _recorder(options: argparse.Namespace) -> Recorder:
    words = _numbers("--latency", options.latency, (1, 2))
    for one in words:
        _within("--latency", one, 0, 10)
    if words[0] > words[-1]:
        raise fault("--latency", f"'{options.latency}' has the most first", f"--latency {words[1]:g},{words[0]:g}")
    return Recorder(
        noise=_within("--noise", options.noise, 0, 20),
        drop=_within("--drop", options.drop, 0, 0.9),
        latency_s=(words[0], words[-1]),
        joints_every=int(_within("--joints-every", options.joints_every, 1, 10_000)),
        pictures_every=int(_within("--pictures-every", options.pictures_every, 1, 10_000)),
    )


def _sensors(options: argparse.Namespace, joints: int, cameras: Sequence[str]) -> Sensors:
    seed = int(_within("--seed", options.seed, 0, 2**63 - 1))
    most_deg = _within("--joint-offset", options.joint_offset, 0, 10)
    drawn = sensing.draw_sensors(np.random.default_rng([seed, 1]), joints, cameras, most_deg, options.noise)
    offset, drift = options.clock_offset, options.drift
    if offset is not None:
        _within("--clock-offset", offset, -10, 10)
    if drift is not None:
        _within("--drift", drift, -1000, 1000)
    clocks = {
        name: Clock(one.offset_s if offset is None else offset, one.drift_ppm if drift is None else drift)
        for name, one in drawn.clocks.items()
    }
    return Sensors(drawn.torque, drawn.drift_time_s, drawn.joint_offsets, clocks)


def _numbers(flag: str, text: str, counts: tuple[int, ...]) -> list[float]:
    try:
        numbers = [float(word) for word in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) not in counts or not all(map(math.isfinite, numbers)):
        wanted = " or ".join(map(str, counts))
        raise fault(flag, f"'{text}' is not {wanted} numbers", f"{flag} {','.join(['0.05'] * counts[0])}")
    return numbers


def _distortion(text: str | None) -> list[float] | None:
    """k1 k2 p1 p2 k3; None: none was given."""
    if text is None:
        return None
    numbers = _numbers("--distortion", text, _TERMS)
    for one in numbers:
        _within("--distortion", one, -1, 1)
    return (numbers + [0.0] * 5)[:5]


def _episode(options: argparse.Namespace) -> StoredEpisode:
    episode = Catalogue(options.source)[options.episode]
    place = f"{options.source}, episode {episode.id}"
    if is_real(episode):
        raise fault(place, "it is a real one, whose truth nobody knows", "name an episode of a simulation")
    if episode.frames < 2:
        raise fault(place, "it has one frame only", "name an episode in which the arm moves")
    return episode


def _cameras(episode: StoredEpisode, named: str | None) -> list[str]:
    known = [str(one) for one in episode.table("cameras").values("camera")]
    if named is None:
        stored = [camera for camera in known if episode.stored_pictures.get(f"{camera}_rgb")]
        if not stored:
            cure = f"--cameras {known[0]} draws them now, " if known else ""
            place = f"{episode.catalogue.path}, episode {episode.id}"
            raise fault(place, "no pictures of it are stored", f"{cure}--cameras '' leaves pictures out")
        return stored
    names = [one for one in named.split(",") if one]
    for name in names:
        if name not in known:
            raise unknown(f"{episode.catalogue.path}, episode {episode.id}", "camera", name, known)
    return list(dict.fromkeys(names))


def _view(episode: StoredEpisode, camera: str, size: tuple[int, int] | None, distortion: list[float] | None) -> Json:
    """The camera as pictures are of it: its entry in a camera file."""
    row = next(one for one in episode.table("cameras") if one["camera"] == camera)
    stored = episode.catalogue.query(
        "SELECT width, height, focal_x, focal_y, centre_x, centre_y FROM images "
        "WHERE episode = ?1 AND camera = ?2 AND kind = 'rgb'",
        episode.id,
        camera,
        limit=1,
    )
    row |= next(iter(stored), {})
    width, height = size or (row["width"], row["height"])
    matrix = [[row["focal_x"], 0.0, row["centre_x"]], [0.0, row["focal_y"], row["centre_y"]], [0.0, 0.0, 1.0]]
    if size is not None:
        matrix = episode.picture(0, camera, width=width, height=height)["intrinsics"].tolist()
    pose = np.array([[row[name] for name in ("x", "y", "z", "qx", "qy", "qz", "qw")]])
    mount = str(row["mount"])
    robot = episode.arrays("joint_positions").column("joint_positions").labels[0].split(".")[0]
    return {
        "name": camera,
        "width": width,
        "height": height,
        "camera_matrix": matrix,
        "distortion": distortion or [row[name] for name in _LENS],
        "pixel_centres": "half",
        "mount": mount if mount == "world" else "robot." + mount.removeprefix(f"{robot}."),
        "mount_from_camera": matrices(pose)[0].tolist(),
        "near": row["near_m"],
        "far": row["far_m"],
    }


def _size(text: str | None) -> tuple[int, int] | None:
    if text is None:
        return None
    words = text.split("x")
    if len(words) != 2 or not all(word.isdecimal() and 16 <= int(word) <= 4096 for word in words):
        raise fault("--size", f"'{text}' is no size of 16x16 … 4096x4096 pixels", "--size 640x480")
    return int(words[0]), int(words[1])


class _Renderer:
    """Pictures through lenses that the episode's cameras do not have, by the engine's program."""

    def __init__(self, episode: StoredEpisode, views: Sequence[Json], folder: Path) -> None:
        self._episode, self._folder, self._cv2 = episode, folder, opencv()
        self._entries = {view["name"]: view for view in views}
        self._cameras = folder / "cameras.json"
        self._cameras.write_text(json.dumps({"cameras": list(self._entries.values())}))

    def pictures(self, camera: str, frames: Sequence[int]) -> Array:
        """n x height x width x 3, uint8."""
        with tempfile.TemporaryDirectory(dir=self._folder) as out:
            size = "{width}x{height}".format(**self._entries[camera])
            self._run("--out", out, "--camera", camera, "--size", size, "--frames", ",".join(map(str, frames)))
            files = sorted(Path(out).rglob("*.png"))
            if len(files) != len(frames):
                raise fault(f"camera {camera}", f"{len(files)} of {len(frames)} pictures were drawn", "--cameras NAMES")
            return np.stack([self._cv2.imread(str(file))[..., ::-1] for file in files])

    def _run(self, *further: str) -> None:
        command = ["render", str(self._episode.catalogue.path), str(self._episode.id), "--kinds", "rgb"]
        command += ["--camera-file", str(self._cameras), *further]
        done = program.call(*command)
        if done.returncode:
            raise fault(f"episode {self._episode.id}", f"its pictures cannot be drawn anew: {program.said(done)}", "")


def as_jpeg(picture: Array) -> tuple[bytes, str]:
    """Its file and the name of the form. picture: height x width x 3, uint8. Needs OpenCV."""
    cv2 = opencv()
    return cv2.imencode(".jpg", picture[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, _QUALITY])[1].tobytes(), "jpeg"


def as_png(picture: Array) -> tuple[bytes, str]:
    return packed(picture), "png"


def _truth(
    options: argparse.Namespace,
    episode: StoredEpisode,
    joints: Sequence[str],
    sensors: Sensors,
    recorder: Recorder,
    views: Sequence[Json],
    dropped: Dropped,
) -> Json:
    base = robot_base(episode).tolist()
    told = {"episode": episode.id, "task": episode.task, "seed": episode.seed, "frames": episode.frames}
    offsets = sensors.joint_offsets.tolist()
    return {
        "catalogue": episode.catalogue.path.name,
        **told,
        "frame_hz": episode.frame_hz,
        "drawn_by_seed": options.seed,
        "start_s": sensing.EPOCH_S,  # stamp of frame 0 on the robot's clock
        "base": {"position": base[:3], "quaternion": base[3:]},
        "joint_offsets_rad": dict(zip(joints, offsets, strict=True)),
        "torque": {name: values.tolist() for name, values in sensors.torque.items()},
        "torque_drift_time_s": sensors.drift_time_s,
        "clocks": {  # as recording.json has them
            name: {"offset_s": one.offset_s, "drift_ppm": one.drift_ppm, "reference_s": sensing.EPOCH_S}
            for name, one in sensors.clocks.items()
        },
        "noise": recorder.noise,
        "latency_s": list(recorder.latency_s),
        "drop": recorder.drop,
        "dropped_frames": {"joints": dropped.joints, **dropped.pictures},
        "camera_file": {"cameras": list(views)},
    }
