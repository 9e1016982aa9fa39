"""MaskablePPO (sb3-contrib) learns to choose skills: `python skills_ppo.py push_buttons`, or `stack_blocks`."""

import argparse
import time

import gymnasium
import numpy as np
import torch
from sb3_contrib import MaskablePPO
from stable_baselines3.common.monitor import Monitor

import stampede

TASKS = {  # variations ("": all), and a horizon of about two plans: a longer one lets chance succeed
    "push_buttons": {"variation": "", "horizon_s": 30},
    "stack_blocks": {"variation": "height=2", "horizon_s": 15},
}
LEARNER = {
    "gamma": 0.8,  # a skill: with the sparse reward, 1 at success, a shorter plan is worth more
    "n_steps": 100,  # skills between updates: few, as a skill takes longer than its share of an update
    "batch_size": 50,
    "learning_rate": 1e-3,
    "ent_coef": 0.01,  # goes on trying others of the skills that can be done
    "stats_window_size": 50,  # episodes that `success` below is of
}
LINE_EVERY = 300  # steps, a multiple of n_steps


def environment(task: str) -> gymnasium.Env:
    """The agent sees which facts hold and which the goal wants, and chooses among the skills that can be done."""
    return Monitor(stampede.SkillEnv(task, observations=("facts", "goal"), **TASKS[task]))


def train(env: gymnasium.Env, steps: int, seed: int) -> MaskablePPO:
    torch.set_num_threads(1)
    model = MaskablePPO("MultiInputPolicy", env, seed=seed, device="cpu", **LEARNER)
    begin = time.perf_counter()
    for _ in range(0, steps, LINE_EVERY):
        model.learn(LINE_EVERY, reset_num_timesteps=False)
        success = np.mean(model.ep_success_buffer)
        episodes, seconds = len(env.get_episode_rewards()), time.perf_counter() - begin
        print(f"{model.num_timesteps} steps, {episodes} episodes: success {success:.2f}, {seconds:.0f} s", flush=True)
    return model


class Chance:
    """What the agent is compared with: takes any skill that can be done."""

    def __init__(self, env: gymnasium.Env, seed: int) -> None:
        self.observation_space, self.action_space = env.observation_space, env.action_space
        self.random = np.random.default_rng(seed)

    def predict(self, observation, state=None, episode_start=None, deterministic=True, action_masks=None):
        return self.random.choice(np.flatnonzero(action_masks)), state


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("task", choices=TASKS)
    parser.add_argument("--steps", type=int, default=1500, help="skills to learn from")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--episodes", type=int, default=100, help="of the test split, to evaluate with")
    options = parser.parse_args()
    env = environment(options.task)
    agents = {"trained": train(env, options.steps, options.seed)}
    agents["by chance"] = Chance(env, options.seed)
    asked = {"env": env, "episodes": options.episodes, "variation": TASKS[options.task]["variation"]}
    for name, agent in agents.items():
        row = stampede.evaluate(agent, options.task, **asked).rows[0]
        print(f"{name}: success {row.success:.2f} [{row.lower:.2f}, {row.upper:.2f}] of {row.episodes} test episodes")
