"""Datasets for learners over a catalogue: windows of frames with labels, pictures and language.

`FrameDataset` is map-style (`len`, `[i]`), `WindowStream` iterates; both are what `torch.utils.data.DataLoader` takes,
with any number of forked or spawned workers, and need no PyTorch themselves.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from stampede._core import EpisodeArrays
from stampede.catalogue import Catalogue, StoredEpisode
from stampede.faults import fault, unknown

Sample = dict[str, Any]

_PICTURES = ("_rgb", "_depth", "_mask")


class FrameDataset:
    """Windows of consecutive frames of the episodes that a condition chooses.

    A sample is a dict: each column as an array with `window` rows, and

    - `episode`, `frame`: where the window begins;
    - `skill`: int64 (window,), which skill runs at each frame: a place in `skills`, -1 for none;
    - `segment`: int64 (window,), the place of that skill in its episode, -1 for none;
    - `padding`: bool (window,), rows beyond the end, which repeat the last frame;
    - `instruction`: what the task is called; `labels`: list of str, what each frame's skill is called (`pick up the
      red block`, empty for none).

    columns: any of `EpisodeArrays` (`joint_positions`, `action/joint_position`, `facts`, `object_pose/cup` …) and
    pictures (`front_rgb`), which are read for the window only. over: `episode`, or `skill`: windows do not cross the
    end of a skill, and start inside of one. where: a condition on view `episodes`. cache: episodes whose numbers are
    kept in memory, by each worker. Raises Error when no episode is chosen.
    """

    def __init__(
        self,
        catalogue: Catalogue | str,
        columns: Sequence[str] = ("joint_positions", "gripper_opening", "action/joint_position", "action/gripper"),
        *,
        window: int = 1,
        over: Literal["episode", "skill"] = "episode",
        where: str = "outcome = 'success'",
        stride: int = 1,
        cache: int = 64,
        threads: int = 2,
    ) -> None:
        if window < 1 or stride < 1:
            raise fault("FrameDataset", "window and stride are at least 1")
        if over not in ("episode", "skill"):
            raise unknown("over=", "stretch", over, ("episode", "skill"))
        self.catalogue = catalogue if isinstance(catalogue, Catalogue) else Catalogue(catalogue)
        self.window, self.over, self.threads = window, over, threads
        self.pictures = [name for name in columns if name.endswith(_PICTURES)]
        self.columns = [name for name in columns if name not in self.pictures]
        self.episodes = self.catalogue.episodes(where)
        if not self.episodes:
            raise fault(
                str(self.catalogue.path), f"no episode fulfils `{where}`", "Catalogue.query shows what there is"
            )
        self._check_columns()
        self._cache_size = max(1, cache)
        self._cache: dict[int, EpisodeArrays] = {}
        self._spans = self._skill_spans()
        self.skills = sorted({name for spans in self._spans.values() for name, *_ in spans})
        self._index = self._windows(stride)

    def _check_columns(self) -> None:
        """What is not there is told of now, and not by a worker later: of the first episode of each task."""
        for episode in {one.task: one for one in reversed(self.episodes)}.values():
            if self.columns:
                episode.arrays(*self.columns)
            for name in self.pictures:
                if name not in episode.stored_pictures:
                    place = f"{self.catalogue.path}, episode {episode.id}"
                    raise unknown(place, "column of stored pictures", name, episode.stored_pictures or ["none"])

    def __repr__(self) -> str:
        what = ", ".join([*self.columns, *self.pictures])
        return f"FrameDataset({len(self)} windows of {self.window} of {len(self.episodes)} episodes: {what})"

    def _skill_spans(self) -> dict[int, list[tuple[str, str, int, int]]]:
        """Name, label, first and end frame of each innermost skill, by episode."""
        chosen = {episode.id for episode in self.episodes}
        rows = self.catalogue.query(
            "SELECT episode, skill, label, first_frame, end_frame FROM segments s WHERE kind = 'skill' AND NOT EXISTS "
            "(SELECT 1 FROM segments c WHERE c.episode = s.episode AND c.parent = s.segment AND c.kind = 'skill') "
            "ORDER BY episode, first_frame"
        )
        spans: dict[int, list[tuple[str, str, int, int]]] = {episode: [] for episode in chosen}
        for row in rows:
            if row["episode"] in chosen:
                spans[row["episode"]].append((row["skill"], row["label"], row["first_frame"], row["end_frame"]))
        return spans

    def _windows(self, stride: int) -> NDArray[np.int64]:
        """Rows of place among the episodes, first frame, end of the stretch that the window belongs to."""
        rows: list[tuple[int, int, int]] = []
        for place, episode in enumerate(self.episodes):
            stretches = [(0, episode.frames)]
            if self.over == "skill":
                stretches = [(first, end) for *_, first, end in self._spans[episode.id]]
            rows += [(place, frame, end) for first, end in stretches for frame in range(first, end, stride)]
        return np.array(rows, dtype=np.int64).reshape(-1, 3)

    def __len__(self) -> int:
        return len(self._index)

    def __getitem__(self, i: int) -> Sample:
        place, first, end = (int(x) for x in self._index[i])
        return self._sample(self.episodes[place], first, end)

    def _arrays(self, episode: StoredEpisode) -> EpisodeArrays:
        arrays = self._cache.pop(episode.id, None) or episode.arrays(*(self.columns or ["time"]))
        self._cache[episode.id] = arrays  # the latest last
        while len(self._cache) > self._cache_size:
            self._cache.pop(next(iter(self._cache)))
        return arrays

    def _sample(self, episode: StoredEpisode, first: int, end: int) -> Sample:
        rows = np.minimum(np.arange(first, first + self.window), end - 1)
        sample: Sample = {
            "episode": episode.id,
            "frame": first,
            "padding": np.arange(first, first + self.window) >= end,
            "skill": np.full(self.window, -1, dtype=np.int64),
            "segment": np.full(self.window, -1, dtype=np.int64),
            "labels": [""] * self.window,
            "instruction": self._instructions.get(episode.id, ""),
        }
        for place, (name, label, begin, stop) in enumerate(self._spans[episode.id]):
            for k in np.flatnonzero((rows >= begin) & (rows < stop)):
                sample["skill"][k], sample["segment"][k] = self.skills.index(name), place
                sample["labels"][k] = label
        if self.columns:
            arrays = self._arrays(episode)
            for name in self.columns:
                sample[name] = arrays[name][rows]
        for name in self.pictures:
            shown, back = np.unique(rows, return_inverse=True)
            sample[name] = episode.pictures(name, shown.tolist(), threads=self.threads)[back]
        return sample

    @cached_property
    def _instructions(self) -> dict[int, str]:
        """The first sentence of each task, by episode."""
        rows = self.catalogue.query("SELECT episode, text FROM instructions WHERE level = 'task' ORDER BY ordinal DESC")
        return {row["episode"]: str(row["text"]) for row in rows}

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_cache": {}}


class WindowStream:
    """The windows of a `FrameDataset` in a random order that a seed fixes, for ever or for some epochs.

    Each worker of a PyTorch DataLoader gives its own share. PyTorch is imported before the stream is made.
    """

    def __init__(self, dataset: FrameDataset, *, seed: int = 0, epochs: int | None = None) -> None:
        self.dataset, self.seed, self.epochs = dataset, seed, epochs
        torch = sys.modules.get("torch")
        if torch:  # a DataLoader asks by this type whether it is to iterate or to index
            torch.utils.data.IterableDataset.register(WindowStream)

    def __iter__(self) -> Iterator[Sample]:
        worker, workers = _share()
        epoch = 0
        while self.epochs is None or epoch < self.epochs:
            order = np.random.default_rng([self.seed, epoch]).permutation(len(self.dataset))
            for i in order[worker::workers]:
                yield self.dataset[int(i)]
            epoch += 1


def _share() -> tuple[int, int]:
    """Which of how many workers this process is."""
    torch = sys.modules.get("torch")
    info = torch.utils.data.get_worker_info() if torch else None
    return (info.id, info.num_workers) if info else (0, 1)
