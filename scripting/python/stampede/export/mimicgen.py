"""MimicGen's source demonstrations: robomimic's files, and for each demo what data generation needs.

`datagen_info` has the poses of tool and objects, the target of the controller, and a subtask signal for each skill: 1
from its end on. The last skill has none. `data.attrs["task_spec"]` is a list of the orders of skills that there are:
{filter_key, variation, subtasks}. `subtasks` is what `MG_TaskSpec.from_json` takes, and `mask/FILTER_KEY` names the
demos that it fits.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from stampede._core import Segment
from stampede.catalogue import StoredEpisode
from stampede.export import robomimic
from stampede.export.hdf5 import Demo, Facts
from stampede.export.steps import Steps, bodies_of, known, matrices


class Writer(robomimic.Writer):
    """Writes FOLDER/TASK.hdf5."""

    def columns(self, episode: StoredEpisode) -> list[str]:
        return [*(["object_pose"] if bodies_of(episode) else []), "facts"]

    def facts(self, steps: Steps) -> Facts:
        entries = {
            f"subtask_{place}": {
                "object_ref": one["object_ref"],
                "subtask_term_signal": one["signal"],
                "subtask_term_offset_range": None,
            }
            for place, one in enumerate(_subtasks(steps), start=1)
        }
        return {"subtasks": entries}

    def write_more(self, demo: Any, steps: Steps) -> None:
        subtasks = _subtasks(steps)
        info = demo.create_group("datagen_info")
        info.attrs["env_interface_name"] = f"Stampede_{steps.episode.task}"
        info.attrs["env_interface_type"] = "stampede"
        info.create_dataset("eef_pose", data=matrices(steps.arrays["gripper_pose"])[:-1])
        info.create_dataset("target_pose", data=matrices(steps.commanded_tool)[1:])
        info.create_dataset("gripper_action", data=steps.gripper[:, None])
        # Things, and the parts and regions of them that a subtask refers to, such as a drawer.
        named = {one["object_ref"] for one in subtasks} - {None}
        for name in sorted(named.union(bodies_of(steps.episode))):
            info.create_dataset(f"object_poses/{name}", data=matrices(known(steps.arrays[f"object_pose/{name}"]))[:-1])
        signals = info.create_group("subtask_term_signals")
        for one in subtasks[:-1]:
            signal = np.arange(1, steps.count + 1) >= one["end"]
            signals.create_dataset(one["signal"], data=signal.astype(np.int64))

    def complete(self, file: Any, name: str, demos: list[Demo], shared: Facts) -> None:
        super().complete(file, name, demos, shared)
        fitting: dict[tuple[str, str], list[str]] = {}
        for demo in demos:
            fitting.setdefault((demo.episode.variation, json.dumps(demo.facts["subtasks"])), []).append(demo.name)
        specs = []
        for place, ((variation, subtasks), names) in enumerate(fitting.items(), start=1):
            key = f"task_spec_{place}"
            robomimic.put_filter(file, key, names)
            specs.append({"filter_key": key, "variation": variation, "subtasks": json.loads(subtasks)})
        file["data"].attrs["task_spec"] = json.dumps(specs)


def _subtasks(steps: Steps) -> list[Facts]:
    """Skills in time that have steps of their own: signal (a name of its own in the demo; the last has None),
    object_ref (None: it has no thing) and end, the first step after it."""
    counts: dict[str, int] = {}
    subtasks: list[Facts] = []
    previous = 1  # an edge needs a step before it
    for skill in steps.skills:
        end = min(skill.end_frame, steps.count)
        if end <= previous:
            continue
        previous = end
        counts[skill.name] = counts.get(skill.name, 0) + 1
        refers = _reference(steps, skill)
        subtasks.append({"signal": f"{skill.name}_{counts[skill.name]}", "object_ref": refers, "end": end})
    if not subtasks:
        subtasks.append({"object_ref": None})
    subtasks[-1] |= {"signal": None, "end": steps.count}
    return subtasks


def _reference(steps: Steps, skill: Segment) -> str | None:
    """The thing relative to which the hand moves: the skill's first that is not in the hand already, else its first."""
    things = [name for name in skill.arguments if f"object_pose/{name}" in steps.arrays]  # none of a real one
    facts = steps.arrays["facts"][skill.first_frame]
    held = {
        atom.arguments[1]
        for atom, holds in zip(steps.arrays.atoms, facts, strict=True)
        if holds and atom.predicate == "holding"
    }
    return next((name for name in things if name not in held), things[0] if things else None)
