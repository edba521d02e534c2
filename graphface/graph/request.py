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
from graphface.graph.structure import Ref, Step
from graphface.graph.wired import WiredGraph


@dataclass(frozen=True, eq=False)
class Request:
    """What is asked of a graph; see `request`.

    Attributes:
        bound: what was given for each input, in slot order; None for one that was not given.
        targets: output name to what is asked for.
        keys: of every slot.
    """

    graph: WiredGraph
    bound: Sequence[Bound | None]
    targets: Mapping[str, Ref]
    keys: Keys

    def steps(self) -> list[Step]:
        """The nodes that the targets may need, in an order that runs."""
        return self.graph.steps_behind(self.targets.values())

    def key(self, slot: int) -> bytes:
        return self.keys.by_slot[slot]

    def declined(self, step: Step) -> Declined | None:
        """The lazy ports that a step declines, as far as that is known before the run."""
        return self.keys.declined.get(step.slot) if step.lazy else {}


def request(
    graph: WiredGraph,
    inputs: Mapping[str, Any],
    outputs: Iterable[str] | None = None,
) -> Request:
    """Ask a graph for outputs, of inputs.

    Args:
        inputs: name to array, value or path, or to what `WiredGraph.bind` made of one.
        outputs: names of declared outputs, or any "node" or "node.field"; all declared ones by default.

    Raises:
        InputError, UnreadableFile: an input does not fit, or an output is not there.
    """
    targets = graph.targets(outputs)
    keys, numbers = _latest.get(graph, (None, None))
    by_name = graph.bind(inputs, before=numbers)
    bound = tuple(by_name.get(name) for name in graph.inputs)
    digests = [b.digest if b is not None else b"missing" for b in bound]
    keys = graph.recipe.keys(digests, lambda step: declined_before(step, bound), keys)
    _latest[graph] = keys, {name: b for name, b in by_name.items() if b.is_number}
    return Request(graph, bound, targets, keys)


_latest: WeakKeyDictionary[WiredGraph, tuple[Keys, dict[str, Bound]]] = WeakKeyDictionary()
"""The keys that were last made for each graph and the numbers among its inputs, from which the next keys are made
faster (`graphface.graph.keys`). No picture is among them: nothing but its owner and the tiers keeps one alive."""
