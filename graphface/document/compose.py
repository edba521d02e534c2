"""Many graph files and flags to one flat graph: `extends`, nested graphs, variants, profiles, `--replace`, `--set`.

One order decides between settings of the same thing, weakest first:

1. the operator's own defaults,
2. a file's base (`extends`), then the file itself,
3. what an enclosing graph says under `with` of the node that uses the file,
4. variants, in the order asked for; a used file's own before its user's,
5. profiles, likewise,
6. `--replace`, then `--set`.

Every overlay is the same thing, a partial node addressed by its path ("face/landmarks"), so there is one mechanism:
overlays travel down to the file that declares the node and are laid over it in the order of their rank. The parts have
modules of their own: which file a name means (`graph_files`), what `extends` does (`extending`), what an overlay is
(`overlays`, `flags`), what a wire leads to (`references`), and what comes out (`flat`).
"""

from __future__ import annotations

import copy
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from graphface.document.document import Document, InputEntry, NodeEntry, Setting, Wire
from graphface.document.extending import with_bases
from graphface.document.flags import flag_overlays, flag_place
from graphface.document.flat import Composition, FlatNode, FlatWire
from graphface.document.graph_files import GRAPH_SUFFIXES, GraphFiles
from graphface.document.overlays import Overlay, Rank, chosen_overlays, copied, inner_parts, lay_over, own_part
from graphface.document.references import MAX_NESTING, References, Scope, Target
from graphface.errors import DocumentError, Problem, nearest_names
from graphface.place import Place

MAX_NODES = 200_000
"""Graphs in graphs multiply what their files say: nine files of ten nodes each would make 10^9."""


@dataclass(frozen=True)
class Choices:
    """What the caller chose: names of variants and profiles, operators to replace and parameters to set, by path."""

    variants: Sequence[str] = ()
    profiles: Sequence[str] = ()
    replace: Mapping[str, str] = field(default_factory=dict)
    set: Mapping[str, Any] = field(default_factory=dict)


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


class _Composer:
    def __init__(self, document: Document, choices: Choices, shipped: Sequence[Path]) -> None:
        self._top = document
        self._choices = choices
        self._problems: list[Problem] = []
        self._files = GraphFiles(document, shipped, self._problems)
        self._declared: dict[str, set[str]] = {"variant": set(), "profile": set()}
        self._nodes: dict[str, FlatNode] = {}
        self._inputs: dict[str, InputEntry] = {}
        self._count = 0

    def run(self) -> Composition:
        document = with_bases(self._top, self._files, self._problems)
        flags = flag_overlays(self._choices.replace, self._choices.set, self._problems)
        scope = self._expand(document, "", None, {}, flags, ())
        self._check_choices()
        return Composition(
            path=document.path,
            name=document.name or (document.path.stem if document.path else "graph"),
            doc=document.doc,
            inputs=self._inputs,
            nodes=self._nodes,
            outputs=self._resolve_all(scope),
            variants=sorted(self._declared["variant"]),
            profiles=sorted(self._declared["profile"]),
            scope=scope,
            problems=self._problems,
            files=[*([document.path] if document.path is not None else []), *self._files.read],
        )

    def _check_choices(self) -> None:
        for kind, chosen in (("variant", self._choices.variants), ("profile", self._choices.profiles)):
            known = sorted(self._declared[kind])
            has = f"the graph has {', '.join(known)}" if known else "the graph has none"
            for name in chosen:
                if name not in known:
                    place = flag_place(f"--{kind}", name)
                    self._problem(f"unknown {kind} {name!r} ({has})", place, nearest_names(name, known))

    # --- nesting ----------------------------------------------------------------------------------

    def _expand(
        self,
        document: Document,
        prefix: str,
        parent: Scope | None,
        wires: dict[str, Wire],
        pending: Iterable[Overlay],
        chain: tuple[Path, ...],
    ) -> Scope:
        """Put a file's nodes, and those of the graphs that it uses, into the flat graph.

        Args:
            prefix: of the names in the flat graph ("face/"). parent, wires: who uses the file, and plugs what into it.
            pending: overlays from outside for nodes in here. chain: the files around this one.
        """
        self._declared["variant"] |= document.variants.keys()
        self._declared["profile"] |= document.profiles.keys()
        scope = Scope(prefix, document, parent, wires)
        own = chosen_overlays(document, self._choices.variants, self._choices.profiles)
        overlays = sorted([*own, *pending], key=lambda o: o.rank)
        nodes = {name: copied(entry) for name, entry in document.nodes.items()} if overlays else document.nodes
        below = self._lay(overlays, nodes, prefix)
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
                raise DocumentError(
                    [Problem(f"more than {MAX_NODES:,} nodes; graphs used in graphs multiply", node.place)]
                )
        scope.document = copy.copy(document)
        scope.document.nodes = nodes
        return scope

    def _lay(self, overlays: Iterable[Overlay], nodes: dict[str, NodeEntry], prefix: str) -> dict[str, list[Overlay]]:
        """Lay overlays over a file's nodes; returns those for nodes further inside, by the node that leads there."""
        below: dict[str, list[Overlay]] = {}
        for overlay in overlays:
            whole = "/".join(overlay.path)
            head, rest = (whole, ()) if whole in nodes else (overlay.path[0], overlay.path[1:])
            if head not in nodes:
                known = [*(prefix + n for n in nodes), *self._nodes]
                nearest = nearest_names(prefix + whole, known)
                self._problem(f"no node {prefix + whole!r} in this graph", overlay.entry.place, nearest)
            elif rest:
                below.setdefault(head, []).append(Overlay(overlay.rank, rest, overlay.entry))
            else:
                lay_over(nodes[head], overlay.entry)
        return below

    def _expand_graph(self, scope: Scope, node: NodeEntry, below: list[Overlay], chain: tuple[Path, ...]) -> None:
        assert node.use is not None
        inner = self._files.load(node.use.value, scope.document, node.use.place)
        if inner is None:
            return
        assert inner.path is not None
        if inner.path in chain or inner.path.resolve() == (self._top.path and self._top.path.resolve()):
            self._problem(f"{node.use.value!r} uses itself", node.use.place)
            return
        if len(chain) >= MAX_NESTING:
            self._problem(f"graphs nested deeper than {MAX_NESTING}", node.use.place)
            return
        chain = (*chain, inner.path)
        inner = with_bases(inner, self._files, self._problems, (inner.path,))
        self._count += 1
        constants = own_part(node).settings
        self._check_input_names(node, inner, constants)
        self._check_connections(scope, node, inner, constants)
        if constants:
            inner = copy.copy(inner)
            inner.inputs = _with_defaults(inner.inputs, constants)
        pending = [*inner_parts(Rank.WITH, (), node), *below]
        prefix = f"{scope.prefix}{node.name}/"
        scope.graphs[node.name] = self._expand(inner, prefix, scope, node.wires, pending, chain)

    def _check_input_names(self, node: NodeEntry, inner: Document, constants: Mapping[str, Setting]) -> None:
        entries: list[tuple[str, Wire | Setting]] = [*node.wires.items(), *constants.items()]
        for port, entry in entries:
            if port not in inner.inputs and port not in node.carried:
                self._problem(
                    f"graph {node.name!r} ({inner.path and inner.path.name}) has no input {port!r} "
                    f"(it has {', '.join(inner.inputs) or 'none'})",
                    entry.place,
                    nearest_names(port, inner.inputs),
                )

    def _check_connections(
        self, scope: Scope, node: NodeEntry, inner: Document, constants: Mapping[str, Setting]
    ) -> None:
        """Every input of a used graph gets its value from one side."""
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
                    if wire.names is None:
                        flat.wires[port] = FlatWire((), False, wire.place, unplugged=True)
                        continue
                    found = references.wire(scope, wire)
                    flat.wires[port] = FlatWire(*found, wire.place) if found else FlatWire((), False, wire.place, True)
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


def _with_defaults(inputs: Mapping[str, InputEntry], constants: Mapping[str, Setting]) -> dict[str, InputEntry]:
    changed = {name: copy.copy(entry) for name, entry in inputs.items()}
    for name, setting in constants.items():
        if name in changed:
            changed[name].default = setting
    return changed
