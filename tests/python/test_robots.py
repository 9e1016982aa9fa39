"""Kinematics and dynamics from a URDF agree with the engine's."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import stampede
from stampede.robots import Inertia, Robot, robot_of


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


def test_a_load_is_linear_in_its_mass_and_moment() -> None:
    robot, rng = robot_of("panda"), np.random.default_rng(1)
    q, v, a = (rng.normal(size=(5, 7)) for _ in range(3))
    centre = np.array([0.02, -0.03, 0.15])
    loaded = robot.only("hand")
    loaded.inertias["hand"] = Inertia(0.4, centre, np.zeros((3, 3)))
    wanted = loaded.torques(q, v, a)
    columns = robot.load_torques(q, v, a)
    # The load's own inertia about the hand, quadratic in the centre, is left out.
    near = loaded.torques(q, 0 * v, 0 * a)
    assert np.allclose(robot.load_torques(q, 0 * v, 0 * a) @ np.concatenate([[0.4], 0.4 * centre]), near)
    assert np.abs(columns @ np.concatenate([[0.4], 0.4 * centre]) - wanted).max() < 0.2 * np.abs(wanted).max()
    assert {"link7", "hand", "left_finger", "right_finger"} <= robot.beyond_arm() and "link6" not in robot.beyond_arm()


def test_what_is_no_robot(tmp_path: Path) -> None:
    with pytest.raises(stampede.Error, match="did you mean 'panda'"):
        robot_of("pand")
    (tmp_path / "bad.urdf").write_text("<robot><link name='a'/>")
    with pytest.raises(stampede.Error, match="no URDF"):
        Robot(tmp_path / "bad.urdf")
    (tmp_path / "loop.urdf").write_text(
        "<robot name='loop'><link name='a'/><link name='b'/><link name='hand'/>"
        "<joint name='x' type='fixed'><parent link='b'/><child link='hand'/></joint>"
        "<joint name='y' type='fixed'><parent link='hand'/><child link='b'/></joint></robot>"
    )
    with pytest.raises(stampede.Error, match="no tree"):
        Robot(tmp_path / "loop.urdf")
    with pytest.raises(stampede.Error, match="there is no link 'tool'"):
        robot_of("panda", hand="tool")
