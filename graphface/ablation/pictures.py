"""Pictures of an ablation, drawn while the values of a variant are in memory: outputs, and what lies between.

Of the nodes between, those are drawn that are not the same in every variant: as pictures only, since a page that held
the values under their pixels too would have tens of megabytes. A node that is asked for by name has them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from graphface.ablation.running import Cell, Watcher
from graphface.errors import GraphfaceError
from graphface.evaluate.evaluator import Evaluator
from graphface.graph.demand import take
from graphface.graph.request import Request
from graphface.graph.structure import Ref
from graphface.pictures import draw
from graphface.record import Record
from graphface.report.blobs import Blobs
from graphface.report.compare.embed import layer, message
from graphface.report.difference.side import Side
from graphface.report.recorder import fields_taken
from graphface.values.picture import View

SIZE = 640
"""Pixels of the longer side of an output's picture."""
BETWEEN = 400
"""The most for a node that lies between."""


@dataclass
class CasePictures:
    """The pictures of one case.

    Attributes:
        original: what the output was made from, as the viewer takes it; None where no input is of its type.
        truth: the true output, where there is one.
        places: what can be looked at, the output first: a node, or one of its fields.
        layers: by place and variant.
    """

    original: dict[str, Any] | None = None
    truth: dict[str, Any] | None = None
    places: list[str] = field(default_factory=list)
    layers: dict[tuple[str, int], dict[str, Any]] = field(default_factory=dict)


class Pictures(Watcher):
    """Draws what the page shows.

    Args:
        output: the output that is compared. truths: the true outputs by case, or nothing.
        nodes: further nodes, or "node.field", to draw, with the values under their pixels.
    """

    def __init__(
        self,
        evaluator: Evaluator,
        output: str,
        *,
        truths: Sequence[Any] = (),
        nodes: Sequence[str] = (),
        size: int = SIZE,
    ) -> None:
        self.blobs = Blobs()
        self.cases: list[CasePictures] = []
        self._evaluator = evaluator
        self._output = output
        self._truths = truths
        self._asked = list(nodes)
        self._size = size
        self._variant = 0

    def case_started(self, case: int, requests: Sequence[Request]) -> None:
        """Find out which nodes are not the same in every variant."""
        shown = CasePictures(places=[self._output])
        seen: dict[str, set[bytes]] = {}
        counts: dict[str, int] = {}
        for asked in requests:
            for step in asked.steps():
                seen.setdefault(step.name, set()).add(asked.key(step.slot))
                counts[step.name] = counts.get(step.name, 0) + 1
        outputs = {_name(asked, ref) for asked in requests for ref in asked.targets.values() if not ref.fields}
        for name in _in_order(requests):
            if name not in outputs and (len(seen[name]) > 1 or counts[name] < len(requests)):
                shown.places += _places(name, requests)
        shown.places += [name for name in self._asked if name not in shown.places]
        self.cases.append(shown)
        self._variant = 0

    def variant_finished(self, cell: Cell, asked: Request, records: Sequence[Record]) -> None:
        """Draw the variant's output and nodes; why there is none in place of those that it has not."""
        shown, variant = self.cases[cell.case], self._variant
        self._variant += 1
        side = Side(asked, self._evaluator, records)
        if variant == 0:
            self._given(shown, cell.case, side)
        if cell.failure:
            shown.layers[self._output, variant] = message(cell.variant.name, cell.failure)
        else:
            ref = asked.targets[self._output]
            view = side.view(_name(asked, ref), self._size)
            shown.layers[self._output, variant] = self._layer(cell.value, asked, ref, view, cell.variant.name)
        for place in shown.places[1:]:
            shown.layers[place, variant] = self._between(place, side, cell.variant.name)

    def _given(self, shown: CasePictures, case: int, side: Side) -> None:
        """The input that the output was made from, and the true output."""
        asked = side.request
        declared = asked.graph.type_of(asked.targets[self._output])
        inputs = [name for name in asked.graph.inputs if name in side.needed]
        fitting = [name for name in inputs if declared.accepts(side.type_of(name))]
        if fitting:
            ref = Ref(side.needed[fitting[0]])
            shown.original = self._layer(side.value(fitting[0]), asked, ref, View(self._size), "original")
        truth = self._truths[case] if case < len(self._truths) else None
        if truth is not None:
            target = asked.targets[self._output]
            shown.truth = self._layer(truth, asked, target, View(self._size), "truth")

    def _between(self, place: str, side: Side, label: str) -> dict[str, Any]:
        graph = side.request.graph
        name, _, path = place.partition(".")
        fields = tuple(path.split(".")) if path else ()
        if name not in side.needed:
            why = side.declined.get(name, "not needed here") if name in graph.names else "this variant has no such node"
            return message(label, why)
        if name in side.failures or name in side.blocked:
            return message(label, side.failures.get(name, "a node above it failed"))
        try:
            value = take(side.value(name), fields)
            ref = Ref(side.needed[name], fields)
            asked_for = place in self._asked
            size = self._size if asked_for else min(self._size, BETWEEN)
            return self._layer(value, side.request, ref, side.view(name, size), label, values=asked_for)
        except (GraphfaceError, AttributeError) as error:
            return message(label, str(error))

    def _layer(
        self, value: Any, asked: Request, ref: Ref, view: View, label: str, *, values: bool = True
    ) -> dict[str, Any]:
        declared = asked.graph.type_of(ref)
        picture = draw(value, declared, asked.graph.registry, view)
        if not values:
            picture = replace(picture, data=None)
        return layer(self.blobs.sheet("", str(declared), picture), label)


def _name(asked: Request, ref: Ref) -> str:
    return asked.graph.names[ref.slot]


def _in_order(requests: Sequence[Request]) -> list[str]:
    """The nodes of all variants, in the order of the first that has them."""
    return list(dict.fromkeys(step.name for asked in requests for step in asked.steps()))


def _places(name: str, requests: Sequence[Request]) -> list[str]:
    """A node, or those of its fields that other nodes take."""
    fields: dict[str, None] = {}
    for asked in requests:
        for slot, paths in fields_taken(asked).items():
            if asked.graph.names[slot] == name:
                fields |= dict.fromkeys(".".join(path) for path in sorted(paths))
    return [f"{name}.{path}" for path in fields] or [name]
