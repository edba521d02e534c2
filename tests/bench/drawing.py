"""What the layout of a drawing costs, and how many wires cross in it.

    python tests/bench/drawing.py

Shipped graphs, and random ones with frames and mostly short wires. Every box has the same size; times are CPU time of
this process, the best of three. Crossings are those of straight lines between the middles of the boxes' sides, in which
the layouts of other programs can be counted too.
"""

from __future__ import annotations

import random
import time

import numpy as np

from graphface import load
from graphface.report.drawing.boxes import Box, Layout, Wire
from graphface.report.drawing.layout import layout

WIDTH, HEIGHT = 120.0, 110.0
Names = tuple[list[str], list[tuple[str, str]]]


def shipped(name: str) -> Names:
    graph = load(name)
    refs = ((step.name, ref) for step in graph.steps for argument in step.arguments for ref in argument.refs)
    return list(graph.names), [(graph.names[ref.slot], target) for target, ref in refs]


def made(count: int) -> Names:
    """Every other forty boxes are in a frame; a box has one to three wires, from about ten boxes back."""
    chance = random.Random(0)
    names: list[str] = []
    wires: list[tuple[str, str]] = []
    for number in range(count):
        names.append(f"f{number // 40}/n{number}" if number // 40 % 2 else f"n{number}")
        for _ in range(chance.choice((1, 2, 2, 3)) if number else 0):
            wires.append((names[max(0, number - 1 - int(chance.expovariate(0.1)))], names[-1]))
    return names, wires


def measured(names: list[str], wires: list[tuple[str, str]]) -> tuple[float, Layout]:
    """Milliseconds and the layout."""
    boxes = [Box(name, WIDTH, HEIGHT) for name in names]
    cords = [Wire(source, target, HEIGHT / 2, HEIGHT / 2) for source, target in wires]
    spent = []
    for _ in range(3):
        start = time.process_time()
        placed = layout(boxes, cords)
        spent.append(time.process_time() - start)
    return min(spent) * 1e3, placed


def crossings(placed: Layout, wires: list[tuple[str, str]]) -> int:
    """Pairs of lines that cross; two from the same box, or to the same, do not count."""
    boxes = placed.boxes
    lines = np.array([(boxes[s].right, boxes[s].y + HEIGHT / 2, boxes[t].x, boxes[t].y + HEIGHT / 2) for s, t in wires])
    found = 0
    for place, (ax, ay, bx, by) in enumerate(lines):
        cx, cy, dx, dy = lines[:place].T
        apart = ((cx != ax) | (cy != ay)) & ((dx != bx) | (dy != by))

        def left(x0: object, y0: object, x1: object, y1: object, x2: object, y2: object) -> np.ndarray:
            return (y2 - y0) * (x1 - x0) > (y1 - y0) * (x2 - x0)  # type: ignore[operator,no-any-return]

        sides = left(ax, ay, cx, cy, dx, dy) != left(bx, by, cx, cy, dx, dy)
        others = left(ax, ay, bx, by, cx, cy) != left(ax, ay, bx, by, dx, dy)
        found += int((apart & sides & others).sum())
    return found


def main() -> None:
    graphs = {name: shipped(name) for name in ("represent", "relight", "transfer", "makeup")}
    graphs |= {f"made of {count}": made(count) for count in (300, 1000, 3000)}
    print(f"{'':14s} {'boxes':>6s} {'wires':>6s} {'CPU ms':>8s} {'crossings':>10s} {'size':>16s}")
    for name, (names, wires) in graphs.items():
        spent, placed = measured(names, wires)
        size = f"{placed.width:.0f} x {placed.height:.0f}"
        crossed = crossings(placed, wires)
        print(f"{name:14s} {len(names):6d} {len(wires):6d} {spent:8.1f} {crossed:10d} {size:>16s}", flush=True)


if __name__ == "__main__":
    main()
