"""A graph as the boxes that are drawn: for every input and node its texts, its ports and how large it has to be."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import ceil

from graphface.graph.structure import GraphInput, Ref, Step, field_type
from graphface.graph.wired import WiredGraph
from graphface.report.drawing.boxes import Box, Wire
from graphface.report.drawing.marks import Mark
from graphface.report.drawing.palette import hue
from graphface.report.drawing.text_width import text_width, wrapped

TITLE_SIZE, TEXT_SIZE, PORT_SIZE = 13.0, 11.0, 10.5
HEADER, ROW, LINE, BAR, THUMBNAIL = 40.0, 16.0, 17.0, 6.0, 108.0
INSET = 10.0
_NARROWEST, _WITH_MORE, _WIDEST = 112.0, 150.0, 208.0
_BOTTOM = 6.0
FOLDED = (150.0, 56.0)
"""The size of a folded frame."""


@dataclass(frozen=True)
class Port:
    """A port of a box.

    Attributes:
        name: empty where it is the whole value. type: as graph files call it.
        y: below the top of the box. wired: whether anything is plugged in, or taken from it. lazy: may be declined.
    """

    name: str
    type: str
    y: float
    wired: bool
    lazy: bool = False

    @property
    def text(self) -> str:
        return self.name or self.type

    @property
    def tooltip(self) -> str:
        words = f"{self.name}: {self.type}" if self.name else self.type
        return f"{words} (lazy)" if self.lazy else words


@dataclass(frozen=True)
class Node:
    """An input or node of the graph, as it is drawn.

    Attributes:
        name: the whole path. operator: its name; of an input what kind of input it is.
        hue: of the operator's family, in degrees; None for an input. doc: the first paragraph of what it says.
        results: the declared outputs that it is, or that are fields of it.
    """

    name: str
    operator: str
    hue: int | None
    doc: str
    inputs: Sequence[Port]
    outputs: Sequence[Port]
    results: Sequence[str]
    mark: Mark | None
    thumbnail: str
    width: float
    height: float

    @property
    def title(self) -> str:
        return self.name.rpartition("/")[2]

    @property
    def words(self) -> list[str]:
        """The lines that its mark says; two where there is a reason."""
        words = self.mark.words if self.mark is not None else ""
        return wrapped(words, self.width - 2 * INSET, PORT_SIZE, 2)

    @property
    def below_ports(self) -> float:
        """Where the ports end and a thumbnail begins."""
        return HEADER + ROW * max(len(self.inputs), len(self.outputs))


@dataclass(frozen=True)
class Cord:
    """A wire with the ports that it joins."""

    source: Node
    out: Port
    target: Node
    into: Port

    @property
    def dimmed(self) -> bool:
        """Whether nothing passes it, as one of its ends is skipped."""
        return any(node.mark is not None and node.mark.dimmed for node in (self.source, self.target))

    @property
    def tooltip(self) -> str:
        field = f".{self.out.name}" if self.out.name else ""
        return f"{self.source.name}{field} → {self.target.name}.{self.into.name} ({self.out.type})"


@dataclass(frozen=True)
class Figure:
    """Everything to be drawn, without places."""

    nodes: Sequence[Node]
    cords: Sequence[Cord]

    @property
    def boxes(self) -> list[Box]:
        return [Box(node.name, node.width, node.height) for node in self.nodes]

    @property
    def wires(self) -> list[Wire]:
        return [Wire(c.source.name, c.target.name, c.out.y, c.into.y) for c in self.cords]


def figure(graph: WiredGraph, marks: Mapping[str, Mark] = {}, thumbnails: Mapping[str, str] = {}) -> Figure:
    """The boxes and wires of a graph.

    Args:
        marks, thumbnails: by the names of inputs and nodes; a thumbnail is a `data:image/...` URI.
    """
    taken = _taken(graph)
    results: dict[int, list[str]] = {}
    for name, ref in graph.outputs.items():
        results.setdefault(ref.slot, []).append(name)
    nodes: list[Node] = []
    for slot, name in enumerate(graph.names):
        step = graph.step(slot)
        outputs = _outputs(graph, slot, taken[slot])
        mark, thumbnail = marks.get(name), thumbnails.get(name, "")
        if step is None:
            nodes.append(_sized(_of_input(graph.inputs[name], outputs, results.get(slot, ()), mark, thumbnail)))
        else:
            nodes.append(_sized(_of_step(step, outputs, results.get(slot, ()), mark, thumbnail)))
    return Figure(nodes, list(_cords(graph, nodes, taken)))


def _taken(graph: WiredGraph) -> list[list[tuple[str, ...]]]:
    """For every slot which of its fields are wired or outputs of the graph, each once; () is the whole value."""
    taken: list[dict[tuple[str, ...], None]] = [{} for _ in graph.names]
    refs: Iterator[Ref] = (ref for step in graph.steps for a in step.arguments for ref in a.refs)
    for ref in (*refs, *graph.outputs.values()):
        taken[ref.slot][ref.fields] = None
    return [sorted(fields) for fields in taken]


def _outputs(graph: WiredGraph, slot: int, taken: Sequence[tuple[str, ...]]) -> list[Port]:
    step = graph.step(slot)
    base = step.operator.output if step is not None else graph.inputs[graph.input_names[slot]].type
    return [
        Port(".".join(fields), str(field_type(base, fields)), _row(number), bool(taken))
        for number, fields in enumerate(taken or [()])
    ]


def _of_input(
    given: GraphInput, outputs: Sequence[Port], results: Sequence[str], mark: Mark | None, thumbnail: str
) -> Node:
    optional = "optional input" if given.type.optional else "input"
    words = "input with default" if given.default is not None else optional
    return Node(given.name, words, None, given.doc, (), outputs, results, mark, thumbnail, 0, 0)


def _of_step(step: Step, outputs: Sequence[Port], results: Sequence[str], mark: Mark | None, thumbnail: str) -> Node:
    operator = step.operator
    plugged = {a.port for a in step.arguments if a.refs}
    inputs = [
        Port(name, str(port.type), _row(number), name in plugged, port.lazy)
        for number, (name, port) in enumerate(operator.inputs.items())
    ]
    doc = operator.doc.partition("\n\n")[0]
    return Node(step.name, operator.name, hue(operator.family), doc, inputs, outputs, results, mark, thumbnail, 0, 0)


def _row(number: int) -> float:
    return HEADER + ROW * (number + 0.5)


def _sized(node: Node) -> Node:
    """The node with the size that its texts ask for, within limits."""
    widths = [
        text_width(node.title, TITLE_SIZE, bold=True) + 2 * INSET,
        text_width(node.operator, TEXT_SIZE) + 2 * INSET,
        *(text_width(f"▸ {name}", TEXT_SIZE, bold=True) + 2 * INSET for name in node.results),
    ]
    for row in range(max(len(node.inputs), len(node.outputs))):
        texts = [ports[row].text for ports in (node.inputs, node.outputs) if row < len(ports)]
        widths.append(sum(text_width(text, PORT_SIZE) for text in texts) + 2 * INSET + 12)
    least = _WITH_MORE if node.thumbnail or (node.mark is not None and node.mark.reason) else _NARROWEST
    node = replace(node, width=float(ceil(max(least, min(max(widths), _WIDEST)))))
    height = node.below_ports + _BOTTOM
    if node.thumbnail:
        height += THUMBNAIL + _BOTTOM
    height += LINE * bool(node.results) + LINE * len(node.words)
    if node.mark is not None and node.mark.heat is not None:
        height += BAR
    return replace(node, height=height)


def _cords(graph: WiredGraph, nodes: Sequence[Node], taken: Sequence[Sequence[tuple[str, ...]]]) -> Iterator[Cord]:
    for step in graph.steps:
        node = nodes[step.slot]
        into = {port.name: port for port in node.inputs}
        for argument in step.arguments:
            for ref in argument.refs:
                out = nodes[ref.slot].outputs[taken[ref.slot].index(ref.fields)]
                yield Cord(nodes[ref.slot], out, node, into[argument.port])
