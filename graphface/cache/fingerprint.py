"""`fingerprint`: one digest for everything an operator's result depends on in the code.

A memoized result is wrong as soon as any helper changes, in whatever module, so the digest covers the function and all
code of its own distribution that it reaches: functions through the global names they read (`helper`, `sh.render`),
classes with their methods, module-level constants, decorators, closures, imports inside functions. The walk reads live
objects, since these are what will run; only imports inside functions are read from source (`graphface.cache.source`).
Packages released by others count by name and version (`graphface.cache.territory`).

Objects are visited breadth first and numbered in that order, so that cycles end and the digest depends neither on
addresses, hash seeds, nor on what else has been imported.

A class brings all of its methods but those that the engine calls at the edges of a graph (`from_file`, `picture` ...):
how a photo is decoded is no part of every operator that touches an `Image`. They count where an operator names them.

Known limits: what is reached only through strings (`getattr(module, name)`) counts only where the module is named,
and then as a whole; a container changed in place is seen by the next walk, not by `stale`.
"""

from __future__ import annotations

import builtins
import functools
import os
import re
import sys
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import fields, is_dataclass
from enum import Enum
from pathlib import Path
from types import BuiltinFunctionType, CellType, FunctionType, MethodType, ModuleType
from typing import Any

import numpy as np

from graphface.cache.bytecode import PYTHON, Import, read_code
from graphface.cache.digest import Undigestible, exact, new_hash
from graphface.cache.source import Source, absolute, drifted, locate
from graphface.cache.territory import Territory

ENGINE_HOOKS = frozenset({"from_file", "to_file", "coerce", "picture"})

_MISSING: Any = object()
_PLAIN = (type(None), bool, int, float, complex, str, bytes, np.ndarray, type(...))
_MACHINERY = frozenset(
    {
        "__dict__",
        "__doc__",
        "__module__",
        "__qualname__",
        "__weakref__",
        "__firstlineno__",
        "__static_attributes__",
        "__abstractmethods__",
        "__dataclass_fields__",
        "__dataclass_params__",
        "__match_args__",
        "__parameters__",
        "__orig_bases__",
        "__signature__",
        "__class_vars__",
        "__private_attributes__",
        "__hash__",
        "__replace__",
        "_abc_impl",
    }
)
"""What Python, dataclasses, enum and pydantic put into a class themselves, derived from the rest."""


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
            if namespace.get(name, _MISSING) is not value:
                return True
        for function, code, defaults in self._code:
            if function.__code__ is not code or function.__defaults__ is not defaults:
                return True
        return any(_modified(path) != before for path, before in self._files)


def fingerprint(*functions: Callable[..., Any] | None) -> Fingerprint:
    """The fingerprint of `functions` together (an operator and its `needs` rule); None among them is skipped."""
    roots = [function for function in functions if function is not None]
    walk = _Walk(Territory([getattr(f, "__module__", None) or "builtins" for f in roots]))
    return walk.run(roots)


class _Walk:
    """One traversal: `_put` writes a value or a reference to it, `_describe` an object once, when its turn comes."""

    def __init__(self, territory: Territory) -> None:
        self._territory = territory
        self._state = new_hash()
        self._numbers: dict[int, int] = {}
        self._alive: list[Any] = []
        self._queue: deque[Any] = deque()
        self._inside: set[int] = set()
        self._reached: dict[str, None] = {}
        self._mentioned: set[str] = set()
        self._hooks: list[tuple[str, Any]] = []
        self._pending: deque[tuple[str, str | None]] = deque()
        self._slices: dict[tuple[str, str | None], bytes] = {}
        self._names: dict[tuple[int, str], tuple[Any, str, Any]] = {}
        self._code: list[tuple[FunctionType, Any, Any]] = []
        self._files: dict[str, int] = {}

    def run(self, roots: list[Callable[..., Any]]) -> Fingerprint:
        self._write("python", PYTHON)
        for root in roots:
            self._put(root)
        while self._queue or self._pending or self._mentioned_hooks():
            while self._queue:
                self._describe(self._queue.popleft())
            while self._pending:
                self._read_source(*self._pending.popleft())
        for (module, name), digest in sorted(self._slices.items(), key=lambda item: (item[0][0], item[0][1] or "")):
            self._write("source", f"{module} {name}")
            self._state.update(digest)
        return Fingerprint(
            self._state.digest(), tuple(self._reached), self._names.values(), self._code, self._files.items()
        )

    def _write(self, tag: str, text: str = "") -> None:
        self._state.update(exact((tag, text)))

    def _reach(self, name: str) -> None:
        self._reached.setdefault(name)

    def _foreign(self, module: str | None) -> bool:
        """Write the released package that `module` belongs to, if it does."""
        released = self._territory.foreign(module)
        if released is None:
            return False
        self._write("foreign", released)
        if released != "python":
            self._reach(released)
        return True

    def _put(self, value: Any) -> None:
        if isinstance(value, _PLAIN) and not isinstance(value, Enum):
            try:
                self._state.update(exact(value))
            except Undigestible:
                self._write("opaque", _type_name(value))
        elif type(value) in (list, tuple, dict, set, frozenset):
            self._put_container(value)
        else:
            number = self._numbers.get(id(value))
            if number is None:
                number = self._numbers[id(value)] = len(self._numbers)
                self._alive.append(value)
                self._queue.append(value)
            self._write("object", str(number))

    def _put_container(self, value: Any) -> None:
        if id(value) in self._inside:
            return self._write("cycle")
        self._inside.add(id(value))
        self._write(type(value).__name__, str(len(value)))
        if isinstance(value, dict):
            for key in sorted(value, key=_order):
                self._put(key)
                self._put(value[key])
        else:
            for item in sorted(value, key=_order) if isinstance(value, set | frozenset) else value:
                self._put(item)
        self._inside.discard(id(value))

    def _describe(self, value: Any) -> None:
        if isinstance(value, FunctionType):
            self._function(value)
        elif isinstance(value, ModuleType):
            self._module(value)
        elif isinstance(value, type):
            self._class(value)
        elif isinstance(value, MethodType):
            self._parts("method", value.__func__, value.__self__)
        elif isinstance(value, functools.partial):
            self._parts("partial", value.func, value.args, value.keywords)
        elif isinstance(value, staticmethod | classmethod):
            self._parts(type(value).__name__, value.__func__)
        elif isinstance(value, property):
            self._parts("property", value.fget, value.fset, value.fdel)
        elif isinstance(value, functools.cached_property):
            self._parts("cached_property", value.func)
        elif isinstance(value, BuiltinFunctionType | np.ufunc):
            self._write("builtin", f"{getattr(value, '__module__', '')} {value.__name__}")
            self._foreign(getattr(value, "__module__", None))
        elif isinstance(value, Enum):
            self._write("member", value.name)
            self._put(type(value))
        elif isinstance(value, re.Pattern):
            self._parts("pattern", value.pattern, value.flags)
        elif isinstance(value, np.dtype | np.generic | Path):
            self._write(_type_name(value), str(value))
            self._parts("content", exact(value) if isinstance(value, Path) else None)
        else:
            self._instance(value)

    def _parts(self, tag: str, *parts: Any) -> None:
        self._write(tag, str(len(parts)))
        for part in parts:
            self._put(part)

    def _function(self, function: FunctionType) -> None:
        namespace = function.__globals__
        self._write("function", f"{function.__name__}" if function.__name__ != "<lambda>" else "")
        wrapped = function.__dict__.get("__wrapped__")
        if self._foreign(namespace.get("__name__")):
            # A decorator of somebody else's: what it wraps is ours.
            self._parts(
                "wrapped", wrapped, [c for c in _cells(function).values() if isinstance(c, FunctionType | type)]
            )
            return
        self._reach(f"{function.__module__}.{function.__qualname__}")
        self._code.append((function, function.__code__, function.__defaults__))
        content = read_code(function.__code__)
        self._state.update(content.digest)
        self._mentioned |= content.names
        self._parts("function", function.__defaults__, function.__kwdefaults__, _cells(function), wrapped)
        for chain in content.references:
            self._resolve(namespace, chain)
        for statement in content.imports:
            self._import(statement, namespace.get("__package__") or "")

    def _resolve(self, namespace: dict[str, Any], chain: tuple[str, ...]) -> None:
        """Follow `sh.render` as the function will: through modules by attribute, up to the first other object."""
        name, *attributes = chain
        self._write("name", ".".join(chain))
        value = self._look(namespace, name)
        if value is _MISSING:
            if not hasattr(builtins, name):
                self._write("missing")
            return
        while isinstance(value, ModuleType) and attributes:
            attribute = attributes.pop(0)
            inner = vars(value).get(attribute, _MISSING)
            foreign = self._territory.foreign(value.__name__) is not None
            if foreign and not (isinstance(inner, ModuleType) and self._territory.foreign(inner.__name__) is None):
                break
            value = self._look(vars(value), attribute)
        if value is _MISSING:
            self._write("missing")
        else:
            self._put(value)

    def _look(self, namespace: Any, name: str) -> Any:
        """What `name` means now; `stale` will compare."""
        value = namespace.get(name, _MISSING)
        self._names[id(namespace), name] = (namespace, name, value)
        return value

    def _module(self, module: ModuleType) -> None:
        """A module used as a value may have any of its names used."""
        self._write("module", module.__name__)
        if self._foreign(module.__name__):
            return
        self._reach(module.__name__)
        for name in sorted(vars(module)):
            if not (name.startswith("__") and name.endswith("__")):
                self._write("name", name)
                self._put(self._look(vars(module), name))

    def _class(self, kind: type) -> None:
        self._write("class", f"{kind.__module__}.{kind.__qualname__}")
        if self._foreign(kind.__module__):
            return
        self._reach(f"{kind.__module__}.{kind.__qualname__}")
        self._parts("bases", *kind.__bases__, type(kind))
        if issubclass(kind, Enum):
            self._put([(member.name, member._value_) for member in kind.__members__.values()])
        elif is_dataclass(kind):
            self._write("dataclass", repr(kind.__dataclass_params__))  # type: ignore[attr-defined]
            self._put([_field(field) for field in fields(kind)])
        for name, info in getattr(kind, "model_fields", {}).items() if "__pydantic_fields__" in vars(kind) else ():
            self._write("field", name)
            self._parts("field", str(info.annotation), info.default, info.default_factory, list(info.metadata))
        for name in sorted(vars(kind)):
            if not self._derived(kind, name):
                value = self._look(vars(kind), name)
                if name in ENGINE_HOOKS:
                    self._hooks.append((name, value))
                else:
                    self._write("attribute", name)
                    self._put(_annotations(value) if name == "__annotations__" else value)

    def _derived(self, kind: type, name: str) -> bool:
        if name in _MACHINERY or name.startswith("__pydantic_") or name == "model_fields":
            return True
        if issubclass(kind, Enum) and (name in kind.__members__ or name.startswith("_")):
            return True
        value = getattr(vars(kind)[name], "__wrapped__", vars(kind)[name])
        return isinstance(value, FunctionType) and is_dataclass(kind) and value.__code__.co_filename == "<string>"

    def _mentioned_hooks(self) -> bool:
        """Put the engine's hooks that the code walked so far names; True where there were any."""
        named = [hook for hook in self._hooks if hook[0] in self._mentioned]
        self._hooks = [hook for hook in self._hooks if hook[0] not in self._mentioned]
        for name, value in named:
            self._write("hook", name)
            self._put(value)
        return bool(named)

    def _instance(self, value: Any) -> None:
        """Any other object: its class, and its attributes where the class is ours or a plain record."""
        kind = type(value)
        self._put(kind)
        ours = self._territory.foreign(kind.__module__) is None
        wrapped = getattr(value, "__wrapped__", None)
        if isinstance(wrapped, FunctionType):
            self._parts("wrapped", wrapped)
        if isinstance(value, tuple | list):
            self._put(list(value))
        elif isinstance(value, dict):
            self._put(dict(value))
        elif is_dataclass(value):
            self._put({f.name: getattr(value, f.name, None) for f in fields(value) if f.name not in ENGINE_HOOKS})
        elif ours or hasattr(kind, "model_fields"):
            self._put(dict(getattr(value, "__dict__", {})))
        else:
            held = getattr(value, "__dict__", {})
            self._put({name: held[name] for name in held if isinstance(held[name], FunctionType)})

    def _import(self, statement: Import, package: str) -> None:
        """An import inside a function: names from the module, or the whole module; each name may be a module itself."""
        module = absolute(statement, package)
        self._write("import", module)
        if self._foreign(module) and not self._holds_ours(module, statement):
            return
        for name in statement.names or (None,):
            inner = f"{module}.{name}"
            if name is not None and not self._foreign(inner) and locate(inner) is not None:
                self._pending.append((inner, None))
            elif self._territory.foreign(module) is None:
                self._pending.append((module, None if name == "*" else name))

    def _holds_ours(self, module: str, statement: Import) -> bool:
        """`from graphface import nodes`: the package is not ours, what is imported from it is."""
        return any(self._territory.foreign(f"{module}.{name}") is None for name in statement.names or ())

    def _read_source(self, module: str, name: str | None) -> None:
        if (module, name) in self._slices:
            return
        loaded = sys.modules.get(module)
        path = locate(module)
        self._reach(f"{module}.{name}" if name else module)
        if loaded is None:
            self._look(sys.modules, module)
            if path is not None:
                self._files[str(path)] = _modified(str(path))
        try:
            source = _source(path, loaded) if path is not None else None
        except (OSError, SyntaxError):
            source = None
        if source is None:
            self._slices[module, name] = b"no source"
            return
        cut = source.slice(name)
        self._slices[module, name] = cut.digest
        package = module if path is not None and path.name == "__init__.py" else module.rpartition(".")[0]
        for statement in cut.imports:
            self._import_of_source(statement, package)
        if loaded is None:
            return
        for held in cut.names:
            value = self._look(vars(loaded), held)
            if drifted(source, loaded, held):
                self._write("drift", f"{module}.{held}")
                self._put(value)

    def _import_of_source(self, statement: Import, package: str) -> None:
        """As `_import`; the statement itself is in the slice's digest already."""
        module = absolute(statement, package)
        for name in statement.names or (None,):
            inner = f"{module}.{name}"
            if name is not None and self._territory.foreign(inner) is None and locate(inner) is not None:
                self._pending.append((inner, None))
            elif self._territory.foreign(module) is None:
                self._pending.append((module, None if name == "*" else name))
            elif (released := self._territory.foreign(module)) is not None:
                self._slices[released, None] = released.encode()
                self._reach(released)


_Loaded = tuple[ModuleType, Any, Source]
_read: dict[tuple[str, int], Source] = {}
_read_as_loaded: dict[str, _Loaded] = {}


def _source(path: Path, loaded: ModuleType | None) -> Source:
    """The source of a module; of a loaded one as it was when first asked for, since that is what runs."""
    if loaded is not None:
        known = _read_as_loaded.get(loaded.__name__)
        if known is not None and known[0] is loaded and known[1] is loaded.__spec__:
            return known[2]
    key = (str(path), _modified(str(path)))
    if key not in _read:
        _read[key] = Source(path)
    if loaded is not None:
        _read_as_loaded[loaded.__name__] = (loaded, loaded.__spec__, _read[key])
    return _read[key]


def _modified(path: str) -> int:
    try:
        return os.stat(path).st_mtime_ns
    except OSError:
        return -1


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


def _field(field: Any) -> tuple[Any, ...]:
    defaults = [
        None if d.__class__.__name__ == "_MISSING_TYPE" else (d,) for d in (field.default, field.default_factory)
    ]
    return (field.name, field.init, field.compare, bool(field.kw_only), *defaults)


def _annotations(hints: dict[str, Any]) -> dict[str, str]:
    """Annotations as written; resolved ones by name, since their repr may hold addresses."""
    return {name: hint if isinstance(hint, str) else getattr(hint, "__qualname__", "") for name, hint in hints.items()}


def _order(value: Any) -> bytes:
    try:
        return exact(value)
    except Undigestible:
        return f"{_type_name(value)} {getattr(value, '__qualname__', '')}".encode()


def _type_name(value: Any) -> str:
    return f"{type(value).__module__}.{type(value).__qualname__}"
