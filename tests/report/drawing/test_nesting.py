"""Names as a tree of frames, and wires as links inside them."""

from graphface.report.drawing.boxes import Box, Wire
from graphface.report.drawing.nesting import BORDER, Nesting


def boxes(*names: str) -> list[Box]:
    return [Box(name, 10, 10) for name in names]


class TestFrames:
    def test_tree(self) -> None:
        """A frame for every folder of the paths, numbered behind the boxes; each after the one around it."""
        nesting = Nesting(boxes("f/g/a", "f/b", "c"), [], ())
        assert [frame.path for frame in nesting.frames.values()] == ["", "f", "f/g"]
        assert [frame.children for frame in nesting.frames.values()] == [[4, 2], [5, 1], [0]]

    def test_folded(self) -> None:
        """A folded frame stands for everything inside it, and no frame inside it is made."""
        nesting = Nesting(boxes("f/g/a", "f/b", "f/h/c"), [Wire("f/g/a", "f/h/c", 5, 5)], {"f"})
        assert [frame.path for frame in nesting.frames.values()] == ["", "f"]
        assert nesting.hops == [[]]

    def test_folded_inside(self) -> None:
        """What is around a folded frame stays open."""
        nesting = Nesting(boxes("f/g/a", "f/b"), [], {"f/g"})
        assert [frame.path for frame in nesting.frames.values()] == ["", "f", "f/g"]
        assert nesting.frames[3].children == [4, 1]


class TestLinks:
    def test_hops(self) -> None:
        """Out of each frame on the way, across, into each frame."""
        nesting = Nesting(boxes("f/a", "g/h/b"), [Wire("f/a", "g/h/b", 3, 4)], ())
        paths = [(nesting.frames[frame].path, link.source, link.target) for frame, link in nesting.hops[0]]
        f, g, h = (number for number, frame in nesting.frames.items() if frame.path)
        assert paths == [("f", 0, BORDER), ("", f, g), ("g", BORDER, h), ("g/h", BORDER, 1)]
        assert nesting.hops[0][-1][1].enters == 4

    def test_bundles(self) -> None:
        """Wires that leave a box at one height share what they have in common, others do not."""
        wires = [Wire("f/a", "b", 3, 1), Wire("f/a", "c", 3, 1), Wire("f/a", "c", 7, 1)]
        nesting = Nesting(boxes("f/a", "b", "c"), wires, ())
        assert nesting.bundles == [(0, 3), (0, 7)]
        inside = next(frame for frame in nesting.frames.values() if frame.path == "f")
        assert len(inside.links) == 2
