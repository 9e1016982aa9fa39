"""A task as a class."""

from pathlib import Path

TASKS_PATH = str(Path(__file__).parents[1] / "tasks")  # a folder with a module for each task


class Task:
    """Names a task of the engine. What it is lies in its Lua file (tasks/README.md); it has no methods to override."""

    task_name: str = ""

    @classmethod
    def get_name(cls) -> str:
        """`reach_target`"""
        return cls.task_name
