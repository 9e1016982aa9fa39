"""Kinematics and dynamics from a URDF agree with the engine's, and with formulas."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import stampede
from stampede.robots import Robot, robot_of


@pytest.fixture(scope="module")
def arrays(tmp_path_factory: pytest.TempPathFactory) -> stampede.EpisodeArrays:
    """Every physics step of an arm that follows a smooth path."""
    path = tmp_path_factory.mktemp("robots") / "moves.db"
    world = stampede.Session(catalogue=path).environment(
        "reach_target", channels=["joint_positions"], frame_hz=240, physics_hz=240, horizon_s=60, record=True
    )
    start = world.reset(stampede.Reset(seed=1))["joint_positions"]
    for k in range(480):
        share = (k / 480) ** 3 * (10 - 15 * k / 480 + 6 * (k / 480) ** 2)
        goal = start + share * np.array([0.4, 0.3, -0.4, 0.3, 0.5, -0.4, 0.6])
        assert not world.step(stampede.Action("joint_position", goal.tolist())).refusal
    world.episode()
    return next(iter(stampede.Catalogue(path))).arrays()


def test_links_are_where_the_engine_has_them(arrays: stampede.EpisodeArrays) -> None:
    robot = robot_of("panda")
    assert robot.arm == [f"joint{k}" for k in range(1, 8)] and robot.base == "link0"
    hands = robot.poses(arrays["joint_positions"], ["hand"])["hand"]
    tips = hands @ np.array([0, 0, 0.1034, 1])
    assert np.allclose(tips[:, :3] + [-0.3, 0, 0.75], arrays["gripper_pose"][:, :3], atol=1e-9)
    assert np.allclose(hands[:, :3, :3], arrays["gripper_matrix"][:, :3, :3], atol=1e-9)


def test_torques_are_those_of_the_simulated_motors(arrays: stampede.EpisodeArrays) -> None:
    robot = robot_of("panda")
    velocities = arrays["joint_velocities"]
    accelerations = np.gradient(velocities, 1 / 240, axis=0)
    torques = robot.torques(arrays["joint_positions"], velocities, accelerations)
    off = (torques - arrays["joint_forces"])[10:]
    assert np.abs(arrays["joint_forces"]).max() > 15
    assert np.abs(off).max() < 0.15 and off.std(axis=0).max() < 0.05  # N m


def test_a_load_is_linear_in_its_mass_and_moment(tmp_path: Path) -> None:
    robot, rng = robot_of("panda"), np.random.default_rng(1)
    q, v, a = (rng.normal(size=(5, 7)) for _ in range(3))
    load = (
        "<link name='load'><inertial><origin xyz='0.02 -0.03 0.15'/><mass value='0.4'/>"
        "<inertia ixx='0' ixy='0' ixz='0' iyy='0' iyz='0' izz='0'/></inertial></link>"
        "<joint name='grasp' type='fixed'><parent link='hand'/><child link='load'/></joint></robot>"
    )
    (tmp_path / "loaded.urdf").write_text(robot.file.read_text().replace("</robot>", load))
    loaded = Robot(tmp_path / "loaded.urdf")
    parameters = 0.4 * np.array([1, 0.02, -0.03, 0.15])
    # The load's own inertia about the hand, quadratic in the centre, is left out: at rest there is none.
    for moves, near in ((0, 1e-9), (1, 0.2)):
        wanted = loaded.torques(q, moves * v, moves * a) - robot.torques(q, moves * v, moves * a)
        found = robot.load_torques(q, moves * v, moves * a) @ parameters
        assert np.abs(found - wanted).max() < near * np.abs(wanted).max()
    assert np.allclose(loaded.only("load").torques(q, v, a), wanted)
    assert robot.beyond_arm() == {"link7", "flange", "hand", "left_finger", "right_finger"}


PENDULUM = """<robot><link name='wall'/>
  <link name='rod'><visual><geometry><mesh filename='package://nowhere/rod.stl'/></geometry></visual>
    <inertial><origin xyz='0.3 0 0'/><mass value='2'/>
      <inertia ixx='1' ixy='0' ixz='0' iyy='0.05' iyz='0' izz='1'/></inertial></link>
  <link name='tool'><inertial><origin xyz='0 0 -0.1'/><mass value='0.5'/>
    <inertia ixx='0' ixy='0' ixz='0' iyy='0' iyz='0' izz='0'/></inertial></link>
  <link name='finger'/>
  <joint name='swing' type='continuous'>
    <origin xyz='0 0 1'/><axis xyz='0 -2 0'/><parent link='wall'/><child link='rod'/></joint>
  <joint name='tool' type='fixed'>
    <origin xyz='0.8 0 0' rpy='0 1.5707963267948966 0'/><parent link='rod'/><child link='tool'/></joint>
  <joint name='slide' type='prismatic'><axis xyz='1 0 0'/><parent link='tool'/><child link='finger'/>
    <limit lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>"""


def test_a_pendulum_on_a_continuous_joint(tmp_path: Path) -> None:
    """By formulas: its rod of 2 kg lies along x at 0 and rises; a tool of 0.5 kg is fixed to it, with its name."""
    (tmp_path / "pendulum.urdf").write_text(PENDULUM)
    arm = Robot(tmp_path / "pendulum.urdf", "tool")
    assert (arm.name, arm.base, arm.arm, arm.fingers) == ("pendulum", "wall", ["swing"], ["slide"])
    q, v, a = np.array([[0.0], [0.7], [-2.0], [9.0]]), np.full((4, 1), 1.5), np.full((4, 1), 2.5)
    poses = arm.poses(q)
    rise, run = np.sin(q[:, 0]), np.cos(q[:, 0])
    assert np.allclose(poses["tool"][:, :3, 3], np.stack([0.8 * run, 0 * run, 1 + 0.8 * rise], axis=1))
    assert np.allclose(poses["tool"][:, :3, 2], np.stack([run, 0 * run, rise], axis=1))  # rpy: its z is the rod's x
    assert np.allclose(poses["finger"], poses["tool"]) and np.allclose(poses["wall"], np.eye(4))
    rod = (2 * 0.3**2 + 0.05) * a + 2 * 0.3 * 9.81 * np.cos(q)
    tool = 0.5 * 0.7**2 * a + 0.5 * 0.7 * 9.81 * np.cos(q)
    assert np.allclose(arm.torques(q, v, a), rod + tool)
    assert np.allclose(arm.only("rod").torques(q, v, a), rod) and np.allclose(arm.only("tool").torques(q, v, a), tool)
    load = 0.8**2 * a + 0.8 * 9.81 * np.cos(q)  # of 1 kg in the tool's origin
    assert np.allclose(arm.load_torques(q, v, a)[..., 0], load)
    assert arm.beyond_arm() == {"rod", "tool", "finger"} and arm.heavy == ["rod", "tool"]


def broken(folder: Path, links: str, joints: str) -> Path:
    """A URDF of links `a b` and fixed joints `a>b`."""
    urdf = "".join(f"<link name='{link}'/>" for link in links.split())
    for joint in joints.split():
        parent, child = joint.split(">")
        urdf += f"<joint name='{joint}' type='fixed'><parent link='{parent}'/><child link='{child}'/></joint>"
    file = folder / "broken.urdf"
    file.write_text(f"<robot name='broken'>{urdf}</robot>")
    return file


@pytest.mark.parametrize(
    ("links", "joints"),
    [
        ("a b hand", "b>hand hand>b"),
        ("a hand", "a>hand hand>a"),
        ("a b hand", "a>hand"),
        ("a b hand", "a>b b>hand a>hand"),
    ],
)
def test_links_that_are_no_tree(tmp_path: Path, links: str, joints: str) -> None:
    with pytest.raises(stampede.Error, match="no tree") as caught:
        Robot(broken(tmp_path, links, joints))
    assert "broken.urdf" in caught.value.where and caught.value.hint


def test_what_is_no_robot(tmp_path: Path) -> None:
    with pytest.raises(stampede.Error, match="did you mean 'panda'"):
        robot_of("pand")
    (tmp_path / "bad.urdf").write_text("<robot><link name='a'/>")
    with pytest.raises(stampede.Error, match="no URDF"):
        Robot(tmp_path / "bad.urdf")
    with pytest.raises(stampede.Error, match="at joint a>hnad: there is no link 'hnad'") as caught:
        Robot(broken(tmp_path, "a hand", "a>hnad"))
    assert caught.value.hint == "did you mean 'hand'?"
    (tmp_path / "bad.urdf").write_text(PENDULUM.replace("continuous", "twisted"))
    with pytest.raises(stampede.Error, match="no URDF") as caught:
        Robot(tmp_path / "bad.urdf")
    assert "bad.urdf" in caught.value.where and caught.value.hint
    with pytest.raises(stampede.Error, match="there is no link 'tool'"):
        robot_of("panda", hand="tool")
    with pytest.raises(stampede.Error, match="there is no link 'hnad'"):
        robot_of("panda").poses(np.zeros(7), ["hnad"])
    with pytest.raises(stampede.Error, match="6 positions for 7 joints"):
        robot_of("panda").poses(np.zeros(6))


def test_without_pinocchio(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pinocchio", None)
    with pytest.raises(ImportError, match=r'Pinocchio is missing\n    pip install "stampede-sim\[recordings\]"'):
        robot_of("panda")


def test_the_package_itself_does_not_import_pinocchio() -> None:
    script = "import sys, stampede, stampede.torque_noise, stampede.robots; sys.exit('pinocchio' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", script], check=False).returncode == 0
