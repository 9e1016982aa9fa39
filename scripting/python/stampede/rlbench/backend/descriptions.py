"""What a task is called in words."""

import shutil
import tempfile
import weakref
from pathlib import Path

from stampede import _core


class Descriptions:
    """
    Sentences of tasks by variation. The engine makes them with an episode, so an empty one is kept in a catalogue that
    goes with this object.
    """

    def __init__(self, paths: list[Path]) -> None:
        folder = tempfile.mkdtemp(prefix="stampede-rlbench-")
        weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
        self._session = _core.Session(paths=paths, catalogue=Path(folder) / "descriptions.db")
        self._known: dict[tuple[str, str], list[str]] = {}

    def of(self, task: str, variation: str, seed: int) -> list[str]:
        """All sentences of a variation. seed: of a start that can be made."""
        if (task, variation) not in self._known:
            environment = self._session.environment(task, channels=["time"], record=True)
            environment.reset(_core.Reset(variation=variation, seed=seed))
            episode = environment.episode()
            _, rows = self._session.query(
                f"SELECT text FROM instructions WHERE episode = {episode.id} AND level = 'task' ORDER BY ordinal"
            )
            self._known[task, variation] = [row[0] for row in rows]
        return list(self._known[task, variation])
