"""What a walk through code writes down: the digest so far, whose code was reached, and what must stay as it is.

Plain values are written out. Other objects are numbered in the order of their first mention and described later, one by
one, so that cycles end and the digest depends neither on addresses, hash seeds, nor on what else has been imported.
"""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Iterator
from enum import Enum
from pathlib import PurePath
from types import FunctionType
from typing import Any

import numpy as np

from graphface.cache.beside import content
from graphface.cache.territory import Territory
from graphface.values.digest import Undigestible, exact, new_hash

MISSING: Any = object()
_PLAIN = (type(None), bool, int, float, complex, str, bytes, np.ndarray, PurePath, type(...))


class Ledger:
    """The record of one walk.

    Attributes:
        state: the hash that everything is written to.
        reached: what was included, in the order of the walk: "module.name", "numpy 2.4.6".
        names: every name looked up and what it stood for. code: every function with its code and defaults.
        files: source files of modules that are not loaded, and when they were modified.
    """

    def __init__(self, territory: Territory) -> None:
        self.territory = territory
        self.state = new_hash()
        self.reached: dict[str, None] = {}
        self.names: dict[tuple[int, str], tuple[Any, str, Any]] = {}
        self.code: list[tuple[FunctionType, Any, Any]] = []
        self.files: dict[str, int] = {}
        self._numbers: dict[int, int] = {}
        self._alive: list[Any] = []
        self._queue: deque[Any] = deque()
        self._inside: set[int] = set()

    def write(self, tag: str, text: str = "") -> None:
        self.state.update(exact((tag, text)))

    def put(self, value: Any) -> None:
        """Write a plain value or a container of such; of any other object its number."""
        inside = self._place(value)
        if inside is not None:
            self.write("path", inside)
            self.state.update(exact(content(value)))
        elif isinstance(value, _PLAIN) and not isinstance(value, Enum):
            try:
                self.state.update(exact(value))
            except Undigestible:
                self.write("opaque", type_name(value))
        elif type(value) in (list, tuple, dict, set, frozenset):
            self._put_container(value)
        else:
            number = self._numbers.get(id(value))
            if number is None:
                number = self._numbers[id(value)] = len(self._numbers)
                self._alive.append(value)
                self._queue.append(value)
            self.write("object", str(number))

    def parts(self, tag: str, *parts: Any) -> None:
        """Write several values under a tag."""
        self.write(tag, str(len(parts)))
        for part in parts:
            self.put(part)

    def undescribed(self) -> Iterator[Any]:
        """The objects that have a number and no description yet, also those that get one on the way."""
        while self._queue:
            yield self._queue.popleft()

    def reach(self, name: str) -> None:
        self.reached.setdefault(name)

    def foreign(self, module: str | None) -> bool:
        """Write the released package that `module` belongs to, if it does."""
        released = self.territory.foreign(module)
        if released is None:
            return False
        self.write("foreign", released)
        if released != "python":
            self.reach(released)
        return True

    def look(self, namespace: Any, name: str) -> Any:
        """What `name` means now, or `MISSING`; `Fingerprint.stale` will compare."""
        value = namespace.get(name, MISSING)
        self.names[id(namespace), name] = (namespace, name, value)
        return value

    def watch(self, path: str) -> None:
        """Note when a file was modified; `Fingerprint.stale` will compare."""
        self.files[path] = modified(path)

    def _put_container(self, value: Any) -> None:
        if id(value) in self._inside:
            return self.write("cycle")
        self._inside.add(id(value))
        self.write(type(value).__name__, str(len(value)))
        if isinstance(value, dict):
            for key in sorted(value, key=self._order):
                self.put(key)
                self.put(value[key])
        else:
            for item in sorted(value, key=self._order) if isinstance(value, set | frozenset) else value:
                self.put(item)
        self._inside.discard(id(value))

    def _place(self, value: Any) -> str | None:
        """Where in the operator's own package a path points; None for anything else."""
        return self.territory.place(value) if isinstance(value, str | PurePath) else None

    def _order(self, value: Any) -> bytes:
        try:
            return exact(self._place(value) or value)
        except Undigestible:
            return f"{type_name(value)} {getattr(value, '__qualname__', '')}".encode()


def modified(path: str) -> int:
    """When a file was modified, nanoseconds; -1 where there is none."""
    try:
        return os.stat(path).st_mtime_ns
    except OSError:
        return -1


def type_name(value: Any) -> str:
    return f"{type(value).__module__}.{type(value).__qualname__}"
