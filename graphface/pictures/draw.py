"""Which drawing a value gets."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from graphface.pictures.arrays import draw_array
from graphface.pictures.card import draw_text
from graphface.pictures.grid import MOST, Cell, draw_grid
from graphface.pictures.plots import draw_numbers
from graphface.registry import Registry
from graphface.values.frozen import describe
from graphface.values.parts import Named, rule_of
from graphface.values.picture import Picture, View
from graphface.values.port_types import ANY, ArrayType, Atom, ListOf, PortType, port_type

ALONE = View()
_DEPTH = 3
"""Records in records are drawn so deep; beyond that they are described in words."""


def draw(value: Any, declared: PortType, registry: Registry, view: View = ALONE) -> Picture:
    """The picture of a value.

    Args:
        declared: the type of its port, which says what an array means.
        registry: where drawings are found.

    Never fails and never gives an empty picture: where a drawing raises, the picture says so in words.
    """
    with np.errstate(all="ignore"):
        return _drawn(value, declared, registry, view, _DEPTH)


def _drawn(value: Any, declared: PortType, registry: Registry, view: View, depth: int) -> Picture:
    try:
        for kind in _kinds(value, declared):
            drawing = registry.draw(kind)
            if drawing is not None:
                return _checked(drawing(value, view))
        return _by_engine(value, declared, registry, view, depth)
    except Exception as error:
        return draw_text(f"no picture: {type(error).__name__}: {error}\n\n{_words(value)}", view)


def _by_engine(value: Any, declared: PortType, registry: Registry, view: View, depth: int) -> Picture:
    """Numbers, texts, arrays, lists, mappings and records; anything else in words."""
    if value is None:
        return draw_text("nothing", view)
    if isinstance(value, np.ndarray):
        return draw_array(value, view)
    if isinstance(value, str):
        return draw_text(value or "empty text", view)
    rule = rule_of(type(value))
    if rule is None or not depth or isinstance(value, set | frozenset):
        return draw_text(_words(value), view)
    parts = list(rule.items(value))
    if not parts:
        return draw_text(f"empty {type(value).__name__}", view)
    named = not isinstance(value, list | tuple)
    if all(_is_number(part) for _, part in parts) and (len(parts) > 3 or not named):
        labels = [str(label) for label, _ in parts] if named else ()
        return draw_numbers([float(part) for _, part in parts], view, labels)
    types = _types(value, declared, rule)
    view = replace(view, above=_within([part for _, part in parts], view.above))

    def drawing(label: Any, part: Any) -> Callable[[View], Picture]:
        return lambda inner: _drawn(part, types(label), registry, inner, depth - 1)

    return _tiles(parts, drawing, view, named=named)


def _tiles(
    parts: Sequence[tuple[Any, Any]],
    drawing: Callable[[Any, Any], Callable[[View], Picture]],
    view: View,
    *,
    named: bool,
) -> Picture:
    """A tile for each part; of named parts the short ones are lines of one tile."""
    short = [(label, part) for label, part in parts if named and _is_short(part)]
    cells: list[Cell] = [(str(label), drawing(label, part)) for label, part in parts if not (named and _is_short(part))]
    lines = "\n".join(f"{label}: {_words(part)}" for label, part in short)
    if not cells:
        return draw_text(lines, view)
    if lines:
        cells.insert(min(len(cells), MOST - 2), ("", lambda inner: draw_text(lines, inner)))
    return draw_grid(cells, view)


def _within(parts: list[Any], above: Callable[[Atom], Any]) -> Callable[[Atom], Any]:
    """As `above`, with the other parts of the same record before what that was made from."""

    def nearest(kind: Atom) -> Any:
        own = (part for part in parts if isinstance(kind, type) and isinstance(part, kind))
        found = next(own, None)
        return above(kind) if found is None else found

    return nearest


def _types(value: Any, declared: PortType, rule: Any) -> Callable[[Any], PortType]:
    """From the label of a part to its declared type, as far as there is one."""
    if isinstance(rule, Named):
        hints = rule.annotations(type(value))
        return lambda label: _port_type(hints[label]) if label in hints else ANY
    item = next((atom.item for atom in declared.alternatives if isinstance(atom, ListOf)), ANY)
    return lambda label: item


def _port_type(annotation: Any) -> PortType:
    try:
        return port_type(annotation)
    except TypeError:
        return ANY


def _kinds(value: Any, declared: PortType = ANY) -> Iterable[Atom]:
    """The array type that the port declares and that the value is of, then its class."""
    arrays: list[Atom] = [a for a in declared.alternatives if isinstance(a, ArrayType) and a.problem(value) is None]
    return [*arrays, type(value)]


def _checked(picture: Picture) -> Picture:
    """A picture that can be shown.

    Raises:
        ValueError: it cannot.
    """
    pixels = picture.pixels
    if pixels.dtype != np.uint8 or pixels.ndim != 3 or pixels.shape[2] != 3 or not pixels.size:
        raise ValueError(f"expected uint8 H x W x 3, the drawing gave {pixels.dtype}{list(pixels.shape)}")
    return picture


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float | np.number) and not isinstance(value, bool)


def _is_short(value: Any) -> bool:
    """Whether a part is told in a line rather than drawn."""
    if isinstance(value, str | bytes):
        return len(value) <= 60
    if isinstance(value, tuple | list):
        return len(value) <= 4 and all(_is_number(part) for part in value)
    return value is None or (rule_of(type(value)) is None and not isinstance(value, np.ndarray))


def _words(value: Any) -> str:
    try:
        if isinstance(value, bytes):
            return f"{len(value)} bytes"
        return f"{value:.6g}" if isinstance(value, float) else describe(value)
    except Exception as error:
        return f"a {type(value).__name__} that cannot describe itself ({type(error).__name__})"
