"""What functions depend on in the code: modules by what their files say, everything else as it is in memory.

A function whose code stands in the file of its module counts with that module and all that it imports. Others (a cell
of a notebook, what was patched in) are described object by object: code, closure, the globals that the code names.
Objects are numbered as they are mentioned and described in that order, so that cycles end and neither addresses nor
hash seeds matter.
"""

from __future__ import annotations

import copyreg
import dis
import sys
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from enum import Enum
from itertools import chain
from pathlib import PurePath
from types import CodeType, FunctionType, ModuleType
from typing import Any

from graphface.fingerprint.loaded import Module, Watch
from graphface.fingerprint.modules import absolute, distribution, imported, released
from graphface.values.digest import digest_file, exact, new_hash

_PLAIN = (type(None), bool, int, float, complex, str, bytes, type(...), PurePath)
_DECLARING = ("__slots__", "__pydantic_fields__")
"""Attributes with a name of Python's own that decide what a class does."""


class Walk:
    """The walk from some functions; `engine` stands for what the engine does to results.

    Attributes:
        digest: 16 bytes.
        reached: what counts: modules by content, packages as "name version", functions and classes as they are.
        watched: what must stay as it is for the digest to hold.
    """

    def __init__(self, functions: Sequence[Callable[..., Any]], engine: int) -> None:
        self.reached: dict[str, bytes] = {}
        self._live = Watch()
        self.watched: list[Watch] = [self._live]
        self._own = distribution(getattr(functions[0], "__module__", None) or "builtins")
        self._state = new_hash()
        self._numbers: dict[int, tuple[int, Any]] = {}  # holds the objects, or an id might be given again
        self._objects: deque[Any] = deque()
        self._modules: deque[str] = deque()
        self._packages = {""}
        self._write(engine, *functions)
        while self._objects or self._modules:
            if self._objects:
                self._describe(self._objects.popleft())
            else:
                self._read(self._modules.popleft())
        self._state.update(exact(sorted(self.reached.items())))
        self.digest: bytes = self._state.digest()

    def _reach(self, module: str) -> None:
        name = released(module, self._own)
        if name is None and module not in self.reached:
            self._modules.append(module)
        if name != "":
            self.reached.setdefault(name or module, b"")

    def _reach_packages(self, package: str) -> None:
        """Reach the packages around a module where importing them does more than define names.

        Others count where something is imported from them: a table of all operators, or of names to re-export, says
        nothing about one of them.
        """
        if package in self._packages or released(package, self._own) is not None:
            return
        self._packages.add(package)
        module = Module.of(package)
        if module is not None and module.source.has_effects:
            self._reach(package)
        self._reach_packages(package.rpartition(".")[0])

    def _read(self, name: str) -> None:
        """Count a module by its file, reach what it imports, describe what departs from the file."""
        module = Module.of(name)
        if module is None:
            self._live.name(sys.modules, name)
            self._write(name, sys.modules.get(name))
            return
        self.watched.append(module.watch)
        files = [digest_file(file) for file in module.source.files if file.is_file()]
        self.reached[name] = module.source.digest + b"".join(files)
        self._reach_packages(name.rpartition(".")[0])
        for target in module.source.imports:
            self._reach(target)
        for label, value in module.departures():
            self._write(name, label, value)

    def _write(self, *values: Any) -> None:
        """Write plain values; of any other its number, a description follows when its turn comes."""
        for value in values:
            if isinstance(value, _PLAIN) and not isinstance(value, Enum):
                self._state.update(exact(value))
            else:
                if id(value) not in self._numbers:
                    self._numbers[id(value)] = (len(self._numbers), value)
                    self._objects.append(value)
                self._state.update(exact(("object", self._numbers[id(value)][0])))

    def _describe(self, value: Any) -> None:
        self._write(type(value).__name__)
        if isinstance(value, FunctionType):
            self._function(value)
        elif isinstance(value, type):
            self._class(value)
        elif isinstance(value, ModuleType):
            self._module(value)
        elif isinstance(value, staticmethod | classmethod):
            self._write(value.__func__)
        elif isinstance(value, property):
            self._write(value.fget, value.fset, value.fdel)
        elif type(value) in (list, tuple):
            self._write(len(value), *value)
        elif type(value) in (set, frozenset):
            self._write(len(value), *sorted(value, key=lambda item: getattr(item, "__qualname__", "") or ascii(item)))
        elif type(value) is dict:
            self._write(len(value), *chain.from_iterable(value.items()))
        else:
            self._write(type(value), *_parts(value))

    def _function(self, function: FunctionType) -> None:
        space, name = function.__globals__, function.__globals__.get("__name__") or ""
        cells = []
        for cell in function.__closure__ or ():
            with suppress(ValueError):  # not assigned yet
                cells.append(cell.cell_contents)
        self._write(f"{name}.{function.__qualname__}")
        if released(name, self._own) is not None:  # somebody else's decorator: what it wraps may be ours
            self._reach(name)
            ours = [value for value in cells if isinstance(value, FunctionType | type)]
            self._write(function.__dict__.get("__wrapped__"), *ours)
            return
        self._live.function(function)
        module = Module.of(name)
        place = module.place(function) if module is not None else None
        if place is not None:
            self._write(place)
            self._reach(name)
        else:
            self.reached.setdefault(f"{name}.{function.__qualname__}", b"")
            self._code(function.__code__, space)
            with suppress(NameError):  # evaluated only now, from 3.14 on
                self._write(function.__annotations__)
        self._write(function.__defaults__, function.__kwdefaults__, *cells)

    def _code(self, code: CodeType, space: dict[str, Any]) -> None:
        """Describe code that stands in no file, and the globals and modules that it names."""
        self._write(sys.implementation.cache_tag, code.co_code, code.co_exceptiontable, code.co_flags)
        self._write(code.co_argcount, code.co_kwonlyargcount, code.co_names, code.co_varnames, code.co_freevars)
        steps = [step for step in dis.get_instructions(code) if step.opname != "EXTENDED_ARG"]
        for index, step in enumerate(steps):
            if step.opname == "IMPORT_NAME":
                level, names = (before.argval for before in steps[index - 2 : index])
                module = absolute("." * level + step.argval, space.get("__package__") or "")
                for target in imported(module, names or (), self._own):
                    self._write(target)
                    self._reach(target)
            elif step.opname in ("LOAD_GLOBAL", "LOAD_NAME"):
                self._live.name(space, step.argval)
                self._write(step.argval, space.get(step.argval, "missing"))
        for constant in code.co_consts:
            if isinstance(constant, CodeType):
                self._code(constant, space)
            else:
                self._write(ascii(sorted(map(ascii, constant)) if isinstance(constant, frozenset) else constant))

    def _class(self, kind: type) -> None:
        self._write(f"{kind.__module__}.{kind.__qualname__}")
        others = released(kind.__module__, self._own) is not None
        module = Module.of(kind.__module__) if not others else None
        if others or (module is not None and kind in module.classes):
            self._reach(kind.__module__)
            return
        self.reached.setdefault(f"{kind.__module__}.{kind.__qualname__}", b"")
        self._live.space(vars(kind))
        self._write(type(kind), *kind.__bases__)
        for name in sorted(vars(kind)):
            value = vars(kind)[name]
            if not name.startswith("__") or isinstance(value, FunctionType) or name in _DECLARING:
                self._write(name, value)

    def _module(self, module: ModuleType) -> None:
        name = module.__name__
        self._write(name)
        if released(name, self._own) is not None or (Module.of(name) is not None and sys.modules.get(name) is module):
            self._reach(name)
        else:  # made at run time
            self._live.space(vars(module))
            self._write(*chain.from_iterable((n, v) for n, v in sorted(vars(module).items()) if not n.startswith("__")))


def _parts(value: Any) -> list[Any]:
    """What an object consists of: what it wraps and what pickling would ask it for; nothing of a lock or a file."""
    try:
        wrapped = getattr(value, "__wrapped__", None)
        reduce = copyreg.dispatch_table.get(type(value))
        parts = reduce(value) if reduce is not None else value.__reduce_ex__(2)
    except Exception:
        return []
    if isinstance(parts, str):
        return [wrapped, parts]
    return [wrapped, *(list(part) if isinstance(part, Iterator) else part for part in parts)]
