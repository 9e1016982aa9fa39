"""Scripts of the laboratory for `--path`: an arm that is not quite ours with a board in its hand, and a camera."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import cv2
import numpy as np
from numpy.typing import NDArray

from stampede.robots import robot_of

Array = NDArray[Any]

FRAME_HZ = 240  # of physics: torques are those of the motion only where every step is seen
DRIVER_EVERY = 2  # frames: the arm reports at 120 Hz
BASE = np.array([-0.30, 0.0, 0.75])  # of the arm in the world
SQUARES, SQUARE_M, MARKER_M = (5, 4), 0.05, 0.037
DICTIONARY = "DICT_4X4_50"
BOARD_KG = 0.3
SIZE = (640, 480)


def board() -> Any:
    dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, DICTIONARY))
    return cv2.aruco.CharucoBoard(SQUARES, SQUARE_M, MARKER_M, dictionary)


def write_library(folder: Path, truth: Any, seed: int) -> None:
    """Scripts for `--path`: the arm with the board and other masses, the camera as it really is, a task with no end."""
    for kind in ("tasks", "worlds/robots"):
        (folder / kind).mkdir(parents=True, exist_ok=True)
    ours = robot_of("panda").file
    tree = ElementTree.parse(ours)
    root = tree.getroot()
    rng = np.random.default_rng([seed, 2])
    for inertial in root.iter("inertial"):
        scale = rng.uniform(0.97, 1.03)
        mass = inertial.find("mass")
        mass.set("value", repr(float(mass.get("value")) * scale))
    root.append(ElementTree.fromstring(_board_link()))
    root.append(ElementTree.fromstring(_board_joint(truth.hand_from_board)))
    robots = folder / "worlds" / "robots"
    tree.write(robots / "panda.urdf")
    (robots / "panda.lua").write_text(ours.with_suffix(".lua").read_text())
    picture = board().generateImage((SQUARES[0] * 80, SQUARES[1] * 80), marginSize=0, borderBits=1)
    cv2.imwrite(str(robots / "board.png"), picture)
    (robots / "board.obj").write_text(_quad())
    (robots / "board.mtl").write_text("newmtl board\nKd 1 1 1\nmap_Kd board.png\n")
    camera = {
        "name": "lab",
        "width": SIZE[0],
        "height": SIZE[1],
        "camera_matrix": truth.matrix.tolist(),
        "distortion": truth.distortion.tolist(),
        "mount": "world",
        "mount_from_camera": truth.world_from_camera.tolist(),
    }
    (folder / "worlds" / "lab.json").write_text(json.dumps({"cameras": [camera]}))
    (folder / "worlds" / "laboratory.lua").write_text(
        f"""-- An arm with a board in its hand before a camera.
return world {{
  robot = {{ "panda", at = {{ {BASE[0]}, {BASE[1]}, {BASE[2]} }} }},
  fixtures = {{ floor = {{ "floor", at = {{ 0.2, 0, 0 }} }}, pedestal = {{ "pedestal", at = {{ -0.30, 0, 0.75 }} }},
    table = {{ "work_table", at = {{ 0.19, 0, 0.75 }} }} }},
  cameras = {{ lab = {{ at = {{ 1, 0, 1.4 }}, look_at = "table", fov = deg(40) }} }},
  calibration = "lab.json",
  sensors = {{ joint_torque = {{ "joint_torque", rate = {FRAME_HZ // DRIVER_EVERY} }} }},
  physics_hz = {FRAME_HZ}, frame_hz = {FRAME_HZ},
}}
"""
    )
    (folder / "tasks" / "wave.lua").write_text(
        """-- Move about before the camera; the cube stays where it is, so this never ends by itself.
return task {
  world = "laboratory",
  objects = { block = { "cube", colour = "red" } },
  init = { is.on("block", "table") },
  goal = { is.lifted("block") },
  instructions = { "move about" },
}
"""
    )


def _board_link() -> str:
    sides = 'ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.002"'
    centre = f"{SQUARES[0] * SQUARE_M / 2} {SQUARES[1] * SQUARE_M / 2} 0.002"
    return (
        f'<link name="board"><inertial><origin xyz="{centre}"/><mass value="{BOARD_KG}"/><inertia {sides}/></inertial>'
        f'<visual><geometry><mesh filename="board.obj"/></geometry></visual></link>'
    )


def _board_joint(pose: Array) -> str:
    r = pose[:3, :3]
    rpy = (np.arctan2(r[2, 1], r[2, 2]), np.arcsin(-r[2, 0]), np.arctan2(r[1, 0], r[0, 0]))
    xyz, turn = (" ".join(repr(float(one)) for one in values) for values in (pose[:3, 3], rpy))
    return (
        '<joint name="board_joint" type="fixed"><parent link="hand"/><child link="board"/>'
        f'<origin xyz="{xyz}" rpy="{turn}"/></joint>'
    )


def _quad() -> str:
    """The board's face, its first corner at the origin; x right, y down in the picture. And a back, 4 mm behind."""
    w, h = SQUARES[0] * SQUARE_M, SQUARES[1] * SQUARE_M
    corners = [(0, 0, 0), (w, 0, 0), (w, h, 0), (0, h, 0)]
    lines = ["mtllib board.mtl"]
    lines += [f"v {x} {y} {z}" for x, y, z in corners]
    lines += ["vt 0 1", "vt 1 1", "vt 1 0", "vt 0 0", "vn 0 0 -1", "usemtl board"]
    lines += ["f 4/4/1 3/3/1 2/2/1", "f 4/4/1 2/2/1 1/1/1"]
    return "\n".join(lines) + "\n"
