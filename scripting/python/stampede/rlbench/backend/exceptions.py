"""What can go wrong, under RLBench's names."""

from stampede._core import Error


class InvalidActionError(Error):
    """An action that cannot be done. Nothing has changed then."""


class BoundaryError(Error):
    """RLBench's, for `except`; a start that cannot be made is a `stampede.Error` here."""


class WaypointError(Error):
    """RLBench's, for `except`; tasks have no waypoints here."""


class DemoError(Error, RuntimeError):
    """No demo could be made, or a stored one cannot be used. RLBench raises a RuntimeError for some of these."""
