"""What the command line says of every recording, whatever its form: robot, task, outcome, cameras."""

from __future__ import annotations

import argparse
import json
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede.export.steps import matrices
from stampede.faults import fault
from stampede.recordings.folder import FolderWriter
from stampede.robots import Robot, described_robot, robot_of

Json = dict[str, Any]

FRAME_HZ = 30  # of a recording that does not say it


@dataclass
class Given:
    out: Path
    robot: Robot
    described: Json  # `robot` of recording.json, without its base
    base: list[float]  # x y z, quaternion x y z w
    camera_file: Path | None
    task: str
    outcome: str
    world: str
    frame_hz: int  # 0: as the recording's form has it
    tell: Callable[[str], None]
    files: list[Path] = field(default_factory=list)  # that recording.json names
    base_said: bool = False  # by the command line

    @property
    def world_from_base(self) -> NDArray[Any]:
        return matrices(np.array([self.base]))[0]

    def document(self, about: Json, **further: Any) -> Json:
        """recording.json but for its streams. about: what the source itself says of task, success and frame_hz."""
        task = self.task or str(about.get("task", "")) or self.out.name
        outcome = self.outcome or ("failure" if str(about.get("success", "True")) == "False" else "success")
        base = {"position": self.base[:3], "quaternion": self.base[3:]}
        document: Json = {
            "task": re.sub(r"[^a-z0-9_]+", "_", task.lower()).strip("_") or "recording",
            "outcome": outcome,
            "robot": {**self.described, "base": base},
            **further,
        }
        if self.world:
            document["world"] = self.world
        if self.rate_of(about):
            document["frame_hz"] = self.rate_of(about)
        return document

    def rate_of(self, about: Json) -> int:
        """Frames a second; 0: as the recording's form has it."""
        said = float(about.get("frame_hz") or 0)
        return self.frame_hz or (int(said) if said.is_integer() else 0)

    def fit(self, segments: list[Json], about: Json, last_s: float) -> list[Json]:
        """Cut at the end of the episode's last frame; without those that take no time. last_s: the last joint state,
        since the first."""
        rate = self.rate_of(about) or FRAME_HZ
        end_s = (int(last_s * rate + 1e-6) + 1) / rate
        cut = [{**one, "end_s": min(one["end_s"], end_s)} for one in segments]
        return [one for one in cut if one["start_s"] < one["end_s"]]

    def copy_cameras(self, folder: FolderWriter, document: Json) -> bool:
        """The camera file that was named, if one was; pictures of cameras that it lacks are left out. Raises Error."""
        if self.camera_file is None:
            return False
        try:
            names = [str(one["name"]) for one in json.loads(self.camera_file.read_text())["cameras"]]
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise fault(str(self.camera_file), f"no camera file: {error}", '{"cameras": [{"name": …}]}') from error
        for camera in folder.leave_out(names):
            self.tell(
                f"camera {camera}: it is not in {self.camera_file}, so its pictures are left out; "
                f"python -m stampede.calibrate extrinsics {self.out} --camera {camera} --apply brings them in"
            )
        folder.copy(self.camera_file, "cameras.json")
        document["cameras"] = "cameras.json"
        return True

    def copy_files(self, folder: FolderWriter) -> None:
        for file in self.files:
            folder.copy(file, file.name)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--out", required=True, metavar="FOLDER", help="a new folder")
    parser.add_argument(
        "--robot",
        default="panda",
        help="of worlds/robots, or a JSON file with the object `robot` of recording.json (default: %(default)s)",
    )
    parser.add_argument(
        "--base",
        default="",
        metavar="'X Y Z [QX QY QZ QW]'",
        help="of the robot in the world, m (default: what a bag's transforms say, else 0 0 0)",
    )
    parser.add_argument(
        "--task", default="", help="what was done (default: what the source says, else the folder's name)"
    )
    parser.add_argument(
        "--outcome", choices=("success", "failure"), help="(default: what the source says, else success)"
    )
    parser.add_argument("--world", default="", help="a world of ours whose fixtures stand around")
    parser.add_argument("--frame-hz", type=int, default=0, help="frames a second of the episode")
    parser.add_argument("--cameras", metavar="FILE", help="a camera file, instead of what the source says of cameras")
    parser.add_argument("--into", metavar="DEMOS.DB", help="import it into this catalogue too")


def given_by(options: argparse.Namespace, tell: Callable[[str], None]) -> Given:
    """Raises Error for what makes no sense."""
    described = described_robot(options.robot)
    files = []
    folder = Path(options.robot).parent if options.robot.endswith(".json") else Path()
    if "urdf" in described:
        files.append(folder / described["urdf"])
        described = {**described, "urdf": files[0].name}
    camera_file = Path(options.cameras) if options.cameras else None
    if camera_file is not None and not camera_file.is_file():
        raise fault(options.cameras, "there is no such camera file", "python -m stampede.calibrate writes one")
    return Given(
        out=Path(options.out),
        robot=robot_of(described, files[0].parent if files else Path()),
        described={key: value for key, value in described.items() if key != "base"},
        base=_pose_of(options.base or "0 0 0"),
        camera_file=camera_file,
        task=options.task,
        outcome=options.outcome or "",
        world=options.world,
        frame_hz=options.frame_hz,
        tell=tell,
        files=files,
        base_said=bool(options.base),
    )


def _pose_of(text: str) -> list[float]:
    try:
        numbers = [float(word) for word in text.replace(",", " ").split()]
    except ValueError:
        numbers = []
    if len(numbers) == 3:
        numbers += [0.0, 0.0, 0.0, 1.0]
    length = float(np.linalg.norm(numbers[3:])) if len(numbers) == 7 else 0.0
    if not np.isfinite(numbers).all() or not length > 1e-6:
        raise fault("--base", f"'{text}' is no pose", "--base '-0.3 0 0.75', or with a quaternion x y z w behind it")
    return numbers[:3] + [value / length for value in numbers[3:]]
