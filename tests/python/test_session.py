"""Sessions from Python: runs, sinks, policies as skills, sensors, evaluation, interruption."""

from __future__ import annotations

import itertools
import os
import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import stampede


def test_a_run_is_the_same_bits_in_any_session(tmp_path: Path) -> None:
    one = stampede.Session().run("reach_target", seed=3)
    again = stampede.Session().run("reach_target", seed=3)
    a, b = (stampede.Session().arrays(episode) for episode in (one, again))
    assert one.success and one.key == again.key
    assert all(np.array_equal(a[name], b[name], equal_nan=True) for name in a.keys() if a[name].dtype == np.float64)
    stored = stampede.Session(catalogue=tmp_path / "demos.db").run("reach_target", seed=3)
    assert stored.id == 1 and stored.key == one.key


@pytest.mark.parametrize(
    ("request_", "kind", "words"),
    [
        ({"seed": 2**70}, stampede.Error, r"run\(seed=\): 1180591620717411303424 is too large"),
        ({"seed": 10**5000}, stampede.Error, r"run\(seed=\): a value of type int is too large"),
        ({"skills": 2**40}, stampede.Error, r"run\(skills=\): 1099511627776 is too large"),
        ({"variation": "\ud800"}, stampede.Error, r"run\(variation=\): '\\ud800' is no text that UTF-8 has"),
        ({"\ud800": 1}, stampede.Error, r"run: '\\ud800' is no text that UTF-8 has"),
        ({"seed": "7"}, TypeError, r"run\(seed=\) cannot be '7', of type str"),
        ({"seed": 1.5}, TypeError, r"run\(seed=\) cannot be 1.5, of type float"),
        ({"variation": 7}, TypeError, r"run\(variation=\) cannot be 7, of type int"),
        ({"on_failure": 7}, TypeError, r"run\(on_failure=\) cannot be 7, of type int"),
        ({"pictures": 7}, TypeError, r"run\(pictures=\) cannot be 7, of type int"),
        ({"pictures": {"width": "x"}}, TypeError, r"run\(pictures=\) cannot be {'width': 'x'}, of type dict"),
    ],
)
def test_arguments_that_do_not_fit_are_told_by_name(request_: dict[str, object], kind: type, words: str) -> None:
    with pytest.raises(kind, match=words):
        stampede.Session().run("reach_target", **request_)


def test_a_sink_gets_episodes_in_order_whatever_the_workers() -> None:
    session = stampede.Session()
    kept: list[tuple[int, float]] = []

    def keep(episode: stampede.Episode) -> None:
        kept.append((episode.seed, float(session.arrays(episode, ["joint_positions"])["joint_positions"].sum())))

    tally = session.run_all(["reach_target"], episodes=4, seed=5, workers=2, sink=keep)
    assert tally.finished == 4 and tally.tasks["reach_target"].episodes == 4
    two, kept = kept, []
    session.run_all(["reach_target"], episodes=4, seed=5, workers=1, sink=keep)
    assert kept == two and len(two) == 4


def test_what_a_sink_raises_ends_the_run() -> None:
    def fail(episode: stampede.Episode) -> None:
        raise KeyError("full")

    with pytest.raises(KeyError, match="full"):
        stampede.Session().run_all(["reach_target"], episodes=3, sink=fail)


def test_ctrl_c_ends_a_run_and_keeps_what_is_finished(tmp_path: Path) -> None:
    session = stampede.Session(catalogue=tmp_path / "demos.db")

    def press(episode: stampede.Episode, done: int, total: int) -> None:
        if done == 2:
            threading.Timer(0.01, os.kill, (os.getpid(), signal.SIGINT)).start()

    signal.signal(signal.SIGINT, signal.default_int_handler)  # what a shell began in the background ignores it
    with pytest.raises(KeyboardInterrupt):
        session.run_all(["reach_target"], episodes=40, progress=press)
    kept = len(stampede.Catalogue(tmp_path / "demos.db"))
    assert 2 <= kept < 40
    rest = session.run_all(["reach_target"], episodes=40)
    assert rest.existing == kept and rest.finished == 40 - kept


# A plan that takes long: one tower of many blocks in another order.
def hard_problem() -> tuple[str, str]:
    domain = """(define (domain d) (:requirements :strips)
      (:predicates (on ?a ?b) (clear ?a) (hold ?a) (empty) (tab ?a))
      (:action pick :parameters (?a) :precondition (and (clear ?a) (tab ?a) (empty))
       :effect (and (hold ?a) (not (empty)) (not (tab ?a)) (not (clear ?a))))
      (:action put :parameters (?a) :precondition (hold ?a)
       :effect (and (not (hold ?a)) (empty) (tab ?a) (clear ?a)))
      (:action stack :parameters (?a ?b) :precondition (and (hold ?a) (clear ?b))
       :effect (and (not (hold ?a)) (empty) (on ?a ?b) (clear ?a) (not (clear ?b))))
      (:action unstack :parameters (?a ?b) :precondition (and (on ?a ?b) (clear ?a) (empty))
       :effect (and (hold ?a) (clear ?b) (not (on ?a ?b)) (not (clear ?a)) (not (empty)))))"""
    count = 150
    order = sorted(range(count), key=lambda i: (i * 7919) % 1009)
    blocks = " ".join(f"b{i}" for i in range(count))
    start = " ".join(f"(on b{a} b{b})" for a, b in itertools.pairwise(range(count)))
    goal = " ".join(f"(on b{a} b{b})" for a, b in itertools.pairwise(order))
    problem = (
        f"(define (problem p) (:domain d) (:objects {blocks}) "
        f"(:init (empty) (clear b0) (tab b{count - 1}) {start}) (:goal (and {goal})))"
    )
    return domain, problem


def test_ctrl_c_ends_whatever_takes_long_at_once(tmp_path: Path) -> None:
    file = tmp_path / "demos.db"
    session = stampede.Session(catalogue=file)
    session.run("reach_target", seed=1)
    endless = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT count(*) FROM n"
    domain, problem = hard_problem()
    world = stampede.Session().environment("stack_blocks")
    world.reset(stampede.Reset(seed=1))
    step = stampede.Session().plan("stack_blocks", seed=1).steps[0]

    def run_on() -> None:
        for seed in range(1000):
            session.run("stack_blocks", seed=seed)

    def reset_on() -> None:
        for seed in range(1000):
            world.reset(stampede.Reset(seed=seed))

    def step_on() -> None:
        state = world.save()
        for _ in range(1000):
            world.restore(state)
            world.step(stampede.Action.skill_call(step.action, list(step.arguments)))

    signal.signal(signal.SIGINT, signal.default_int_handler)
    long: list[Callable[[], object]] = [
        lambda: session.query(endless),
        lambda: stampede.Catalogue(file).query(endless),
        lambda: stampede.plan_pddl(domain, problem),
        run_on,
        step_on,
        reset_on,
    ]
    for one in long:
        pressed: list[float] = []

        def press(pressed: list[float] = pressed) -> None:
            pressed.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        threading.Timer(0.5, press).start()
        with pytest.raises(KeyboardInterrupt):
            one()
        assert time.monotonic() - pressed[0] < 0.5  # 0.2 s where nobody else wants the processor
    stored = stampede.Catalogue(file).episodes()
    assert all(episode.reason == "none" or not episode.success for episode in stored)
    assert session.run("reach_target", seed=1).success


class TowardsTarget:
    """Moves the tool straight to the place that it is called with."""

    def begin(self, call: stampede.PolicyCall) -> None:
        self.place = call.arguments["place"]

    def act(self, observation: dict[str, np.ndarray]) -> stampede.Action | None:
        tool = observation["gripper_pose"]
        way = observation[f"object_pose/{self.place}"][:3] - tool[:3]
        if np.linalg.norm(way) < 0.01:
            return None
        step = way * min(1.0, 0.04 / np.linalg.norm(way))
        return stampede.Action("tool_delta", [*step, 0, 0, 0])


def test_a_policy_is_the_body_of_a_labelled_skill(tmp_path: Path) -> None:
    (tmp_path / "skills").mkdir()
    shipped = Path(stampede._core.__file__).parent
    source = next(p for p in (shipped / "engine/share/stampede/skills").rglob("reach.lua")).read_text()
    body = source[source.index("run =") :]
    end = body.index("end,") + len("end,")
    (tmp_path / "skills" / "reach.lua").write_text(source.replace(body[:end], 'run = policy("towards"),'))
    session = stampede.Session(paths=[tmp_path])
    session.add_policy("towards", TowardsTarget, channels=["gripper_pose", "object_pose"])
    episode = session.run("reach_target", seed=4)
    assert episode.success
    arrays = session.arrays(episode)
    skill = next(s for s in arrays.segments if s.kind == "skill")
    assert skill.name == "reach" and skill.success
    assert "policy" in {s.name for s in arrays.segments if s.kind == "motion"}
    assert len(arrays.agent_actions) > 3 and arrays.agent_actions[0].asked.space == "tool_delta"


class PicksFromAbove:
    """Turns the hand down over the thing, closes it, and lifts."""

    def begin(self, call: stampede.PolicyCall) -> None:
        self.thing, self.frame, self.place = call.arguments["obj"], 0, None

    def act(self, observation: dict[str, np.ndarray]) -> stampede.Action | None:
        if self.place is None:
            self.place = observation[f"object_pose/{self.thing}"][:3].copy()
            x, y, z, w = observation[f"object_pose/{self.thing}"][3:]
            self.turn = [w, z, -y, -x]  # the thing's, and then half a turn about its own x
        self.frame += 1
        if self.frame > 140:
            return None
        height = 0.12 if self.frame < 45 or self.frame > 110 else 0.0
        opening = 0.08 if self.frame < 85 else 0.0
        pose = [*(self.place + [0, 0, height]), *self.turn]
        return stampede.Action("tool_pose", pose, gripper=opening)


def test_what_a_policy_took_is_in_the_hand_for_the_skill_that_follows(tmp_path: Path) -> None:
    (tmp_path / "skills").mkdir()
    (tmp_path / "skills" / "pick.lua").write_text(
        '''-- Take it from above.
return skill {
  label = "pick up the {obj}",
  params = { "obj: movable & graspable", "from: support" },
  precondition = { is.hand_empty(), is.on("obj", "from") },
  effect = { is.holding("obj"), is_not.hand_empty(), is_not.on("obj", "from"), is.lifted("obj") },
  run = policy("from_above", { until_effect = false }),
}'''
    )
    session = stampede.Session(paths=[tmp_path])
    session.add_policy("from_above", PicksFromAbove, channels=["object_pose"])
    episode = session.run("pick_and_lift", seed=4, on_failure="stop")
    assert episode.success, episode.reason


def test_a_policy_that_fails_is_a_failed_episode_with_its_words() -> None:
    class Broken:
        def act(self, observation: dict[str, np.ndarray]) -> None:
            raise RuntimeError("no weights")

    class Wrong:
        def act(self, observation: dict[str, np.ndarray]) -> int:
            return 3

    session = stampede.Session()
    for policy in (Broken, Wrong):
        rows = session.evaluate(["reach_target"], policy=policy, episodes=2, channels=["gripper_pose"]).rows
        assert rows[0].succeeded == 0 and rows[0].reasons == {"policy_error": 2}


def test_an_evaluation_has_intervals_and_perturbations(tmp_path: Path) -> None:
    session = stampede.Session(catalogue=tmp_path / "evaluation.db")
    rows = session.evaluate(["reach_target"], episodes=3, perturb=["camera"]).rows
    whole = {row.perturbation: row for row in rows if row.task == "reach_target" and not row.axis}
    assert set(whole) == {"none", "camera=1"}
    assert whole["none"].episodes == 3 and whole["none"].lower < whole["none"].success <= whole["none"].upper
    assert len(stampede.Catalogue(tmp_path / "evaluation.db")) == 6
    with pytest.raises(stampede.Error, match="camera"):
        session.evaluate(["reach_target"], perturb=["camra"])


def test_a_sensor_is_a_column_and_a_channel() -> None:
    session = stampede.Session()

    def height(now: stampede._core.SimulatorView) -> list[float]:
        return [now.pose("panda.hand").position[2]]

    session.add_sensor("height", height, ["z"], unit="m", rate_hz=20)
    episode = session.run("reach_target", seed=2)
    arrays = session.arrays(episode)
    assert arrays["sensor/height"].shape[1] == 1 and arrays.column("sensor/height").unit == "m"
    assert np.allclose(arrays["sensor/height"][-1, 0], arrays["gripper_pose"][-1, 2], atol=0.02)
    session.add_sensor("height", lambda now: [now.joint_position("panda.joint99")], ["z"])
    assert session.run("reach_target", seed=2).reason == "sensor_error"


def test_plans_states_pictures_and_points() -> None:
    session = stampede.Session()
    plan = session.plan("put_item_in_drawer", seed=1)
    assert plan.found and [step.action for step in plan.steps][0].startswith("open")
    again = stampede.plan_pddl(plan.domain, plan.problem)
    assert again.found
    with pytest.raises(stampede.Error):
        stampede.plan_pddl("(define", plan.problem)

    episode = session.run("pick_and_lift", seed=1)
    state = session.state(episode, 0)
    assert any(str(fact) == "(hand_empty panda.hand)" for fact in state.facts)
    assert session.picture(episode, 0, width=40, height=30, depth=True)["depth"].shape == (30, 40)
    points = session.points(episode, 0, width=40, height=30, mask=True)
    assert points["positions"].shape == points["colours"].shape and len(points["mask"]) == len(points["positions"])
    with pytest.raises(stampede.Error, match="no frame"):
        session.picture(episode, 10_000)


def test_saved_states_branch_bit_for_bit() -> None:
    world = stampede.Session().environment("pick_and_lift", channels=["joint_positions", "object_pose"])
    world.reset(stampede.Reset(seed=1))
    saved = world.save()
    ways = []
    for _ in range(2):
        world.restore(saved)
        for _ in range(5):
            step = world.step(stampede.Action("joint_delta", np.full(7, 0.02), gripper=0.0))
        ways.append(step.observation)
    assert all(np.array_equal(ways[0][name], ways[1][name], equal_nan=True) for name in ways[0])
    refused = world.step(stampede.Action("joint_delta", [0.1]))
    assert refused.refusal and refused.frames == 0
    with pytest.raises(TypeError, match="list of numbers"):
        stampede.Action("joint_delta", "text")


def test_a_saved_state_begins_a_fresh_environment() -> None:
    session = stampede.Session()
    first = session.environment("pick_and_lift", channels=["joint_positions"])
    spaces = [space.name for space in first.spaces()]
    assert "joint_delta" in spaces and first.frame_hz == 20 and first.skill_descriptions()
    first.reset(stampede.Reset(seed=1))
    assert [space.name for space in first.spaces()] == spaces
    first.step(stampede.Action("joint_delta", np.full(7, 0.02)))
    saved = first.save()
    wanted = first.step(stampede.Action("joint_delta", np.full(7, 0.02))).observation["joint_positions"]
    for begin in ("reset", "restore"):
        fresh = session.environment("pick_and_lift", channels=["joint_positions"])
        getattr(fresh, begin)(saved)
        now = fresh.step(stampede.Action("joint_delta", np.full(7, 0.02))).observation["joint_positions"]
        assert np.array_equal(now, wanted)


def test_what_an_environment_says_of_itself() -> None:
    channels = ["joint_positions", "front_rgb", "front_camera_intrinsics"]
    world = stampede.Session().environment("pick_and_lift", channels=channels, width=40, height=30, horizon_s=7)
    now = world.reset(stampede.Reset(seed=1))
    assert world.frame_hz == 20 and world.horizon_s == 7
    assert world.labels()["joint_positions"][0] == "panda.joint1"
    assert any("cube" in text or "block" in text for text in world.instructions())
    assert now["front_rgb"].shape == (30, 40, 3)
    assert now["front_camera_intrinsics"][:2, 2].tolist() == [20, 15]  # of the pictures, not of the camera's own size
    assert stampede.Action("hold") == stampede.Action("hold") and stampede.Action("hold") != 3


def test_motions_stop_at_their_via_points_where_that_is_set() -> None:
    """A stop: the arm stands for a frame or more, and moves before and after."""

    def stops(**settings: list[str]) -> int:
        session = stampede.Session()
        arrays = session.arrays(session.run("pick_and_lift", seed=3, **settings))
        still = np.abs(arrays["joint_velocities"]).max(axis=1) < 0.1
        return int((still[1:] & ~still[:-1]).sum())

    assert stops(set=["motion.stop_at_vias=1"]) > stops()
    assert stops(set=["motion.stop_at_vias=0"]) == stops()
    for setting, message in (
        ("motion.stop_at_vias=2", "motion.stop_at_vias is 0 or 1"),
        ("motion.stop_at_via=1", "motions have no parameter 'stop_at_via'"),
        ("motion.controller=joint_impedance", "motions have no controller"),
    ):
        with pytest.raises(stampede.Error, match=message):
            stampede.Session().run("pick_and_lift", seed=3, set=[setting])
