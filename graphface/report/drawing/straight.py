"""How far down each item stands: as straight across from what it is joined to as the order and the spacing allow."""

from __future__ import annotations

from collections.abc import Sequence

_ROUNDS = 40
Pull = tuple[int, float, float]
"""Another item, how far above it this item has to stand for a straight link, and the weight of the link."""


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
    for turn in range(_ROUNDS):
        sides = (before,) if turn % 2 == 0 else (after,)
        sides = (before, after) if turn >= _ROUNDS - 2 else sides
        numbers = range(len(columns)) if turn % 2 == 0 else range(len(columns) - 1, -1, -1)
        for number in numbers:
            _settle(columns[number], offsets[number], tops, sides)
    for number in {0, len(columns) - 1}:  # the borders follow where the wires ended up
        _settle(columns[number], offsets[number], tops, (before, after))
    return tops


def _settle(
    column: Sequence[int], offsets: Sequence[float], tops: list[float], sides: Sequence[Sequence[Sequence[Pull]]]
) -> None:
    """Least squares under the spacing: neighbors that want into each other move as one (isotonic regression)."""
    pools: list[list[float]] = []  # mean, weight, count
    for item, offset in zip(column, offsets, strict=True):
        wanted = weight = 0.0
        for side in sides:
            for other, shift, pull in side[item]:
                wanted += pull * (tops[other] + shift)
                weight += pull
        if not weight:
            wanted, weight = tops[item] * 0.1, 0.1
        pools.append([wanted / weight - offset, weight, 1])
        while len(pools) > 1 and pools[-2][0] > pools[-1][0]:
            mean, weight, count = pools.pop()
            upper = pools[-1]
            upper[0] = (upper[0] * upper[1] + mean * weight) / (upper[1] + weight)
            upper[1] += weight
            upper[2] += count
    at = 0
    for mean, _, count in pools:
        for _ in range(int(count)):
            tops[column[at]] = mean + offsets[at]
            at += 1
