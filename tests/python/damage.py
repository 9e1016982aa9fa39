"""Damaged files, for tests of what reads them. STAMPEDE_FUZZ: how many times more than usual, as .ci/soak sets it."""

import os
import random

_ODD = [b"\xff" * 8, b"\0" * 8, b"\xff\xff\xff\x7f", b"\0\0\0\x80", b"\x01", b"\xff", b"9" * 30, b"-1", b"nan"]


def cases(usual: int) -> int:
    return usual * int(os.environ.get("STAMPEDE_FUZZ", "1"))


def damaged(data: bytes, draw: random.Random, head: int = 4096) -> bytes:
    """Cut off, or with some bytes changed, overwritten, taken out or doubled; half of these within the first `head`."""
    if draw.random() < 0.15:
        return data[: draw.randrange(len(data))]
    result = bytearray(data)
    for _ in range(draw.choice((1, 1, 2, 5, 20))):
        end = min(len(result), head) if draw.random() < 0.5 else len(result)
        if end == 0:
            break
        at = draw.randrange(end)
        kind = draw.randrange(5)
        if kind == 0:
            result[at] = draw.randrange(256)
        elif kind == 1:
            result[at] ^= 1 << draw.randrange(8)
        elif kind == 2:
            odd = draw.choice(_ODD)
            result[at : at + len(odd)] = odd
        elif kind == 3:
            del result[at : at + draw.randrange(1, 40)]
        else:
            result[at:at] = result[at : at + draw.randrange(1, 40)]
    return bytes(result)
