"""Errors of the package, in the form of the engine's own."""

import difflib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from stampede._core import Error

_SHOWN = 200  # letters of what a library says


def fault(where: str, what: str, cure: str = "") -> Error:
    """An Error that says the place, what is wrong there, and how to cure it."""
    error = Error(f"{where}: {what}" + (f"\n    {cure}" if cure else ""))
    error.where, error.message, error.hint = where, what, cure
    return error


def unknown(where: str, kind: str, name: object, known: Iterable[str]) -> Error:
    """An Error for a name that is none of those known; its cure is the nearest one, or all of them."""
    names = list(known)
    if not isinstance(name, str):
        return fault(where, f"{name!r} is no name of a {kind}", "one of " + ", ".join(names))
    near = difflib.get_close_matches(name, names, n=1)
    cure = f"did you mean '{near[0]}'?" if near else "one of " + ", ".join(names)
    return fault(where, f"there is no {kind} '{name}'", cure)


@contextmanager
def reading(where: str, cure: str = "copy it again, or make it anew") -> Iterator[None]:
    """While a file of somebody else's is read: whatever the libraries that do so raise of it becomes an Error.

    A length in a damaged file can ask for all memory, so MemoryError is of the file too. Errors of our own and of what
    is not installed pass; so does what is no Exception, such as KeyboardInterrupt.
    """
    try:
        yield
    except (Error, ImportError, NameError):
        raise
    except Exception as error:
        said = " ".join(str(error).split())[:_SHOWN]
        what = type(error).__name__ + (f": {said}" if said else "")
        raise fault(where, f"it ends early or is damaged ({what})", cure) from error
