"""An evaluator that knows what each result cost, for benches whose variants share most of their work.

With one evaluator a face is found and fitted once however many ways it is relit. A stopwatch around each run would
charge the first variant for what the others take from memory. Instead the CPU time of every node is kept from when it
ran, and the cost of a result is the sum over the nodes behind it.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from graphface import Evaluator, MemoryTier, Observer

if TYPE_CHECKING:
    from graphface.evaluate.evaluator import Result
    from graphface.graph.request import Request
    from graphface.graph.structure import Step
    from graphface.record import Record


class MeteredEvaluator(Evaluator):
    """An evaluator with a memory tier that adds up CPU time.

    That is the time of the whole process, threads of OpenCV included, so nodes run one at a time, and BLAS keeps to one
    thread: its others wait in a busy loop, which would count.
    """

    def __init__(self) -> None:
        self._costs = _Costs()
        super().__init__(memory=MemoryTier(), observers=[self._costs])

    def run(self, request: Request, observers: Sequence[Observer] = ()) -> Result:
        from threadpoolctl import threadpool_limits  # type: ignore[import-untyped]

        self._last = request
        with threadpool_limits(1, user_api="blas"):
            return super().run(request, observers)

    def key(self, output: str) -> bytes:
        """The cache key that an output, or any "node", had in the last run."""
        return self._last.key(self._last.graph.targets([output])[output].slot)

    def cpu_ms(self, key: bytes, given: Iterable[bytes] = ()) -> float:
        """CPU milliseconds of all that a result needs and that none of the `given` results needs as well."""
        behind = self._costs.behind
        at_hand = frozenset[bytes]().union(*(behind.get(other, ()) for other in given))
        return 1e3 * sum(self._costs.seconds[needed] for needed in behind.get(key, frozenset()) - at_hand)

    def forget(self, key: bytes) -> None:
        """Let the next run compute a result anew; of all times that a node ran the least counts."""
        assert self.memory is not None
        self.memory.drop(key)


class _Costs(Observer):
    """CPU `seconds` of each node by key, and the keys of all that is `behind` it, its own among them."""

    def __init__(self) -> None:
        self.seconds: dict[bytes, float] = {}
        self.behind: dict[bytes, frozenset[bytes]] = {}
        self._declined: set[tuple[bytes, str]] = set()
        self._started = 0.0

    def run_started(self, request: Request) -> None:
        self._request = request

    def node_started(self, name: str, step: Step | None) -> None:
        self._started = time.process_time()

    def node_finished(self, record: Record, step: Step | None, value: Any) -> None:
        if step is None:
            return
        key = record.key
        if record.state == "declined":
            self._declined.add((key, record.name.removeprefix(f"{step.name}.")))
        elif record.state == "ran":
            took = time.process_time() - self._started
            self.seconds[key] = min(took, self.seconds.get(key, took))
            wired = [argument for argument in step.arguments if (key, argument.port) not in self._declined]
            above = {self._request.key(ref.slot) for argument in wired for ref in argument.refs}
            self.behind[key] = frozenset({key}).union(*(self.behind.get(other, ()) for other in above))
