"""Which topic of a bag is what: by its type, its name and its first message, or as `--map` says."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import islice

import numpy as np

from stampede.faults import fault, unknown
from stampede.recordings.bags import Bag, Topic
from stampede.recordings.messages import KINDS, JointReading, PictureReading, decoder, type_name
from stampede.robots import Robot

# Words that name no camera in `/front/color/image_raw/compressed`.
_PLAIN = re.compile(
    r"(image|color|colour|rgb|depth|infra\d?|raw|rect|registered|compressed|compresseddepth|camera_info|calibration|"
    r"aligned|to|info|_)+"
)
_DEPTHS = ("16UC1", "mono16", "32FC1", "compressedDepth")
_LOOKED_AT = 2000  # messages of a topic, for the names in it
MAPPED = ("joints", "gripper", "rgb", "depth", "lens", "wrench")


@dataclass
class Roles:
    joints: str = ""
    gripper: str = ""  # topic of joint states with the fingers, where it is another one; empty: none
    arm: tuple[str, ...] = ()  # what the bag calls the arm's joints
    measured: tuple[str, ...] = ()  # what it says of them beside positions: velocity, effort
    fingers: tuple[str, ...] = ()  # what it calls the joints of the fingers
    pictures: dict[str, tuple[str, str]] = field(default_factory=dict)  # topic -> rgb or depth, camera
    lenses: dict[str, str] = field(default_factory=dict)  # topic -> camera
    wrenches: dict[str, str] = field(default_factory=dict)  # topic -> name
    transforms: set[str] = field(default_factory=set)
    segments: set[str] = field(default_factory=set)

    def all(self) -> set[str]:
        named = {self.joints, self.gripper, *self.pictures, *self.lenses, *self.wrenches}
        return (named | self.transforms | self.segments) - {""}


def parse_map(texts: Sequence[str]) -> dict[str, str]:
    """`rgb.front=/topic`, …: what -> topic; `rgb=none`: nothing of this kind. Raises Error."""
    mapped: dict[str, str] = {}
    for text in texts:
        for one in text.split(","):
            what, equals, topic = one.partition("=")
            kind, _, name = what.partition(".")
            if kind not in MAPPED:
                raise unknown(f"--map {one}", "kind of stream", kind, MAPPED)
            needs_name = kind not in ("joints", "gripper") and topic != "none"
            if not equals or not topic or (needs_name and not re.fullmatch(r"[a-z][a-z0-9_]*", name)):
                raise fault(
                    f"--map {one}", "it says no topic", "joints=/joint_states, rgb.front=/camera/image_raw, rgb=none"
                )
            mapped[what] = topic
    return mapped


def prefixes_of(joints: Sequence[str], names: Collection[str]) -> list[str]:
    """What stands before the URDF's names of all these joints, `panda_`; empty: the names are the same."""
    first = [name.removesuffix(joints[0]) for name in names if name.endswith(joints[0])]
    return sorted(one for one in first if _ends_a_word(one) and all(one + joint in names for joint in joints))


def the_prefix(joints: Sequence[str], names: Collection[str], wanted: str | None, place: str) -> str | None:
    """The one prefix of all these joints, or the one that is wanted; None: there is none. Raises Error for several."""
    prefixes = [one for one in prefixes_of(joints, names) if wanted in (None, one)]
    if len(prefixes) > 1:
        several = ", ".join(f"'{one}'" for one in prefixes)
        cure = f"--prefix {prefixes[-1]} says which one it is"
        raise fault(place, f"several arms have these joints, with the prefixes {several}", cure)
    return prefixes[0] if prefixes else None


def _ends_a_word(prefix: str) -> bool:
    return not prefix or prefix[-1] in "._/"


def camera_name(topic: str) -> str:
    """`/camera/front/image` -> front, `/camera/color/image_raw` -> camera."""
    words = [word for word in topic.lower().split("/") if word and not _PLAIN.fullmatch(word)]
    name = re.sub(r"[^a-z0-9_]", "_", words[-1]) if words else "camera"
    return name if name[0].isalpha() else f"camera_{name}"


def roles_of(bag: Bag, place: str, robot: Robot, mapped: dict[str, str], prefix: str | None = None) -> Roles:
    """prefix: what stands before the names of the robot's joints; None: found. Raises Error for topics that are not
    there, for what cannot be told apart, and for another robot's joints."""
    topics = {topic.name: topic for topic in bag.topics()}
    for what, name in mapped.items():
        if name != "none" and name not in topics:
            raise unknown(f"{place} ({what})", "topic", name, sorted(topics))
    of_kind: dict[str, list[Topic]] = {}
    for topic in topics.values():
        of_kind.setdefault(KINDS.get(type_name(topic.schema), ""), []).append(topic)
    roles = Roles()
    _find_joints(roles, bag, place, robot, mapped, of_kind.get("joints", []), topics, prefix)
    _find_pictures(roles, bag, place, mapped, of_kind.get("picture", []), topics)
    _find_named(roles.lenses, "lens", mapped, of_kind.get("lens", []))
    _find_named(roles.wrenches, "wrench", mapped, of_kind.get("wrench", []))
    roles.transforms = {topic.name for topic in of_kind.get("transforms", [])}
    roles.segments = {topic.name for topic in of_kind.get("segments", [])}
    return roles


def _readings(bag: Bag, topic: Topic) -> Iterator[object]:
    read = decoder(topic.name, topic.schema, topic.encoding)
    for _, log_ns, data in bag.messages({topic.name}):
        yield read(data, log_ns)


def _first(bag: Bag, topic: Topic) -> object:
    """The first message of a topic; None: it has none."""
    return next(_readings(bag, topic), None)


@dataclass
class _Named:
    """What the joint states of a topic name, all its drivers' together."""

    names: dict[str, None]  # in their order
    measured: dict[str, set[str]]  # velocity, effort: joints that have some


def _named(bag: Bag, topic: Topic) -> _Named:
    found = _Named({}, {"velocity": set(), "effort": set()})
    for one in islice(_readings(bag, topic), _LOOKED_AT):
        if isinstance(one, JointReading):
            found.names.update(dict.fromkeys(one.names))
            for part, joints in found.measured.items():
                values = getattr(one, part)[: len(one.names)]
                joints.update(one.names[k] for k in np.flatnonzero(np.isfinite(values)))
    return found


def _find_joints(
    roles: Roles,
    bag: Bag,
    place: str,
    robot: Robot,
    mapped: dict[str, str],
    found: list[Topic],
    topics: dict[str, Topic],
    wanted: str | None,
) -> None:
    candidates = [topics[mapped["joints"]]] if mapped.get("joints", "none") != "none" else found
    if not candidates:
        known = ", ".join(f"{topic.name} ({topic.schema})" for topic in topics.values())
        raise fault(
            place, "it has no topic of joint states", f"record sensor_msgs/JointState; there are {known or 'none'}"
        )
    named = {topic.name: _named(bag, topic) for topic in candidates}
    found_arms = {
        name: the_prefix(robot.arm, one.names, wanted, f"{place}, topic {name}") for name, one in named.items()
    }
    arms = {name: prefix for name, prefix in found_arms.items() if prefix is not None}
    if not arms:
        raise _no_arm(place, robot, named, wanted)
    if len(arms) > 1:
        raise fault(place, f"{' and '.join(arms)} both have the arm's joints", f"--map joints={next(iter(arms))}")
    ((roles.joints, prefix),) = arms.items()
    roles.arm = tuple(prefix + joint for joint in robot.arm)
    roles.measured = tuple(part for part, joints in named[roles.joints].measured.items() if joints & set(roles.arm))
    _find_fingers(roles, bag, place, robot, mapped, topics, named, prefix)


def _no_arm(place: str, robot: Robot, named: dict[str, _Named], wanted: str | None) -> Exception:
    names = list(dict.fromkeys(name for one in named.values() for name in one.names))
    where = f"{place}, topic {', '.join(named)}"
    there = "its joints are " + (", ".join(names) or "none")
    if wanted is not None:
        return fault(where, f"no names of the arm's joints have the prefix '{wanted}': {there}", "leave --prefix out")
    ends = [joint for joint in robot.arm if any(name == joint or name.endswith(joint) for name in names)]
    if len(ends) == len(robot.arm):
        parts = "no prefix is that of all of the arm's joints"
        cure = "record all joints of the arm on one topic"
        return fault(where, f"{parts}, so they are not of one arm: {there}", cure)
    missing = next(joint for joint in robot.arm if joint not in ends)
    return fault(
        where,
        f"it has no joint '{missing}' of the arm, so it is of another robot: {there}",
        f"--robot names another one (its joints are {', '.join(robot.arm)})",
    )


def _find_fingers(
    roles: Roles,
    bag: Bag,
    place: str,
    robot: Robot,
    mapped: dict[str, str],
    topics: dict[str, Topic],
    named: dict[str, _Named],
    prefix: str,
) -> None:
    """The hand's joints: on the arm's topic, or on one of their own."""
    if "gripper" in mapped:
        if mapped["gripper"] == "none":
            return
        roles.gripper = mapped["gripper"]
        names = list(_named(bag, topics[roles.gripper]).names)
        roles.fingers = _fingers(robot, names, prefix) or _fingers(robot, names, None)
        return
    roles.fingers = _fingers(robot, named[roles.joints].names, prefix)
    if roles.fingers:
        return
    others = {name: one.names for name, one in named.items() if name != roles.joints}
    if mapped.get("joints", "none") != "none":
        return
    for known in (prefix, None):  # a topic of the hand alone may have names of its own
        hands = {name: fingers for name, names in others.items() if (fingers := _fingers(robot, names, known))}
        if len(hands) > 1:
            both = " and ".join(hands)
            cure = f"--map gripper={next(iter(hands))}, or gripper=none"
            raise fault(place, f"{both} both have joints of a hand", cure)
        if hands:
            ((roles.gripper, roles.fingers),) = hands.items()
            return


def _fingers(robot: Robot, names: Collection[str], prefix: str | None) -> tuple[str, ...]:
    """Names of the joints of one hand. prefix: of the arm's joints; None: of a hand that is named in its own way."""
    if prefix is None:
        return tuple(name for name in names if re.search("finger|gripper", name))
    exact = tuple(prefix + finger for finger in robot.fingers)
    if exact and all(one in names for one in exact):
        return exact
    return tuple(one for one in names if one.startswith(prefix) and "finger" in one and (prefix or _is_plain(one)))


def _is_plain(name: str) -> bool:
    """Whether nothing stands before `finger` that could name another arm."""
    return re.match(r"[a-z]*finger", name) is not None


def _find_pictures(
    roles: Roles, bag: Bag, place: str, mapped: dict[str, str], found: list[Topic], topics: dict[str, Topic]
) -> None:
    taken: dict[tuple[str, str], Topic] = {}
    for what, name in mapped.items():
        kind, _, camera = what.partition(".")
        if kind in ("rgb", "depth") and name != "none":
            taken[kind, camera] = topics[name]
    closed = {what.partition(".")[0] for what in mapped}
    for topic in found:
        first = _first(bag, topic)
        if not isinstance(first, PictureReading):
            continue
        kind = "depth" if any(word in first.encoding for word in _DEPTHS) else "rgb"
        if kind in closed:
            continue
        key = (kind, camera_name(topic.name))
        other = taken.setdefault(key, topic)
        if other is topic:
            continue
        packed = ["Compressed" in one.schema or "compressed" in one.name for one in (other, topic)]
        if packed[0] == packed[1]:
            raise fault(
                place,
                f"{other.name} and {topic.name} would both be {kind} of camera '{key[1]}'",
                f"--map {kind}.NAME={topic.name} for each that is wanted",
            )
        taken[key] = topic if packed[1] else other  # files are taken as they are
    roles.pictures = {topic.name: key for key, topic in taken.items()}


def _find_named(names: dict[str, str], kind: str, mapped: dict[str, str], found: list[Topic]) -> None:
    given = {topic: what.partition(".")[2] for what, topic in mapped.items() if what.partition(".")[0] == kind}
    if given:
        names.update({topic: name for topic, name in given.items() if topic != "none"})
        return
    for topic in found:
        name = camera_name(topic.name)
        if kind == "wrench" and name in names.values():
            raise fault(topic.name, f"another topic would be wrench '{name}' too", f"--map wrench.NAME={topic.name}")
        names[topic.name] = name
