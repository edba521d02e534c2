"""What a run did again and why, in one line: "3 of 36 nodes ran in 0.8 s: parameter order of face/light 2 -> 1"."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence

from graphface.evaluate.evaluator import Evaluator
from graphface.evaluate.observe import Observer
from graphface.evaluate.reason import Reason
from graphface.graph.request import Request
from graphface.record import Record
from graphface.report.explain import Explained, explain
from graphface.report.history import History

_SHOWN = 2
_CAUSES = {
    "parameter": "parameter {parameter} of {name} {old} -> {new}",
    "operator": "{name} is {new} instead of {old}",
    "wiring": "port {port} of {name} is connected to {new}",
    "input": "input {node} changed",
    "unpinned": "{name} is pinned no longer",
    "pinned above": "{node} is pinned",
    "first seen": "{name} is new",
    "failed before": "{name} failed before",
}


class Rerun(Observer):
    """Follows one run and says what it did.

    Args:
        history: what was known before; somebody else lets it learn.
    """

    def __init__(self, evaluator: Evaluator, history: History) -> None:
        self.request: Request | None = None
        self.line: str = ""
        self._evaluator = evaluator
        self._history = history
        self._explained: list[Explained] = []
        self._first = True
        self._started = 0.0

    def run_started(self, request: Request) -> None:
        self._first = not self._history.last(request.graph.name)
        self._explained = explain(request, self._evaluator, self._history)
        self.request = request
        self._started = time.perf_counter()

    def run_finished(self, records: Sequence[Record]) -> None:
        assert self.request is not None
        ran = {r.name for r in records if r.state in ("ran", "failed")}
        failed = sum(r.state == "failed" for r in records)
        entries = [e for e in self._explained if e.name in ran and e.fate != "pinned"]
        seconds = time.perf_counter() - self._started
        self.line = f"{len(entries)} of {len(self.request.steps())} nodes ran in {seconds:.1f} s"
        self.line += f", {failed} failed" if failed else ""
        why = "first run" if self._first else causes(entries)
        self.line += f": {why}" if why else ": nothing that the outputs depend on has changed" if not entries else ""


def causes(ran: Sequence[Explained]) -> str:
    """Why these nodes ran: what changed of some of them, not that others stand below those."""
    code = list(dict.fromkeys(e.operator for e in ran if _why(e).kind == "code"))
    found = [f"the code of {_listed(code, ', ')} changed"] if code else []
    found += dict.fromkeys(_causes(ran))
    if not found:
        found = list(dict.fromkeys(f"{e.name}: {_why(e)}" for e in ran if _why(e)))
    return _listed(found, "; ")


def _listed(texts: Sequence[str], separator: str) -> str:
    more = f" and {len(texts) - _SHOWN} more" if len(texts) > _SHOWN else ""
    return separator.join(texts[:_SHOWN]) + more


def _causes(ran: Sequence[Explained]) -> Iterator[str]:
    for entry in ran:
        why = _why(entry)
        if why.kind in _CAUSES:
            parts = {part: getattr(why, part) for part in ("node", "port", "parameter", "old", "new")}
            yield _CAUSES[why.kind].format(name=entry.name, operator=entry.operator, **parts)


def _why(entry: Explained) -> Reason:
    return entry.reason if entry.fate == "run" else entry.otherwise
