"""Bags: MCAP files, and folders or files of rosbag2, in MCAP or SQLite, as topics and their messages in log order."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from stampede.faults import fault

_MAGIC = b"\x89MCAP0\r\n"
_SQLITE = b"SQLite format 3\x00"


@dataclass(frozen=True)
class Topic:
    name: str
    schema: str  # name of the messages' type
    encoding: str  # cdr, json …


class Bag(Protocol):
    """A recording on the disk. Raises Error for what is no bag, and for one that ends early."""

    def topics(self) -> list[Topic]:
        """By name."""

    def messages(self, names: set[str]) -> Iterator[tuple[str, int, bytes]]:
        """Topic, log time (ns) and bytes of the messages of these topics, in log order."""

    def about(self) -> dict[str, str]:
        """What the bag says of the episode in it, as our own exporter writes it; else nothing."""


def open_bag(path: Path, truncated: bool = False) -> Bag:
    """truncated: of a file that ends early, what is whole is taken."""
    if path.is_dir():
        return _of_folder(path, truncated)
    try:
        with path.open("rb") as stream:
            head = stream.read(16)
    except OSError as error:
        raise fault(str(path), f"it cannot be read: {error.strerror}", "check its name and permissions") from error
    if head.startswith(_MAGIC):
        return McapBag(path, truncated)
    if head.startswith(_SQLITE):
        return SqliteBag(path)
    if head.startswith(b"#ROSBAG"):
        raise fault(str(path), "it is a bag of ROS 1", "convert it: `rosbags-convert` of the package rosbags")
    raise fault(str(path), "it is neither MCAP nor a bag of rosbag2", "name a .mcap or .db3 file, or a bag's folder")


def _of_folder(folder: Path, truncated: bool) -> Bag:
    files = sorted([*folder.glob("*.mcap"), *folder.glob("*.db3")])
    if not files:
        packed = [one.name for one in folder.glob("*.zstd")]
        raise fault(
            str(folder),
            f"{packed[0]} is compressed as a whole" if packed else "there is no .mcap or .db3 file in it",
            "unpack it: `zstd -d`" if packed else "name the folder of a bag, where metadata.yaml is",
        )
    bags = [open_bag(file, truncated) for file in files]
    return bags[0] if len(bags) == 1 else _Parts(bags)


class _Parts:
    """A bag that was split into files, which follow each other in time as their names do."""

    def __init__(self, bags: list[Bag]) -> None:
        self._bags = bags

    def topics(self) -> list[Topic]:
        return sorted({topic for bag in self._bags for topic in bag.topics()}, key=lambda topic: topic.name)

    def messages(self, names: set[str]) -> Iterator[tuple[str, int, bytes]]:
        for bag in self._bags:
            yield from bag.messages(names)

    def about(self) -> dict[str, str]:
        return self._bags[0].about()


class McapBag:
    """An MCAP file, by way of the package mcap."""

    def __init__(self, path: Path, truncated: bool = False) -> None:
        self._path, self._truncated = path, truncated
        try:
            from mcap import exceptions, reader
        except ImportError as error:
            raise ImportError('mcap is missing\n    pip install "stampede[recordings]"') from error
        self._reader, self._errors = reader, exceptions.McapError
        self._summary = None if truncated else self._read_summary()

    def _read_summary(self) -> Any:
        with self._path.open("rb") as stream:
            try:
                summary = self._reader.make_reader(stream).get_summary()
            except (self._errors, OSError, ValueError) as error:
                raise self._cut(error) from error
        if summary is None or not summary.channels:
            raise self._cut("it has no summary")
        return summary

    def _cut(self, error: object) -> Exception:
        return fault(
            str(self._path),
            f"it ends early or is damaged ({error or 'end of file'}): the recorder was stopped hard, or a copy "
            f"was cut off",
            "--truncated takes what is whole; `mcap recover` makes it a whole file",
        )

    def topics(self) -> list[Topic]:
        if self._summary is not None:
            schemas, channels = self._summary.schemas, self._summary.channels.values()
            found = {
                Topic(one.topic, schemas[one.schema_id].name if one.schema_id else "", one.message_encoding)
                for one in channels
            }
        else:
            found = {
                Topic(channel.topic, schema.name if schema else "", channel.message_encoding)
                for schema, channel, _ in self._whole_messages(None)
            }
        return sorted(found, key=lambda topic: topic.name)

    def messages(self, names: set[str]) -> Iterator[tuple[str, int, bytes]]:
        if self._summary is None:
            for _, channel, message in self._whole_messages(names):
                yield channel.topic, message.log_time, message.data
            return
        with self._path.open("rb") as stream:
            try:
                for _, channel, message in self._reader.make_reader(stream).iter_messages(topics=list(names)):
                    yield channel.topic, message.log_time, message.data
            except (self._errors, OSError) as error:
                raise self._cut(error) from error

    def about(self) -> dict[str, str]:
        if self._summary is None:
            return {}
        with self._path.open("rb") as stream:
            for one in self._reader.make_reader(stream).iter_metadata():
                if one.name == "episode":
                    return dict(one.metadata)
        return {}

    def _whole_messages(self, names: set[str] | None) -> Iterator[tuple[Any, Any, Any]]:
        """Up to where the file ends, in the file's order."""
        wanted = None if names is None else list(names)
        with self._path.open("rb") as stream:
            reader = self._reader.NonSeekingReader(stream)
            try:
                yield from reader.iter_messages(topics=wanted, log_time_order=False)
            except Exception as error:  # the decompressors of cut chunks raise errors of their own
                if isinstance(error, GeneratorExit):
                    raise


class SqliteBag:
    """A .db3 file of rosbag2."""

    def __init__(self, path: Path) -> None:
        self._path = path
        rows = self._ask("SELECT id, name, type, serialization_format FROM topics ORDER BY name")
        self._topics = {number: Topic(name, schema, encoding) for number, name, schema, encoding in rows}
        if not self._topics:
            raise fault(str(path), "it holds no topic", "record with `ros2 bag record TOPIC…`")

    def _ask(self, question: str, *values: Any) -> Iterator[tuple[Any, ...]]:
        try:
            connection = sqlite3.connect(f"file:{self._path}?mode=ro", uri=True)
            try:
                yield from connection.execute(question, values)
            finally:
                connection.close()
        except sqlite3.Error as error:
            raise fault(
                str(self._path),
                f"it is no bag, ends early or is damaged ({error})",
                "`ros2 bag reindex` its folder, or `sqlite3 FILE .recover`",
            ) from error

    def topics(self) -> list[Topic]:
        return sorted(self._topics.values(), key=lambda topic: topic.name)

    def messages(self, names: set[str]) -> Iterator[tuple[str, int, bytes]]:
        wanted = [number for number, topic in self._topics.items() if topic.name in names]
        marks = ",".join("?" * len(wanted))
        rows = self._ask(
            f"SELECT topic_id, timestamp, data FROM messages WHERE topic_id IN ({marks}) ORDER BY timestamp, id",
            *wanted,
        )
        for number, log_ns, data in rows:
            yield self._topics[number].name, log_ns, data

    def about(self) -> dict[str, str]:
        return {}
