"""A session: one graph kept at hand while its inputs are edited, for an editor that shows every change at once.

What an edit does not reach stays in memory under its key, so a run after an edit does only what the edit reaches. What
a session adds: inputs that were not edited are not bound again (a picture is hashed and decoded once); a *preview*,
the same graph on reduced inputs, answers while the full result is still to come; and of what edits do reach only the
last few states are remembered, so that hours of dragging a light neither fill the memory nor push the representation
out of it. (Memory that was in use a moment ago is also faster to write to than new.)

    session = Session(load("relight"), {"photo": "portrait.jpg"}, shrink={"photo": half_size})
    session.edit(scene=scene)
    session.preview()["image"]      # quick and small
    session.render()["image"]       # full
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from graphface.cache.memory import MemoryTier
from graphface.evaluate.evaluator import Evaluator, Result
from graphface.evaluate.plan import Planned, plan
from graphface.graph.inputs import Bound
from graphface.graph.request import Request, request
from graphface.graph.wired import WiredGraph

Shrink = Callable[[Any], Any]


class Session:
    """A graph with inputs that can be edited one at a time; safe to use from several threads.

    Args:
        graph: what is evaluated.
        inputs: input name to array, value or path; a mapping, so that no name of an input can be taken for a setting.
        draft: what the preview evaluates, such as the same graph with a quick profile; by default `graph`.
        shrink: input name to a function that makes the preview's value of the full one.
        evaluator: what runs and remembers; one with a memory tier by default.
        history: how many states of each node are remembered, for going back to them at no cost.
    """

    def __init__(
        self,
        graph: WiredGraph,
        inputs: Mapping[str, Any] | None = None,
        *,
        draft: WiredGraph | None = None,
        shrink: Mapping[str, Shrink] | None = None,
        evaluator: Evaluator | None = None,
        history: int = 4,
    ) -> None:
        self.graph = graph
        self.draft: WiredGraph = draft if draft is not None else graph
        self.evaluator: Evaluator = evaluator if evaluator is not None else Evaluator(memory=MemoryTier())
        self.edits: int = 0
        self._shrink = dict(shrink or {})
        self._given: dict[str, Any] = {}
        self._full: dict[str, Bound] = {}
        self._small: dict[str, Bound] = {}
        self._history = max(1, history)
        self._past: dict[tuple[bool, str], list[bytes]] = {}
        self._lock = threading.Lock()
        self.edit(**(inputs or {}))

    def edit(self, /, **inputs: Any) -> None:
        """Change some inputs; the others keep their values and are not looked at again.

        Raises:
            InputError, UnreadableFile: a value does not fit; the session stays as it was.
        """
        with self._lock:
            given = {**self._given, **inputs}
            touched = set(inputs) if self.edits else set(self.graph.input_names)
            bound = self.graph.bind({name: value for name, value in given.items() if name in touched})
            full = {**self._full, **{name: one for name, one in bound.items() if name in touched}}
            small = {**self._small, **self._shrunk(full, touched)}
            self._given, self._full, self._small = given, full, small
            self.edits += 1

    def render(self, outputs: Iterable[str] | None = None) -> Result:
        """The outputs for the inputs as they are now, at full size."""
        with self._lock:
            return self._remembered(self.evaluator.run(self._request(outputs)), full=True)

    def preview(self, outputs: Iterable[str] | None = None) -> Result:
        """The outputs of `draft` for the reduced inputs."""
        with self._lock:
            asked = request(self.draft, self._small, outputs)
            return self._remembered(self.evaluator.run(asked), full=False)

    def plan(self, outputs: Iterable[str] | None = None) -> list[Planned]:
        """What `render` would do now: after an edit, the nodes it reaches."""
        with self._lock:
            return plan(self._request(outputs), self.evaluator)

    def _request(self, outputs: Iterable[str] | None) -> Request:
        return request(self.graph, self._full, outputs)

    def _remembered(self, result: Result, *, full: bool) -> Result:
        """Forget states of the nodes that are older than `history`."""
        memory = self.evaluator.memory
        for record in result.records if memory is not None else ():
            if record.state in ("ran", "memory", "disk"):
                past = self._past.setdefault((full, record.name), [])
                if record.key in past:
                    past.remove(record.key)
                past.append(record.key)
                if len(past) > self._history and memory is not None:
                    memory.drop(past.pop(0))
        return result

    def _shrunk(self, full: Mapping[str, Bound], touched: set[str]) -> dict[str, Bound]:
        """The preview's inputs among `touched`: reduced where there is a way to, else the same."""
        reduced = {name: self._shrink[name](full[name].value) for name in touched & set(self._shrink) & set(full)}
        bound = self.draft.bind(reduced) if reduced else {}
        return {name: bound[name] if name in reduced else full[name] for name in touched if name in full}
