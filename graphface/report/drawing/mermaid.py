"""A graph as Mermaid text, which Markdown viewers draw: nested graphs are subgraphs, lazy wires dashed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from graphface.graph.wired import WiredGraph
from graphface.report.drawing.figure import Node, figure
from graphface.report.drawing.frames import Tree, tree_of
from graphface.report.drawing.marks import Mark
from graphface.report.drawing.palette import family_tint


def draw_mermaid(graph: WiredGraph, *, marks: Mapping[str, Mark] = {}) -> str:
    """The flowchart. Boxes are numbered there: no name can be taken for a word of the language."""
    drawn = figure(graph, marks)
    number = {node.name: f"n{place}" for place, node in enumerate(drawn.nodes)}
    frames = iter(range(len(drawn.nodes)))
    lines = ["flowchart LR", *_tree(tree_of(drawn.nodes), number, frames)]
    joined: dict[tuple[str, str], bool] = {}
    for cord in drawn.cords:
        ends = number[cord.source.name], number[cord.target.name]
        joined[ends] = joined.get(ends, True) and cord.into.lazy
    lines += [f"  {source} {'-.->' if lazy else '-->'} {target}" for (source, target), lazy in joined.items()]
    lines += _classes(drawn.nodes, number)
    return "\n".join(lines) + "\n"


def quoted(text: str) -> str:
    """Text in quotes; all but letters, digits and a few signs as Mermaid's character codes."""
    text = " ".join(text.split())
    return '"' + "".join(c if c.isalnum() or c in " _.,:/()|-" else f"#{ord(c)};" for c in text) + '"'


def _tree(tree: Tree, number: Mapping[str, str], frames: Iterator[int]) -> Iterator[str]:
    """Lines of boxes inside their frames."""
    for depth, item in tree.walk():
        indent = "  " * (depth + 1)
        if item is None:
            yield f"{indent}end"
        elif isinstance(item, str):
            yield f"{indent}subgraph f{next(frames)}[{quoted(item.rpartition('/')[2])}]"
        else:
            opens, closes = ("([", "])") if item.hue is None else ("[", "]")
            yield f"{indent}{number[item.name]}{opens}{_label(item)}{closes}"


def _label(node: Node) -> str:
    lines = [node.title, node.operator, *(f"output {name}" for name in node.results)]
    if node.mark is not None and node.mark.words:
        lines.append(node.mark.words)
    return '"' + "<br/>".join(quoted(line)[1:-1] for line in lines) + '"'


def _classes(nodes: Sequence[Node], number: Mapping[str, str]) -> Iterator[str]:
    families: dict[int, list[str]] = {}
    for node in nodes:
        if node.hue is not None:
            families.setdefault(node.hue, []).append(number[node.name])
    for degrees, names in sorted(families.items()):
        yield f"  classDef hue{degrees} fill:{family_tint(degrees, 'light')},color:#1d2126,stroke:#8b95a3"
        yield f"  class {','.join(names)} hue{degrees}"
    dimmed = [number[n.name] for n in nodes if n.mark is not None and n.mark.dimmed]
    if dimmed:
        yield "  classDef dimmed stroke-dasharray:4 3,opacity:0.5"
        yield f"  class {','.join(dimmed)} dimmed"
