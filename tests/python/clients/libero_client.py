"""LIBERO's own dataset and its own parser of BDDL on exported files: `libero_client.py FILE…`.

The parser is loaded apart from its package, which wants a simulator.
"""

import importlib.util
import json
import sys
import tempfile
from pathlib import Path

import h5py
import libero
import numpy as np
import torch
from libero.lifelong.datasets import GroupedTaskDataset, SequenceVLDataset, get_dataset

MODALITIES = {"rgb": ["agentview_rgb", "eye_in_hand_rgb"], "depth": [], "low_dim": ["gripper_states", "joint_states"]}
ARGUMENTS = {"in": 2, "on": 2, "open": 1, "close": 1, "turnon": 1, "turnoff": 1}  # LIBERO's predicates

spec = importlib.util.spec_from_file_location("utils", Path(libero.__file__).parent / "libero/envs/bddl_utils.py")
bddl = importlib.util.module_from_spec(spec)
spec.loader.exec_module(bddl)


def check_windows(path):
    """Windows that the dataset gives; what is in them is what is in the file."""
    data, shapes = get_dataset(path, MODALITIES, initialize_obs_utils=True, seq_len=10)
    assert shapes["ac_dim"] == 8 and list(shapes["all_shapes"]["joint_states"]) == [7]
    window = data[3]
    with h5py.File(path) as file:
        demo = file["data"][data.demos[0]]
        assert data.n_demos == file["data"].attrs["num_demos"] and np.allclose(window["actions"], demo["actions"][3:13])
        for name in shapes["all_obs_keys"]:
            seen = window["obs"][name]
            if name.endswith("_rgb") and seen.dtype != np.uint8:  # channels first, 0 … 1
                seen = np.moveaxis(seen, 1, -1) * 255
            assert np.allclose(seen, demo["obs"][name][3:13], atol=1e-3), name
    return data


def check_problem(path):
    """What is refused for want of words has no problem."""
    with h5py.File(path) as file:
        attributes = dict(file["data"].attrs)
    if not attributes["bddl_file_content"]:
        assert attributes["bddl_refusal"]
        return False
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / attributes["bddl_file_name"]
        place.write_text(attributes["bddl_file_content"])
        problem, info = bddl.robosuite_parse_problem(str(place)), bddl.get_problem_info(str(place))
    told = json.loads(attributes["problem_info"])
    assert " ".join(problem["language_instruction"]) == info["language_instruction"] == told["language_instruction"]
    names = {name for group in ("objects", "fixtures") for some in problem[group].values() for name in some}
    names |= set(problem["regions"])
    for predicate, *arguments in problem["initial_state"] + problem["goal_state"]:
        assert len(arguments) == ARGUMENTS[predicate] and set(arguments) <= names, (predicate, arguments)
    assert problem["goal_state"] and set(problem["obj_of_interest"]) <= names
    return True


sets = [check_windows(path) for path in sys.argv[1:]]
problems = sum(check_problem(path) for path in sys.argv[1:])
tasks = GroupedTaskDataset([SequenceVLDataset(data, torch.zeros(4)) for data in sets], torch.zeros(len(sets), 4))
batch = next(iter(torch.utils.data.DataLoader(tasks, batch_size=4, shuffle=True)))
assert batch["actions"].shape == (4, 10, 8) and batch["task_emb"].shape == (4, 4)
print(f"LIBERO reads {len(tasks)} windows of {len(sets)} tasks, and the problems of {problems}")
