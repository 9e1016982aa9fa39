"""LeRobotDataset v2.1 and v3.0 to recording folders, one an episode.

`observation.state` holds the joints, by the names of its feature; `observation.velocity` and `observation.effort`,
or our exporter's further channels, the rest; `action` is the command where it has the joints' names. Films are decoded;
pictures in tables go through as they are. `subtask_index` becomes segments, tasks sentences.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stampede.export.lerobot import tables
from stampede.export.video import library as av_library
from stampede.faults import fault
from stampede.files import plain_file
from stampede.recordings import rows as steps
from stampede.recordings.folder import FolderWriter
from stampede.recordings.given import Given
from stampede.recordings.pictures import packed
from stampede.recordings.roles import camera_name
from stampede.recordings.rows import Rows

Array = NDArray[Any]
Json = dict[str, Any]

_STATE = "observation.state"
_VELOCITIES = ("observation.velocity", "observation.joint_velocities")
_EFFORTS = ("observation.effort", "observation.joint_forces")
_CHUNK = 1000  # episodes a folder, where info.json does not say it


def add_arguments(parser: argparse.ArgumentParser) -> None:
    steps.add_arguments(parser)


def convert(given: Given, options: argparse.Namespace) -> list[Path]:
    """Raises Error for what is no such dataset, and for another robot."""
    dataset = _Dataset(Path(options.source))
    numbers = steps.numbers_of(options.episodes, len(dataset.episodes), options.source)
    folders = []
    for number in numbers:
        path = steps.folder_of(given, number, len(numbers))
        with FolderWriter(path, options.skip_bad) as folder:
            _write(folder, dataset, number, given, options)
        folders.append(path)
    given.tell(f"{len(folders)} episodes of {options.source}")
    return folders


class _Dataset:
    """info.json, the list of episodes, and their tables."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.arrow, self.parquet, _ = tables()
        plain_file(root / "meta" / "info.json")
        try:
            self.info: Json = json.loads((root / "meta" / "info.json").read_text())
            self.version = str(self.info["codebase_version"]).lstrip("v")
            self.fps = float(self.info["fps"])
            self.features: Json = self.info["features"]
        except (OSError, ValueError, KeyError) as error:
            raise fault(
                str(root), f"it is no LeRobotDataset: {error}", "name the folder in which meta/info.json is"
            ) from error
        if self.version not in ("3.0", "2.1", "2.0"):
            raise fault(str(root), f"LeRobotDataset v{self.version} is not read", "convert it to v3.0 with LeRobot")
        if _STATE not in self.features:
            raise fault(str(root), f"it has no feature {_STATE}", f"it has {', '.join(self.features)}")
        self.episodes = self._episodes()
        self.tasks = self._index("tasks", "task")
        self.subtasks = self._index("subtasks", "subtask")

    def _episodes(self) -> list[Json]:
        if self.version == "3.0":
            files = sorted((self.root / "meta" / "episodes").rglob("*.parquet"))
            found = [row for file in files for row in self.read(file).to_pylist()]
        else:
            found = self._lines("episodes.jsonl")
        if not found:
            raise fault(str(self.root / "meta"), "it lists no episode", "copy all of the dataset")
        return sorted(found, key=lambda row: row["episode_index"])

    def read(self, file: Path, **options: Any) -> Any:
        plain_file(file)
        try:
            return self.parquet.read_table(file, **options)
        except (OSError, self.arrow.ArrowException) as error:
            raise fault(
                str(file), f"it is missing, ends early or is damaged: {error}", "copy all of the dataset"
            ) from error

    def _lines(self, name: str) -> list[Json]:
        file = plain_file(self.root / "meta" / name)
        try:
            return [json.loads(line) for line in file.read_text().splitlines() if line.strip()]
        except (OSError, ValueError) as error:
            raise fault(str(file), f"it cannot be read: {error}", "copy all of the dataset") from error

    def _index(self, name: str, column: str) -> dict[int, str]:
        """Texts by number. pandas keeps them as the table's index."""
        file = self.root / "meta" / f"{name}.parquet"
        if file.exists():
            rows = self.read(file).to_pylist()
            return {int(row[f"{column}_index"]): str(row.get(column, row.get("__index_level_0__", ""))) for row in rows}
        if (self.root / "meta" / f"{name}.jsonl").exists():
            return {int(row[f"{column}_index"]): str(row[column]) for row in self._lines(f"{name}.jsonl")}
        return {}

    def table(self, number: int) -> Any:
        one = self.episodes[number]
        places = {
            "chunk_index": one.get("data/chunk_index"),
            "file_index": one.get("data/file_index"),
            "episode_chunk": number // int(self.info.get("chunks_size", _CHUNK)),
            "episode_index": number,
        }
        file = self._place("data_path", places)
        table = self.read(file, filters=[("episode_index", "=", one["episode_index"])])
        if table.num_rows != one["length"]:
            raise fault(
                str(file),
                f"{table.num_rows} of {one['length']} rows of episode {number} are there",
                "copy all of the dataset",
            )
        return table

    def film(self, number: int, key: str) -> tuple[Path, float]:
        """The film of a feature, and where in it the episode begins, s."""
        one = self.episodes[number]
        places = {
            "video_key": key,
            "chunk_index": one.get(f"videos/{key}/chunk_index"),
            "file_index": one.get(f"videos/{key}/file_index"),
            "episode_chunk": number // int(self.info.get("chunks_size", _CHUNK)),
            "episode_index": number,
        }
        return self._place("video_path", places), float(one.get(f"videos/{key}/from_timestamp") or 0.0)

    def _place(self, kind: str, places: Json) -> Path:
        """A file by a pattern of info.json, which names the dataset's own; they may be links, as in a hub's cache."""
        name = str(self.info[kind]).format(**places)
        if name.startswith("/") or ".." in name.split("/"):
            cure = f"name files of the dataset in `{kind}`"
            raise fault(str(self.root / "meta" / "info.json"), f"its {kind} leads out of the dataset: {name}", cure)
        return self.root / name

    def names(self, feature: str) -> list[str]:
        names = self.features[feature].get("names") or []
        if isinstance(names, dict):
            names = next(iter(names.values()), [])
        return [str(name) for name in names]


def _write(folder: FolderWriter, dataset: _Dataset, number: int, given: Given, options: argparse.Namespace) -> None:
    table = dataset.table(number)
    place = f"{options.source}, episode {number}"
    rows = _rows(dataset, table, given, options, place)
    task = steps.name_of(rows.labels["language"][0]["text"]) if rows.labels.get("language") else ""
    about: Json = {"task": task, "frame_hz": dataset.fps}
    if "next.success" in table.column_names:
        about["success"] = str(bool(np.ravel(table["next.success"].to_pylist()[-1])[0]))
    steps.write_numbers(folder, rows, given.robot.arm)
    for key, feature in dataset.features.items():
        if feature.get("dtype") in ("image", "video"):
            camera = camera_name(key.rpartition(".")[2])
            files = (
                _stored(table, key, rows, place) if feature["dtype"] == "image" else _film(dataset, number, key, rows)
            )
            steps.write_pictures(folder, "rgb", camera, files, f"{place}, {key}")
    steps.finish(folder, given, rows, about, f"{options.source}, episode {number}")


def _rows(dataset: _Dataset, table: Any, given: Given, options: argparse.Namespace, place: str) -> Rows:
    arm = given.robot.arm
    unit = np.pi / 180 if options.degrees else 1.0
    state = _matrix(table, _STATE)
    at, gripper = steps.columns_of(dataset.names(_STATE), state.shape[1], arm, f"{place}, {_STATE}", options.prefix)
    times = np.ravel(_matrix(table, "timestamp"))
    even = np.round(times * dataset.fps) / dataset.fps  # float32 seconds, of an even clock
    times = np.where(np.abs(times - even) < 1e-3, even, times)
    rows = Rows([round(float(time) * 1e9) for time in times], state[:, at] * unit, place=place)
    for name, features, factor in (("velocity", _VELOCITIES, unit), ("effort", _EFFORTS, 1.0)):
        found = next((one for one in features if one in dataset.features), None)
        if found is not None:
            values = _matrix(table, found)
            if values.shape[1] >= len(arm):
                there, _ = steps.columns_of(
                    dataset.names(found)[: values.shape[1]], values.shape[1], arm, f"{place}, {found}", options.prefix
                )
                setattr(rows, name, values[:, there] * factor)
    if gripper is not None:
        rows.opening = state[:, gripper]
    names = dataset.names("action") if "action" in dataset.features else []
    if names and set(dataset.names(_STATE)) <= set(names):
        action = _matrix(table, "action")
        there, _ = steps.columns_of(names, action.shape[1], arm, f"{place}, action", options.prefix)
        rows.command = action[:, there] * unit
    rows.labels = _labels(dataset, table)
    return rows


def _matrix(table: Any, column: str) -> Array:
    values = np.array(table[column].to_pylist(), dtype=float)
    return values if values.ndim > 1 else values[:, None]


def _labels(dataset: _Dataset, table: Any) -> Json:
    numbers = table["task_index"].to_pylist() if "task_index" in table.column_names else []
    texts = [dataset.tasks[one] for one in dict.fromkeys(numbers) if one in dataset.tasks]
    labels: Json = {"labelled_by": "person", "language": [{"level": "task", "text": text} for text in texts if text]}
    segments: list[Json] = []
    subtasks = table["subtask_index"].to_pylist() if "subtask_index" in table.column_names else []
    for frame, one in enumerate(np.ravel(subtasks).astype(int).tolist()):
        if one not in dataset.subtasks:
            continue
        text = dataset.subtasks[one]
        if segments and segments[-1]["end_frame"] == frame and segments[-1]["label"] == text:
            segments[-1]["end_frame"] = frame + 1
        else:
            start = {"kind": "skill", "name": steps.name_of(text), "arguments": [], "label": text}
            segments.append({**start, "first_frame": frame, "end_frame": frame + 1})
    for one in segments:  # frames here are the dataset's; seconds hold at any rate
        one["start_s"], one["end_s"] = one.pop("first_frame") / dataset.fps, one.pop("end_frame") / dataset.fps
    return {**labels, "segments": segments} if segments else labels


def _stored(table: Any, key: str, rows: Rows, place: str) -> Iterator[tuple[int, bytes, str]]:
    for stamp, one in zip(rows.stamps_ns, table[key].to_pylist(), strict=True):
        data = one.get("bytes") if isinstance(one, dict) else None
        if not data:
            raise fault(place, f"a picture of {key} is not in the table", "copy all of the dataset")
        yield stamp, data, "jpg" if data.startswith(b"\xff\xd8") else "png"


def _film(dataset: _Dataset, number: int, key: str, rows: Rows) -> Iterator[tuple[int, bytes, str]]:
    path, start_s = dataset.film(number, key)
    av = av_library()
    if not path.is_file():
        raise fault(str(path), "the film is missing", "copy all of the dataset")
    count = 0
    try:
        with av.open(str(path), format="mp4") as film:  # no list of other files, which FFmpeg would follow
            stream = film.streams.video[0]
            stream.thread_type = "AUTO"
            half = 0.5 / dataset.fps
            if start_s > 0:
                film.seek(int(start_s / stream.time_base), stream=stream)
            for frame in film.decode(stream):
                if frame.time is None or frame.time < start_s - half:
                    continue
                if count == len(rows.stamps_ns):
                    break
                yield rows.stamps_ns[count], packed(frame.to_ndarray(format="rgb24")), "png"
                count += 1
    except (av.FFmpegError, IndexError) as error:
        raise fault(str(path), f"the film ends early or is damaged: {error}", "copy all of the dataset") from error
    if count < len(rows.stamps_ns):
        raise fault(str(path), f"the film has {count} of {len(rows.stamps_ns)} pictures", "copy all of the dataset")
