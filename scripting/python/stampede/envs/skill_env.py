"""A task as a Gymnasium environment whose agent acts by skills."""

from collections.abc import Mapping, Sequence
from typing import Any, SupportsInt

import numpy as np
from gymnasium import spaces

from stampede import _core

from .account import skill_text
from .alone import alone
from .base import EpisodeEnv, Result, SavedEpisode, Settings
from stampede.faults import fault
from .sessions import PathLike
from .spaces import Observation, box_within

CONTROLLERS = ("own", "joint_position", "joint_impedance", "cartesian_impedance")

HOLD, GO_ON = "hold", "go_on"

INNER_CHANNELS = ("progress", "applicable")  # whether the goal holds, and what can be done


class SkillEnv(EpisodeEnv):
    """A task whose agent chooses among ground skills; a step is a whole one, an option in the sense of an SMDP.

    Actions: Discrete over `skill_names`: every ground skill of the scene, `pick(cup, table, panda.hand)`, then `hold`
    (stand still for a second), which the mask allows where no skill can be done, and with `frames` at last `go_on`.
    `action_masks` says which can be done now. info["duration"] is how many frames a step took, info["duration_s"] how
    long that is, info["ended"] which skills ended and how (dicts with skill, success, reason, detail, missing_effects);
    discounting by duration is the learner's.

    Where the goal holds after a skill, the same step waits until it has held long enough, so success ends the episode.

    Arguments (the others are Env's):
        parameters: actions are a Dict instead: `skill` (the Discrete above), `controller` (Discrete over CONTROLLERS),
            `parameters` (a Box for each continuous parameter with bounds, by `pick.height`), and `set` (MultiBinary, in
            the order of `parameter_names`): which of them count; the others are drawn. Those of other skills than the
            one that is chosen do not matter. The last two are left out where no skill of the scene has such
            parameters.
        frames: a step ends after so many; the skill goes on with `go_on`, any other action cuts it off. 0: at its end.
    """

    def __init__(
        self,
        task: str,
        *,
        parameters: bool = False,
        frames: int = 0,
        observations: Sequence[str] = ("facts",),
        reward: str = "sparse",
        variation: str | None = None,
        split: str = "train",
        render_mode: str | None = None,
        camera: str = "front",
        frame_hz: float = 0,
        physics_hz: float = 0,
        horizon_s: float = 0,
        image_size: int | tuple[int, int] | None = None,
        hidden: bool = False,
        randomise: bool = False,
        perturb: str = "",
        record: bool = False,
        catalogue: PathLike | None = None,
        root: PathLike | None = None,
        paths: Sequence[PathLike] = (),
    ) -> None:
        if frames < 0:
            raise fault("frames=", "a number of frames is not negative", "0: a step is a whole skill")
        settings = Settings(
            observations=observations,
            reward=reward,
            variation=variation,
            split=split,
            render_mode=render_mode,
            camera=camera,
            frame_hz=frame_hz,
            physics_hz=physics_hz,
            horizon_s=horizon_s,
            image_size=image_size,
            hidden=hidden,
            randomise=randomise,
            perturb=perturb,
            record=record,
            catalogue=catalogue,
            root=root,
            paths=paths,
        )
        super().__init__(task, settings, inner_channels=INNER_CHANNELS)
        self._frames = frames
        self._choices = [(choice.skill, list(choice.arguments)) for choice in self._environment.skills()]
        self.skill_names = [skill_text(choice) for choice in self._environment.skills()]
        self.skill_names += [HOLD, GO_ON] if frames else [HOLD]
        self._boxes = self._parameter_boxes()
        self.parameter_names = list(self._boxes)
        skill = spaces.Discrete(len(self.skill_names))
        self.action_space = self._parameter_space(skill) if parameters else skill
        self._acting = {"parameters": parameters, "frames": frames}

    @property
    def arguments(self) -> dict[str, Any]:
        """All that this environment was made with, but the task."""
        return {**vars(self.settings), **self._acting}

    def _parameter_boxes(self) -> dict[str, spaces.Box]:
        present = {skill for skill, _ in self._choices}
        boxes = {}
        for description in self._environment.skill_descriptions():
            for one in description.continuous if description.skill in present else []:
                if one.lower and np.isfinite([*one.lower, *one.upper]).all():
                    boxes[f"{description.skill}.{one.name}"] = box_within(one.lower, one.upper)
        return dict(sorted(boxes.items()))

    def _parameter_space(self, skill: spaces.Discrete) -> spaces.Dict:
        parts: dict[str, spaces.Space] = {"skill": skill, "controller": spaces.Discrete(len(CONTROLLERS))}
        if self._boxes:
            parts["parameters"] = spaces.Dict(self._boxes)
            parts["set"] = spaces.MultiBinary(len(self._boxes))
        return spaces.Dict(parts)

    @alone
    def reset(
        self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        return self._of_same_skills(super().reset(seed=seed, options=options))

    @alone
    def restore(self, saved: SavedEpisode) -> tuple[Observation, dict[str, Any]]:
        return self._of_same_skills(super().restore(saved))

    def _of_same_skills(self, begun: tuple[Observation, dict[str, Any]]) -> tuple[Observation, dict[str, Any]]:
        now = [(choice.skill, list(choice.arguments)) for choice in self._environment.skills()]
        if now != self._choices:
            self._account.end()
            raise fault(
                f"task '{self.task}'",
                f"variation '{begun[1]['variation']}' has other ground skills than the first",
                "fix the variation with variation=",
            )
        return begun

    def action_masks(self) -> np.ndarray:
        """Which actions can be done now: bool, one an entry of `skill_names`, at least one of them True.

        A skill can be done when its precondition holds; `hold` counts where nothing else can.
        """
        self._check_begun("action_masks")
        return self.masks(self._account.raw, self._account.running)

    def masks(self, raw: Mapping[str, Any], running: str = "") -> np.ndarray:
        """What action_masks says, of channels as the engine gives them. running: the skill that can go on."""
        mask = np.zeros(len(self.skill_names), bool)
        mask[: len(self._choices)] = raw["applicable"]
        if self._frames:
            mask[-1] = bool(running)
        if not mask.any():
            mask[len(self._choices)] = True
        return mask

    @alone
    def step(self, action: SupportsInt | Mapping[str, Any] | _core.Action) -> Result:
        """Does one skill. One whose precondition does not hold ends at once, and counts as one frame of the horizon.

        An action that cannot be done changes nothing either: info["refusal"] says why. A stampede.Action of any space
        is taken too. Raises stampede.Error for an action that is not of the space.
        """
        self._check_begun("step")
        if self._account.over:
            return self._result(self._account.after_end())
        steps = [self._environment.step(self.action(action))]
        if self._waits_for_verdict(steps[0]):
            steps.append(self._environment.step(_core.Action(HOLD)))
        verdict = self._account.after(*steps)
        info = verdict[-1]
        info["duration_s"] = info["duration"] / self.frame_hz
        return self._result(verdict)

    def _waits_for_verdict(self, step: _core.Step) -> bool:
        over = step.terminated or step.truncated
        return not (over or step.refusal or step.running) and step.observation["progress"] == 1

    def action(self, action: SupportsInt | Mapping[str, Any] | _core.Action) -> _core.Action:
        """The engine's action for one of the action space."""
        if isinstance(action, _core.Action):
            return action
        values: Mapping[str, Any] = action if isinstance(action, Mapping) else {"skill": action}
        if isinstance(action, Mapping) != isinstance(self.action_space, spaces.Dict):
            raise fault("step(action)", f"{action} is not of this environment's action space", str(self.action_space))
        chosen = int(values["skill"])
        if not 0 <= chosen < len(self.skill_names):
            last = len(self.skill_names) - 1
            raise fault("step(action)", f"there is no skill {chosen}", f"they count from 0 to {last}")
        if chosen >= len(self._choices):
            return _core.Action(self.skill_names[chosen], frames=self._frames)
        skill, arguments = self._choices[chosen]
        controller = CONTROLLERS[int(values.get("controller", 0))]
        return _core.Action.skill_call(
            skill,
            arguments,
            self._set_parameters(skill, values),
            controller="" if controller == "own" else controller,
            frames=self._frames,
        )

    def _set_parameters(self, skill: str, action: Mapping[str, Any]) -> dict[str, list[float]]:
        chosen = {}
        for name, counts in zip(self.parameter_names, action.get("set", ()), strict=False):
            owner, _, parameter = name.partition(".")
            if counts and owner == skill:
                chosen[parameter] = np.asarray(action["parameters"][name], np.float64).tolist()
        return chosen
