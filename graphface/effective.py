"""The effective document: a graph after `extends`, nesting, variants, profiles and flags, as one flat YAML text.

The text is itself a graph file. Nodes of nested graphs keep their path as their name ("face/landmarks"), every
parameter that something set is written out, and the origin of each value stands behind it as a comment. Results carry
this text as their provenance, so that a picture can be run again (`graphface run result.png`).
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from graphface.located import Place

if TYPE_CHECKING:
    from graphface.graph import Graph
    from graphface.wiring import Argument, GraphInput, Ref, Step


def effective(graph: Graph, *, origins: bool = True) -> str:
    """The flat YAML of a graph; with `origins`, where each value came from (file:line:column or flag) as comments."""
    return "\n".join(_lines(graph, origins)) + "\n"


def _lines(graph: Graph, origins: bool) -> Iterator[str]:
    composition = graph.composition

    def noted(line: str, place: Place | None) -> str:
        return f"{line}  # {_origin(place)}" if origins and place is not None else line

    yield "graphface: 1"
    yield f"name: {_value(composition.name)}"
    if composition.doc:
        yield f"doc: {_value(composition.doc)}"
    if graph.inputs:
        yield "inputs:"
        for entry in graph.inputs.values():
            yield noted(f"  {entry.name}: {_input(entry)}", entry.default.place if entry.default else entry.place)
    yield "nodes:" if graph.steps else "nodes: {}"
    names = [*graph.inputs, *(step.name for step in graph.steps)]
    for step in graph.steps:
        yield from _step_lines(step, names, composition.nodes[step.name].use.place, noted)
    if graph.outputs:
        yield "outputs:"
        for name, ref in graph.outputs.items():
            yield f"  {name}: {_reference(ref, names)}"


def _step_lines(step: Step, names: list[str], use: Place | None, noted: Any) -> Iterator[str]:
    yield f"  {step.name}:"
    yield noted(f"    use: {step.operator.name}", use)
    if step.arguments:
        wires = ", ".join(f"{a.port}: {_wire(a, names)}" for a in step.arguments)
        yield f"    in: {{{wires}}}"
    if step.settings:
        yield "    with:"
        for name, setting in step.settings.items():
            yield noted(f"      {name}: {_value(setting.value)}", setting.place)


def _input(entry: GraphInput) -> str:
    if entry.default is None:
        return _value(str(entry.type))
    return f"{{type: {_value(str(entry.type))}, default: {_value(entry.default.value)}}}"


def _wire(argument: Argument, names: list[str]) -> str:
    shown = [_reference(ref, names) for ref in argument.refs]
    return f"[{', '.join(shown)}]" if argument.is_list else shown[0]


def _reference(ref: Ref, names: list[str]) -> str:
    return ".".join((names[ref.slot], *ref.fields))


def _value(value: Any) -> str:
    """JSON, which is YAML; non-finite numbers as YAML writes them."""
    if isinstance(value, float) and value != value:
        return ".nan"
    if value in (float("inf"), float("-inf")):
        return ".inf" if value > 0 else "-.inf"
    return json.dumps(value, ensure_ascii=False)


def _origin(place: Place) -> str:
    """The place for reading: files below the working folder by their path, others by their name."""
    name = place.source.name
    if name.startswith("--"):
        return name
    relative = os.path.relpath(name) if os.path.isabs(name) else name
    return f"{os.path.basename(name) if relative.startswith('..') else relative}:{place.line}:{place.column}"
