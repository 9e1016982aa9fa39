"""What a viewer draws: the parts of an episode's scene, their shapes, and how they hang together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from stampede.catalogue import StoredEpisode
from stampede.export.steps import Array, Json, stored_scene


@dataclass(frozen=True)
class Part:
    """A rigid part of a thing or of the robot, hung from its parent by a joint."""

    frame: str  # `chest` of a thing's base, else `chest.bottom_drawer`, `panda.link3`
    parent: str  # frame; `world` of a base
    joint: str  # label in `joint_positions`, `gripper_joint_positions` or `object_joint_positions`; empty: it is fixed
    turns: bool  # by rad: a hinge or screw; else it slides
    lead: float  # of a screw, m/rad
    axis: Array  # 3, in the joint's frame
    parent_from_joint: Array  # 7: m, quaternion x y z w; of a base its pose at the start, world
    shapes: list[Json]  # kind, size, radius, length, points (m), colour, part_from_shape

    def pose(self, position: float) -> Array:
        """7: parent_from_part where the joint is at `position`, rad or m."""
        origin, turn = self.parent_from_joint[:3], self.parent_from_joint[3:]
        if not self.turns:
            return np.concatenate([origin + _rotated(turn, self.axis * position), turn])
        own = np.append(self.axis * np.sin(position / 2), np.cos(position / 2))
        return np.concatenate([origin + _rotated(turn, self.axis * position * self.lead), _product(turn, own)])


def parts_of(episode: StoredEpisode) -> list[Part]:
    """Things first, then the robot, each part after its parent; none of an episode without a scene, a real one."""
    scene = stored_scene(episode)
    if scene is None:
        return []
    things = [part for body in scene["bodies"] for part in _parts(body, body["name"])]
    robot = scene["robot"]["body"]
    return things + _parts(robot, f"{robot['name']}.{robot['parts'][0]['name']}")


def robot_base(episode: StoredEpisode) -> Array:
    """7: where the robot stands; m, quaternion x y z w, world. NaN of an episode without a scene."""
    bases = [part for part in parts_of(episode) if part.parent == "world"]
    return bases[-1].parent_from_joint if bases else np.full(7, np.nan)


def quaternion(rotation: Array) -> Array:
    """x y z w with w >= 0, of a 3 x 3 matrix."""
    (a, b, c), (d, e, f), (g, h, i) = np.asarray(rotation)
    symmetric = np.array(  # its eigenvector of the largest value is the quaternion
        [[a - e - i, d + b, g + c, h - f], [d + b, e - a - i, h + f, c - g], [g + c, h + f, i - a - e, d - b]]
        + [[h - f, c - g, d - b, a + e + i]]
    )
    found = np.linalg.eigh(symmetric)[1][:, -1]
    return found if found[3] >= 0 else -found


def pose_of(transform: Json) -> Array:
    """7: m, quaternion x y z w, of a transform in a document."""
    rotation = np.reshape(transform["rotation"], (3, 3))
    return np.concatenate([transform["origin"], quaternion(rotation)])


def _parts(body: Json, base: str) -> list[Part]:
    frames: list[str] = []
    parts: list[Part] = []
    for part in body["parts"]:
        joint, is_base = part["joint"], part["parent"] < 0
        frames.append(base if is_base else f"{body['name']}.{part['name']}")
        moves = not is_base and joint["kind"] != "fixed"
        parts.append(
            Part(
                frame=frames[-1],
                parent="world" if is_base else frames[part["parent"]],
                joint=f"{body['name']}.{joint['name']}" if moves else "",
                turns=joint["kind"] in ("hinge", "screw"),
                lead=joint.get("pitch", 0.0) / (2 * np.pi),
                axis=np.array(joint["axis"]),
                parent_from_joint=pose_of(body["world_from_body"] if is_base else joint["parent_from_joint"]),
                shapes=_drawn(part["shapes"]),
            )
        )
    return parts


def _drawn(shapes: list[Json]) -> list[Json]:
    """What is seen of a part; for a mesh the hulls that collide in its place."""
    seen = [shape for shape in shapes if shape["visible"] and shape["kind"] != "mesh"]
    if any(shape["visible"] and shape["kind"] == "mesh" for shape in shapes):
        seen += [shape for shape in shapes if shape["collides"] and not shape["visible"]]
    return seen


def _product(first: Array, second: Array) -> Array:
    """Of quaternions x y z w."""
    (a, b), (c, d) = (first[:3], first[3]), (second[:3], second[3])
    return np.append(b * c + d * a + np.cross(a, c), b * d - a @ c)


def _rotated(turn: Array, vector: Array) -> Array:
    across = 2 * np.cross(turn[:3], vector)
    return vector + turn[3] * across + np.cross(turn[:3], across)
