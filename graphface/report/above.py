"""The values that a drawn value was made from: what `View.above` looks through.

A mask is looked at over its photo, landmarks on it. Whoever draws the values of a run knows the graph and where values
are kept; `above` finds the nearest one of a type, breadth first against the wires.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

import numpy as np

from graphface.cache.memory import MISSING
from graphface.graph.request import Request
from graphface.graph.structure import Ref
from graphface.values.port_types import ArrayType, Atom, PortType, output_fields

_DEPTH = 3
"""How many records deep a type is searched: a list of meshes with cameras is deep enough."""


def above(request: Request, slot: int, value_of: Callable[[int], Any]) -> Callable[[Atom], Any]:
    """For the value at a slot: a function from a type to the nearest value of it among those it was made from, or None.

    Breadth first through what is plugged into the node, then into those nodes, graph inputs included. Of a record the
    fields count too, after the record itself. Only values whose declared type may hold the one asked for are looked up.

    Args:
        value_of: from a slot to its value; None or `MISSING` where it is not known. Called once for a slot.
    """
    value_of = cache(value_of)

    @cache
    def nearest(kind: Atom) -> Any:
        for ref in _refs_above(request, slot):
            declared = request.graph.type_of(ref)
            if not any(True for _ in _paths(declared, kind)):
                continue
            value = value_of(ref.slot)
            if value is None or value is MISSING:
                continue
            found = next(_values(_at(value, ref.fields), declared, kind), None)
            if found is not None:
                return found
        return None

    return nearest


def _refs_above(request: Request, slot: int) -> Iterator[Ref]:
    """What is plugged in at a slot, then above that, nearest first; each once, a field before the record it is of."""
    seen: set[Ref] = set()
    expanded = {slot}
    level = [slot]
    while level:
        below, level = level, []
        for current in below:
            step = request.graph.step(current)
            for ref in [] if step is None else [ref for argument in step.arguments for ref in argument.refs]:
                whole = (Ref(ref.slot, ref.fields[:n]) for n in range(len(ref.fields), -1, -1))
                for part in whole:
                    if part not in seen:
                        seen.add(part)
                        yield part
                if ref.slot not in expanded:
                    expanded.add(ref.slot)
                    level.append(ref.slot)


def _paths(declared: PortType, kind: Atom, depth: int = _DEPTH) -> Iterator[tuple[str, ...]]:
    """Where a value of the declared type may hold one of `kind`: paths of fields, shortest first."""
    if any(_may_be(atom, kind) for atom in declared.alternatives):
        yield ()
    if depth:
        for atom in declared.alternatives:
            for name, inner in output_fields(atom).items() if isinstance(atom, type) else ():
                for path in _paths(inner, kind, depth - 1):
                    yield (name, *path)


def _values(value: Any, declared: PortType, kind: Atom) -> Iterator[Any]:
    for path in sorted(_paths(declared, kind), key=len):
        found = _at(value, path)
        if _is(found, kind):
            yield found


def _may_be(declared: Atom, kind: Atom) -> bool:
    if isinstance(kind, ArrayType):
        return isinstance(declared, ArrayType) and declared.is_a(kind)
    if isinstance(kind, type) and isinstance(declared, ArrayType):
        return issubclass(np.ndarray, kind)
    if isinstance(kind, type) and isinstance(declared, type):
        return declared is object or issubclass(declared, kind) or issubclass(kind, declared)
    return declared is kind


def _is(value: Any, kind: Atom) -> bool:
    if isinstance(kind, ArrayType):
        return kind.problem(value) is None
    return isinstance(kind, type) and isinstance(value, kind)


def _at(value: Any, fields: tuple[str, ...]) -> Any:
    """`value.field.field...`; None where there is no such field."""
    for name in fields:
        value = getattr(value, name, None)
    return value
