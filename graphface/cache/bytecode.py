"""What a code object says, without where it says it.

Comments, docstrings and line numbers must not change a fingerprint, and the source of a function may not exist (a
notebook, a generated method), so the compiled code is read. Hashing `co_code` as it stands would not do: it names
constants and globals by index, and adding a docstring shifts every index. Here each instruction is spelled with what
its index stands for; a docstring is a constant that no instruction loads, and drops out by itself.
"""

from __future__ import annotations

import dis
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from types import CodeType
from typing import Any

from graphface.values.digest import Undigestible, exact, new_hash

PYTHON = f"{sys.implementation.name} {sys.version_info.major}.{sys.version_info.minor}"
"""Bytecode differs between versions of Python, so digests do too."""

_CONSTANT = frozenset(dis.hasconst)
_NAMED = frozenset(dis.hasname)
_IGNORED = frozenset(dis.opmap[name] for name in ("CACHE", "NOP", "RESUME") if name in dis.opmap)
_FLAG_BITS = {"LOAD_GLOBAL": 1} | ({"LOAD_ATTR": 1, "LOAD_SUPER_ATTR": 2} if sys.version_info >= (3, 12) else {})
_SHIFT = {dis.opmap[name]: bits for name, bits in _FLAG_BITS.items() if name in dis.opmap}
"""Low bits of the argument that are flags; the index of the name lies above them."""

_HAS_DOCSTRING = 0x4000000
"""A flag of `co_flags` since 3.13."""

_NOTED_BY_CLASSES = frozenset({"__doc__", "__firstlineno__", "__static_attributes__"})
"""What the body of a class stores that is documentation, or (since 3.13) derived from where and what the code is."""

_LOADS_CONSTANT = _CONSTANT | frozenset(dis.opmap[name] for name in ("LOAD_SMALL_INT",) if name in dis.opmap)
_STORE_NAME = dis.opmap["STORE_NAME"]
_READS_NAME = frozenset({"LOAD_GLOBAL", "LOAD_NAME", "LOAD_FROM_DICT_OR_GLOBALS"})
_READS_ATTRIBUTE = frozenset({"LOAD_ATTR", "LOAD_METHOD"})


@dataclass(frozen=True)
class Import:
    """An import statement inside a function: `names` is None for `import module`."""

    module: str
    level: int
    names: tuple[str, ...] | None


@dataclass(frozen=True)
class CodeContent:
    """What one code object, nested ones included, is made of.

    Attributes:
        digest: 16 bytes over instructions, constants, arguments and flags.
        references: global names read, each with the attributes read off it at once (`("sh", "basis")`).
        imports: import statements.
        names: every name and attribute mentioned.
    """

    digest: bytes
    references: tuple[tuple[str, ...], ...]
    imports: tuple[Import, ...]
    names: frozenset[str]


@lru_cache(maxsize=8192)
def read_code(code: CodeType) -> CodeContent:
    """The content of `code`."""
    state = new_hash()
    references: dict[tuple[str, ...], None] = {}
    imports: dict[Import, None] = {}
    chain: list[str] = []
    recent: list[Any] = []
    for opcode, argument, meaning in _that_count(code):
        name = dis.opname[opcode]
        if opcode in _CONSTANT:
            state.update(b"%d=" % opcode + _constant(meaning))
            recent = [*recent[-1:], meaning]
        elif opcode in _NAMED:
            state.update(b"%d,%d:%b" % (opcode, _flags(opcode, argument), meaning.encode("utf-8", "surrogatepass")))
        else:
            state.update(b"%d.%d" % (opcode, argument))
            if name == "LOAD_SMALL_INT":  # 3.14: the level of an import may come this way
                recent = [*recent[-1:], argument]
        state.update(b";")
        if chain and name in _READS_ATTRIBUTE:
            chain.append(meaning)
            continue
        if chain:
            references[tuple(chain)] = None
        chain = [meaning] if name in _READS_NAME else []
        if name == "IMPORT_NAME":
            level, names = (*recent, 0, None)[:2]
            imports[Import(meaning, level, names)] = None
    state.update(_constant(_frame(code)))
    nested = [read_code(constant) for constant in code.co_consts if isinstance(constant, CodeType)]
    return CodeContent(
        digest=state.digest(),
        references=tuple({**references, **dict.fromkeys(r for inner in nested for r in inner.references)}),
        imports=tuple({**imports, **dict.fromkeys(i for inner in nested for i in inner.imports)}),
        names=frozenset(code.co_names).union(*(inner.names for inner in nested)),
    )


def instructions(code: CodeType) -> Iterator[tuple[int, int, Any]]:
    """(opcode, argument, constant or name it stands for); a tenth of the cost of `dis.get_instructions`."""
    raw, extended = code.co_code, 0
    for position in range(0, len(raw), 2):
        opcode, argument = raw[position], raw[position + 1] | extended
        if opcode == dis.EXTENDED_ARG:
            extended = argument << 8
            continue
        extended = 0
        if opcode in _IGNORED:
            continue
        if opcode in _CONSTANT:
            yield opcode, argument, code.co_consts[argument]
        elif opcode in _NAMED:
            yield opcode, argument, code.co_names[argument >> _SHIFT.get(opcode, 0)]
        else:
            yield opcode, argument, None


def _that_count(code: CodeType) -> Iterator[tuple[int, int, Any]]:
    """The instructions, but for the pairs that load a constant and store it as one of `_NOTED_BY_CLASSES`."""
    last: tuple[int, int, Any] | None = None
    for instruction in instructions(code):
        opcode, _, meaning = instruction
        if last is not None and opcode == _STORE_NAME and meaning in _NOTED_BY_CLASSES and last[0] in _LOADS_CONSTANT:
            last = None
            continue
        if last is not None:
            yield last
        last = instruction
    if last is not None:
        yield last


def _flags(opcode: int, argument: int) -> int:
    return argument & ((1 << _SHIFT.get(opcode, 0)) - 1)


def _frame(code: CodeType) -> tuple[Any, ...]:
    """What the instructions do not say: arguments, variables, flags, and where exceptions are caught."""
    counts = (code.co_argcount, code.co_posonlyargcount, code.co_kwonlyargcount, code.co_flags & ~_HAS_DOCSTRING)
    return (*counts, code.co_varnames, code.co_cellvars, code.co_freevars, code.co_exceptiontable)


def _constant(value: Any) -> bytes:
    """A constant as bytes; sets in it are ordered, since their order depends on the process."""
    if isinstance(value, CodeType):
        return b"C" + read_code(value).digest
    try:
        return exact(value)
    except Undigestible:
        return repr(value).encode()
