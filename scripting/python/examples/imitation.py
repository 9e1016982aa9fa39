"""What the examples that learn from demonstrations share: what is seen, the network, its training, its evaluation.

Where to go next is said in several ways: in the frame of the hand, and in that of each thing. A drawer is gripped at
the same place of the drawer wherever that stands, so in the right frame little is left to learn (as in
task-parameterised models: Calinon, 2016, doi:10.1007/s11370-015-0187-9). The likeliest way is done. Demos differ where
nothing that is seen tells why, a cube is gripped by this pair of faces or that, and the mean of two grasps is none.
"""

import argparse
import re
import time
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from scipy.spatial.transform import Rotation
from torch import nn

import stampede

OPEN = 0.08  # m
WAYS = 5  # in each frame
UNITS = torch.tensor([0.005] * 3 + [0.03] * 6 + [0.1])  # m, cosines, opening: differences that matter
SCALE = 20  # UNITS: the network's numbers are about 1
TRUST = 0.01  # in what a way mostly is: the cost of a difference, beside that of an error


@dataclass
class Rows:
    """What is learned from one demo, a row a frame. Poses: x y z, m, and quaternion x y z w, in the world."""

    hand: np.ndarray  # n x 7
    joints: np.ndarray  # n x 9: of the arm, rad, and the fingers, m
    things: np.ndarray  # n x T x 7, of what the network sees
    ahead: np.ndarray  # n x C x 7: where it shall say that the hand goes
    opening: np.ndarray  # n x C, -1 … 1, that the hand has there
    sentences: list[str]  # any of them is said at each row
    often: np.ndarray  # n, how often a row is learned from beside others


class Words:
    """Which words occur in a sentence, 0 or 1 each; rare ones, such as names of colours, are left out."""

    def __init__(self, sentences):
        split = [set(re.findall(r"\w+", sentence)) for sentence in sentences]
        count = Counter(word for words in split for word in words)
        self.all = sorted(word for word in count if count[word] > len(split) / 10)

    def __call__(self, sentence):
        return torch.tensor(np.isin(self.all, re.findall(r"\w+", sentence)), dtype=torch.float32)


def matrices(poses):
    """… x 7 to … x 4 x 4, world_from_frame."""
    turns = Rotation.from_quat(poses[..., 3:].reshape(-1, 4)).as_matrix()
    made = np.zeros((*poses.shape[:-1], 4, 4), dtype=np.float32)
    made[..., :3, :3] = turns.reshape(*poses.shape[:-1], 3, 3)
    made[..., :3, 3], made[..., 3, 3] = poses[..., :3], 1
    return torch.from_numpy(made)


def inverse(frames):
    made = frames.clone()
    made[..., :3, :3] = frames[..., :3, :3].mT
    made[..., :3, 3:] = -made[..., :3, :3] @ frames[..., :3, 3:]
    return made


def numbers(frames):
    """… x 4 x 4 to … x 9: place, and two columns of the rotation, which do not jump (Zhou et al., arXiv:1812.07035)."""
    return torch.cat([frames[..., :3, 3], frames[..., :3, 0], frames[..., :3, 1]], -1)


def pose_of(frame, said):
    """A pose in the world, 7, of nine such numbers that were said in a frame, 4 x 4."""
    x = said[3:6] / np.linalg.norm(said[3:6])
    y = said[6:9] - x * (x @ said[6:9])
    y = y / np.linalg.norm(y)
    turn = Rotation.from_matrix(frame[:3, :3] @ np.stack([x, y, np.cross(x, y)], axis=1))
    return np.hstack([frame[:3, :3] @ said[:3] + frame[:3, 3], turn.as_quat()])


def features(joints, hand, things):
    """What the network sees, n rows: each thing from the hand and from each other. Frames: n x 4 x 4, n x T x 4 x 4."""
    seen = numbers(inverse(hand)[:, None] @ things)
    between = (inverse(things)[:, :, None] @ things[:, None])[..., :3, 3]
    return torch.cat([joints, hand[:, 2], seen.flatten(1), between.flatten(1)], 1)


class Network(nn.Module):
    """Features and words to ways to go on: in each frame WAYS times `chunk` rows of nine numbers and an opening.

    A way is what it mostly is, `usual`, and what is different this once. Their weights are those of a mixture of normal
    distributions (Bishop, Mixture Density Networks, 1994).
    """

    def __init__(self, inputs, frames, chunk, width=512):
        super().__init__()
        self.shape = (frames, WAYS, chunk, 10)
        layers = [nn.Linear(inputs, width), nn.ReLU(), nn.Linear(width, width), nn.ReLU()]
        self.layers = nn.Sequential(*layers, nn.Linear(width, width), nn.ReLU())
        self.usual = nn.Parameter(torch.zeros(self.shape))
        self.other, self.weights = nn.Linear(width, frames * WAYS * chunk * 10), nn.Linear(width, frames * WAYS)
        nn.init.zeros_(self.other.weight), nn.init.zeros_(self.other.bias)
        for name, value in (("middle", 0.0), ("spread", 1.0)):
            self.register_buffer(name, torch.full((inputs,), value))

    def forward(self, seen):
        """What is different, n x frames x WAYS x chunk x 10, and logarithms of weights, n x (frames WAYS)."""
        deep = self.layers(((seen - self.middle) / self.spread).clamp(-5, 5))
        return self.other(deep).reshape(-1, *self.shape), self.weights(deep).log_softmax(1)

    def loss(self, seen, ahead, width):
        """How unlikely what came, n x frames x chunk x 10, was; ways are so many UNITS wide."""
        other, weights = self(seen)
        wrong = (self.usual + other - (ahead / UNITS / SCALE)[:, :, None]).square().sum(-1).mean(-1) / width**2
        costs = SCALE**2 * (wrong + TRUST * other.square().sum(-1).mean(-1))
        return -torch.logsumexp(weights - costs.flatten(1) / 2, 1).mean()

    def ask(self, joints, hand, things, said):
        """Where to go: poses in the world, chunk x 7, and openings, m. hand, things: 7 and T x 7; said: words."""
        frames = matrices(np.vstack([hand, things]))
        with torch.no_grad():
            seen = features(torch.tensor(joints, dtype=torch.float32)[None], frames[None, 0], frames[None, 1:])
            other, weights = self(torch.cat([seen, said[None]], 1))
            frame, way = divmod(int(weights.argmax()), WAYS)
            rows = ((self.usual + other[0])[frame, way] * SCALE * UNITS).numpy()
        return [(pose_of(frames[frame].numpy(), row), self.opening(row[9])) for row in rows]

    def opening(self, said):
        """m: the nearest of those of the demos, for a hand that is almost closed holds nothing."""
        nearest = self.openings[(self.openings - float(said)).abs().argmin()]
        return OPEN * (float(nearest) + 1) / 2


class Batches:
    """Rows of all demos at random, each time with one of a demo's sentences and the open hand a little beside where it
    was: this teaches to come back. beside: standard deviations of that, m and rad."""

    def __init__(self, demos, words, beside, seed):
        self.random, self.beside = np.random.default_rng(seed), np.repeat(beside, 3)
        names = ("hand", "joints", "things", "ahead", "opening", "often")
        joined = {name: np.concatenate([getattr(demo, name) for demo in demos]) for name in names}
        self.hand, self.things, self.ahead = (matrices(joined[name]) for name in ("hand", "things", "ahead"))
        self.joints, self.opening = (torch.tensor(joined[name]).float() for name in ("joints", "opening"))
        self.often = np.cumsum(joined["often"])
        self.owner = np.repeat(np.arange(len(demos)), [len(demo.hand) for demo in demos])
        self.said = [torch.stack([words(sentence) for sentence in demo.sentences]) for demo in demos]

    def draw(self, size):
        """What is seen, size rows, and what comes, size x frames x chunk x 10."""
        rows = np.searchsorted(self.often, self.random.random(size) * self.often[-1])
        moved = self.random.normal(size=(size, 6)) * self.beside * (self.opening[rows, :1].numpy() > 0)
        turned = Rotation.from_rotvec(moved[:, 3:]).as_quat()
        hand = self.hand[rows] @ matrices(np.hstack([moved[:, :3], turned]))
        said = torch.stack([self.said[demo][self.random.integers(len(self.said[demo]))] for demo in self.owner[rows]])
        frames = torch.cat([hand[:, None], self.things[rows]], 1)
        ahead = numbers(inverse(frames)[:, :, None] @ self.ahead[rows][:, None])
        opening = self.opening[rows][:, None, :, None].expand(*ahead.shape[:3], 1)
        seen = features(self.joints[rows], hand, self.things[rows])
        return torch.cat([seen, said], 1), torch.cat([ahead, opening], -1)


def fit(demos, words, steps, beside, seed=0):
    """A network that was trained on the rows of all demos."""
    torch.set_num_threads(1)
    torch.set_flush_denormal(True)  # the weights of ways that are out of the question
    torch.manual_seed(seed)
    batches = Batches(demos, words, beside, seed)
    seen, ahead = batches.draw(5000)
    network = Network(seen.shape[1], ahead.shape[1], ahead.shape[2])
    network.usual.data[:] = ahead[:WAYS].transpose(0, 1) / UNITS / SCALE
    network.openings = batches.opening.unique()
    network.middle[:], network.spread[:] = seen.mean(0), seen.std(0).clamp(min=1e-2)
    optimiser = torch.optim.AdamW(network.parameters(), weight_decay=1e-3)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimiser, 1e-3, total_steps=steps)
    begin, losses = time.perf_counter(), []
    for step in range(1, steps + 1):
        loss = network.loss(*batches.draw(256), width=max(1.0, 10 - 20 * step / steps))  # ways part little by little
        optimiser.zero_grad()
        loss.backward()
        optimiser.step()
        schedule.step()
        losses.append(loss.item())
        if step % (steps // 10) == 0:
            seconds = time.perf_counter() - begin
            print(f"{step} steps, {seconds:.0f} s: loss {np.mean(losses[-steps // 10 :]):.3f}", flush=True)
    return network.eval()


def joints_of(seen):
    """… x 9, of the engine's columns or channels: of the arm, rad, and the fingers, m."""
    return np.hstack([seen["joint_positions"], seen["gripper_joint_positions"]])


def arguments(description, steps):
    """The command line that all of them have."""
    parser = argparse.ArgumentParser(description=description.splitlines()[0])
    parser.add_argument("--demos", type=int, default=200)
    parser.add_argument("--steps", type=int, default=steps, help="of the optimiser")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--episodes", type=int, default=100, help="of the test split, to evaluate with")
    parser.add_argument("--out", default=".build/examples", help="folder for demonstrations")
    return parser


def task_arguments(description, steps):
    """The same, of those that learn a whole task."""
    parser = arguments(description, steps)
    parser.add_argument("task", nargs="?", default="pick_and_lift")
    parser.add_argument("--horizon", type=float, default=60, help="s, simulated")
    return parser


def demonstrations(task, count, folder):
    """A catalogue with so many demos that succeeded; made where there is none."""
    file = Path(folder, f"{task}.db")
    file.parent.mkdir(parents=True, exist_ok=True)
    if not file.exists():
        stampede.Session(catalogue=file).run_all([task], episodes=count, workers=2)
    return file


def report(maker, task, channels, episodes, horizon_s):
    """Success on the test split, with its interval."""
    asked = {"channels": list(channels), "episodes": episodes, "horizon_s": horizon_s}
    row = stampede.evaluate(maker, task, hidden=True, **asked).rows[0]  # demos too have poses of what nobody sees
    print(f"{task}: success {row.success:.2f} [{row.lower:.2f}, {row.upper:.2f}] of {row.episodes} of the test split")
