"""The effective document: a graph after `extends`, nesting, variants, profiles and flags, as one flat YAML text.

The text is itself a graph file. Nodes of nested graphs keep their path as their name ("face/landmarks"), every
parameter that something set is written out, and the origin of each value stands behind it as a comment. Results carry
this text as their provenance, so that a picture can be run again (`graphface run result.png`).
"""

from __future__ import annotations

import json
import math
import os
import re
from collections.abc import Callable, Iterator
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Any

from graphface.document.located import Place, scalar
from graphface.values.parts import NUMBERED, rule_of

if TYPE_CHECKING:
    from graphface.graph.graph import Graph
    from graphface.graph.wiring import Argument, GraphInput, Ref, Step

_NOT_IN_YAML = re.compile(r"[^\x20-\x7e\xa0-\u2027\u202a-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]")
"""Characters that a YAML text may not hold unescaped, or would take for the end of a line."""

Noted = Callable[[str, Place | None], str]
"""Puts a line's origin behind it."""


def effective(graph: Graph, *, origins: bool = True) -> str:
    """The flat YAML of a graph; with `origins`, where each value came from (file:line:column or flag) as comments."""
    return "\n".join(_lines(graph, origins)) + "\n"


def escaped(line: str) -> str:
    """A line of JSON as a line of YAML: some characters may stand in a JSON string and not in a YAML one."""
    return _NOT_IN_YAML.sub(lambda found: f"\\u{ord(found[0]):04x}", line)


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
            yield noted(
                f"  {entry.name}: {_input(graph, entry)}", entry.default.place if entry.default else entry.place
            )
    yield "nodes:" if graph.steps else "nodes: {}"
    names = [*graph.inputs, *(step.name for step in graph.steps)]
    for step in graph.steps:
        yield from _step_lines(step, names, composition.nodes[step.name].use.place, noted)
    if graph.outputs:
        yield "outputs:"
        for name, ref in graph.outputs.items():
            yield f"  {name}: {_reference(ref, names)}"


def _step_lines(step: Step, names: list[str], use: Place | None, noted: Noted) -> Iterator[str]:
    yield f"  {step.name}:"
    yield noted(f"    use: {_word(step.operator.name)}", use)
    if step.arguments:
        wires = ", ".join(f"{a.port}: {_wire(a, names)}" for a in step.arguments)
        yield f"    in: {{{wires}}}"
    if step.settings:
        yield "    with:"
        for name, setting in step.settings.items():
            yield noted(f"      {name}: {_value(setting.value)}", setting.place)


def _input(graph: Graph, entry: GraphInput) -> str:
    """An input's type as its file writes it (a class may go by another name there), with default and doc."""
    declared = _value(graph.composition.inputs[entry.name].type.value)
    if entry.default is None and not entry.doc:
        return declared
    parts = [f"type: {declared}"]
    if entry.default is not None:
        parts.append(f"default: {_value(_default(graph, entry))}")
    if entry.doc:
        parts.append(f"doc: {_value(entry.doc)}")
    return f"{{{', '.join(parts)}}}"


def _default(graph: Graph, entry: GraphInput) -> Any:
    """The default; a file named by a graph in another folder, as seen from the folder of the whole graph."""
    from graphface.graph.graph import shipped_folders

    assert entry.default is not None
    value, place, top = entry.default.value, entry.default.place, graph.composition.path
    named_in = place.source.path if place is not None else None
    files = graph.registry.files(entry.type)
    if not isinstance(value, str) or files is None or files.read is None or named_in is None or top is None:
        return value
    file = (named_in.parent / value).resolve()
    if named_in.parent.resolve() == top.parent.resolve() or not file.is_file():
        return value
    roots = [folder.resolve() for folder in (top.parent, *shipped_folders(graph.registry))]
    return next((file.relative_to(root).as_posix() for root in roots if file.is_relative_to(root)), value)


def _wire(argument: Argument, names: list[str]) -> str:
    shown = [_reference(ref, names) for ref in argument.refs]
    return f"[{', '.join(shown)}]" if argument.is_list else shown[0]


def _reference(ref: Ref, names: list[str]) -> str:
    return _word(".".join((names[ref.slot], *ref.fields)))


def _word(text: str) -> str:
    """A name, quoted where YAML would read something else in it (a node called "null")."""
    return text if isinstance(scalar(text), str) else _quoted(text)


def _value(value: Any) -> str:
    """A value as flow YAML; what YAML cannot say becomes the nearest that it can: a tuple a list, a path a text."""
    if isinstance(value, Enum):
        return _value(value.value)
    rule = rule_of(type(value))
    if rule is NUMBERED:
        return f"[{', '.join(_value(item) for item in value)}]"
    if rule is not None:
        return f"{{{', '.join(f'{_quoted(str(label))}: {_value(part)}' for label, part in rule.items(value))}}}"
    if isinstance(value, float) and not math.isfinite(value):
        return ".nan" if math.isnan(value) else ".inf" if value > 0 else "-.inf"
    if value is None or isinstance(value, bool | int | float):
        return json.dumps(value)
    return _value(value.tolist()) if hasattr(value, "tolist") else _quoted(str(value))


def _quoted(text: str) -> str:
    """A text in double quotes."""
    return escaped(json.dumps(text.encode("utf-8", "replace").decode(), ensure_ascii=False))


def _origin(place: Place) -> str:
    """The place for reading: files below the working folder by their path, others by their name."""
    name = place.source.name
    if name.startswith("--"):
        return name
    relative = os.path.relpath(name) if os.path.isabs(name) else name
    shown = Path(name).name if relative.startswith("..") else relative
    return "".join(c if c.isprintable() else "?" for c in f"{shown}:{place.line}:{place.column}")
