"""Names to operators: the flat graph checked against ports, parameters and types, and put in an order that runs.

Everything wrong is found in one pass and reported together: unknown operators, ports and parameters, values out of
range, a mask plugged into a picture, a required port left open, a cycle. After this nothing about the graph can fail
but the operators themselves.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from graphlib import CycleError, TopologicalSorter
from types import MappingProxyType
from typing import Any

from pydantic import BaseModel, ValidationError

from graphface.document.document import InputEntry, Setting
from graphface.document.flat import Composition, FlatNode, FlatWire
from graphface.document.located import place_inside, plain
from graphface.document.mistakes import choices, reason
from graphface.document.references import Target
from graphface.errors import DeclarationError, DocumentError, Problem, UnknownOperator, UnknownType, nearest_names
from graphface.graph.structure import Argument, GraphInput, Ref, Step, Structure, field_type
from graphface.node import InputPort, Operator
from graphface.place import Place
from graphface.registry import Registry
from graphface.values.port_types import ListOf, PortType, output_fields


def wire(composition: Composition, registry: Registry) -> Structure:
    """Look up, check and order a flat graph.

    Raises:
        DocumentError: with every problem found.
    """
    return _Wirer(composition, registry).run()


class _Wirer:
    def __init__(self, composition: Composition, registry: Registry) -> None:
        self._graph = composition
        self._registry = registry
        self._problems: list[Problem] = list(composition.problems)
        self._operators: dict[str, Operator | None] = {}
        self._unusable: dict[str, str] = {}
        self._bare: dict[str, dict[str, Any]] = {}

    def run(self) -> Structure:
        inputs = {
            name: GraphInput(slot, name, self._input_type(entry), entry.default, entry.doc, entry.place)
            for slot, (name, entry) in enumerate(self._graph.inputs.items())
        }
        operators = {name: self._operator(node) for name, node in self._graph.nodes.items()}
        types = {name: entry.type for name, entry in inputs.items()}
        types |= {name: op.output for name, op in operators.items() if op is not None}
        slots = {name: slot for slot, name in enumerate([*inputs, *self._order()])}
        steps = []
        for name in list(slots)[len(inputs) :]:
            operator, node = operators[name], self._graph.nodes[name]
            if operator is None:
                continue
            order = list(operator.inputs)
            arguments = tuple(sorted(self._arguments(node, operator, types, slots), key=lambda a: order.index(a.port)))
            settings, parameters = self._parameters(node, operator)
            steps.append(Step(slots[name], name, operator, arguments, parameters, settings, node.place))
        outputs = {}
        for name, target in self._graph.outputs.items():
            if self._checked_type(target, types, None, f"output {name!r}") is not None:
                outputs[name] = Ref(slots[target.name], target.fields)
        if self._problems:
            raise DocumentError(self._problems)
        return Structure(MappingProxyType(inputs), tuple(steps), MappingProxyType(slots), MappingProxyType(outputs))

    def _input_type(self, entry: InputEntry) -> PortType:
        try:
            return self._registry.type(entry.type.value)
        except UnknownType as error:
            self._problem(f"unknown type {error.name!r} of input {entry.name!r}", entry.type.place, error.nearest)
            return PortType((object,), optional=True)

    def _operator(self, node: FlatNode) -> Operator | None:
        name = node.use.value
        nearest: list[str] = []
        if name not in self._operators:
            self._operators[name] = None
            try:
                operator = self._registry.operator(name)
                operator.check()
                self._operators[name] = operator
            except UnknownOperator as error:
                self._unusable[name], nearest = error.reason, error.nearest
            except DeclarationError as error:
                self._unusable[name] = str(error)
        if name in self._unusable:
            self._problem(self._unusable[name], node.use.place, nearest)
        return self._operators[name]

    # --- order ------------------------------------------------------------------------------------

    def _order(self) -> list[str]:
        """Node names so that each stands after what it depends on; a cycle is a problem."""
        nodes = self._graph.nodes
        above = {
            name: {target.name for wire in node.wires.values() for target in wire.targets if target.name in nodes}
            for name, node in nodes.items()
        }
        try:
            return list(TopologicalSorter(above).static_order())
        except CycleError as error:
            self._report_cycle(error.args[1][1:])
            return list(nodes)

    def _report_cycle(self, cycle: list[str]) -> None:
        first = min(cycle, key=lambda n: self._graph.nodes[n].place.line)
        start = cycle.index(first)
        path = [*cycle[start:], *cycle[:start], first]
        self._problem(f"a cycle: {' -> '.join(path)}", self._graph.nodes[first].place)

    # --- ports ------------------------------------------------------------------------------------

    def _arguments(
        self, node: FlatNode, operator: Operator, types: Mapping[str, PortType], slots: Mapping[str, int]
    ) -> Iterator[Argument]:
        for port_name, flat in node.wires.items():
            port = operator.inputs.get(port_name)
            if port is None:
                if port_name not in node.carried:
                    self._unknown_port(node, operator, port_name, flat)
                continue
            if flat.broken:
                continue
            as_list = self._check_wire(node, port, flat, types)
            if as_list is not None and all(t.name in slots for t in flat.targets):
                refs = tuple(Ref(slots[t.name], t.fields) for t in flat.targets)
                yield Argument(port_name, refs, as_list, port.lazy)
        for port in operator.inputs.values():
            if port.required and port.name not in node.wires:
                self._problem(
                    f"port {port.name!r} ({port.type}) of node {node.name!r} ({operator.name}) is not connected",
                    node.place,
                )

    def _check_wire(
        self, node: FlatNode, port: InputPort, flat: FlatWire, types: Mapping[str, PortType]
    ) -> bool | None:
        """Whether the port gets a list; None where the wire does not fit."""
        what = f"port {port.name!r} of node {node.name!r}"
        found = [self._checked_type(target, types, flat.place, what) for target in flat.targets]
        sources = [source for source in found if source is not None]
        if len(sources) < len(found):
            return None
        item = next((a.item for a in port.type.alternatives if isinstance(a, ListOf)), None)
        single = len(sources) == 1 and not flat.is_list
        if single and port.type.accepts(sources[0]):
            return False
        if item is not None and all(item.accepts(source) for source in sources):
            return True
        wanted = item if item is not None and not single else port.type
        misfit = _misfit(flat.targets, sources, wanted, f"{what} ({node.use.value})")
        self._problem(misfit or f"{what} takes one {port.type}, not a list", flat.place)
        return None

    def _checked_type(
        self, target: Target, types: Mapping[str, PortType], place: Place | None, what: str
    ) -> PortType | None:
        """The type behind a target; None, with the problem noted, where a field does not exist."""
        base = types.get(target.name)
        if base is None:
            return None
        found = field_type(base, target.fields)
        if found is None:
            offered = [name for a in base.alternatives if isinstance(a, type) for name in output_fields(a)]
            has = f"it has {', '.join(offered)}" if offered else "it has none"
            wanted = ".".join(target.fields)
            self._problem(
                f"{target.name!r} ({base}) has no output {wanted!r} for {what} ({has})",
                place,
                nearest_names(target.fields[0], offered),
            )
        return found

    def _unknown_port(self, node: FlatNode, operator: Operator, port: str, flat: FlatWire) -> None:
        if port in operator.parameters.model_fields:
            self._problem(f"{port!r} is a parameter of {operator.name}, not a port; set it under 'with'", flat.place)
            return
        known = ", ".join(operator.inputs) or "none"
        self._problem(
            f"{operator.name} has no port {port!r} (it has {known})", flat.place, nearest_names(port, operator.inputs)
        )

    # --- parameters -------------------------------------------------------------------------------

    def _parameters(self, node: FlatNode, operator: Operator) -> tuple[dict[str, Setting], dict[str, Any]]:
        """The settings that apply, and all parameters validated."""
        if not node.settings:
            if not self._bare.get(operator.name):  # what is wrong without settings is wrong at every such node
                self._bare[operator.name] = self._validate(node, operator, {})
            return {}, self._bare[operator.name]
        model = operator.parameters
        settings = {}
        for name, setting in node.settings.items():
            if name in model.model_fields:
                settings[name] = setting
            elif name in node.carried:
                continue
            elif name in operator.inputs:
                self._problem(f"{name!r} is a port of {operator.name}; connect it under 'in'", setting.place)
            else:
                known = ", ".join(model.model_fields) or "none"
                self._problem(
                    f"{operator.name} has no parameter {name!r} (it has {known})",
                    setting.place,
                    nearest_names(name, model.model_fields),
                )
        return settings, self._validate(node, operator, settings)

    def _validate(self, node: FlatNode, operator: Operator, settings: Mapping[str, Setting]) -> dict[str, Any]:
        model = operator.parameters
        try:
            checked: BaseModel = model.model_validate({name: plain(s.value) for name, s in settings.items()})
        except ValidationError as error:
            for detail in error.errors(include_url=False):
                name = str(detail["loc"][0]) if detail["loc"] else ""
                setting = settings.get(name)
                place: Place | None = node.place
                if setting is not None:
                    place = place_inside(setting.value, detail["loc"][1:]) or setting.place
                inside = "".join(f"[{part!r}]" for part in detail["loc"][1:])
                if detail["type"] == "missing" and setting is None:
                    message = f"parameter {name!r} of node {node.name!r} ({operator.name}) is required"
                else:
                    message = f"parameter {name!r}{inside} of node {node.name!r} ({operator.name}): {reason(detail)}"
                self._problem(message, place, nearest_names(str(detail["input"]), choices(detail), 1))
            return {}
        return {name: getattr(checked, name) for name in model.model_fields}

    def _problem(self, message: str, place: Place | None, nearest: list[str] | tuple[str, ...] = ()) -> None:
        self._problems.append(Problem(message, place, tuple(nearest)))


def _misfit(targets: Sequence[Target], sources: Sequence[PortType], wanted: PortType, what: str) -> str:
    """The first wire whose type is not taken, in words; empty where each is."""
    for target, source in zip(targets, sources, strict=True):
        if not wanted.accepts(source):
            hint = " (it may be None; the port is not optional)" if source.optional and not wanted.optional else ""
            return f"{target} gives {source}, but {what} takes {wanted}{hint}"
    return ""
