"""
RLBench's folders: TASK/variation0/episodes/episode0/, with a folder of PNG files a camera and kind and the pickled
demo; or PerAct's, which has all variations together in TASK/all_variations/episodes/.

`stampede.rlbench.utils.get_stored_demos` reads them, and so do RLBench, PerAct and RVT themselves with
`--classes rlbench`.
"""

from __future__ import annotations

import argparse
import pickle
import shutil
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

from stampede import _core
from stampede._core import EpisodeArrays, Error
from stampede.catalogue import StoredEpisode
from stampede.export import cameras_of
from stampede.export.steps import is_real
from stampede.faults import fault
from stampede.file_names import file_name
from stampede.png import pillow
from stampede.rlbench.backend.const import (
    EPISODE_FOLDER,
    EPISODES_FOLDER,
    LOW_DIM_PICKLE,
    DEPTH_SCALE,
    VARIATION_DESCRIPTIONS,
    VARIATION_NUMBER,
    VARIATIONS_ALL_FOLDER,
    VARIATIONS_FOLDER,
)
from stampede.rlbench.backend.observation import Observation
from stampede.rlbench.backend.observing import observation_of
from stampede.rlbench.backend.pickles import demo_bytes
from stampede.rlbench.backend.pictures import CameraView, camera_misc, depth_to_unit
from stampede.rlbench.backend.recorded import STOP_AT_VIAS, columns, demo_misc, ignoring_frames, kept_frames, numbers_at
from stampede.rlbench.backend.scene import Scene
from stampede.rlbench.backend.utils import float_array_to_rgb, mask_to_rgb_handles
from stampede.rlbench.demo import Demo
from stampede.rlbench.observation_config import CAMERAS, ObservationConfig

_KINDS = ("rgb", "depth", "mask")
_FRAMES_AT_ONCE = 64  # whose pictures are in memory


class Writer:
    """
    Writes an episode as RLBench's dataset generator would have, under its own numbers.

    Variation k is the k-th of the task's order. Seeds and variations are kept in the demos, so that
    `TaskEnvironment.reset_to_demo` makes their starts again.
    """

    def __init__(self, folder: Path, options: argparse.Namespace, episodes: Sequence[StoredEpisode]) -> None:
        self._folder = folder
        self._options = options
        pillow("rlbench")
        self._session = _core.Session(paths=[Path(path) for path in options.scripts])
        self._orders: dict[str, list[str]] = {}
        self._places: dict[int, tuple[int, int]] = {}  # episode -> variation, number
        counts: dict[tuple[str, int], int] = {}
        for episode in episodes:
            variation = self._variation_index(episode)
            place = episode.task, -1 if options.all_variations else variation
            number = counts.get(place, 0)
            counts[place] = number + 1
            self._places[episode.id] = variation, number

    @staticmethod
    def add_arguments(parser: argparse.ArgumentParser) -> None:
        parser.add_argument(
            "--classes",
            choices=("stampede", "rlbench"),
            default="stampede",
            help="whose classes are in the pickles: stampede.rlbench's, or RLBench's own (default: %(default)s)",
        )
        parser.add_argument(
            "--all-variations",
            action="store_true",
            help="PerAct's layout: all variations of a task together, in TASK/all_variations/episodes",
        )
        parser.add_argument(
            "--gripper-frames",
            action="store_true",
            help="also frames while the fingers move and the arm waits; RLBench's demos are without them",
        )
        parser.add_argument(
            "--scripts",
            action="append",
            default=[],
            metavar="FOLDER",
            help="holds tasks/ and worlds/ of tasks that did not come with the engine; may be repeated",
        )

    def has(self, episode: StoredEpisode) -> bool:
        return self._folder_of(episode).is_dir()

    def write(self, episode: StoredEpisode) -> None:
        final = self._folder_of(episode)
        partial = final.with_name(f".{final.name}.partial")
        shutil.rmtree(partial, ignore_errors=True)
        partial.mkdir(parents=True)
        self._write_into(partial, episode)
        _pickle_plain(partial / VARIATION_NUMBER, self._places[episode.id][0])
        _pickle_plain(partial / VARIATION_DESCRIPTIONS, episode.instructions("task"))
        if not self._options.all_variations:
            self._write_descriptions(episode)
        partial.rename(final)

    def finish(self) -> None:
        """Every episode is complete by itself."""

    def close(self) -> None:
        """No file is open between two episodes."""

    def _variation_index(self, episode: StoredEpisode) -> int:
        if is_real(episode):
            raise fault(
                f"episode {episode.id}",
                "it is a recording of a real robot, and RLBench's folders are of variations of a simulated task",
                "--where \"outcome = 'success' AND source <> 'real'\" leaves such out; lerobot and others take them",
            )
        if episode.arrays("joint_positions")["joint_positions"].shape[1] != Scene.joint_count:
            raise fault(
                f"episode {episode.id}",
                f"its arm does not have {Scene.joint_count} joints, and RLBench's demos are a Panda's",
                "lerobot and others take any arm",
            )
        if episode.task not in self._orders:
            try:
                self._orders[episode.task] = self._session.variations(episode.task)
            except Error as error:
                cure = "its variations are numbered by its script: --scripts FOLDER"
                raise fault(f"episode {episode.id}", str(error), cure) from error
        order = self._orders[episode.task]
        if episode.variation not in order:
            raise fault(
                f"episode {episode.id}",
                f"{episode.task} has no variation '{episode.variation}' any more",
                "give the scripts that it was made with: --scripts FOLDER",
            )
        return order.index(episode.variation)

    def _folder_of(self, episode: StoredEpisode) -> Path:
        variation, number = self._places[episode.id]
        return self._variation_folder(episode) / EPISODES_FOLDER / (EPISODE_FOLDER % number)

    def _variation_folder(self, episode: StoredEpisode) -> Path:
        variation, _ = self._places[episode.id]
        return self._folder / file_name(episode.task) / (
            VARIATIONS_ALL_FOLDER if self._options.all_variations else VARIATIONS_FOLDER % variation
        )

    def _cameras_of(self, episode: StoredEpisode) -> list[str]:
        """With --draw all of RLBench's that the scene has, unless they are named: RLBench's own loader wants them all."""
        if self._options.cameras is None and self._options.draw:
            return [camera for camera in CAMERAS if camera in episode.table("cameras").values("camera")]
        return [camera for camera in cameras_of(episode, self._options) if camera in CAMERAS]

    def _write_descriptions(self, episode: StoredEpisode) -> None:
        file = self._variation_folder(episode) / VARIATION_DESCRIPTIONS
        if file.exists():
            return
        partial = file.with_name(f".{file.name}.partial")
        _pickle_plain(partial, episode.instructions("task"))
        partial.rename(file)

    def _write_into(self, folder: Path, episode: StoredEpisode) -> None:
        cameras = self._cameras_of(episode)
        arrays = episode.arrays(*columns(cameras))
        frames = kept_frames(arrays, self._options.gripper_frames, self._stops_at_vias(episode))
        intrinsics = {camera: self._write_pictures(folder, episode, arrays, camera, frames) for camera in cameras}
        demo = Demo(
            self._observations(arrays, frames, intrinsics, self._places[episode.id][0]),
            np.random.RandomState(episode.seed % 2**32).get_state() if episode.seed is not None else None,
            1,
            episode.variation,
            episode.seed,
            self._was_randomised(episode),
        )
        (folder / LOW_DIM_PICKLE).write_bytes(demo_bytes(demo, self._options.classes))

    @staticmethod
    def _was_randomised(episode: StoredEpisode) -> bool:
        options = episode.catalogue.query(
            "SELECT options ->> 'randomise' AS randomise FROM episodes WHERE episode = ?1", episode.id
        )
        return options.values("randomise") != [None]

    @staticmethod
    def _stops_at_vias(episode: StoredEpisode) -> bool:
        options = episode.catalogue.query(
            "SELECT options ->> 'set' AS settings FROM episodes WHERE episode = ?1", episode.id
        )
        return STOP_AT_VIAS in (options.values("settings")[0] or "").split()

    @staticmethod
    def _observations(
        arrays: EpisodeArrays, frames: list[int], intrinsics: dict[str, np.ndarray], variation: int
    ) -> list[Observation]:
        config = ObservationConfig()
        config.set_all_high_dim(False)
        config.set_all_low_dim(True)
        observations = []
        ignoring = ignoring_frames(arrays)
        for frame, misc in zip(frames, demo_misc(arrays, frames, variation), strict=True):
            for camera, matrix in intrinsics.items():
                near, far = float(arrays[f"{camera}_camera_near"]), float(arrays[f"{camera}_camera_far"])
                extrinsics = arrays[f"{camera}_camera_extrinsics"][frame]
                misc |= camera_misc(camera, CameraView(extrinsics, matrix, near, far))
            observations.append(observation_of(config, numbers_at(arrays, frame), {}, misc, frame in ignoring))
        return observations

    def _write_pictures(
        self, folder: Path, episode: StoredEpisode, arrays: EpisodeArrays, camera: str, frames: list[int]
    ) -> np.ndarray:
        """The PNG files of a camera; gives its intrinsics for their size, the engine's convention."""
        near, far = float(arrays[f"{camera}_camera_near"]), float(arrays[f"{camera}_camera_far"])
        encode = {
            "rgb": lambda picture: picture,
            "depth": lambda picture: float_array_to_rgb(depth_to_unit(picture, near, far), DEPTH_SCALE),
            "mask": mask_to_rgb_handles,
        }
        size = (0, 0)
        with ThreadPoolExecutor(2) as pool:
            for kind in _KINDS:
                pngs = folder / file_name(f"{camera}_{kind}")
                pngs.mkdir()
                for first in range(0, len(frames), _FRAMES_AT_ONCE):
                    pictures = self._read(episode, pngs.name, frames[first : first + _FRAMES_AT_ONCE])
                    size = pictures.shape[1:3]
                    files = [pngs / f"{first + place}.png" for place in range(len(pictures))]
                    list(pool.map(_save, files, map(encode[kind], pictures)))
        return _intrinsics(episode, camera, *size)

    def _read(self, episode: StoredEpisode, column: str, frames: list[int]) -> np.ndarray:
        try:
            return episode.pictures(column, frames, draw=self._options.draw)
        except Error as error:
            if self._options.draw:
                raise
            raise fault(
                f"episode {episode.id}",
                f"not every picture '{column}' is stored",
                "RLBench's folders have rgb, depth and mask of each camera: add --draw, or choose with --cameras",
            ) from error


def _pickle_plain(file: Path, value: object) -> None:
    file.write_bytes(pickle.dumps(value, protocol=2))


def _save(file: Path, colours: np.ndarray) -> None:
    pillow("rlbench").fromarray(colours).save(file)


def _intrinsics(episode: StoredEpisode, camera: str, height: int, width: int) -> np.ndarray:
    """(3, 3), pixels, focal lengths positive: of the camera's stored pictures, or of those drawn at its own size."""
    sizes = "width, height, focal_x, focal_y, centre_x, centre_y"
    known = episode.catalogue.query(
        f"SELECT {sizes} FROM images WHERE episode = ?1 AND camera = ?2 AND width = ?3 AND height = ?4 "
        f"UNION SELECT {sizes} FROM cameras WHERE episode = ?1 AND camera = ?2 AND width = ?3 AND height = ?4 LIMIT 1",
        episode.id,
        camera,
        width,
        height,
    )
    (row,) = known
    return np.array(
        [[row["focal_x"], 0, row["centre_x"]], [0, row["focal_y"], row["centre_y"]], [0, 0, 1]], dtype=float
    )
