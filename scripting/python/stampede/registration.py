"""Names under which Gymnasium makes the tasks that ship, once `stampede` is imported."""

from pathlib import Path

import gymnasium

_TASKS = Path(__file__).parent / "engine" / "share" / "stampede" / "tasks"


def shipped_tasks() -> list[str]:
    """By name. Their files say it: to load them all takes long."""
    return sorted(file.stem for file in _TASKS.glob("*.lua"))


def register_tasks() -> None:
    """Registers `stampede/TASK` (Env, VectorEnv) and `stampede-skills/TASK` (SkillEnv) for every task that ships."""
    for task in shipped_tasks():
        gymnasium.register(
            f"stampede/{task}",
            entry_point="stampede.envs.env:Env",
            vector_entry_point="stampede.envs.vector:VectorEnv",
            kwargs={"task": task},
        )
        gymnasium.register(
            f"stampede-skills/{task}", entry_point="stampede.envs.skill_env:SkillEnv", kwargs={"task": task}
        )
