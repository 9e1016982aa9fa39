"""`low_dim_obs.pkl` and `variation_descriptions.pkl`: written and read so that RLBench and we read each other's."""

import pickle
from pathlib import Path
from typing import Any

from stampede.files import plain_file
from stampede.rlbench.backend.exceptions import DemoError
from stampede.rlbench.backend.unpickling import NotPlain, plain_value
from stampede.rlbench.demo import Demo

_CLASSES = (("rlbench.demo", "Demo"), ("rlbench.backend.observation", "Observation"))


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
    for module, name in _CLASSES:
        ours = f"cstampede.{module}\n{name}\n".encode()
        if data.count(ours) != 1:
            raise AssertionError(f"a pickled demo names {name} {data.count(ours)} times")
        data = data.replace(ours, f"c{module}\n{name}\n".encode())
    return data.replace(b"cnumpy._core.multiarray\n", b"cnumpy.core.multiarray\n")


def read_pickle(file: Path) -> Any:
    """
    What a pickle of anybody holds; nothing of it runs. Raises DemoError for a file that is not there, cut off, or holds
    more than demos are made of.
    """
    try:
        return plain_value(plain_file(file).read_bytes())
    except FileNotFoundError:
        raise DemoError(f"{file}: there is no such file\n    an episode's folder has it") from None
    except OSError as error:
        raise DemoError(f"{file}: it cannot be read: {error.strerror}\n    copy it again") from None
    except NotPlain as error:
        raise DemoError(f"{file}: it is no pickled demo: {error}\n    write the dataset again") from error
