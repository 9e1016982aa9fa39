"""Demos that are stored: in RLBench's folders, or in a catalogue."""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np

from stampede import _core
from stampede._core import Error
from stampede.faults import reading
from stampede.rlbench.backend.exceptions import DemoError
from stampede.rlbench.backend.folders import demo_folders, load_demo
from stampede.rlbench.backend.recorded import STOP_AT_VIAS, columns, demo_observations
from stampede.rlbench.backend.task import Task
from stampede.rlbench.backend.utils import task_file_to_task_class
from stampede.rlbench.demo import Demo, Demos
from stampede.rlbench.observation_config import ObservationConfig


def name_to_task_class(task_file: str) -> type[Task]:
    """`reach_target` or `reach_target.py` -> the class `tasks.ReachTarget`. Raises `stampede.Error` for no task."""
    return task_file_to_task_class(task_file)


def get_stored_demos(
    amount: int,
    image_paths: bool,
    dataset_root: str | os.PathLike[str],
    variation_number: int,
    task_name: str,
    obs_config: ObservationConfig,
    random_selection: bool = True,
    from_episode_number: int = 0,
) -> list[Demo]:
    """
    Demos of one variation of a task, from a folder in RLBench's layout or from a catalogue.

    variation_number: -1 is all of them, in `all_variations` where the folder has that, else by variation. amount: -1 is
    all. image_paths: pictures are paths of files, and there are no point clouds. random_selection: drawn without
    repetition from numpy's global generator; else in order, from `from_episode_number` on.
    Raises DemoError where they are not there, or broken.
    """
    root = check_dataset_root(dataset_root)
    variations = _core.Session().variations(task_name) if root.is_file() else []
    return stored_demos(
        root,
        task_name,
        variation_number,
        variations,
        obs_config,
        amount,
        image_paths,
        random_selection,
        from_episode_number,
    )


def _demo_of(folder: Path, variation: int, config: ObservationConfig, image_paths: bool) -> Demo:
    try:
        with reading(str(folder), "write the dataset again"):
            return load_demo(folder, variation, config, image_paths)
    except DemoError:
        raise
    except Error as error:
        raise DemoError(str(error)) from error


def check_dataset_root(dataset_root: str | os.PathLike[str]) -> Path:
    """The path of a folder or catalogue that is there."""
    if not dataset_root:
        raise DemoError("there is no dataset\n    give Environment a dataset_root, or ask for live_demos=True")
    root = Path(dataset_root)
    if not root.exists():
        raise DemoError(f"{root}: there is no such folder or catalogue\n    dataset_root names one")
    return root


def stored_demos(
    root: Path,
    task: str,
    variation: int,
    variations: Sequence[str],
    config: ObservationConfig,
    amount: int,
    image_paths: bool,
    random_selection: bool,
    from_episode_number: int,
) -> list[Demo]:
    """As `get_stored_demos`. variations: canonical texts in the task's order; only a catalogue needs them."""
    if root.is_dir():
        folders = demo_folders(root, task, variation)
        chosen = _choice(len(folders), amount, random_selection, from_episode_number, f"{task}, variation {variation}")
        return Demos(_demo_of(folders[place], variation, config, image_paths) for place in chosen)
    if image_paths:
        raise DemoError(f"{root}: a catalogue has no files of pictures\n    image_paths=False, or export it to folders")
    if not -1 <= variation < len(variations):
        raise Error(f"{task} has no variation {variation}\n    they go from 0 to {len(variations) - 1}, and -1 is all")
    wanted = variations if variation == -1 else [variations[variation]]
    reader = _core.CatalogueReader(root)
    question = "SELECT episode, variation FROM demos WHERE task = ?1 ORDER BY episode"
    _, rows = reader.query(question, (task,))
    rows = [(episode, variations.index(text)) for episode, text in rows if text in wanted]
    of_what = f"{task}, all variations" if variation == -1 else f"{task} '{wanted[0]}'"
    chosen = _choice(len(rows), amount, random_selection, from_episode_number, of_what)
    return Demos(_catalogue_demo(reader, *rows[place], config) for place in chosen)


def _choice(there: int, amount: int, random_selection: bool, first: int, of_what: str) -> list[int]:
    """Places of the demos that are wanted."""
    available = there if random_selection else max(0, there - first)
    wanted = available if amount == -1 else amount
    if wanted < 1 or wanted > available:
        raise DemoError(
            f"{amount} demos of {of_what} are wanted, {available} are there\n"
            "    ask for fewer (-1: all), or store more with `stampede run`"
        )
    if random_selection:
        return [int(place) for place in np.random.permutation(there)[:wanted]]
    return list(range(first, first + wanted))


def _catalogue_demo(reader: _core.CatalogueReader, episode: int, variation: int, config: ObservationConfig) -> Demo:
    arrays = reader.arrays(episode, columns(config.cameras_on))
    told = "SELECT options ->> 'randomise', options ->> 'set' FROM episodes WHERE episode = ?1"
    _, ((randomise, settings),) = reader.query(told, (episode,))
    trimmed = STOP_AT_VIAS in (settings or "").split()
    observations = demo_observations(config, arrays, partial(reader.picture, episode), variation, trimmed)
    demo = Demo(list(observations), None, 1, arrays.variation, arrays.seed, randomise is not None)
    demo.variation_number = variation
    return demo
