"""Behaviour cloning from state: `python clone.py pick_and_lift`.

Makes demonstrations, exports them to robomimic's HDF5 and reads them there. The network sees the things that skills
were done with and the words of the instruction. It foretells where the hand is told to be in each of the next frames
(action chunks: Zhao et al., RSS 2023, arXiv:2304.13705).
"""

import json
from pathlib import Path

import h5py
import numpy as np
from imitation import Rows, Words, demonstrations, fit, report, task_arguments
from scipy.spatial.transform import Rotation

import stampede
from stampede.export import export

CHANNELS = ("joint_positions", "gripper_joint_positions", "gripper_pose", "task_low_dim_state")
CHUNK, FOLLOWED = 16, 12  # frames that are foretold, and that are done before the network is asked again
BESIDE = 0.01, 0.05  # m, rad


class Demos:
    """Demos of a file of robomimic's as rows to learn from, and how to find the same in an environment."""

    def __init__(self, file):
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
            self.rows = [self.read(demo, meta["instructions"]) for demo, meta in zip(demos, metas, strict=True)]

    def things(self, low_dim):
        """Poses, … x T x 7, of what skills were done with and what is somewhere else in each demo."""
        return np.stack([low_dim[..., at : at + 7] for at in self.columns], axis=-2)

    def read(self, demo, sentences):
        seen, told = demo["obs"], demo["action_dict"]
        turns = Rotation.from_rotvec(told["abs_rot_axis_angle"]).as_quat()
        targets = np.hstack([told["abs_pos"], turns])
        ahead = np.minimum(np.arange(len(targets))[:, None] + np.arange(CHUNK), len(targets) - 1)
        return Rows(
            hand=np.hstack([seen["robot0_eef_pos"], seen["robot0_eef_quat"]]),
            joints=np.hstack([seen["robot0_joint_pos"], seen["robot0_gripper_qpos"]]),
            things=self.things(seen["object"][:]),
            ahead=targets[ahead],
            opening=told["gripper"][:, 0][ahead],
            sentences=sentences,
            often=np.ones(len(targets)),
        )


class Cloned:
    """The network as what acts in an episode."""

    def __init__(self, network, demos):
        self.network, self.demos, self.plan = network, demos, []

    def begin(self, call):
        self.said = self.demos.words(call.instruction)

    def act(self, observation):
        if not self.plan:
            arm, fingers, tool, low_dim = (observation[name] for name in CHANNELS)
            things = self.demos.things(low_dim)
            self.plan = self.network.ask(np.hstack([arm, fingers]), tool, things, self.said)[:FOLLOWED]
        pose, opening = self.plan.pop(0)
        return stampede.Action("tool_pose", pose, gripper=opening)


if __name__ == "__main__":
    options = task_arguments(__doc__, steps=15_000).parse_args()
    catalogue = demonstrations(options.task, options.demos, options.out)
    folder = Path(options.out, f"{options.task}-robomimic")
    file = folder / f"{options.task}.hdf5"
    if not file.exists():
        export(["robomimic", str(catalogue), "--out", str(folder), "--cameras", ""])
    demos = Demos(file)
    network = fit(demos.rows, demos.words, options.steps, BESIDE, options.seed)
    report(lambda: Cloned(network, demos), options.task, CHANNELS, options.episodes, options.horizon)
