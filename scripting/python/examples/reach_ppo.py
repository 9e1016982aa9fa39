"""PPO (Stable-Baselines3) learns `reach_target` from state: `python reach_ppo.py`."""

import argparse
import time

import gymnasium
import torch
from stable_baselines3 import PPO

import stampede

SETTINGS = {
    "action": "tool_delta",
    "observations": ("gripper_pose", "object_pose/target", "object_pose_in_tool/target"),
    "reward": "dense",
    "gripper": False,
    "normalise_actions": True,
    "horizon_s": 5,
}
LINE_EVERY = 10_000  # steps, a multiple of n_steps


class ByProgress(gymnasium.Wrapper):
    """What a step adds to the dense reward, and 1 at success.

    The dense reward says how near the goal is. Summed up it would pay for staying near; its differences pay for getting
    there (potential-based shaping: Ng, Harada and Russell, ICML 1999).
    """

    def reset(self, **arguments):
        self.near = 0.0
        return self.env.reset(**arguments)

    def step(self, action):
        observation, near, terminated, truncated, info = self.env.step(action)
        reward, self.near = near - self.near + info["success"], near
        return observation, reward, terminated, truncated, info


def train(steps: int, seed: int = 0) -> PPO:
    """A policy after so many steps of one environment."""
    torch.set_num_threads(1)
    env = ByProgress(gymnasium.wrappers.FlattenObservation(stampede.Env("reach_target", **SETTINGS)))
    model = PPO("MlpPolicy", env, n_steps=1000, batch_size=250, gamma=0.95, learning_rate=1e-3, seed=seed)
    begin = time.perf_counter()
    for _ in range(0, steps, LINE_EVERY):
        model.learn(min(LINE_EVERY, steps), reset_num_timesteps=False)
        seconds = time.perf_counter() - begin
        row = stampede.evaluate(model, "reach_target", episodes=20, first_seed=0).rows[0]  # without exploring
        print(f"{model.num_timesteps} steps, {seconds:.0f} s: success {row.success:.2f} of 20 starts", flush=True)
    return model


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--episodes", type=int, default=100, help="of the test split, to evaluate with")
    options = parser.parse_args()
    model = train(options.steps, options.seed)
    row = stampede.evaluate(model, "reach_target", episodes=options.episodes).rows[0]
    print(f"success {row.success:.2f} [{row.lower:.2f}, {row.upper:.2f}] of {row.episodes} of the test split")
