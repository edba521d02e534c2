"""What differs between two identities of a node."""

from __future__ import annotations

from dataclasses import replace

from graphface.report.changes import changes
from graphface.report.history import Identity

THEN = Identity("toy.add", "c0", {"plus": "1"}, {"a": [["x", "k1"]], "b": [["n.low", "k2"]]}, "key")


def kinds(now: Identity, changed: set[str] = frozenset()) -> list[str]:  # type: ignore[assignment]
    return [reason.kind for reason in changes(THEN, now, changed)]


def test_the_same() -> None:
    """No reason."""
    assert kinds(THEN) == []


def test_every_difference() -> None:
    """Those of the node itself first, then those above it."""
    now = replace(
        THEN, code="c1", parameters={"plus": "2", "new": "3"}, inputs={"a": [["x", "k9"]], "b": [["n.low", "k8"]]}
    )
    assert kinds(now, {"n"}) == ["code", "parameter", "parameter", "input", "node above"]


def test_another_operator() -> None:
    """Its code and parameters are others anyway."""
    assert kinds(replace(THEN, operator="toy.subtract", code="c1", parameters={})) == ["operator"]


def test_wiring() -> None:
    """Another wire, or none."""
    (reason,) = changes(THEN, replace(THEN, inputs={"a": THEN.inputs["a"]}), ())
    assert str(reason) == "port b is connected to nothing, was n.low"
