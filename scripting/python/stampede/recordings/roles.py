"""Which topic of a bag is what: by its type, its name and its first message, or as `--map` says."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from stampede.faults import fault, unknown
from stampede.recordings.bags import Bag, Topic
from stampede.recordings.messages import KINDS, JointReading, PictureReading, decoder, type_name

# Words that name no camera in `/front/color/image_raw/compressed`.
_PLAIN = re.compile(
    r"(image|color|colour|rgb|depth|infra\d?|raw|rect|registered|compressed|compresseddepth|camera_info|calibration|"
    r"aligned|to|info|_)+"
)
_DEPTHS = ("16UC1", "mono16", "32FC1", "compressedDepth")
MAPPED = ("joints", "gripper", "rgb", "depth", "lens", "wrench")


@dataclass
class Roles:
    joints: str = ""
    gripper: str = ""  # topic of joint states with the fingers, where it is another one; empty: none
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


def joint_for(joint: str, names: Sequence[str]) -> str | None:
    """The name in a message that means a joint of the URDF: the same, or the shortest that ends in it,
    `panda_joint1`."""
    if joint in names:
        return joint
    ending = sorted((name for name in names if re.search(rf"[._/]{re.escape(joint)}$", name)), key=len)
    if not ending or (len(ending) > 1 and len(ending[0]) == len(ending[1])):
        return None
    return ending[0]


def camera_name(topic: str) -> str:
    """`/camera/front/image` -> front, `/camera/color/image_raw` -> camera."""
    words = [word for word in topic.lower().split("/") if word and not _PLAIN.fullmatch(word)]
    name = re.sub(r"[^a-z0-9_]", "_", words[-1]) if words else "camera"
    return name if name[0].isalpha() else f"camera_{name}"


def roles_of(bag: Bag, place: str, arm: Sequence[str], mapped: dict[str, str]) -> Roles:
    """Raises Error for topics that are not there, that cannot be told apart, and for another robot's joints."""
    topics = {topic.name: topic for topic in bag.topics()}
    for what, name in mapped.items():
        if name != "none" and name not in topics:
            raise unknown(f"{place} ({what})", "topic", name, sorted(topics))
    of_kind: dict[str, list[Topic]] = {}
    for topic in topics.values():
        of_kind.setdefault(KINDS.get(type_name(topic.schema), ""), []).append(topic)
    roles = Roles()
    _find_joints(roles, bag, place, arm, mapped, of_kind.get("joints", []), topics)
    _find_pictures(roles, bag, place, mapped, of_kind.get("picture", []), topics)
    _find_named(roles.lenses, "lens", mapped, of_kind.get("lens", []))
    _find_named(roles.wrenches, "wrench", mapped, of_kind.get("wrench", []))
    roles.transforms = {topic.name for topic in of_kind.get("transforms", [])}
    roles.segments = {topic.name for topic in of_kind.get("segments", [])}
    return roles


def _first(bag: Bag, topic: Topic) -> object:
    """The first message of a topic; None: it has none."""
    read = decoder(topic.name, topic.schema, topic.encoding)
    for _, log_ns, data in bag.messages({topic.name}):
        return read(data, log_ns)
    return None


def _find_joints(
    roles: Roles,
    bag: Bag,
    place: str,
    arm: Sequence[str],
    mapped: dict[str, str],
    found: list[Topic],
    topics: dict[str, Topic],
) -> None:
    candidates = [topics[mapped["joints"]]] if mapped.get("joints", "none") != "none" else found
    if not candidates:
        known = ", ".join(f"{topic.name} ({topic.schema})" for topic in topics.values())
        raise fault(
            place, "it has no topic of joint states", f"record sensor_msgs/JointState; there are {known or 'none'}"
        )
    arms: list[str] = []
    names_seen: list[str] = []
    for topic in candidates:
        first = _first(bag, topic)
        if not isinstance(first, JointReading):
            continue
        names_seen += [name for name in first.names if name not in names_seen]
        if all(joint_for(joint, first.names) for joint in arm):
            arms.append(topic.name)
        elif any("finger" in name or "gripper" in name for name in first.names):
            roles.gripper = topic.name
    if not arms:
        missing = next((joint for joint in arm if not joint_for(joint, names_seen)), arm[0])
        raise fault(
            f"{place}, topic {', '.join(topic.name for topic in candidates)}",
            f"it has no joint '{missing}' of the arm, so it is of another robot: its joints are "
            + (", ".join(names_seen) or "none"),
            f"--robot names another one (its joints are {', '.join(arm)})",
        )
    if len(arms) > 1:
        raise fault(place, f"{' and '.join(arms)} both have the arm's joints", f"--map joints={arms[0]}")
    roles.joints = arms[0]
    if "gripper" in mapped:
        roles.gripper = "" if mapped["gripper"] == "none" else mapped["gripper"]


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
