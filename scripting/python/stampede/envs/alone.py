"""One thread at a time."""

import threading
from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar

from stampede.faults import fault

Method = TypeVar("Method", bound=Callable[..., Any])


def alone(method: Method) -> Method:
    """A method of an object with `_use`, an RLock, that refuses while another thread is in one of these.

    To wait would give each thread a step of an episode that the others change under its feet.
    """

    @wraps(method)
    def refusing(self: Any, *arguments: Any, **named: Any) -> Any:
        use: threading.RLock = self._use
        if not use.acquire(blocking=False):
            kind = type(self).__name__
            raise fault(
                f"{kind}.{method.__name__}",
                f"another thread is using the {kind}",
                "one thread at a time: make one for each thread, or put a lock around it",
            )
        try:
            return method(self, *arguments, **named)
        finally:
            use.release()

    return refusing  # type: ignore[return-value]
