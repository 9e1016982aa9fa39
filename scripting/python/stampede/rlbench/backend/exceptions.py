"""What can go wrong, under RLBench's names."""

from stampede._core import Error


class InvalidActionError(Error):
    """An action that cannot be done. Nothing has changed then."""


class DemoError(Error):
    """No demo could be made, or a stored one cannot be used."""
