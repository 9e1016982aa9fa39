"""Writes recording folders, which `stampede import recording` reads (db/recording/README.md)."""

from __future__ import annotations

import json
import math
import shutil
from collections.abc import Iterable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType
from typing import IO, Any

from stampede.faults import fault
from stampede.file_names import FileNames
from stampede.files import check_new, give_name, made_beside

FORM = 1  # `stampede_recording` of recording.json
UNPLACED = "unplaced.json"  # streams of cameras of which nobody knows where they are
_SECOND = 10**9  # ns

Json = dict[str, Any]


def stamp_text(stamp_ns: int) -> str:
    """Seconds with nine digits: no rounding, whatever the epoch."""
    return f"{'-' if stamp_ns < 0 else ''}{abs(stamp_ns) // _SECOND}.{abs(stamp_ns) % _SECOND:09d}"


@dataclass
class Counts:
    """What became of a stream's readings."""

    written: int = 0
    repeated: int = 0  # of the stamp before: left out
    skipped: int = 0  # bad ones, where that was asked for
    first_ns: int = 0
    last_ns: int = 0
    latency_ns: list[int] = field(default_factory=list)  # log time minus stamp

    @property
    def duration_s(self) -> float:
        return (self.last_ns - self.first_ns) / _SECOND


class Stream:
    """One stream of a folder: rows of a CSV file, and pictures beside it. Stamps must rise.

    place: how errors call it. skip_bad: readings with stamps that fall are left out and counted, instead of an Error.
    """

    def __init__(self, file: IO[str], described: Json, place: str, skip_bad: bool) -> None:
        self.described, self.counts, self.place = described, Counts(), place
        self._file, self._skip_bad = file, skip_bad
        self._last_ns: int | None = None

    def takes(self, stamp_ns: int) -> bool:
        """Whether a reading with this stamp is to be written. Raises Error where the clock ran backwards."""
        last = self._last_ns
        if last is None or stamp_ns > last:
            return True
        if stamp_ns == last:
            self.counts.repeated += 1
            return False
        if not self._skip_bad:
            raise fault(
                self.place,
                f"its clock runs backwards, from {stamp_text(last)} to {stamp_text(stamp_ns)} s, at reading "
                f"{self.counts.written + 1}",
                "--skip-bad leaves such readings out; --clock log takes the recorder's times instead",
            )
        self.counts.skipped += 1
        return False

    def skip(self, what: str) -> None:
        """A reading that cannot be used: an Error, or counted."""
        if not self._skip_bad:
            raise fault(f"{self.place}, reading {self.counts.written + 1}", what, "--skip-bad leaves such readings out")
        self.counts.skipped += 1

    def row(self, stamp_ns: int, values: Iterable[float]) -> None:
        """NaN is an empty field. The stamp is one that `takes` agreed to."""
        text = ",".join("" if math.isnan(value) else repr(value) for value in values)
        self._put(stamp_ns, text)

    def picture(self, stamp_ns: int, folder: Path, data: bytes, ending: str) -> None:
        self.picture_file(stamp_ns, folder, ending).write_bytes(data)

    def picture_file(self, stamp_ns: int, folder: Path, ending: str) -> Path:
        """Its row; the file is for the caller to write."""
        name = f"{self.counts.written + 1:06d}.{ending}"
        self._put(stamp_ns, name)
        return folder / name

    def _put(self, stamp_ns: int, text: str) -> None:
        self._file.write(f"{stamp_text(stamp_ns)},{text}\n")
        self._last_ns = self.counts.last_ns = stamp_ns
        if not self.counts.written:
            self.counts.first_ns = stamp_ns
        self.counts.written += 1


class FolderWriter:
    """A folder that has its name once all of it is there; until then it is in a hidden one beside.

    with FolderWriter(path) as folder:
        joints = folder.series("joints", ["joint1_position_rad"], clock="robot")
        joints.row(stamp_ns, [0.1])
        folder.finish({"task": "wave", "outcome": "success", "robot": {"name": "panda"}})
    """

    def __init__(self, path: Path, skip_bad: bool = False) -> None:
        self.path, self._skip_bad = path, skip_bad
        self._held = ExitStack()
        self.streams: list[Stream] = []
        self._unplaced: list[str] = []
        self._names = FileNames("recording.json", "labels.json", "cameras.json", "lenses.json", UNPLACED)
        self._finished = False

    def __enter__(self) -> FolderWriter:
        check_new(self.path)
        self._made = self._held.enter_context(made_beside(self.path))
        self._files = self._held.enter_context(ExitStack())
        self._made.mkdir()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with self._held:
            self._files.close()
            if kind is None and self._finished:
                give_name(self._made, self.path)

    def series(self, kind: str, columns: Sequence[str], clock: str, place: str = "", **fields: Any) -> Stream:
        """A stream of numbers, in a file of its name or kind."""
        name = str(fields.get("name", kind))
        own = self._names.take(name)
        file = self._open(f"{own}.csv", columns)
        return self._add(file, {"kind": kind, **fields, "file": f"{own}.csv", "clock": clock}, place or name)

    def pictures(self, kind: str, camera: str, clock: str, place: str = "", **fields: Any) -> tuple[Stream, Path]:
        """A stream of pictures, kind rgb or depth, and the folder for Stream.picture."""
        name = self._names.take(f"{camera}_{kind}")
        folder = self._made / name
        folder.mkdir()
        described = {"kind": kind, "camera": camera, "folder": name, "times": f"{name}.csv", "clock": clock, **fields}
        return self._add(self._open(f"{name}.csv", ["file"]), described, place or name), folder

    def write_json(self, name: str, document: Any) -> None:
        (self._made / name).write_text(json.dumps(document, indent=1) + "\n")

    def write_labels(self, document: Json, labels: Json) -> None:
        """Of the episode, named in its document; nothing where there are none."""
        if labels.get("segments") or labels.get("language"):
            self.write_json("labels.json", labels)
            document["labels"] = "labels.json"

    def copy(self, source: Path, name: str) -> None:
        shutil.copyfile(source, self._made / name)

    def leave_out(self, placed: Iterable[str]) -> list[str]:
        """Cameras with pictures that are none of these; their streams go to unplaced.json, until a calibration says
        where they are: beside a camera file that lacks them nothing could be imported."""
        there = {str(one.described["camera"]) for one in self.streams if "camera" in one.described}
        self._unplaced = sorted(there.difference(placed))
        return self._unplaced

    def finish(self, document: Json) -> None:
        """recording.json: this, and the streams that have readings."""
        every = [stream.described for stream in self.streams if stream.counts.written]
        written = [one for one in every if one.get("camera") not in self._unplaced]
        if len(written) < len(every):
            self.write_json(UNPLACED, {"streams": [one for one in every if one not in written]})
        clocks: Json = {str(one["clock"]): {} for one in written}
        self.write_json(
            "recording.json", {"stampede_recording": FORM, **document, "clocks": clocks, "streams": written}
        )
        self._finished = True

    def _open(self, name: str, columns: Sequence[str]) -> IO[str]:
        file = self._files.enter_context((self._made / name).open("w", buffering=1 << 20))
        file.write(",".join(["time_s", *columns]) + "\n")
        return file

    def _add(self, file: IO[str], described: Json, place: str) -> Stream:
        stream = Stream(file, described, place, self._skip_bad)
        self.streams.append(stream)
        return stream
