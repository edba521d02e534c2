"""Imports inside functions: what they bring counts by source, so that nothing is imported only to be fingerprinted.

`graphface.cache.source` says why, and cuts a module down to what the imported names need.
"""

from __future__ import annotations

import sys
from collections import deque
from pathlib import Path
from types import ModuleType
from typing import Any

from graphface.cache.beside import content
from graphface.cache.bytecode import Import
from graphface.cache.ledger import Ledger, modified
from graphface.cache.source import Source, absolute, drifted, locate


class LateImports:
    """The modules that one walk found imported inside functions."""

    def __init__(self, ledger: Ledger) -> None:
        self._ledger = ledger
        self._pending: deque[tuple[str, str | None]] = deque()
        self._slices: dict[tuple[str, str | None], bytes] = {}

    def add(self, statement: Import, package: str) -> None:
        """An import inside a function: names from the module, or the whole module; each name may be a module itself."""
        module = absolute(statement, package)
        self._ledger.write("import", module)
        if self._ledger.foreign(module) and not self._holds_ours(module, statement):
            return
        for name in statement.names or (None,):
            inner = f"{module}.{name}"
            if name is not None and not self._ledger.foreign(inner) and locate(inner) is not None:
                self._pending.append((inner, None))
            elif self._ledger.territory.foreign(module) is None:
                self._pending.append((module, None if name == "*" else name))

    def read(self) -> bool:
        """Read everything that is pending, and what it imports; False where there was nothing."""
        found = bool(self._pending)
        while self._pending:
            self._read_source(*self._pending.popleft())
        return found

    def write(self) -> None:
        """Write the digests of all that was read, in an order that does not depend on when it was reached."""
        for (module, name), digest in sorted(self._slices.items(), key=lambda item: (item[0][0], item[0][1] or "")):
            self._ledger.write("source", f"{module} {name}")
            self._ledger.state.update(digest)

    def _holds_ours(self, module: str, statement: Import) -> bool:
        """`from graphface import nodes`: the package is not ours, what is imported from it is."""
        return any(self._ledger.territory.foreign(f"{module}.{name}") is None for name in statement.names or ())

    def _read_source(self, module: str, name: str | None) -> None:
        if (module, name) in self._slices:
            return
        loaded = sys.modules.get(module)
        path = locate(module)
        self._ledger.reach(f"{module}.{name}" if name else module)
        if loaded is None:
            self._ledger.look(sys.modules, module)
            if path is not None:
                self._ledger.watch(str(path))
        source = _source(path, loaded) if path is not None else None
        if source is None:
            self._slices[module, name] = b"no source"
            return
        cut = source.slice(name)
        self._slices[module, name] = cut.digest + b"".join(content(file) for file in cut.files)
        package = module if path is not None and path.name == "__init__.py" else module.rpartition(".")[0]
        for statement in cut.imports:
            self._add_of_source(statement, package)
        if loaded is None:
            return
        for held in cut.names:
            value = self._ledger.look(vars(loaded), held)
            if drifted(source, loaded, held):
                self._ledger.write("drift", f"{module}.{held}")
                self._ledger.put(value)

    def _add_of_source(self, statement: Import, package: str) -> None:
        """As `add`; the statement itself is in the slice's digest already."""
        module, territory = absolute(statement, package), self._ledger.territory
        for name in statement.names or (None,):
            inner = f"{module}.{name}"
            if name is not None and territory.foreign(inner) is None and locate(inner) is not None:
                self._pending.append((inner, None))
            elif (released := territory.foreign(module)) is None:
                self._pending.append((module, None if name == "*" else name))
            else:
                self._slices[released, None] = released.encode()
                self._ledger.reach(released)


_Loaded = tuple[ModuleType, Any, Source]
_read: dict[tuple[str, int], Source] = {}
_read_as_loaded: dict[str, _Loaded] = {}


def _source(path: Path, loaded: ModuleType | None) -> Source | None:
    """The source of a module; of a loaded one as it was when first asked for, since that is what runs.

    None where it cannot be read, or is not Python.
    """
    if loaded is not None:
        known = _read_as_loaded.get(loaded.__name__)
        if known is not None and known[0] is loaded and known[1] is loaded.__spec__:
            return known[2]
    key = (str(path), modified(str(path)))
    if key not in _read:
        try:
            _read[key] = Source(path)
        except (OSError, SyntaxError):
            return None
    if loaded is not None:
        _read_as_loaded[loaded.__name__] = (loaded, loaded.__spec__, _read[key])
    return _read[key]
