"""HDF5 files with a group a demo. Each demo is a file of its own until all are there.

So an export that is cut off, killed in the middle of a write included, keeps every demo that was finished, and no file
is ever gone on with that may be damaged.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from stampede.catalogue import StoredEpisode
from stampede.export.pieces import Pieces
from stampede.export.steps import ACTIONS, Array, Steps
from stampede.faults import fault

Facts = dict[str, Any]  # as JSON has them


def library() -> Any:
    """h5py. Raises ImportError that says how to install it."""
    try:
        import h5py
    except ImportError as error:
        raise ImportError('h5py is missing\n    pip install "stampede-sim[hdf5]"') from error
    return h5py


def add_action_argument(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--action",
        choices=ACTIONS,
        default="joint_position",
        help="space of the actions, -1 to 1 as stampede.Env(normalise_actions=True) has it (default: %(default)s)",
    )


def scale_of(steps: Steps, action: str) -> Facts:
    """What actions are: their space, a name for each value, and what -1 and 1 stand for, in rad and m.

    And names for the values of further channels."""
    lower, upper = steps.bounds(action)
    return {
        "action_space": action,
        "action_names": steps.action_names(action),
        "action_lower": [*map(float, lower), 0.0],
        "action_upper": [*map(float, upper), steps.opening],
        **({"channel_names": json.dumps(steps.channel_names)} if steps.channels else {}),
    }


def environment_of(task: str, action: str) -> Facts:
    """robomimic's description of the environment that takes the actions."""
    # Readers look for one key or the other; 2 is their number for environments of Gym.
    arguments = {"action": action, "normalise_actions": True}
    return {"env_name": f"stampede/{task}", "type": 2, "env_type": 2, "env_kwargs": arguments}


def put_pictures(group: Any, name: str, pictures: Array) -> None:
    """Pictures of all steps, compressed one by one so that a window is read alone."""
    group.create_dataset(name, data=pictures, chunks=(1, *pictures.shape[1:]), compression="gzip", compression_opts=1)


@dataclass(frozen=True)
class Demo:
    """An episode as it is in a file."""

    name: str  # of its group
    episode: StoredEpisode
    facts: Facts  # of it alone


class DemoFiles:
    """Files with a group for each of their episodes.

    names: the file of each episode, a path in `folder`. group: path of a demo in its file, {} for its number there.
    """

    def __init__(
        self, folder: Path, episodes: Sequence[StoredEpisode], names: Sequence[str], group: str = "data/demo_{}"
    ) -> None:
        self._h5py = library()
        self._folder = folder
        self._group = group
        self._pieces = Pieces(folder)
        self._file_of = {episode.id: name for episode, name in zip(episodes, names, strict=True)}
        self.episodes: dict[str, list[StoredEpisode]] = {}
        for episode, name in zip(episodes, names, strict=True):
            self.episodes.setdefault(name, []).append(episode)
        self._shared: dict[str, tuple[StoredEpisode, Facts]] = {}

    def file_of(self, episode: StoredEpisode) -> str:
        return self._file_of[episode.id]

    def has(self, episode: StoredEpisode) -> bool:
        return (self._folder / self.file_of(episode)).exists() or self._pieces.has(episode.id)

    @contextmanager
    def making(self, episode: StoredEpisode, shared: Facts, own: Facts) -> Iterator[Any]:
        """A group to be filled with the episode. It counts once the block has ended well.

        shared: facts that must be the same for all demos of a file; raises Error where they are not. own: its own.
        `finish` gives both back.
        """
        self._check_shared(episode, shared)
        with self._pieces.making(episode.id) as piece:
            (piece / "facts.json").write_text(json.dumps({"shared": shared, "own": own}))
            with self._h5py.File(piece / "demo.hdf5", "w") as file:
                yield file.create_group("demo")

    def finish(self, complete: Callable[[Any, str, list[Demo], Facts], None]) -> None:
        """Puts the files together. complete(open file, its name, its demos, shared facts) adds what needs all demos."""
        for name, episodes in self.episodes.items():
            final = self._folder / name
            if final.exists():  # made before the export was cut off
                continue
            final.parent.mkdir(parents=True, exist_ok=True)
            part = final.with_name(final.name + ".part")
            with self._h5py.File(part, "w") as file:
                demos = [self._add(file, number, episode) for number, episode in enumerate(episodes)]
                complete(file, name, demos, self._shared[name][1])
            part.replace(final)
        self._pieces.remove()

    def _add(self, file: Any, number: int, episode: StoredEpisode) -> Demo:
        piece = self._pieces.of(episode.id)
        facts = json.loads((piece / "facts.json").read_text())
        self._check_shared(episode, facts["shared"])
        path = self._group.format(number)
        with self._h5py.File(piece / "demo.hdf5", "r") as source:
            source.copy("demo", file, path)
        return Demo(path.rpartition("/")[2], episode, facts["own"])

    def _check_shared(self, episode: StoredEpisode, shared: Facts) -> None:
        first, expected = self._shared.setdefault(self.file_of(episode), (episode, shared))
        different = [key for key in expected if expected[key] != shared[key]]
        if different:
            raise fault(
                f"episode {episode.id}",
                f"its {different[0]} differ from those of episode {first.id}, and both belong into one file",
                "--where exports them apart, for instance by variation or frame_hz",
            )
