"""What is observed at one frame."""

from typing import Any

import numpy as np

from stampede.rlbench.observation_config import CAMERAS

_PICTURES = tuple(f"{camera}_{kind}" for camera in CAMERAS for kind in ("rgb", "depth", "mask", "point_cloud"))
# Names are the engine's and RLBench's alike.
NUMBERS = (
    "joint_velocities",
    "joint_positions",
    "joint_forces",
    "gripper_open",
    "gripper_pose",
    "gripper_matrix",
    "gripper_joint_positions",
    "gripper_touch_forces",
    "task_low_dim_state",
)
STANDS_RAD_PER_S = 0.01  # an arm none of whose joints is faster
FIELDS = (*_PICTURES, *NUMBERS, "ignore_collisions", "misc")


class Observation:
    """
    One frame, a twentieth of a second. A field that is switched off is None.

    CAMERA is left_shoulder, right_shoulder, overhead, wrist or front; H x W is its height and width; n is 7.

    CAMERA_rgb           (H, W, 3) uint8
    CAMERA_depth         (H, W) float32: 0 at the near plane, 1 at the far one; or m. Nothing in range is the far plane
    CAMERA_mask          (H, W) float64: id of what is seen, 0 the background; or (H, W, 3), the id as a colour
    CAMERA_point_cloud   (H, W, 3) float64: m, world
    joint_velocities     (n,) float64: rad/s
    joint_positions      (n,) float64: rad
    joint_forces         (n,) float64: N m
    gripper_open         float: 1.0 where the first finger is beyond 0.9 of its range, else 0.0; in demos 1.0 also where
                         the hand was told to open less wide
    gripper_pose         (7,) float64: x y z in m and quaternion x y z w of the point between the pads; world
    gripper_matrix       (4, 4) float64: the same, world_from_gripper
    gripper_joint_positions (2,) float64: m, 0 … 0.04
    gripper_touch_forces (6,) float64: N, a vector a finger; its second component is the force along the pad's normal
    task_low_dim_state   (k,) float64: pose of each object, then positions of joints that are not the robot's; world
    ignore_collisions    () float64: 1.0 in frames of a demo whose motion was not planned around obstacles (lines, arcs,
                         pushes), or in which the arm stands, else 0.0; PerAct's field
    misc                 dict: CAMERA_camera_extrinsics, CAMERA_camera_intrinsics, CAMERA_camera_near,
                         CAMERA_camera_far; variation_index; in demos joint_position_action and frame
    """

    misc: dict[str, Any]

    def __init__(self, **fields: Any) -> None:
        for name in FIELDS:
            setattr(self, name, fields.pop(name, {} if name == "misc" else None))
        if fields:
            raise TypeError(f"an Observation has no field '{next(iter(fields))}'")

    def get_low_dim_data(self) -> np.ndarray:
        """All numbers that are switched on, one after the other, without the matrix: (m,) float64."""
        parts = [
            np.atleast_1d(np.asarray(getattr(self, name), dtype=np.float64))
            for name in ("gripper_open", *(name for name in NUMBERS if name not in ("gripper_open", "gripper_matrix")))
            if getattr(self, name) is not None
        ]
        return np.concatenate(parts) if parts else np.array([])
