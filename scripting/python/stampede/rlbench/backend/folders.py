"""Demos in RLBench's folders: TASK/variation0/episodes/episode0/front_rgb/0.png … and low_dim_obs.pkl."""

import re
from pathlib import Path
from typing import Any

import numpy as np

from stampede.files import plain_file
from stampede.png import pillow
from stampede.rlbench.backend.const import (
    DEPTH_SCALE,
    EPISODE_FOLDER,
    EPISODES_FOLDER,
    LOW_DIM_PICKLE,
    VARIATION_NUMBER,
    VARIATIONS_ALL_FOLDER,
    VARIATIONS_FOLDER,
)
from stampede.rlbench.backend.exceptions import DemoError
from stampede.rlbench.backend.observation import NUMBERS, Observation
from stampede.rlbench.backend.pickles import read_pickle
from stampede.rlbench.backend.pictures import encoded_fields, resized_intrinsics
from stampede.rlbench.backend.utils import image_to_float_array, rgb_handles_to_mask
from stampede.rlbench.demo import Demo
from stampede.rlbench.observation_config import CameraConfig, ObservationConfig


def demo_folders(root: Path, task: str, variation: int) -> list[Path]:
    """Folders of the episodes of one variation, by number; variation -1: of all, which one layout has together."""
    if not (root / task).is_dir():
        there = ", ".join(sorted(one.name for one in root.iterdir() if one.is_dir()))
        raise DemoError(f"{root}: there is no task '{task}'\n    there are {there or 'none'}")
    name = VARIATIONS_ALL_FOLDER if variation == -1 else VARIATIONS_FOLDER % variation
    folders = [root / task / name / EPISODES_FOLDER]
    if variation == -1 and not folders[0].is_dir():
        each = [one / EPISODES_FOLDER for one in _numbered(root / task, VARIATIONS_FOLDER)]
        folders = [one for one in each if one.is_dir()] or folders
    if not folders[0].is_dir():
        there = ", ".join(sorted(one.name for one in (root / task).iterdir() if one.is_dir()))
        raise DemoError(f"{folders[0]}: there is no such folder\n    there are {there or 'none'}")
    return [episode for one in folders for episode in _numbered(one, EPISODE_FOLDER)]


def _number_of(folder: Path, pattern: str) -> int | None:
    """12 of a folder `episode12`. pattern: `episode%d`."""
    match = re.fullmatch(pattern.replace("%d", "([0-9]{1,9})"), folder.name)
    return None if match is None else int(match[1])


def _numbered(folder: Path, pattern: str) -> list[Path]:
    """`episode0`, `episode1` … in it, in the order of their numbers."""
    found = ((_number_of(one, pattern), one) for one in folder.iterdir())
    return [one for _, one in sorted((number, one) for number, one in found if number is not None)]


def load_demo(folder: Path, variation: int, config: ObservationConfig, image_paths: bool) -> Demo:
    """
    A demo with the fields that `config` has switched on. variation: -1 is the one that the folder names. image_paths:
    those of pictures are paths as text, and point clouds are left out. Pictures of another size are resized, and
    intrinsics with them.

    Raises DemoError where there are not as many pictures as observations.
    """
    demo = read_pickle(folder / LOW_DIM_PICKLE)
    if not isinstance(demo, Demo):
        raise DemoError(f"{folder / LOW_DIM_PICKLE}: it holds no demo\n    write the dataset again")
    demo.variation_number = _variation_number(folder) if variation == -1 else variation
    for name, camera in config.cameras.items():
        for kind, wanted in (("rgb", camera.rgb), ("depth", camera.needs_depth), ("mask", camera.mask)):
            pictures = folder / f"{name}_{kind}"
            there = sum(1 for _ in pictures.glob("*.png")) if wanted else len(demo)
            if there != len(demo):
                raise DemoError(
                    f"{pictures}: {there} pictures of {len(demo)} observations\n"
                    f"    switch {name}_{kind} off in ObservationConfig, or write the dataset again with it"
                )
    for number, seen in enumerate(demo):
        _take_numbers(seen, config)
        for name, camera in config.cameras.items():
            if image_paths:
                _take_paths(seen, folder, number, name, camera)
            elif camera.is_on:
                _take_pictures(seen, folder, number, name, camera)
    return demo


def _variation_number(folder: Path) -> int:
    of_folder = _number_of(folder.parents[1], VARIATIONS_FOLDER)
    if of_folder is not None and not (folder / VARIATION_NUMBER).exists():  # RLBench's own have none there
        return of_folder
    number = read_pickle(folder / VARIATION_NUMBER)
    if not isinstance(number, int) or isinstance(number, bool) or number < 0:
        raise DemoError(f"{folder / VARIATION_NUMBER}: it holds no variation's number\n    write the dataset again")
    return number


def _take_numbers(seen: Observation, config: ObservationConfig) -> None:
    for field in NUMBERS:
        value = seen.__dict__.get(field)
        noise = getattr(config, f"{field}_noise", None)
        if value is None or not getattr(config, field):
            value = None
        elif noise is not None:
            value = noise.apply(value)
        setattr(seen, field, value)


def _take_paths(seen: Observation, folder: Path, number: int, name: str, camera: CameraConfig) -> None:
    for kind in ("rgb", "depth", "mask"):
        if getattr(camera, kind):
            setattr(seen, f"{name}_{kind}", str(folder / f"{name}_{kind}" / f"{number}.png"))


def _take_pictures(seen: Observation, folder: Path, number: int, name: str, camera: CameraConfig) -> None:
    image = pillow("rlbench")
    width, height = camera.width_and_height
    own_size = (width, height)

    def read(kind: str, resampling: Any) -> np.ndarray:
        nonlocal own_size
        with image.open(plain_file(folder / f"{name}_{kind}" / f"{number}.png")) as picture:
            own_size = picture.size
            if own_size != (width, height):
                picture = picture.resize((width, height), resampling)
            return np.asarray(picture)

    # Only colours may be mixed: the bytes of depth and mask are digits.
    rgb = read("rgb", image.Resampling.BILINEAR) if camera.rgb else None
    depth = image_to_float_array(read("depth", image.Resampling.NEAREST), DEPTH_SCALE) if camera.needs_depth else None
    mask = rgb_handles_to_mask(read("mask", image.Resampling.NEAREST)) if camera.mask else None
    key = f"{name}_camera_intrinsics"
    seen.misc[key] = resized_intrinsics(seen.misc[key], width / own_size[0], height / own_size[1])
    for field, value in encoded_fields(name, camera, rgb, depth, mask, seen.misc).items():
        setattr(seen, field, value)
