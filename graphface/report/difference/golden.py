"""A run against a folder of known-good values: which node goes wrong first.

The folder is what `graphface run ... --dump DIR` wrote (`graphface.report.dump`). Only values count: another version of
an operator that gives the same is no difference.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from graphface.errors import GraphfaceError, UnreadableFile
from graphface.evaluate.evaluator import Evaluator
from graphface.evaluate.reason import Reason
from graphface.graph.request import Request
from graphface.report.difference.compare import merged
from graphface.report.difference.found import Differences
from graphface.report.difference.node import NodeDifference
from graphface.report.difference.recorded import read_recorded
from graphface.report.difference.side import Side, failure_of
from graphface.report.difference.tolerance import GOLDEN, Tolerance
from graphface.report.difference.values import differences
from graphface.report.dump import RUN, value_path
from graphface.report.trace import jsonable
from graphface.values.picture import View
from graphface.values.port_types import PortType
from graphface.values.value_file import read_value

_HAD = ("ran", "memory", "disk")
"""States of a node that has a value."""


class Dumped:
    """The values in the folder, as one side of a comparison.

    Args:
        other: the side that is compared with it: says what types the values have, and what stands above them.

    Attributes:
        nodes: those with a value, each with what the folder's trace says of it. without: those whose value could not be
            stored. failed: those that failed then.
    """

    def __init__(self, folder: Path, other: Side) -> None:
        recorded = {str(node["name"]): node for node in read_recorded(folder / RUN).nodes}
        inputs = {name for name, node in recorded.items() if node.get("operator") == "input"}
        self.folder = folder
        self._other = other
        stored = {path.relative_to(folder).with_suffix("").as_posix() for path in folder.rglob("*.npz")}
        in_order = [*recorded, *sorted(stored - recorded.keys())]
        self.nodes = {name: recorded.get(name, {}) for name in in_order if name in stored - inputs}
        self.without = {name for name, node in recorded.items() if name not in stored and node.get("state") in _HAD}
        self.failed = {name for name, node in recorded.items() if node.get("state") == "failed"}

    def value(self, name: str) -> Any:
        """The known-good value.

        Raises:
            UnreadableFile: it was not dumped, or cannot be read.
        """
        graph = self._other.request.graph
        step = graph.step(self._other.needed[name])
        annotation = step.operator.output_annotation if step is not None else Any
        return read_value(value_path(self.folder, name), annotation)

    def type_of(self, name: str) -> PortType:
        return self._other.type_of(name)

    def view(self, name: str, size: int) -> View:
        return self._other.view(name, size)


class GoldenComparison:
    """A run and a folder of known-good values.

    Attributes:
        sides: the folder, the run.

    Raises:
        UnreadableFile: the folder is none that --dump wrote.
    """

    labels = ("known good", "now")

    def __init__(self, asked: Request, folder: Path, evaluator: Evaluator) -> None:
        now = Side(asked, evaluator)
        self.sides = Dumped(folder, now), now

    def differences(self, tolerance: Tolerance = Tolerance(GOLDEN)) -> Differences:  # noqa: B008 - is frozen
        """Compare every node that has a dumped value, and name those that only one side has."""
        good, now = self.sides
        listed: list[NodeDifference] = []
        below: list[NodeDifference] = []
        compared = 0
        steps = [name for name in now.needed if name not in now.request.graph.inputs]
        for name in merged([n for n in good.nodes if n not in now.request.graph.inputs], steps):
            if name not in good.nodes and (name in good.without or self._has_twin(name)):
                continue
            found = self._node(name)
            compared += name in good.nodes and name in now.needed
            if found is None or (found.kind == "values" and not found.parts):
                continue
            slight = found.kind == "values" and all(tolerance.allows(part) for part in found.parts)
            (below if slight else listed).append(found)
        unknown = [(name, "its value could not be stored in the folder") for name in steps if name in good.without]
        return Differences(self.labels, listed, below, not_compared=unknown, compared=compared, tolerance=tolerance)

    def _has_twin(self, name: str) -> bool:
        """Whether an equal node, evaluated for both, stands in the folder."""
        good, now = self.sides
        key = now.request.key(now.needed[name])
        return any(n in good.nodes for n, slot in now.needed.items() if now.request.key(slot) == key)

    def _node(self, name: str) -> NodeDifference | None:
        good, now = self.sides
        operators = str(good.nodes.get(name, {}).get("operator", "")), self._operator(name)
        reasons = self._reasons(name)
        if name not in now.needed:
            there = name in now.request.graph.names
            why = now.declined.get(name, "nothing that is asked for needs it") if there else "there is no such node now"
            return NodeDifference(name, operators, "only there", words=why)
        if name in now.failures:
            return (
                None
                if name in good.failed
                else NodeDifference(name, operators, "failed", reasons=reasons, words=f"now: {now.failures[name]}")
            )
        if name in now.blocked:
            words = "now: a node above it failed"
            return (
                NodeDifference(name, operators, "failed", reasons=reasons, words=words) if name in good.nodes else None
            )
        if name not in good.nodes:
            return NodeDifference(name, operators, "only here", words="no known-good value of it")
        try:
            parts = sorted(differences(good.value(name), now.value(name)), key=lambda p: -p.relative)
        except UnreadableFile as error:
            return NodeDifference(name, operators, "only here", words=f"no known-good value of it: {error.reason}")
        except GraphfaceError as error:
            return NodeDifference(name, operators, "failed", reasons=reasons, words=failure_of(error))
        return NodeDifference(name, operators, "values", tuple(parts), reasons)

    def _reasons(self, name: str) -> tuple[Reason, ...]:
        """What the folder's trace says of the node's settings then, beside those of now."""
        good, now = self.sides
        graph = now.request.graph
        step = graph.step(now.needed[name]) if name in now.needed else None
        then = good.nodes.get(name)
        if step is None or then is None:
            return ()
        if then.get("operator") != step.operator.name:
            return (Reason("operator", old=str(then.get("operator")), new=step.operator.name),)
        old, new = then.get("parameters") or {}, jsonable(step.parameters)
        return tuple(
            Reason("parameter", parameter=p, old=str(old.get(p)), new=str(new.get(p)))
            for p in {**old, **new}
            if old.get(p) != new.get(p) and p not in step.operator.cosmetic
        )

    def _operator(self, name: str) -> str:
        graph = self.sides[1].request.graph
        step = graph.step(graph.names.index(name)) if name in graph.names else None
        return step.operator.name if step is not None else ""
