"""A graph ready to run: load it from YAML, ask for outputs, look at it.

    graph = load("relight.yaml", profiles=["draft"], set={"mask.softness": 0.2})
    result = graph.run(photo="portrait.jpg", outputs=["image", "face/mesh.normals"])

Loading checks everything; what is left to fail in a run are the operators themselves.
"""

from __future__ import annotations

import gc
import importlib.util
import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from graphface.cache.memory import MemoryTier
from graphface.document.compose import Choices, compose
from graphface.document.document import Document, parse_document, read_document
from graphface.document.effective import escaped
from graphface.document.flat import Composition
from graphface.document.graph_files import GRAPH_SUFFIXES, find_graph
from graphface.document.located import Source
from graphface.document.provenance import read_provenance
from graphface.document.references import References
from graphface.errors import DocumentError, InputError, UsageError, nearest_names
from graphface.evaluate.evaluator import Evaluator, Result
from graphface.graph.inputs import Bound, bind, missing_inputs
from graphface.graph.keys import KeyTable
from graphface.graph.needs import declined_now
from graphface.graph.wiring import GraphInput, Ref, Step, field_type, wire
from graphface.registry import Registry, default_registry
from graphface.values.port_types import PortType

if TYPE_CHECKING:
    import networkx

_shared = Evaluator(memory=MemoryTier())


def load(
    source: str | Path | Mapping[str, Any],
    *,
    variants: Sequence[str] = (),
    profiles: Sequence[str] = (),
    replace: Mapping[str, str] | None = None,
    set: Mapping[str, Any] | None = None,
    plugins: Sequence[str | Path] = (),
    registry: Registry | None = None,
) -> Graph:
    """A graph from a file, a shipped graph's name ("relight"), a YAML text, a mapping of the same form, or a result
    that carries its graph.

    Args:
        variants, profiles: names of overlays that the graph declares.
        replace: node path to the operator to use there instead.
        set: "node.parameter" to value; wins over everything.
        plugins: files of further operators.
        registry: where names are looked up; everything installed by default.

    Raises:
        DocumentError: the graph is wrong; all problems with file, line and column.
        UnreadableFile: there is no such file.
    """
    registry = registry if registry is not None else default_registry()
    if plugins:
        registry = registry.extended()
        for plugin in plugins:
            registry.add_file(Path(plugin))
    shipped = shipped_folders(registry)
    choices = Choices(tuple(variants), tuple(profiles), dict(replace or {}), dict(set or {}))
    with _collector_paused():
        document, problems = _read(source, shipped, registry)
        if problems:
            raise DocumentError(problems)
        return Graph(compose(document, choices, shipped=shipped), registry)


def shipped_folders(registry: Registry) -> list[Path]:
    """The folders of graph files that installed packs offer."""
    folders = []
    for package in registry.graph_packages():
        spec = importlib.util.find_spec(package)
        if spec is not None and spec.submodule_search_locations:
            folders.append(Path(spec.submodule_search_locations[0]))
    return folders


class Graph:
    """A graph, checked and in an order that runs; see `load`.

    Attributes:
        inputs: the graph's inputs by name. steps: its nodes, each after what it depends on.
        outputs: the declared outputs. composition: the effective document, before operators were looked up.
    """

    def __init__(self, composition: Composition, registry: Registry) -> None:
        self.composition = composition
        self.registry = registry
        wiring = wire(composition, registry)
        self.inputs: dict[str, GraphInput] = wiring.inputs
        self.steps: list[Step] = wiring.steps
        self.outputs: dict[str, Ref] = wiring.outputs
        self.input_names = list(wiring.inputs)
        self.decisions: dict[int, dict[str, str]] = {}
        self._slots = wiring.slots
        self._table = KeyTable(len(self.inputs), self.steps)

    def __repr__(self) -> str:
        return f"Graph({self.name!r}, {len(self.steps)} nodes, outputs: {', '.join(self.outputs)})"

    @property
    def name(self) -> str:
        return self.composition.name

    def run(
        self, /, outputs: Iterable[str] | None = None, *, evaluator: Evaluator | None = None, **inputs: Any
    ) -> Result:
        """Evaluate outputs and only what they need.

        Args:
            outputs: names of declared outputs, or any "node" or "node.field"; all declared ones by default.
            evaluator: where to run and what to keep; by default one per process with a memory tier.
            inputs: arrays, values or paths by input name. One called `outputs` or `evaluator` goes another way:
                `evaluator.run(graph, graph.bind({"outputs": value}), graph.targets())`.

        Raises:
            InputError, UnreadableFile: an input is missing or does not fit. RunFailed: a node failed.
        """
        evaluator = evaluator if evaluator is not None else _shared
        return evaluator.run(self, self.bind(inputs), self.targets(outputs))

    def bind(self, given: Mapping[str, Any], *, stat_shortcut: bool = True) -> dict[str, Bound]:
        """Graph inputs with their digests; see `graphface.graph.inputs.bind`."""
        return bind(self.inputs, given, self.registry.files, roots=self._default_roots, stat_shortcut=stat_shortcut)

    def targets(self, outputs: Iterable[str] | None = None) -> dict[str, Ref]:
        """What is asked for, as slots.

        Raises:
            InputError: a name that is neither an output nor a node.
        """
        names = list(self.outputs) if outputs is None else list(outputs)
        return {name: self._target(name) for name in names}

    def type_of(self, ref: Ref) -> PortType:
        """The declared type behind a target."""
        first = len(self.inputs)
        base = self.steps[ref.slot - first].operator.output if ref.slot >= first else self._input_at(ref.slot).type
        found = field_type(base, ref.fields)
        assert found is not None
        return found

    def keys(self, bound: Mapping[str, Bound]) -> list[bytes]:
        """The key of every slot for these inputs."""
        ordered = [bound.get(name) for name in self.inputs]
        digests = [b.digest if b is not None else b"missing" for b in ordered]

        def decide(step: Step) -> frozenset[str]:
            try:
                found = declined_now(step, ordered)
            except Exception:  # asked again in the run, where its failure is that of a node with a name and a place
                found = None
            if found is None:
                self.decisions.pop(step.slot, None)
                return frozenset()
            self.decisions[step.slot] = found
            return frozenset(found)

        return list(self._table.update(digests, decide))

    def behind(self, targets: Iterable[Ref]) -> list[int]:
        """All slots that `targets` may need, lazy ones included, in an order that runs."""
        first, seen = len(self.inputs), set()
        stack = [ref.slot for ref in targets]
        while stack:
            slot = stack.pop()
            if slot not in seen:
                seen.add(slot)
                if slot >= first:
                    stack.extend((*self.steps[slot - first].eager, *self.steps[slot - first].lazy))
        return sorted(seen)

    def steps_behind(self, targets: Iterable[Ref]) -> list[Step]:
        """The nodes among `behind`."""
        first = len(self.inputs)
        return [self.steps[slot - first] for slot in self.behind(targets) if slot >= first]

    def missing(self, given: Mapping[str, Any], targets: Iterable[Ref]) -> list[str]:
        """Inputs that `targets` may need and that are neither given nor have a default."""
        needed = {self.input_names[s] for s in self.behind(targets) if s < len(self.inputs)}
        return [name for name in missing_inputs(self.inputs, given) if name in needed]

    def networkx(self) -> networkx.DiGraph[str]:
        """The graph for drawing and analysis: nodes have `operator`, edges have `port`."""
        import networkx

        drawn: networkx.DiGraph[str] = networkx.DiGraph(name=self.name)
        drawn.add_nodes_from((name, {"operator": None, "type": str(i.type)}) for name, i in self.inputs.items())
        names = [*self.inputs, *(s.name for s in self.steps)]
        for step in self.steps:
            drawn.add_node(step.name, operator=step.operator.name, type=str(step.operator.output))
            for argument in step.arguments:
                for ref in argument.refs:
                    drawn.add_edge(names[ref.slot], step.name, port=argument.port, lazy=argument.lazy)
        return drawn

    def _repr_html_(self) -> str:
        """A notebook's view: inputs, every node with its operator and what is plugged into it, outputs."""
        from html import escape

        names = [*self.inputs, *(step.name for step in self.steps)]
        rows = [
            f"<tr><td><b>{escape(i.name)}</b></td><td>input: {escape(str(i.type))}</td><td></td></tr>"
            for i in self.inputs.values()
        ]
        for step in self.steps:
            wires = [
                f"{a.port} = {', '.join('.'.join((names[r.slot], *r.fields)) for r in a.refs)}" for a in step.arguments
            ]
            cells = (f"<b>{escape(step.name)}</b>", escape(step.operator.name), escape("; ".join(wires)))
            rows.append(f"<tr>{''.join(f'<td>{cell}</td>' for cell in cells)}</tr>")
        title = f"{escape(self.name)}: {escape(', '.join(self.outputs))}"
        return f"<table><caption>{title}</caption>{''.join(rows)}</table>"

    def _input_at(self, slot: int) -> GraphInput:
        return self.inputs[self.input_names[slot]]

    @cached_property
    def _default_roots(self) -> list[Path]:
        own = self.composition.path.resolve().parent if self.composition.path is not None else Path.cwd()
        return [own, *shipped_folders(self.registry)]

    def _target(self, name: str) -> Ref:
        if name in self.outputs:
            return self.outputs[name]
        said: list[str] = []
        nearest: list[str] = []

        def complain(message: str, place: object, near: Sequence[str]) -> None:
            said.append(message)
            nearest.extend(near)

        found = References(complain).resolve(self.composition.scope, name, None)
        if found is None or len(found[0]) != 1:
            reason = said[0] if said else "is a list of wires"
            raise InputError(name, reason, nearest_names(name, [*self.outputs, *self._slots]) or nearest)
        target = found[0][0]
        if target.name not in self._slots:
            raise InputError(name, "no output or node of this name", nearest_names(name, [*self.outputs, *self._slots]))
        declared = self.type_of(Ref(self._slots[target.name]))
        if field_type(declared, target.fields) is None:
            raise InputError(name, f"{target.name!r} ({declared}) has no field {'.'.join(target.fields)!r}")
        return Ref(self._slots[target.name], target.fields)


@contextmanager
def _collector_paused() -> Iterator[None]:
    """Loading allocates and keeps everything, so collecting on the way only costs: at 100,000 nodes 157 µs a node with
    the garbage collector, 95 without, and linear only without."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


def _read(
    source: str | Path | Mapping[str, Any], shipped: Sequence[Path], registry: Registry
) -> tuple[Document, list[Any]]:
    if isinstance(source, Mapping):
        return parse_document(Source("<mapping>", _as_text(source)))
    if isinstance(source, str) and "\n" in source:
        return parse_document(Source("<text>", source))
    path = find_graph(str(source), shipped)
    if path.suffix.lower() in GRAPH_SUFFIXES:
        return read_document(path)
    return parse_document(Source(f"{path} (its provenance)", read_provenance(path, registry)))


def _as_text(graph: Mapping[str, Any]) -> str:
    """A mapping as JSON, which is YAML too, and in which a text never looks like a number."""
    try:
        lines = json.dumps(dict(graph), indent=1, ensure_ascii=False).split("\n")
        return "\n".join(escaped(line) for line in lines)
    except (TypeError, ValueError, RecursionError) as error:
        raise UsageError(f"a graph given as a mapping holds plain values only: {error}") from None
