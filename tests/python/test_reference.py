"""What C++ offers, Python offers too, under the same names: read from the public headers."""

from __future__ import annotations

import inspect
import re
from pathlib import Path

import pytest

import stampede
from stampede import _core

ROOT = Path(__file__).resolve().parents[2]
HEADERS = {
    path.name: path.read_text()
    for room in ("engine", "db", "scripting")
    for path in (ROOT / room / "include" / "stampede").glob("*.h")
}


def _body(header: str, name: str) -> str:
    """The text between the braces of a struct or class, without comments."""
    text = re.sub(r"//[^\n]*", "", HEADERS[header])
    start = re.search(rf"\b(struct|class)\s+(STAMPEDE_EXPORT\s+)?{name}\b[^;{{]*{{", text)
    assert start, f"{header} has no {name}"
    depth, at = 1, start.end()
    while depth:
        depth += {"{": 1, "}": -1}.get(text[at], 0)
        at += 1
    return text[start.end() : at - 1].split("private:")[0]


def fields(header: str, name: str) -> set[str]:
    body = re.sub(r"\{[^{}]*\}", "", _body(header, name))  # initialisers, and bodies of functions
    body = re.sub(r"std::function<.*?>(?=\s+\w+\s*[;=])", "function", body, flags=re.DOTALL)
    while "<" in body:
        body = re.sub(r"<[^<>]*>", "", body)
    found: set[str] = set()
    for statement in body.split(";"):
        declared = re.sub(r"=[^,]*", "", statement).strip()
        if declared and "(" not in declared and not declared.startswith(("friend", "using", "public")):
            found |= {re.findall(r"\w+", one)[-1] for one in declared.split(",")}
    return found


def methods(header: str, name: str) -> set[str]:
    body = _body(header, name)
    while "{" in body:  # bodies of functions
        body = re.sub(r"\{[^{}]*\}", "", body)
    found = set(re.findall(r"(?<![\w~:])([a-z_]\w*)\s*\(", body))
    return {name for name in found if not name.endswith("_")} - {"explicit", "default", "operator"}


SAME_FIELDS = [
    ("action.h", "ActionComponent", _core.ActionComponent, set()),
    ("action.h", "ActionSpace", _core.ActionSpace, set()),
    ("action.h", "AgentAction", _core.Action, set()),
    ("action.h", "AskedAction", _core.AskedAction, set()),
    ("action.h", "SkillChoice", _core.SkillChoice, set()),
    ("action.h", "SkillParameterInfo", _core.SkillParameterInfo, set()),
    ("action.h", "SkillDescription", _core.SkillDescription, set()),
    ("environment.h", "ActionRefusal", _core.ActionRefusal, set()),
    ("environment.h", "SkillEnd", _core.SkillEnd, set()),
    ("environment.h", "StepResult", _core.Step, set()),
    ("environment.h", "PolicyCall", _core.PolicyCall, set()),
    ("world_state.h", "StateFact", _core.Fact, set()),
    ("world_state.h", "StateJoint", _core.StateJoint, set()),
    ("world_state.h", "StatePose", _core.StatePose, set()),
    ("world_state.h", "StateHand", _core.StateHand, set()),
    ("world_state.h", "WorldState", _core.WorldState, set()),
    ("arrays.h", "ArraySegment", _core.Segment, set()),
    ("arrays.h", "ArrayColumn", _core.Column, {"shape", "data"}),  # those of the numpy array
    ("arrays.h", "ArrayPictures", _core.PictureColumn, {"frame"}),
    ("arrays.h", "EpisodeArrays", _core.EpisodeArrays, {"columns"}),  # keys() and [name]
    ("episode.h", "Episode", _core.Episode, {"outcome", "record"}),  # `success`; of the engine
    ("episode.h", "TaskTally", _core.TaskTally, {"simulated_us"}),
    ("episode.h", "RunTally", _core.RunTally, set()),
    ("evaluation.h", "EvaluationRow", _core.EvaluationRow, set()),
    ("evaluation.h", "Evaluation", _core.Evaluation, set()),
    ("session.h", "TaskPlanStep", _core.PlanStep, set()),
    ("session.h", "TaskPlan", _core.TaskPlan, set()),
    ("catalogue_reader.h", "ReadyQuestion", _core.ReadyQuestion, set()),
]


@pytest.mark.parametrize(("header", "name", "shown", "without"), SAME_FIELDS, ids=[row[1] for row in SAME_FIELDS])
def test_values_have_the_same_fields(header: str, name: str, shown: type, without: set[str]) -> None:
    of_cpp = fields(header, name)
    assert len(of_cpp) > 1
    missing = {field for field in of_cpp - without if not hasattr(shown, field)}
    assert not missing
    assert without <= of_cpp


@pytest.mark.parametrize(
    ("header", "name", "shown", "without"),
    [
        ("session.h", "Session", _core.Session, set()),
        ("environment.h", "Environment", _core.Environment, set()),
        ("world_state.h", "SimulatorView", _core.SimulatorView, set()),
        ("catalogue_reader.h", "CatalogueReader", _core.CatalogueReader, set()),
    ],
)
def test_classes_have_the_same_methods(header: str, name: str, shown: type, without: set[str]) -> None:
    of_cpp = methods(header, name)
    assert len(of_cpp) > 4 and without <= of_cpp
    assert not {method for method in of_cpp - without if not hasattr(shown, method)}


@pytest.mark.parametrize(
    ("header", "name", "documented", "without"),
    [
        ("environment.h", "EnvironmentSettings", _core.Session.environment, set()),
        ("environment.h", "ResetRequest", _core.Reset, set()),
        ("environment.h", "PolicyEntry", _core.Session.add_policy, set()),
        ("episode.h", "EpisodeRequest", _core.Session.run, set()),
        ("evaluation.h", "EvaluationRequest", _core.Session.evaluate, {"settings", "stop"}),  # by name; Ctrl-C
        ("world_state.h", "SensorEntry", _core.Session.add_sensor, set()),
        ("picture.h", "PictureStorage", _core.Session.run, {"instance", "semantic"}),  # mask, semantic_mask
        ("picture.h", "PictureRequest", _core.CatalogueReader.picture, {"instance", "semantic"}),
    ],
)
def test_requests_are_keyword_arguments(header: str, name: str, documented: object, without: set[str]) -> None:
    text = documented.__doc__ or ""
    of_cpp = fields(header, name)
    assert len(of_cpp) > 4 and without <= of_cpp
    assert not {field for field in of_cpp - without if not re.search(rf"\b{field}\b", text)}


def test_settings_are_taken_by_name_and_unknown_ones_are_not() -> None:
    session = stampede.Session()
    defaults = {"hidden": False, "reward": "sparse", "frame_hz": 0, "physics_hz": 0, "horizon_s": 0, "record": False}
    pictures = {"width": 0, "height": 0, "picture_sizes": {}, "shadows": False, "picture_hz": {}}
    pictures["renderer"] = "own"
    noise = {"rgb_noise": 0, "depth_noise": 0, "torque_noise": 0, "torque_model": ""}
    given = {"channels": ["joint_positions"], **defaults, **pictures, **noise}
    assert set(given) == fields("environment.h", "EnvironmentSettings")
    assert session.environment("reach_target", **given)
    with pytest.raises(TypeError, match="no argument 'framehz'"):
        session.environment("reach_target", framehz=10)
    with pytest.raises(TypeError, match="no argument 'sed'"):
        session.run("reach_target", sed=1)
    with pytest.raises(stampede.Error, match="own or osmesa"):
        session.environment("reach_target", renderer="mesa")
    with pytest.raises(stampede.Error, match="one of sparse, dense, task"):
        session.environment("reach_target", reward="dens")


def test_every_action_space_is_in_the_reference() -> None:
    environment = stampede.Session().environment("reach_target", channels=["joint_positions"])
    environment.reset(stampede.Reset(seed=1))
    spaces = {space.name for space in environment.spaces()}
    in_header = set(re.findall(r"^// \| (\w+) \|", HEADERS["action.h"], re.MULTILINE)) - {"name"}
    assert spaces == in_header
    text = _core.Action.__doc__ or ""
    assert not {space for space in spaces if not re.search(rf"\b{space}\b", text)}


def test_the_package_is_typed_and_every_name_is_documented() -> None:
    package = Path(stampede.__file__).parent
    assert (package / "py.typed").exists() and (package / "_core.pyi").exists()
    for name in ("Session", "Environment", "CatalogueReader", "Action", "Reset", "EpisodeArrays"):
        assert inspect.getdoc(getattr(_core, name)), name
    for name in ("Catalogue", "StoredEpisode", "Table", "FrameDataset", "WindowStream", "Env", "SkillEnv", "VectorEnv"):
        shown = getattr(stampede, name)
        assert inspect.getdoc(shown), name
        for member, value in vars(shown).items():
            if not member.startswith("_") and inspect.isfunction(value):
                assert inspect.getdoc(value), f"{name}.{member}"
    for name in ("generate", "ray_executor", "Part", "Progress", "LostShards", "Executor", "Job"):
        assert inspect.getdoc(getattr(stampede.cluster, name)), name
