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
from typing import Any

from graphface.document.document import InputEntry, Setting
from graphface.document.flat import Composition, FlatNode, FlatWire
from graphface.document.scalars import scalar
from graphface.node import Operator
from graphface.place import Place
from graphface.registry import Registry
from graphface.values.parts import NUMBERED, rule_of

_NOT_IN_YAML = re.compile(r"[^\x20-\x7e\xa0-\u2027\u202a-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]")
"""Characters that a YAML text may not hold unescaped, or would take for the end of a line."""

Noted = Callable[[str, Place | None], str]
"""Puts a line's origin behind it."""


def effective(composition: Composition, registry: Registry, *, origins: bool = True) -> str:
    """The flat YAML of a graph; with `origins`, where each value came from (file:line:column or flag) as comments."""
    return "\n".join(_lines(composition, registry, origins)) + "\n"


def escaped(line: str) -> str:
    """A line of JSON as a line of YAML: some characters may stand in a JSON string and not in a YAML one."""
    return _NOT_IN_YAML.sub(lambda found: f"\\u{ord(found[0]):04x}", line)


def _lines(composition: Composition, registry: Registry, origins: bool) -> Iterator[str]:
    def noted(line: str, place: Place | None) -> str:
        return f"{line}  # {origin(place)}" if origins and place is not None else line

    yield "graphface: 1"
    yield f"name: {_value(composition.name)}"
    if composition.doc:
        yield f"doc: {_value(composition.doc)}"
    if composition.inputs:
        yield "inputs:"
        for name, entry in composition.inputs.items():
            written = _input(composition, registry, entry)
            yield noted(f"  {name}: {written}", entry.default.place if entry.default else entry.place)
    yield "nodes:" if composition.nodes else "nodes: {}"
    for node in composition.nodes.values():
        yield from _node_lines(node, registry.operator(node.use.value), noted)
    if composition.outputs:
        yield "outputs:"
        for name, target in composition.outputs.items():
            yield f"  {name}: {_word(str(target))}"


def _node_lines(node: FlatNode, operator: Operator, noted: Noted) -> Iterator[str]:
    yield f"  {node.name}:"
    yield noted(f"    use: {_word(operator.name)}", node.use.place)
    wires = {port: wire for port, wire in node.wires.items() if port in operator.inputs}
    if wires:
        yield f"    in: {{{', '.join(f'{port}: {_wire(wire)}' for port, wire in wires.items())}}}"
    settings = {name: s for name, s in node.settings.items() if name in operator.parameters.model_fields}
    if settings:
        yield "    with:"
        for name, setting in settings.items():
            yield noted(f"      {name}: {_value(setting.value)}", setting.place)


def _input(composition: Composition, registry: Registry, entry: InputEntry) -> str:
    """An input's type as its file writes it (a class may go by another name there), with default and doc."""
    declared = _value(entry.type.value)
    if entry.default is None and not entry.doc:
        return declared
    parts = [f"type: {declared}"]
    if entry.default is not None:
        parts.append(f"default: {_value(_default(composition, registry, entry.type.value, entry.default))}")
    if entry.doc:
        parts.append(f"doc: {_value(entry.doc)}")
    return f"{{{', '.join(parts)}}}"


def _default(composition: Composition, registry: Registry, declared: str, default: Setting) -> Any:
    """The default; a file named by a graph in another folder, as seen from the folder of the whole graph."""
    value, place, top = default.value, default.place, composition.path
    named_in = place.source.path if place is not None else None
    files = registry.files(registry.type(declared))
    if not isinstance(value, str) or files is None or files.read is None or named_in is None or top is None:
        return value
    file = (named_in.parent / value).resolve()
    if named_in.parent.resolve() == top.parent.resolve() or not file.is_file():
        return value
    roots = [folder.resolve() for folder in (top.parent, *registry.graph_folders())]
    return next((file.relative_to(root).as_posix() for root in roots if file.is_relative_to(root)), value)


def _wire(wire: FlatWire) -> str:
    shown = [_word(str(target)) for target in wire.targets]
    # Wires that come from a list of a nested graph form one too, and so do several.
    return f"[{', '.join(shown)}]" if wire.is_list or len(shown) != 1 else shown[0]


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


def origin(place: Place) -> str:
    """The place for reading: files below the working folder by their path, others by their name."""
    name = place.source.name
    if name.startswith("--"):
        return name
    relative = os.path.relpath(name) if os.path.isabs(name) else name
    shown = Path(name).name if relative.startswith("..") else relative
    return "".join(c if c.isprintable() else "?" for c in f"{shown}:{place.line}:{place.column}")
