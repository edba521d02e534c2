"""One run: from the outputs asked for, backwards to what they need and no further.

A slot is *demanded* when something needs its value. Demanding looks it up first; only on a miss are its own inputs
demanded, so a memoized output costs one lookup whatever stands behind it. A step whose inputs have arrived is ready; a
step with lazy ports is then asked by its `needs` rule which of them it wants, and only those are demanded. Ready steps
run inline or on a pool of threads: the bookkeeping is the same and stays on the calling thread, so results, order of
records within a branch and what is memoized do not depend on the number of threads.

Depth-first demand with a stack (no recursion: graphs may be 100,000 nodes deep) was chosen over walking a precomputed
plan because lazy ports make the needed set depend on values; `graphface.evaluate.plan` predicts it with the same rules.

A value is let go when its last consumer in the run is done; what the memory tier keeps is that tier's affair.
"""

from __future__ import annotations

import queue
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

from graphface.cache.memory import MISSING
from graphface.errors import NodeError, RunFailed
from graphface.evaluate.calling import Caller, Outcome, take
from graphface.evaluate.observe import Record, State, hooks
from graphface.graph.needs import declined_with
from graphface.graph.wiring import Ref, Step
from graphface.values.frozen import freeze

if TYPE_CHECKING:
    from graphface.evaluate.evaluator import Evaluator
    from graphface.graph.graph import Graph
    from graphface.graph.inputs import Bound


class Run:
    """One evaluation. All state is by key, so that equal nodes of a graph are one."""

    def __init__(
        self, evaluator: Evaluator, graph: Graph, bound: Mapping[str, Bound], targets: Mapping[str, Ref]
    ) -> None:
        self._evaluator = evaluator
        self._memory, self._disk = evaluator.memory, evaluator.disk
        self._graph = graph
        self._first = len(graph.inputs)
        self._bound = [bound.get(name) for name in graph.inputs]
        self._lent: set[int] = set().union(*(b.borrowed for b in self._bound if b is not None))
        self._keys = graph.keys(bound)
        self._targets = targets
        self._kept = {self._keys[ref.slot] for ref in targets.values()}
        self._slots: dict[bytes, int] = {}
        self._done: dict[bytes, Any] = {}
        self._waiting: dict[bytes, int] = {}
        self._dependents: dict[bytes, list[bytes]] = {}
        self._consumers: dict[bytes, int] = {}
        self._ready: list[bytes] = []
        self._sizes: dict[bytes, int] = {}
        self._live = 0
        self._wanted: list[int] = []
        self._decisions = dict(graph.decisions)
        self._declined: dict[bytes, frozenset[str]] = {}
        self._undecided: set[bytes] = set()
        self._spent: list[bytes] = []
        self._failed: dict[bytes, NodeError | None] = {}
        self._records: list[Record] = []
        self._on_finish = hooks(evaluator.observers, "node_finished")
        self._caller = Caller(evaluator, graph, self._bound, self._keys, self._done, self._declined)

    def go(self) -> tuple[dict[str, Any], list[Record]]:
        """The outputs by name, and what became of every node."""
        for hook in hooks(self._evaluator.observers, "run_started"):
            hook(self._graph.steps_behind(self._targets.values()))
        try:
            self._wanted += [ref.slot for ref in self._targets.values()]
            self._demand()
            if self._evaluator.threads == 1:
                self._loop_inline()
            else:
                self._loop_threads()
        finally:
            for hook in hooks(self._evaluator.observers, "run_finished"):
                hook(self._records)
        values = {}
        for name, ref in self._targets.items():
            key = self._keys[ref.slot]
            if key in self._done:
                values[name] = take(self._done[key], ref.fields)
        failures = [f for f in self._failed.values() if f is not None]
        if failures:
            raise RunFailed(failures, values, self._records)
        return values, self._records

    # --- demand -----------------------------------------------------------------------------------

    def _demand(self) -> None:
        """See to it that the slots in `_wanted` get their values: look each up, or demand what it needs."""
        keys, demanded, find, first, steps = (
            self._keys,
            self._slots,
            self._evaluator.find,
            self._first,
            self._graph.steps,
        )
        stack = self._wanted
        while stack:
            slot = stack.pop()
            key = keys[slot]
            if key in demanded:
                continue
            demanded[key] = slot
            step = steps[slot - first] if slot >= first else None
            value, tier = find(key, step)
            if value is not MISSING:
                self._done[key] = value
                self._report(Record(self._name(slot), _operator_name(step), tier, key), step, value)
                self._arrived(key)
            elif step is None:
                self._ready.append(key)
            else:
                above = step.eager
                if step.lazy:
                    above = self._demand_lazy(key, step)
                for parent in (*step.eager, *step.lazy):
                    self._consumers[keys[parent]] = self._consumers.get(keys[parent], 0) + 1
                self._await(key, above)
                stack.extend(above)
        if self._spent and not self._undecided:
            self._let_go()

    def _demand_lazy(self, key: bytes, step: Step) -> tuple[int, ...]:
        """The slots that a step with lazy ports needs as far as is known before its eager inputs are there."""
        decided = self._decisions.get(step.slot)
        if decided is None:
            self._undecided.add(key)
            return step.eager
        return (*step.eager, *self._settle(key, step, decided))

    def _settle(self, key: bytes, step: Step, declined: Mapping[str, str]) -> tuple[int, ...]:
        """Note which lazy ports a step declines; the slots behind those that it wants."""
        self._declined[key] = frozenset(declined)
        for port, reason in declined.items():
            self._report(Record(f"{step.name}.{port}", step.operator.name, "declined", key, reason=reason), step, None)
        wanted = (r.slot for a in step.arguments if a.lazy and a.port not in declined for r in a.refs)
        return tuple(dict.fromkeys(wanted))

    def _await(self, key: bytes, above: Sequence[int]) -> None:
        """Make a step ready once every slot above it has its value."""
        missing = 0
        for slot in above:
            parent = self._keys[slot]
            if parent in self._done:
                continue
            if parent in self._failed:
                self._fail(key, None)
                return
            self._dependents.setdefault(parent, []).append(key)
            missing += 1
        self._waiting[key] = missing
        if missing == 0 and key in self._undecided:
            self._decide(key)
        elif missing == 0:
            self._ready.append(key)

    def _arrived(self, key: bytes) -> None:
        """A value is there: tell the steps that wait for it."""
        waiting = self._waiting
        for dependent in self._dependents.pop(key, ()):
            if dependent in waiting:
                waiting[dependent] -= 1
                if waiting[dependent] == 0:
                    if dependent in self._undecided:
                        self._decide(dependent)
                    else:
                        self._ready.append(dependent)

    def _decide(self, key: bytes) -> None:
        """All eager inputs are there: ask the rule which lazy ones are wanted."""
        step = self._step(key)
        try:
            eager = {a.port: self._caller.argument(a) for a in step.arguments if not a.lazy}
            declined = declined_with(step, eager)
        except Exception as error:
            self._fail(key, self._caller.error(step, error, {}))
            return
        self._undecided.discard(key)
        wanted = self._settle(key, step, declined)
        self._await(key, wanted)
        self._wanted += wanted  # demanded by whoever called: recursion would be as deep as a chain of lazy ports

    # --- loops ------------------------------------------------------------------------------------

    def _loop_inline(self) -> None:
        ready = self._ready
        while ready:
            key = ready.pop()
            self._finish(key, self._caller.evaluate(self._slots[key]))

    def _loop_threads(self) -> None:
        threads = self._evaluator.threads
        finished: queue.SimpleQueue[tuple[bytes, Outcome]] = queue.SimpleQueue()
        running = 0

        def work(key: bytes, slot: int) -> None:
            finished.put((key, self._caller.evaluate(slot)))

        with ThreadPoolExecutor(threads, thread_name_prefix="graphface") as pool:
            while self._ready or running:
                while self._ready and running < (threads if self._live <= self._evaluator.in_flight else 1):
                    key = self._ready.pop()
                    pool.submit(work, key, self._slots[key])
                    running += 1
                key, outcome = finished.get()
                running -= 1
                self._finish(key, outcome)

    # --- bookkeeping, on the calling thread -------------------------------------------------------

    def _finish(self, key: bytes, outcome: Outcome) -> None:
        value, error, seconds, cpu, said = outcome
        if error is not None and not isinstance(error, NodeError):
            raise error
        slot = self._slots[key]
        step = self._graph.steps[slot - self._first] if slot >= self._first else None
        if error is not None:
            self._fail(key, error, seconds)
            return
        self._done[key] = value
        size = 0
        arrays: tuple[Any, ...] = ()
        if type(value) is not float:
            arrays = freeze(value, self._lent)
            if arrays:
                size = self._sizes[key] = sum([a.nbytes for a in arrays])
                self._live += size
        if not arrays or not any(id(a) in self._lent for a in arrays):
            if self._memory is not None:
                self._memory.put(key, value, seconds, arrays)
            if self._disk is not None and step is not None:
                self._store(key, step, value, seconds)
        self._report(
            Record(self._name(slot), _operator_name(step), "ran", key, seconds, cpu, size, "", said or ()), step, value
        )
        self._arrived(key)
        if self._wanted or self._spent:
            self._demand()
        if step is not None:
            self._release(step)

    def _store(self, key: bytes, step: Step, value: Any, seconds: float) -> None:
        assert self._disk is not None
        meta = {"operator": step.operator.name}
        self._disk.put(key, value, cost_seconds=seconds, meta=meta, annotation=step.operator.output_annotation)

    def _release(self, step: Step) -> None:
        """Let go of values that no step of this run waits for any more, once no rule can ask for them again."""
        consumers, keys = self._consumers, self._keys
        for slot in (*step.eager, *step.lazy) if step.lazy else step.eager:
            key = keys[slot]
            consumers[key] -= 1
            if consumers[key] == 0 and key not in self._kept and key in self._done:
                self._spent.append(key)
        if self._spent and not self._undecided:
            self._let_go()

    def _let_go(self) -> None:
        for key in self._spent:
            if self._consumers[key] == 0 and key in self._done:
                del self._done[key], self._slots[key]
                self._live -= self._sizes.pop(key, 0)
        self._spent.clear()

    def _fail(self, key: bytes, error: NodeError | None, seconds: float = 0.0) -> None:
        """Note a failure and everything below that it blocks."""
        stack: list[tuple[bytes, NodeError | None]] = [(key, error)]
        while stack:
            current, failure = stack.pop()
            if current in self._failed:
                continue
            self._failed[current] = failure
            self._waiting.pop(current, None)
            self._undecided.discard(current)
            step = self._step(current)
            state: State = "failed" if failure is not None else "blocked"
            reason = failure.reason if failure is not None else ""
            self._report(Record(step.name, step.operator.name, state, current, seconds, reason=reason), step, None)
            stack.extend((dependent, None) for dependent in self._dependents.pop(current, ()))

    def _report(self, record: Record, step: Step | None, value: Any) -> None:
        self._records.append(record)
        for hook in self._on_finish:
            hook(record, step, value)

    def _step(self, key: bytes) -> Step:
        return self._graph.steps[self._slots[key] - self._first]

    def _name(self, slot: int) -> str:
        return self._graph.steps[slot - self._first].name if slot >= self._first else self._graph.input_names[slot]


def _operator_name(step: Step | None) -> str:
    return step.operator.name if step is not None else "input"
