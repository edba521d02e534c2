"""How far down items stand."""

from graphface.report.drawing.straight import straightened


def test_level() -> None:
    """An item stands straight across from what it is joined to, ports in line."""
    tops = straightened([[0], [1]], [40, 20], [[], []], [[], [(0, 25.0, 1.0)]], [[(1, -25.0, 1.0)], []])
    assert abs(tops[1] - tops[0] - 25) < 1


def test_spacing() -> None:
    """Two that want to stand in the same place stand around it, the least distance apart."""
    before = [[], [(0, 0.0, 1.0)], [(0, 0.0, 1.0)]]
    after = [[(1, 0.0, 1.0), (2, 0.0, 1.0)], [], []]
    tops = straightened([[0], [1, 2]], [10, 10, 10], [[], [5]], before, after)
    assert abs(tops[2] - tops[1] - 15) < 1e-6
    assert abs((tops[1] + tops[2]) / 2 - tops[0]) < 1


def test_nothing_pulls() -> None:
    """Items without a joint stand below one another."""
    assert straightened([[0, 1]], [10, 10], [[5]], [[], []], [[], []]) == [0, 15]
