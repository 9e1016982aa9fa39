"""What a task is called in words."""

from stampede import _core


class Descriptions:
    """Sentences of tasks by variation, made once each."""

    def __init__(self, session: _core.Session) -> None:
        self._session = session
        self._known: dict[tuple[str, str], list[str]] = {}

    def of(self, task: str, variation: str, seed: int) -> list[str]:
        """All sentences of a variation. seed: of a start that can be made."""
        if (task, variation) not in self._known:
            environment = self._session.environment(task, channels=["time"])
            environment.reset(_core.Reset(variation=variation, seed=seed))
            self._known[task, variation] = environment.instructions()
        return list(self._known[task, variation])
