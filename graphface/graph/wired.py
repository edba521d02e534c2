"""A graph whose names are looked up and checked: what is asked of it is answered in slots. Nothing in it changes."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from graphface.document.effective import effective
from graphface.document.flat import Composition
from graphface.document.provenance import KEY as PROVENANCE
from graphface.document.references import References
from graphface.errors import InputError, nearest_names
from graphface.graph.demand import reached
from graphface.graph.inputs import Bound, bind, missing_inputs
from graphface.graph.keys import KeyRecipe
from graphface.graph.structure import GraphInput, Ref, Step, field_type
from graphface.graph.wiring import wire
from graphface.registry import Registry
from graphface.values.port_types import PortType

if TYPE_CHECKING:
    import networkx


class WiredGraph:
    """A graph, checked and in an order that runs.

    Any number of threads, sessions and evaluators may use it at once: what a run knows is in its `Request`.

    Attributes:
        inputs: the graph's inputs by name. steps: its nodes, each after what it depends on.
        outputs: the declared outputs. composition: the effective document, before operators were looked up.
    """

    def __init__(self, composition: Composition, registry: Registry) -> None:
        self.composition = composition
        self.registry = registry
        structure = wire(composition, registry)
        self.inputs: Mapping[str, GraphInput] = structure.inputs
        self.steps: tuple[Step, ...] = structure.steps
        self.outputs: Mapping[str, Ref] = structure.outputs
        self.input_names: tuple[str, ...] = tuple(structure.inputs)
        self._structure = structure

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.name!r}, {len(self.steps)} nodes, outputs: {', '.join(self.outputs)})"

    @property
    def name(self) -> str:
        return self.composition.name

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The names of inputs and steps, by slot."""
        return (*self.inputs, *(step.name for step in self.steps))

    @cached_property
    def recipe(self) -> KeyRecipe:
        """How the keys of its slots are made."""
        return KeyRecipe(self._structure)

    def step(self, slot: int) -> Step | None:
        """The step at a slot; None where an input is."""
        first = len(self.inputs)
        return self.steps[slot - first] if slot >= first else None

    def bind(
        self, given: Mapping[str, Any], *, stat_shortcut: bool = True, before: Mapping[str, Bound] | None = None
    ) -> dict[str, Bound]:
        """Graph inputs with their digests; see `graphface.graph.inputs.bind`."""
        files, roots = self.registry.files, self._default_roots
        return bind(self.inputs, given, files, roots=roots, stat_shortcut=stat_shortcut, before=before or {})

    def targets(self, outputs: Iterable[str] | None = None) -> dict[str, Ref]:
        """What is asked for, as slots.

        Raises:
            InputError: a name that is neither an output nor a node.
        """
        names = list(self.outputs) if outputs is None else list(outputs)
        return {name: self._target(name) for name in names}

    def type_of(self, ref: Ref) -> PortType:
        """The declared type behind a target."""
        step = self.step(ref.slot)
        base = step.operator.output if step is not None else self.inputs[self.input_names[ref.slot]].type
        found = field_type(base, ref.fields)
        assert found is not None
        return found

    def node(self, name: str) -> Step:
        """The node of a name; what a nested graph calls so ("face.mask") is a name too.

        Raises:
            InputError: there is no such node, or the name is that of an input or of a field.
        """
        slot = self._structure.slots.get(name)
        target = Ref(slot) if slot is not None else self._target(name)
        step = self.step(target.slot)
        if step is None:
            raise InputError(name, "is an input of the graph; give it as one")
        if target.fields:
            raise InputError(name, f"is a field; name the whole node, {step.name!r}")
        return step

    def behind(self, targets: Iterable[Ref], without: Container[int] = ()) -> list[int]:
        """All slots that `targets` may need, lazy ones included, in an order that runs.

        Args:
            without: slots above which nothing is needed.
        """

        def above(slot: int) -> tuple[int, ...]:
            step = self.step(slot)
            return (*step.eager, *step.lazy) if step is not None and slot not in without else ()

        return sorted(reached((ref.slot for ref in targets), above))

    def missing(self, given: Mapping[str, Any], targets: Iterable[Ref]) -> list[str]:
        """Inputs that `targets` may need and that are neither given nor have a default."""
        needed = {self.input_names[s] for s in self.behind(targets) if s < len(self.inputs)}
        return [name for name in missing_inputs(self.inputs, given) if name in needed]

    def effective(self, *, origins: bool = True) -> str:
        """The graph as one flat YAML text; see `graphface.document.effective`."""
        return effective(self.composition, self.registry, origins=origins)

    def provenance(self) -> dict[str, str]:
        """What a result of this graph keeps inside its file, so that it can be run again."""
        return {PROVENANCE: self.effective(origins=False)}

    def networkx(self) -> networkx.DiGraph[str]:
        """The graph for drawing and analysis: nodes have `operator`, edges have `port`."""
        import networkx

        drawn: networkx.DiGraph[str] = networkx.DiGraph(name=self.name)
        drawn.add_nodes_from((name, {"operator": None, "type": str(i.type)}) for name, i in self.inputs.items())
        for step in self.steps:
            drawn.add_node(step.name, operator=step.operator.name, type=str(step.operator.output))
            for argument in step.arguments:
                for ref in argument.refs:
                    drawn.add_edge(self.names[ref.slot], step.name, port=argument.port, lazy=argument.lazy)
        return drawn

    @cached_property
    def _default_roots(self) -> list[Path]:
        own = self.composition.path.resolve().parent if self.composition.path is not None else Path.cwd()
        return [own, *self.registry.graph_folders()]

    def _target(self, name: str) -> Ref:
        if name in self.outputs:
            return self.outputs[name]
        slots = self._structure.slots
        complaints: list[str] = []
        nearest: list[str] = []

        def complain(message: str, place: object, near: Sequence[str]) -> None:
            complaints.append(message)
            nearest.extend(near)

        found = References(complain).resolve(self.composition.scope, name, None)
        if found is None or len(found[0]) != 1:
            reason = complaints[0] if complaints else "is a list of wires"
            raise InputError(name, reason, nearest_names(name, [*self.outputs, *slots]) or nearest)
        target = found[0][0]
        if target.name not in slots:
            raise InputError(name, "no output or node of this name", nearest_names(name, [*self.outputs, *slots]))
        declared = self.type_of(Ref(slots[target.name]))
        if field_type(declared, target.fields) is None:
            raise InputError(name, f"{target.name!r} ({declared}) has no field {'.'.join(target.fields)!r}")
        return Ref(slots[target.name], target.fields)
