"""Poses: x y z in m, then a unit quaternion x y z w."""

import numpy as np


def product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Quaternion of turning by `b` first, then by `a`."""
    vector = a[3] * b[:3] + b[3] * a[:3] + np.cross(a[:3], b[:3])
    return np.append(vector, a[3] * b[3] - a[:3] @ b[:3])


def rotated(quaternion: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """`vector` turned by `quaternion`."""
    twice = 2.0 * np.cross(quaternion[:3], vector)
    return vector + quaternion[3] * twice + np.cross(quaternion[:3], twice)


def composed(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Pose `b`, given in the frame that pose `a` is, in the frame of `a`."""
    return np.concatenate([a[:3] + rotated(a[3:], b[:3]), product(a[3:], b[3:])])


def interpolated(a: np.ndarray, b: np.ndarray, share: float) -> np.ndarray:
    """The pose that lies at `share` (0 … 1) of the straight line from pose `a` to pose `b`, turned evenly."""
    turn = rotation_vector(a[3:], b[3:]) * share
    angle = float(np.linalg.norm(turn))
    step = np.append(turn * (0.5 * np.sinc(angle / (2.0 * np.pi))), np.cos(angle / 2.0))
    return np.concatenate([a[:3] + (b[:3] - a[:3]) * share, product(step, a[3:])])


def rotation_vector(from_quaternion: np.ndarray, to_quaternion: np.ndarray) -> np.ndarray:
    """The shortest turn from one orientation to another, rad, about axes of the world."""
    turn = product(to_quaternion, from_quaternion * np.array([-1.0, -1.0, -1.0, 1.0]))
    turn = -turn if turn[3] < 0 else turn
    length = float(np.linalg.norm(turn[:3]))
    return np.zeros(3) if length < 1e-12 else turn[:3] / length * 2.0 * np.arctan2(length, turn[3])
