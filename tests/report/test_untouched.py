"""Why a run did not touch a node, in words."""

import contextlib

from toys import toy_registry

from graphface import Evaluator, MemoryTier, RunFailed, load
from graphface.report.trace import Trace
from graphface.report.untouched import untouched

TEXT = """\
graphface: 1
inputs: {x: float}
nodes:
  a: {use: toy.add, in: {a: x}, with: {plus: 2}}
  twin: {use: toy.add, in: {a: x}, with: {plus: 2}}
  far: {use: toy.add, in: {a: x}, with: {plus: 7}}
  extra: {use: toy.subtract, in: {a: far}}
  gate: {use: toy.gate, in: {a: a, extra: extra}, with: {open: false}}
  both: {use: toy.add, in: {a: gate, b: twin}}
  bad: {use: toy.fail, in: {a: a}}
  other: {use: toy.add, in: {a: x}, with: {plus: 9}}
"""


def reasons(outputs: list[str], runs: int = 1) -> dict[str, str]:
    """By node, after that many runs with one evaluator that remembers."""
    graph = load(TEXT, registry=toy_registry())
    evaluator, trace = Evaluator(memory=MemoryTier()), Trace()
    for _ in range(runs):
        asked = graph.request({"x": 1.0}, outputs)
        with contextlib.suppress(RunFailed):
            evaluator.run(asked, [trace])
    return {graph.names[slot]: str(reason) for slot, reason in untouched(asked, trace.records).items()}


def test_first_run() -> None:
    """Twins, what was declined with all that only it needs, and what nobody asked for."""
    found = reasons(["both"])
    assert {"x", "gate", "both"}.isdisjoint(found)
    assert [found.get(name) for name in ("a", "twin")].count(None) == 1
    assert "which was evaluated for both" in (found.get("a") or found["twin"])
    assert found["extra"] == found["far"] == "gate declined it: the gate is shut"
    assert found["other"] == found["bad"] == "not needed for both"


def test_memoized() -> None:
    """Everything above a memoized value names it."""
    found = reasons(["gate"], runs=2)
    assert found["a"] == "only gate needs it, and that is memoized"
    assert found["x"] == found["a"]


def test_failed() -> None:
    """Below a failure nothing is without a record."""
    assert "bad" not in reasons(["bad"])
