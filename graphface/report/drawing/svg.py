"""A graph as SVG text: one that stands alone, or inside a page.

Nodes are `<g class="node" data-node="face/mesh">`, frames `<g class="frame" data-frame="face">`, wires `<path
class="wire" data-from="..." data-to="...">`. Colors follow `prefers-color-scheme`. Everything that comes from a graph
file passes `escape`; no other text is put together from it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from html import escape as html_escape

from graphface.graph.wired import WiredGraph
from graphface.report.drawing.boxes import Layout, Rect
from graphface.report.drawing.curve import path
from graphface.report.drawing.figure import (
    BAR,
    FOLDED,
    INSET,
    LINE,
    PORT_SIZE,
    TEXT_SIZE,
    THUMBNAIL,
    TITLE_SIZE,
    Cord,
    Figure,
    Node,
    Port,
    figure,
)
from graphface.report.drawing.layout import layout
from graphface.report.drawing.marks import Mark
from graphface.report.drawing.palette import heat_color
from graphface.report.drawing.style import style
from graphface.report.drawing.text_width import fitted, text_width

FRAME_SIZE = 12.0


def draw_svg(
    graph: WiredGraph,
    *,
    marks: Mapping[str, Mark] = {},
    thumbnails: Mapping[str, str] = {},
    folded: Collection[str] = (),
) -> str:
    """The drawing as an `<svg>` element with its style in it.

    Args:
        marks: what to say about inputs and nodes, by name.
        thumbnails: pictures of their values, `data:image/...` URIs by name; others are left out.
        folded: frames to draw as one box, by path.
    """
    drawn = figure(graph, marks, thumbnails)
    placed = layout(drawn.boxes, drawn.wires, dict.fromkeys(folded, FOLDED))
    return svg_of(drawn, placed, graph.name)


def svg_of(drawn: Figure, placed: Layout, name: str) -> str:
    """The same of a figure that has its places already."""
    width, height = placed.width, placed.height
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" class="graphface-drawing" viewBox="0 0 {width:g} {height:g}" '
        f'width="{width:g}" height="{height:g}" role="img" aria-label="{escape(name)}">',
        f"<style>{style({node.hue for node in drawn.nodes if node.hue is not None})}</style>",
        f'<rect class="paper" width="{width:g}" height="{height:g}"/>',
        *(_frame(frame, rect, frame in placed.folded, drawn) for frame, rect in placed.frames.items()),
        '<g class="wires">',
        *(_wire(cord, placed, number) for number, cord in enumerate(drawn.cords) if placed.wires[number]),
        "</g>",
        *(line for node in drawn.nodes if node.name in placed.boxes for line in _node(node, placed.boxes[node.name])),
        "</svg>",
    ]
    return "\n".join(parts)


def escape(text: str) -> str:
    """Text for an element or an attribute; characters that no XML may hold become the replacement character."""
    return html_escape("".join(c if _allowed(c) else "\ufffd" for c in text))


def _allowed(character: str) -> bool:
    number = ord(character)
    return character in "\t\n\r" or (number >= 32 and not 0xD800 <= number < 0xE000 and number & 0xFFFE != 0xFFFE)


def _frame(frame: str, rect: Rect, is_folded: bool, drawn: Figure) -> str:
    inside = sum(node.name.startswith(f"{frame}/") for node in drawn.nodes)
    title = fitted(frame.rpartition("/")[2], rect.width - 2 * INSET, FRAME_SIZE, bold=True)
    return (
        f'<g class="frame{" folded" if is_folded else ""}" data-frame="{escape(frame)}" '
        f'transform="translate({rect.x:g} {rect.y:g})"><title>{escape(frame)}: {inside} boxes</title>'
        f'<rect width="{rect.width:g}" height="{rect.height:g}" rx="8"/>'
        f'<text class="name" x="{INSET:g}" y="20">{escape(title)}</text>'
        f'<text class="count" x="{INSET:g}" y="40">{inside} boxes</text></g>'
    )


def _wire(cord: Cord, placed: Layout, number: int) -> str:
    kind = "wire lazy" if cord.into.lazy else "wire"
    if cord.dimmed:
        kind += " dimmed"
    if number in placed.back:
        kind += " back"
    return (
        f'<path class="{kind}" data-from="{escape(cord.source.name)}" data-to="{escape(cord.target.name)}" '
        f'd="{path(placed.wires[number])}"><title>{escape(cord.tooltip)}</title></path>'
    )


def _node(node: Node, rect: Rect) -> Iterator[str]:
    width, height = rect.width, rect.height
    yield (
        f'<g class="{_classes(node)}" data-node="{escape(node.name)}" tabindex="0" '
        f'transform="translate({rect.x:g} {rect.y:g})"><title>{escape(_tooltip(node))}</title>'
        f'<rect class="box" width="{width:g}" height="{height:g}" rx="6"/>'
        f'<path class="band" d="M0 6a6 6 0 0 1 6 -6H{width - 6:g}a6 6 0 0 1 6 6V36H0Z"/>'
        f'<path class="stripe" d="M6 0A6 6 0 0 0 0 6V{height - 6:g}A6 6 0 0 0 4 {height - 0.35:g}V0.35Z"/>'
        f'<rect class="edge" width="{width:g}" height="{height:g}" rx="6"/>'
    )
    yield _text("name", INSET, 17, node.title, width - 2 * INSET, TITLE_SIZE, bold=True)
    yield _text("operator", INSET, 31, node.operator, width - 2 * INSET, TEXT_SIZE)
    for number in range(max(len(node.inputs), len(node.outputs))):
        left = node.inputs[number] if number < len(node.inputs) else None
        right = node.outputs[number] if number < len(node.outputs) else None
        yield from _ports(left, right, width)
    yield from _below(node, width)
    yield "</g>"


def _classes(node: Node) -> str:
    words = ["node", f"hue-{node.hue}" if node.hue is not None else "input"]
    if node.results:
        words.append("result")
    if node.mark is not None and node.mark.state:
        words.append(node.mark.state)
    if node.mark is not None and node.mark.dimmed:
        words.append("dimmed")
    return " ".join(words)


def _tooltip(node: Node) -> str:
    mark = node.mark.words if node.mark is not None else ""
    lines = [node.name, node.operator, node.doc, *(f"output {name}" for name in node.results), mark]
    return "\n".join(line for line in lines if line)


def _ports(left: Port | None, right: Port | None, width: float) -> Iterator[str]:
    """One row: an input on the left side, an output on the right."""
    space = width - 2 * INSET - (12 if left is not None and right is not None else 0)
    of_left = fitted(left.text, space, PORT_SIZE) if left is not None else ""
    if left is not None and right is not None:
        of_left = fitted(left.text, max(space / 2, space - text_width(right.text, PORT_SIZE)), PORT_SIZE)
    if left is not None:
        yield _dot(left, 0.0)
        yield f'<text class="port" x="{INSET:g}" y="{left.y + 3.7:g}">{escape(of_left)}</text>'
    if right is not None:
        of_right = fitted(right.text, space - text_width(of_left, PORT_SIZE), PORT_SIZE)
        yield _dot(right, width)
        yield f'<text class="port out" x="{width - INSET:g}" y="{right.y + 3.7:g}">{escape(of_right)}</text>'


def _dot(port: Port, x: float) -> str:
    kind = "dot" if port.wired else "dot free"
    return f'<circle class="{kind}" cx="{x:g}" cy="{port.y:g}" r="3.5"><title>{escape(port.tooltip)}</title></circle>'


def _below(node: Node, width: float) -> Iterator[str]:
    """Under the ports: thumbnail, declared outputs, what the mark says, heat."""
    y, space = node.below_ports + 2, width - 2 * INSET
    if node.thumbnail:
        if node.thumbnail.startswith("data:image/"):
            yield (
                f'<image x="{INSET:g}" y="{y + 2:g}" width="{space:g}" height="{THUMBNAIL:g}" '
                f'href="{escape(node.thumbnail)}"/>'
            )
        y += THUMBNAIL + 6
    if node.results:
        yield _text("output", INSET, y + 11, f"▸ {', '.join(node.results)}", space, TEXT_SIZE, bold=True)
        y += LINE
    mark = node.mark
    for line in node.words:
        yield _text("reason", INSET, y + 11, line, space, PORT_SIZE)
        y += LINE
    if mark is not None and mark.heat is not None:
        share = min(max(mark.heat, 0.0), 1.0)
        yield (
            f'<rect class="cold" x="{INSET:g}" y="{y + 1:g}" width="{space:g}" height="{BAR - 2:g}" rx="2"/>'
            f'<rect class="heat" x="{INSET:g}" y="{y + 1:g}" width="{space * share:.1f}" height="{BAR - 2:g}" rx="2" '
            f'fill="{heat_color(share)}"/>'
        )


def _text(kind: str, x: float, y: float, text: str, space: float, size: float, *, bold: bool = False) -> str:
    """A line of text that is cut where it would run out of its box."""
    return f'<text class="{kind}" x="{x:g}" y="{y:g}">{escape(fitted(text, space, size, bold=bold))}</text>'
