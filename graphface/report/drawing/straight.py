"""How far down each item stands: as straight across from what it is joined to as the order and the spacing allow."""

from __future__ import annotations

from collections.abc import Sequence

_ROUNDS = 12
_STILL = 0.5
"""Pixels: where no item moves further than this in a round, there are no more rounds."""
_ALONE = 0.1
"""The weight with which an item that nothing pulls stays in its place."""
Pull = tuple[int, float, float]
"""Another item, how far below its top this item has to stand for a straight link, and the weight of the link."""


def straightened(
    columns: Sequence[Sequence[int]],
    heights: Sequence[float],
    spaces: Sequence[Sequence[float]],
    before: Sequence[Sequence[Pull]],
    after: Sequence[Sequence[Pull]],
) -> list[float]:
    """The top of every item; in each column in the given order and at least `spaces` apart.

    Args:
        spaces: for each column the least distance between an item and the next.
        before, after: the links of every item to the left and to the right.
    """
    tops = [0.0] * len(heights)
    offsets = []
    for column, space in zip(columns, spaces, strict=True):
        below, down = 0.0, []
        for number, item in enumerate(column):
            down.append(below)
            tops[item] = below
            below += heights[item] + (space[number] if number < len(space) else 0.0)
        offsets.append(down)
    to_left, to_right = _sums(before), _sums(after)
    both = _sums([(*one, *other) for one, other in zip(before, after, strict=True)])
    numbers = range(len(columns))
    for order, sums in ((numbers, to_left), (reversed(numbers), to_right)):
        for number in order:
            _settle(columns[number], offsets[number], tops, sums)
    for turn in range(_ROUNDS):
        order = reversed(numbers) if turn % 2 else numbers
        if max((_settle(columns[n], offsets[n], tops, both) for n in order), default=0.0) < _STILL:
            break
    for number in (0, -1):  # the borders follow where the wires ended up
        _settle(columns[number], offsets[number], tops, both)
    return tops


_Sum = tuple[Sequence[tuple[int, float]], float, float]
"""What one item is pulled by: others with their weights, the weighted sum of the shifts, the sum of the weights."""


def _sums(pulls: Sequence[Sequence[Pull]]) -> list[_Sum]:
    return [
        (
            [(other, weight) for other, _, weight in of_item],
            sum(shift * weight for _, shift, weight in of_item),
            sum(weight for _, _, weight in of_item),
        )
        for of_item in pulls
    ]


def _settle(column: Sequence[int], offsets: Sequence[float], tops: list[float], sums: Sequence[_Sum]) -> float:
    """Least squares under the spacing: neighbors that want into each other move as one (isotonic regression).

    How far the item that moved most did.
    """
    pools: list[tuple[float, float, int]] = []  # mean, weight, count
    for item, offset in zip(column, offsets, strict=True):
        others, mean, weight = sums[item]
        if others:
            for other, pull in others:
                mean += pull * tops[other]
            mean = mean / weight - offset
        else:
            mean, weight = tops[item] - offset, _ALONE
        count = 1
        while pools and pools[-1][0] > mean:
            upper, heavier, more = pools.pop()
            mean = (upper * heavier + mean * weight) / (heavier + weight)
            weight += heavier
            count += more
        pools.append((mean, weight, count))
    at, moved = 0, 0.0
    for mean, _, count in pools:
        for place in range(at, at + count):
            item, top = column[place], mean + offsets[place]
            moved = max(moved, abs(tops[item] - top))
            tops[item] = top
        at += count
    return moved
