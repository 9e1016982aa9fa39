"""Exported datasets, read back by the libraries that their readers use; exports that are cut off, and bad input."""

from __future__ import annotations

import json
import os
import shutil
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import stampede
from stampede.export import export, rlds
from stampede.export.steps import TOOL_SPEED, Steps, matrices, rotation_vectors

FORMATS = ["robomimic", "libero", "mimicgen", "maniskill", "lerobot", "rlds", "mcap", "rlbench"]

PICTURES = {"cameras": ["front", "wrist"], "width": 32, "height": 24, "depth": False, "mask": False}
PICTURES["semantic_mask"] = False


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("export") / "demos.db"
    session = stampede.Session(catalogue=path)
    tally = session.run_all(["pick_and_lift"], episodes=3, seed=7, pictures=PICTURES)
    tally = session.run_all(["reach_target"], episodes=1, seed=1_000_000, pictures=PICTURES)
    assert tally.succeeded == 1 and len(stampede.Catalogue(path)) == 4
    return path


def run(made: Path, folder: Path, name: str, *options: str) -> Path:
    export([name, str(made), "--out", str(folder), *options], tell=lambda line: None)
    assert not list(folder.rglob("*.part")) and not list(folder.rglob(".pieces"))
    return folder


def test_turns_and_matrices() -> None:
    half = np.sqrt(0.5)
    start, end = np.array([[0, 0, 0, 1.0]]), np.array([[0, 0, half, half]])
    assert np.allclose(rotation_vectors(start, end), [[0, 0, np.pi / 2]])
    assert np.allclose(rotation_vectors(end, start), [[0, 0, -np.pi / 2]])
    assert np.allclose(rotation_vectors(start, -end), [[0, 0, np.pi / 2]])  # the same turn
    assert np.allclose(rotation_vectors(end, end), 0)
    matrix = matrices(np.array([[1.0, 2, 3, 0, 0, half, half]]))[0]
    assert np.allclose(matrix @ [1, 0, 0, 1], [1, 3, 3, 1])


def test_exported_joint_positions_do_the_task_in_the_environment(made: Path) -> None:
    """They are what Env takes, so the task succeeds when they are played back."""
    episode = stampede.Catalogue(made)[1]
    actions = Steps(episode).actions("joint_position")
    assert actions.dtype == np.float32 and np.abs(actions).max() <= 1 and len(actions) == episode.frames - 1
    env = stampede.Env("pick_and_lift", action="joint_position", normalise_actions=True)
    env.reset(options={"variation": episode.variation, "seed": episode.seed})
    for action in [*actions, *[actions[-1]] * 20]:
        *_, terminated, truncated, info = env.step(action)
        if terminated or truncated:
            break
    assert info["success"]


@pytest.mark.parametrize("kind", ["joint_delta", "tool_delta"])
def test_deltas_add_up_to_the_path_of_the_reference(made: Path, kind: str) -> None:
    steps = Steps(stampede.Catalogue(made)[1])
    path = steps.commanded_joints if kind == "joint_delta" else steps.commanded_tool[:, :3]
    width = path.shape[1]
    natural = steps.natural_actions(kind)
    assert np.allclose(path[0] + natural[:, :width].cumsum(axis=0), path[1:])
    actions = steps.actions(kind)
    assert np.abs(actions).max() <= 1 and actions.shape == natural.shape
    assert np.allclose(actions[:, :width] * steps.bounds(kind)[1][:width], natural[:, :width], atol=1e-6)


def _waved(catalogue: Path, task: str, *paths: Path) -> tuple[stampede.StoredEpisode, dict[str, Any]]:
    """An episode in which all joints are told to turn a little in each frame, and the upper bounds of its spaces."""
    session = stampede.Session(paths=list(paths), catalogue=catalogue)
    world = session.environment(task, channels=["joint_positions"], record=True)
    goal = world.reset(stampede.Reset(seed=1))["joint_positions"]
    upper = {space.name: [one.upper for one in space.components] for space in world.spaces()}
    for _ in range(10):
        goal = goal + 0.01
        assert not world.step(stampede.Action("joint_position", goal.tolist())).refusal
    world.episode()
    return list(stampede.Catalogue(catalogue))[-1], upper


def _four_joints(folder: Path) -> Path:
    """Scripts with a crane of four joints and a hand, and a task `wave`."""
    mass = "<inertial><mass value='1'/><inertia ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial>"
    urdf = "".join(f"<link name='{name}'>{mass}</link>" for name in ["foot", "a", "b", "c", "palm", "left", "right"])
    axes = [("foot", "a", "0 0 1"), ("a", "b", "0 1 0"), ("b", "c", "0 1 0"), ("c", "palm", "0 1 0")]
    for k, (parent, child, axis) in enumerate(axes, 1):
        urdf += f"<joint name='turn{k}' type='revolute'><parent link='{parent}'/><child link='{child}'/>"
        urdf += f"<origin xyz='{0.2 * (k > 2)} 0 {0.4 * (k < 2)}'/><axis xyz='{axis}'/>"
        urdf += f"<limit lower='-2' upper='2' velocity='{1 + k / 10}' effort='50'/></joint>"
    for side, sign in (("left", 1), ("right", -1)):
        urdf += f"<joint name='{side}_slide' type='prismatic'><parent link='palm'/><child link='{side}'/>"
        urdf += f"<axis xyz='0 {sign} 0'/><limit lower='0' upper='0.03' velocity='0.2' effort='20'/></joint>"
    robot = (
        'urdf = "crane.urdf", arm = { "turn1", "turn2", "turn3", "turn4" }, fingers = { "left_slide", "right_slide" },'
        ' pads = { "left", "right" }, tip = { link = "palm", at = { 0.08, 0, 0 } }, home = { 0, -0.6, 0.9, 0 },'
        " limits = { acceleration = 10, jerk = 5000 }, opening = 0.06, grip_force = 20"
    )
    table = 'fixtures = { table = { "work_table", at = { 0.19, 0, 0.75 } } }'
    files = {
        "worlds/robots/crane.urdf": f"<robot name='crane'>{urdf}</robot>",
        "worlds/robots/crane.lua": f"-- A crane.\nreturn robot {{ {robot} }}\n",
        "worlds/yard.lua": f'-- It.\nreturn world {{ robot = {{ "crane", at = {{ -0.3, 0, 0.75 }} }}, {table} }}\n',
        "tasks/wave.lua": '-- Go to the mark.\nreturn task { world = "yard", instructions = { "go to the mark" },\n'
        '  objects = { mark = { "floating_target", at = { 0.2, 0.3, 1.2 } } },\n'
        '  init = { is.hand_empty() }, goal = is.at("mark") }\n',
    }
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return folder


def test_scales_are_those_of_the_action_spaces_of_any_arm(tmp_path: Path) -> None:
    own = _four_joints(tmp_path / "own")
    for task, joints, paths in (("reach_target", 7, []), ("wave", 4, [own])):
        episode, upper = _waved(tmp_path / "waved.db", task, *paths)
        steps = Steps(episode)
        assert np.allclose(upper["joint_delta"], steps.bounds("joint_delta")[1])
        assert np.allclose(upper["tool_delta"], TOOL_SPEED / episode.frame_hz)
        assert np.allclose(upper["joint_position"], steps.bounds("joint_position")[1])
        assert np.allclose(upper["gripper"], steps.opening)
        assert steps.actions("joint_position").shape == (10, joints + 1)
        assert np.allclose(steps.gripper, 1)  # it was open all the time


def test_arms_of_other_sizes_are_exported_apart(tmp_path: Path) -> None:
    both, own = tmp_path / "both.db", _four_joints(tmp_path / "own")
    _waved(both, "reach_target")
    _waved(both, "wave", own)
    with pytest.raises(stampede.Error, match="RLBench's demos are a Panda's"):
        run(both, tmp_path / "rlbench", "rlbench", "--where", "task = 'wave'")
    for name in FORMATS[:6]:
        run(both, tmp_path / name, name, "--where", "task = 'wave'")
        if name in ("lerobot", "rlds"):  # others have a file a task
            with pytest.raises(stampede.Error, match="not those of the first episode"):
                run(both, tmp_path / f"{name}_both", name, "--where", "frames > 1")


def _film(path: Path) -> tuple[list[float], np.ndarray]:
    av = pytest.importorskip("av")
    with av.open(str(path)) as film:
        frames = [(float(frame.time), frame.to_ndarray(format="rgb24")) for frame in film.decode(video=0)]
    return [time for time, _ in frames], np.stack([picture for _, picture in frames])


def test_lerobot_3(made: Path, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("av")
    folder = run(made, tmp_path / "out", "lerobot", "--where", "task = 'pick_and_lift'", "--valid", "0")
    info = json.loads((folder / "meta/info.json").read_text())
    demos = stampede.Catalogue(made).demos("task = 'pick_and_lift'")
    lengths = [episode.frames - 1 for episode in demos]
    assert info["codebase_version"] == "v3.0" and info["total_frames"] == sum(lengths) and info["fps"] == 20
    assert info["splits"] == {"train": "0:3"}
    data = parquet.ParquetFile(folder / "data/chunk-000/file-000.parquet")
    assert data.num_row_groups == 3  # one an episode
    table = data.read().to_pydict()
    videos = {name for name, feature in info["features"].items() if feature["dtype"] == "video"}
    assert set(table) == set(info["features"]) - videos and len(videos) == 2
    assert table["index"] == list(range(sum(lengths))) and table["frame_index"][: lengths[0]] == list(range(lengths[0]))
    assert np.allclose(np.array(table["timestamp"]) * 20, table["frame_index"])
    assert len(table["observation.state"][0]) == len(info["features"]["observation.state"]["names"]) == 8
    tasks = pandas.read_parquet(folder / "meta/tasks.parquet")
    assert tasks.index[table["task_index"][0]] == demos[0].instructions()[0]
    subtasks = pandas.read_parquet(folder / "meta/subtasks.parquet")
    label = subtasks.index[table["subtask_index"][0]]
    assert label.startswith("pick up") and label == Steps(demos[0]).skills[0].label
    episodes = pandas.read_parquet(folder / "meta/episodes/chunk-000/file-000.parquet")
    assert episodes["length"].tolist() == lengths and episodes["stampede/seed"].tolist() == [e.seed for e in demos]
    stats = json.loads((folder / "meta/stats.json").read_text())
    assert np.allclose(stats["action"]["mean"], np.mean(table["action"], axis=0), atol=1e-5)
    assert np.shape(stats["observation.images.front"]["mean"]) == (3, 1, 1)

    times, pictures = _film(folder / "videos/observation.images.front/chunk-000/file-001.mp4")
    assert np.abs(np.array(times) * 20 - np.arange(lengths[1])).max() < 1e-3
    original = demos[1].pictures("front_rgb", range(lengths[1])).astype(float)
    assert np.abs(pictures - original).mean() < 6
    mean = original.reshape(-1, 3).mean(axis=0) / 255
    assert np.allclose(np.ravel(episodes["stats/observation.images.front/mean"][1].tolist()), mean, atol=1e-6)


def test_lerobot_21(made: Path, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    pytest.importorskip("av")
    folder = run(made, tmp_path / "out", "lerobot", "--version", "2.1", "--valid", "0")
    info = json.loads((folder / "meta/info.json").read_text())
    assert info["codebase_version"] == "v2.1" and info["total_videos"] == 8
    assert info["splits"] == {"train": "0:3", "test": "3:4"}
    assert "observation.environment_state" not in info["features"]  # two tasks have other things
    lines = [json.loads(line) for line in (folder / "meta/episodes.jsonl").read_text().splitlines()]
    for number, line in enumerate(lines):
        table = parquet.read_table(folder / f"data/chunk-000/episode_{number:06d}.parquet")
        assert table.num_rows == line["length"] and set(table["episode_index"].to_pylist()) == {number}
        times, _ = _film(folder / f"videos/chunk-000/observation.images.wrist/episode_{number:06d}.mp4")
        assert len(times) == line["length"]
    stats = [json.loads(line) for line in (folder / "meta/episodes_stats.jsonl").read_text().splitlines()]
    assert set(stats[0]["stats"]["action"]) == {"min", "max", "mean", "std", "count"}


def test_mcap(made: Path, tmp_path: Path) -> None:
    reader = pytest.importorskip("mcap.reader")
    folder = run(made, tmp_path / "out", "mcap", "--where", "task = 'pick_and_lift'", "--limit", "1")
    episode = stampede.Catalogue(made)[1]
    messages: dict[str, list[tuple[float, Any]]] = {}
    with next(folder.iterdir()).open("rb") as stream:
        file = reader.make_reader(stream)
        for schema, channel, message in file.iter_messages():
            assert json.loads(schema.data)["type"] == "object"
            messages.setdefault(channel.topic, []).append((message.log_time / 1e9, json.loads(message.data)))
        about = next(iter(file.iter_metadata())).metadata
    assert about["task"] == "pick_and_lift" and about["seed"] == str(episode.seed)
    assert len(messages["/tf"]) == len(messages["/camera/front/image"]) == episode.frames
    assert messages["/tf"][20][0] == pytest.approx(1.0)
    tool = messages["/tf"][20][1]["transforms"][0]
    place = episode.arrays("gripper_pose")["gripper_pose"][20]
    assert [tool["translation"][axis] for axis in "xyz"] == pytest.approx(place[:3].tolist())
    skills = Steps(episode).skills
    assert [text["message"] for _, text in messages["/skills"]][0] == skills[0].label
    assert {cube["id"] for cube in messages["/scene"][0][1]["entities"]} >= {skills[0].arguments[0]}


CHANNELS = ("--channels", "joint_forces,object_pose/table,progress", "--cameras", "")
CHANNELS += ("--where", "task = 'pick_and_lift'")


@pytest.mark.parametrize(
    ("name", "place", "rows"),
    [
        ("robomimic", "data/demo_0/obs", -1),
        ("mimicgen", "data/demo_0/obs", -1),
        ("libero", "data/demo_0/obs", -1),
        ("maniskill", "traj_0/obs/extra", None),
    ],
)
def test_further_channels_in_hdf5(made: Path, tmp_path: Path, name: str, place: str, rows: int | None) -> None:
    h5py = pytest.importorskip("h5py")
    folder = run(made, tmp_path / "out", name, *CHANNELS)
    arrays = stampede.Catalogue(made)[1].arrays("joint_forces", "object_pose/table")
    file = min(path for path in folder.rglob("*") if path.suffix in (".h5", ".hdf5"))
    with h5py.File(file) as data:
        assert np.array_equal(data[place]["joint_forces"], arrays["joint_forces"][:rows])
        assert np.array_equal(data[place]["object_pose.table"], arrays["object_pose/table"][:rows])
        names = data["data"].attrs["channel_names"] if "data" in data else None
    names = names or json.loads(file.with_suffix(".json").read_text())["env_info"]["channel_names"]
    assert json.loads(names)["joint_forces"] == list(arrays.column("joint_forces").labels)


def test_further_channels_in_lerobot_and_mcap(made: Path, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    reader = pytest.importorskip("mcap.reader")
    forces = stampede.Catalogue(made)[1].arrays("joint_forces")["joint_forces"]
    folder = run(made, tmp_path / "lerobot", "lerobot", *CHANNELS, "--limit", "1", "--valid", "0")
    feature = json.loads((folder / "meta/info.json").read_text())["features"]["observation.joint_forces"]
    assert feature["shape"] == [7] and len(feature["names"]) == 7
    table = parquet.read_table(next(folder.rglob("data/**/*.parquet")))
    rows = np.array(table["observation.joint_forces"].to_pylist(), np.float32)
    assert np.array_equal(rows, forces[:-1].astype(np.float32))
    assert str(table["observation.progress"].type) == "float"  # a single number is no vector to LeRobot
    folder = run(made, tmp_path / "mcap", "mcap", *CHANNELS, "--limit", "1")
    with next(folder.iterdir()).open("rb") as stream:
        found = [json.loads(m.data) for *_, m in reader.make_reader(stream).iter_messages(["/channels/joint_forces"])]
    assert np.array_equal([one["values"] for one in found], forces)


@pytest.mark.parametrize("name", FORMATS)
def test_an_export_that_was_cut_off_goes_on(
    made: Path, tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With the episodes that it began with, though the catalogue has more of them by then."""
    pytest.importorskip({"lerobot": "av", "rlds": "numpy", "mcap": "mcap", "rlbench": "PIL"}.get(name, "h5py"))
    module = __import__(f"stampede.export.{name}", fromlist=["Writer"])
    written: list[int] = []
    write = module.Writer.write

    def cut_off(self: Any, episode: stampede.StoredEpisode) -> None:
        if len(written) == 1:
            raise KeyboardInterrupt
        written.append(episode.id)
        write(self, episode)

    catalogue = shutil.copy(made, tmp_path / "demos.db")
    folder = tmp_path / "out"
    cameras = "" if name == "rlbench" else "front"  # it would want depths and masks too
    arguments = [name, str(catalogue), "--out", str(folder), "--where", "outcome = 'success'", "--cameras", cameras]
    monkeypatch.setattr(module.Writer, "write", cut_off)
    with pytest.raises(KeyboardInterrupt):
        export(arguments, tell=lambda line: None)
    finals = [p for p in folder.rglob("*") if p.is_file() and p.suffix != ".json" and ".pieces" not in p.parts]
    assert bool(finals) == (name in ("mcap", "rlbench"))  # an episode is whole by itself

    stampede.Session(catalogue=catalogue).run_all(["reach_target"], episodes=1, seed=1, pictures=PICTURES)

    def counted(self: Any, episode: stampede.StoredEpisode) -> None:
        written.append(episode.id)
        write(self, episode)

    monkeypatch.setattr(module.Writer, "write", counted)
    with pytest.raises(stampede.Error, match="another export was cut off here"):
        export([*arguments, "--limit", "2"], tell=lambda line: None)
    told: list[str] = []
    assert export(arguments, tell=told.append) == 4 and "; 1 that came later are not" in told[-1]
    assert sorted(written) == [1, 2, 3, 4]  # the first was not written twice
    whole = run(made, tmp_path / "whole", *arguments[:1], *arguments[4:])
    assert {p.relative_to(folder) for p in folder.rglob("*")} == {p.relative_to(whole) for p in whole.rglob("*")}


def test_an_export_does_not_go_on_with_another_catalogue(
    made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    catalogue = Path(shutil.copy(made, tmp_path / "demos.db"))
    arguments = ["rlds", str(catalogue), "--out", str(tmp_path / "out"), "--where", "episode = 1"]

    def cut_off(self: Any, episode: stampede.StoredEpisode) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(rlds.Writer, "write", cut_off)
    with pytest.raises(KeyboardInterrupt):
        export(arguments, tell=lambda line: None)
    catalogue.unlink()
    stampede.Session(catalogue=catalogue).run_all(["reach_target"], episodes=1, seed=3, pictures=PICTURES)
    with pytest.raises(stampede.Error, match="is not the file that it began with"):
        export(arguments, tell=lambda line: None)


@pytest.mark.parametrize("text", ["{", "[]", "{}", '"x"', "null", '{"options": {}, "episodes": [1]}', "[" * 99999])
def test_a_damaged_manifest_is_told(made: Path, tmp_path: Path, text: str) -> None:
    manifest = tmp_path / "stampede-export.json"
    manifest.write_text(text)
    with pytest.raises(stampede.Error, match="it is damaged, or not of an export") as caught:
        export(["mcap", str(made), "--out", str(tmp_path)])
    assert caught.value.where == str(manifest) and caught.value.hint and manifest.read_text() == text


def test_bad_input(made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture) -> None:
    def of(*options: str) -> list[str]:
        return [*options, "--out", str(tmp_path / "out")]

    with pytest.raises(stampede.Error, match="no episode fulfils"):
        export(of("robomimic", str(made), "--where", "split = 'test' AND task = 'pick_and_lift'"))
    with pytest.raises(stampede.Error, match="no such column"):
        export(of("robomimic", str(made), "--where", "colour = 'red'"))
    with pytest.raises(stampede.CatalogueError, match="none.db"):
        export(of("robomimic", str(tmp_path / "none.db")))
    with pytest.raises(stampede.Error, match="no share"):
        export(of("robomimic", str(made), "--valid", "1.5"))
    with pytest.raises(stampede.Error, match="did you mean 'front'"):
        export(of("robomimic", str(made), "--cameras", "fornt"))
    with pytest.raises(stampede.Error, match="--draw"):
        export(of("robomimic", str(made), "--cameras", "overhead"))
    with pytest.raises(stampede.Error, match="no column of that name"):
        export(of("robomimic", str(made), "--channels", "joint_force"))
    with pytest.raises(stampede.Error, match="'front_rgb' has no row of numbers"):
        export(of("robomimic", str(made), "--channels", "joint_forces,front_rgb"))
    with pytest.raises(SystemExit):
        export(of("rlbench", str(made), "--channels", "facts"))
    with pytest.raises(SystemExit):
        export(of("robomimick", str(made)))
    assert "robomimick" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()  # the right command may follow
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "thesis.txt").write_text("mine")
    with pytest.raises(stampede.Error, match="not empty"):
        export(["robomimic", str(made), "--out", str(tmp_path / "full")])
    (tmp_path / "link").symlink_to(tmp_path / "full" / "thesis.txt")
    (tmp_path / "nowhere").symlink_to(tmp_path / "none")
    os.mkfifo(tmp_path / "pipe")
    for form in stampede.export.FORMATS:
        for out in ("full/thesis.txt", "full/thesis.txt/in", "link", "nowhere", "pipe"):
            with pytest.raises(stampede.Error, match="it is no folder|it cannot be written: Not a directory"):
                export([form, str(made), "--where", "task = 'pick_and_lift'", "--out", str(tmp_path / out)])
    assert (tmp_path / "full" / "thesis.txt").read_text() == "mine" and not (tmp_path / "none").exists()
    monkeypatch.setitem(sys.modules, "h5py", None)
    with pytest.raises(ImportError, match=r"stampede-sim\[hdf5\]"):
        export(["robomimic", str(made), "--out", str(tmp_path / "missing")])
