"""What differs between two identities of a node: its operator, code, parameters, wiring, or something above it."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from graphface.evaluate.reason import Reason
from graphface.report.history import PINNED, Identity


def changes(
    before: Identity, now: Identity, changed: Collection[str], pinned: Collection[str] = ()
) -> Iterator[Reason]:
    """Every difference between a node's identity then and now, those of the node itself first.

    Args:
        changed: the names of the nodes whose keys are not what they were. pinned: those that have a given value.

    Where another operator stands in the node's place, its code and parameters are not compared: they are others anyway.
    """
    if before.operator == PINNED != now.operator:
        yield Reason("unpinned")
    elif before.operator != now.operator:
        yield Reason("operator", old=before.operator, new=now.operator)
    else:
        if before.code != now.code:
            yield Reason("code")
        for name in {**before.parameters, **now.parameters}:
            old, new = before.parameters.get(name), now.parameters.get(name)
            if old != new:
                yield Reason("parameter", parameter=name, old=str(old), new=str(new))
    for port in {**before.inputs, **now.inputs}:
        if before.inputs.get(port) != now.inputs.get(port):
            yield _input_change(port, before.inputs.get(port, []), now.inputs.get(port, []), changed, pinned)


def _input_change(
    port: str, before: list[list[str]], now: list[list[str]], changed: Collection[str], pinned: Collection[str]
) -> Reason:
    there, here = [name for name, _ in before], [name for name, _ in now]
    if there != here:
        return Reason("wiring", port=port, old=", ".join(there) or "nothing", new=", ".join(here) or "nothing")
    culprit = next(name for (name, new), (_, old) in zip(now, before, strict=True) if new != old).partition(".")[0]
    if culprit in pinned:
        return Reason("pinned above", node=culprit)
    return Reason("node above" if culprit in changed else "input", node=culprit, port=port)
