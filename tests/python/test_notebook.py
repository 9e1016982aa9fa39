"""At a prompt: names, what objects say of themselves, early errors in Python's words, tasks by Gymnasium's names."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

stampede = pytest.importorskip("stampede")


@pytest.fixture(scope="module")
def demos(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("demos") / "demos.db"
    stampede.Session(catalogue=path).run("reach_target", seed=3)
    return path


def test_names() -> None:
    names = dir(stampede)
    assert {"Catalogue", "Env", "SkillEnv", "VectorEnv", "FrameDataset", "Session", "evaluate"} <= set(names)
    assert not {"Any", "TYPE_CHECKING", "annotations", "check_interpreter"} & set(names)
    assert all(getattr(stampede, name) is not None for name in names)


def test_objects_say_what_they_are(demos: Path) -> None:
    catalogue = stampede.Catalogue(demos)
    arrays = catalogue[1].arrays()
    session = stampede.Session(catalogue=demos)
    world = stampede.Session().environment("reach_target")
    evaluation = stampede.Session().evaluate(["reach_target"], episodes=1)
    one = stampede.Session()
    said = {
        repr(session): f"Session(catalogue='{demos}')",
        repr(one): "Session()",
        repr(world): "Environment('reach_target')",
        repr(stampede.Env("reach_target", action="tool_delta")): "Env('reach_target', action='tool_delta')",
        repr(stampede.VectorEnv("reach_target", 2)): "VectorEnv('reach_target', num_envs=2)",
        repr(evaluation): "Evaluation(reach_target, none: 1 of 1)",
        repr(arrays): f"EpisodeArrays(reach_target {arrays.variation}, {arrays.frames} frames, {len(arrays)} columns)",
        repr(arrays.column("joint_positions")): f"Column('joint_positions', {arrays.frames} x 7, rad)",
        repr(stampede.Reset(seed=4)): "Reset(seed 4)",
    }
    assert all(found == expected for found, expected in said.items())
    dataset = stampede.FrameDataset(catalogue, ["joint_positions"], window=2)
    assert repr(dataset) == f"FrameDataset({arrays.frames} windows of 2 of 1 episodes: joint_positions)"
    world.reset()
    state = session.state(session.run("reach_target", seed=3), 0)
    env = stampede.Env("reach_target")
    env.reset(seed=1)
    assert repr(env.save()) == f"SavedEpisode(reach_target {env.reset(seed=1)[1]['variation']}, seed 1)"
    saved = world.save()
    for answer in (world.step(stampede.Action("hold", frames=2)), world.skills()[0], world.spaces()[0], state, saved):
        assert " object at 0x" not in repr(answer)
    table = catalogue.query("SELECT '<b>' AS \"a&b\"")._repr_html_()
    assert table == "<table><tr><th>a&amp;b</th></tr><tr><td>&lt;b&gt;</td></tr></table>"
    assert "<td>reach_target</td>" in evaluation._repr_html_()


def test_notebooks_show_what_objects_are(demos: Path) -> None:
    catalogue = stampede.Catalogue(demos)
    episode, session = catalogue[1], stampede.Session()
    assert catalogue._repr_html_() == (
        "<table><tr><th>task</th><th>episodes</th><th>successful</th></tr>"
        f"<tr><td>reach_target</td><td>1</td><td>1</td></tr></table><p>Catalogue(&#x27;{demos}&#x27;): 1 episodes</p>"
    )
    shown = episode._repr_html_()
    assert "<tr><th>seed</th><td>3</td></tr>" in shown and "<tr><th>end</th><td>success</td></tr>" in shown
    assert f"<td>{episode.instructions()[0]}</td>" in shown
    arrays = episode.arrays("joint_positions")._repr_html_()
    assert f"<tr><td>joint_positions</td><td>{episode.frames} x 7</td><td>rad</td>" in arrays
    assert session._repr_html_() == (
        "<table><tr><th>session</th><td>Session()</td></tr>"
        f"<tr><th>tasks</th><td>{len(session.tasks())}</td></tr></table>"
    )
    env = stampede.Env("reach_target", observations=["joint_positions", "gripper_open"])
    assert env._repr_html_().startswith(
        "<table><tr><th></th><th>space</th></tr><tr><td>action</td><td>8 float32</td></tr>"
        "<tr><td>gripper_open</td><td>1 float64</td></tr><tr><td>joint_positions</td><td>7 float64</td></tr></table>"
    )
    assert "choices</td>" in stampede.SkillEnv("reach_target")._repr_html_()
    assert "<td>action</td><td>2 x 8 float32</td>" in stampede.VectorEnv("reach_target", 2)._repr_html_()


def test_errors_are_early_and_in_pythons_words(demos: Path) -> None:
    for columns in (["joint_position"], ["front_rgb"], ["joint_positions", "object_pose/nothing"]):
        with pytest.raises(stampede.Error, match=columns[-1]):
            stampede.FrameDataset(str(demos), columns)
    session = stampede.Session()
    for use in (
        lambda: session.run("reach_target", where="(nonsense"),
        lambda: session.run("reach_target", set=["nonsense"]),
        lambda: session.run("reach_target", skills=0),
        lambda: session.run_all([]),
        lambda: session.run_all(["reach_target"], episodes=0),
        lambda: session.run_all(["reach_target"]),
        lambda: session.query("SELECT 1"),
        lambda: session.environment("reach_target").episode(),
        lambda: session.add_sensor("a b", lambda now: [1.0], ["x"]),
        lambda: session.add_sensor("ab", lambda now: [1.0], []),
        lambda: session.add_policy("", object),
        lambda: stampede.Session(catalogue=":memory:"),
    ):
        with pytest.raises(stampede.Error) as caught:
            use()
        assert "::" not in str(caught.value) + caught.value.where + caught.value.hint
    with pytest.raises(stampede.Error, match="episodes=: it is at least 1"):
        session.run_all(["reach_target"], episodes=0)


def test_tasks_have_names_in_gymnasium() -> None:
    code = """
import gymnasium
env = gymnasium.make("stampede:stampede/reach_target")
assert "stampede.envs.env" in str(type(env.unwrapped))
assert gymnasium.make("stampede-skills/reach_target").unwrapped.skill_names
import stampede
from stampede.registration import shipped_tasks
assert shipped_tasks() == sorted(stampede.Session().tasks())
"""
    subprocess.run([sys.executable, "-c", code], check=True, timeout=120)
    code = "import stampede, gymnasium; gymnasium.make('stampede/reach_target')"
    subprocess.run([sys.executable, "-c", code], check=True, timeout=120)


def test_every_environment_says_that_a_skill_failed() -> None:
    env = stampede.Env("pick_and_lift")
    env.reset(seed=1)
    impossible = next(one for one in env.skills() if not one.feasible)
    info = env.step(stampede.Action.skill_call(impossible.skill, impossible.arguments))[-1]
    (ended,) = info["ended"]
    assert ended["skill"].startswith(impossible.skill + "(") and not ended["success"] and ended["reason"] != "none"
    assert env.step(env.action_space.sample())[-1]["ended"] == []
    many = stampede.VectorEnv("pick_and_lift", 2)
    many.reset(seed=1)
    call = stampede.Action.skill_call(impossible.skill, impossible.arguments)
    infos = many.step([call, many.single_action_space.sample()])[-1]
    assert infos["ended"][0][0]["reason"] == ended["reason"] and infos["ended"][1] == []
