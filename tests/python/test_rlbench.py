"""RLBench's interface: programs in its style run with other import lines, and every field is what it says."""

import functools
import os
import pickle
import re
import shutil
import sys
import types
from pathlib import Path

import numpy as np
import pytest

from stampede import Error, Session
from stampede.export import export
from stampede.rlbench import Environment, ObservationConfig, RandomizeEvery, tasks
from stampede.rlbench.action_modes.action_mode import ActionMode, JointPositionActionMode, MoveArmThenGripper
from stampede.rlbench.action_modes.arm_action_modes import (
    EndEffectorPoseViaIK,
    EndEffectorPoseViaPlanning,
    ERJointViaIK,
    JointPosition,
    JointTorque,
    JointVelocity,
    RelativeFrame,
)
from stampede.rlbench.action_modes.gripper_action_modes import Discrete, GripperJointPosition
from stampede.rlbench.backend.exceptions import DemoError, InvalidActionError
from stampede.rlbench.backend.observation import NUMBERS, Observation
from stampede.rlbench.backend.rotations import composed, product, rotation_vector
from stampede.rlbench.backend.task import TASKS_PATH
from stampede.rlbench.backend.utils import (
    float_array_to_rgb_image,
    image_to_float_array,
    mask_to_rgb_handles,
    rgb_handles_to_mask,
    task_file_to_task_class,
)
from stampede.rlbench.environment import SUPPORTED_ROBOTS
from stampede.rlbench.backend.scene import Start
from stampede.rlbench.noise_model import GaussianNoise
from stampede.rlbench.observation_config import CAMERAS, RenderMode
from stampede.rlbench.utils import get_stored_demos, name_to_task_class

H, W = 48, 64
OPEN, CLOSED = 1.0, 0.0


def config_with(*cameras: str) -> ObservationConfig:
    config = ObservationConfig()
    config.set_all(False)
    config.set_all_low_dim(True)
    for name in cameras:
        camera = config.cameras[name]
        camera.set_all(True)
        camera.image_size = (W, H)
        camera.render_mode = RenderMode.OPENGL
    return config


@functools.cache
def shared_environment() -> Environment:
    return Environment(JointPositionActionMode())


def sharing(environment: Environment) -> Environment:
    """With scripts that have been read already, which takes longer than most tests."""
    environment.session = shared_environment().session
    environment.descriptions = shared_environment().descriptions
    return environment


def task_for(arm, config: ObservationConfig | None = None, task=tasks.ReachTarget, gripper=None, **settings):
    mode = MoveArmThenGripper(arm, gripper or Discrete())
    return sharing(Environment(mode, obs_config=config or config_with(), headless=True, **settings)).get_task(task)


def target_of(seen: Observation) -> np.ndarray:
    """reach_target's goal is the last object of its state."""
    return seen.task_low_dim_state[-7:-4]


@pytest.fixture(autouse=True)
def same_draws():
    np.random.seed(7)


# Programs in RLBench's style; nothing but the import lines is changed.
PROGRAMS = {
    "random actions, past the end of episodes": """
import numpy as np
from rlbench.environment import Environment
from rlbench.action_modes.action_mode import MoveArmThenGripper
from rlbench.action_modes.arm_action_modes import JointVelocity
from rlbench.action_modes.gripper_action_modes import Discrete
from rlbench.observation_config import ObservationConfig
from rlbench.tasks import ReachTarget

class Agent:
    def __init__(self, shape):
        self.shape = shape
    def act(self, obs):
        return np.concatenate([np.random.normal(0.0, 0.1, size=(self.shape[0] - 1,)), [1.0]])

config = ObservationConfig()
config.set_all_high_dim(False)
env = Environment(action_mode=MoveArmThenGripper(JointVelocity(), Discrete()), obs_config=config, headless=True)
env.launch()
task = env.get_task(ReachTarget)
agent = Agent(env.action_shape)
steps = 0
for i in range(30):
    if i % 10 == 0:
        descriptions, obs = task.reset()
        assert all(isinstance(one, str) for one in descriptions) and descriptions
    obs, reward, terminate = task.step(agent.act(obs))
    assert obs.joint_positions.shape == (7,)
    assert reward in (0.0, 1.0)
    steps += 1
env.shutdown()
assert steps == 30
""",
    "imitation": """
import numpy as np
from rlbench import Environment, ObservationConfig, CameraConfig
from rlbench.action_modes.action_mode import MoveArmThenGripper
from rlbench.action_modes.arm_action_modes import JointVelocity
from rlbench.action_modes.gripper_action_modes import Discrete
from rlbench.tasks import ReachTarget

off = dict(rgb=False, depth=False, point_cloud=False, mask=False)
config = ObservationConfig(
    left_shoulder_camera=CameraConfig(rgb=True, depth=False, point_cloud=False, mask=False, image_size=(32, 32)),
    right_shoulder_camera=CameraConfig(**off), overhead_camera=CameraConfig(**off), wrist_camera=CameraConfig(**off),
    front_camera=CameraConfig(**off), gripper_touch_forces=True)
env = Environment(MoveArmThenGripper(JointVelocity(), Discrete()), "", config, True)
env.launch()
task = env.get_task(ReachTarget)
demos = task.get_demos(2, live_demos=True)
frames = [obs for demo in demos for obs in demo]
batch = np.random.choice(np.array(frames, dtype=object), replace=False, size=5)
images = np.stack([obs.left_shoulder_rgb for obs in batch])
truth = np.stack([obs.joint_velocities for obs in batch])
assert images.shape == (5, 32, 32, 3) and truth.shape == (5, 7)
env.shutdown()
""",
    "few shot": """
import numpy as np
from rlbench.environment import Environment
from rlbench.action_modes.action_mode import MoveArmThenGripper
from rlbench.action_modes.arm_action_modes import JointVelocity
from rlbench.action_modes.gripper_action_modes import Discrete
from rlbench.observation_config import ObservationConfig
from rlbench.tasks import FS10_V1

config = ObservationConfig()
config.set_all(False)
config.gripper_pose = True
env = Environment(MoveArmThenGripper(JointVelocity(), Discrete()), obs_config=config, headless=True)
env.launch()
train_tasks, test_tasks = FS10_V1["train"], FS10_V1["test"]
assert len(train_tasks) == 10 and len(test_tasks) == 5 and not set(train_tasks) & set(test_tasks)
for task_class in np.random.choice(train_tasks, 2, replace=False):
    task = env.get_task(task_class)
    task.sample_variation()
    descriptions, obs = task.reset()
    obs, reward, terminate = task.step(np.zeros(env.action_shape))
    assert obs.joint_positions is None
    assert obs.gripper_pose.shape == (7,)
env.shutdown()
""",
    "reset to a demo": """
import numpy as np
from rlbench.environment import Environment
from rlbench.action_modes.action_mode import MoveArmThenGripper
from rlbench.action_modes.arm_action_modes import JointPosition
from rlbench.action_modes.gripper_action_modes import Discrete
from rlbench.observation_config import ObservationConfig
from rlbench.tasks import ReachTarget

config = ObservationConfig()
config.set_all_high_dim(False)
env = Environment(MoveArmThenGripper(JointPosition(), Discrete()), obs_config=config, headless=True)
task = env.get_task(ReachTarget)
(demo,) = task.get_demos(1, live_demos=True)
descriptions, obs = task.reset_to_demo(demo)
success = 0.0
actions = [seen.misc["joint_position_action"] for seen in demo[1:]]
for action in actions + 20 * actions[-1:]:
    obs, reward, terminate = task.step(action)
    success = max(success, reward)
    if terminate:
        break
assert success == 1.0, "a demo that is played back reaches its goal"
env.shutdown()
""",
    "gym": """
import gymnasium as gym
import rlbench

env = gym.make("rlbench/reach_target-state-v0", render_mode="rgb_array")
obs, info = env.reset(seed=3)
assert info["text_descriptions"]
for i in range(5):
    obs, reward, terminate, truncated, info = env.step(env.action_space.sample())
    picture = env.render()
assert env.observation_space.contains(obs) and picture.shape == (128, 128, 3)
env.close()
""",
    "own action mode, randomised looks, shaped reward": """
import numpy as np
from rlbench import RandomizeEvery, VisualRandomizationConfig
from rlbench.environment import Environment
from rlbench.action_modes.action_mode import JointPositionActionMode
from rlbench.observation_config import ObservationConfig
from rlbench.tasks import ReachTarget

config = ObservationConfig()
config.set_all_high_dim(False)
env = Environment(JointPositionActionMode(), obs_config=config, headless=True, shaped_rewards=True,
                  randomize_every=RandomizeEvery.EPISODE, frequency=1,
                  visual_randomization_config=VisualRandomizationConfig(image_directory="textures"))
env.launch()
task = env.get_task(ReachTarget)
descriptions, obs = task.reset()
low, high = env.action_bounds()
obs, reward, terminate = task.step(np.clip(np.zeros(8), low, high))
assert isinstance(reward, float)
env.shutdown()
""",
}


@pytest.mark.parametrize("name", PROGRAMS)
def test_programs_run_with_other_import_lines(name: str) -> None:
    text = re.sub(r"^(from|import) rlbench", r"\1 stampede.rlbench", PROGRAMS[name], flags=re.MULTILINE)
    exec(compile(text, name, "exec"), {"__name__": "__main__"})


def test_every_field_has_its_shape_and_type() -> None:
    task = task_for(JointVelocity(), config_with("front", "wrist"))
    _, seen = task.reset()
    for camera in ("front", "wrist"):
        expected = {
            "rgb": ((H, W, 3), np.uint8),
            "depth": ((H, W), np.float32),
            "mask": ((H, W), np.float64),
            "point_cloud": ((H, W, 3), np.float64),
        }
        for kind, (shape, dtype) in expected.items():
            value = getattr(seen, f"{camera}_{kind}")
            assert (value.shape, value.dtype) == (shape, dtype), (camera, kind)
    shapes = {
        "joint_velocities": (7,),
        "joint_positions": (7,),
        "joint_forces": (7,),
        "gripper_pose": (7,),
        "gripper_matrix": (4, 4),
        "gripper_joint_positions": (2,),
        "gripper_touch_forces": (6,),
        "task_low_dim_state": (42,),
    }
    for name, shape in shapes.items():
        value = getattr(seen, name)
        assert (value.shape, value.dtype) == (shape, np.float64), name
    assert seen.gripper_open == 1.0 and type(seen.gripper_open) is float
    assert seen.overhead_rgb is None and "overhead_camera_near" not in seen.misc
    assert seen.misc["variation_index"] == 0
    assert seen.misc["front_camera_far"] == 4.5 and seen.misc["front_camera_near"] == 0.01
    assert np.allclose(seen.gripper_matrix[:3, 3], seen.gripper_pose[:3])
    assert np.isfinite(seen.task_low_dim_state).all()


def test_low_dim_data_is_in_order_and_leaves_out_what_is_off() -> None:
    seen = Observation(gripper_open=1.0, joint_positions=np.arange(7.0), gripper_matrix=np.eye(4))
    assert seen.get_low_dim_data().tolist() == [1.0, 0, 1, 2, 3, 4, 5, 6]
    assert Observation().get_low_dim_data().shape == (0,)
    with pytest.raises(TypeError, match="no field 'colour'"):
        Observation(colour=1)


def test_cameras_have_rlbenchs_convention() -> None:
    """The goal's middle, by extrinsics and negative focal lengths, is where mask and point cloud have the goal."""
    config = config_with("front")
    config.front_camera.image_size = (160, 120)
    _, seen = task_for(JointVelocity(), config).reset()
    intrinsics, extrinsics = seen.misc["front_camera_intrinsics"], seen.misc["front_camera_extrinsics"]
    assert intrinsics[0, 0] == intrinsics[1, 1] == pytest.approx(-175.84 * 120 / 128, rel=1e-3)
    x, y, z = extrinsics[:3, :3].T @ (target_of(seen) - extrinsics[:3, 3])
    u = intrinsics[0, 0] * x / z + intrinsics[0, 2]
    v = intrinsics[1, 1] * y / z + intrinsics[1, 2]
    identity = seen.front_mask[round(v), round(u)]
    assert identity > 0
    goal = seen.front_mask == identity
    assert goal.sum() < 0.05 * goal.size, "the goal is small, and not the floor"
    assert np.linalg.norm(seen.front_point_cloud[goal] - target_of(seen), axis=1).max() < 0.06


def test_sizes_are_width_and_height_live_and_stored(catalogue: Path, dataset: Path) -> None:
    config = config_with("front")
    config.front_camera.image_size = [40, 24]
    _, live = task_for(JointVelocity(), config).reset()
    (drawn,) = get_stored_demos(1, False, catalogue, red(), "reach_target", config, False)
    (resized,) = get_stored_demos(1, False, dataset, red(), "reach_target", config, False)
    for seen in (live, drawn[0], resized[0]):
        assert seen.front_rgb.shape == (24, 40, 3) and seen.front_depth.shape == seen.front_mask.shape == (24, 40)
        assert seen.misc["front_camera_intrinsics"][:2, 2].tolist() == [19.5, 11.5]
    for size in (64, (64,), (0, 64), ("64", 64), (64.5, 64), None):
        config.front_camera.image_size = size
        with pytest.raises(Error, match=r"CameraConfig\(image_size=\): .* is no size"):
            task_for(JointVelocity(), config)


def test_each_camera_has_its_own_size() -> None:
    config = config_with("front", "wrist")
    config.wrist_camera.image_size = (30, 20)
    _, seen = task_for(JointVelocity(), config).reset()
    assert seen.front_rgb.shape == (H, W, 3) and seen.wrist_rgb.shape == (20, 30, 3)
    assert seen.wrist_point_cloud.shape == (20, 30, 3)
    assert seen.misc["wrist_camera_intrinsics"][:2, 2].tolist() == [14.5, 9.5], "whole numbers are middles of pixels"


def test_depth_and_masks_in_both_encodings() -> None:
    config = config_with("front", "overhead")
    config.overhead_camera = config_with("front").front_camera
    config.front_camera.depth_in_meters = True
    config.front_camera.masks_as_one_channel = False
    task, plain = task_for(JointVelocity(), config), task_for(JointVelocity(), config_with("front"))
    np.random.seed(1)
    _, metres = task.reset()
    np.random.seed(1)
    _, unit = plain.reset()
    assert 0.0 <= unit.front_depth.min() and unit.front_depth.max() <= 1.0
    assert np.allclose(metres.front_depth, 0.01 + unit.front_depth * (4.5 - 0.01), atol=1e-5)
    assert 1.0 < metres.front_depth.min() and metres.front_depth.max() <= 4.5
    assert metres.front_mask.shape == (H, W, 3) and metres.front_mask.max() <= 1.0
    assert np.array_equal(rgb_handles_to_mask(metres.front_mask), unit.front_mask)
    assert np.allclose(metres.front_point_cloud, unit.front_point_cloud, atol=1e-5)


def project_back(metres: np.ndarray, extrinsics: np.ndarray, intrinsics: np.ndarray) -> np.ndarray:
    """As programs do that take a pixel's whole indices for its place: by the inverse of the matrix that projects."""
    height, width = metres.shape
    v, u = np.mgrid[0:height, 0:width]
    seen = np.stack([u * metres, v * metres, metres, np.ones_like(metres)], axis=-1)
    projection = np.eye(4)
    projection[:3] = intrinsics @ np.linalg.inv(extrinsics)[:3]
    return (seen @ np.linalg.inv(projection).T)[..., :3]


@pytest.mark.parametrize("camera", CAMERAS)
def test_the_table_is_at_its_height_by_back_projection(camera: str) -> None:
    config = config_with(camera)
    getattr(config, f"{camera}_camera").image_size = (128, 128)
    getattr(config, f"{camera}_camera").depth_in_meters = True
    _, seen = task_for(JointVelocity(), config).reset()
    misc = seen.misc
    points = project_back(
        getattr(seen, f"{camera}_depth").astype(float),
        misc[f"{camera}_camera_extrinsics"],
        misc[f"{camera}_camera_intrinsics"],
    )
    heights = points[..., 2][np.abs(points[..., 2] - 0.75) < 4e-3]
    assert heights.size > 300, "the table fills much of the picture"
    assert np.quantile(np.abs(heights - 0.75), 0.95) < 1e-5, "but for its edge, and what crosses its height"
    assert np.abs(points - getattr(seen, f"{camera}_point_cloud")).max() < 1e-5


def test_intrinsics_go_with_a_resized_picture() -> None:
    from stampede.rlbench.backend.pictures import resized_intrinsics

    half = resized_intrinsics(np.array([[-100.0, 0, 63.5], [0, -80.0, 31.5], [0, 0, 1]]), 0.5, 0.25)
    assert half.tolist() == [[-50.0, 0, 31.5], [0, -20.0, 7.5], [0, 0, 1]]


def test_nothing_in_range_is_the_far_plane() -> None:
    from stampede.rlbench.backend.pictures import depth_to_unit

    assert depth_to_unit(np.array([[0.0, 0.01, 2.255, 4.5]], np.float32), 0.01, 4.5).tolist() == [[1.0, 0.0, 0.5, 1.0]]


def test_encodings_in_png_by_hand() -> None:
    pytest.importorskip("PIL")
    most = 2**24 - 1
    picture = float_array_to_rgb_image(np.array([[0.0, 1.0, 65536 / most, 258 / most, 2.0, -1.0]]), most)
    assert picture.mode == "RGB" and picture.size == (6, 1)
    colours = [[[0, 0, 0], [255, 255, 255], [1, 0, 0], [0, 1, 2], [255, 255, 255], [0, 0, 0]]]
    assert np.asarray(picture).tolist() == colours
    values = np.random.random((5, 6)).astype(np.float32)
    assert np.abs(image_to_float_array(float_array_to_rgb_image(values, most), most) - values).max() < 1e-7
    metres = image_to_float_array(float_array_to_rgb_image(values))
    assert np.abs(metres - values).max() <= 0.5 / 256000, "without a scale in steps of 1/256 mm"
    assert not np.asarray(float_array_to_rgb_image(values, drop_blue=True))[..., 2].any()
    assert mask_to_rgb_handles(np.array([[1, 256, 65536 + 2]])).tolist() == [[[1, 0, 0], [0, 1, 0], [2, 0, 1]]]


def test_noise_is_applied_and_repeatable() -> None:
    config = config_with("front")
    config.front_camera.rgb_noise = GaussianNoise(0.05, (0.0, 1.0))
    config.joint_velocities_noise = GaussianNoise(0.01)
    noisy, plain = task_for(JointVelocity(), config), task_for(JointVelocity(), config_with("front"))
    seen = []
    for task in (noisy, noisy, plain):
        np.random.seed(4)
        seen.append(task.reset()[1])
    assert np.array_equal(seen[0].joint_velocities, seen[1].joint_velocities)
    assert np.array_equal(seen[0].front_rgb, seen[1].front_rgb)
    assert 0.001 < np.std(seen[0].joint_velocities) < 0.05 and np.array_equal(seen[2].joint_velocities, np.zeros(7))
    difference = seen[0].front_rgb.astype(float) - seen[2].front_rgb
    middle = (seen[2].front_rgb > 60) & (seen[2].front_rgb < 195)  # not clipped
    assert np.std(difference[middle]) == pytest.approx(0.05 * 255, rel=0.1)


def test_planning_goes_to_the_goal_and_the_end_stays_the_end() -> None:
    task = task_for(EndEffectorPoseViaPlanning())
    _, seen = task.reset()
    seen, reward, terminate = task.step(np.array([*target_of(seen), 1, 0, 0, 0, OPEN]))
    assert (reward, terminate) == (1.0, True)
    again, reward, terminate = task.step(np.array([0.2, 0, 1.0, 1, 0, 0, 0, OPEN]))
    assert (reward, terminate) == (1.0, True)
    assert np.array_equal(again.joint_positions, seen.joint_positions)


@pytest.mark.parametrize("arm", [EndEffectorPoseViaPlanning, EndEffectorPoseViaIK])
def test_poses_absolute_and_relative(arm) -> None:
    quarter = np.array([0.0, 0.0, np.sin(np.pi / 8), np.cos(np.pi / 8)])  # 45 degrees about z
    up = np.array([0.0, 0.0, 0.05])
    for mode, action, expected in (
        (arm(), lambda now: np.append(now[:3] - up, now[3:]), lambda now: np.append(now[:3] - up, now[3:])),
        (
            arm(absolute_mode=False),
            lambda now: np.append(-up, quarter),
            lambda now: np.append(now[:3] - up, product(quarter, now[3:])),
        ),
        (
            arm(frame=RelativeFrame.EE),
            lambda now: np.append(up, quarter),
            lambda now: composed(now, np.append(up, quarter)),
        ),
    ):
        task = task_for(mode)
        _, seen = task.reset()
        now = seen.gripper_pose
        wanted = expected(now)
        seen, _, _ = task.step(np.append(action(now), OPEN))
        assert np.linalg.norm(seen.gripper_pose[:3] - wanted[:3]) < 0.002
        assert np.linalg.norm(rotation_vector(seen.gripper_pose[3:], wanted[3:])) < 0.01


def test_a_pose_with_a_joint() -> None:
    task = task_for(ERJointViaIK(commanded_joints=[0], delta_angle=True))
    _, before = task.reset()
    seen, _, _ = task.step(np.concatenate([before.gripper_pose, [0.1], [OPEN]]))
    assert np.linalg.norm(seen.gripper_pose[:3] - before.gripper_pose[:3]) < 2e-3
    assert seen.joint_positions[0] - before.joint_positions[0] == pytest.approx(0.1, abs=2e-3)
    with pytest.raises(InvalidActionError, match="do not lead to that pose"):
        task.step(np.concatenate([before.gripper_pose, [2.5], [OPEN]]))
    now = task.get_observation()
    assert np.array_equal(now.joint_positions, seen.joint_positions)


def test_joint_modes() -> None:
    task = task_for(JointPosition(absolute_mode=False))
    _, before = task.reset()
    for _ in range(4):
        seen, _, _ = task.step(np.append(np.full(7, 0.02), OPEN))
    assert (seen.joint_positions > before.joint_positions).all()
    task = task_for(JointVelocity())
    task.reset()
    for _ in range(4):
        seen, _, _ = task.step(np.append(np.full(7, 0.2), OPEN))
    assert np.allclose(seen.joint_velocities, 0.2, atol=0.02)
    task = task_for(JointTorque())
    _, before = task.reset()
    for _ in range(4):
        seen, _, _ = task.step(np.array([0, 0, 0, 0, 0, 0, 1.0, OPEN]))
    assert seen.joint_positions[6] > before.joint_positions[6] + 0.01


def test_grippers() -> None:
    task = task_for(JointVelocity())
    task.reset()
    still = np.zeros(7)
    seen, _, _ = task.step(np.append(still, CLOSED))
    assert seen.gripper_open == 0.0 and seen.gripper_joint_positions.max() < 1e-3
    seen, _, _ = task.step(np.append(still, OPEN))
    assert seen.gripper_open == 1.0 and seen.gripper_joint_positions.min() > 0.039
    task = task_for(JointVelocity(), gripper=GripperJointPosition())
    task.reset()
    for _ in range(10):
        seen, _, _ = task.step(np.append(still, 0.02))
    assert np.allclose(seen.gripper_joint_positions, 0.02, atol=1e-3)


def test_a_grasp_is_felt_and_lifts() -> None:
    """pick_and_lift by poses alone, as an agent of RLBench would do it."""
    task = task_for(EndEffectorPoseViaPlanning(), task=tasks.PickAndLift)
    (demo,) = task.get_demos(1, live_demos=True)
    task.reset_to_demo(demo)
    closes = next(place for place, seen in enumerate(demo) if seen.gripper_open == 0.0)
    grasp, lifted = demo[closes - 1].gripper_pose, demo[-1].gripper_pose
    above = np.append(grasp[:3] + [0, 0, 0.1], grasp[3:])
    task.step(np.append(above, OPEN))
    task.step(np.append(grasp, OPEN))
    seen, _, _ = task.step(np.append(grasp, CLOSED))
    assert (seen.gripper_touch_forces.reshape(2, 3)[:, 1] > 1.0).all()
    assert (seen.gripper_touch_forces.reshape(2, 3)[:, [0, 2]] == 0.0).all()
    _, reward, terminate = task.step(np.append(lifted, CLOSED))
    assert (reward, terminate) == (1.0, True)


@pytest.mark.parametrize("name", ["put_knife_on_chopping_board", "take_usb_out_of_computer"])
def test_a_demo_played_back_by_its_poses_does_the_task(name: str) -> None:
    """In these a skill lets go by opening the hand a little: the demo's `gripper_open` has to say so."""
    task = task_for(EndEffectorPoseViaPlanning(), task=tasks.task_of(name))
    (demo,) = task.get_demos(1, live_demos=True)
    task.reset_to_demo(demo)
    terminate, before = False, demo[0]
    for place, seen in enumerate(demo):
        if place % 6 == 0 or seen.gripper_open != before.gripper_open:
            _, reward, terminate = task.step(np.append(seen.gripper_pose, seen.gripper_open))
        if terminate:
            break
        before = seen
    assert (reward, terminate) == (1.0, True)
    assert demo[-1].gripper_open == 1.0 and demo[-1].misc["joint_position_action"][-1] == 1.0


def stops(demo) -> list[int]:
    """PerAct's rule: the hand changes, the arm has stopped, or it is the last frame."""
    found, buffer = [], 0
    for i, seen in enumerate(demo):
        near = [demo[k].gripper_open for k in (i - 2, i - 1, i, min(i + 1, len(demo) - 1))]
        steady = i < len(demo) - 2 and len(set(near)) == 1
        stopped = buffer <= 0 and steady and np.allclose(seen.joint_velocities, 0, atol=0.1)
        buffer = 4 if stopped else buffer - 1
        if i > 0 and (seen.gripper_open != demo[i - 1].gripper_open or i == len(demo) - 1 or stopped):
            found.append(i)
    return found


@pytest.mark.parametrize("name", ["pick_and_lift", "open_drawer"])
def test_demos_that_stop_at_via_points_are_done_again_by_their_keyframes(name: str) -> None:
    task = task_for(EndEffectorPoseViaPlanning(), task=tasks.task_of(name))
    start = np.random.get_state()
    (plain,) = task.get_demos(1, live_demos=True)
    np.random.set_state(start)
    (demo,) = task.get_demos(1, live_demos=True, stop_at_vias=True)
    assert demo.seed == plain.seed
    closing = [next(i for i, seen in enumerate(one) if seen.gripper_open == 0.0) for one in (plain, demo)]
    before = [[i for i in stops(one) if i < shut - 6] for one, shut in zip((plain, demo), closing, strict=True)]
    assert not [i for i in before[0] if i > 6] and before[1], "the approach is a keyframe only where the arm stands there"
    held = demo[-1].misc["frame"] - demo[-4].misc["frame"]
    assert held == 3 and not np.allclose(demo[-8].joint_positions, demo[-1].joint_positions, atol=1e-3)
    task.reset_to_demo(demo)
    for i in stops(demo):
        _, reward, terminate = task.step(np.append(demo[i].gripper_pose, demo[i].gripper_open))
        if terminate:
            break
    assert reward == 1.0


def test_joint_positions_of_demos_do_the_task_again() -> None:
    task = task_for(JointPosition())
    for demo in task.get_demos(5, live_demos=True):
        task.reset_to_demo(demo)
        rewards = [task.step(seen.misc["joint_position_action"])[1] for seen in demo[1:]]
        assert rewards[-1] == 1.0


# Wrists that turn, lids and doors that lead the hand, a block that is pushed, forks that are let go beside knives.
@pytest.mark.parametrize(
    "name", ["change_clock", "open_box", "slide_cabinet_open", "slide_block_to_target", "set_the_table"]
)
def test_demos_that_stop_do_it_again_by_joint_positions_in_contact_too(name: str) -> None:
    task = task_for(JointPosition(), task=tasks.task_of(name))
    (demo,) = task.get_demos(1, live_demos=True, stop_at_vias=True)
    task.reset_to_demo(demo)
    rewards = []
    for seen in demo[1:]:
        _, reward, over = task.step(seen.misc["joint_position_action"])
        rewards.append(reward)
        if over:
            break
    assert rewards[-1] == 1.0


def test_paths_around_obstacles_are_not_into_them() -> None:
    free, checked = EndEffectorPoseViaPlanning(), EndEffectorPoseViaPlanning(collision_checking=True)
    into_the_table = np.array([0.2, 0.0, 0.70, 1, 0, 0, 0, OPEN])
    task = task_for(checked)
    _, before = task.reset()
    with pytest.raises(InvalidActionError):
        task.step(into_the_table)
    assert np.array_equal(task.get_observation().get_low_dim_data(), before.get_low_dim_data())
    task = task_for(free)
    task.reset()
    seen, _, _ = task.step(into_the_table)
    assert 0.70 < seen.gripper_pose[2] < 0.80, "it goes there, and the table stops it"


def test_the_preset_mode_has_bounds() -> None:
    env = sharing(Environment(JointPositionActionMode(), obs_config=config_with()))
    low, high = env.action_bounds()
    assert env.action_shape == (8,)
    assert np.allclose(low, [-0.1] * 7 + [0]) and np.allclose(high, [0.1] * 7 + [0.04])
    task = env.get_task(tasks.ReachTarget)
    _, before = task.reset()
    for _ in range(6):
        seen, _, _ = task.step(np.array([0.05, 0, 0, 0, 0, 0, 0, 0.01]))
    assert seen.joint_positions[0] > before.joint_positions[0] + 0.1
    assert seen.gripper_joint_positions.max() < 0.03
    with pytest.raises(NotImplementedError):
        MoveArmThenGripper(JointVelocity(), Discrete()).action_bounds()


def test_a_mode_of_ones_own() -> None:
    from stampede import Action

    class Twist(ActionMode):
        def __init__(self) -> None:
            super().__init__(JointVelocity(), Discrete())

        def action(self, scene, action) -> None:
            scene.act(Action("tool_delta", action))

        def action_shape(self, scene) -> tuple[int, ...]:
            return (6,)

    env = sharing(Environment(Twist(), obs_config=config_with()))
    task = env.get_task(tasks.ReachTarget)
    _, before = task.reset()
    for _ in range(5):
        seen, _, _ = task.step(np.array([0, 0, -0.01, 0, 0, 0]))
    assert env.action_shape == (6,)
    assert seen.gripper_pose[2] < before.gripper_pose[2] - 0.02


@pytest.mark.parametrize(
    "action, message",
    [
        (np.zeros(3), r"shape \(3,\)\n    this action mode takes \(8,\)"),
        (np.array([0.1, 0, 1, 1, 1, 0, 0, 1]), "has length 1.414"),
        (np.array([9, 0, 1, 1, 0, 0, 0, 1]), "out of its bounds"),
        (np.array([0.9, 0.9, 1, 1, 0, 0, 0, 1]), "another pose|nearer pose"),
        (np.array([np.nan, 0, 1, 1, 0, 0, 0, 1]), "not finite"),
    ],
)
def test_bad_actions_change_nothing(action: np.ndarray, message: str) -> None:
    for arm in (EndEffectorPoseViaPlanning(), EndEffectorPoseViaIK()):
        task = task_for(arm)
        _, before = task.reset()
        with pytest.raises(InvalidActionError, match=message):
            task.step(action)
        assert np.array_equal(task.get_observation().get_low_dim_data(), before.get_low_dim_data())


def test_variations() -> None:
    task = task_for(JointVelocity())
    assert task.get_name() == "reach_target" and task.variation_count() == 20
    task.set_variation(3)
    sentences, seen = task.reset()
    colour = shared_environment().session.variations("reach_target")[3].removeprefix("colour=")
    assert seen.misc["variation_index"] == 3 and all(colour in one for one in sentences)
    assert task.sample_variation() in range(20)
    with pytest.raises(Error, match="no variation 20\n    they go from 0 to 19"):
        task.set_variation(20)


def test_starts_follow_numpys_generator() -> None:
    task = task_for(JointVelocity())
    starts = []
    for seed in (1, 1, 2):
        np.random.seed(seed)
        starts.append(task.reset()[1].get_low_dim_data())
    assert np.array_equal(starts[0], starts[1]) and not np.array_equal(starts[0], starts[2])
    static = task_for(JointVelocity(), static_positions=True)
    assert np.array_equal(static.reset()[1].get_low_dim_data(), static.reset()[1].get_low_dim_data())


def test_live_demos() -> None:
    task = task_for(JointVelocity(), config_with("front"))
    task.set_variation(2)
    np.random.seed(5)
    steps: list[Observation] = []
    (demo,) = task.get_demos(1, live_demos=True, callable_each_step=steps.append)
    assert len(steps) == len(demo) and all(one is other for one, other in zip(steps, demo, strict=True))
    assert "joint_position_action" not in demo[0].misc
    assert all(seen.misc["joint_position_action"].shape == (8,) for seen in demo[1:])
    assert all(seen.misc["variation_index"] == 2 for seen in demo)
    assert demo.num_reset_attempts >= 1
    _, seen = task.reset_to_demo(demo)
    for name in NUMBERS:
        assert np.array_equal(getattr(seen, name), getattr(demo[0], name)), name
    for kind in ("rgb", "depth", "mask"):
        assert np.array_equal(getattr(seen, f"front_{kind}"), getattr(demo[0], f"front_{kind}")), kind
    assert np.allclose(seen.front_point_cloud, demo[0].front_point_cloud, atol=1e-6)
    demo.restore_state()
    (again,) = task.get_demos(1, live_demos=True)
    assert again.seed == demo.seed and np.array_equal(again[-1].joint_positions, demo[-1].joint_positions)


def test_frames_while_the_fingers_move() -> None:
    without, with_them = config_with(), config_with()
    with_them.record_gripper_closing = True
    demos = []
    for config in (without, with_them):
        np.random.seed(9)
        demos += task_for(JointVelocity(), config, tasks.PickAndLift).get_demos(1, live_demos=True)
    frames = [[seen.misc["frame"] for seen in demo] for demo in demos]
    assert frames[1] == list(range(len(demos[1]))) and set(frames[0]) < set(frames[1])
    dropped = sorted(set(frames[1]) - set(frames[0]))
    opening = [seen.gripper_joint_positions[0] for seen in demos[1]]
    assert opening[dropped[0] - 1] - opening[dropped[-1]] > 0.01, "they close in what is left out"


def test_randomised_looks_differ_and_come_back() -> None:
    plain = task_for(JointVelocity(), config_with("front"))
    drawn = task_for(JointVelocity(), config_with("front"), randomize_every=RandomizeEvery.EPISODE)
    (demo,) = drawn.get_demos(1, live_demos=True)
    _, seen = plain.reset_to_demo(demo)
    assert np.array_equal(seen.front_rgb, demo[0].front_rgb)
    demo.randomise = False
    _, seen = plain.reset_to_demo(demo)
    assert not np.array_equal(seen.front_rgb, demo[0].front_rgb)


def test_tasks_are_classes() -> None:
    assert set(tasks.__all__) >= {"ReachTarget", "StackBlocks", "FS10_V1"}
    assert tasks.ReachTarget is task_file_to_task_class("reach_target.py") is name_to_task_class("reach_target")
    assert tasks.ReachTarget.__name__ == "ReachTarget"
    modules = {file.removesuffix(".py") for file in os.listdir(TASKS_PATH) if file.endswith(".py")}
    assert modules - {"__init__"} == set(Session().tasks())
    from stampede.rlbench.tasks.reach_target import ReachTarget

    assert ReachTarget is tasks.ReachTarget and ReachTarget.__doc__.startswith("Bring the tip of the hand")
    assert {tasks.task_class(name).task_name for name in Session().tasks()} == set(Session().tasks())
    with pytest.raises(ImportError):
        exec("from stampede.rlbench.tasks import ReachTargt")
    with pytest.raises(AttributeError, match="did you mean 'ReachTarget'"):
        _ = tasks.ReachTargt
    with pytest.raises(Error, match="did you mean 'reach_target'"):
        task_file_to_task_class("reach_targt")


def test_task_sets_have_rlbenchs_sizes_as_far_as_there_are_tasks() -> None:
    sizes = {"FS10_V1": (10, 5), "FS25_V1": (25, 5), "FS50_V1": (50, 5), "FS95_V1": (85, 5)}
    for name, size in sizes.items():
        train, test = getattr(tasks, name)["train"], getattr(tasks, name)["test"]
        assert (len(train), len(test)) == size, name
        assert len({*train, *test}) == len(train) + len(test), "none twice"
    joint = {name: getattr(tasks, name)["train"] for name in ("MT15_V1", "MT30_V1", "MT55_V1", "MT100_V1")}
    assert [len(one) for one in joint.values()] == [15, 30, 55, len(Session().tasks())]
    assert joint["MT15_V1"] == tasks.FS10_V1["train"] + tasks.FS10_V1["test"]
    assert tasks.CloseMicrowave in tasks.FS10_V1["train"] and tasks.OpenFridge in tasks.FS10_V1["test"]


def test_what_cannot_be_had_is_told() -> None:
    mode = MoveArmThenGripper(JointVelocity(), Discrete())
    with pytest.raises(Error, match="no robot 'sawyer'"):
        Environment(mode, robot_setup="sawyer")
    with pytest.raises(Error, match="RandomizeEvery.EPISODE"):
        Environment(mode, randomize_every=RandomizeEvery.TRANSITION)
    with pytest.raises(Error, match="is no class of a task"):
        Environment(mode).get_task("reach_target")
    with pytest.raises(Error, match="there is no frame 'hand'"):
        EndEffectorPoseViaIK(frame="hand")
    with pytest.raises(Error, match="no such index"):
        ERJointViaIK(commanded_joints=[7])
    task = task_for(JointVelocity())
    with pytest.raises(Error, match=r"call reset\(\) before step\(\)"):
        task.step(np.zeros(8))
    assert "sawyer" not in SUPPORTED_ROBOTS and issubclass(DemoError, RuntimeError)
    with pytest.raises(DemoError, match="dataset_root"):
        task.get_demos(1)
    with pytest.raises(DemoError, match="no such folder or catalogue"):
        task_for(JointVelocity(), dataset_root="/no/such/folder").get_demos(1)
    with pytest.raises(Error, match="no attribute|no render mode"):
        import gymnasium

        gymnasium.make("rlbench/reach_target-state-v0", render_mode="human")


# Datasets


@pytest.fixture(scope="module")
def catalogue(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two demos of reach_target in red with pictures of `front`, and one of pick_and_lift without."""
    file = tmp_path_factory.mktemp("catalogue") / "demos.db"
    session = Session(catalogue=file)
    pictures = {"frames": "all", "cameras": ["front"], "width": W, "height": H, "semantic_mask": False}
    for seed in (1, 2):
        session.run("reach_target", variation="colour=red", seed=seed, pictures=pictures)
    session.run("pick_and_lift", variation="colour=black", seed=1)
    return file


@pytest.fixture(scope="module")
def dataset(catalogue: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    pytest.importorskip("PIL")
    folder = tmp_path_factory.mktemp("dataset") / "rlbench"
    export(["rlbench", str(catalogue), "--out", str(folder), "--where", "task = 'reach_target'"])
    return folder


@functools.cache
def red() -> int:
    return shared_environment().session.variations("reach_target").index("colour=red")


@functools.cache
def black() -> int:
    return shared_environment().session.variations("pick_and_lift").index("colour=black")


def test_export_and_catalogue_give_the_same_demos(catalogue: Path, dataset: Path) -> None:
    config = config_with("front")
    stored = get_stored_demos(-1, False, dataset, red(), "reach_target", config, random_selection=False)
    direct = get_stored_demos(-1, False, catalogue, red(), "reach_target", config, random_selection=False)
    assert [demo.seed for demo in stored] == [demo.seed for demo in direct] == [1, 2]
    for one, other in zip(stored, direct, strict=True):
        assert len(one) == len(other) > 10
        for seen, expected in zip(one, other, strict=True):
            for name in NUMBERS:
                assert np.array_equal(getattr(seen, name), getattr(expected, name)), name
            assert np.array_equal(seen.front_rgb, expected.front_rgb)
            assert np.array_equal(seen.front_mask, expected.front_mask)
            # The catalogue stores depth in steps of 0.1 mm; the range is 4.49 m.
            assert np.abs(seen.front_depth - expected.front_depth).max() < 1e-4 / 4.49
            assert np.abs(seen.front_point_cloud - expected.front_point_cloud).max() < 2e-4
            assert seen.misc.keys() == expected.misc.keys()
            for key, value in seen.misc.items():
                assert np.allclose(value, expected.misc[key]), key


def test_exported_pictures_are_those_of_live_demos(catalogue: Path, tmp_path: Path) -> None:
    pytest.importorskip("PIL")
    export(["rlbench", str(catalogue), "--out", str(tmp_path), "--where", "task = 'pick_and_lift'", "--draw"])
    config = ObservationConfig()
    task = task_for(JointVelocity(), config, tasks.PickAndLift, dataset_root=str(tmp_path), static_positions=True)
    task.set_variation(black())
    (stored,) = task.get_demos(1)
    seen = task._scene  # noqa: SLF001
    seen.reset(Start("colour=black", 1), black())
    live = seen.observation()
    for camera in CAMERAS:
        assert np.array_equal(getattr(stored[0], f"{camera}_rgb"), getattr(live, f"{camera}_rgb")), camera


def test_stored_demos_of_runs_that_stop_end_soon_after_the_last_motion(tmp_path: Path) -> None:
    pytest.importorskip("PIL")
    file = tmp_path / "demos.db"
    session = Session(catalogue=file)
    session.run("pick_and_lift", variation="colour=black", seed=1, set=["motion.stop_at_vias=1"])
    session.run("pick_and_lift", variation="colour=black", seed=1)
    export(["rlbench", str(file), "--out", str(tmp_path / "out"), "--cameras", ""])
    last = []
    for root in (file, tmp_path / "out"):
        demos = get_stored_demos(2, False, root, black(), "pick_and_lift", config_with(), random_selection=False)
        last.append([np.abs(demo[-6].joint_positions - demo[-1].joint_positions).max() for demo in demos])
    assert last[0] == last[1]
    assert last[0][0] > 1e-3 > last[0][1], "without the setting the arm stands for longer"


def test_exported_demos_can_be_gone_back_to(dataset: Path) -> None:
    task = task_for(JointVelocity(), dataset_root=str(dataset))
    task.set_variation(red())
    for demo in task.get_demos(2):
        _, seen = task.reset_to_demo(demo)
        assert np.array_equal(seen.joint_positions, demo[0].joint_positions)
        assert np.array_equal(seen.task_low_dim_state, demo[0].task_low_dim_state)
    named = sharing(Environment(MoveArmThenGripper(JointVelocity(), Discrete()), dataset, config_with()))
    assert len(named.get_demos("reach_target", -1, red())) == 2


def test_files_of_a_dataset(catalogue: Path, dataset: Path) -> None:
    from PIL import Image

    variation = dataset / "reach_target" / f"variation{red()}"
    sentences = pickle.loads((variation / "variation_descriptions.pkl").read_bytes())
    assert sentences and all("red" in one for one in sentences)
    episode = variation / "episodes" / "episode0"
    frames = len(pickle.loads((episode / "low_dim_obs.pkl").read_bytes()))
    assert sorted(one.name for one in episode.iterdir()) == [
        "front_depth",
        "front_mask",
        "front_rgb",
        "low_dim_obs.pkl",
        "variation_descriptions.pkl",
        "variation_number.pkl",
    ]
    assert pickle.loads((episode / "variation_number.pkl").read_bytes()) == red()
    assert pickle.loads((episode / "variation_descriptions.pkl").read_bytes()) == sentences
    for kind in ("rgb", "depth", "mask"):
        names = {one.name for one in (episode / f"front_{kind}").iterdir()}
        assert names == {f"{frame}.png" for frame in range(frames)}
    from stampede import Catalogue

    first = Catalogue(catalogue).demos("task = 'reach_target'")[0]
    depth = first.pictures("front_depth", [0])[0]
    colours = np.asarray(Image.open(episode / "front_depth" / "0.png")).astype(float)
    unit = (colours[..., 0] * 65536 + colours[..., 1] * 256 + colours[..., 2]) / (2**24 - 1)
    assert np.allclose(0.01 + unit * (4.5 - 0.01), np.where(depth > 0, depth, 4.5), atol=1e-6)
    handles = np.asarray(Image.open(episode / "front_mask" / "0.png")).astype(int)
    assert np.array_equal(handles @ [1, 256, 65536], first.pictures("front_mask", [0])[0])


def test_all_variations_together(catalogue: Path, tmp_path: Path) -> None:
    """PerAct's layout: episodes by number over all variations, each with its own."""
    pytest.importorskip("PIL")
    folder = tmp_path / "peract"
    export(["rlbench", str(catalogue), "--out", str(folder), "--cameras", "", "--all-variations"])
    episodes = sorted(one.relative_to(folder).as_posix() for one in folder.glob("*/*/*/*"))
    assert episodes == [
        "pick_and_lift/all_variations/episodes/episode0",
        "reach_target/all_variations/episodes/episode0",
        "reach_target/all_variations/episodes/episode1",
    ]
    for root in (folder, catalogue):
        demos = get_stored_demos(-1, False, root, -1, "reach_target", config_with(), random_selection=False)
        assert [demo.variation_number for demo in demos] == [red(), red()]
    number = folder / "reach_target" / "all_variations" / "episodes" / "episode0" / "variation_number.pkl"
    number.write_bytes(pickle.dumps("red"))
    with pytest.raises(DemoError, match="no variation's number"):
        get_stored_demos(-1, False, folder, -1, "reach_target", config_with(), random_selection=False)


def test_all_variations_of_the_usual_layout(dataset: Path, tmp_path: Path) -> None:
    """Each variation has its folder; there, RLBench's own episodes do not say their variation's number."""
    task = tmp_path / "given" / "reach_target"
    for number, count in ((10, 1), (2, 2), (0, 0)):
        (task / f"variation{number}" / "episodes").mkdir(parents=True)
        for place in range(count):
            whole = dataset / "reach_target" / f"variation{red()}" / "episodes" / "episode0"
            episode = task / f"variation{number}" / "episodes" / f"episode{place}"
            shutil.copytree(whole, episode)
            (episode / "variation_number.pkl").unlink()
    (task / "variation7").mkdir()  # of an export that was cut off
    (task / "variation²" / "episodes" / "episode²").mkdir(parents=True)
    demos = get_stored_demos(-1, False, tmp_path / "given", -1, "reach_target", config_with(), random_selection=False)
    assert [demo.variation_number for demo in demos] == [2, 2, 10]
    with pytest.raises(DemoError, match="variation7/episodes: there is no such folder"):
        get_stored_demos(-1, False, tmp_path / "given", 7, "reach_target", config_with())
    shutil.rmtree(task)
    task.mkdir()
    with pytest.raises(DemoError, match="all_variations/episodes: there is no such folder"):
        get_stored_demos(-1, False, tmp_path / "given", -1, "reach_target", config_with())


def test_an_array_of_demos_has_one_entry_a_demo(dataset: Path) -> None:
    """As RLBench's example of imitation learning does it."""
    task = task_for(JointVelocity(), dataset_root=str(dataset))
    task.set_variation(red())
    for demos in (task.get_demos(2), task.get_demos(2, live_demos=True)):
        flat = np.array(demos).flatten()
        assert flat.shape == (2,) and flat[0] is demos[0] and flat[1] is demos[1]
        batch = np.random.choice(flat, replace=False)
        assert [seen.joint_velocities.shape for seen in batch] == [(7,)] * len(batch)
        assert np.asarray(demos, dtype=object).shape == (2,)


def test_collisions_are_ignored_where_a_motion_was_not_planned_around_them(catalogue: Path) -> None:
    (demo,) = get_stored_demos(-1, False, catalogue, black(), "pick_and_lift", config_with(), False)
    from stampede import Catalogue

    (episode,) = Catalogue(catalogue).demos("task = 'pick_and_lift'")
    motions = [one for one in episode.segments if one.kind == "motion"]
    for seen in demo:
        assert seen.ignore_collisions.shape == ()
        (motion,) = [one.name for one in motions if one.first_frame <= seen.misc["frame"] < one.end_frame] or ["hold"]
        planned = motion in ("move_to", "move_through")
        assert seen.ignore_collisions == float(not planned), motion
    config = config_with()
    config.record_ignore_collisions = False
    (demo,) = get_stored_demos(-1, False, catalogue, black(), "pick_and_lift", config, False)
    assert demo[0].ignore_collisions is None


def test_paths_instead_of_pictures_and_other_sizes(dataset: Path) -> None:
    config = config_with("front")
    (demo,) = get_stored_demos(1, True, dataset, red(), "reach_target", config, False, 1)
    assert Path(demo[3].front_depth).name == "3.png" and Path(demo[3].front_depth).is_file()
    assert demo[3].front_point_cloud is None and demo.seed == 2
    config.front_camera.image_size = (32, 24)
    (small,) = get_stored_demos(1, False, dataset, red(), "reach_target", config, False)
    assert small[0].front_rgb.shape == (24, 32, 3) and small[0].front_depth.shape == (24, 32)
    assert np.allclose(np.diag(small[0].misc["front_camera_intrinsics"]), [-32.97, -32.97, 1.0], atol=0.01)
    far = small[0].front_depth == 1.0
    table = (small[0].front_point_cloud[..., 2] > 0.74) & (small[0].front_point_cloud[..., 2] < 0.76) & ~far
    assert table.sum() > 60, "the table's top is at 0.75 m"


def test_pickles_of_rlbenchs_own_classes(catalogue: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("PIL")
    folder = tmp_path / "theirs"
    export(["rlbench", str(catalogue), "--out", str(folder), "--cameras", "", "--classes", "rlbench"])
    file = folder / "reach_target" / f"variation{red()}" / "episodes" / "episode0" / "low_dim_obs.pkl"
    assert b"stampede" not in file.read_bytes()
    made = {}
    for module, name in (
        ("rlbench", None),
        ("rlbench.demo", "Demo"),
        ("rlbench.backend", None),
        ("rlbench.backend.observation", "Observation"),
    ):
        stand_in = types.ModuleType(module)
        if name:
            made[name] = type(name, (), {"__module__": module})
            setattr(stand_in, name, made[name])
        monkeypatch.setitem(sys.modules, module, stand_in)
    demo = pickle.loads(file.read_bytes())
    assert type(demo) is made["Demo"] and type(demo._observations[0]) is made["Observation"]
    assert demo._observations[0].joint_positions.shape == (7,) and demo._observations[0].front_rgb is None
    np.random.set_state(demo.random_seed)
    (ours,) = get_stored_demos(1, False, folder, red(), "reach_target", config_with(), False)
    assert np.array_equal(ours[0].joint_positions, demo._observations[0].joint_positions)


def test_an_export_that_was_cut_off_goes_on(catalogue: Path, tmp_path: Path) -> None:
    pytest.importorskip("PIL")
    arguments = ["rlbench", str(catalogue), "--out", str(tmp_path / "out"), "--cameras", ""]
    lines: list[str] = []

    def stop_after_two(line: str) -> None:
        lines.append(line)
        if len(lines) == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        export(arguments, stop_after_two)
    partial = tmp_path / "out" / "pick_and_lift" / "variation1" / "episodes" / ".episode0.partial" / "front_rgb"
    partial.mkdir(parents=True)
    export(arguments, lines.append)
    folders = sorted(one.relative_to(tmp_path / "out").as_posix() for one in (tmp_path / "out").glob("*/*/*/*"))
    assert folders == [
        "pick_and_lift/variation1/episodes/episode0",
        f"reach_target/variation{red()}/episodes/episode0",
        f"reach_target/variation{red()}/episodes/episode1",
    ]
    assert not list((tmp_path / "out").rglob("*.partial"))


def test_broken_datasets_are_told(catalogue: Path, dataset: Path, tmp_path: Path) -> None:
    import shutil

    def load(root: Path, config: ObservationConfig, **more):
        return get_stored_demos(
            more.get("amount", 1), False, root, more.get("variation", red()), "reach_target", config, False
        )

    with pytest.raises(DemoError, match="wrist_rgb: 0 pictures of"):
        load(dataset, config_with("wrist"))
    with pytest.raises(DemoError, match="3 demos of .* are wanted, 2 are there"):
        load(dataset, config_with(), amount=3)
    with pytest.raises(DemoError, match=f"there are variation{red()}"):
        load(dataset, config_with(), variation=red() + 1)
    with pytest.raises(DemoError, match="there is no task 'stack_blocks'\n    there are reach_target"):
        get_stored_demos(1, False, dataset, 0, "stack_blocks", config_with())
    with pytest.raises(DemoError, match="no files of pictures"):
        get_stored_demos(1, True, catalogue, red(), "reach_target", config_with())
    broken = tmp_path / "broken"
    shutil.copytree(dataset, broken)
    episode = broken / "reach_target" / f"variation{red()}" / "episodes" / "episode0"
    (episode / "front_rgb" / "0.png").unlink()
    with pytest.raises(DemoError, match="front_rgb: .* pictures of .* observations"):
        load(broken, config_with("front"))
    whole = (episode / "low_dim_obs.pkl").read_bytes()
    (episode / "low_dim_obs.pkl").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(DemoError, match="no pickled demo"):
        load(broken, config_with())
    (episode / "low_dim_obs.pkl").write_bytes(pickle.dumps(Path("anything")))
    with pytest.raises(DemoError, match="no part of a demo"):
        load(broken, config_with())
    with pytest.raises(Error, match="no seed"):
        demo = load(dataset, config_with())[0]
        demo.seed = None
        task_for(JointVelocity()).reset_to_demo(demo)


def test_an_export_says_what_it_lacks(catalogue: Path, tmp_path: Path) -> None:
    pytest.importorskip("PIL")
    with pytest.raises(Error, match="--draw"):
        export(["rlbench", str(catalogue), "--out", str(tmp_path / "a"), "--cameras", "wrist"])


def test_cameras_of_all_names_are_there() -> None:
    data = shared_environment().get_scene_data()
    assert set(data) == {f"{c}_camera_{what}" for c in CAMERAS for what in ("extrinsics", "intrinsics", "near", "far")}
    assert data["front_camera_intrinsics"][0, 0] == pytest.approx(-175.84, abs=0.01)
    assert data["wrist_camera_intrinsics"][0, 0] == pytest.approx(-110.85, abs=0.01)
    assert np.allclose(data["front_camera_extrinsics"][:3, 3], [1.35, 0, 1.58])
