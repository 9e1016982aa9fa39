"""Stable-Baselines3 and its contributions train in the environments."""

import warnings

import gymnasium
import pytest

learners = pytest.importorskip("stable_baselines3")

from stable_baselines3.common.env_checker import check_env  # noqa: E402

from stampede.envs import Env, SkillEnv  # noqa: E402


def test_stable_baselines_accepts_dict_and_flat_observations():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        check_env(Env("reach_target", normalise_actions=True))
        check_env(gymnasium.wrappers.FlattenObservation(Env("reach_target", normalise_actions=True)))
        check_env(SkillEnv("reach_target"))


@pytest.mark.parametrize("policy", ["MultiInputPolicy", "MlpPolicy"])
def test_stable_baselines_trains(policy):
    env = Env("reach_target", normalise_actions=True, observations=("joint_positions", "gripper_open", "facts"))
    flat = gymnasium.wrappers.FlattenObservation(env) if policy == "MlpPolicy" else env
    model = learners.PPO(policy, flat, n_steps=32, batch_size=16, n_epochs=1, device="cpu").learn(32)
    assert model.num_timesteps == 32


def test_maskable_ppo_chooses_only_what_can_be_done():
    contrib = pytest.importorskip("sb3_contrib")
    env = SkillEnv("reach_target", horizon_s=20)
    refused = []
    step = env.step

    def watched(action):
        result = step(action)
        refused.append("refusal" in result[-1])
        return result

    env.step = watched
    contrib.MaskablePPO("MultiInputPolicy", env, n_steps=32, batch_size=16, n_epochs=1, device="cpu").learn(64)
    assert len(refused) == 64
    assert not any(refused)
