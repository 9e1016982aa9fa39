"""Env and SkillEnv: spaces, seeds, refusals, ends, records."""

import copy
import pickle

import gymnasium
import numpy as np
import pytest

import stampede
from stampede import _core
from stampede.envs import Env, SkillEnv
from stampede.envs.spaces import ObservationCodec, box_within
from stampede.envs.starts import SPLIT_SEEDS

TASKS = _core.Session().tasks()


def equal(one, other):
    return one.keys() == other.keys() and all(np.array_equal(one[name], other[name]) for name in one)


def test_all_shipped_tasks_are_registered():
    assert {f"stampede/{task}" for task in TASKS} <= set(gymnasium.registry)
    assert {f"stampede-skills/{task}" for task in TASKS} <= set(gymnasium.registry)


def test_seed_gives_the_same_bits():
    def episode(seed):
        env = Env("stack_blocks")
        env.action_space.seed(1)
        observation, info = env.reset(seed=seed)
        results = [(observation, info)] + [env.step(env.action_space.sample()) for _ in range(5)]
        second, later = env.reset()
        return results, second, later

    one, other, third = episode(7), episode(7), episode(8)
    for a, b in zip(one[0], other[0], strict=True):
        assert equal(a[0], b[0])
        assert a[1:] == b[1:]
    assert equal(one[1], other[1])
    assert one[2] == other[2]
    assert not equal(one[0][0][0], third[0][0][0])


def test_a_seed_is_the_engines_and_splits_share_none():
    train, test = Env("reach_target"), Env("reach_target", split="test")
    assert train.reset(seed=7)[1]["seed"] == 7
    assert test.reset(seed=7)[1]["seed"] == SPLIT_SEEDS + 7
    assert all(train.reset()[1]["seed"] < SPLIT_SEEDS <= test.reset()[1]["seed"] for _ in range(3))
    engine = train.session.environment("reach_target")
    observation, info = train.reset(seed=7)
    start = engine.reset(_core.Reset(variation=info["variation"], seed=7))
    assert np.array_equal(observation["task_low_dim_state"], np.nan_to_num(start["task_low_dim_state"]))


def test_variations_are_drawn_among_those_asked_for():
    env = Env("stack_blocks", variation="height=3")
    drawn = {env.reset(seed=seed)[1]["variation"] for seed in range(6)}
    assert len(drawn) > 1
    assert all("height=3" in text for text in drawn)
    assert env.reset(options={"variation": "height=2,colour=red"})[1]["variation"] == "colour=red,height=2"


def test_options_say_what_start():
    env = Env("stack_blocks", observations=("fact_names",))
    _, info = env.reset(options={"seed": 1_000_003, "variation": "colour=red,height=3", "where": "(on block1 block2)"})
    assert info["seed"] == 1_000_003
    assert "(on block1 block2)" in info["fact_names"]
    with pytest.raises(_core.Error, match="did you mean 'variation'"):
        env.reset(options={"variatoin": "x"})
    with pytest.raises(_core.Error, match="without an episode"):
        env.reset(options={"frame": 3})


def test_a_start_that_cannot_be_made_says_so_where_it_was_named():
    env = Env("reach_target")
    with pytest.raises(_core.Error, match="no start was found"):
        env.reset(options={"seed": 1, "where": "(at panda.hand target)"})
    with pytest.raises(_core.Error, match="no episode is under way"):
        env.step(env.action_space.sample())


def test_a_drawn_start_that_cannot_be_made_gives_way_to_the_next():
    env = Env("reach_target")
    starts, asked = env._starts, []

    def reset(request):
        asked.append(request.seed)
        if len(asked) < 3:
            error = _core.Error("reach_target: no start")
            error.where = "reach_target"
            raise error
        return "began"

    start, answer = starts.begin(np.random.default_rng(0), 7, {}, reset)
    assert answer == "began"
    assert asked[0] == 7
    assert start.seed == asked[-1]
    assert len(set(asked)) == 3


def test_unknown_names_have_a_cure():
    with pytest.raises(_core.Error, match="did you mean 'stack_blocks'"):
        Env("stack_block")
    with pytest.raises(_core.Error, match="did you mean 'joint_delta'"):
        Env("reach_target", action="joint_delt")
    with pytest.raises(_core.Error, match="SkillEnv acts by skills"):
        Env("reach_target", action="skill")
    with pytest.raises(_core.Error, match="no such channel"):
        Env("reach_target", observations=("joint_pos",))
    with pytest.raises(_core.Error, match="variation of task"):
        Env("reach_target", variation="colour=rainbow")
    with pytest.raises(_core.Error, match="train, test"):
        Env("reach_target", split="validation")
    with pytest.raises(_core.Error, match="rgb_array"):
        Env("reach_target", render_mode="human")
    with pytest.raises(_core.Error, match="sparse, dense, task"):
        Env("reach_target", reward="shaped")


def test_a_refused_action_changes_nothing_and_ends_at_the_horizon():
    env = Env("reach_target", reward="dense", horizon_s=0.5)
    observation, _ = env.reset(seed=1)
    beyond = env.action_space.high * 2
    for count in range(1, 11):
        now, reward, terminated, truncated, info = env.step(beyond)
        assert equal(now, observation)
        assert reward == 0
        assert "panda.joint1 is out of its bounds" in info["refusal"]
        assert not terminated
        assert truncated == (count == 10)  # 0.5 s at 20 Hz
    assert info["reason"] == "timeout"
    assert info["is_success"] is False


def test_frames_and_refused_steps_fill_the_horizon_together():
    env = Env("reach_target", horizon_s=0.5)
    env.reset(seed=1)
    rest, beyond = np.zeros(8, np.float32), env.action_space.high * 2
    ends = [env.step(beyond if i % 2 else rest)[3] for i in range(10)]
    assert ends == [False] * 9 + [True]


def test_after_the_end_nothing_is_done():
    env = Env("reach_target", horizon_s=0.1)
    env.reset(seed=1)
    rest = np.zeros(8, np.float32)
    while not (result := env.step(rest))[3]:
        pass
    after = env.step(rest)
    assert equal(after[0], result[0])
    assert after[1:4] == (0.0, False, True)
    assert "call reset()" in after[4]["refusal"]


def test_any_space_at_any_step():
    env = Env("pick_up_cup", action="joint_velocity", variation="colour=red")
    env.reset(seed=3)
    env.step(np.zeros(8, np.float32))
    result = env.step(_core.Action.skill_call("pick", ["cup", "table", "panda.hand"]))
    assert "(holding panda.hand cup)" in result[4]["changes"]
    assert result[4]["duration"] > 1
    for _ in range(40):
        if result[2]:
            break
        result = env.step(_core.Action("joint_delta", np.zeros(7)))
    assert result[1:3] == (1.0, True)
    assert result[4]["is_success"] is True


def test_an_arm_that_gets_back_to_its_way_makes_its_tool_no_faster():
    # It comes to the stop of its elbow, its motors bear no more, and it falls behind what it is led by.
    env = Env("open_jar", action="tool_velocity", horizon_s=10, hidden=True)
    draw = np.random.default_rng([0, 200])
    env.reset(seed=0)
    over, before, held, fastest = False, None, 0, 0.0
    while not over:
        if held == 0:
            low, high = env.action_space.low, env.action_space.high
            action, held = low + draw.random(env.action_space.shape) * (high - low), int(draw.integers(1, 20))
        held -= 1
        seen, _, ended, cut, _ = env.step(action.astype(env.action_space.dtype))
        over, place = ended or cut, seen["gripper_pose"][:3]
        fastest = max(fastest, 0.0 if before is None else float(np.linalg.norm(place - before)) * 20)
        before = place
    env.close()
    assert 1.5 < fastest < 1.67


def test_actions_have_names_units_and_true_bounds():
    env = Env("reach_target", action="tool_impedance")
    assert env.action_names == ["x", "y", "z", "qx", "qy", "qz", "qw", "stiffness", "gripper"]
    assert env.action_units[-2:] == ["N/m", "m"]
    assert Env("reach_target", action="gripper").action_names == ["opening"]
    assert Env("reach_target", gripper=False).action_space.shape == (7,)
    for action in ("joint_position", "joint_velocity", "joint_torque"):
        env = Env("reach_target", action=action)
        for corner in (env.action_space.low, env.action_space.high):
            env.reset(seed=1)
            assert "refusal" not in env.step(corner)[4]
    with pytest.raises(_core.Error, match=r"has shape \(8,\), not \(7,\)"):
        env.step(np.zeros(7))


def test_boxes_lie_within_their_bounds():
    rng = np.random.default_rng(0)
    lower = rng.normal(size=200)
    upper = lower + rng.uniform(0.1, 1, 200)
    box = box_within(lower, upper)
    assert (box.low.astype(np.float64) >= lower).all()
    assert (box.high.astype(np.float64) <= upper).all()
    assert np.allclose(box.low, lower, rtol=1e-6, atol=1e-6)


def test_normalised_actions_span_the_same_bounds():
    plain, unit = Env("reach_target"), Env("reach_target", normalise_actions=True)
    assert (unit.action_space.low, unit.action_space.high) == (pytest.approx(-1), pytest.approx(1))
    asked = unit._actions(np.array([1, -1, 0, 0, 0, 0, 0, 0.5]))
    assert asked.values[0] == pytest.approx(plain.action_space.high[0])
    assert asked.values[1] == pytest.approx(plain.action_space.low[1])
    assert asked.values[2:] == pytest.approx([0] * 5)
    assert asked.gripper == pytest.approx(0.06)


def test_what_is_unknown_is_zero():
    channels = ("object_pose/item", "facts", "sensor")
    hidden = Env("find_item_in_drawer", observations=channels)
    observation, _ = hidden.reset(seed=1)
    assert np.array_equal(observation["object_pose/item"], np.zeros(7))
    raw = hidden.session.environment("find_item_in_drawer", channels=list(channels)).reset()
    assert np.isnan(raw["object_pose/item"]).all()
    seen, _ = Env("find_item_in_drawer", observations=channels, hidden=True).reset(seed=1)
    assert np.linalg.norm(seen["object_pose/item"][3:]) == pytest.approx(1)
    assert observation["facts"].dtype == np.int8


def test_another_shape_names_the_cure():
    codec = ObservationCodec({"a": np.zeros(3)})
    with pytest.raises(_core.Error, match="variation="):
        codec.check({"a": np.zeros(4)})
    with pytest.raises(_core.Error, match="variation="):
        codec.check({"a": np.zeros(3), "b": np.zeros(1)})


def test_texts_are_info():
    env = Env("reach_target", observations=("joint_positions", "sentences", "plan"))
    observation, info = env.reset(seed=1)
    assert list(observation) == ["joint_positions"]
    assert info["plan"] == ["(reach target panda.hand)"]
    assert env.step(np.zeros(8))[4]["sentences"] == info["sentences"]


def test_components_have_labels():
    labels = Env("pick_up_cup", observations=("joint_positions", "task_low_dim_state", "facts")).observation_labels
    assert labels["joint_positions"][0] == "panda.joint1"
    assert len(labels["task_low_dim_state"]) == 35
    assert "(hand_empty panda.hand)" in labels["facts"]


def test_render_is_what_the_camera_sees():
    env = Env("reach_target", render_mode="rgb_array", camera="wrist", image_size=(48, 64))
    assert "wrist_rgb" not in env.observation_space.spaces
    env.reset(seed=1)
    picture = env.render()
    assert picture.shape == (48, 64, 3)
    assert picture.dtype == np.uint8
    assert picture.std() > 1
    with pytest.raises(_core.Error, match="did you mean 'wrist'"):
        Env("reach_target", render_mode="rgb_array", camera="wrst")
    assert Env("reach_target").metadata["render_fps"] == 20


def test_an_episode_that_was_kept_can_be_drawn():
    env = Env("reach_target", render_mode="rgb_array", image_size=32, record=True, horizon_s=0.1)
    env.reset(seed=1)
    over = False
    while not over:
        _, _, _, over, _ = env.step(env.action_space.high)
    assert env.render().std() > 1


def test_goal_says_what_is_wanted_next():
    env = SkillEnv("push_buttons", variation="count=3", observations=("facts", "goal"))
    observation, _ = env.reset(seed=1)
    atoms = env.observation_labels["goal"]
    assert atoms == env.observation_labels["facts"]
    assert observation["goal"].shape == observation["facts"].shape
    for button in ("button1", "button2", "button3"):
        wanted = [atom for atom, sign in zip(atoms, observation["goal"], strict=True) if sign]
        at_the_end = ["(hand_empty panda.hand)"] if button == "button3" else []
        assert wanted == [*at_the_end, f"(pressed {button}.cap)"]
        observation, *_ = env.step(env.skill_names.index(f"press({button}.cap, panda.hand)"))


def test_save_and_restore_branch():
    env = Env("reach_target")
    env.reset(seed=1)
    env.step(env.action_space.high)
    saved = env.save()
    first = env.step(env.action_space.low)
    now, info = env.restore(saved)
    assert env.observation_space.contains(now)
    assert info["seed"] == 1
    second = env.step(env.action_space.low)
    assert equal(first[0], second[0])
    fresh = Env("reach_target")
    now, info = fresh.restore(saved)
    assert info["seed"] == 1 and info["instruction"]
    assert equal(first[0], fresh.step(fresh.action_space.low)[0])
    fresh.reset(seed=2)
    fresh.restore(saved)  # whatever start is under way
    assert equal(first[0], fresh.step(fresh.action_space.low)[0])


def test_recorded_episodes_reach_the_catalogue(tmp_path):
    file = tmp_path / "agent.db"
    env = SkillEnv("reach_target", record=True, catalogue=file)
    env.reset(seed=1)
    result = env.step(env.skill_names.index("reach(target, panda.hand)"))
    assert result[2]
    assert result[4]["recorded"].success
    env.reset(seed=2)
    env.step(env.skill_names.index("reach(other1, panda.hand)"))
    assert not env.episode().success
    env.close()
    _, rows = _core.CatalogueReader(file).query("SELECT seed, outcome FROM episodes ORDER BY seed")
    assert [row[0] for row in rows] == [1, 2]


def test_environments_share_the_session_of_a_catalogue(tmp_path):
    one, other = (Env("reach_target", record=True, catalogue=tmp_path / "a.db") for _ in range(2))
    assert one.session is other.session
    assert one.session is not Env("reach_target").session


def test_only_saved_moments_are_restored():
    env = Env("reach_target")
    env.reset(seed=1)
    for nothing in (None, 5, env.save().state):
        with pytest.raises(_core.Error, match=r"Env.restore: .* is no saved moment"):
            env.restore(nothing)
    env.restore(env.save())


def test_of_a_stored_episode_it_is_said_how_to_begin_in_it(tmp_path):
    session = stampede.Session(catalogue=tmp_path / "demos.db")
    session.run("reach_target", seed=3)
    stored = stampede.Catalogue(tmp_path / "demos.db")[1]
    env = Env("reach_target")
    with pytest.raises(_core.Error, match="'episode' is no stampede.Episode, but StoredEpisode") as caught:
        env.reset(options={"episode": stored, "frame": 5})
    assert caught.value.hint.startswith("Session().run('reach_target', variation='colour=")
    cure = caught.value.hint.partition(", with")[0]
    episode = eval(cure, {"Session": stampede.Session})
    seen, _ = env.reset(options={"episode": episode, "frame": 5})
    assert np.array_equal(seen["joint_positions"], stored.arrays("joint_positions")["joint_positions"][5])
    with pytest.raises(_core.Error, match="'episode' is no stampede.Episode, but 1"):
        env.reset(options={"episode": 1})


def test_options_of_another_type_are_told():
    env = Env("reach_target")
    for name, value in (("variation", 5), ("seed", "7"), ("seed", 1.5), ("goal", None), ("frame", None)):
        with pytest.raises(_core.Error, match=rf"'{name}' cannot be {value!r}"):
            env.reset(options={name: value})
    assert env.reset(options={"seed": np.int64(7)})[1]["seed"] == 7


def test_actions_are_pickled_and_what_cannot_be_says_what_to_do_instead():
    for action in (
        stampede.Action("hold", frames=3),
        stampede.Action("joint_delta", [0.01] * 7, gripper=0.04, controller="joint_impedance"),
        stampede.Action("tool_delta", np.zeros(6), frame="tool"),
        stampede.Action.skill_call("pick", ["cup", "table"], {"height": 0.2}, "joint_impedance", 5),
    ):
        for again in (pickle.loads(pickle.dumps(action)), copy.copy(action), copy.deepcopy([action])[0]):
            assert again == action and again is not action
    session = stampede.Session()
    episode = session.run("reach_target", seed=1)
    world = session.environment("reach_target")
    world.reset()
    for one in (episode, session.arrays(episode), session, world, world.save(), stampede.Reset(seed=1)):
        with pytest.raises(TypeError, match=rf"cannot pickle or copy {type(one).__name__}\(.*\n    \w+"):
            pickle.dumps(one)


def test_a_closed_environment_says_so():
    env = Env("reach_target")
    env.close()
    env.close()
    for use in (env.reset, env.render, env.save, env.skills, lambda: env.step(np.zeros(8))):
        with pytest.raises(_core.Error, match="closed"):
            use()


def test_a_plans_skills_reach_the_goal():
    env = SkillEnv("stack_blocks", variation="colour=teal,height=2")
    _, info = env.reset(seed=3)
    plan = _core.Session().plan("stack_blocks", seed=info["seed"], variation=info["variation"])
    for step in plan.steps:
        action = env.skill_names.index(f"{step.action}({', '.join(step.arguments)})")
        assert env.action_masks()[action]
        _, reward, terminated, _, info = env.step(action)
        assert info["ended"][0]["success"]
        assert info["duration_s"] == info["duration"] / 20
    assert terminated
    assert reward == 1
    assert info["is_success"]


def test_a_skill_that_is_masked_moves_nothing_and_counts():
    env = SkillEnv("pick_up_cup", horizon_s=0.2)
    env.reset(seed=1)
    masked = int(np.flatnonzero(~env.action_masks())[0])
    for count in range(1, 5):
        _, reward, _, truncated, info = env.step(masked)
        assert info["ended"][0]["reason"] == "precondition_false"
        assert (reward, info["duration"]) == (0, 0)
        assert truncated == (count == 4)
    env.reset(seed=1)
    with pytest.raises(_core.Error, match="there is no skill 99"):
        env.step(99)


def test_masks_are_of_skills_whose_precondition_holds():
    env = SkillEnv("pick_up_cup")
    env.reset(seed=1)
    for _ in range(3):
        mask = env.action_masks()
        assert mask.tolist() == [choice.feasible for choice in env.skills()] + [False]
        env.step(np.flatnonzero(mask)[0])


def test_hold_is_left_where_no_skill_can_be_done():
    env = SkillEnv("reach_target")
    env.reset(seed=1)
    assert not env.action_masks()[-1]
    assert env.masks({"applicable": np.zeros(3, bool)}).tolist() == [False] * 3 + [True]


def test_a_skill_can_go_on():
    env = SkillEnv("pick_up_cup", frames=10, variation="colour=red")
    env.reset(seed=3)
    go_on = env.skill_names.index("go_on")
    assert not env.action_masks()[go_on]
    info = env.step(env.skill_names.index("pick(cup, table, panda.hand)"))[4]
    assert info["duration"] == 10
    assert info["running"]
    assert env.action_masks()[go_on]
    for _ in range(20):
        _, reward, terminated, _, info = env.step(go_on)
        if terminated:
            break
    assert reward == 1
    assert info["is_success"]


def test_parameters_are_the_agents_where_set():
    env = SkillEnv("pick_up_cup", parameters=True, variation="colour=red")
    assert env.parameter_names == ["pick.height"]
    box = env.action_space["parameters"]["pick.height"]
    assert np.isfinite(box.low).all() and np.isfinite(box.high).all()
    action = {
        "skill": env.skill_names.index("pick(cup, table, panda.hand)"),
        "controller": 2,
        "parameters": {"pick.height": box.high},
        "set": np.array([1], np.int8),
    }
    asked = env.action(action)
    assert asked.parameters == {"height": [pytest.approx(0.3)]}
    assert asked.controller == "joint_impedance"
    assert env.action({**action, "set": np.array([0], np.int8), "controller": 0}).parameters == {}
    env.reset(seed=3)
    high = env.step(action)[4]
    assert "refusal" not in high
    assert set(SkillEnv("reach_target", parameters=True).action_space) == {"skill", "controller"}
    env.reset(seed=3)
    with pytest.raises(_core.Error, match="not of this environment's action space"):
        env.step(0)


def test_a_lid_is_shut_by_the_joint_positions_of_its_demo_and_nothing_is_pressed_hard(tmp_path):
    env = Env("close_grill", action="joint_position", hidden=True, record=True, catalogue=tmp_path / "demos.db")
    for seed in [1, 200, 209]:  # the hand slipped on the handle, or its palm pressed with 174 N
        demo = env.session.run("close_grill", seed=seed, set=["motion.stop_at_vias=1"])
        stored = env.session.arrays(demo, ["action/joint_position", "action/gripper"])
        actions = np.column_stack([stored["action/joint_position"], stored["action/gripper"]])[:-1]
        env.reset(options={"variation": demo.variation, "seed": seed})
        for action in actions:
            done = env.step(action.astype(env.action_space.dtype))[4]["success"]
            if done:
                break
        assert done, seed
    env.close()
    pressed = "SELECT max(peak_force) FROM contacts WHERE object_a = 'panda' AND object_b = 'grill'"
    _, rows = _core.CatalogueReader(tmp_path / "demos.db").query(pressed)
    assert 20 < rows[0][0] < 100
