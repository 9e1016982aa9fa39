"""robomimic's info script and dataset class on an exported file: `robomimic_client.py FILE [OBSERVATION…]`.

LIBERO reads its files with the same class: `robomimic_client.py FILE agentview_rgb joint_states gripper_states`.
"""

import subprocess
import sys

import h5py
import numpy as np
import torch
from robomimic.utils.dataset import SequenceDataset

path = sys.argv[1]
observed = tuple(sys.argv[2:]) or ("robot0_eef_pos", "robot0_joint_pos", "object")
# It fails where actions are not within -1 … 1.
subprocess.run([sys.executable, "-m", "robomimic.scripts.get_dataset_info", "--dataset", path], check=True)
with h5py.File(path) as file:
    split = "train" if "mask/train" in file else None
    first = file["data/demo_0/obs"]
    expected = {key: first[key][3] for key in observed}

data = SequenceDataset(
    hdf5_path=path,
    obs_keys=observed,
    dataset_keys=("actions", "rewards", "dones"),
    frame_stack=1,
    seq_length=10,
    pad_frame_stack=True,
    pad_seq_length=True,
    goal_mode=None,
    hdf5_cache_mode=None,
    hdf5_use_swmr=True,
    hdf5_normalize_obs=False,
    filter_by_attribute=split,
    load_next_obs=False,
)
if data.demos[0] == "demo_0":
    assert all(np.allclose(data[0]["obs"][key][3], expected[key]) for key in observed)
batch = next(iter(torch.utils.data.DataLoader(data, batch_size=8, shuffle=True)))
assert batch["actions"].shape == (8, 10, 8) and batch["actions"].abs().max() <= 1
for key in observed:
    assert batch["obs"][key].shape == (8, 10, *expected[key].shape), key
print(f"robomimic reads {len(data)} windows of {path}")
