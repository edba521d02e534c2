"""One run: from the outputs asked for, backwards to what they need and no further.

A slot is *demanded* when something needs its value. Demanding looks it up first; only on a miss are its own inputs
demanded, so a memoized output costs one lookup whatever stands behind it. A step whose inputs have arrived is ready; a
step with lazy ports is then asked by its `needs` rule which of them it wants, and only those are demanded. Ready steps
run inline or on a pool of threads: the bookkeeping is the same and stays on the calling thread, so results, order of
records within a branch and what is memoized do not depend on the number of threads.

Depth-first demand with a stack (no recursion: graphs are deep) was chosen over walking a precomputed plan because lazy
ports make the needed set depend on values; `graphface.evaluate.plan` predicts it by the same rule,
`graphface.graph.demand`.

All state is by key, so that equal nodes of a graph are one. A value is let go when its last reader in the run is done;
what the memory tier keeps is that tier's affair.
"""

from __future__ import annotations

import queue
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from types import MappingProxyType
from typing import Any, Protocol

from graphface.cache.memory import MISSING
from graphface.errors import NodeError, RunFailed
from graphface.evaluate.calling import Caller, Outcome
from graphface.evaluate.observe import Hooks
from graphface.evaluate.task import Task, label
from graphface.fallback import collect_warnings, collected_warnings, python_warnings
from graphface.graph.demand import declined_with, demanded, take
from graphface.graph.keys import Declined
from graphface.graph.request import Request
from graphface.graph.structure import Step
from graphface.record import Record, State
from graphface.values.frozen import freeze


class Tiers(Protocol):
    """Where values are looked up and kept."""

    def find(self, key: bytes, step: Step | None) -> tuple[Any, State]: ...

    def keep(self, key: bytes, step: Step | None, value: Any, seconds: float, arrays: tuple[Any, ...]) -> None: ...


_NOTHING: Declined = MappingProxyType({})


class Run:
    """One evaluation of a request."""

    def __init__(
        self,
        request: Request,
        tiers: Tiers,
        call: Callable[[dict[bytes, Any]], Caller],
        hooks: Hooks,
        threads: int,
        in_flight: int,
    ) -> None:
        self._request = request
        self._tiers = tiers
        self._threads = threads
        self._in_flight = in_flight
        self._hooks = hooks
        self._on_finish = hooks.node_finished
        self._names = request.graph.names
        self._steps: Sequence[Step | None] = request.graph.steps
        if request.pinned:
            self._steps = [step if step.slot not in request.pinned else None for step in request.graph.steps]
        self._first = len(request.graph.inputs)
        self._keys = request.keys.by_slot
        self._kept = {self._keys[ref.slot] for ref in request.targets.values()}
        self._values: dict[bytes, Any] = {}
        self._caller = call(self._values)
        self._tasks: dict[bytes, Task] = {}
        self._demanded: list[Task] = []
        self._ready: list[Task] = []
        self._undecided = 0
        self._spent: list[Task] = []
        self._live = 0
        self._failures: list[NodeError] = []
        self._records: list[Record] = []

    def go(self) -> tuple[dict[str, Any], list[Record]]:
        """The outputs by name, and what became of every node.

        Raises:
            RunFailed: a node failed; it has the outputs that did not need it.
        """
        for hook in self._hooks.run_started:
            hook(self._request)
        try:
            for ref in self._request.targets.values():
                self._task(ref.slot)
            self._demand()
            if self._threads == 1:
                self._loop_inline()
            else:
                self._loop_threads()
        finally:
            for hook in self._hooks.run_finished:
                hook(self._records)
        values = {}
        for name, ref in self._request.targets.items():
            key = self._keys[ref.slot]
            if key in self._values:
                values[name] = take(self._values[key], ref.fields)
        if self._failures:
            raise RunFailed(self._failures, values, self._records)
        return values, self._records

    # --- demand -----------------------------------------------------------------------------------

    def _task(self, slot: int) -> Task:
        """The task of a slot's key, demanded now if it was not before."""
        key = self._keys[slot]
        task = self._tasks.get(key)
        if task is None:
            first = self._first
            task = self._tasks[key] = Task(key, slot, self._steps[slot - first] if slot >= first else None)
            self._demanded.append(task)
        return task

    def _demand(self) -> None:
        """Look up everything newly demanded, or demand what it needs."""
        find, newest = self._tiers.find, self._demanded
        while newest:
            task = newest.pop()
            step = task.step
            value, tier = find(task.key, step)
            if value is not MISSING:
                self._values[task.key] = value
                task.heavy = True
                self._tell(Record(self._names[task.slot], label(task, self._first), tier, task.key), step, value)
                self._arrived(task)
            elif step is None:
                self._ready.append(task)
            else:
                task.declined = declined = self._request.declined(step) if step.lazy else _NOTHING
                if declined is None:
                    self._undecided += 1
                elif declined:
                    self._tell_declined(task, step)
                self._await(task, demanded(step, declined)[0])
        if self._spent and not self._undecided:
            self._let_go()

    def _await(self, task: Task, slots: Iterable[int]) -> None:
        """Make a task ready, or ask its rule, once every one of these slots has its value."""
        tasks, keys, values = self._tasks, self._keys, self._values
        missing = 0
        for slot in slots:
            source = tasks.get(keys[slot]) or self._task(slot)
            if source.failed:
                self._stop(task, "blocked")
                return
            source.readers += 1
            task.sources.append(source)
            if source.key not in values:
                source.waiters.append(task)
                missing += 1
        task.waiting = missing
        if not missing:
            self._proceed(task)

    def _arrived(self, task: Task) -> None:
        """A value is there: tell the tasks that wait for it."""
        for waiter in task.waiters:
            waiter.waiting -= 1
            if not waiter.waiting:
                self._proceed(waiter)
        task.waiters.clear()

    def _proceed(self, task: Task) -> None:
        """Everything a task waited for is there. Runs only what has not failed meanwhile."""
        if task.failed:
            return
        if task.declined is None and task.step is not None:
            self._decide(task, task.step)
        else:
            self._ready.append(task)

    def _decide(self, task: Task, step: Step) -> None:
        """All eager inputs are there: ask the rule which lazy ones are wanted."""
        try:
            eager = {a.port: self._caller.argument(a) for a in step.arguments if not a.lazy}
            with python_warnings():
                task.declined = declined_with(step, eager)
        except Exception as error:
            self._fail(task, self._caller.error(step, error, {}))
            return
        self._undecided -= 1
        self._tell_declined(task, step)
        wanted, _ = demanded(step, task.declined)
        self._await(task, (slot for slot in wanted if slot not in step.eager))

    # --- loops ------------------------------------------------------------------------------------

    def _loop_inline(self) -> None:
        ready, evaluate = self._ready, self._caller.evaluate
        with collected_warnings():
            while ready:
                task = ready.pop()
                self._finish(task, evaluate(task.slot, task.step, task.declined))

    def _loop_threads(self) -> None:
        finished: queue.SimpleQueue[tuple[Task, Outcome]] = queue.SimpleQueue()
        running = 0

        def work(task: Task) -> None:
            finished.put((task, self._caller.evaluate(task.slot, task.step, task.declined)))

        with ThreadPoolExecutor(self._threads, "graphface", collect_warnings) as pool:
            while self._ready or running:
                while self._ready and running < (self._threads if self._live <= self._in_flight else 1):
                    pool.submit(work, self._ready.pop())
                    running += 1
                task, outcome = finished.get()
                running -= 1
                self._finish(task, outcome)

    # --- bookkeeping, on the calling thread -------------------------------------------------------

    def _finish(self, task: Task, outcome: Outcome) -> None:
        value, error, seconds, cpu, warnings = outcome
        if error is not None:
            if not isinstance(error, NodeError):
                raise error
            self._fail(task, error, seconds)
            return
        key, step = task.key, task.step
        self._values[key] = value
        arrays: tuple[Any, ...] = ()
        if type(value) is not float:
            arrays = freeze(value)
            if arrays:
                task.heavy = True
                task.size = sum([a.nbytes for a in arrays])
                self._live += task.size
        self._tiers.keep(key, step, value, seconds, arrays)
        name, operator = self._names[task.slot], label(task, self._first)
        self._tell(Record(name, operator, "ran", key, seconds, cpu, task.size, "", warnings), step, value)
        self._arrived(task)
        for source in task.sources:
            source.readers -= 1
            if source.heavy and not source.readers:
                self._spent.append(source)
        if self._demanded or (self._spent and not self._undecided):
            self._demand()

    def _let_go(self) -> None:
        """Drop arrays that no task of this run reads any more, once no rule can ask for them again."""
        for task in self._spent:
            if not task.readers and task.key not in self._kept and self._tasks.get(task.key) is task:
                del self._tasks[task.key]
                del self._values[task.key]
                self._live -= task.size
        self._spent.clear()

    def _fail(self, task: Task, error: NodeError, seconds: float = 0.0) -> None:
        self._failures.append(error)
        self._stop(task, "failed", error.reason, seconds)

    def _stop(self, task: Task, state: State, reason: str = "", seconds: float = 0.0) -> None:
        """Note that a task has no value, and that those waiting for it never will."""
        stack = [(task, state, reason, seconds)]
        while stack:
            current, now, why, took = stack.pop()
            if current.failed:
                continue
            current.failed = True
            step = current.step
            if current.declined is None and step is not None:
                self._undecided -= 1
            name = self._names[current.slot]
            self._tell(Record(name, label(current, self._first), now, current.key, took, reason=why), step)
            stack.extend((waiter, "blocked", "", 0.0) for waiter in current.waiters)
            current.waiters.clear()

    def _tell_declined(self, task: Task, step: Step) -> None:
        for port, reason in (task.declined or {}).items():
            name = f"{step.name}.{port}"
            self._tell(Record(name, step.operator.name, "declined", task.key, reason=reason), step)

    def _tell(self, record: Record, step: Step | None, value: Any = None) -> None:
        self._records.append(record)
        for hook in self._on_finish:
            hook(record, step, value)
