"""Many graph files and flags to one flat graph: `extends`, nested graphs, variants, profiles, `--replace`, `--set`.

One order decides between settings of the same thing, weakest first:

1. the operator's own defaults,
2. a file's base (`extends`), then the file itself,
3. what an enclosing graph says under `with` of the node that uses the file,
4. variants, in the order asked for; a used file's own before its user's,
5. profiles, likewise,
6. `--replace`, then `--set`.

Every overlay is the same thing, a partial node addressed by its path ("face/landmarks"), so there is one mechanism:
overlays travel down to the file that declares the node and are laid over it in the order of their rank.

A graph file names other files only below the folder of the file that was asked for, or among the graphs that installed
packs ship: a graph from a stranger cannot reach into the rest of the disk.
"""

from __future__ import annotations

import copy
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from graphface.document import (
    NAME,
    Document,
    InputEntry,
    NodeEntry,
    Setting,
    Wire,
    read_document,
)
from graphface.errors import DocumentError, Problem, UnreadableFile, nearest_names
from graphface.located import Place, Source, parse, plain, scalar
from graphface.references import MAX_NESTING, References, Scope, Target

MAX_NODES = 2_000_000
GRAPH_SUFFIXES = (".yaml", ".yml")

_WITH, _VARIANT, _PROFILE, _REPLACE, _SET = range(5)


@dataclass(frozen=True)
class FlatWire:
    """What is plugged into a port; `broken` where a name in it means nothing, which was told already."""

    targets: tuple[Target, ...]
    is_list: bool
    place: Place | None
    broken: bool = False


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
    """The flat graph, still in names: the operators behind them are looked up by `graphface.wiring`.

    `problems` is what is wrong so far; wiring adds what it finds, so that all of it is told at once.
    """

    source: Source
    path: Path | None
    name: str
    doc: str
    inputs: dict[str, InputEntry]
    nodes: dict[str, FlatNode]
    outputs: dict[str, Target]
    variants: list[str]
    profiles: list[str]
    scope: Scope
    files: list[Path]
    problems: list[Problem]


@dataclass(frozen=True)
class Choices:
    """What the caller chose: names of variants and profiles, operators to replace and parameters to set, by path."""

    variants: Sequence[str] = ()
    profiles: Sequence[str] = ()
    replace: Mapping[str, str] = field(default_factory=dict)
    set: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class _Overlay:
    rank: int
    path: tuple[str, ...]
    entry: NodeEntry


def compose(document: Document, choices: Choices, *, shipped: Sequence[Path] = ()) -> Composition:
    """The flat graph of a document after every overlay.

    Args:
        document: as read by `read_document`.
        choices: variants, profiles, replacements and parameters asked for.
        shipped: folders of graph files that installed packs offer.

    Raises:
        DocumentError: it is too large; any other problem is left in `problems` of the result.
    """
    return _Composer(document, choices, shipped).run()


def find_graph(name: str, shipped: Sequence[Path]) -> Path:
    """The file of a graph given on the command line: a path, or the name of a shipped graph ("relight").

    Raises:
        UnreadableFile: neither exists; the message lists the shipped ones.
    """
    path = Path(name)
    if _is_file(path):
        return path
    for folder in shipped:
        for candidate in (folder / name, *(folder / f"{name}{s}" for s in GRAPH_SUFFIXES)):
            if _is_file(candidate):
                return candidate
    known = shipped_graphs(shipped)
    hint = f" (shipped graphs: {', '.join(known)})" if known else ""
    raise UnreadableFile(name, f"no such graph file{hint}")


def shipped_graphs(shipped: Sequence[Path]) -> list[str]:
    return sorted(p.stem for folder in shipped for s in GRAPH_SUFFIXES for p in folder.glob(f"*{s}"))


def _is_file(path: Path) -> bool:
    """Whether there is such a file; a name that no file could have (too long, a NUL in it) is none."""
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


class _Composer:
    def __init__(self, document: Document, choices: Choices, shipped: Sequence[Path]) -> None:
        self._top = document
        self._choices = choices
        self._shipped = [folder.resolve() for folder in shipped]
        folder = document.path.parent if document.path is not None else Path.cwd()
        self._roots = [folder.resolve(), *self._shipped]
        self._problems: list[Problem] = []
        self._declared: dict[str, set[str]] = {"variant": set(), "profile": set()}
        self._nodes: dict[str, FlatNode] = {}
        self._inputs: dict[str, InputEntry] = {}
        self._read: dict[Path, Document] = {}
        self._count = 0

    def run(self) -> Composition:
        document = self._with_bases(self._top, ())
        scope = self._expand(document, "", None, {}, self._flag_overlays(), ())
        for kind, chosen in (("variant", self._choices.variants), ("profile", self._choices.profiles)):
            for name in chosen:
                if name not in self._declared[kind]:
                    place = Place(Source(f"--{kind}", name), 1, 1)
                    known = sorted(self._declared[kind])
                    has = f"the graph has {', '.join(known)}" if known else "the graph has none"
                    self._problem(f"unknown {kind} {name!r} ({has})", place, nearest_names(name, known))
        return Composition(
            source=document.source,
            path=document.path,
            name=document.name or (document.path.stem if document.path else "graph"),
            doc=document.doc,
            inputs=self._inputs,
            nodes=self._nodes,
            outputs=self._resolve_all(scope),
            variants=sorted(self._declared["variant"]),
            profiles=sorted(self._declared["profile"]),
            scope=scope,
            files=list(self._read),
            problems=self._problems,
        )

    # --- files ------------------------------------------------------------------------------------

    def _load(self, text: str, near: Document, place: Place | None) -> Document | None:
        """The document that a file names, looked for beside that file and then among the shipped graphs."""
        naming = (place.source.path if place is not None else None) or near.path
        folder = naming.parent if naming is not None else Path.cwd()
        for base in (folder, *self._shipped):
            if not _is_file(base / text):
                continue
            path = (base / text).resolve()
            if not any(path.is_relative_to(root) for root in self._roots):
                self._problem(f"{text!r} lies outside the folder of the graph", place)
                return None
            if path not in self._read:
                try:
                    document, problems = read_document(path)
                except (UnreadableFile, DocumentError) as error:
                    self._problem(f"{text!r} cannot be used", place)
                    self._problems += error.problems if isinstance(error, DocumentError) else [Problem(str(error))]
                    return None
                self._problems += problems
                self._read[path] = document
            return self._read[path]
        known = shipped_graphs(self._roots)
        self._problem(f"no graph file {text!r}", place, [f"{n}.yaml" for n in nearest_names(Path(text).stem, known)])
        return None

    def _with_bases(self, document: Document, chain: tuple[Path, ...]) -> Document:
        """A document laid over the one it extends."""
        if document.extends is None:
            return document
        base = self._load(document.extends.value, document, document.extends.place)
        if base is None:
            return document
        assert base.path is not None
        if base.path in chain or len(chain) >= MAX_NESTING:
            self._problem(f"{document.extends.value!r} extends itself", document.extends.place)
            return document
        base = self._with_bases(base, (*chain, base.path))
        merged = copy.copy(document)
        merged.doc = document.doc or base.doc
        merged.inputs = base.inputs | document.inputs
        merged.outputs = base.outputs | document.outputs
        merged.nodes = {name: _copy(entry) for name, entry in base.nodes.items()}
        for name, entry in document.nodes.items():
            if name in merged.nodes:
                _lay_over(merged.nodes[name], entry)
                merged.nodes[name].place = entry.place if entry.use is not None else merged.nodes[name].place
            else:
                merged.nodes[name] = entry
        merged.variants = base.variants | document.variants
        merged.profiles = base.profiles | document.profiles
        return merged

    # --- overlays ---------------------------------------------------------------------------------

    def _flag_overlays(self) -> list[_Overlay]:
        overlays = []
        for path, operator in self._choices.replace.items():
            place = Place(Source("--replace", f"{path}={operator}"), 1, 1)
            entry = NodeEntry(path, place, use=Setting(operator, place))
            overlays.append(_Overlay(_REPLACE, tuple(path.split("/")), entry))
        for key, value in self._choices.set.items():
            place = Place(Source("--set", f"{key}={value}"), 1, 1)
            path, dot, parameter = key.rpartition(".")
            if not dot:
                self._problem(f"{key!r}: expected node.parameter", place)
                continue
            entry = NodeEntry(path, place, settings={parameter: Setting(value, place)})
            overlays.append(_Overlay(_SET, tuple(path.split("/")), entry))
        return overlays

    def _own_overlays(self, document: Document) -> list[_Overlay]:
        """The chosen variants and profiles that this file declares."""
        overlays = []
        for kind, rank, declared, chosen in (
            ("variant", _VARIANT, document.variants, self._choices.variants),
            ("profile", _PROFILE, document.profiles, self._choices.profiles),
        ):
            self._declared[kind] |= declared.keys()
            for name in chosen:
                for path, entry in declared.get(name, {}).items():
                    overlays.append(_Overlay(rank, tuple(path.split("/")), _plain(entry)))
                    overlays += _nested(rank, tuple(path.split("/")), entry)
        return overlays

    # --- nesting ----------------------------------------------------------------------------------

    def _expand(
        self,
        document: Document,
        prefix: str,
        parent: Scope | None,
        wires: dict[str, Wire],
        pending: Iterable[_Overlay],
        chain: tuple[Path, ...],
    ) -> Scope:
        scope = Scope(prefix, document, parent, wires)
        overlays = sorted([*self._own_overlays(document), *pending], key=lambda o: o.rank)
        nodes = {name: _copy(entry) for name, entry in document.nodes.items()} if overlays else document.nodes
        below: dict[str, list[_Overlay]] = {}
        for overlay in overlays:
            whole = "/".join(overlay.path)
            head, rest = (whole, []) if whole in nodes else (overlay.path[0], overlay.path[1:])
            if head not in nodes:
                self._unknown_node(overlay, prefix, nodes)
            elif rest:
                below.setdefault(head, []).append(_Overlay(overlay.rank, tuple(rest), overlay.entry))
            else:
                _lay_over(nodes[head], overlay.entry)
        self._declare_inputs(scope)
        for name, node in nodes.items():
            if node.removed:
                continue
            if node.use is None:
                self._problem(f"node {prefix + name!r} has no 'use': which operator or graph file is it?", node.place)
            elif node.use.value.endswith(GRAPH_SUFFIXES):
                self._expand_graph(scope, node, below.get(name, []), chain)
            else:
                for overlay in below.get(name, []):
                    self._problem(f"node {prefix + name!r} is an operator and has no nodes inside", overlay.entry.place)
                self._count += 1
                self._nodes[prefix + name] = FlatNode(
                    prefix + name, node.place, node.use, {}, node.settings, node.carried
                )
            if self._count > MAX_NODES:
                raise DocumentError([Problem(f"more than {MAX_NODES:,} nodes", node.place)])
        scope.document = copy.copy(document)
        scope.document.nodes = nodes
        return scope

    def _expand_graph(self, scope: Scope, node: NodeEntry, below: list[_Overlay], chain: tuple[Path, ...]) -> None:
        assert node.use is not None
        inner = self._load(node.use.value, scope.document, node.use.place)
        if inner is None:
            return
        assert inner.path is not None
        if inner.path in chain or inner.path.resolve() == (self._top.path and self._top.path.resolve()):
            self._problem(f"{node.use.value!r} uses itself", node.use.place)
            return
        if len(chain) >= MAX_NESTING:
            self._problem(f"graphs nested deeper than {MAX_NESTING}", node.use.place)
            return
        inner = self._with_bases(inner, (inner.path,))
        assert inner.path is not None
        self._count += 1
        pending = _nested(_WITH, (), node)
        constants = _plain(node).settings
        self._check_input_names(scope, node, inner, constants)
        chain = (*chain, inner.path)
        if constants:
            inner = copy.copy(inner)
            inner.inputs = _with_defaults(inner.inputs, constants)
        prefix = f"{scope.prefix}{node.name}/"
        scope.graphs[node.name] = self._expand(inner, prefix, scope, node.wires, [*pending, *below], chain)

    def _check_input_names(
        self, scope: Scope, node: NodeEntry, inner: Document, constants: Mapping[str, Setting]
    ) -> None:
        for port, place in [
            *((p, w.place) for p, w in node.wires.items()),
            *((k, s.place) for k, s in constants.items()),
        ]:
            if port not in inner.inputs and port not in node.carried:
                self._problem(
                    f"graph {node.name!r} ({inner.path and inner.path.name}) has no input {port!r} "
                    f"(it has {', '.join(inner.inputs) or 'none'})",
                    place,
                    nearest_names(port, inner.inputs),
                )
        plugged = {name for name, wire in node.wires.items() if wire.names is not None}
        for name, entry in inner.inputs.items():
            if name not in plugged and name not in constants and not entry.may_stay_open:
                self._problem(f"input {name!r} of graph {scope.prefix + node.name!r} is not connected", node.place)
            if name in plugged and name in constants:
                message = (
                    f"input {name!r} of graph {scope.prefix + node.name!r} is connected, so it cannot be set as well"
                )
                self._problem(message, constants[name].place)

    def _declare_inputs(self, scope: Scope) -> None:
        """Inputs of the whole graph: the top file's, and inner ones left at their default."""
        for name, entry in scope.document.inputs.items():
            wire = scope.wires.get(name)
            if wire is None or wire.names is None:
                self._inputs[scope.prefix + name] = entry

    def _unknown_node(self, overlay: _Overlay, prefix: str, nodes: Mapping[str, NodeEntry]) -> None:
        name = prefix + "/".join(overlay.path)
        known = [*(prefix + n for n in nodes), *self._nodes]
        self._problem(f"no node {name!r} in this graph", overlay.entry.place, nearest_names(name, known))

    # --- references -------------------------------------------------------------------------------

    def _resolve_all(self, top: Scope) -> dict[str, Target]:
        references = References(self._problem)
        stack = [top]
        while stack:
            scope = stack.pop()
            stack.extend(scope.graphs.values())
            for name, node in scope.document.nodes.items():
                flat = self._nodes.get(scope.prefix + name)
                if flat is None or node.removed:
                    continue
                for port, wire in node.wires.items():
                    if wire.names is not None:
                        found = references.wire(scope, wire)
                        flat.wires[port] = (
                            FlatWire(*found, wire.place) if found else FlatWire((), False, wire.place, True)
                        )
        outputs = {}
        for name, setting in top.document.outputs.items():
            found = references.resolve(top, setting.value, setting.place)
            if found is not None and len(found[0]) == 1:
                outputs[name] = found[0][0]
            elif found is not None:
                self._problem(f"output {name!r} is a list of wires; join them in a node", setting.place)
        return outputs

    def _problem(self, message: str, place: Place | None, nearest: Sequence[str] = ()) -> None:
        self._problems.append(Problem(message, place, tuple(nearest)))


def _copy(entry: NodeEntry) -> NodeEntry:
    copied = copy.copy(entry)
    copied.wires, copied.settings = dict(entry.wires), dict(entry.settings)
    copied.carried = set(entry.carried)
    return copied


def _plain(entry: NodeEntry) -> NodeEntry:
    """An entry without its settings of nodes further inside ("inner/node.parameter")."""
    plain = copy.copy(entry)
    plain.settings = {key: setting for key, setting in entry.settings.items() if "." not in key}
    return plain


def _nested(rank: int, path: tuple[str, ...], entry: NodeEntry) -> list[_Overlay]:
    """The settings that `_plain` leaves out, as overlays of the nodes that they are for."""
    overlays = []
    for key, setting in entry.settings.items():
        inner, dot, parameter = key.rpartition(".")
        if dot:
            body = NodeEntry(inner, setting.place or entry.place, settings={parameter: setting})
            overlays.append(_Overlay(rank, (*path, *inner.split("/")), body))
    return overlays


def _lay_over(node: NodeEntry, overlay: NodeEntry) -> None:
    """Lay a partial node over a node; one removed before comes back only where the overlay says what it is."""
    if overlay.removed:
        node.removed = True
        return
    if overlay.use is not None:
        node.removed = False
        if node.use is not None and overlay.use.value != node.use.value:
            node.carried |= {*node.wires, *node.settings}
        node.use = overlay.use
    node.wires |= overlay.wires
    node.settings |= overlay.settings
    node.carried -= {*overlay.wires, *overlay.settings}


def _with_defaults(inputs: Mapping[str, InputEntry], constants: Mapping[str, Setting]) -> dict[str, InputEntry]:
    changed = {name: copy.copy(entry) for name, entry in inputs.items()}
    for name, setting in constants.items():
        if name in changed:
            changed[name].default = setting
    return changed


def read_flag(text: str, flag: str) -> tuple[str, Any]:
    """ "node.parameter=value" of `--set` or `--replace`; the value is a YAML scalar, plain or quoted, or a flow value.

    Raises:
        DocumentError: there is no "=", or the value is not YAML.
    """
    key, equals, value = text.partition("=")
    place = Place(Source(flag, text), 1, 1)
    if not equals or not all(NAME.fullmatch(part) for part in key.replace("/", ".").split(".")):
        raise DocumentError([Problem(f"expected name=value, got {text!r}", place)])
    if value[:1] in ("[", "{", "'", '"'):
        tree, problems = parse(Source(flag, f"value: {value}"))
        if problems:
            raise DocumentError(problems)
        return key, plain(tree["value"])
    return key, scalar(value)
