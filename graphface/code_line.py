"""The line of somebody's code where an error arose: what the author of an operator wants to see first.

A traceback through an operator begins in the engine and may end in a library that the operator called. The deepest
frame in the operator's own files is the line to show.
"""

from __future__ import annotations

import importlib
import inspect
import os.path
import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

ENGINE = "graphface"
_IMPORTLIB = os.path.dirname(importlib.__file__)
_LONGEST = 160


@dataclass(frozen=True)
class CodeLine:
    """A line of Python: its file, its number from 1, the function that it is in, and its text."""

    file: str
    line: int
    function: str
    text: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}, in {self.function}\n    {self.text}"


def own_line(error: BaseException, function: Callable[..., Any]) -> CodeLine | None:
    """The deepest line of a traceback in the files of a function's own distribution; None where it has none there."""
    return _deepest(error, _own_files(function))


def line_of_import(error: BaseException) -> CodeLine | None:
    """The line that made an import fail; None where what was to be imported does not exist."""
    if isinstance(error, SyntaxError):
        return _line(error.filename or "", error.lineno or 0, "<module>")
    engine = os.path.dirname(__file__)
    return _deepest(error, lambda file: not file.startswith(("<frozen", _IMPORTLIB, engine)))


def declaration_line(function: Callable[..., Any]) -> CodeLine | None:
    """Where a function is defined; None where it is not written in Python."""
    code = getattr(inspect.unwrap(function), "__code__", None)
    return _line(code.co_filename, code.co_firstlineno, code.co_name) if code is not None else None


def _deepest(error: BaseException, within: Callable[[str], bool]) -> CodeLine | None:
    found = None
    trace = error.__traceback__
    while trace is not None:
        code = trace.tb_frame.f_code
        if within(code.co_filename):
            found = (code.co_filename, trace.tb_lineno, code.co_name)
        trace = trace.tb_next
    return _line(*found) if found is not None else None


def _own_files(function: Callable[..., Any]) -> Callable[[str], bool]:
    """Whether a file belongs to the same distribution: the same outermost package, or the same file without one.

    The engine's package counts as a namespace, for the operators that are installed in it; so does one without a file.
    """
    parts = function.__module__.split(".")
    for count in range(1, len(parts) + 1):
        package = sys.modules.get(".".join(parts[:count]))
        file = getattr(package, "__file__", None)
        if count == len(parts) and not hasattr(package, "__path__"):
            break
        if file is not None and parts[:count] != [ENGINE]:
            folder = os.path.dirname(file) + os.sep
            return lambda name: name.startswith(folder)
    own = declaration_line(function)
    return lambda name: own is not None and name == own.file


def _line(file: str, line: int, function: str) -> CodeLine:
    import linecache

    text = "".join(c if c.isprintable() else " " for c in linecache.getline(file, line).strip())
    return CodeLine(file, line, function, text[:_LONGEST])
