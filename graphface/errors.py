"""What can go wrong, whose mistake it is, and where it is.

Every error carries its parts (path, line, node, expected ...) as attributes and builds its sentence from them, so that
a test or an editor need not read the sentence. Two families matter to the command line: `UsageError` means that what
was asked cannot be done (exit code 2), `RunError` that doing it failed (exit code 1).
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from graphface.code_line import CodeLine
from graphface.place import Place
from graphface.record import Record


class GraphfaceError(Exception):
    """Base of all errors that speak to the user."""


class UsageError(GraphfaceError):
    """The request is wrong: a file, a name, an option. Nothing was run."""


class RunError(GraphfaceError):
    """The request was understood and failed on the way."""


class PluginError(UsageError):
    """A plug-in file could not be used."""

    def __init__(self, message: str, path: Path) -> None:
        super().__init__(message)
        self.path = path


@dataclass(frozen=True)
class WrongArgument:
    """One argument of an operator that is declared wrongly ("return" for its output), and what to write instead."""

    name: str
    reason: str

    def __str__(self) -> str:
        what = "output" if self.name == "return" else f"argument {self.name!r}"
        return f"{what}: {self.reason}" if self.name else self.reason


class DeclarationError(UsageError, TypeError):
    """A function cannot be an operator as its signature is.

    Attributes:
        operator: its name. file, line: where it is declared. wrong: every argument that has to be changed.
    """

    def __init__(self, operator: str, file: str, line: int, wrong: Sequence[WrongArgument]) -> None:
        self.operator = operator
        self.file = file
        self.line = line
        self.wrong: list[WrongArgument] = list(wrong)
        told = "; ".join(str(argument) for argument in self.wrong)
        super().__init__(f"{file}:{line}: operator {operator!r}: {told}")


class UnknownName(UsageError, LookupError):
    """A name that means nothing; `nearest` are the likely ones meant."""

    kind = "name"

    def __init__(self, name: str, known: Iterable[str]) -> None:
        self.name = name
        self.known: list[str] = sorted(known)
        self.nearest: list[str] = nearest_names(name, self.known)
        super().__init__(f"unknown {self.kind} {name!r}{did_you_mean(self.nearest)}")

    def __str__(self) -> str:
        return str(self.args[0])


class UnknownOperator(UnknownName):
    """No such operator; `reason` is the sentence without the nearest names.

    Args:
        why: what is known about its absence: its module is broken, say.
    """

    kind = "operator"

    def __init__(self, name: str, known: Iterable[str], why: str = "") -> None:
        super().__init__(name, known)
        self.reason: str = f"unknown operator {name!r}{f': {why}' if why else ''}"
        self.args: tuple[str, ...] = (f"{self.reason}{did_you_mean(self.nearest)}",)


class UnknownType(UnknownName):
    kind = "type"


@dataclass(frozen=True)
class Problem:
    """One thing wrong with a file or a flag: what, where, and the names that may have been meant."""

    message: str
    place: Place | None = None
    nearest: tuple[str, ...] = ()

    def __str__(self) -> str:
        text = f"{self.message}{did_you_mean(list(self.nearest))}"
        if self.place is None:
            return text
        return f"{self.place}: {text}\n{self.place.excerpt}".rstrip()


class DocumentError(UsageError):
    """A graph, or another file that people write, is wrong; `problems` has every mistake found, not only the first."""

    def __init__(self, problems: Sequence[Problem]) -> None:
        self.problems: list[Problem] = list(problems)
        super().__init__("\n".join(str(p) for p in self.problems))


class InputError(UsageError):
    """What was given for a graph input, or asked of its outputs, does not fit."""

    def __init__(self, name: str, reason: str, nearest: Sequence[str] = ()) -> None:
        self.name = name
        self.reason = reason
        self.nearest: list[str] = list(nearest)
        super().__init__(f"{name!r}: {reason}{did_you_mean(self.nearest)}")


class NodeError(RunError):
    """A node failed; the original exception is the cause.

    Attributes:
        node, operator: their names. place: where the graph file states the node.
        inputs: port to a short description of the value it got (shape, dtype, range).
        files: the files given for graph inputs that it depends on.
        code: the line of the operator's own code where it failed; None where that is not known.
    """

    def __init__(
        self,
        node: str,
        operator: str,
        place: Place | None,
        reason: str,
        inputs: dict[str, str],
        files: Sequence[str] = (),
        code: CodeLine | None = None,
    ) -> None:
        self.node = node
        self.operator = operator
        self.place = place
        self.reason = reason
        self.inputs = inputs
        self.files: list[str] = list(files)
        self.code = code
        where = f"{place}: " if place is not None else ""
        lines = [f"{where}node {node!r} ({operator}) failed: {reason}"]
        lines += [f"    {line}" for line in str(code).splitlines()] if code is not None else []
        lines += [f"    {port}: {shown}" for port, shown in inputs.items()]
        lines += [f"    from {', '.join(self.files)}"] if self.files else []
        super().__init__("\n".join(lines))


class NonFiniteError(NodeError):
    """A node gave NaN or infinity."""


class RunFailed(RunError):
    """One or more nodes failed; `failures` has each, `finished` the values of outputs that did not need them.

    `records` says what became of every node. The cause is the original exception of the first failure.
    """

    def __init__(
        self, failures: Sequence[NodeError], finished: dict[str, object], records: Sequence[Record] = ()
    ) -> None:
        self.failures: list[NodeError] = list(failures)
        self.finished = finished
        self.records: list[Record] = list(records)
        super().__init__("\n".join(str(f) for f in self.failures))
        self.__cause__: BaseException | None = self.failures[0].__cause__ if self.failures else None


class UnreadableFile(UsageError):
    """A file given as input cannot be read as what it should be."""

    def __init__(self, path: Path | str, reason: str) -> None:
        super().__init__(f"{path}: {reason}")
        self.path: Path = Path(path)
        self.reason = reason


class UnwritableFile(RunError):
    """A result could not be written."""

    def __init__(self, path: Path | str, reason: str) -> None:
        super().__init__(f"{path}: {reason}")
        self.path: Path = Path(path)
        self.reason = reason


class RefusedOutput(UnwritableFile, UsageError):
    """As `UnwritableFile`, and seen before anything was run: a missing folder, a suffix that no writer knows."""


def out_of_memory(error: Exception) -> str:
    """What is told of an allocation that failed."""
    wanted = f" ({error})" if str(error) else ""
    return f"out of memory{wanted}; a smaller picture takes less, and so does --threads 1"


def nearest_names(name: str, known: Iterable[str], count: int = 3) -> list[str]:
    """The known names most like `name`, best first; the same word behind another prefix ("face/light") is nearest."""
    candidates = list(known)
    tail = re.split(r"[./]", name)[-1]
    same_tail = [c for c in candidates if re.split(r"[./]", c)[-1] == tail]
    close = difflib.get_close_matches(name, candidates, count, cutoff=0.6)
    return [*dict.fromkeys(same_tail + close)][:count]


def did_you_mean(names: list[str]) -> str:
    return f"; did you mean {' or '.join(repr(n) for n in names)}?" if names else ""
