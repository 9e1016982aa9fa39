"""What torque sensors say beside the truth, fitted to a recording, for `stampede run --noise torque=FILE.json`.

`python -m stampede.torque_noise RECORDING --out arm.json`

What is left of the measured torques without those that the motion takes (stampede.robots: the URDF's masses,
corrected by some per cent, and a load in the hand) is, for each joint,
    coulomb tanh(v / smooth) + viscous v + offset + drift (1 - exp(-t / drift_time)) + white noise,
least squares for all joints at once; `smooth` and `drift_time` are those that fit best. The arm must touch nothing.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede._core import Error
from stampede.calibrate.apply import write_whole
from stampede.calibrate.recorded import Recording
from stampede.faults import fault, reading
from stampede.robots import Robot

Array = NDArray[Any]
Json = dict[str, Any]

_VERSION = "stampede_torque_noise"
_WINDOW_S = 0.12  # over which a velocity's slope is its acceleration
_LEAST_S = 5.0
_MOVES = 0.02  # rad/s: below, nothing is learned of a joint's friction
_SMOOTHS = (0.005, 0.01, 0.02, 0.05, 0.1)  # rad/s
_MASS_SD, _LOAD_SD, _MOMENT_SD = 0.05, 1.0, 0.3  # of a link's mass; kg; kg m
_NEAR = 10.0  # columns of a joint whose friction is not seen are held by a prior so wide, N m
_TOGETHER_S = 1.0  # what the model lacks is the same for so long: readings within it count as one beside the priors
_QUANTILES = (0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99)


@dataclass
class Motion:
    """Samples at even times."""

    times: Array  # s since the recording began
    positions: Array
    velocities: Array
    accelerations: Array
    efforts: Array


@dataclass
class TorqueNoise:
    """The fitted model; arrays by joint. As engine/episode/torque_noise.h."""

    joints: list[str]
    coulomb: Array
    viscous: Array
    offset: Array
    drift: Array
    white: Array
    smooth: float
    drift_time_s: float
    recorded_s: float

    def expected(self, velocities: Array, times: Array) -> Array:
        """n x joints, N m, without the white part. times: s since the arm was switched on."""
        warm = 1 - np.exp(-times / self.drift_time_s)
        friction = self.coulomb * np.tanh(velocities / self.smooth) + self.viscous * velocities
        return friction + self.offset + warm[:, None] * self.drift

    def document(self) -> Json:
        rows = zip(self.joints, self.coulomb, self.viscous, self.offset, self.drift, self.white, strict=True)
        return {
            _VERSION: 1,
            "drift_time_s": self.drift_time_s,
            "recorded_s": self.recorded_s,
            "joints": [
                {
                    "joint": joint,
                    "coulomb_nm": float(coulomb),
                    "smooth_rad_s": self.smooth,
                    "viscous_nm_s_rad": float(viscous),
                    "offset_nm": float(offset),
                    "drift_nm": float(drift),
                    "white_nm": float(white),
                }
                for joint, coulomb, viscous, offset, drift, white in rows
            ],
        }


@dataclass
class Fit:
    noise: TorqueNoise
    residuals: Array  # n x joints: what the sensors say beside the motion's torques, N m
    motion: Motion
    masses: dict[str, float]  # by link: relative to the URDF's
    load_kg: float
    load_centre: Array  # m, hand


def motion_of(recording: Recording) -> Motion:
    """Raises Error where torques or velocities were not recorded, or it is too short."""
    joints = recording.joints
    place = str(recording.joints_file)
    if joints.efforts is None or not np.isfinite(joints.efforts).any():
        raise fault(place, "no torques were recorded", "record the efforts of all joints")
    if joints.velocities is None:
        raise fault(place, "no velocities were recorded", "record the velocities of all joints")
    known = np.isfinite(joints.efforts).all(axis=1)
    span = float(joints.times[known][-1] - joints.times[known][0]) if known.any() else 0.0
    if span < _LEAST_S:
        raise fault(
            place, f"torques were recorded for {span:.1f} s", f"record {_LEAST_S:.0f} s at least, better minutes"
        )
    spacing = float(np.median(np.diff(joints.times)))
    at = np.clip(np.searchsorted(joints.times, np.arange(0, span, spacing)), 1, len(joints.times) - 1)
    at = at[known[at]]  # readings as they are: those between would have less noise
    even = np.arange(0, joints.times[-1], spacing)
    smooth = np.stack([np.interp(even, joints.times, column) for column in joints.velocities.T], axis=1)
    slopes = np.stack([_slopes(column, spacing) for column in smooth.T], axis=1)
    accelerations = np.stack([np.interp(joints.times[at], even, column) for column in slopes.T], axis=1)
    at, first = np.unique(at, return_index=True)
    return Motion(
        joints.times[at], joints.positions[at], joints.velocities[at], accelerations[first], joints.efforts[at]
    )


def _slopes(values: Array, spacing: float) -> Array:
    """Of straight lines through a window about each sample (Savitzky, Golay, 1964, doi:10.1021/ac60214a047)."""
    half = max(1, round(_WINDOW_S / spacing / 2))
    weights = np.arange(half, -half - 1, -1.0)
    padded = np.concatenate([np.full(half, values[0]), values, np.full(half, values[-1])])
    return np.convolve(padded, weights, mode="valid") / (weights @ weights) / spacing


def fit(recording: Recording, with_load: bool = True, with_masses: bool = True) -> Fit:
    """Raises Error for a recording that cannot serve."""
    motion = motion_of(recording)
    robot = recording.robot
    still = [name for name, column in zip(robot.arm, motion.velocities.T, strict=True) if np.abs(column).max() < _MOVES]
    if len(still) == len(robot.arm):
        raise fault(str(recording.joints_file), "the arm stood still", "move all joints, both ways, slowly and fast")
    left = motion.efforts - robot.torques(motion.positions, motion.velocities, motion.accelerations)
    shared, priors, links = _shared_columns(robot, motion, with_load, with_masses)
    span = float(motion.times[-1])
    together = max(1.0, _TOGETHER_S / float(np.median(np.diff(motion.times))))
    best: tuple[float, float, float, Array] | None = None
    variance = np.var(left - np.median(left, axis=0), axis=0) + 1e-12
    for _ in range(2):  # the second time with the variances that the first has found
        best = None
        for smooth in _SMOOTHS:
            for drift_time in np.geomspace(span / 20, span * 2, 14):
                own = _own_columns(motion, smooth, float(drift_time))
                values, cost = _solve(left, own, shared, priors, variance * together)
                if best is None or cost < best[0]:
                    best = (cost, smooth, float(drift_time), values)
        assert best is not None
        own = _own_columns(motion, best[1], best[2])
        variance = np.var(left - _predicted(best[3], own, shared), axis=0) + 1e-12
    assert best is not None
    _, smooth, drift_time, values = best
    mine = values[: 4 * len(robot.arm)].reshape(-1, 4)
    beside = np.einsum("njk,k->nj", shared, values[4 * len(robot.arm) :])
    own = _own_columns(motion, smooth, drift_time)
    white = np.sqrt(np.var(left - _predicted(values, own, shared), axis=0))
    noise = TorqueNoise(
        list(robot.arm), mine[:, 0], mine[:, 1], mine[:, 2], mine[:, 3], white, smooth, drift_time, span
    )
    rest = values[4 * len(robot.arm) :]
    load = rest[len(links) :] if with_load else np.zeros(4)
    centre = load[1:] / load[0] if abs(load[0]) > 0.01 else np.zeros(3)
    masses = {link: 1 + float(one) for link, one in zip(links, rest, strict=False)}
    return Fit(noise, left - beside, motion, masses, float(load[0]), centre)


def _shared_columns(robot: Robot, motion: Motion, with_load: bool, with_masses: bool) -> tuple[Array, Array, list[str]]:
    """n x joints x columns that all joints share: torques of each moving link's mass, and of a load; standard
    deviations of their factors; names of the links."""
    columns, priors, links = [], [], []
    carried = robot.beyond_arm() if with_load else set()  # a load says the same as their masses
    if with_masses:
        for link in robot.heavy:
            if link in carried:
                continue
            column = robot.only(link).torques(motion.positions, motion.velocities, motion.accelerations)
            if np.abs(column).max() > 0.05:
                columns.append(column[..., None])
                priors.append(_MASS_SD)
                links.append(link)
    if with_load:
        columns.append(robot.load_torques(motion.positions, motion.velocities, motion.accelerations))
        priors += [_LOAD_SD, _MOMENT_SD, _MOMENT_SD, _MOMENT_SD]
    if not columns:
        return np.zeros((*motion.positions.shape, 0)), np.zeros(0), []
    return np.concatenate(columns, axis=2), np.array(priors), links


def _own_columns(motion: Motion, smooth: float, drift_time: float) -> Array:
    """n x joints x 4: of coulomb, viscous, offset, drift."""
    ones = np.ones_like(motion.velocities)
    warm = np.broadcast_to((1 - np.exp(-motion.times / drift_time))[:, None], ones.shape)
    return np.stack([np.tanh(motion.velocities / smooth), motion.velocities, ones, warm], axis=2)


def _solve(left: Array, own: Array, shared: Array, priors: Array, variance: Array) -> tuple[Array, float]:
    """Values of all columns, the joints' own first, and what they leave. Friction is not negative."""
    arm, more = left.shape[1], shared.shape[2]
    size = 4 * arm + more
    normal, pull = np.zeros((size, size)), np.zeros(size)
    for joint in range(arm):
        columns = np.concatenate([own[:, joint], shared[:, joint]], axis=1)
        places = np.concatenate([np.arange(4 * joint, 4 * joint + 4), np.arange(4 * arm, size)])
        normal[np.ix_(places, places)] += columns.T @ columns / variance[joint]
        pull[places] += columns.T @ left[:, joint] / variance[joint]
    normal += np.diag(np.concatenate([np.full(4 * arm, 1 / _NEAR**2), 1 / priors**2]))
    free = np.ones(size, dtype=bool)
    values = np.zeros(size)
    friction = np.array([k for k in range(4 * arm) if k % 4 < 2])
    while True:
        values[:] = 0
        values[free] = np.linalg.solve(normal[np.ix_(free, free)], pull[free])
        negative = friction[values[friction] < 0]
        if not len(negative):
            break
        free[negative] = False
    return values, float(-(pull @ values))


def _predicted(values: Array, own: Array, shared: Array) -> Array:
    arm = own.shape[1]
    mine = np.einsum("njk,jk->nj", own, values[: 4 * arm].reshape(arm, 4))
    return mine + np.einsum("njk,k->nj", shared, values[4 * arm :])


def distance(one: Array, other: Array) -> float:
    """Kolmogorov's and Smirnov's, of two samples: 0 alike, 1 apart."""
    both = np.sort(np.concatenate([one, other]))
    shares = [np.searchsorted(np.sort(sample), both, side="right") / len(sample) for sample in (one, other)]
    return float(np.abs(shares[0] - shares[1]).max())


def comparison(residuals: Array, others: Array, joints: Sequence[str]) -> list[Json]:
    """How two samples of what sensors say beside the truth are distributed, by joint."""
    return [
        {
            "joint": joint,
            "distance": distance(one, other),
            "quantiles_nm": [float(value) for value in np.quantile(one, _QUANTILES)],
            "other_quantiles_nm": [float(value) for value in np.quantile(other, _QUANTILES)],
        }
        for joint, one, other in zip(joints, residuals.T, others.T, strict=True)
    ]


def drawn(noise: TorqueNoise, motion: Motion, seed: int = 0) -> Array:
    """What the model says that the sensors would have read beside the truth, in this motion."""
    rng = np.random.default_rng(seed)
    expected = noise.expected(motion.velocities, motion.times)
    return expected + noise.white * rng.normal(size=expected.shape)


def main(arguments: Sequence[str] | None = None) -> tuple[str, Json]:
    """Runs the command line; gives what it found, in words and as JSON. Raises Error for bad input."""
    options = _parse(arguments)
    with reading(options.recording):
        recording = Recording(Path(options.recording), corrected=True)
    found = fit(recording, not options.no_load, not options.no_masses)
    alike = comparison(found.residuals, drawn(found.noise, found.motion), found.noise.joints)
    document = found.noise.document() | {"fitted_to": Path(options.recording).name}
    write_whole(Path(options.out), document)
    report = {
        **document,
        "load_kg": found.load_kg,
        "load_centre_m": [float(one) for one in found.load_centre],
        "masses": found.masses,
        "compared": alike,
    }
    return (json.dumps(report, indent=1) if options.json else _words(found, alike, options.out)), report


def _words(found: Fit, alike: list[Json], out: str) -> str:
    noise = found.noise
    lines = [f"{'joint':10}{'coulomb':>9}{'viscous':>10}{'offset':>9}{'drift':>9}{'white':>8}{'KS':>8}"]
    lines.append(f"{'':10}{'N m':>9}{'N m s/rad':>10}{'N m':>9}{'N m':>9}{'N m':>8}")
    for k, joint in enumerate(noise.joints):
        lines.append(
            f"{joint:10}{noise.coulomb[k]:9.3f}{noise.viscous[k]:10.3f}{noise.offset[k]:9.3f}{noise.drift[k]:9.3f}"
            f"{noise.white[k]:8.3f}{alike[k]['distance']:8.3f}"
        )
    lines.append(
        f"friction turns at {noise.smooth:g} rad/s; warm after {noise.drift_time_s:.0f} s; "
        f"{noise.recorded_s:.0f} s recorded"
    )
    if found.load_kg:
        centre = " ".join(f"{1e3 * one:.0f}" for one in found.load_centre)
        lines.append(f"load in the hand {found.load_kg:.3f} kg, its centre at {centre} mm")
    if found.masses:
        worst = max(found.masses.items(), key=lambda one: abs(one[1] - 1))
        lines.append(f"masses: {worst[0]} differs most from the URDF, by {100 * (worst[1] - 1):+.1f} %")
    return "\n".join([*lines, f"written to {out}"])


def _parse(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m stampede.torque_noise", description=__doc__.partition("\n")[0])
    parser.add_argument(
        "recording", metavar="RECORDING", help="a recording folder, with velocities and torques of the joints"
    )
    parser.add_argument("--out", required=True, metavar="FILE.json")
    parser.add_argument("--no-load", action="store_true", help="the hand was empty")
    parser.add_argument("--no-masses", action="store_true", help="the URDF's masses are right")
    parser.add_argument("--json", action="store_true")
    return parser.parse_args(arguments)


if __name__ == "__main__":
    try:
        print(main()[0])
    except (Error, ImportError) as error:
        sys.exit(f"error: {error}")
