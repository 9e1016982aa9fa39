"""Where should the hand go next? `python next_pose.py pick_and_lift --from segments` (or keyframes).

Agents such as C2F-ARM (James et al., CVPR 2022) and PerAct (Shridhar et al., CoRL 2022) learn the next pose to go to,
from frames that a rule picks out of each demo: where the gripper changes, and where the arm stands still. A demo that
passes its approach without stopping has no such frame there. The catalogue knows the true ones: the ends of motions,
and the via-points that they pass. Everything else is the same here: network, demos, straight lines that are followed.
"""

import argparse

import numpy as np
from clone import OPEN, Words, demonstrations, features, fit, pose_from, report, seen_from
from scipy.spatial.transform import Rotation

import stampede

CHANNELS = ("gripper_joint_positions", "gripper_pose", "object_pose")
NEAR = 0.006, 0.04  # m, rad: arrived
SOON = 4  # frames: a pose that is as near as that counts as reached
STRIDE = 0.05, 0.2  # m, rad a frame: how far ahead on the line the hand is told to go
SQUEEZE = 8  # frames that the fingers take
AGAIN = 15  # frames after which the network is asked again, if the hand is still on its way

FRAMES = {
    "keyframes": "SELECT frame FROM keyframes WHERE episode = ?1 AND method = 'stopped'",
    "segments": "SELECT end_frame AS frame FROM segments WHERE episode = ?1 AND kind = 'motion' "
    "UNION SELECT frame FROM vias WHERE episode = ?1",
}


class NextPoses:
    """Demos of a catalogue as rows to learn from: every frame, with the pose of the next chosen one."""

    def __init__(self, catalogue, rule):
        self.features, self.ahead, self.said = [], [], []
        episodes = stampede.Catalogue(catalogue).demos()
        self.words = Words(sentence for episode in episodes for sentence in episode.instructions())
        used = {name for episode in episodes for s in episode.segments if s.kind == "skill" for name in s.arguments}
        arrays = [episode.arrays(*CHANNELS, "action") for episode in episodes]
        posed = [name for name in sorted(used) if f"object_pose/{name}" in arrays[0].keys()]
        begin = {name: [each[f"object_pose/{name}"][0] for each in arrays] for name in posed}
        self.names = [name for name in posed if np.ptp(begin[name], axis=0).max() > 1e-3]
        self.count = 0
        for episode, seen in zip(episodes, arrays, strict=True):
            rows = episode.catalogue.query(FRAMES[rule], episode.id)
            self.add(seen, sorted({row["frame"] for row in rows if 0 < row["frame"] < episode.frames}))
            self.said.append([self.words(sentence) for sentence in episode.instructions()])

    def add(self, seen, chosen):
        self.count += len(chosen)
        tool = seen["gripper_pose"]
        then = np.array([next(frame for frame in chosen if frame > now + SOON) for now in range(chosen[-1] - SOON)])
        now = slice(0, len(then))
        openings = 2 * seen["action/gripper"][then - 1] / OPEN - 1
        ahead = seen_from(tool[now], tool[then, :3], Rotation.from_quat(tool[then, 3:]), openings)
        self.features.append(features(seen["gripper_joint_positions"][now], tool[now], self.things(seen, now)))
        self.ahead.append(ahead[:, None])

    def things(self, seen, rows):
        return [seen[f"object_pose/{name}"][rows] for name in self.names]


class ByPoses:
    """Goes to one pose after the other in straight lines; then the fingers move, and it asks for the next."""

    def __init__(self, network, demos):
        self.network, self.demos = network, demos
        self.opening = OPEN
        self.left = self.squeeze = 0  # frames until the network is asked again, and that the fingers need

    def begin(self, call):
        self.words = self.demos.words(call.instruction)

    def act(self, observation):
        tool = observation["gripper_pose"]
        if self.left == 0:
            row = features(
                observation["gripper_joint_positions"][None], tool[None], self.demos.things(observation, None)
            )[0]
            self.goal, self.next_opening = pose_from(tool, self.network.ask(row, self.words)[0])
            self.left, self.last = AGAIN, None
        way = self.goal[:3] - tool[:3]
        turn = (Rotation.from_quat(self.goal[3:]) * Rotation.from_quat(tool[3:]).inv()).as_rotvec()
        far, angle = np.linalg.norm(way), np.linalg.norm(turn)
        stands = self.last is not None and np.abs(tool - self.last).max() < 1e-4
        self.last = tool.copy()
        self.left -= 1
        if self.squeeze == 0 and (far > NEAR[0] or angle > NEAR[1]) and not stands:
            part = min(1.0, STRIDE[0] / max(far, 1e-9), STRIDE[1] / max(angle, 1e-9))
            turned = Rotation.from_rotvec(part * turn) * Rotation.from_quat(tool[3:])
            return stampede.Action("tool_pose", [*(tool[:3] + part * way), *turned.as_quat()])
        if self.squeeze == 0:
            self.squeeze = 1 if self.opening == self.next_opening else SQUEEZE
            self.opening = self.next_opening
        self.squeeze -= 1
        self.left = self.squeeze
        return stampede.Action("gripper", [self.opening])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("task", nargs="?", default="pick_and_lift")
    parser.add_argument("--from", dest="rule", choices=sorted(FRAMES), default="segments")
    parser.add_argument("--demos", type=int, default=200)
    parser.add_argument("--steps", type=int, default=8_000, help="of the optimiser")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--episodes", type=int, default=100, help="of the test split, to evaluate with")
    parser.add_argument("--horizon", type=float, default=60, help="s, simulated")
    parser.add_argument("--out", default=".build/examples", help="folder for demonstrations")
    options = parser.parse_args()
    demos = NextPoses(demonstrations(options.task, options.demos, options.out), options.rule)
    print(f"{demos.count / len(demos.features):.1f} poses a demo")
    network = fit(demos, options.steps, options.seed)
    report(lambda: ByPoses(network, demos), options.task, CHANNELS, options.episodes, options.horizon)
