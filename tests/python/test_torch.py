"""PyTorch's DataLoader takes the package's datasets, whichever way its workers start."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import stampede

torch = pytest.importorskip("torch")

COLUMNS = ["joint_positions", "front_rgb", "action/joint_position", "facts"]


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("torch") / "demos.db"
    pictures = {"cameras": ["front"], "width": 32, "height": 24, "depth": False, "mask": False, "semantic_mask": False}
    tally = stampede.Session(catalogue=path).run_all(["reach_target"], episodes=2, seed=7, pictures=pictures)
    assert tally.succeeded == 2
    return path


@pytest.fixture
def data(made: Path) -> stampede.FrameDataset:
    return stampede.FrameDataset(str(made), COLUMNS, window=4)


@pytest.mark.parametrize("method", ["fork", "spawn", None])
def test_batches_are_the_windows(data: stampede.FrameDataset, method: str | None) -> None:
    assert data[3]["frame"] == 3  # the file is open here before workers start
    workers = {"num_workers": 2, "multiprocessing_context": method, "persistent_workers": True} if method else {}
    loader = torch.utils.data.DataLoader(data, batch_size=8, **workers)
    for _ in range(2):  # epochs
        seen = 0
        for batch in loader:
            for row in range(len(batch["frame"])):
                expected = data[seen + row]
                for name in (*COLUMNS, "skill", "segment", "padding"):
                    assert np.array_equal(batch[name][row].numpy(), expected[name], equal_nan=name.startswith("action"))
                assert batch["instruction"][row] == expected["instruction"] != ""
                assert [labels[row] for labels in batch["labels"]] == expected["labels"]
            seen += len(batch["frame"])
        assert seen == len(data)
    assert batch["front_rgb"].dtype == torch.uint8 and batch["joint_positions"].dtype == torch.float64


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_workers_share_the_windows_of_a_stream(data: stampede.FrameDataset, method: str) -> None:
    stream = stampede.WindowStream(data, seed=1, epochs=1)
    loader = torch.utils.data.DataLoader(stream, batch_size=8, num_workers=2, multiprocessing_context=method)
    seen = [
        (int(episode), int(frame))
        for batch in loader
        for episode, frame in zip(batch["episode"], batch["frame"], strict=True)
    ]
    assert len(seen) == len(set(seen)) == len(data) and seen != sorted(seen)


def test_random_order_and_windows_of_skills(made: Path) -> None:
    data = stampede.FrameDataset(str(made), ["joint_positions"], window=6, over="skill")
    loader = torch.utils.data.DataLoader(data, batch_size=16, shuffle=True, drop_last=True)
    batch = next(iter(loader))
    assert batch["joint_positions"].shape == (16, 6, 7)
    assert (batch["segment"] == batch["segment"][:, :1]).all() and (batch["segment"] >= 0).all()
