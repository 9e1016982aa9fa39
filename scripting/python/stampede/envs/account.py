"""What an environment says of an episode beside its observation: reward, end, info."""

from collections.abc import Sequence
from typing import Any

from stampede import _core

from .starts import Start

Verdict = tuple[float, bool, bool, dict[str, Any]]  # reward, terminated, truncated, info

_AFTER_END = "the episode is over\n    call reset()"


class EpisodeAccount:
    """One episode after the other, in Gymnasium's terms.

    A step in which no frame goes by (its action was refused, or a skill failed before anything moved) counts as one
    frame of the horizon, so that an episode of such steps ends too.
    """

    def __init__(self, task: str) -> None:
        self._task = task
        self._limit = 0  # frames, and steps without any
        self._identity: dict[str, Any] | None = None
        self.motionless = 0  # steps of this episode in which no frame went by
        self.terminated = self.truncated = self._success = False
        self.running = ""  # the skill, path or hold that can go on
        self.raw: dict[str, Any] = {}  # the last observation, as the engine gives it

    @property
    def begun(self) -> bool:
        return self._identity is not None

    @property
    def over(self) -> bool:
        return self.terminated or self.truncated

    def end(self) -> None:
        """Nothing has begun any more."""
        self._identity = None

    def begin(self, start: Start, raw: dict[str, Any], horizon_frames: int, instructions: list[str]) -> dict[str, Any]:
        """The info that `reset` gives. instructions: what the task is called in words, for this start."""
        self._limit = horizon_frames
        self._identity = {"task": self._task, "variation": start.variation, "seed": start.seed}
        self._identity["instruction"] = instructions[start.seed % len(instructions)] if instructions else ""
        return self.go_back(raw, 0)

    def go_back(self, raw: dict[str, Any], motionless: int) -> dict[str, Any]:
        """The info that `restore` gives."""
        self.motionless = motionless
        self.terminated = self.truncated = self._success = False
        self.running = ""
        self.raw = raw
        return {**(self._identity or {}), **texts_of(raw)}

    def after_end(self) -> Verdict:
        """Of a step after the end: it is refused."""
        info = {**(self._identity or {}), "success": self._success, "refusal": _AFTER_END, "duration": 0, "ended": []}
        return 0.0, self.terminated, self.truncated, info

    def after(self, *steps: _core.Step) -> Verdict:
        """Of what one step of the caller's made of steps of the engine's."""
        last = steps[-1]
        self.raw = raw = last.observation
        duration = last.frames if len(steps) == 1 else sum(step.frames for step in steps)
        if duration == 0:
            self.motionless += 1
        self.running = last.running
        self.terminated = last.terminated
        self.truncated = last.truncated
        self._success = last.success
        if not self.over and self.motionless:
            self.truncated = self.motionless + last.frame >= self._limit
        refusal = steps[0].refusal
        info = {
            **(self._identity or {}),
            "time_s": last.time_s,
            "duration": duration,
            "success": self._success,
            "reason": last.reason,
            "running": self.running,
            "changes": changes_of(steps),
            "limited": sorted({limit for step in steps for limit in step.limited}),
            "ended": [_described(end) for step in steps for end in step.ended],
        }
        if refusal is not None:
            info["refusal"] = str(refusal)
        if self.over:
            info["is_success"] = self._success
            info["detail"] = last.detail
            if last.reason == "none" and self.truncated:
                info["reason"] = "timeout"
        info.update(texts_of(raw))
        return 0.0 if refusal is not None else last.reward, self.terminated, self.truncated, info


def texts_of(raw: dict[str, Any]) -> dict[str, list[str]]:
    """Channels that are texts; they have no place in a space."""
    return {name: value for name, value in raw.items() if isinstance(value, list)}


def changes_of(steps: Sequence[_core.Step]) -> list[str]:
    """Facts that came, `(on cup shelf)`, and went, `(not (on cup shelf))`."""
    return [str(fact) if fact.holds else f"(not {fact})" for step in steps for fact in step.changes]


def skill_text(choice: _core.SkillChoice | _core.SkillEnd) -> str:
    """`pick(cup, table, panda.hand)`."""
    return f"{choice.skill}({', '.join(choice.arguments)})"


def _described(end: _core.SkillEnd) -> dict[str, Any]:
    return {
        "skill": skill_text(end),
        "success": end.success,
        "reason": end.reason,
        "detail": end.detail,
        "missing_effects": list(end.missing_effects),
    }
