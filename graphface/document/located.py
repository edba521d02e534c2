"""YAML text to plain data that remembers where every key and value stands.

PyYAML's C parser yields events; the tree is built from them here instead of by `yaml.compose`, for two reasons: depth
and alias expansion are bounded while reading (a 10-line alias bomb expands to gigabytes, and composing is recursive),
and scalars follow YAML 1.2's core schema (`on` is a string, `1e0` a number).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

import yaml

from graphface.document.scalars import scalar
from graphface.errors import DocumentError, Problem, UnreadableFile
from graphface.place import Place, Source

MAX_BYTES = 64 << 20
MAX_DEPTH = 64
MAX_ALIASED_VALUES = 100_000


class Map(dict[str, Any]):
    """A YAML mapping that knows where it, its keys and its values stand."""

    __slots__ = ("_key_places", "_value_places", "place")

    def __init__(self, place: Place) -> None:
        super().__init__()
        self.place: Place = place
        self._key_places: dict[str, Place] = {}
        self._value_places: dict[str, Place] = {}

    def key_place(self, key: str) -> Place:
        return self._key_places[key]

    def value_place(self, key: str) -> Place:
        return self._value_places[key]

    def put(self, key: str, value: Any, key_place: Place, value_place: Place) -> None:
        self[key] = value
        self._key_places[key] = key_place
        self._value_places[key] = value_place


class Seq(list[Any]):
    """A YAML sequence that knows where it and its items stand."""

    __slots__ = ("_item_places", "place")

    def __init__(self, place: Place) -> None:
        super().__init__()
        self.place: Place = place
        self._item_places: list[Place] = []

    def item_place(self, index: int) -> Place:
        return self._item_places[index]

    def put(self, value: Any, place: Place) -> None:
        self.append(value)
        self._item_places.append(place)


def file_source(path: Path, max_bytes: int = MAX_BYTES) -> Source:
    """The text of a YAML file.

    Raises:
        UnreadableFile: there is no such file, it is too large, or it is not UTF-8 text.
    """
    try:
        with path.open("rb") as file:
            content = file.read(max_bytes + 1)
        if len(content) > max_bytes:
            raise UnreadableFile(path, f"larger than {max_bytes >> 10:,} KiB")
        return Source(str(path), content.decode("utf-8-sig"), path)
    except UnicodeDecodeError as error:
        raise UnreadableFile(path, f"not UTF-8 text (byte {error.start} is 0x{content[error.start]:02x})") from None
    except (OSError, ValueError) as error:
        raise UnreadableFile(path, getattr(error, "strerror", None) or str(error)) from None


def parse(source: Source) -> tuple[Any, list[Problem]]:
    """The tree of a YAML text (`Map`, `Seq` and scalars), and the duplicate keys found in it.

    Raises:
        DocumentError: the text is not YAML, or nested too deeply.
    """
    builder = _Builder(source)
    try:
        for event in yaml.parse(source.text, Loader=_Loader):
            builder.take(event)
    except yaml.MarkedYAMLError as error:
        raise DocumentError([_not_yaml(error, source)]) from None
    except UnicodeEncodeError as error:
        reason = "not text: a lone surrogate " + repr(source.text[error.start : error.start + 1])
        raise DocumentError([Problem(reason, source.start)]) from None
    except yaml.YAMLError as error:
        raise DocumentError([Problem(f"not YAML: {str(error).splitlines()[0]}", source.start)]) from None
    return builder.root, builder.problems


def place_inside(tree: Any, keys: Sequence[str | int]) -> Place | None:
    """Where the value stands that keys of mappings and lists lead to, as far as they do; None if they lead nowhere."""
    place = None
    for key in keys:
        if isinstance(tree, Map) and key in tree:
            place, tree = tree.value_place(str(key)), tree[str(key)]
        elif isinstance(tree, Seq) and isinstance(key, int) and key < len(tree):
            place, tree = tree.item_place(key), tree[key]
    return place


def plain(value: Any) -> Any:
    """A value of the tree as ordinary dicts and lists: what operators get, with the keys of a caller's own."""
    if isinstance(value, Map):
        return {key: plain(item) for key, item in value.items()}
    return [plain(item) for item in value] if isinstance(value, Seq) else value


_Loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


@dataclass(slots=True)
class _Open:
    """A mapping or sequence being read.

    `key` awaits its value. `size` counts the values so far, aliases expanded, and `height` the levels below this one.
    """

    value: Map | Seq
    anchor: str | None
    key: tuple[str, Place] | None = None
    size: int = 1
    height: int = 0

    @property
    def awaits_key(self) -> bool:
        return self.key is None and isinstance(self.value, Map)


class _Builder:
    """Builds the tree event by event, without recursion."""

    def __init__(self, source: Source) -> None:
        self.root: Any = None
        self.problems: list[Problem] = []
        self._source = source
        self._open: list[_Open] = []
        self._anchors: dict[str, tuple[Any, int, int]] = {}
        self._aliased = 0
        self._documents = 0
        self._takes = {
            yaml.ScalarEvent: self._scalar,
            yaml.MappingStartEvent: self._start,
            yaml.SequenceStartEvent: self._start,
            yaml.MappingEndEvent: self._end,
            yaml.SequenceEndEvent: self._end,
            yaml.AliasEvent: self._alias,
            yaml.DocumentStartEvent: self._document,
        }

    def take(self, event: Any) -> None:
        take = self._takes.get(type(event))
        if take is not None:
            take(event, Place(self._source, event.start_mark.line + 1, event.start_mark.column + 1))

    def _scalar(self, event: Any, place: Place) -> None:
        self._check_tag(event, place)
        value: Any = event.value
        if event.style in (None, "") and not self._awaits_key():
            value = scalar(value)
        self._put(value, place, event.anchor, 1, 0)

    def _start(self, event: Any, place: Place) -> None:
        self._check_tag(event, place)
        if self._awaits_key():
            self._fail("a key must be a plain word", place)
        if len(self._open) >= MAX_DEPTH:
            self._fail(f"nested deeper than {MAX_DEPTH} levels", place)
        value = Map(place) if type(event) is yaml.MappingStartEvent else Seq(place)
        self._open.append(_Open(value, event.anchor))

    def _end(self, event: Any, place: Place) -> None:
        done = self._open.pop()
        if isinstance(done.value, Map) and "<<" in done.value:
            self._merge(done.value)
        self._put(done.value, done.value.place, done.anchor, done.size, done.height + 1)

    def _alias(self, event: Any, place: Place) -> None:
        if self._awaits_key():
            self._fail("a key must be a plain word", place)
        if event.anchor not in self._anchors:
            self._fail(f"unknown anchor {event.anchor!r} (an anchor cannot contain itself)", place)
        value, size, height = self._anchors[event.anchor]
        self._aliased += size
        if self._aliased > MAX_ALIASED_VALUES:
            self._fail(f"aliases expand to more than {MAX_ALIASED_VALUES:,} values", place)
        if len(self._open) + height > MAX_DEPTH:
            self._fail(f"aliases nest deeper than {MAX_DEPTH} levels", place)
        self._put(value, place, None, size, height)

    def _document(self, event: Any, place: Place) -> None:
        self._documents += 1
        if self._documents > 1:
            self._fail("a file holds one YAML document", place)

    def _awaits_key(self) -> bool:
        return bool(self._open) and self._open[-1].awaits_key

    def _put(self, value: Any, place: Place, anchor: str | None, size: int, height: int) -> None:
        """Put a finished value where it belongs: at the root, into a sequence, or into a mapping as key or value."""
        if anchor is not None:
            self._anchors[anchor] = (value, size, height)
        if not self._open:
            self.root = value
            return
        parent = self._open[-1]
        parent.size += size
        parent.height = max(parent.height, height)
        if isinstance(parent.value, Seq):
            parent.value.put(value, place)
        elif parent.key is None:
            parent.key = (value, place)
        else:
            (key, key_place), parent.key = parent.key, None
            if key in parent.value:
                message = f"{key!r} stands twice; the first is at line {parent.value.key_place(key).line}"
                self.problems.append(Problem(message, key_place))
            else:
                parent.value.put(key, value, key_place, place)

    def _merge(self, mapping: Map) -> None:
        """`<<: *base`: what another mapping holds, or several, and this one does not say itself (as in YAML 1.1)."""
        place, merged = mapping.key_place("<<"), mapping.pop("<<")
        for base in merged if isinstance(merged, Seq) else [merged]:
            if not isinstance(base, Map):
                self.problems.append(Problem("'<<' takes a mapping, or a list of mappings", place))
                continue
            for key, value in base.items():
                if key not in mapping:
                    mapping.put(key, value, base.key_place(key), base.value_place(key))

    def _check_tag(self, event: Any, place: Place) -> None:
        if event.tag is not None and event.tag != "!":
            self._fail(f"tags ({event.tag}) have no meaning here; remove it", place)

    def _fail(self, message: str, place: Place) -> NoReturn:
        raise DocumentError([Problem(message, place)])


def _not_yaml(error: yaml.MarkedYAMLError, source: Source) -> Problem:
    mark = error.problem_mark or error.context_mark
    if mark is None:
        return Problem(f"not YAML: {error.problem}", source.start)
    line = source.lines[mark.line] if mark.line < len(source.lines) else ""
    if line[: mark.column + 1].isspace() and "\t" in line[: mark.column + 1]:
        reason = "indented by a tab; YAML is indented by spaces"
    else:
        reason = ", ".join(part for part in (error.problem, error.context) if part)
    return Problem(f"not YAML: {reason}", Place(source, mark.line + 1, mark.column + 1))
