"""LeRobot's own dataset class on an exported folder, v3.0: `lerobot_client.py FOLDER`."""

import sys

import torch
from lerobot.datasets.lerobot_dataset import LeRobotDataset

data = LeRobotDataset("stampede/exported", root=sys.argv[1], video_backend="pyav")
sample = data[len(data) // 2]
assert sample["task"] and sample["observation.state"].shape == (8,) and sample["action"].shape == (8,)
pictures = [name for name in sample if name.startswith("observation.images.")]
assert pictures and all(sample[name].ndim == 3 and 0 < sample[name].mean() < 1 for name in pictures)
batch = next(iter(torch.utils.data.DataLoader(data, batch_size=8, shuffle=True)))
assert batch["action"].shape == (8, 8)
print(f"LeRobot reads {data.num_episodes} episodes, {len(data)} frames; at {len(data) // 2}: {sample.get('subtask')}")
