"""A module as it is in this process, beside what its file says.

What is in memory is what runs, and the file need not say it: names are replaced at run time, files are edited after
they were loaded. Code objects compare by content, so the functions in memory are compared with those that the file
compiles to; imports and literals are compared with the statements. What departs from the file is described as it is.

Known limit: what a computed name (`TABLE = np.arange(3)`) should be, the file does not say without being run. The value
that it has when the module is first looked at is taken for right; that it is replaced is noticed from then on.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Mapping
from enum import Enum
from functools import cached_property
from operator import is_
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

from graphface.fingerprint.modules import locate
from graphface.fingerprint.source import Source
from graphface.values.digest import Undigestible, exact

MISSING: Any = object()
_PLAIN = (bool, int, float, complex, str, bytes, tuple, list, dict, set, frozenset, type(None))


class Watch:
    """Names, functions and files that must stay as they are for a fingerprint to hold."""

    def __init__(self) -> None:
        self._spaces: list[tuple[Mapping[str, Any], list[Any]]] = []
        self._names: list[tuple[Mapping[str, Any], str, Any]] = []
        self._functions: list[tuple[FunctionType, Any, Any]] = []
        self._files: list[tuple[Path, tuple[int, int]]] = []

    def space(self, space: Mapping[str, Any]) -> None:
        """Watch all names of a module or class."""
        self._spaces.append((space, list(space.values())))

    def name(self, space: Mapping[str, Any], name: str) -> None:
        self._names.append((space, name, space.get(name, MISSING)))

    def function(self, function: FunctionType) -> None:
        self._functions.append((function, function.__code__, function.__defaults__))

    def file(self, path: Path) -> None:
        self._files.append((path, _stamp(path)))

    def changed(self) -> bool:
        """Some 20 ns a name, 1 µs a file."""
        try:
            for space, values in self._spaces:
                if len(space) != len(values) or not all(map(is_, space.values(), values)):
                    return True
        except RuntimeError:  # another thread adds a name just now
            return True
        for names, name, value in self._names:
            if names.get(name, MISSING) is not value:
                return True
        for function, code, defaults in self._functions:
            if function.__code__ is not code or function.__defaults__ is not defaults:
                return True
        return bool(self._files) and any(_stamp(path) != before for path, before in self._files)


class Module:
    """A module that counts by its content.

    Attributes:
        source: its file; of a loaded module as it was when first looked at, since that is what runs.
        classes: those that it holds as its file says.
        watch: holds for as long as this description does.
    """

    def __init__(self, name: str, source: Source, loaded: ModuleType | None, known: dict[str, Any] | None) -> None:
        self.name: str = name
        self.source: Source = source
        self.loaded: ModuleType | None = loaded
        self.spec: Any = getattr(loaded, "__spec__", None)
        self._departures: list[tuple[str, Any]] = []
        self._imports: list[tuple[str, Any, str, str | None]] = []
        self.classes: set[type] = set()
        self.watch: Watch = Watch()
        self._first, self._known = known is None, known or {}
        self.watch.name(sys.modules, name)
        for file in source.files:
            self.watch.file(file)
        if loaded is None:
            self.watch.file(source.path)
        else:
            self._compare(vars(loaded), "")

    @classmethod
    def of(cls, name: str) -> Module | None:
        """The module as it is now, None where it has no file; neither read nor compared again where nothing changed."""
        loaded, before = sys.modules.get(name), _modules.get(name)
        source, known = None, None
        if before is not None and before.loaded is loaded and before.spec is getattr(loaded, "__spec__", None):
            moved = loaded is None and locate(name) != before.source.path
            if not moved and not before.watch.changed():
                return before
            if loaded is not None:  # what runs is what was read first, not the file as it is by now
                source, known = before.source, before._known
        if source is None:
            path = locate(name)
            if path is None or not path.is_file():
                return None
            source = _read(name, path)
        _modules[name] = cls(name, source, loaded, known)
        return _modules[name]

    def place(self, function: FunctionType) -> str | None:
        """Where in the file the code of a function stands, None where it does not."""
        if self.loaded is None or function.__globals__ is not vars(self.loaded):
            return None
        name = function.__code__.co_qualname
        alike = self.source.codes.get(name, [])
        return f"{name} {alike.index(function.__code__)}" if function.__code__ in alike else None

    def departures(self) -> Iterator[tuple[str, Any]]:
        """What the module holds and its file does not say, by qualified name.

        What was imported is compared each time: the module it came from may have been loaded again since.
        """
        yield from self._departures
        for label, value, module, name in self._imports:
            held: Any = sys.modules.get(module, value)
            if held is not value and name is not None:
                held = vars(held).get(name, sys.modules.get(f"{module}.{name}", value))
            if held is not value and not _same(held, value):
                yield label, value

    def _compare(self, space: Mapping[str, Any], scope: str) -> None:
        """Compare the names of the module, or of a class in it, with what the file says."""
        self.watch.space(space)
        for name, value in list(space.items()):
            label, function = scope + name, _innermost(value)
            if isinstance(function, FunctionType):
                self.watch.function(function)
            if self._departs(label, value, function):
                self._departures.append((label, value))
            elif isinstance(value, type) and (value.__module__, value.__qualname__) == (self.name, label):
                self.classes.add(value)
                self._compare(vars(value), label + ".")

    def _departs(self, label: str, value: Any, function: Any) -> bool:
        """Whether a name holds something else than the file says; imports are noted for later."""
        match self.source.bindings.get(label):
            case ("import", (module, name)):
                self._imports.append((label, value, module, name))
                return False
            case ("literal", stated) if stated or not isinstance(stated, list | dict | set):
                machinery = "." in label and (not isinstance(value, _PLAIN) or isinstance(value, Enum))
                return not machinery and not _same(stated, value)
            case ("def", decorated):
                departs = self._definition_departs(label, value, function, decorated)
                if departs is not None:
                    return departs
            case None if label.rpartition(".")[2].startswith("__") and not isinstance(value, FunctionType):
                return False  # Python's own, some of it written when first used
        # Computed, or an empty container, which is filled in use.
        submodule = sys.modules.get(f"{self.name}.{label}", MISSING) is value
        return self._replaced(label, value) and not submodule

    def _definition_departs(self, label: str, value: Any, function: Any, decorated: bool) -> bool | None:
        """The same of a name that a def or class statement binds; None where a decorator made something else of it."""
        if isinstance(value, type) and (value.__module__, value.__qualname__) == (self.name, label):
            return False
        wrapped = function is not value and isinstance(value, FunctionType)
        named = isinstance(function, FunctionType) and function.__code__.co_qualname == label
        if named and (decorated or not wrapped):
            return self.place(function) is None or self._replaced(label + "()", function.__defaults__)
        return None if decorated else True

    def _replaced(self, label: str, value: Any) -> bool:
        """Whether this was another object when the module was first looked at."""
        if self._first:
            self._known[label] = value
        return self._known.get(label, MISSING) is not value


def _innermost(value: Any) -> Any:
    """The function inside decorators, a method or a property; other values as they are."""
    if isinstance(value, staticmethod | classmethod):
        value = value.__func__
    elif isinstance(value, property | cached_property):
        value = value.fget if isinstance(value, property) else value.func
    try:
        while (inner := value.__dict__.get("__wrapped__")) is not None:
            value = inner
    except Exception:  # an object that has no attributes, or answers for them itself
        pass
    return value


def _same(one: Any, other: Any) -> bool:
    try:
        return exact(one) == exact(other)
    except Undigestible:
        return False


def _stamp(path: Path) -> tuple[int, int]:
    """What changes when a file is written: its time and its size; zeros where there is none."""
    try:
        status = os.stat(path)
    except OSError:
        return (0, 0)
    return (status.st_mtime_ns, status.st_size)


def _read(name: str, path: Path) -> Source:
    key = (path, _stamp(path))
    if name not in _sources or _sources[name][0] != key:
        _sources[name] = (key, Source(name, path))
    return _sources[name][1]


_modules: dict[str, Module] = {}
_sources: dict[str, tuple[Any, Source]] = {}
