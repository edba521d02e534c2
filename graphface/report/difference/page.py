"""The page of a comparison: the nodes that differ, in order, and both pictures of each under one viewer."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from importlib.resources import files
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from graphface.errors import GraphfaceError
from graphface.graph.request import Request
from graphface.graph.structure import field_type
from graphface.pictures import draw
from graphface.report.blobs import Blobs
from graphface.report.compare.embed import layer, message, page, texts
from graphface.report.compare.mask import as_png, differing
from graphface.report.difference.found import Differences
from graphface.report.difference.node import NodeDifference
from graphface.report.difference.side import Side
from graphface.report.difference.values import PartDifference
from graphface.report.difference.words import cause, measured, place, short, title
from graphface.report.recorder import fields_taken
from graphface.values.frozen import arrays_in
from graphface.values.picture import View
from graphface.values.port_types import PortType
from graphface.values.writing import beside

SIZE = 512
"""Pixels of a picture's longer side. A relight of 14 differing nodes then takes about 7 MB."""
_SAME_SHAPE = 0.02
"""By which share the proportions of a picture and an array may differ so that one lies over the other."""


class Values(Protocol):
    """One side's values, and how they are drawn."""

    def value(self, name: str) -> Any: ...
    def type_of(self, name: str) -> PortType: ...
    def view(self, name: str, size: int) -> View: ...


class Compared(Protocol):
    """Two sides; the second is a run."""

    @property
    def sides(self) -> tuple[Values, Side]: ...


def write_page(
    compared: Compared, found: Differences, path: Path, *, size: int = SIZE, titles: tuple[str, str] = ("", "")
) -> None:
    """Write the page, whole or not at all.

    Args:
        titles: what the sides are, in full.

    Raises:
        UnwritableFile: the folder cannot be written to.
    """
    text = page_text(compared, found, size=size, titles=titles)
    with beside(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def page_text(compared: Compared, found: Differences, *, size: int = SIZE, titles: tuple[str, str] = ("", "")) -> str:
    """The HTML of the page."""
    drawn = _Drawn(compared, found, size)
    nodes = [drawn.node(node) for node in found.nodes]
    first = found.first
    data = {
        "sides": [{"label": label, "title": text} for label, text in zip(found.labels, titles, strict=True)],
        "summary": found.summary,
        "notes": found.notes,
        "nodes": nodes,
        "first": next((i for i, node in enumerate(found.nodes) if node is first), 0),
    }
    name = f"{compared.sides[1].request.graph.name}: differences"
    assets = files("graphface.report.difference")
    return page(
        name,
        '<div id="differences"></div><noscript>This page needs JavaScript; nothing is loaded.</noscript>',
        styles=[(assets / "page.css").read_text(encoding="utf-8")],
        scripts=[(assets / "page.js").read_text(encoding="utf-8")],
        data={"found": data, "blobs": texts(drawn.blobs)},
    )


class _Drawn:
    """Draws nodes into blobs."""

    def __init__(self, compared: Compared, found: Differences, size: int) -> None:
        self.blobs = Blobs()
        self._sides = compared.sides
        self._labels = found.labels
        self._size = size
        now: Request = compared.sides[1].request
        self._fields = {now.graph.names[slot]: fields for slot, fields in fields_taken(now).items()}
        self._registry = now.graph.registry

    def node(self, node: NodeDifference) -> dict[str, Any]:
        values = [self._value(node, side) for side in (0, 1)]
        relative = node.relative if node.parts else math.inf
        return {
            "name": node.name,
            "title": title(node),
            "kind": node.kind,
            "cause": cause(node),
            "caused": bool(node.caused),
            "above": list(dict.fromkeys(r.node for r in node.reasons if r.kind == "node above")),
            "size": None if math.isinf(relative) else relative,
            "short": _in_short(node, relative),
            "parts": [[part.path, measured(part), place(part)] for part in node.parts[:12]],
            "panels": list(self._panels(node, values)),
        }

    def _value(self, node: NodeDifference, side: int) -> Any:
        """A side's value; where there is none, the reason as a `_Missing`."""
        if node.kind == ("only here", "only there")[side]:
            return _Missing(node.words)
        try:
            return self._sides[side].value(node.name)
        except (GraphfaceError, KeyError) as error:
            return _Missing(node.words or str(error))

    def _panels(self, node: NodeDifference, values: list[Any]) -> Iterator[dict[str, Any]]:
        """The value, and those of its fields that nodes take and that differ."""
        fields = sorted(".".join(f) for f in self._fields.get(node.name, ()))
        for path in ["", *fields]:
            parts = [p for p in node.parts if not path or p.path == path or p.path.startswith((f"{path}.", f"{path}["))]
            if path and not parts:
                continue
            layers = [self._layer(node, side, path, values[side]) for side in (0, 1)]
            yield {"label": path or "value", "layers": layers, **self._marks(parts, values, layers)}

    def _layer(self, node: NodeDifference, side: int, path: str, value: Any) -> dict[str, Any]:
        label = self._labels[side]
        steps = tuple(path.split(".")) if path else ()
        for name in steps:
            value = value if isinstance(value, _Missing) else getattr(value, name, None)
        if isinstance(value, _Missing):
            return message(label, value.why)
        whole = self._sides[side].type_of(node.name)
        declared = field_type(whole, steps) or whole
        picture = draw(value, declared, self._registry, self._sides[side].view(node.name, self._size))
        if not path and self._fields.get(node.name):
            picture = replace(picture, data=None)  # its fields, which have their own pictures, have the values
        return layer(self.blobs.sheet(path, str(declared), picture), label)

    def _marks(self, parts: list[PartDifference], values: list[Any], layers: list[dict[str, Any]]) -> dict[str, Any]:
        """Where the part that differs most does so, in shares of the picture; and a mask of its pixels."""
        part = next((p for p in parts if p.box is not None), None)
        if part is None or part.box is None or any("message" in made for made in layers):
            return {}
        height, width = part.shape[:2]
        if any(abs(made["width"] * height / (made["height"] * width) - 1) > _SAME_SHAPE for made in layers):
            return {}
        left, top, wide, high = part.box
        row, column = part.position[:2]
        marks = {
            "box": [left / width, top / height, wide / width, high / height],
            "at": [(column + 0.5) / width, (row + 0.5) / height],
        }
        arrays = [_array(value, part.path) for value in values]
        if arrays[0] is None or arrays[1] is None:
            return {"marks": marks}
        mask = differing(arrays[0], arrays[1], (layers[0]["height"], layers[0]["width"]))
        return {"marks": marks} if mask is None else {"marks": marks, "mask": self.blobs.add(as_png(mask))}


class _Missing:
    """In place of a value: why there is none."""

    def __init__(self, why: str) -> None:
        self.why = why


def _in_short(node: NodeDifference, relative: float) -> str:
    """The difference in a word or a figure, for the list."""
    if node.kind != "values":
        return {"failed": "fails", "only here": "new", "only there": "gone"}[node.kind]
    part = node.parts[0]
    if part.words:
        return "shape" if part.words.startswith("shape") else "other"
    return "NaN" if math.isinf(relative) else short(part.greatest)


def _array(value: Any, path: str) -> NDArray[Any] | None:
    return next((np.asarray(array) for where, array in arrays_in(value) if where == path), None)
