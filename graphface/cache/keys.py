"""The keys of a graph's slots: what a value is, known before it is computed.

A step's key is one 16-byte digest of its operator (name, version, fingerprint of its code), its canonical parameters,
which fields of which inputs its ports take, and the keys of those inputs. It holds the *digests* of its inputs, never
their nested description, so a key costs the same at any depth, and no pixel of an intermediate is ever read.

A table keeps the keys of the last binding and recomputes only what lies below an input that changed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from hashlib import blake2b

from graphface.cache.digest import canonical
from graphface.fingerprint import Fingerprint, fingerprint
from graphface.node import Operator
from graphface.wiring import Step

KEY_BYTES = 16
DECLINED = b"declined" + bytes(KEY_BYTES - 8)

Decide = Callable[[Step], frozenset[str]]
"""Says which lazy ports of a step are declined, as far as that can be told before anything runs."""


class Code:
    """Digests of operators, recomputed when their code or a helper's is replaced while the process runs."""

    def __init__(self) -> None:
        self._prints: dict[Operator, tuple[Fingerprint, bytes]] = {}

    def digest(self, operator: Operator) -> bytes:
        return self.digests([operator])[operator]

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


class KeyTable:
    """The keys of one graph."""

    def __init__(self, inputs: int, steps: Sequence[Step]) -> None:
        self._steps = steps
        self._operators = list({step.operator for step in steps})
        self._code: dict[Operator, bytes] = {}
        self._statics: list[bytes] = []
        self._parents = [tuple(r.slot for a in step.arguments for r in a.refs) for step in steps]
        self._first = inputs
        self._declined: dict[int, frozenset[str]] = {}
        self.keys: list[bytes] = [b""] * (inputs + len(steps))

    def declined(self, slot: int) -> frozenset[str]:
        """The lazy ports of a step that were declined before the run."""
        return self._declined.get(slot, frozenset())

    def update(self, digests: Sequence[bytes], decide: Decide) -> list[bytes]:
        """The keys for these input digests, by slot.

        Args:
            digests: of the graph inputs, in slot order.
            decide: asked about every step with lazy ports whose inputs changed.
        """
        try:
            return self._update(digests, decide)
        except BaseException:  # interrupted half-way, the keys are those of no inputs at all
            self._statics = []
            raise

    def _update(self, digests: Sequence[bytes], decide: Decide) -> list[bytes]:
        everything = self._refresh_code()
        keys, first = self.keys, self._first
        dirty = bytearray(len(keys))
        changed = everything
        for slot, digest in enumerate(digests):
            if keys[slot] != digest:
                keys[slot] = digest
                dirty[slot] = 1
                changed = True
        if not changed:
            return keys
        if everything:
            dirty[:] = b"\1" * len(dirty)
        for index, parents in enumerate(self._parents):
            for parent in parents:
                if dirty[parent]:
                    break
            else:
                if not everything:
                    continue
            slot = first + index
            step = self._steps[index]
            if step.lazy:
                key = self._lazy_key(step, index, decide)
            else:
                key = blake2b(
                    self._statics[index] + b"".join([keys[p] for p in parents]), digest_size=KEY_BYTES
                ).digest()
            if key != keys[slot]:
                keys[slot] = key
                dirty[slot] = 1
        return keys

    def _lazy_key(self, step: Step, index: int, decide: Decide) -> bytes:
        declined = self._declined[step.slot] = decide(step)
        parts = [self._statics[index]]
        for argument in step.arguments:
            if argument.port in declined:
                parts.append(DECLINED)
            else:
                parts += [self.keys[r.slot] for r in argument.refs]
        return blake2b(b"".join(parts), digest_size=KEY_BYTES).digest()

    def _refresh_code(self) -> bool:
        """Recompute what does not depend on inputs, where an operator's code changed; whether it did."""
        code = CODE.digests(self._operators)
        if code == self._code and self._statics:
            return False
        self._code = code
        plain: dict[tuple[Operator, int, tuple[object, ...]], bytes] = {}
        shapes: dict[tuple[object, ...], bytes] = {}
        self._statics = []
        for step in self._steps:
            shape = tuple((a.port, a.is_list, tuple(r.fields for r in a.refs)) for a in step.arguments)
            identity = (step.operator, id(step.parameters), shape)
            if identity not in plain:
                kept = {n: v for n, v in step.parameters.items() if n not in step.operator.cosmetic}
                if shape not in shapes:
                    shapes[shape] = canonical(shape)
                text = code[step.operator] + canonical(kept) + shapes[shape]
                plain[identity] = blake2b(text, digest_size=KEY_BYTES).digest()
            self._statics.append(plain[identity])
        return True
