"""One run in shards: by process pools, Dask, Ray and submitit, with workers that are killed."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import pytest

import stampede
from stampede import _core
from stampede.cluster import LostShards, Part, Progress, generate, ray_executor

PROGRAM = Path(_core.__file__).parent / "engine" / "bin" / "stampede"
RUN: dict[str, Any] = {"tasks": ["reach_target"], "episodes": 60, "seed": 7, "shards": 4}


def pool() -> ProcessPoolExecutor:
    return ProcessPoolExecutor(2, mp_context=get_context("fork"))


def dying(
    diary: Path, deaths: dict[int, int], function: Callable[..., Part], shard: int, ticket: str, folder: str, *rest: Any
) -> Part:
    """What a worker does that is killed while it makes the shard, at its first tries. It keeps a diary."""
    with (diary / str(shard)).open("a") as lines:
        lines.write(f"{os.getpid()}\n")
    if len((diary / str(shard)).read_text().split()) <= deaths.get(shard, 0):
        threading.Thread(target=die_in_mid_run, args=(Path(folder), shard), daemon=True).start()
    return function(shard, ticket, folder, *rest)


def die_in_mid_run(folder: Path, shard: int) -> None:
    while not any(file.stat().st_size for file in folder.glob(f"part-{shard:04}-*.half-wal")):
        time.sleep(0.002)
    os.kill(os.getpid(), signal.SIGKILL)


class Through:
    """An executor that has its functions called by another one."""

    def __init__(self, executor: Any, caller: Callable[..., Any]) -> None:
        self.executor, self.caller, self.submitted = executor, caller, []
        if hasattr(executor, "shutdown"):
            self.shutdown = executor.shutdown

    def submit(self, function: Callable[..., Any], /, shard: int, *rest: Any) -> Any:
        self.submitted.append(shard)
        return self.executor.submit(self.caller, function, shard, *rest)


def call(function: Callable[..., Any], *arguments: Any) -> Any:
    return function(*arguments)


def nobody() -> Any:
    raise AssertionError("nothing is to be made")


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The hash of RUN, made at once."""
    file = tmp_path_factory.mktemp("whole") / "all.db"
    run = {key: value for key, value in RUN.items() if key != "shards"}
    assert stampede.Session(catalogue=file).run_all(**run).finished == 60
    return content_hash(file)


@pytest.fixture
def diary(tmp_path: Path) -> Path:
    (tmp_path / "diary").mkdir()
    return tmp_path / "diary"


@pytest.fixture
def threads() -> Iterator[ThreadPoolExecutor]:
    with ThreadPoolExecutor(2) as executor:
        yield executor


def program(*words: str | Path) -> str:
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def content_hash(file: Path) -> str:
    return program("query", file, "--hash").split()[-1]


def merged_hash(parts: list[Part], folder: Path) -> str:
    program("merge", folder / "all.db", *(part.file for part in parts))
    return content_hash(folder / "all.db")


def files(folder: Path) -> list[str]:
    return sorted(file.name for file in folder.iterdir())


WHOLE = [f"part-000{shard}-of-0004.db" for shard in (1, 2, 3, 4)] + ["run.json"]


def test_parts_are_one_run_and_are_made_once(whole: str, tmp_path: Path) -> None:
    out = tmp_path / "parts"
    told: list[Progress] = []
    parts = list(generate(**RUN, out=out, executor=pool, progress=told.append))
    assert sorted(part.shard for part in parts) == [1, 2, 3, 4]
    assert {(part.shards, part.episodes, part.succeeded, part.tries) for part in parts} == {(4, 15, 15, 1)}
    assert [(now.done, now.shards, now.lost) for now in told] == [(n, 4, "") for n in (1, 2, 3, 4)]
    assert files(out) == WHOLE
    assert merged_hash(parts, tmp_path) == whole
    assert len(stampede.Catalogue(*(part.file for part in parts))) == 60

    stamps = [(out / name).stat().st_mtime_ns for name in WHOLE]
    again = list(generate(**RUN, out=out, executor=nobody))
    assert [(part.shard, part.episodes, part.succeeded, part.tries) for part in again] == [
        (shard, 15, 15, 0) for shard in (1, 2, 3, 4)
    ]
    assert [(out / name).stat().st_mtime_ns for name in WHOLE] == stamps
    (out / WHOLE[2]).unlink()
    assert [part.tries for part in generate(**RUN, out=out, executor=pool)] == [0, 0, 0, 1]
    assert merged_hash(parts, tmp_path) == whole


def test_parts_may_be_more_than_episodes(threads: ThreadPoolExecutor, tmp_path: Path) -> None:
    parts = list(generate("reach_target", tmp_path, episodes=2, shards=3, executor=threads))
    assert sorted((part.shard, part.episodes) for part in parts) == [(1, 1), (2, 1), (3, 0)]
    assert len(stampede.Catalogue(*(part.file for part in parts))) == 2


def test_a_worker_that_is_killed_in_mid_run_costs_a_try(whole: str, diary: Path, tmp_path: Path) -> None:
    out = tmp_path / "parts"
    told: list[Progress] = []
    maker = lambda: Through(pool(), partial(dying, diary, {2: 1}))  # noqa: E731
    parts = list(generate(**RUN, out=out, executor=maker, progress=told.append))
    assert {part.shard: part.tries for part in parts}[2] == 2
    assert [now.done for now in told if "BrokenProcessPool" in now.lost]
    assert files(out) == WHOLE
    assert merged_hash(parts, tmp_path) == whole


def test_a_shard_that_kills_each_worker_is_found_and_the_others_finish(whole: str, diary: Path, tmp_path: Path) -> None:
    out = tmp_path / "parts"
    maker = lambda: Through(pool(), partial(dying, diary, {3: 99}))  # noqa: E731
    parts: list[Part] = []
    with pytest.raises(
        LostShards, match=r"of 4 shards, 3 were lost 2 times each\n    shard 3: BrokenProcessPool"
    ) as end:
        for part in generate(**RUN, out=out, executor=maker, retries=1):
            parts.append(part)
    assert sorted(part.shard for part in parts) == [1, 2, 4]
    assert list(end.value.errors) == [3] and "the same call tries the others again" in end.value.hint
    assert [name for name in files(out) if name.endswith(".db")] == [WHOLE[0], WHOLE[1], WHOLE[3]]
    assert any(".half" in name for name in files(out))  # of shard 3, and of nothing that is finished
    parts = list(generate(**RUN, out=out, executor=pool))
    assert [part.tries for part in parts] == [0, 0, 0, 1]
    assert files(out) == WHOLE
    assert merged_hash(parts, tmp_path) == whole


def test_a_pool_that_was_handed_over_and_breaks_is_told_of_with_its_cure(diary: Path, tmp_path: Path) -> None:
    with pool() as executor:
        broken = Through(executor, partial(dying, diary, {1: 1}))
        with pytest.raises(stampede.Error, match=r"the executor is broken.*\n    executor=lambda"):
            list(generate(**RUN, out=tmp_path / "parts", executor=broken))
    assert len(list(generate(**RUN, out=tmp_path / "parts", executor=pool))) == 4


def test_shards_are_given_as_they_come(threads: ThreadPoolExecutor, tmp_path: Path) -> None:
    others_were_given = threading.Event()

    def first_is_slow(function: Callable[..., Part], shard: int, *rest: Any) -> Part:
        assert shard != 1 or others_were_given.wait(60)
        return function(shard, *rest)

    order = []
    for part in generate(**{**RUN, "episodes": 4}, out=tmp_path, executor=Through(threads, first_is_slow)):
        order.append(part.shard)
        if len(order) == 3:
            others_were_given.set()
    assert order == [2, 3, 4, 1]


def test_no_more_is_in_flight_than_was_asked_for(threads: ThreadPoolExecutor, tmp_path: Path) -> None:
    executor = Through(threads, call)
    shards = generate("reach_target", tmp_path, episodes=8, shards=8, executor=executor, in_flight=3)
    assert executor.submitted == []
    for given, _ in enumerate(shards):
        assert len(executor.submitted) - given <= 3
        time.sleep(0.05)
        assert len(executor.submitted) - given <= 3
    assert sorted(executor.submitted) == list(range(1, 9))


def test_who_stops_asking_goes_on_later(threads: ThreadPoolExecutor, tmp_path: Path) -> None:
    executor = Through(threads, call)
    run = {"tasks": "reach_target", "out": tmp_path, "episodes": 8, "shards": 8, "in_flight": 2}
    for part in generate(**run, executor=executor):
        if part.shard >= 3:
            break
    assert 3 <= len(executor.submitted) <= 5
    threads.shutdown()
    rest = list(generate(**run, executor=pool))
    assert len(rest) == 8 and 2 <= sum(part.tries == 0 for part in rest) <= 5


def test_mistakes_are_told_at_once(threads: ThreadPoolExecutor, tmp_path: Path) -> None:
    def refused(match: str, error: type[Exception] = stampede.Error, **other: Any) -> None:
        asked = {"tasks": "reach_target", "shards": 2, "executor": threads, **other}
        with pytest.raises(error, match=match):
            generate(out=tmp_path / "parts", **asked)
        assert not (tmp_path / "parts").exists()

    refused("did you mean 'reach_target'", tasks=["reach_targt"])
    refused("near. takes 2 arguments", goal="(near target)")
    refused("shards=: it is at least 1, not 0", shards=0)
    refused("in_flight=: it is at least 1", in_flight=0)
    refused("retries=: it is at least 0", retries=-1)
    refused("episodes=: it is at least 1", episodes=0)
    refused("int has no submit", executor=2)
    refused("plain values", set=[object()])
    refused("no argument 'sede'", TypeError, sede=3)


def test_what_only_a_worker_finds_wrong_is_not_tried_again(threads: ThreadPoolExecutor, tmp_path: Path) -> None:
    executor = Through(threads, call)
    pictures = {"cameras": ["nowhere"]}
    with pytest.raises(stampede.Error, match="nowhere"):
        list(generate("reach_target", tmp_path, shards=4, executor=executor, in_flight=1, pictures=pictures))
    assert executor.submitted == [1]
    right = generate("reach_target", tmp_path, shards=4, executor=threads)  # nothing was made: the folder is free
    assert len(list(right)) == 4


def test_a_worker_that_sees_another_folder_is_told(threads: ThreadPoolExecutor, tmp_path: Path) -> None:
    def elsewhere(function: Callable[..., Part], shard: int, ticket: str, folder: str, *rest: Any) -> Part:
        return function(shard, ticket, str(tmp_path / "elsewhere"), *rest)

    with pytest.raises(
        stampede.Error, match=r"elsewhere/run\.json: it is not there.*\n    let this worker see the folder"
    ):
        list(generate("reach_target", tmp_path / "parts", shards=1, executor=Through(threads, elsewhere)))


def test_a_try_that_was_not_lost_after_all_does_no_harm(threads: ThreadPoolExecutor, tmp_path: Path) -> None:
    def twice(*order: Any) -> Part:
        with ThreadPoolExecutor(2) as both:
            first, second = both.map(lambda _: call(*order), range(2))
        assert (first.episodes, first.file) == (second.episodes, second.file)
        return first

    (part,) = generate("reach_target", tmp_path, episodes=20, shards=1, executor=Through(threads, twice))
    assert files(tmp_path) == ["part-0001-of-0001.db", "run.json"] and len(stampede.Catalogue(part.file)) == 20


def test_where_nothing_works_not_all_is_tried(threads: ThreadPoolExecutor, tmp_path: Path) -> None:
    def lost(*_: Any) -> None:
        raise OSError("no such host")

    executor = Through(threads, lost)
    with pytest.raises(LostShards, match="shard 1: OSError: no such host") as end:
        list(generate("reach_target", tmp_path, shards=100, executor=executor, retries=1))
    assert len(end.value.errors) == 4
    assert set(Counter(executor.submitted).values()) <= {1, 2} and len(set(executor.submitted)) < 20


def test_parts_of_another_run_are_refused(threads: ThreadPoolExecutor, tmp_path: Path) -> None:
    out, own = tmp_path / "parts", tmp_path / "own"
    shipped = next((PROGRAM.parents[1] / "share/stampede/tasks").rglob("reach_target.lua"))
    (own / "tasks").mkdir(parents=True)
    shutil.copy(shipped, own / "tasks" / "mine.lua")
    run = {"tasks": ["mine"], "out": out, "episodes": 2, "shards": 2, "paths": [own]}
    assert len(list(generate(**run, executor=threads))) == 2

    def refused(match: str, **other: Any) -> None:
        with pytest.raises(stampede.Error, match=match) as end:
            generate(**{**run, **other}, executor=nobody)
        assert end.value.where == str(out / "run.json") and "another folder" in end.value.hint

    refused(r"of another run: episodes is 2 there and 3 here\n", episodes=3)
    refused("seed is 0 there and 5 here", seed=5)
    refused("shards is 2 there and 4 here", shards=4)
    refused("request.randomise is not said there and true here", randomise=True)
    refused(r'tasks is \["mine"\] there and \["reach_target"\] here', tasks=["reach_target"])
    with (own / "tasks" / "mine.lua").open("a") as script:
        script.write("-- changed\n")
    refused(r"scripts\.mine is .* there and .* here\n")
    shutil.copy(shipped, own / "tasks" / "mine.lua")
    assert [part.tries for part in generate(**run, executor=nobody)] == [0, 0]
    (out / "run.json").write_text("{")
    refused("it is damaged")
    (out / "run.json").unlink()
    refused("it is not there")


def test_a_folder_with_files_of_others_is_left_as_it_is(tmp_path: Path) -> None:
    run = {"tasks": "reach_target", "shards": 1, "executor": nobody}
    (tmp_path / "run.json").write_text('{"name": "mine"}')
    (tmp_path / "part-time.half.txt").write_text("mine")
    with pytest.raises(stampede.Error, match="run.json: it is of another run"):
        generate(**run, out=tmp_path)
    assert files(tmp_path) == ["part-time.half.txt", "run.json"]
    assert (tmp_path / "run.json").read_text() == '{"name": "mine"}'
    with pytest.raises(stampede.Error, match="run.json: it is no folder"):
        generate(**run, out=tmp_path / "run.json")


def test_it_is_imported_when_it_is_asked_for_and_brings_nothing() -> None:
    script = """import sys, stampede
assert "stampede.cluster" not in sys.modules and "cluster" in dir(stampede)
assert stampede.cluster.generate.__doc__ and stampede.cluster.ray_executor.__doc__
assert not {"ray", "dask", "distributed", "submitit"} & set(sys.modules)"""
    subprocess.run([sys.executable, "-c", script], check=True)


def test_dask(whole: str, diary: Path, tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    pickle_by_value("cloudpickle")
    import dask

    told: list[Progress] = []
    with (
        dask.config.set({"distributed.scheduler.allowed-failures": 0}),  # else it tries again itself, thrice
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        executor = Through(client.get_executor(), partial(dying, diary, {2: 1}))
        parts = list(generate(**RUN, out=tmp_path / "parts", executor=executor, progress=told.append))
    assert all("KilledWorker" in now.lost for now in told if now.lost)
    tries = {part.shard: part.tries for part in parts}
    assert tries[2] == 2 and set(tries.values()) == {1, 2}  # what waited beside it for the same worker is lost with it
    check_whole(parts, whole, tmp_path)


def test_submitit(whole: str, diary: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    submitit = pytest.importorskip("submitit")
    monkeypatch.setattr(submitit.Job, "_results_timeout_s", 1, raising=False)  # 15: it waits for slow network disks
    pickle_by_value("cloudpickle")
    told: list[Progress] = []
    local = submitit.LocalExecutor(folder=tmp_path / "log")
    local.update_parameters(timeout_min=5)
    executor = Through(local, partial(dying, diary, {2: 1}))
    parts = list(generate(**RUN, out=tmp_path / "parts", executor=executor, in_flight=2, progress=told.append))
    assert ["shard 2: UncompletedJobError" in now.lost for now in told if now.lost] == [True]
    check_one_loss(parts, whole, tmp_path)


def test_ray(whole: str, diary: Path, tmp_path: Path) -> None:
    ray = pytest.importorskip("ray")
    pickle_by_value("ray.cloudpickle")
    told: list[Progress] = []
    with ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False):
        executor = Through(ray_executor(num_cpus=1), partial(dying, diary, {2: 1}))
        parts = list(generate(**RUN, out=tmp_path / "parts", executor=executor, progress=told.append))
    assert ["shard 2: WorkerCrashedError" in now.lost for now in told if now.lost] == [True]
    check_one_loss(parts, whole, tmp_path)


def pickle_by_value(pickle: str) -> None:
    """Workers of these libraries do not find this file."""
    import importlib

    importlib.import_module(pickle).register_pickle_by_value(sys.modules[__name__])


def check_one_loss(parts: list[Part], whole: str, folder: Path) -> None:
    assert {part.shard: part.tries for part in parts} == {1: 1, 2: 2, 3: 1, 4: 1}
    check_whole(parts, whole, folder)


def check_whole(parts: list[Part], whole: str, folder: Path) -> None:
    assert files(folder / "parts") == WHOLE
    assert merged_hash(parts, folder) == whole
