"""Sessions that environments of one process share; a process that was forked opens its own."""

import os
import weakref
from collections.abc import Sequence

from stampede import _core

PathLike = str | os.PathLike[str]


class SharedSession:
    """A session that is open for as long as an environment holds it.

    Two sessions must not write one catalogue, so environments of the same folders and catalogue have the same one.
    """

    def __init__(self, root: str | None, paths: tuple[str, ...], catalogue: str | None) -> None:
        self.root = root
        self.paths = paths
        self.core = _core.Session(root=root, paths=list(paths), catalogue=catalogue)


_open: weakref.WeakValueDictionary[tuple[object, ...], SharedSession] = weakref.WeakValueDictionary()


def shared_session(root: PathLike | None, paths: Sequence[PathLike], catalogue: PathLike | None) -> SharedSession:
    """The session of these folders and this catalogue, opened where no environment has it open.

    Raises stampede.Error for scripts that cannot be read.
    """
    if isinstance(paths, (str, os.PathLike)):
        paths = (paths,)

    def absolute(path: PathLike | None) -> str | None:
        return None if path is None else os.path.abspath(path)

    key = (os.getpid(), absolute(root), tuple(os.path.abspath(path) for path in paths), absolute(catalogue))
    session = _open.get(key)
    if session is None:
        session = _open[key] = SharedSession(*key[1:])
    return session
