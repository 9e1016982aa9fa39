"""Observations from what the engine gives: channels of a running environment, or rows of a recorded episode."""

from collections.abc import Mapping

import numpy as np

from stampede.rlbench.backend.observation import NUMBERS, Observation
from stampede.rlbench.backend.pictures import CameraView, camera_misc, picture_fields
from stampede.rlbench.observation_config import ObservationConfig


def observation_of(
    config: ObservationConfig,
    numbers: Mapping[str, np.ndarray],
    views: Mapping[str, CameraView],
    misc: Mapping[str, object],
    ignore_collisions: bool = False,
) -> Observation:
    """
    The fields that `config` has switched on, with its noise.

    numbers: `NUMBERS` of one frame, as engine/episode/README.md says. views: of the cameras that are on.
    ignore_collisions: whether the motion of the frame was not planned around obstacles.
    """
    fields: dict[str, object] = {}
    for name in NUMBERS:
        if getattr(config, name):
            fields[name] = _field(config, name, numbers[name])
    if config.record_ignore_collisions:
        fields["ignore_collisions"] = np.array(float(ignore_collisions))
    about_cameras: dict[str, object] = {}
    for camera, view in views.items():
        fields.update(picture_fields(camera, config.cameras[camera], view))
        about_cameras.update(camera_misc(camera, view))
    return Observation(**fields, misc={**about_cameras, **misc})


def _field(config: ObservationConfig, name: str, value: np.ndarray) -> object:
    if name == "gripper_open":
        return float(value)
    if name == "gripper_touch_forces":
        return touch_vectors(value)
    value = np.array(value, dtype=np.float64)
    noise = getattr(config, f"{name}_noise", None)
    return value if noise is None else noise.apply(value)


def touch_vectors(normal_forces: np.ndarray) -> np.ndarray:
    """Normal force at each pad, N, to one vector a finger, flattened: along y, the normal of the pad."""
    vectors = np.zeros((len(normal_forces), 3))
    vectors[:, 1] = normal_forces
    return vectors.reshape(-1)
