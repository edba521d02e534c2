"""A graph as boxes with texts and ports."""

from graphface import Graph
from graphface.report.drawing.figure import INSET, PORT_SIZE, figure
from graphface.report.drawing.marks import Mark
from graphface.report.drawing.text_width import text_width


class TestNodes:
    def test_ports(self, graph: Graph) -> None:
        """All input ports, wired or not; of the outputs those that are taken, or the whole value."""
        nodes = {node.name: node for node in figure(graph).nodes}
        assert [(p.name, p.wired) for p in nodes["f/deep/a"].inputs] == [("a", True), ("b", True)]
        assert [(p.name, p.type) for p in nodes["p"].outputs] == [("high", "Grid | None"), ("low", "Grid")]
        assert [(p.text, p.wired) for p in nodes["f/m"].outputs] == [("float", True)]
        assert nodes["gate"].inputs[1].lazy

    def test_inputs(self, graph: Graph) -> None:
        """Inputs are boxes without a family; they say whether they have to be given."""
        said = {node.name: node.operator for node in figure(graph).nodes if node.hue is None}
        assert said == {"x": "input", "y": "input with default", "z": "optional input"}

    def test_results(self, graph: Graph) -> None:
        """A node says which outputs of the graph it is."""
        nodes = {node.name: node for node in figure(graph).nodes}
        assert nodes["gate"].results == ["total"]
        assert nodes["p"].results == ["pair"]

    def test_ports_are_inside(self, graph: Graph) -> None:
        """Every port stands at its box's side, and the texts of a row beside each other."""
        for node in figure(graph).nodes:
            assert all(0 < port.y < node.height for port in (*node.inputs, *node.outputs))
            for left, right in zip(node.inputs, node.outputs, strict=False):
                assert text_width(left.text + right.text, PORT_SIZE) <= node.width - 2 * INSET

    def test_grows(self, graph: Graph) -> None:
        """Marks and thumbnails make a box taller, a reason takes two lines at most."""
        (plain,) = (node for node in figure(graph).nodes if node.name == "g")
        drawn = figure(graph, {"g": Mark("skipped", "not needed " * 30, 0.5)}, {"g": "data:image/png,"})
        (marked,) = (node for node in drawn.nodes if node.name == "g")
        assert marked.height > plain.height + 100
        assert len(marked.words) == 2


def test_cords(graph: Graph) -> None:
    """A cord for every wire, with the ports it joins; dimmed where one end is skipped."""
    drawn = figure(graph, {"f/m": Mark("skipped", "why")})
    said = {cord.tooltip: cord.dimmed for cord in drawn.cords}
    assert said["p.low → f/m.grid (Grid)"]
    assert not said["x → f/deep/a.a (float)"]
    assert len(drawn.wires) == 6
