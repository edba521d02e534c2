"""Boxes with paths for names as a tree of frames, and each wire as one link in every frame that it runs through.

Boxes and frames are numbered together, the boxes first; the frame number `root` holds everything. A wire from deep in
one frame to deep in another is a link to the right border of each frame that it leaves, one link between the two
frames (or boxes) that stand side by side, and a link from the left border of each frame that it enters.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field

from graphface.report.drawing.boxes import Box, Wire

BORDER = -1
"""Stands for the left border of a frame where a link begins, for the right one where it ends."""


@dataclass(frozen=True)
class Link:
    """A wire inside one frame. `bundle` is shared by the wires that leave one box at one height.

    `source` and `target` are numbers of boxes or frames, or BORDER. `enters` counts where `target` is a box.
    """

    bundle: int
    source: int
    target: int
    enters: float


@dataclass
class Frame:
    """One frame: its boxes and frames in the order given, and its links, each once."""

    path: str
    children: list[int] = field(default_factory=list)
    links: dict[Link, None] = field(default_factory=dict)


class Nesting:
    """The tree.

    Attributes:
        frames: by number, each after the frame around it.
        parent: of every box and frame; of the root, BORDER.
        ends: source and target of every wire, as numbers; that of a folded frame for the boxes inside it.
        bundles: for every bundle its source and how far below its top it leaves.
        hops: for every wire the links that it is made of, each with its frame.
    """

    def __init__(self, boxes: Sequence[Box], wires: Sequence[Wire], folded: Collection[str]) -> None:
        self.root = len(boxes)
        self.frames = {self.root: Frame("")}
        self.parent = [BORDER] * (len(boxes) + 1)
        self.folded: set[int] = set()
        self._by_path = {"": self.root}
        self._folded_paths = folded
        shown = {box.name: self._place(number, box.name) for number, box in enumerate(boxes)}
        self.ends = [(shown[wire.source], shown[wire.target]) for wire in wires]
        self.bundles: list[tuple[int, float]] = []
        self._depth = self._depths()
        numbers: dict[tuple[int, float], int] = {}
        self.hops: list[list[tuple[int, Link]]] = []
        for wire, (source, target) in zip(wires, self.ends, strict=True):
            if source == target and source in self.folded:
                self.hops.append([])
                continue
            key = (source, 0.0 if source in self.folded else wire.leaves)
            bundle = numbers.setdefault(key, len(numbers))
            if bundle == len(self.bundles):
                self.bundles.append(key)
            self.hops.append(self._follow(bundle, source, target, wire.enters))

    def _place(self, number: int, path: str) -> int:
        """Put a box into its frames, made where they are new; the number that stands for it in the drawing."""
        above = []
        while path and path.rpartition("/")[0] not in self._by_path:
            path = path.rpartition("/")[0]
            above.append(path)
        frame = self._by_path[path.rpartition("/")[0]]
        for path in reversed(above):
            if frame in self.folded:
                self._by_path[path] = frame
            else:
                frame = self._add_frame(path, frame)
        if frame in self.folded:
            return frame
        self.parent[number] = frame
        self.frames[frame].children.append(number)
        return number

    def _add_frame(self, path: str, around: int) -> int:
        number = len(self.parent)
        self.parent.append(around)
        self.frames[around].children.append(number)
        self.frames[number] = Frame(path)
        self._by_path[path] = number
        if path in self._folded_paths:
            self.folded.add(number)
        return number

    def _depths(self) -> list[int]:
        depth = [0] * len(self.parent)
        for number, frame in self.frames.items():
            for child in frame.children:
                depth[child] = depth[number] + 1
        return depth

    def _follow(self, bundle: int, source: int, target: int, enters: float) -> list[tuple[int, Link]]:
        """The links of one wire, from its source to its target."""
        out: list[tuple[int, Link]] = []
        into: list[tuple[int, Link]] = []
        while self.parent[source] != self.parent[target]:
            if self._depth[source] >= self._depth[target]:
                frame = self.parent[source]
                out.append((frame, Link(bundle, source, BORDER, 0.0)))
                source = frame
            else:
                frame = self.parent[target]
                into.append((frame, Link(bundle, BORDER, target, self._entry(target, enters))))
                target = frame
        across = (self.parent[source], Link(bundle, source, target, self._entry(target, enters)))
        hops = [*out, across, *reversed(into)]
        for frame, link in hops:
            self.frames[frame].links[link] = None
        return hops

    def _entry(self, target: int, enters: float) -> float:
        return enters if target < self.root else 0.0
