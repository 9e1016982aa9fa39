"""Bags as topics and their messages in log order: rosbag2 and ROS 1 by way of rosbags, other MCAP files by way of mcap.

rosbags reads folders and files of rosbag2 (MCAP and SQLite, split, compressed by message or file) and of ROS 1. It
takes messages of ROS alone, and files that have their end; Foxglove's messages as JSON, and what is whole of a file
that was cut off, are read by mcap.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from stampede._core import Error
from stampede.faults import fault, reading
from stampede.files import plain_file

_MAGIC = b"\x89MCAP0\r\n"
_SQLITE = b"SQLite format 3\x00"
_ROS_1 = b"#ROSBAG"
_METADATA = "metadata.yaml"
_INSTALL = '\n    pip install "stampede-sim[recordings]"'
_CUT = "the recorder was stopped hard, or a copy was cut off"


@dataclass(frozen=True)
class Topic:
    name: str
    schema: str  # name of the messages' type
    encoding: str  # cdr, ros1, json …


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
        with plain_file(path).open("rb") as stream:
            head = stream.read(16)
    except OSError as error:
        raise fault(str(path), f"it cannot be read: {error.strerror}", "check its name and permissions") from error
    if head.startswith(_MAGIC):
        bag = McapBag(path, truncated)
        of_ros = path.suffix == ".mcap" and all(topic.encoding == "cdr" for topic in bag.topics())
        return RosBag(path) if of_ros and not truncated else bag
    if head.startswith(_SQLITE):
        if path.suffix != ".db3":
            raise fault(str(path), "rosbags knows files of SQLite by the ending .db3", "name it so")
        return RosBag(path)
    if head.startswith(_ROS_1):
        return RosBag(path, ros_1=True)
    raise fault(
        str(path), "it is neither MCAP nor a bag of ROS 1 or 2", "name a .mcap, .db3 or .bag file, or a bag's folder"
    )


def _of_folder(folder: Path, truncated: bool) -> Bag:
    for one in folder.iterdir():
        if not one.is_dir():
            plain_file(one)  # rosbags opens what the metadata name
    if (folder / _METADATA).is_file() and not truncated:
        return RosBag(folder)
    files = sorted(one for ending in ("*.mcap", "*.db3", "*.bag") for one in folder.glob(ending))
    if not files:
        cure = f"name the folder in which {_METADATA} is"
        raise fault(str(folder), "there is no .mcap, .db3 or .bag file in it", cure)
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


class RosBag:
    """A bag of ROS, by way of the package rosbags."""

    def __init__(self, path: Path, ros_1: bool = False) -> None:
        try:
            from rosbags import rosbag1, rosbag2
        except ImportError as error:
            raise ImportError(f"rosbags is missing{_INSTALL}") from error
        self._path, self._encoding = path, "ros1" if ros_1 else "cdr"
        self._open: Any = rosbag1.Reader if ros_1 else rosbag2.Reader
        with self._reading(), self._open(path) as reader:
            self._topics = {Topic(one.topic, one.msgtype, self._encoding) for one in reader.connections}
        if not self._topics:
            raise fault(str(path), "it holds no topic", "record with `ros2 bag record TOPIC…`")

    def _reading(self) -> Any:
        cure = f"{_CUT}: --truncated takes what is whole of MCAP, `ros2 bag reindex` and `rosbag reindex` mend others"
        return reading(str(self._path), cure)

    def topics(self) -> list[Topic]:
        return sorted(self._topics, key=lambda topic: topic.name)

    def messages(self, names: set[str]) -> Iterator[tuple[str, int, bytes]]:
        with self._reading(), self._open(self._path) as reader:
            wanted = [one for one in reader.connections if one.topic in names]
            for connection, log_ns, data in reader.messages(connections=wanted) if wanted else ():
                yield connection.topic, log_ns, bytes(data)

    def about(self) -> dict[str, str]:
        return {}


class McapBag:
    """An MCAP file, by way of the package mcap."""

    def __init__(self, path: Path, truncated: bool = False) -> None:
        self._path = path
        try:
            from mcap import reader
        except ImportError as error:
            raise ImportError(f"mcap is missing{_INSTALL}") from error
        self._reader = reader
        self._summary = None if truncated else self._read_summary()

    def _reading(self) -> Any:
        return reading(
            str(self._path), f"{_CUT}: --truncated takes what is whole, `mcap recover` makes it a whole file"
        )

    def _read_summary(self) -> Any:
        with self._reading(), self._path.open("rb") as stream:
            summary = self._reader.make_reader(stream).get_summary()
            if summary is None or not summary.channels:
                raise ValueError("it has no summary")
            return summary

    def topics(self) -> list[Topic]:
        if self._summary is None:
            with self._reading():
                messages = self._whole_messages(None)
                found = {Topic(one.topic, kind.name if kind else "", one.message_encoding) for kind, one, _ in messages}
            return sorted(found, key=lambda topic: topic.name)
        with self._reading():
            kinds, channels = self._summary.schemas, self._summary.channels.values()
            names = {one.schema_id: kinds[one.schema_id].name if one.schema_id else "" for one in channels}
            found = {Topic(one.topic, names[one.schema_id], one.message_encoding) for one in channels}
            return sorted(found, key=lambda topic: topic.name)

    def messages(self, names: set[str]) -> Iterator[tuple[str, int, bytes]]:
        if self._summary is None:
            for _, channel, message in self._whole_messages(names):
                yield channel.topic, message.log_time, message.data
            return
        with self._reading(), self._path.open("rb") as stream:
            for _, channel, message in self._reader.make_reader(stream).iter_messages(topics=list(names)):
                yield channel.topic, message.log_time, message.data

    def about(self) -> dict[str, str]:
        if self._summary is None:
            return {}
        with self._reading(), self._path.open("rb") as stream:
            for one in self._reader.make_reader(stream).iter_metadata():
                if one.name == "episode":
                    return dict(one.metadata)
        return {}

    def _whole_messages(self, names: set[str] | None) -> Iterator[tuple[Any, Any, Any]]:
        """Up to where the file ends, in the file's order."""
        wanted = None if names is None else list(names)
        with self._path.open("rb") as stream:
            messages = self._reader.NonSeekingReader(stream).iter_messages(topics=wanted, log_time_order=False)
            while True:
                try:
                    with self._reading():
                        one = next(messages, None)
                except Error:  # the end
                    return
                if one is None:
                    return
                yield one
