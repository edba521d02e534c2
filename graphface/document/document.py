"""A graph file as a validated document: every entry of the right form, every value with its place.

The names of nodes and inputs are words; a path ("face/landmarks") is the name that a node of a nested graph has in the
flat form of `graphface.document.effective`. This module knows the form of one file and nothing of the others: what
another file says is known when files are composed (`graphface.document.compose`), what an operator's parameters are
called when the graph is wired (`graphface.graph.wiring`). All mistakes of a file are collected and reported at once. A
hand-written reader instead of a pydantic model (`graphface.document.typed_yaml`), since here the values keep their
places: what is wrong with many of them is only known later.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from graphface.document.located import Map, Seq, file_source, parse
from graphface.errors import Problem, nearest_names
from graphface.place import Place, Source

FORMAT = 1
NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_-]*")
TAKEN = frozenset({"outputs", "evaluator"})
"""Names that no input can have: `Graph.run` takes inputs as keyword arguments beside these two of its own."""

_REFERENCE = re.compile(r"[A-Za-z_][A-Za-z0-9_-]*(?:[./][A-Za-z_][A-Za-z0-9_-]*)*")
_TOP = ("graphface", "name", "doc", "extends", "inputs", "nodes", "outputs", "variants", "profiles")
_NODE = ("use", "in", "with", "doc")


@dataclass(frozen=True)
class Setting:
    """A value and the place, or the flag, that set it.

    A mapping or list keeps its positions inside (`Map`, `Seq`) until it is used, when `plain` leaves them away.
    """

    value: Any
    place: Place | None


@dataclass(frozen=True)
class Wire:
    """Names plugged into an input port: one, or several for a `list[...]` port. None unplugs an optional port."""

    names: tuple[str, ...] | None
    is_list: bool
    place: Place | None


@dataclass
class NodeEntry:
    """One node as a file states it; in an overlay any part may be absent.

    `carried` names ports and parameters written for an operator that an overlay has since replaced.
    """

    name: str
    place: Place
    use: Setting | None = None
    wires: dict[str, Wire] = field(default_factory=dict)
    settings: dict[str, Setting] = field(default_factory=dict)
    doc: str = ""
    removed: bool = False
    carried: set[str] = field(default_factory=set)


@dataclass
class InputEntry:
    """A graph input: a type, and perhaps a default."""

    name: str
    place: Place
    type: Setting
    default: Setting | None = None
    doc: str = ""

    @property
    def may_stay_open(self) -> bool:
        return self.default is not None or "None" in re.split(r"[|\s]+", str(self.type.value))


@dataclass
class Document:
    """One graph file; `path` is None for a text."""

    path: Path | None
    name: str = ""
    doc: str = ""
    extends: Setting | None = None
    inputs: dict[str, InputEntry] = field(default_factory=dict)
    nodes: dict[str, NodeEntry] = field(default_factory=dict)
    outputs: dict[str, Setting] = field(default_factory=dict)
    variants: dict[str, dict[str, NodeEntry]] = field(default_factory=dict)
    profiles: dict[str, dict[str, NodeEntry]] = field(default_factory=dict)


def read_document(path: Path) -> tuple[Document, list[Problem]]:
    """The document in a graph file, and what is wrong with it.

    Raises:
        UnreadableFile: there is no such file, it is not UTF-8 text, or it is too large.
        DocumentError: it is not YAML.
    """
    return parse_document(file_source(path))


def parse_document(source: Source) -> tuple[Document, list[Problem]]:
    """As `read_document`, from a text."""
    tree, problems = parse(source)
    document = Document(source.path)
    if not isinstance(tree, Map):
        return document, [*problems, Problem("a graph file is a mapping that begins with 'graphface: 1'", source.start)]
    return document, problems + list(_read_top(tree, document))


def read_overlay(entries: Any, place: Place, *, settings_only: bool) -> tuple[dict[str, NodeEntry], list[Problem]]:
    """A variant (node path to partial node), or with `settings_only` a profile (node path to parameters)."""
    found: dict[str, NodeEntry] = {}
    if not isinstance(entries, Map):
        what = "parameters" if settings_only else "changes"
        return found, [Problem(f"expected a mapping from nodes to their {what}", place)]
    problems: list[Problem] = []
    for name, body in entries.items():
        node = NodeEntry(name, entries.key_place(name))
        problems += _check_path(name, node.place)
        if body is None and not settings_only:
            node.removed = True
        elif not isinstance(body, Map):
            problems.append(Problem(f"expected a mapping for node {name!r}", entries.value_place(name)))
        elif settings_only:
            node.settings = {key: Setting(value, body.key_place(key)) for key, value in body.items()}
        else:
            problems += _read_node(body, node)
        found[name] = node
    return found, problems


def _read_top(tree: Map, document: Document) -> Iterator[Problem]:
    yield from _unknown_keys(tree, _TOP, "a graph file")
    yield from _read_head(tree, document)
    yield from _read_inputs(tree, document)
    yield from _read_nodes(tree, document)
    yield from _read_outputs(tree, document)
    yield from _read_overlays(tree, document)
    for section in ("inputs", "nodes", "outputs", "variants", "profiles"):
        if tree.get(section) is not None and not isinstance(tree[section], Map):
            yield Problem(f"{section!r} is a mapping", tree.value_place(section))
    for name in (name for name in document.nodes if name in document.inputs):
        first = document.inputs[name].place
        yield Problem(f"{name!r} is an input (line {first.line}) and a node; rename one", document.nodes[name].place)


def _read_head(tree: Map, document: Document) -> Iterator[Problem]:
    version = tree.get("graphface")
    if version != FORMAT or isinstance(version, bool):
        place = tree.value_place("graphface") if "graphface" in tree else tree.place
        yield Problem(f"a graph file begins with 'graphface: {FORMAT}', the version of its format", place)
    for key in ("name", "doc"):
        value = tree.get(key)
        if value is not None and not isinstance(value, str):
            yield Problem(f"{key!r} is a text", tree.value_place(key))
        else:
            setattr(document, key, value or "")
    if tree.get("extends") is not None:
        if isinstance(tree["extends"], str):
            document.extends = Setting(tree["extends"], tree.value_place("extends"))
        else:
            yield Problem("'extends' names one graph file", tree.value_place("extends"))


def _read_inputs(tree: Map, document: Document) -> Iterator[Problem]:
    for name, body, place, key_place in _section(tree, "inputs"):
        yield from _check_path(name, key_place)
        if name in TAKEN:
            yield Problem(f"an input cannot be called {name!r}: that is an argument of Graph.run; rename it", key_place)
        if isinstance(body, str):
            document.inputs[name] = InputEntry(name, key_place, Setting(body, place))
        elif isinstance(body, Map) and isinstance(body.get("type"), str):
            yield from _unknown_keys(body, ("type", "default", "doc"), f"input {name!r}")
            entry = InputEntry(name, key_place, Setting(body["type"], body.value_place("type")))
            if "default" in body:
                entry.default = Setting(body["default"], body.value_place("default"))
            entry.doc = str(body.get("doc") or "")
            document.inputs[name] = entry
        else:
            yield Problem(
                f"input {name!r}: expected a type, as in '{name}: Image' or '{{type: Image, default: ...}}'", place
            )


def _read_nodes(tree: Map, document: Document) -> Iterator[Problem]:
    for name, body, place, key_place in _section(tree, "nodes"):
        yield from _check_path(name, key_place)
        node = NodeEntry(name, key_place)
        document.nodes[name] = node
        if body is None:
            node.removed = True
        elif isinstance(body, Map):
            yield from _read_node(body, node)
        else:
            yield Problem(f"node {name!r}: expected a mapping with 'use', 'in' and 'with'", place)


def _read_outputs(tree: Map, document: Document) -> Iterator[Problem]:
    for name, body, place, key_place in _section(tree, "outputs"):
        yield from _check_name(name, key_place)
        if isinstance(body, str):
            document.outputs[name] = Setting(body, place)
            yield from _check_reference(body, place)
        else:
            yield Problem(
                f"output {name!r}: expected the name of a node or input, as in 'image: composite.image'", place
            )


def _read_overlays(tree: Map, document: Document) -> Iterator[Problem]:
    for section, target, settings_only in (
        ("variants", document.variants, False),
        ("profiles", document.profiles, True),
    ):
        for name, body, place, key_place in _section(tree, section):
            yield from _check_name(name, key_place)
            target[name], problems = read_overlay(
                body if body is not None else Map(place), place, settings_only=settings_only
            )
            yield from problems


def _read_node(body: Map, node: NodeEntry) -> Iterator[Problem]:
    yield from _unknown_keys(body, _NODE, f"node {node.name!r}")
    if "use" in body:
        if isinstance(body["use"], str):
            node.use = Setting(body["use"], body.value_place("use"))
        else:
            yield Problem("'use' names an operator or a graph file", body.value_place("use"))
    node.doc = str(body.get("doc") or "")
    wires = body.get("in")
    if isinstance(wires, Map):
        for port, value in wires.items():
            yield from _read_wire(node, port, value, wires.value_place(port))
    elif wires is not None:
        yield Problem("'in' maps ports to the names plugged into them", body.value_place("in"))
    settings = body.get("with")
    if isinstance(settings, Map):
        node.settings = {key: Setting(value, settings.key_place(key)) for key, value in settings.items()}
    elif settings is not None:
        yield Problem("'with' maps parameters to their values", body.value_place("with"))


def _read_wire(node: NodeEntry, port: str, value: Any, place: Place) -> Iterator[Problem]:
    if value is None:
        node.wires[port] = Wire(None, False, place)
    elif isinstance(value, str):
        yield from _check_reference(value, place)
        node.wires[port] = Wire((value,), False, place)
    elif isinstance(value, Seq) and all(isinstance(v, str) for v in value):
        for index, item in enumerate(value):
            yield from _check_reference(item, value.item_place(index))
        node.wires[port] = Wire(tuple(value), True, place)
    else:
        yield Problem(
            f"port {port!r} of node {node.name!r} takes the name of a node or input; a constant belongs under 'with'",
            place,
        )


def _section(tree: Map, key: str) -> Iterator[tuple[str, Any, Place, Place]]:
    section = tree.get(key)
    if isinstance(section, Map):
        for name, body in section.items():
            yield name, body, section.value_place(name), section.key_place(name)


def _unknown_keys(body: Map, known: tuple[str, ...], what: str) -> Iterator[Problem]:
    for key in body:
        if key not in known:
            yield Problem(
                f"{what} has no entry {key!r} (it has {', '.join(known)})",
                body.key_place(key),
                tuple(nearest_names(key, known, 1)),
            )


def _check_name(name: str, place: Place) -> Iterator[Problem]:
    if not NAME.fullmatch(name):
        yield Problem(f"{name!r} is not a name: letters, digits, '_' and '-', beginning with a letter", place)


def _check_path(name: str, place: Place) -> Iterator[Problem]:
    for part in name.split("/"):
        yield from _check_name(part, place)


def _check_reference(text: str, place: Place) -> Iterator[Problem]:
    if not _REFERENCE.fullmatch(text):
        yield Problem(f"{text!r} is not a reference such as 'photo' or 'face.normals'", place)
