"""What a calibration found, in words."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from stampede.calibrate.bundle import Result
from stampede.calibrate.lens import Lens
from stampede.calibrate.recorded import Recording


def lens_words(camera: str, lens: Lens, out: Path) -> str:
    d = lens.deviations
    assert d is not None and lens.errors is not None
    bent = "  ".join(
        f"{name} {value:.4f} ± {sd:.4f}"
        for name, value, sd in zip(("k1", "k2", "p1", "p2", "k3"), lens.distortion, d[4:], strict=True)
    )
    return "\n".join(
        [
            f"camera {camera}: {lens.width} x {lens.height}, {lens.pictures} pictures, reprojection error "
            f"{lens.rms:.3f} pixels "
            f"(worst picture {lens.errors.max():.3f})",
            f"  focal length {lens.focal[0]:.2f} ± {d[0]:.2f}, {lens.focal[1]:.2f} ± {d[1]:.2f} pixels",
            f"  centre {lens.centre[0]:.2f} ± {d[2]:.2f}, {lens.centre[1]:.2f} ± {d[3]:.2f} pixels",
            f"  distortion {bent}",
            f"  written to {out}",
        ]
    )


# Poses


def pose_words(result: Result, recording: Recording) -> str:
    lines = []
    for one in result.cameras:
        at, sd = 1e3 * one.pose[:3, 3], one.pose_deviation
        lines += [
            f"camera {one.name} on {one.mount}: {one.pictures} pictures, {one.corners} corners, reprojection error "
            f"{one.rms:.3f} pixels (median {one.median:.3f})",
            f"  at {at[0]:.1f} {at[1]:.1f} {at[2]:.1f} mm, ± {1e3 * sd[:3].max():.1f} mm, ± "
            f"{np.degrees(sd[3:].max()):.3f} degrees",
            f"  clock: {1e3 * one.offset_s:+.2f} ± {1e3 * one.offset_deviation_s:.2f} ms, "
            f"{one.drift_ppm:+.0f} ± {one.drift_deviation_ppm:.0f} ppm",
            f"  focal length {one.lens.focal[0]:.2f} ± {one.lens_deviation[0]:.2f}, centre {one.lens.centre[0]:.2f} "
            f"{one.lens.centre[1]:.2f} ± {one.lens_deviation[2:4].max():.2f} pixels",
            "  worst pictures: " + ", ".join(f"{rms:.2f} pixels at {time:.2f} s" for time, rms in one.worst),
        ]
    lines.append("joints, to be added to what they read:")
    for name, offset, sd, free in zip(
        recording.robot.arm, result.offsets, result.offset_deviations, result.freed, strict=True
    ):
        found = f"{np.degrees(offset):+.3f} ± {np.degrees(sd):.3f} degrees" if free else "taken as it is"
        lines.append(f"  {name}: {found}")
    return "\n".join(lines)
