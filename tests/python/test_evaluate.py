"""evaluate: the planner, and policies of one's own."""

import numpy as np
import pytest

from stampede import _core
from stampede.envs import SkillEnv
from stampede.evaluation import evaluate


def test_the_planner_is_evaluated():
    rows = evaluate(None, "reach_target", episodes=2, variation="colour=red").rows
    assert (rows[0].task, rows[0].episodes, rows[0].succeeded) == ("reach_target", 2, 2)


class Still:
    """Does nothing for three frames, then is done."""

    begun = []

    def begin(self, call):
        self.left = 3
        Still.begun.append(call.task)

    def act(self, observation):
        assert list(observation) == ["joint_positions"]
        self.left -= 1
        return _core.Action("joint_delta", [0.0] * 7) if self.left >= 0 else None


def test_a_policy_of_ones_own_is_evaluated():
    Still.begun = []
    rows = evaluate(Still, ["reach_target", "pick_up_cup"], episodes=1, channels=["joint_positions"]).rows
    assert sorted(Still.begun) == ["pick_up_cup", "reach_target"]
    assert {row.task: row.succeeded for row in rows if row.task} == {"reach_target": 0, "pick_up_cup": 0}


class First:
    """A model that takes the first skill that can be done."""

    def __init__(self, env):
        self.observation_space, self.action_space = env.observation_space, env.action_space

    def predict(self, observation, state=None, episode_start=None, deterministic=False, action_masks=None):
        assert self.observation_space.contains(observation)
        return np.flatnonzero(action_masks)[0], state


def test_a_model_of_skills_is_evaluated_as_it_would_act_in_its_environment():
    env = SkillEnv("push_buttons", observations=("facts", "goal"), split="test", horizon_s=12)
    for variation, succeeds in {"count=1,first=violet,second=black,third=olive": True, "count=2": False}.items():
        row = evaluate(First(env), "push_buttons", env=env, episodes=1, variation=variation).rows[0]
        _, info = env.reset(seed=0, options={"variation": variation})
        while "is_success" not in info:
            _, _, _, _, info = env.step(np.flatnonzero(env.action_masks())[0])
        assert row.succeeded == info["is_success"] == succeeds
        assert row.mean_length_s == pytest.approx(info["time_s"], abs=0.16)  # to a few frames


def test_a_model_of_parts_of_skills_is_not_evaluated():
    env = SkillEnv("reach_target", frames=5)
    with pytest.raises(_core.Error, match="parts of skills"):
        evaluate(First(env), "reach_target", env=env)


def test_unknown_tasks_have_a_cure():
    with pytest.raises(_core.Error, match="did you mean 'reach_target'"):
        evaluate(None, "reach_targe", episodes=1)
