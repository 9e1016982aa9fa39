"""Behaviour cloning from state: `python clone.py pick_and_lift`.

Makes demonstrations, exports them to robomimic's HDF5 and reads them there. The network sees the things that skills
were done with, as the hand sees them, and the words of the instruction. It foretells where the hand is told to be in
each of the next frames, in the hand's own frame (action chunks: Zhao et al., RSS 2023, arXiv:2304.13705).
"""

import argparse
import json
import re
import time
from collections import Counter
from pathlib import Path

import h5py
import numpy as np
import torch
from scipy.spatial.transform import Rotation
from torch import nn

import stampede
from stampede.export import export

CHANNELS = ("gripper_joint_positions", "gripper_pose", "task_low_dim_state")
OPEN = 0.08  # m
CHUNK, FOLLOWED = 16, 12  # frames that are foretold, and that are done before the network is asked again
COPIES = 8  # of each demo, with the hand a little beside where it was
BESIDE = np.array([4e-3, 4e-3, 4e-3, 2e-2, 2e-2, 2e-2])  # m, rad; standard deviation


def features(fingers, tool, things):
    """What the network sees, a row a frame. fingers: n x 2, m; tool, things: n x 7, m, quaternion x y z w, world."""
    hand = Rotation.from_quat(tool[:, 3:])
    parts = [fingers, tool[:, 2:3], hand.as_matrix()[:, 2]]
    for thing in things:
        parts.append(hand.inv().apply(thing[:, :3] - tool[:, :3]))
        parts.append(two_columns(hand.inv() * Rotation.from_quat(thing[:, 3:])))
    return np.concatenate(parts, axis=1)


def two_columns(rotations):
    """n x 6: what a network can say of a rotation without jumps (Zhou et al., CVPR 2019, arXiv:1812.07035)."""
    return rotations.as_matrix()[:, :, :2].reshape(-1, 6)


def rotation_of(numbers):
    """The rotation whose two columns are nearly these."""
    x, y = np.reshape(numbers, (3, 2)).T
    x = x / np.linalg.norm(x)
    y = y - x * (x @ y)
    y = y / np.linalg.norm(y)
    return Rotation.from_matrix(np.stack([x, y, np.cross(x, y)], axis=1))


def seen_from(tool, places, turns, openings):
    """Poses to go to and openings (-1 … 1), as the network shall say them: n x 10. tool: n x 7, where the hand is."""
    hand = Rotation.from_quat(tool[:, 3:])
    return np.hstack([hand.inv().apply(places - tool[:, :3]), two_columns(hand.inv() * turns), openings[:, None]])


def pose_from(tool, said):
    """The other way: a pose in the world (7), and the opening in m. The hand is told to be open or shut."""
    hand = Rotation.from_quat(tool[3:])
    pose = np.hstack([tool[:3] + hand.apply(said[:3]), (hand * rotation_of(said[3:9])).as_quat()])
    return pose, OPEN * float(said[9] > 0)


class Words:
    """Which words occur in a sentence, 0 or 1 each; rare ones, such as names of colours, are left out."""

    def __init__(self, sentences):
        split = [set(re.findall(r"\w+", sentence)) for sentence in sentences]
        count = Counter(word for words in split for word in words)
        self.all = sorted(word for word in count if count[word] > len(split) / 10)

    def __call__(self, sentence):
        return np.isin(self.all, re.findall(r"\w+", sentence)).astype(np.float32)


class Demos:
    """Demos of a file of robomimic's, as rows to learn from: by demo `features`, `ahead` (n x CHUNK x 10), `said`."""

    def __init__(self, file):
        self.features, self.ahead, self.said = [], [], []
        random = np.random.default_rng(0)
        with h5py.File(file) as data:
            demos = [data["data"][f"demo_{i}"] for i in range(len(data["data"]))]
            metas = [json.loads(demo.attrs["ep_meta"]) for demo in demos]
            self.words = Words(sentence for meta in metas for sentence in meta["instructions"])
            names = [
                str(name).partition("/")[2] for name in data["data"].attrs["state_names"] if "low_dim" in str(name)
            ]
            begin = np.array([demo["obs/object"][0] for demo in demos])
            used = {name for meta in metas for segment in meta["segments"] for name in segment["arguments"]}
            columns = {name: names.index(f"{name}.x") for name in sorted(used) if f"{name}.x" in names}
            self.columns = [at for at in columns.values() if np.ptp(begin[:, at : at + 7], axis=0).max() > 1e-3]
            for demo, meta in zip(demos, metas, strict=True):
                for _ in range(COPIES):
                    self.add(demo, random)
                    self.said.append([self.words(sentence) for sentence in meta["instructions"]])

    def things(self, low_dim):
        """Poses, n x 7 each, of what skills were done with and what is somewhere else in each demo."""
        return [low_dim[:, at : at + 7] for at in self.columns]

    def add(self, demo, random):
        """As if the open hand had been a little beside where it was, and told the same: this teaches to come back."""
        seen, told = demo["obs"], demo["action_dict"]
        openings = told["gripper"][:, 0]
        beside = (openings > 0)[:, None] * random.normal(size=(len(openings), 6)) * BESIDE
        hand = Rotation.from_rotvec(beside[:, 3:]) * Rotation.from_quat(seen["robot0_eef_quat"])
        tool = np.hstack([seen["robot0_eef_pos"] + beside[:, :3], hand.as_quat()])
        places, turns = told["abs_pos"][:], Rotation.from_rotvec(told["abs_rot_axis_angle"])
        ahead = np.minimum(np.arange(len(tool))[:, None] + np.arange(CHUNK), len(tool) - 1)
        self.features.append(features(seen["robot0_gripper_qpos"][:], tool, self.things(seen["object"][:])))
        each = [seen_from(tool, places[then], turns[then], openings[then]) for then in ahead.T]
        self.ahead.append(np.stack(each, axis=1))


class Network(nn.Module):
    """Rows of features and words to `chunk` times ten numbers (see seen_from)."""

    def __init__(self, inputs, chunk, width=512):
        super().__init__()
        layers = [nn.Linear(inputs, width), nn.ReLU(), nn.Linear(width, width), nn.ReLU()]
        self.layers = nn.Sequential(*layers, nn.Linear(width, width), nn.ReLU(), nn.Linear(width, chunk * 10))
        for name, shape in (("middle", inputs), ("spread", inputs), ("mean", (chunk, 10)), ("scale", (chunk, 10))):
            self.register_buffer(name, torch.ones(shape))

    def forward(self, seen):
        seen = ((seen - self.middle) / self.spread).clamp(-5, 5)
        return self.layers(seen).reshape(len(seen), *self.mean.shape) * self.scale + self.mean

    def ask(self, row, words):
        """For one row: chunk x 10."""
        with torch.no_grad():
            return self(torch.tensor(np.concatenate([row, words])[None], dtype=torch.float32))[0].numpy()


def fit(demos, steps, seed=0):
    """Trains by squared error on rows of all demos, each time with one of a demo's sentences."""
    torch.set_num_threads(1)
    torch.manual_seed(seed)
    random = np.random.default_rng(seed)
    owner = np.repeat(np.arange(len(demos.ahead)), [len(rows) for rows in demos.ahead])
    seen = torch.tensor(np.concatenate(demos.features), dtype=torch.float32)
    ahead = torch.tensor(np.concatenate(demos.ahead), dtype=torch.float32)
    said = [torch.tensor(np.array(some), dtype=torch.float32) for some in demos.said]
    network = Network(seen.shape[1] + len(demos.words.all), ahead.shape[1])
    network.middle[: seen.shape[1]], network.spread[: seen.shape[1]] = seen.mean(0), seen.std(0).clamp(min=1e-2)
    network.mean[:], network.scale[:] = ahead.mean(0), ahead.std(0).clamp(min=1e-3)
    optimiser = torch.optim.AdamW(network.parameters(), weight_decay=1e-3)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimiser, 1e-3, total_steps=steps)
    begin, total = time.perf_counter(), 0.0
    for step in range(1, steps + 1):
        batch = random.integers(len(owner), size=256)
        words = torch.stack([said[d][random.integers(len(said[d]))] for d in owner[batch]])
        found = network(torch.cat([seen[batch], words], 1))
        loss = ((found - ahead[batch]) / network.scale).square().mean()
        optimiser.zero_grad()
        loss.backward()
        optimiser.step()
        schedule.step()
        total += loss.item()
        if step % (steps // 10) == 0:
            print(f"{step} steps, {time.perf_counter() - begin:.0f} s: loss {total / (steps // 10):.4f}", flush=True)
            total = 0.0
    return network.eval()


class Cloned:
    """The network as what acts in an episode."""

    def __init__(self, network, demos):
        self.network, self.demos, self.plan = network, demos, []

    def begin(self, call):
        self.words = self.demos.words(call.instruction)

    def act(self, observation):
        if not self.plan:
            fingers, tool, low_dim = (observation[name] for name in CHANNELS)
            row = features(fingers[None], tool[None], self.demos.things(low_dim[None]))[0]
            self.plan = [pose_from(tool, said) for said in self.network.ask(row, self.words)[:FOLLOWED]]
        pose, opening = self.plan.pop(0)
        return stampede.Action("tool_pose", pose, gripper=opening)


def demonstrations(task, count, folder):
    """A catalogue with so many demos that succeeded; made where there is none."""
    file = Path(folder, f"{task}.db")
    file.parent.mkdir(parents=True, exist_ok=True)
    if not file.exists():
        stampede.Session(catalogue=file).run_all([task], episodes=count, workers=2)
    return file


def report(maker, task, channels, episodes, horizon_s):
    """Success on the test split, with its interval."""
    row = stampede.evaluate(maker, task, channels=list(channels), episodes=episodes, horizon_s=horizon_s).rows[0]
    print(f"{task}: success {row.success:.2f} [{row.lower:.2f}, {row.upper:.2f}] of {row.episodes} of the test split")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("task", nargs="?", default="pick_and_lift")
    parser.add_argument("--demos", type=int, default=200)
    parser.add_argument("--steps", type=int, default=15_000, help="of the optimiser")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--episodes", type=int, default=100, help="of the test split, to evaluate with")
    parser.add_argument("--horizon", type=float, default=60, help="s, simulated")
    parser.add_argument("--out", default=".build/examples", help="folder for demonstrations")
    options = parser.parse_args()
    catalogue = demonstrations(options.task, options.demos, options.out)
    files = Path(options.out, f"{options.task}-robomimic")
    export(["robomimic", str(catalogue), "--out", str(files), "--cameras", ""])
    demos = Demos(files / f"{options.task}.hdf5")
    network = fit(demos, options.steps, options.seed)
    report(lambda: Cloned(network, demos), options.task, CHANNELS, options.episodes, options.horizon)
