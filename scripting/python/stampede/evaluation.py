"""How often a policy succeeds: Session.evaluate, for learners' models as well."""

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from stampede import _core

if TYPE_CHECKING:
    import gymnasium

    from .envs.sessions import PathLike

PolicyMaker = Callable[[], Any]


def evaluate(
    policy: Any,
    tasks: str | Sequence[str],
    *,
    env: "gymnasium.Env | Mapping[str, Any] | None" = None,
    episodes: int = 20,
    first_seed: int = 1_000_000,
    variation: str = "",
    perturb: Sequence[str] = (),
    workers: int = 1,
    shard: tuple[int, int] = (1, 1),
    name: str = "policy",
    deterministic: bool = True,
    root: "PathLike | None" = None,
    paths: "Sequence[PathLike]" = (),
    catalogue: "PathLike | None" = None,
    **settings: Any,
) -> _core.Evaluation:
    """Runs `episodes` of each task, undisturbed and along axes of perturbation, and counts successes.

    Arguments:
        policy: None: the planner. A callable: gives, once an episode, an object with
            `act(observation) -> Action | None` and, if it likes, `begin(call)`. Or a model with
            `predict(observation, state=, episode_start=, deterministic=)`, as of Stable-Baselines3: it observes and
            acts as in `env`. One that chooses skills is given `action_masks=` where its `predict` takes it.
        tasks: one name or several.
        env: for a model: an Env or SkillEnv, as it was trained in (wrapped or not), or arguments of one. None: the
            model's own.
        episodes, first_seed: how many of each task, and from which seed; from 1'000'000 up is the test split.
        variation: canonical text or axes of it; empty: all. perturb: axes, `camera=1` with strength.
        workers: threads. shard (2, 8): the second of eight parts, each into a catalogue of its own. name: of the policy, in the catalogue. deterministic: of a model.
        root, paths, catalogue: as of stampede.Session; the episodes go to the catalogue.
        settings: for a policy that is no model: channels, rates, horizon_s, width and more, as of Session.environment.

    Raises stampede.Error for unknown names, and for a model whose spaces are not those of the tasks.
    """
    session = _core.Session(root=root, paths=list(paths), catalogue=catalogue)
    asked: dict[str, Any] = {
        "episodes": episodes,
        "first_seed": first_seed,
        "variation": variation,
        "perturb": list(perturb),
        "workers": workers,
        "shard": shard,
        "policy_name": name,
    }
    names = [tasks] if isinstance(tasks, str) else list(tasks)
    if not hasattr(policy, "predict"):
        return session.evaluate(names, policy=policy, **asked, **settings)
    from .envs.models import model_policy

    maker, of_engine = model_policy(policy, names, env, deterministic, root, paths)
    return session.evaluate(names, policy=maker, **asked, **{**of_engine, **settings})
