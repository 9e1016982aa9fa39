"""Every task and every action space passes Gymnasium's own check."""

import warnings

import gymnasium
import pytest
from gymnasium.utils.env_checker import check_env

from stampede import _core
from stampede.envs import Env
from stampede.envs.spaces import SET_POINT_SPACES

TASKS = _core.Session().tasks()


def checked(env):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that poses have no bounds
        check_env(env, skip_render_check=True)
    env.close()


@pytest.mark.parametrize("task", TASKS)
def test_every_task_passes_gymnasiums_check(task):
    checked(gymnasium.make(f"stampede/{task}").unwrapped)


@pytest.mark.parametrize("task", ["reach_target", "stack_blocks"])
@pytest.mark.parametrize("action", SET_POINT_SPACES)
def test_every_space_passes_gymnasiums_check(task, action):
    checked(Env(task, action=action))


@pytest.mark.parametrize("parameters", [False, True])
def test_skills_pass_gymnasiums_check(parameters):
    checked(gymnasium.make("stampede-skills/put_item_in_drawer", parameters=parameters).unwrapped)
