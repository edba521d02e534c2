"""Shapes, wires and texts on a Pillow picture, in the coordinates of a layout."""

from __future__ import annotations

from base64 import b64decode
from collections.abc import Iterator, Sequence
from functools import cache
from io import BytesIO
from itertools import pairwise
from math import hypot
from typing import TYPE_CHECKING

from graphface.report.drawing.boxes import Lane, Rect
from graphface.report.drawing.curve import Point, curved

if TYPE_CHECKING:
    from PIL import ImageFont

_DOT, _WIRE, _DASH = 3.0, 1.4, 4.0


class Pen:
    """Draws in the layout's coordinates."""

    def __init__(self, paper: str, width: float, height: float, scale: float) -> None:
        from PIL import Image, ImageDraw

        self.scale = scale
        self.picture = Image.new("RGB", (max(1, round(width * scale)), max(1, round(height * scale))), paper)
        self._draw = ImageDraw.Draw(self.picture)

    def box(
        self,
        rect: Rect,
        fill: str | None,
        edge: str | None,
        thick: float = 1.0,
        radius: float = 6.0,
        round_at: str = "lrtb",
    ) -> None:
        """A rectangle, its corners round where both sides that meet there are named: left, right, top, bottom."""
        s = self.scale
        sides = (rect.x * s, rect.y * s, rect.right * s, rect.bottom * s)
        left, right, top, bottom = (side in round_at for side in "lrtb")
        corners = left and top, right and top, right and bottom, left and bottom
        bend = max(0.0, min(radius * s, (sides[2] - sides[0]) / 2 - 1, (sides[3] - sides[1]) / 2 - 1))
        self._draw.rounded_rectangle(sides, bend, fill, edge, max(1, round(thick * s)), corners=corners)

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
        self,
        x: float,
        y: float,
        text: str,
        room: float,
        size: float,
        color: str,
        *,
        bold: bool = False,
        end: bool = False,
    ) -> float:
        """Write on a baseline from x on, or up to x; cut to `room`. How much of it the text takes."""
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


def _points(lanes: Sequence[Lane], steps: int = 24) -> list[Point]:
    """A wire's curve as a line of points."""
    start, parts = curved(lanes)
    points: list[Point] = [start]
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


def _dashes(points: Sequence[Point], long: float) -> Iterator[list[Point]]:
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


@cache
def _font(size: int) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    from PIL import ImageFont

    return ImageFont.load_default(size)
