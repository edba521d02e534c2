"""Calling one node: its arguments from values that are there, its output checked, its failure explained.

Safe on any thread: what is read here is written by the thread that keeps the books, never while a node that needs
it is being called.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from graphface import fallback
from graphface.errors import GraphfaceError, InputError, NodeError, NonFiniteError
from graphface.evaluate.observe import hooks
from graphface.graph.wiring import Argument, Ref, Step
from graphface.values.frozen import describe, first_non_finite

if TYPE_CHECKING:
    from graphface.evaluate.evaluator import Evaluator
    from graphface.graph.graph import Graph
    from graphface.graph.inputs import Bound

Outcome = tuple[Any, BaseException | None, float, float, list[str]]
"""Value, error, wall seconds, seconds of CPU (measured where an observer listens), warnings."""


class Caller:
    """Evaluates slots of one run.

    Args:
        keys: by slot. done: values by key. declined: lazy ports that a step declined, by its key.
    """

    def __init__(
        self,
        evaluator: Evaluator,
        graph: Graph,
        bound: Sequence[Bound | None],
        keys: Sequence[bytes],
        done: Mapping[bytes, Any],
        declined: Mapping[bytes, frozenset[str]],
    ) -> None:
        self._evaluator = evaluator
        self._graph = graph
        self._first = len(graph.inputs)
        self._bound = bound
        self._keys = keys
        self._done = done
        self._declined = declined
        self._on_start = hooks(evaluator.observers, "node_started")
        self._observed = bool(evaluator.observers)

    def evaluate(self, slot: int) -> Outcome:
        """Call one step or load one input. Raises nothing: a worker that ended silently would leave the run waiting."""
        step = self._graph.steps[slot - self._first] if slot >= self._first else None
        said: list[str] = []
        token = fallback.collector.set(said)
        value, error = None, None
        cpu = time.thread_time() if self._observed else 0.0
        start = time.perf_counter()
        try:
            for hook in self._on_start:
                hook(step.name if step is not None else self._graph.input_names[slot], step)
            value = self._load(slot) if step is None else self._call(step)
        except BaseException as caught:
            error = caught
        seconds = time.perf_counter() - start
        if self._observed:
            cpu = time.thread_time() - cpu
        fallback.collector.reset(token)
        return value, error, seconds, cpu, said

    def _load(self, slot: int) -> Any:
        bound, name = self._bound[slot], self._graph.input_names[slot]
        if bound is None:
            raise InputError(name, f"this input ({self._graph.inputs[name].type}) is needed and was not given")
        try:
            return bound.value
        except GraphfaceError:
            raise
        except Exception as error:
            raise InputError(name, f"{bound.origin} cannot be read: {type(error).__name__}: {error}") from error

    def _call(self, step: Step) -> Any:
        if step.plain is not None:
            done, keys = self._done, self._keys
            arguments = {port: done[keys[slot]] for port, slot in step.plain}
        else:
            declined = self._declined.get(self._keys[step.slot], ())
            plugged = {a.port: None if a.port in declined else self.argument(a) for a in step.arguments}
            arguments = {**step.absent, **plugged}
        try:
            value = step.operator.function(**arguments, **step.parameters)
        except Exception as error:
            raise self.error(step, error, arguments) from error
        if type(value) not in step.operator.plain_outputs:
            problem = step.operator.output.problem(value)
            if problem is not None:
                raise self.error(step, TypeError(f"returned something else: {problem}"), arguments)
        if self._evaluator.guard != "off":
            found = first_non_finite(value, self._evaluator.finite)
            if found is not None:
                self._not_finite(step, found, arguments)
        return value

    def argument(self, argument: Argument) -> Any:
        """What is plugged into a port: a value, or a list of them."""
        done, keys = self._done, self._keys
        if argument.is_list:
            return [take(done[keys[r.slot]], r.fields) for r in argument.refs]
        ref = argument.refs[0]
        value = done[keys[ref.slot]]
        return take(value, ref.fields) if ref.fields else value

    def _not_finite(self, step: Step, found: str, arguments: Mapping[str, Any]) -> None:
        if self._evaluator.guard == "warn":
            fallback.warn(f"its output {found}")
            return
        shown = {port: describe(value) for port, value in arguments.items()}
        raise NonFiniteError(
            step.name, step.operator.name, step.place, f"its output {found}", shown, self._files_behind(step)
        )

    def error(self, step: Step, error: Exception, arguments: Mapping[str, Any]) -> NodeError:
        """A failure with everything that helps to find its cause."""
        reason = str(error) if isinstance(error, GraphfaceError) else f"{type(error).__name__}: {error}"
        shown = {port: describe(value) for port, value in arguments.items()}
        failure = NodeError(step.name, step.operator.name, step.place, reason, shown, self._files_behind(step))
        failure.__cause__ = error
        return failure

    def _files_behind(self, step: Step) -> list[str]:
        """The files given for the graph inputs that a step depends on."""
        inputs = (self._bound[slot] for slot in self._graph.behind([Ref(step.slot)]) if slot < self._first)
        return [bound.origin for bound in inputs if bound is not None and bound.is_file]


def take(value: Any, fields: Sequence[str]) -> Any:
    """`value.field.field...`; None where one on the way is None, as the type of such a reference says."""
    for name in fields:
        if value is None:
            return None
        value = getattr(value, name)
    return value
