"""Tasks as environments of Gymnasium. Importing this registers them: `gymnasium.make("stampede/stack_blocks")`."""

from .env import Env
from .registration import register_tasks
from .skill_env import SkillEnv
from .vector import VectorEnv

__all__ = ["Env", "SkillEnv", "VectorEnv"]

register_tasks()
