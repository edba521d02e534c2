"""The formats of drawings, by name and by what files are called."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Literal, get_args

from graphface.errors import RefusedOutput
from graphface.graph.wired import WiredGraph
from graphface.report.drawing.marks import Mark
from graphface.values.writing import beside, check_folder

Format = Literal["svg", "png", "html", "mermaid", "dot"]
FORMATS: tuple[Format, ...] = get_args(Format)
_SUFFIXES: dict[str, Format] = {
    ".svg": "svg",
    ".png": "png",
    ".html": "html",
    ".htm": "html",
    ".mmd": "mermaid",
    ".mermaid": "mermaid",
    ".dot": "dot",
    ".gv": "dot",
}


def draw(graph: WiredGraph, form: Format, marks: Mapping[str, Mark] = {}) -> bytes:
    """The drawing as a file's contents; text is UTF-8."""
    if form == "png":
        from graphface.report.drawing.png import draw_png

        return draw_png(graph, marks=marks)
    if form == "html":
        from graphface.report.drawing.html import draw_html

        return _bytes(draw_html(graph, marks=marks))
    if form == "mermaid":
        from graphface.report.drawing.mermaid import draw_mermaid

        return _bytes(draw_mermaid(graph, marks=marks))
    if form == "dot":
        from graphface.report.drawing.dot import draw_dot

        return _bytes(draw_dot(graph, marks=marks))
    from graphface.report.drawing.svg import draw_svg

    return _bytes(draw_svg(graph, marks=marks))


def write_drawing(graph: WiredGraph, path: Path, form: Format | None = None, marks: Mapping[str, Mark] = {}) -> None:
    """Write the drawing to a file, whole or not at all.

    Args:
        form: by default what the suffix says.

    Raises:
        RefusedOutput: the suffix says nothing, or the folder is missing or read-only.
        UnwritableFile: it cannot be written.
    """
    form = form or format_of(path)
    check_folder(path)
    drawn = draw(graph, form, marks)
    with beside(path) as temporary:
        temporary.write_bytes(drawn)


def format_of(path: Path) -> Format:
    """The format of a file by its suffix.

    Raises:
        RefusedOutput: no format has this suffix.
    """
    form = _SUFFIXES.get(path.suffix.lower())
    if form is None:
        raise RefusedOutput(path, f"no drawing is written as {path.suffix!r}; use {', '.join(_SUFFIXES)}")
    return form


def _bytes(text: str) -> bytes:
    return text.encode("utf-8", "replace")
