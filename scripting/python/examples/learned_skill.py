"""A learned policy as the body of a skill: `python learned_skill.py`.

The frames of `pick` are cut out of the demonstrations of one task by their ground-truth segments. What is learned from
them sees the one thing that it is called with, so a planner can use it in any task: `learned/skills/pick.lua` takes the
place of the skill that ships, and keeps its precondition and effect.
"""

from pathlib import Path

import numpy as np
from clone import BESIDE, CHUNK, FOLLOWED
from imitation import OPEN, Rows, Words, arguments, demonstrations, fit, joints_of

import stampede

CHANNELS = ("joint_positions", "gripper_joint_positions", "gripper_pose", "object_pose")
CLEAR = 0.08  # m that a thing is lifted by
NO_WORDS = Words([])


def picks(catalogue):
    """Rows to learn from: what each `pick` of a catalogue was told to do."""
    for episode in stampede.Catalogue(catalogue).demos():
        seen = episode.arrays(*CHANNELS, "action")
        for segment in episode.segments:
            if segment.kind == "skill" and segment.name == "pick" and segment.success:
                rows = np.arange(segment.first_frame, segment.end_frame)
                ahead = np.minimum(rows[:, None] + np.arange(CHUNK), rows[-1])
                yield Rows(
                    hand=seen["gripper_pose"][rows],
                    joints=joints_of(seen)[rows],
                    things=seen[f"object_pose/{segment.arguments[0]}"][rows][:, None],
                    ahead=seen["action/tool_pose"][ahead],
                    opening=seen["action/gripper"][ahead] / OPEN * 2 - 1,
                    sentences=[""],
                    often=np.ones(len(rows)),
                )


class ClonedPick:
    """The network as the body of one call of `pick`: done when the thing is clear. The engine tests the effect."""

    def __init__(self, network):
        self.network, self.plan, self.begun_at = network, [], None

    def begin(self, call):
        self.thing = f"object_pose/{call.arguments['obj']}"

    def act(self, observation):
        tool, thing = observation["gripper_pose"], observation[self.thing]
        self.begun_at = thing[2] if self.begun_at is None else self.begun_at
        if thing[2] > self.begun_at + CLEAR:
            return None
        if not self.plan:
            self.plan = self.network.ask(joints_of(observation), tool, thing[None], NO_WORDS(""))[:FOLLOWED]
        pose, opening = self.plan.pop(0)
        return stampede.Action("tool_pose", pose, gripper=opening)


if __name__ == "__main__":
    parser = arguments(__doc__, steps=10_000)
    parser.set_defaults(episodes=50)
    options = parser.parse_args()
    rows = list(picks(demonstrations("pick_and_lift", options.demos, options.out)))
    network = fit(rows, NO_WORDS, options.steps, BESIDE, options.seed)
    session = stampede.Session(paths=[Path(__file__).parent / "learned"])
    session.add_policy("cloned_pick", lambda: ClonedPick(network), channels=list(CHANNELS))
    for task, variation in (("pick_and_lift", ""), ("stack_blocks", "height=2")):
        row = session.evaluate([task], episodes=options.episodes, variation=variation).rows[0]
        print(f"{task}: the planner succeeds in {row.success:.2f} [{row.lower:.2f}, {row.upper:.2f}] of {row.episodes}")
