"""A graph as pixels, drawn with Pillow: the look of the SVG on light paper, without a browser."""

from __future__ import annotations

from base64 import b64decode
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from io import BytesIO
from itertools import pairwise
from math import hypot, sqrt
from typing import TYPE_CHECKING

from graphface.graph.wired import WiredGraph
from graphface.report.drawing.boxes import Lane, Layout, Rect
from graphface.report.drawing.curve import curved
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
from graphface.report.drawing.palette import LIGHT, family_color, family_tint, heat_color, hue

if TYPE_CHECKING:
    from PIL import Image, ImageFont

_SCALE, _MOST_PIXELS = 2.0, 48e6
_DOT, _WIRE, _DASH, _STRIPE = 3.0, 1.4, 4.0, 4.0


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
    pen = _Pen(placed.width, placed.height, scale)
    for frame, rect in placed.frames.items():
        pen.box(rect, LIGHT.frame, LIGHT.frame_edge)
        pen.text(rect.x + INSET, rect.y + 20, frame.rpartition("/")[2], rect.width - 2 * INSET, 12, LIGHT.ink, bold=True)
    for cord, lanes in zip(drawn.cords, placed.wires, strict=True):
        pen.wire(lanes, _faded(LIGHT.wire) if cord.dimmed else LIGHT.wire, dashed=cord.into.lazy)
    for node in drawn.nodes:
        _node(pen, node, placed.boxes[node.name])
    return pen.picture


class _Pen:
    """Draws in the layout's coordinates."""

    def __init__(self, width: float, height: float, scale: float) -> None:
        from PIL import Image, ImageDraw

        self.scale = scale
        self.picture = Image.new("RGB", (max(1, round(width * scale)), max(1, round(height * scale))), LIGHT.paper)
        self._draw = ImageDraw.Draw(self.picture)

    def box(
        self, rect: Rect, fill: str | None, edge: str | None, thick: float = 1.0, radius: float = 6.0, round_at: str = "lrtb"
    ) -> None:
        """A rectangle, its corners round where both sides that meet there are named: left, right, top, bottom."""
        s = self.scale
        sides = (rect.x * s, rect.y * s, rect.right * s, rect.bottom * s)
        corners = tuple(set(corner) <= set(round_at) for corner in ("lt", "rt", "rb", "lb"))
        self._draw.rounded_rectangle(sides, radius * s, fill, edge, max(1, round(thick * s)), corners=corners)  # type: ignore[arg-type]

    def dot(self, x: float, y: float, fill: str, edge: str) -> None:
        s = self.scale
        around = ((x - _DOT) * s, (y - _DOT) * s, (x + _DOT) * s, (y + _DOT) * s)
        self._draw.ellipse(around, fill, edge, max(1, round(s / 2)))

    def wire(self, lanes: Sequence[Lane], color: str, *, dashed: bool) -> None:
        thick = max(1, round(_WIRE * self.scale))
        points = [(x * self.scale, y * self.scale) for x, y in _points(lanes)]
        for piece in _dashes(points, _DASH * self.scale) if dashed else [points]:
            self._draw.line(piece, color, thick, joint="curve")

    def text(
        self, x: float, y: float, text: str, room: float, size: float, color: str, *, bold: bool = False, end: bool = False
    ) -> float:
        """Write on a baseline, cut to `room`; how much of it the text takes."""
        font = _font(max(4, round(size * self.scale)))
        text = _cut(" ".join(text.split()), font, room * self.scale)
        long = font.getlength(text)
        left = x * self.scale - (long if end else 0)
        for shift in (0.0, 0.4 * self.scale) if bold else (0.0,):
            self._draw.text((left + shift, y * self.scale), text, color, font, anchor="ls")
        return long / self.scale

    def paste(self, uri: str, rect: Rect) -> None:
        """A thumbnail, as large as it fits; none where it cannot be read."""
        from PIL import Image, UnidentifiedImageError

        size = max(1, round(rect.width * self.scale)), max(1, round(rect.height * self.scale))
        try:
            with Image.open(BytesIO(b64decode(uri.partition(",")[2]))) as read:
                small = read.convert("RGB")
        except (OSError, ValueError, UnidentifiedImageError):
            return
        share = min(size[0] / small.width, size[1] / small.height)
        small = small.resize((max(1, round(small.width * share)), max(1, round(small.height * share))))
        left = rect.x * self.scale + (size[0] - small.width) / 2
        self.picture.paste(small, (round(left), round(rect.y * self.scale)))


def _node(pen: _Pen, node: Node, rect: Rect) -> None:
    dimmed = node.mark is not None and node.mark.dimmed
    ink, muted = (_faded(LIGHT.ink), _faded(LIGHT.muted)) if dimmed else (LIGHT.ink, LIGHT.muted)
    tint = family_tint(hue(node.family), "light") if node.family else LIGHT.given
    color = family_color(hue(node.family), "light") if node.family else LIGHT.muted
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


def _port(pen: _Pen, port: Port, x: float, top: float) -> None:
    fill, edge = (LIGHT.wire, LIGHT.box) if port.wired else (LIGHT.box, LIGHT.wire)
    pen.dot(x, top + port.y, fill, edge)


def _below(pen: _Pen, node: Node, rect: Rect) -> None:
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


def _points(lanes: Sequence[Lane], steps: int = 14) -> list[tuple[float, float]]:
    """A wire's curve as a line of points."""
    start, parts = curved(lanes)
    points = [start]
    for part in parts:
        if len(part) == 2:
            points.append(part)
            continue
        (ax, ay), (bx, by), (cx, cy), (dx, dy) = points[-1], *part
        for step in range(1, steps + 1):
            t = step / steps
            u = 1 - t
            a, b, c, d = u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t
            points.append((a * ax + b * bx + c * cx + d * dx, a * ay + b * by + c * cy + d * dy))
    return points


def _dashes(points: Sequence[tuple[float, float]], long: float) -> Iterator[list[tuple[float, float]]]:
    """Every other piece of a line of points, each about so long."""
    piece, left, shown = [points[0]], long, True
    for (ax, ay), (bx, by) in pairwise(points):
        length, done = hypot(bx - ax, by - ay), 0.0
        while length - done > left:
            done += left
            at = ax + (bx - ax) * done / length, ay + (by - ay) * done / length
            if shown:
                yield [*piece, at]
            piece, left, shown = [at], long, not shown
        left -= length - done
        piece.append((bx, by))
    if shown and len(piece) > 1:
        yield piece


def _cut(text: str, font: ImageFont.FreeTypeFont | ImageFont.ImageFont, room: float) -> str:
    if font.getlength(text) <= room:
        return text
    while text and font.getlength(text + "...") > room:
        text = text[:-1]
    return text.rstrip() + "..." if text else ""


def _faded(color: str) -> str:
    """Half way to the paper."""
    parts = [(int(color[i : i + 2], 16) + int(LIGHT.paper[i : i + 2], 16) + 1) // 2 for i in (1, 3, 5)]
    return "#" + "".join(f"{part:02x}" for part in parts)


@cache
def _font(size: int) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    from PIL import ImageFont

    return ImageFont.load_default(size)
