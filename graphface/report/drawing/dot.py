"""A graph in the DOT language of Graphviz: nested graphs are clusters, ports are fields of records."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from graphface.graph.wired import WiredGraph
from graphface.report.drawing.figure import Node, Port, figure
from graphface.report.drawing.frames import tree_of
from graphface.report.drawing.marks import Mark
from graphface.report.drawing.palette import family_tint


def draw_dot(graph: WiredGraph, *, marks: Mapping[str, Mark] = {}) -> str:
    """The digraph. Boxes are numbered there, names are labels only."""
    drawn = figure(graph, marks)
    number = {node.name: place for place, node in enumerate(drawn.nodes)}
    lines = [
        f"digraph {quoted(graph.name or 'graph')} {{",
        "  rankdir=LR;",
        '  node [shape=record, fontname="Helvetica", fontsize=10, style=filled, fillcolor="#eef1f5"];',
        '  graph [fontname="Helvetica", fontsize=11];',
        '  edge [arrowsize=0.6, color="#8b95a3"];',
    ]
    frames = iter(range(len(drawn.nodes)))
    for depth, item in tree_of(drawn.nodes).walk():
        indent = "  " * (depth + 1)
        if item is None:
            lines.append(f"{indent}}}")
        elif isinstance(item, str):
            lines.append(f"{indent}subgraph cluster_{next(frames)} {{ label={quoted(item.rpartition('/')[2])};")
        else:
            lines.append(f"{indent}n{number[item.name]} [{', '.join(_attributes(item))}];")
    for cord in drawn.cords:
        out, into = cord.source.outputs.index(cord.out), cord.target.inputs.index(cord.into)
        dashed = " [style=dashed]" if cord.into.lazy else ""
        lines.append(f"  n{number[cord.source.name]}:o{out} -> n{number[cord.target.name]}:i{into}{dashed};")
    return "\n".join([*lines, "}"]) + "\n"


def quoted(text: str) -> str:
    """A string of the language: one line, quotes and backslashes escaped."""
    return '"' + _line(text).replace("\\", "\\\\").replace('"', '\\"') + '"'


def _attributes(node: Node) -> Iterator[str]:
    lines = [node.title, node.operator, *(f"output {name}" for name in node.results)]
    if node.mark is not None and node.mark.words:
        lines.append(node.mark.words)
    middle = "\\n".join(_field(line) for line in lines)
    fields = [_ports("i", node.inputs), middle, _ports("o", node.outputs)]
    yield f'label="{" | ".join(f for f in fields if f)}"'
    yield f"tooltip={quoted(f'{node.name} {node.operator}')}"
    if node.hue is not None:
        yield f'fillcolor="{family_tint(node.hue, "light")}"'
    if node.mark is not None and node.mark.dimmed:
        yield 'style="filled,dashed", fontcolor="#8b95a3"'


def _ports(side: str, ports: Sequence[Port]) -> str:
    return f"{{{' | '.join(f'<{side}{place}> {_field(p.text)}' for place, p in enumerate(ports))}}}" if ports else ""


def _field(text: str) -> str:
    """Text inside a record's label."""
    return "".join(f"\\{c}" if c in '\\"{}|<>' else c for c in _line(text))


def _line(text: str) -> str:
    """One line that holds no character that a viewer may act on."""
    return " ".join("".join(c if c.isprintable() else " " for c in text).split())
