"""How many demos do their task again: keyframe_replay.py [TASK…] [--demos N] [--sixth] [--plain]

Each demo is gone back to and played three ways: by the keyframes that PerAct's rule finds in it (its poses, its hand and its
`ignore_collisions`, as an agent that has learned it without error would predict them), by every sixth frame instead
(--sixth), and by its joint positions. An arm that touches something goes carefully and may be late for its joint
positions: the last of them is asked for up to two seconds on, and how long is said. Prints one line a demo, and the shares.
"""

import argparse

import numpy as np

from stampede.rlbench.action_modes.action_mode import ActionMode, MoveArmThenGripper
from stampede.rlbench.action_modes.arm_action_modes import EndEffectorPoseViaPlanning, JointPosition
from stampede.rlbench.action_modes.gripper_action_modes import Discrete
from stampede.rlbench.backend.exceptions import DemoError, InvalidActionError
from stampede.rlbench.environment import Environment
from stampede.rlbench.observation_config import ObservationConfig
from stampede.rlbench.tasks import task_of


WAIT = 40  # frames of 50 ms


class KeyframeMode(ActionMode):
    """(9,): pose, hand, whether collisions are ignored: PerAct's action."""

    def __init__(self) -> None:
        super().__init__(EndEffectorPoseViaPlanning(), Discrete())
        self._arms = [EndEffectorPoseViaPlanning(collision_checking=wanted) for wanted in (True, False)]

    def action(self, scene, action) -> None:
        self._arms[int(action[8])].action(scene, action[:7])
        self.gripper_action_mode.action(scene, action[7:8])

    def action_shape(self, scene) -> tuple[int, ...]:
        return (9,)


def keyframes(demo) -> list[int]:
    """PerAct's rule; the code of ARM."""
    found, buffer = [], 0
    before = demo[0].gripper_open
    for i, seen in enumerate(demo):
        is_next_to_last = i == len(demo) - 2
        steady = i < len(demo) - 2 and (
            seen.gripper_open == demo[i + 1].gripper_open == demo[i - 1].gripper_open == demo[i - 2].gripper_open
        )
        still = np.allclose(seen.joint_velocities, 0, atol=0.1)
        stopped = buffer <= 0 and still and not is_next_to_last and steady
        buffer = 4 if stopped else buffer - 1
        if i != 0 and (seen.gripper_open != before or i == len(demo) - 1 or stopped):
            found.append(i)
        before = seen.gripper_open
    if len(found) > 1 and found[-1] - 1 == found[-2]:
        found.pop(-2)
    return found


def reaches_goal(task, demo, actions) -> tuple[str, int]:
    """Why not, empty: it does; and after how many actions that was known."""
    task.reset_to_demo(demo)
    for number, action in enumerate(actions, 1):
        try:
            _, reward, over = task.step(action)
        except InvalidActionError as error:
            return f"action {number} of {len(actions)}: {error}".split("\n")[0], number
        if reward == 1.0:
            return "", number
        if over:
            return f"over after action {number} of {len(actions)}", number
    return f"not done after {len(actions)}", len(actions)


def pose_actions(demo, frames) -> list[np.ndarray]:
    return [
        np.array([*demo[i].gripper_pose, demo[i].gripper_open, float(demo[max(0, i - 1)].ignore_collisions)])
        for i in frames
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tasks", nargs="*", help="default: all")
    parser.add_argument("--demos", type=int, default=3, help="of each task")
    parser.add_argument("--sixth", action="store_true")
    parser.add_argument("--plain", action="store_true", help="demos that pass their via-points without stopping")
    options = parser.parse_args()
    config = ObservationConfig()
    config.set_all_high_dim(False)
    poses = Environment(KeyframeMode(), obs_config=config)
    joints = Environment(MoveArmThenGripper(JointPosition(), Discrete()), obs_config=config)
    made = {"stop_at_vias": True} if not options.plain else {}
    counts = {"keyframes": 0, "sixth": 0, "joints": 0}
    total = waited = 0
    for name in options.tasks or poses.session.tasks():
        ways = poses.get_task(task_of(name))
        steps = joints.get_task(task_of(name))
        for number in range(options.demos):
            np.random.seed(number)
            ways.set_variation(number % ways.variation_count())
            try:
                demo = ways.get_demos(1, live_demos=True, **made)[0]
            except DemoError as error:
                print(f"{name} {number}: no demo: {error}".split("\n")[0], flush=True)
                continue
            total += 1
            found = keyframes(demo)
            told = {"keyframes": reaches_goal(ways, demo, pose_actions(demo, found))[0]}
            if options.sixth:
                sixth = [*range(6, len(demo) - 1, 6), len(demo) - 1]
                told["sixth"] = reaches_goal(ways, demo, pose_actions(demo, sixth))[0]
            told["joints"], late = joints_replay(steps, demo)
            waited += late > 0
            for kind, why in told.items():
                counts[kind] += not why
            words = ", ".join(f"{kind}: {why or 'done'}" for kind, why in told.items())
            words += f" {late} frames late" if late else ""
            print(f"{name} {number}: {len(demo)} frames, {len(found)} keyframes {found}; {words}", flush=True)
    for kind, count in counts.items():
        print(f"{kind}: {count} of {total}" + (f", {waited} of them late" if kind == "joints" else ""))


def joints_replay(task, demo) -> tuple[str, int]:
    """Why not, and how many frames late."""
    actions = [seen.misc["joint_position_action"] for seen in demo[1:]]
    why, taken = reaches_goal(task, demo, actions + [actions[-1]] * WAIT)
    return why, 0 if why else max(0, taken - len(actions))


main()
