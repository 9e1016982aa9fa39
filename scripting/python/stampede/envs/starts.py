"""Which start an environment makes: variation and seed, given or drawn."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from numbers import Integral
from typing import Any, TypeVar

import numpy as np

from stampede import _core
from stampede.catalogue import StoredEpisode
from stampede.faults import fault, unknown

SPLIT_SEEDS = 1_000_000  # seeds from here up are of the test split
OPTIONS = ("variation", "seed", "where", "goal", "perturb", "randomise", "episode", "frame")
_TEXTS = ("variation", "where", "goal", "perturb")
_TRIES = 10

Answer = TypeVar("Answer")


def _check_episode(episode: Any) -> None:
    if isinstance(episode, _core.Episode):
        return
    cure = "give what Session.run returns"
    if isinstance(episode, StoredEpisode):
        made = f"run({episode.task!r}, variation={episode.variation!r}, seed={episode.seed})"
        cure = f"Session().{made}, with its other options, makes it again, bit for bit"
    raise fault("reset(options=)", f"'episode' is no stampede.Episode, but {episode!r}", cure)


@dataclass(frozen=True)
class Start:
    """One start as the engine is asked for it."""

    request: _core.Reset
    variation: str
    seed: int  # the engine's
    drawn: bool  # whether another draw may take its place where it cannot be made


class Starts:
    """The starts of one task, drawn repeatably.

    variation: canonical text or axes of it (`colour=red`); None: any of the task's. split: `train` or `test`.
    """

    def __init__(
        self, session: _core.Session, task: str, variation: str | None, split: str, randomise: bool, perturb: str
    ) -> None:
        if split not in ("train", "test"):
            raise unknown("split=", "split", split, ("train", "test"))
        if task not in session.tasks():
            raise unknown("task", "task", task, session.tasks())
        self.task = task
        self._all = list(session.variations(task)) or [""]
        self._variations = self._matching(variation)
        self._first_seed = SPLIT_SEEDS if split == "test" else 0
        self._randomise = randomise
        self._perturb = perturb

    def _matching(self, variation: str | None) -> list[str]:
        if not variation:
            return self._all
        axes = {axis.strip() for axis in variation.split(",")}
        matching = [text for text in self._all if axes <= set(text.split(","))]
        if not matching:
            raise unknown("variation=", f"variation of task '{self.task}'", variation, self._all)
        return matching

    def first(self) -> _core.Reset:
        """A start that shows which shapes observations have."""
        return _core.Reset(variation=self._variations[0], seed=self._first_seed, perturb=self._perturb)

    def draw(self, random: np.random.Generator, seed: int | None, options: Mapping[str, Any]) -> Start:
        """The start for a reset.

        seed: as of `reset`; the engine's is its remainder, so that seed 7 is `stampede run --seed 7`, and 1'000'007
        in the test split. None: drawn from `random`. options: see OPTIONS; they come before anything drawn.
        """
        for name, value in options.items():
            if name not in OPTIONS:
                raise unknown("reset(options=)", "option", name, OPTIONS)
            kind = Integral if name in ("seed", "frame") else str if name in _TEXTS else object
            if not isinstance(value, kind) and (name, value) != ("variation", None):  # any of the task's
                cure = "give a text" if kind is str else "give a whole number"
                raise fault("reset(options=)", f"'{name}' cannot be {value!r}", cure)
        episode = options.get("episode")
        if episode is not None:
            _check_episode(episode)
            request = _core.Reset(episode=episode, frame=int(options.get("frame", 0)))
            return Start(request, episode.variation, episode.seed, drawn=False)
        if "frame" in options:
            cure = "give 'episode' too, as Session.run returns it"
            raise fault("reset(options=)", "a frame without an episode", cure)
        candidates = self._matching(options["variation"]) if "variation" in options else self._variations
        variation = candidates[int(random.integers(len(candidates)))]
        if "seed" in options:
            engine_seed = int(options["seed"])
        else:
            number = int(random.integers(SPLIT_SEEDS)) if seed is None else seed % SPLIT_SEEDS
            engine_seed = self._first_seed + number
        request = _core.Reset(
            variation=variation,
            seed=engine_seed,
            where=options.get("where", ""),
            goal=options.get("goal", ""),
            randomise=bool(options.get("randomise", self._randomise)),
            perturb=options.get("perturb", self._perturb),
        )
        return Start(request, variation, engine_seed, drawn="seed" not in options)

    def begin(
        self,
        random: np.random.Generator,
        seed: int | None,
        options: Mapping[str, Any],
        reset: Callable[[_core.Reset], Answer],
        first: Start | None = None,
    ) -> tuple[Start, Answer]:
        """Makes a start with `reset`; one that was drawn and cannot be made gives way to the next draw.

        first: a start that was drawn already and is tried before others.
        """
        start = first or self.draw(random, seed, options)
        for tries_left in reversed(range(_TRIES)):
            try:
                return start, reset(start.request)
            except _core.Error as error:
                # The engine names the task where its start cannot be made, and the argument where that is wrong.
                if not start.drawn or tries_left == 0 or getattr(error, "where", "") != self.task:
                    raise
            start = self.draw(random, None, options)
        raise AssertionError("the last try returns or raises")
