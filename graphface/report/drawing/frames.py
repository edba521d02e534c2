"""Boxes in the frames that their names say, for languages that nest: in the order given, no recursion."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from graphface.report.drawing.figure import Node


@dataclass
class Tree:
    """A frame's boxes and frames, in the order they came."""

    path: str = ""
    children: list[Node | Tree] = field(default_factory=list)

    def walk(self) -> Iterator[tuple[int, Node | str | None]]:
        """Depth and box, or the path of a frame that opens, or None where it closes; its boxes stand between."""
        stack = [iter(self.children)]
        while stack:
            child = next(stack[-1], None)
            if child is None:
                stack.pop()
                if stack:
                    yield len(stack) - 1, None
            elif isinstance(child, Tree):
                yield len(stack) - 1, child.path
                stack.append(iter(child.children))
            else:
                yield len(stack) - 1, child


def tree_of(nodes: Sequence[Node]) -> Tree:
    """The tree of all boxes."""
    root = Tree()
    known = {"": root}
    for node in nodes:
        path, missing = node.name.rpartition("/")[0], []
        while path not in known:
            missing.append(path)
            path = path.rpartition("/")[0]
        frame = known[path]
        for path in reversed(missing):
            known[path] = Tree(path)
            frame.children.append(known[path])
            frame = known[path]
        frame.children.append(node)
    return root
