"""Pictures in RLBench's conventions, made from the engine's."""

from dataclasses import dataclass

import numpy as np

from stampede.rlbench.backend.utils import mask_to_rgb_handles
from stampede.rlbench.observation_config import CameraConfig

# The engine describes a camera by columns CAMERA_camera_extrinsics …
CAMERA_COLUMNS = ("extrinsics", "intrinsics", "near", "far")

# RLBench's cameras have x to the left and y up in the picture, and negative focal lengths; the engine's x to the right
# and y down, and positive ones. Both look along z, and both give the same pixels.
_HALF_TURN = np.diag([-1.0, -1.0, 1.0, 1.0])
# The middle of the first pixel is at 0 in RLBench's intrinsics (PyRep projects whole indices), at 0.5 in the engine's.
_HALF_PIXEL = 0.5


@dataclass
class CameraView:
    """
    What one camera of the engine saw at one frame. None: not wanted.

    rgb (H, W, 3) uint8; depth (H, W) float32, m along z, 0 where nothing is in range; mask (H, W) uint16;
    extrinsics (4, 4) world_from_camera, x right, y down; intrinsics (3, 3), pixels, of this size; near, far: m.
    """

    extrinsics: np.ndarray
    intrinsics: np.ndarray
    near: float
    far: float
    rgb: np.ndarray | None = None
    depth: np.ndarray | None = None
    mask: np.ndarray | None = None


def camera_misc(camera: str, view: CameraView) -> dict[str, object]:
    """The camera's entries of `Observation.misc`: RLBench's frame of the camera, middles of pixels at whole numbers."""
    intrinsics = np.array(view.intrinsics, dtype=np.float64)
    intrinsics[0, 0] *= -1.0
    intrinsics[1, 1] *= -1.0
    intrinsics[:2, 2] -= _HALF_PIXEL
    return {
        f"{camera}_camera_extrinsics": np.asarray(view.extrinsics, dtype=np.float64) @ _HALF_TURN,
        f"{camera}_camera_intrinsics": intrinsics,
        f"{camera}_camera_near": float(view.near),
        f"{camera}_camera_far": float(view.far),
    }


def depth_to_unit(depth: np.ndarray, near: float, far: float) -> np.ndarray:
    """Engine's depth (m, 0: nothing in range) to 0 at the near plane … 1 at the far one and beyond; float32."""
    metres = np.where(depth > 0, depth, far).astype(np.float64)
    return np.clip((metres - near) / (far - near), 0.0, 1.0).astype(np.float32)


def point_cloud(metres: np.ndarray, intrinsics: np.ndarray, extrinsics: np.ndarray) -> np.ndarray:
    """
    Points that the middles of the pixels see: (H, W, 3) float64, m, world.

    metres: (H, W) along the camera's z. intrinsics, extrinsics: RLBench's, as `camera_misc` gives them.
    """
    height, width = metres.shape
    v, u = np.mgrid[0:height, 0:width]
    z = metres.astype(np.float64)
    x = (u - intrinsics[0, 2]) / intrinsics[0, 0] * z
    y = (v - intrinsics[1, 2]) / intrinsics[1, 1] * z
    return np.stack([x, y, z], axis=-1) @ extrinsics[:3, :3].T + extrinsics[:3, 3]


def resized_intrinsics(intrinsics: np.ndarray, x: float, y: float) -> np.ndarray:
    """RLBench's intrinsics of a picture x times as wide and y times as high."""
    resized = np.array(intrinsics, dtype=np.float64)
    resized[:2, 2] += _HALF_PIXEL
    resized *= np.array([x, y, 1.0])[:, None]
    resized[:2, 2] -= _HALF_PIXEL
    return resized


def picture_fields(camera: str, config: CameraConfig, view: CameraView) -> dict[str, np.ndarray]:
    """Those fields of an `Observation` that `config` has switched on, with its noise."""
    unit = None if view.depth is None else depth_to_unit(view.depth, view.near, view.far)
    return encoded_fields(camera, config, view.rgb, unit, view.mask, camera_misc(camera, view))


def encoded_fields(
    camera: str,
    config: CameraConfig,
    rgb: np.ndarray | None,
    unit_depth: np.ndarray | None,
    mask: np.ndarray | None,
    misc: dict[str, object],
) -> dict[str, np.ndarray]:
    """As `picture_fields`, from depth of 0 … 1 and a camera as `Observation.misc` describes it."""
    fields: dict[str, np.ndarray] = {}
    near, far = misc[f"{camera}_camera_near"], misc[f"{camera}_camera_far"]
    if config.rgb:
        noisy = config.rgb_noise.apply(rgb.astype(np.float32) / 255.0)
        fields[f"{camera}_rgb"] = np.rint(np.clip(noisy, 0.0, 1.0) * 255.0).astype(np.uint8)
    if config.needs_depth:
        depth = near + unit_depth * (far - near) if config.depth_in_meters else unit_depth
        depth = config.depth_noise.apply(depth.astype(np.float32))
        if config.depth:
            fields[f"{camera}_depth"] = depth.astype(np.float32)
        if config.point_cloud:
            metres = depth if config.depth_in_meters else near + depth.astype(np.float64) * (far - near)
            fields[f"{camera}_point_cloud"] = point_cloud(
                metres, misc[f"{camera}_camera_intrinsics"], misc[f"{camera}_camera_extrinsics"]
            )
    if config.mask:
        ids = mask.astype(np.float64)
        fields[f"{camera}_mask"] = ids if config.masks_as_one_channel else mask_to_rgb_handles(mask) / 255.0
    return fields
