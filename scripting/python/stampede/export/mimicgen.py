"""MimicGen's source demonstrations: robomimic's files, and for each demo what data generation needs.

`datagen_info` has the poses of tool and objects, the target of the controller, and a subtask signal for each skill: 1
from its end on. The last skill has none. `data.attrs["task_spec"]` names, for each variation, the skills in order and
the object that each refers to, as MimicGen's task specifications do.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from stampede.catalogue import StoredEpisode
from stampede.export import robomimic
from stampede.export.steps import Steps, bodies_of, known, matrices


class Writer(robomimic.Writer):
    """Writes FOLDER/TASK.hdf5."""

    def columns(self, episode: StoredEpisode) -> list[str]:
        return [f"object_pose/{name}" for name in bodies_of(episode)]

    def write_more(self, demo: Any, data: Any, steps: Steps) -> None:
        info = demo.create_group("datagen_info")
        info.attrs["env_interface_name"] = f"Stampede_{steps.episode.task}"
        info.attrs["env_interface_type"] = "stampede"
        info.create_dataset("eef_pose", data=matrices(steps.arrays["gripper_pose"])[:-1])
        info.create_dataset("target_pose", data=matrices(steps.commanded_tool)[1:])
        info.create_dataset("gripper_action", data=steps.gripper[:, None])
        poses = info.create_group("object_poses")
        for name in bodies_of(steps.episode):
            poses.create_dataset(name, data=matrices(known(steps.arrays[f"object_pose/{name}"]))[:-1])
        signals = info.create_group("subtask_term_signals")
        subtasks = self._subtasks(steps)
        for subtask in subtasks[:-1]:
            signal = np.arange(1, steps.count + 1) >= subtask["end_frame"]
            signals.create_dataset(subtask["signal"], data=signal.astype(np.int64))
        subtasks[-1]["signal"] = None
        specs = json.loads(data.attrs.get("task_spec", "{}"))
        specs[steps.episode.variation] = [{k: one[k] for k in ("signal", "object_ref")} for one in subtasks]
        data.attrs["task_spec"] = json.dumps(specs)

    @staticmethod
    def _subtasks(steps: Steps) -> list[dict[str, Any]]:
        """Skills in time: signal (a name of its own in the demo), object_ref, end_frame."""
        counts: dict[str, int] = {}
        subtasks: list[dict[str, Any]] = []
        for skill in steps.skills:
            counts[skill.name] = counts.get(skill.name, 0) + 1
            refers = skill.arguments[0] if skill.arguments else None
            subtasks.append(
                {"signal": f"{skill.name}_{counts[skill.name]}", "object_ref": refers, "end_frame": skill.end_frame}
            )
        return subtasks or [{"signal": "all_1", "object_ref": None, "end_frame": steps.count}]
