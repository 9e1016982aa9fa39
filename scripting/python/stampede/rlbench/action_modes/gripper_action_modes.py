"""How an action moves the fingers."""

from abc import ABC, abstractmethod

import numpy as np

from stampede import _core
from stampede.rlbench.action_modes.arm_action_modes import checked_shape
from stampede.rlbench.backend.scene import Scene

_STALLED_M = 1e-4  # change of the opening in a frame
_MOST_FRAMES = 40
_FRAMES_AFTER_OPENING = 10  # what was let go falls


class GripperActionMode(ABC):
    """The gripper's part of an ActionMode; see there for `channels`."""

    channels: tuple[str, ...] = ()

    @abstractmethod
    def action(self, scene: Scene, action: np.ndarray) -> None:
        """Does it. Raises InvalidActionError for what cannot be done, and nothing has changed then."""

    @abstractmethod
    def action_shape(self, scene: Scene | type[Scene]) -> tuple[int, ...]: ...


class Discrete(GripperActionMode):
    """
    (1,): above 0.5 opens, else closes, until the fingers stop; nothing where they are so already. It opens as far as it
    can beside what stands by its fingers, as in the demos, and further where the arm stands next.

    attach_grasped_objects and detach_before_open change nothing: what is grasped is held by contact.
    """

    def __init__(self, attach_grasped_objects: bool = True, detach_before_open: bool = True) -> None:
        """Arguments as in RLBench."""

    def action(self, scene: Scene, action: np.ndarray) -> None:
        action = checked_shape(action, self.action_shape(scene))
        wants_open = action[0] > 0.5
        if wants_open == (float(scene.numbers["gripper_open"]) > 0.5):
            return
        news = wants_open != scene.told_to_open
        if not news and not (wants_open and scene.stands):
            return  # something holds the fingers: those that close go on by themselves when they can
        if news:
            scene.arrive()
        scene.told_to_open = wants_open
        fingers = _core.Action("release") if wants_open else _core.Action("gripper", [0.0])
        for frame in range(_MOST_FRAMES):
            before = float(scene.numbers["gripper_opening"])
            scene.act(fingers)
            # Fingers start from rest: the first frames may be slower than one in which they have stalled.
            if scene.over or (frame > 1 and abs(float(scene.numbers["gripper_opening"]) - before) < _STALLED_M):
                break
        if wants_open and news:
            scene.act(_core.Action("hold", frames=_FRAMES_AFTER_OPENING - 1))
            scene.act(fingers)  # ends the hold: nothing is left that could go on

    def action_shape(self, scene: Scene | type[Scene]) -> tuple[int, ...]:
        return (1,)


class GripperJointPosition(GripperActionMode):
    """
    (1,) m, position of each finger, 0 … 0.04: towards it for one frame. Clipped to what the hand can do.

    attach_grasped_objects and detach_before_open change nothing: what is grasped is held by contact.
    """

    def __init__(
        self, attach_grasped_objects: bool = True, detach_before_open: bool = True, absolute_mode: bool = True
    ) -> None:
        self._absolute_mode = absolute_mode

    def action(self, scene: Scene, action: np.ndarray) -> None:
        action = checked_shape(action, self.action_shape(scene))
        now = 0.0 if self._absolute_mode else float(scene.numbers["gripper_opening"])
        scene.act(_core.Action("gripper", scene.within_bounds("gripper", now + 2.0 * action)))

    def action_shape(self, scene: Scene | type[Scene]) -> tuple[int, ...]:
        return (1,)
