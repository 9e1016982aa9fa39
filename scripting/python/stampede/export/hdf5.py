"""HDF5 files that are written demo by demo, and go on where they were cut off."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from stampede.catalogue import StoredEpisode
from stampede.export.steps import ACTIONS, Array
from stampede.faults import fault

_WHOLE = "stampede_whole"  # attribute of a demo of which nothing is missing


def library() -> Any:
    """h5py. Raises ImportError that says how to install it."""
    try:
        import h5py
    except ImportError as error:
        raise ImportError('h5py is missing\n    pip install "stampede[hdf5]"') from error
    return h5py


def add_action_argument(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--action",
        choices=ACTIONS,
        default="joint_position",
        help="space of the actions, -1 to 1 as stampede.Env(normalise_actions=True) has it (default: %(default)s)",
    )


class GrowingFile:
    """An HDF5 file under a temporary name until `finish`; `NAME.part` beside it meanwhile.

    What an export that was cut off left is gone on with where HDF5 can open it, and thrown away where it cannot.
    """

    def __init__(self, path: Path) -> None:
        h5py = library()
        self.path = path
        self._part = path.with_name(path.name + ".part")
        if path.exists():
            raise fault(str(path), "the file is there already", "name another folder")
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            self.file = h5py.File(self._part, "a")
            for group in (self.file, *(g for g in self.file.values() if isinstance(g, h5py.Group))):
                for name in [n for n, one in group.items() if n.rpartition("_")[2].isdigit()]:
                    if not group[name].attrs.get(_WHOLE):
                        del group[name]
        except (OSError, KeyError, RuntimeError):
            self._part.unlink()
            self.file = h5py.File(self._part, "w")

    def has(self, name: str) -> bool:
        """Whether this demo, a path inside the file, is there with all that belongs to it."""
        return name in self.file

    def begin(self, name: str) -> Any:
        """A group for a demo. It counts after `end` only."""
        return self.file.create_group(name)

    def end(self, group: Any) -> None:
        group.attrs[_WHOLE] = True
        self.file.flush()

    def finish(self) -> None:
        """The file gets its name."""
        for group in self.file.values():
            for one in group.values():
                one.attrs.pop(_WHOLE, None)
        for one in self.file.values():
            one.attrs.pop(_WHOLE, None)
        self.file.close()
        self._part.rename(self.path)

    def close(self) -> None:
        self.file.close()


class DemoFiles:
    """Files with a group `data/demo_0`, `data/demo_1` … each, as robomimic and those after it have them.

    names: the file of each episode.
    """

    def __init__(self, folder: Path, episodes: Sequence[StoredEpisode], names: Sequence[str]) -> None:
        self.episodes: dict[str, list[StoredEpisode]] = {}
        self._places: dict[int, tuple[str, int]] = {}
        for episode, name in zip(episodes, names, strict=True):
            others = self.episodes.setdefault(name, [])
            self._places[episode.id] = name, len(others)
            others.append(episode)
        # Those that are there were finished before the export was cut off.
        self._files = {name: GrowingFile(folder / name) for name in self.episodes if not (folder / name).exists()}

    def has(self, episode: StoredEpisode) -> bool:
        file = self._files.get(self._places[episode.id][0])
        return file is None or f"data/{self.demo_name(episode)}" in file.file

    def demo_name(self, episode: StoredEpisode) -> str:
        return f"demo_{self._places[episode.id][1]}"

    def data(self, episode: StoredEpisode) -> Any:
        """The group of the demos of its file."""
        return self._files[self._places[episode.id][0]].file.require_group("data")

    def begin(self, episode: StoredEpisode) -> Any:
        """A group for the episode. It counts after `end` only."""
        return self.data(episode).create_group(self.demo_name(episode))

    def end(self, episode: StoredEpisode) -> None:
        file = self._files[self._places[episode.id][0]]
        file.end(file.file[f"data/{self.demo_name(episode)}"])

    def finish(self, complete: Callable[[Any, list[StoredEpisode]], None]) -> None:
        """complete(file, its episodes) adds what needs all of them; then each file gets its name."""
        for name, file in self._files.items():
            file.file["data"].attrs["total"] = int(sum(d.attrs["num_samples"] for d in file.file["data"].values()))
            complete(file.file, self.episodes[name])
            file.finish()

    def close(self) -> None:
        for file in self._files.values():
            file.close()


def put_pictures(group: Any, name: str, pictures: Array) -> None:
    """Pictures of all steps, compressed one by one so that a window is read alone."""
    group.create_dataset(name, data=pictures, chunks=(1, *pictures.shape[1:]), compression="gzip", compression_opts=1)
