"""Robots from their URDF: where links are, and what torques a motion takes. By Pinocchio (Carpentier et al., 2019,
doi:10.1109/SII.2019.8700380), which is imported when a robot is read.

It is what `stampede.recordings`, `stampede.calibrate` and `stampede.torque_noise` know of an arm. Units: m, rad, kg,
N m; poses are 4 x 4 matrices parent_from_child. Gravity is 9.81 m/s^2 along -z of the base.
"""

from __future__ import annotations

import copy
import json
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from stampede._core import Error
from stampede.faults import fault, unknown
from stampede.files import plain_file

Array = NDArray[Any]

_ROBOTS = Path(__file__).parent / "engine" / "share" / "stampede" / "worlds" / "robots"


def pinocchio() -> Any:
    """The library. Raises ImportError that says how to install it."""
    try:
        import pinocchio
    except ImportError as error:
        raise ImportError('Pinocchio is missing\n    pip install "stampede-sim[recordings]"') from error
    return pinocchio


class Robot:
    """A tree of links. hand: the link that the arm carries about; the arm's joints are those on the way to it.

    links: all, the base first; heavy: those that have an inertia; fingers: joints that slide and are not the arm's.
    Raises Error for a file that is no URDF, and for a hand that it does not have.
    """

    def __init__(self, file: Path, hand: str = "hand") -> None:
        self.file, self.hand = file, hand
        self._urdf, self.links = _read(file)
        self.name = str(self._urdf.get("name"))
        self.base = self.links[0]
        self.heavy = [str(link.get("name")) for link in self._urdf.findall("link") if link.find("inertial") is not None]
        self._model = model = self._model_of(self.heavy)
        if not all(model.existFrame(link, pinocchio().BODY) for link in self.links):  # some hang from each other alone
            raise _no_tree(file)
        way = [k for k in self._above(hand) if model.joints[k].nv == 1 and k > 0]
        self.arm = [str(model.names[k]) for k in way]
        self._columns = [model.joints[k].idx_v for k in way]
        sliding = [str(joint.get("name")) for joint in self._urdf.findall("joint[@type='prismatic']")]
        self.fingers = [name for name in sliding if name not in self.arm]

    def poses(self, positions: Array, links: Sequence[str] | None = None) -> dict[str, Array]:
        """base_from_link of each link: n x 4 x 4. positions: n x joints of the arm; other joints are at 0."""
        pin, model = pinocchio(), self._model
        positions = np.atleast_2d(positions)
        frames = {link: self._frame_of(link) for link in (self.links if links is None else links)}
        found = {link: np.empty((len(positions), 4, 4)) for link in frames}
        data = model.createData()
        for row, q in enumerate(self._configurations(positions)):
            pin.forwardKinematics(model, data, q)
            for link, frame in frames.items():
                found[link][row] = pin.updateFramePlacement(model, data, frame).homogeneous
        return found

    def torques(self, positions: Array, velocities: Array, accelerations: Array) -> Array:
        """What the arm's motors have to give, n x joints. Ideal joints; other joints than the arm's are at rest."""
        rnea, data = pinocchio().rnea, self._model.createData()
        states = self._states(positions, velocities, accelerations)
        each = [rnea(self._model, data, *state)[self._columns] for state in states]
        return np.array(each).reshape(positions.shape)

    def load_torques(self, positions: Array, velocities: Array, accelerations: Array) -> Array:
        """What a load in the hand takes, as a linear function of it: n x joints x 4, for its mass (kg) and its mass
        times its centre in the hand's frame (kg m). Its own inertia is left out."""
        pin, model = pinocchio(), self._model
        hand = model.frames[self._frame_of(self.hand)]

        def point(centre: Array) -> Any:
            return hand.placement.act(pin.Inertia(1.0, centre, np.zeros((3, 3)))).toDynamicParameters()

        # What is quadratic in the centre is the same on both sides.
        load = np.stack([point(np.zeros(3)), *((point(axis) - point(-axis)) / 2 for axis in np.eye(3))], axis=1)
        carrier = slice(10 * (hand.parentJoint - 1), 10 * hand.parentJoint)  # ten parameters a body
        data = model.createData()
        states = self._states(positions, velocities, accelerations)
        each = (pin.computeJointTorqueRegressor(model, data, *state).reshape(model.nv, -1) for state in states)
        return np.array([one[self._columns, carrier] @ load for one in each]).reshape(*positions.shape, 4)

    def beyond_arm(self) -> set[str]:
        """Links that nothing of the arm moves to each other: the last joint's and what hangs from it."""
        last = self._model.getJointId(self.arm[-1])
        return {link for link in self.links if last in self._above(link)}

    def only(self, link: str) -> Robot:
        """The same robot, in which one link alone has mass: torques are linear in the masses."""
        one = copy.copy(self)
        one._model = self._model_of([link])
        return one

    def _model_of(self, heavy: Collection[str]) -> Any:
        """heavy: links whose inertias count. Pinocchio lumps what is fixed to each other, so an inertia is had alone
        only by leaving out the others."""
        bare = copy.deepcopy(self._urdf)
        for link in bare.findall("link"):
            for part in list(link):
                if part.tag != "inertial" or link.get("name") not in heavy:
                    link.remove(part)
        try:
            return pinocchio().buildModelFromXML(ElementTree.tostring(bare, encoding="unicode"))
        except ValueError as error:
            raise fault(str(self.file), f"no URDF: {error}", "mend what is told on standard error") from error

    def _frame_of(self, link: str) -> int:
        """Its number in Pinocchio's model, which must not be asked for what it does not have."""
        if link not in self.links:
            raise unknown(str(self.file), "link", link, self.links)
        return int(self._model.getFrameId(link, pinocchio().BODY))

    def _above(self, link: str) -> list[int]:
        """Numbers of the joints from the base to a link, after 0."""
        return list(self._model.supports[self._model.frames[self._frame_of(link)].parentJoint])

    def _configurations(self, positions: Array) -> Iterator[Array]:
        """Of all joints, as Pinocchio has them: a continuous one is a cosine and a sine."""
        if positions.shape[1] != len(self.arm):
            raise fault(self.name, f"{positions.shape[1]} positions for {len(self.arm)} joints", ", ".join(self.arm))
        pin = pinocchio()
        zero = pin.neutral(self._model)
        return (pin.integrate(self._model, zero, row) for row in self._of_all(positions))

    def _states(self, positions: Array, velocities: Array, accelerations: Array) -> Iterator[tuple[Array, ...]]:
        moving = self._of_all(velocities), self._of_all(accelerations)
        return zip(self._configurations(positions), *moving, strict=True)

    def _of_all(self, values: Array) -> Array:
        """Of all joints: 0 where they are not the arm's."""
        result = np.zeros((len(values), self._model.nv))
        result[:, self._columns] = values
        return result


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
    plain_file(Path(text))
    try:
        described = json.loads(Path(text).read_text())
    except (OSError, ValueError) as error:
        raise fault(
            text, f"no description of a robot: {error}", 'write { "urdf": …, "arm": […], "tip": {…} }'
        ) from error
    if not isinstance(described, dict):
        raise fault(text, "an object is expected", 'write { "urdf": …, "arm": […], "tip": {…} }')
    return described


def _read(file: Path) -> tuple[ElementTree.Element, list[str]]:
    """A URDF and the names of its links, the base first."""
    plain_file(file)
    try:
        urdf = ElementTree.parse(file).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise fault(str(file), f"no URDF: {error}", "name the robot's URDF file") from error
    urdf.set("name", urdf.get("name", file.stem))
    links = [str(one.get("name")) for one in urdf.findall("link")]
    joints = urdf.findall("joint")
    if not links or not joints:
        raise fault(str(file), "no robot: it has no links or no joints", "name the robot's URDF file")
    for joint in joints:
        for end in joint.findall("parent") + joint.findall("child"):
            if end.get("link") not in links:
                raise unknown(f"{file} at joint {joint.get('name')}", "link", end.get("link", ""), links)
    hung = [end.get("link") for end in urdf.findall("joint/child")]
    if not len(hung) == len({*hung}) == len(links) - 1:  # each but the base, once
        raise _no_tree(file)
    return urdf, sorted(links, key=hung.__contains__)


def _no_tree(file: Path) -> Error:
    return fault(str(file), "its links are no tree", "hang every link from one that hangs from the base")
