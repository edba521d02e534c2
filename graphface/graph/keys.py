"""The keys of a graph's slots: what a value is, known before it is computed.

A step's key is one 16-byte digest of its operator (name, version, fingerprint of its code), its canonical parameters,
which fields of which inputs its ports take, and the keys of those inputs. It holds the *digests* of its inputs, never
their nested description, so a key costs the same at any depth, and no pixel of an intermediate is ever read.

`Keys` is a value, made once for the inputs of one request and never written to afterwards. A table that the graph
updated in place was rejected: a second thread that used the graph read keys of the first one's inputs, and a cache then
kept its results under them. A run takes its inputs, its keys and its answers of `needs` rules from one request, so no
result can be stored under a key that was made for anything else. Keys of an earlier request only save work: what lies
below no changed input is copied from them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from hashlib import blake2b
from operator import itemgetter
from types import MappingProxyType

from graphface.fingerprint import Fingerprint, fingerprint
from graphface.graph.structure import Step, Structure
from graphface.node import Operator
from graphface.values.digest import canonical

KEY_BYTES = 16
DECLINED = b"declined" + bytes(KEY_BYTES - 8)

Declined = Mapping[str, str]
"""The lazy ports that a step declines, each with the reason."""

Decide = Callable[[Step], Declined | None]
"""Says which lazy ports of a step are declined; None where that cannot be told before something has run."""


class Code:
    """Digests of operators, recomputed when their code or a helper's is replaced while the process runs."""

    def __init__(self) -> None:
        self._prints: dict[Operator, tuple[Fingerprint, bytes]] = {}

    def digests(self, operators: Sequence[Operator]) -> dict[Operator, bytes]:
        """The digest of each; what several share is looked at once."""
        known = {operator: self._prints[operator] for operator in operators if operator in self._prints}
        watched = {watch for found, _ in known.values() for watch in found.watched}
        changed = {watch for watch in watched if watch.changed()}
        for operator in operators:
            if operator not in known or (changed and not changed.isdisjoint(known[operator][0].watched)):
                known[operator] = self._prints[operator] = self._take(operator)
        return {operator: known[operator][1] for operator in operators}

    def _take(self, operator: Operator) -> tuple[Fingerprint, bytes]:
        found = fingerprint(operator.function, operator.needs)
        named = canonical((operator.name, operator.version, found.digest))
        return found, blake2b(named, digest_size=KEY_BYTES).digest()


CODE = Code()


@dataclass(frozen=True, eq=False)
class Keys:
    """The keys of one request.

    Attributes:
        by_slot: 16 bytes for each input and step.
        declined: by slot, for the steps whose `needs` rule could be asked before the run.
        digests: of the graph inputs; code: of the operators; pinned: of the values that stand in for steps, by slot.
            What the keys were made from.
    """

    by_slot: Sequence[bytes]
    declined: Mapping[int, Declined]
    digests: tuple[bytes, ...]
    code: Mapping[Operator, bytes]
    pinned: Mapping[int, bytes]


@dataclass(frozen=True, eq=False)
class _Row:
    """What of a step's key does not depend on inputs or code."""

    step: Step
    operator: Operator
    settings: bytes
    parents: tuple[int, ...]
    marks: Callable[[bytearray], tuple[int, ...]]
    """Of the step itself and its parents, what an array by slot holds: one call, where a loop took most of the time."""


class KeyRecipe:
    """How the keys of a graph are made; nothing in it changes."""

    def __init__(self, structure: Structure) -> None:
        self._first = len(structure.inputs)
        self._operators = tuple(dict.fromkeys(step.operator for step in structure.steps))
        known: dict[tuple[object, ...], bytes] = {}
        self._rows = tuple(_row(step, known) for step in structure.steps)

    def keys(
        self,
        digests: Sequence[bytes],
        decide: Decide,
        before: Keys | None = None,
        pinned: Mapping[int, bytes] = MappingProxyType({}),
    ) -> Keys:
        """The keys for these input digests, in slot order.

        Args:
            decide: asked about every step with lazy ports that an input change reaches.
            before: keys of the same graph for other inputs.
            pinned: by slot, the digests of values that stand in for steps; each is the key of its slot.
        """
        digests = tuple(digests)
        code = CODE.digests(self._operators)
        if before is None or before.code != code or before.pinned != pinned:
            changed = bytearray(b"\1" * (self._first + len(self._rows)))
            by_slot = [*digests, *(b"" for _ in self._rows)]
            declined: dict[int, Declined] = {}
        elif before.digests == digests:
            return before
        else:
            changed = bytearray(old != new for old, new in zip(before.digests, digests, strict=True))
            changed.extend(bytes(len(self._rows)))
            by_slot = [*digests, *before.by_slot[self._first :]]
            declined = dict(before.declined)
        for slot, digest in pinned.items():
            by_slot[slot] = digest
        for slot, row in self._not_in(pinned):
            if not any(row.marks(changed)):
                continue
            text = code[row.operator] + row.settings
            if row.step.lazy:
                text += _lazy_parents(row.step, by_slot, declined, decide)
            else:
                text += b"".join([by_slot[parent] for parent in row.parents])
            key = blake2b(text, digest_size=KEY_BYTES).digest()
            changed[slot] = key != by_slot[slot]
            by_slot[slot] = key
        return Keys(by_slot, declined, digests, code, pinned)

    def _not_in(self, pinned: Mapping[int, bytes]) -> Iterable[tuple[int, _Row]]:
        """The rows with their slots, without those that are pinned."""
        rows = enumerate(self._rows, self._first)
        return ((slot, row) for slot, row in rows if slot not in pinned) if pinned else rows


def _row(step: Step, known: dict[tuple[object, ...], bytes]) -> _Row:
    parents = tuple(r.slot for a in step.arguments for r in a.refs)
    marks = itemgetter(step.slot, step.slot, *parents)  # twice, since of one alone it gives no tuple
    return _Row(step, step.operator, _settings(step, known), parents, marks)


def _settings(step: Step, known: dict[tuple[object, ...], bytes]) -> bytes:
    """A digest of a step's parameters and of which fields its ports take; nodes without settings share theirs."""
    shape = tuple((a.port, a.is_list, tuple(r.fields for r in a.refs)) for a in step.arguments)
    identity = (step.operator, id(step.parameters), shape)
    if identity not in known:
        kept = {name: value for name, value in step.parameters.items() if name not in step.operator.cosmetic}
        known[identity] = blake2b(canonical(kept) + canonical(shape), digest_size=KEY_BYTES).digest()
    return known[identity]


def _lazy_parents(step: Step, by_slot: Sequence[bytes], declined: dict[int, Declined], decide: Decide) -> bytes:
    """The keys behind a step's ports, a constant standing for those that it declines."""
    answer = decide(step)
    declined.pop(step.slot, None)
    if answer is not None:
        declined[step.slot] = answer
    parts = []
    for argument in step.arguments:
        if answer is not None and argument.port in answer:
            parts.append(DECLINED)
        else:
            parts += [by_slot[r.slot] for r in argument.refs]
    return b"".join(parts)
