"""Old names in a graph led to the present ones: operators, ports and parameters that have been renamed since."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

from graphface.document.document import Setting
from graphface.document.flat import FlatNode, FlatWire
from graphface.node import Operator
from graphface.place import Place

Entry = TypeVar("Entry", FlatWire, Setting)


def with_present_names(node: FlatNode, operator: Operator, warnings: dict[str, None]) -> FlatNode:
    """The node with the names that its operator's ports and parameters have now.

    Where an old and a new name of the same thing are both given, the one laid over the other applies.

    Args:
        warnings: gets a sentence for every place that uses an old name; a dictionary, so that a graph used twice in
            another warns once.
    """
    if node.use.value != operator.name and node.use.value in operator.formerly:
        _note(warnings, node.use.place, f"operator {node.use.value!r}", operator.name)
    if operator.renamed.keys().isdisjoint([*node.wires, *node.settings]):
        return node
    wires = _renamed(node.wires, operator, "port", warnings)
    settings = _renamed(node.settings, operator, "parameter", warnings)
    carried = {operator.renamed.get(name, name) for name in node.carried}
    return replace(node, wires=wires, settings=settings, carried=carried)


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
