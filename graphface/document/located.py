"""YAML text to plain data that remembers where every key and value stood.

PyYAML's C parser yields events; the tree is built from them here instead of by `yaml.compose`, for three reasons: depth
and alias expansion are bounded while reading (a 10-line alias bomb expands to gigabytes, and composing is recursive),
scalars follow YAML 1.2's core schema (`on` is a string, `1e0` a number), and a position costs one int, not an object,
so that a graph of 100,000 nodes still fits. Loading 1,000 nodes takes about 40 ms.
"""

from __future__ import annotations

import math
import re
from typing import Any

import yaml

from graphface.errors import DocumentError, Problem, UnreadableFile
from graphface.place import COLUMN_BITS, Place, Source

MAX_DEPTH = 64
MAX_ALIASED_VALUES = 100_000
MAX_CHARACTERS = 256 * 1024 * 1024
MAX_DIGITS = 1000

_INT = re.compile(r"[-+]?[0-9]+")
_HEX = re.compile(r"0x[0-9a-fA-F]+")
_OCTAL = re.compile(r"0o[0-7]+")
_FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_CONSTANTS: dict[str, Any] = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL")),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
    **dict.fromkeys((".inf", ".Inf", ".INF", "+.inf"), math.inf),
    "-.inf": -math.inf,
    **dict.fromkeys((".nan", ".NaN", ".NAN"), math.nan),
}


class Map(dict[str, Any]):
    """A YAML mapping that knows where it, its keys and its values stood."""

    __slots__ = ("_at", "_key_at", "_value_at", "source")

    def __init__(self, source: Source, at: int) -> None:
        super().__init__()
        self.source = source
        self._at = at
        self._key_at: dict[str, int] = {}
        self._value_at: dict[str, int] = {}

    @property
    def place(self) -> Place:
        return self.source.place(self._at)

    def key_place(self, key: str) -> Place:
        return self.source.place(self._key_at[key])

    def value_place(self, key: str) -> Place:
        return self.source.place(self._value_at[key])

    def put(self, key: str, value: Any, key_at: int, value_at: int) -> None:
        self[key] = value
        self._key_at[key] = key_at
        self._value_at[key] = value_at


class Seq(list[Any]):
    """A YAML sequence that knows where it and its items stood."""

    __slots__ = ("_at", "_item_at", "source")

    def __init__(self, source: Source, at: int) -> None:
        super().__init__()
        self.source = source
        self._at = at
        self._item_at: list[int] = []

    @property
    def place(self) -> Place:
        return self.source.place(self._at)

    def item_place(self, index: int) -> Place:
        return self.source.place(self._item_at[index])

    def put(self, value: Any, at: int) -> None:
        self.append(value)
        self._item_at.append(at)


def file_source(path: Path) -> Source:
    """The text of a YAML file.

    Raises:
        UnreadableFile: there is no such file, or it is not UTF-8 text.
    """
    try:
        return Source(str(path), path.read_text(encoding="utf-8-sig"), path)
    except UnicodeDecodeError as error:
        byte = error.object[error.start]
        raise UnreadableFile(path, f"not UTF-8 text (byte {error.start} is 0x{byte:02x})") from None
    except (OSError, ValueError) as error:
        raise UnreadableFile(path, getattr(error, "strerror", None) or str(error)) from None


def parse(source: Source) -> tuple[Any, list[Problem]]:
    """The tree of a YAML text (`Map`, `Seq` and scalars), and the duplicate keys found in it.

    Raises:
        DocumentError: the text is not YAML, or is too deep or too large to be a graph.
    """
    if len(source.text) > MAX_CHARACTERS:
        raise DocumentError([Problem(f"the file is larger than {MAX_CHARACTERS >> 20} MiB", source.place(_at_start()))])
    builder = _Builder(source)
    try:
        for event in yaml.parse(source.text, Loader=_Loader):
            builder.take(event)
    except yaml.MarkedYAMLError as error:
        raise DocumentError([Problem(_yaml_reason(error), _mark_place(source, error))]) from None
    except UnicodeEncodeError as error:
        reason = "not text: a lone surrogate " + repr(source.text[error.start : error.start + 1])
        raise DocumentError([Problem(reason, source.place(_at_start()))]) from None
    except yaml.YAMLError as error:
        raise DocumentError([Problem(f"not YAML: {str(error).splitlines()[0]}", source.place(_at_start()))]) from None
    return builder.root, builder.problems


def scalar(text: str) -> Any:
    """A plain scalar by YAML 1.2's core schema: null, bool, int, float or str.

    An integer of more than `MAX_DIGITS` digits is infinite: Python refuses to convert or even print such numbers.
    """
    if text in _CONSTANTS:
        return _CONSTANTS[text]
    for form, base in ((_INT, 10), (_HEX, 16), (_OCTAL, 8)):
        if form.fullmatch(text):
            return int(text, base) if len(text) <= MAX_DIGITS else math.inf
    return float(text) if _FLOAT.fullmatch(text) else text


def plain(value: Any) -> Any:
    """A value of the tree as ordinary dicts and lists: what operators get, with the keys of a caller's own."""
    if isinstance(value, Map):
        return {key: plain(item) for key, item in value.items()}
    return [plain(item) for item in value] if isinstance(value, Seq) else value


_Loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


class _Builder:
    """Builds the tree event by event, without recursion."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.root: Any = None
        self.problems: list[Problem] = []
        self._open: list[Map | Seq] = []
        self._keys: list[tuple[str, int] | None] = []
        self._anchors: dict[str, tuple[Any, int, int]] = {}
        self._pending: list[tuple[str | None, int]] = []
        self._heights: list[int] = []
        self._values = 0
        self._aliased = 0
        self._documents = 0

    def take(self, event: Any) -> None:
        kind = type(event)
        if kind is yaml.ScalarEvent:
            at = _pack(event.start_mark)
            value: Any = event.value
            if event.tag is not None and event.tag != "!":
                self._fail(f"tags ({event.tag}) have no meaning here; remove it", at)
            if event.style in (None, "") and not self._awaits_key():
                value = scalar(value)
            self._place(value, at, event.anchor, 1, 0)
        elif kind is yaml.MappingStartEvent or kind is yaml.SequenceStartEvent:
            at = _pack(event.start_mark)
            if event.tag is not None and event.tag != "!":
                self._fail(f"tags ({event.tag}) have no meaning here; remove it", at)
            if self._awaits_key():
                self._fail("a key must be a plain word", at)
            if len(self._open) >= MAX_DEPTH:
                self._fail(f"nested deeper than {MAX_DEPTH} levels", at)
            self._open.append(Map(self.source, at) if kind is yaml.MappingStartEvent else Seq(self.source, at))
            self._keys.append(None)
            self._pending.append((event.anchor, self._values))
            self._heights.append(0)
        elif kind is yaml.MappingEndEvent or kind is yaml.SequenceEndEvent:
            done = self._open.pop()
            self._keys.pop()
            anchor, before = self._pending.pop()
            size = self._values - before
            self._values = before
            self._place(done, done._at, anchor, size + 1, self._heights.pop() + 1)
        elif kind is yaml.AliasEvent:
            at = _pack(event.start_mark)
            if self._awaits_key():
                self._fail("a key must be a plain word", at)
            if event.anchor not in self._anchors:
                self._fail(f"unknown anchor {event.anchor!r} (an anchor cannot contain itself)", at)
            value, size, height = self._anchors[event.anchor]
            self._aliased += size
            if self._aliased > MAX_ALIASED_VALUES:
                self._fail(f"aliases expand to more than {MAX_ALIASED_VALUES:,} values", at)
            if len(self._open) + height > MAX_DEPTH:
                self._fail(f"aliases nest deeper than {MAX_DEPTH} levels", at)
            self._place(value, at, None, size, height)
        elif kind is yaml.DocumentStartEvent:
            self._documents += 1
            if self._documents > 1:
                self._fail("a graph file holds one YAML document", _pack(event.start_mark))

    def _awaits_key(self) -> bool:
        return bool(self._open) and isinstance(self._open[-1], Map) and self._keys[-1] is None

    def _place(self, value: Any, at: int, anchor: str | None, size: int, height: int) -> None:
        self._values += size
        if anchor is not None:
            self._anchors[anchor] = (value, size, height)
        if not self._open:
            self.root = value
            return
        self._heights[-1] = max(self._heights[-1], height)
        parent = self._open[-1]
        if isinstance(parent, Seq):
            parent.put(value, at)
            return
        key = self._keys[-1]
        if key is None:
            self._keys[-1] = (value, at)
            return
        self._keys[-1] = None
        if key[0] in parent:
            first = parent.key_place(key[0])
            message = f"{key[0]!r} stands twice; the first is at line {first.line}"
            self.problems.append(Problem(message, self.source.place(key[1])))
        else:
            parent.put(key[0], value, key[1], at)

    def _fail(self, message: str, at: int) -> None:
        raise DocumentError([Problem(message, self.source.place(at))])


def _at_start() -> int:
    return (1 << COLUMN_BITS) | 1


def _pack(mark: Any) -> int:
    line, column = int(mark.line) + 1, int(mark.column) + 1
    return line << COLUMN_BITS | min(column, (1 << COLUMN_BITS) - 1)


def _mark_place(source: Source, error: yaml.MarkedYAMLError) -> Place:
    mark = error.problem_mark or error.context_mark
    return source.place(_pack(mark) if mark is not None else _at_start())


def _yaml_reason(error: yaml.MarkedYAMLError) -> str:
    parts = [p for p in (error.problem, error.context) if p]
    return "not YAML: " + ", ".join(parts)
