"""LeRobotDataset v3.0, or v2.1: numbers in parquet files, cameras as films, statistics.

Splits are ranges of episodes, in the order train, valid, test. Skills are there as `subtask_index` (-1: none) and
`meta/subtasks.parquet`; with --language also as `language_persistent`, for LeRobot 0.6: subtasks, the plan, motions and
other wordings of the task. Columns of `meta/episodes` say each episode's seed, variation, success and number of skills.
Actions are in natural units: rad or m and rotation vectors, and the opening of the gripper in m. Poses of things,
`observation.environment_state`, are there where all episodes have the same things.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np

from stampede.catalogue import StoredEpisode
from stampede.export import common_cameras, split_of
from stampede.export.pieces import Pieces, place
from stampede.export.steps import ACTIONS, Array, Steps, check_names
from stampede.export.video import ENCODERS, NAMES, library, write_film
from stampede.faults import fault
from stampede.file_names import file_name

_THINGS = "observation.environment_state"
_SPLITS = ("train", "valid", "test")
_QUANTILES = {"q01": 0.01, "q10": 0.1, "q50": 0.5, "q90": 0.9, "q99": 0.99}
_CHUNK = 1000  # files a folder
_DATA_MB, _VIDEO_MB = 100, 200  # as LeRobot's own; films are one an episode

_LANGUAGE = ("language_persistent", "language_events")
_NUMBERS = {  # what LeRobot adds to every frame
    "timestamp": "float32",
    "frame_index": "int64",
    "episode_index": "int64",
    "index": "int64",
    "task_index": "int64",
}


def tables() -> tuple[Any, Any, Any]:
    """pyarrow, pyarrow.parquet and pandas. Raises ImportError that says how to install them."""
    try:
        import pandas
        import pyarrow
        import pyarrow.parquet
    except ImportError as error:
        raise ImportError(f'{error.name} is missing\n    pip install "stampede-sim[lerobot]"') from error
    return pyarrow, pyarrow.parquet, pandas


class Writer:
    """Writes data/, videos/ and meta/."""

    def __init__(self, folder: Path, options: argparse.Namespace, episodes: Sequence[StoredEpisode]) -> None:
        tables()
        library()
        if options.language and options.version != "3.0":
            raise fault("--language", "LeRobot v2.1 has no such columns", "--version 3.0")
        self._folder, self._options = folder, options
        self._pieces = Pieces(folder)
        of_split = {episode.id: split_of(episode, options.valid) for episode in episodes}
        self._episodes = sorted(episodes, key=lambda episode: _SPLITS.index(of_split[episode.id]))
        self._split_sizes = {split: sum(1 for one in of_split.values() if one == split) for split in _SPLITS}
        self._tasks = _numbered([_task(episode) for episode in self._episodes])
        self._subtasks: dict[str, int] = {}
        rates = {episode.frame_hz for episode in episodes}
        if len(rates) > 1 or not float(next(iter(rates))).is_integer():
            raise fault("frame_hz", f"LeRobot knows one whole rate, not {sorted(rates)}", "--where 'frame_hz = 20'")
        self._fps = int(rates.pop())
        self._cameras = common_cameras(self._episodes, options)
        self._features: dict[str, Any] = {}

    @staticmethod
    def add_arguments(parser: argparse.ArgumentParser) -> None:
        parser.add_argument("--version", choices=("3.0", "2.1"), default="3.0", help="(default: %(default)s)")
        parser.add_argument("--action", choices=ACTIONS, default="joint_position", help="(default: %(default)s)")
        parser.add_argument(
            "--encoder", choices=tuple(ENCODERS), default="libx264", help="of the films (default: %(default)s)"
        )
        parser.add_argument(
            "--language", action="store_true", help="columns of language as well; LeRobot before 0.5 cannot read them"
        )

    def has(self, episode: StoredEpisode) -> bool:
        return self._pieces.has(episode.id)

    def write(self, episode: StoredEpisode) -> None:
        steps = Steps(episode, channels=self._options.channels)
        columns, names, labels = self._columns(steps)
        with self._pieces.making(episode.id) as piece:
            with ThreadPoolExecutor(max(1, len(self._cameras))) as threads:
                films = [threads.submit(self._film, piece, episode, camera, steps.count) for camera in self._cameras]
                names_of_films = [f"observation.images.{file_name(camera)}" for camera in self._cameras]
                histograms = {name: film.result() for name, film in zip(names_of_films, films, strict=True)}
            np.savez(piece / "columns.npz", **columns)  # type: ignore[arg-type]
            np.savez(piece / "pictures.npz", **histograms)  # type: ignore[arg-type]
            described = {
                "names": names,
                "labels": labels,
                "sizes": self._sizes(episode),
                "about": _about(steps),
                "language": _language(steps) if self._options.language else [],
            }
            (piece / "described.json").write_text(json.dumps(described))

    def finish(self) -> None:
        pieces = [self._pieces.of(episode.id) for episode in self._episodes]
        columns = [dict(np.load(piece / "columns.npz")) for piece in pieces]
        described = [json.loads((piece / "described.json").read_text()) for piece in pieces]
        names = dict(described[0]["names"])
        if not names[_THINGS] or any(one["names"][_THINGS] != names[_THINGS] for one in described):
            for one in (names, *columns):  # real ones have none; of several tasks: a feature is the same in all
                del one[_THINGS]
        for episode, one in zip(self._episodes, described, strict=True):
            check_names(episode, one["names"], names)
            if one["sizes"] != described[0]["sizes"]:
                raise fault(f"episode {episode.id}", "its pictures have another size than the first's", "--where SQL")
        self._features = self._describe(names, described[0]["sizes"])
        self._subtasks = _numbered(sorted({label for one in described for label in one["labels"]}))
        first = 0
        for number, (one, about) in enumerate(zip(columns, described, strict=True)):
            self._number(one, number, first, about["labels"])
            first += len(one["index"])
        histograms = [dict(np.load(piece / "pictures.npz")) for piece in pieces]
        stats = [_stats(one, pictures) for one, pictures in zip(columns, histograms, strict=True)]
        (self._folder / "meta").mkdir(exist_ok=True)
        if self._options.version == "3.0":
            whole: dict[str, Any] = {}
            for name in columns[0]:  # one after the other, so that little is there twice
                whole |= _stats({name: np.concatenate([one[name] for one in columns])}, {})
            pictures = {name: sum(one[name] for one in histograms) for name in histograms[0]}
            whole |= _picture_stats(pictures, first)
            self._finish_3(columns, described, stats, whole)
        else:
            self._finish_2(columns, described, stats)
        self._write_index("subtasks", "subtask", self._subtasks)
        self._pieces.remove()

    def close(self) -> None:
        """No file is open between two episodes."""

    # Episodes

    def _columns(self, steps: Steps) -> tuple[dict[str, Array], dict[str, list[str]], list[str]]:
        """Rows of all steps, names of the components of vectors, and what `subtask_index` counts in this episode."""
        arrays = steps.arrays
        for name, values in steps.channels.items():
            if not values.shape[1]:
                told = f"channel '{name}' has no component here, which LeRobot has no feature for"
                raise fault(f"episode {steps.episode.id}", told, "leave it out of --channels")
        state = np.hstack([steps.observed("joint_positions"), steps.observed("gripper_opening")[:, None]])
        things = steps.observed("task_low_dim_state")
        labels = list(_numbered([skill.label for skill in steps.skills if skill.label]))
        subtask = np.full(steps.count, -1, dtype=np.int64)
        for skill in steps.skills:
            if skill.label:
                subtask[skill.first_frame : skill.end_frame] = labels.index(skill.label)
        done = np.zeros(steps.count, dtype=bool)
        done[-1] = True
        frames = np.arange(steps.count, dtype=np.int64)
        columns = {
            "observation.state": state.astype(np.float32),
            _THINGS: things.astype(np.float32),
            "action": steps.natural_actions(self._options.action).astype(np.float32),
            **{f"observation.{name}": _feature(values[:-1]) for name, values in steps.channels.items()},
            "next.reward": steps.rewards.astype(np.float32),
            "next.done": done,
            "next.success": steps.success,
            "subtask_index": subtask,
            "timestamp": (frames / self._fps).astype(np.float32),
            "frame_index": frames,
            # What counts over all episodes is known in the end.
            "episode_index": np.zeros_like(frames),
            "index": frames,
            "task_index": np.zeros_like(frames),
        }
        names = {
            "observation.state": [*arrays.column("joint_positions").labels, "gripper"],
            _THINGS: list(arrays.column("task_low_dim_state").labels),
            "action": steps.action_names(self._options.action),
            **{f"observation.{name}": labels for name, labels in steps.channel_names.items()},
        }
        return columns, names, labels

    def _number(self, columns: dict[str, Array], number: int, first: int, labels: Sequence[str]) -> None:
        """Numbers that count over all episodes. first: the index of its first row."""
        columns["index"] = columns["frame_index"] + first
        columns["episode_index"] = np.full_like(columns["index"], number)
        columns["task_index"] = np.full_like(columns["index"], self._tasks[_task(self._episodes[number])])
        everywhere = np.array([*(self._subtasks[label] for label in labels), -1], dtype=np.int64)
        columns["subtask_index"] = everywhere[columns["subtask_index"]]  # -1 stays: it is the last

    def _film(self, piece: Path, episode: StoredEpisode, camera: str, count: int) -> Array:
        """Writes it; gives how often each value is in each channel: 3 x 256."""
        pictures = episode.pictures(f"{camera}_rgb", range(count), draw=self._options.draw, threads=1)
        if pictures.shape[1] % 2 or pictures.shape[2] % 2:
            raise fault(f"camera {camera}", "pictures of films have an even height and width", "--cameras NAMES")
        write_film(piece / f"{file_name(camera)}.mp4", pictures, self._fps, self._options.encoder)
        return np.stack([np.bincount(pictures[..., k].ravel(), minlength=256) for k in range(3)])

    def _sizes(self, episode: StoredEpisode) -> dict[str, list[int]]:
        return {
            camera: list(episode.pictures(f"{camera}_rgb", [0], draw=self._options.draw).shape[1:])
            for camera in self._cameras
        }

    # The whole

    def _describe(self, names: dict[str, list[str]], sizes: dict[str, list[int]]) -> dict[str, Any]:
        features: dict[str, Any] = {
            name: {"dtype": "float32", "shape": [len(labels)], "names": labels} for name, labels in names.items()
        }
        codec = NAMES[self._options.encoder]
        for camera, shape in sizes.items():
            features[f"observation.images.{file_name(camera)}"] = {
                "dtype": "video",
                "shape": shape,
                "names": ["height", "width", "channels"],
                "info": {
                    "video.height": shape[0],
                    "video.width": shape[1],
                    "video.codec": codec,
                    "video.pix_fmt": "yuv420p",
                    "video.is_depth_map": False,
                    "video.fps": self._fps,
                    "video.channels": 3,
                    "has_audio": False,
                },
            }
        singles = {"next.reward": "float32", "next.done": "bool", "next.success": "bool", "subtask_index": "int64"}
        for name, kind in {**singles, **_NUMBERS}.items():
            features[name] = {"dtype": kind, "shape": [1], "names": None}
        if self._options.language:
            for name in _LANGUAGE:
                features[name] = {"dtype": "language", "shape": [1], "names": None}
        return features

    def _info(self, frames: int) -> dict[str, Any]:
        first, splits = 0, {}
        for split, size in self._split_sizes.items():
            if size:
                splits[split] = f"{first}:{first + size}"
            first += size
        return {
            "codebase_version": f"v{self._options.version}",
            "robot_type": "panda",
            "total_episodes": len(self._episodes),
            "total_frames": frames,
            "total_tasks": len(self._tasks),
            "chunks_size": _CHUNK,
            "fps": self._fps,
            "splits": splits,
            "features": self._features,
        }

    def _finish_3(
        self, columns: list[dict[str, Array]], described: list[dict[str, Any]], stats: list[Any], whole: Any
    ) -> None:
        arrow, parquet, _ = tables()
        data, rows, file, first = None, [], -1, 0
        path = partial = self._folder
        for number, episode in enumerate(self._episodes):
            if data is None or partial.stat().st_size > _DATA_MB * 1e6:
                if data is not None:
                    data.close()
                    partial.replace(path)
                file += 1
                path = self._folder / f"data/chunk-{file // _CHUNK:03d}/file-{file % _CHUNK:03d}.parquet"
                partial = path.with_name(path.name + ".part")
                path.parent.mkdir(parents=True, exist_ok=True)
                data = parquet.ParquetWriter(partial, self._schema(), compression="snappy", use_dictionary=True)
            data.write_table(self._table(columns[number], described[number]["language"]))  # a row group an episode
            length = len(columns[number]["index"])
            row: dict[str, Any] = {
                "episode_index": number,
                "tasks": [_task(episode)],
                "length": length,
                "data/chunk_index": file // _CHUNK,
                "data/file_index": file % _CHUNK,
                "dataset_from_index": first,
                "dataset_to_index": first + length,
                "meta/episodes/chunk_index": 0,
                "meta/episodes/file_index": 0,
                **described[number]["about"],
            }
            for camera in self._cameras:
                key = f"observation.images.{file_name(camera)}"
                chunk, place_in_chunk = number // _CHUNK, number % _CHUNK
                film = self._pieces.of(episode.id) / f"{file_name(camera)}.mp4"
                place(film, self._folder / f"videos/{key}/chunk-{chunk:03d}/file-{place_in_chunk:03d}.mp4")
                row[f"videos/{key}/chunk_index"] = chunk
                row[f"videos/{key}/file_index"] = place_in_chunk
                row[f"videos/{key}/from_timestamp"] = 0.0
                row[f"videos/{key}/to_timestamp"] = length / self._fps
            for feature, values in stats[number].items():
                row |= {f"stats/{feature}/{name}": value for name, value in values.items()}
            rows.append(row)
            first += length
        assert data is not None
        data.close()
        partial.replace(path)
        meta = self._folder / "meta"
        episodes = meta / "episodes/chunk-000/file-000.parquet"
        episodes.parent.mkdir(parents=True, exist_ok=True)
        parquet.write_table(arrow.Table.from_pylist(rows), episodes)
        self._write_index("tasks", "task", self._tasks)
        info = self._info(first) | {
            "data_files_size_in_mb": _DATA_MB,
            "video_files_size_in_mb": _VIDEO_MB,
            "data_path": "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet",
            "video_path": "videos/{video_key}/chunk-{chunk_index:03d}/file-{file_index:03d}.mp4"
            if self._cameras
            else None,
        }
        (meta / "stats.json").write_text(json.dumps(whole, indent=4))
        (meta / "info.json").write_text(json.dumps(info, indent=4))

    def _finish_2(self, columns: list[dict[str, Array]], described: list[dict[str, Any]], stats: list[Any]) -> None:
        _, parquet, _ = tables()
        meta, episodes, frames = self._folder / "meta", [], 0
        for number, episode in enumerate(self._episodes):
            chunk = f"chunk-{number // _CHUNK:03d}"
            path = self._folder / f"data/{chunk}/episode_{number:06d}.parquet"
            path.parent.mkdir(parents=True, exist_ok=True)
            partial = path.with_name(path.name + ".part")
            parquet.write_table(self._table(columns[number], []), partial, compression="snappy")
            partial.replace(path)
            for camera in self._cameras:
                film = self._pieces.of(episode.id) / f"{file_name(camera)}.mp4"
                key = f"observation.images.{file_name(camera)}"
                place(film, self._folder / f"videos/{chunk}/{key}/episode_{number:06d}.mp4")
            length = len(columns[number]["index"])
            frames += length
            about = {"episode_index": number, "tasks": [_task(episode)], "length": length}
            episodes.append(about | described[number]["about"])
        exact = {"q01", "q10", "q50", "q90", "q99"}  # v2.1 has no quantiles
        lean = [{f: {n: v for n, v in s.items() if n not in exact} for f, s in one.items()} for one in stats]
        _write_lines(meta / "episodes.jsonl", episodes)
        _write_lines(meta / "tasks.jsonl", [{"task_index": k, "task": text} for text, k in self._tasks.items()])
        _write_lines(meta / "episodes_stats.jsonl", [{"episode_index": k, "stats": one} for k, one in enumerate(lean)])
        info = self._info(frames) | {
            "total_videos": len(self._cameras) * len(self._episodes),
            "total_chunks": (len(self._episodes) + _CHUNK - 1) // _CHUNK,
            "data_path": "data/chunk-{episode_chunk:03d}/episode_{episode_index:06d}.parquet",
            "video_path": "videos/chunk-{episode_chunk:03d}/{video_key}/episode_{episode_index:06d}.mp4"
            if self._cameras
            else None,
        }
        (meta / "info.json").write_text(json.dumps(info, indent=4))

    def _schema(self) -> Any:
        arrow, _, _ = tables()
        kinds = {"float32": arrow.float32(), "int64": arrow.int64(), "bool": arrow.bool_()}
        fields = []
        for name, feature in self._features.items():
            if feature["dtype"] == "language":
                fields.append(arrow.field(name, arrow.list_(_language_row(name))))
            elif feature["dtype"] != "video":
                kind = kinds[feature["dtype"]]
                vector = feature["shape"][0] > 1
                fields.append(arrow.field(name, arrow.list_(kind, feature["shape"][0]) if vector else kind))
        return arrow.schema(fields)

    def _table(self, columns: dict[str, Array], language: list[dict[str, Any]]) -> Any:
        arrow, _, _ = tables()
        schema = self._schema()
        values = []
        for field in schema:
            if field.name in _LANGUAGE:  # of an episode: the same rows at every frame, and no events
                rows = language if field.name == "language_persistent" else []
                values.append(arrow.array([rows] * len(columns["index"]), type=field.type))
                continue
            column = columns[field.name]
            if column.ndim > 1:
                flat = arrow.array(np.ascontiguousarray(column).ravel())
                values.append(arrow.FixedSizeListArray.from_arrays(flat, column.shape[1]))
            else:
                values.append(arrow.array(column))
        return arrow.Table.from_arrays(values, schema=schema)

    def _write_index(self, name: str, column: str, numbers: dict[str, int]) -> None:
        """A table whose index is the text, as LeRobot reads it."""
        _, _, pandas = tables()
        frame = pandas.DataFrame({f"{column}_index": list(numbers.values())}, index=list(numbers))
        frame.index.name = column
        frame.to_parquet(self._folder / f"meta/{name}.parquet")


def _task(episode: StoredEpisode) -> str:
    sentences = episode.instructions()
    return sentences[0] if sentences else f"{episode.task} {episode.variation or ''}".strip()


def _about(steps: Steps) -> dict[str, Any]:
    """Columns of ours, to filter by."""
    episode = steps.episode
    return {
        "stampede/task": episode.task,
        "stampede/variation": episode.variation or "",
        "stampede/seed": -1 if episode.seed is None else episode.seed,  # as RLDS has it
        "stampede/success": episode.success,
        "stampede/skills": len(steps.skills),
    }


def _language(steps: Steps) -> list[dict[str, Any]]:
    """Rows of `language_persistent`, in time: what holds from a frame on until a row of the same style."""

    def row(frame: int, style: str, content: str, role: str = "assistant") -> dict[str, Any]:
        return {"role": role, "content": content, "style": style, "timestamp": frame / steps.episode.frame_hz}

    skills = [skill for skill in steps.skills if skill.label and skill.first_frame < steps.count]
    plan = "\n".join(f"{number}. {skill.label}" for number, skill in enumerate(skills, 1))
    rows = [row(0, "plan", plan)] if plan else []
    rows += [row(skill.first_frame, "subtask", skill.label) for skill in skills]
    rows += [
        row(motion.first_frame, "motion", " ".join([motion.name, *motion.arguments]))
        for motion in steps.arrays.segments
        if motion.kind == "motion" and motion.first_frame < min(motion.end_frame, steps.count)
    ]
    rows += [row(0, "task_aug", sentence, "user") for sentence in steps.episode.instructions()[1:]]
    return sorted(rows, key=lambda one: (one["timestamp"], one["style"]))


def _language_row(column: str) -> Any:
    """The type of a row of one of LeRobot's columns of language."""
    arrow, _, _ = tables()
    fields = [("role", arrow.string()), ("content", arrow.string()), ("style", arrow.string())]
    if column == "language_persistent":
        fields.append(("timestamp", arrow.float32()))
    return arrow.struct([*fields, ("camera", arrow.string()), ("tool_calls", arrow.list_(arrow.string()))])


def _numbered(texts: Sequence[str]) -> dict[str, int]:
    return {text: number for number, text in enumerate(dict.fromkeys(texts))}


def _feature(rows: Array) -> Array:
    """Rows of a channel, float32; one of a single number is no vector to LeRobot."""
    return (rows[:, 0] if rows.shape[1] == 1 else rows).astype(np.float32)


def _stats(columns: dict[str, Array], histograms: dict[str, Array]) -> dict[str, dict[str, Any]]:
    """Of each feature of one episode or all."""
    stats = {}
    for name, values in columns.items():
        rows = values.reshape(len(values), -1).astype(np.float64)
        stats[name] = {
            "min": rows.min(axis=0).tolist(),
            "max": rows.max(axis=0).tolist(),
            "mean": rows.mean(axis=0).tolist(),
            "std": rows.std(axis=0).tolist(),
            "count": [len(rows)],
            **{key: np.quantile(rows, share, axis=0).tolist() for key, share in _QUANTILES.items()},
        }
    return stats | _picture_stats(histograms, len(next(iter(columns.values()))))


def _picture_stats(histograms: dict[str, Array], frames: int) -> dict[str, dict[str, Any]]:
    """By channel, 3 x 1 x 1, values of 0 … 1."""
    stats: dict[str, dict[str, Any]] = {}
    levels = np.arange(256) / 255
    for name, counts in histograms.items():
        share = counts / counts.sum(axis=1, keepdims=True)
        mean = share @ levels
        below = np.cumsum(share, axis=1)
        one = {
            "min": [levels[row > 0].min() for row in counts],
            "max": [levels[row > 0].max() for row in counts],
            "mean": mean,
            "std": np.sqrt(np.maximum(share @ levels**2 - mean**2, 0)),
            **{key: [levels[np.searchsorted(row, q)] for row in below] for key, q in _QUANTILES.items()},
        }
        stats[name] = {key: np.asarray(value, dtype=np.float64).reshape(3, 1, 1).tolist() for key, value in one.items()}
        stats[name]["count"] = [frames]
    return stats


def _write_lines(path: Path, rows: Sequence[dict[str, Any]]) -> None:
    path.write_text("".join(json.dumps(row) + "\n" for row in rows))
