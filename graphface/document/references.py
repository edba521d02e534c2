"""What a name in a graph file means: "photo", "face.normals", "face/surface.depth".

A file sees its own nodes and inputs, and of a graph used as a node its outputs ("face.normals") and, for those who look
inside, its nodes ("face/surface"). An input of a used graph stands for whatever its user plugged in, so following a
reference may lead outwards and inwards again.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from graphface.document.document import Document, Wire
from graphface.errors import DocumentError, Problem, nearest_names
from graphface.place import Place

MAX_NESTING = 32
MAX_WIRES = 10_000
"""Into one port, beyond those that a file writes out: lists of lists through nested graphs double at every step."""

Complain = Callable[[str, Place | None, Sequence[str]], None]
Found = tuple[tuple["Target", ...], bool]
"""Targets in the flat graph, and whether they form a list."""


@dataclass(frozen=True)
class Target:
    """What a wire leads to: a node or graph input of the flat graph, and fields of its value."""

    name: str
    fields: tuple[str, ...] = ()

    def __str__(self) -> str:
        return ".".join((self.name, *self.fields))


@dataclass
class Scope:
    """One graph file in its place in the nesting: what its names mean."""

    prefix: str
    document: Document
    parent: Scope | None
    wires: dict[str, Wire]
    graphs: dict[str, Scope] = field(default_factory=dict)


class References:
    """Follows references; what cannot be followed goes to `complain` (message, place, nearest names)."""

    def __init__(self, complain: Complain) -> None:
        self._complain = complain

    def wire(self, scope: Scope, wire: Wire, fields: Sequence[str] = (), depth: int = 0) -> Found | None:
        """Everything plugged into one port, and fields of it; None, with a complaint, where a name means nothing."""
        targets: list[Target] = []
        is_list, broken = wire.is_list, False
        for name in wire.names or ():
            found = self.resolve(scope, name, wire.place, depth)
            if found is None:
                broken = True
                continue
            targets += [Target(t.name, (*t.fields, *fields)) for t in found[0]]
            is_list = is_list or found[1]
            if len(targets) > max(MAX_WIRES, len(wire.names or ())):
                raise DocumentError([Problem(f"more than {MAX_WIRES:,} wires into one port", wire.place)])
        return None if broken else (tuple(targets), is_list)

    def resolve(self, scope: Scope, text: str, place: Place | None, depth: int = 0) -> Found | None:
        """What a reference means in a scope; None, with a complaint, where it means nothing."""
        if depth > 4 * MAX_NESTING:
            self._complain(f"{text!r} leads back to itself through nested graphs", place, ())
            return None
        head, *fields = text.split(".")
        document = scope.document
        if "/" in head and head not in document.nodes and head not in document.inputs:
            first, rest = head.split("/", 1)
            if first in scope.graphs:
                return self.resolve(scope.graphs[first], ".".join((rest, *fields)), place, depth + 1)
            self._unknown(scope, head, place)
            return None
        if head in scope.graphs:
            return self._output(scope.graphs[head], head, fields, place, depth)
        entry = document.nodes.get(head)
        if entry is not None and not entry.removed:
            return (Target(scope.prefix + head, tuple(fields)),), False
        if head in document.inputs:
            return self._input(scope, head, fields, depth)
        self._unknown(scope, head, place)
        return None

    def _input(self, scope: Scope, name: str, fields: list[str], depth: int) -> Found | None:
        wire = scope.wires.get(name)
        if wire is None or wire.names is None or scope.parent is None:
            return (Target(scope.prefix + name, tuple(fields)),), False
        return self.wire(scope.parent, wire, fields, depth + 1)

    def _output(self, graph: Scope, name: str, fields: list[str], place: Place | None, depth: int) -> Found | None:
        offered = graph.document.outputs
        if not fields and len(offered) == 1:
            fields = list(offered)
        if not fields or fields[0] not in offered:
            wanted = f"no output {fields[0]!r}" if fields else "several outputs, name one"
            nearest = nearest_names(fields[0], offered) if fields else []
            self._complain(f"graph {name!r} has {wanted} (it has {', '.join(offered)})", place, nearest)
            return None
        inner = self.resolve(graph, offered[fields[0]].value, offered[fields[0]].place, depth + 1)
        if inner is None:
            return None
        return tuple(Target(t.name, (*t.fields, *fields[1:])) for t in inner[0]), inner[1]

    def _unknown(self, scope: Scope, name: str, place: Place | None) -> None:
        document = scope.document
        known = [*document.inputs, *(n for n, e in document.nodes.items() if not e.removed)]
        self._complain(f"no node or input {name!r} in this graph", place, nearest_names(name, known))
