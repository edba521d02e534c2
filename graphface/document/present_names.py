"""Old names in a graph led to the present ones: operators, ports and parameters that have been renamed since.

Done once, when files and flags are composed and before anything is looked up, so that nothing behind it meets an old
name: not the keys, not a trace, not the effective document that results carry.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

from graphface.document.document import Setting
from graphface.document.flat import Composition, FlatNode, FlatWire
from graphface.errors import DeclarationError, UnknownOperator
from graphface.fallback import warn
from graphface.node import Operator
from graphface.place import Place
from graphface.registry import Registry

Entry = TypeVar("Entry", FlatWire, Setting)


def with_present_names(composition: Composition, registry: Registry) -> Composition:
    """The flat graph with the names that operators, ports and parameters have now; each place with an old one is warned
    of once, however many nodes come from it.

    Where an old and a new name of the same thing are both given, the one laid over the other applies. What is wrong
    with an operator is left for wiring to tell.
    """
    operators = {name: _usable(name, registry) for name in {node.use.value for node in composition.nodes.values()}}
    warnings: dict[str, None] = {}
    nodes = {name: _present(node, operators[node.use.value], warnings) for name, node in composition.nodes.items()}
    for warning in warnings:
        warn(warning)
    return replace(composition, nodes=nodes)


def _usable(name: str, registry: Registry) -> Operator | None:
    try:
        operator = registry.operator(name)
        operator.check()
    except (UnknownOperator, DeclarationError):
        return None
    return operator


def _present(node: FlatNode, operator: Operator | None, warnings: dict[str, None]) -> FlatNode:
    """The node under present names, without the ports that are unplugged."""
    if operator is not None:
        if operator.name != node.use.value:
            _note(warnings, node.use.place, f"operator {node.use.value!r}", operator.name)
            node = replace(node, use=Setting(operator.name, node.use.place))
        if not operator.renamed.keys().isdisjoint([*node.wires, *node.settings]):
            wires = _renamed(node.wires, operator, "port", warnings)
            settings = _renamed(node.settings, operator, "parameter", warnings)
            carried = {operator.renamed.get(name, name) for name in node.carried}
            node = replace(node, wires=wires, settings=settings, carried=carried)
    if any(wire.unplugged for wire in node.wires.values()):
        node = replace(node, wires={port: wire for port, wire in node.wires.items() if not wire.unplugged})
    return node


def _renamed(entries: dict[str, Entry], operator: Operator, kind: str, warnings: dict[str, None]) -> dict[str, Entry]:
    found = {}
    for name, entry in entries.items():
        present = operator.renamed.get(name, name)
        if present != name:
            _note(warnings, entry.place, f"{kind} {name!r} of {operator.name}", present)
        found[present] = entry
    return found


def _note(warnings: dict[str, None], place: Place | None, what: str, present: str) -> None:
    where = f"{place}: " if place is not None else ""
    warnings[f"{where}{what} is now called {present!r}"] = None
