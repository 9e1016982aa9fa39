"""Names under which Gymnasium makes the tasks that ship."""

import gymnasium

from stampede import _core


def register_tasks() -> None:
    """Registers `stampede/TASK` (Env, VectorEnv) and `stampede-skills/TASK` (SkillEnv) for every task that ships."""
    for task in _core.Session().tasks():
        gymnasium.register(
            f"stampede/{task}",
            entry_point="stampede.envs.env:Env",
            vector_entry_point="stampede.envs.vector:VectorEnv",
            kwargs={"task": task},
        )
        gymnasium.register(
            f"stampede-skills/{task}", entry_point="stampede.envs.skill_env:SkillEnv", kwargs={"task": task}
        )
