"""Names of files and folders of a dataset, and the scale of depth in its PNG files."""

from stampede.rlbench.observation_config import CAMERAS

DEPTH_SCALE = 2**24 - 1
IMAGE_FORMAT = "%d.png"
LOW_DIM_PICKLE = "low_dim_obs.pkl"
VARIATION_DESCRIPTIONS = "variation_descriptions.pkl"
VARIATION_NUMBER = "variation_number.pkl"  # of PerAct's layout, in each episode's folder
VARIATIONS_FOLDER = "variation%d"
VARIATIONS_ALL_FOLDER = "all_variations"
EPISODES_FOLDER = "episodes"
EPISODE_FOLDER = "episode%d"

IMAGE_KINDS = ("rgb", "depth", "mask")
IMAGE_FOLDERS = tuple(f"{camera}_{kind}" for camera in CAMERAS for kind in IMAGE_KINDS)
(
    LEFT_SHOULDER_RGB_FOLDER,
    LEFT_SHOULDER_DEPTH_FOLDER,
    LEFT_SHOULDER_MASK_FOLDER,
    RIGHT_SHOULDER_RGB_FOLDER,
    RIGHT_SHOULDER_DEPTH_FOLDER,
    RIGHT_SHOULDER_MASK_FOLDER,
    OVERHEAD_RGB_FOLDER,
    OVERHEAD_DEPTH_FOLDER,
    OVERHEAD_MASK_FOLDER,
    WRIST_RGB_FOLDER,
    WRIST_DEPTH_FOLDER,
    WRIST_MASK_FOLDER,
    FRONT_RGB_FOLDER,
    FRONT_DEPTH_FOLDER,
    FRONT_MASK_FOLDER,
) = IMAGE_FOLDERS
