"""Pickles of anybody: whatever is in one, nothing of it runs, and what is read is plain."""

import pickle
import random
import struct
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

stampede = pytest.importorskip("stampede")

from damage import cases, damaged  # noqa: E402
from numpy._core.multiarray import _reconstruct  # noqa: E402

from stampede.rlbench.backend.exceptions import DemoError  # noqa: E402
from stampede.rlbench.backend.observation import Observation  # noqa: E402
from stampede.rlbench.backend.pickles import demo_bytes, read_pickle  # noqa: E402
from stampede.rlbench.backend.unpickling import NotPlain, plain_value  # noqa: E402
from stampede.rlbench.demo import Demo  # noqa: E402


def demo_of(frames: int) -> Demo:
    draw = np.random.default_rng(1)
    seen = [
        Observation(
            joint_positions=draw.random(7),
            gripper_open=float(frame % 2),
            gripper_matrix=np.asfortranarray(draw.random((4, 4))),
            front_mask=np.arange(6, dtype=">u2").reshape(2, 3),
            wrist_mask=np.array([[True, False]]),
            misc={"variation_index": 0, "near": np.float64(0.01), "far": np.float32(4.5), "front": None},
        )
        for frame in range(frames)
    ]
    return Demo(seen, random_seed=np.random.get_state(), num_reset_attempts=2, variation="colour=red", seed=7)


class Made:
    """What is pickled as a call of anything."""

    def __init__(self, *reduced: Any) -> None:
        self.reduced = reduced

    def __reduce__(self) -> tuple:
        return self.reduced



def array_with(kind: Any, shape: tuple = (1,), data: Any = b"\x41" * 8) -> Made:
    return Made(_reconstruct, (np.ndarray, (0,), b"b"), (1, shape, kind, False, data))


HOSTILE = {
    "a field of kind object, said to be none": array_with(
        Made(np.dtype, ("V8", False, True), (3, "|", None, ("a",), {"a": (np.dtype("O"), 0)}, 8, 1, 0))
    ),
    "a number that becomes fields": array_with(
        Made(np.dtype, ("f8", False, True), (3, "|", None, ("a",), {"a": (np.dtype("O"), 0)}, 8, 1, 0))
    ),
    "a number of another size": array_with(
        Made(np.dtype, ("f8", False, True), (3, "<", None, None, None, 4096, 8, 0))
    ),
    "objects": array_with(np.dtype("O"), data=[1]),
    "texts": array_with(np.dtype("U2")),
    "a call of a dtype": Made(np.dtype, (Made(np.dtype, ("O",)),)),
    "an array without bytes": Made(np.ndarray, ((1 << 62,), "u1")),
    "bytes that are too few": array_with(np.dtype("f8"), shape=(1 << 20,)),
    "a negative shape": array_with(np.dtype("f8"), shape=(-1, -1)),
    "a program": Made(print, ("it ran",)),
    "a state for a class": Made(_reconstruct, (np.ndarray, (0,), b"b"), {"__class__": 1}),
    "a state for an observation": Made(Observation, (), {"__class__": 1, "__dict__": {}}),
    "a list that is never ended": b"(" * 2000 + b".",
    "lists in lists": b"\x80\x02" + b"]" * 200000 + b"a" * 199999 + b".",
    "twice the list before, forty times": b"\x80\x02K\x01" + b"q\x00(h\x00h\x00l" * 40 + b".",
    "a list in itself": b"\x80\x02]q\x00h\x00a.",
    "vast bytes": b"\x80\x04\x8e\xff\xff\xff\xff\xff\xff\xff\x7f",
    "a vast place of the memo": b"\x80\x02]r\xff\xff\xff\xff" + b"h\x01.",
    "a vast number": b"\x80\x02\x8b\x00\x10\x00\x00" + b"\x7f" * 4096 + b".",
    "a dotted name": b"\x80\x04\x8c\x05numpy\x8c\x0ectypeslib.load\x93.",
    "an array's type alone": pickle.dumps(np.dtype("f8"), 2),
    "an array that is not filled": b"\x80\x02cnumpy.core.multiarray\n_reconstruct\ncnumpy\nndarray\nK\x00\x85c_codecs\n"
    b"encode\nX\x01\x00\x00\x00bX\x06\x00\x00\x00latin1\x86R\x87R.",
    "the same bytes in a hundred arrays": b"\x80\x02(cnumpy\ndtype\nX\x02\x00\x00\x00u1\x85Rq\x01cnumpy.core.numeric\n"
    b"_frombuffer\nq\x02X\xe8\x03\x00\x00"
    + b"a" * 1000
    + b"q\x030"
    + b"h\x02(h\x03h\x01M\xe8\x03\x85X\x01\x00\x00\x00CtR" * 100
    + b"l.",
    "a buffer from elsewhere": b"\x80\x05\x97.",
    "a persistent name": b"Pone\n.",
    "an extension": b"\x80\x02\x82\x01.",
}


@pytest.mark.parametrize("what", HOSTILE)
def test_what_is_no_part_of_a_demo_is_refused(what: str, tmp_path: Path, capfd: pytest.CaptureFixture) -> None:
    data = HOSTILE[what]
    file = tmp_path / "x.pkl"
    file.write_bytes(data if isinstance(data, bytes) else pickle.dumps(data, protocol=2))
    with pytest.raises(DemoError, match="x.pkl: it is no pickled demo: .*\n    write the dataset again"):
        read_pickle(file)
    assert capfd.readouterr().out == ""


def same(one: Any, other: Any) -> bool:
    if isinstance(one, np.ndarray):
        return isinstance(other, np.ndarray) and one.dtype == other.dtype and np.array_equal(one, other)
    if isinstance(one, Demo | Observation):
        return type(one) is type(other) and same(vars(one), vars(other))
    if isinstance(one, dict):
        return list(one) == list(other) and all(same(one[key], other[key]) for key in one)
    if isinstance(one, list | tuple):
        return type(one) is type(other) and len(one) == len(other) and all(map(same, one, other))
    return type(one) is type(other) and one == other


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_demos_are_read_as_pickle_reads_them(protocol: int) -> None:
    data = pickle.dumps(demo_of(3), protocol)
    expected = pickle.loads(data)
    for seen in expected:
        seen.front_mask = seen.front_mask.astype("u2")  # in the machine's order
    assert same(plain_value(data), expected)
    assert plain_value(pickle.dumps(["reach the red target", "touch it"], protocol))[1] == "touch it"


def test_a_state_of_the_generator_is_looked_at() -> None:
    demo = plain_value(demo_bytes(demo_of(1), "rlbench"))
    demo.restore_state()
    name, key, _, has_spare, spare = demo.random_seed
    for bad in (
        (name, key, 10**9, has_spare, spare),
        (name, key, -(10**9), has_spare, spare),
        (name, key[:10], 1, has_spare, spare),
        (name, key.astype(float), 1, has_spare, spare),
        ("PCG64", key, 1, has_spare, spare),
        "MT19937",
    ):
        demo.random_seed = bad
        with pytest.raises(stampede.Error, match="no state of numpy's generator"):
            demo.restore_state()


def look_at(value: Any, left: list[int]) -> None:
    """Touches all of it; raises for what is not plain."""
    left[0] -= 1
    assert left[0] > 0
    if isinstance(value, np.ndarray | np.generic):
        assert value.dtype.kind in "biuf" and value.dtype.fields is None
        float(np.sum(value, dtype=float))
    elif isinstance(value, Demo | Observation):
        look_at(vars(value), left)
    elif isinstance(value, dict):
        for name, one in value.items():
            assert type(name) is str
            look_at(one, left)
    elif isinstance(value, list | tuple):
        for one in value:
            look_at(one, left)
    else:
        assert value is None or isinstance(value, bool | int | float | str | bytes | bytearray)


def program(draw: random.Random) -> bytes:
    """Opcodes of demos in any order."""
    names = [
        b"cnumpy\ndtype\n",
        b"cnumpy\nndarray\n",
        b"cnumpy.core.multiarray\n_reconstruct\n",
        b"cnumpy.core.multiarray\nscalar\n",
        b"cnumpy.core.numeric\n_frombuffer\n",
        b"c_codecs\nencode\n",
        b"ccopy_reg\n_reconstructor\n",
        b"c__builtin__\nobject\n",
        b"crlbench.demo\nDemo\n",
        b"crlbench.backend.observation\nObservation\n",
    ]
    texts = [b"f8", b"O", b"V8", b"|", b"<", b"a", b"latin1", b"C", b"front_rgb", b"_observations", b"\xc3\xbf" * 8]
    values = [b"N", b"\x88", b"\x89", b"K\x03", b"K\x01", b"J\xff\xff\xff\xff", b"K\x08", b"]", b"}", b")"]
    values.append(b"G" + b"\0" * 8)
    values += [b"X" + struct.pack("<I", len(text)) + text for text in texts] + [b"C\x08" + b"\x41" * 8]
    acts = [b"R", b"b", b"\x81", b"\x85", b"\x86", b"\x87", b"(", b"t", b"l", b"d", b"a", b"e", b"s", b"u", b"2", b"0"]
    acts += [b"q\x00", b"q\x01", b"h\x00", b"h\x01", b"\x94", b"1"]
    pools = draw.choices((names, values, acts), weights=(2, 4, 6), k=draw.randrange(1, 60))
    return b"\x80\x04" + b"".join(draw.choice(pool) for pool in pools) + b"."


def test_no_pickle_does_harm() -> None:
    whole = [demo_bytes(demo_of(2), "rlbench"), *(pickle.dumps(demo_of(1), protocol) for protocol in (0, 2, 4, 5))]
    whole.append(pickle.dumps(array_with(np.dtype("f8"))))
    whole += [data for data in HOSTILE.values() if isinstance(data, bytes) and len(data) < 9999]
    draw = random.Random(7)
    refused = 0
    count = cases(3000)
    for case in range(count):
        data = program(draw) if case % 3 == 0 else damaged(draw.choice(whole), draw)
        try:
            look_at(plain_value(data), [32 * len(data) + 100])
        except NotPlain:
            refused += 1
    assert 0.3 * count < refused < count, "some of what is damaged can still be read"


def test_reading_takes_no_more_memory_than_the_file() -> None:
    """In a process with little memory: each of these asks for gigabytes."""
    code = """
import resource, sys
from stampede.rlbench.backend.unpickling import NotPlain, plain_value
sys.path.insert(0, sys.argv[1])
from test_pickles import HOSTILE
import pickle
resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))
for data in HOSTILE.values():
    try:
        plain_value(data if isinstance(data, bytes) else pickle.dumps(data, protocol=2))
    except NotPlain as error:
        assert "MemoryError" not in str(error), error
    else:
        raise AssertionError(data)
"""
    subprocess.run([sys.executable, "-c", code, str(Path(__file__).parent)], check=True, timeout=120)
