"""Stampede: labelled robot demonstrations, and tasks to act in.

    import stampede

    session = stampede.Session(catalogue="demos.db")          # tasks become episodes
    session.run_all(["pick_and_lift"], episodes=10, workers=2)
    for episode in stampede.Catalogue("demos.db").demos():     # episodes as numpy arrays, segments, facts, SQL
        print(episode, episode.arrays("joint_positions")["joint_positions"].shape)
    env = stampede.Env("pick_and_lift")                        # a Gymnasium environment; or gymnasium.make

`python -m stampede.export` writes datasets for trainers; `stampede.rlbench` has RLBench's interface.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from stampede.interpreter import check_interpreter

check_interpreter()

from stampede._core import (
    Action,
    ActionSpace,
    CatalogueError,
    Environment,
    Episode,
    EpisodeArrays,
    Error,
    Evaluation,
    EvaluationRow,
    Fact,
    PolicyCall,
    Reset,
    SavedState,
    Segment,
    Session,
    Step,
    TaskPlan,
    WorldState,
    __version__,
    plan_pddl,
)
from stampede import pickling, shown
from stampede.catalogue import Catalogue, StoredEpisode, Table
from stampede.registration import register_tasks

if TYPE_CHECKING:
    from stampede import cluster
    from stampede.datasets import FrameDataset, WindowStream
    from stampede.envs import Env, SkillEnv, VectorEnv
    from stampede.evaluation import evaluate

# Imported when they are first asked for: they need packages that take long to import.
_LATER = {
    "Env": "stampede.envs",
    "SkillEnv": "stampede.envs",
    "VectorEnv": "stampede.envs",
    "evaluate": "stampede.evaluation",
    "FrameDataset": "stampede.datasets",
    "WindowStream": "stampede.datasets",
}
_MODULES_LATER = {"cluster"}

__all__ = [
    "__version__",
    "Action",
    "ActionSpace",
    "Catalogue",
    "CatalogueError",
    "Environment",
    "Episode",
    "EpisodeArrays",
    "Error",
    "Evaluation",
    "EvaluationRow",
    "Fact",
    "PolicyCall",
    "Reset",
    "SavedState",
    "Segment",
    "Session",
    "Step",
    "StoredEpisode",
    "Table",
    "TaskPlan",
    "WorldState",
    "plan_pddl",
    "cluster",
    "Env",
    "SkillEnv",
    "VectorEnv",
    "evaluate",
    "FrameDataset",
    "WindowStream",
]


def __dir__() -> list[str]:
    return sorted(__all__)


def __getattr__(name: str) -> Any:
    import importlib

    if name in _LATER:
        return getattr(importlib.import_module(_LATER[name]), name)
    if name in _MODULES_LATER:
        return importlib.import_module(f"stampede.{name}")
    raise AttributeError(f"module 'stampede' has no attribute {name!r}")


register_tasks()
pickling.register()
shown.register()
