"""What an `Observation` holds."""

import operator
from enum import Enum

from stampede.faults import fault
from stampede.rlbench.noise_model import Identity, NoiseModel

CAMERAS = ("left_shoulder", "right_shoulder", "overhead", "wrist", "front")


class RenderMode(Enum):
    """How pictures are drawn. PyRep's enumeration of the same name is accepted too."""

    OPENGL = 0  # without shadows
    OPENGL3 = 7  # with shadows


class CameraConfig:
    """
    What one camera gives.

    image_size: width and height, pixels, as PyRep has them. render_mode: OPENGL3 draws shadows, any other does not.
    masks_as_one_channel: masks are ids (H, W); else colours (H, W, 3) of 0 … 1. depth_in_meters: depth is m; else 0 at
    the near plane, 1 at the far one.
    """

    def __init__(
        self,
        rgb: bool = True,
        rgb_noise: NoiseModel | None = None,
        depth: bool = True,
        depth_noise: NoiseModel | None = None,
        point_cloud: bool = True,
        mask: bool = True,
        image_size: tuple[int, int] = (128, 128),
        render_mode: object = RenderMode.OPENGL,
        masks_as_one_channel: bool = True,
        depth_in_meters: bool = False,
    ) -> None:
        self.rgb = rgb
        self.rgb_noise = rgb_noise if rgb_noise is not None else Identity()
        self.depth = depth
        self.depth_noise = depth_noise if depth_noise is not None else Identity()
        self.point_cloud = point_cloud
        self.mask = mask
        self.image_size = image_size
        self.render_mode = render_mode
        self.masks_as_one_channel = masks_as_one_channel
        self.depth_in_meters = depth_in_meters

    def set_all(self, value: bool) -> None:
        """Switches all kinds of pictures on or off."""
        self.rgb = self.depth = self.point_cloud = self.mask = value

    @property
    def needs_depth(self) -> bool:
        return self.depth or self.point_cloud

    @property
    def is_on(self) -> bool:
        return self.rgb or self.depth or self.point_cloud or self.mask

    @property
    def width_and_height(self) -> tuple[int, int]:
        """`image_size`, pixels. Raises `stampede.Error` for what is no size."""
        try:
            width, height = (operator.index(size) for size in self.image_size)
        except (TypeError, ValueError):
            width = height = 0
        if width < 1 or height < 1:
            raise fault("CameraConfig(image_size=)", f"{self.image_size!r} is no size", "(width, height), pixels")
        return width, height

    @property
    def shadows(self) -> bool:
        return getattr(self.render_mode, "name", "") == "OPENGL3"


class ObservationConfig:
    """Which fields of an `Observation` are filled, and with which noise. A field that is off is None."""

    def __init__(
        self,
        left_shoulder_camera: CameraConfig | None = None,
        right_shoulder_camera: CameraConfig | None = None,
        overhead_camera: CameraConfig | None = None,
        wrist_camera: CameraConfig | None = None,
        front_camera: CameraConfig | None = None,
        joint_velocities: bool = True,
        joint_velocities_noise: NoiseModel | None = None,
        joint_positions: bool = True,
        joint_positions_noise: NoiseModel | None = None,
        joint_forces: bool = True,
        joint_forces_noise: NoiseModel | None = None,
        gripper_open: bool = True,
        gripper_pose: bool = True,
        gripper_matrix: bool = False,
        gripper_joint_positions: bool = False,
        gripper_touch_forces: bool = False,
        wrist_camera_matrix: bool = False,
        record_gripper_closing: bool = False,
        task_low_dim_state: bool = False,
        record_ignore_collisions: bool = True,
    ) -> None:
        self.left_shoulder_camera = left_shoulder_camera if left_shoulder_camera is not None else CameraConfig()
        self.right_shoulder_camera = right_shoulder_camera if right_shoulder_camera is not None else CameraConfig()
        self.overhead_camera = overhead_camera if overhead_camera is not None else CameraConfig()
        self.wrist_camera = wrist_camera if wrist_camera is not None else CameraConfig()
        self.front_camera = front_camera if front_camera is not None else CameraConfig()
        self.joint_velocities = joint_velocities
        self.joint_velocities_noise = joint_velocities_noise if joint_velocities_noise is not None else Identity()
        self.joint_positions = joint_positions
        self.joint_positions_noise = joint_positions_noise if joint_positions_noise is not None else Identity()
        self.joint_forces = joint_forces
        self.joint_forces_noise = joint_forces_noise if joint_forces_noise is not None else Identity()
        self.gripper_open = gripper_open
        self.gripper_pose = gripper_pose
        self.gripper_matrix = gripper_matrix
        self.gripper_joint_positions = gripper_joint_positions
        self.gripper_touch_forces = gripper_touch_forces
        self.wrist_camera_matrix = wrist_camera_matrix
        self.record_gripper_closing = record_gripper_closing
        self.task_low_dim_state = task_low_dim_state
        self.record_ignore_collisions = record_ignore_collisions

    def set_all(self, value: bool) -> None:
        """Switches every field on or off."""
        self.set_all_high_dim(value)
        self.set_all_low_dim(value)

    def set_all_high_dim(self, value: bool) -> None:
        """Switches all pictures of all cameras on or off."""
        for camera in self.cameras.values():
            camera.set_all(value)

    def set_all_low_dim(self, value: bool) -> None:
        """Switches everything but pictures on or off."""
        self.joint_velocities = self.joint_positions = self.joint_forces = value
        self.gripper_open = self.gripper_pose = self.gripper_matrix = value
        self.gripper_joint_positions = self.gripper_touch_forces = value
        self.wrist_camera_matrix = self.task_low_dim_state = value

    @property
    def cameras(self) -> dict[str, CameraConfig]:
        """By the camera's name."""
        return {name: getattr(self, f"{name}_camera") for name in CAMERAS}

    @property
    def cameras_on(self) -> dict[str, CameraConfig]:
        """Those that give any picture."""
        return {name: camera for name, camera in self.cameras.items() if camera.is_on}
