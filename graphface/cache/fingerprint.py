"""`fingerprint`: one digest for everything an operator's result depends on in the code.

A memoized result is wrong as soon as any helper changes, in whatever module, so the digest covers the function and all
code of its own distribution that it reaches: functions through the global names they read (`helper`, `sh.render`),
classes with their methods, module-level constants, decorators, closures, imports inside functions. The walk
(`graphface.cache.walk`) reads live objects, since these are what will run; only imports inside functions are read from
source (`graphface.cache.late_imports`). Packages released by others count by name and version
(`graphface.cache.territory`).

A class brings all of its methods but those that the engine calls at the edges of a graph (`from_file`, `picture` ...):
how a photo is decoded is no part of every operator that touches an `Image`. They count where an operator names them.

A path into the operator's own package counts by its place there, with the content of the file it names
(`graphface.cache.beside`): two environments share results, an edited data file invalidates them.

Known limits: what is reached only through strings (`getattr(module, name)`) counts only where the module is named,
and then as a whole; a data file counts where a constant names it, not where the body of a function spells its path; a
container changed in place is seen by the next walk, not by `stale`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from types import FunctionType
from typing import Any

from graphface.cache.ledger import MISSING, Ledger, modified
from graphface.cache.territory import Territory
from graphface.cache.walk import walk


class Fingerprint:
    """The digest of some functions' code, and whether it still holds.

    Attributes:
        digest: 16 bytes, the same in every process of one Python version.
        reached: what was included, in the order of the walk: "module.name", "numpy 2.4.6".
    """

    __slots__ = ("_code", "_files", "_names", "digest", "reached")

    def __init__(
        self,
        digest: bytes,
        reached: tuple[str, ...],
        names: Iterable[tuple[Any, str, Any]],
        code: Iterable[tuple[FunctionType, Any, Any]],
        files: Iterable[tuple[str, int]],
    ) -> None:
        self.digest = digest
        self.reached = reached
        self._names = tuple(names)
        self._code = tuple(code)
        self._files = tuple(files)

    def __repr__(self) -> str:
        return f"Fingerprint({self.digest.hex()[:12]}, {len(self.reached)} reached)"

    def stale(self) -> bool:
        """Whether any name now means another object, or any function got other code: then walk again.

        Costs some 30 ns a name. True does not say that the digest has changed.
        """
        for namespace, name, value in self._names:
            if namespace.get(name, MISSING) is not value:
                return True
        for function, code, defaults in self._code:
            if function.__code__ is not code or function.__defaults__ is not defaults:
                return True
        return any(modified(path) != before for path, before in self._files)


def fingerprint(*functions: Callable[..., Any] | None) -> Fingerprint:
    """The fingerprint of `functions` together (an operator and its `needs` rule); None among them is skipped."""
    roots = [function for function in functions if function is not None]
    ledger = Ledger(Territory([getattr(f, "__module__", None) or "builtins" for f in roots]))
    walk(roots, ledger)
    names, code, files = ledger.names.values(), ledger.code, ledger.files.items()
    return Fingerprint(ledger.state.digest(), tuple(ledger.reached), names, code, files)
