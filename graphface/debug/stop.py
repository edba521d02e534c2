"""What a breakpoint hands over: a run that stands at a node.

A value is replaced by ending the run and running a request in which it is pinned (`graphface.graph.pinning`) on the
same evaluator. With a memory tier nothing is computed twice, and no cache ever takes the replaced value for the node's
own. Changing the value in place was rejected: it would be kept under the key of what the node gave.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, NoReturn

from graphface.errors import InputError
from graphface.evaluate.observe import StopRun
from graphface.graph.request import Request, changed
from graphface.graph.structure import Step

At = Literal["before", "after"]


@dataclass(eq=False)
class Stop:
    """A run that stands at a node.

    Attributes:
        request: what is being run. step: the node.
        arguments: the values of its ports; None where it did not run, since its value was memoized.
        value: what it gave; None before it ran, and where it failed for the reason `error`.
        steps: set to True to stop again before the next node that runs, whichever it is.
    """

    request: Request
    step: Step
    at: At
    arguments: Mapping[str, Any] | None
    value: Any = None
    error: str = ""
    steps: bool = field(default=False, init=False)

    @property
    def name(self) -> str:
        return self.step.name

    def replace(self, value: Any, name: str = "") -> NoReturn:
        """Go on with another value, or one read from a file, as if a node had given it.

        Args:
            name: a port of this node, for what is plugged into it, or any node or input; by default this node.

        Raises:
            InputError, UnreadableFile: there is no such name, or the value does not fit; the run still stands.
            StopRun: else, to whoever runs: do not catch it.
        """
        source = self.source(name) if name else self.name
        raise StopRun(f"{source} is replaced", changed(self.request, source, value))

    def quit(self) -> NoReturn:
        """End the run: `StopRun` leaves it."""
        raise StopRun(f"stopped {self.at} node {self.name!r}; no output was written")

    def source(self, name: str) -> str:
        """The node or input that is plugged into a port; another name as it is.

        Raises:
            InputError: several are plugged in, or a field of one, or nothing.
        """
        graph = self.request.graph
        plugged = next((a for a in self.step.arguments if a.port == name), None)
        if plugged is None and name in self.step.operator.inputs:
            raise InputError(name, "nothing is plugged into this port")
        if plugged is None:
            return name
        if len(plugged.refs) != 1:
            raise InputError(name, f"takes several; name one of {', '.join(graph.names[r.slot] for r in plugged.refs)}")
        ref = plugged.refs[0]
        if ref.fields:
            where = ".".join((graph.names[ref.slot], *ref.fields))
            raise InputError(name, f"takes {where}; only the whole of {graph.names[ref.slot]!r} can be replaced")
        return graph.names[ref.slot]
