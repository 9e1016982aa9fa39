"""robomimic's own dataset class on an exported file: `robomimic_client.py FILE`."""

import sys

from robomimic.utils.dataset import SequenceDataset

data = SequenceDataset(
    hdf5_path=sys.argv[1],
    obs_keys=("robot0_eef_pos", "robot0_joint_pos", "object"),
    dataset_keys=("actions", "rewards", "dones"),
    frame_stack=1,
    seq_length=10,
    pad_frame_stack=True,
    pad_seq_length=True,
    goal_mode=None,
    hdf5_cache_mode=None,
    hdf5_use_swmr=True,
    hdf5_normalize_obs=False,
    filter_by_attribute="train",
    load_next_obs=False,
)
sample = data[len(data) // 2]
assert sample["actions"].shape[0] == 10 and abs(sample["actions"]).max() <= 1
assert sample["obs"]["robot0_joint_pos"].shape == (10, 7)
print(f"robomimic reads {len(data)} windows of {sys.argv[1]}")
