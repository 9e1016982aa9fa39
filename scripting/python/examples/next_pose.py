"""Where should the hand go next? `python next_pose.py pick_and_lift --from segments` (or keyframes).

Agents such as C2F-ARM (James et al., CVPR 2022) and PerAct (Shridhar et al., CoRL 2022) learn the next pose to go to,
from frames that a rule picks out of each demo: where the gripper changes, and where the arm stands still. A demo that
passes its approach without stopping has no such frame there. The catalogue knows the true ones: the ends of motions,
and the via-points that they pass. Everything else is the same here: network, demos, straight lines that are followed.
"""

import numpy as np
from imitation import OPEN, Rows, Words, demonstrations, fit, joints_of, report, task_arguments
from scipy.spatial.transform import Rotation

import stampede

CHANNELS = ("joint_positions", "gripper_joint_positions", "gripper_pose", "object_pose")
NEAR = 0.006, 0.04  # m, rad: arrived
REACHED = 0.02, 0.1  # m, rad: of a demo, which may pass it
STRIDE = {True: (0.03, 0.15), False: (0.01, 0.05)}  # of the open hand and the closed: m, rad a frame
BESIDE = 0.02, 0.1  # m, rad: the next pose is the same from there
SQUEEZE = 8  # frames that the fingers take
AGAIN = 30  # frames after which the network is asked again, if the hand is still on its way

FRAMES = {
    "keyframes": "SELECT frame FROM keyframes WHERE episode = ?1 AND method = 'stopped'",
    "segments": "SELECT end_frame AS frame FROM segments WHERE episode = ?1 AND kind = 'motion' "
    "UNION SELECT frame FROM vias WHERE episode = ?1",
}


def far(one, other, limits):
    """Whether two poses are further apart than so many m and rad."""
    angle = 2 * np.arccos(min(1.0, abs(one[3:] @ other[3:])))
    return np.linalg.norm(one[:3] - other[:3]) > limits[0] or angle > limits[1]


class NextPoses:
    """Demos of a catalogue as rows to learn from: every frame, with the pose of the next chosen one."""

    def __init__(self, catalogue, rule):
        episodes = stampede.Catalogue(catalogue).demos()
        self.words = Words(sentence for episode in episodes for sentence in episode.instructions())
        used = {name for episode in episodes for s in episode.segments if s.kind == "skill" for name in s.arguments}
        arrays = [episode.arrays(*CHANNELS, "gripper_opening", "action") for episode in episodes]
        posed = [name for name in sorted(used) if f"object_pose/{name}" in arrays[0].keys()]
        begin = {name: [each[f"object_pose/{name}"][0] for each in arrays] for name in posed}
        self.names = [name for name in posed if np.ptp(begin[name], axis=0).max() > 1e-3]
        self.count = 0
        self.rows = [self.read(episode, seen, rule) for episode, seen in zip(episodes, arrays, strict=True)]

    def read(self, episode, seen, rule):
        found = episode.catalogue.query(FRAMES[rule], episode.id)
        chosen = sorted({row["frame"] for row in found if 0 < row["frame"] < episode.frames})
        self.count += len(chosen)
        opening = np.hstack([seen["gripper_opening"][0], seen["action/gripper"]])  # that was told before each frame
        tool, then = seen["gripper_pose"], []
        for now in range(episode.frames):
            ahead = [f for f in chosen if f > now and (opening[f] != opening[now] or far(tool[now], tool[f], REACHED))]
            if not ahead:
                break
            then.append(ahead[0])
        now = slice(0, len(then))
        return Rows(
            hand=tool[now],
            joints=joints_of(seen)[now],
            things=self.things(seen)[now],
            ahead=tool[then][:, None],
            opening=2 * opening[then][:, None] / OPEN - 1,
            sentences=episode.instructions(),
            often=1 / np.bincount(then)[then],  # each pose as often as any other
        )

    def things(self, seen):
        return np.stack([seen[f"object_pose/{name}"] for name in self.names], axis=-2)


class ByPoses:
    """Goes to one pose after the other in straight lines; then the fingers move, and it asks for the next."""

    def __init__(self, network, demos):
        self.network, self.demos = network, demos
        self.opening = OPEN
        self.left = self.squeeze = 0  # frames until the network is asked again, and that the fingers need

    def begin(self, call):
        self.said = self.demos.words(call.instruction)

    def act(self, observation):
        tool = observation["gripper_pose"]
        if self.left == 0:
            joints, things = joints_of(observation), self.demos.things(observation)
            self.goal, self.next_opening = self.network.ask(joints, tool, things, self.said)[0]
            self.left, self.last = AGAIN, None
        way = self.goal[:3] - tool[:3]
        turn = (Rotation.from_quat(self.goal[3:]) * Rotation.from_quat(tool[3:]).inv()).as_rotvec()
        stands = self.last is not None and np.abs(tool - self.last).max() < 1e-4
        self.last = tool.copy()
        self.left -= 1
        if self.squeeze == 0 and far(tool, self.goal, NEAR) and not stands:
            stride = STRIDE[self.opening > 0]
            part = 1 / max(1.0, np.linalg.norm(way) / stride[0], np.linalg.norm(turn) / stride[1])
            turned = Rotation.from_rotvec(part * turn) * Rotation.from_quat(tool[3:])
            return stampede.Action("tool_pose", [*(tool[:3] + part * way), *turned.as_quat()])
        if self.squeeze == 0:
            self.squeeze = 1 if abs(self.opening - self.next_opening) < 0.005 else SQUEEZE
            self.opening = self.next_opening
        self.squeeze -= 1
        self.left = self.squeeze
        return stampede.Action("gripper", [self.opening])


if __name__ == "__main__":
    parser = task_arguments(__doc__, steps=8_000)
    parser.add_argument("--from", dest="rule", choices=sorted(FRAMES), default="segments")
    options = parser.parse_args()
    demos = NextPoses(demonstrations(options.task, options.demos, options.out), options.rule)
    print(f"{demos.count / len(demos.rows):.1f} poses a demo")
    network = fit(demos.rows, demos.words, options.steps, BESIDE, options.seed)
    report(lambda: ByPoses(network, demos), options.task, CHANNELS, options.episodes, options.horizon)
