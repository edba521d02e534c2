"""A graph as pixels, drawn with Pillow: the look of the SVG on light paper, without a browser."""

from __future__ import annotations

from collections.abc import Mapping
from io import BytesIO
from math import sqrt
from typing import TYPE_CHECKING

from graphface.graph.wired import WiredGraph
from graphface.report.drawing.boxes import Layout, Rect
from graphface.report.drawing.figure import (
    BAR,
    HEADER,
    INSET,
    LINE,
    PORT_SIZE,
    TEXT_SIZE,
    THUMBNAIL,
    TITLE_SIZE,
    Figure,
    Node,
    Port,
    figure,
)
from graphface.report.drawing.layout import layout
from graphface.report.drawing.marks import Mark
from graphface.report.drawing.palette import LIGHT, family_color, family_tint, heat_color
from graphface.report.drawing.pen import Pen

if TYPE_CHECKING:
    from PIL import Image

_SCALE, _MOST_PIXELS = 2.0, 48e6
_STRIPE, _FRAME_TITLE = 4.0, 12.0


def draw_png(graph: WiredGraph, *, marks: Mapping[str, Mark] = {}, thumbnails: Mapping[str, str] = {}) -> bytes:
    """The PNG file: two pixels for each of the layout's, fewer where that would be more than 48 megapixels."""
    drawn = figure(graph, marks, thumbnails)
    placed = layout(drawn.boxes, drawn.wires)
    file = BytesIO()
    picture_of(drawn, placed).save(file, "PNG", optimize=False)
    return file.getvalue()


def picture_of(drawn: Figure, placed: Layout) -> Image.Image:
    """The drawing as an RGB picture."""
    scale = min(_SCALE, sqrt(_MOST_PIXELS / max(placed.width * placed.height, 1.0)))
    pen = Pen(LIGHT.paper, placed.width, placed.height, scale)
    for frame, rect in placed.frames.items():
        pen.box(rect, LIGHT.frame, LIGHT.frame_edge)
        title, room = frame.rpartition("/")[2], rect.width - 2 * INSET
        pen.text(rect.x + INSET, rect.y + 20, title, room, _FRAME_TITLE, LIGHT.ink, bold=True)
    for cord, lanes in zip(drawn.cords, placed.wires, strict=True):
        pen.wire(lanes, _faded(LIGHT.wire) if cord.dimmed else LIGHT.wire, dashed=cord.into.lazy)
    for node in drawn.nodes:
        _node(pen, node, placed.boxes[node.name])
    return pen.picture


def _node(pen: Pen, node: Node, rect: Rect) -> None:
    dimmed = node.mark is not None and node.mark.dimmed
    ink, muted = (_faded(LIGHT.ink), _faded(LIGHT.muted)) if dimmed else (LIGHT.ink, LIGHT.muted)
    tint = family_tint(node.hue, "light") if node.hue is not None else LIGHT.given
    color = family_color(node.hue, "light") if node.hue is not None else LIGHT.muted
    failed = node.mark is not None and node.mark.state == "failed"
    left, wide = rect.x + _STRIPE, rect.width - _STRIPE
    pen.box(rect, _faded(color) if dimmed else color, None)
    pen.box(Rect(left, rect.y, wide, rect.height), LIGHT.box, None, round_at="rtb")
    pen.box(Rect(left, rect.y, wide, HEADER - 4), _faded(tint) if dimmed else tint, None, round_at="rt")
    edge, thick = (LIGHT.accent, 2.0) if node.results else (LIGHT.edge, 1.0)
    pen.box(rect, None, LIGHT.failed if failed else edge, 3.0 if failed else thick)
    room = rect.width - 2 * INSET
    pen.text(rect.x + INSET, rect.y + 17, node.title, room, TITLE_SIZE, ink, bold=True)
    pen.text(rect.x + INSET, rect.y + 31, node.operator, room, TEXT_SIZE, muted)
    for number in range(max(len(node.inputs), len(node.outputs))):
        taken = 0.0
        if number < len(node.inputs):
            port, share = node.inputs[number], room * (0.62 if number < len(node.outputs) else 1.0)
            taken = pen.text(rect.x + INSET, rect.y + port.y + 3.7, port.text, share, PORT_SIZE, muted) + 8
            _port(pen, port, rect.x, rect.y)
        if number < len(node.outputs):
            port = node.outputs[number]
            pen.text(rect.right - INSET, rect.y + port.y + 3.7, port.text, room - taken, PORT_SIZE, muted, end=True)
            _port(pen, port, rect.right, rect.y)
    _below(pen, node, rect)


def _port(pen: Pen, port: Port, x: float, top: float) -> None:
    fill, edge = (LIGHT.wire, LIGHT.box) if port.wired else (LIGHT.box, LIGHT.wire)
    pen.dot(x, top + port.y, fill, edge)


def _below(pen: Pen, node: Node, rect: Rect) -> None:
    """Under the ports: thumbnail, declared outputs, what the mark says, heat."""
    left, room, y = rect.x + INSET, rect.width - 2 * INSET, rect.y + node.below_ports + 2
    if node.thumbnail:
        pen.paste(node.thumbnail, Rect(left, y + 2, room, THUMBNAIL))
        y += THUMBNAIL + 6
    if node.results:
        pen.text(left, y + 11, f"> {', '.join(node.results)}", room, TEXT_SIZE, LIGHT.accent, bold=True)
        y += LINE
    mark = node.mark
    for line in node.words:
        color = LIGHT.failed if mark is not None and mark.state == "failed" else LIGHT.muted
        pen.text(left, y + 11, line, room, PORT_SIZE, color)
        y += LINE
    if mark is not None and mark.heat is not None:
        share = min(max(mark.heat, 0.0), 1.0)
        pen.box(Rect(left, y + 1, room, BAR - 2), LIGHT.edge, None, radius=2)
        if share > 0:
            pen.box(Rect(left, y + 1, max(room * share, 1.0), BAR - 2), heat_color(share), None, radius=2)


def _faded(color: str) -> str:
    """Half way to the paper."""
    parts = [(int(color[i : i + 2], 16) + int(LIGHT.paper[i : i + 2], 16) + 1) // 2 for i in (1, 3, 5)]
    return "#" + "".join(f"{part:02x}" for part in parts)
