"""Digests by content: what a graph input is, what a parameter says.

One prefix-free encoding serves both. Each value becomes a tag, a length and a payload, so that no two different
structures share their bytes; an array contributes dtype, shape and its buffer without a copy. `digest_value` feeds the
encoding to a hash, `canonical` returns it. They differ in one point only: parameters are written by people, for whom
`1`, `1.0` and `1e0` are one number, while an operator can tell an input 1 from an input 1.0.

The hash is xxh3 where xxhash is installed (12 MiB in about a millisecond) and BLAKE2b elsewhere. Both give 16 bytes;
the algorithm's name goes into every preimage, so two installations never take each other's digests for their own. xxh3
does not resist an adversary, and need not: whoever can write into a cache folder has no use for a collision.
"""

from __future__ import annotations

import hashlib
import os
import struct
import time
from collections.abc import Callable, Iterable, Sequence
from enum import Enum
from pathlib import Path, PurePath
from typing import Any, Protocol

import numpy as np

from graphface.errors import UnreadableFile, UsageError
from graphface.values.parts import MODEL, Named, Rule, rule_of

try:
    import xxhash

    _xxh3: Any = xxhash.xxh3_128
except ImportError:  # the `fast` extra is not installed
    _xxh3 = None

ALGORITHM = "blake2b_128" if _xxh3 is None else "xxh3_128"
DIGEST_SIZE = 16

RACY_NS = 2_000_000_000
"""A file changed this recently may change again within one tick of its time stamp (2 s on FAT): stat proves nothing."""

_FILES_REMEMBERED = 4096
_CHUNK = 1 << 20


class Undigestible(UsageError, TypeError):
    """A value that has no digest by content; `value_type` is the type met, possibly deep inside."""

    def __init__(self, value_type: type, hint: str) -> None:
        super().__init__(f"cannot digest a value of type {value_type.__module__}.{value_type.__qualname__}: {hint}")
        self.value_type = value_type


class Hash(Protocol):
    def update(self, data: Any, /) -> None: ...
    def digest(self) -> bytes: ...


def new_hash(algorithm: str = ALGORITHM) -> Hash:
    """A hash of `DIGEST_SIZE` bytes that has taken in its own name.

    Raises:
        LookupError: the algorithm is not available here.
    """
    if algorithm == "xxh3_128" and _xxh3 is not None:
        return _xxh3(b"graphface/1 xxh3_128\n")  # type: ignore[no-any-return]
    if algorithm == "blake2b_128":
        return hashlib.blake2b(b"graphface/1 blake2b_128\n", digest_size=DIGEST_SIZE)
    raise LookupError(f"hash {algorithm!r} is not available; install graphface[fast]")


def digest_value(value: object) -> bytes:
    """16 bytes that stand for the content of a graph input.

    Arrays count by dtype, shape and C-order bytes (so NaN equals itself), records by type and parts
    (`graphface.values.parts`), a Path by its text and, where it is a file, its content.

    Raises:
        Undigestible: some part of the value has no content that could be read (an open file, an object array).
    """
    state = new_hash()
    _write_root(value, state.update, strict=True)
    return state.digest()


def canonical(value: object) -> bytes:
    """The same bytes for equal parameters, other bytes for any others.

    Integral floats and integers coincide, as do 0.0 and -0.0; True is not 1, a tuple is not a list; dictionaries are
    unordered. A Path counts by its text. Pass the validated pydantic model itself rather than its dump: two models of
    a union may have the same fields.

    Raises:
        Undigestible: as for `digest_value`.
    """
    parts: list[Any] = []
    _write_root(value, parts.append, strict=False)
    return b"".join(parts)


def exact(value: object) -> bytes:
    """As `canonical`, for constants of code: 1, 1.0, True and -0.0 all differ; a Path counts with its content.

    Raises:
        Undigestible: as for `digest_value`.
    """
    return _encoded(value, strict=True)


def digest_file(path: Path | str, *, stat_shortcut: bool = True) -> bytes:
    """16 bytes that stand for the content of a file.

    With `stat_shortcut`, a file whose path, size, times and inode are those of an earlier call in this process is not
    read again, unless it had changed shortly before that call: a second change may then hide in the same time stamp.

    Raises:
        UnreadableFile: it is missing, a folder, or not permitted.
    """
    given, path = path, os.path.abspath(path)
    try:
        before = _identity(os.stat(path))
        known = _remembered.get(path) if stat_shortcut else None
        if known is not None and known[0] == before:
            return known[1]
        started = time.time_ns()
        digest, after = _hash_file(path)
    except OSError as error:
        raise UnreadableFile(given, error.strerror or str(error)) from error
    settled = max(after.st_mtime_ns, after.st_ctime_ns) < started - RACY_NS
    if settled and _identity(after) == before:
        if len(_remembered) >= _FILES_REMEMBERED:
            _remembered.clear()
        _remembered[path] = (before, digest)
    return digest


_Identity = tuple[int, ...]
_remembered: dict[str, tuple[_Identity, bytes]] = {}


def _identity(status: os.stat_result) -> _Identity:
    """What changes when a file does; ctime also catches an edit whose mtime was set back."""
    return (status.st_size, status.st_mtime_ns, status.st_ctime_ns, status.st_ino, status.st_dev)


def _hash_file(path: str) -> tuple[bytes, os.stat_result]:
    state = new_hash()
    state.update(b"file\n")
    buffer = memoryview(bytearray(_CHUNK))
    with open(path, "rb", buffering=0) as file:
        while count := file.readinto(buffer):
            state.update(buffer[:count])
        return state.digest(), os.fstat(file.fileno())


_Emit = Callable[[Any], object]


def _write_root(value: object, emit: _Emit, *, strict: bool) -> None:
    try:
        _write(value, emit, strict)
    except RecursionError:
        raise Undigestible(type(value), "it contains itself, or is nested too deeply") from None


def _write(value: Any, emit: _Emit, strict: bool) -> None:
    """Emit the encoding of `value`: one tag, then what makes the rest self-delimiting."""
    kind = type(value)
    if kind is float and strict:
        emit(b"f" + (b"nan-nan-" if value != value else struct.pack("<d", value)))
    elif kind is str:
        _text(b"s", value, emit)
    elif (rule := rule_of(kind)) is not None:
        _write_parts(value, rule, emit, strict)
    else:
        _write_whole(value, emit, strict)


def _write_whole(value: Any, emit: _Emit, strict: bool) -> None:
    """Emit the encoding of a value that has no parts."""
    for kinds, write in _STRICT if strict else _LOOSE:
        if isinstance(value, kinds):
            write(value, emit, strict)
            return
    hint = "pass plain values, arrays, dataclasses or pydantic models, or say its parts with register_parts"
    raise Undigestible(type(value), hint)


def _write_parts(value: Any, rule: Rule, emit: _Emit, strict: bool) -> None:
    kind = type(value)
    if isinstance(value, set | frozenset):
        emit(b"S%d:" % len(value))
        for item in sorted(_encoded(item, strict) for item in value):
            emit(item)
    elif isinstance(value, list | tuple):
        if kind not in (list, tuple):
            _text(b"D", _name(kind), emit)
        emit(b"%c%d:" % (b"l" if isinstance(value, list) else b"t", len(value)))
        for item in value:
            _write(item, emit, strict)
    else:
        if isinstance(rule, Named):
            _text(b"M" if rule is MODEL else b"D", _name(kind), emit)
        _write_pairs(rule.items(value), emit, strict)


def _write_generic(value: Any, emit: _Emit, strict: bool) -> None:
    _text(b"g", value.dtype.str, emit)
    _sized(b"b", value.tobytes(), emit)


def _write_path(value: PurePath, emit: _Emit, strict: bool) -> None:
    _text(b"p", str(value), emit)
    if strict and os.path.isfile(value):
        emit(b"+" + digest_file(Path(value)))


def _write_number(value: Any, emit: _Emit, strict: bool) -> None:
    if isinstance(value, complex):
        emit(b"c")
        _write_number(value.real, emit, strict)
        _write_number(value.imag, emit, strict)
    elif isinstance(value, int | np.integer) or (not strict and float(value).is_integer()):
        whole = int(value)
        # Python refuses to spell very large integers in decimal.
        _text(b"i", str(whole) if whole.bit_length() < 512 else hex(whole), emit)
    else:
        emit(b"f" + (b"nan-nan-" if value != value else struct.pack("<d", value)))


def _write_array(array: Any, emit: _Emit, strict: bool) -> None:
    if array.dtype.hasobject:
        raise Undigestible(type(array), "an object array holds references, not content; give it a numeric dtype")
    if isinstance(array, np.ma.MaskedArray):
        raise Undigestible(type(array), "pass the data and the mask as two arrays")
    layout = array.dtype.descr if array.dtype.names else array.dtype.str
    _text(b"a", f"{layout} {array.shape}", emit)
    # `view` drops the dtype, which memoryview may not know (float16, datetime64).
    emit(np.ascontiguousarray(array).reshape(-1).view(np.uint8).data if array.size else b"")


_LOOSE: Sequence[tuple[Any, Callable[[Any, _Emit, bool], object]]] = (
    (type(None), lambda value, emit, strict: emit(b"N")),
    (Enum, lambda value, emit, strict: _text(b"e", f"{_name(type(value))}.{value.name}", emit)),
    ((bool, np.bool_), lambda value, emit, strict: emit(b"T" if value else b"F")),
    (str, lambda value, emit, strict: _text(b"s", value, emit)),
    ((int, np.integer, float, np.floating, complex), _write_number),
    ((bytes, bytearray, memoryview), lambda value, emit, strict: _sized(b"b", bytes(value), emit)),
    (np.ndarray, _write_array),
    (PurePath, _write_path),
    (type(...), lambda value, emit, strict: emit(b".")),
)
"""How values without parts are written; the first of the classes that a value is an instance of counts."""

_STRICT = (*_LOOSE[:4], (np.generic, _write_generic), *_LOOSE[4:])
"""The dtype of a NumPy scalar counts in an input, not in a parameter."""


def _write_pairs(pairs: Iterable[tuple[Any, Any]], emit: _Emit, strict: bool) -> None:
    """Name-value pairs, ordered by the encoding of the name: keys of several types cannot be compared otherwise."""
    encoded = sorted(((_encoded(name, strict), value) for name, value in pairs), key=lambda pair: pair[0])
    emit(b"d%d:" % len(encoded))
    for name, value in encoded:
        emit(name)
        _write(value, emit, strict)


def _encoded(value: object, strict: bool) -> bytes:
    parts: list[Any] = []
    _write(value, parts.append, strict)
    return b"".join(parts)


def _text(tag: bytes, text: str, emit: _Emit) -> None:
    _sized(tag, text.encode("utf-8", "surrogatepass"), emit)


def _sized(tag: bytes, payload: bytes, emit: _Emit) -> None:
    emit(b"%c%d:%b" % (tag, len(payload), payload))


def _name(kind: type) -> str:
    return f"{kind.__module__}.{kind.__qualname__}"
