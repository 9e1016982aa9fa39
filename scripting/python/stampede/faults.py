"""Errors of the package, in the form of the engine's own."""

import difflib
from collections.abc import Iterable

from stampede._core import Error


def fault(where: str, what: str, cure: str = "") -> Error:
    """An Error that says the place, what is wrong there, and how to cure it."""
    error = Error(f"{where}: {what}" + (f"\n    {cure}" if cure else ""))
    error.where, error.message, error.hint = where, what, cure
    return error


def unknown(where: str, kind: str, name: str, known: Iterable[str]) -> Error:
    """An Error for a name that is none of those known; its cure is the nearest one, or all of them."""
    names = list(known)
    near = difflib.get_close_matches(name, names, n=1)
    cure = f"did you mean '{near[0]}'?" if near else "one of " + ", ".join(names)
    return fault(where, f"there is no {kind} '{name}'", cure)
