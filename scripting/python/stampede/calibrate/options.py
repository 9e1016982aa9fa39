"""The command line of `python -m stampede.calibrate`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

_WHAT = "Finds what cameras, clocks and joints are off by, from pictures of a board."


def parse(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m stampede.calibrate", description=_WHAT)
    kinds = parser.add_subparsers(dest="what", required=True, metavar="WHAT")
    lens = kinds.add_parser("intrinsics", help="focal length, centre and distortion")
    poses = kinds.add_parser("extrinsics", help="where cameras are; clocks; joints")
    for one in (lens, poses):
        one.add_argument(
            "source", metavar="SOURCE", help="a recording folder" + (", or one of pictures" if one is lens else "")
        )
        one.add_argument(
            "--board",
            action="append",
            required=True,
            help="charuco:5x4:0.05:0.037:4X4_50 (squares, m), "
            "checkerboard:9x6:0.025, aruco:7:0.08:4X4_50; for extrinsics with @LINK or @world (default: @hand)",
        )
        one.add_argument(
            "--camera", action="append", default=[], help="name; for extrinsics with @LINK (default: @world)"
        )
        one.add_argument(
            "--most",
            type=int,
            default=300 if one is lens else 1000,
            help="pictures looked at, evenly chosen (default: %(default)s)",
        )
        one.add_argument("--out", metavar="FILE", help="a camera file")
        one.add_argument("--json", action="store_true")
    lens.add_argument("--k3", action="store_true", help="look for k3 too: wide lenses")
    poses.add_argument("--lens", metavar="FILE", help="camera file with the lenses (default: that of the recording)")
    poses.add_argument("--keep-lens", action="store_true", help="do not refine it")
    poses.add_argument("--keep-joints", action="store_true", help="joints read the truth")
    poses.add_argument(
        "--search", type=float, default=0.5, metavar="S", help="clocks differ by at most so much (default: %(default)s)"
    )
    poses.add_argument(
        "--board-at",
        action="append",
        default=[],
        metavar="'N=X Y Z QX QY QZ QW'",
        help="the N-th board's pose in its mount is known: frees the first or last joint's offset",
    )
    poses.add_argument("--board-sd", default="0.0005,0.05", metavar="M,DEGREES", help="how well (default: %(default)s)")
    poses.add_argument("--apply", action="store_true", help="write cameras and clocks into the recording")
    poses.add_argument(
        "--apply-joints", action="store_true", help="and correct its joint positions; those measured are kept"
    )
    return parser.parse_args(arguments)
