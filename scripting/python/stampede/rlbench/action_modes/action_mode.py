"""An arm mode and a gripper mode together."""

from abc import ABC, abstractmethod

import numpy as np

from stampede import _core
from stampede.rlbench.action_modes.arm_action_modes import ArmActionMode, JointPosition, checked_shape
from stampede.rlbench.action_modes.gripper_action_modes import GripperActionMode, GripperJointPosition
from stampede.rlbench.backend.scene import Scene


class ActionMode(ABC):
    """
    How `TaskEnvironment.step` moves the robot.

    A mode of your own overrides `action` and calls `scene.act(stampede.Action(…))`, and `action_shape`. `channels`:
    what it reads of `scene.numbers` beyond the fields of an Observation.
    """

    channels: tuple[str, ...] = ()

    def __init__(self, arm_action_mode: ArmActionMode, gripper_action_mode: GripperActionMode) -> None:
        self.arm_action_mode = arm_action_mode
        self.gripper_action_mode = gripper_action_mode
        self.channels = (*arm_action_mode.channels, *gripper_action_mode.channels)

    @abstractmethod
    def action(self, scene: Scene, action: np.ndarray) -> None:
        """Does it. Raises InvalidActionError for what cannot be done, and nothing has changed then."""

    @abstractmethod
    def action_shape(self, scene: Scene | type[Scene]) -> tuple[int, ...]:
        """Shape of the array that `action` takes."""

    def action_bounds(self) -> tuple[np.ndarray, np.ndarray]:
        """Least and greatest values."""
        raise NotImplementedError("this action mode has no bounds; JointPositionActionMode has")


class MoveArmThenGripper(ActionMode):
    """The arm's part first, to its end, then the gripper's. An action is both, one after the other."""

    def action(self, scene: Scene, action: np.ndarray) -> None:
        action = checked_shape(action, self.action_shape(scene))
        arm_size = int(np.prod(self.arm_action_mode.action_shape(scene)))
        self.arm_action_mode.action(scene, action[:arm_size])
        self.gripper_action_mode.action(scene, action[arm_size:])

    def action_shape(self, scene: Scene | type[Scene]) -> tuple[int, ...]:
        arm, gripper = self.arm_action_mode.action_shape(scene), self.gripper_action_mode.action_shape(scene)
        return (int(np.prod(arm)) + int(np.prod(gripper)),)


class JointPositionActionMode(ActionMode):
    """Changes of the joints (rad) and the position of each finger (m) in one frame; (8,)."""

    def __init__(self) -> None:
        super().__init__(JointPosition(absolute_mode=False), GripperJointPosition(absolute_mode=True))

    def action(self, scene: Scene, action: np.ndarray) -> None:
        action = checked_shape(action, self.action_shape(scene))
        target = scene.within_bounds("joint_position", scene.numbers["joint_positions"] + action[: scene.joint_count])
        opening = scene.within_bounds("gripper", 2.0 * action[scene.joint_count :])
        scene.act(_core.Action("joint_position", target, gripper=float(opening[0])))

    def action_shape(self, scene: Scene | type[Scene]) -> tuple[int, ...]:
        return (scene.joint_count + 1,)

    def action_bounds(self) -> tuple[np.ndarray, np.ndarray]:
        """(8,) each: ±0.1 rad, and 0 … 0.04 m."""
        joints = Scene.joint_count
        return np.array([-0.1] * joints + [0.0]), np.array([0.1] * joints + [Scene.opening_m / 2])
