"""evaluate: the planner, and policies of one's own."""

import pytest

from stampede import _core
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


def test_unknown_tasks_have_a_cure():
    with pytest.raises(_core.Error, match="did you mean 'reach_target'"):
        evaluate(None, "reach_targe", episodes=1)
