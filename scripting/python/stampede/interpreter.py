"""Interpreters that cannot have the engine, told of before it is loaded."""

import importlib
import sys


def check_interpreter() -> None:
    """Raises ImportError in a subinterpreter, and where the GIL was switched off by force."""
    if not getattr(sys, "_is_gil_enabled", lambda: True)():
        raise ImportError("stampede needs the GIL\n    unset PYTHON_GIL, and leave -X gil=0 out")
    for name in ("_interpreters", "_xxsubinterpreters"):  # of Python 3.13 and later, of those before
        try:
            interpreters = importlib.import_module(name)
        except ImportError:
            continue
        if interpreters.get_current() != interpreters.get_main():
            raise ImportError("stampede runs in the main interpreter alone\n    use threads or processes instead")
        return
