"""The scenes for other simulators: MJCF made of Stampede's own Panda URDF, and how the arm waves.

The robot stands at the origin; the top of the table is the plane z = 0.
"""

import math
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
URDF = ROOT / "worlds/robots/panda.urdf"
HZ = 240  # of the physics
FRAME = 12  # physics steps of a frame
STROKE = 120  # physics steps from one waving pose to the next
HOME = np.array([0, -math.pi / 4, 0, -3 * math.pi / 4, 0, math.pi / 2, math.pi / 4])
TIP = 0.1034  # of the hand's frame, along its z
CUBE = 0.04
ARM = [f"joint{i}" for i in range(1, 8)]
STIFFNESS = [4500, 4500, 3500, 3500, 2000, 2000, 2000]  # position servos, as MuJoCo's own Panda has them
TORQUE = [87, 87, 87, 87, 12, 12, 12]
CAMERAS = {  # those of the standard world, whose robot stands at (-0.30, 0, 0.75)
    "front": ((1.35, 0, 1.58), (0.05, 0, 0.98)),
    "left_shoulder": ((-0.175, 0.2, 1.98), (0.22, 0.02, 0.80)),
    "overhead": ((-0.175, 0, 2.43), (0.15, 0, 0.75)),
    "right_shoulder": ((-0.175, -0.2, 1.98), (0.22, -0.02, 0.80)),
}
COLOURS = ["0.85 0.15 0.15 1", "0.2 0.65 0.25 1", "0.15 0.3 0.85 1", "0.95 0.8 0.15 1", "0.6 0.2 0.7 1"]


def resting_cubes(count: int) -> list[tuple[float, float, float]]:
    """As tests/support/panda.h puts them."""
    return [(0.4 + 0.09 * (i // 5), 0.1 * (i % 5) - 0.2, CUBE / 2) for i in range(count)]


def waving(frames: int) -> np.ndarray:
    """frames x 7: where the arm is to be after each frame; tests/bench/peers_bench.cpp waves in the same way."""

    def pose(k: int) -> np.ndarray:
        k %= 99
        return HOME + (0.2 * np.sin(1.3 * k + np.arange(7)) if k > 0 else 0)

    rows = []
    for frame in range(1, frames + 1):
        k, rest = divmod(frame * FRAME, STROKE)
        rows.append(pose(k) + (pose(k + 1) - pose(k)) * smooth(rest / STROKE))
    return np.array(rows)


def smooth(s: float) -> float:
    """From 0 to 1 with no speed and no acceleration at the ends."""
    return s**3 * (10 - 15 * s + 6 * s * s)


def mjcf(
    cubes: list[tuple[float, float, float]],
    *,
    collision: bool = True,
    looks: bool = False,
    cameras: bool = False,
    shadows: bool = False,
    sleep: bool = False,
) -> str:
    """The Panda, a table and cubes. `looks`: with what only renderers need."""
    urdf = ElementTree.parse(URDF).getroot()
    links = {link.get("name"): link for link in urdf.findall("link")}
    joints = urdf.findall("joint")
    colours = {m.get("name"): m.find("color").get("rgba") for m in urdf.findall("material")}

    def geoms(link: ElementTree.Element, tag: str, attributes: str) -> list[str]:
        made = []
        for shape in link.findall(tag):
            origin, form = shape.find("origin"), shape.find("geometry")[0]
            sizes = {
                "box": lambda f: " ".join(str(float(v) / 2) for v in f.get("size").split()),
                "cylinder": lambda f: f"{f.get('radius')} {float(f.get('length')) / 2}",
                "sphere": lambda f: f.get("radius"),
            }
            material = shape.find("material")
            paint = f' rgba="{colours[material.get("name")]}"' if material is not None else ""
            made.append(
                f'<geom type="{form.tag}" size="{sizes[form.tag](form)}" pos="{origin.get("xyz")}" '
                f'euler="{origin.get("rpy") or "0 0 0"}" {attributes}{paint}/>'
            )
        return made

    def body(name: str, place: str = "", joint: str = "") -> str:
        link, parts = links[name], []
        inertial = link.find("inertial")
        if inertial is not None:
            i = inertial.find("inertia")
            inertia = " ".join(i.get(k) for k in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz"))
            parts.append(
                f'<inertial pos="{inertial.find("origin").get("xyz")}" mass="{inertial.find("mass").get("value")}" '
                f'fullinertia="{inertia}"/>'
            )
        # The fingers' contacts are stiff, or a cube creeps out of them.
        finger = ' priority="1" solref="0.01 1"' if "finger" in name else ""
        if collision:  # what the arm touches: the table and the cubes, never itself
            parts += geoms(link, "collision", f'contype="2" conaffinity="2" group="3"{finger}')
        if looks:
            parts += geoms(link, "visual", 'contype="0" conaffinity="0" group="2" mass="0"')
        if name == "hand":
            parts.append(f'<site name="tip" pos="0 0 {TIP}"/>')
            if cameras:  # looks along the hand, the fingers at its lower edge
                parts.append(camera("wrist", np.array([0.07, 0, 0]), np.array([0.03, 0, 0.25]), 60, (1, 0, 0)))
        for child in joints:
            if child.find("parent").get("link") == name:
                parts.append(child_body(child))
        return f'<body name="{name}" {place} gravcomp="1">{joint}{"".join(parts)}</body>'

    def child_body(child: ElementTree.Element) -> str:
        origin = child.find("origin")
        place = f'pos="{origin.get("xyz")}" euler="{origin.get("rpy") or "0 0 0"}"'
        joint = ""
        if child.get("type") != "fixed":
            kind = {"revolute": "hinge", "prismatic": "slide"}[child.get("type")]
            limit = child.find("limit")
            joint = (
                f'<joint name="{child.get("name")}" type="{kind}" axis="{child.find("axis").get("xyz")}" '
                f'range="{limit.get("lower")} {limit.get("upper")}"/>'
            )
        return body(child.find("child").get("link"), place, joint)

    world = [
        '<geom name="table" type="box" size="0.4 0.6 0.025" pos="0.55 0 -0.025" rgba="0.6 0.45 0.3 1" '
        'contype="1" conaffinity="2"/>'
    ]
    if looks:
        cast = "true" if shadows else "false"
        world.append(f'<light pos="0.5 0.5 2.5" dir="0 -0.15 -1" directional="true" castshadow="{cast}"/>')
    if cameras:
        for name, (at, to) in CAMERAS.items():
            shift = np.array([0.30, 0, -0.75])
            world.append(camera(name, np.array(at) + shift, np.array(to) + shift, 40))
    for i, at in enumerate(cubes):
        world.append(
            f'<body name="cube{i}" pos="{at[0]} {at[1]} {at[2]}"><freejoint/>'
            f'<geom type="box" size="{CUBE / 2} {CUBE / 2} {CUBE / 2}" mass="0.1" contype="1" conaffinity="3" '
            f'rgba="{COLOURS[i % len(COLOURS)]}"/></body>'
        )
    motors = "".join(
        f'<position joint="{name}" kp="{kp}" kv="{kp / 10}" forcerange="{-most} {most}"/>'
        for name, kp, most in zip(ARM, STIFFNESS, TORQUE, strict=True)
    )
    return f"""<mujoco>
  <compiler angle="radian" eulerseq="XYZ" balanceinertia="true" fusestatic="true"/>
  <option timestep="{1 / HZ!r}" integrator="implicitfast">
    <flag sleep="{"enable" if sleep else "disable"}"/>
  </option>
  <visual>
    <global offwidth="128" offheight="128"/>
    <quality offsamples="0" shadowsize="1024" numslices="20" numstacks="2" numquads="1"/>
  </visual>
  <default><joint armature="0.1" damping="1"/></default>
  <worldbody>{"".join(world)}{body("link0")}</worldbody>
  <tendon><fixed name="fingers"><joint joint="left_finger_joint" coef="0.5"/><joint joint="right_finger_joint"
    coef="0.5"/></fixed></tendon>
  <equality><joint joint1="left_finger_joint" joint2="right_finger_joint" solimp="0.95 0.99 0.001" solref="0.01 1"/>
  </equality>
  <actuator>{motors}<position tendon="fingers" kp="1000" kv="100" forcerange="-20 20"/></actuator>
</mujoco>"""


def camera(name: str, at: np.ndarray, to: np.ndarray, fov: float, up: tuple[int, int, int] = (0, 0, 1)) -> str:
    back = (at - to) / np.linalg.norm(at - to)
    if abs(back @ np.array(up)) > 0.999:
        up = (1, 0, 0)
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    axes = " ".join(f"{v:.6f}" for v in (*right, *np.cross(back, right)))
    return f'<camera name="{name}" pos="{" ".join(str(v) for v in at)}" xyaxes="{axes}" fovy="{fov}"/>'


def random_cubes(random: np.random.Generator, count: int) -> list[tuple[float, float, float]]:
    """Apart from each other and within reach."""
    placed: list[tuple[float, float, float]] = []
    while len(placed) < count:
        x, y = random.uniform(0.36, 0.64), random.uniform(-0.28, 0.28)
        if all(math.hypot(x - a, y - b) > 0.085 for a, b, _ in placed):
            placed.append((x, y, CUBE / 2))
    return placed
