"""How much the Gymnasium environments cost beside the engine alone.

    PYTHONPATH=scripting/python python tests/bench/python/env_bench.py [rounds]

Steps of reach_target at 20 Hz, space joint_position, default observations, no pictures. Each round steps the engine
alone and the environment in turn, with the same actions; the figure is the median of the rounds' ratios, so that what
else the machine does weighs on both. "In lockstep": the engine alone as well waits at each step for both environments.
"""

import statistics
import sys
import threading
import time
from collections.abc import Callable

import numpy as np

from stampede import _core
from stampede.envs import Env, VectorEnv
from stampede.envs.env import OBSERVATIONS

TASK = "reach_target"
STEPS = 400
HOME = [0.0, 0.175, 0.0, -0.873, 0.0, 1.222, 0.785]


def actions() -> np.ndarray:
    """STEPS x 8, float32: near the joints' home, fingers open."""
    near = np.random.default_rng(0).uniform(-0.2, 0.2, (STEPS, 7)) + HOME
    return np.column_stack([near, np.full(STEPS, 0.04)]).astype(np.float32)


def run_engine(environment: _core.Environment, seed: int) -> None:
    environment.reset(_core.Reset(seed=seed))
    for row in ACTIONS:
        environment.step(_core.Action("joint_position", row[:7], gripper=0.04))


def run_env(env: Env) -> None:
    env.reset(seed=0)
    for row in ACTIONS:
        env.step(row)


def run_threads(environments: list[_core.Environment]) -> None:
    threads = [threading.Thread(target=run_engine, args=(one, i)) for i, one in enumerate(environments)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def run_group(group: _core.EnvironmentGroup) -> None:
    group.run([_core.Reset(seed=i) for i in range(len(group))])
    for row in ACTIONS:
        group.run([_core.Action("joint_position", row[:7], gripper=0.04)] * len(group))


def run_vector(env: VectorEnv) -> None:
    env.reset(seed=0)
    for rows in BOTH:
        env.step(rows)


def seconds(work: Callable[[], None]) -> float:
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def compare(name: str, alone: Callable[[], None], wrapped: Callable[[], None], rounds: int, steps: int) -> None:
    alone(), wrapped()
    pairs = [(seconds(alone), seconds(wrapped)) for _ in range(rounds)]
    rates = [f"{steps / statistics.median(column):.0f}" for column in zip(*pairs, strict=True)]
    ratio = statistics.median(one / other for one, other in pairs)
    print(f"{name}: engine {rates[0]} steps/s, environment {rates[1]} steps/s, {ratio:.2f} of the engine's")


ACTIONS = actions()
BOTH = np.stack([ACTIONS, ACTIONS], axis=1)

if __name__ == "__main__":
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 9
    session = _core.Session()
    channels = {"channels": list(OBSERVATIONS)}
    variation = session.variations(TASK)[0]
    one, *two = [session.environment(TASK, **channels) for _ in range(3)]
    env = Env(TASK, action="joint_position", variation=variation)
    compare("Env", lambda: run_engine(one, 0), lambda: run_env(env), rounds, STEPS)
    vector = VectorEnv(TASK, 2, action="joint_position", variation=variation)
    compare("VectorEnv of 2", lambda: run_threads(two), lambda: run_vector(vector), rounds, 2 * STEPS)
    group = _core.environment_group(session, TASK, 2, 2, **channels)
    compare("VectorEnv of 2, in lockstep", lambda: run_group(group), lambda: run_vector(vector), rounds, 2 * STEPS)
