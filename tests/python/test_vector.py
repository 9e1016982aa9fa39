"""VectorEnv: the same as its environments one by one, in all modes of Gymnasium."""

import gymnasium
import numpy as np
import pytest
from gymnasium.vector import AutoresetMode, SyncVectorEnv

from stampede import _core
from stampede.envs import Env, VectorEnv

TASK = "reach_target"
SHORT = {"horizon_s": 0.25, "reward": "dense", "observations": ("joint_positions", "task_low_dim_state", "facts")}


def same(one, other):
    """Whether observations or infos are equal, types and bits."""
    assert type(one) is type(other)
    if isinstance(one, dict):
        assert one.keys() == other.keys()
        for key in one:
            same(one[key], other[key])
    elif isinstance(one, (tuple, list)):
        for a, b in zip(one, other, strict=True):
            same(a, b)
    elif isinstance(one, np.ndarray):
        assert (one.dtype, one.shape) == (other.dtype, other.shape)
        if one.dtype == object:
            for a, b in zip(one, other, strict=True):
                same(a, b)
        else:
            assert np.array_equal(one, other)
    else:
        assert one == other


@pytest.mark.parametrize("mode", [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP])
@pytest.mark.parametrize("seed", [5, [9, None, 3]])
def test_it_gives_what_gymnasiums_own_vector_gives(mode, seed):
    ours = VectorEnv(TASK, 3, threads=2, autoreset_mode=mode, **SHORT)
    theirs = SyncVectorEnv([lambda: Env(TASK, **SHORT)] * 3, autoreset_mode=mode)
    assert ours.observation_space == theirs.observation_space
    assert ours.action_space == theirs.action_space
    if not isinstance(seed, int):  # a seed that is not given is drawn: from a generator that is known
        for vector in (ours, theirs):
            vector.reset(seed=[1, 2, 3])
    same(ours.reset(seed=seed), theirs.reset(seed=seed))
    ours.action_space.seed(0)
    for step in range(14):
        actions = ours.action_space.sample()
        actions[1] *= 3 if step == 2 else 1  # one is refused
        results = ours.step(actions), theirs.step(actions)
        same(*results)
    assert ours.np_random_seed == theirs.np_random_seed
    for vector in (ours, theirs):
        vector.close()


def test_disabled_leaves_the_end_to_the_caller():
    settings = dict(SHORT, autoreset_mode="Disabled")
    vector = VectorEnv(TASK, 2, **settings)
    alone = Env(TASK, **SHORT)
    vector.reset(seed=4)
    rest = np.zeros((2, 8), np.float32)
    ends = [vector.step(rest)[3].tolist() for _ in range(5)]
    assert ends == [[False, False]] * 4 + [[True, True]]
    before, _, _, truncations, infos = vector.step(rest)
    assert truncations.all()
    assert "call reset()" in infos["refusal"][0]
    mask = np.array([False, True])
    options = {"reset_mask": mask}
    now, infos = vector.reset(seed=8, options=options)
    assert options == {"reset_mask": mask}  # as it was
    assert infos["_seed"].tolist() == [False, True]
    expected, _ = alone.reset(seed=9)
    for name in now:
        assert np.array_equal(now[name][0], before[name][0])
        assert np.array_equal(now[name][1], expected[name])
    assert vector.step(rest)[3].tolist() == [True, False]


@pytest.mark.parametrize("mask", [np.array([True]), np.array([0, 1]), np.array([False, False])])
def test_a_wrong_mask_is_refused(mask):
    vector = VectorEnv(TASK, 2)
    vector.reset(seed=1)
    with pytest.raises(_core.Error, match="reset_mask"):
        vector.reset(options={"reset_mask": mask})


def test_results_are_the_callers_own():
    vector = VectorEnv(TASK, 2)
    first, _ = vector.reset(seed=1)
    kept = {name: values.copy() for name, values in first.items()}
    vector.step(vector.action_space.high)
    same(first, kept)


def test_any_space_at_any_step():
    vector = VectorEnv("pick_up_cup", 2, variation="colour=red")
    vector.reset(seed=3)
    pick = _core.Action.skill_call("pick", ["cup", "table", "panda.hand"])
    infos = vector.step([pick, np.zeros(8)])[4]
    assert "(holding panda.hand cup)" in infos["changes"][0]
    assert infos["duration"][1] == 1
    assert len(vector.skills()[1]) == 4


def test_a_start_that_cannot_be_made_stops_no_other(monkeypatch):
    vector, alone = VectorEnv(TASK, 2), Env(TASK)
    monkeypatch.setattr(vector, "_try_at_once", lambda starts: None)
    observation, infos = vector.reset(seed=6)
    assert infos["seed"].tolist() == [6, 7]
    expected, _ = alone.reset(seed=7)
    for name in expected:
        assert np.array_equal(observation[name][1], expected[name])


def test_it_is_made_by_name():
    vector = gymnasium.make_vec(f"stampede/{TASK}", num_envs=2, action="tool_delta")
    assert isinstance(vector.unwrapped, VectorEnv)
    assert vector.action_names[-1] == "gripper"
    vector.close()


def test_pictures():
    vector = VectorEnv(TASK, 2, render_mode="rgb_array", image_size=32)
    vector.reset(seed=1)
    pictures = vector.render()
    assert [picture.shape for picture in pictures] == [(32, 32, 3)] * 2
    assert not np.array_equal(*pictures)


@pytest.mark.parametrize("mode", ["NextStep", "SameStep"])
def test_recorded_episodes_reach_the_catalogue(tmp_path, mode):
    file = tmp_path / "agents.db"
    vector = VectorEnv(TASK, 2, record=True, catalogue=file, horizon_s=0.2, autoreset_mode=mode)
    vector.reset(seed=1)
    recorded = []
    for _ in range(6):
        _, _, _, over, infos = vector.step(np.zeros_like(vector.action_space.low))
        ended = infos.get("final_info", infos) if mode == "SameStep" else infos
        recorded += [episode for episode in ended.get("recorded", ()) if episode]
    assert len(recorded) == 2
    assert not any(episode.success for episode in recorded)
    vector.close()
    _, rows = _core.CatalogueReader(file).query("SELECT seed, frames FROM episodes ORDER BY seed")
    assert [row[0] for row in rows] == [1, 2]
    assert all(row[1] >= 4 for row in rows)


def test_bad_arguments():
    with pytest.raises(_core.Error, match="there is no such camera"):
        VectorEnv(TASK, 2, render_mode="rgb_array", camera="frnt")
    with pytest.raises(_core.Error, match="one or more"):
        VectorEnv(TASK, 0)
    with pytest.raises(_core.Error, match="NextStep"):
        VectorEnv(TASK, 1, autoreset_mode="next")
    vector = VectorEnv(TASK, 2)
    with pytest.raises(_core.Error, match=r"call reset\(\)"):
        vector.step(vector.action_space.high)
    with pytest.raises(_core.Error, match="3 seeds for 2"):
        vector.reset(seed=[1, 2, 3])
    vector.reset()
    with pytest.raises(_core.Error, match="1 actions"):
        vector.step([np.zeros(8)])
    vector.close()
    with pytest.raises(_core.Error, match="closed"):
        vector.reset()
