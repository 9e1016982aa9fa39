"""Rigid motions, many at once, and the closed-form start of a hand-eye calibration. Poses are 4 x 4 matrices."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]


def turned(vector: Array) -> Array:
    """3 x 3 of a rotation vector, rad."""
    angle = float(np.linalg.norm(vector))
    if angle < 1e-12:
        return np.eye(3) + skew(vector)
    k = skew(vector / angle)
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * (k @ k)


def skew(v: Array) -> Array:
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def moved(pose: Array, step: Array) -> Array:
    """A pose after a small motion in its own frame: 3 m, 3 rad."""
    result = pose.copy()
    result[:3, 3] = pose[:3, 3] + pose[:3, :3] @ step[:3]
    result[:3, :3] = pose[:3, :3] @ turned(step[3:])
    return result


def step_between(pose: Array, other: Array) -> Array:
    """The small motion that `moved` makes of one the other."""
    turn = pose[:3, :3].T @ other[:3, :3]
    return np.concatenate([pose[:3, :3].T @ (other[:3, 3] - pose[:3, 3]), vector_of(turn)])


def vector_of(turn: Array) -> Array:
    """The rotation vector of 3 x 3; exact below half a turn."""
    sine = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
    length = float(np.linalg.norm(sine))
    angle = np.arctan2(length, (np.trace(turn) - 1) / 2)
    return sine * (angle / length if length > 1e-12 else 1.0)


def inverse(poses: Array) -> Array:
    """... x 4 x 4."""
    result = np.broadcast_to(np.eye(4), poses.shape).copy()
    back = np.swapaxes(poses[..., :3, :3], -1, -2)
    result[..., :3, :3] = back
    result[..., :3, 3] = -np.einsum("...ij,...j->...i", back, poses[..., :3, 3])
    return result


def nearest_rotation(matrix: Array) -> Array:
    u, _, v = np.linalg.svd(matrix)
    return u @ np.diag([1, 1, np.sign(np.linalg.det(u @ v))]) @ v


def robot_world(first: Array, second: Array) -> tuple[Array, Array, float]:
    """X and Y of first[i] X = Y second[i], n x 4 x 4 each, in closed form (Shah, 2013, doi:10.1115/1.4024473); and
    how well the rotations fit: rad, root mean square."""
    left, right = first[:, :3, :3], second[:, :3, :3]
    eye = np.eye(3)
    # vec of a matrix by columns: vec(A X) = (I x A) vec X, vec(Y B) = (B^T x I) vec Y
    rows = np.concatenate(
        [np.concatenate([np.kron(eye, a), -np.kron(b.T, eye)], axis=1) for a, b in zip(left, right, strict=True)]
    )
    solution = np.linalg.eigh(rows.T @ rows)[1][:, 0]
    x, y = (part.reshape(3, 3).T for part in (solution[:9], solution[9:]))
    sign = np.sign(np.linalg.det(x)) or 1.0
    x, y = nearest_rotation(sign * x), nearest_rotation(sign * y)
    system = np.concatenate([np.concatenate([a, -eye], axis=1) for a in left])
    wanted = np.concatenate([y @ b[:3, 3] - a[:3, 3] for a, b in zip(first, second, strict=True)])
    ways, *_ = np.linalg.lstsq(system, wanted, rcond=None)
    found = []
    for turn, way in ((x, ways[:3]), (y, ways[3:])):
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = turn, way
        found.append(pose)
    off = np.einsum("nij,jk->nik", left, x) - np.einsum("ij,njk->nik", y, right)
    return found[0], found[1], float(np.sqrt((off**2).sum(axis=(1, 2)).mean() / 2))
