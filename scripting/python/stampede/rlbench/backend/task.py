"""A task as a class."""


class Task:
    """Names a task of the engine. What it is lies in its Lua file (tasks/README.md); it has no methods to override."""

    task_name: str = ""

    @classmethod
    def get_name(cls) -> str:
        """`reach_target`"""
        return cls.task_name
