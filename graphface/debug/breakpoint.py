"""`Breakpoint`: an observer that stops a run before or after a node, and hands over what is there.

evaluator = Evaluator(memory=MemoryTier(), observers=[Breakpoint("face/mask", at="after")])
relight.run(evaluator=evaluator, photo="portrait.jpg")
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from graphface.debug.stop import At, Stop
from graphface.errors import UsageError, nearest_names
from graphface.evaluate.observe import Observer
from graphface.graph.request import Request
from graphface.graph.structure import Step
from graphface.graph.wired import WiredGraph
from graphface.record import Record

When = Callable[[str, Step, Any], object]


class Breakpoint(Observer):
    """Stops a run of one graph at a node; with several threads one node stands at a time while others go on.

    A node that is memoized does not run: a run stops before it never, after it only where its value is looked up.

    Args:
        node: a node or several, by name; "NODE:after" and "NODE:before" win over `at`.
        when: called with the name, the step, and the arguments by port (before) or the value (after); what is false
            lets the run go on.
        at: before the node's function is called, or after, also where it failed.
        then: called with the `Stop`, on whatever thread the node runs; by default a prompt in the terminal.

    Raises:
        UsageError: `at` is neither.
    """

    def __init__(
        self,
        node: str | Sequence[str],
        when: When | None = None,
        at: At = "before",
        then: Callable[[Stop], None] | None = None,
    ) -> None:
        self._places = [_place(text, at) for text in ([node] if isinstance(node, str) else node)]
        self._when = when
        self._then: Callable[[Stop], None] = then if then is not None else _ask
        self._lock = threading.Lock()
        self._stepping = False
        self._request: Request | None = None
        self._nodes: dict[At, set[str]] = {"before": set(), "after": set()}
        self._called: dict[str, Mapping[str, Any]] = {}

    def check(self, graph: WiredGraph) -> list[Step]:
        """The nodes of a graph at which this stops.

        Raises:
            InputError: there is no such node.
        """
        return [graph.node(name) for name, _ in self._places]

    def run_started(self, request: Request) -> None:
        self._request = request
        self._called.clear()
        self._nodes = {"before": set(), "after": set()}
        for step, (_, at) in zip(self.check(request.graph), self._places, strict=True):
            self._nodes[at].add(step.name)

    def node_called(self, name: str, step: Step, arguments: Mapping[str, Any]) -> None:
        if name in self._nodes["after"]:
            self._called[name] = arguments
        if self._stepping or (name in self._nodes["before"] and self._wanted(name, step, arguments)):
            self._stop(step, "before", arguments)

    def node_finished(self, record: Record, step: Step | None, value: Any) -> None:
        if step is None or record.name not in self._nodes["after"] or record.state in ("blocked", "declined"):
            return
        arguments = self._called.pop(record.name, None)
        failed = record.state == "failed"
        if failed or self._wanted(record.name, step, value):
            self._stop(step, "after", arguments, value, record.reason)

    def _wanted(self, name: str, step: Step, looked_at: Any) -> bool:
        return self._when is None or bool(self._when(name, step, looked_at))

    def _stop(
        self, step: Step, at: At, arguments: Mapping[str, Any] | None, value: Any = None, error: str = ""
    ) -> None:
        assert self._request is not None
        with self._lock:
            stop = Stop(self._request, step, at, arguments, value, error)
            self._stepping = False
            self._then(stop)
            self._stepping = stop.steps


def _place(text: str, at: At) -> tuple[str, At]:
    name, colon, word = text.rpartition(":")
    if not colon:
        name, word = text, at
    if word == "before":
        return name, "before"
    if word == "after":
        return name, "after"
    raise UsageError(f"{text!r}: stops before or after a node, not {word!r}{_hint(word)}")


def _hint(word: str) -> str:
    near = nearest_names(word, ["before", "after"], 1)
    return f"; did you mean {near[0]!r}?" if near else ""


def _ask(stop: Stop) -> None:
    from graphface.debug.prompt import ask

    ask(stop)
