"""Calling one node: its arguments from values that are there, its output checked, its failure explained.

Safe on any thread: what is read here is written by the thread that keeps the books, never while a node that needs
it is being called.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, MutableMapping
from math import isfinite
from typing import Any, Literal

from graphface import fallback
from graphface.code_line import declaration_line, own_line
from graphface.errors import GraphfaceError, InputError, NodeError, NonFiniteError, out_of_memory
from graphface.evaluate.observe import Hooks
from graphface.graph.demand import take
from graphface.graph.keys import Declined
from graphface.graph.request import Request
from graphface.graph.structure import Argument, Ref, Step
from graphface.values.frozen import describe, first_non_finite

Guard = Literal["off", "warn", "error"]

Outcome = tuple[Any, BaseException | None, float, float, tuple[str, ...]]
"""Value, error, wall seconds, seconds of CPU (measured where an observer listens), warnings."""


class Caller:
    """Evaluates slots of one request.

    Args:
        values: by key; the run puts them there.
        guard: what to do about NaN and infinity in a node's output.
        finite: arrays found finite before, by id; shared by the runs of an evaluator.
    """

    def __init__(
        self,
        request: Request,
        values: Mapping[bytes, Any],
        guard: Guard,
        finite: MutableMapping[int, Any],
        hooks: Hooks,
    ) -> None:
        self._request = request
        self._graph = request.graph
        self._values = values
        self._keys = request.keys.by_slot
        self._guard = guard
        self._finite = finite
        self._on_start = hooks.node_started
        self._on_call = hooks.node_called
        self._paused: dict[int, float] = {}
        self._observed = hooks.any

    def evaluate(self, slot: int, step: Step | None, declined: Declined | None) -> Outcome:
        """Call one step or load one input, on a thread that collects warnings.

        Raises nothing: a worker that ended silently would leave the run waiting.
        """
        value: Any = None
        error: BaseException | None = None
        cpu = time.thread_time() if self._observed else 0.0
        start = time.perf_counter()
        try:
            for hook in self._on_start:
                hook(self._graph.names[slot], step)
            value = self._load(slot) if step is None else self._call(step, declined)
        except MemoryError as caught:  # while what a node returned was looked at
            error = self.error(step, caught, {}) if step is not None else caught
        except BaseException as caught:
            error = caught
        seconds = time.perf_counter() - start
        if self._observed:
            cpu = time.thread_time() - cpu
            seconds -= self._paused.pop(slot, 0.0)
        return value, error, seconds, cpu, fallback.taken_warnings()

    def argument(self, argument: Argument) -> Any:
        """What is plugged into a port: a value, or a list of them."""
        values, keys = self._values, self._keys
        if argument.is_list:
            return [take(values[keys[r.slot]], r.fields) for r in argument.refs]
        ref = argument.refs[0]
        value = values[keys[ref.slot]]
        return take(value, ref.fields) if ref.fields else value

    def error(self, step: Step, error: Exception, arguments: Mapping[str, Any]) -> NodeError:
        """A failure with everything that helps to find its cause."""
        reason = reason_of(error)
        shown = {port: describe(value) for port, value in arguments.items()}
        function = step.operator.function
        code = declaration_line(function) if error.__traceback__ is None else own_line(error, function)
        failure = NodeError(step.name, step.operator.name, step.place, reason, shown, self._files_behind(step), code)
        failure.__cause__ = error
        return failure

    def _load(self, slot: int) -> Any:
        bound, name = self._request.given(slot), self._graph.names[slot]
        if bound is None:
            raise InputError(name, f"this input ({self._graph.inputs[name].type}) is needed and was not given")
        try:
            return bound.value
        except GraphfaceError:
            raise
        except Exception as error:
            raise InputError(name, f"{bound.origin} cannot be read: {reason_of(error)}") from error

    def _call(self, step: Step, declined: Declined | None) -> Any:
        if step.plain is not None:
            values, keys = self._values, self._keys
            arguments = {port: values[keys[slot]] for port, slot in step.plain}
        else:
            plugged = {a.port: None if declined and a.port in declined else self.argument(a) for a in step.arguments}
            arguments = {**step.absent, **plugged}
        if self._on_call:
            self._tell_called(step, arguments)
        operator = step.operator
        try:
            given = {**arguments, **step.parameters} if step.parameters else arguments
            value = operator.function(**given)
        except Exception as error:
            raise self.error(step, error, arguments) from error
        if type(value) not in operator.plain_outputs:
            problem = operator.output.problem(value)
            if problem is not None:
                raise self.error(step, TypeError(f"returned something else: {problem}"), arguments)
        if self._guard != "off" and not (type(value) is float and isfinite(value)):
            found = first_non_finite(value, self._finite)
            if found is not None:
                self._not_finite(step, found, arguments)
        return value

    def _tell_called(self, step: Step, arguments: Mapping[str, Any]) -> None:
        start = time.perf_counter()
        for hook in self._on_call:
            hook(step.name, step, arguments)
        self._paused[step.slot] = time.perf_counter() - start

    def _not_finite(self, step: Step, found: str, arguments: Mapping[str, Any]) -> None:
        if self._guard == "warn":
            fallback.warn(f"its output {found}")
            return
        shown = {port: describe(value) for port, value in arguments.items()}
        raise NonFiniteError(
            step.name, step.operator.name, step.place, f"its output {found}", shown, self._files_behind(step)
        )

    def _files_behind(self, step: Step) -> list[str]:
        """The files given for the inputs and pinned nodes that a step depends on."""
        given = (self._request.given(slot) for slot in self._request.behind([Ref(step.slot)]))
        return [one.origin for one in given if one is not None and one.is_file]


def reason_of(error: Exception) -> str:
    """What a failed node says: the sentence of an error that speaks to the user, else the kind of the error too."""
    if isinstance(error, MemoryError) or "Insufficient memory" in str(error):  # what OpenCV says of it
        return out_of_memory(error)
    return str(error) if isinstance(error, GraphfaceError) else f"{type(error).__name__}: {error}"
