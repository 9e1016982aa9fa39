"""When looks, light, cameras and dynamics are drawn anew."""

from enum import Enum


class RandomizeEvery(Enum):
    EPISODE = 0
    VARIATION = 1
    TRANSITION = 2


class RandomizationConfig:
    """whitelist, blacklist: names of objects; the engine draws the looks of all, so both must stay empty."""

    def __init__(self, whitelist: list[str] | None = None, blacklist: list[str] | None = None) -> None:
        self.whitelist = whitelist or []
        self.blacklist = blacklist or []


class VisualRandomizationConfig(RandomizationConfig):
    """image_directory: RLBench's textures; looks here are the engine's own, and the folder is not read."""

    def __init__(
        self,
        image_directory: str = "",
        whitelist: list[str] | None = None,
        blacklist: list[str] | None = None,
        randomize_arm: bool = True,
    ) -> None:
        super().__init__(whitelist, blacklist)
        self.image_directory = image_directory
        self.randomize_arm = randomize_arm


class DynamicsRandomizationConfig(RandomizationConfig):
    """Masses, friction and the like are drawn by the engine together with looks."""
