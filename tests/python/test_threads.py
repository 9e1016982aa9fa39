"""Python does not crash: threads that share an object, the end of the interpreter, forks, interrupts, cycles."""

from __future__ import annotations

import copy
import gc
import os
import pickle
import subprocess
import sys
import threading
import weakref
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

stampede = pytest.importorskip("stampede")

from stampede import _core  # noqa: E402

USING = "another thread is using the"


@pytest.fixture(scope="module")
def demos(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("demos") / "demos.db"
    stampede.Session(catalogue=path).run_all(["reach_target"], episodes=2, seed=3)
    return path


def together(work: Callable[[], Any], times: int = 15) -> list[BaseException]:
    """Four threads do it over and over. What they raised."""
    raised: list[BaseException] = []

    def loop() -> None:
        for _ in range(times):
            try:
                work()
            except BaseException as error:  # noqa: BLE001
                raised.append(error)

    threads = [threading.Thread(target=loop) for _ in range(4)]
    for one in threads:
        one.start()
    for one in threads:
        one.join()
    return raised


@pytest.mark.parametrize("kind", ["Env", "SkillEnv", "VectorEnv", "core", "group"])
def test_a_second_thread_is_refused(kind: str) -> None:
    if kind in ("core", "group"):
        session = stampede.Session()
        if kind == "core":
            world = session.environment("reach_target", channels=["joint_positions"])
            world.reset()
            hold = stampede.Action("hold", frames=5)
            use = lambda: (world.reset(), world.step(hold), world.skills(), world.observe())  # noqa: E731
        else:
            group = _core.environment_group(session, "reach_target", 2, 2, channels=["joint_positions"])
            use = lambda: (group.run([stampede.Reset()] * 2), group.skills(0), group.pictures("front", 1))  # noqa: E731
        raised = together(use)
        use()
    else:
        more = {"num_envs": 2, "threads": 2} if kind == "VectorEnv" else {}
        env = getattr(stampede, kind)("reach_target", **more)
        action = env.action_space.sample() if kind != "SkillEnv" else 0
        first = env.reset(seed=1)[0]
        raised = together(lambda: (env.reset(seed=1), env.step(action)))
        again = env.reset(seed=1)[0]
        assert all(np.array_equal(first[name], again[name]) for name in first)
    assert raised and all(isinstance(one, stampede.Error) for one in raised)
    assert all(USING in str(one) or "reset() first" in str(one) for one in raised)


@pytest.mark.parametrize("kind", ["Env", "SkillEnv", "VectorEnv"])
def test_to_close_what_another_thread_uses_is_refused_and_harmless(kind: str) -> None:
    more = {"num_envs": 2, "threads": 2} if kind == "VectorEnv" else {}
    env = getattr(stampede, kind)("reach_target", **more)
    raised: list[BaseException] = []
    stop = threading.Event()

    def use() -> None:
        try:
            while not stop.is_set():
                env.reset(seed=1)
        except BaseException as error:  # noqa: BLE001
            raised.append(error)

    thread = threading.Thread(target=use)
    thread.start()
    refused = 0
    while refused < 3 and thread.is_alive():
        try:
            env.close()
        except stampede.Error as error:
            refused += 1
            assert f"{kind}.close: {USING}" in str(error)
    stop.set()
    thread.join()
    env.close()
    env.close()
    assert refused == 3 or "closed" in str(raised[0])
    assert all(isinstance(one, stampede.Error) and "closed" in str(one) for one in raised)
    with pytest.raises(stampede.Error, match="closed"):
        env.reset()


def test_threads_that_share_a_session_or_a_reader_wait(demos: Path, tmp_path: Path) -> None:
    session = stampede.Session(catalogue=tmp_path / "new.db")
    keys: set[str] = set()
    assert not together(lambda: keys.add(session.run("reach_target", seed=3).key), 3)
    assert len(keys) == 1 and len(stampede.Catalogue(tmp_path / "new.db")) == 1
    reader = _core.CatalogueReader(demos)
    assert not together(lambda: (reader.query("SELECT * FROM frames"), reader.arrays(1), reader.state(1, 0)), 5)


def test_a_policy_cannot_use_the_session_that_asks_it(tmp_path: Path) -> None:
    session = stampede.Session(catalogue=tmp_path / "demos.db")
    said: list[str] = []

    class Asks:
        def act(self, observation: Any) -> None:
            try:
                session.query("SELECT 1")
            except stampede.Error as error:
                said.append(str(error))

    session.evaluate(["reach_target"], policy=Asks, episodes=2, workers=2, channels=["joint_positions"])
    assert said and all("in the midst of a call" in one for one in said)


# The end of the interpreter.

LOOPS = {
    "catalogue": "c = stampede.Catalogue(sys.argv[1])\n"
    "work = lambda: (list(c.demos()), c.query('SELECT * FROM frames'))",
    "env": "e = threading.local()\ndef work():\n    e.e = getattr(e, 'e', None) or stampede.Env('reach_target')\n"
    "    e.e.reset(seed=1); e.e.step(e.e.action_space.sample())",
    "vector": "e = threading.local()\ndef work():\n"
    "    e.e = getattr(e, 'e', None) or stampede.VectorEnv('reach_target', 2)\n"
    "    e.e.reset(seed=1); e.e.step(e.e.action_space.sample())",
    "evaluate": "class P:\n    def act(self, o): return stampede.Action('joint_delta', [0.01] * 7)\n"
    "def work(): stampede.Session().evaluate(['reach_target'], policy=P, episodes=4, workers=2, channels=['time'])",
    "run_all": "def work(): stampede.Session().run_all(['reach_target'], episodes=4, workers=2, sink=lambda e: None)",
}


def python(code: str, *arguments: str) -> subprocess.CompletedProcess:
    command = [sys.executable, "-X", "dev", "-W", "ignore", "-c", code, *arguments]
    checked = {**os.environ, "PYTHONMALLOC": "debug"}
    return subprocess.run(command, capture_output=True, text=True, timeout=120, env=checked)


@pytest.mark.parametrize("what", LOOPS)
def test_daemon_threads_do_not_disturb_the_end(what: str, demos: Path) -> None:
    code = f"""
import stampede, sys, threading, time
{LOOPS[what]}
def loop():
    while True: work()
for _ in range(3): threading.Thread(target=loop, daemon=True).start()
time.sleep(1.5)
print("leaving")
sys.exit(3)
"""
    done = python(code, str(demos))
    assert (done.returncode, done.stdout, done.stderr) == (3, "leaving\n", "")


def test_what_is_called_while_the_interpreter_ends(demos: Path) -> None:
    code = """
import atexit, sys
atexit.register(lambda: print(len(catalogue) > 0, session.run("reach_target", seed=3).success))
import stampede
catalogue, session = stampede.Catalogue(sys.argv[1]), stampede.Session()
"""
    done = python(code, str(demos))
    assert (done.returncode, done.stdout, done.stderr) == (0, "True True\n", "")


def in_a_fork(work: Callable[[], None]) -> int:
    child = os.fork()
    if child == 0:
        code = 1
        try:
            work()
            code = 0
        finally:
            os._exit(code)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def test_forks(demos: Path) -> None:
    catalogue = stampede.Catalogue(demos)
    reader = catalogue._reader
    picture = catalogue[1].picture(0, width=16, height=16)["rgb"]
    env, many = stampede.Env("reach_target", render_mode="rgb_array"), stampede.VectorEnv("reach_target", 2, threads=2)
    first = env.reset(seed=1)[0]
    many.reset(seed=1)
    session = stampede.Session(catalogue=demos)
    session.run("reach_target", seed=3)
    count = len(catalogue)

    def child() -> None:
        assert np.array_equal(catalogue[1].picture(0, width=16, height=16)["rgb"], picture)
        again = env.reset(seed=1)[0]
        assert all(np.array_equal(first[name], again[name]) for name in first) and env.render() is not None
        refused = "this process was forked .*\n    make another one in this process"
        for use in (lambda: many.reset(seed=1), lambda: reader.arrays(1), lambda: session.run("reach_target", seed=3)):
            with pytest.raises(stampede.Error, match=refused):
                use()
        more = stampede.VectorEnv("reach_target", 2, threads=2)
        more.reset(seed=1)
        copy.deepcopy(env).reset(seed=1)

    assert in_a_fork(child) == 0
    assert len(catalogue) == count and many.reset(seed=1)


def test_a_subinterpreter_is_refused() -> None:
    code = """
try:
    import _interpreters as interpreters
except ImportError:
    import _xxsubinterpreters as interpreters
import sys
other = interpreters.create()
interpreters.run_string(other, '''
import sys
sys.path[:] = %r
try:
    import stampede
except ImportError as error:
    print(error, flush=True)
''' % sys.path)
"""
    done = python(code)
    assert done.returncode == 0 and "main interpreter alone" in done.stdout, done.stderr


# Interrupts



class Stops:
    """Acts, and then is interrupted."""

    kind: type[BaseException] = KeyboardInterrupt
    calls = 0
    after = 0

    def act(self, observation: Any) -> stampede.Action:
        type(self).calls += 1
        if type(self).calls > self.after:
            raise self.kind("now")
        return stampede.Action("joint_delta", np.full(7, 0.001))


def with_policy(folder: Path, policy: type, **other: Any) -> stampede.Session:
    """A session in which the skill `reach` is this policy."""
    (folder / "skills").mkdir(exist_ok=True)
    shipped = Path(_core.__file__).parent
    source = next(p for p in (shipped / "engine/share/stampede/skills").rglob("reach.lua")).read_text()
    body = source[source.index("run =") :]
    body = body[: body.index("end,") + len("end,")]
    (folder / "skills" / "reach.lua").write_text(source.replace(body, 'run = policy("stops"),'))
    session = stampede.Session(paths=[folder], **other)
    session.add_policy("stops", policy, channels=["joint_positions"])
    return session


@pytest.mark.parametrize("kind", [KeyboardInterrupt, SystemExit, GeneratorExit])
def test_an_interrupt_in_a_policy_ends_the_run(kind: type[BaseException], tmp_path: Path) -> None:
    class Policy(Stops):
        pass

    Policy.kind = kind
    session = with_policy(tmp_path, Policy, catalogue=tmp_path / "demos.db")
    with pytest.raises(kind, match="now"):
        session.run("reach_target", seed=4)
    assert Policy.calls == 1
    for workers in (1, 2):
        Policy.calls = 0
        with pytest.raises(kind, match="now"):
            session.run_all(["reach_target"], episodes=6, workers=workers)
        assert Policy.calls <= workers
    with pytest.raises(kind, match="now"):
        session.evaluate(["reach_target"], policy=Policy, episodes=4, workers=2, channels=["joint_positions"])
    world = session.environment("reach_target")
    world.reset(stampede.Reset(seed=4))
    call = next(one for one in world.skills() if one.feasible and one.skill == "reach")
    with pytest.raises(kind, match="now"):
        world.step(stampede.Action.skill_call(call.skill, call.arguments))
    with pytest.raises(stampede.Error, match=r"reset\(\) first"):
        world.step(stampede.Action("hold"))
    world.reset(stampede.Reset(seed=4))
    assert not Path(tmp_path / "demos.db").exists() or len(stampede.Catalogue(tmp_path / "demos.db")) == 0
    session.add_sensor("broken", lambda now: Policy().act(now), ["x"])
    with pytest.raises(kind, match="now"):
        session.run("push_button", seed=1)


def test_what_was_finished_before_an_interrupt_is_kept(tmp_path: Path) -> None:
    class Policy(Stops):
        pass

    Policy.after = 100
    session = stampede.Session(catalogue=tmp_path / "demos.db")
    settings = {"channels": ["joint_positions"], "horizon_s": 2.0}  # 40 frames an episode
    with pytest.raises(KeyboardInterrupt, match="now"):
        session.evaluate(["reach_target"], policy=Policy, episodes=9, **settings)
    kept = stampede.Catalogue(tmp_path / "demos.db").episodes()
    assert len(kept) == 2 and all(one.reason == "timeout" for one in kept)


def test_a_session_and_its_policy_are_collected(tmp_path: Path) -> None:
    class Mark:
        pass

    def make(keep_environment: bool) -> tuple[weakref.ref, Any]:
        session, mark = stampede.Session(), Mark()
        session.add_policy("p", lambda: (session, mark))
        session.add_sensor("s", lambda now: [float(session is not None and mark is not None)], ["x"])
        world = session.environment("reach_target", channels=["sensor/s"])
        mark.world = world  # a longer way around
        return weakref.ref(mark), world if keep_environment else None

    gone, _ = make(False)
    gc.collect()
    assert gone() is None
    there, world = make(True)
    gc.collect()
    world.reset()
    assert there() is not None
    assert world.step(stampede.Action("hold", frames=2)).observation["sensor/s"][0] == 1.0
    del world
    gc.collect()
    assert there() is None


def test_environments_are_copied_by_their_arguments() -> None:
    for env in (
        stampede.Env("reach_target", action="tool_delta", reward="dense", variation="colour=red"),
        stampede.SkillEnv("reach_target", parameters=True),
        stampede.VectorEnv("reach_target", 2, action="tool_delta"),
    ):
        first = env.reset(seed=5)[0]
        for other in (copy.deepcopy(env), pickle.loads(pickle.dumps(env))):
            assert type(other) is type(env) and other.action_space == env.action_space and repr(other) == repr(env)
            again = other.reset(seed=5)[0]
            assert all(np.array_equal(first[name], again[name]) for name in first)
