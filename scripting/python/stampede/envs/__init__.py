"""Tasks as environments of Gymnasium. Importing this registers them: `gymnasium.make("stampede/stack_blocks")`."""

from .env import Env
from .registration import register_tasks

__all__ = ["Env"]

register_tasks()
