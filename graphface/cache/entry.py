"""One stored value as one file: a safetensors file whose header also holds the structure, the key and a checksum.

Any safetensors reader opens it. The checksum stands at a fixed place near the front and covers every byte of the file,
its own digits counted as zeros, so that damage to the header is seen as surely as damage to the arrays.

    8 bytes   length of the header, little endian
    header    {"__metadata__": {"checksum": "xxh3_128:…", "key": …, "meta": …, "structure": …}, "0": {"dtype": …}, …}
    arrays    one after another, in C order

The format is written here rather than by the safetensors package because the package copies every array twice on the
way to a file; here arrays are handed to the kernel where they lie, and read back as views of the file's bytes.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from graphface.values.codec import TENSOR_DTYPES, Tensors
from graphface.values.digest import ALGORITHM, DIGEST_SIZE, new_hash

_DTYPES = dict(zip("BOOL U8 I8 U16 I16 F16 U32 I32 F32 U64 I64 F64".split(), TENSOR_DTYPES, strict=True))  # noqa: SIM905
_CODES = {np.dtype(dtype): code for code, dtype in _DTYPES.items()}

_START = b'{"__metadata__":{"checksum":"'
_ZEROS = b"0" * (2 * DIGEST_SIZE)
_ALIGN = 64
MAX_HEADER = 64 << 20


class DamagedEntry(Exception):
    """The bytes are not an intact entry; the message says what is wrong with them."""


class UnknownChecksum(Exception):
    """The entry is checksummed with a hash that is not installed here: neither good nor bad."""


def pack(tensors: Tensors, structure: Any, key: bytes, meta: dict[str, Any]) -> list[Any]:
    """The buffers that make up the file, in order; arrays are not copied."""
    # Wide items first: every array then starts at a multiple of its item size.
    ordered = sorted(tensors.items(), key=lambda item: -item[1].itemsize)
    checksum = f"{ALGORITHM}:{_ZEROS.decode()}"
    about = {"checksum": checksum, "format": "graphface/1", "key": key.hex()}
    about |= {"meta": json.dumps(meta, default=str), "structure": json.dumps(structure, separators=(",", ":"))}
    table: dict[str, Any] = {"__metadata__": about}
    position = 0
    for name, array in ordered:
        end = position + array.nbytes
        table[name] = {"dtype": _CODES[array.dtype], "shape": array.shape, "data_offsets": (position, end)}
        position = end
    header = json.dumps(table, separators=(",", ":")).encode()
    header += b" " * (-(8 + len(header)) % _ALIGN)
    front = bytearray(len(header).to_bytes(8, "little") + header)
    bodies = [array.reshape(-1).view(np.uint8).data for _, array in ordered if array.size]
    digits = _checksum(ALGORITHM, [front, *bodies])
    at = 8 + len(_START) + len(ALGORITHM) + 1
    front[at : at + len(_ZEROS)] = digits
    return [front, *bodies]


def unpack(data: memoryview, key: bytes | None = None) -> tuple[Tensors, Any, dict[str, Any]]:
    """Arrays (read-only views of `data`), structure and meta of an intact entry.

    Args:
        data: the whole file, writable: the checksum's digits are zeroed in place.
        key: what the entry must be for.

    Raises:
        DamagedEntry: any byte is not what was written, or the entry is for another key.
        UnknownChecksum: it cannot be told.
    """
    table, start = read_header(data)
    about = table.pop("__metadata__")
    algorithm, _, digits = about["checksum"].partition(":")
    at = 8 + len(_START) + len(algorithm) + 1
    data[at : at + len(_ZEROS)] = _ZEROS
    try:
        found = _checksum(algorithm, [data])
    except LookupError as error:
        raise UnknownChecksum(str(error)) from None
    if found != digits.encode():
        raise DamagedEntry("its checksum does not match")
    if key is not None and about["key"] != key.hex():
        raise DamagedEntry("it belongs to another key")
    body = np.frombuffer(data.toreadonly(), np.uint8)[start:]
    tensors = {}
    for name, row in table.items():
        first, last = row["data_offsets"]
        tensors[name] = body[first:last].view(_DTYPES[row["dtype"]]).reshape(row["shape"])
    return tensors, json.loads(about["structure"]), json.loads(about["meta"])


def read_header(data: bytes | memoryview) -> tuple[dict[str, Any], int]:
    """The header's table, unverified, and where the arrays start. `data` may end after the header.

    Raises:
        DamagedEntry: there is no such header.
    """
    length = header_length(data)
    if len(data) < 8 + length:
        raise DamagedEntry("it ends within its header")
    try:
        table = json.loads(bytes(data[8 : 8 + length]))
        about = table["__metadata__"]
        checksum, _ = about["checksum"], (about["key"], about["structure"], about["meta"])
        if len(checksum.partition(":")[2]) != len(_ZEROS):
            raise DamagedEntry("its checksum is malformed")
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise DamagedEntry("its header is malformed") from None
    return table, 8 + length


def header_length(data: bytes | memoryview) -> int:
    """The length that the first bytes of a file announce.

    Raises:
        DamagedEntry: they are not the first bytes of an entry.
    """
    if len(data) < 8 + len(_START) or data[8 : 8 + len(_START)] != _START:
        raise DamagedEntry("it is not a graphface cache entry")
    length = int.from_bytes(data[:8], "little")
    if length > MAX_HEADER:
        raise DamagedEntry("its header has an impossible length")
    return length


def _checksum(algorithm: str, buffers: list[Any]) -> bytes:
    state = new_hash(algorithm)
    for buffer in buffers:
        state.update(buffer)
    return state.digest().hex().encode()
