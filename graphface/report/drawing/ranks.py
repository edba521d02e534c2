"""The column of every item of one frame: links run from left to right, as few as possible the other way.

Items are numbers from 0; nothing here recurses, a chain may have any length.
"""

from __future__ import annotations

from collections.abc import Sequence

Arrow = tuple[int, int]


def backward(count: int, arrows: Sequence[Arrow]) -> set[Arrow]:
    """The arrows that close a circle when the items are walked in their order, depth first."""
    after: list[list[int]] = [[] for _ in range(count)]
    for source, target in arrows:
        after[source].append(target)
    state = bytearray(count)  # 1 on the way, 2 done
    found = set()
    for start in range(count):
        if state[start]:
            continue
        state[start] = 1
        stack = [(start, iter(after[start]))]
        while stack:
            item, following = stack[-1]
            for target in following:
                if state[target] == 1:
                    found.add((item, target))
                elif not state[target]:
                    state[target] = 1
                    stack.append((target, iter(after[target])))
                    break
            else:
                state[item] = 2
                stack.pop()
    return found


def ranks(count: int, arrows: Sequence[Arrow]) -> list[int]:
    """Columns along the longest path; then, from right to left, what feeds more than it takes moves beside the first
    item that it feeds.

    Args:
        arrows: without a circle.
    """
    after: list[set[int]] = [set() for _ in range(count)]
    before: list[set[int]] = [set() for _ in range(count)]
    for source, target in arrows:
        after[source].add(target)
        before[target].add(source)
    order, waiting = [i for i in range(count) if not before[i]], [len(b) for b in before]
    rank = [0] * count
    for item in order:  # grows while it is walked
        for target in after[item]:
            rank[target] = max(rank[target], rank[item] + 1)
            waiting[target] -= 1
            if not waiting[target]:
                order.append(target)
    for item in reversed(order):
        if after[item] and not before[item]:
            rank[item] = min(rank[target] for target in after[item]) - 1
    return rank
