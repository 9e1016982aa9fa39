"""Files of TFRecord and the `tf.train.Example` in each record, without TensorFlow.

Protobuf's encoding: a message is its fields one after the other, each a key, a length, and that many bytes. Example has
field 1, Features. Features has a field 1 for each feature: its name (1) and its Feature (2). Feature is a list of bytes
(1), float32 (2) or int64 (3), whose field 1 is the values. A record is a message between its length and checksums.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence

import numpy as np

from stampede.export.steps import Array


def features(values: Mapping[str, Array | Sequence[bytes]]) -> bytes:
    """Features by name: a list of bytes, or an array of float32, int64 or bool, row after row.

    What two calls give may be put one after the other.
    """
    return b"".join(_field(1, _field(1, name.encode()) + _field(2, _feature(one))) for name, one in values.items())


def example(features: bytes) -> bytes:
    """The message of these features."""
    return _field(1, features)


def record(message: bytes) -> bytes:
    """As it is in a file."""
    length = struct.pack("<Q", len(message))
    return b"".join([length, _masked_checksum(length), message, _masked_checksum(message)])


def crc32c(data: bytes) -> int:
    """The checksum CRC-32C (Castagnoli).

    It is the remainder of a division of polynomials. The data are cut into equal parts, of which all remainders are
    found at once. Then neighbours become one: the first is moved over the length of the second, and added to it.
    """
    data = _ONES + data
    parts = 1 << (len(data).bit_length() // 2)
    length = -(-len(data) // parts)
    zeros = parts * length - len(data)
    rows = np.frombuffer(bytes(zeros) + data + bytes(32 * length), dtype=np.uint8).reshape(parts + 32, length)
    # The last 32 rows move each bit over that length. So they are the columns of the matrix which moves any remainder.
    bits = np.left_shift(np.uint32(1), np.arange(32, dtype=np.uint32))
    remainders = np.concatenate([np.zeros(parts, dtype=np.uint32), bits])
    for column in np.ascontiguousarray(rows.T):
        remainders = _TABLE[(remainders ^ column) & 0xFF] ^ (remainders >> 8)
    remainders, matrix = remainders[:parts], remainders[parts:]
    while len(remainders) > 1:
        remainders = _product(matrix, remainders[0::2]) ^ remainders[1::2]
        matrix = _product(matrix, matrix)
    return int(remainders[0]) ^ 0xFFFFFFFF


def _feature(values: Array | Sequence[bytes]) -> bytes:
    if not isinstance(values, np.ndarray):
        return _field(1, b"".join(_field(1, one) for one in values))
    if values.dtype == np.float32:
        return _field(2, _field(1, values.astype("<f4").tobytes()))
    return _field(3, _field(1, b"".join(_varint(int(one)) for one in values.ravel())))


def _field(number: int, content: bytes) -> bytes:
    return b"".join([_varint(number << 3 | 2), _varint(len(content)), content])  # 2: its length is given


def _varint(number: int) -> bytes:
    """Seven bits a byte, the lowest first; a negative number as the 64 bits of its complement."""
    number &= 0xFFFFFFFFFFFFFFFF
    content = bytearray()
    while number >= 0x80:
        content.append(number & 0x7F | 0x80)
        number >>= 7
    content.append(number)
    return bytes(content)


def _masked_checksum(data: bytes) -> bytes:
    crc = crc32c(data)
    return struct.pack("<I", ((crc >> 15 | crc << 17) + 0xA282EAD8) & 0xFFFFFFFF)


def _product(matrix: Array, values: Array) -> Array:
    """Of a matrix of bits, its columns as uint32, and each of some values."""
    product = np.zeros_like(values)
    for place, column in enumerate(matrix):
        product ^= (values >> np.uint32(place) & np.uint32(1)) * column
    return product


def _table() -> Array:
    """Remainders of the bytes."""
    remainders: Array = np.arange(256, dtype=np.uint32)
    for _ in range(8):
        remainders = (remainders >> 1) ^ (remainders & 1) * np.uint32(0x82F63B78)
    return remainders


_TABLE = _table()
_ONES = bytes.fromhex("54641f64")  # bring a remainder of 0 to all ones, with which a checksum begins
