"""ManiSkill's own dataset class and its functions on exported trajectories: `maniskill_client.py FILE.h5`."""

import json
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np
import torch
from mani_skill.trajectory import utils
from mani_skill.trajectory.dataset import ManiSkillTrajectoryDataset
from mani_skill.trajectory.merge_trajectory import merge_trajectories

path = sys.argv[1]
described = json.loads(Path(path).with_suffix(".json").read_text())
data = ManiSkillTrajectoryDataset(path, success_only=True)
assert len(data) == sum(one["elapsed_steps"] for one in described["episodes"])
with h5py.File(path) as file:
    first = file["traj_0"]
    count = len(first["actions"])
    assert np.array_equal(data[5]["action"], first["actions"][5])
    assert np.array_equal(data[5]["obs"]["agent"]["qpos"], first["obs/agent/qpos"][5])
    states = utils.dict_to_list_of_dicts(first["env_states"])
    assert len(states) == count + 1
    for state in states[0]["actors"].values():
        assert state.shape == (13,) and np.isclose(np.linalg.norm(state[3:7]), 1)
    robot = states[0]["articulations"]["panda"]  # pose of the base, its velocities, joints, their velocities
    assert robot.shape == (31,) and np.isclose(np.linalg.norm(robot[3:7]), 1)
    assert np.allclose(robot[13:22], first["obs/agent/qpos"][0])
batch = next(iter(torch.utils.data.DataLoader(data, batch_size=4, shuffle=True)))
assert batch["action"].shape == (4, 8) and batch["obs"]["extra"]["tcp_pose"].shape == (4, 7)
with tempfile.TemporaryDirectory() as folder:
    merged = str(Path(folder) / "merged.h5")
    merge_trajectories(merged, [path, path])
    assert len(ManiSkillTrajectoryDataset(merged)) == 2 * len(data)
print(f"ManiSkill reads {len(described['episodes'])} trajectories, {len(data)} steps of {path}")
