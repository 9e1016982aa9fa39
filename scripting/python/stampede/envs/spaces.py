"""Gymnasium's spaces for the engine's actions and observations, and the way between the two."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from gymnasium import spaces

from stampede import _core

from stampede.faults import fault, unknown

SET_POINT_SPACES = (
    "joint_position",
    "joint_delta",
    "joint_velocity",
    "joint_torque",
    "tool_pose",
    "tool_delta",
    "tool_velocity",
    "tool_impedance",
    "tool_path",
    "tool_path_delta",
    "gripper",
)

Observation = dict[str, np.ndarray]

# What is certain of a channel, by the end of its name. Measured joints may pass their limits by a little, so they have
# no bounds.
_BOUNDS = {
    "gripper_open": (0.0, 1.0),
    "progress": (0.0, 1.0),
    "goal": (-1.0, 1.0),
    "time": (0.0, np.inf),
    "step": (0, np.iinfo(np.int64).max),
    "_depth": (0.0, np.inf),
}


def box_within(lower: Sequence[float], upper: Sequence[float]) -> spaces.Box:
    """A float32 Box of which no member lies outside of the float64 bounds."""
    exact_low, exact_high = np.asarray(lower, np.float64), np.asarray(upper, np.float64)
    low, high = exact_low.astype(np.float32), exact_high.astype(np.float32)
    low = np.where(low < exact_low, np.nextafter(low, np.float32(np.inf)), low)
    high = np.where(high > exact_high, np.nextafter(high, np.float32(-np.inf)), high)
    return spaces.Box(low, high, dtype=np.float32)


class ActionCodec:
    """One action space of the engine as a Box: float32, one entry a component, in the order of `names`.

    gripper: the opening of the fingers (m) comes last. normalise: all entries are -1 … 1 instead, from bound to bound.
    """

    def __init__(self, available: Sequence[_core.ActionSpace], name: str, gripper: bool, normalise: bool) -> None:
        by_name = {space.name: space for space in available}
        if name not in SET_POINT_SPACES:
            if name in by_name:
                cure = "SkillEnv acts by skills; step takes any stampede.Action"
                raise fault("action=", f"'{name}' has no values", cure)
            raise unknown("action=", "action space", name, SET_POINT_SPACES)
        self.name = name
        self.gripper = gripper and name != "gripper"
        components = list(by_name[name].components)
        self.names = [component.name for component in components]
        self.units = [component.unit for component in components]
        if self.gripper:
            components += by_name["gripper"].components
            self.names.append("gripper")
            self.units.append(components[-1].unit)
        self._lower = np.array([component.lower for component in components])
        self._upper = np.array([component.upper for component in components])
        self._normalise = normalise
        count = len(components)
        if normalise:
            self.space = spaces.Box(-1.0, 1.0, (count,), np.float32)
        else:
            self.space = box_within(self._lower, self._upper)

    def __call__(self, action: np.ndarray | Sequence[float] | _core.Action) -> _core.Action:
        """The engine's action. One that is the engine's already passes, whatever its space."""
        if isinstance(action, _core.Action):
            return action
        values = np.asarray(action, np.float64)
        if values.shape != self._lower.shape:
            raise fault(
                "step(action)",
                f"an action of {self.name} has shape {self._lower.shape}, not {values.shape}",
                "its components: " + ", ".join(self.names),
            )
        if self._normalise:
            values = self._lower + (values + 1.0) * 0.5 * (self._upper - self._lower)
        if self.gripper:
            return _core.Action(self.name, values[:-1], gripper=float(values[-1]))
        return _core.Action(self.name, values)


class ObservationCodec:
    """The engine's channels as a Dict of Box and MultiBinary, by channel, in the engine's types.

    Shapes are the channel's; a single number has shape (1,). Truth values are int8. What is not known (NaN) is 0; a
    quaternion of zeros is no rotation, so an unknown pose can be told. Texts are no part of the space.
    """

    def __init__(self, example: Mapping[str, Any], leave_out: frozenset[str] = frozenset()) -> None:
        self._arrays = [
            (name, value.shape, value.dtype)
            for name, value in example.items()
            if not isinstance(value, list) and name not in leave_out
        ]
        self._count = len(example)
        self.space = spaces.Dict({name: _space_of(name, example[name]) for name, _, _ in self._arrays})

    def __call__(self, raw: Mapping[str, Any]) -> Observation:
        """A member of the space, of channels of an episode whose first ones were checked."""
        return {name: _known(raw[name]) if shape else _known(raw[name].reshape(1)) for name, shape, _ in self._arrays}

    def batch(self, raws: Sequence[Mapping[str, Any]]) -> Observation:
        """Members of the space, one a row, as new arrays."""
        observation: Observation = {}
        for name, shape, dtype in self._arrays:
            rows = np.empty((len(raws), *(shape or (1,))), dtype)
            for i, raw in enumerate(raws):
                rows[i] = raw[name]
            observation[name] = _known(rows)
        return observation

    def check(self, raw: Mapping[str, Any]) -> None:
        """Raises stampede.Error where the engine's channels have other shapes than at the first start."""
        if len(raw) != self._count:
            raise _other_shape("observation", f"{len(raw)} channels", f"{self._count} channels")
        for name, shape, _ in self._arrays:
            value = raw.get(name)
            if value is None or value.shape != shape:
                raise _other_shape(f"channel '{name}'", "not there" if value is None else str(value.shape), str(shape))


def _known(values: np.ndarray) -> np.ndarray:
    """Truth values as int8, and what is not known as 0."""
    kind = values.dtype.kind
    if kind == "b":
        return values.view(np.int8)
    if kind == "f":
        squares = np.vdot(values, values)  # NaN where one is NaN, and several times as fast as asking each
        if squares != squares:
            return np.where(np.isnan(values), values.dtype.type(0), values)
    return values


def _other_shape(where: str, now: str, before: str) -> Exception:
    return fault(where, f"it was {before} and is {now} at this start", "fix the start's shape with variation=")


def _space_of(name: str, value: np.ndarray) -> spaces.Space:
    shape = value.shape or (1,)
    if value.dtype.kind == "b":
        return spaces.MultiBinary(shape)
    if value.dtype.kind == "u":
        return spaces.Box(0, np.iinfo(value.dtype).max, shape, value.dtype.type)
    for end, (low, high) in _BOUNDS.items():
        if name == end or (end.startswith("_") and name.endswith(end)):
            return spaces.Box(low, high, shape, value.dtype.type)
    if value.dtype.kind == "i":
        limits = np.iinfo(value.dtype)
        return spaces.Box(limits.min, limits.max, shape, value.dtype.type)
    return spaces.Box(-np.inf, np.inf, shape, value.dtype.type)
