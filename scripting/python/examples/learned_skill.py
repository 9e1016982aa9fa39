"""A learned policy as the body of a skill: `python learned_skill.py`.

The frames of `pick` are cut out of the demonstrations of one task by their ground-truth segments. What is learned from
them sees the one thing that it is called with, so a planner can use it in any task: `learned/skills/pick.lua` takes the
place of the skill that ships, and keeps its precondition and effect.
"""

import argparse
from pathlib import Path

import numpy as np
from clone import BESIDE, CHUNK, COPIES, FOLLOWED, OPEN, Words, demonstrations, features, fit, pose_from, seen_from
from scipy.spatial.transform import Rotation

import stampede

CHANNELS = ("gripper_joint_positions", "gripper_pose", "object_pose")
CLEAR = 0.08  # m that a thing is lifted by


class Picks:
    """Rows to learn from: what each `pick` of a catalogue was told to do."""

    def __init__(self, catalogue):
        self.features, self.ahead, self.said = [], [], []
        self.words = Words([])
        random = np.random.default_rng(0)
        for episode in stampede.Catalogue(catalogue).demos():
            seen = episode.arrays(*CHANNELS, "action")
            for segment in episode.segments:
                if segment.kind == "skill" and segment.name == "pick" and segment.success:
                    for _ in range(COPIES):
                        self.add(seen, segment, random)
                        self.said.append([self.words("")])

    def add(self, seen, segment, random):
        rows = np.arange(segment.first_frame, segment.end_frame)
        tool, told, openings = (
            seen["gripper_pose"][rows],
            seen["action/tool_pose"],
            seen["action/gripper"] / OPEN * 2 - 1,
        )
        beside = (openings[rows] > 0)[:, None] * random.normal(size=(len(rows), 6)) * BESIDE
        hand = Rotation.from_rotvec(beside[:, 3:]) * Rotation.from_quat(tool[:, 3:])
        tool = np.hstack([tool[:, :3] + beside[:, :3], hand.as_quat()])
        each = []
        for k in range(CHUNK):
            then = np.minimum(rows + k, rows[-1])
            each.append(seen_from(tool, told[then, :3], Rotation.from_quat(told[then, 3:]), openings[then]))
        thing = seen[f"object_pose/{segment.arguments[0]}"][rows]
        self.features.append(features(seen["gripper_joint_positions"][rows], tool, [thing]))
        self.ahead.append(np.stack(each, axis=1))


class ClonedPick:
    """The network as the body of one call of `pick`: done when the thing is clear. The engine tests the effect."""

    def __init__(self, network):
        self.network, self.plan, self.begun_at = network, [], None

    def begin(self, call):
        self.thing = f"object_pose/{call.arguments['obj']}"

    def act(self, observation):
        fingers, tool, thing = (observation[name] for name in (*CHANNELS[:2], self.thing))
        self.begun_at = thing[2] if self.begun_at is None else self.begun_at
        if thing[2] > self.begun_at + CLEAR:
            return None
        if not self.plan:
            row = features(fingers[None], tool[None], [thing[None]])[0]
            self.plan = [pose_from(tool, said) for said in self.network.ask(row, [])[:FOLLOWED]]
        pose, opening = self.plan.pop(0)
        return stampede.Action("tool_pose", pose, gripper=opening)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--demos", type=int, default=200)
    parser.add_argument("--steps", type=int, default=10_000, help="of the optimiser")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--episodes", type=int, default=50, help="of the test split, to evaluate with")
    parser.add_argument("--out", default=".build/examples", help="folder for demonstrations")
    options = parser.parse_args()
    network = fit(Picks(demonstrations("pick_and_lift", options.demos, options.out)), options.steps, options.seed)
    session = stampede.Session(paths=[Path(__file__).parent / "learned"])
    session.add_policy("cloned_pick", lambda: ClonedPick(network), channels=list(CHANNELS))
    for task, variation in (("pick_and_lift", ""), ("stack_blocks", "height=2")):
        row = session.evaluate([task], episodes=options.episodes, variation=variation).rows[0]
        print(f"{task}: the planner succeeds in {row.success:.2f} [{row.lower:.2f}, {row.upper:.2f}] of {row.episodes}")
