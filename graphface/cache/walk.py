"""A walk through live code: each object is described by its kind, and mentions others, which have their turn later.

Live objects and not source files, since they are what will run: a function replaced at run time, a closure, a notebook
cell all count as they are. Breadth first; `graphface.cache.ledger` numbers objects as they are mentioned.
"""

from __future__ import annotations

import builtins
import functools
import re
from collections.abc import Callable
from dataclasses import fields, is_dataclass
from enum import Enum
from types import BuiltinFunctionType, CellType, FunctionType, MethodType, ModuleType
from typing import Any

import numpy as np

from graphface.cache.bytecode import PYTHON, read_code
from graphface.cache.class_content import dataclass_fields, model_fields, own_names, written_annotations
from graphface.cache.late_imports import LateImports
from graphface.cache.ledger import MISSING, Ledger, type_name

ENGINE_HOOKS = frozenset({"from_file", "to_file", "suffixes", "coerce", "picture"})
"""What the engine uses at the edges of a graph; they count where the code walked names them."""


def walk(roots: list[Callable[..., Any]], ledger: Ledger) -> None:
    """Write everything that `roots` depend on in the code into `ledger`."""
    _Walk(ledger).run(roots)


class _Walk:
    def __init__(self, ledger: Ledger) -> None:
        self._ledger = ledger
        self._imports = LateImports(ledger)
        self._mentioned: set[str] = set()
        self._hooks: list[tuple[str, Any]] = []

    def run(self, roots: list[Callable[..., Any]]) -> None:
        self._ledger.write("python", PYTHON)
        for root in roots:
            self._ledger.put(root)
        more = True
        while more:
            for value in self._ledger.undescribed():
                self._describe(value)
            more = self._imports.read() or self._mentioned_hooks()
        self._imports.write()

    def _describe(self, value: Any) -> None:
        ledger = self._ledger
        if isinstance(value, FunctionType):
            self._function(value)
        elif isinstance(value, ModuleType):
            self._module(value)
        elif isinstance(value, type):
            self._class(value)
        elif isinstance(value, MethodType):
            ledger.parts("method", value.__func__, value.__self__)
        elif isinstance(value, functools.partial):
            ledger.parts("partial", value.func, value.args, value.keywords)
        elif isinstance(value, staticmethod | classmethod):
            ledger.parts(type(value).__name__, value.__func__)
        elif isinstance(value, property):
            ledger.parts("property", value.fget, value.fset, value.fdel)
        elif isinstance(value, functools.cached_property):
            ledger.parts("cached_property", value.func)
        elif isinstance(value, BuiltinFunctionType | np.ufunc):
            ledger.write("builtin", f"{getattr(value, '__module__', '')} {value.__name__}")
            ledger.foreign(getattr(value, "__module__", None))
        elif isinstance(value, Enum):
            ledger.write("member", value.name)
            ledger.put(type(value))
        elif isinstance(value, re.Pattern):
            ledger.parts("pattern", value.pattern, value.flags)
        elif isinstance(value, np.dtype | np.generic):
            ledger.write(type_name(value), str(value))
        else:
            self._instance(value)

    def _function(self, function: FunctionType) -> None:
        ledger, namespace = self._ledger, function.__globals__
        ledger.write("function", f"{function.__name__}" if function.__name__ != "<lambda>" else "")
        wrapped = function.__dict__.get("__wrapped__")
        if ledger.foreign(namespace.get("__name__")):
            # A decorator of somebody else's: what it wraps is ours.
            held = [c for c in _cells(function).values() if isinstance(c, FunctionType | type)]
            ledger.parts("wrapped", wrapped, held)
            return
        ledger.reach(f"{function.__module__}.{function.__qualname__}")
        ledger.code.append((function, function.__code__, function.__defaults__))
        content = read_code(function.__code__)
        ledger.state.update(content.digest)
        self._mentioned |= content.names
        ledger.parts("function", function.__defaults__, function.__kwdefaults__, _cells(function), wrapped)
        for chain in content.references:
            self._resolve(namespace, chain)
        for statement in content.imports:
            self._imports.add(statement, namespace.get("__package__") or "")

    def _resolve(self, namespace: dict[str, Any], chain: tuple[str, ...]) -> None:
        """Follow `sh.render` as the function will: through modules by attribute, up to the first other object."""
        ledger, (name, *attributes) = self._ledger, chain
        ledger.write("name", ".".join(chain))
        value = ledger.look(namespace, name)
        if value is MISSING:
            if not hasattr(builtins, name):
                ledger.write("missing")
            return
        while isinstance(value, ModuleType) and attributes:
            attribute = attributes.pop(0)
            inner = vars(value).get(attribute, MISSING)
            foreign = ledger.territory.foreign(value.__name__) is not None
            if foreign and not (isinstance(inner, ModuleType) and ledger.territory.foreign(inner.__name__) is None):
                break
            value = ledger.look(vars(value), attribute)
        if value is MISSING:
            ledger.write("missing")
        else:
            ledger.put(value)

    def _module(self, module: ModuleType) -> None:
        """A module used as a value may have any of its names used."""
        ledger = self._ledger
        ledger.write("module", module.__name__)
        if ledger.foreign(module.__name__):
            return
        ledger.reach(module.__name__)
        for name in sorted(vars(module)):
            if not (name.startswith("__") and name.endswith("__")):
                ledger.write("name", name)
                ledger.put(ledger.look(vars(module), name))

    def _class(self, kind: type) -> None:
        ledger, full_name = self._ledger, f"{kind.__module__}.{kind.__qualname__}"
        ledger.write("class", full_name)
        if ledger.foreign(kind.__module__):
            return
        ledger.reach(full_name)
        ledger.parts("bases", *kind.__bases__, type(kind))
        if issubclass(kind, Enum):
            ledger.put([(member.name, member._value_) for member in kind.__members__.values()])
        elif is_dataclass(kind):
            ledger.write("dataclass", repr(kind.__dataclass_params__))  # type: ignore[attr-defined]
            ledger.put(dataclass_fields(kind))
        for name, content in model_fields(kind):
            ledger.write("field", name)
            ledger.parts("field", *content)
        for name in own_names(kind):
            value = ledger.look(vars(kind), name)
            if name in ENGINE_HOOKS:
                self._hooks.append((name, value))
            else:
                ledger.write("attribute", name)
                ledger.put(written_annotations(value) if name == "__annotations__" else value)

    def _mentioned_hooks(self) -> bool:
        """Put the engine's hooks that the code walked so far names; True where there were any."""
        named = [hook for hook in self._hooks if hook[0] in self._mentioned]
        self._hooks = [hook for hook in self._hooks if hook[0] not in self._mentioned]
        for name, value in named:
            self._ledger.write("hook", name)
            self._ledger.put(value)
        return bool(named)

    def _instance(self, value: Any) -> None:
        """Any other object: its class, and its attributes where the class is ours or a plain record."""
        ledger, kind = self._ledger, type(value)
        ledger.put(kind)
        ours = ledger.territory.foreign(kind.__module__) is None
        wrapped = getattr(value, "__wrapped__", None)
        if isinstance(wrapped, FunctionType):
            ledger.parts("wrapped", wrapped)
        if isinstance(value, tuple | list):
            ledger.put(list(value))
        elif isinstance(value, dict):
            ledger.put(dict(value))
        elif is_dataclass(value):
            ledger.put({f.name: getattr(value, f.name, None) for f in fields(value) if f.name not in ENGINE_HOOKS})
        elif ours or hasattr(kind, "model_fields"):
            ledger.put(dict(getattr(value, "__dict__", {})))
        else:
            held = getattr(value, "__dict__", {})
            ledger.put({name: held[name] for name in held if isinstance(held[name], FunctionType)})


def _cells(function: FunctionType) -> dict[str, Any]:
    """The closure's variables; one not assigned yet (a function being defined) is left out."""
    cells: tuple[CellType, ...] = function.__closure__ or ()
    found = {}
    for name, cell in zip(function.__code__.co_freevars, cells, strict=True):
        try:
            found[name] = cell.cell_contents
        except ValueError:
            continue
    return found
