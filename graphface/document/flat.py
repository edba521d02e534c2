"""The flat graph: what composing files and flags leaves, still in names.

No nesting, no overlays: every node of every used graph by its path ("face/landmarks"), every wire led to the node or
graph input that it ends at. The operators behind the names are looked up by `graphface.graph.wiring`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from graphface.document.document import InputEntry, Setting
from graphface.document.references import Scope, Target
from graphface.errors import Problem
from graphface.place import Place


@dataclass(frozen=True)
class FlatWire:
    """What is plugged into a port; `broken` where a name in it means nothing, which is among the problems already.

    `unplugged` where the file says null: it takes away what is plugged in under an old name of the port.
    """

    targets: tuple[Target, ...]
    is_list: bool
    place: Place | None
    broken: bool = False
    unplugged: bool = False


@dataclass
class FlatNode:
    """A node of the flat graph. `carried` names ports and parameters written for an operator since replaced: they apply
    where the new operator knows them and are dropped where it does not."""

    name: str
    place: Place
    use: Setting
    wires: dict[str, FlatWire] = field(default_factory=dict)
    settings: dict[str, Setting] = field(default_factory=dict)
    carried: set[str] = field(default_factory=set)


@dataclass
class Composition:
    """The whole flat graph.

    `problems` is what is wrong so far; wiring adds what it finds, so that all of it is reported together. `files` are
    those that were read.
    """

    path: Path | None
    name: str
    doc: str
    inputs: dict[str, InputEntry]
    nodes: dict[str, FlatNode]
    outputs: dict[str, Target]
    variants: list[str]
    profiles: list[str]
    scope: Scope
    problems: list[Problem]
    files: list[Path] = field(default_factory=list)
