"""One run, made in shards by whatever executor there is: a process pool, submitit, Dask, Ray.

    from concurrent.futures import ProcessPoolExecutor

    for part in stampede.cluster.generate(
        ["stack_blocks"], "parts", episodes=1000, shards=100, executor=lambda: ProcessPoolExecutor(8)
    ):
        print(part.shard, part.episodes, stampede.Catalogue(part.file))

Each shard is a catalogue of its own in one folder. All of them together are what one `Session.run_all` of the same
arguments makes, bit for bit: `stampede.Catalogue(*files)` reads them as one, `stampede merge all.db parts/*.db` makes
one of them. A shard whose worker is lost is made again; one that is finished never is.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from stampede.faults import fault

from .executors import Executor, Job, ray_executor
from .flight import Flight, LostShards, Pool, Progress
from .folder import Part, claim
from .request import PathLike, absolute, check_request, made_of, plain_request

__all__ = ["Executor", "Job", "LostShards", "Part", "Progress", "generate", "ray_executor"]


def generate(
    tasks: str | Sequence[str],
    out: PathLike,
    *,
    episodes: int = 1,
    seed: int = 0,
    shards: int,
    executor: Executor | Callable[[], Executor],
    in_flight: int = 8,
    retries: int = 2,
    progress: Callable[[Progress], object] | None = None,
    workers: int = 1,
    root: PathLike | None = None,
    paths: Sequence[PathLike] = (),
    **request: Any,
) -> Iterator[Part]:
    """Makes the episodes of one run in shards, and gives each shard as it is finished, in any order.

    Nothing is submitted before the first part is asked for. Who stops asking leaves the rest undone; the same call goes
    on from there, and gives parts that are there already too. Mistakes in the arguments are told of at once.

    Arguments:
        tasks: one name or several.
        out: a folder that this machine and all workers see by one path, such as a cluster's shared disk. Parts are
            `part-0003-of-0100.db`; `run.json` says what run they are of.
        episodes, seed: how many of each task, and the first one's seed, as of Session.run_all.
        shards: how many parts. A worker makes one at a time, and makes it anew when it is lost: minutes are good.
        executor: has `submit(function, *arguments)`, whose answer has `done()` and `result()`: one of
            concurrent.futures, of submitit, `client.get_executor()` of Dask, `ray_executor()`. Or a function that
            makes one: it is called again when a pool breaks, which takes no more work once a worker was killed.
        in_flight: shards that are submitted and not yet given, at most. Twice the number of workers keeps all busy.
        retries: how often a shard is made again whose worker was lost. Where a pool breaks nobody knows by which
            shard: those it had are tried in halves until it is known, and that one only counts.
        progress: called with a Progress after each shard that is finished or lost.
        workers: threads of each worker. They do not change the data.
        root, paths: as of stampede.Session; the workers read them too.
        request: as of Session.run: variation, goal, pictures and more. Plain values.

    Raises stampede.Error for bad input, and where `out` holds parts of another run. Raises LostShards in the end, when
    all other shards are finished; earlier only if none is and many were lost.
    """
    asked = plain_request(request)
    names = [tasks] if isinstance(tasks, str) else list(tasks)
    for name, value, least in (("shards", shards, 1), ("in_flight", in_flight, 1), ("retries", retries, 0)):
        if not isinstance(value, int) or value < least:
            raise fault(f"{name}=", f"it is at least {least}, not {value!r}")
    if not callable(executor) and not hasattr(executor, "submit"):
        cure = "an executor, or a function that makes one: executor=lambda: ProcessPoolExecutor(2)"
        raise fault("executor=", f"{type(executor).__name__} has no submit()", cure)
    scripts = (None if root is None else absolute(root), [absolute(path) for path in paths])
    check_request(names, episodes, {**asked, "seed": seed, "workers": workers}, *scripts)
    run = {"tasks": names, "episodes": episodes, "seed": seed, "shards": shards, "request": asked}
    folder = Path(absolute(out))
    run |= made_of(names, *scripts)
    claim(folder, run)
    flight = Flight(Pool(executor), (str(folder), run, *scripts, workers), in_flight, retries, progress)
    return flight.parts()
