"""What a graph is once its names are looked up: inputs, steps and outputs in one numbering, the *slot*.

Inputs come first, then the steps in an order where every step stands after what it depends on. Evaluation works on
slots alone, so a node costs list indexing and no names. Nothing here is written to after loading: any number of
threads may read it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from graphface.document.document import Setting
from graphface.node import Operator
from graphface.place import Place
from graphface.values.port_types import PortType, output_fields


@dataclass(frozen=True)
class Ref:
    """A slot, and the fields taken of its value."""

    slot: int
    fields: tuple[str, ...] = ()


@dataclass(frozen=True)
class Argument:
    """What is plugged into one port."""

    port: str
    refs: tuple[Ref, ...]
    is_list: bool
    lazy: bool


@dataclass(frozen=True)
class GraphInput:
    slot: int
    name: str
    type: PortType
    default: Setting | None
    doc: str
    place: Place


@dataclass(frozen=True, eq=False)
class Step:
    """One node, ready to run.

    Attributes:
        eager, lazy: the slots behind its ports, each once.
        absent: the ports that get None, since nothing is plugged in.
        plain: ports with slots where every port is eager and takes one whole value, the common, fast case; else None.
    """

    slot: int
    name: str
    operator: Operator
    arguments: tuple[Argument, ...]
    parameters: Mapping[str, Any]
    settings: Mapping[str, Setting]
    place: Place

    @cached_property
    def eager(self) -> tuple[int, ...]:
        return tuple(dict.fromkeys(r.slot for a in self.arguments if not a.lazy for r in a.refs))

    @cached_property
    def lazy(self) -> tuple[int, ...]:
        return tuple(dict.fromkeys(r.slot for a in self.arguments if a.lazy for r in a.refs))

    @cached_property
    def absent(self) -> Mapping[str, None]:
        plugged = {a.port for a in self.arguments}
        return {port: None for port in self.operator.needs_none if port not in plugged}

    @cached_property
    def plain(self) -> tuple[tuple[str, int], ...] | None:
        if self.absent or any(len(a.refs) != 1 or a.lazy or a.is_list or a.refs[0].fields for a in self.arguments):
            return None
        return tuple((a.port, a.refs[0].slot) for a in self.arguments)


@dataclass(frozen=True)
class Structure:
    """A whole graph: `slots` gives the slot of every name, `outputs` what the declared outputs are."""

    inputs: Mapping[str, GraphInput]
    steps: tuple[Step, ...]
    slots: Mapping[str, int]
    outputs: Mapping[str, Ref]


def field_type(annotation: PortType, fields: tuple[str, ...]) -> PortType | None:
    """The type of `value.field.field...`, or None where an alternative has no such field.

    A field of a value that may be None may be None too: there is nothing to take it from.
    """
    current = annotation
    for name in fields:
        offered = [output_fields(a) if isinstance(a, type) else {} for a in current.alternatives]
        if not all(name in ports for ports in offered):
            return None
        atoms = dict.fromkeys(atom for ports in offered for atom in ports[name].alternatives)
        optional = current.optional or any(ports[name].optional for ports in offered)
        current = PortType(tuple(atoms), optional)
    return current
