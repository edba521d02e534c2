"""pdb inside an operator, with its real arguments."""

from __future__ import annotations

import bdb
import pdb
import sys
from collections.abc import Callable, Mapping
from typing import Any

from graphface.evaluate.calling import reason_of
from graphface.fallback import python_warnings
from graphface.values.frozen import describe


def step_through(function: Callable[..., Any], given: Mapping[str, Any]) -> None:
    """Call a function under pdb, from its first line; where it raises, pdb goes on at the line that did.

    What it gives is printed and not kept: it is a pure function, and the run has its own call of it.
    """
    traced = sys.gettrace()
    try:
        with python_warnings():
            value = _debugger().runcall(function, **given)
    except bdb.BdbQuit:
        return
    except Exception as error:
        print(f"it raised {reason_of(error)}")
        _after(error)
        return
    finally:
        sys.settrace(traced)  # pdb leaves none behind: a debugger or a measurement of coverage around it goes on
    print(f"it gave {describe(value)}")


def _after(error: Exception) -> None:
    """pdb at the line that raised."""
    debugger = _debugger()
    debugger.reset()
    try:
        debugger.interaction(None, error.__traceback__)
    except bdb.BdbQuit:
        return


def _debugger() -> pdb.Pdb:
    """Commands come from the terminal, or from whatever is standard input."""
    return pdb.Pdb() if sys.stdin.isatty() else pdb.Pdb(stdin=sys.stdin, stdout=sys.stdout)
