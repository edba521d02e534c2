"""`fingerprint`: one digest for everything an operator's result depends on in the code.

A memoized result is wrong as soon as any helper changes, so the digest covers, transitively, the modules of its own
distribution that the operator's module imports, at the top or inside functions: their syntax, without comments,
docstrings and layout, and the data files they name. Released packages count by name and version. Whole modules and not
only the functions reached, since that takes no interpreting of bytecode, is the same on every Python, and is as fine as
the modules are small.

What is not in any file (a notebook's cell, a function patched in, a file edited after it was loaded) counts as it is in
memory: `graphface.fingerprint.loaded` finds it, `graphface.fingerprint.walk` describes it.

Known limits: a module imported by a computed name (`importlib.import_module(name)`) is not seen, nor is a data file of
a computed name. A container changed in place is seen by the next fingerprint, not by `stale`. A counter that is a
module's global counts as a constant replaced at run time.
"""

from __future__ import annotations

from collections.abc import Callable
from threading import RLock
from typing import Any

from graphface.fingerprint.loaded import Watch
from graphface.fingerprint.walk import Walk

RESULT_FORMAT = 2
"""What the engine does to results: how arguments are passed, values coerced, frozen, stored and keyed.

The engine's code is in no fingerprint; raising this number makes all memoized results new. A test says when."""


class Fingerprint:
    """The digest of some functions' code, and whether it still holds.

    Attributes:
        digest: 16 bytes, the same in every process and on every Python, but for code that stands in no file.
        reached: what counts, sorted: modules, packages as "numpy 2.4.6", functions and classes that stand in no file.
        watched: what is looked at to tell whether the digest holds; fingerprints share those of their modules.
    """

    __slots__ = ("digest", "reached", "watched")

    def __init__(self, digest: bytes, reached: tuple[str, ...], watched: tuple[Watch, ...]) -> None:
        self.digest: bytes = digest
        self.reached: tuple[str, ...] = reached
        self.watched: tuple[Watch, ...] = watched

    def __repr__(self) -> str:
        return f"Fingerprint({self.digest.hex()[:12]}, {len(self.reached)} reached)"

    def stale(self) -> bool:
        """Whether any name, function or file is another: then take it again, the digest may be what it was."""
        return any(watch.changed() for watch in self.watched)


def fingerprint(*functions: Callable[..., Any] | None) -> Fingerprint:
    """The fingerprint of `functions` together (an operator and its `needs` rule); None among them is skipped."""
    with _one_at_a_time:
        walk = Walk([function for function in functions if function is not None], RESULT_FORMAT)
    return Fingerprint(walk.digest, tuple(sorted(walk.reached)), tuple(walk.watched))


_one_at_a_time = RLock()
"""What modules say is kept for all threads, and Python 3.11 may fail where two of them parse deep code at once."""
