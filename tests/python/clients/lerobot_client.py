"""LeRobot's own dataset class on an exported folder, v3.0: `lerobot_client.py FOLDER [OTHER]`.

OTHER is what LeRobot's converter made of an export of v2.1: the same samples, pictures too.
"""

import sys

import torch
from lerobot.datasets.lerobot_dataset import LeRobotDataset


def opened(folder):
    return LeRobotDataset("stampede/exported", root=folder, video_backend="pyav")


data = opened(sys.argv[1])
sample = data[len(data) // 2]
assert sample["task"] and sample["observation.state"].shape == (8,) and sample["action"].shape == (8,)
pictures = [name for name in sample if name.startswith("observation.images.")]
assert pictures and all(sample[name].ndim == 3 and 0 < sample[name].mean() < 1 for name in pictures)
batch = next(iter(torch.utils.data.DataLoader(data, batch_size=8, shuffle=True)))
assert batch["action"].shape == (8, 8)
print(f"LeRobot reads {data.num_episodes} episodes, {len(data)} frames; at {len(data) // 2}: {sample.get('subtask')}")

if len(sys.argv) > 2:
    other = opened(sys.argv[2])
    assert len(other) == len(data) and other.num_episodes == data.num_episodes
    ends = {row[key] for row in data.meta.episodes for key in ("dataset_from_index", "dataset_to_index")}
    near = {frame + step for frame in ends for step in (-1, 0, 1)} | set(range(0, len(data), 29))
    for k in sorted(near & set(range(len(data)))):
        ours, theirs = data[k], other[k]
        assert set(theirs) >= set(ours) - {"subtask"}  # the converter leaves meta/subtasks.parquet behind
        for name, value in theirs.items():
            same = torch.equal(value, ours[name]) if isinstance(value, torch.Tensor) else value == ours[name]
            assert same, f"{name} at {k}"
    for name, stats in other.meta.stats.items():
        for which in ("min", "max", "mean", "std"):
            ours = torch.as_tensor(data.meta.stats[name][which])
            assert torch.allclose(torch.as_tensor(stats[which]), ours, atol=1e-4), f"{which} of {name}"
    print(f"its converter makes the same of v2.1: {sys.argv[2]}")
