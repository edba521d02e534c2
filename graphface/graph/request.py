"""One request of a graph: which outputs, of which inputs, and the keys that follow from them.

Everything that a run knows before it begins is in this value, and nothing in it changes. Run, plan, history and explain
are all given the same request, so they speak of the same inputs and the same keys, on whatever thread each of them is.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any
from weakref import WeakKeyDictionary

from graphface.graph.demand import declined_before
from graphface.graph.inputs import Bound
from graphface.graph.keys import Declined, Keys
from graphface.graph.pinning import bind_pinned
from graphface.graph.structure import Ref, Step
from graphface.graph.wired import WiredGraph


@dataclass(frozen=True, eq=False)
class Request:
    """What is asked of a graph; see `request`.

    Attributes:
        bound: what was given for each input, in slot order; None for one that was not given.
        targets: output name to what is asked for.
        keys: of every slot.
        pinned: the values that stand in for nodes, by slot (`graphface.graph.pinning`).
    """

    graph: WiredGraph
    bound: Sequence[Bound | None]
    targets: Mapping[str, Ref]
    keys: Keys
    pinned: Mapping[int, Bound]

    def steps(self) -> list[Step]:
        """The nodes that the targets may need, in an order that runs; pinned ones are none of them."""
        return [step for slot in self.behind(self.targets.values()) if (step := self.step(slot)) is not None]

    def step(self, slot: int) -> Step | None:
        """The node that gives a slot its value; None where an input or a pinned value does."""
        return self.graph.step(slot) if slot not in self.pinned else None

    def given(self, slot: int) -> Bound | None:
        """What was given for an input or for a pinned node; None where nothing was."""
        return self.pinned.get(slot) if slot >= len(self.bound) else self.bound[slot]

    def behind(self, targets: Iterable[Ref]) -> list[int]:
        """All slots that `targets` may need, nothing above pinned nodes, in an order that runs."""
        return self.graph.behind(targets, self.pinned)

    def key(self, slot: int) -> bytes:
        return self.keys.by_slot[slot]

    def declined(self, step: Step) -> Declined | None:
        """The lazy ports that a step declines, as far as that is known before the run."""
        return self.keys.declined.get(step.slot) if step.lazy else {}


def request(
    graph: WiredGraph,
    inputs: Mapping[str, Any],
    outputs: Iterable[str] | None = None,
    pinned: Mapping[str, Any] | None = None,
) -> Request:
    """Ask a graph for outputs, of inputs.

    Args:
        inputs: name to array, value or path, or to what `WiredGraph.bind` made of one.
        outputs: names of declared outputs, or any "node" or "node.field"; all declared ones by default.
        pinned: node name to a value, or the path of one, that stands in for what the node would give.

    Raises:
        InputError, UnreadableFile: an input or a pinned value does not fit, or an output is not there.
    """
    targets = graph.targets(outputs)
    stand_ins = bind_pinned(graph, pinned) if pinned else {}
    keys, numbers = _latest.get(graph, (None, None))
    by_name = graph.bind(inputs, before=numbers)
    bound = tuple(by_name.get(name) for name in graph.inputs)
    digests = [b.digest if b is not None else b"missing" for b in bound]
    own = {slot: b.digest for slot, b in stand_ins.items()}
    keys = graph.recipe.keys(digests, lambda step: declined_before(step, bound), keys, own)
    _latest[graph] = keys, {name: b for name, b in by_name.items() if b.is_number}
    return Request(graph, bound, targets, keys, stand_ins)


def changed(asked: Request, name: str, value: Any) -> Request:
    """The same request with another value for an input, or with one that stands in for a node.

    Raises:
        InputError, UnreadableFile: there is no such input or node, or the value does not fit.
    """
    inputs: dict[str, Any] = {b.name: b for b in asked.bound if b is not None}
    pinned: dict[str, Any] = {b.name: b for b in asked.pinned.values()}
    (inputs if name in asked.graph.inputs else pinned)[name] = value
    return request(asked.graph, inputs, asked.targets, pinned)


_latest: WeakKeyDictionary[WiredGraph, tuple[Keys, dict[str, Bound]]] = WeakKeyDictionary()
"""The keys that were last made for each graph and the numbers among its inputs, from which the next keys are made
faster (`graphface.graph.keys`). No picture is among them: nothing but its owner and the tiers keeps one alive."""
