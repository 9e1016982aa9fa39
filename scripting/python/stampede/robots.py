"""Robots from their URDF: where links are, and what torques a motion takes. Many configurations at once, numpy only.

It is what `stampede.recordings`, `stampede.calibration` and `stampede.torque_noise` know of an arm. Units: m, rad, kg,
N m; poses are 4 x 4 matrices parent_from_child.
"""

from __future__ import annotations

import copy
import json
import xml.etree.ElementTree as ElementTree
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede.faults import fault, unknown

Array = NDArray[Any]

GRAVITY = np.array([0.0, 0.0, -9.81])  # m/s^2, in the base's frame
_TURNING, _SLIDING = ("revolute", "continuous"), ("prismatic",)
_ROBOTS = Path(__file__).parent / "engine" / "share" / "stampede" / "worlds" / "robots"


@dataclass(frozen=True)
class Joint:
    """What hangs a link from its parent."""

    name: str
    kind: str  # revolute, continuous, prismatic, fixed
    parent: str
    child: str
    origin: Array  # parent_from_joint
    axis: Array  # unit, in the joint's frame

    @property
    def moves(self) -> bool:
        return self.kind in _TURNING + _SLIDING


@dataclass(frozen=True)
class Inertia:
    mass: float  # kg
    centre: Array  # m, link
    tensor: Array  # about the centre, link's axes, kg m^2


class Robot:
    """A tree of links. hand: the link that the arm carries about; the arm's joints are those on the way to it.

    Raises Error for a file that is no URDF, and for a hand that it does not have.
    """

    def __init__(self, file: Path, hand: str = "hand") -> None:
        self.file = file
        self.name, self.joints, self.inertias, self._links = _read(file)
        self.base = next(link for link in self._links if link not in {joint.child for joint in self.joints})
        if hand not in self._links:
            raise unknown(str(file), "link", hand, self._links)
        self.hand = hand
        self._above = {joint.child: joint for joint in self.joints}
        self.arm = [joint.name for joint in self._way(hand) if joint.moves]
        self.fingers = [joint.name for joint in self.joints if joint.kind in _SLIDING and joint.name not in self.arm]

    def _way(self, link: str) -> list[Joint]:
        """Joints from the base to a link."""
        way: list[Joint] = []
        while link in self._above:
            way.append(self._above[link])
            link = way[-1].parent
            if len(way) > len(self.joints):
                raise fault(
                    str(self.file), "its links are no tree", "hang every link from one that hangs from the base"
                )
        return way[::-1]

    def poses(self, positions: Array, links: Sequence[str] | None = None) -> dict[str, Array]:
        """base_from_link of each link: n x 4 x 4. positions: n x joints of the arm; other joints are at 0."""
        positions = np.atleast_2d(positions)
        if positions.shape[1] != len(self.arm):
            raise fault(self.name, f"{positions.shape[1]} positions for {len(self.arm)} joints", ", ".join(self.arm))
        place = {name: index for index, name in enumerate(self.arm)}
        wanted = (
            None if links is None else {self.base}.union(*({one.child for one in self._way(link)} for link in links))
        )
        found = {self.base: np.broadcast_to(np.eye(4), (len(positions), 4, 4))}
        for joint in self._ordered:
            if wanted is not None and joint.child not in wanted:
                continue
            pose = found[joint.parent] @ joint.origin
            if joint.name in place:
                pose = pose @ _motion(joint, positions[:, place[joint.name]])
            found[joint.child] = pose
        return found

    def torques(self, positions: Array, velocities: Array, accelerations: Array) -> Array:
        """What the arm's motors have to give, n x joints: recursive Newton-Euler (Luh, Walker, Paul, 1980,
        doi:10.1115/1.3149599) in the base's axes. Ideal joints; other joints than the arm's are at rest."""
        poses = self.poses(positions)
        place = {name: index for index, name in enumerate(self.arm)}
        count = len(positions)
        zero = np.zeros((count, 3))
        turn, spin = {self.base: zero}, {self.base: zero}  # angular velocity and acceleration
        rise = {self.base: np.broadcast_to(-GRAVITY, (count, 3))}  # of the link's origin
        axes: dict[str, Array] = {}
        for joint in self._ordered:
            above = joint.parent
            way = poses[joint.child][:, :3, 3] - poses[above][:, :3, 3]
            w, a = turn[above], spin[above]
            lift = rise[above] + np.cross(a, way) + np.cross(w, np.cross(w, way))
            if joint.name in place:
                column = place[joint.name]
                axis = axes[joint.child] = poses[joint.child][:, :3, :3] @ joint.axis
                v, c = velocities[:, column, None] * axis, accelerations[:, column, None] * axis
                if joint.kind in _TURNING:
                    w, a = w + v, a + c + np.cross(w, v)
                else:
                    lift = lift + c + 2 * np.cross(w, v)
            turn[joint.child], spin[joint.child], rise[joint.child] = w, a, lift
        force = {link: zero for link in poses}
        moment = {link: zero for link in poses}  # about the link's origin
        result = np.zeros((count, len(self.arm)))
        for joint in reversed(self._ordered):
            link = joint.child
            rotation = poses[link][:, :3, :3]
            if link in self.inertias:
                body = self.inertias[link]
                arm = rotation @ body.centre
                w, a = turn[link], spin[link]
                push = body.mass * (rise[link] + np.cross(a, arm) + np.cross(w, np.cross(w, arm)))
                tensor = rotation @ body.tensor @ np.swapaxes(rotation, 1, 2)
                twist = _times(tensor, a) + np.cross(w, _times(tensor, w))
                force[link] = force[link] + push
                moment[link] = moment[link] + twist + np.cross(arm, push)
            way = poses[link][:, :3, 3] - poses[joint.parent][:, :3, 3]
            force[joint.parent] = force[joint.parent] + force[link]
            moment[joint.parent] = moment[joint.parent] + moment[link] + np.cross(way, force[link])
            if joint.name in place:
                pull = moment[link] if joint.kind in _TURNING else force[link]
                result[:, place[joint.name]] = np.einsum("ij,ij->i", pull, axes[link])
        return result

    def load_torques(self, positions: Array, velocities: Array, accelerations: Array) -> Array:
        """What a load in the hand takes, as a linear function of it: n x joints x 4, for its mass (kg) and its mass
        times its centre in the hand's frame (kg m). Its own inertia is left out."""

        def with_centre(centre: Array) -> Array:
            one = copy.copy(self)
            one.inertias = {self.hand: Inertia(1.0, centre, np.zeros((3, 3)))}
            return one.torques(positions, velocities, accelerations)

        columns = [with_centre(np.zeros(3))]
        for axis in 0.1 * np.eye(3):  # what is quadratic in the centre is the same on both sides
            columns.append((with_centre(axis) - with_centre(-axis)) / 0.2)
        return np.stack(columns, axis=2)

    def beyond_arm(self) -> set[str]:
        """Links that nothing of the arm moves to each other: the last joint's and what hangs from it."""
        last = next(joint for joint in self.joints if joint.name == self.arm[-1])
        return {last.child} | {link for link in self._links if last in self._way(link)}

    def only(self, link: str) -> Robot:
        """The same robot, in which one link alone has mass: torques are linear in the masses."""
        one = copy.copy(self)
        one.inertias = {link: self.inertias[link]}
        return one

    @cached_property
    def _ordered(self) -> list[Joint]:
        """Parents before children."""
        found, ordered = {self.base}, []
        left = list(self.joints)
        while left:
            ready = [joint for joint in left if joint.parent in found]
            if not ready:
                raise fault(
                    str(self.file), "its links are no tree", "hang every link from one that hangs from the base"
                )
            ordered += ready
            found |= {joint.child for joint in ready}
            left = [joint for joint in left if joint not in ready]
        return ordered


def robot_of(described: Mapping[str, Any] | str, folder: Path = Path(), hand: str = "hand") -> Robot:
    """The robot of a recording: a name of worlds/robots, or the object `robot` of recording.json."""
    if isinstance(described, str):
        described = {"name": described}
    if "urdf" in described:
        return Robot(folder / described["urdf"], described.get("tip", {}).get("link", hand))
    name = str(described.get("name", ""))
    file = _ROBOTS / f"{name}.urdf"
    if not file.exists():
        raise unknown("robot", "robot", name, sorted(one.stem for one in _ROBOTS.glob("*.urdf")))
    return Robot(file, hand)


def described_robot(text: str) -> dict[str, Any]:
    """`--robot`: a name, or a JSON file with the object `robot` of recording.json."""
    if not text.endswith(".json"):
        return {"name": text}
    try:
        described = json.loads(Path(text).read_text())
    except (OSError, ValueError) as error:
        raise fault(
            text, f"no description of a robot: {error}", 'write { "urdf": …, "arm": […], "tip": {…} }'
        ) from error
    if not isinstance(described, dict):
        raise fault(text, "an object is expected", 'write { "urdf": …, "arm": […], "tip": {…} }')
    return described


def rotation(rpy: Array) -> Array:
    """3 x 3 of roll, pitch and yaw about fixed axes, as URDF has them."""
    (sr, sp, sy), (cr, cp, cy) = np.sin(rpy), np.cos(rpy)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def _times(matrices: Array, vectors: Array) -> Array:
    return np.einsum("ijk,ik->ij", matrices, vectors)


def _motion(joint: Joint, positions: Array) -> Array:
    """joint_from_child at each position."""
    result = np.broadcast_to(np.eye(4), (len(positions), 4, 4)).copy()
    if joint.kind in _SLIDING:
        result[:, :3, 3] = positions[:, None] * joint.axis
        return result
    x, y, z = joint.axis
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])  # Rodrigues' formula
    sine, versine = np.sin(positions)[:, None, None], (1 - np.cos(positions))[:, None, None]
    result[:, :3, :3] += sine * skew + versine * (skew @ skew)
    return result


def _read(file: Path) -> tuple[str, list[Joint], dict[str, Inertia], list[str]]:
    try:
        root = ElementTree.parse(file).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise fault(str(file), f"no URDF: {error}", "name the robot's URDF file") from error
    links = [str(one.get("name")) for one in root.findall("link")]
    inertias = {}
    for element in root.findall("link"):
        inertial = element.find("inertial")
        if inertial is not None:
            inertias[str(element.get("name"))] = _inertia(inertial)
    joints = [_joint(one) for one in root.findall("joint")]
    if not links or not joints:
        raise fault(str(file), "no robot: it has no links or no joints", "name the robot's URDF file")
    for joint in joints:
        for link in (joint.parent, joint.child):
            if link not in links:
                raise unknown(f"{file} at joint {joint.name}", "link", link, links)
    return str(root.get("name", file.stem)), joints, inertias, links


def _joint(element: ElementTree.Element) -> Joint:
    ends = {}
    for end in ("parent", "child"):
        found = element.find(end)
        ends[end] = "" if found is None else str(found.get("link"))
    axis = element.find("axis")
    along = _numbers("1 0 0" if axis is None else axis.get("xyz"))
    length = np.linalg.norm(along)
    return Joint(
        str(element.get("name")),
        str(element.get("type")),
        ends["parent"],
        ends["child"],
        _pose(element.find("origin")),
        along / length if length > 0 else along,
    )


def _inertia(element: ElementTree.Element) -> Inertia:
    pose = _pose(element.find("origin"))
    mass, given = element.find("mass"), element.find("inertia")
    xx, xy, xz, yy, yz, zz = (
        0.0 if given is None else float(given.get(name, 0)) for name in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    )
    tensor = pose[:3, :3] @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ pose[:3, :3].T
    return Inertia(0.0 if mass is None else float(mass.get("value", 0)), pose[:3, 3], tensor)


def _pose(origin: ElementTree.Element | None) -> Array:
    pose = np.eye(4)
    if origin is not None:
        pose[:3, :3] = rotation(_numbers(origin.get("rpy")))
        pose[:3, 3] = _numbers(origin.get("xyz"))
    return pose


def _numbers(text: str | None) -> Array:
    return np.array([float(word) for word in (text or "0 0 0").split()])
