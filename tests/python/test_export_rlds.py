"""RLDS, read back by a few lines that know the file format and no more; exports that are cut off."""

from __future__ import annotations

import json
import re
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import stampede
from stampede.export import export, rlds
from stampede.export.pictures import size_of
from stampede.export.steps import Steps
from stampede.export.tfrecord import crc32c
from stampede.png import png_of

Example = dict[str, Any]


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two episodes that lift and one of the test split, all with small pictures."""
    path = tmp_path_factory.mktemp("rlds") / "demos.db"
    session = stampede.Session(catalogue=path)
    pictures = {"cameras": ["front", "wrist"], "width": 32, "height": 24, "depth": False, "mask": False}
    pictures["semantic_mask"] = False
    session.run_all(["pick_and_lift"], episodes=2, seed=7, pictures=pictures)
    session.run_all(["reach_target"], episodes=1, seed=1_000_000, pictures=pictures)
    assert len(stampede.Catalogue(path).demos()) == 3
    return path


def run(made: Path, folder: Path, *options: str) -> Path:
    export(["rlds", str(made), "--out", str(folder), *options], tell=lambda line: None)
    assert [path.name for path in folder.iterdir()] == ["stampede"]
    return folder / "stampede/1.0.0"


def slow_crc32c(data: bytes) -> int:
    """Bit by bit, as it is defined."""
    register = 0xFFFFFFFF
    for byte in data:
        register ^= byte
        for _ in range(8):
            register = register >> 1 ^ (0x82F63B78 if register & 1 else 0)
    return register ^ 0xFFFFFFFF


def number(data: bytes, place: int) -> tuple[int, int]:
    """A number of seven bits a byte, and the place after it."""
    value, shift = 0, 0
    while True:
        byte = data[place]
        value |= (byte & 0x7F) << shift
        place, shift = place + 1, shift + 7
        if byte < 0x80:
            return value, place


def fields(data: bytes) -> Iterator[tuple[int, bytes]]:
    place = 0
    while place < len(data):
        key, place = number(data, place)
        assert key & 7 == 2
        length, place = number(data, place)
        yield key >> 3, data[place : place + length]
        place += length
    assert place == len(data)


def values(feature: bytes) -> Any:
    ((kind, content),) = fields(feature)
    if kind == 1:
        return [one for _, one in fields(content)]
    ((_, numbers),) = fields(content)
    if kind == 2:
        return np.frombuffer(numbers, dtype="<f4")
    found, place = [], 0
    while place < len(numbers):
        value, place = number(numbers, place)
        found.append(value - 2**64 if value >= 2**63 else value)
    return found


def examples(path: Path) -> Iterator[Example]:
    data, place = path.read_bytes(), 0
    while place < len(data):
        (length,) = struct.unpack_from("<Q", data, place)
        message = data[place + 12 : place + 12 + length]
        for start, size in ((place, 8), (place + 12, length)):
            crc = crc32c(data[start : start + size])
            masked = ((crc >> 15) + (crc << 17) + 0xA282EAD8) % 2**32
            assert struct.unpack_from("<I", data, start + size) == (masked,)
        ((_, features),) = fields(message)
        entries = [dict(fields(entry)) for _, entry in fields(features)]
        yield {entry[1].decode(): values(entry[2]) for entry in entries}
        place += 16 + length


def read(folder: Path) -> dict[int, Example]:
    """Episodes by number. Shards are those that dataset_info.json counts."""
    info = json.loads((folder / "dataset_info.json").read_text())
    names = {"features.json", "dataset_info.json"}
    found: dict[int, Example] = {}
    for split in info["splits"]:
        lengths = [int(length) for length in split["shardLengths"]]
        for shard, length in enumerate(lengths):
            name = f"stampede-{split['name']}.tfrecord-{shard:05d}-of-{len(lengths):05d}"
            names.add(name)
            read = list(examples(folder / name))
            assert len(read) == length
            for one in read:
                found[one["episode_metadata/episode"][0]] = one | {"split": split["name"]}
    assert {path.name for path in folder.iterdir()} == names
    return found


def flat(layout: Any, name: str = "") -> dict[str, Any]:
    """Leaves of features.json by their names in a record."""
    if "featuresDict" in layout:
        parts = layout["featuresDict"]["features"]
        return {key: leaf for part in parts for key, leaf in flat(parts[part], f"{name}/{part}").items()}
    if "sequence" in layout:
        return flat(layout["sequence"]["feature"], name)
    return {name.removeprefix("/"): layout}


def test_checksums() -> None:
    # From RFC 3720, B.4.
    assert crc32c(bytes(32)) == 0x8A9136AA and crc32c(b"\xff" * 32) == 0x62A8AB43
    assert crc32c(bytes(range(32))) == 0x46DD794E
    data = np.random.default_rng(1).bytes(5000)
    for size in (0, 1, 2, 3, 4, 7, 64, 1000, 5000):
        assert crc32c(data[:size]) == slow_crc32c(data[:size])


def test_records_are_the_episodes(made: Path, tmp_path: Path) -> None:
    folder = run(made, tmp_path / "out", "--valid", "0")
    found = read(folder)
    assert {number: one["split"] for number, one in found.items()} == {1: "train", 2: "train", 3: "test"}
    one, steps = found[1], Steps(stampede.Catalogue(made)[1], ["facts"])
    frames, arrays = steps.episode.frames, steps.arrays
    state = one["steps/observation/state"].reshape(frames, 8)
    assert np.allclose(state[:, :7], arrays["joint_positions"]) and np.allclose(state[:, 7], arrays["gripper_opening"])
    actions = one["steps/action"].reshape(frames, 8)
    assert np.allclose(actions[:-1], steps.natural_actions("joint_position"))
    assert one["steps/is_first"] == [1] + [0] * (frames - 1)
    assert one["steps/is_last"] == one["steps/is_terminal"] == [0] * (frames - 1) + [1]
    # The last step has no action: it is to stay, and what led to success is the one before.
    assert np.array_equal(actions[-1], actions[-2])
    assert one["steps/reward"].tolist() == [0] * (frames - 2) + [1, 0]
    assert one["steps/discount"].tolist() == [1] * (frames - 2) + [0, 0]
    assert set(one["steps/language_instruction"]) == {steps.instruction.encode()}
    first = steps.skills[0]
    assert one["steps/skill"][0].decode() == first.name and one["steps/skill_label"][0].decode() == first.label
    assert one["steps/skill_arguments"][0].decode().split() == list(first.arguments)
    assert one["steps/segment"][: first.end_frame] == [0] * first.end_frame
    assert -1 in one["steps/segment"]  # the arm stands still in the end
    holding = {str(arrays.atoms[k]) for k in np.flatnonzero(arrays["facts"][20])}
    assert set(re.findall(r"\(.*?\)", one["steps/facts"][20].decode())) == holding
    assert one["episode_metadata/seed"] == [steps.episode.seed] and one["episode_metadata/source"] == [b"sim"]
    assert one["episode_metadata/file_path"] == [b"demos.db"] and one["episode_metadata/success"] == [1]
    assert json.loads(one["episode_metadata/instructions"][0]) == steps.episode.instructions()
    stored = steps.episode.catalogue.query(
        "SELECT data FROM images WHERE episode = 1 AND camera = 'wrist' AND kind = 'rgb' ORDER BY frame"
    )
    assert one["steps/observation/wrist_image"] == stored.values("data")
    assert "steps/observation/environment_state" not in one  # two tasks have other things


def test_features_are_what_is_in_the_records(made: Path, tmp_path: Path) -> None:
    folder = run(made, tmp_path / "out", "--where", "task = 'pick_and_lift'", "--action", "tool_delta")
    found = read(folder)
    leaves = flat(json.loads((folder / "features.json").read_text()))
    assert set(leaves) | {"split"} == set(found[1])
    for name, leaf in leaves.items():
        rows = stampede.Catalogue(made)[1].frames if name.startswith("steps/") else 1
        if "tensor" in leaf:
            sizes = [int(size) for size in leaf["tensor"]["shape"].get("dimensions", [])]
            assert len(found[1][name]) == rows * np.prod(sizes, dtype=int), name
            assert isinstance(found[1][name], np.ndarray) == (leaf["tensor"]["dtype"] == "float32")
        else:
            assert len(found[1][name]) == rows and isinstance(found[1][name][0], bytes)
    image = leaves["steps/observation/image"]["image"]
    assert image["shape"]["dimensions"] == ["24", "32", "3"] and image["encodingFormat"] == "png"
    assert len(leaves["steps/observation/environment_state"]["description"].split(",")) > 7
    last = found[1]["steps/action"].reshape(-1, 7)[-1]
    assert (last[:6] == 0).all() and last[6] < 0.08  # to stay, and to hold


def test_further_channels(made: Path, tmp_path: Path) -> None:
    folder = run(made, tmp_path / "out", "--channels", "joint_forces", "--cameras", "")
    leaf = flat(json.loads((folder / "features.json").read_text()))["steps/observation/joint_forces"]
    assert leaf["tensor"]["shape"] == {"dimensions": ["7"]}
    forces = stampede.Catalogue(made)[1].arrays("joint_forces")["joint_forces"].astype(np.float32)
    assert np.array_equal(np.reshape(read(folder)[1]["steps/observation/joint_forces"], (-1, 7)), forces)


def test_shards_and_another_name(made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rlds, "_SHARD_BYTES", 1)
    folder = run(made, tmp_path / "out", "--valid", "0", "--cameras", "")
    assert len(list(folder.glob("stampede-train.tfrecord-*-of-00002"))) == 2 and len(read(folder)) == 3
    export(["rlds", str(made), "--out", str(tmp_path / "named"), "--name", "lifts"], tell=lambda line: None)
    assert (tmp_path / "named/lifts/1.0.0/lifts-test.tfrecord-00000-of-00001").exists()
    with pytest.raises(stampede.Error, match="no name of a dataset"):
        run(made, tmp_path / "bad", "--name", "My data")


def test_pictures_that_are_not_stored_are_drawn(made: Path, tmp_path: Path) -> None:
    folder = run(made, tmp_path / "out", "--where", "episode = 3", "--cameras", "overhead", "--draw")
    (file, *_) = read(folder)[3]["steps/observation/overhead_image"]
    drawn = stampede.Catalogue(made)[3].pictures("overhead_rgb", [0], draw=True)[0]
    assert file == png_of(drawn, "rlds") and size_of(file) == drawn.shape[:2]


def test_what_is_cut_off_at_the_very_end_is_done_again(
    made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    put_split = rlds.Writer._put_split

    def cut_off(self: Any, folder: Path, split: str, *rest: Any) -> Any:
        if split == "test":
            raise KeyboardInterrupt
        return put_split(self, folder, split, *rest)

    monkeypatch.setattr(rlds.Writer, "_put_split", cut_off)
    with pytest.raises(KeyboardInterrupt):
        run(made, tmp_path / "out")
    assert not (tmp_path / "out/stampede/1.0.0").exists()
    monkeypatch.setattr(rlds.Writer, "_put_split", put_split)
    folder, whole = run(made, tmp_path / "out"), run(made, tmp_path / "whole")
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == {
        path.name: path.read_bytes() for path in whole.iterdir()
    }
