"""How an action moves the arm."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from enum import Enum

import numpy as np

from stampede import _core
from stampede._core import Error
from stampede.rlbench.backend.exceptions import InvalidActionError
from stampede.rlbench.backend.rotations import composed, interpolated, product, rotation_vector
from stampede.rlbench.backend.scene import Scene

_BACK_M = (0.03, 0.08)  # one after the other, out of what the hand touches
_UNIT_TOLERANCE = 1e-3  # of a quaternion's length
_STANDS_RAD = 0.001  # a frame
_TOUCHES_AT_START = "the arm touches something at the start"
_SHUT_M = 0.002  # less wide, the hand is a fist
_OFF_M, _OFF_RAD = 0.005, 0.05
_PRESSES_FRAMES = 8  # standing short of the pose
_MOST_FRAMES = 200  # ten seconds for one action by inverse kinematics


class RelativeFrame(Enum):
    """What a pose is relative to: the world, or the point between the pads where it is now."""

    WORLD = 0
    EE = 1


def checked_shape(action: Sequence[float] | np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    """The action as float64. Raises InvalidActionError where it has another shape, or numbers that are not finite."""
    action = np.asarray(action, dtype=np.float64)
    if action.shape != shape:
        raise InvalidActionError(f"the action has shape {action.shape}\n    this action mode takes {shape}")
    if not np.isfinite(action).all():
        raise InvalidActionError("the action has a number that is not finite\n    give finite numbers")
    return action


class ArmActionMode(ABC):
    """The arm's part of an ActionMode; see there for `channels`."""

    channels: tuple[str, ...] = ()

    @abstractmethod
    def action(self, scene: Scene, action: np.ndarray) -> None:
        """Does it. Raises InvalidActionError for what cannot be done, and nothing has changed then."""

    @abstractmethod
    def action_shape(self, scene: Scene | type[Scene]) -> tuple[int, ...]: ...


class JointVelocity(ArmActionMode):
    """(7,) rad/s, for one frame. Beyond what a joint can do: as fast as it can."""

    def action(self, scene: Scene, action: np.ndarray) -> None:
        action = checked_shape(action, self.action_shape(scene))
        scene.act(_core.Action("joint_velocity", scene.within_bounds("joint_velocity", action)))

    def action_shape(self, scene: Scene | type[Scene]) -> tuple[int, ...]:
        return (scene.joint_count,)


class JointPosition(ArmActionMode):
    """(7,) rad, towards it for one frame: positions, or changes of the measured ones. Clipped to the joints' limits."""

    def __init__(self, absolute_mode: bool = True) -> None:
        self._absolute_mode = absolute_mode

    def action(self, scene: Scene, action: np.ndarray) -> None:
        action = checked_shape(action, self.action_shape(scene))
        target = action if self._absolute_mode else scene.numbers["joint_positions"] + action
        bounded = scene.within_bounds("joint_position", target)
        scene.act(_core.Action("joint_position", bounded, controller=_controller(scene)))

    def action_shape(self, scene: Scene | type[Scene]) -> tuple[int, ...]:
        return (scene.joint_count,)


class JointTorque(ArmActionMode):
    """(7,) N m, beside those that bear the arm's own weight, for one frame. Clipped to what the motors can do."""

    def action(self, scene: Scene, action: np.ndarray) -> None:
        action = checked_shape(action, self.action_shape(scene))
        scene.act(_core.Action("joint_torque", scene.within_bounds("joint_torque", action)))

    def action_shape(self, scene: Scene | type[Scene]) -> tuple[int, ...]:
        return (scene.joint_count,)


class _EndEffectorPose(ArmActionMode):
    """
    (7,): x y z in m and a unit quaternion x y z w, of the point between the pads.

    absolute_mode: the pose; else a change of the present one: moved, and turned about it, along axes of the world.
    frame EE: the pose is in the present frame of the hand, absolute_mode or not. collision_checking: see
    EndEffectorPoseViaPlanning; inverse kinematics alone never minds obstacles.
    """

    def __init__(
        self,
        absolute_mode: bool = True,
        frame: RelativeFrame | str = RelativeFrame.WORLD,
        collision_checking: bool = False,
    ) -> None:
        self._absolute_mode = absolute_mode
        self._frame = _frame_of(frame)
        self._collision_checking = collision_checking

    def action_shape(self, scene: Scene | type[Scene]) -> tuple[int, ...]:
        return (7,)

    def _target(self, scene: Scene, pose: np.ndarray) -> np.ndarray:
        """The pose that is asked for, in the world."""
        length = np.linalg.norm(pose[3:])
        if abs(length - 1.0) > _UNIT_TOLERANCE:
            raise InvalidActionError(
                f"the quaternion of the pose has length {length:.4g}\n"
                "    a pose is x y z and a unit quaternion x y z w: divide it by its length"
            )
        now = scene.numbers["gripper_pose"]
        if self._frame is RelativeFrame.EE:
            return composed(now, pose)
        if self._absolute_mode:
            return pose
        return np.concatenate([now[:3] + pose[:3], product(pose[3:], now[3:])])


def _frame_of(frame: RelativeFrame | str) -> RelativeFrame:
    name = frame.upper() if isinstance(frame, str) else getattr(frame, "name", "")
    named = {"WORLD": RelativeFrame.WORLD, "WORLD FRAME": RelativeFrame.WORLD}
    named |= {"EE": RelativeFrame.EE, "END EFFECTOR": RelativeFrame.EE}
    if name not in named:
        raise Error(f"there is no frame '{frame}'\n    one of RelativeFrame.WORLD, RelativeFrame.EE")
    return named[name]


class EndEffectorPoseViaPlanning(_EndEffectorPose):
    """
    A whole path to the pose. With collision_checking it is planned around obstacles. Without, it is a straight line
    that minds no obstacle, so that the hand can reach what it grasps; where the arm cannot follow the line, a path is
    planned after all.
    """

    _LINE_M = 0.01  # a frame
    _LINE_RAD = 0.05
    _HANDLE = 0.2  # of them, with what may be a handle in the hand, which friction alone holds there

    def action(self, scene: Scene, action: np.ndarray) -> None:
        target = self._target(scene, checked_shape(action, self.action_shape(scene)))
        if scene.over or (not self._collision_checking and self._follows_line(scene, target)):
            return
        try:
            scene.act(_core.Action("tool_path", target))
        except InvalidActionError as error:
            # What the arm touches already is no obstacle on its way off it, as in RLBench; else there is no way.
            if _TOUCHES_AT_START not in str(error):
                raise
            if not self._backs_off(scene, target) and not self._follows_line(scene, target):
                raise

    def _backs_off(self, scene: Scene, target: np.ndarray) -> bool:
        """The way it came, out of what it touches, and on by a planned path. False, with everything as it was: no."""
        start, here = scene.save(), scene.numbers["gripper_pose"]
        for way in _BACK_M:
            if not self._follows_line(scene, composed(here, np.array([0, 0, -way, 0, 0, 0, 1.0]))):
                continue
            if scene.over:
                return True
            try:
                scene.act(_core.Action("tool_path", target))
                return True
            except InvalidActionError:
                scene.restore(start)
        return False

    def _follows_line(self, scene: Scene, target: np.ndarray) -> bool:
        """False, with everything as it was, where the arm cannot."""
        begin = scene.numbers["gripper_pose"]
        way = float(np.linalg.norm(target[:3] - begin[:3]))
        turn = float(np.linalg.norm(rotation_vector(begin[3:], target[3:])))
        controller = _controller(scene)
        pace = self._HANDLE if controller else 1.0
        parts = max(1, int(np.ceil(max(way / self._LINE_M, turn / self._LINE_RAD) / pace)))
        start = scene.save()
        try:
            for part in range(1, parts):
                scene.act(_core.Action("tool_pose", interpolated(begin, target, part / parts), controller=controller))
                if scene.over:
                    return True
            _go_straight(scene, target, controller)
            if controller and _is_off(scene, target):  # what it moves resists: with the motors' whole force
                _go_straight(scene, target)
        except InvalidActionError:
            scene.restore(start)
            return False
        return True


class EndEffectorPoseViaIK(_EndEffectorPose):
    """Inverse kinematics from the present joints, then straight there, until the arm stands."""

    def action(self, scene: Scene, action: np.ndarray) -> None:
        _go_straight(scene, self._target(scene, checked_shape(action, self.action_shape(scene))))


def _controller(scene: Scene) -> str:
    """What a hand has hold of may be a handle, which leads it: the arm then gives way, as in demos. A fist pushes."""
    opening = float(scene.numbers["gripper_opening"])
    return "joint_impedance" if _SHUT_M < opening and float(scene.numbers["gripper_open"]) < 0.5 else ""


def _is_off(scene: Scene, target: np.ndarray) -> bool:
    now = scene.numbers["gripper_pose"]
    turn = float(np.linalg.norm(rotation_vector(now[3:], target[3:])))
    return float(np.linalg.norm(target[:3] - now[:3])) > _OFF_M or turn > _OFF_RAD


def _go_straight(scene: Scene, target: np.ndarray, controller: str = "") -> None:
    """To a pose by inverse kinematics, until the arm stands. Raises InvalidActionError where there is no solution."""
    still = 0
    for frame in range(_MOST_FRAMES):
        before = scene.numbers["joint_positions"]
        try:
            scene.act(_core.Action("tool_pose", target, controller=controller))
        except InvalidActionError:
            if frame == 0:
                raise
            return  # the joints have gone where the solver finds nothing better
        # The arm starts from rest, and what it presses on gives way only after a while.
        still = still + 1 if _moved(scene, before) < _STANDS_RAD else 0
        if scene.over or still >= (_PRESSES_FRAMES if _is_off(scene, target) else 2):
            return


def _moved(scene: Scene, before: np.ndarray) -> float:
    return float(np.abs(scene.numbers["joint_positions"] - before).max())


class ERJointViaIK(_EndEffectorPose):
    """
    A pose and some joints, so that the arm's redundancy is used up: (7 + k,), pose and `commanded_joints`, rad.

    commanded_joints: their indices, one at most for 7 joints. eps: tolerance in m and rad. delta_angle: the joints are
    changes. Raises InvalidActionError, with the state as before, where 50 frames do not lead there.
    """

    channels = ("tool_jacobian",)
    _MOST_FRAMES = 50
    _LARGEST_STEP_RAD = 0.1
    _DAMPING = 1e-3

    def __init__(
        self,
        absolute_mode: bool = True,
        frame: RelativeFrame | str = RelativeFrame.WORLD,
        collision_checking: bool = False,
        commanded_joints: Sequence[int] = (0,),
        eps: float = 1e-3,
        delta_angle: bool = False,
    ) -> None:
        super().__init__(absolute_mode, frame, collision_checking)
        self._commanded = list(commanded_joints)
        self._eps = eps
        self._delta_angle = delta_angle
        if not all(0 <= joint < Scene.joint_count for joint in self._commanded):
            raise Error(f"commanded_joints {self._commanded}: a joint has no such index\n    they go from 0 to 6")

    def action_shape(self, scene: Scene | type[Scene]) -> tuple[int, ...]:
        return (7 + len(self._commanded),)

    def action(self, scene: Scene, action: np.ndarray) -> None:
        action = checked_shape(action, self.action_shape(scene))
        target, angles = self._target(scene, action[:7]), action[7:]
        if self._delta_angle:
            angles = scene.numbers["joint_positions"][self._commanded] + angles
        if scene.over:
            return
        start = scene.save()
        try:
            for _ in range(self._MOST_FRAMES):
                error, away = self._errors(scene, target, angles)
                if max(np.abs(error).max(), np.abs(away).max(initial=0.0)) < self._eps:
                    return
                scene.act(_core.Action("joint_position", self._next_joints(scene, error, away)))
                if scene.over:
                    return
        except InvalidActionError:
            scene.restore(start)
            raise
        scene.restore(start)
        raise InvalidActionError(
            f"{self._MOST_FRAMES} frames of inverse kinematics do not lead to that pose with joints {self._commanded} "
            f"at {np.round(angles, 3).tolist()}\n    a nearer pose, or other angles"
        )

    def _errors(self, scene: Scene, target: np.ndarray, angles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        now = scene.numbers["gripper_pose"]
        error = np.concatenate([target[:3] - now[:3], rotation_vector(now[3:], target[3:])])
        return error, angles - scene.numbers["joint_positions"][self._commanded]

    def _next_joints(self, scene: Scene, error: np.ndarray, away: np.ndarray) -> np.ndarray:
        """One step of damped least squares in the joints that are free; the commanded ones go where they are told."""
        jacobian = scene.numbers["tool_jacobian"]
        free = [joint for joint in range(scene.joint_count) if joint not in self._commanded]
        step = np.zeros(scene.joint_count)
        step[self._commanded] = np.clip(away, -self._LARGEST_STEP_RAD, self._LARGEST_STEP_RAD)
        left = error - jacobian @ step
        part = jacobian[:, free]
        step[free] = part.T @ np.linalg.solve(part @ part.T + self._DAMPING**2 * np.eye(6), left)
        step[free] *= min(1.0, self._LARGEST_STEP_RAD / max(1e-12, float(np.abs(step[free]).max())))
        return scene.within_bounds("joint_position", scene.numbers["joint_positions"] + step)
