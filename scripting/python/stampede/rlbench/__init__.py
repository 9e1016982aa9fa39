"""
RLBench's interface on this engine: its module paths, classes, arguments, shapes and units.

Importing it makes the tasks known to Gymnasium, as `rlbench/reach_target-state-v0` and `…-vision-v0`. README.md beside
this file has a table of what differs in meaning.
"""

import gymnasium as _gymnasium

from stampede._core import Session as _Session
from stampede.rlbench.environment import Environment
from stampede.rlbench.observation_config import CameraConfig, ObservationConfig
from stampede.rlbench.sim2real.domain_randomization import (
    DynamicsRandomizationConfig,
    RandomizeEvery,
    VisualRandomizationConfig,
)
from stampede.rlbench.task_environment import TaskEnvironment

__all__ = [
    "CameraConfig",
    "DynamicsRandomizationConfig",
    "Environment",
    "ObservationConfig",
    "RandomizeEvery",
    "TaskEnvironment",
    "VisualRandomizationConfig",
]


def _register() -> None:
    for task in _Session().tasks():
        for mode in ("state", "vision"):
            _gymnasium.register(
                id=f"rlbench/{task}-{mode}-v0",
                entry_point="stampede.rlbench.gym:make",
                kwargs={"task": task, "observation_mode": mode},
            )


_register()
