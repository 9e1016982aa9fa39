"""Torque noise: fitted to what is known, used by `stampede run`, and distributed alike."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import stampede
from stampede import torque_noise
from stampede.calibrate.recorded import Recording
from stampede.recordings.folder import FolderWriter
from stampede.robots import robot_of

PROGRAM = Path(stampede.__file__).parent / "engine" / "bin" / "stampede"
RATE, SECONDS = 100, 90
TRUE = torque_noise.TorqueNoise(
    [f"joint{k}" for k in range(1, 8)],
    coulomb=np.array([0.5, 0.7, 0.4, 0.6, 0.2, 0.15, 0.1]),
    viscous=np.array([0.3, 0.5, 0.2, 0.4, 0.1, 0.1, 0.05]),
    offset=np.array([0.4, -0.5, 0.2, 0.3, -0.1, 0.2, 0.05]),
    drift=np.array([0.5, 0.4, -0.3, 0.6, 0.2, -0.1, 0.1]),
    white=np.array([0.1, 0.12, 0.08, 0.1, 0.04, 0.05, 0.03]),
    smooth=0.02,
    drift_time_s=25.0,
    recorded_s=SECONDS,
)


def write_recording(folder: Path, efforts: bool = True, moves: float = 1.0, seconds: float = SECONDS) -> Path:
    """An arm that swings about, with a load of 0.4 kg in its hand and the torque sensors of TRUE."""
    rng = np.random.default_rng(7)
    robot = robot_of("panda")
    times = np.arange(0, seconds, 1 / RATE)
    waves, phases = rng.uniform(0.5, 1.4, (2, 7)), rng.uniform(0, 6, (2, 7))
    home = np.array([0, -0.6, 0, -2.2, 0, 1.6, 0.8])
    angle = times[:, None, None] * waves + phases
    q = home + moves * (0.35 * np.sin(angle)).sum(axis=1)
    v = moves * (0.35 * waves * np.cos(angle)).sum(axis=1)
    a = -moves * (0.35 * waves**2 * np.sin(angle)).sum(axis=1)
    torques = robot.torques(q, v, a) + robot.load_torques(q, v, a) @ [0.4, 0.4 * 0.01, 0, 0.4 * 0.1]
    torques += TRUE.expected(v, times) + TRUE.white * rng.normal(size=q.shape)
    with FolderWriter(folder) as out:
        parts = ["position_rad", "velocity_rad_s"] + (["effort_nm"] if efforts else [])
        stream = out.series("joints", [f"{joint}_{part}" for part in parts for joint in robot.arm], "robot")
        for k, time in enumerate(times):
            values = [q[k], v[k] + rng.normal(0, 1e-3, 7)] + ([torques[k]] if efforts else [])
            stream.row(round(time * 1e9), np.concatenate(values).tolist())
        out.finish({"task": "swing", "outcome": "success", "robot": {"name": "panda"}})
    return folder


@pytest.fixture(scope="module")
def fitted(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, torque_noise.Fit, dict[str, Any]]:
    folder = tmp_path_factory.mktemp("torque")
    recording = write_recording(folder / "recording")
    words, report = torque_noise.main([str(recording), "--out", str(folder / "noise.json")])
    assert "joint7" in words and "written to" in words
    return folder / "noise.json", torque_noise.fit(Recording(recording)), report


def test_what_was_put_in_comes_out(fitted: tuple[Path, torque_noise.Fit, dict[str, Any]]) -> None:
    _, fit, report = fitted
    noise = fit.noise
    assert noise.smooth == TRUE.smooth and 15 < noise.drift_time_s < 40
    assert np.allclose(noise.coulomb, TRUE.coulomb, atol=0.03) and np.allclose(noise.white, TRUE.white, rtol=0.15)
    assert np.allclose(noise.viscous, TRUE.viscous, atol=0.15) and np.allclose(noise.drift, TRUE.drift, atol=0.1)
    warm, true = (one.offset + one.drift for one in (noise, TRUE))
    assert np.allclose(warm, true, atol=0.25)
    assert 0.25 < fit.load_kg < 0.55 and all(0.9 < one < 1.1 for one in fit.masses.values())
    assert max(one["distance"] for one in report["compared"]) < 0.04


def test_runs_have_the_noise_of_the_recording(
    fitted: tuple[Path, torque_noise.Fit, dict[str, Any]], tmp_path: Path
) -> None:
    """What `run --noise` adds, in these runs' own motions, is distributed as the model says; and is the same again."""
    file, fit, _ = fitted
    read: dict[str, list[np.ndarray]] = {}
    velocities: list[np.ndarray] = []
    for name, options in (
        ("ideal", []),
        ("noisy", ["--noise", f"torque={file}"]),
        ("again", ["--noise", f"torque={file}"]),
    ):
        out = tmp_path / f"{name}.db"
        command = [
            str(PROGRAM),
            "run",
            "stack_blocks",
            "--episodes",
            "4",
            "--workers",
            "2",
            "--out",
            str(out),
            *options,
        ]
        subprocess.run(command, check=True, capture_output=True)
        for episode in stampede.Catalogue(out):
            arrays = episode.arrays("sensor", "joint_velocities")
            read.setdefault(name, []).append(arrays["sensor/joint_torque"])
            if name == "ideal":
                velocities.append(arrays["joint_velocities"][1:])  # the sensor has the frames' rate
    added = [noisy - ideal for noisy, ideal in zip(read["noisy"], read["ideal"], strict=True)]
    assert all((one == other).all() for one, other in zip(read["noisy"], read["again"], strict=True))
    steady = [one.mean(axis=0) for one in added]
    assert np.ptp(steady, axis=0).max() > 0.02  # episodes begin at other moments of the recording
    rng = np.random.default_rng(1)
    expected = []
    for v, one in zip(velocities, added, strict=True):
        # When each began is its own: the start that fits its readings best.
        times = np.arange(1, len(v) + 1) / 20
        begins = np.linspace(0, SECONDS, 300)
        best = min(begins, key=lambda begin: ((fit.noise.expected(v, begin + times) - one) ** 2).sum())
        expected.append(fit.noise.expected(v, best + times) + fit.noise.white * rng.normal(size=v.shape))
    alike = torque_noise.comparison(np.concatenate(added), np.concatenate(expected), fit.noise.joints)
    assert max(one["distance"] for one in alike) < 0.08
    white = torque_noise.comparison(
        np.concatenate(added), 0.1 * rng.normal(size=np.concatenate(added).shape), fit.noise.joints
    )
    assert min(one["distance"] for one in white) > 0.15  # white noise alone is told from it


def test_recordings_that_cannot_serve(tmp_path: Path) -> None:
    for name, options, words in (
        ("no_torques", {"efforts": False}, "no torques were recorded"),
        ("still", {"moves": 0.0}, "the arm stood still"),
        ("short", {"seconds": 2}, "torques were recorded for 2.0 s"),
    ):
        recording = write_recording(tmp_path / name, **options)  # type: ignore[arg-type]
        with pytest.raises(stampede.Error, match=words) as caught:
            torque_noise.main([str(recording), "--out", str(tmp_path / "noise.json")])
        assert caught.value.hint and not (tmp_path / "noise.json").exists()
    with pytest.raises(stampede.Error, match="no recording"):
        torque_noise.main([str(tmp_path), "--out", str(tmp_path / "noise.json")])


def test_a_recording_reads_nothing_from_outside_of_its_folder(tmp_path: Path) -> None:
    whole = write_recording(tmp_path / "whole", seconds=2)

    def refused(words: str) -> None:
        with pytest.raises(stampede.Error, match=words) as caught:
            Recording(given)
        assert str(given) in caught.value.where and caught.value.hint

    given = tmp_path / "given"
    given.mkdir()
    (given / "recording.json").symlink_to(whole / "recording.json")
    refused("recording.json: it leads out of")
    (given / "recording.json").unlink()
    os.mkfifo(given / "recording.json")
    refused("it is no file")
    (given / "recording.json").unlink()
    document = json.loads((whole / "recording.json").read_text())
    document["streams"][0]["file"] = "../whole/joints.csv"
    (given / "recording.json").write_text(json.dumps(document))
    refused("joints.csv: it leads out of")
    document["streams"][0]["file"] = "joints.csv"
    (given / "recording.json").write_text(json.dumps(document))
    os.mkfifo(given / "joints.csv")
    refused("joints.csv: it is no file")
    document["robot"] = {"urdf": "../robot.urdf"}
    (given / "recording.json").write_text(json.dumps(document))
    refused("robot.urdf: it leads out of")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda d: d.update(stampede_torque_noise=2), "it is no torque noise"),
        (lambda d: d["joints"].pop(), "it says nothing of joint7"),
        (lambda d: d["joints"][2].update(white_nm=-1), "'white_nm' must not be negative"),
        (lambda d: d["joints"][2].update(smooth_rad_s=0), "'smooth_rad_s' must be above 0"),
        (lambda d: d["joints"][2].pop("drift_nm"), "'drift_nm' is no number"),
        (lambda d: d["joints"].append(d["joints"][0]), "is there twice"),
        (lambda d: d["joints"].append({**d["joints"][0], "joint": "joint9"}), "has no joint 'joint9'"),
    ],
)
def test_files_that_the_engine_does_not_take(
    fitted: tuple[Path, torque_noise.Fit, dict[str, Any]], tmp_path: Path, change: Any, words: str
) -> None:
    document = json.loads(fitted[0].read_text())
    change(document)
    bad = tmp_path / "bad.json"
    bad.write_text(json.dumps(document))
    out = tmp_path / "out.db"
    command = [str(PROGRAM), "run", "reach_target", "--noise", f"torque={bad}", "--out", str(out)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 3 and words in done.stderr and not out.exists()


def test_distances_of_samples() -> None:
    rng = np.random.default_rng(3)
    one = rng.normal(size=5000)
    assert torque_noise.distance(one, rng.normal(size=5000)) < 0.04
    assert torque_noise.distance(one, one + 1) == pytest.approx(0.383, abs=0.03)
    assert torque_noise.distance(one, one + 100) == 1 and torque_noise.distance(one, one) == 0
