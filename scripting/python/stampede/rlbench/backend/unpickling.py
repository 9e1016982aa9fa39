"""Pickles of anybody, read without running them: opcodes are interpreted here, and nothing that they name is called.

What comes of a file is plain: None, truth values, numbers, texts, bytes, lists, tuples, dicts with texts as keys, numpy
arrays and scalars of numbers, Observation and Demo. An array is made of a type, a shape and bytes, each of which is
looked at first; no object gets a state that a file made up.
"""

from __future__ import annotations

import pickletools
import re
from collections.abc import Callable
from typing import Any

import numpy as np

from stampede.rlbench.backend.observation import FIELDS, Observation
from stampede.rlbench.demo import Demo

_MOST_BYTES = 1 << 30  # of a file
_MOST_DEPTH = 32  # of what lies in each other
_MOST_MARKS = 1000  # that are open at once
_MOST_AXES = 8
_MOST_BITS = 64  # of a whole number
_SHOWN = 80  # letters of a name, in a complaint
_REPEATS = 16  # a value may be in several places: by how much what is read may be larger than its file

_KINDS = re.compile(r"[<>=|]?(b1|[iu][1248]|f[248])")  # bool, whole numbers, floats
_ORDERS = ("<", ">", "=", "|")

# What a pickled demo names. numpy 1 and 2 have other modules for the same.
_NAMES = {
    "rlbench.demo.Demo": "Demo",
    "rlbench.backend.observation.Observation": "Observation",
    "numpy.ndarray": "ndarray",
    "numpy.dtype": "dtype",
    "numpy.core.multiarray._reconstruct": "reconstruct",
    "numpy.core.multiarray.scalar": "scalar",
    "numpy.core.numeric._frombuffer": "frombuffer",
    "_codecs.encode": "encode",
    "copyreg._reconstructor": "reconstructor",
    "builtins.object": "object",
}


class NotPlain(ValueError):
    """A pickle that is damaged, or holds more than demos are made of."""


class _Name:
    """Stands for a function or class that the file names."""

    def __init__(self, what: str) -> None:
        self.what = what


class _Type:
    """Stands for a numpy.dtype: `f8`, and the order of its bytes."""

    def __init__(self, kind: str) -> None:
        self.kind = kind
        self.order = "="

    def dtype(self) -> np.dtype[Any]:
        return np.dtype(self.kind).newbyteorder(self.order)


class _Unfilled:
    """Stands for an array whose state comes next, and where the memo has it."""

    def __init__(self) -> None:
        self.memo: list[int] = []


_STANDS_FOR = (_Name, _Type, _Unfilled)


def plain_value(data: bytes) -> Any:
    """The value that a pickle holds. Raises NotPlain for any other than those named above."""
    if len(data) > _MOST_BYTES:
        raise NotPlain(f"it has {len(data)} bytes")
    try:
        value = _Machine(len(data)).run(data)
        _check(value, len(data))
    except NotPlain:
        raise
    except (ValueError, TypeError, IndexError, KeyError, OverflowError, MemoryError, RecursionError) as error:
        raise NotPlain(str(error) or type(error).__name__) from error
    return value


class _Machine:
    def __init__(self, size: int) -> None:
        self._stack: list[Any] = []
        self._below: list[list[Any]] = []  # stacks under the marks
        self._memo: dict[int, Any] = {}
        self._array_bytes_left = size  # the bytes of each array are in the file

    def run(self, data: bytes) -> Any:
        for opcode, argument, _ in pickletools.genops(data):
            if opcode.name == "STOP":
                if self._below or len(self._stack) != 1:
                    raise NotPlain("it ends before it is whole")
                return self._stack[0]
            if opcode.name in _PUSHED:
                self._stack.append(argument)
                continue
            act = _ACTS.get(opcode.name)
            if act is None:
                raise NotPlain(f"it has the opcode {opcode.name}, which is in no demo")
            act(self, argument)
        raise NotPlain("it ends early")

    # Opcodes, by the names that pickletools has for them.

    def _push(self, value: Any) -> None:
        self._stack.append(value)

    def _mark(self, _: Any) -> None:
        if len(self._below) == _MOST_MARKS:
            raise NotPlain(f"more than {_MOST_MARKS} values are begun and not ended")
        self._below.append(self._stack)
        self._stack = []

    def _since_mark(self) -> list[Any]:
        if not self._below:
            raise NotPlain("a value ends that was not begun")
        values, self._stack = self._stack, self._below.pop()
        return values

    def _pop(self, _: Any) -> None:
        if self._stack:
            self._stack.pop()
        else:
            self._since_mark()

    def _take(self, count: int) -> tuple[Any, ...]:
        if len(self._stack) < count:
            raise NotPlain("a value is used that is not there")
        taken = tuple(self._stack[len(self._stack) - count :])
        del self._stack[len(self._stack) - count :]
        return taken

    def _top(self, kind: type) -> Any:
        if not self._stack or type(self._stack[-1]) is not kind:
            raise NotPlain(f"no {kind.__name__} is there to be filled")
        return self._stack[-1]

    def _put(self, number: int | None) -> None:
        value = self._stack[-1]
        number = len(self._memo) if number is None else int(number)
        self._memo[number] = value
        if isinstance(value, _Unfilled):
            value.memo.append(number)

    def _get(self, number: int) -> None:
        self._stack.append(self._memo[int(number)])

    def _append(self, _: Any) -> None:
        (value,) = self._take(1)
        self._top(list).append(value)

    def _appends(self, _: Any) -> None:
        values = self._since_mark()
        self._top(list).extend(values)

    def _set_item(self, _: Any) -> None:
        self._set_pairs(list(self._take(2)))

    def _set_items(self, _: Any) -> None:
        self._set_pairs(self._since_mark())

    def _set_pairs(self, values: list[Any]) -> None:
        self._top(dict).update(_pairs(values))

    def _global(self, names: str) -> None:
        self._stack.append(_name(*names.split(" ", 1)))

    def _stack_global(self, _: Any) -> None:
        self._stack.append(_name(*self._take(2)))

    def _new_object(self, _: Any) -> None:
        made, arguments = self._take(2)
        self._stack.append(self._object(made, arguments))

    def _object(self, made: Any, arguments: Any) -> Any:
        if isinstance(made, _Name) and arguments == ():
            if made.what == "Demo":
                return Demo([])
            if made.what == "Observation":
                return Observation()
        raise NotPlain("it makes an object that is no part of a demo")

    def _reduce(self, _: Any) -> None:
        function, arguments = self._take(2)
        call = _CALLS.get(function.what) if isinstance(function, _Name) else None
        if call is None or not isinstance(arguments, tuple):
            raise NotPlain("it calls what is no part of a demo")
        self._stack.append(call(self, *arguments))

    def _reconstructor(self, made: Any, base: Any, state: Any) -> Any:
        if not (isinstance(base, _Name) and base.what == "object" and state is None):
            raise NotPlain("it makes an object that is no part of a demo")
        return self._object(made, ())

    def _build(self, _: Any) -> None:
        filled, state = self._take(2)
        if isinstance(filled, _Type):
            _order(filled, state)
        elif isinstance(filled, _Unfilled):
            array = self._array_of(state)
            for number in filled.memo:
                self._memo[number] = array
            filled = array
        elif isinstance(filled, Demo | Observation):
            _fill(filled, state)
        else:
            raise NotPlain("it gives a state to what has none")
        self._stack.append(filled)

    # What a file may ask to be called.

    def _unfilled(self, kind: Any, shape: Any, letter: Any) -> _Unfilled:
        if not (isinstance(kind, _Name) and kind.what == "ndarray" and shape == (0,) and letter in (b"b", "b")):
            raise NotPlain("it has an array that is none of numpy's")
        return _Unfilled()

    def _array_of(self, state: Any) -> np.ndarray:
        if not isinstance(state, tuple) or len(state) != 5 or state[0] != 1 or type(state[3]) not in (bool, int):
            raise NotPlain("an array is described in another way than numpy does")
        _, shape, kind, columns_first, data = state
        return self._array(data, kind, shape, "F" if columns_first else "C")

    def _array(self, data: Any, kind: Any, shape: Any, order: Any = "C") -> np.ndarray:
        data = data.encode("latin-1") if isinstance(data, str) else data
        if not isinstance(kind, _Type) or not isinstance(data, bytes | bytearray) or order not in ("C", "F"):
            raise NotPlain("an array is described in another way than numpy does")
        if not isinstance(shape, tuple) or len(shape) > _MOST_AXES:
            raise NotPlain("an array has a shape that is none")
        dtype, count = kind.dtype(), 1
        for size in shape:
            if type(size) is not int or not 0 <= size <= _MOST_BYTES:
                raise NotPlain("an array has a shape that is none")
            count *= size
        if count * dtype.itemsize != len(data):
            raise NotPlain(f"an array of shape {shape} has {len(data)} bytes")
        self._array_bytes_left -= len(data)
        if self._array_bytes_left < 0:
            raise NotPlain("its arrays are larger than itself")
        if dtype.kind == "b":  # a truth value is 0 or 1, and no other byte
            values = np.frombuffer(data, np.uint8) != 0
        else:
            values = np.frombuffer(data, dtype).astype(dtype.newbyteorder("="))
        return values.reshape(shape, order=order)

    def _scalar(self, kind: Any, data: Any) -> Any:
        return self._array(data, kind, ())[()]

    def _dtype(self, kind: Any, aligned: Any = False, copied: Any = True) -> _Type:
        if not isinstance(kind, str) or not _KINDS.fullmatch(kind) or aligned not in (False, 0):
            raise NotPlain("it has an array of something else than numbers")
        return _Type(kind.lstrip("<>=|"))

    def _encode(self, text: Any, encoding: Any) -> bytes:
        if not isinstance(text, str) or encoding not in ("latin1", "latin-1"):
            raise NotPlain("it has bytes in an encoding that pickle does not use")
        return text.encode("latin-1")


def _name(module: Any, name: Any) -> _Name:
    if not isinstance(module, str) or not isinstance(name, str):
        raise NotPlain("it names something without a name")
    full = f"{module}.{name}".removeprefix("stampede.")
    full = re.sub(r"^numpy\._core\.", "numpy.core.", full)
    full = re.sub(r"^(copy_reg|__builtin__)\.", lambda old: {"copy_reg": "copyreg."}.get(old[1], "builtins."), full)
    if full not in _NAMES:
        shown = f"{module}.{name}"[:_SHOWN]
        raise NotPlain(f"it has a {shown if shown.isprintable() else ascii(shown)}, which is no part of a demo")
    return _Name(_NAMES[full])


def _order(kind: _Type, state: Any) -> None:
    """What numpy says of a type beside its name: that of a number has nothing but an order of bytes."""
    if not isinstance(state, tuple) or not 8 <= len(state) <= 9 or state[0] not in (2, 3, 4):
        raise NotPlain("a type of numbers is described in another way than numpy does")
    if state[1] not in _ORDERS or state[2:8] != (None, None, None, -1, -1, 0) or any(state[8:]):
        raise NotPlain("it has an array of something else than numbers")
    kind.order = state[1]


def _fill(filled: Demo | Observation, state: Any) -> None:
    if not isinstance(state, dict):
        raise NotPlain("an object has a state without names")
    for name, value in state.items():
        if name.startswith("_") and name != "_observations":
            raise NotPlain(f"a {type(filled).__name__} has a field that begins with _")
        if isinstance(filled, Demo) or name in FIELDS:
            filled.__dict__[name] = value


def _pairs(values: list[Any]) -> dict[str, Any]:
    if len(values) % 2:
        raise NotPlain("a name has no value")
    for name in values[::2]:
        if type(name) is not str:
            raise NotPlain(f"a value has no text for a name, but a {type(name).__name__}")
    return dict(zip(values[::2], values[1::2], strict=True))


def _is_list_of_observations(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(one, Observation) for one in value)


def _check(value: Any, size: int) -> None:
    """Nothing is left that stands for something else, nothing holds itself, and nothing is vast."""
    sizes: dict[int, int] = {}  # of what has parts, as a tree; 0: it is being looked at

    def count(one: Any, depth: int) -> int:
        if isinstance(one, _STANDS_FOR):
            raise NotPlain("it holds a part of an array that is no array")
        parts: Any = one
        if isinstance(one, int) and one.bit_length() > _MOST_BITS:
            raise NotPlain(f"it has a number of {one.bit_length()} bits")
        if isinstance(one, Demo) and not _is_list_of_observations(one._observations):
            raise NotPlain("a demo is no list of observations")
        if isinstance(one, Demo | Observation):
            parts = list(vars(one).values())
        elif isinstance(one, dict):
            parts = list(one.values())
        elif not isinstance(one, list | tuple):
            return 1
        known = sizes.get(id(one))
        if known == 0 or depth == _MOST_DEPTH:
            raise NotPlain("what it holds lies in itself" if known == 0 else f"more than {_MOST_DEPTH} lists in lists")
        if known is None:
            sizes[id(one)] = 0
            known = sizes[id(one)] = 1 + sum(count(part, depth + 1) for part in parts)
        return known

    if count(value, 0) > _REPEATS * size:
        raise NotPlain("what it holds is far larger than itself")


_PUSHED = frozenset(
    "INT BININT BININT1 BININT2 LONG LONG1 LONG4 STRING BINSTRING SHORT_BINSTRING BINBYTES SHORT_BINBYTES BINBYTES8 "
    "BYTEARRAY8 UNICODE SHORT_BINUNICODE BINUNICODE BINUNICODE8 FLOAT BINFLOAT".split()
)
_ACTS: dict[str, Callable[[_Machine, Any], None]] = {
    "PROTO": lambda machine, _: None,
    "FRAME": lambda machine, _: None,
    "NONE": lambda machine, _: machine._push(None),
    "NEWTRUE": lambda machine, _: machine._push(True),
    "NEWFALSE": lambda machine, _: machine._push(False),
    "EMPTY_LIST": lambda machine, _: machine._push([]),
    "EMPTY_DICT": lambda machine, _: machine._push({}),
    "EMPTY_TUPLE": lambda machine, _: machine._push(()),
    "LIST": lambda machine, _: machine._push(machine._since_mark()),
    "TUPLE": lambda machine, _: machine._push(tuple(machine._since_mark())),
    "DICT": lambda machine, _: machine._push(_pairs(machine._since_mark())),
    "TUPLE1": lambda machine, _: machine._push(machine._take(1)),
    "TUPLE2": lambda machine, _: machine._push(machine._take(2)),
    "TUPLE3": lambda machine, _: machine._push(machine._take(3)),
    "MARK": _Machine._mark,
    "POP": _Machine._pop,
    "POP_MARK": lambda machine, _: machine._since_mark().clear(),
    "DUP": lambda machine, _: machine._push(machine._stack[-1]),
    "PUT": _Machine._put,
    "BINPUT": _Machine._put,
    "LONG_BINPUT": _Machine._put,
    "MEMOIZE": _Machine._put,
    "GET": _Machine._get,
    "BINGET": _Machine._get,
    "LONG_BINGET": _Machine._get,
    "APPEND": _Machine._append,
    "APPENDS": _Machine._appends,
    "SETITEM": _Machine._set_item,
    "SETITEMS": _Machine._set_items,
    "GLOBAL": _Machine._global,
    "STACK_GLOBAL": _Machine._stack_global,
    "NEWOBJ": _Machine._new_object,
    "REDUCE": _Machine._reduce,
    "BUILD": _Machine._build,
}
_CALLS: dict[str, Callable[..., Any]] = {
    "reconstruct": _Machine._unfilled,
    "frombuffer": _Machine._array,
    "scalar": _Machine._scalar,
    "dtype": _Machine._dtype,
    "encode": _Machine._encode,
    "reconstructor": _Machine._reconstructor,
}
