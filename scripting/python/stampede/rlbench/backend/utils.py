"""Encodings of pictures in PNG files, and names of tasks."""

from __future__ import annotations

from pathlib import PurePath
from typing import TYPE_CHECKING, Any

import numpy as np

from stampede.png import pillow

if TYPE_CHECKING:
    from stampede.rlbench.backend.task import Task


_MOST_WHOLE = 2**24 - 1
_SCALE = 256000.0  # of metres to steps of 1/256 mm; datasets are written with DEPTH_SCALE


def float_array_to_rgb(values: np.ndarray, scale_factor: float) -> np.ndarray:
    """(H, W) to (H, W, 3) uint8: times `scale_factor`, rounded, high byte first (R), low byte last (B)."""
    whole = np.floor(np.asarray(values, dtype=np.float64) * scale_factor + 0.5)
    whole = np.clip(whole, 0, _MOST_WHOLE).astype(np.uint32)
    return np.stack([whole >> 16 & 255, whole >> 8 & 255, whole & 255], axis=-1).astype(np.uint8)


def float_array_to_rgb_image(float_array: np.ndarray, scale_factor: float = _SCALE, drop_blue: bool = False) -> Any:
    """
    (H, W) to a Pillow image: times `scale_factor`, rounded, high byte first (R), low byte last (B).

    drop_blue: without the low byte. Values beyond 2**24 - 1 steps, and below 0, are clipped.
    """
    colours = float_array_to_rgb(float_array, scale_factor)
    if drop_blue:
        colours[..., 2] = 0
    return pillow("rlbench").fromarray(colours)


def image_to_float_array(image: Any, scale_factor: float | None = None) -> np.ndarray:
    """A picture that `float_array_to_rgb_image` made to (H, W) float64. scale_factor: 256000, unless given."""
    colours = np.asarray(image).astype(np.float64)
    steps = colours[..., 0] * 65536 + colours[..., 1] * 256 + colours[..., 2]
    return steps / (_SCALE if scale_factor is None else scale_factor)


def mask_to_rgb_handles(mask: np.ndarray) -> np.ndarray:
    """Ids (H, W) to colours (H, W, 3) uint8: low byte first (R), high byte last (B)."""
    ids = mask.astype(np.uint32)
    return np.stack([ids & 255, ids >> 8 & 255, ids >> 16 & 255], axis=-1).astype(np.uint8)


def rgb_handles_to_mask(rgb_coded_handles: np.ndarray) -> np.ndarray:
    """Colours (H, W, 3), floats of 0 … 1 or uint8, to ids (H, W) float64."""
    colours = np.asarray(rgb_coded_handles)
    if colours.dtype != np.uint8:
        colours = np.rint(colours * 255.0)
    colours = colours.astype(np.float64)
    return colours[..., 0] + colours[..., 1] * 256 + colours[..., 2] * 65536


def task_file_to_task_class(task_file: str, parent_folder: str = "rlbench") -> type[Task]:
    """
    The class of a task's name or file: `reach_target` and `reach_target.py` give `tasks.ReachTarget`.

    parent_folder is RLBench's and has no meaning here. Raises `stampede.Error` with the nearest name.
    """
    from stampede.rlbench.tasks import task_class

    return task_class(PurePath(task_file).stem)
