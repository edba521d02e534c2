"""Boxes in the frames that their names say."""

from graphface import Registry, load
from graphface.report.drawing.figure import Node, figure
from graphface.report.drawing.frames import tree_of

TEXT = """graphface: 1
inputs: {x: float}
nodes: {f/g/a: {use: toy.add, in: {a: x}}, f/b: {use: toy.add, in: {a: x}}, c: {use: toy.add, in: {a: x}}}
"""


def test_walk(registry: Registry) -> None:
    """A frame opens, holds its boxes and frames, and closes."""
    walked = [
        (depth, item.name if isinstance(item, Node) else item)
        for depth, item in tree_of(figure(load(TEXT, registry=registry)).nodes).walk()
    ]
    opened = [item for _, item in walked if item is not None and item.endswith(("f", "g"))]
    assert opened == ["f", "f/g"]
    assert walked.count((1, None)) == 1
    assert (2, "f/g/a") in walked
    assert (1, "f/b") in walked
    assert (0, "c") in walked
