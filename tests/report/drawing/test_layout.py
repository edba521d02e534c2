"""The layered layout with frames."""

import pytest
from hypothesis import given, settings
from nested_boxes import Nested, check, nested

from graphface import DocumentError, load
from graphface.registry import default_registry
from graphface.report.drawing.boxes import Box, Wire
from graphface.report.drawing.figure import figure
from graphface.report.drawing.layout import layout

SHIPPED = sorted(path for folder in default_registry().graph_folders() for path in folder.glob("*.yaml"))


class TestShippedGraphs:
    @pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
    def test_nothing_overlaps(self, path: object) -> None:
        """Of every shipped graph with each of its variants and profiles: no overlap, wires from left to right."""
        plain = load(path)  # type: ignore[arg-type]
        choices = [{}, *({"variants": [v]} for v in plain.composition.variants)]
        choices += [{"profiles": [p]} for p in plain.composition.profiles]
        for choice in choices:
            try:
                loaded = load(path, **choice)  # type: ignore[arg-type]
            except DocumentError:  # a profile of the graph that this one extends, for nodes that it has no more
                continue
            drawn = figure(loaded)
            placed = layout(drawn.boxes, drawn.wires)
            check(placed, drawn.boxes, drawn.wires)
            assert not placed.back


class TestRandomGraphs:
    @given(nested())
    @settings(max_examples=300)
    def test_nothing_overlaps(self, graph: Nested) -> None:
        """Whatever is nested in what, of any size, with circles and folded frames; and the same layout each time."""
        boxes, wires, folded = graph
        placed = layout(boxes, wires, folded)
        check(placed, boxes, wires)
        assert layout(boxes, wires, folded) == placed


class TestWires:
    def test_straight(self) -> None:
        """Two boxes in a row are joined by one level line."""
        placed = layout([Box("a", 10, 40), Box("b", 10, 20)], [Wire("a", "b", 30, 5)])
        assert placed.wires == [((placed.boxes["a"].right, placed.boxes["b"].x, placed.boxes["a"].y + 30),)]

    def test_back(self) -> None:
        """A wire that closes a circle is declared as one that runs back."""
        boxes = [Box("a", 10, 10), Box("b", 10, 10)]
        placed = layout(boxes, [Wire("a", "b", 5, 5), Wire("b", "a", 5, 5)])
        assert placed.back == {1}

    def test_folded(self) -> None:
        """Wires meet a folded frame in its middle; those inside it are gone."""
        boxes = [Box("f/a", 10, 10), Box("f/g/b", 10, 10), Box("c", 10, 10)]
        wires = [Wire("f/a", "f/g/b", 5, 5), Wire("f/g/b", "c", 5, 5)]
        placed = layout(boxes, wires, {"f": (100, 50)})
        assert set(placed.boxes) == {"c"}
        assert set(placed.frames) == {"f"}
        assert placed.wires[0] == ()
        assert placed.wires[1][0][2] == placed.frames["f"].y + 25


class TestLarge:
    def test_chain(self) -> None:
        """A chain of 3,000 boxes is no deeper than the stack."""
        boxes = [Box(f"n{i}", 10, 10) for i in range(3000)]
        placed = layout(boxes, [Wire(f"n{i}", f"n{i + 1}", 5, 5) for i in range(2999)])
        assert placed.boxes["n2999"].x > placed.boxes["n2998"].right

    def test_deep(self) -> None:
        """Neither are 500 frames in each other, with a wire from the innermost out of all."""
        boxes = [Box("f/" * depth + "n", 10, 10) for depth in range(500)]
        placed = layout(boxes, [Wire(boxes[-1].name, "n", 5, 5)])
        assert len(placed.frames) == 499

    def test_nothing(self) -> None:
        """No boxes at all give an empty drawing."""
        assert layout([], []).boxes == {}
