"""Stable-Baselines3 and its contributions train in the environments."""

import warnings

import gymnasium
import pytest

learners = pytest.importorskip("stable_baselines3")

from stable_baselines3.common.env_checker import check_env  # noqa: E402

from stampede import _core  # noqa: E402
from stampede.envs import Env, SkillEnv  # noqa: E402
from stampede.evaluation import evaluate  # noqa: E402


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


def trained(env):
    return learners.PPO("MultiInputPolicy", env, n_steps=8, batch_size=8, n_epochs=1, device="cpu")


def test_a_model_is_evaluated_as_it_would_act_in_its_environment():
    settings = {"normalise_actions": True, "horizon_s": 1, "action": "joint_velocity", "variation": "colour=red"}
    env = Env("reach_target", **settings, split="test")
    model = trained(env)
    result = evaluate(model, "reach_target", episodes=2, variation="colour=red", catalogue=None)
    assert result.rows[0].episodes == 2
    assert result.rows[0].mean_length_s == pytest.approx(1)
    same = evaluate(model, ["reach_target"], env=settings, episodes=2, variation="colour=red")
    assert [row.mean_return for row in same.rows] == [row.mean_return for row in result.rows]


def test_the_episode_of_an_evaluation_is_that_of_the_environment(tmp_path):
    env = Env("reach_target", normalise_actions=True, horizon_s=1, split="test", variation="colour=red")
    flat = gymnasium.wrappers.FlattenObservation(env)
    model = learners.PPO("MlpPolicy", flat, n_steps=8, batch_size=8, n_epochs=1, device="cpu")
    file = tmp_path / "evaluation.db"
    evaluate(model, "reach_target", env=flat, episodes=1, variation="colour=red", catalogue=file)
    stored = _core.CatalogueReader(file).arrays(1)["joint_positions"]
    observation, info = flat.reset(seed=0)
    assert info["seed"] == 1_000_000
    over = False
    while not over:
        observation, _, terminated, truncated, _ = flat.step(model.predict(observation, deterministic=True)[0])
        over = terminated or truncated
    assert (env.observation(env._account.raw)["joint_positions"] == stored[-1]).all()


def test_a_model_of_skills_is_evaluated_with_its_masks(tmp_path):
    contrib = pytest.importorskip("sb3_contrib")
    env = SkillEnv("stack_blocks", variation="colour=red,height=2", horizon_s=8, split="test")
    model = contrib.MaskablePPO("MultiInputPolicy", env, n_steps=8, batch_size=8, device="cpu", seed=0)
    file = tmp_path / "evaluation.db"
    evaluate(model, "stack_blocks", episodes=1, variation="colour=red,height=2", catalogue=file)
    observation, info = env.reset(seed=0)
    skills = []
    while "is_success" not in info:
        action = model.predict(observation, deterministic=True, action_masks=env.action_masks())[0]
        skills.append(env.skill_names[action])
        observation, _, _, _, info = env.step(action)
    asked = [one.asked for one in _core.CatalogueReader(file).arrays(1).agent_actions]
    asked = [action for action in asked if action.space == "skill"]  # after success it holds still
    assert [f"{action.skill}({', '.join(action.arguments)})" for action in asked] == skills


def test_one_model_acts_in_several_tasks():
    env = Env("pick_and_lift", normalise_actions=True, horizon_s=0.5, observations=("joint_positions",))
    rows = evaluate(trained(env), ["pick_and_lift", "pick_up_cup"], episodes=1).rows
    assert {row.task: row.episodes for row in rows if row.axis == ""}["pick_up_cup"] == 1


def test_a_model_of_other_spaces_is_named():
    model = trained(Env("reach_target", normalise_actions=True))
    with pytest.raises(_core.Error, match="its observation space is not the model's"):
        evaluate(model, "stack_blocks", episodes=1)
    with pytest.raises(_core.Error, match="its action space is not the model's"):
        evaluate(model, "reach_target", env={"action": "tool_delta", "gripper": False}, episodes=1)
    with pytest.raises(_core.Error, match=r"a stampede\.Env"):
        evaluate(model, "reach_target", env=SkillEnv("reach_target"), episodes=1)
