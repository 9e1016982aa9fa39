"""`low_dim_obs.pkl` and `variation_descriptions.pkl`: written and read so that RLBench and we read each other's."""

import importlib
import io
import pickle
from pathlib import Path
from typing import Any

from stampede.rlbench.backend.exceptions import DemoError
from stampede.rlbench.backend.observation import Observation
from stampede.rlbench.demo import Demo

_OURS = {("rlbench.demo", "Demo"): Demo, ("rlbench.backend.observation", "Observation"): Observation}
_NUMPY_NAMES = {"_reconstruct", "ndarray", "dtype", "scalar", "_frombuffer"}


def demo_bytes(demo: Demo, classes: str) -> bytes:
    """
    A pickle of a demo. classes: `stampede`, or `rlbench`, so that it is of RLBench's own classes where it is read.

    Protocol 2 names each class once, in a line of text of its own, whose length is written nowhere: so the names can be
    changed in the bytes, and RLBench need not be installed. With `rlbench`, numpy's functions get the names that
    numpy 1 and 2 both know.
    """
    data = pickle.dumps(demo, protocol=2)
    if classes == "stampede":
        return data
    for module, name in _OURS:
        ours = f"cstampede.{module}\n{name}\n".encode()
        if data.count(ours) != 1:
            raise AssertionError(f"a pickled demo names {name} {data.count(ours)} times")
        data = data.replace(ours, f"c{module}\n{name}\n".encode())
    return data.replace(b"cnumpy._core.multiarray\n", b"cnumpy.core.multiarray\n")


class _Reader(pickle.Unpickler):
    """Makes demos, observations and arrays, and nothing else: a pickle of anybody may be read."""

    def find_class(self, module: str, name: str) -> Any:
        ours = _OURS.get((module.removeprefix("stampede."), name))
        if ours is not None:
            return ours
        if module.split(".")[0] == "numpy" and name in _NUMPY_NAMES:
            return _numpy_attribute(module, name)
        if (module, name) == ("_codecs", "encode"):
            return super().find_class(module, name)
        raise pickle.UnpicklingError(f"it has a {module}.{name}, which is no part of a demo")


def _numpy_attribute(module: str, name: str) -> Any:
    """numpy 2 has in `numpy._core` what numpy 1 has in `numpy.core`."""
    for place in (module.replace("numpy.core", "numpy._core"), module.replace("numpy._core", "numpy.core")):
        try:
            return getattr(importlib.import_module(place), name)
        except (ImportError, AttributeError):
            continue
    raise pickle.UnpicklingError(f"numpy has no {module}.{name}")


def read_pickle(file: Path) -> Any:
    """Raises DemoError for a file that is not there, cut off, or holds more than demos are made of."""
    try:
        return _Reader(io.BytesIO(file.read_bytes()), encoding="latin1").load()
    except FileNotFoundError:
        raise DemoError(f"{file}: there is no such file\n    an episode's folder has it") from None
    except (pickle.UnpicklingError, EOFError, ValueError, IndexError, KeyError, TypeError, AttributeError) as error:
        raise DemoError(f"{file}: it is no pickled demo: {error}\n    write the dataset again") from error
