"""Tasks as environments of Gymnasium: `gymnasium.make("stampede/stack_blocks")`, once `stampede` is imported."""

from .env import Env
from .skill_env import SkillEnv
from .vector import VectorEnv

__all__ = ["Env", "SkillEnv", "VectorEnv"]
